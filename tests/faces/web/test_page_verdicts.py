"""What the page says of a screw: one verdict."""

import json
import tomllib
import urllib.parse

import pytest

from .conftest import ROOT

pytestmark = pytest.mark.slow

#: A screw that its operating point would wear out, and its cycle does not.
MOVING = "#A=vertical-axis&band=0&view=duty"


def test_one_verdict_where_a_cycle_is_given(visit):
    """Item 19: the headline failed the operating point for ever, the card of the cycle held all checks."""
    here = visit().open(MOVING)
    here.page.wait_for_selector("#duty .sheet tr:has-text('motor speed')", state="attached")
    assert "Over the cycle: All 11 checks hold." in here.text("#summary")
    assert "Fails" not in here.text("main")
    assert here.text("#checks .verdict") == "Over the cycle: All 11 checks hold."
    assert here.page.locator("#checks [data-check=motor_speed]").count() == 1
    here.go("duty").page.locator("#f-motor-rated_torque").fill("2")
    here.page.wait_for_selector(
        "#summary:has-text('Over the cycle: Fails: RMS torque of the motor.')", state="attached"
    )
    assert here.text("#checks .verdict") == "Over the cycle: Fails: RMS torque of the motor."


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
