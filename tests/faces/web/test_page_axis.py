"""The card of the axis: a sketch whose parts lead to their inputs, and what gives way over the stroke."""

import pytest

from .shown_sheets import drawn, shows
from .test_page_access import violations
from .test_page_duty import answered, case_of, edited

pytestmark = pytest.mark.slow


def part(here, name):
    return here.text(f"#axis button[data-part={name}] strong")


def test_a_feed_axis_from_its_sketch_to_its_numbers(visit, server):
    here = visit()
    here.open("#A=feed-axis&band=0&view=axis")
    page = here.page
    answered(here, "axis")
    answer = server.post("axis", {"case": case_of(here)}).json()
    results = answer["results"]
    shows(here, "axis", answer["sheet"])
    # the chart has the whole at all places
    x, y = drawn(here, page.locator("#axis .sheet .chart").first.get_attribute("id")).evaluate(
        "({ drawn: { figure } }) => (({ x, y }) => [x, y])"
        "(figure.marks.find((mark) => mark.kind === 'curve' && mark.x.length > 1))"
    )
    assert len(x) == len(results["position"])
    assert abs(min(y) - min(results["total"]) / 1e6) < 1e-9 * min(y)
    # the sheet follows the units of the page
    page.locator("#system").select_option("inch")
    page.wait_for_selector("#axis .sheet td:has-text('lbf')")
    page.locator("#system").select_option("metric")
    page.wait_for_selector("#axis .sheet td:has-text('N/µm')")
    shares = page.locator("#axis figure:has(figcaption:text-is('share of the compliance'))")
    shares.locator("summary").click()
    shares.locator("tbody tr").first.wait_for()
    assert shares.locator("tbody tr").count() == len(results["position"])
    # each part shows its input, and what the case lacks is dashed
    assert {name: part(here, name) for name in ("table", "fixed", "ends", "shaft", "motor", "mount")} == {
        "table": "500 kg",
        "fixed": "800 N/µm",
        "ends": "fixed-supported",
        "shaft": "1100 mm",
        "motor": "not given",
        "mount": "not given",
    }
    absent = page.eval_on_selector_all("#axis svg .absent", "all => all.map((one) => one.dataset.part).sort()")
    assert absent == ["counterweight", "inclination", "motor", "mount"]
    buttons = page.eval_on_selector_all("#axis button.absent", "all => all.map((one) => one.dataset.part).sort()")
    assert buttons == absent
    # by keyboard to a field of the form, of another card, and of this one; a click on the picture does the same
    for name, id in (
        ("mount", "f-installation-mount_rigidity"), ("table", "f-axis-mass"),
        ("guides", "f-guides-friction_coefficient"),
    ):  # fmt: skip
        here.go("axis").page.locator(f"#axis button[data-part={name}]").press("Enter")
        page.wait_for_function(f"() => document.activeElement.id === '{id}'")
    page.locator("#axis svg g[data-part=fixed] rect").first.click(position={"x": 9, "y": 4})
    page.wait_for_function("() => document.activeElement.id === 'f-bearings-fixed-rigidity'")
    # an edit here is one of the case
    edited(here, "axis", lambda: page.locator("#f-bearings-fixed-rigidity").fill("400"))
    assert case_of(here)["bearings"]["fixed"]["rigidity"] == "400 N/um"
    assert part(here, "fixed") == "400 N/µm"
    rigidity = "#axis table:has(caption:text-is('Rigidity')) tr:has-text('{}') data >> nth=0"
    assert page.locator(rigidity.format("bearings")).get_attribute("value") == "400000000"
    here.type("installation.mount_rigidity", "500 N/um")
    page.wait_for_selector("#axis .sheet tr:has-text('mount')", state="attached")
    answered(here, "axis")
    assert page.locator(rigidity.format("mount")).get_attribute("value") == "500000000"
    assert page.locator("#axis svg g.absent[data-part=mount]").count() == 0
    assert violations(here) == []


def test_an_axis_without_an_installation_on_a_phone(visit):
    here = visit(width=390, height=844, scheme="dark", expected=("status of 422",)).open("#A=paper&band=0&view=axis")
    page = here.page
    page.wait_for_selector("#axis .fault:has-text('unsupported length')")
    assert part(here, "table") == "not given"
    page.locator("#axis button[data-part=shaft]").press("Enter")
    page.wait_for_function("() => document.activeElement.id === 'f-installation-unsupported_length'")
    page.keyboard.type("800")
    here.choose("installation.ends", "fixed-free")
    here.see("#axis")  # it follows where it is seen
    page.locator("#axis .fault").wait_for(state="detached")
    answered(here, "axis")
    page.wait_for_function("() => !document.querySelector('#axis svg g[data-part=ends] > *')")  # its far end is free
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    assert violations(here) == []
