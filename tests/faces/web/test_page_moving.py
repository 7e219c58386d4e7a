"""The cards of balls in motion: asked by their buttons, with their charts and tables."""

from .test_page_access import violations
from .test_page_duty import answered, case_of, number


def test_a_reversal_is_asked_for_and_refused(visit, server):
    here = visit()
    here.expected = ("status of 422",)
    asked = []
    here.page.on("request", lambda one: asked.append(one) if one.url.endswith("/jobs/reversal") else None)
    here.open("#A=paper&A.operation.screw_speed=6+rpm&band=0&cards=reversal")
    page = here.page
    page.wait_for_selector("#reversal-start")
    assert "This is a hypothesis" in here.text("#reversal")
    here.type("operation.axial_load", "2 kN")
    assert asked == []  # it takes seconds: no key asks for it
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal [data-name=all-90]")
    answered(here, "reversal")
    answer = server.post("reversal", {"case": case_of(here)}).json()
    results = answer["results"]
    swing = results["swing"]
    assert number(here, "reversal", "all-90") == next(one["screw_angle"] for one in swing if one["share"] == 0.9) > 0
    assert number(here, "reversal", "helix-50") == results["swing_by_mechanism"]["helix"][0]["screw_angle"]
    assert number(here, "reversal", "lugre-stiffness") == results["lugre"]["model"]["presliding_stiffness"]
    assert here.text("#reversal [data-name=rolling-50]") == "at once"
    said = page.eval_on_selector_all("#reversal [data-record]", "all => all.map((one) => one.dataset.record)")
    assert said == [one["id"] for one in (*answer["verdicts"], *answer["warnings"])]
    # the chart has the parts that there are, and all of them as numbers
    page.locator("#reversal-chart").scroll_into_view_if_needed()
    page.wait_for_selector("#reversal-chart .main-svg")
    parts = [name for name, values in results["contributions"].items() if any(values)]
    assert len(parts) > 2
    assert page.locator("#reversal-chart ul.legend li").count() == len(parts) + 1
    axes = page.eval_on_selector(
        "#reversal-chart .plot",
        "one => [one.layout.xaxis.type, one.layout.xaxis.title.text, one.layout.yaxis.title.text]",
    )
    assert axes == ["log", "angle of the screw (\u00b0)", "friction torque (N\u00b7m)"]
    page.locator("#reversal-chart details summary").click()
    page.wait_for_selector("#reversal-chart tbody tr")
    assert page.locator("#reversal-chart tbody tr").count() == len(results["screw_angle"])
    # a travel that is none stands below the button, the answer above stays
    page.locator("#reversal details.card-fields > summary").click()
    page.locator("#reversal-travel").fill("-1 mm")
    page.wait_for_selector("#reversal code:has-text('--travel')")
    assert "of the input before" in here.text("#reversal .card-line")
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .fault:has-text('must be positive')")
    page.locator("#reversal-travel").fill("50 um")
    page.locator("#reversal-start").click()
    page.wait_for_function("() => document.querySelector('#reversal .fault') === null")
    page.wait_for_selector("#reversal [data-record='reversal.back']:has-text('less than')")
    answered(here, "reversal")
    # a model that has no slip across the path
    here.open("#A=paper&A.operation.screw_speed=6+rpm&A.model.name=olaru2005&band=0&cards=reversal")
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .fault:has-text('knows no slip across the path')")
    assert violations(here) == []


def test_a_reversal_in_german(visit):
    here = visit(width=390, height=844)
    try:
        here.page.context.add_cookies([{"name": "ballscrew-language", "value": "de", "url": here.address}])
        here.open("#A=paper&A.operation.screw_speed=6+rpm&band=0&cards=reversal")
        here.page.locator("#reversal-start").click()
        here.page.wait_for_selector("#reversal [data-name=all-90]")
        answered(here, "reversal")
        warning = here.text("#reversal [data-record='reversal.hypothesis']")
        assert "ist eine Hypothese: er ist berechnet" in warning
        assert "Bohrschlupf" in here.text("#reversal ul.legend")
        assert here.page.locator("#reversal [lang=en]").count() == 0
        assert here.page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    finally:
        here.page.context.clear_cookies()
