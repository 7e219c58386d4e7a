"""Charts of the page: the band of the torque over the speed, and operating points of either sign."""

import json
from xml.etree import ElementTree

import pytest

from .drawn_charts import DRAWN, POINT, chart

pytestmark = pytest.mark.slow


def at(line, place):
    """The value of a line at a place between its points."""
    _, x, y = line
    (left, low), (right, high) = next(
        pair
        for pair in zip(zip(x, y, strict=True), list(zip(x, y, strict=True))[1:], strict=False)
        if pair[0][0] <= place <= pair[1][0]
    )
    return low + (high - low) * (place - left) / (right - left)


def test_the_torque_over_the_speed_has_its_band(visit, server):
    """At the operating point that of the headline; it goes with the box, and its numbers stand in the table."""
    here = visit().open("#A=paper")
    here.page.wait_for_selector("#band-words details")
    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(
        "() => document.querySelector('#torque-chart ul.legend')?.innerText.includes('of the samples')"
    )
    case = server.get("vocabulary").json()["starts"]["paper"]["case"]
    band = server.post("band", {"case": case}).json()["band"]["screw_torque"]
    found = chart(here, "torque-chart")
    assert [name for name, *_ in found["curves"]] == ["sum"]
    assert [name for name, *_ in found["bands"]] == [
        f"band: {share} % of the samples of inputs and laws" for share in (95, 80, 50)
    ]
    ends = [((name, x, low), (name, x, high)) for name, x, low, high in found["bands"]]
    (low, high), (low_of_80, high_of_80), (low_of_50, high_of_50) = ends
    speed, _ = found["point"]
    assert at(low, speed) == pytest.approx(band["low"], rel=0.01)
    assert at(high, speed) == pytest.approx(band["high"], rel=0.01)
    # the narrower intervals are those of the same samples at a level of their own, and lie in each other
    of_level = {0.5: (low_of_50, high_of_50), 0.8: (low_of_80, high_of_80)}
    for level, ends in of_level.items():
        one = server.post("band", {"case": case, "level": level}).json()["band"]["screw_torque"]
        assert [at(end, speed) for end in ends] == pytest.approx([one["low"], one["high"]], rel=0.01)
    nested = zip(*(line[2] for line in (low, low_of_80, low_of_50, high_of_50, high_of_80, high)), strict=True)
    assert all(list(ends) == sorted(ends) for ends in nested)
    legend = here.text("#torque-chart ul.legend")
    assert all(f"band: {share} % of the samples" in legend for share in (95, 80, 50))
    here.page.locator("#torque-chart summary").click()
    here.page.wait_for_selector("#torque-chart tbody td")
    headings = here.page.locator("#torque-chart thead th").all_inner_texts()
    row = here.page.locator("#torque-chart tbody tr").first.locator("th, td").all_inner_texts()
    within = [f"{end} end, {share} % of the samples (N·m)" for share in (80, 50) for end in ("lower", "upper")]
    names = ["lower end of the band (N·m)", "upper end of the band (N·m)", *within]
    assert headings[2:8] == names
    intervals = (low, high, low_of_80, high_of_80, low_of_50, high_of_50)
    assert [float(cell) for cell in row[2:8]] == pytest.approx([line[2][0] for line in intervals], rel=1e-3)
    here.page.locator("#band").uncheck()
    here.page.wait_for_function(
        "() => !document.querySelector('#torque-chart ul.legend').innerText.includes('the samples')"
    )
    # a chart that was out of sight is drawn again once it is in sight
    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    assert chart(here, "torque-chart")["bands"] == []


@pytest.mark.parametrize(("load", "speed"), [(4000, -600), (-4000, 600), (-4000, -600)])
def test_operating_points_of_either_sign_stand_on_their_curves(load, speed, visit):
    here = visit().open(f"#A=paper&A.operation.axial_load={load}+N&A.operation.screw_speed={speed}+rpm&band=0")
    for name, value in {"torque-chart": speed, "film-chart": speed, "pressure-chart": load}.items():
        found = chart(here, name)
        (left, right), (x, y) = found["x"], found["point"]
        assert x == pytest.approx(value)
        assert left < x < right
        assert right == pytest.approx(2 * abs(value), rel=1e-4)
        curves = [at(line, x) for line in found["curves"]]
        assert any(y == pytest.approx(one, rel=0.02) for one in curves), name
    found = chart(here, "map-chart")
    assert found["point"] == pytest.approx([speed, load])
    assert found["x"][0] < speed < found["x"][1]
    assert found["y"][0] < load < found["y"][1]
    assert all(0 < value < 1 for row in found["map"] for value in row)
    assert ("the load drives" in here.text("#map-chart ul.legend")) is True


def test_a_speed_below_zero_is_dragged(visit):
    here = visit().open("#A=paper&A.operation.screw_speed=-600+rpm&band=0")
    found = chart(here, "torque-chart")
    x, y = here.page.evaluate(POINT, "torque-chart")
    mouse = here.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 40, y, steps=3)
    mouse.up()
    here.settle()
    moved = float(here.page.locator(here.id("operation.screw_speed")).input_value())
    assert found["x"][0] < moved < -600


def test_a_chart_that_fails_leaves_nothing_to_read(visit):
    """Where its answer fails the reason stands in its place, and the next one is drawn there."""
    here = visit().open()
    chart(here, "torque-chart")
    problem = {"title": "too much", "status": 422, "lines": ["too much"], "faults": []}

    def refuse(route):
        """The answers, but for the curve over the speed."""
        answer = route.fetch()
        lines = [json.loads(line) for line in answer.text().splitlines()]
        refused = {"question": "over_speed", "place": 0, "problem": problem}
        lines = [refused if line["question"] == "over_speed" else line for line in lines]
        route.fulfill(response=answer, body="".join(f"{json.dumps(line)}\n" for line in lines))

    here.page.route("**/api/v1/answers", refuse, times=1)
    here.type("operation.axial_load", "5000")
    here.page.wait_for_selector("#torque-chart > .warning")
    assert here.page.locator("#torque-chart canvas").count() == 0
    here.type("operation.axial_load", "6000")
    here.page.wait_for_function(DRAWN, arg="torque-chart")
    assert here.page.locator("#torque-chart > .warning").count() == 0


def test_a_chart_is_read_enlarged_and_shown_whole_again(visit):
    """All curves are read at one place; a part that is drawn out by the pointer fills the chart."""
    here = visit().open("#A=paper&band=0")
    whole = chart(here, "pressure-chart")
    box = here.page.locator("#pressure-chart .plot").bounding_box()
    mouse = here.page.mouse
    mouse.move(box["x"] + box["width"] / 3, box["y"] + 60)
    lines = here.page.locator("#pressure-chart .reading li").all_inner_texts()
    load = float(here.text("#pressure-chart .reading p").rsplit(": ")[1])
    place = whole["curves"][0][1].index(load)
    assert [line.rsplit(": ")[0] for line in lines] == ["ball and screw (GPa)", "ball and nut (GPa)"]
    assert [float(line.rsplit(": ")[1]) for line in lines] == pytest.approx(
        [curve[2][place] for curve in whole["curves"]], rel=1e-3
    )
    mouse.down()
    mouse.move(box["x"] + box["width"] / 2, box["y"] + 62, steps=3)
    mouse.up()
    part = chart(here, "pressure-chart")
    assert part["x"][0] > whole["x"][0]
    assert part["x"][1] < whole["x"][1]
    assert part["y"] == whole["y"]
    here.page.locator("#pressure-chart button.whole").click()
    assert chart(here, "pressure-chart")["x"] == whole["x"]
    assert not here.page.locator("#pressure-chart button.whole").is_visible()


#: A figure: two curves, one of a single point, a band of fewer points, dots, and a range that is not valid.
FIGURE = """
  const curve = (name, x, y, style = "line") => ({ kind: "curve", name, x, y, colour: "ink", style });
  const figure = { x: { title: "x (s)" }, y: { title: "y (N)" }, marks: [
    curve("one", [0, 1, 2, 3, 4], [0, 10, 20, 30, 40]), curve("alone", [4], [7]), curve("tests", [3], [5], "dots"),
    { kind: "band", name: "band", x: [0, 4], low: [0, 8], high: [4, 12], colour: "ink", solid: false },
    { kind: "outside", name: "outside", x: [0, 1, 2, 3, 4], valid: [true, false, false, false, true] },
  ] };
"""
READ = f"""async (places) => {{
  const {{ readingAt }} = ballscrewModules["figure_words.js"];
  const {{ Scale }} = ballscrewModules["scale.js"];
  {FIGURE}
  const box = {{ left: 0, top: 0, right: 400, bottom: 100 }};
  const frame = {{ box, x: new Scale(0, 4, 0, 400), y: new Scale(0, 40, 100, 0) }};
  return places.map((place) => {{
    const {{ title, lines }} = readingAt(figure, frame, ...place);
    return [title, ...lines.map(({{ words }}) => words)];
  }});
}}"""
#: The length of the picture of a small part of it.
PART = f"""async (range) => {{
  const {{ drawFigure }} = ballscrewModules["figure.js"];
  const {{ PAPER }} = ballscrewModules["palette.js"];
  const {{ SvgPen }} = ballscrewModules["pen.js"];
  {FIGURE}
  const pen = new SvgPen(400, 200);
  drawFigure(pen, figure, {{ width: 400, height: 200 }}, PAPER, {{ x: range }});
  return pen.document("", "").length;
}}"""


def test_all_marks_are_read_at_one_place(visit):
    """A band between its points, a curve only where it is, dots only near them."""
    found = visit().open("#A=paper&band=0").page.evaluate(READ, [[110, 10], [398, 10], [301, 88]])
    assert found == [
        ["x (s): 1", "one (N): 10", "band (N): 2 to 6"],
        ["x (s): 4", "one (N): 40", "alone (N): 7", "band (N): 8 to 12"],
        ["x (s): 3", "tests (N): 5"],
    ]


def test_a_small_part_of_a_chart_is_drawn_as_fast_as_the_whole(visit):
    """The stripes over what is not valid were drawn far beyond the chart: 10 million of them after three drags."""
    page = visit().open("#A=paper&band=0").page
    whole, part = (page.evaluate(PART, ends) for ends in ([0, 4], [2, 2.000001]))
    assert part < 2 * whole


def test_a_chart_is_saved_as_it_is_seen(visit):
    """Its curves, its words and its legend as SVG, on white whatever the screen is."""
    here = visit(scheme="dark").open("#A=paper&band=0")
    chart(here, "pressure-chart")
    picture = ElementTree.fromstring(here.download("#pressure-chart button:text-is('SVG')"))
    words = [text.text for text in picture.iter("{http://www.w3.org/2000/svg}text")]
    assert {"axial load (N)", "greatest pressure (GPa)", "ball and screw", "operating point"} <= {*words}
    strokes = {path.get("stroke") for path in picture.iter("{http://www.w3.org/2000/svg}path")}
    assert {"#0062a0", "#a34a00"} <= strokes
    assert picture.find("{http://www.w3.org/2000/svg}rect").get("fill") == "#ffffff"


def test_answers_that_are_kept_are_bounded_by_their_size(visit):
    """Of six answers of 4 MB the first is asked again, and one larger than all may be is never kept; not the rest."""
    found = (
        visit()
        .open()
        .page.evaluate(
            """async () => {
          const { ask } = ballscrewModules["server.js"];
          const asked = [];
          const one = (n, size) => ask("run", { n }, new AbortController().signal, async () => {
            asked.push(n);
            return { text: "x".repeat(size) };
          });
          for (const n of [1, 2, 3, 4, 5, 6]) await one(n, 4e6);
          await one(7, 21e6);
          for (const n of [6, 5, 4, 3, 7, 1]) await one(n, n === 7 ? 21e6 : 4e6);
          return asked;
        }"""
        )
    )
    assert found == [1, 2, 3, 4, 5, 6, 7, 7, 1]


def test_the_torque_has_its_width_on_a_small_screen(visit):
    here = visit(width=1024, height=768).open("#A=paper&band=0")
    here.page.wait_for_function(DRAWN, arg="torque-chart")
    left, right = here.page.evaluate(
        "() => { const { x } = document.querySelector('#torque-chart .plot').drawn.frame; return [x.start, x.end]; }"
    )
    assert right - left > 400
