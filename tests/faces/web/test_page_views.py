"""Views of the page: one screen for each task, with an address; what one has comes first."""

import pytest

from .conftest import Visit, new_page

DOUBLE = "rexroth-40x10x6-6-double"
PANE = "document.body.dataset.seenPane"
#: A row of a double nut, in the long run alone, and an example with a motion, an axis and its motor.
ONE_SCREEN = (pytest.param(DOUBLE, marks=pytest.mark.long), "vertical-axis")
#: Panes by their addresses, in the order of their tabs.
PANES = """[...new Set([...document.querySelectorAll("#have, section[data-pane]")]
  .flatMap((one) => one.dataset.pane.split(" ")))]"""
#: All cards that are seen have their answers, and all charts in sight are drawn.
AT_REST = """() => ![...document.querySelectorAll(".card-result, #over-input")].some((one) => one.ariaBusy === "true")
  && ![...document.querySelectorAll(".plot")].some((one) => one.checkVisibility() && !("drawn" in one.dataset)
    && one.getBoundingClientRect().top < innerHeight)"""
#: Where a part ends on the page.
BOTTOM = """(id) => {
  const one = document.getElementById(id);
  return one.checkVisibility() ? Math.round(one.getBoundingClientRect().bottom + scrollY) : 0;
}"""


def pane(here):
    return here.page.evaluate(PANE)


def test_each_pane_has_an_address_and_is_reached_by_tabs(visit):
    """A pane that is opened by its address is the one that its tab leads to."""
    here = visit()
    here.expected = ("status of 422",)  # the paper's screw has no axis
    here.open("#A=paper&band=0")
    panes = here.page.evaluate(
        "[...new Set([...document.querySelectorAll('[data-pane]')].flatMap((one) => one.dataset.pane.split(' ')))]"
    )
    assert len(panes) > 15
    for one in panes:
        here.go(one)
        assert pane(here) == one
        assert here.page.locator("#views [aria-current=page]").count() == 1
        view = one.partition(".")[0]
        is_first = one == next(other for other in panes if other.partition(".")[0] == view)
        address = here.page.evaluate("location.hash + '&'")
        assert f"&view={one}&" in address or (is_first and (f"&view={view}&" in address or view == "torque"))
        seen = here.page.evaluate(
            """() => [...document.querySelectorAll("#results > section, #have")]
                .filter((one) => one.checkVisibility() && !one.matches(".answer")).length"""
        )
        assert seen >= 1
    assert here.page.evaluate("location.hash").endswith(f"view={panes[-1]}")


def test_back_returns_to_the_view_and_undo_takes_back_an_edit(visit):
    """The browser goes back by views, too; the button of the page does not stop at them."""
    here = visit().open("#A=paper&band=0")
    here.type("operation.axial_load", "3000")
    here.go("nut.film").go("checks")
    here.page.go_back()
    here.page.wait_for_function(f"() => {PANE} === 'nut.film'")
    assert here.page.locator(here.id("operation.axial_load")).input_value() == "3000"
    here.page.reload()
    here.page.wait_for_selector("html[data-ready]")
    here.page.locator("#undo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '4000'")
    here.settle()
    assert pane(here) == "torque.speed"  # where the edit was made
    here.page.locator("#redo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '3000'")


def test_a_link_within_the_page_takes_the_place_of_views_that_were_left(visit):
    """Its entry has the number of a view that one had gone back from, and is no view itself."""
    here = visit().open("#A=paper&band=0")
    here.go("checks").page.go_back()
    here.page.wait_for_function(f"() => {PANE} === 'torque.speed'")
    here.page.evaluate("location.hash = '#A=paper&A.operation.axial_load=3000+N&band=0'")
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '3000'")
    here.page.locator("#undo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '4000'")


def test_another_view_asks_the_server_for_nothing_that_is_known(visit):
    here = visit().open("#A=paper&band=0").rest(300)
    asked = here.posts()
    here.go("nut").go("checks").go("torque")
    here.page.go_back()
    here.page.wait_for_function(f"() => {PANE} === 'checks.limits'")
    assert here.posts() == asked


def test_an_unknown_view_is_said(visit):
    here = visit().open("#A=paper&band=0&view=nonsense")
    assert "nonsense" in here.text("#notice")
    assert pane(here) == "torque.speed"


def test_a_page_of_somebody_new_begins_with_the_first_screen(browser, server):
    page = new_page(browser)
    assert pane(Visit(page, server.address).open("")) == "start.have"
    page.context.close()


def test_the_first_screen_asks_what_one_has(visit, server):
    """A part of a part number is enough; the answer is that of the row."""
    here = visit().open("#A=paper&band=0&view=start")
    assert here.page.locator("#form").is_hidden()
    rows = server.get("catalogue").json()
    all_rows = rows["rows"] if isinstance(rows, dict) else rows
    words = here.page.locator("#have-part")
    words.fill("double 40x10")
    found = here.page.locator("#have [data-row]")
    names = found.evaluate_all("all => all.map((one) => one.dataset.row)")
    assert DOUBLE in names
    assert all("40x10" in name and "double" in name for name in names)
    assert f"of {len(all_rows)} screws" in here.text("#have-count")
    here.page.locator(f"#have [data-row='{DOUBLE}']").click()
    here.page.wait_for_function("(name) => location.hash.includes(`A=${name}`)", arg=DOUBLE)
    here.settle()
    case = server.get(f"catalogue/{DOUBLE}").json()["case"]
    torque = server.post("run", {"case": case}).json()["results"]["screw_torque"]
    assert here.numbers()["results"]["screw_torque"] == torque
    words.fill("nothing like it")
    assert found.count() == 0
    assert "nothing like it" in here.text("#have-count")
    here.page.locator("#have-torque").click()
    assert pane(here) == "torque.speed"
    here.go("start").page.locator("#have-need").click()
    assert pane(here) == "choose.rows"
    here.go("start").page.locator("#have-log").click()
    assert pane(here) == "measure.fit"


def test_work_goes_on_while_another_view_is_seen(visit):
    """What was asked for by a button is there on return."""
    here = visit().open("#A=paper&A.operation.screw_speed=6+rpm&band=0&view=nut.reversal")
    here.page.locator("#reversal-start").click()
    here.go("checks").go("nut.reversal")
    here.page.wait_for_selector("#reversal .card-result[aria-busy=false]:not([hidden])")
    assert sum(url.endswith("/jobs/reversal") for url in here.requests) == 1


@pytest.mark.parametrize("start", ONE_SCREEN)
def test_each_pane_is_one_screen(visit, start):
    """But for sheets, which are read from their top: form and answer stand on one page, and it is scrolled."""
    here = visit(width=1440, height=900)
    here.expected = ("status of 422",)  # the row has no axis
    here.open(f"#A={start}&band=0").page.evaluate("() => sessionStorage.clear()")  # answers to other tests stay there
    here.open(f"#A={start}&band=0&view=torque")
    panes = here.page.evaluate(PANES)
    assert len(panes) > 25
    ends = {}
    for one in panes:
        here.go(one)
        assert pane(here) == one
        here.rest(450)  # a card asks after that
        here.page.wait_for_function(AT_REST)
        if not here.page.locator(".sheet:visible").count():
            ends[one] = max(here.page.evaluate(BOTTOM, part) for part in ("form", "have", "results"))
    assert {one: end for one, end in ends.items() if end > 900} == {}


@pytest.mark.parametrize("view", ["start", "torque.speed", "nut.film", "choose", "measure"])
def test_a_view_has_one_primary_action_at_most(visit, view):
    here = visit().open(f"#A=paper&band=0&view={view}")
    seen = "[...document.querySelectorAll('.primary')].filter((one) => one.checkVisibility()).length"
    assert here.page.evaluate(seen) <= 1
