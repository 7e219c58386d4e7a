"""Laws of the user's in a sweep: recorded where that works, on plain arrays where not, and always right."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.physics.laws.traits import law_traits
from support.structures import forget_structures


def with_an_assignment(conditions):
    mu = np.full(np.shape(conditions.film_parameter), 0.2)
    mu[conditions.film_parameter > 1] = 0.02
    return mu


def of_logarithms(conditions):
    """Powers of what may be negative."""
    x = np.log(conditions.film_parameter + 0.1)
    return 0.1 - 0.01 * x + 0.002 * x**2 - 0.001 * x**3


LAWS = {
    "an assignment": with_an_assignment,
    "powers of logarithms": of_logarithms,
    "the house style": lambda c: 0.02 + 0.18 / (1 + c.film_parameter**2) ** 0.5,
    "a limit": lambda c: np.clip(0.2 - 0.1 * c.film_parameter, 0.02, 0.2),
    "a constant": lambda c: 0.1,
    "the root of a square": lambda c: 0.1 * np.sqrt((c.film_parameter - 1) ** 2),
    "the fourth root of a fourth power": lambda c: ((c.film_parameter - 1) ** 4) ** 0.25,
    "the square of a root": lambda c: 0.02 + 0.1 * np.sqrt(c.film_parameter) ** 2,
    "either or": lambda c: np.where(np.logical_xor(c.film_parameter > 0.5, c.film_parameter > 0.8), 0.1, 0.2),
    "not of a choice": lambda c: np.where(~np.where(c.film_parameter > 0.5, c.film_parameter > 0.8, False), 0.1, 0.2),
    "a ufunc for whole numbers": lambda c: np.ldexp(c.film_parameter, 2),
    "a method of arrays": lambda c: c.film_parameter.clip(0.02, 0.2),
    "a table": lambda c: np.interp(c.film_parameter, [0.0, 3.0], [0.2, 0.02]),
    "a high power": lambda c: 0.2 / (1 + (c.film_parameter - 1) ** 12),
    "a negative power": lambda c: 0.01 * c.film_parameter**-2.0,
}


@pytest.mark.slow
@pytest.mark.parametrize("name", LAWS)
def test_the_same_as_plain_arrays(name, model, seed_screw, seed_oil):
    changed = dataclasses.replace(model, friction=LAWS[name])
    loads, speeds = np.array([10.0, 1000.0, 2000.0, 8000.0]), np.array([1.0, 10.0, 50.0, 100.0])
    names = ["screw_friction_coefficient", "nut_friction_coefficient", "screw_torque"]
    ds = bs.sweep(changed, seed_screw, seed_oil, outputs=names, axial_load=loads, screw_speed=speeds)
    plain = changed(seed_screw, seed_oil, axial_load=loads[:, None], screw_speed=speeds)
    assert ds.screw_friction_coefficient.to_numpy() == pytest.approx(plain.screw.friction_coefficient, rel=1e-12)
    assert ds.nut_friction_coefficient.to_numpy() == pytest.approx(plain.nut.friction_coefficient, rel=1e-12)
    assert ds.screw_torque.to_numpy() == pytest.approx(plain.screw_torque, rel=1e-12)


def test_a_law_that_fails_says_so_itself(model, seed_screw, seed_oil):
    def broken(conditions):
        raise RuntimeError("no such film")

    with pytest.raises(RuntimeError, match="no such film"):
        bs.sweep(
            dataclasses.replace(model, friction=broken), seed_screw, seed_oil, axial_load=[1.0, 2.0], screw_speed=1.0
        )


def test_fixed_zero_load_keeps_its_limits(model, seed_screw, seed_oil):
    """Constants fold by the rules of arrays: 0 to a negative power is infinite, not an error."""
    names = list(known_outputs())
    ds = bs.sweep(model, seed_screw, seed_oil, outputs=names, axial_load=0, screw_speed=60.0, loaded_balls=[50, 56])
    assert np.all(np.isnan(ds.efficiency))
    assert np.all(ds.ideal_torque == 0)
    assert np.all(np.isinf(ds.screw_minimum_film_thickness))


def test_the_dataset_names_its_laws(model, seed_screw, seed_oil):
    changed = dataclasses.replace(model, ball_friction_coefficient=0.2)
    ds = bs.sweep(changed, seed_screw, seed_oil, axial_load=[1.0], screw_speed=[1.0])
    assert ds.attrs["title"].endswith(f"model {model.name}, changed: ball_friction_coefficient")
    assert ds.attrs["model_hertz"] == model.hertz.__name__
    assert ds.attrs["screw_ball_material_young_modulus"] == seed_screw.ball_material.young_modulus


def swept(model, seed_screw, seed_oil, **options):
    return bs.sweep(model, seed_screw, seed_oil, axial_load=[1.0, 2.0], screw_speed=[1.0, 2.0], **options).attrs


def test_the_dataset_says_what_evaluated_it_and_why(model, seed_screw, seed_oil, monkeypatch, tmp_path):
    forget_structures(monkeypatch, tmp_path)
    assert swept(model, seed_screw, seed_oil)["engine"] == "numpy"
    assert swept(model, seed_screw, seed_oil, engine="numpy")["engine_reason"] == "it was asked for"
    by_table = swept(dataclasses.replace(model, friction=LAWS["a table"]), seed_screw, seed_oil)
    assert (
        "plain arrays: numpy.interp cannot be recorded; raised by the law model.friction" in by_table["engine_reason"]
    )


def test_a_law_may_declare_that_it_wants_plain_arrays(model, seed_screw, seed_oil):
    @law_traits(recordable=False)
    def of_a_library(conditions):
        assert isinstance(conditions.film_parameter, np.ndarray | np.floating)
        return 0.1 + 0 * conditions.film_parameter

    changed = dataclasses.replace(model, friction=of_a_library)
    assert "model.friction declares" in swept(changed, seed_screw, seed_oil)["engine_reason"]


def test_only_what_cannot_be_recorded_falls_back(model, seed_screw, seed_oil):
    """What a law raises on a recording for a reason of its own is not silenced."""

    def broken_on_recordings(conditions):
        if not isinstance(conditions.film_parameter, np.ndarray | np.floating):
            raise KeyError("mine")
        return 0.1 + 0 * conditions.film_parameter

    with pytest.raises(KeyError, match="mine") as caught:
        swept(dataclasses.replace(model, friction=broken_on_recordings), seed_screw, seed_oil)
    assert caught.value.__notes__[0].startswith("raised by the law model.friction")
