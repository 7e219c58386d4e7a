"""The solver of the lines of pure rolling, against independent ones."""

import dataclasses
from typing import NamedTuple

import mpmath
import numpy as np
import pytest

import ballscrew as bs
from ballscrew.physics.equations import equilibrium, friction
from ballscrew.physics.laws.torque import Resistances
from ballscrew.physics.solvers import slip
from ballscrew.physics.solvers.slip import BallProblem
from support import strategies

CORRECTED = bs.FrictionModel.corrected()
BOX = 100_000


def without_curvature(r):
    """Sliding forces of a result as they are without the curvature moments, at screw and nut."""
    s, n, chain = r.screw, r.nut, r.ball_chain
    forces = (
        s.elastic_resistance_moment + n.elastic_resistance_moment,
        chain.moment,
        r.ball_screw.ball_diameter,
        s.hydrodynamic_rolling_force,
        n.hydrodynamic_rolling_force,
        r.frame.curvature_ratio,
        chain.braking_force,
    )
    return equilibrium.screw_sliding_force(*forces), equilibrium.nut_sliding_force(*forces)


class Outcome(NamedTuple):
    """The solver's own answer for the contacts of a result, and the moments that go with it."""

    screw_offset: object
    nut_offset: object
    residual: object
    screw_moment: object
    nut_moment: object


def outcome(r):
    found = slip.solve(r.screw, r.nut, *without_curvature(r), r.ball_screw.ball_diameter)
    moments = (side.curvature_moment_at(offset) for side, offset in zip((r.screw, r.nut), found[:2], strict=True))
    return Outcome(*found, *moments)


def ball_problem(r, pure_rolling_offset=None):
    """What the slip law was asked for a result."""
    sides = (r.screw, r.nut)
    asked = Resistances(
        *(side.hydrodynamic_rolling_force for side in sides),
        *(side.elastic_resistance_moment for side in sides),
        r.ball_chain,
    )
    d_w = r.ball_screw.ball_diameter
    return BallProblem(*sides, asked, d_w, r.frame, r.screw_speed, pure_rolling_offset)


def box(size=BOX, seed=2005):
    """What the corrected model says of random screws, oils and operating points."""
    return strategies.box(size, seed)(CORRECTED)


@pytest.fixture(scope="module")
def anywhere():
    return box()


def moments_by_bisection(r):
    """Both curvature moments by bisection alone: no closed form for Y, no Newton step, no slope."""
    contacts = (r.screw, r.nut)
    at_rest = without_curvature(r)
    d_w = r.ball_screw.ball_diameter
    bound = sum(
        0.1 * c.friction_coefficient * c.contact_load * c.semi_major_axis**2 / c.deformed_radius for c in contacts
    )

    def offset(ratio):
        low, high = np.zeros_like(ratio), np.ones_like(ratio)
        for _ in range(60):
            middle = (low + high) / 2
            # the traction falls with the offset
            carries_more = 1 - 3 * middle + middle**3 > ratio
            low, high = np.where(carries_more, middle, low), np.where(carries_more, high, middle)
        return (low + high) / 2

    def offsets(total):
        return [
            offset((force + total / d_w) / (c.friction_coefficient * c.contact_load))
            for c, force in zip(contacts, at_rest, strict=True)
        ]

    low, high = -bound, +bound
    for _ in range(60):
        middle = (low + high) / 2
        both = sum(c.curvature_moment_at(Y) for c, Y in zip(contacts, offsets(middle), strict=True))
        too_small = both > middle
        low, high = np.where(too_small, middle, low), np.where(too_small, high, middle)
    return [c.curvature_moment_at(Y) for c, Y in zip(contacts, offsets((low + high) / 2), strict=True)], bound


def test_converges_everywhere(anywhere):
    """A fixed number of steps is enough for every contact that fits its groove."""
    found = slip.curvature_slip(ball_problem(anywhere))
    assert np.all(found.converged)
    assert found.tolerance == slip.TOLERANCE
    assert np.max(found.residual) <= slip.TOLERANCE
    assert np.max(outcome(anywhere).residual) <= slip.TOLERANCE
    assert np.all(anywhere.converged)
    assert np.all(anywhere.validity["equilibrium"])


@pytest.mark.slow
def test_more_steps_change_nothing(anywhere, monkeypatch):
    few = outcome(anywhere)
    monkeypatch.setattr(slip, "NEWTON_STEPS", 3 * slip.NEWTON_STEPS)
    many = outcome(anywhere)
    scale = np.abs(many.screw_moment) + np.abs(many.nut_moment)
    assert np.all(np.abs(few.screw_moment - many.screw_moment) <= 1e-12 * scale)
    assert np.all(np.abs(few.nut_moment - many.nut_moment) <= 1e-12 * scale)


def test_traction_is_what_equilibrium_asks_for(anywhere):
    """Away from skidding, µQ (1 − 3Y + Y³) is the sliding force of the whole equilibrium."""
    rolls = anywhere.validity["skid"]
    assert 0.5 < rolls.mean() < 1
    for side in (anywhere.screw, anywhere.nut):
        limit = side.traction_limit
        carried = limit * friction.traction_ratio(side.pure_rolling_offset)
        assert np.all((np.abs(carried - side.sliding_force) <= 1e-12 * limit)[rolls])
        assert np.all((side.pure_rolling_offset >= 0) & (side.pure_rolling_offset <= 1))


@pytest.mark.slow
def test_agrees_with_bisection():
    r = box(5000, seed=7)
    (screw_moment, nut_moment), bound = moments_by_bisection(r)
    found = outcome(r)
    assert np.all(np.abs(found.screw_moment - screw_moment) <= 1e-11 * bound)
    assert np.all(np.abs(found.nut_moment - nut_moment) <= 1e-11 * bound)


@pytest.mark.parametrize("ratio", [-0.999, -0.5, -1e-3, 0.0, 1e-6, 0.02, 0.3, 0.9, 0.999999])
def test_offset_is_the_root_of_the_cubic(ratio):
    """The closed form against a bracketing root of 1 − 3Y + Y³ = T with 30 digits."""
    with mpmath.workdps(30):
        root = mpmath.findroot(lambda Y: 1 - 3 * Y + Y**3 - mpmath.mpf(ratio), (0, 1), solver="anderson")
        assert 0 <= root <= 1
        expected = float(root)
    assert friction.offset_from_traction(ratio) == pytest.approx(expected, rel=1e-12, abs=0)


@pytest.mark.parametrize("axial_load", [40.0, 800.0, 4000.0])
def test_agrees_with_a_solution_in_both_offsets(seed_screw, seed_oil, axial_load):
    """Both equations in Y_s and Y_n at once, with 30 digits."""
    r = CORRECTED(seed_screw, seed_oil, axial_load=axial_load, screw_speed=20.0)
    contacts = (r.screw, r.nut)
    at_rest = without_curvature(r)
    with mpmath.workdps(30):

        def residuals(*offsets):
            moments = sum(c.curvature_moment_at(Y) for c, Y in zip(contacts, offsets, strict=True))
            return [
                (force + moments / r.ball_screw.ball_diameter) / mpmath.mpf(c.traction_limit) - (1 - 3 * Y + Y**3)
                for c, force, Y in zip(contacts, at_rest, offsets, strict=True)
            ]

        roots = [float(root) for root in mpmath.findroot(residuals, (0.3, 0.3))]
    assert [c.pure_rolling_offset for c in contacts] == pytest.approx(roots, rel=1e-12)


def test_skid_saturates_and_still_balances():
    """Beyond µQ the traction stays at its limit; torques still balance, and the result says so."""
    r = box(20_000, seed=3)
    skids = ~r.validity["skid"] & (r.contact_load > 0)
    assert skids.sum() > 100
    for side in (r.screw, r.nut):
        ratio = side.sliding_force / side.traction_limit
        most = side.curvature_moment_at(0.0)
        driven, dragged = ratio > 1 + 1e-9, ratio < -1 - 1e-9
        assert np.all(side.pure_rolling_offset[driven] == 0)
        assert np.allclose(side.curvature_friction_moment[driven], most[driven], rtol=1e-14)
        assert np.allclose(side.pure_rolling_offset[dragged], 1, rtol=1e-14)
        assert np.allclose(side.curvature_friction_moment[dragged], -most[dragged], rtol=1e-13)
    pushing = r.ball_screw.loaded_balls * r.net_braking_force * r.frame.path_radius
    scale = sum(np.abs(part) for part in r.contributions.values()) + np.abs(r.nut_torque)
    assert np.all(np.abs(r.screw_torque - r.nut_torque - pushing) <= 1e-12 * scale)
    assert np.all(np.abs(r.screw_torque * r.screw_speed - r.friction_power) <= 1e-12 * scale * r.screw_speed)
    assert not np.any(r.valid[skids])


def test_without_load_the_moments_vanish(seed_screw, seed_oil):
    r = CORRECTED(seed_screw, seed_oil, axial_load=np.zeros(3), screw_speed=np.array([0.0, 1.0, 100.0]))
    found = outcome(r)
    for moment in (found.screw_moment, found.nut_moment):
        assert np.array_equal(moment, np.zeros(3))
    for offset in (found.screw_offset, found.nut_offset):
        assert np.all((offset == 0) | (np.abs(offset - 1) < 1e-15))
    assert np.all(found.residual == 0)
    assert np.all(r.converged)


def test_imposed_offset_is_taken_as_it_is(seed_screw, seed_oil):
    r = CORRECTED(seed_screw, seed_oil, axial_load=4000.0, screw_speed=60.0)
    given = slip.curvature_slip(ball_problem(r, 0.34))
    assert given.screw.pure_rolling_offset == given.nut.pure_rolling_offset == 0.34
    assert given.screw.curvature_moment == r.screw.curvature_moment_at(0.34)
    assert given.nut.curvature_moment == r.nut.curvature_moment_at(0.34)
    assert given.converged
    model = dataclasses.replace(CORRECTED, pure_rolling_offset=0.34)
    assert model(seed_screw, seed_oil, axial_load=4000.0, screw_speed=60.0).nut.pure_rolling_offset == 0.34


def test_what_does_not_converge_says_so(seed_screw, seed_oil):
    """Ellipses wider than the ball, and neighbours that push as hard as the load: some of these do not close."""
    load, share = (x.ravel() for x in np.meshgrid(np.logspace(3, 9, 401), np.logspace(-3, 0, 101)))
    model = dataclasses.replace(CORRECTED, ball_to_ball_force=share * load / 56)
    r = model(seed_screw, seed_oil, axial_load=load, screw_speed=10.0)
    open_ = ~r.converged
    assert 0 < open_.sum() < 0.1 * load.size
    assert np.min(r.nut.semi_major_axis[open_]) > seed_screw.ball_diameter
    assert not np.any(r.validity["equilibrium"][open_])
    assert not np.any(r.valid[open_])
    assert any(warning.startswith("equilibrium:") for warning in r.warnings)
    assert np.all(np.isfinite(r.screw_torque))
    assert "conformity" in slip.curvature_slip(ball_problem(r)).advice


def test_curvature_alone_neither_spins_nor_creeps(seed_screw, seed_oil):
    """The paper's slip law hands nothing through the ball but forces along the path, and never skids."""
    r = CORRECTED(seed_screw, seed_oil, axial_load=4000.0, screw_speed=60.0)
    found = slip.curvature_slip(ball_problem(r))
    assert found.spin_moment == found.lateral_force == 0
    assert found.rolling_share == r.rolling_share == 1
    for side in (found.screw, found.nut, r.screw, r.nut):
        assert side.creep_speed == side.spin == side.lateral_slip_speed == 0
    assert found.screw.curvature_moment == r.screw.curvature_friction_moment
    assert found.nut.curvature_moment == r.nut.curvature_friction_moment


def test_a_point_does_not_see_its_neighbours(anywhere):
    """The number of steps is fixed, so a hard point in an array cannot move an easy one."""
    found = outcome(anywhere)
    part = slice(123, 457)
    ball = anywhere.kinds[0].friction
    some = dataclasses.replace(
        ball,
        ball_diameter=ball.ball_diameter[part],
        screw=cut(ball.screw, part),
        nut=cut(ball.nut, part),
        frame=cut(ball.frame, part),
        ball_chain=type(ball.ball_chain)(*(x[part] for x in ball.ball_chain)),
    )
    kind = dataclasses.replace(anywhere.kinds[0], friction=some)
    screw = dataclasses.replace(anywhere.ball_screw, ball_diameter=anywhere.ball_screw.ball_diameter[part])
    again = outcome(dataclasses.replace(anywhere, ball_screw=screw, frame=some.frame, kinds=(kind,)))
    assert np.allclose(again.screw_offset, found.screw_offset[part], rtol=1e-13, atol=1e-15)


def cut(part, where):
    """A dataclass of arrays, cut to some of the points."""
    return dataclasses.replace(
        part,
        **{
            field.name: value[where]
            for field in dataclasses.fields(part)
            if isinstance(value := getattr(part, field.name), np.ndarray) and value.ndim
        },
    )
