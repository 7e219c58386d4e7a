"""Charts of the page: the band of the torque over the speed, and operating points of either sign."""

import json

import pytest

#: A chart as it is drawn: the ends of its axes, its diamond, and its curves by name.
CHART = """(id) => {
  const plot = document.querySelector(`#${id} .plot`);
  const { xaxis, yaxis } = plot._fullLayout;
  const { x, y } = plot.data.find((one) => one.marker?.symbol === "diamond");
  const lines = plot.data.filter((one) => one.mode === "lines" && !one.stackgroup);
  return {
    x: xaxis.range, y: yaxis.range, point: [x[0], y[0]],
    lines: lines.map(({ name, x, y }) => [name, [...x], [...y]]), map: plot.data[0].z,
  };
}"""
DRAWN = """(id) => document.querySelector(`#${id} .plot`)?._fullLayout?.xaxis"""


def chart(here, name):
    here.see(f"#{name}")
    here.page.locator(f"#{name}").scroll_into_view_if_needed()
    here.page.wait_for_function(DRAWN, arg=name)
    return here.page.evaluate(CHART, name)


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
    names = [name for name, _, _ in found["lines"]]
    within = [f"{end} end, {share} % of the samples" for share in (80, 50) for end in ("lower", "upper")]
    assert names == ["lower end of the band", "upper end of the band", *within, "sum"]
    speed, _ = found["point"]
    low, high, low_of_80, high_of_80, low_of_50, high_of_50, _ = found["lines"]
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
    row = here.page.locator("#torque-chart tbody tr").first.locator("td").all_inner_texts()
    intervals = (low, high, low_of_80, high_of_80, low_of_50, high_of_50)
    assert [float(cell) for cell in row[1:7]] == pytest.approx([line[2][0] for line in intervals], rel=1e-3)
    here.page.locator("#band").uncheck()
    here.page.wait_for_function(
        "() => !document.querySelector('#torque-chart ul.legend').innerText.includes('the samples')"
    )
    # a chart that was out of sight is drawn again once it is in sight
    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    here.page.wait_for_function("() => !document.querySelector('#torque-chart .plot').data.some(({ fill }) => fill)")
    assert [name for name, _, _ in chart(here, "torque-chart")["lines"]] == ["sum"]


@pytest.mark.parametrize(("load", "speed"), [(4000, -600), (-4000, 600), (-4000, -600)])
def test_operating_points_of_either_sign_stand_on_their_curves(load, speed, visit):
    here = visit().open(f"#A=paper&A.operation.axial_load={load}+N&A.operation.screw_speed={speed}+rpm&band=0")
    for name, value in {"torque-chart": speed, "film-chart": speed, "pressure-chart": load}.items():
        found = chart(here, name)
        (left, right), (x, y) = found["x"], found["point"]
        assert x == pytest.approx(value)
        assert left < x < right
        assert right == pytest.approx(2 * abs(value), rel=1e-4)
        curves = [at(line, x) for line in found["lines"]]
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
    x, y = here.page.evaluate(
        """() => {
          const plot = document.querySelector("#torque-chart .plot"), { left, top } = plot.getBoundingClientRect();
          const { xaxis, yaxis } = plot._fullLayout;
          const { x, y } = plot.data.find((one) => one.marker?.symbol === "diamond");
          return [left + xaxis._offset + xaxis.d2p(x[0]), top + yaxis._offset + yaxis.d2p(y[0])];
        }"""
    )
    mouse = here.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 40, y, steps=3)
    mouse.up()
    here.settle()
    moved = float(here.page.locator(here.id("operation.screw_speed")).input_value())
    assert found["x"][0] < moved < -600


#: What plotly.js keeps of a plot: the figure, and a listener of the window that holds it.
HELD = "(plot) => [plot._fullLayout, plot._responsiveChartHandler].map((one) => one !== undefined)"


def test_a_plot_that_is_taken_away_is_ended(visit):
    """Where its answer fails, and where a place of its name is made anew: nothing keeps its numbers in memory."""
    here = visit().open()
    chart(here, "torque-chart")
    plot = here.page.query_selector("#torque-chart .plot")
    assert plot.evaluate(HELD) == [True, True]
    problem = {"title": "too much", "status": 422, "lines": ["too much"], "faults": []}

    def refuse(route):
        """The answers, but for the curve over the speed."""
        answer = route.fetch()
        lines = [json.loads(line) for line in answer.text().splitlines()]
        refused = {"question": "over_speed", "place": 0, "problem": problem}
        lines = [refused if line["question"] == "over_speed" else line for line in lines]
        route.fulfill(response=answer, body="".join(f"{json.dumps(line)}\n" for line in lines))

    here.page.route("**/api/v1/answers", refuse)
    here.type("operation.axial_load", "5000")
    here.page.wait_for_selector("#torque-chart > .warning")
    assert plot.evaluate(HELD) == [False, False]
    first = here.page.evaluate_handle(
        """async () => {
          const { draw, watch, layout } = await import("/page/plot.js");
          const figure = (colours) => ({ traces: [{ x: [1, 2], y: [1, 2] }], layout: layout(colours, "x", "y") });
          const nothing = { description: "", caption: "", legend: () => [], numbers: () => [[], []] };
          const chart = { name: "made", figure, ...nothing };
          const place = () => Object.assign(document.createElement("div"), { id: "made-chart", className: "chart" });
          const holder = document.querySelector("#torque-chart").parentElement;
          const one = place(), other = place();
          holder.append(one);
          watch(one);
          await draw("made-chart", chart);
          one.scrollIntoView();
          while (!one.querySelector(".plot")._fullLayout) await new Promise((then) => setTimeout(then, 20));
          one.replaceWith(other);
          watch(other);
          return one.querySelector(".plot");
        }"""
    )
    assert first.evaluate(HELD) == [False, False]


def test_answers_that_are_kept_are_bounded_by_their_size(visit):
    """Of six answers of 4 MB the first is asked again, and one larger than all may be is never kept; not the rest."""
    found = (
        visit()
        .open()
        .page.evaluate(
            """async () => {
          const { ask } = await import("/page/server.js");
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
    here.page.wait_for_selector("#torque-chart .main-svg")
    assert here.page.locator("#torque-chart .plot .bg").first.bounding_box()["width"] > 400
