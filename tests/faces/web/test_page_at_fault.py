"""What is wrong, late or out of date does not pass for an answer on the page."""

import statistics

import pytest

from .shown_sheets import numbers_of

pytestmark = pytest.mark.slow

DOUBLE = "rexroth-40x10x6-6-double"


def test_a_fault_stands_beside_its_field(visit):
    here = visit(expected=("status of 422",)).open().type("operation.axial_load", "4000 furlong")
    field = here.page.locator("[data-path='operation.axial_load']")
    assert "4000 furlong" in field.locator(".fault").inner_text()
    assert "use a unit such as N, kN or lbf" in field.locator(".fault").inner_text()
    assert field.locator("input").get_attribute("aria-invalid") == "true"
    assert "f-operation-axial_load-fault" in field.locator("input").get_attribute("aria-describedby")
    assert "furlong" not in here.text("#faults")  # each fault once, beside its field
    assert "axial load (Operating point)" in here.text("#faults")
    assert "of the previous input" in here.text("#faults")
    struck = "getComputedStyle(document.querySelector('#numbers data')).textDecorationLine"
    faint = "Number(getComputedStyle(document.querySelector('#torque-chart .plot')).opacity)"
    assert here.page.evaluate(struck) == "line-through"
    assert here.page.evaluate(faint) < 0.5
    assert "not computed" in here.page.title()
    here.type("operation.axial_load", "4000")
    assert field.locator(".fault").inner_text() == ""
    assert field.locator("input").get_attribute("aria-invalid") is None
    assert here.page.evaluate(struck) == "none"
    assert here.page.evaluate(faint) == 1
    assert "N·m" in here.page.title()


def test_a_fault_opens_its_section(visit):
    here = visit(expected=("status of 422",)).open("#A=paper&A.nut.preload=-5+kN&A.nut.type=double&band=0")
    fault = here.page.locator("[data-path='nut.preload'] .fault")
    assert fault.is_visible()
    assert fault.inner_text()


def test_models_and_laws_side_by_side(visit, server):
    here = visit().open()
    here.see("#models-button")
    here.page.locator("#models-button").click()
    here.page.wait_for_selector("#models table")
    found = server.post("compare", {"case": server.get("vocabulary").json()["starts"]["paper"]["case"]}).json()
    shown = here.page.locator("#models data").evaluate_all(
        "all => all.filter(({ value }) => value).map(({ value }) => Number(value))"
    )
    assert shown == [value for value, _ in numbers_of(found["sheet"]) if value is not None]
    here.type("operation.axial_load", "3000")
    assert not here.page.locator("#models table").count()  # of another case


def test_a_script_that_is_slipped_in_does_not_run(visit):
    here = visit(expected=("Content Security Policy",)).open()
    here.page.evaluate(
        """() => {
          const inline = document.createElement("script"), outer = document.createElement("script");
          const image = document.createElement("div");
          inline.textContent = "window.hurt = 1";
          outer.src = "https://example.invalid/x.js";
          image.innerHTML = '<img src="data:," onerror="window.hurt = 2">';
          document.body.append(inline, outer, image);
        }"""
    )
    here.rest(300)
    assert here.page.evaluate("window.hurt") is None
    assert any("script-src" in line for line in here.complaints)
    here.requests = [one for one in here.requests if "example.invalid" not in one]  # asked for here, and stopped


@pytest.mark.long
def test_the_page_keeps_up_with_typing(visit):
    """Needs a machine that does nothing else; ``benchmarks/page.py`` says how fast it is."""
    here = visit().open()
    here.page.locator("#f-operation-axial_load").focus()
    for _ in range(8):
        here.page.keyboard.press("ArrowUp")
        here.rest(50)
        here.settle()
    measured = "(name) => performance.getEntriesByName(name).slice(1).map((one) => one.duration)"
    assert statistics.median(here.page.evaluate(measured, "numbers")) < 400
    assert statistics.median(here.page.evaluate(measured, "chart")) < 600


def test_a_coefficient_can_be_typed_on(visit):
    """The form is made anew with each answer of another law: 0.10 on the way to 0.107 is not made 0.1."""
    here = visit().open("#A=paper&A.model.friction.boundary_friction_coefficient=0.105&band=0")
    here.reveal(field := "model.friction.boundary_friction_coefficient")
    first = here.text("#summary")
    here.page.locator(here.id(field)).focus()
    here.page.keyboard.press("End")
    here.page.keyboard.press("Backspace")
    here.page.wait_for_function("(first) => document.querySelector('#summary').innerText !== first", arg=first)
    here.settle()
    here.page.keyboard.type("7")
    here.settle()
    assert here.page.locator(here.id(field)).input_value() == "0.107"


def test_a_start_that_comes_late_is_not_shown(visit):
    here = visit().open()
    late = []
    here.page.route("**/catalogue/hiwin-40-16k5", lambda route: late.append(route))
    here.page.locator("#start").select_option("hiwin-40-16k5")
    while not late:
        here.page.wait_for_timeout(10)
    here.page.locator("#start").select_option(DOUBLE)
    here.page.wait_for_selector("#case >> text=double nut")
    before = here.settle().values()
    with here.page.expect_response("**/catalogue/hiwin-40-16k5"):
        late[0].continue_()
    here.rest(200)
    here.page.unroute("**/catalogue/hiwin-40-16k5")
    assert here.values() == before


def test_a_band_of_the_input_before_does_not_pass_for_an_answer(visit):
    here = visit(expected=("status of 422",)).open()
    here.page.route("**/api/v1/band", lambda route: None)
    here.page.locator("#band").check()
    here.page.wait_for_selector("#band-words >> text=computing")
    here.type("operation.axial_load", "nonsense")
    here.page.locator("#system").select_option("inch")
    here.page.wait_for_function("() => document.title.includes('not computed')")
    here.page.unroute("**/api/v1/band")
    here.page.locator("#system").select_option("metric")
    here.type("operation.axial_load", "4000")
    here.page.wait_for_selector("#band-words >> text=95 %")


def test_what_is_superseded_is_dropped(visit):
    here = visit().open()
    field = here.page.locator("#f-operation-axial_load")
    for load in ("1000", "2000", "3000", "2500"):
        field.fill(load)  # faster than the server answers
    here.settle()
    assert here.numbers()["results"] == visit().open("#A=paper&A.operation.axial_load=2500+N").numbers()["results"]
    assert "2500 N" in here.text("#case")
