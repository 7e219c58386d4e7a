"""The answer of a band: declared once, and the same on every face."""

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import case_file
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band import compute, document
from ballscrew.questions.band.answer import BandResults
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.run.compute import run
from ballscrew.questions.shared import declared
from support.answers import undescribed
from support.commands import ROOT


@pytest.fixture(scope="module")
def answer():
    case = case_file.load(ROOT / "examples" / "olaru2005.toml")
    report = compute.band(case, BandOptions(samples=64))
    return plain(document.document(run(case), report))


def test_every_output_is_on_every_face(answer):
    described, known = declared.schema(BandResults).model_json_schema()["properties"], quantities_of(FrictionResult)
    for name in BAND_OUTPUTS:
        one = answer["band"][name]
        assert one["low"] <= one["median"] <= one["high"]
        assert answer["units"]["band"][name] == known[name].unit == described[name].get("x-si-unit", "1")
        assert described[name]["description"].startswith(known[name].info.meaning)


def test_a_band_is_valid_by_its_schema(answer):
    declared.schema(BandResults).model_validate(answer["band"])
    assert any("reason" in one for one in answer["band"]["inputs"].values())
    assert any(answer["band"]["laws"].values())


def test_every_part_is_described():
    assert list(undescribed(BandResults)) == []
