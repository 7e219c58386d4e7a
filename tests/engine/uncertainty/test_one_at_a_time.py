"""Swings of a tornado: the model at the ends of each input, and nothing else."""

import dataclasses

import pytest

import ballscrew as bs
from ballscrew.engine.uncertainty.sensitivity import one_at_a_time

MODEL = bs.FrictionModel.reference()
SCREW = bs.catalogue()["hiwin-40-20k4"].screw()
OIL = bs.Lubricant.from_grade("ISO VG 100")
POINT = {"axial_load": 5000.0, "screw_speed": 60.0}


def test_a_swing_is_the_model_at_both_ends_of_one_input():
    uncertain = {
        "screw_conformity": bs.Uniform(0.52, 0.56),
        "friction.boundary_friction_coefficient": bs.Normal(0.12, 0.02),
        "axial_load": bs.Normal(5000.0, 100.0),
    }
    found = {swing.input: swing for swing in one_at_a_time(MODEL, SCREW, OIL, uncertain=uncertain, **POINT)}

    def torque(screw=SCREW, model=MODEL, **changes):
        return float(model(screw, OIL, **{**POINT, **changes}).screw_torque)

    ends = [0.52 + 0.04 * share for share in (0.025, 0.975)]
    swing = found["screw_conformity"]
    expected = [torque(dataclasses.replace(SCREW, screw_conformity=end)) for end in ends]
    assert [swing.at_lower, swing.at_upper] == pytest.approx(expected, rel=1e-9)
    ends = [0.12 + 0.02 * number for number in (-1.959963985, 1.959963985)]
    swing = found["friction.boundary_friction_coefficient"]
    expected = [
        torque(
            model=dataclasses.replace(
                MODEL, friction=dataclasses.replace(MODEL.friction, boundary_friction_coefficient=end)
            )
        )
        for end in ends
    ]
    assert [swing.at_lower, swing.at_upper] == pytest.approx(expected, rel=1e-9)
    swing = found["axial_load"]
    expected = [torque(axial_load=5000.0 + 100 * number) for number in (-1.959963985, 1.959963985)]
    assert [swing.at_lower, swing.at_upper] == pytest.approx(expected, rel=1e-9)


def test_the_widest_comes_first_and_nothing_uncertain_has_no_swing():
    uncertain = {"axial_load": bs.Normal(5000.0, 1.0), "screw_conformity": bs.Uniform(0.52, 0.56)}
    found = one_at_a_time(MODEL, SCREW, OIL, uncertain=uncertain, **POINT)
    assert [swing.input for swing in found] == ["screw_conformity", "axial_load"]
    assert found[0].ends[1] - found[0].ends[0] == found[0].width
    assert one_at_a_time(MODEL, SCREW, OIL, uncertain={}, **POINT) == ()
