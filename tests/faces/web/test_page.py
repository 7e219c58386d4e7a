"""What the page shows is what the command line computes, in whatever units; its address holds all of it."""

import json
import re
import urllib.parse

import pytest
from typer.testing import CliRunner

from ballscrew.faces.cli.main import app
from ballscrew.physics.friction.balls import MECHANISMS

DOUBLE = "rexroth-40x10x6-6-double"
#: Of fewer balls: its band takes a second, and not two.
SMALL = "rexroth-16x5x3-4-double"


@pytest.fixture
def computed(tmp_path):
    """The results of the command line for the case file that the page gives."""

    def run(visit):
        path = tmp_path / "case.toml"
        path.write_bytes(visit.download("#downloads button:text-is('TOML')"))
        found = CliRunner().invoke(app, ["run", str(path), "--json"])
        assert found.exit_code == 0, found.output
        return json.loads(found.stdout)

    return run


def agree(visit, document):
    """Every number shown is that of the document, to the last bit."""
    shown, results = visit.numbers(), document["results"]
    parts = {MECHANISMS.get(name, name): value for name, value in results["contributions"].items() if value != 0}
    assert {"screw_torque", "drive_torque", "efficiency", "friction_power"} <= shown["results"].keys()
    assert shown["results"] == {name: results[name] for name in shown["results"]}
    assert len(shown["screw"]) >= 7
    assert shown["screw"] == {name: results["screw"][name] for name in shown["screw"]}
    assert shown["nut"] == {name: results["nut"][name] for name in shown["nut"]}
    assert shown["parts"] == {"sum": results["screw_torque"], **parts}
    return results


@pytest.mark.slow
def test_by_keyboard_alone(visit, computed):
    here = visit().open()
    keyboard = here.page.keyboard
    before = agree(here, computed(here))
    here.page.locator("#start").focus()
    keyboard.type(DOUBLE[:12])  # as people choose in a list
    here.settle()
    assert here.page.locator("#start").input_value().startswith("rexroth-40x10")
    keyboard.press("Tab")  # the summary of the section
    keyboard.press("Tab")
    assert here.page.evaluate("document.activeElement.id") == "f-operation-axial_load"
    keyboard.press("Control+A")
    keyboard.type("7500")
    for _ in range(3):  # the unit and the slider
        keyboard.press("Tab")
    assert here.page.evaluate("document.activeElement.id") == "f-operation-screw_speed"
    keyboard.press("Control+A")
    keyboard.type("500")
    keyboard.press("ArrowUp")
    keyboard.press("Shift+ArrowUp")
    here.settle()
    found = computed(here)
    assert found["inputs"]["operation"]["axial_load"] == 7500
    assert here.page.locator("#f-operation-screw_speed").input_value() == "610"
    after = agree(here, found)
    assert after["screw_torque"] != before["screw_torque"]


#: A row with another nut and load; and on the paper's screw a law with its coefficient, uncertain inputs, and inches.
CASES = {
    "double nut": [("start", DOUBLE), ("operation.axial_load", "7 kN"), ("nut.preload", "3 kN")],
    "fields of all kinds": [
        ("model.friction", "load-sharing"),
        ("model.friction.boundary_friction_coefficient", "0.11"),
        ("screw.screw_conformity", "0.54 ± 0.01"),
        ("screw.lead", "5 ± 0.01"),
        ("units", "inch"),
        ("operation.axial_load", "900"),
        ("lubricant.viscosity", "60"),
    ],
}


@pytest.mark.parametrize("case", CASES)
def test_shows_what_the_command_line_computes(visit, computed, case):
    here = visit().open()
    before = here.numbers()
    for field, text in CASES[case]:
        if field == "start":
            here.page.locator("#start").select_option(text)
            here.settle()
        elif field == "units":
            here.page.locator("#system").select_option(text)
        elif here.page.locator(here.id(field)).evaluate("one => one.localName") == "select":
            here.choose(field, text)
        else:
            here.type(field, text)
    agree(here, computed(here))
    assert here.numbers() != before


@pytest.mark.slow
def test_uncertain_input_and_its_band(visit, computed):
    here = visit().open()
    here.type("screw.screw_conformity", "0.54 ± 0.01").page.locator("#band").check()
    here.page.wait_for_selector("#band-words >> text=95 %")
    assert here.page.locator("#numbers .interval").count() >= 3
    assert computed(here)["inputs"]["screw"]["screw_conformity"] == 0.54
    here.type("operation.axial_load", "3000")  # the band before is not left standing
    here.page.wait_for_selector("#band-words >> text=computing")
    here.page.wait_for_selector("#band-words >> text=95 %")
    interval = here.text("#numbers [data-name=screw_torque] + .interval")
    low, high = re.search(r"([\d.]+) to ([\d.]+)", interval).groups()
    assert float(low) < here.numbers()["results"]["screw_torque"] < float(high)


# -- units ------------------------------------------------------------------------------------------


@pytest.mark.slow
def test_units_do_not_drift(visit):
    here = visit().open(f"#A={SMALL}&band=0")  # a band is asked for later, when the page rests
    here.type("operation.axial_load", "1234.5678901 N").page.keyboard.press("Tab")
    assert here.page.locator("#f-operation-axial_load").input_value() == "1234.5678901"  # its unit stands beside it
    here.type("lubricant.temperature", "40")
    before, numbers = here.values(), here.numbers()
    here.quiet()
    asked, address = here.posts(), here.page.url
    for _ in range(2):
        here.page.locator("#system").select_option("inch")
        assert here.page.locator("#f-operation-axial_load").input_value().startswith("277.5419")
        assert here.page.locator("#f-lubricant-temperature").input_value() == "104"
        assert here.numbers() == numbers
        for unit in ("kN", "lbf", "kgf", "N"):
            here.unit("operation.axial_load", unit)
        here.unit("lubricant.temperature", "degF")
        here.unit("lubricant.temperature", "K")
        here.page.locator("#system").select_option("metric")
        assert here.values() == before
    here.quiet()
    assert here.numbers() == numbers
    assert here.posts() == asked  # nothing of that needs the server
    assert here.page.url == address


@pytest.mark.slow
def test_numbers_are_in_the_units_chosen(visit):
    """Sentences of the server are those of the command line."""
    here = visit().open(f"#A={SMALL}&B=paper&band=0")
    metric = here.page.locator("main").inner_text()
    assert "lbf" not in metric.replace("lbf\n", "")
    here.page.locator("#system").select_option("inch")
    here.page.wait_for_selector("#said >> text=lbf·in", state="attached")
    for part in ("#summary", "#numbers", "#contacts", "#torque-chart", "#map-chart"):
        text = here.text(part)
        assert not re.search(r"\d (N|kN|N·m|mm|µm|MPa|GPa|°C)\b", text), text
    assert "psi" in here.text("#contacts")
    torque = here.numbers()["results"]["screw_torque"]
    assert f"{torque / 0.1129848290276167:.4g} lbf·in" in here.text("#summary")


# -- the address ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_the_address_restores_everything(visit):
    here = visit().open()
    here.type("operation.axial_load", "3.21 kN").choose("model.friction", "load-sharing")
    here.page.locator("#add").click()
    here.settle().page.locator("#start").select_option(SMALL)
    here.settle().type("nut.preload", "0.4 kN")
    here.unit("operation.screw_speed", "rev/s")
    here.page.locator("#band").check()
    here.page.wait_for_selector("#band-words >> text=95 %")
    here.rest(500)  # the address follows when typing rests
    bands = (
        "() => [...document.querySelectorAll('#compare td')].filter((one) => / to /.test(one.textContent)).length > 1"
    )
    here.page.wait_for_function(bands)
    there = visit().open(here.page.url.partition("/#")[2].join(["#", ""]))
    there.page.wait_for_selector("#band-words >> text=95 %")
    there.page.wait_for_function(bands)
    assert there.page.locator("#design-B").get_attribute("aria-pressed") == "true"
    assert there.values() == here.values()
    assert there.numbers() == here.numbers()
    assert there.text("#compare") == here.text("#compare")
    assert there.text("#band-words") == here.text("#band-words")
    assert there.page.locator("#u-operation-screw_speed").input_value() == "rev/s"


@pytest.mark.slow
def test_back_and_forward(visit):
    here = visit().open()
    first = here.numbers()
    here.page.locator("#start").select_option(SMALL)
    second = here.settle().numbers()
    here.page.locator("#add").click()
    here.settle().type("operation.axial_load", "5000")
    third = here.numbers()
    here.rest(500)
    for before in (second, second, first):  # without what was typed, without the other design, without the row
        here.page.go_back()
        assert here.settle().numbers() == before
    for _ in range(3):
        here.page.go_forward()
        here.settle()
    assert here.settle().numbers() == third
    assert here.page.locator("#f-operation-axial_load").input_value() == "5000"


@pytest.mark.slow
def test_typing_does_not_flood_the_history(visit):
    here = visit().open()
    # counted by itself: a browser keeps 50 entries, of the pages before as well
    here.page.evaluate(
        """() => {
          window.pushed = 0;
          const push = history.pushState.bind(history);
          history.pushState = (...all) => { window.pushed += 1; push(...all); };
        }"""
    )
    field = here.page.locator("#f-operation-axial_load")
    field.focus()
    for _ in range(250):  # a key held down; browsers complain of 200 addresses written in 10 s
        here.page.keyboard.press("ArrowUp")
    here.settle()
    here.rest(500)
    assert here.page.evaluate("pushed") == 1  # one entry for all of it
    load = field.input_value()
    assert float(load) > 10_000
    assert f"A.operation.axial_load={load}+N" in here.page.url
    assert here.numbers()["results"] == visit().open(f"#A=paper&A.operation.axial_load={load}+N").numbers()["results"]


NONSENSE = {
    "unknown start": ("#A=no-such-screw", "The link starts from no-such-screw, not known here"),
    "prototype": (
        "#A=paper&A.__proto__.polluted=1&A.constructor.polluted=1&A.operation.constructor=1&units=constructor",
        "left out: A.__proto__.polluted, A.constructor.polluted, A.operation.constructor",
    ),
    "unknown unit": ("#A=paper&unit.operation.axial_load=furlong", "left out: unit.operation.axial_load"),
    "script": ("#A=<script>window.hurt=1</script>&A.<img src=x onerror=hurt=1>=1", "<script>window.hurt=1</script>"),
    "long": (f"#A={'x' * 100_000}&{'y' * 100_000}=1&z=1&z=2&z=3&z=4", "…"),
}  # fmt: skip


def test_nonsense_in_a_link_does_no_harm(visit, server):
    """One after the other: the page is loaded once."""
    plain = server.post("run", {"case": server.get("vocabulary").json()["starts"]["paper"]["case"]}).json()
    here = visit()
    for link, words in NONSENSE.values():
        a_link_does_no_harm(here.open(f"{link}&band=0"), words, plain)


def a_link_does_no_harm(here, words, plain):
    here.page.wait_for_function("(words) => document.querySelector('#notice').textContent.includes(words)", arg=words)
    here.settle()
    assert len(here.text("#notice")) < 500
    agree(here, plain)
    assert here.page.evaluate("[window.hurt, {}.polluted, Object.polluted, document.images.length]") == [
        None,
        None,
        None,
        0,
    ]
    here.type("operation.axial_load", "1000")  # and the page goes on
    assert here.numbers()["results"]["screw_torque"] < plain["results"]["screw_torque"]


TEXTS = ["<script>window.hurt = 1</script>", "__proto__", "1e400 N", "9" * 3000, "\u202e5 N", "5 N; rm"]


@pytest.mark.slow
def test_nonsense_typed_into_a_field_is_refused_in_words(visit):
    here = visit(
        expected=(
            "status of 422",
            "status of 413",
        )
    ).open("#A=paper&band=0")
    for text in TEXTS:
        here.type("operation.axial_load", text)
        here.page.wait_for_selector("#faults p")
        assert here.page.evaluate("window.hurt") is None
        here.type("operation.axial_load", "1000")
        assert here.page.locator("#faults p").count() == 0


def test_nonsense_in_a_field_is_refused_in_words(visit):
    here = visit(expected=("status of 422",)).open(
        f"#A=paper&A.operation.axial_load={urllib.parse.quote(TEXTS[0])}&band=0"
    )
    assert here.text("#faults").strip()
    assert here.page.evaluate("window.hurt") is None
    here.type("operation.axial_load", "1000")
    assert here.page.locator("#faults p").count() == 0


# -- designs ----------------------------------------------------------------------------------------


def compared(here):
    """The numbers of the table, by design."""
    return here.page.evaluate(
        """() => { const rows = [...document.querySelectorAll("#compare tbody tr")]; const found = {};
          [...document.querySelectorAll("#compare thead th")].forEach((head, place) => {
            const cells = rows.map((row) => row.children[place + 1].querySelector("data"));
            found[head.textContent] = Object.fromEntries(cells
              .filter((one) => one && one.value !== "").map((one) => [one.dataset.name, Number(one.value)])); });
          return found; }"""
    )


@pytest.mark.slow
def test_three_and_four_designs(visit, computed):
    here = visit().open(f"#A=paper&B={SMALL}&C=hiwin-40-16k5&show=C&at=own&band=0")
    here.page.locator("#add").click()
    here.settle().page.locator("#start").select_option(SMALL)
    here.settle().type("operation.axial_load", "2.5 kN")
    table = compared(here)
    assert list(table) == ["Design A", "Design B", "Design C", "Design D"]
    for letter in "ABCD":
        here.page.locator(f"#design-{letter}").click()
        results = agree(here.settle(), computed(here))
        assert len(table[f"Design {letter}"]) >= 5
        for name, value in table[f"Design {letter}"].items():
            assert value == results[name], (letter, name)
    here.page.locator("#design-B").click()
    here.settle().page.locator("#remove").click()
    assert compared(here.settle()) == {
        "Design A": table["Design A"],
        "Design B": table["Design C"],
        "Design C": table["Design D"],
    }
    for _ in range(2):
        here.page.locator("#remove").click()
        here.settle()
    assert here.page.locator("#remove").is_disabled()
    assert here.page.evaluate("document.activeElement.id") == "design-A"  # focus is not lost with the button
    assert not here.page.locator("#compare table").count()


def test_one_design_at_fault_does_not_spoil_the_others(visit):
    here = visit(expected=("status of 422",)).open(
        "#A=paper&B=paper&B.screw.lead=nonsense&C=hiwin-40-16k5&show=A&band=0"
    )
    table = compared(here)
    assert table["Design B"] == {}
    assert table["Design A"]["screw_torque"] == here.numbers()["results"]["screw_torque"]
    assert "lead (Screw)" in here.text("#compare")
    assert not here.page.locator("#faults p").count()
