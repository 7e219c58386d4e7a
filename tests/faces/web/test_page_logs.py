"""The cards that take logs, and the hand-over: each walked through whole."""

import pytest

from ballscrew.faces.web.body_examples import examples

from .shown_sheets import drawn, shows
from .test_page_access import violations
from .test_page_duty import answered, case_of, number

pytestmark = pytest.mark.slow

#: A page with the card of the service and a nut with preload.
DOUBLE_NUT = "#A=paper&A.nut.type=double&A.nut.preload=3+kN&A.model.name=olaru2005&band=0&view=measure.service"

#: Milliseconds in which a card has followed an edit: ``REST`` of calibrate.js, and some.
AFTER_AN_EDIT = 600

#: An edit, and the button before the card has followed the edit.
CHOOSE_AND_USE = """([field, value]) => {
  const one = document.querySelector(field);
  one.value = value;
  for (const name of ["input", "change"]) one.dispatchEvent(new Event(name, { bubbles: true }));
  document.querySelector("#calibrate-use").click();
}"""

#: The fields of a fit that are drawn from the vocabulary.
OPTION_IDS = "[...document.querySelectorAll('#calibration details .entry [id^=fit-]')].map((one) => one.id)"


def given_logs(here):
    """Put the logs of the example of the API into the card of the service."""
    page = here.page
    page.wait_for_selector("#service-worn", state="attached")
    body = examples("ServiceBody")["paper"]
    for name in ("worn", "new"):
        file = {"name": body[name]["name"], "mimeType": "text/csv", "buffer": body[name]["text"].encode()}
        page.set_input_files(f"#service-{name}", file)
        page.wait_for_selector(f"#service-{name}-name:has-text('{name}.csv')")
    page.wait_for_selector("#service-start:enabled")
    return body


def test_a_log_is_fitted_and_used(visit, server):
    """From the example, with a column that is chosen by hand, to the case with the calibration, and back."""
    here = visit(expected=("status of 422",)).open("#A=paper&band=0&view=measure")
    page = here.page
    page.locator("#fit-example").click(timeout=20_000)
    page.wait_for_selector("#calibrate-fit:enabled")
    assert page.input_value("#log-column-3") == "torque"
    here.settle()  # the case to take away is that of the last answer
    case = case_of(here)
    assert case["lubricant"]["grade"] == "ISO VG 68"
    # a column that is taken for what its unit is not of is refused beside it
    page.locator("#log-column-3").select_option("temperature")
    page.wait_for_selector("#calibrate-fit:disabled")
    assert "column temperature" in here.text("#calibration .card-inputs .fault >> nth=0")
    page.locator("#log-column-3").select_option("torque")
    page.wait_for_selector("#calibrate-fit:enabled")
    page.locator("#free-1").check()
    assert "--free friction.boundary_friction_coefficient,constant_torque" in here.text("#calibration code")
    names = {one["name"] for one in server.get("vocabulary").json()["options"]["fit"]} - {"free", "columns"}
    assert {one.removeprefix("fit-") for one in here.page.evaluate(OPTION_IDS)} == names
    page.locator("#calibration details:has(#fit-holdout) summary").click()
    page.locator("#fit-holdout").fill("0.3")
    page.locator("#fit-seed").fill("3")
    assert here.text("#calibration code").endswith("--holdout 0.3 --seed 3")
    page.locator("#calibrate-fit").click()
    page.wait_for_selector("#calibrate-use")
    answered(here, "calibration")
    log = server.get("examples").json()["fit"]["logs"][0]
    free = ["friction.boundary_friction_coefficient", "constant_torque"]
    found = server.post("fit", {"case": case, "log": log, "free": free, "holdout": 0.3, "seed": 3}).json()
    shows(here, "calibration", found["sheet"])
    page.locator("#system").select_option("inch")
    page.wait_for_selector("#calibration .sheet td:has-text('lbf')")
    page.locator("#system").select_option("metric")
    page.wait_for_selector("#calibration .sheet td:has-text('N·m')")
    assert "residuals against time" in here.page.locator("#calibration figcaption").all_text_contents()
    drawn(here, page.locator("#calibration .sheet .chart").first.get_attribute("id"))
    saved = here.download("#calibrate-save").decode()
    assert saved == found["calibrated"]["toml"]
    page.locator("#calibrate-use").click()
    page.wait_for_selector("#calibrate-used:has-text('Undo')")
    assert "→" in here.text("#calibrate-used")
    here.settle()
    used = case_of(here)
    assert used["calibration"]["numbers"] == found["calibrated"]["case"]["calibration"]["numbers"]
    assert used["model"]["friction"] == found["calibrated"]["case"]["model"]["friction"]
    assert server.post("run", {"case": used}).status_code == 200
    page.wait_for_selector("#calibration .card-line:has-text('of the previous input')")
    assert violations(here) == []
    page.locator("#undo").click()
    here.settle()
    assert case_of(here) == case
    page.wait_for_selector("#calibrate-used:text-is('')", state="attached")
    # a fit of another case is not written over this one
    page.evaluate(CHOOSE_AND_USE, [here.id("lubricant.grade"), "ISO VG 220"])
    page.wait_for_selector("#calibrate-used:has-text('has changed since the fit')")
    here.rest(AFTER_AN_EDIT).settle()  # what follows the edit does not take the words away
    assert "has changed since the fit" in here.text("#calibrate-used")
    assert case_of(here)["lubricant"]["grade"] == "ISO VG 220"
    here.choose("lubricant.grade", "ISO VG 68").settle()
    page.wait_for_selector("#calibrate-used:text-is('')", state="attached")


def test_two_logs_tell_the_preload_that_is_left(visit, server):
    here = visit(width=390, height=844, scheme="dark", expected=("status of 422",)).open(DOUBLE_NUT)
    page = here.page
    body = given_logs(here)
    page.locator("#service-tolerance").fill("5")
    page.wait_for_selector("#service code:has-text('--tolerance 0.05')")
    assert "ballscrew service new.csv worn.csv" in here.text("#service code")
    page.locator("#service-start").click()
    page.wait_for_selector("#service .sheet table")
    found = server.post("service", {**body, "case": case_of(here), "tolerance": 0.05}).json()
    shows(here, "service", found["sheet"])
    drawn(here, page.locator("#service .sheet .chart").first.get_attribute("id"))
    page.locator("#service-tolerance").fill("500")
    page.locator("#service-start").click()
    page.wait_for_selector("#service .fault")
    assert "tolerance" in here.text("#service .fault")
    assert not page.locator("#service .sheet").is_visible()  # no number stands below a fault
    page.locator("#system").select_option("inch")
    here.rest(AFTER_AN_EDIT).settle()
    assert not page.locator("#service .sheet").is_visible()  # in no units
    assert violations(here) == []


def test_a_design_is_handed_over(visit, server):
    import base64

    here = visit(expected=("status of 422",)).open("#A=paper&band=0&view=hand-over")
    page = here.page
    page.wait_for_selector("#hand-over-target option >> nth=1", state="attached")
    page.locator("#hand-over-target").select_option("linuxcnc")
    page.locator("#hand-over-option-joint").fill("two")
    page.locator("#hand-over-make").click()
    page.wait_for_selector("#hand-over .fault")
    assert "joint" in here.text("#hand-over .fault")
    page.locator("#hand-over-option-joint").fill("2")
    page.locator("#hand-over-range-screw_speed").fill("-200:200 rpm")
    page.wait_for_selector("#hand-over code:has-text('--option joint=2')")
    page.locator("#hand-over-make").click()
    page.wait_for_selector("#hand-over-download")
    answered(here, "hand-over")
    body = {
        "case": case_of(here),
        "to": "linuxcnc",
        "ranges": {"screw_speed": "-200:200 rpm"},
        "options": {"joint": "2"},
    }
    found = server.post("hand-over", body).json()
    assert here.download("#hand-over-download") == base64.b64decode(found["file"]["base64"])
    assert number(here, "hand-over", "screw_torque") == found["results"]["worst_error"]["screw_torque"]["value"]
    assert violations(here) == []
