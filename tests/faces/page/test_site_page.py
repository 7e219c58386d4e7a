"""The page without a server: its numbers are those of the program, its case is the program's, and it opens anywhere."""

import json
import math
import re
import tomllib
from importlib import resources
from pathlib import Path
from random import Random
from urllib.parse import urlencode

import axe_playwright_python
import pytest
from playwright.sync_api import expect

from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.engine.uncertainty import bands
from ballscrew.faces.cli.main import COMMANDS
from ballscrew.faces.page import site
from ballscrew.faces.web import documents
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from ballscrew.questions.band.compute import of_makers
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run.compute import run

NUTS = ("row", "double", "double+elastic")
#: As that of the fixture: the folder below the root of the server.
PATH = "tools/screws/"
AXE = (Path(axe_playwright_python.__file__).parent / "axe.min.js").read_text(encoding="utf-8")
#: Relative: a module is that of the same recording.
TOLERANCE = 1e-12


def fragment_of(start="paper", view="torque", **sections):
    """The address of a design with sections of its own."""
    return "#" + urlencode({"A": start, "A.tables": json.dumps(sections), "view": view})


def nut_of(kind):
    """The sections of a kind of nut."""
    nut = kind.partition("+")[0]
    return {
        "nut": None if nut == "row" else {"type": nut, "preload": "1500 N"},
        "bodies": {} if kind.endswith("+elastic") else None,
        "losses": None if nut == "row" else {"seals": {"seal_torque": "0.1 N m"}},
    }


ROW = "rexroth-32x10x3.969-5-double"
RIGID = fragment_of(ROW, **nut_of("double"))
ELASTIC = fragment_of(ROW, **nut_of("double+elastic"))


def case_of(tables):
    return case_file.build(tables, rows=catalogue())


def torque_of(tables):
    """The friction torque of a case, computed by the model itself."""
    case = case_of(tables)
    point = {"axial_load": case.operation.axial_load, "screw_speed": case.operation.screw_speed}
    return float(case.model(case.screw, case.lubricant, **point).screw_torque)


def assert_is_of_the_program(found):
    assert found["outputs"]["screw_torque"] == pytest.approx(torque_of(found["case"]), rel=TOLERANCE, abs=0)


#: Each start with numbers moved as by hand: load and speed of opposite signs, geometry, oil, surfaces and laws.
CASES = {
    "the paper's screw, all moved": (
        "",
        {
            "operation.axial_load": -2500, "operation.screw_speed": 1250, "lubricant.viscosity": 61,
            "screw.ball_diameter": 3.4, "screw.contact_angle": 41.5, "screw.loaded_balls": 61,
            "screw.ball_roughness": 0.1, "model.friction.boundary_friction_coefficient": 0.15,
            "model.ball_force.share_of_load": 0.01,
        },
    ),
    "a double nut, cold": (RIGID, {"lubricant.temperature": 11, "nut.preload": 1800, "screw.lead": 8}),
    "an elastic nut, loaded more": (ELASTIC, {"operation.axial_load": 2000, "nut.preload": 2000}),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_the_torque_is_that_of_the_model_and_of_its_case(visit, name):
    fragment, moves = CASES[name]
    here = visit().open(fragment)
    assert_is_of_the_program(here.state())
    for path, value in moves.items():
        before, found = here.state(), here.slide(path, value)
        assert found["outputs"] != before["outputs"], path
        assert_is_of_the_program(found)


#: Of a run what the page computes otherwise: by a search, or as a number near zero.
LOOSE = {"lift_off_load", "residual"}


#: A usual point; at rest; a preload that is lost; a speed of the nut, and nothing on it: two of them for each nut.
POINTS = [
    ("row", ("5 kN", "900 rpm")),
    ("row", ("0 N", "-12 m/min")),
    ("double", ("4 kN", "0 rpm")),
    ("double", ("-35 kN", "20 rpm")),
    ("double+elastic", ("5 kN", "900 rpm")),
    ("double+elastic", ("-35 kN", "20 rpm")),
]


@pytest.mark.parametrize(("kind", "point"), POINTS, ids=str)
def test_numbers_verdicts_and_checks_are_those_of_the_program(visit, kind, point):
    operation = dict(zip(("axial_load", "screw_speed"), point, strict=True))
    here = visit().open(fragment_of(ROW, **nut_of(kind), operation=operation))
    found = here.state()
    case = case_of(found["case"])
    document = documents.run(run(case))
    own = found["outputs"]
    for name, value in own.items():
        wanted = document["results"].get(name, document.get("loads", {}).get(name))
        if isinstance(value, float) and wanted is not None and name not in LOOSE:
            assert value == pytest.approx(wanted, rel=1e-9), name
    assert {"screw_torque", "drive_torque", "efficiency", "holding_torque"} <= own.keys()
    for part in ("contributions", "validity"):
        assert own[part] == pytest.approx(document["results"][part], rel=1e-9), part
    for name, quadrant in own["quadrants"].items():
        program = document["results"]["quadrants"][name]
        assert {**quadrant, "efficiency": quadrant["efficiency"] or math.nan} == pytest.approx(
            {key: program[key] for key in quadrant}, rel=1e-9, nan_ok=True
        )
    said = here.page.locator("#verdicts, #rules").all_text_contents()
    parts = [part for one in document["verdicts"] for part in one["text"].split("; ")]
    assert [part for part in parts if part not in "".join(said)] == []
    here.page.locator("[data-view=checks]").click()
    made = checked("page", case).checks
    titles = here.page.eval_on_selector_all("#checks tbody tr span[title]", "all => all.map((one) => one.title)")
    assert titles == [check.text for check in made]
    values = here.page.eval_on_selector_all(
        "#checks tbody data[data-name]", "all => all.map((one) => [one.dataset.name, one.value])"
    )
    for (name, value), check in zip(values, made, strict=True):
        assert name == check.name
        wanted = math.nan if check.value is None else check.value
        assert float(value or math.nan) == pytest.approx(wanted, rel=1e-9, nan_ok=True), name


def test_the_loads_of_the_balls_are_those_of_the_program(visit):
    here = visit().open(ELASTIC.replace("view=torque", "view=nut"))
    loads = run(case_of(here.state()["case"])).friction.loads
    here.page.locator("#nut-unrolled").scroll_into_view_if_needed()
    here.page.wait_for_selector("#nut-extremes td")
    shown = here.page.locator("#nut-extremes tbody tr").first.inner_text().split("\t")
    first = max(loads.forward_load[: len(loads.forward_load) // 2].max(), 0.0)
    assert f"{float(first):.4g}\u00a0N" in shown


@pytest.mark.slow
@pytest.mark.parametrize("kind", NUTS)
def test_cases_made_at_random_are_those_of_the_program(visit, kind):
    """Any row with any oil and any sliders moved a little."""
    random = Random(kind)
    here = visit()
    oils = [{"viscosity": "61 mPa s"}, {"grade": "ISO VG 46", "temperature": "22 degC"}]
    starts = ["paper", *(row.name for row in printed_rows())]
    for _ in range(11):
        here.page.goto("about:blank")
        here.open(fragment_of(random.choice(starts), **nut_of(kind), lubricant=random.choice(oils)))
        here.page.evaluate("for (const one of document.querySelectorAll('form details')) one.open = true")
        sliders = here.page.eval_on_selector_all(
            "input[type=range]:not([hidden])",
            "all => all.map(({ name, min, max, value }) => [name, Number(min), Number(max), Number(value)])",
        )
        for name, low, high, value in random.sample(sliders, 5):
            moved = here.slide(name, value + random.uniform(-0.1, 0.1) * (high - low))
            if here.page.locator("#results.stale").count():  # beyond a bound that the slider does not know
                here.page.locator("#undo").click()
                here.rest()
                continue
            assert_is_of_the_program(moved)


@pytest.mark.parametrize("start", [RIGID, ELASTIC])
def test_the_nut_begins_with_its_most_loaded_ball(visit, start):
    here = visit().open(start)
    here.page.locator("[data-view=nut]").click()
    results = documents.run(run(case_file.build(here.state()["case"])))["results"]
    for name in ("maximum_pressure", "largest_contact_load", "minimum_film_parameter"):
        shown = here.page.locator(f"#ball-numbers [data-name={name}]").get_attribute("value")
        assert float(shown) == pytest.approx(results[name], rel=1e-9)
    assert not here.page.locator("#numbers").is_visible()  # those of the torque are its own view's


FULL_BATH = """() => {
  const { marks } = document.querySelector("#torque-chart .plot").drawn.figure;
  const curve = marks.find(({ name }) => name === "in a full bath of oil");
  return curve && [curve.x.at(-1), curve.y.at(-1)];
}"""


def test_a_full_bath_stands_beside_a_screw_that_is_starved(visit):
    """Cold, thick oil."""
    cold = {"grade": "ISO VG 220", "temperature": "5 degC"}
    at = {"axial_load": "3000 N", "screw_speed": "1000 rpm"}
    here = visit().open(fragment_of("rexroth-40x10x6-6-double", lubricant=cold, operation=at))
    case = case_of(here.state()["case"])
    flooded = case.model(case.screw, case.lubricant, axial_load=3000.0, screw_speed=1000 * math.pi / 30).flooded_torque
    assert f"in a full bath the friction torque is {float(flooded):.4g}" in here.page.text_content("#summary")
    speed, torque = here.page.evaluate(FULL_BATH)
    expected = case.model(case.screw, case.lubricant, axial_load=3000.0, screw_speed=speed * math.pi / 30)
    assert torque == pytest.approx(float(expected.flooded_torque), rel=1e-5)  # axes have six digits
    here.slide("lubricant.temperature", 80)
    here.page.wait_for_function(f"!({FULL_BATH})()")


def ends_of(tables, count):
    """The ends of the torque of a case with so many samples, computed by the program without other laws."""
    case = case_of(tables)
    found = bands.band(
        case.model,
        case.screw,
        case.lubricant,
        samples=count,
        alternatives=of_makers(case),
        distributions={name: one.distribution for name, one in uncertain_inputs.all_of(case).items()},
        axial_load=float(case.operation.axial_load),
        screw_speed=float(case.operation.screw_speed),
    )
    return found["screw_torque"].both


def assert_band_is_of_the_program(here):
    words = here.page.locator("#band-words details p.small").first
    words.wait_for(state="attached")
    count = int(words.text_content().split()[0])
    ends = ends_of(here.state()["case"], count)
    low, high = here.page.locator("#numbers .interval").first.inner_text().split("\u00a0")[0].split(" to ")
    assert (float(low), float(high)) == pytest.approx(tuple(ends), rel=5e-4)  # as they are shown
    assert float(low) <= ends.low <= ends.high <= float(high)  # rounded outwards


@pytest.mark.slow
@pytest.mark.parametrize("kind", NUTS)
def test_the_band_is_that_of_the_program(visit, kind):
    here = visit().open(fragment_of(**nut_of(kind)))
    assert_band_is_of_the_program(here)
    assert "inputs alone" in here.page.text_content("#summary")  # that of the program is of inputs and laws
    marks = "document.querySelector('#torque-chart .plot').drawn.figure.marks"
    here.page.wait_for_function(f"() => {marks}.some(({{ kind, solid }}) => kind === 'band' && !solid)")


@pytest.mark.slow
def test_a_band_of_numbers_that_were_changed_is_dropped(visit):
    here = visit().open(RIGID)
    for load in (900, 1200, 2500):  # the next comes while the band before is computed
        here.slide("operation.axial_load", load)
    assert_band_is_of_the_program(here)


def test_the_file_and_the_link_to_the_program_hold_the_case(visit):
    here = visit().open(RIGID)
    found = here.slide("screw.lead", 9)
    page = here.page
    page.locator("[data-view=handover]").click()
    with page.expect_download() as download:
        page.locator("#downloads button", has_text="TOML").click()
    assert tomllib.loads(Path(download.value.path()).read_text()) == found["case"]
    page.locator("[data-view=duty]").click()
    expect(page.locator("#duty")).to_contain_text("ballscrew duty case.toml")
    link = page.locator("#duty a").get_attribute("href")
    assert link == f"http://127.0.0.1:8017/{page.evaluate('location.hash')}"
    other = visit().open(page.evaluate("location.hash"))
    assert other.state() == here.state()


def test_a_screw_is_found_by_its_size_and_those_of_the_program_are_said(visit):
    here = visit().open()
    search = here.page.locator("#search")
    search.fill("40×10 rexroth")
    here.page.locator("[data-row='rexroth-40x10x6-6-double']").click()
    here.page.wait_for_function("() => window.ballscrew.case.screw.catalogue === 'rexroth-40x10x6-6-double'")
    search.fill("thk bnf4010")
    expect(here.page.locator("#screw-search .found")).to_contain_text("ballscrew check thk")


def test_what_the_page_does_not_compute_is_said_beside_its_field(visit):
    here = visit().open(RIGID)
    for path, text, words in (
        ("operation.axial_load", "4 kg", "is no number of this field"),
        ("screw.ball_diameter", "-1 mm", "is no number of this field"),
        ("nut.axial_play", "5 um", "is not computed by a page without a server"),
        ("nut.preload", "150 %", "is no number of this field"),
        ("operation.screw_speed", "", "Give a value"),
    ):
        before = here.state()
        here.type(path, text)
        expect(here.page.locator(f"#f-{path.replace('.', '-')}-fault"), path).to_contain_text(words)
        assert here.state()["outputs"] == before["outputs"]
        here.page.locator("#undo").click()
        here.rest()
    here.type("operation.axial_load", "3.5 kN")
    assert here.state()["inputs"]["operation"]["axial_load"] == 3500


def test_a_row_that_the_program_computes_is_said_and_the_page_goes_on(visit):
    """Defect: nothing was shown, for good."""
    here = visit().open("#A=thk-bnfn4010-5")
    expect(here.page.locator("#notice")).to_contain_text("thk-bnfn4010-5")
    assert_is_of_the_program(here.state())


def test_an_example_of_an_axis_has_the_sizes_of_its_row(visit):
    """Defect: a change of its screw was refused, for its balls."""
    here = visit().open("#A=vertical-axis")
    for path, value in (("screw.lead", 18), ("screw.screw_roughness", 0.2)):
        assert_is_of_the_program(here.slide(path, value))


def test_commands_are_those_of_the_program():
    script = (resources.files("ballscrew.faces.page") / "needs_program.js").read_text(encoding="utf-8")
    commands = set(re.findall(r"ballscrew ([a-z-]+)", script.partition("const COMMANDS")[2].partition("};")[0]))
    assert {"duty", "hand-over"} <= commands <= {*COMMANDS, "catalogue", "serve"}


def test_where_the_model_does_not_hold_is_said(visit):
    here = visit().open()
    here.slide("lubricant.viscosity", 500)
    found = here.slide("operation.axial_load", 50)
    assert found["outputs"]["valid"] is False
    expect(here.page.locator("#verdicts")).to_contain_text("Outside the model's validity: elastic regime")


def test_a_link_to_what_the_page_has_not_is_said(visit):
    here = visit()
    here.page.goto(f"{here.address}#A=thk-nowhere&A.screw.lead=6+mm")
    here.page.wait_for_selector("#notice:not([hidden])")
    expect(here.page.locator("#notice")).to_contain_text("thk-nowhere")


def violations(here):
    """What axe finds: an evaluation by the debugger is not stopped by the policy of the page."""
    here.page.evaluate(f"{AXE}; 0")
    found = here.page.evaluate("axe.run(document, {resultTypes: ['violations']})")["violations"]
    return [(one["id"], one["impact"], [node["target"] for node in one["nodes"]][:3]) for one in found]


@pytest.mark.slow
@pytest.mark.parametrize(("width", "scheme"), [(1440, "light"), (360, "dark")])
def test_axe_finds_nothing(visit, width, scheme):
    here = visit(width=width, scheme=scheme).open(RIGID)
    for view in ("torque", "nut", "checks", "duty", "measure"):
        here.page.locator(f"[data-view={view}]").click()
        here.page.evaluate("for (const one of document.querySelectorAll('details')) one.open = true")
        here.rest()
        assert violations(here) == [], view
        assert here.page.evaluate("document.documentElement.scrollWidth") <= width, view


def test_the_scheme_is_chosen_and_kept(visit):
    here = visit().open()
    here.page.locator("#scheme").click()
    assert here.page.locator("html").get_attribute("data-scheme") == "dark"
    here.open("?again")
    assert here.page.locator("html").get_attribute("data-scheme") == "dark"


@pytest.mark.slow
@pytest.mark.parametrize("single", [False, True], ids=["folder", "one file"])
def test_it_opens_from_files(visit, folder, tmp_path, single):
    if single:
        site.write(tmp_path / "page.html", site.site(("reference",), ("row",), single=True))
    page = tmp_path / "page.html" if single else folder / PATH / "index.html"
    here = visit(at=page.as_uri()).open()
    assert_is_of_the_program(here.slide("operation.axial_load", 3000))
    assert_band_is_of_the_program(here)  # without a worker: none starts from a file


def test_it_opens_without_a_network_after_the_first_visit(visit):
    here = visit().open()
    here.page.evaluate("navigator.serviceWorker.ready.then(() => 0)")
    here.page.context.set_offline(True)
    here.open("?again")
    assert_is_of_the_program(here.slide("operation.axial_load", 3000))
    digest = here.page.evaluate("globalThis.ballscrewSite.digest")
    kept = here.page.evaluate("caches.keys()")
    assert [name.rpartition(" ")[2] for name in kept] == [digest]
