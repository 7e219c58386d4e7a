"""The cards of sensitivity, optimisation and condition, and long requests that go on as jobs by themselves."""

import json
import urllib.parse

import pytest

from .conftest import ROOT
from .shown_sheets import drawn, shows
from .test_page_access import violations
from .test_page_duty import answered, case_of

pytestmark = pytest.mark.slow

NEED = {
    "axial_load": "2 kN", "feed": "15 m/min", "unsupported_length": "1 m", "ends": "fixed-supported",
    "running_time": "20000 h",
}  # fmt: skip


def with_need(need):
    kept = urllib.parse.quote(
        json.dumps({"texts": need, "units": {}, "rest": {"optimise": {"elastic_generations": 0}}})
    )
    return f"#A=paper&band=0&view=choose.optimise&need={kept}"


def test_sources_of_the_band(visit, server):
    """The bars are those of the answer; a click on the name of an input goes to its field."""
    here = visit()
    here.open("#A=paper&band=0&view=checks.sensitivity")
    page = here.page
    page.wait_for_selector("#sensitivity-start")
    page.locator("#sensitivity details.card-fields > summary").click()
    page.locator("#sensitivity-samples").fill("256")
    page.locator("#sensitivity-method").fill("sobol")
    page.wait_for_selector("#sensitivity code:has-text('--samples 256')")
    page.locator("#sensitivity-start").click()
    page.wait_for_selector("#sensitivity tbody tr")
    answered(here, "sensitivity")
    found = server.post("sensitivity", {"case": case_of(here), "samples": 256}).json()
    shows(here, "sensitivity", found["sheet"])
    chart = page.locator("#sensitivity .sheet .chart").first
    plot = drawn(here, chart.get_attribute("id"))
    count, pitch = plot.evaluate(
        "({ drawn: { figure, frame } }) => [figure.y.names.length, frame.y.pixel(1) - frame.y.pixel(0)]"
    )
    assert count > 5
    assert pitch >= 26  # two lines of a name lie over no other one
    first = found["sensitivity"]["inputs"][0]["first_order"]
    width, end = plot.evaluate(
        "({ drawn: { figure: { marks } } }) => [marks[0].width, marks.find(({ kind }) => kind === 'whisker').high]"
    )
    assert width == first["value"]
    assert abs(end - first["high"]) < 1e-12
    assert violations(here) == []
    page.locator("#sensitivity .sheet tbody button:text-is('viscosity')").click()
    page.wait_for_function("document.activeElement?.id === 'f-lubricant-viscosity'")
    page.locator("#sensitivity-method").fill("local")
    page.locator("#sensitivity-samples").fill("")
    page.locator("#sensitivity-start").click()
    page.wait_for_selector("#sensitivity .sheet:has-text('at the medians of the inputs')")
    answered(here, "sensitivity")


def test_an_optimum_is_taken(visit, server):
    here = visit(scheme="dark")
    here.open(with_need(NEED))
    page = here.page
    page.wait_for_selector("#optimise-start")
    assert "axial load (Operating point): 2 kN" in here.text("#optimise")
    page.locator("#optimise details.card-fields > summary").click()
    for name, value in {"population": "16", "generations": "8", "members": "4"}.items():
        page.locator(f"#optimise-{name}").fill(value)
    page.locator("#optimise input[value=life]").check()
    page.wait_for_selector("#optimise code:has-text('--objectives loss,inertia,life')")
    page.locator("#optimise-start").click()
    page.wait_for_selector("#optimise .sheet tbody tr")
    need = {"need": NEED, "optimise": {"elastic_generations": 0}}
    options = {"population": 16, "generations": 8, "members": 4, "objectives": ["loss", "inertia", "life"]}
    answer = server.post("optimise", {"need": need, **options}).json()
    found = answer["candidates"]
    shows(here, "optimise", answer["sheet"])
    rows = page.locator("#optimise .sheet table").first.locator("tbody tr")
    assert rows.count() == len(found) > 1
    plot = drawn(here, "optimise-chart-life-against-loss")
    assert plot.evaluate("({ drawn }) => drawn.figure.y.title").endswith("(h)")
    assert violations(here) == []
    rows.nth(1).locator("button").last.click()
    page.wait_for_selector("#optimise [role=status]:has-text('Optimum 2 is design A')")
    here.settle()
    assert case_of(here)["screw"]["lead"] == found[1]["case"]["screw"]["lead"]


def test_a_condition_over_time(visit, server):
    """From a table; then from logs, which are put in order by hand, and cannot be judged with a wrong option."""
    here = visit(width=390, height=844, expected=("status of 422",)).open("#A=paper&band=0&view=measure.condition")
    page = here.page
    page.locator("#condition-example").click()
    page.wait_for_selector("#condition-start:enabled")
    here.settle()
    page.locator("#condition-start").click()
    page.wait_for_selector("#condition tbody tr")
    answered(here, "condition")
    text = (ROOT / "examples" / "nut_over_years.csv").read_text(encoding="utf-8")
    tests = [{"name": "nut_over_years.csv", "text": text}]
    found = server.post("condition", {"case": case_of(here), "tests": tests}).json()
    shows(here, "condition", found["sheet"])
    for chart in page.locator("#condition .sheet .chart").all():
        drawn(here, chart.get_attribute("id"))
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert violations(here) == []
    # logs in the order of their names, moved by hand
    new = (ROOT / "examples" / "nut_new.csv").read_bytes()
    files = [{"name": f"{name}.csv", "mimeType": "text/csv", "buffer": new} for name in ("test-10", "test-9")]
    page.set_input_files("#condition-log", files)
    page.wait_for_selector("#condition-tests li:nth-child(3)")
    names = page.locator("#condition-tests li > span:first-child")
    assert names.all_inner_texts() == ["nut_over_years.csv", "test-9.csv", "test-10.csv"]
    page.locator("#condition-tests li").nth(2).locator("button").first.click()
    assert names.all_inner_texts() == ["nut_over_years.csv", "test-10.csv", "test-9.csv"]
    page.locator("#condition-tests li").nth(0).locator("button").last.click()
    assert names.all_inner_texts() == ["test-10.csv", "test-9.csv"]
    page.locator("#condition-start").click()
    page.wait_for_selector("#condition .fault")
    assert not page.locator("#condition tbody tr").first.is_visible()  # no number stands below a fault


def test_a_long_request_is_shown_and_cancelled(visit, server):
    """The line at the foot of the page says how far it is; the next request of its kind is a job at once."""
    here = visit(expected=("status of 422",)).open("#A=paper&band=0")
    page = here.page
    fault = {"where": "server", "path": "server", "id": "out_of_time", "text": "", "line": "", "problem": "",
             "given": "", "remedy": "", "messages": {"problem": None, "given": None, "remedy": None}}  # fmt: skip
    ended = {"type": "about:blank", "title": "Invalid input", "status": 422, "lines": ["too long"], "faults": [fault]}
    page.route(
        "**/api/v1/compare",
        lambda route: route.fulfill(status=422, content_type="application/problem+json", body=json.dumps(ended)),
    )
    running = {"id": "one", "address": "compare", "state": "running", "before": 0, "finished": 1, "total": 4,
               "computed": 1.0, "limit": 600.0, "rows": []}  # fmt: skip
    page.route("**/api/v1/jobs/*", lambda route: route.fulfill(status=200, json=running))
    here.see("#models-button").page.locator("#models-button").click()
    line = page.locator("#long-work p[data-address=compare]")
    line.wait_for()
    assert "Models side by side" in line.inner_text()
    assert line.locator("progress").get_attribute("value") == "1"
    assert violations(here) == []
    line.locator("button").click()
    page.wait_for_selector("#models:has-text('Cancelled.')")
    assert page.locator("#long-work").is_hidden()
    page.unroute("**/api/v1/jobs/*")
    asked = sum(url.endswith("/api/v1/compare") for url in here.requests)
    page.locator("#models-button").click()
    page.wait_for_selector("#models table")
    assert sum(url.endswith("/api/v1/compare") for url in here.requests) == asked == 1
    assert sum(url.endswith("/api/v1/jobs/compare") for url in here.requests) == 2
