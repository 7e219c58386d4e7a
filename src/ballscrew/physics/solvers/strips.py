r"""The forces of a slipping contact, as sums over strips of its ellipse.

Friction has its full strength everywhere and the direction of the slip: the slope of friction,
load and slip speed by a freedom of the slip is the force that goes with it. A strip across the
ellipse slips with the root-mean-square of what happens in it
(:func:`~ballscrew.physics.equations.slip.cell_slip_speed`), which keeps all slopes smooth.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import AngularSpeed, Force, Length, Ratio, Speed
from ballscrew.physics.equations import slip

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
