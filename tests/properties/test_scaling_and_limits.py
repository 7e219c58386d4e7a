"""How results scale, where they tend to, and what they do not depend on."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.physics.equations.rolling import elastic_resistance_moment
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.laws.inlet import Inlet
from support.strategies import (
    RPM,
    all_models,
    both_models,
    cases,
    close,
    corrected,
    fitting_cases,
    floats,
    moving_cases,
    oils,
    powers,
    screws,
    speeds,
    torque_scale,
    with_ball_force,
)

OUTPUTS = known_outputs()
TORQUES = ("screw_torque", "nut_torque", "ideal_torque", "drive_torque")
EFFICIENCIES = ("efficiency", "back_driving_efficiency", "friction_coefficient", "friction_angle")
#: Coefficients that only a preloaded nut has.
OF_A_PRELOAD = ("preload_torque_coefficient", "diameter_drag_coefficient")


# -- units ----------------------------------------------------------------------------------------


def scaled_elastic_resistance(length, force):
    """(20) in other units: its constant has the unit N^-0.33 m^0.67."""

    def law(c):
        constant = force ** (1 - 1.33) * length ** (1 - 0.33)
        return constant * elastic_resistance_moment(c.ball_diameter, c.contact_load, c.radii_ratio)

    return law


def scaled_screw(screw, length, force):
    lengths = (
        "pitch_circle_diameter", "lead", "ball_diameter", "ball_roughness", "screw_roughness", "nut_roughness",
    )  # fmt: skip
    materials = {
        name: dataclasses.replace(
            getattr(screw, name), young_modulus=getattr(screw, name).young_modulus * force / length**2
        )
        for name in ("ball_material", "screw_material", "nut_material")
    }
    return dataclasses.replace(screw, **{name: getattr(screw, name) * length for name in lengths}, **materials)


@pytest.mark.slow
@given(cases, all_models, *[powers(1e-3, 1e3)] * 3)
def test_units(case, model, length, force, time):
    """Nothing depends on the units: lengths, forces and times may be counted in any, with (20)'s constant converted."""
    # the replenishment of the inlet is a fit in millimetres and revolutions per minute, and is left out
    inlet = Inlet(replenishment_constant=0.0) if isinstance(model.inlet, Inlet) else model.inlet
    model = dataclasses.replace(model, ball_to_ball_force=0.02, inlet=inlet)
    other = dataclasses.replace(
        model, ball_to_ball_force=0.02 * force, elastic_resistance=scaled_elastic_resistance(length, force)
    )
    oil = bs.Lubricant(
        viscosity=case.oil.viscosity * force * time / length**2,
        pressure_viscosity_coefficient=case.oil.pressure_viscosity_coefficient * length**2 / force,
        thermal_conductivity=case.oil.thermal_conductivity * force / time,
    )
    r = case(model)
    scaled = other(
        scaled_screw(case.screw, length, force),
        oil,
        axial_load=case.axial_load * force,
        screw_speed=case.screw_speed / time,
    )
    for name in TORQUES:
        assert close(
            getattr(scaled, name), getattr(r, name) * force * length, 1e-11, scale=torque_scale(r) * force * length
        ), name
    for mechanism in MECHANISMS:
        assert close(
            scaled.contributions[mechanism],
            r.contributions[mechanism] * force * length,
            1e-11,
            scale=torque_scale(r) * force * length,
        ), mechanism
    assert close(scaled.friction_power, r.friction_power * force * length / time, 1e-11)
    assert close(scaled.efficiency, r.efficiency, 1e-11)
    for side in ("screw", "nut"):
        there, here = getattr(scaled, side), getattr(r, side)
        for name in ("film_parameter", "friction_coefficient", "ellipticity", "radii_ratio"):
            assert close(getattr(there, name), getattr(here, name), 1e-11), name
        assert close(there.maximum_pressure, here.maximum_pressure * force / length**2, 1e-11)
        assert close(there.minimum_film_thickness, here.minimum_film_thickness * length, 1e-11)
        assert close(there.sliding_force, here.sliding_force * force, 1e-11, scale=2 * r.screw.tangential_force * force)


@pytest.mark.slow
@given(cases, all_models, st.integers(2, 7))
def test_balls_add_up(case, model, factor):
    """Torque is additive in the balls: twice the balls under twice the load have twice the torque."""
    model = with_ball_force(model, 0.02)
    r = case(model)
    more = case(model, axial_load=factor * case.axial_load, loaded_balls=factor * case.screw.loaded_balls)
    assert close(more.contact_load, r.contact_load)
    assert close(more.screw_torque, factor * r.screw_torque, scale=factor * torque_scale(r))
    assert close(more.nut_torque, factor * r.nut_torque, scale=factor * torque_scale(r))


@pytest.mark.slow
@given(moving_cases, both_models, powers(0.02, 50))
def test_viscosity_and_speed_count_as_their_product(case, model, factor):
    """Friction torque depends on η0 n alone: twice the viscosity at half the speed is the same."""
    r = case(model)
    same = case(model, viscosity=case.oil.viscosity * factor, screw_speed=case.screw_speed / factor)
    for name in ("screw_torque", "nut_torque", "efficiency"):
        assert close(getattr(same, name), getattr(r, name), 1e-11, scale=torque_scale(r) + r.efficiency), name
    assert close(same.screw.film_parameter, r.screw.film_parameter, 1e-11)


# -- at rest and without load ---------------------------------------------------------------------


@pytest.mark.slow
@given(cases, both_models)
def test_rest_is_the_limit_of_slow_motion(case, model):
    """Nothing jumps at rest but the drive torque, by the friction that turns with the motion."""
    backwards, rest, creeping = (case(model, screw_speed=speed) for speed in (-1e-18, 0.0, 1e-18))
    for name in TORQUES:
        if name != "drive_torque":
            for near in (backwards, creeping):
                assert close(getattr(near, name), getattr(rest, name), 1e-6, scale=torque_scale(rest)), name
    assert rest.drive_torque == rest.ideal_torque
    for near, sign in ((backwards, -1), (creeping, 1)):
        limit = rest.ideal_torque + sign * rest.screw_torque
        assert close(near.drive_torque, limit, 1e-6, scale=torque_scale(rest))


@pytest.mark.slow
@given(screws(), oils, all_models, st.none() | st.just(0.0) | powers(1e-3, 1.0))
@pytest.mark.parametrize(("axial_load", "screw_speed"), [(0.0, 0.0), (0.0, 60.0), (1000.0, 0.0)])
def test_limits_are_numbers(axial_load, screw_speed, screw, oil, model, ball_to_ball_force):
    """No load and no speed give limits, never NaN, in all but the efficiencies of a load that there is not."""
    model = with_ball_force(model, ball_to_ball_force)
    r = model(screw, oil, axial_load=axial_load, screw_speed=screw_speed)
    for name, output in OUTPUTS.items():
        # without a load nothing is driven, and nothing drives
        undefined = name in OF_A_PRELOAD or (axial_load == 0 and name in EFFICIENCIES)
        assert bool(np.isnan(float(output.read(r)))) == undefined, name
    for power in r.dissipation.values():
        assert np.isfinite(power)
    for name in (*TORQUES, "friction_power"):
        assert np.isfinite(getattr(r, name)), name
    if axial_load == 0:
        assert not r.valid
        assert not r.validity["skid"]


@pytest.mark.slow
@given(screws(), oils, both_models, speeds)
def test_without_load_the_screw_still_drags(screw, oil, model, screw_speed):
    """As Q → 0 only what pushes the balls along is left: friction between balls alone, and no efficiency."""
    r = model(screw, oil, axial_load=0.0, screw_speed=screw_speed)
    assert r.screw_torque == pytest.approx(
        r.contributions["ball_to_ball"] + r.contributions["chain_braking"], rel=1e-12
    )
    assert r.screw_torque > 0
    assert np.isnan(r.efficiency)
    assert np.isnan(r.back_driving_efficiency)


@pytest.mark.slow
@given(screws(), oils, both_models, powers(1, 5000))
def test_efficiency_vanishes_with_the_load(screw, oil, model, rpm):
    """η → 0 as Q → 0: the balls still have to be pushed and the oil still has to be moved."""
    load = 10.0 ** -np.arange(0, 25, 2)
    r = model(screw, oil, axial_load=load, screw_speed=rpm * RPM)
    assert np.all(np.diff(r.efficiency) < 0)
    assert r.efficiency[-1] < 1e-12


@given(both_models, floats(100, 1000), floats(0.05, 0.5))
def test_efficiency_rises_at_light_load(model, rpm, viscosity):
    """η rises with the load on (0, 20 N] a ball, at the paper's SCREW."""
    contact_load = np.linspace(0, 20, 101)
    load = contact_load * 56 * math.sin(math.pi / 4)
    r = model(SCREW, bs.Lubricant(viscosity), axial_load=load, screw_speed=rpm * RPM)
    assert np.isnan(r.efficiency[0])
    assert r.efficiency[1] > 0
    assert np.all(np.diff(r.efficiency[1:]) > 0)


@pytest.mark.slow
@given(screws(), oils, all_models, powers(1, 5000))
def test_skid_is_flagged_as_the_load_vanishes(screw, oil, model, rpm):
    """The sliding force that equilibrium asks for falls more slowly than µQ: a ball with little load skids."""
    load = 10.0 ** -np.arange(0, 25, 2)
    r = model(screw, oil, axial_load=load, screw_speed=rpm * RPM)
    assert not r.validity["skid"][-1]
    assert not r.valid[-1]
    assert any(warning.startswith("skid:") for warning in r.warnings)
    for side in (r.screw, r.nut):
        beyond = np.abs(side.sliding_force) > side.traction_limit
        assert not np.any(r.validity["skid"] & beyond)


# -- the helix ------------------------------------------------------------------------------------


@pytest.mark.slow
@given(cases, powers(1e-6, 1e-2))
def test_helix_is_a_second_order_effect(case, slope):
    """For a small lead the helix changes the friction torque by the order of φ², and its sign does not count."""
    r, flat, back = (
        case(corrected, lead=np.array([lead * math.pi * case.screw.pitch_circle_diameter]))
        for lead in (slope, 0.0, -slope)
    )
    assert close(r.screw_torque, flat.screw_torque, 10 * slope**2 + 1e-12, scale=torque_scale(flat))
    assert close(r.screw_torque, back.screw_torque, scale=torque_scale(flat))


@pytest.mark.slow
@given(fitting_cases(), both_models)
def test_on_a_huge_pitch_circle_both_contacts_are_alike(case, model):
    """d_m → ∞: screw and nut are both flat to the ball, and no contact can tell them apart."""
    screw = dataclasses.replace(
        case.screw,
        pitch_circle_diameter=1e9 * case.screw.ball_diameter,
        nut_conformity=case.screw.screw_conformity,
        nut_roughness=case.screw.screw_roughness,
        nut_material=case.screw.screw_material,
    )
    # the entrainment speed stays what it was
    speed = case.screw_speed * case.screw.pitch_circle_diameter / screw.pitch_circle_diameter
    r = with_ball_force(model, 0.0)(screw, case.oil, axial_load=case.axial_load, screw_speed=speed)
    for name, output in OUTPUTS.items():
        other = OUTPUTS.get("nut_" + name.removeprefix("screw_"))
        if name.startswith("screw_") and other is not None:
            assert close(output.read(r), other.read(r), 1e-7), name


# -- arrays ---------------------------------------------------------------------------------------


@pytest.mark.slow
@given(st.lists(cases, min_size=2, max_size=4), both_models)
def test_arrays_are_scalars_element_by_element(some, model):
    """An array of operating points gives what each point gives by itself."""
    first = some[0]
    load = np.array([0.0, *(c.axial_load for c in some), 50.0])
    speed = np.array([5.0, *(c.screw_speed for c in some), 0.0])
    together = model(first.screw, first.oil, axial_load=load, screw_speed=speed)
    for i in range(len(load)):
        alone = model(first.screw, first.oil, axial_load=float(load[i]), screw_speed=float(speed[i]))
        scale = {name: torque_scale(alone) for name in (*TORQUES, "screw_friction_torque", "nut_friction_torque")}
        scale["residual"] = 1.0  # in units of load and preload
        for name, output in OUTPUTS.items():
            found = np.broadcast_to(output.read(together), load.shape)[i]
            expected = output.read(alone)
            if not np.isfinite(expected):
                np.testing.assert_equal(found, expected, name)
            elif name.endswith(("sliding_force", "tangential_force")):
                assert close(found, expected, scale=abs(alone.screw.tangential_force) + abs(expected)), name
            elif name.endswith("pure_rolling_offset"):
                # a double root at Y = 1, where the traction is at its negative limit
                assert close(found, expected, 1e-6), name
            else:
                assert close(found, expected, scale=scale.get(name)), name


@pytest.mark.slow
@given(cases, all_models)
def test_designs_may_be_arrays_too(case, model):
    """Fields of the screw and of the oil broadcast like operating points."""
    diameters = case.screw.ball_diameter * np.array([0.8, 0.9, 1.0])
    together = case(model, ball_diameter=diameters)
    for i, diameter in enumerate(diameters):
        alone = case(model, ball_diameter=float(diameter))
        assert close(together.screw_torque[i], alone.screw_torque, scale=torque_scale(alone))


@pytest.mark.slow
@given(cases, all_models)
def test_nonsense_in_an_array_stays_where_it_is(case, model):
    """NaN and infinite numbers are flagged where they stand, and leave their neighbours alone."""
    load = np.array([case.axial_load, math.nan, -math.inf, math.inf, case.axial_load])
    r = case(model, axial_load=load)
    sane = case(model, axial_load=load[[0, 4]])
    assert not np.any(r.validity["inputs"][1:4])
    assert not np.any(r.valid[1:4])
    assert np.isnan(r.screw_torque[1])
    assert np.allclose(r.screw_torque[[0, 4]], sane.screw_torque, rtol=1e-13, atol=0)
