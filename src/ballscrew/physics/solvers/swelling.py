r"""The radial swelling of nut and shaft under the balls of a nut, and the balance with it.

The balls of a nut body push nut and screw apart with :math:`N = \sum Q \cos\alpha`. By Lamé's cylinders
(:mod:`ballscrew.physics.equations.rigidity`) a gap :math:`u = N / k_r` opens between them, the same along the body: a
wall as thick as a nut's carries the push of one ball over a turn and more. The gap moves the grooves apart. It is a
spring like the others, so that energy is kept, and the forces on nut and screw stay opposite and equal.

Each half of a preloaded nut has a gap of its own. The gaps are found by Newton's method around the balance of the
chain of balls; by the symmetry of the energy one slope serves for both.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Angle, Force, Length, Ratio
from ballscrew.physics.components.screw import dynamic_load_rating
from ballscrew.physics.equations import geometry
from ballscrew.physics.solvers.ball_springs import (
    BallSprings,
    Bars,
    Field,
    RadialPush,
    chain_balance,
    over_balls,
    tridiagonal,
)

#: Balls over their pitch circle between which the diameter is searched; real ones have 0.05 to 0.24.
SEARCHED = (0.02, 0.3)
#: Halvings of the interval: its end is within 1e-12 of the diameter.
_HALVINGS = 40


def ball_of_rating(
    rating: Force, ball_circle: Length, lead: Length, contact_angle: Angle, loaded_turns: Ratio
) -> Length:
    r"""Ball diameter, m, whose dynamic load rating by ISO 3408-5 is the one given; NaN where none searched has it.

    ``rating`` is the rating of one nut body (N), ``ball_circle`` the diameter of the helix of the ball centres (m),
    ``lead`` its lead (m), ``contact_angle`` in rad, ``loaded_turns`` the turns that carry load. Of a turn
    :math:`\pi d_m/(d_w \cos\varphi) - 1/2` balls are counted, the mean of the whole numbers of balls that find room:
    with whole ones the rating would fall where one fewer finds room. Searched are :data:`SEARCHED`.
    Found by bisection, as the rating then grows with the ball, by about its power of 1.3. The formulas are those of
    :mod:`ballscrew.physics.equations.life`, as recalled, corroborated for balls of 3 mm to 10 mm.
    """
    phi = geometry.lead_angle(lead, ball_circle)

    def rated(ball: Length) -> Force:
        in_a_turn = math.pi * ball_circle / ball / math.cos(phi) - 0.5
        return float(dynamic_load_rating(ball_circle, ball, contact_angle, phi, in_a_turn, loaded_turns))

    low, high = (share * ball_circle for share in SEARCHED)
    if not rated(low) <= rating <= rated(high):
        return math.nan
    for _ in range(_HALVINGS):
        middle = math.sqrt(low * high)
        low, high = (middle, high) if rated(middle) < rating else (low, middle)
    return math.sqrt(low * high)


#: Imbalance of the radial forces that counts as none, in units of the forces at work, and steps of the search at most.
BALANCED, STEPS = 1e-13, 40
#: Rounding of a sum of radial forces, in units of itself.
ROUNDING = 1e-15


class Swelling(NamedTuple):
    """Radial stiffness of each nut body, and which balls are of which (the bodies first, then the balls)."""

    stiffness: Field
    members: Field

    def of(self, rows: slice) -> Swelling:
        """The one nut body that has these balls."""
        members = self.members[:, rows]
        return Swelling(self.stiffness, members[members.any(axis=1)])

    def at(self, points: NDArray[np.intp]) -> Swelling:
        """Some of the operating points."""
        stiffness = self.stiffness
        return Swelling(stiffness if stiffness.shape[-1] == 1 else stiffness[points], self.members)

    def widened(self, springs: BallSprings, gap: Field) -> BallSprings:
        """The springs of balls between bodies with these gaps."""
        return springs.widened(gap, np.argmax(self.members, axis=0))

    def sums(self, by_ball: Field) -> Field:
        """Sums over the balls of each body."""
        return np.stack([over_balls(body[:, None] * by_ball) for body in self.members])


class Widened(NamedTuple):
    """A balance with swelling: the gaps of the bodies, the displacements, and what is left."""

    gap: Field
    displacement: Field
    imbalance: Force


def widened_balance(
    springs: BallSprings, bars: Bars, swelling: Swelling, load: Field, scale: Field, start: Field
) -> Widened:
    """The displacements of a chain of bars, and the gaps of its bodies, that carry a load, from a start.

    The chain is solved for given gaps. What has settled stays, so that no point depends on others.
    """
    x, here, gap = start.copy(), springs, np.zeros((len(swelling.members), load.size))
    left = np.zeros_like(gap)
    among, links, bodies = np.arange(load.size), bars, swelling
    for tried in range(STEPS):
        at = x[:, among]
        push = here.radial_push(at)
        now = bodies.sums(push.force) - bodies.stiffness * gap[:, among]
        left[:, among] = now
        still = _size(now) > BALANCED * scale[among] + ROUNDING * _size(bodies.sums(push.force))
        # the displacements to start at carry no load yet
        if tried and not still.any():
            break
        if tried and not still.all():
            open_ = np.flatnonzero(still)
            among, at, now = among[open_], at[:, open_], now[:, open_]
            here, links, bodies = here.at(open_), links.at(open_), bodies.at(open_)
            push = RadialPush(*(part[:, open_] for part in push))
        moved = _moved_by_gaps(bodies, links, here.forces(at)[1], push.cross)
        matrix = _matrix(bodies, push.slope, push.cross, moved)
        step = np.linalg.solve(matrix, now.T[..., None])[..., 0].T
        gap[:, among] += step
        here = bodies.widened(springs.at(among), gap[:, among])
        following = at + _along(moved, step)
        x[:, among] = chain_balance(here, links, load[among], scale[among], following)
    return Widened(gap, x, _size(left))


def widened_response(springs: BallSprings, bars: Bars, swelling: Swelling, displacement: Field, right: Field) -> Field:
    """Displacements by small forces at the balls, chain and gaps together."""
    push, slope = springs.radial_push(displacement), springs.forces(displacement)[1]
    alone = tridiagonal(bars.stiffness, slope, right)
    moved = _moved_by_gaps(swelling, bars, slope, push.cross)
    matrix = _matrix(swelling, push.slope, push.cross, moved)
    step = np.linalg.solve(matrix, swelling.sums(push.cross * alone).T[..., None])[..., 0].T
    return alone + _along(moved, step)


def _moved_by_gaps(swelling: Swelling, bars: Bars, slope: Field, cross: Field) -> Field:
    """Displacement of the balls by the gap of each body: bodies, balls, points."""
    return np.stack([tridiagonal(bars.stiffness, slope, body[:, None] * cross) for body in swelling.members])


def _along(moved: Field, step: NDArray[Any]) -> Field:
    """Displacement by a step of the gaps."""
    along = np.zeros_like(moved[0])
    for of_body, its_step in zip(moved, step, strict=True):
        along += of_body * its_step
    return along


def _matrix(swelling: Swelling, slope: Field, cross: Field, moved: Field) -> Field:
    """Slopes of the radial imbalance of each body by the gap of each, with the sign that a spring has; points first."""
    own = swelling.sums(slope).T
    through = np.stack([swelling.sums(cross * each) for each in moved]).transpose(2, 1, 0)
    stiffness = np.broadcast_to(swelling.stiffness, (slope.shape[-1],))
    diagonal = np.eye(len(swelling.members)) * (stiffness[:, None, None] - own[:, :, None])
    return diagonal - through


def _size(by_body: Field) -> Force:
    return np.max(np.abs(by_body), axis=0)


def excess_at_rest(
    preload: Field,
    radial_stiffness: Field,
    springs: BallSprings,
    loaded_balls: Field,
) -> Field:
    """Excess size of balls on both flanks of both bodies, such that each flank carries the preload without load."""
    A, alpha, c_phi, K = springs.centre_distance, springs.contact_angle, springs.lead_cosine, springs.load_deflection
    across, along = A * np.cos(alpha), A * np.sin(alpha)
    # both flanks push apart: 2 N = 2 F / (tan α' cos φ), and tan α' = along / (across - u); linear in u
    push = 2 * preload / (c_phi * radial_stiffness)
    if springs.constant_angle:
        sine, gap = np.sin(alpha), push * np.cos(alpha) / np.sin(alpha)
        opened = gap * np.cos(alpha)
    else:
        gap = push * across / (along + push)
        distance = np.hypot(across - gap, along)
        sine, opened = along / distance, gap * (2 * across - gap) / (A + distance)
    return (preload / (loaded_balls * sine * c_phi * K)) ** (2 / 3) + opened


def preload_of_oversize(
    oversize: Field, radial_stiffness: Field, springs: BallSprings, loaded_balls: Field, most: Field
) -> Field:
    """The preload that balls of an oversize make where the bodies swell: less than ``most``, that of rigid ones."""
    low, high = np.zeros_like(most), np.array(most, dtype=float)
    for _ in range(80):
        middle = (low + high) / 2
        too_much = excess_at_rest(middle, radial_stiffness, springs, loaded_balls) > oversize
        low, high = np.where(too_much, low, middle), np.where(too_much, middle, high)
    return (low + high) / 2
