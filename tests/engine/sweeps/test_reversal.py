"""A reversal as a dataset: the numbers of the physics, with names, units and sources."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.sweeps.sweep import PARTS, dataset_of
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.moving_balls.reversal import LOSSES, MECHANISMS, reversal
from support.reversals import closed_form

REFERENCE = bs.FrictionModel.reference()
POINT = {"axial_load": 2000.0, "screw_speed": 1.0}


@pytest.fixture(scope="module")
def found():
    return bs.reversal(REFERENCE, SCREW, OIL, **POINT, travel=2e-5)


def test_the_numbers_are_those_of_the_physics(found):
    alone = reversal(REFERENCE, SCREW, OIL, **POINT, travel=2e-5)
    assert np.array_equal(found["screw_angle"], alone.screw_angle)
    for name in ("travel", "screw_torque"):
        assert np.array_equal(found[name], getattr(alone, name))
    for name, values in alone.contributions.items():
        assert np.array_equal(found[f"contribution_{name}"], values)
        assert float(found[f"steady_contribution_{name}"]) == alone.steady_contributions[name]
    assert float(found["steady_torque"]) == alone.steady_torque
    assert np.array_equal(found["displacement"], alone.displacement)


def test_parts_sum_to_the_torque(found):
    parts = [found[name] for name in found if str(name).startswith("contribution_")]
    assert sum(parts).to_numpy() == pytest.approx(found["screw_torque"].to_numpy(), abs=1e-14)
    steady = [float(found[name]) for name in found if str(name).startswith("steady_contribution_")]
    assert sum(steady) == pytest.approx(float(found["steady_torque"]), rel=1e-12)


def test_travel_is_lead_times_angle(found):
    angles = found["screw_angle"].to_numpy()
    assert found["travel"].to_numpy() == pytest.approx(angles * SCREW.lead / (2 * math.pi), rel=1e-14)
    assert np.all(np.diff(angles) > 0)


def test_everything_has_a_name_a_unit_and_sources(found):
    for name in [*found.variables]:
        assert found[name].attrs["long_name"], name
        assert found[name].attrs["units"] in ("rad", "rad/s", "m", "N", "N m"), name
    assert found["screw_angle"].dims == ("screw_angle",)
    assert found.attrs["source"].endswith("model reference")
    assert "Olaru" in found.attrs["references"]
    assert "hypothesis" in found.attrs["comment"]
    assert found.attrs["start"] == "after a reversal"
    assert float(found["axial_load"]) == 2000.0


def test_every_part_has_words():
    assert PARTS.keys() == {*MECHANISMS, LOSSES}


def test_what_it_is_of_is_said():
    """Numbers that no ball screw has are said, as in a sweep."""
    subject = Configuration(REFERENCE, SCREW, OIL)
    rested = dataset_of(subject, closed_form(from_rest=True), POINT)
    assert rested.attrs["start"] == "from rest"
    assert float(rested["screw_torque"][0]) == 0
    assert "warnings" not in rested.attrs
    fast = dataset_of(subject, closed_form(), {"axial_load": 2000.0, "screw_speed": 1e4})
    assert "speed of the screw" in fast.attrs["warnings"]


def test_units_are_taken():
    quantity = units.registry().Quantity
    with_units = bs.reversal(
        REFERENCE, SCREW, OIL, axial_load=quantity(2, "kN"), screw_speed=quantity(60, "deg/s"), travel=quantity(1, "um")
    )
    plain = bs.reversal(REFERENCE, SCREW, OIL, axial_load=2000.0, screw_speed=math.pi / 3, travel=1e-6)
    assert with_units["screw_torque"].to_numpy() == pytest.approx(plain["screw_torque"].to_numpy(), rel=1e-12)


@pytest.mark.parametrize(
    ("changes", "where"),
    [
        ({"screw_speed": 0.0}, "operation.screw_speed"),
        ({"travel": 0.0}, "reversal.travel"),
        ({"axial_load": np.array([1.0, 2.0])}, "operation.axial_load"),
        ({"gap": -1.0}, "reversal.gap"),
    ],
)
def test_what_is_refused(changes, where):
    with pytest.raises(InputError) as error:
        bs.reversal(REFERENCE, SCREW, OIL, **(POINT | changes))
    assert [fault.where for fault in error.value.faults] == [where]
