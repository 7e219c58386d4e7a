"""Renderers of sheets, on sheets made for them: what is in a sheet is on each of its faces, in units of people."""

import csv
import json
import math
import zipfile

import numpy as np
import pytest

from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Bar,
    Bars,
    Chart,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Map,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    columns_of,
    document,
    words,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.faces.sheets import files, pictures, report_blocks, terminal
from support.pictures import drawn

LENGTH = Quantity("stroke", "m", Info("s", "stroke", "mm"))
TURNS = Quantity("turns", "1", Info("n", "turns"))
TIME = Quantity("time", "s", Info("t", "time"))
SHEET = Sheet(
    "an axis of two parts",
    [
        Lines([Line("assumed: nothing", "small")], detail=True),
        Lines([Line("it holds", "verdict"), Line("it is warm", "warning", "heat"), Line("assumed: a length", "small")]),
        Table(
            "parts",
            "Parts",
            ("", "stroke", "share", "why"),
            [["first", Number(0.25, LENGTH, band=(0.21234, 0.29876)), Share(0.75), "long"], ["other", None, None, ""]],
            ["A part may be short."],
        ),
        Table("life", "Life", ("", "value"), [["turns", Number(1.126e9, TURNS)], ["travel", Number(2.0, LENGTH)]]),
        Chart(
            "motion",
            Axis("time", TIME),
            Axis("position", LENGTH),
            [
                Curve("there", [0.0, 1.0], [0.0, 0.25], "blue"),
                Band("samples", [0.0, 1.0], [0.0, 0.2], [0.0, 0.3], "blue"),
                Level("end", 0.25, "red"),
                Vertical("half", 0.5),
            ],
        ),
        Chart(
            "orders",
            Axis("order", TURNS),
            Axis("amplitude", LENGTH, log=True, least=1e-6),
            [Curve("", [1.0, 2.0, 3.0], [1e-9, 1e-3, 1e-2], style="dotted")],
            detail=True,
        ),
        Map(
            "growth",
            Axis("time", TIME),
            Axis("place", LENGTH),
            Axis("grown", LENGTH),
            ([0.0, 1.0, 2.0], [0.0, 0.1]),
            [[0.0, 1e-3, 2e-3], [0.0, 2e-3, 4e-3]],
            [Level("end", 0.05)],
        ),
        Bars("shares", LENGTH, [Bar("first", [("", 0.25, "red")])]),
        Bars(
            "parts of a sum",
            LENGTH,
            [
                Bar("with a band"),
                Bar("sum", [("rolling", 0.2, "sky"), ("slip", 0.1, "blue")], (0.2, 0.45), "as it is"),
                Bar("other", [("slip", -0.1, "blue"), ("rolling", 0.3, "sky")], hatched=True),
            ],
            [Vertical("half", 0.15)],
        ),
        Columns("states", [Column("time", np.array([0.0, 0.5, math.nan]), TIME), Column("phase", ["a", "b", "b"])]),
    ],
)


@pytest.mark.parametrize(
    ("cell", "text"),
    [
        (Number(0.25, LENGTH), "250 mm"),
        (Number(0.25, LENGTH, band=(0.21234, 0.29876)), "250 mm (212.3 to 298.8)"),  # ends outward
        (Number(1.126e9, TURNS), "1126 million"),
        (Number(math.inf, TURNS), "infinite"),
        (Number(math.nan, LENGTH), "–"),
        (Number(-0.0, LENGTH), "0 mm"),
        (Number(0.25, LENGTH, 2, (0.21234, 0.29876)), "250 mm (210 to 300)"),
        (Share(-0.125), "-12.5%"),
        (Share(-1e-9), "0.0%"),
        (Share(0.125, band=(0.12345, 0.13001)), "12.5% (12.3% to 13.1%)"),
        (Share(0.3, band=(0.29, 1.0)), "30.0% (29.0% to 100.0%)"),
        (Share(math.nan), "–"),
        (None, "–"),
        ("long", "long"),
    ],
)
def test_cells_in_words(cell, text):
    assert words(cell) == text


def test_terminal():
    assert terminal.text(SHEET, "ascii").splitlines() == [
        "an axis of two parts",
        "",
        "assumed: nothing",
        "",
        "it holds",
        "warning  heat: it is warm",
        "assumed: a length",
        "",
        "Parts                     stroke  share  why",
        "  first  250 mm (212.3 to 298.8)  75.0%  long",
        "  other                        –      –",
        "  A part may be short.",
        "",
        "Life             value",
        "  turns   1126 million",
        "  travel       2000 mm",
    ]


def test_a_compact_table_has_its_unit_in_its_title():
    cells = ["first", Number(0.25, LENGTH, band=(0.21234, 0.29876))]
    table = Table("t", "Strokes, mm", ("", "stroke"), [cells], is_compact=True)
    assert terminal.text(Sheet("s", [table])).splitlines()[-1] == "  first      250 (212.3 to 298.8)"
    assert report_blocks.table(table).rows == [["first", "250 (212.3 to 298.8)"]]


def test_bars_on_the_terminal():
    table = Table("t", "T", ("", "share"), [["half", Share(0.5)], ["none", Share(0.0)], ["beyond", Share(1.5)]])
    lines = terminal.text(Sheet("s", [table])).splitlines()
    assert [line.count("█") for line in lines] == [0, 0, 0, 12, 0, 24]


def test_report_leaves_detail_out():
    blocks = report_blocks.blocks(SHEET, "axis")
    assert [type(block).__name__ for block in blocks] == [
        "Paragraph",
        "Bullets",
        "Table",
        "Table",
        "Picture",
        "Bullets",
    ]
    assert blocks[0].text == "An axis of two parts. It holds."
    assert blocks[1].entries == ["It is warm."]
    assert blocks[2].rows[0][:4] == ["first", "250 mm (212.3 to 298.8)", "75.0%", "long"]
    assert blocks[2].rows[0][4].end == 0.75
    assert blocks[4].words == "Motion; growth; shares; parts of a sum: an axis of two parts."
    assert blocks[5].entries == ["Assumed: a length."]
    assert "assumed: nothing" not in str(blocks)


def test_csv_and_workbook(tmp_path):
    files.write(tmp_path / "a.csv", SHEET)
    with (tmp_path / "a.csv").open(encoding="utf-8", newline="") as stream:
        assert list(csv.reader(stream)) == [["time [s]", "phase"], ["0.0", "a"], ["0.5", "b"], ["", "b"]]
    files.write(tmp_path / "a.xlsx", SHEET)
    with zipfile.ZipFile(tmp_path / "a.xlsx") as book:
        listed = book.read("xl/workbook.xml").decode()
    assert [name in listed for name in ("parts", "life", "states")] == [True] * 3
    # one unit in the heading, several beside the numbers
    parts, life = (files.rows_of(SHEET.blocks[index]) for index in (2, 3))
    assert parts.headings == ["parts", "stroke [mm]", "stroke [mm] from", "stroke [mm] to", "share", "why"]
    assert parts.rows[0] == ["first", 250.0, 212.34, 298.76, 0.75, "long"]
    assert life.headings == ["life", "value", "unit"]
    assert life.rows == [["turns", 1.126e9, ""], ["travel", 2000.0, "mm"]]


def test_picture(tmp_path):
    files.write(tmp_path / "a.svg", SHEET)
    shown = drawn(tmp_path / "a.svg")
    charts = ("position [mm]", "time [s]", "there", "samples", "end", "half", "amplitude [mm]", "grown [mm]")
    caption = "It holds. It is warm. Assumed: a length."
    parts = ("rolling", "slip", "as it is", "parts of a sum")
    for text in ("an axis of two parts", caption, *charts, "shares", "[mm]", *parts):
        assert text in shown.text
    assert [len(panel.lines) for panel in shown.panels[:3]] == [3, 1, 1]
    assert [panel.areas for panel in shown.panels[:3]] == [1, 0, 1]


def test_bars_of_parts():
    """Parts stand one after the other, negative ones to the left of zero; a band is about the end of their sum."""
    panel = next(panel for panel in pictures.picture(SHEET).axes if panel.get_title() == "parts of a sum")
    edges = [(round(bar.get_x(), 9), round(bar.get_x() + bar.get_width(), 9)) for bar in panel.patches]
    assert edges == [(0, 200), (200, 300), (0, -100), (0, 300)]
    assert [bool(bar.get_hatch()) for bar in panel.patches] == [False, False, True, True]
    assert panel.collections[0].get_segments()[0][:, 0] == pytest.approx([200, 450])


def test_csv_is_the_first_table_of_columns_or_else_the_first_table(tmp_path):
    """By their order, not by their lengths, which differ from case to case."""
    short = Table("t", "T", ("", "share"), [["half", Share(0.5)]])
    long = Table("u", "U", ("", "share"), [["a", Share(0.1)], ["b", Share(0.2)]])
    columns = [Columns("one", [Column("x", [1])]), Columns("two", [Column("x", [1, 2])])]
    for blocks, name, text in (
        ([short, long], "", "t,share\nhalf,0.5\n"),
        ([short, *columns], "", "x\n1\n"),
        ([short, *columns], "two", "x\n1\n2\n"),
    ):
        files.write_tables(tmp_path / "a.csv", Sheet("s", blocks), name)
        assert (tmp_path / "a.csv").read_text() == text


def test_no_table_takes_the_place_of_another_of_its_name():
    table = Table("t", "T", ("",), [["a"]])
    with pytest.raises(AssertionError, match="two tables of one name"):
        Sheet("s", [table, table])


def test_axes_of_a_picture():
    _, second, *_ = pictures.picture(SHEET).axes
    assert second.get_yscale() == "log"
    assert second.get_ylim()[0] == pytest.approx(1e-3)
    curve = Curve("", [1.0, 2.0], [0.99, 1.01], style="circles")
    (high,) = pictures.picture(Sheet("s", [Chart("c", Axis("x", TURNS), Axis("y", TURNS, least=0.0), [curve])])).axes
    assert high.get_ylim() == pytest.approx((0.0, 1.01 * 1.05))  # no circle is cut by the frame


def test_json():
    found = json.loads(json.dumps(document(SHEET), allow_nan=False))
    assert [block["kind"] for block in found["blocks"]] == [
        "lines",
        "lines",
        "table",
        "table",
        "chart",
        "chart",
        "map",
        "bars",
        "bars",
        "columns",
    ]
    number = found["blocks"][2]["rows"][0][1]
    assert (number["value"], number["unit"], number["band"]) == (0.25, "m", [0.21234, 0.29876])
    assert found["blocks"][9]["columns"][0]["values"] == [0.0, 0.5, None]


def test_unknown_kinds_of_files_are_refused(tmp_path):
    from ballscrew.basis.errors import InputError

    with pytest.raises(InputError, match=r"a\.doc.*\.csv, \.xlsx, \.png, \.svg or \.pdf"):
        files.check([tmp_path / "a.doc"])


def test_an_end_of_a_band_is_rounded_outward():
    assert [words(Number(0.12345, LENGTH, 2, toward=way)) for way in (-1, 0, 1)] == ["120 mm", "120 mm", "130 mm"]


def test_bars_begin_at_their_origin_or_where_they_say():
    bars = [Bar("shift", [("", 0.1, "blue")]), Bar("interval", [("", 0.2, "blue")], start=0.3)]
    (panel,) = pictures.picture(Sheet("s", [Bars("b", LENGTH, bars, origin=0.5)])).axes
    edges = [(round(bar.get_x(), 9), round(bar.get_x() + bar.get_width(), 9)) for bar in panel.patches]
    assert edges == [(500, 600), (300, 500)]
    assert panel.get_xlim()[0] < 300  # no axis begins at a bar


def test_rows_need_not_have_the_same_columns():
    rows = [{"name": ("a", None), "stroke": (0.1, LENGTH)}, {"name": ("b", None), "mass": (None, LENGTH)}]
    table = files.rows_of(columns_of("t", lambda: rows))
    assert table.headings == ["name", "stroke [mm]", "mass [mm]"]
    assert table.rows == [["a", 100.0, None], ["b", None, None]]


def test_lines_below_a_heading_are_a_list_of_their_own_in_a_report():
    lines = Lines([Line("what is uncertain:"), Line("  a length"), Line("  a mass")])
    _, paragraph, bullets = report_blocks.blocks(Sheet("s", [lines]), "s")
    assert (paragraph.text, bullets.entries) == ("What is uncertain:", ["A length.", "A mass."])
