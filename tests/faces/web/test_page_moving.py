"""The cards of balls in motion: asked by their buttons, with their charts and tables."""

import pytest

from .shown_sheets import drawn, shows
from .test_page_access import violations
from .test_page_duty import answered, case_of

pytestmark = pytest.mark.slow


def test_a_reversal_is_asked_for_and_refused(visit, server):
    here = visit()
    here.expected = ("status of 422",)
    asked = []
    here.page.on("request", lambda one: asked.append(one) if one.url.endswith("/jobs/reversal") else None)
    here.open("#A=paper&A.operation.screw_speed=6+rpm&band=0&view=nut.reversal")
    page = here.page
    page.wait_for_selector("#reversal-start")
    assert "This is a hypothesis" in here.text("#reversal")
    here.type("operation.axial_load", "2 kN")
    assert asked == []  # it takes seconds: no key asks for it
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .sheet table")
    answer = server.post("reversal", {"case": case_of(here)}).json()
    shows(here, "reversal", answer["sheet"])
    # the chart has the parts that there are, and all of them as numbers
    curves = next(block for block in answer["sheet"]["blocks"] if block["kind"] == "chart")
    chart = page.locator("#reversal .sheet .chart").first
    plot = drawn(here, chart.get_attribute("id"))
    assert chart.locator("ul.legend li").count() == len([one for one in curves["marks"] if one["name"]])
    axes = plot.evaluate("({ drawn: { figure: { x, y } } }) => [x.log, x.title, y.title]")
    assert axes == [True, "angle of the screw (\u00b0)", "friction torque (N\u00b7m)"]
    chart.locator("details summary").click()
    page.wait_for_selector("#reversal .sheet .chart tbody tr")
    assert chart.locator("tbody tr").count() == len(curves["marks"][0]["x"])
    # a travel that is none stands below the button, the answer above stays
    page.locator("#reversal details.card-fields > summary").click()
    page.locator("#reversal-travel").fill("-1 mm")
    page.wait_for_selector("#reversal code:has-text('--travel')")
    assert "of the previous input" in here.text("#reversal .card-line")
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .fault:has-text('must be positive')")
    page.locator("#reversal-travel").fill("50 um")
    page.locator("#reversal-start").click()
    page.wait_for_function("() => document.querySelector('#reversal .fault') === null")
    page.wait_for_selector("#reversal .verdict:has-text('less than')")
    answered(here, "reversal")
    # a model that has no slip across the path
    here.open("#A=paper&A.operation.screw_speed=6+rpm&A.model.name=olaru2005&band=0&view=nut.reversal")
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .fault:has-text('knows no slip across the path')")
    assert violations(here) == []


def test_a_ripple_with_a_fault(visit, server):
    here = visit()
    here.expected = ("status of 422",)
    asked = []
    here.page.on("request", lambda one: asked.append(one) if one.url.endswith("/jobs/ripple") else None)
    here.open("#A=hiwin-40-20k4&band=0&view=nut.ripple")
    page = here.page
    page.wait_for_selector("#ripple-start")
    assert "This is a hypothesis" in here.text("#ripple")
    here.type("screw.loaded_balls", "20")
    assert asked == []
    page.locator("#ripple details.card-fields > summary").click()
    page.locator("#ripple-turns").fill("6")
    page.locator("#ripple-start").click()
    page.wait_for_selector("#ripple .sheet table")
    body = {"case": case_of(here), "turns": 6}
    shows(here, "ripple", server.post("ripple", body).json()["sheet"])
    axes = "({ drawn: { figure: { x, y } } }) => [y.log, x.title, y.title]"
    found = [
        drawn(here, chart.get_attribute("id")).evaluate(axes) for chart in page.locator("#ripple .sheet .chart").all()
    ]
    assert found == [
        [False, "turns of the screw", "torque (N\u00b7m)"],
        [True, "order, per turn of the screw", "amplitude (N\u00b7mm)"],
    ]
    # a fault that there is not, and one that there is
    page.locator("#ripple-fault").fill("rust")
    page.locator("#ripple-start").click()
    page.wait_for_selector("#ripple .fault:has-text('rust')")
    page.locator("#ripple-fault").fill("missing-ball")
    page.wait_for_selector("#ripple code:has-text('--fault missing-ball')")
    page.locator("#ripple-start").click()
    page.wait_for_selector("#ripple .sheet tr:has-text('missing-ball')")
    shows(here, "ripple", server.post("ripple", {**body, "fault": ["missing-ball"]}).json()["sheet"])
    assert violations(here) == []
