"""Balance, energy and slip of the reference model, on ten thousand screws at once."""

import dataclasses
import itertools

import numpy as np
import pytest

from ballscrew.physics.equations import equilibrium, kinematics, slip
from ballscrew.physics.friction.validity import REASONS
from ballscrew.physics.laws.friction import LoadSharing
from ballscrew.physics.solvers import ellipse_slip
from support.screws import with_grooves
from support.strategies import box, constant_friction, reference, without_losses_of_rolling

SIZE = 10_000
#: Torque, force and power close to this; rounding leaves 3e-15.
RELATIVE = 1e-12
#: Load of a ball, N, below which it is about to skid.
LIGHT = 1.0
SLIP = ("curvature", "spin", "helix")


@pytest.fixture(scope="module")
def case():
    return box(SIZE, seed=1)


@pytest.fixture(scope="module")
def r(case):
    return case(reference)


@pytest.fixture(scope="module")
def crushed():
    """The same without a limit of the load: contacts wider than the ball among them."""
    return box(SIZE, seed=2, heaviest=np.inf)(reference)


def sides(r):
    return r.screw, r.nut


def slip_torque(r):
    return sum(r.contributions[mechanism] for mechanism in SLIP)


def skids(r):
    return r.rolling_share < 1


# -- what the sample is --------------------------------------------------------------------------


def test_the_sample_is_worth_the_name(case, r):
    """All screws are valid, and there is rest, motion, skid, rolling, and spin of any size in it."""
    assert np.all(r.validity["inputs"])
    assert np.all(case.screw.fits)
    assert 0.2 < np.mean(skids(r)) < 0.5
    assert 0.3 < np.mean(r.valid) < 0.7
    assert 0.02 < np.mean(r.screw_speed == 0) < 0.1
    rolls = ~skids(r) & (r.screw_speed > 0)
    assert np.mean(r.screw.spin_parameter[rolls] < 0.5) > 0.05
    assert np.mean(r.screw.spin_parameter[rolls] > 2) > 0.05


# -- balance ---------------------------------------------------------------------------------------


@pytest.mark.parametrize("of", ["r", "crushed"])
def test_everything_is_finite(of, request):
    r = request.getfixturevalue(of)
    for torque in (r.screw_torque, r.nut_torque, r.friction_power, *r.contributions.values(), *r.dissipation.values()):
        assert np.all(np.isfinite(torque))
    for side in sides(r):
        for name in ("creep_speed", "spin", "lateral_slip_speed", "sliding_force", "curvature_friction_moment"):
            assert np.all(np.isfinite(getattr(side, name))), name
    assert np.all(r.screw_torque[r.validity["contact_pressure"]] > 0)


@pytest.mark.parametrize("of", ["r", "crushed"])
def test_energy(of, request):
    """What friction takes from the screw is dissipated at the balls, skidding ones included."""
    r = request.getfixturevalue(of)
    assert np.all(np.abs(r.screw_torque * r.screw_speed - r.friction_power) <= RELATIVE * np.abs(r.friction_power))


@pytest.mark.parametrize("of", ["r", "crushed"])
def test_action_is_reaction(of, request):
    """M_S − M_N = z F_B L, skidding balls included."""
    r = request.getfixturevalue(of)
    pushing = r.ball_screw.loaded_balls * r.net_braking_force * r.frame.path_radius
    assert np.all(np.abs(r.screw_torque - r.nut_torque - pushing) <= RELATIVE * np.abs(r.screw_torque))


@pytest.mark.parametrize("of", ["r", "crushed"])
def test_contributions_sum_to_the_torque(of, request):
    r = request.getfixturevalue(of)
    parts = list(r.contributions.values())
    assert np.all(np.abs(sum(parts) - r.screw_torque) <= RELATIVE * sum(np.abs(part) for part in parts))


@pytest.mark.parametrize("of", ["r", "crushed"])
def test_the_ball_is_in_balance(of, request):
    """Along its path, and about the axis it rolls about, with the forces as reported; (22) and (23)."""
    r = request.getfixturevalue(of)
    s, n = sides(r)
    forces = (s.sliding_force, n.sliding_force, s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force)
    net = equilibrium.force_imbalance(*forces, s.pressure_force, n.pressure_force, r.ball_chain.braking_force)
    moments = sum(side.curvature_friction_moment + side.elastic_resistance_moment for side in sides(r))
    d_w = r.ball_screw.ball_diameter
    turning = equilibrium.moment_imbalance(*forces, moments, r.ball_chain.moment, d_w)
    size = sum(map(np.abs, forces)) + s.pressure_force + n.pressure_force + r.ball_chain.braking_force
    size = size + np.abs(moments) / d_w
    assert np.all(np.abs(net) <= RELATIVE * size)
    assert np.all(np.abs(turning) <= RELATIVE * size * d_w)


def test_no_mechanism_gives_power(r):
    """Friction dissipates: each mechanism by itself, skidding or not."""
    power = r.friction_power
    for mechanism, part in r.dissipation.items():
        assert np.all(part >= -RELATIVE * power), mechanism


def test_slip_is_shared_by_the_contacts(r):
    """What screw and nut force on a ball, its contacts take between them, and neither takes less than nothing."""
    spin = kinematics.relative_spin(r.screw_speed, r.frame.rolling_plane_sine)
    lateral = kinematics.torsion_speed(r.screw_speed, r.ball_screw.ball_diameter, r.frame.lead_angle)
    for total, name in ((spin, "spin"), (lateral, "lateral_slip_speed")):
        parts = [getattr(side, name) for side in sides(r)]
        assert np.all(np.abs(sum(parts) - total) <= 1e-12 * total)
        for part in parts:
            assert np.all((part >= -1e-12 * total) & (part <= total * (1 + 1e-12)))


def test_friction_carries_no_more_than_it_can(r):
    """Force along the path and across it together stay within friction times load, as does the spin moment."""
    for side in sides(r):
        limit = side.traction_limit
        settled = r.converged & ~skids(r)
        both = np.hypot(side.sliding_force, r.lateral_force)
        assert np.all((both <= 1.01 * limit)[settled])
        assert np.all(np.abs(side.sliding_force) <= 1.001 * limit)
        assert np.all(r.lateral_force <= limit)
        most = 3 / 8 * limit * side.semi_major_axis * np.sqrt(1 + side.ellipticity**-2)
        assert np.all(r.spin_moment <= 1.05 * most)


# -- skid ------------------------------------------------------------------------------------------


def test_a_skid_is_flagged_and_nothing_else_is(r):
    too_much = sum(np.abs(side.sliding_force) > side.traction_limit for side in sides(r)) > 0
    assert np.array_equal(r.validity["skid"], ~skids(r) & ~too_much)
    assert not np.any(r.valid[skids(r)])
    assert np.all((r.rolling_share > 0) & (r.rolling_share <= 1))


def test_a_ball_that_skids_has_one_contact_at_its_limit(r):
    ratio = np.max([np.abs(side.sliding_force) / side.traction_limit for side in sides(r)], axis=0)
    assert np.all(np.abs(ratio[skids(r)] - 1) <= 2e-3)


def test_all_that_resists_falls_alike_in_a_skid(case, r):
    """The share scales rolling forces, hysteresis and the chain; what is left of them is reported."""
    asked = case(dataclasses.replace(reference, friction=constant_friction(1e6)))
    assert np.all(asked.rolling_share == 1)
    share = r.rolling_share
    for here, there in zip(sides(r), sides(asked), strict=True):
        for name in ("hydrodynamic_rolling_force", "elastic_resistance_moment"):
            expected = share * getattr(there, name)
            assert np.all(np.abs(getattr(here, name) - expected) <= RELATIVE * expected), name
    assert np.all(np.abs(r.ball_chain.moment - share * asked.ball_chain.moment) <= RELATIVE * asked.ball_chain.moment)
    assert np.all(np.abs(r.ball_to_ball_force - share * asked.ball_to_ball_force) <= RELATIVE)


# -- convergence -----------------------------------------------------------------------------------


def test_equilibrium_is_found(r):
    """A fixed number of steps is enough but for 1 case in 500 of those that are valid otherwise, and for 3 % of all."""
    assert np.array_equal(r.validity["equilibrium"], r.converged)
    valid_otherwise = np.all([r.validity[reason] for reason in REASONS if reason != "equilibrium"], axis=0)
    assert np.mean(~r.converged[valid_otherwise]) < 0.004
    assert np.mean(~r.converged) < 0.03


def test_more_steps_change_little(case, r, monkeypatch):
    shares = ellipse_slip.NEWTON_SHARES
    monkeypatch.setattr(ellipse_slip, "NEWTON_SHARES", shares + 40 * shares[-1:])
    many = case(reference)
    off = np.abs(r.screw_torque / many.screw_torque - 1)
    assert np.quantile(off[r.valid], 0.99) < 1e-4
    assert np.max(off[r.valid & (r.contact_load > LIGHT)]) < 2e-3
    # next to no load on a ball: creep is all that is left to find, and friction hardly holds it
    assert np.max(off[r.valid]) < 5e-3
    # where it has not converged, the torque is off by little
    assert np.max(off) < 0.05


def test_neighbours_change_nothing(case, r):
    """The number of steps is fixed, so a hard point in an array cannot move an easy one."""
    for i in range(0, SIZE, 997):
        parts = [
            dataclasses.replace(
                part,
                **{
                    field.name: float(value[i])
                    for field in dataclasses.fields(part)
                    if np.ndim(value := getattr(part, field.name))
                },
            )
            for part in (case.screw, case.oil)
        ]
        alone = reference(*parts, axial_load=float(case.axial_load[i]), screw_speed=float(case.screw_speed[i]))
        assert alone.screw_torque == pytest.approx(r.screw_torque[i], rel=1e-9)
        assert alone.valid == r.valid[i]


# -- the power where it is lost --------------------------------------------------------------------


def power_of_the_points(r, some):
    """Friction times load times slip over both contacts of one ball, point by point."""
    # t = sin(angle) across and x = sqrt(1 - t²) sin(other angle) along: smooth, also where the pressure ends
    nodes, weights = np.polynomial.legendre.leggauss(48)
    t, x = np.sin(np.pi / 2 * nodes), np.sin(np.pi / 2 * nodes[::3])
    across = np.pi / 2 * weights * np.cos(np.pi / 2 * nodes) * 3 / 4 * (1 - t**2)
    along = np.cos(np.pi / 2 * nodes[::3]) ** 2
    along = along / along.sum()
    total = 0.0
    for side in sides(r):
        a, R_d, kappa, limit = (
            np.broadcast_to(getattr(side, name), r.screw_torque.shape)[some][:, None]
            for name in ("semi_major_axis", "deformed_radius", "ellipticity", "traction_limit")
        )
        creep, rim, lateral = side.creep_speed[some], (side.spin * side.semi_major_axis)[some], side.lateral_slip_speed
        C = slip.curvature_slip_speed(a, R_d, (r.entrainment_speed / side.rolling_radius)[some][:, None])
        s = slip.path_slip_speed(creep[:, None], rim[:, None], C, t, slip.surface_depth(t, a, R_d))
        g = slip.local_spin_speed(rim[:, None], C, t)
        for place, weight in zip(x, along, strict=True):
            sideways = lateral[some][:, None] - place * np.sqrt(1 - t**2) / kappa * g
            total = total + np.sum(limit * weight * across * np.hypot(s, sideways), axis=1)
    return total


def power_of_the_forces(r):
    """The same by the resultants: sliding forces in creep, and the moments and the lateral force."""
    along = sum(
        side.sliding_force * side.creep_speed
        + side.curvature_friction_moment * r.entrainment_speed / side.rolling_radius
        for side in sides(r)
    )
    spin = r.spin_moment * kinematics.relative_spin(r.screw_speed, r.frame.rolling_plane_sine)
    D = kinematics.torsion_speed(r.screw_speed, r.ball_screw.ball_diameter, r.frame.lead_angle)
    return along + spin + r.lateral_force * D


def test_the_power_of_the_slip_is_what_every_point_of_the_contacts_loses(r):
    """The forces that the balance asks for are those that the slip gives rise to: their powers are the same."""
    some = np.flatnonzero((r.screw_speed > 0) & r.converged)[:2000]
    off = np.abs(power_of_the_forces(r)[some] / power_of_the_points(r, some) - 1)
    assert np.median(off) < 3e-3
    assert np.quantile(off, 0.95) < 0.015
    assert np.max(off) < 0.08


# -- proportions -----------------------------------------------------------------------------------


def test_slip_torque_is_proportional_to_friction(case):
    """Where nothing but sliding is lost, the balls slip as they must and the torque goes with the coefficient."""
    model = without_losses_of_rolling(reference)
    once, more = (case(dataclasses.replace(model, friction=constant_friction(mu))) for mu in (0.04, 0.12))
    assert np.all(np.abs(more.screw_torque - 3 * once.screw_torque) <= 1e-9 * more.screw_torque)
    assert np.all(slip_torque(once) == pytest.approx(once.screw_torque, rel=1e-12))


def test_torque_rises_with_the_load(case):
    constant = dataclasses.replace(reference, friction=constant_friction(0.1))
    torque = [case(constant, axial_load=factor * case.axial_load).screw_torque for factor in (1.0, 1.1, 2.0)]
    assert np.all(np.diff(torque, axis=0) > 0)


def test_torque_rises_with_boundary_friction(case):
    """More friction, more torque: also for a ball that skids, which it carries better."""
    results = [
        case(dataclasses.replace(reference, friction=LoadSharing(boundary_friction_coefficient=mu)))
        for mu in (0.08, 0.09, 0.15)
    ]
    for less, more in itertools.pairwise(results):
        rise = more.screw_torque / less.screw_torque - 1
        # a trace of it is left by the last step of the iteration, more of it where that has not converged
        assert np.all(rise[less.valid & more.valid] > -1e-3)
        assert np.mean(rise < 0) < 0.01


def test_slip_and_its_sign_of_a_steep_screw(case, r):
    """Spin and helix brake; so does the curvature, but for a trace of it where creep takes its place."""
    for mechanism in ("spin", "helix"):
        assert np.all(r.contributions[mechanism] >= -1e-12 * r.screw_torque)
    assert np.all(slip_torque(r) > 0)
    settled = r.converged & ~skids(r)
    assert np.all((r.contributions["curvature"] >= -1e-3 * r.screw_torque)[settled])


# -- four quadrants --------------------------------------------------------------------------------


def test_quadrants(r):
    """Friction opposes the rotation in all four; power in is power out and heat."""
    heat = r.friction_power
    lifted = r.ideal_torque * r.screw_speed
    for quadrant in r.quadrants.values():
        assert np.all(quadrant.shaft_power == quadrant.shaft_torque * quadrant.speed_sign * r.screw_speed)
        # what the shaft gives goes into the load and into heat
        into_the_load = quadrant.load_sign * quadrant.speed_sign * lifted
        gap = quadrant.shaft_power - into_the_load - heat
        assert np.all(np.abs(gap) <= 1e-11 * (lifted + heat))
    forward, back = r.quadrants["drives forward"], r.quadrants["is back-driven forward"]
    moving = r.screw_speed > 0
    assert np.all(r.drive_torque == np.where(moving, forward.shaft_torque, r.ideal_torque))
    assert np.all(r.quadrants["drives in reverse"].shaft_torque == -forward.shaft_torque)
    assert np.all(back.shaft_torque == -r.holding_torque)
    assert np.all(r.quadrants["is back-driven in reverse"].shaft_torque == r.holding_torque)
    useful = (lifted / np.where(moving, forward.shaft_power, 1.0))[moving]
    assert useful == pytest.approx(forward.efficiency[moving], rel=1e-12)
    # a shaft that has to push along with the load makes no use of it
    assert np.array_equal(back.efficiency <= 0, r.self_locking)
    assert np.array_equal(r.self_locking, r.holding_torque <= 0)
    freely = moving & ~r.self_locking
    gained = (-back.shaft_power / np.where(moving, lifted, 1.0))[freely]
    assert gained == pytest.approx(back.efficiency[freely], rel=1e-9, abs=1e-12)


def test_a_fine_lead_with_much_friction_locks_itself(seed_oil):
    screw = with_grooves(0.505, pitch_circle_diameter=0.100, lead=0.005, ball_diameter=3e-3, loaded_balls=200)
    rough = dataclasses.replace(reference, friction=constant_friction(1.0))
    locked, free = (model(screw, seed_oil, axial_load=20e3, screw_speed=0.0) for model in (rough, reference))
    assert locked.self_locking
    assert locked.holding_torque < 0
    assert locked.back_driving_efficiency < 0
    assert locked.efficiency < 0.5
    assert not free.self_locking
    assert free.efficiency > 0.7
