"""Long work of the page: jobs that survive a reload, that are cancelled, and whose limits are said in words."""

import json
import time

import psutil
import pytest

from ballscrew.faces.web.request_queue import out_of_time

from .shown_sheets import shows
from .test_page_duty import case_of
from .test_page_logs import DOUBLE_NUT, given_logs

pytestmark = pytest.mark.slow

#: Choosing from the whole catalogue, which takes longer than any of these tests looks at it.
#: All that is judged is asked for: the page starts at once.
NEED = {
    "axial_load": "2 kN", "feed": "15 m/min", "unsupported_length": "1 m", "ends": "fixed-supported",
    "running_time": "20000 h",
}  # fmt: skip


def starts(here):
    """Requests that start the job of a service."""
    return sum(url.endswith("/jobs/service") for url in here.requests)


def jobs_of(server):
    """Processes of jobs: those that the process has of which they are forks."""
    return [one for child in psutil.Process(server.process.pid).children() for one in child.children()]


def test_a_service_survives_a_reload(visit, server):
    """While it computes, and once it is there: one click starts the work once."""
    here = visit().open(DOUBLE_NUT)
    body = given_logs(here)
    with here.page.expect_response(lambda one: one.url.endswith("/jobs/service")):
        here.page.locator("#service-start").click()
    for _ in range(2):
        here.page.reload()
        here.page.wait_for_selector("#service .sheet table")
        assert "before the page was reloaded" in here.text("#service .card-line")
    shows(here, "service", server.post("service", {**body, "case": case_of(here), "tolerance": 0.1}).json()["sheet"])
    assert starts(here) == 1


def test_cancelling_on_the_page_kills_the_work(visit, server):
    here = visit().open("#A=paper&band=0&view=choose")
    page = here.page
    page.wait_for_selector("#choose-start")
    for name, value in NEED.items():
        field = page.locator(f"[data-path='need.{name}'] :is(input, select)").first
        (field.select_option if name == "ends" else field.fill)(value)
    page.locator("#choose-start").click()
    end = time.monotonic() + 120
    while not (found := jobs_of(server)):
        assert time.monotonic() < end
        time.sleep(0.05)
    page.locator("#choose .card-line button").click()
    page.wait_for_selector("#choose .card-line:has-text('Cancelled')")
    assert psutil.wait_procs(found, 120)[1] == []
    page.reload()
    page.wait_for_selector("#choose-start")
    here.rest(500)
    assert jobs_of(server) == []


def test_a_limit_that_was_reached_is_said_as_it_is(start, visit):
    """Once, in true words: no field is marked, and no browser sends it again."""
    server = start("--time-limit", "0.1")
    here = visit(server.address, expected=("status of 422",)).open(DOUBLE_NUT)
    # a job of a tenth of a second: its limit is 3 s, which this log of many rows does not take; it is refused by hand
    (fault,) = out_of_time(3.0, is_job=True).faults
    refused = {"title": "Invalid input", "status": 422, "lines": [str(fault)], "faults": [fault.document()]}
    here.page.route(
        "**/jobs/*/answer",
        lambda route: route.fulfill(status=422, content_type="application/problem+json", body=json.dumps(refused)),
    )
    given_logs(here)
    here.page.locator("#service-start").click()
    here.page.wait_for_selector("#service .fault")
    said = here.text("#service")
    assert "stopped the work, which took too long (3 s of processor time): ask for less at a time, or start" in said
    assert "Not computed." in said
    assert "marked field" not in said
    assert starts(here) == 1


def test_a_curve_that_takes_too_long_goes_on_as_a_job(visit):
    """The line of the curve has the sweep that it is; the other lines are shown meanwhile."""
    here = visit()
    problem = out_of_time(20.0).faults[0]
    refused = {"type": "about:blank", "title": "Invalid input", "status": 422, "lines": [str(problem)],
               "faults": [problem.document()]}  # fmt: skip
    held = []

    def answer(route):
        lines = [json.loads(line) for line in route.fetch().text().splitlines()]
        for line in lines:
            if line["question"] == "over_load":
                axis = line.pop("answer")["axes"]["axial_load"]["values"]
                vary = {"axial_load": f"{', '.join(map(repr, axis))} N"}
                outputs = ["screw_maximum_pressure", "nut_maximum_pressure"]
                line |= {"problem": refused, "sweep": {"vary": vary, "outputs": outputs}}
        body = "".join(json.dumps(line) + "\n" for line in lines)
        route.fulfill(status=200, content_type="application/x-ndjson", body=body)

    here.page.route("**/api/v1/answers", answer)
    here.page.route("**/jobs/sweep", lambda route: held.append(route))
    here.open("#A=paper&band=0&view=nut.contact")
    here.page.wait_for_selector("#pressure-chart .warning:has-text('goes on in the background')")
    here.page.wait_for_selector("#long-work [data-address=sweep]")
    held.pop().continue_()
    here.page.wait_for_selector("#pressure-chart .plot[data-drawn]")
    here.page.wait_for_selector("#long-work [data-address=sweep]", state="detached")
    assert sum(url.endswith("/jobs/sweep") for url in here.requests) == 1


DUPLICATED = """async () => {
  const jobs = ballscrewModules["jobs.js"];
  const { keeping } = ballscrewModules["keeping.js"];
  const asked = [];
  const { fetch } = window;
  window.fetch = async (address, { method = "GET" }) => {
    asked.push(`${method} ${address.split("?")[0]}`);
    return new Response(JSON.stringify({ id: "new", state: "finished", rows: [] }));
  };
  const { signal } = new AbortController();
  const copy = (tab) => sessionStorage.setItem("ballscrew.job.test", JSON.stringify({ id: "old", tab, key: "" }));
  try {
    copy("another");
    const found = jobs.keptJob("test");
    await jobs.runJob("duty", {}, { place: "test", signal });
    copy(keeping.own());
    await jobs.runJob("duty", {}, { place: "test", signal });
    const cancelled = await jobs.runJob("duty", { other: 1 }, { place: "test", signal: AbortSignal.abort() })
      .catch((error) => error.name);
    return [found === undefined, asked.map((one) => one.replace("/api/v1/", "")), cancelled];
  } finally {
    window.fetch = fetch;
    sessionStorage.removeItem("ballscrew.job.test");
  }
}"""


def test_a_duplicated_tab_leaves_the_job_of_the_other_one(visit):
    """The browser copies what a tab keeps. A request that is cancelled already ends at once, and starts nothing."""
    here = visit().open()
    is_other, asked, cancelled = here.page.evaluate(DUPLICATED)
    begun = ["POST jobs/duty", "GET jobs/new", "GET jobs/new/answer"]
    assert is_other
    assert asked == [*begun, "DELETE jobs/old", *begun, "DELETE jobs/new"]
    assert cancelled == "AbortError"


def test_two_clicks_on_a_report_make_it_once(visit):
    here = visit().open()
    page = here.page
    here.see("#downloads")
    button = page.locator("#downloads button:text-is('HTML')")
    with page.expect_download():
        button.evaluate("(one) => { one.click(); one.click(); }")
    assert sum("/jobs/report" in url for url in here.requests) == 1
    page.wait_for_function("() => !document.querySelector('#download-words').textContent.includes('…')")
    with page.expect_download():
        button.click()  # it can be made again
