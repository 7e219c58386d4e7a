"""The page as somebody meets it who walks through it for the first time."""

import base64

import pytest

pytestmark = pytest.mark.slow

#: In the page: a file is dropped, beside every place that takes one.
DROP = """({name, content}) => {
  const given = new DataTransfer();
  given.items.add(new File([Uint8Array.from(atob(content), (one) => one.charCodeAt(0))], name));
  document.body.dispatchEvent(new DragEvent("drop", {dataTransfer: given, bubbles: true, cancelable: true}));
}"""


def test_a_row_leaves_the_unit_of_the_load(visit):
    """A row has its load in kN: what is typed next is in newton, as the field was, also after Undo."""
    here = visit().open()
    here.page.locator("#search").fill("40x10 rexroth double")
    here.page.locator("[data-row]").first.click()
    here.page.wait_for_selector("#case >> text=7210 N")
    unit = here.page.locator("#u-operation-axial_load")
    assert (here.value("operation.axial_load"), unit.input_value()) == ("7210", "N")
    here.type("operation.axial_load", "8000")
    assert here.text("#case").startswith("8000 N")
    here.page.locator("#undo").click()
    here.page.wait_for_selector("#case >> text=7210 N")
    assert unit.input_value() == "N"


def test_what_an_example_says_is_so(visit):
    """Its mass is not named beside another one, and torque and duty say whose loads they are of."""
    here = visit().open("#A=vertical-axis&band=0&view=duty")
    mass = here.page.locator("#f-axis-mass")
    mass.wait_for()
    assert here.page.locator("#example").text_content().endswith("a vertical axis of 400 kg with its motor.")
    mass.fill("120")
    here.page.wait_for_selector("#example", state="hidden")
    assert "do not count here" in here.text("#duty")
    here.page.locator("#to-torque").click()
    assert "the cycle of the axis has loads of its own" in here.text("#of-point")
    here.page.locator("#to-cycle").click()
    here.page.wait_for_selector("#duty .verdict >> text=45 kg cm²")


def test_choose_says_what_it_needs_before_it_is_asked(visit):
    here = visit().open("#band=0&view=choose")
    wanted = here.page.locator("#choose-wanted")
    wanted.wait_for()
    assert wanted.inner_text() == "Still to be given: feed."
    here.page.locator("#f-need-mass").fill("300")
    assert wanted.inner_text() == "Still to be given: acceleration, feed, stroke."
    for name, text in (("acceleration", "3"), ("feed", "30"), ("stroke", "600")):
        here.page.locator(f"#f-need-{name}").fill(text)
    assert wanted.is_hidden()
    assert "axial load" not in here.text("#optimise p >> nth=0")


def test_a_phone_shows_the_answer_before_the_case(visit):
    here = visit(width=390, height=844).open()
    torque = here.page.locator("#numbers [data-name=screw_torque]").bounding_box()
    assert torque["y"] + torque["height"] < 844
    assert not here.page.locator("#f-operation-axial_load").is_visible()
    here.page.locator("#case-column > summary").click()
    here.page.locator("#f-operation-axial_load").fill("2000")
    assert here.settle().text("#case").startswith("2000 N")
    here.page.set_viewport_size({"width": 1360, "height": 900})
    assert here.page.locator("#form").is_visible()


def test_a_field_is_called_by_its_label(visit):
    """A sentence of an answer that names a field by its key in a file."""
    here = visit().open("#A=vertical-axis&band=0&view=axis")
    here.page.wait_for_selector("#axis .card-result >> text=first position (Surroundings) is not given")
    assert "surroundings." not in here.text("#axis")


def test_a_log_dropped_on_measure_is_fitted(visit, server):
    here = visit().open("#band=0&view=measure")
    here.page.wait_for_selector("#calibrate-log", state="attached")
    log = server.get("examples").json()["fit"]["logs"][0]
    content = base64.b64encode(log["text"].encode()).decode()
    here.page.evaluate(DROP, {"name": log["name"], "content": content})
    here.page.wait_for_selector("#calibrate-fit")
    assert here.text("#calibrate-log-name") == log["name"]


def test_nothing_is_said_twice_of_the_torque(visit):
    """Back-driving at speed and at rest, and the rule of the maker of a screw beside those of all makers."""
    here = visit().open("#A=vertical-axis&band=0")
    verdicts = here.text("#verdicts")
    assert verdicts.casefold().count("back-drives") == 1
    assert ("at this speed" in verdicts, "at rest" in verdicts) == (True, True)
    assert "its maker" not in verdicts
    assert here.text("#rules").count("HIWIN") == 1
    here.page.locator("#rules summary").click()
    assert "range of the rule" in here.text("#rules")
