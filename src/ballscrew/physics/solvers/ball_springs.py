r"""Balls as springs between screw and nut, and the chain that elastic bodies make of them.

Arrays have the balls first and the operating points last. The force of a ball rises with the displacement of
the screw at its place, whatever the nut, so that each balance here has one solution.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.physics.equations import rigidity

Field = NDArray[np.float64]

#: Imbalance that counts as none, in units of the forces at work.
BALANCED = 1e-13
#: Steps of a search at most, and halvings of a Newton step that has made it worse.
STEPS, HALVINGS = 100, 12
#: Points up to which chains are eliminated one by one.
FEW_POINTS = 8
#: Rounding of a place, in units of itself.
ROUNDING = 1e-15


class Flanks(NamedTuple):
    """One flank pair of each ball: which way it faces, where it stands without displacement, and its ball's excess."""

    #: One where an axial displacement of the screw loads the pair, minus one where it relieves it.
    facing: Field
    #: Displacement across the path without one of the screw.
    offset: Field
    #: What the ball is too big by for its grooves.
    excess: Field


class FlankLoads(NamedTuple):
    """Load of a flank pair, sine of its contact angle, axial force on the screw, and slope of that by displacement."""

    load: Field
    sine: Field
    axial_force: Field
    slope: Field


class RadialPush(NamedTuple):
    """Radial force of the balls apart, its slope by the gap between screw and nut, and by the axial displacement.

    The last is also what the gap takes from the axial force: both are derivatives of one energy.
    """

    force: Field
    slope: Field
    cross: Field


class PushedApart(NamedTuple):
    """Axial force of each ball and its slope by the displacement; its radial push, and the slopes of that.

    The last one, with the other sign, is the slope of the axial force by the gap.
    """

    force: Field
    slope: Field
    push: Field
    push_by_opening: Field
    push_by_displacement: Field


class BallSprings(NamedTuple):
    """The springs of the balls: one flank pair each, or two."""

    load_deflection: Field
    centre_distance: Field
    contact_angle: Field
    lead_cosine: Field
    #: How many balls each stands for.
    balls: Field
    #: Whether the contact angle keeps its value without load.
    constant_angle: bool
    flanks: tuple[Flanks, ...]

    def loads(self, flanks: Flanks, displacement: Field) -> FlankLoads:
        """Loads of the flank pairs at an axial displacement of the screw."""
        A, alpha, c_phi = self.centre_distance, self.contact_angle, self.lead_cosine
        xi = flanks.facing * displacement * c_phi + flanks.offset
        if self.constant_angle:
            sine, turning = np.sin(alpha), 0.0
            approach = xi * sine + flanks.excess
        else:
            s = rigidity.loaded_centre_distance(A, alpha, xi)
            sine = rigidity.loaded_contact_sine(A, alpha, xi, s)
            approach = rigidity.ball_approach(A, alpha, xi, s, flanks.excess)
            turning = (1 - sine**2) / s
        # a flank ends in the radial plane: beyond it there is none to touch
        delta = np.where(sine > 0, np.maximum(approach, 0.0), 0.0)
        load = rigidity.hertz_load(self.load_deflection, delta)
        slope = (1.5 * self.load_deflection * np.sqrt(delta) * sine**2 + load * turning) * c_phi**2
        return FlankLoads(load, sine, flanks.facing * load * sine * c_phi, slope)

    def forces(self, displacement: Field) -> tuple[Field, Field]:
        """Axial force of each ball (of all it stands for), and its slope by the displacement."""
        loads = [self.loads(flanks, displacement) for flanks in self.flanks]
        force, slope = sum(pair.axial_force for pair in loads), sum(pair.slope for pair in loads)
        return self.balls * force, self.balls * slope

    def radial_push(self, displacement: Field) -> RadialPush:
        """Radial force of each ball on nut and screw, and its slopes."""
        A, alpha, c_phi = self.centre_distance, self.contact_angle, self.lead_cosine
        total = [0 * displacement] * 3
        for flanks in self.flanks:
            there = self.loads(flanks, displacement)
            sine = there.sine
            delta = (there.load / self.load_deflection) ** (2 / 3)
            stiffness, cosine = 1.5 * self.load_deflection * np.sqrt(delta), np.sqrt(1 - sine**2)
            if self.constant_angle:
                turning = 0 * delta
            else:
                xi = flanks.facing * displacement * c_phi + flanks.offset
                turning = there.load / rigidity.loaded_centre_distance(A, alpha, xi)
            parts = (
                there.load * cosine,
                -(stiffness * cosine**2 + turning * sine**2),
                flanks.facing * c_phi * (stiffness - turning) * sine * cosine,
            )
            total = [so_far + self.balls * part for so_far, part in zip(total, parts, strict=True)]
        return RadialPush(*total)

    def pushed_apart(self, displacement: Field, gap: Field) -> PushedApart:
        """Forces of each ball at a displacement and in grooves that a gap has moved apart, with all slopes."""
        A, alpha, c_phi = self.centre_distance, self.contact_angle, self.lead_cosine
        total: list[Field] = [0.0 * displacement] * len(PushedApart._fields)
        for flanks in self.flanks:
            xi = flanks.facing * displacement * c_phi + flanks.offset
            if self.constant_angle:
                sine, cosine = np.sin(alpha), np.cos(alpha)
                approach, per_distance = xi * sine - gap * cosine + flanks.excess, 0.0
            else:
                across, along = A * np.cos(alpha), A * np.sin(alpha)
                s = np.sqrt((across - gap) ** 2 + (along + xi) ** 2)
                sine, cosine = (along + xi) / s, (across - gap) / s
                approach = (xi * (2 * along + xi) - gap * (2 * across - gap)) / (s + A) + flanks.excess
                per_distance = 1 / s
            delta = np.where(sine > 0, np.maximum(approach, 0.0), 0.0)
            load = rigidity.hertz_load(self.load_deflection, delta)
            stiffness, turning = 1.5 * self.load_deflection * np.sqrt(delta), load * per_distance
            parts = PushedApart(
                flanks.facing * c_phi * load * sine,
                c_phi**2 * (stiffness * sine**2 + turning * cosine**2),
                load * cosine,
                -(stiffness * cosine**2 + turning * sine**2),
                flanks.facing * c_phi * (stiffness - turning) * sine * cosine,
            )
            total = [so_far + self.balls * part for so_far, part in zip(total, parts, strict=True)]
        return PushedApart(*total)

    def widened(self, gap: Field, body: NDArray[np.intp]) -> BallSprings:
        """The springs of grooves that a radial gap has moved apart: another distance and angle.

        Gaps are those of the bodies, and ``body`` is that of each ball; what is the same at all balls of a body
        is worked out once.
        """
        A, alpha = self.centre_distance, self.contact_angle
        if self.constant_angle:
            return self._with_excess((-gap * np.cos(alpha))[body])
        across, along = A * np.cos(alpha) - gap, A * np.sin(alpha)
        distance = np.hypot(across, along)
        moved = self._with_excess((-gap * (2 * A * np.cos(alpha) - gap) / (A + distance))[body])
        return moved._replace(centre_distance=distance[body], contact_angle=np.arctan2(along, across)[body])

    def _with_excess(self, more: Field) -> BallSprings:
        return self._replace(flanks=tuple(each._replace(excess=each.excess + more) for each in self.flanks))

    def touch(self, flanks: Flanks) -> Field:
        """Displacement across the path at which a flank pair just touches."""
        A, alpha = self.centre_distance, self.contact_angle
        if self.constant_angle:
            return -flanks.excess / np.sin(alpha)
        return np.sqrt(np.maximum((A - flanks.excess) ** 2 - (A * np.cos(alpha)) ** 2, 0.0)) - A * np.sin(alpha)

    def of(self, rows: slice) -> BallSprings:
        """Some of the balls."""
        return self._replace(flanks=tuple(Flanks(*(part[rows] for part in flanks)) for flanks in self.flanks))

    def of_kinds(self, number: int) -> BallSprings:
        """One mean ball for so many in a row, which are of a kind."""

        def mean(part: Field) -> Field:
            return part.reshape(-1, number, part.shape[-1]).mean(axis=1)

        return self._replace(balls=number * self.balls, flanks=tuple(Flanks(*map(mean, each)) for each in self.flanks))

    def at(self, points: NDArray[np.intp]) -> BallSprings:
        """Some of the operating points."""
        return self._replace(
            load_deflection=_some(self.load_deflection, points),
            centre_distance=_some(self.centre_distance, points),
            contact_angle=_some(self.contact_angle, points),
            lead_cosine=_some(self.lead_cosine, points),
            balls=_some(self.balls, points),
            flanks=tuple(Flanks(*(_some(part, points) for part in each)) for each in self.flanks),
        )


class Bars(NamedTuple):
    """Axial stiffness of the bodies from ball to ball, and the share of the load that enters at the first ball.

    The rest enters at the last one.
    """

    stiffness: Field
    first_share: Field

    def of(self, rows: slice, first_share: float) -> Bars:
        """The bars between some of the balls, where the load enters otherwise."""
        return Bars(self.stiffness[rows], first_share + 0 * self.first_share)

    def at(self, points: NDArray[np.intp]) -> Bars:
        """Some of the operating points."""
        return Bars(_some(self.stiffness, points), _some(self.first_share, points))


def over_balls(values: Field) -> Field:
    """The sum over the balls, in the same order whatever the number of points and their places in memory."""
    return np.sum(np.ascontiguousarray(values.T), axis=-1)


def _some(values: Field, points: NDArray[np.intp]) -> Field:
    """Columns of an array, or all of it where the points do not differ."""
    return values if values.shape[-1] == 1 else values[..., points]


def rigid_balance(springs: BallSprings, load: Field, scale: Field, guess: Field, tolerance: float = BALANCED) -> Field:
    """The one displacement of a rigid screw in a rigid nut that balances a load.

    Newton's steps within a bracket; a step that leaves it is replaced by a bisection. ``scale`` are the
    forces against which an imbalance is judged, ``guess`` is a displacement of the right size.
    """

    def imbalance(here: BallSprings, load: Field, x: Field) -> tuple[Field, Field]:
        force, slope = here.forces(x[None])
        return over_balls(force) - load, over_balls(slope)

    # twice the guess beyond where the last ball touches, every ball carries more than its share
    touches = [np.max(np.abs(springs.touch(each) - each.offset), axis=0) for each in springs.flanks]
    reach = np.maximum.reduce(touches) / springs.lead_cosine + 2 * np.maximum(guess, 1e-12)
    low, high = -reach, reach
    for _ in range(STEPS):
        too_high, too_low = imbalance(springs, load, low)[0] > 0, imbalance(springs, load, high)[0] < 0
        if not (too_high.any() or too_low.any()):
            break
        low, high = np.where(too_high, 2 * low, low), np.where(too_low, 2 * high, high)
    # from where every ball that the load presses on is pressed; minus zero is no load on balls that face backwards
    x = np.where(np.signbit(load), low, high)
    among, here = np.arange(load.size), springs
    for _ in range(STEPS):
        at = x[among]
        left, slope = imbalance(here, load[among], at)
        low[among] = np.where(left < 0, at, low[among])
        high[among] = np.where(left > 0, at, high[among])
        still = (np.abs(left) > tolerance * scale[among]) & (high[among] - low[among] > 1e-16 * reach[among])
        if not still.any():
            break
        if not still.all():
            among, at, left, slope = among[still], at[still], left[still], slope[still]
            here = springs.at(among)
        newton = at - left / np.where(slope > 0, slope, 1.0)
        inside = (newton > low[among]) & (newton < high[among]) & (slope > 0)
        x[among] = np.where(inside, newton, (low[among] + high[among]) / 2)
    return x + 0 * springs.flanks[0].facing


def chain_balance(springs: BallSprings, bars: Bars, load: Field, scale: Field, start: Field) -> Field:
    """The displacements at which a chain of bars carries a load, from a start.

    Newton's method with a tridiagonal matrix, for the points that are still open. It points downhill for the
    sum of the squares of the imbalances; where the full step overshoots, a part of it is taken.
    """
    x = start.copy()
    size = np.empty_like(load)
    among = np.arange(load.size)
    left, slope = _imbalances(springs, bars, load, x)
    here, links = springs, bars
    for _ in range(STEPS):
        size[among] = _size(left)
        still = size[among] > BALANCED * scale[among] + _rounding(links, x[:, among])
        if not still.any():
            break
        if not still.all():
            among, left, slope = among[still], left[:, still], slope[:, still]
            here, links = springs.at(among), bars.at(among)
        step, at = tridiagonal(links.stiffness, slope, left), x[:, among]
        share = np.ones(among.size)
        for _ in range(HALVINGS):
            left, slope = _imbalances(here, links, load[among], at + share * step)
            worse = ~(_size(left) < size[among])
            if not worse.any():
                break
            share = np.where(worse, share / 2, share)
        x[:, among] = at + share * step
    # a common shift brings the sum of the forces to the load where rounding was in the way of the balls
    force, slope = springs.forces(x)
    stiffness = over_balls(slope)
    return x + np.where(stiffness > 0, (load - over_balls(force)) / np.where(stiffness > 0, stiffness, 1.0), 0.0)


def chain_imbalance(springs: BallSprings, bars: Bars, load: Field, displacement: Field) -> Field:
    """Root of the sum of the squares of what is left of the balance at the balls beyond rounding, N."""
    left, _ = _imbalances(springs, bars, load, displacement)
    return np.maximum(_size(left) - _rounding(bars, displacement), 0.0)


def _rounding(bars: Bars, displacement: Field) -> Field:
    """The forces that stiff bars make of rounded places, N."""
    most = np.max(bars.stiffness * np.abs(displacement[1:]), axis=0, initial=0.0)
    return ROUNDING * np.sqrt(len(displacement)) * most


def _imbalances(springs: BallSprings, bars: Bars, load: Field, x: Field) -> tuple[Field, Field]:
    """Force left at each ball, and the slope of the ball's own force."""
    force, slope = springs.forces(x)
    passed_on = bars.stiffness * np.diff(x, axis=0)
    left = -force
    left[0] += bars.first_share * load
    left[-1] += (1 - bars.first_share) * load
    left[:-1] += passed_on
    left[1:] -= passed_on
    return left, slope


def _size(left: Field) -> Field:
    return np.sqrt(over_balls(left**2))


def tridiagonal(bars: Field, grounds: Field, right: Field) -> Field:
    """Displacements of a chain of linear springs under forces: Thomas' elimination, which needs no pivots here.

    Each diagonal is the spring to ground plus what is left of the chain behind, in series with a
    bar: sums of what is not negative, so that stiff bars cost no digits.

    Few points are eliminated one by one, as plain numbers, with the same result to the last bit: an operation on an
    array of one element takes as long as 20 of them.
    """
    points = right.shape[-1]
    if points > FEW_POINTS:
        return _tridiagonal_side_by_side(bars, grounds, right)
    columns = [np.broadcast_to(values, (len(values), points)).T.tolist() for values in (bars, grounds, right)]
    try:
        moved = [_tridiagonal_of_one(*column) for column in zip(*columns, strict=True)]
    except ZeroDivisionError:  # neither bar nor ground: NaN, as of arrays
        return _tridiagonal_side_by_side(bars, grounds, right)
    return np.ascontiguousarray(np.array(moved).T)


def _tridiagonal_of_one(bars: list[float], grounds: list[float], right: list[float]) -> list[float]:
    """The elimination of one chain in plain numbers."""
    behind, carried = [grounds[0]], [right[0]]
    for bar, ground, force in zip(bars, grounds[1:], right[1:], strict=True):
        share = bar / (bar + behind[-1])
        carried.append(force + share * carried[-1])
        behind.append(ground + share * behind[-1])
    moved = [carried[-1] / (behind[-1] if behind[-1] > 0 else 1.0)]
    for bar, left, stiffness in zip(reversed(bars), reversed(carried[:-1]), reversed(behind[:-1]), strict=True):
        moved.append((left + bar * moved[-1]) / (bar + stiffness))
    return moved[::-1]


def _tridiagonal_side_by_side(bars: Field, grounds: Field, right: Field) -> Field:
    """The elimination of many chains, ball by ball."""
    behind = np.empty_like(right)
    carried = np.empty_like(right)
    behind[0], carried[0] = grounds[0], right[0]
    for i in range(1, len(right)):
        share = bars[i - 1] / (bars[i - 1] + behind[i - 1])
        behind[i] = grounds[i] + share * behind[i - 1]
        carried[i] = right[i] + share * carried[i - 1]
    moved = np.empty_like(right)
    moved[-1] = carried[-1] / np.where(behind[-1] > 0, behind[-1], 1.0)
    for i in range(len(right) - 2, -1, -1):
        moved[i] = (carried[i] + bars[i] * moved[i + 1]) / (bars[i] + behind[i])
    return moved
