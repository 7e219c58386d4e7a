"""The table of equations in the documentation is up to date."""


def test_the_page_is_up_to_date(equation_table):
    assert equation_table.PAGE.read_text(encoding="utf-8") == equation_table.page(), (
        "run python docs/make_equation_table.py"
    )


def test_every_row_is_filled(equation_table):
    rows = [line for line in equation_table.page().splitlines() if line.startswith("| §")]
    assert len(rows) == 41
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split(" | ")]
        assert len(cells) == 5, row
        assert all(cells), row
