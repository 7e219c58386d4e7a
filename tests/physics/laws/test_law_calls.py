"""Laws of a contact take its conditions; what is no law is refused."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.inlet import Inlet
from ballscrew.physics.laws.protocols import InletFactors

POINT = {"axial_load": 4000.0, "screw_speed": 60.0}
REFERENCE = bs.FrictionModel.reference()


@pytest.fixture
def contact(seed_screw, seed_oil):
    return REFERENCE(seed_screw, seed_oil, **POINT).screw


# -- the conditions --------------------------------------------------------------------------------


def test_a_law_can_read_what_the_laws_before_it_found(seed_screw, seed_oil):
    seen = {}

    def rolling_of_the_film(conditions):
        seen.update(vars(conditions))
        return 1e5 * conditions.minimum_film_thickness

    inlet = Inlet(replenishment_constant=0.0)
    full_film = dataclasses.replace(REFERENCE, rolling=rolling_of_the_film, full_film=lambda c: 0.03, inlet=inlet)
    result = full_film(seed_screw, seed_oil, **POINT)
    assert result.nut.hydrodynamic_rolling_force == pytest.approx(
        1e5 * result.nut.minimum_film_thickness * result.nut.inlet_film_factor, rel=1e-4
    )
    assert seen["film_parameter"] == result.nut.film_parameter
    assert seen["full_film_friction_coefficient"] == 0.03
    assert seen["transverse_radius"] / seen["rolling_radius"] == pytest.approx(result.nut.radii_ratio)


def test_a_fuller_state_keeps_what_is_known(contact):
    pressure = contact.maximum_pressure
    fuller = contact.extended(Contact, friction_coefficient=0.5)
    assert vars(fuller)["maximum_pressure"] == pressure
    assert (fuller.friction_coefficient, contact.friction_coefficient == 0.5) == (0.5, False)


# -- what is no law --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("slot", "given", "said"),
    [
        ("rolling", "houpert", r"model\.rolling: must be a law, not its name \(houpert\) · from "
         r"ballscrew\.physics\.laws\.rolling import houpert_rolling, and give rolling=houpert_rolling"),
        ("rolling", "haupert", r'model\.rolling: .* \(haupert\) · did you mean "houpert"\? in a case file'),
        ("film", "hamrock-dowson", r"import HamrockDowson, and give film=HamrockDowson\(\)"),
        ("film", bs.HamrockDowson, r"model\.film: must be a law \(the class HamrockDowson\) · make one of it"),
        ("slip", None, r"model\.slip: must be a law \(None\)"),
        ("friction", 0.1, r"model\.friction: must be a law \(0\.1\) · give a function"),
    ],
)  # fmt: skip
def test_what_is_no_law_is_refused(slot, given, said):
    with pytest.raises(bs.InputError, match=said):
        dataclasses.replace(REFERENCE, **{slot: given})


@pytest.mark.parametrize(
    ("slot", "returned", "said"),
    [
        ("rolling", None, r"model\.rolling: must return numbers \(.*\.returns returned None\) · return a number"),
        ("rolling", "1 N", "must return numbers .*returned a str"),
        ("friction", 0.1 + 0j, "must return numbers .*returned a complex"),
        ("friction", [0.1], "must return numbers .*returned a list"),
        ("film", np.array(["a"]), "must return numbers"),
        ("elastic_resistance", np.zeros(7), r"model\.elastic_resistance: must return an array in the shape .*\(7,\)"),
        ("inlet", (1.0, 1.0), r"model\.inlet: must return a InletFactors .*returned a tuple\) · return "
         r"ballscrew\.physics\.laws\.protocols\.InletFactors"),
        ("inlet", InletFactors(1.0, None), r"model\.inlet: must return numbers"),
        ("hertz", InletFactors(1.0, 1.0), r"model\.hertz: must return a HertzShape"),
        ("slip", 1.0, r"model\.slip: must return a Slip"),
        ("frame", 1.0, r"model\.frame: must return a Frame"),
        ("race_torques", (1.0, 1.0), r"model\.race_torques: must return a RaceTorques"),
        ("ideal_torque", None, r"model\.ideal_torque: must return numbers"),
    ],
)  # fmt: skip
def test_what_a_law_returns_is_checked(slot, returned, said, seed_screw, seed_oil):
    def returns(conditions, *_):
        return returned

    model = dataclasses.replace(REFERENCE, **{slot: returns})
    with pytest.raises(bs.InputError, match=said):
        model(seed_screw, seed_oil, axial_load=[1000.0, 2000.0, 3000.0], screw_speed=60.0).drive_torque  # noqa: B018  (read)
    with pytest.raises(bs.InputError, match=said):
        bs.sweep(model, seed_screw, seed_oil, axial_load=[1000.0, 2000.0, 3000.0], screw_speed=60.0)


def test_a_law_with_an_array_for_a_coefficient(seed_screw, seed_oil):
    """Its result has the shape of the coefficient: that is right."""

    @dataclasses.dataclass(frozen=True)
    class Constant:
        coefficient: np.ndarray

        def __call__(self, conditions):
            return self.coefficient + 0 * conditions.contact_load

    model = dataclasses.replace(REFERENCE, friction=Constant(np.array([0.05, 0.1])))
    torque = model(seed_screw, seed_oil, **POINT).screw_torque
    assert torque.shape == (2,)
    assert torque[0] < torque[1]


def test_what_a_law_raises_names_it(seed_screw, seed_oil):
    def broken(conditions):
        raise ZeroDivisionError("mine")

    with pytest.raises(ZeroDivisionError, match="mine") as caught:
        dataclasses.replace(REFERENCE, rolling=broken)(seed_screw, seed_oil, **POINT)
    assert caught.value.__notes__[0].startswith("raised by the law model.rolling = ")


def test_a_law_of_several_arguments_is_named(seed_screw, seed_oil):
    """A law takes the conditions of the contact, and nothing else."""
    model = dataclasses.replace(REFERENCE, friction=lambda film_parameter, full_film: 0.1)
    with pytest.raises(TypeError, match="full_film") as caught:
        model(seed_screw, seed_oil, **POINT)
    assert caught.value.__notes__[0].startswith("raised by the law model.friction = ")
