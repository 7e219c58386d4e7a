"""The answer of a sweep: declared once, and the same on every face."""

import pytest

from ballscrew import evaluator
from ballscrew.basis.output.json_text import plain
from ballscrew.cases.case_files import case_file
from ballscrew.engine.evaluation.recordings import KNOWN
from ballscrew.questions.band import BandOptions
from ballscrew.questions.shared import schemas
from ballscrew.questions.sweep import band, compute
from ballscrew.questions.sweep.answer import SweepResults, document
from support.commands import ROOT
from support.structures import forget_structures

CASE = case_file.load(ROOT / "examples" / "olaru2005.toml")
AXES = ("axial_load=1:4:3 kN", "screw_speed=10,100 rpm")


@pytest.mark.parametrize("banded", [False, True], ids=["alone", "with bands"])
def test_every_output_is_in_the_document_as_it_is_in_the_dataset(banded):
    plan = compute.plan(CASE, AXES, ("efficiency", "screw_torque"), None, banded=banded)
    dataset = compute.sweep(CASE, plan)
    if banded:
        dataset = band.with_band(CASE, plan, dataset, BandOptions(samples=16))
    answer = plain(document(CASE, plan, dataset))
    schemas.schema(SweepResults).model_validate({name: answer[name] for name in ("axes", "outputs")})
    assert list(answer["axes"]) == ["axial_load", "screw_speed"]
    for name in ("efficiency", "screw_torque", "valid"):
        assert answer["outputs"][name]["values"] == dataset[name].to_numpy().tolist()
        assert answer["outputs"][name]["unit"] == plan.quantities[name].unit
        assert answer["outputs"][name]["meaning"] == plan.quantities[name].info.meaning
        for end in ("low", "high"):
            assert (end in answer["outputs"][name]) == banded
            assert not banded or answer["outputs"][name][end] == dataset[f"{name}_{end}"].to_numpy().tolist()
    assert answer.get("band") == ({"level": 0.95, "samples": 16, "seed": 0} if banded else None)


@pytest.mark.compiles
@pytest.mark.parametrize("name", ["map.nc", "map.csv"])
def test_no_bit_of_a_file_depends_on_the_kernels_that_are_kept(monkeypatch, tmp_path, name):
    forget_structures(monkeypatch, tmp_path / "cache")
    to = tmp_path / name
    plan = compute.plan(CASE, AXES, ("efficiency", "screw_torque"), to)
    before = compute.sweep(CASE, plan, to=to)
    banded = band.with_band(CASE, plan, before, BandOptions(samples=64), recorded=True)
    assert evaluator(CASE.model, CASE.screw, CASE.lubricant).engine_reason == KNOWN
    band.with_band(CASE, plan, before, BandOptions(samples=4096))  # so many that a kernel is compiled
    assert compute.sweep(CASE, plan, to=to).identical(before)
    assert band.with_band(CASE, plan, before, BandOptions(samples=64), recorded=True).identical(banded)
