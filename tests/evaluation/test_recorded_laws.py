"""Laws of the user's in a sweep: recorded where that works, on plain arrays where not, and always right."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.analyses.outputs import known_outputs

LAWS = {
    "the root of a square": lambda lam, conditions, full_film: 0.1 * np.sqrt((lam - 1) ** 2),
    "the fourth root of a fourth power": lambda lam, conditions, full_film: ((lam - 1) ** 4) ** 0.25,
    "the square of a root": lambda lam, conditions, full_film: 0.02 + 0.1 * np.sqrt(lam) ** 2,
    "either or": lambda lam, conditions, full_film: np.where(np.logical_xor(lam > 0.5, lam > 0.8), 0.1, 0.2),
    "not of a choice": lambda lam, conditions, full_film: np.where(~np.where(lam > 0.5, lam > 0.8, False), 0.1, 0.2),
    "a ufunc for whole numbers": lambda lam, conditions, full_film: np.ldexp(lam, 2),
    "a method of arrays": lambda lam, conditions, full_film: lam.clip(0.02, 0.2),
    "a table": lambda lam, conditions, full_film: np.interp(lam, [0.0, 3.0], [0.2, 0.02]),
    "a high power": lambda lam, conditions, full_film: 0.2 / (1 + (lam - 1) ** 12),
    "a negative power": lambda lam, conditions, full_film: 0.01 * lam**-2.0,
}


@pytest.mark.parametrize("name", LAWS)
def test_the_same_as_plain_arrays(name, model, seed_screw, seed_oil):
    changed = dataclasses.replace(model, friction=LAWS[name])
    loads, speeds = np.array([1000.0, 2000.0, 4000.0]), np.array([10.0, 50.0, 100.0])
    names = ["screw_friction_coefficient", "nut_friction_coefficient", "screw_torque"]
    ds = bs.sweep(changed, seed_screw, seed_oil, outputs=names, axial_load=loads, screw_speed=speeds)
    plain = changed(seed_screw, seed_oil, axial_load=loads[:, None], screw_speed=speeds)
    assert ds.screw_friction_coefficient.to_numpy() == pytest.approx(plain.screw.friction_coefficient, rel=1e-12)
    assert ds.nut_friction_coefficient.to_numpy() == pytest.approx(plain.nut.friction_coefficient, rel=1e-12)
    assert ds.screw_torque.to_numpy() == pytest.approx(plain.screw_torque, rel=1e-12)


def test_a_law_that_fails_says_so_itself(model, seed_screw, seed_oil):
    def broken(film_parameter, conditions, full_film):
        raise RuntimeError("no such film")

    with pytest.raises(RuntimeError, match="no such film"):
        bs.sweep(
            dataclasses.replace(model, friction=broken), seed_screw, seed_oil, axial_load=[1.0, 2.0], screw_speed=1.0
        )


def test_fixed_zero_load_keeps_its_limits(model, seed_screw, seed_oil):
    """Constants fold by the rules of arrays: 0 to a negative power is infinite, not an error."""
    names = list(known_outputs())
    ds = bs.sweep(model, seed_screw, seed_oil, outputs=names, axial_load=0, screw_speed=60.0, loaded_balls=[50, 56])
    assert list(ds.efficiency.to_numpy()) == [0.0, 0.0]
    assert np.all(np.isinf(ds.screw_minimum_film_thickness))


def test_the_dataset_names_its_laws(model, seed_screw, seed_oil):
    changed = dataclasses.replace(model, ball_friction_coefficient=0.2)
    ds = bs.sweep(changed, seed_screw, seed_oil, axial_load=[1.0], screw_speed=[1.0])
    assert ds.attrs["title"].endswith(f"model {model.name}, changed: ball_friction_coefficient")
    assert ds.attrs["model_hertz"] == model.hertz.__name__
    assert ds.attrs["screw_ball_material_young_modulus"] == seed_screw.ball_material.young_modulus
