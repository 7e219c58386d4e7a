"""Pictures of the torque: where the power goes, the Stribeck curve, cold and hot, and the band as a fan."""

import csv
import io

import pytest

from .drawn_charts import CHART

pytestmark = pytest.mark.slow

#: Bars at the ends of the flows of power, by their names: their heights.
BARS = """() => Object.fromEntries([...document.querySelectorAll("#power rect[data-flow]")].map(
  (one) => [one.dataset.flow, Number(one.getAttribute("height"))]))"""
#: How high a bar of all of the power is.
WHOLE = 150
HOT = "#A=paper&A.lubricant.grade=ISO+VG+100&A.lubricant.viscosity=&A.lubricant.temperature=40+degC&band=0"


def powers(here):
    """The numbers of the table, by the direction and the name."""
    return here.page.evaluate(
        """() => Object.fromEntries([...document.querySelectorAll("#power data")].map(
          (one) => [one.dataset.name.replace("power-", ""), Number(one.value)]))"""
    )


def rows_of(here, name):
    """The headings and the numbers of a chart, as its file has them."""
    here.see(f"#{name}").page.locator(f"#{name}").scroll_into_view_if_needed()
    here.page.wait_for_selector(f"#{name} .plot[data-drawn]")
    rows = list(csv.reader(io.StringIO(here.download(f"#{name} button:text-is('CSV')").decode("utf-8-sig"))))
    return rows[0], rows[1:]


def paper_of(server, **operation):
    case = server.get("vocabulary").json()["starts"]["paper"]["case"]
    case["operation"].update(operation)
    return case


@pytest.mark.parametrize(
    ("load", "speed", "ends"),
    [
        (2000, 300, {"in-shaft", "out-useful"}),
        (-2000, -300, {"in-shaft", "out-useful"}),
        # the load drives, and something of it is left
        (-2000, 300, {"in-load", "out-brake"}),
        # the seals take more than the load gives
        (-20, 300, {"in-load", "in-shaft"}),
        (0, 300, {"in-shaft"}),
    ],
)
def test_power_in_is_power_out_and_the_numbers_are_those_of_the_answer(load, speed, ends, visit, server):
    loss = "A.losses.seals.seal_torque=20+N+mm"
    here = visit().open(f"#A=paper&A.operation.axial_load={load}+N&A.operation.screw_speed={speed}+rpm&{loss}&band=0")
    case = paper_of(server, axial_load=f"{load} N", screw_speed=f"{speed} rpm")
    case["losses"] = {"seals": {"seal_torque": "20 N mm"}}
    found = server.post("run", {"case": case}).json()
    results, turns = found["results"], found["inputs"]["operation"]["screw_speed"]
    shown = powers(here)
    losses = {f"out-{name}": torque * abs(turns) for name, torque in results["contributions"].items() if torque}
    assert {name for name in shown if name.split("-", 1)[1] in ("shaft", "load", "useful", "brake")} == ends
    assert {name: power for name, power in shown.items() if name not in ends} == pytest.approx(losses)
    expected = {
        "in-shaft": results["drive_torque"] * turns,
        "out-brake": -results["drive_torque"] * turns,
        "out-useful": results["ideal_torque"] * turns,
        "in-load": -results["ideal_torque"] * turns,
    }
    assert {name: shown[name] for name in ends} == pytest.approx({name: expected[name] for name in ends})
    given, taken = (sum(power for name, power in shown.items() if name.startswith(side)) for side in ("in-", "out-"))
    assert given == pytest.approx(taken, rel=1e-12)
    if "out-useful" in ends:
        assert shown["out-useful"] / given == pytest.approx(results["efficiency"])
    if "out-brake" in ends:
        assert shown["out-brake"] / given == pytest.approx(results["back_driving_efficiency"])
    bars = here.page.evaluate(BARS)
    assert bars == pytest.approx({name: WHOLE * power / given for name, power in shown.items()})


def test_no_power_flows_at_rest(visit):
    here = visit().open("#A=paper&A.operation.screw_speed=0+rpm&band=0")
    assert here.text("#power") == "At rest no power flows."


def test_power_on_a_phone(visit):
    here = visit(width=390, height=844)
    here.open().see("#power")
    assert here.page.evaluate("() => document.documentElement.scrollWidth <= innerWidth")
    sizes = here.page.evaluate(
        """() => [...document.querySelectorAll("#power .amount")].map((one) => one.getBoundingClientRect())
          .map(({ left, right, height }) => [left, right, height])"""
    )
    assert sizes
    assert all(left >= 0 and right <= 390 and height > 9 for left, right, height in sizes)


def test_the_stribeck_curve_has_the_numbers_of_the_server(visit, server):
    here = visit().open()
    headings, rows = rows_of(here, "stribeck-chart")
    assert headings[:2] == ["least film parameter λ", "friction torque (N·m)"]
    films, torques, speeds = ([float(row[place]) for row in rows] for place in range(3))
    assert films == sorted(films)
    outputs = ["screw_torque", "screw_film_parameter", "nut_film_parameter"]
    vary = {"screw_speed": f"{', '.join(map(repr, speeds))} rpm"}
    found = server.post("sweep", {"case": paper_of(server), "vary": vary, "outputs": outputs}).json()["outputs"]
    torque, *both = (found[name]["values"] for name in outputs)
    assert films == pytest.approx(list(map(min, *both)), rel=1e-6)
    assert torques == pytest.approx(torque, rel=1e-6)
    answer = server.post("run", {"case": paper_of(server)}).json()["results"]
    (x, y), zones = here.page.evaluate(
        """() => {
          const { marks } = document.querySelector("#stribeck-chart .plot").drawn.figure;
          const { x, y } = marks.find(({ kind }) => kind === "point");
          return [[x, y], marks.filter(({ kind }) => kind === "zone").map(({ words, from }) => [words, from])];
        }"""
    )
    assert x == pytest.approx(min(answer[side]["film_parameter"] for side in ("screw", "nut")))
    assert y == pytest.approx(answer["screw_torque"])
    # a regime begins where its condition does, at 1 and 3
    begins = {"boundary": 0, "mixed": 1, "full film": 3}
    assert zones
    for name, place in zones:
        assert place == pytest.approx(max(begins[name], min([*films, x]) / 1.15))


def check_hot_and_cold(here, server, **operation):
    here.see("#temperatures").page.locator(
        "#temperatures"
    ).scroll_into_view_if_needed()  # the curves are computed once they are seen
    headings, rows = rows_of(here, "hot-chart")
    temperatures = [0, 40, 80]
    assert headings[1:4] == [f"{one}\u00a0°C (N·m)" for one in temperatures]
    speeds = [float(row[0]) for row in rows]
    case = paper_of(server, **operation)
    case["lubricant"] = {**case["lubricant"], "grade": "ISO VG 100", "temperature": "40 degC"}
    del case["lubricant"]["viscosity"]
    for place, one in enumerate(temperatures, start=1):
        case["lubricant"]["temperature"] = f"{one} degC"
        body = {"case": case, "vary": {"screw_speed": f"{', '.join(map(repr, speeds))} rpm"}}
        found = server.post("sweep", {**body, "outputs": ["screw_torque"]}).json()["outputs"]
        theirs = found["screw_torque"]["values"]
        assert [float(row[place]) for row in rows] == pytest.approx(theirs, rel=1e-6)
        assert [row[place + 3] == "yes" for row in rows] == found["valid"]["values"]
    table = here.page.locator("#temperatures tbody tr td:nth-child(2) data").evaluate_all(
        "all => all.map((one) => Number(one.value))"
    )
    x, y = here.page.evaluate(CHART, "hot-chart")["point"]
    # the diamond stands on the curve of the case, whose number the table has, too
    assert y == pytest.approx(table[1])
    assert min(speeds) < x < max(speeds)


def over_speed(page):
    """The sweeps over temperature and speed that the page asks for, as they come; the card of any input has others."""
    asked = []

    def note(request):
        if request.url.endswith("/sweep") and "screw_speed" in request.post_data_json["vary"]:
            asked.append(request)

    page.on("request", note)
    return asked


def test_cold_and_hot_curves_are_those_of_the_server(visit, server):
    here = visit()
    asked = over_speed(here.page)
    here.open(HOT)
    check_hot_and_cold(here, server)
    assert len(asked) == 1


@pytest.mark.compiles
def test_cold_and_hot_curves_of_the_module_are_those_of_the_server(visit, server):
    here = visit()
    asked = over_speed(here.page)
    here.open(HOT)
    here.page.locator(here.id("operation.axial_load")).focus()
    here.page.wait_for_selector("html[data-engine=ready]", state="attached", timeout=300_000)
    here.see("#temperatures").page.locator("#temperatures").scroll_into_view_if_needed()
    here.page.wait_for_selector("#hot-chart .plot[data-drawn]")
    before = len(asked)
    here.type("operation.axial_load", "3000")
    check_hot_and_cold(here, server, axial_load="3000 N")
    assert len(asked) == before
