"""The cards of a duty and of warming up: walked through whole, by keyboard where something is moved."""

import tomllib

import pytest

from .shown_sheets import shows
from .test_page_access import violations

pytestmark = pytest.mark.slow


def case_of(here):
    """The case that the page gives."""
    return tomllib.loads(here.download("#downloads button:text-is('TOML')").decode())


def number(here, card, name):
    return float(here.page.locator(f"#{card} [data-name={name}]").get_attribute("value"))


#: The table of the state in which a warm-up ends.
STEADY = "#warm-up table:has(caption:text-is('Steady state'))"


def nut_temperature(here):
    cell = here.page.locator(f"{STEADY} tr:has-text('temperature of the nut') data").first
    return float(cell.get_attribute("value"))


def cycle_time(here):
    return float(here.page.locator("#duty tr:has-text('time of a cycle') data").get_attribute("value"))


def answered(here, card):
    """Wait until a card has asked and has its answer."""
    here.page.wait_for_function(
        f"""() => {{ const one = document.querySelector("#{card} .card-result");
            return one?.getAttribute("aria-busy") === "false" && !one.classList.contains("earlier"); }}"""
    )
    return here


def edited(here, card, action):
    """Do something that is answered anew."""
    before = here.page.locator(f"#{card} .card-result").get_attribute("aria-busy")
    assert before == "false"
    action()
    here.page.wait_for_selector(f"#{card} .card-result[aria-busy=true]", state="attached")
    return answered(here, card)


def test_a_duty_from_an_example_to_a_fault_and_back(visit, server):
    here = visit(expected=("status of 422",)).open(
        "#A=paper&A.nut.type=double&A.nut.preload=2+kN&A.screw.dynamic_load_rating=20+kN&band=0"
    )
    page = here.page
    here.go("duty")
    answered(here, "duty")
    assert "an example, a vertical axis" in here.text("#duty")
    assert "motion" not in case_of(here)
    # the first change takes the example into the design
    edited(here, "duty", lambda: page.locator("#segment-1-distance").fill("300"))
    case = case_of(here)
    assert [one["name"] for one in case["motion"]["segment"]][:2] == ["up", "change of tool"]
    assert case["motion"]["segment"][0]["distance"] == "300 mm"
    answer = server.post("duty", {"case": case}).json()
    shows(here, "duty", answer["sheet"])
    assert page.locator("#duty .sheet .warning[data-record=open_cycle]").count() == 1
    # each edit begins from the ones before, in the same table, in another segment and in another section
    edits = {"segment-1-speed": "15", "segment-3-distance": "-500", "f-motion-acceleration": "3"}
    for id, typed in edits.items():
        edited(here, "duty", lambda id=id, typed=typed: page.locator(f"#{id}").fill(typed))
    edited(here, "duty", lambda: page.locator("#segment-3-speed").fill("12"))
    page.locator("#add").click()
    page.locator("#design-A").click()
    here.settle()
    answered(here, "duty")
    assert {id: page.input_value(f"#{id}") for id in edits} == edits
    motion = case_of(here)["motion"]
    one, _, two, *_ = motion["segment"]
    assert motion["acceleration"] == "3 m/s^2"
    assert [one["distance"], one["speed"], two["distance"], two["speed"]] == [
        "300 mm",
        "15 m/min",
        "-500 mm",
        "12 m/min",
    ]
    shows(here, "duty", server.post("duty", {"case": case_of(here)}).json()["sheet"])
    page.locator("#remove").click()
    here.settle()
    answered(here, "duty")
    # a fault stands beside its cell, the answer above stays, and undo takes it back
    page.locator("#segment-1-speed").fill("fast")
    page.wait_for_selector("#segment-1-speed[aria-invalid=true]")
    assert here.text("#duty td.wrong .fault")
    assert "of the previous input" in here.text("#duty .card-line")
    assert not page.locator("#results").evaluate("one => one.classList.contains('stale')")
    page.locator("#undo").click()
    answered(here, "duty")
    assert page.input_value("#segment-1-speed") == "15"
    # moved, added and deleted by keys, with the focus at the segment
    page.locator("#segment-1-name").focus()
    edited(here, "duty", lambda: page.keyboard.press("Alt+ArrowDown"))
    assert page.input_value("#segment-2-name") == "up"
    assert page.evaluate("document.activeElement.id") == "segment-2-down"
    edited(here, "duty", lambda: page.locator("#segment-add").press("Enter"))
    assert page.evaluate("document.activeElement.id") == "segment-6-name"
    edited(here, "duty", lambda: page.locator("#segment-6-delete").press("Enter"))
    assert page.locator("#duty .segments tbody tr").count() == 5
    # a recorded motion counts until it is taken away
    rows = [f"{0.02 * i:.2f},{0.1 * (i % 100 if i % 200 < 100 else 100 - i % 100):.1f}" for i in range(201)]
    file = {"name": "run.csv", "mimeType": "text/csv", "buffer": "\n".join(["time [s],position [mm]", *rows]).encode()}
    edited(here, "duty", lambda: page.locator("#duty-trace").set_input_files(file))
    assert cycle_time(here) == 4.0
    assert "run.csv counts in place of the motion" in here.text("#duty")
    edited(here, "duty", lambda: page.locator("#duty-trace-remove").click())
    assert cycle_time(here) != 4.0
    edited(here, "duty", lambda: page.locator("#motion-kind").select_option("s-curve"))
    here.go("duty")
    edited(here, "duty", lambda: page.locator("#f-axis-mass").fill("200"))
    edited(here, "duty", lambda: page.locator("#f-motor-largest_speed").fill("100"))
    page.wait_for_selector("#duty .sheet tr:has-text('motor peak torque'):has-text('FAILS')")
    assert page.locator("#duty .verdict.careful:has-text('fails')").count() == 1
    edited(here, "duty", lambda: page.locator("#motor-toggle").press("Enter"))
    case = case_of(here)
    assert (case["motion"]["kind"], case["axis"]["mass"]) == ("s-curve", "200 kg")
    assert "motor" not in case
    assert violations(here) == []
    # the link has all of it, with the card open
    page.wait_for_function("() => location.hash.includes('view=duty')")
    here.open(page.url.partition("/")[2].partition("#")[2].join(["#", ""]))
    answered(here, "duty")
    assert page.input_value("#f-axis-mass") == "200"


def test_warming_up_with_a_band_that_is_cancelled(visit, server):
    here = visit(
        width=390,
        height=844,
        scheme="dark",
        expected=(
            "status of 422",
            "ERR_FAILED",
        ),
    ).open("#A=warm-up&band=0&view=heat")
    page = here.page
    answered(here, "warm-up")
    shows(here, "warm-up", server.post("warm-up", {"case": case_of(here)}).json()["sheet"])
    before = nut_temperature(here)
    page.locator("#warm-hours").fill("never")
    page.wait_for_selector("#warm-hours[aria-invalid=true]")
    edited(here, "warm-up", lambda: page.locator("#warm-hours").fill("0,5"))
    edited(here, "warm-up", lambda: page.locator("#f-surroundings-ambient").fill("30"))
    assert case_of(here)["surroundings"]["ambient"] == "30 degC"
    assert nut_temperature(here) > before
    # Undo of something else leaves the hours to be changed
    here.type("operation.axial_load", "1 kN")
    page.locator("#undo").click()
    answered(here.settle(), "warm-up")
    edited(here, "warm-up", lambda: page.locator("#warm-hours").fill("0,75"))
    page.wait_for_function("() => new URLSearchParams(location.hash.slice(1)).get('hours') === '0,75'")
    # what takes long says so, and is cancelled
    held = []
    page.route("**/api/v1/jobs/warm-up", lambda route: held.append(route))
    page.locator("#warm-band").check()
    page.locator("#warm-up .card-line button").click()
    assert "Cancelled. The results below are those of the previous input." in here.text("#warm-up .card-line")
    page.unroute("**/api/v1/jobs/warm-up")
    edited(here, "warm-up", lambda: page.locator("#warm-up .card-line button").click())
    assert " to " in here.text(f"{STEADY} tr:has-text('temperature of the nut') td >> nth=0")
    assert violations(here) == []


def test_focus_and_cursor_stay_while_the_fields_of_a_card_are_made_anew(visit):
    here = visit()
    here.open("#A=warm-up&band=0&view=heat")
    page = here.page
    answered(here, "warm-up")
    edited(here, "warm-up", lambda: page.locator("#warm-hours").fill("12"))
    page.locator("#warm-hours").evaluate("one => { globalThis.before = one; one.setSelectionRange(1, 1); }")
    page.locator("#system").evaluate("one => { one.value = 'inch'; one.dispatchEvent(new Event('change')); }")
    page.wait_for_function("() => !globalThis.before.isConnected")
    after = page.evaluate("(({ id, value, selectionStart }) => [id, value, selectionStart])(document.activeElement)")
    assert after == ["warm-hours", "12", 1]
