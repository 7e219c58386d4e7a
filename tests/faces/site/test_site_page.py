"""The static page: its numbers are those of the model, its case is that of the program, everybody can use it."""

import json
import math
import re
import tomllib
from importlib import resources
from pathlib import Path
from random import Random
from urllib.parse import parse_qs, urlencode

import axe_playwright_python
import pytest

from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.engine.uncertainty import bands
from ballscrew.faces.site import site
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.band.compute import of_makers

MODELS = ("reference",)
NUTS = ("row", "double", "double+elastic")
#: As that of the fixture: the folder below the root of the server.
PATH = "tools/screws/"
DOUBLE = "#start=rexroth-32x10x3.969-5-double&kind=double"
ELASTIC = "#start=hiwin-40-8k5&kind=double%2Belastic"
AXE = (Path(axe_playwright_python.__file__).parent / "axe.min.js").read_text(encoding="utf-8")
OPEN_ALL = "for (const one of document.querySelectorAll('details')) one.open = true"
PAGE = resources.files("ballscrew.faces.site").joinpath("page")
#: Relative: a module is that of the same recording.
TOLERANCE = 1e-12


def torque_of(tables):
    """The friction torque of a case, computed by the model itself."""
    case = case_file.build(tables, rows=catalogue())
    operation = case.operation
    return float(
        case.model(
            case.screw, case.lubricant, axial_load=operation.axial_load, screw_speed=operation.screw_speed
        ).screw_torque
    )


#: Each start with numbers moved as by hand: load and speed of opposite signs, geometry, oil, surfaces and laws.
CASES = {
    "the paper's screw": ("", {}),
    "the paper's screw, all moved": (
        "",
        {
            "operation.axial_load": -2500,
            "operation.screw_speed": 1250,
            "lubricant.viscosity": 61,
            "screw.ball_diameter": 3.4,
            "screw.contact_angle": 41.5,
            "screw.loaded_balls": 61,
            "screw.ball_roughness": 0.1,
            "model.friction.boundary_friction_coefficient": 0.15,
            "model.ball_force.share_of_load": 0.01,
        },
    ),
    "a double nut": (DOUBLE, {}),
    "a double nut, cold": (
        DOUBLE,
        {"lubricant.temperature": 11, "nut.preload": 1800, "losses.seals.seal_torque": 0.3, "screw.lead": 8},
    ),
    "an elastic nut": (ELASTIC, {}),
    "an elastic nut, loaded more": (ELASTIC, {"operation.axial_load": 2000, "nut.preload": 3000}),
}


@pytest.mark.parametrize("name", CASES)
def test_the_torque_is_that_of_the_model_and_of_its_case(visit, name):
    fragment, moves = CASES[name]
    here = visit().open(fragment)
    found = here.state()
    for path, value in moves.items():
        before, found = found, here.slide(path, value)
        assert found["inputs"] != before["inputs"], path  # at once, before anything is drawn
    assert found["outputs"]["screw_torque"] == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0)


#: The torque in a full bath of oil at the ends of a chart, in SI.
FULL_BATH = """(id) => {
  const { marks } = document.querySelector(`#${id} .plot`).drawn.figure;
  const curve = marks.find(({ name }) => name === "in a full bath of oil");
  return [curve.x.at(-1), curve.y.at(-1)];
}"""


def test_a_full_bath_stands_beside_a_screw_that_is_starved(visit):
    """Cold, thick oil: in the headline, and as a curve over the speed, over the load and beside the band."""
    cold = "&grade=ISO+VG+220&temperature=5&axial_load=3000&screw_speed=1000"
    here = visit().open(f"#start=rexroth-40x10x6-6-double&kind=double{cold}")
    case = case_file.build(here.state()["case"], rows=catalogue())
    friction = case.model(
        case.screw, case.lubricant, axial_load=case.operation.axial_load, screw_speed=case.operation.screw_speed
    )
    assert here.page.text_content("#full-bath") == f"in a full bath of oil {float(friction.flooded_torque):.4g} N·m"
    for chart in ("over-speed", "fan", "over-load"):
        here.page.locator(f"#{chart}").scroll_into_view_if_needed()
        here.page.wait_for_selector(f"#{chart} .plot[data-drawn]")
        x, torque = here.page.evaluate(FULL_BATH, chart)
        load, speed = (x, case.operation.screw_speed) if chart == "over-load" else (3000.0, x * math.pi / 30)
        expected = case.model(case.screw, case.lubricant, axial_load=load, screw_speed=speed).flooded_torque
        assert torque == pytest.approx(float(expected), rel=1e-9), chart
    here.slide("lubricant.temperature", 80)
    here.page.locator("#over-speed").scroll_into_view_if_needed()
    here.rest()
    assert not here.page.is_visible("#full-bath")
    assert here.page.evaluate(FULL_BATH.replace("return [", "return curve && ["), "over-speed") is None


#: A slider by its path, moved by a share of its range.
MOVE = """([path, share]) => {
  const slider = document.querySelector(`input[type=range][name="${path}"]`);
  slider.value = String(Number(slider.value) + share * (slider.max - slider.min));
  slider.dispatchEvent(new Event("input", { bubbles: true }));
}"""


@pytest.mark.slow
@pytest.mark.parametrize("kind", NUTS)
def test_cases_made_at_random_are_those_of_the_program(visit, kind):
    """Any start with any oil and any sliders moved a little."""
    random = Random(kind)
    here = visit()
    for _ in range(4):
        start, grade = random.choice(sorted(catalogue())), random.choice(["", "ISO VG 46", "ISO VG 220"])
        here.page.goto("about:blank")
        here.open("#" + urlencode({"start": start, "kind": kind, "grade": grade}))
        names = here.page.evaluate("[...document.querySelectorAll('input[type=range]')].map((one) => one.name)")
        for name in random.sample(names, 5):
            here.page.evaluate(MOVE, [name, random.uniform(-0.1, 0.1)])
        found = here.state()
        torque = found["outputs"]["screw_torque"]
        assert torque == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0), found["case"]


def band_of(here):
    """The band that the page has found, when all of it is there."""
    here.page.wait_for_selector("html[data-band=fan]")
    return here.page.evaluate("globalThis.ballscrewBand")


def ends_of(tables, count):
    """The ends of the torque of a case with so many samples, computed by the program without other laws."""
    case = case_file.build(tables, rows=catalogue())
    operation = case.operation
    found = bands.band(
        case.model, case.screw, case.lubricant, samples=count, alternatives=of_makers(case),
        distributions={name: one.distribution for name, one in uncertain_inputs.all_of(case).items()},
        axial_load=float(operation.axial_load), screw_speed=float(operation.screw_speed),
    )  # fmt: skip
    return found["screw_torque"].both


@pytest.mark.slow
@pytest.mark.parametrize("fragment", ["", DOUBLE, "#start=paper&kind=double%2Belastic"])
def test_the_band_is_that_of_the_program(visit, fragment):
    here = visit().open(fragment)
    found = band_of(here)
    ends = ends_of(here.state()["case"], found["point"]["count"])
    assert found["isBeside"]
    assert tuple(found["point"]["ends"]["screw_torque"].values()) == pytest.approx(ends, rel=TOLERANCE)
    low, high = math.floor(1e4 * ends.low) / 1e4, math.ceil(1e4 * ends.high) / 1e4
    here.page.locator("#fan").scroll_into_view_if_needed()  # it is drawn when it is seen
    here.rest()
    for place in ("#band", "#fan"):
        here.page.locator(place, has_text=f"{low:.4f} to {high:.4f}").wait_for()  # the fan when there is time
    assert "inputs alone" in here.page.locator("#band").inner_text()  # that of the program is of inputs and laws


@pytest.mark.slow
def test_a_band_of_numbers_that_were_changed_is_dropped(visit):
    here = visit().open(DOUBLE)
    band_of(here)
    for load in (900, 1200, 2500):  # the next comes while the band before is computed
        here.slide("operation.axial_load", load)
        assert here.page.locator("html").get_attribute("data-band") is None
        here.rest(200)
    found = band_of(here)
    ends = ends_of(here.state()["case"], found["point"]["count"])
    assert tuple(found["point"]["ends"]["screw_torque"].values()) == pytest.approx(ends, rel=TOLERANCE)


def test_a_slider_moves_the_numbers_at_once(visit):
    here = visit().open()
    before = here.state()["outputs"]["screw_torque"]
    after = here.slide("operation.screw_speed", 1200)
    assert after["outputs"]["screw_torque"] > before  # thicker films need more to roll through
    assert after["inputs"]["screw_speed"] == pytest.approx(1200 / 60 * 2 * 3.141592653589793, rel=1e-15)
    here.rest()
    assert float(here.page.locator("#torque").inner_text()) == pytest.approx(after["outputs"]["screw_torque"], rel=5e-4)


def test_the_file_and_the_link_hold_the_case(visit):
    here = visit().open(DOUBLE)
    found = here.slide("screw.lead", 9)
    here.rest()
    assert tomllib.loads(here.page.locator("#toml").inner_text()) == found["case"]
    link = here.page.locator("#open-program").get_attribute("href")
    address, _, fragment = link.partition("#")
    parameters = {name: texts[0] for name, texts in parse_qs(fragment).items()}
    assert address == "http://127.0.0.1:8017/"
    assert (parameters["A"], parameters["A.screw.lead"]) == ("rexroth-32x10x3.969-5-double", "9 mm")
    sections = json.loads(parameters["A.tables"])
    assert {name: one for name, one in sections.items() if one is not None} == {
        name: one for name, one in found["case"].items() if name != "screw"
    }


@pytest.mark.slow
def test_the_address_of_the_page_holds_the_case(visit):
    here = visit().open(DOUBLE)
    here.slide("lubricant.temperature", 63)
    here.rest()
    other = visit().open(here.page.evaluate("location.hash"))
    assert other.state() == here.state()


def test_an_oil_of_a_grade_is_chosen_and_left(visit):
    here = visit().open()
    here.page.locator("#grade").select_option("ISO VG 68")
    here.page.wait_for_selector('input[name="lubricant.temperature"]')
    warm = here.slide("lubricant.temperature", 60)
    assert warm["case"]["lubricant"] == {"grade": "ISO VG 68", "temperature": "60 degC"}
    assert warm["outputs"]["screw_torque"] == pytest.approx(torque_of(warm["case"]), rel=TOLERANCE, abs=0)
    here.page.locator("#grade").select_option("")
    here.page.wait_for_selector('input[name="lubricant.viscosity"]')
    plain = here.state()
    assert plain["inputs"]["viscosity"] == pytest.approx(warm["inputs"]["viscosity"], rel=1e-3)
    assert plain["outputs"]["screw_torque"] == pytest.approx(torque_of(plain["case"]), rel=TOLERANCE, abs=0)


@pytest.mark.slow
def test_a_start_and_a_nut_are_chosen(visit):
    here = visit().open()
    here.page.locator("#start").fill("rexroth-16x5x3-4-double")
    here.page.wait_for_selector('input[name="nut.preload"]')
    assert here.state()["case"]["screw"] == {"catalogue": "rexroth-16x5x3-4-double"}
    here.page.locator("#kind").select_option("row")
    here.page.wait_for_selector('input[name="nut.preload"]', state="detached")
    found = here.state()
    assert "nut" not in found["case"]
    assert found["outputs"]["screw_torque"] == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0)


@pytest.mark.slow
def test_a_start_is_found_by_its_size_and_the_code_of_another_maker_is_not_taken_for_it(visit):
    here = visit().open()
    here.page.locator("#start").fill("40×10")
    here.page.locator("#start").press("Enter")
    here.page.wait_for_function("() => window.ballscrew.case.screw.catalogue === 'rexroth-40x10x6-6-double'")
    here.page.locator("#start").fill("SFU2005-4")
    here.page.locator("#start").press("Enter")
    assert here.page.locator("#start-matches").inner_text().startswith("SFU2005-4 is not in the list")
    assert here.state()["case"]["screw"]["catalogue"] == "rexroth-40x10x6-6-double"
    here.page.locator("#start-matches button", has_text="rexroth-20x5x3-5-single").click()
    here.page.wait_for_function("() => window.ballscrew.case.screw.catalogue === 'rexroth-20x5x3-5-single'")


def test_what_no_case_may_have_is_refused_in_words(visit):
    here = visit().open()
    before = here.state()
    field = here.page.locator("#f-screw-ball_diameter")
    field.fill("-1")
    assert here.page.locator("#f-screw-ball_diameter-fault").inner_text() == "must be > 0"
    assert field.get_attribute("aria-invalid") == "true"
    assert here.state() == before
    load = here.page.locator("#f-operation-axial_load")
    for text, fault in (("4,000", "not understood"), ("1e99", "must be ≤ 10⁹"), ("4 kg", "not understood")):
        load.fill(text)
        assert here.page.locator("#f-operation-axial_load-fault").inner_text().startswith(fault)
        assert here.state() == before
    load.fill("3.5 kN")
    assert here.state()["inputs"]["axial_load"] == 3500
    field.fill("3.3")
    assert here.page.locator("#f-screw-ball_diameter-fault").inner_text() == ""
    assert here.state()["case"]["screw"]["ball_diameter"] == "3.3 mm"


def test_where_the_model_does_not_hold_is_said(visit):
    here = visit().open()
    assert here.page.locator("#verdict").inner_text() == "All conditions of the model hold."
    here.slide("lubricant.viscosity", 500)
    found = here.slide("operation.axial_load", 50)
    here.rest()
    assert found["outputs"]["valid"] == 0
    assert "too light for the film law" in here.page.locator("#verdict").inner_text()
    assert "too light for the film law" in here.page.locator("#over-speed .shaded").inner_text()


def test_a_slider_is_moved_by_keys(visit):
    here = visit().open()
    slider = here.page.locator('input[type=range][name="operation.axial_load"]')
    slider.focus()
    here.page.keyboard.press("ArrowRight")
    after = here.state()["inputs"]["axial_load"]
    assert after > 4000
    here.page.keyboard.press("ArrowLeft")
    assert here.state()["inputs"]["axial_load"] == 4000
    here.page.keyboard.press("Home")
    assert here.state()["inputs"]["axial_load"] == -8000  # all four quadrants are within reach


#: Where the operating point of a chart is drawn, on the screen.
POINT = """(plot) => {
  const { figure, frame } = plot.drawn;
  const { left, top } = plot.getBoundingClientRect();
  const point = figure.marks.find((mark) => mark.kind === "point");
  return [left + frame.x.pixel(point.x), top + frame.y.pixel(point.y)];
}"""


def test_the_point_is_dragged_in_the_chart(visit):
    here = visit().open()
    plot = here.page.locator("#over-speed .plot[data-drawn]")
    x, y = plot.evaluate(POINT)
    before = here.state()["inputs"]["screw_speed"]
    here.page.mouse.move(x, y)
    here.page.mouse.down()
    here.page.mouse.move(x + 100, y)
    first = here.state()["inputs"]["screw_speed"]
    here.page.mouse.move(x + 200, y)
    here.page.mouse.up()
    last = here.state()["inputs"]["screw_speed"]
    assert before < first < last
    here.rest(400)
    assert plot.evaluate(POINT)[0] == pytest.approx(x + 200, abs=5)  # the slider has steps


def test_a_chart_is_read_and_saved(visit):
    """What both pages have: numbers below the pointer, a part drawn out, CSV and SVG."""
    here = visit().open(DOUBLE)
    plot = here.page.locator("#over-speed .plot[data-drawn]")
    box = plot.bounding_box()
    here.page.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    reading = plot.locator(".reading").inner_text()
    assert "speed of the screw (rpm)" in reading
    assert "hydrodynamic rolling (N·m)" in reading
    for kind in ("CSV", "SVG"):
        with here.page.expect_download() as download:
            here.page.locator(f"#over-speed button:has-text('{kind}')").click()
        assert download.value.suggested_filename == f"ballscrew-over_speed.{kind.lower()}"


@pytest.mark.slow
def test_each_chart_has_its_numbers_and_words(visit):
    here = visit().open(DOUBLE)
    here.page.evaluate(OPEN_ALL)
    for section in here.page.locator(".answers section:has(canvas)").all():
        section.scroll_into_view_if_needed()
        here.rest(600)
        picture = section.locator("[role=img]")
        assert picture.get_attribute("aria-label"), section.get_attribute("id")
        if section.get_attribute("id") == "ball":  # no chart: its few numbers are in its words
            assert "45.77°" in picture.get_attribute("aria-label")
            continue
        section.locator("details").evaluate("(one) => { one.open = true }")
        section.locator("tbody tr").first.wait_for()
        assert section.locator("tbody tr").count() > 10, section.get_attribute("id")


@pytest.mark.slow
def test_checks_are_said(visit):
    here = visit().open(DOUBLE)
    assert "4 of 8 judged, and these hold" in here.page.locator("#whole").inner_text()
    moves = {"operation.axial_load": 6400, "screw.ball_diameter": 2, "screw.loaded_balls": 60}
    for path, value in {**moves, "screw.screw_conformity": 0.65}.items():
        found = here.slide(path, value)  # small balls, few of them, in a wide groove
    assert [one["id"] for one in found["checks"] if one["holds"] is False] == ["check.contact_pressure"]
    here.rest()
    assert here.page.locator("#checks .fails").count() > 0


def test_paper_has_the_charts_that_nobody_has_scrolled_to(visit):
    here = visit(scheme="dark").open(DOUBLE)
    here.page.evaluate("dispatchEvent(new Event('beforeprint'))")
    empty = """[...document.querySelectorAll(".answers section canvas:first-child")].filter((one) =>
      one.getContext("2d").getImageData(0, 0, one.width, one.height).data.every((value) => value === 0))"""
    assert here.page.evaluate(f"{empty}.map((one) => one.closest('section').id)") == []
    assert here.page.locator("html").get_attribute("data-scheme") == "light"
    here.page.evaluate("dispatchEvent(new Event('afterprint'))")
    assert here.page.locator("html").get_attribute("data-scheme") == "dark"


def violations(here):
    """What axe finds: an evaluation by the debugger is not stopped by the policy of the page."""
    here.page.evaluate(f"{AXE}; 0")
    found = here.page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [(one["id"], one["impact"], [node["target"] for node in one["nodes"]][:3]) for one in found]


@pytest.mark.slow
@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), (360, "dark")])
def test_axe_finds_nothing(visit, width, scheme):
    here = visit(width=width, scheme=scheme).open(DOUBLE)
    here.page.evaluate(OPEN_ALL)
    here.rest(600)
    assert violations(here) == []
    assert here.page.evaluate("document.documentElement.scrollWidth") <= width


def test_the_scheme_is_chosen_and_kept(visit):
    here = visit().open()
    here.page.locator("#scheme").click()
    assert here.page.locator("html").get_attribute("data-scheme") == "dark"
    here.open("?again")
    assert here.page.locator("html").get_attribute("data-scheme") == "dark"


def test_there_is_no_formula_in_the_page():
    allowed = {"max", "min", "PI", "abs", "floor", "ceil", "round", "log10"}
    for one in PAGE.iterdir():
        if one.name.endswith(".js"):
            text = one.read_text(encoding="utf-8")
            assert set(re.findall(r"\bMath\.(\w+)", text)) <= allowed, one.name
            if "log10" in text:
                assert one.name == "charts.js"  # of axes that are logarithmic


def test_a_link_to_what_the_page_has_not_is_said(visit):
    here = visit().open("#start=paper&kind=double%2Bspacers&axial_load=3000&lead=-1")
    here.page.wait_for_selector("#trouble:not(:empty)")
    assert here.page.locator("#trouble").inner_text().endswith("without it: double+spacers, lead=-1.")
    assert here.state()["inputs"]["axial_load"] == 3000


@pytest.mark.slow
@pytest.mark.parametrize("single", [False, True], ids=["folder", "one file"])
def test_it_opens_from_files(visit, folder, tmp_path, single):
    if single:
        site.write(tmp_path / "page.html", site.site(MODELS, ("row",), single=True))
    page = tmp_path / "page.html" if single else folder / PATH / "index.html"
    here = visit(at=page.as_uri()).open()
    found = here.slide("operation.axial_load", 3000)
    assert found["outputs"]["screw_torque"] == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0)
    band = band_of(here)
    assert not band["isBeside"]  # no worker starts from a file
    ends = ends_of(found["case"], band["point"]["count"])
    assert tuple(band["point"]["ends"]["screw_torque"].values()) == pytest.approx(ends, rel=TOLERANCE)


def test_it_opens_without_a_network_after_the_first_visit(visit):
    here = visit().open()
    here.page.evaluate("navigator.serviceWorker.ready.then(() => 0)")
    here.page.context.set_offline(True)
    here.open("?again")
    found = here.slide("operation.axial_load", 3000)
    assert found["outputs"]["screw_torque"] == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0)
    digest = here.page.evaluate("globalThis.ballscrewSite.digest")
    assert here.page.locator("#version").inner_text().endswith(digest)
    kept = here.page.evaluate("caches.keys()")
    assert [name.rpartition(" ")[2] for name in kept] == [digest]
