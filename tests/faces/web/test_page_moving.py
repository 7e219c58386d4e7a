"""The cards of balls in motion: asked by their buttons, with their charts, and refused below them."""

import pytest

from .shown_sheets import drawn, shows
from .test_page_access import violations
from .test_page_duty import answered, case_of

pytestmark = pytest.mark.slow

#: By card: its page, an edit of the case, an option and what is sent of it, titles of its charts, and what is refused.
CARDS = {
    "reversal": (
        "#A=paper&A.operation.screw_speed=6+rpm&band=0&view=nut.reversal",
        ("operation.axial_load", "2 kN"),
        ("gap", "0.25", 0.25),
        [["angle of the screw (\u00b0)", "friction torque (N\u00b7m)"]],
        ("travel", "-1 mm", "must be positive", "50 um"),
    ),
    "ripple": (
        "#A=hiwin-40-20k4&band=0&view=nut.ripple",
        ("screw.loaded_balls", "20"),
        ("turns", "6", 6),
        [["turns of the screw", "torque (N\u00b7m)"], ["order, per turn of the screw", "amplitude (N\u00b7mm)"]],
        ("fault", "rust", "rust", "missing-ball"),
    ),
}
TITLES = "({ drawn: { figure: { x, y } } }) => [x.title, y.title]"


@pytest.mark.parametrize("name", CARDS)
def test_a_card_is_asked_by_its_button_and_refused_below_it(visit, server, name):
    address, edit, (option, typed, sent), titles, (field, wrong, said, right) = CARDS[name]
    here = visit()
    here.expected = ("status of 422",)
    asked = []
    here.page.on("request", lambda one: asked.append(one) if one.url.endswith(f"/jobs/{name}") else None)
    page = here.open(address).page
    page.wait_for_selector(f"#{name}-start")
    assert "This is a hypothesis" in here.text(f"#{name}")
    here.type(*edit)
    assert asked == []  # it takes seconds: no key asks for it
    page.locator(f"#{name} details.card-fields > summary").click()
    page.locator(f"#{name}-{option}").fill(typed)
    page.locator(f"#{name}-start").click()
    page.wait_for_selector(f"#{name} .sheet table")
    answer = server.post(name, {"case": case_of(here), option: sent}).json()
    shows(here, name, answer["sheet"])
    charts = page.locator(f"#{name} .sheet .chart").all()
    found = [drawn(here, chart.get_attribute("id")).evaluate(TITLES) for chart in charts]
    assert found[: len(titles)] == titles
    # the first chart has the curves that there are, and all of them as numbers
    curves = next(block for block in answer["sheet"]["blocks"] if block["kind"] == "chart")["marks"]
    assert charts[0].locator("ul.legend li").count() == len([one for one in curves if one["name"]])
    charts[0].locator("details summary").click()
    page.wait_for_selector(f"#{name} .sheet .chart tbody tr")
    # what is refused stands below the button, and the answer above stays
    page.locator(f"#{name}-{field}").fill(wrong)
    page.wait_for_selector(f"#{name} code:has-text('--{field}')")
    assert "of the previous input" in here.text(f"#{name} .card-line")
    page.locator(f"#{name}-start").click()
    page.wait_for_selector(f"#{name} .fault:has-text('{said}')")
    page.locator(f"#{name}-{field}").fill(right)
    page.locator(f"#{name}-start").click()
    page.wait_for_function(f"() => document.querySelector('#{name} .fault') === null")
    answered(here, name)
    assert violations(here) == []
