"""Views of the page: one screen for each task, with an address; what one has comes first."""

import pytest

from .conftest import Visit, new_page

pytestmark = pytest.mark.slow

DOUBLE = "rexroth-40x10x6-6-double"
VIEW = "document.body.dataset.seenView"
#: The views, in the order of their tabs.
VIEWS = ("torque", "nut", "checks", "duty", "heat", "axis", "choose", "measure", "handover")


def view(here):
    return here.page.evaluate(VIEW)


def test_each_view_has_an_address_and_is_reached_by_its_tab(visit):
    here = visit()
    here.expected = ("status of 422",)  # the paper's screw has no axis
    here.open("#A=paper&band=0")
    tabs = here.page.locator("#views [data-view]")
    assert tuple(tabs.evaluate_all("all => all.map((one) => one.dataset.view)")) == VIEWS
    for name in VIEWS:
        here.go(name)
        assert view(here) == name
        assert here.page.locator("#views [aria-current=page]").get_attribute("data-view") == name
        address = here.page.evaluate("location.hash")
        assert address.endswith(f"view={name}") or (name == "torque" and "view=" not in address)
        seen = here.page.locator("#results > section").evaluate_all(
            "all => all.filter((one) => one.checkVisibility()).length"
        )
        assert seen >= 1


@pytest.mark.parametrize(
    ("address", "name", "place"),
    [
        ("nut.film", "nut", "#film-chart"),
        ("duty.limits", "duty", "#duty"),  # a part that it had once
        ("hand-over.files", "handover", "#files"),
        ("start.own", "choose", "#own-nut"),
        ("start.have", "torque", "#numbers"),
    ],
)
def test_an_address_leads_to_a_part_of_a_view_also_by_its_old_name(visit, address, name, place):
    here = visit(expected=("status of 422",)).open(f"#A=paper&band=0&view={address}")
    assert view(here) == name
    here.page.wait_for_function(
        "(place) => document.querySelector(place).getBoundingClientRect().top < innerHeight", arg=place
    )


def test_back_returns_to_the_view_and_undo_takes_back_an_edit(visit):
    """The browser goes back by views, too; the button of the page does not stop at them."""
    here = visit().open("#A=paper&band=0")
    here.type("operation.axial_load", "3000")
    here.go("nut.film").go("checks")
    here.page.go_back()
    here.page.wait_for_function(f"() => {VIEW} === 'nut'")
    assert here.page.locator(here.id("operation.axial_load")).input_value() == "3000"
    here.page.reload()
    here.page.wait_for_selector("html[data-ready]")
    here.page.locator("#undo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '4000'")
    here.settle()
    assert view(here) == "torque"  # where the edit was made
    here.page.locator("#redo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '3000'")


def test_a_link_within_the_page_takes_the_place_of_views_that_were_left(visit):
    """Its entry has the number of a view that one had gone back from, and is no view itself."""
    here = visit().open("#A=paper&band=0")
    here.go("checks").page.go_back()
    here.page.wait_for_function(f"() => {VIEW} === 'torque'")
    here.page.evaluate("location.hash = '#A=paper&A.operation.axial_load=3000+N&band=0'")
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '3000'")
    here.page.locator("#undo").click()
    here.page.wait_for_function("() => document.querySelector('#f-operation-axial_load').value === '4000'")


def test_another_view_asks_the_server_for_nothing_that_is_known(visit):
    here = visit().open("#A=paper&band=0").quiet()
    asked = here.posts()
    here.go("nut").go("checks").go("torque")
    here.page.go_back()
    here.page.wait_for_function(f"() => {VIEW} === 'checks'")
    assert here.posts() == asked


def test_an_unknown_view_is_said(visit):
    here = visit().open("#A=paper&band=0&view=nonsense")
    assert "nonsense" in here.text("#notice")
    assert view(here) == "torque"


def test_a_page_of_somebody_new_begins_with_the_torque_of_an_example(browser, server):
    page = new_page(browser)
    here = Visit(page, server.address).open("")
    assert view(here) == "torque"
    assert here.text("#example").startswith("Example, until you choose something else")
    assert here.page.locator("#search").is_visible()
    page.context.close()


def test_a_screw_is_found_by_a_part_of_its_number(visit, server):
    """By a size as it is written, parts of a name, or an order code; the answer is that of the row."""
    here = visit().open("#A=paper&band=0")
    rows = server.get("catalogue").json()
    all_rows = rows["rows"] if isinstance(rows, dict) else rows
    words = here.page.locator("#search")
    words.fill("double 40x10")
    found = here.page.locator("#screw-search [data-row]")
    names = found.evaluate_all("all => all.map((one) => one.dataset.row)")
    assert DOUBLE in names
    of = {row["name"]: row["row"] | {"nut": row["nut"]} for row in all_rows}
    assert all(of[name]["nut"] == "double" for name in names)
    assert all((of[name]["nominal_diameter"], of[name]["lead"]) == (0.04, 0.01) for name in names)
    assert f"of {len(all_rows)} screws" in here.text("#search-count")
    here.page.locator(f"#screw-search [data-row='{DOUBLE}']").click()
    here.page.wait_for_function("(name) => location.hash.includes(`A=${name}`)", arg=DOUBLE)
    here.settle()
    case = server.get(f"catalogue/{DOUBLE}").json()["case"]
    torque = server.post("run", {"case": case}).json()["results"]["screw_torque"]
    assert here.numbers()["results"]["screw_torque"] == torque
    words.fill("SFU4010-4")
    assert here.text("#search-count").startswith("SFU4010-4 is not in the catalogue")
    names = found.evaluate_all("all => all.map((one) => one.dataset.row)")
    assert all((of[name]["nominal_diameter"], of[name]["lead"]) == (0.04, 0.01) for name in names)
    words.fill("nothing like it")
    assert found.count() == 0
    assert "nothing like it" in here.text("#search-count")
    words.fill("40 × 10")
    words.press("Enter")  # the first one is taken
    here.page.wait_for_function("() => document.querySelector('#search').value === ''")
    assert "40x10" in here.settle().page.evaluate("location.hash")
    here.page.locator("#search-own").click()
    assert view(here) == "choose"


def test_work_goes_on_while_another_view_is_seen(visit):
    """What was asked for by a button is there on return."""
    here = visit().open("#A=paper&A.operation.screw_speed=6+rpm&band=0&view=nut.reversal")
    here.page.locator("#reversal-start").click()
    here.go("checks").go("nut.reversal")
    here.page.wait_for_selector("#reversal .card-result[aria-busy=false]:not([hidden])")
    assert sum(url.endswith("/jobs/reversal") for url in here.requests) == 1


@pytest.mark.parametrize("name", ["torque", "nut", "heat", "handover"])
def test_a_section_has_one_primary_action_at_most(visit, name):
    here = visit(expected=("status of 422",)).open(f"#A=paper&band=0&view={name}")
    most = """() => Math.max(...[...document.querySelectorAll("section")].map((section) =>
      [...section.querySelectorAll(".primary")].filter((one) => one.checkVisibility()).length))"""
    assert here.page.evaluate(most) <= 1
