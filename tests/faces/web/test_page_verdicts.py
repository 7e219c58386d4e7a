"""What the page says of a screw: one verdict, in one language."""

import json
import re
import tomllib
import urllib.parse

from .conftest import ROOT

#: A screw that its operating point would wear out, and its cycle does not.
MOVING = "#A=vertical-axis&band=0&view=duty"
RECORDS = (
    "#verdicts p, #rules p, #duty [data-record], #checks .verdict, #duty .card-result > div .verdict, "
    "#warm-up [data-record]"
)


def in_german(here, fragment):
    here.page.context.add_cookies([{"name": "ballscrew-language", "value": "de", "url": here.address}])
    return here.open(fragment)


def test_one_verdict_where_a_cycle_is_given(visit):
    """Item 19: the headline failed the operating point for ever, the card of the cycle held all checks."""
    here = visit().open(MOVING)
    here.page.wait_for_selector("#duty [data-check=motor_speed]", state="attached")
    assert "Over the cycle: All 11 checks hold." in here.text("#summary")
    assert "Fails" not in here.text("main")
    assert here.text("#checks .verdict") == "Over the cycle: All 11 checks hold."
    assert here.page.locator("#checks [data-check=motor_speed]").count() == 1
    here.go("duty.axis").page.locator("#f-motor-rated_torque").fill("2")
    here.page.wait_for_selector("#summary:has-text('Over the cycle: Fails: RMS torque of the motor.')")
    assert here.text("#checks .verdict") == "Over the cycle: Fails: RMS torque of the motor."


def test_safety_in_german(visit):
    """Item 21: "a brake is needed: 24.97 N m" stood beside "27,4 N·m"."""
    here = visit()
    try:
        in_german(here, "#A=vertical-axis&band=0&view=duty&A.lubricant.temperature=-5+degC")
        here.page.wait_for_selector("#duty [data-record='verdict.brake']", state="attached")
        here.go("heat.end")
        here.page.wait_for_selector("#warm-up [data-record]")
        brake = here.text("#duty [data-record='verdict.brake']")
        assert re.search(
            r"^Fällt bei abgeschaltetem Motor \(in allen Zuständen\), .* eine Bremse ist nötig: 24,97 N·m", brake
        )
        assert here.text("#duty [data-record='verdict.motor']").startswith("Der Motor reicht")
        assert "Mangelschmierung" in here.text("#verdicts")
        assert "nach den Regeln der Hersteller: HIWIN, ihr Hersteller, " in here.text("#rules")
        assert "widersprechen einander hier um den Faktor" in here.text("#rules")
        records = here.page.locator(RECORDS).all()
        assert len(records) > 8
        for one in records:
            words = one.inner_text().replace("\u00a0", " ")
            assert one.get_attribute("lang") is None, words
            assert one.locator("[lang=en]").count() == 0, words
            assert not re.search(r"\d\.\d| N m\b|\bthe\b|\bload\b", words), words
    finally:
        here.page.context.clear_cookies()


def test_the_headline_of_a_cold_axis_whose_load_drives(visit, ballscrew):
    """Its efficiency is known, and its torque lies above its own band, which is said."""
    path = ROOT / "examples" / "cold_axis" / "grade.toml"
    answer = json.loads(ballscrew("run", str(path), "--band", "--json").stdout)
    results, band = answer["results"], answer["band"]["screw_torque"]
    tables = json.dumps({"losses": None, **tomllib.loads(path.read_text(encoding="utf-8"))})
    here = visit().open("#" + urllib.parse.urlencode({"A": "paper", "A.tables": tables, "band": "1"}))
    here.page.wait_for_selector("#numbers .interval:text-matches('to')")
    assert results["efficiency"] is None
    assert f"efficiency {results['back_driving_efficiency']:.4g} (the load drives)" in here.text("#summary")
    assert ("above its band" in here.text("#summary")) == (results["screw_torque"] > band["high"])
