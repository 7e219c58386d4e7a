"""Where the reference model tends to, and that it gets there without a jump."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from ballscrew.physics.components.operating_state import NOTHING
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.laws.frame import bearing_frame
from ballscrew.physics.laws.inlet import Inlet, ideal_inlet
from support.strategies import RPM, Case, box, constant_friction, corrected, reference, torque_scale, with_ball_force

SIZE = 4000


@pytest.fixture(scope="module")
def case():
    return box(SIZE, seed=3)


@pytest.fixture(scope="module")
def moving():
    return box(SIZE, seed=4, at_rest=0.0)


def off(found, expected):
    return np.abs(found.screw_torque / expected.screw_torque - 1)


# -- rest and load -------------------------------------------------------------------------------


@pytest.mark.parametrize("rpm", [1e-12, 1e-9])
def test_rest_is_the_limit_of_slow_motion(case, rpm):
    """The torque is off its limit by no more than friction is, and by rolling; both grow from nothing with the film."""
    rest, creeping = (case(reference, screw_speed=speed) for speed in (0.0, rpm * RPM))
    mu_0 = reference.friction.boundary_friction_coefficient
    fallen = [1 - side.friction_coefficient / mu_0 for side in (creeping.screw, creeping.nut)]
    rolled = creeping.contributions["hydrodynamic_rolling"] / creeping.screw_torque
    assert np.all(
        off(creeping, rest) <= np.maximum(*fallen) + rolled + 1e-5
    )  # the last: slip that has settled, or nearly
    assert np.max(fallen) < 1e-2
    assert np.all(rest.friction_power == 0)


def test_at_rest_the_oil_does_not_matter(case, model):
    """As n → 0 there is no film: neither viscosity nor pressure–viscosity coefficient matters, to the last bit."""
    other = dataclasses.replace(case, oil=bs.Lubricant(0.37, 1.5e-8, thermal_conductivity=0.2))
    first, second = (some(model, screw_speed=0.0) for some in (case, other))
    for name in ("screw_torque", "nut_torque", "drive_torque", "efficiency", "back_driving_efficiency"):
        assert np.array_equal(getattr(first, name), getattr(second, name)), name
    for side in (first.screw, first.nut):
        assert np.all(side.minimum_film_thickness == 0)
        assert np.all(side.film_parameter == 0)
        assert np.all(side.hydrodynamic_rolling_force == 0)
        assert np.all(side.friction_coefficient == model.friction.boundary_friction_coefficient)


@pytest.mark.parametrize("axial_load", [0.0, 1e-300, 1e-30, 1e-10, 1e-3])
@pytest.mark.parametrize("rpm", [0.0, 1.0, 3000.0])
def test_without_load_all_is_finite(case, axial_load, rpm):
    """Less and less load: the torque vanishes with it, and nothing is NaN but the efficiency of no load."""
    r = case(reference, axial_load=np.full(SIZE, axial_load), screw_speed=rpm * RPM)
    torques = (r.screw_torque, r.nut_torque, r.friction_power, *r.contributions.values(), *r.dissipation.values())
    for torque in torques:
        assert np.all(np.isfinite(torque))
    assert np.all(r.screw_torque >= 0)
    # friction can carry no more than its coefficient times the load
    assert np.all(r.screw_torque <= 0.5 * axial_load * case.screw.pitch_circle_diameter)
    for side in (r.screw, r.nut):
        for name in ("creep_speed", "spin", "lateral_slip_speed", "pure_rolling_offset", "friction_coefficient"):
            assert np.all(np.isfinite(getattr(side, name))), name
    assert np.all(np.isnan(r.efficiency) == (axial_load < NOTHING))
    if axial_load < NOTHING:
        assert np.all(r.screw_torque == 0)
        assert not np.any(r.validity["skid"])


def test_efficiency_tends_to_a_number_as_a_skidding_ball_is_unloaded(case):
    """Both torques vanish like the load: friction of a ball that skids is in proportion to it."""
    few, fewer = (case(reference, axial_load=np.full(SIZE, F), screw_speed=1000 * RPM) for F in (1e-6, 1e-8))
    assert np.all(few.rolling_share < 1)
    assert np.max(np.abs(few.screw_torque / (100 * fewer.screw_torque) - 1)) < 0.5
    assert np.all((few.efficiency > 0) & (few.efficiency < 1))


# -- geometry --------------------------------------------------------------------------------------


def with_lead(case, slope, model=reference):
    return case(model, lead=slope * math.pi * case.screw.pitch_circle_diameter)


@pytest.mark.parametrize("model", [reference, corrected])
def test_without_lead_it_is_a_bearing(case, model):
    """φ = 0: nothing of the helix is left, to the last bit."""
    helix = with_lead(case, np.zeros(SIZE), model)
    bearing = with_lead(case, np.zeros(SIZE), dataclasses.replace(model, frame=bearing_frame))
    for name, output in known_outputs().items():
        assert np.array_equal(output.read(helix), output.read(bearing), equal_nan=True), name
    assert np.all(helix.contributions["helix"] == 0)
    assert np.all(helix.lateral_force == 0)
    assert np.all(helix.screw.lateral_slip_speed == 0)


@pytest.mark.parametrize("slope", [1e-12, 1e-9, 1e-6, 1e-4])
def test_the_helix_grows_from_nothing(case, slope):
    """φ → 0: corrected kinematics and helix slip vanish continuously, the latter with φ or faster."""
    flat, r = with_lead(case, np.zeros(SIZE)), with_lead(case, slope)
    both = r.converged & flat.converged
    assert np.max(off(r, flat)[both]) < 100 * slope
    assert np.all((r.contributions["helix"] / r.screw_torque <= 1e3 * slope)[both])


@pytest.mark.parametrize("huge", [1e6, 1e9])
def test_on_a_huge_pitch_circle_both_contacts_are_alike(moving, huge):
    """d_m → ∞: no contact can tell screw and nut apart, and they share spin and lateral slip by halves."""
    screw = dataclasses.replace(
        moving.screw,
        pitch_circle_diameter=huge * moving.screw.ball_diameter,
        nut_conformity=moving.screw.screw_conformity,
        nut_roughness=moving.screw.screw_roughness,
    )
    speed = moving.screw_speed * moving.screw.pitch_circle_diameter / screw.pitch_circle_diameter
    r = with_ball_force(reference, 0.0)(screw, moving.oil, axial_load=moving.axial_load, screw_speed=speed)
    for name in (
        "friction_coefficient", "sliding_force", "curvature_friction_moment", "hydrodynamic_rolling_force",
        "minimum_film_thickness", "creep_speed", "spin", "lateral_slip_speed",
    ):  # fmt: skip
        one, other = getattr(r.screw, name), getattr(r.nut, name)
        assert np.all(np.abs(one - other) <= 1e5 / huge * np.maximum(np.abs(one), np.abs(other))), name
    assert np.max(np.abs(r.screw_torque / r.nut_torque - 1)) < 1e-9


# -- along lines through the hard places -----------------------------------------------------------


def along(load=4000.0, rpm=600.0, **changed):
    """The paper's screw with one of its numbers running through many."""
    return Case(SCREW, OIL, load, rpm * RPM)(reference, **changed)


def steps(r):
    """Relative steps of the torque from point to point, and of its parts in units of the torque."""
    M = r.screw_torque
    parts = [np.abs(np.diff(part)) / M[1:] for part in r.contributions.values()]
    return np.max([np.abs(np.diff(M)) / M[1:], *parts], axis=0)


CONFORMITIES = np.linspace(0.502, 0.58, 4001)
LINES = {
    "load through the skid": {"axial_load": np.geomspace(0.5, 50, 4001)},
    "speed through the skid": {"axial_load": 20.0, "screw_speed": np.geomspace(1, 500, 4001)},
    "spin from little to pure": {
        "axial_load": 800.0,
        "contact_angle": math.radians(70),
        "screw_conformity": CONFORMITIES,
        "nut_conformity": CONFORMITIES,
    },
    "contact angle": {"contact_angle": np.radians(np.linspace(20, 70, 4001))},
    "lead": {"lead": np.geomspace(0.0033, 0.04, 4001)},
    "speed from rest": {"screw_speed": np.geomspace(1e-9, 500, 8001)},
}


@pytest.mark.parametrize("name", LINES)
def test_nothing_jumps_along_a_line(name):
    """Small steps of the input are small steps of torque and parts: no branch, no skid and no iteration shows."""
    changed = LINES[name]
    r = along(**changed)
    values = next(value for value in changed.values() if np.ndim(value))
    relative = np.abs(np.diff(values)) / values[1:]
    if name == "spin from little to pure":
        relative = np.diff(values) / (values[1:] - 0.5)
    assert np.all(steps(r) <= 6 * relative + 1e-9)


def test_the_lines_go_where_they_say():
    load = along(**LINES["load through the skid"])
    assert load.rolling_share[0] < 0.5
    assert load.rolling_share[-1] == 1
    traction = load.screw.sliding_force / load.screw.traction_limit
    assert np.max(traction) > 0.99
    spin = along(**LINES["spin from little to pure"]).screw.spin_parameter
    assert spin[0] < 0.5
    assert spin[-1] > 1.3


@pytest.mark.parametrize("conformity", [0.505, 0.56])
def test_traction_through_its_range(conformity):
    """The net force of the contacts from a trace of what friction carries to all of it: finite and continuous."""
    force = np.geomspace(1e-4, 10, 4001)
    model = dataclasses.replace(with_ball_force(reference, force), friction=constant_friction(0.1))
    screw = dataclasses.replace(SCREW, screw_conformity=conformity, nut_conformity=conformity)
    r = model(screw, OIL, axial_load=2000.0, screw_speed=6.0)
    ratio = r.screw.sliding_force / r.screw.traction_limit
    assert ratio[0] < 0.1
    assert ratio[-1] > 0.99
    assert np.all(steps(r) <= 5 * np.diff(force) / force[1:] + 1e-9)


# -- gradients -------------------------------------------------------------------------------------

INPUTS = ("axial_load", "screw_speed", "viscosity", "ball_diameter", "contact_angle", "lead")


@pytest.mark.parametrize("name", INPUTS)
def test_gradients_are_finite_and_the_same_at_two_steps(moving, name):
    """Central differences of ln M_S over ln of each input: bounded anywhere, and equal at two steps where smooth."""
    holder = moving if hasattr(moving, name) else moving.screw if hasattr(moving.screw, name) else moving.oil
    value = getattr(holder, name)

    def slope(step):
        up, down = (moving(reference, **{name: value * factor}).screw_torque for factor in (1 + step, 1 - step))
        return np.log(up / down) / np.log((1 + step) / (1 - step))

    coarse, fine = slope(1e-4), slope(1e-5)
    assert np.all(np.abs(coarse) < 6)
    assert np.all(np.abs(fine) < 12)
    assert np.quantile(np.abs(coarse - fine), 0.99) < 2e-3
    # what is left are the places where a skid begins, and a last step of the iteration that just turned around
    assert np.mean(np.abs(coarse - fine) > 0.01) < 0.005


def test_gradients_of_the_parts_are_bounded(moving):
    """No part of the torque jumps against it: creep, spin and lateral slip hand over gently."""
    M = moving(reference).screw_torque
    step = 1e-5
    up, down = (moving(reference, axial_load=moving.axial_load * factor) for factor in (1 + step, 1 - step))
    for mechanism in MECHANISMS:
        slope = (up.contributions[mechanism] - down.contributions[mechanism]) / (2 * step * M)
        assert np.all(np.isfinite(slope)), mechanism
        assert np.quantile(np.abs(slope), 0.999) < 6, mechanism
    assert np.all(torque_scale(up) > 0)


# -- what is flagged at the ends -----------------------------------------------------------------


def test_an_inlet_that_heat_rules_is_flagged():
    """From a factor of one half down, and never where the inlet is taken as cool."""
    speeds = np.array([60.0, 600.0, 6000.0])
    model = bs.FrictionModel.reference()
    r = model(SCREW, OIL, axial_load=4000.0, screw_speed=speeds)
    factor = np.minimum(r.screw.inlet_film_factor, r.nut.inlet_film_factor)
    assert isinstance(model.inlet, Inlet)
    assert np.array_equal(r.validity["inlet_heating"], factor >= 0.5)
    assert list(r.validity["inlet_heating"]) == [True, True, False]
    cool = dataclasses.replace(model, inlet=ideal_inlet)(SCREW, OIL, axial_load=4000.0, screw_speed=speeds)
    assert np.all(cool.validity["inlet_heating"])


def test_no_load_is_nothing_to_lock():
    r = bs.FrictionModel.reference()(SCREW, OIL, axial_load=np.array([0.0, 4000.0]), screw_speed=60.0)
    assert not np.any(r.self_locking)
