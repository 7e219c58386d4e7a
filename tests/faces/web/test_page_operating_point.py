"""The operating point by hand: units of the nut's speed, sliders, the diamond of a chart; and charts over any input."""

import re
import tomllib

import pytest

from .drawn_charts import AT_LOAD, POINT

pytestmark = pytest.mark.slow


def test_the_operating_point_moves_by_hand(visit):
    """The paper's screw, of 5 mm lead, from 600 rpm to 12 m/min, by a slider, and in the chart."""
    here = visit().open()
    before = here.numbers()["results"]["screw_torque"]
    here.unit("operation.screw_speed", "m/min")
    assert here.value("operation.screw_speed") == "3"
    assert here.numbers()["results"]["screw_torque"] == before
    here.type("operation.screw_speed", "12")
    assert "2400 rpm" in here.text("#case")
    file = tomllib.loads(here.download("#downloads button:text-is('TOML')").decode())
    assert file["operation"]["screw_speed"] == "12 m/min"
    here.type("screw.lead", "10")  # the nut keeps its speed
    assert "1200 rpm" in here.text("#case")

    here.type("screw.lead", "20 mm ± 0.1 mm").rest(400)  # the lead that counts is known from the answer
    assert "600 rpm" in here.text("#case")
    here.unit("operation.screw_speed", "rpm")
    assert here.value("operation.screw_speed") == "600"
    here.unit("operation.screw_speed", "m/min")
    here.page.locator("#s-operation-screw_speed").press("ArrowRight")
    assert "615 rpm" in here.settle().text("#case")
    assert here.value("operation.screw_speed") == "12.3"
    here.type("operation.screw_speed", "12").type("screw.lead", "10 mm")

    slider = here.page.locator("#s-operation-axial_load")
    assert slider.get_attribute("aria-valuetext") == "4000 N"
    slider.press("ArrowRight")
    here.settle()
    assert here.value("operation.axial_load") == "4050"
    here.type("operation.axial_load", "20000")
    assert float(slider.get_attribute("max")) == 50_000

    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(AT_LOAD, arg=20_000)
    x, y = here.page.evaluate(POINT, "torque-chart")
    mouse = here.page.mouse
    mouse.move(x, y)
    mouse.down()
    mouse.move(x - 80, y + 40, steps=3)
    assert here.value("operation.screw_speed") == "12"  # the chart stays under the pointer until it is let go
    mouse.up()
    here.settle()
    assert 5 < float(here.value("operation.screw_speed")) < 12
    here.rest(400)  # the address follows
    assert re.search(r"screw_speed=[\d.]+\+m%2Fmin", here.page.url)


def test_designs_over_any_input(visit, server):
    """Two designs in one chart; one that has no such input is named, and not drawn."""
    here = visit().open(
        "#A=paper&B=paper&B.screw.lead=10+mm&B.lubricant.grade=ISO+VG+32&B.lubricant.viscosity=&B.lubricant.temperature=40+degC&band=0"
    )
    here.go("torque.input")

    def over(path):
        here.page.locator("#over-input-of").select_option(path)
        here.page.wait_for_selector('#over-input[aria-busy="false"]')
        return here.text("#over-input [role=status]"), here.page.locator("#over-input-chart ul.legend").inner_text()

    here.page.wait_for_selector("#over-input-of option", state="attached")
    reasons, legend = over("screw.contact_angle")
    assert (reasons, "Design A" in legend, "Design B" in legend) == ("", True, True)
    assert here.page.locator("#over-input-from").input_value() == "36"
    here.page.locator("#over-input-chart summary").click()
    here.page.wait_for_selector("#over-input-chart tbody td")
    first = here.page.locator("#over-input-chart tbody tr").first.locator("td").all_inner_texts()
    case = {**server.get("vocabulary").json()["starts"]["paper"]["case"]}
    case["screw"] = {**case["screw"], "contact_angle": "36 deg"}
    expected = server.post("run", {"case": case}).json()["results"]["screw_torque"]
    assert abs(float(first[0]) - expected) < 1e-4 * expected
    here.page.locator("#add").click()
    for _ in range(4):
        here.settle().page.locator("#add").click()
    here.settle().see("#over-input-chart")  # it follows where it is seen
    here.page.wait_for_selector("#over-input-chart ul.legend li:nth-child(8)")
    looks = here.page.evaluate(
        "[...document.querySelectorAll('#over-input-chart ul.legend li .key')].slice(0, 7)"
        ".map((key) => `${key.className} ${getComputedStyle(key).color}`)"
    )
    assert len(set(looks)) == 7
    assert "undefined" not in "".join(looks)
    reasons, legend = over("lubricant.temperature")
    assert ("Design A" in reasons, "Design A" in legend, "Design B" in legend) == (True, False, True)


def test_other_programs_read_case_inputs_and_outputs(visit, server):
    here = visit().open("#A=paper&band=0")
    here.page.locator("input[type=range][name='operation.axial_load']").fill("3000")
    here.settle()
    case, outputs = here.page.evaluate("[ballscrew.case, ballscrew.outputs]")
    assert case["operation"]["axial_load"] == "3000 N"
    answer = server.post("run", {"case": case}).json()
    assert outputs == answer["results"]
    assert here.page.evaluate("ballscrew.inputs") == answer["inputs"]
