"""The card of files, walked through whole: open, name, save, open again, undo, and what stays in the browser."""

import json
import tomllib

import pytest

from .conftest import Visit
from .test_page_access import SIZES, violations

pytestmark = pytest.mark.slow

MINE = """# of the shop
[screw]
catalogue = "rexroth-16x5x3-4-double"
contact_angle = "45 ± 2 deg"   # measured

[nut]
type = "double"
preload = "7 %"

[losses.seals]
seal_torque = "0.05 N m"

[model.rolling]
law = "houpert"

[lubricant]
grade = "ISO VG 68"
temperature = "40 degC"

[operation]
axial_load = "2 kN"
screw_speed = "300 rpm"

[axis]
mass = "40 kg"

[motion]
kind = "segments"
acceleration = "0.5 g"

[[motion.segment]]
distance = "500 mm"
speed = "30 m/min"

[[motion.segment]]
distance = "-500 mm"
speed = "30 m/min"

[shop]
bins = [7, 8]
"""
WRONG = MINE.replace('"2 kN"', '"2 furlong"').replace("[nut]", '[nut]\ncolour = "red"')


def values(here):
    return here.page.evaluate(
        "Object.fromEntries([...document.querySelectorAll('#form [data-path]')]"
        ".map((one) => [one.dataset.path, one.querySelector('input, select').value]))"
    )


def given(here, name, content):
    """Open a file as somebody does who chooses it."""
    here.page.evaluate("document.querySelector('#notice').textContent = ''")
    here.page.locator("#open-file").set_input_files({"name": name, "mimeType": "", "buffer": content})
    here.page.wait_for_function("() => document.querySelector('#notice').textContent")
    return here.settle().text("#notice")


def toml(here):
    content = here.download("#downloads button:text-is('TOML')")
    here.page.wait_for_selector("#download-words >> text=TOML saved", state="attached")
    return content


def test_files_and_designs(visit):
    here = visit(expected=("status of 422",)).open()
    said = given(here, "mine.toml", MINE.encode())
    assert "mine.toml is open: design A." in said  # nobody had touched the first one
    assert "2 comments" in said
    assert "not computed with" in said
    assert "shop" in said
    assert here.page.locator("#start").input_value() == "rexroth-16x5x3-4-double"
    assert here.page.locator("#f-screw-contact_angle").input_value() == "45 ± 2 deg"
    first = toml(here)
    tables = tomllib.loads(MINE)  # with those that the form does not show
    shop = tables.pop("shop")
    assert tomllib.loads(first.decode()) == {**tables, "aside": {"shop": shop}}
    numbers, fields = here.numbers(), values(here)
    given(here, "again.toml", first)
    assert here.page.locator("#design-B").get_attribute("aria-pressed") == "true"
    assert (here.numbers(), values(here), toml(here)) == (numbers, fields, first)

    here.go("handover.files")
    here.page.locator("#name-B").fill("lighter oil")
    here.settle().choose("lubricant.grade", "ISO VG 32")
    lighter = here.numbers()
    assert lighter != numbers
    here.rest(500)
    project = here.download("#files button:text-is('Project as TOML')")
    saved = tomllib.loads(project.decode())
    assert saved["ballscrew_project"] == 1
    assert [one["name"] for one in saved["designs"]] == ["A rexroth-16x5x3-4-double", "lighter oil"]
    assert saved["designs"][1]["case"]["lubricant"]["grade"] == "ISO VG 32"
    here.page.locator("#files [aria-label='Delete B']").click()
    here.settle()
    assert here.page.locator("#design-B").count() == 0
    here.page.locator("#undo").click()
    here.page.wait_for_selector("#design-B")
    assert here.settle().page.locator("#name-B").input_value() == "lighter oil"

    there = visit(**SIZES["phone"]).open("#band=0&view=handover.files")
    given(there, "all.toml", project)
    there.page.locator("#design-B").click()
    assert there.settle().numbers() == lighter
    assert "lighter oil" in there.text("#design-B")
    assert violations(there) == []
    nine = {"ballscrew_project": 1, "designs": [{**saved["designs"][0], "name": f"no {k}"} for k in range(9)]}
    assert "holds 8 designs. There was no place for no 6, no 7, no 8." in given(
        there, "9.json", json.dumps(nine).encode()
    )
    assert there.page.locator("#add").is_disabled()
    future = json.dumps({**saved, "ballscrew_project": 9}).encode()
    there.expected = here.expected
    assert "unknown version (9)" in given(there, "future.json", future)

    assert "is open" in given(here, "wrong.toml", WRONG.encode())
    field = here.page.locator("[data-path='operation.axial_load']")
    assert "furlong" in field.locator(".fault").inner_text()
    here.type("operation.axial_load", "2 kN")
    here.page.locator("#faults button:text-is('Keep it aside')").click()
    assert here.settle().numbers() == numbers
    assert tomllib.loads(toml(here).decode())["aside"]["nut"] == {"colour": "red"}
    what_stays_in_the_browser(here)


def what_stays_in_the_browser(here):
    shown = here.numbers()
    here.rest(500)
    assert here.page.evaluate("Object.keys(localStorage).length") == 1
    other = Visit(here.page.context.new_page(), here.address)
    other.page.set_default_timeout(180_000)
    other.open("")  # another tab: the same work, which it does not write over
    assert "Your work of" in other.text("#notice")
    assert other.numbers() == shown
    other.type("operation.axial_load", "1 kN").rest(500)
    assert other.page.evaluate("Object.keys(localStorage).length") == 2
    changed = other.numbers()
    other.page.close()
    again = Visit(here.page.context.new_page(), here.address)
    again.page.set_default_timeout(180_000)
    again.open("")  # closed and opened: the last work, by its own name
    assert again.numbers() == changed
    again.type("operation.axial_load", "3 kN").rest(500)
    assert again.page.evaluate("Object.keys(localStorage).length") == 2
    kept = "Object.values(localStorage).map((one) => JSON.parse(one).fragment).sort()"
    works = again.page.evaluate(kept)
    again.page.locator("#kept-list button:text-is('Open'):enabled").click()
    assert again.settle().numbers() == shown
    again.rest(500)
    assert again.page.evaluate(kept) == works  # what was on the page before is still kept
    full = "() => { Storage.prototype.setItem = () => { throw new DOMException('', 'QuotaExceededError'); }; }"
    again.page.evaluate(full)
    again.type("operation.axial_load", "4 kN").rest(500)
    assert "storage of this browser is full" in again.text("#not-kept")
    here.page.wait_for_selector("#forget >> text=(2)")
    again.page.close()
    strict = Visit(here.page.context.new_page(), here.address)
    strict.page.set_default_timeout(180_000)
    strict.page.add_init_script(
        "for (const name of ['localStorage', 'sessionStorage']) Object.defineProperty(window, name,"
        " { get() { throw new DOMException('', 'SecurityError'); } });"
        "navigator.locks.request = () => Promise.reject(new DOMException('', 'SecurityError'));"
    )
    strict.open("")
    assert "does not let the page keep anything" in strict.text("#not-kept")
    strict.page.close()
    for _ in range(2):  # the second time is sure
        here.page.locator("#forget").click()
    assert here.page.evaluate("Object.keys(localStorage).length") == 0
    assert not here.page.locator("#forget").is_visible()


def test_a_need_and_a_table_are_there_before_their_card(visit):
    """They are part of the state: a card shows them once it is opened, and the need is in the address and undone."""
    here = visit().open("#A=paper&band=0")
    need = b'[need]\nforce = "2 kN"\nfeed = "15 m/min"\nlength = "1 m"\nends = "fixed-supported"\nlife = "9000 h"\n'
    assert "need.toml" in given(here, "need.toml", need)
    here.page.wait_for_function("() => location.hash.includes('need=')")
    assert "own.csv" in given(here, "own.csv", b"name,d0 [mm],lead [mm],ball [mm],turns,nut\nMINE,40,20,6,4,single\n")
    here.go("choose")
    here.page.wait_for_selector("#choose label >> text=own.csv")
    assert here.page.locator("#f-need-feed").input_value() == "15"
    here.page.locator("#undo").click()
    here.page.wait_for_function("() => !location.hash.includes('need=')")
    here.go("handover.files")
    here.page.wait_for_selector("#files li >> text=MINE")
