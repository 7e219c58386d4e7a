"""The answer of a band: declared once, and the same on every face."""

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.named_calibration import by_rules
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band import BandOptions, compute
from ballscrew.questions.band.answer import BandResults, document, verdicts
from ballscrew.questions.run import answer as answer_of_run
from ballscrew.questions.run.compute import run
from ballscrew.questions.shared import schemas
from support.commands import ROOT


@pytest.fixture(scope="module")
def answer():
    case = case_file.load(ROOT / "examples" / "olaru2005.toml")
    report = compute.band(case, BandOptions(samples=64))
    return plain(document(run(case), report))


def test_every_output_is_on_every_face(answer):
    described, known = schemas.schema(BandResults).model_json_schema()["properties"], quantities_of(FrictionResult)
    for name in BAND_OUTPUTS:
        one = answer["band"][name]
        assert one["low"] <= one["median"] <= one["high"]
        assert answer["units"]["band"][name] == known[name].unit == described[name].get("x-si-unit", "1")
        assert described[name]["description"].startswith(known[name].info.meaning)


def test_a_band_is_valid_by_its_schema(answer):
    schemas.schema(BandResults).model_validate(answer["band"])
    assert any("reason" in one for one in answer["band"]["inputs"].values())
    assert any(answer["band"]["laws"].values())


def test_a_band_stands_beside_the_answer_of_the_run(answer):
    """Which it leaves as it is; its verdicts come after those of the run."""
    alone = plain(answer_of_run.document(run(case_file.load(ROOT / "examples" / "olaru2005.toml"))))
    assert answer["results"] == alone["results"]
    assert answer["verdicts"][: len(alone["verdicts"])] == alone["verdicts"]


@pytest.mark.slow
@pytest.mark.parametrize("preload", ["4326 N", "40 N"])
def test_without_load_each_rule_is_within_the_band_or_not(preload):
    """Rules have neither seals nor other losses, which the band has."""
    settings = [f"nut.preload={preload}", "losses.seals.seal_torque=0.3 N m"]
    case = case_file.load(ROOT / "examples" / "service.toml", [*settings, "operation.axial_load=0 N"])
    report = compute.band(case, BandOptions(samples=64))
    low, high = report.band["screw_torque"].both
    found = {one.id: one for one in verdicts(case, report) if one.id.startswith("band.rule_")}
    assert found.keys() == {"band.rule_jis", "band.rule_rexroth", "band.rule_hiwin"}
    for one in by_rules(case):
        record = found[f"band.rule_{one.rule.name}"]
        assert record.value == pytest.approx(one.torque + 0.3, rel=1e-9)
        assert record.holds == (low <= record.value <= high) == record.text.endswith("within the band")
    loaded = case_file.load(ROOT / "examples" / "service.toml", [*settings, "operation.axial_load=1 kN"])
    told = verdicts(loaded, compute.band(loaded, BandOptions(samples=64)))
    assert not [one.id for one in told if one.id.startswith("band.rule_")]
