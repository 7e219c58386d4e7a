r"""Protocol of slip laws: contact input, and the slip at which the ball is in balance; forces by strips of the ellipse.

The forces of a slipping contact are sums over strips of its ellipse. Friction has its full strength
everywhere and the direction of the slip: the slope of friction, load and slip speed by a freedom of
the slip is the force that goes with it. A strip across the ellipse slips with the root-mean-square
of what happens in it (:func:`~ballscrew.physics.equations.slip.cell_slip_speed`), which keeps all
slopes smooth.
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple, Protocol

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.physics.equations import friction, slip
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.torque import Resistances, ball_forces
from ballscrew.physics.laws.traits import law_traits


class BallProblem(NamedTuple):
    """One ball under load, all that resists it but the slip, and the speed of the screw."""

    screw: Contact
    nut: Contact
    resistances: Resistances
    ball_diameter: Length
    frame: Frame
    screw_speed: AngularSpeed
    pure_rolling_offset: Ratio | None


class ContactSlip(NamedTuple):
    """Slip of one contact, and the moment about the ball that its curvature causes."""

    pure_rolling_offset: Ratio
    curvature_moment: Torque
    creep_speed: Speed
    spin: AngularSpeed
    lateral_slip_speed: Speed


@dataclasses.dataclass(frozen=True, eq=False)
class Slip:
    """Outcome: the slip at both contacts, what they hand through the ball, and how well it closes.

    ``rolling_share`` is the share of the other resistances that friction can carry: below one the
    ball skids, and they fall until it is in balance.
    """

    screw: ContactSlip
    nut: ContactSlip
    spin_moment: Torque
    lateral_force: Force
    rolling_share: Ratio
    residual: Ratio
    tolerance: float

    @property
    def converged(self) -> Mask:
        """Mask: the slip balance converged."""
        return self.residual <= self.tolerance

    @property
    def advice(self) -> str:
        """Remedy where the balance did not converge."""
        return (
            "the contact is too large for its groove (check contact_load, ball_diameter and conformity), "
            "or the ball is about to skid (more load or less speed)"
        )


class SlipLaw(Protocol):
    """Slip of the contacts of a ball."""

    def __call__(self, ball: BallProblem, /) -> Slip:
        """The slip with which the ball is in balance."""
        ...


def contact_rotation(ball: BallProblem, contact: Contact) -> Ratio:
    """Rotation of ball against race in the contact, for one rad/s of the screw."""
    return ball.frame.entrainment_speed(1.0) / contact.rolling_radius


def sliding_forces(ball: BallProblem, rolling_share: Ratio) -> tuple[Force, Force]:
    """Sliding forces at screw and nut that hold what resists the ball, without the curvature moments."""
    forces = ball_forces(ball.resistances.scaled(rolling_share), ball.ball_diameter, ball.frame)
    return forces.screw_sliding_force, forces.nut_sliding_force


def carried_share(ball: BallProblem) -> Ratio:
    """Share of the resistances, slip aside, that the friction of both contacts can carry; one at most.

    What friction can carry is its coefficient times the load, less what the curvature moments may
    ask of it at most, 0.1 µQa²/R_d at each contact.
    """
    limits = [contact.friction_coefficient * contact.contact_load for contact in (ball.screw, ball.nut)]
    curvature = sum(
        0.1 * limit * contact.semi_major_axis**2 / (contact.deformed_radius * ball.ball_diameter)
        for limit, contact in zip(limits, (ball.screw, ball.nut), strict=True)
    )
    forces = sliding_forces(ball, 1.0)
    xp = namespace(curvature, *limits, *forces)
    share = 1.0
    for limit, force in zip(limits, forces, strict=True):
        needed = xp.abs(force)
        left = xp.maximum(limit - curvature, 0.0)
        share = xp.minimum(share, xp.where(needed > left, left / xp.where(needed > left, needed, 1.0), 1.0))
    return share


#: A fixed number of steps: block sizes and neighbours in an array cannot change a result.
NEWTON_STEPS = 5
#: The relative change of the last step that still counts as converged.
TOLERANCE = 1e-12


@law_traits(
    excluded="leaves spin and lateral slip out: a known error, and no doubt", curvature_alone=True, lateral_slip=False
)
def curvature_slip(ball: BallProblem) -> Slip:
    """The paper's slip law: curvature alone, its lines imposed at a given offset or found from equilibrium.

    No spin, no lateral slip, and the ball rolls as if the races did not creep. A ball that would
    skid keeps its resistances; the result's ``skid`` validity tells.
    """
    if ball.pure_rolling_offset is not None:
        offsets = (ball.pure_rolling_offset, ball.pure_rolling_offset)
        residual: Ratio = 0.0
    else:
        screw_force, nut_force = sliding_forces(ball, 1.0)
        *offsets, residual = solve(ball.screw, ball.nut, screw_force, nut_force, ball.ball_diameter)
    screw, nut = (
        ContactSlip(offset, contact.curvature_moment_at(offset), 0.0, 0.0, 0.0)
        for contact, offset in zip((ball.screw, ball.nut), offsets, strict=True)
    )
    return Slip(screw, nut, 0.0, 0.0, 1.0, residual, TOLERANCE)


def solve(
    screw: Contact, nut: Contact, screw_force_at_rest: Force, nut_force_at_rest: Force, ball_diameter: Length
) -> tuple[Ratio, Ratio, Ratio]:
    """Offsets for which the traction of each contact is the sliding force that equilibrium asks for.

    ``screw_force_at_rest`` and ``nut_force_at_rest`` are the sliding forces without the curvature
    moments. Where a sliding force exceeds µQ the ball skids: no offset satisfies equilibrium, the
    traction saturates at its limit, and the result is flagged by its ``skid`` validity. Without
    load the traction ratio is undefined; it is taken as saturated, and the moments vanish. Returns
    the offsets at screw and nut, and the relative imbalance that is left.
    """
    xp = namespace(screw.friction_coefficient, nut.friction_coefficient, screw_force_at_rest, nut_force_at_rest)
    zero = 0 * screw.contact_load
    sides = ((screw, screw_force_at_rest), (nut, nut_force_at_rest))

    def sums(total: Torque) -> tuple[Torque, Ratio, list[Ratio]]:
        moments, slope, offsets = zero, zero, []
        for contact, force_at_rest in sides:
            limit = contact.friction_coefficient * contact.contact_load
            force = force_at_rest + total / ball_diameter
            ratio = xp.where(limit > 0, force / xp.where(limit > 0, limit, 1.0), xp.where(force < 0, -1.0, 1.0))
            bounded = xp.minimum(xp.maximum(ratio, -1.0), 1.0)
            offset = friction.offset_from_traction(bounded)
            sliding_freely = xp.abs(ratio) < 1
            moments = moments + contact.curvature_moment_at(offset)
            slope = slope + xp.where(
                sliding_freely,
                contact.semi_major_axis**2 * offset**2 / (2 * contact.deformed_radius * ball_diameter),
                0.0,
            )
            offsets.append(offset)
        return moments, slope, offsets

    total = zero
    for _ in range(NEWTON_STEPS):
        moments, slope, _ = sums(total)
        total = total + (moments - total) / (1 - slope)
    moments, _, (screw_offset, nut_offset) = sums(total)
    scale = xp.abs(moments) + xp.abs(total)
    residual = xp.abs(moments - total) / xp.where(scale > 0, scale, 1.0)
    return screw_offset, nut_offset, residual


#: Strips of the ellipse. Against the integral, the 95th percentile of the error is 0.5 % with 8 and rises a little
#: with more (``benchmarks/reference.py --strips``): what is left is not the strips' but the mean along the path.
NUMBER_OF_STRIPS = 8
#: Share of the variance of heights that counts. Slip along the path that varies within a strip adds to
#: its mean size only where it changes sign; the root of the mean square would add everywhere. With a
#: quarter, both have the same sum over the strips to both sides of a change of sign (to five half-widths).
ALIGNED = 0.25
#: Slip speed (for one rad/s of the screw, m/s), below which friction is not dry but viscous.
SMALLEST_SLIP = 1e-12


class Strip(NamedTuple):
    """A strip of the ellipse: its share of the load, its mean height, and the variance of heights."""

    share: float
    height: float
    variance: float


def strips_of(number: int) -> tuple[Strip, ...]:
    """Strips of equal width; Hertz pressure, summed along the strip, goes with 1 - t²."""

    def moment(power: int) -> np.ndarray[Any, Any]:
        t = np.linspace(-1, 1, number + 1)
        return np.diff(0.75 * (t ** (power + 1) / (power + 1) - t ** (power + 3) / (power + 3)))

    share, height = moment(0), moment(1) / moment(0)
    variance = moment(2) / share - height**2
    return tuple(Strip(*map(float, strip)) for strip in zip(share, height, variance, strict=True))


STRIPS = strips_of(NUMBER_OF_STRIPS)


class Side(NamedTuple):
    """A contact as its slip sees it; speeds are those of one rad/s of the screw."""

    traction_limit: Force
    traction: Ratio
    curvature: Speed
    semi_major_axis: Length
    deformed_radius: Length
    ellipticity: Ratio


class Shape(NamedTuple):
    """A strip on the contact at hand: its depth, and the variance of the distances from its middle."""

    strip: Strip
    depth: Ratio
    variance: Ratio


def shapes_of(side: Side) -> tuple[Shape, ...]:
    """Along the path a strip is as long as the ellipse is there, b√(1-t²) to both sides, with a quarter as variance."""
    return tuple(
        Shape(
            strip,
            slip.surface_depth(strip.height, side.semi_major_axis, side.deformed_radius) + strip.variance,
            (1 - strip.height**2) / (4 * side.ellipticity**2) + ALIGNED * strip.variance,
        )
        for strip in STRIPS
    )


class Forces(NamedTuple):
    """Slopes of the slip power in units of friction times load, and the slopes of these.

    By creep (path), by the rim speed of the spin, by the lateral slip, and by the curvature slip.
    """

    path: Ratio
    spin: Ratio
    lateral: Ratio
    curvature: Ratio
    path_path: Ratio
    path_spin: Ratio
    path_lateral: Ratio
    spin_spin: Ratio
    spin_lateral: Ratio
    lateral_lateral: Ratio


def forces_of(
    side: Side, shapes: tuple[Shape, ...], creep: Speed, spin: AngularSpeed, lateral: Speed, newton_share: float
) -> Forces:
    """The forces of a contact: sums over its strips of load, direction of slip, and lever."""
    xp = namespace(side.curvature, creep, spin, lateral)
    C, rim = side.curvature, spin * side.semi_major_axis
    sums: list[Any] = [0.0] * 12
    for strip, depth, variance in shapes:
        t = strip.height
        s = slip.path_slip_speed(creep, rim, C, t, depth)
        g = slip.local_spin_speed(rim, C, t)
        twist = variance * g
        lever = s * t + twist
        bend = s * depth + 2 * t * twist
        r = slip.cell_slip_speed(s, g, lateral, variance)
        inverse = xp.minimum(strip.share / r, strip.share / SMALLEST_SLIP)
        second = newton_share / strip.share**2 * inverse**3
        along, about = second * s, second * lever
        terms = (
            inverse, inverse * t, inverse * (t**2 + variance),
            inverse * s, inverse * lever, inverse * bend,
            second, along, about, along * s, along * lever, about * lever,
        )  # fmt: skip
        sums = [total + term for total, term in zip(sums, terms, strict=True)]
    flat, tilt, width, path, by_spin, by_curvature, curl, along, about, path_path, path_spin, spin_spin = sums
    return Forces(
        path=path,
        spin=by_spin,
        lateral=lateral * flat,
        curvature=by_curvature,
        path_path=flat - path_path,
        path_spin=tilt - path_spin,
        path_lateral=-lateral * along,
        spin_spin=width - spin_spin,
        spin_lateral=-lateral * about,
        lateral_lateral=flat - lateral**2 * curl,
    )


def slip_power(side: Side, forces: Forces, creep: Speed, spin: AngularSpeed, lateral: Speed) -> Speed:
    """Power lost in the slip of a contact, in units of friction times load: forces times their slips."""
    rim = spin * side.semi_major_axis
    return forces.path * creep + forces.spin * rim + forces.lateral * lateral + forces.curvature * side.curvature
