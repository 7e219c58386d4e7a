"""The tables by size and by law of friction that the pages show: which rows and which models are in them."""

import math
import sys
from pathlib import Path

import pytest

import ballscrew as bs
from ballscrew.evidence.validation.entries import Conditions
from ballscrew.physics.laws.friction import RunInSharing

BENCHMARKS = Path(__file__).parents[3] / "benchmarks"


@pytest.fixture(scope="module")
def script():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(BENCHMARKS)
        import fit_calibration

        yield fit_calibration
        del sys.modules["fit_calibration"]


def cells(table):
    return [[cell.strip() for cell in line.strip("| \n").split("|")] for line in table.splitlines()]


@pytest.mark.slow
def test_each_row_is_in_one_size_class(script):
    _, _, *lines = cells(script.strata_table())
    counted = {line[0]: int(line[1]) for line in lines}
    for name, number in (("rexroth-double-nut", 24), ("rexroth-single-nut", 18)):
        assert counted[f"{name}, all"] == number
        assert sum(counted[f"{name}, {words}"] for words in script.CLASSES) == number


def test_the_default_among_the_laws_is_the_reference_model(script):
    (words,) = (name for name in script.LAWS if name.endswith("(the default)"))
    model = script.LAWS[words]({})
    assert model == bs.FrictionModel.reference()
    assert model.friction == RunInSharing()


def test_a_constant_share_mixes_boundary_and_film(script):
    conditions = type("Conditions", (), {"film_parameter": 2.0})
    assert script.ConstantShare(1.0)(conditions) == pytest.approx(0.12)
    assert script.ConstantShare(0.0)(conditions) == pytest.approx(0.05)
    assert script.CappedShare(0.35)(conditions) < script.ConstantShare(0.35)(conditions)  # a thick film carries more


def test_the_weighting_factor_by_hand(script):
    """SKF2018: 2.6e-8 (100 rpm · 100 mm²/s)^1.4 · 40 mm = 0.414."""
    at = Conditions(viscosity=100e-6 * bs.Lubricant(viscosity=0.1).density)
    screw = bs.catalogue()["rexroth-40x10x6-6-double"].screw(pitch_circle_diameter=0.04)
    assert -math.log(script.weighting_factor(screw, at)) == pytest.approx(0.41403146, rel=1e-7)
