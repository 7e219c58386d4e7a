"""The card of choosing, walked through whole: a need, the ranked list, filters, the picture, and a design of it."""

import json
import urllib.parse

import pytest

from .test_page_access import violations

pytestmark = pytest.mark.slow

NEED = {
    "axial_load": "3 kN", "feed": "15 m/min", "unsupported_length": "1 m", "ends": "fixed-supported",
    "running_time": "5000 h", "preload": ["5 %", "8 %"], "rows": "rexroth 32x",
}  # fmt: skip
MASS = {"mass": "400 kg", "inclination": "90 deg", "acceleration": "3 m/s^2", "stroke": "600 mm"}
OWN = "name,d0 [mm],lead [mm],ball [mm],turns,nut\nMINE,40,20,6,4,single\n"


def ask(here):
    here.page.locator("#choose-start").click()
    here.page.wait_for_selector("#choose [role=status]")


def test_what_is_left_open_is_asked_about_first(visit, server):
    """A vertical axis without length, ends and life: the page says what nobody can judge, and starts when told to."""
    here = visit()
    texts = {**MASS, "feed": "24 m/min", "nut": "double", "preload": "5 %"}
    rest = {"need": {"rows": "hiwin-40-20k4"}}
    need = urllib.parse.quote(json.dumps({"texts": texts, "units": {}, "rest": rest}))
    here.open(f"#band=0&view=choose&need={need}")
    here.page.wait_for_selector("#choose-start")
    here.page.locator("#choose-start").click()
    here.page.wait_for_selector("#choose-anyway")
    said = here.text("#choose .card-line")
    for words in ("running time", "buckling", "critical speed", "life", "Candidates: 1, 1 s of a processor at most"):
        assert words in said, said
    assert here.page.locator("#choose-result tbody tr").count() == 0
    here.page.locator("#choose-anyway").click()
    here.page.wait_for_selector("#choose [role=status]")
    need = {**texts, "rows": "hiwin-40-20k4"}
    [first] = server.post("select", {"need": need}).json()["candidates"]
    headings = here.page.locator("#choose-result thead th").all_inner_texts()
    cells = here.page.locator("#choose-result tbody tr").nth(0).locator("th, td")
    for heading, value in (
        ("motor, largest torque", first["duty"]["torque_peak"]),
        ("motor, RMS torque", first["duty"]["torque_rms"]),
        ("brake holds", first["brake"]["holding_torque"]),
    ):
        place = next(place for place, words in enumerate(headings) if words.startswith(heading))
        assert float(cells.nth(place).locator("data").get_attribute("value")) == value
    here.page.locator("#choose-start").click()  # it has been said: it is not asked again
    here.page.wait_for_selector("#choose [role=status]")
    here.page.locator("#f-need-running_time").fill("10000 h")
    here.page.locator("#f-need-ends").select_option("fixed-supported")
    here.settle()
    here.page.locator("#choose-start").click()
    here.page.wait_for_selector("#choose [role=status] >> text=1 of which hold all checks")


def test_choose_a_screw(visit, server):
    here = visit(scheme="dark")
    here.expected = ("status of 422",)
    rest = {"need": {"rows": NEED["rows"]}}
    texts = {name: text for name, text in NEED.items() if name not in ("rows", "axial_load")}
    texts["preload"] = "; ".join(NEED["preload"])
    need = urllib.parse.quote(json.dumps({"texts": {**texts, "axial_load": "2 furlong"}, "units": {}, "rest": rest}))
    here.open(f"#band=0&view=choose&need={need}")
    here.page.wait_for_selector("#choose-start")
    here.page.locator("#choose-start").click()
    here.page.wait_for_selector("[data-path='need.axial_load'] .fault:not(:empty)")
    assert "furlong" in here.text("[data-path='need.axial_load'] .fault")
    here.page.locator("#f-need-axial_load").fill(NEED["axial_load"])
    ask(here)
    answer = server.post("select", {"need": {"need": NEED}}).json()
    rows = here.page.locator("#choose-result tbody tr")
    assert rows.count() == min(25, len(answer["candidates"]))
    first = answer["candidates"][0]
    assert first["label"] in rows.nth(0).inner_text()
    assert float(rows.nth(0).locator("data >> nth=0").get_attribute("value")) == first["objectives"]["loss"]
    failing = next(one for one in answer["candidates"] if "life" in [check["name"] for check in one["fails"]])
    rank = f"#choose-result tr[data-rank='{failing['rank']}']"
    assert "life in hours" in here.text(rank)
    assert "times the limit" in here.text(rank)
    here.page.locator("#choose-holding").check()
    assert rows.count() == min(25, answer["holding"])
    here.page.locator("#choose-words").fill("no such screw")
    assert rows.count() == 0
    here.page.locator("#choose-words").fill("")
    here.page.locator("#choose-holding").uncheck()
    here.page.locator("[data-sort=drive_torque]").click()
    assert here.page.evaluate("document.activeElement.dataset.sort") == "drive_torque"
    sorting = here.page.locator("#choose-result [aria-sort]")
    assert (sorting.count(), sorting.get_attribute("aria-sort")) == (1, "ascending")
    known = [one for one in answer["candidates"] if one["complete"]]
    least = min(known, key=lambda one: one["objectives"]["drive_torque"])
    assert least["label"] in rows.nth(0).inner_text()
    lost = next(one for one in answer["candidates"] if one["rigid_lift_off_load"] is not None)
    assert not lost["holds"]
    assert "Preload lost (rigid bodies: above" in here.text(f"#choose-result tr[data-rank='{lost['rank']}']")
    here.page.locator("[data-sort=rank]").click()
    here.page.locator("#choose-y").select_option("life")
    here.page.locator("#choose-chart").scroll_into_view_if_needed()
    here.page.wait_for_function(
        "() => document.querySelector('#choose-chart .plot')?.drawn?.figure.y.title === 'life (h)'"
    )

    assert violations(here) == []

    here.page.locator("#choose-result tbody button >> nth=0").click()
    here.page.wait_for_selector("#choose-result >> text=is design A")
    assert here.settle().page.locator("#start").input_value() == first["name"]
    torque = here.numbers()["results"]["screw_torque"]
    assert torque == first["results"]["screw_torque"]
    assert here.text("#designs [aria-pressed=true]") == f"Design A {first['label']}"
    here.page.locator("#start").select_option(first["name"])  # once more: the preload of the need stays
    here.page.locator("#start").dispatch_event("change")
    assert here.settle().numbers()["results"]["screw_torque"] == torque
    here.page.locator("#undo").click()
    here.page.locator("#undo").click()
    here.page.wait_for_function("(name) => document.querySelector('#start').value !== name", arg=first["name"])
    here.settle()

    file = {"name": "own.csv", "mimeType": "text/csv", "buffer": OWN.encode()}
    here.page.locator("#open-file").set_input_files(file)
    here.page.wait_for_selector("#choose label >> text=own.csv")
    # words of rows would leave the only one out
    here.page.evaluate("location.hash = location.hash.replace(/rexroth[^%]*32x/, '')")
    here.settle()
    ask(here)
    assert "MINE" in rows.nth(0).inner_text()
    for name, typed in MASS.items():
        here.page.locator(f"#f-need-{name}").fill(typed)
    assert here.page.locator("#f-need-axial_load").is_disabled()
    ask(here)
    assert "there and back" in here.text("#choose-result")
    here.page.locator("#choose-result tbody button >> nth=0").click()
    here.page.wait_for_selector("#choose-result >> text=is design")
    assert here.settle().page.locator("#f-operation-axial_load").input_value() == "3922.66"  # its steady rise
    here.page.route("**/api/v1/jobs/select", lambda route: None)  # one that takes long
    here.page.locator("#f-need-mass").fill("410 kg")  # or the answer is there already
    here.page.locator("#choose-start").click()
    here.page.locator("#choose .card-line button").click()
    here.page.wait_for_selector("#choose .card-line >> text=Cancelled")
    here.page.unroute("**/api/v1/jobs/select")


def test_a_selection_of_another_need_is_not_resumed(visit):
    """The card showed the candidates of what was asked, beside the need that had been changed since."""
    here = visit()
    texts = {**MASS, "feed": "24 m/min", "nut": "double", "preload": "5 %", "running_time": "5000 h",
             "unsupported_length": "1 m", "ends": "fixed-supported"}  # fmt: skip
    need = {"texts": texts, "units": {}, "rest": {"need": {"rows": "hiwin-40-20k4"}}}
    here.open(f"#band=0&view=choose&need={urllib.parse.quote(json.dumps(need))}")
    page = here.page
    page.wait_for_selector("#choose-start")
    # of two clicks the second one counts
    page.locator("#choose-start").evaluate("(one) => { one.click(); one.click(); }")
    page.wait_for_selector("#choose [role=status]")
    assert "Cancelled" not in here.text("#choose .card-line")
    page.reload()
    page.wait_for_selector("#choose-result tbody tr")  # the same need: its candidates are there again
    here.settle()
    page.locator("#f-need-running_time").fill("6000 h")
    here.rest(500)
    page.reload()
    page.wait_for_selector("#choose-start")
    page.wait_for_function("() => !sessionStorage.getItem('ballscrew.job.select')")
    assert page.locator("#choose-result tbody tr").count() == 0
