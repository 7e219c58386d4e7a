"""The renderer of sheets on the page, on a sheet that is made for it: each kind of block, in both systems of units."""

from pathlib import Path

import pytest

pytestmark = pytest.mark.slow

TORQUE, LENGTH, PLAIN = ({"unit": unit, "shown_in": shown} for unit, shown in (("N m", "N m"), ("m", "mm"), ("1", "1")))


def number(value, quantity, digits=4, **more):
    return {"value": value, **quantity, "digits": digits, **more}


def share(value, *, bar=False, is_change=False, **more):
    return {"share": value, "bar": bar, "is_change": is_change, **more}


def axis(name, quantity, **more):
    return {"name": name, "quantity": quantity, "log": False, "least": None, **more}


def curve(name, x, y, style="line", **more):
    return {"name": name, "x": x, "y": y, "colour": "blue", "style": style, "second": False, "labels": [], **more}


def line(text, kind, name="", *, is_bad=False):
    return {"text": text, "kind": kind, "name": name, "is_bad": is_bad}


LINES = [
    line("the motor suffices", "verdict"), line("it falls", "verdict", is_bad=True),
    line("it is hot", "warning", name="warm"), line("as usual", "small"), line("a_log.csv: 3 rows", "plain"),
]  # fmt: skip
TABLE = {
    "kind": "table", "name": "sizes", "title": "Sizes", "columns": ["", "value", "share", "words"],
    "rows": [
        ["a heading", "", "", ""],
        ["<b>", number(0.0123456, LENGTH, band=[0.012, 0.0130001]), share(0.255, bar=True), "x"],
        ["nothing", None, share(0.1, is_change=True, band=[0.0991, 0.1009]), "y"],
    ],
    "notes": ["below it."], "detail": False, "is_compact": False, "fields": [],
}  # fmt: skip
CHART = {
    "kind": "chart", "title": "torque over length", "x": axis("length", LENGTH), "y": axis("torque", TORQUE, least=0.0),
    "second": axis("ratio", PLAIN), "detail": False,
    "marks": [
        curve("model", [0.001, 0.002], [0.1, 0.2]),
        curve("tests", [0.001, 0.002], [0.1, None], "dots", labels=["A"]),
        curve("ratio", [0.001, 0.002], [1.0, 2.0], "dashed", second=True),
        {"name": "band", "x": [0.001, 0.002], "low": [0.0, 0.1], "high": [0.2, 0.3], "colour": "grey", "solid": False},
        {"name": "limit", "y": 0.25, "colour": "red"},
        {"name": "end", "x": 0.002, "colour": "ink"},
    ],
}  # fmt: skip
BARS = {
    "kind": "bars", "title": "parts", "quantity": TORQUE, "origin": 0.1, "detail": False,
    "marks": [{"name": "half", "x": 0.2, "colour": "ink"}],
    "bars": [
        {"name": "one", "parts": [["spin", 0.1, "red"], ["other", -0.05, "blue"]], "band": [0.1, 0.3], "text": "t",
         "hatched": False, "start": None},
        {"name": "heading", "parts": [], "band": None, "text": "", "hatched": False, "start": None},
    ],
}  # fmt: skip
MAP = {
    "kind": "map", "title": "a map", "x": axis("length", LENGTH), "y": axis("torque", TORQUE),
    "value": axis("ratio", PLAIN), "places": [[0.001, 0.002, 0.003], [0.1, 0.2]],
    "values": [[1.0, 2.0, 3.0], [2.0, None, 4.0]], "marks": [{"name": "", "y": 0.15, "colour": "ink"}], "detail": False,
}  # fmt: skip
COLUMNS = {
    "kind": "columns", "name": "long table",
    "columns": [{"name": "at", "values": [0.001, 0.002], "quantity": LENGTH},
                {"name": "what", "values": ["p", "q"], "quantity": None}],
}  # fmt: skip
SHEET = {
    "title": "a sheet",
    "blocks": [
        {"kind": "lines", "detail": False, "lines": LINES},
        {"kind": "lines", "detail": True, "lines": [line("an assumption", "small")]},
        TABLE, CHART, BARS, MAP, COLUMNS,
    ],
}  # fmt: skip
SHOW = """async (sheet) => {
  const { sheetPlace } = ballscrewModules["sheet.js"];
  globalThis.made ??= sheetPlace("made");
  document.querySelector("#results").prepend(globalThis.made.head, globalThis.made.place);
  globalThis.made.show(sheet);
}"""


@pytest.fixture
def page(visit):
    here = visit().open("#A=paper&band=0")
    here.page.evaluate(SHOW, SHEET)
    return here.page


def test_lines_and_tables(page):
    assert page.locator("#made-head h3").inner_text() == "A sheet."
    assert page.locator("#made-head .verdict").all_inner_texts() == ["The motor suffices.", "It falls."]
    assert page.locator("#made-head .verdict.careful").all_inner_texts() == ["It falls."]
    assert page.locator("#made-head p >> text=a_log.csv: 3 rows.").count() == 1  # the name of a file stays as it is
    assert page.locator("#made-head .warning[data-record=warm]").inner_text() == "Beware: It is hot."
    assert not page.locator("#made-sheet details >> text=An assumption.").is_visible()
    rows = page.locator("#made-sheet > div table tbody tr")
    texts = [[cell.inner_text() for cell in row.locator("th, td").all()] for row in rows.all()]
    # ends of bands are rounded outward, texts are texts
    assert texts == [
        ["a heading", "", "", ""],
        ["<b>", "12.35\u00a0mm (12 to 13.01)", "25.5\u00a0%", "x"],
        ["nothing", "\u2013", "+10.0\u00a0% (9.9\u00a0% to 10.1\u00a0%)", "y"],
    ]
    assert page.locator("#made-sheet > div .small >> text=Below it.").count() == 1
    values = page.locator("#made-sheet > div table data").evaluate_all("all => all.map((one) => Number(one.value))")
    assert values == [0.0123456, 0.255, 0.1]


def plot(page, name):
    page.locator(f"#made-chart-{name}").scroll_into_view_if_needed()
    page.wait_for_selector(f"#made-chart-{name} .plot[data-drawn]")
    return page.locator(f"#made-chart-{name} .plot")


def test_charts(page):
    found = plot(page, "torque-over-length").evaluate(
        """({ drawn: { figure: { x, y, second, marks }, frame } }) => ({
          curves: marks.filter(({ kind }) => kind === "curve")
            .map(({ name, x, y, second, style }) => [name, x, y, second, style]),
          titles: [x, y, second].map(({ title }) => title),
          levels: marks.filter(({ kind }) => kind === "level").map(({ x, y }) => [x ?? null, y ?? null]),
          least: frame.y.from })"""
    )
    assert found["titles"] == ["length (mm)", "torque (N\u00b7m)", "ratio"]
    assert (found["levels"], found["least"]) == ([[None, 0.25], [2, None]], 0)
    assert ["model", [1, 2], [0.1, 0.2], False, "line"] in found["curves"]
    assert ["ratio", [1, 2], [1, 2], True, "dashed"] in found["curves"]
    legend = page.locator("#made-chart-torque-over-length ul.legend li").all_inner_texts()
    assert legend == ["model", "tests", "ratio", "band", "limit 0.25 N\u00b7m", "end 2 mm"]
    page.locator("#made-chart-torque-over-length summary").click()
    page.wait_for_selector("#made-chart-torque-over-length tbody tr")  # it opens a little later
    headings = page.locator("#made-chart-torque-over-length thead th").all_inner_texts()
    assert headings == [
        "length (mm)",
        "model (N\u00b7m)",
        "tests (N\u00b7m)",
        "ratio",
        "band lower end (N\u00b7m)",
        "band upper end (N\u00b7m)",
    ]
    assert page.locator("#made-chart-torque-over-length tbody tr").count() == 2


def test_bars_and_maps(page):
    spin, other, whisker = plot(page, "parts").evaluate(
        "({ drawn: { figure: { marks } } }) => marks.filter(({ kind }) => kind !== 'level')"
    )
    assert (spin["width"], spin["base"]) == (0.1, 0.1)
    assert (other["width"], other["base"]) == (-0.05, 0.1)  # to the left of the origin
    assert (whisker["low"], whisker["high"]) == (0.1, 0.3)
    grid = plot(page, "a-map").evaluate("({ drawn: { figure: { marks } } }) => marks[0]")
    assert grid["values"] == MAP["values"]
    assert grid["x"] == [1, 2, 3]


def band(name, low, high):
    return {"name": name, "x": [0.001, 0.002], "low": low, "high": high, "colour": "blue", "solid": True}


#: Bands alone, stacked; values that nobody knows; a unit with an offset; names that look like markup.
KELVIN = {"unit": "K", "shown_in": "degC"}
STACKED = {
    "kind": "chart", "title": "stacked", "x": axis("length", LENGTH), "y": axis("torque", TORQUE), "second": None,
    "detail": False,
    "marks": [
        band("<b>one</b>", [0.0, 0.0], [0.2, 0.3]), band("other", [0.2, 0.3], [1.0, None]),
        {"name": "nowhere", "y": None, "colour": "red"},
    ],
}  # fmt: skip
UNKNOWN = {
    "kind": "bars", "title": "unknown", "quantity": KELVIN, "origin": 0.0, "detail": False, "marks": [],
    "bars": [
        {"name": "<i>warmer</i>", "parts": [["", 2.0, "red"]], "band": [1.0, None], "text": "taken", "hatched": False,
         "start": 293.15},
        {"name": "", "parts": [["", None, "blue"]], "band": None, "text": "", "hatched": False, "start": None},
    ],
}  # fmt: skip


def test_what_is_unknown_is_not_drawn_as_nothing(page):
    page.evaluate(SHOW, {"title": "another", "blocks": [STACKED, UNKNOWN]})
    found = plot(page, "stacked").evaluate(
        "({ drawn: { figure: { marks } } }) => marks.map(({ kind, name }) => [kind, name])"
    )
    assert found == [["band", "<b>one</b>"], ["band", "other"]]
    page.locator("#made-chart-stacked summary").click()
    page.wait_for_selector("#made-chart-stacked tbody tr")
    cells = page.locator("#made-chart-stacked tbody tr >> nth=0").locator("th, td").all_inner_texts()
    assert cells == ["1", "0.2", "0.8"]  # what is stacked is a part, not the place of its ends
    bars = plot(page, "unknown")
    parts = bars.evaluate(
        "({ drawn: { figure: { marks } } }) => marks.filter(({ kind }) => kind === 'bar')"
        ".map(({ width, base, words }) => [width, base, words])"
    )
    assert parts == [[2, 20, "<i>warmer</i>: 2 \u00b0C: taken"], [None, 20 - 293.15, "<i>warmer</i>: \u2013 \u00b0C"]]
    assert bars.evaluate("({ drawn }) => drawn.figure.y.names[0].words") == "<i>warmer</i>"
    page.locator("#made-chart-unknown summary").click()
    page.wait_for_selector("#made-chart-unknown tbody tr")
    rows = page.locator("#made-chart-unknown tbody tr")
    assert [row.locator("th, td").all_inner_texts() for row in rows.all()] == [
        ["<i>warmer</i>", "2", "-272.15", "", "taken"],
        ["<i>warmer</i>", "", "", "", ""],
    ]


def test_columns_are_saved_and_units_change(page):
    with page.expect_download() as saved:
        page.locator("#made-sheet [data-columns='long table']").click()
    text = Path(saved.value.path()).read_text(encoding="utf-8")
    assert text.split() == ["at", "(mm),what", "1,p", "2,q"]
    plot(page, "torque-over-length")
    page.locator("#system").select_option("inch")
    page.evaluate(SHOW, SHEET)
    assert page.locator("#made-sheet > div table data").first.inner_text() == "0.486\u00a0in (0.4724 to 0.5119)"
    page.wait_for_function(
        "() => document.querySelector('#made-chart-torque-over-length .plot').drawn.figure.x.title === 'length (in)'"
    )
    # a chart that is no more is gone
    page.evaluate(SHOW, {**SHEET, "blocks": SHEET["blocks"][:3]})
    assert page.locator("#made-sheet .chart").count() == 0
