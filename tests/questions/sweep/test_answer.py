"""The answer of a sweep: declared once, and the same on every face."""

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.cases.case_files import case_file
from ballscrew.questions.band.options import BandOptions
from ballscrew.questions.shared import declared
from ballscrew.questions.sweep import band, compute, document
from ballscrew.questions.sweep.answer import SweepResults
from support.answers import undescribed
from support.commands import ROOT

CASE = case_file.load(ROOT / "examples" / "olaru2005.toml")
AXES = ("axial_load=1:4:3 kN", "screw_speed=10,100 rpm")


@pytest.mark.parametrize("banded", [False, True], ids=["alone", "with bands"])
def test_every_output_is_in_the_document_as_it_is_in_the_dataset(banded):
    plan = compute.plan(CASE, AXES, ("efficiency", "screw_torque"), None, banded=banded)
    dataset = compute.sweep(CASE, plan)
    if banded:
        dataset = band.with_band(CASE, plan, dataset, BandOptions(samples=16))
    answer = plain(document.document(CASE, plan, dataset))
    declared.schema(SweepResults).model_validate({name: answer[name] for name in ("axes", "outputs")})
    assert list(answer["axes"]) == ["axial_load", "screw_speed"]
    for name in ("efficiency", "screw_torque", "valid"):
        assert answer["outputs"][name]["values"] == dataset[name].to_numpy().tolist()
        assert answer["outputs"][name]["unit"] == plan.quantities[name].unit
        assert answer["outputs"][name]["meaning"] == plan.quantities[name].info.meaning
        for end in ("low", "high"):
            assert (end in answer["outputs"][name]) == banded
            assert not banded or answer["outputs"][name][end] == dataset[f"{name}_{end}"].to_numpy().tolist()
    assert answer.get("band") == ({"level": 0.95, "samples": 16, "seed": 0} if banded else None)


def test_every_part_is_described():
    assert list(undescribed(SweepResults)) == []
