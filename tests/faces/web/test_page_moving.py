"""The cards of balls in motion: asked by their buttons, with their charts and tables."""

from .test_page_access import violations
from .test_page_duty import answered, case_of, number


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
    assert "of the previous input" in here.text("#reversal .card-line")
    page.locator("#reversal-start").click()
    page.wait_for_selector("#reversal .fault:has-text('must be positive')")
    page.locator("#reversal-travel").fill("50 um")
    page.locator("#reversal-start").click()
    page.wait_for_function("() => document.querySelector('#reversal .fault') === null")
    page.wait_for_selector("#reversal [data-record='reversal.back']:has-text('less than')")
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
    page.wait_for_selector("#ripple [data-name=nut-range]")
    answered(here, "ripple")
    body = {"case": case_of(here), "turns": 6}
    answer = server.post("ripple", body).json()
    results = answer["results"]
    assert number(here, "ripple", "nut-mean") == results["mean"]
    assert number(here, "ripple", "nut-range") == results["peak_to_peak"] > 0
    assert number(here, "ripple", "order-0") == results["orders"][0]["amplitude"]
    assert results["faults"] == []
    said = page.eval_on_selector_all("#ripple [data-record]", "all => all.map((one) => one.dataset.record)")
    assert said == [one["id"] for one in (*answer["verdicts"], *answer["warnings"])]
    assert page.locator("#ripple .card-result > div > details li").count() == len(answer["assumed"])
    for id, axes in (
        ("ripple-chart", ["linear", "turns of the screw", "friction torque (N\u00b7m)"]),
        ("ripple-orders-chart", ["log", "order (per turn)", "amplitude (N\u00b7mm)"]),
    ):
        page.locator(f"#{id}").scroll_into_view_if_needed()
        page.wait_for_selector(f"#{id} .main-svg")
        found = page.eval_on_selector(
            f"#{id} .plot",
            "({ layout: { xaxis, yaxis } }) => [yaxis.type ?? 'linear', xaxis.title.text, yaxis.title.text]",
        )
        assert found == axes
        page.locator(f"#{id} details summary").click()
        page.wait_for_selector(f"#{id} tbody tr")
    assert page.locator("#ripple-chart tbody tr").count() == len(results["torque"]["x"])
    # a fault that there is not, and one that there is
    page.locator("#ripple-fault").fill("rust")
    page.locator("#ripple-start").click()
    page.wait_for_selector("#ripple .fault:has-text('rust')")
    page.locator("#ripple-fault").fill("missing-ball")
    page.wait_for_selector("#ripple code:has-text('--fault missing-ball')")
    page.locator("#ripple-start").click()
    page.wait_for_selector("#ripple [data-name=missing-ball-range]")
    answered(here, "ripple")
    fault = server.post("ripple", {**body, "fault": ["missing-ball"]}).json()["results"]["faults"][0]
    assert number(here, "ripple", "missing-ball-range") == fault["peak_to_peak"]
    assert "torque" in here.text("#ripple [data-record='ripple.missing-ball']")
    assert violations(here) == []
