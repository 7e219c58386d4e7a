"""What is drawn in a chart of the page, as its place tells it."""

#: A chart is drawn: the place has its figure, and the scales of its axes.
DRAWN = "(id) => document.querySelector(`#${id} .plot`)?.drawn"
#: A chart as it is drawn: the ends of its axes, its operating point, its curves and the ends of its bands by name.
CHART = """(id) => {
  const { figure: { marks }, frame: { x, y } } = document.querySelector(`#${id} .plot`).drawn;
  const of = (kind) => marks.filter((mark) => mark.kind === kind), [point] = of("point");
  return {
    x: [x.from, x.to], y: [y.from, y.to], point: [point.x, point.y], map: of("grid")[0]?.values,
    curves: of("curve").map(({ name, x, y }) => [name, x, y]),
    bands: of("band").filter(({ solid }) => !solid).map(({ name, x, low, high }) => [name, x, low, high]),
  };
}"""
#: Where the operating point is on the screen.
POINT = """(id) => {
  const plot = document.querySelector(`#${id} .plot`), { left, top } = plot.getBoundingClientRect();
  const { figure, frame } = plot.drawn, { x, y } = figure.marks.find(({ kind }) => kind === "point");
  return [left + frame.x.pixel(x), top + frame.y.pixel(y)];
}"""
#: The torque over the speed is that of this load, and its operating point is drawn at the torque that the legend says.
AT_LOAD = """(load) => {
  const place = document.querySelector("#torque-chart"), plot = place.querySelector(".plot");
  const point = plot?.drawn?.figure.marks.find(({ kind }) => kind === "point");
  const torque = Number(place.querySelector("ul.legend data")?.value);
  return plot?.ariaLabel.includes(load) && point && Math.abs(point.y - torque) < 1e-9;
}"""


def chart(here, name):
    """A chart that is scrolled to."""
    here.see(f"#{name}")
    here.page.locator(f"#{name}").scroll_into_view_if_needed()
    here.page.wait_for_function(DRAWN, arg=name)
    return here.page.evaluate(CHART, name)
