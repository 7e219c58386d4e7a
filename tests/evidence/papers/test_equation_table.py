"""The table of equations in the documentation is up to date."""


def test_the_page_is_up_to_date(equation_table):
    page = equation_table.TESTS.parent / "docs" / "equations.md"
    assert equation_table.table() in page.read_text(encoding="utf-8"), "make readme"


def test_every_row_is_filled(equation_table):
    rows = [line for line in equation_table.table().splitlines() if line.startswith("| §")]
    assert len(rows) == 41
    for row in rows:
        cells = [cell.strip() for cell in row.strip("|").split(" | ")]
        assert len(cells) == 5, row
        assert all(cells), row
