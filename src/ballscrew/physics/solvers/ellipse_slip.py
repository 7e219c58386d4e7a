r"""Slip over the whole ellipse: curvature, spin, creep and the helix's lateral slip together.

A ball that rolls has four freedoms left: the creep at each contact, and how the two contacts share
the spin and the lateral slip that screw and nut force on them. With friction coefficient and
pressure given, the power lost in slip is a convex function of the four, and its slopes are the
forces: the balance of the ball is the minimum. So far this is exact, and
:mod:`oracles.contact_integral` minimises it on a fine grid. Here the ellipse is
cut into strips (:mod:`ballscrew.physics.solvers.slip`), each with its root-mean-square slip
(:func:`~ballscrew.physics.equations.slip.cell_slip_speed`), which keeps the function smooth and convex, and
the minimum is found by a fixed number of damped Newton steps from the closed form of
:mod:`~ballscrew.physics.solvers.line_slip`, on whole arrays.

Against the fine integral the slip torque is 0.02 % off in the median and 0.5 % at the 95th
percentile (``benchmarks/reference.py``). What the fixed steps leave of an imbalance never reaches the torques:
sliding forces are those of the balance, and spin moment and lateral force are one number for both
contacts, so that energy is conserved to rounding wherever the iteration stands.
"""

from __future__ import annotations

import operator
from collections.abc import Sequence
from typing import Any, NamedTuple

from ballscrew.basis.arrays import in_blocks, namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.physics.equations import kinematics, slip
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.traits import law_traits
from ballscrew.physics.solvers.line_slip import creep_of_lines, pure_rolling_lines
from ballscrew.physics.solvers.slip import (
    SMALLEST_SLIP,
    BallProblem,
    ContactSlip,
    Forces,
    Side,
    Slip,
    carried_share,
    contact_rotation,
    forces_of,
    shapes_of,
    sliding_forces,
    slip_power,
)

#: Share of Newton's second term at each evaluation of the forces; the rest is Weiszfeld's, which
#: cannot overshoot. A fixed number, so that neighbours in an array change nothing.
NEWTON_SHARES = (0.5, 0.9, 0.99, 0.999, 0.999, 0.999)
#: Where a step has made it worse, this much of it is tried instead.
BACKTRACK = 0.5
#: A ball whose contacts carry more than this share of their friction along the path is about to
#: skid, and its creep grows without limit: it is cut here.
LARGEST_TRACTION_RATIO = 0.999
#: Creep in units of the speed of rolling at which a ball has long been skidding. How fast it still
#: turns then, the model does not tell; up to here no power of its resistances changes sign.
LARGEST_CREEP = 0.5
#: Imbalance, in units of friction times load, that counts as balanced: it is for 99.8 % of the random screws
#: of ``benchmarks/reference.py`` that roll with elastic contacts. What it does to the torque is smaller by an
#: order.
TOLERANCE = 1e-2
#: What rounding may add to the power without a step being called worse.
ROUNDING = 1e-13
#: Newton's steps to the first guess of the shares.
STEPS_OF_SHARE = 4


class _Freedoms(NamedTuple):
    """Unknowns of the balance: creep at both contacts, and the nut's share of spin and lateral slip."""

    screw_creep: Speed
    nut_creep: Speed
    nut_spin: AngularSpeed
    nut_lateral: Speed


class _Solution(NamedTuple):
    """The slip in balance: its degrees of freedom, the loads that the ball transmits, and the imbalance left."""

    screw_creep: Speed
    nut_creep: Speed
    nut_spin: AngularSpeed
    nut_lateral: Speed
    screw_moment: Torque
    nut_moment: Torque
    spin_moment: Torque
    lateral_force: Force
    imbalance: Ratio


@law_traits(alternative=True, contacts_per_ball=frozenset({2, 4}))
def ellipse_slip(ball: BallProblem) -> Slip:
    """The slip law of the reference model: curvature, spin, creep and lateral slip over the ellipse."""
    share = carried_share(ball)
    sides = [
        _side(ball, contact, force)
        for contact, force in zip((ball.screw, ball.nut), sliding_forces(ball, share), strict=True)
    ]
    total_spin = kinematics.relative_spin(1.0, ball.frame.rolling_plane_sine)
    total_lateral = kinematics.torsion_speed(1.0, ball.ball_diameter, ball.frame.lead_angle)
    solution = _Solution(*in_blocks(_solve_slip, *sides[0], *sides[1], total_spin, total_lateral, ball.ball_diameter))
    on_screw = solution.screw_creep, total_spin - solution.nut_spin, total_lateral - solution.nut_lateral
    on_nut = solution.nut_creep, solution.nut_spin, solution.nut_lateral
    return Slip(
        screw=_contact_slip(ball, sides[0], solution.screw_moment, *on_screw),
        nut=_contact_slip(ball, sides[1], solution.nut_moment, *on_nut),
        spin_moment=solution.spin_moment,
        lateral_force=solution.lateral_force,
        rolling_share=share,
        residual=solution.imbalance,
        tolerance=TOLERANCE,
    )


def _side(ball: BallProblem, contact: Contact, sliding_force: Force) -> Side:
    a, R_d = contact.semi_major_axis, contact.deformed_radius
    limit = contact.friction_coefficient * contact.contact_load
    xp = namespace(limit, sliding_force)
    traction = xp.where(limit > 0, sliding_force / xp.where(limit > 0, limit, 1.0), 0.0)
    curvature = slip.curvature_slip_speed(a, R_d, contact_rotation(ball, contact))
    return Side(limit, traction, curvature, a, R_d, contact.ellipticity)


def _contact_slip(
    ball: BallProblem, side: Side, moment: Torque, creep: Speed, spin: AngularSpeed, lateral: Speed
) -> ContactSlip:
    """The slip at the speed of the screw; the creep of a ball that skids is cut, so that it still rolls forward."""
    xp = namespace(side.curvature, creep)
    omega, most = ball.screw_speed, LARGEST_CREEP * ball.frame.entrainment_speed(1.0)
    squared = -creep / xp.where(side.curvature > 0, side.curvature, 1.0)
    # the root of what is not chosen must have a slope, or its derivative spoils that of what is
    none = squared <= 0
    offset = xp.where(none, 0.0, xp.sqrt(xp.where(none, 1.0, squared)))
    cut = xp.minimum(xp.maximum(creep, -most), most)
    return ContactSlip(offset, moment, omega * cut, omega * spin, omega * lateral)


class _Transmitted(NamedTuple):
    """Moments and force that the tractions put on the ball."""

    screw_moment: Torque
    nut_moment: Torque
    spin_moment: Torque
    lateral_force: Force


class _Forced(NamedTuple):
    """Spin and lateral slip that screw and nut impose on the two contacts together."""

    spin: AngularSpeed
    lateral: Speed


class _Iterate(NamedTuple):
    """An iterate: the degrees of freedom, the loads that the ball transmits, and the next step.

    ``power`` is what the balance makes least: power lost in slip less that of the forces held.
    """

    freedoms: _Freedoms
    transmitted: _Transmitted
    imbalance: Ratio
    power: Speed
    step: _Freedoms


def _solve_slip(*numbers: Any) -> _Solution:
    """The balance of the slip: creep, shares of spin and lateral slip, and the forces they lead to."""
    screw, nut = Side(*numbers[:6]), Side(*numbers[6:12])
    forced, ball_diameter = _Forced(*numbers[12:14]), numbers[14]
    screw_strips, nut_strips = shapes_of(screw), shapes_of(nut)
    xp = namespace(screw.curvature, nut.traction, forced.lateral)

    def iterate(at: _Freedoms, newton_share: float) -> _Iterate:
        spin, lateral = forced.spin - at.nut_spin, forced.lateral - at.nut_lateral
        s = forces_of(screw, screw_strips, at.screw_creep, spin, lateral, newton_share)
        n = forces_of(nut, nut_strips, at.nut_creep, at.nut_spin, at.nut_lateral, newton_share)
        imbalance = _imbalance(screw, nut, s, n, ball_diameter)
        power = imbalance.screw_weight * (
            slip_power(screw, s, at.screw_creep, spin, lateral) - (s.path + imbalance.screw_path) * at.screw_creep
        ) + imbalance.nut_weight * (
            slip_power(nut, n, at.nut_creep, at.nut_spin, at.nut_lateral) - (n.path + imbalance.nut_path) * at.nut_creep
        )
        step = _newton_step(screw, nut, s, n, imbalance, at, forced)
        return _Iterate(at, _transmitted(screw, nut, s, n), imbalance.size, power, step)

    best = iterate(_start(screw, nut, forced), NEWTON_SHARES[0])
    for newton_share in NEWTON_SHARES[1:]:
        trial = iterate(_Freedoms(*map(operator.add, best.freedoms, best.step)), newton_share)
        worse = trial.power > best.power + ROUNDING * xp.abs(best.power)
        shorter = [BACKTRACK * move for move in best.step]
        best = _Iterate(
            _Freedoms(*_choose(xp, worse, best.freedoms, trial.freedoms)),
            _Transmitted(*_choose(xp, worse, best.transmitted, trial.transmitted)),
            xp.where(worse, best.imbalance, trial.imbalance),
            xp.where(worse, best.power, trial.power),
            _Freedoms(*_choose(xp, worse, shorter, trial.step)),
        )
    return _Solution(*best.freedoms, *best.transmitted, best.imbalance)


def _choose(xp: Any, mask: Mask, yes: Sequence[Any], no: Sequence[Any]) -> list[Any]:
    return [xp.where(mask, one, other) for one, other in zip(yes, no, strict=True)]


def _transmitted(screw: Side, nut: Side, s: Forces, n: Forces) -> _Transmitted:
    """The smaller of the two contacts' spin moments and lateral forces is what passes through the ball.

    In balance they are the same. Where one contact cannot hold what the other bears, the other's
    share of the slip has not converged yet, but the force has: it is all the weaker one can bear.
    """
    xp = namespace(s.spin, n.spin)
    return _Transmitted(
        _curvature_moment(screw, s),
        _curvature_moment(nut, n),
        xp.minimum(
            s.spin * screw.traction_limit * screw.semi_major_axis,
            n.spin * nut.traction_limit * nut.semi_major_axis,
        ),
        xp.minimum(s.lateral * screw.traction_limit, n.lateral * nut.traction_limit),
    )


def _curvature_moment(side: Side, forces: Forces) -> Torque:
    a, R_d = side.semi_major_axis, side.deformed_radius
    return forces.curvature * side.traction_limit * a**2 / (2 * R_d)


class _Imbalance(NamedTuple):
    """Residuals of the balance, in units of friction times load (and semi-axis)."""

    screw_path: Ratio
    nut_path: Ratio
    spin: Length
    lateral: Ratio
    screw_weight: Ratio
    nut_weight: Ratio
    size: Ratio


def _imbalance(screw: Side, nut: Side, s: Forces, n: Forces, ball_diameter: Length) -> _Imbalance:
    """Sliding forces as the balance asks for them, curvature moments included, less those of the slip."""
    xp = namespace(s.path, n.path, screw.traction)
    moments = _curvature_moment(screw, s) + _curvature_moment(nut, n)
    path: list[Ratio] = []
    for side, forces in ((screw, s), (nut, n)):
        loaded = side.traction_limit > 0
        by_curvature = moments / (ball_diameter * xp.where(loaded, side.traction_limit, 1.0))
        path.append(_bounded(side.traction + by_curvature) - forces.path)
    both = screw.traction_limit + nut.traction_limit
    weight = xp.where(both > 0, screw.traction_limit / xp.where(both > 0, both, 1.0), 0.5)
    a_s, a_n = weight * screw.semi_major_axis, (1 - weight) * nut.semi_major_axis
    spin, span = a_s * s.spin - a_n * n.spin, a_s + a_n
    lateral = weight * s.lateral - (1 - weight) * n.lateral
    relative_spin = spin / xp.where(span > 0, span, 1.0)
    size = xp.sqrt(path[0] ** 2 + path[1] ** 2 + relative_spin**2 + lateral**2)
    return _Imbalance(path[0], path[1], spin, lateral, weight, 1 - weight, size)


def _bounded(traction: Ratio) -> Ratio:
    xp = namespace(traction)
    return xp.minimum(xp.maximum(traction, -LARGEST_TRACTION_RATIO), LARGEST_TRACTION_RATIO)


def _start(screw: Side, nut: Side, forced: _Forced) -> _Freedoms:
    """Shares of spin and lateral slip from saturating forces, and the creep that the line law makes of them.

    What the force along the path leaves of the friction, the contact can set against the forced
    slip; it saturates where that outgrows the slip of the curvature.
    """
    xp = namespace(screw.curvature, screw.traction)
    limits: list[Any] = []
    scales: list[Any] = []
    for side in (screw, nut):
        outer = slip.nominal_sliding_speed(0.0, forced.spin * side.semi_major_axis, forced.lateral, side.ellipticity)
        own = slip.nominal_sliding_speed(side.curvature, 0.0, 0.0, side.ellipticity)
        limits.append(side.traction_limit * xp.sqrt(1 - _bounded(side.traction) ** 2) * outer)
        scales.append(own / xp.where(outer > 0, outer, 1.0))
    share = _nut_share(scales[0], scales[1], limits[0], limits[1])
    nut_spin, nut_lateral = share * forced.spin, share * forced.lateral
    return _Freedoms(
        _start_of_creep(screw, forced.spin - nut_spin, forced.lateral - nut_lateral),
        _start_of_creep(nut, nut_spin, nut_lateral),
        nut_spin,
        nut_lateral,
    )


def _start_of_creep(side: Side, spin: AngularSpeed, lateral: Speed) -> Speed:
    """Creep of the line law, and what lateral slip adds: it turns the friction away from the path."""
    xp = namespace(side.curvature, side.traction, spin)
    T, rim, loaded = _bounded(side.traction), spin * side.semi_major_axis, side.curvature > 0
    lines = pure_rolling_lines(xp.where(loaded, rim / xp.where(loaded, side.curvature, 1.0), 2.0), T)
    return creep_of_lines(lines, side.curvature, rim) + lateral * T / xp.sqrt(1 - T**2)


def _nut_share(screw_scale: Ratio, nut_scale: Ratio, screw_limit: Ratio, nut_limit: Ratio) -> Ratio:
    """Share of the nut in a slip that both contacts resist with the same force, limit · x/√(1 + x²), x = share/scale.

    In x of the weaker contact, what is sought is the root of an increasing concave function:
    Newton's steps from the left never overshoot.
    """
    xp = namespace(screw_scale, nut_scale, screw_limit, nut_limit)
    nut_is_weaker = nut_limit < screw_limit
    weak = xp.where(nut_is_weaker, nut_scale, screw_scale) + SMALLEST_SLIP
    strong = xp.where(nut_is_weaker, screw_scale, nut_scale) + SMALLEST_SLIP
    larger = xp.maximum(nut_limit, screw_limit)
    ratio = xp.where(larger > 0, xp.minimum(nut_limit, screw_limit) / xp.where(larger > 0, larger, 1.0), 1.0)
    x = 1 / (weak + ratio * strong)
    for _ in range(STEPS_OF_SHARE):
        root = xp.sqrt(1 + (1 - ratio**2) * x**2)
        x = x - (weak * x + ratio * strong * x / root - 1) / (weak + ratio * strong / root**3)
    weaker = xp.minimum(weak * x, 1.0)
    return xp.where(nut_is_weaker, weaker, 1 - weaker)


def _newton_step(
    screw: Side, nut: Side, s: Forces, n: Forces, imbalance: _Imbalance, at: _Freedoms, forced: _Forced
) -> _Freedoms:
    """Damped Newton step: the creeps eliminated, two equations left for the shares of the nut.

    No contact takes more than all of the spin or of the lateral slip, or less than none.
    """
    a_s, a_n = screw.semi_major_axis, nut.semi_major_axis
    w_s, w_n = imbalance.screw_weight, imbalance.nut_weight
    # with both creeps following, what the rim speed and the lateral slip still change
    s_spin, s_cross, s_lateral, s_spin_left, s_lateral_left = _eliminated(s, imbalance.screw_path)
    n_spin, n_cross, n_lateral, n_spin_left, n_lateral_left = _eliminated(n, imbalance.nut_path)
    spin_spin = w_s * a_s**2 * s_spin + w_n * a_n**2 * n_spin
    spin_lateral = w_s * a_s * s_cross + w_n * a_n * n_cross
    lateral_lateral = w_s * s_lateral + w_n * n_lateral
    spin_missing = imbalance.spin + w_s * a_s * s_spin_left - w_n * a_n * n_spin_left
    lateral_missing = imbalance.lateral + w_s * s_lateral_left - w_n * n_lateral_left
    xp = namespace(spin_spin, lateral_lateral)
    determinant = spin_spin * lateral_lateral - spin_lateral**2
    solvable = determinant > 0
    determinant = xp.where(solvable, determinant, 1.0)
    nut_spin = xp.where(solvable, (lateral_lateral * spin_missing - spin_lateral * lateral_missing) / determinant, 0.0)
    nut_lateral = xp.where(solvable, (spin_spin * lateral_missing - spin_lateral * spin_missing) / determinant, 0.0)
    nut_spin = xp.minimum(xp.maximum(at.nut_spin + nut_spin, 0.0), forced.spin) - at.nut_spin
    nut_lateral = xp.minimum(xp.maximum(at.nut_lateral + nut_lateral, 0.0), forced.lateral) - at.nut_lateral
    return _Freedoms(
        screw_creep=(imbalance.screw_path + s.path_spin * a_s * nut_spin + s.path_lateral * nut_lateral) / s.path_path,
        nut_creep=(imbalance.nut_path - n.path_spin * a_n * nut_spin - n.path_lateral * nut_lateral) / n.path_path,
        nut_spin=nut_spin,
        nut_lateral=nut_lateral,
    )


def _eliminated(forces: Forces, imbalance: Ratio) -> tuple[Ratio, Ratio, Ratio, Ratio, Ratio]:
    """Slopes by spin and lateral slip at a given force along the path, and what closing that force adds."""
    f = forces
    follow_spin, follow_lateral = f.path_spin / f.path_path, f.path_lateral / f.path_path
    return (
        f.spin_spin - follow_spin * f.path_spin,
        f.spin_lateral - follow_spin * f.path_lateral,
        f.lateral_lateral - follow_lateral * f.path_lateral,
        follow_spin * imbalance,
        follow_lateral * imbalance,
    )
