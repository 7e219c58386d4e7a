"""What people type, take back, compare and lose: undo, numbers of other keyboards, a server that is gone."""

import re
import socket
import tomllib

import pytest

from .drawn_charts import AT_LOAD, DRAWN, POINT

pytestmark = pytest.mark.slow


def undo(here):
    before = here.page.url
    here.page.locator("#undo").click()
    here.page.wait_for_function("before => location.href !== before", arg=before)
    return here.settle()


def test_undo_takes_one_edit_back(visit):
    """Two edits of one field were one step, and a point that was dragged in the map was two."""
    here = visit().open()
    field = here.page.locator(here.id("operation.axial_load"))
    here.type("operation.axial_load", "5000")
    field.press("Tab")
    here.type("operation.axial_load", "6000")
    field.press("Tab")
    undo(here)
    assert here.value("operation.axial_load") == "5000"
    slider = here.page.locator("#s-operation-axial_load")
    for x in (0.3, 0.8):
        box = slider.bounding_box()
        here.page.mouse.move(box["x"] + box["width"] * 0.5, box["y"] + box["height"] / 2)
        here.page.mouse.down()
        here.page.mouse.move(box["x"] + box["width"] * x, box["y"] + box["height"] / 2, steps=4)
        here.page.mouse.up()
        here.settle()
    undo(here)
    middle = float(here.value("operation.axial_load"))
    undo(here)
    assert middle != 5000 == float(here.value("operation.axial_load"))

    here.see("#map-chart")
    here.page.locator("#map-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(DRAWN, arg="map-chart")
    x, y = here.page.evaluate(POINT, "map-chart")
    here.page.mouse.move(x, y)
    here.page.mouse.down()
    here.page.mouse.move(x + 60, y - 40, steps=3)
    here.page.mouse.up()
    here.settle()
    assert here.value("operation.axial_load") != "5000"
    speed = here.value("operation.screw_speed")
    undo(here)
    assert here.value("operation.axial_load") == "5000"
    assert here.value("operation.screw_speed") != speed


EDITS = """async (edits) => {
  const { entries } = ballscrewModules["history.js"];
  const address = location.hash;
  const one = ([value, path]) => entries.edit(value ? `${address}&x=${value}` : address, path);
  const place = () => history.state?.place ?? 0;
  const before = place();
  for (const step of edits) {
    if (Array.isArray(step[0])) entries.asOne(() => step.forEach(one));
    else one(step);
  }
  return place() - before;
}"""


@pytest.mark.parametrize(
    ("edits", "entries"),
    [
        ([("1", "a"), ("1", "b"), ("2", "b")], 2),
        ([("1", "a"), [("1", "b"), ("2", "c"), ("3", "b")]], 2),
        ([("1", "a"), ("2", "a"), ("3", "b")], 2),
    ],
    ids=["in one field", "in several at once", "of another address"],
)
def test_an_edit_that_changes_nothing_has_no_entry(visit, edits, entries):
    """The next key in the same field overwrote the entry of the edit before it."""
    here = visit().open()
    assert here.page.evaluate(EDITS, edits) == entries


@pytest.mark.parametrize(
    ("typed", "case", "kept"),
    [
        ("\u22124000", "-4000 N", "-4000 N"),
        ("４０００", "4000 N", "4000 N"),
        ("4000 ± 10 %", "4000 N", "4000 N ± 10 %"),
    ],
)
def test_numbers_of_other_keyboards(visit, typed, case, kept):
    """The page prints a minus sign that it did not read."""
    here = visit().open().type("operation.axial_load", typed)
    assert here.text("#case").startswith(case)
    file = tomllib.loads(here.download("#downloads button:text-is('TOML')").decode())
    assert file["operation"]["axial_load"] == kept


def test_designs_that_were_changed_side_by_side(visit):
    """The table named eight designs alike, and the chart every second one."""
    more = "".join(f"&{letter}=paper&{letter}.screw.lead={lead}+mm" for lead, letter in enumerate("BCDEFGH", start=6))
    here = visit().open("#A=paper&B.operation.axial_load=9+kN&band=0" + more)
    changed = here.page.locator("#compare tbody tr", has_text="changed").first
    words = changed.locator("td").all_inner_texts()
    assert words[0] == "–"
    assert "lead (Screw): 6 mm" in words[1]
    assert "axial load (Operating point): 9 kN (does not count here)" in words[1]
    assert "lead (Screw): 12 mm" in words[-1]
    here.see("#compare-chart")
    here.page.locator("#compare-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(DRAWN, arg="compare-chart")
    names = here.page.evaluate("document.querySelector('#compare-chart .plot').drawn.figure.y.names")
    assert [name["words"] for name in names] == list("ABCDEFGH")
    here.open()
    assert "up to 8 are shown" in here.text("#compare")


def test_a_server_that_is_gone(visit, commands, start):
    """A PDF said that the input was at fault, and the page did not go on by itself."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    server = start("--port", str(port))
    here = visit(
        server.address,
        expected=(
            "ERR_",
            "Failed to load",
        ),
    ).open("#A=paper&band=0")
    server.end()
    page = here.page
    page.locator(here.id("operation.axial_load")).fill("5000")
    page.wait_for_selector("#faults:has-text('does not answer')")
    here.see("#downloads")
    page.locator("#downloads button:text-is('PDF')").click()
    assert "does not answer" in here.text("#download-words")
    here.go("duty")
    page.wait_for_selector("#duty :is(input, select)")  # its form is there, with a server or without
    start("--port", str(port))
    page.wait_for_selector("#results:not(.stale)")
    assert here.settle().text("#case").startswith("5000 N")
    here.go("duty")
    page.wait_for_selector("#duty .verdict")
    assert page.locator(".card-trouble:visible").all_inner_texts() == []


def test_a_new_tab_restores_the_latest_edit(browser, server):
    """To load an older tab again made its work the latest."""
    context = browser.new_context()
    context.set_default_timeout(180_000)

    def opened(address):
        page = context.new_page()
        page.goto(address)
        page.wait_for_selector("html[data-ready]")
        return page

    def edit(page, load):
        page.locator("#f-operation-axial_load").fill(load)
        page.wait_for_function(
            "load => Object.values(localStorage).some((one) => one.includes(`axial_load=${load}`))", arg=load
        )

    first = opened(f"{server.address}/#A=paper&band=0")
    edit(first, "1111")
    second = opened(f"{server.address}/#A=paper&band=0")
    edit(second, "2222")
    first.reload()
    first.wait_for_selector("html[data-ready]")
    first.locator("[data-view=handover]").click()
    first.wait_for_function("() => Object.values(localStorage).some((one) => one.includes('view=handover'))")
    third = opened(server.address)
    assert third.locator("#f-operation-axial_load").input_value() == "2222"
    context.close()


def test_units_and_labels_are_those_of_people(visit):
    """``m/s^2``, ``young modulus``."""
    here = visit().open("#A=vertical-axis&band=0&view=duty")
    here.page.wait_for_selector("#duty .verdict", state="attached")
    assert here.page.locator("#duty input[type=file]").is_hidden()
    shown = here.page.locator("#duty option").all_inner_texts()
    assert "m/s²" in shown
    assert not [one for one in shown if re.search(r"\^| ", one) and "/" in one]
    here.expected = ("status of 422",)
    here.page.goto("about:blank")
    here.open("#A=paper&A.screw.ball_material.young_modulus=-5+GPa&A.lubricant.density_15=-1+kg%2Fm%5E3&band=0")
    assert "Young's modulus" in here.text("#faults")
    assert "density at 15 °C" in here.text("main")
    assert "young modulus" not in here.text("main")


def test_each_half_of_a_nut_has_a_line_of_its_own(visit):
    """The load of each ball was drawn across the distance between the halves."""
    here = visit().open("#A=rexroth-16x5x3-4-double&A.operation.axial_load=1+kN&band=0")
    here.see("#balls-chart")
    here.page.locator("#balls-chart").scroll_into_view_if_needed()
    here.page.wait_for_selector("#balls-chart .plot[data-drawn]")
    gaps = here.page.evaluate(
        "document.querySelector('#balls-chart .plot').drawn.figure.marks"
        ".map(({ x, y }) => [x.indexOf(null), y.indexOf(null), y.length])"
    )
    assert {(x, y) for x, y, _ in gaps} == {(gaps[0][2] // 2,) * 2}


def test_what_is_read_keeps_off_the_operating_point(visit):
    """Its words covered the diamond that they were asked beside: near it nothing is read, it is taken."""
    here = visit().open()
    here.page.locator("#torque-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(AT_LOAD, arg="4000")
    x, y = here.page.evaluate(POINT, "torque-chart")
    reading = here.page.locator("#torque-chart .reading")
    for offset in (-60, -30, 30, 60):
        here.page.mouse.move(x + offset, y + 30)
        reading.wait_for()
        box = reading.bounding_box()
        inside = box["x"] < x < box["x"] + box["width"] and box["y"] < y < box["y"] + box["height"]
        assert not inside, (offset, box, x, y)
    here.page.mouse.move(x + 3, y + 3)
    reading.wait_for(state="hidden")


def test_a_warning_is_said_once(visit):
    """The lost preload stood as a verdict and again as a warning of each design."""
    screw = "rexroth-16x5x3-4-double"
    here = visit().open(f"#A={screw}&A.operation.axial_load=9+kN&B={screw}&band=0")
    here.see("#compare")
    here.page.wait_for_selector("#compare tbody")
    cells = here.page.locator("#compare tbody tr").evaluate_all(
        "all => Object.fromEntries(all.map((row) => [row.cells[0].textContent, row.cells[1].textContent]))"
    )
    assert "preload lost" in cells["verdict"]
    assert "preload lost" not in cells["beware"]


#: The duty of the second edit is answered long after that of the third one.
LATE = """async () => {
  const { answers } = ballscrewModules["answers.js"];
  const found = answers.current().whole.case;
  const of = (mass) => ({ ...found, axis: { ...found.axis, mass } });
  const { fetch } = window;
  const checks = () => JSON.stringify(answers.current().checks);
  await answers.keepWhole(of("400 kg"));
  const before = checks();
  window.fetch = async (address, options) => {
    const answer = await fetch(address, { ...options, signal: undefined });
    if (String(options?.body).includes("4000 kg")) await new Promise((done) => setTimeout(done, 500));
    return answer;
  };
  try {
    const late = answers.keepWhole(of("4000 kg"));
    await answers.keepWhole(of("400 kg"));
    const then = checks();
    await late;
    return [before, then, checks()];
  } finally {
    window.fetch = fetch;
  }
}"""


def test_checks_are_those_of_the_last_edit_of_a_card(visit):
    """An edit that was taken back left the checks of what was taken back, where they came late."""
    here = visit().open("#A=paper&A.screw.dynamic_load_rating=20+kN&band=0&view=duty")
    page = here.page
    page.wait_for_selector("#duty .card-result[aria-busy=false]", state="attached")
    page.locator("#segment-1-distance").fill("300")  # takes the example into the design
    page.wait_for_selector("#duty .card-result[aria-busy=true]", state="attached")
    page.wait_for_selector("#duty .card-result[aria-busy=false]", state="attached")
    here.settle()
    before, then, found = page.evaluate(LATE)
    assert before == then == found
    assert before
