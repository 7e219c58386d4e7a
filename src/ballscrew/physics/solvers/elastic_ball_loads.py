"""The balls of one nut between its bodies: blocks of operating points, solved with the ball axis first.

What :mod:`ballscrew.physics.solvers.load_distribution` describes and returns is worked out here: which flanks a nut's
balls have, how its halves are braced, and what follows from the displacements of
:mod:`ballscrew.physics.solvers.ball_springs`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Force, Length, Ratio
from ballscrew.physics.solvers.ball_springs import (
    BallSprings,
    Bars,
    Field,
    Flanks,
    chain_balance,
    chain_imbalance,
    rigid_balance,
    tridiagonal,
)
from ballscrew.physics.solvers.compiled_chain import (
    CarriedLoads,
    compiled_chain_balance,
    compiled_imbalance,
    compiled_loads,
    compiled_response,
    compiled_widened_balance,
    compiled_widened_response,
)
from ballscrew.physics.solvers.rigid_ball_loads import PICOMETRE, RigidNut, rigid_lift_off_load
from ballscrew.physics.solvers.swelling import (
    Swelling,
    excess_at_rest,
    preload_of_oversize,
    widened_balance,
    widened_response,
)

#: Imbalance of a ball between its bars that rounding may leave, in the same units.
LARGEST_OF_A_BALL = 1e-6
#: Imbalance of the rigid screw from which the elastic one starts.
START = 0.1
#: The search for the load that lifts off: steps at most, how much further the end of its bracket is moved at once, an
#: overlap that counts as none, in units of the distance of the groove centres, and a bracket that is narrow enough.
STEPS, BEYOND, NO_OVERLAP, ROUNDING = 60, 1.5, 1e-12, 1e-12


class NutCase(NamedTuple):
    """Parameters common to all operating points."""

    balls: int
    halves: int
    oversize: bool
    elastic: bool
    swells: bool
    same_side: bool
    constant_angle: bool
    scatters: bool
    excess: Field
    lead_error: Field
    compiled: bool = False


class NutPoint(NamedTuple):
    """State of each operating point."""

    load: Field
    preload: Field
    contact_angle: Field
    lead_cosine: Field
    centre_distance: Field
    load_deflection: Field
    loaded_balls: Field
    spacing: Field
    screw_bar: Field
    nut_bar: Field
    step: Field
    radial_stiffness: Field
    oversize: Field

    @property
    def direction(self) -> Field:
        """Direction in which the load presses: one forwards, minus one backwards."""
        return np.where(self.load < 0, -1.0, 1.0)

    @property
    def link(self) -> Field:
        """Stiffness per length of both bodies in series."""
        return 1 / (1 / self.screw_bar + 1 / self.nut_bar)

    @property
    def forces_at_work(self) -> Field:
        """Load and preload, against which an imbalance is judged; without both, what a picometre gives."""
        return np.maximum(np.abs(self.load) + self.preload, self.loaded_balls * self.load_deflection * PICOMETRE**1.5)

    def approach(self, force: Field) -> Field:
        """Approach of balls that share an axial force equally at their angle without load."""
        normal = force / (self.loaded_balls * np.sin(self.contact_angle) * self.lead_cosine)
        return (normal / self.load_deflection) ** (2 / 3)

    def displacement(self, force: Field) -> Field:
        """About how far such balls let the screw move."""
        return self.approach(force) / (np.sin(self.contact_angle) * self.lead_cosine)


class Balance(NamedTuple):
    """The springs as they are in a balance, the displacement of the screw at each ball, and what is left of it.

    That is the radial imbalance of bodies that swell, and if it is compiled, that of the balls as well.
    """

    springs: BallSprings
    displacement: Field
    left: Force
    #: The gap of each body; none where nothing swells.
    gap: Field | None = None


def solved(case: NutCase, *numbers: Field) -> tuple[Field, ...]:
    """A block of operating points, the ball axis first."""
    point = _with_preload(case, NutPoint(*numbers))
    without_load, bars = _springs(case, point), _bars(case, point)
    swelling = _swelling(case, point)
    rest = Balance(without_load, _first_touch(point, without_load), 0 * point.load)
    if case.halves == 2:
        without_load, rest = _braced(case, point, without_load, bars, swelling)
    elif case.oversize:
        if case.scatters:
            rest = _balance(case, point, without_load, bars, swelling, 0 * point.load)
        else:
            rest = rest._replace(displacement=0 * rest.displacement)
    springs, values, left, _ = _balance(case, point, without_load, bars, swelling, point.load)
    if not (case.halves == 2 or case.oversize):
        values = np.where(point.load != 0, values, rest.displacement)
    at_rest = rest.displacement
    # without load and preload balls just touch; what rounding makes of that is no load
    works = np.abs(point.load) + point.preload > 0
    is_idle = (point.load == 0) & (point.preload == 0)
    if case.compiled:
        carried = compiled_loads(springs, values, works.astype(float), swells=case.swells)
    else:
        carried = _carried(springs, values, works)
    imbalance = np.abs(carried.on_forward - carried.on_backward - point.load)
    if case.halves == 2:
        braced = np.where(rest.springs.flanks[0].facing > 0, rest.springs.forces(at_rest)[0], 0.0).sum(axis=0)
        # without preload the halves just touch, or nearly
        imbalance = np.maximum(imbalance, np.where(point.preload > 0, np.abs(braced - point.preload), 0.0))
    relative = imbalance / point.forces_at_work
    if case.elastic:
        if not case.compiled:
            left = np.maximum(chain_imbalance(springs, bars, point.load, values), left)
        elif not case.swells:
            left = compiled_imbalance(springs, bars, point.load, values)
        of_balls = left / point.forces_at_work
        relative = np.where(of_balls > LARGEST_OF_A_BALL, of_balls, relative)
    return (
        *carried[:4],
        _travel(case, point, bars, values, point.load) - _travel(case, point, bars, at_rest, 0 * point.load),
        np.where(is_idle, 0.0, 1 / _compliance(case, point, springs, bars, swelling, values, carried)),
        np.where(point.load < 0, carried.on_forward, carried.on_backward),
        _lift_off_load(case, point, without_load),
        np.where(works, relative, 0.0),
    )


def _carried(springs: BallSprings, displacement: Field, works: NDArray[np.bool_]) -> CarriedLoads:
    """Loads and contact angles of the flank pairs that face forwards, and of those that face backwards."""
    loads = [(flanks.facing, springs.loads(flanks, displacement)) for flanks in springs.flanks]

    def of(facing: int) -> tuple[Field, Field, Field]:
        load = angle = force = np.zeros_like(displacement)
        for pair, there in loads:
            load = load + np.where(pair == facing, there.load, 0.0)
            angle = angle + np.where(pair == facing, np.arcsin(there.sine), 0.0)
            force = force + np.where(pair == facing, facing * there.axial_force, 0.0)
        return np.where(works, load, 0.0), angle, np.sum(springs.balls * np.where(works, force, 0.0), axis=0)

    forward, backward = of(1), of(-1)
    slope = springs.balls * sum(there.slope for _, there in loads)
    return CarriedLoads(forward[0], backward[0], forward[1], backward[1], slope, forward[2], backward[2])


def _springs(case: NutCase, point: NutPoint) -> BallSprings:
    """The balls. Those of the second half of a double nut face backwards; they are not braced yet.

    Those of a single nut face the way its load presses.
    """
    row = np.arange(case.halves * case.balls)[:, None]
    forward = np.where(row < case.balls, 1.0, -1.0)
    if not (case.halves == 2 or case.oversize):
        forward = forward * point.direction
    excess = np.broadcast_to(case.excess, forward.shape)
    if case.oversize:
        excess = excess + _oversize(case, point)
    shift = -case.lead_error * point.lead_cosine
    pairs = [Flanks(forward, forward * shift, excess)]
    if case.oversize:
        pairs.append(Flanks(-forward, -forward * shift, excess))
    return _plain_springs(case, point, tuple(pairs))


def _plain_springs(case: NutCase, point: NutPoint, pairs: tuple[Flanks, ...]) -> BallSprings:
    """Balls in grooves that nothing has widened."""
    return BallSprings(
        load_deflection=point.load_deflection,
        centre_distance=point.centre_distance,
        contact_angle=point.contact_angle,
        lead_cosine=point.lead_cosine,
        balls=np.ones_like(point.lead_cosine),
        constant_angle=case.constant_angle,
        flanks=pairs,
    )


def _bars(case: NutCase, point: NutPoint) -> Bars:
    """The bodies between the balls; a double nut has its spacing in the middle."""
    middle = np.arange(1, case.halves * case.balls)[:, None] == case.balls
    lengths = np.where(middle, point.step + point.spacing, point.step)
    share = np.ones_like(point.link) if case.same_side else point.link / point.screw_bar
    return Bars(point.link / lengths, share)


def _swelling(case: NutCase, point: NutPoint) -> Swelling | None:
    """The bodies of the nut, each of which swells by itself."""
    if not case.swells:
        return None
    return Swelling(point.radial_stiffness, np.repeat(np.eye(case.halves), case.balls, axis=1))


def _with_preload(case: NutCase, point: NutPoint) -> NutPoint:
    """The point with the preload that balls of a given oversize make where they widen the nut."""
    if not (case.swells and case.oversize and np.any(np.isfinite(point.oversize))):
        return point
    plain = _plain_springs(case, point, ())
    balls, most = point.loaded_balls, point.preload
    return point._replace(preload=preload_of_oversize(point.oversize, point.radial_stiffness, plain, balls, most))


def _oversize(case: NutCase, point: NutPoint) -> Length:
    """Excess size of balls on both flanks over that of their grooves without load."""
    if not case.swells:
        return point.approach(point.preload)
    return excess_at_rest(point.preload, point.radial_stiffness, _plain_springs(case, point, ()), point.loaded_balls)


def _balance(
    case: NutCase, point: NutPoint, springs: BallSprings, bars: Bars, swelling: Swelling | None, load: Field
) -> Balance:
    """Displacement of the screw at each ball."""
    forces, guess = point.forces_at_work, point.displacement(point.forces_at_work)
    if not case.elastic:
        return Balance(springs, rigid_balance(springs, load, forces, guess), 0 * load)
    start = rigid_balance(springs.of_kinds(case.balls), load, forces, guess, START)
    start = np.broadcast_to(start[0], (len(springs.flanks[0].facing), load.size))
    if swelling is None:
        balance = compiled_chain_balance if case.compiled else chain_balance
        return Balance(springs, balance(springs, bars, load, forces, start), 0 * load)
    widen = compiled_widened_balance if case.compiled else widened_balance
    gap, result, left = widen(springs, bars, swelling, load, forces, start)
    return Balance(swelling.widened(springs, gap), result, left, gap)


def _braced(
    case: NutCase, point: NutPoint, springs: BallSprings, bars: Bars, swelling: Swelling | None
) -> tuple[BallSprings, Balance]:
    """A double nut with its halves braced by the preload, not yet widened, and its balance without load.

    Each half by itself carries the preload, which enters at its inner end.
    """
    n = case.balls
    one, other = springs.of(slice(None, n)), springs.of(slice(n, None))
    alone = point._replace(load=0 * point.preload)
    of_one, of_other = (None, None) if swelling is None else (swelling.of(slice(None, n)), swelling.of(slice(n, None)))
    first = _balance(case, alone, one, bars.of(slice(None, n - 1), 0.0), of_one, point.preload)
    before = first.displacement
    if case.scatters:
        second = _balance(case, alone, other, bars.of(slice(n, None), 1.0), of_other, -point.preload)
        behind = second.displacement
    else:
        second, behind = first, -before[::-1]
    stretch = point.preload / bars.stiffness[n - 1] if case.elastic else 0.0
    gap = before[-1] - behind[0] + stretch
    facing, offset, excess = springs.flanks[0]
    braced = springs._replace(
        flanks=(Flanks(facing, offset + np.where(facing < 0, gap * point.lead_cosine, 0.0), excess),)
    )
    at_rest, widened = np.concatenate([before, behind + gap]), braced
    if swelling is not None and first.gap is not None and second.gap is not None:
        widened = swelling.widened(braced, np.concatenate([first.gap, second.gap]))
    return braced, Balance(widened, at_rest, 0 * point.load)


def _first_touch(point: NutPoint, springs: BallSprings) -> Field:
    """The displacement at which the first ball of a nut without preload touches, at each ball."""
    flanks = springs.flanks[0]
    touch = np.min((springs.touch(flanks) - flanks.offset) / point.lead_cosine, axis=0)
    return point.direction * touch + 0 * flanks.offset


def _travel(case: NutCase, point: NutPoint, bars: Bars, x: Field, load: Field) -> Length:
    """Displacement of the loaded end of the screw against the held end of the nut."""
    beta = bars.first_share
    return beta * x[0] + (1 - beta) * x[-1] + load * _parallel_compliance(case, point, bars)


def _compliance(
    case: NutCase,
    point: NutPoint,
    springs: BallSprings,
    bars: Bars,
    swelling: Swelling | None,
    field: Field,
    carried: CarriedLoads,
) -> Ratio:
    """Slope of the travel by the load, from those of the balls' forces by their displacements."""
    if not case.elastic:
        return 1 / np.sum(carried.slope, axis=0)
    beta, slope = bars.first_share, carried.slope
    right = np.zeros_like(slope)
    right[0] += beta
    right[-1] += 1 - beta
    by_opening, by_displacement = carried.push_by_opening, carried.push_by_displacement
    if swelling is not None and by_opening is not None and by_displacement is not None:
        moved = compiled_widened_response(bars, swelling, slope, by_opening, by_displacement)
    elif swelling is not None:
        moved = widened_response(springs, bars, swelling, field, right)
    elif case.compiled:
        moved = compiled_response(bars, slope)
    else:
        moved = tridiagonal(bars.stiffness, slope, right)
    return beta * moved[0] + (1 - beta) * moved[-1] + _parallel_compliance(case, point, bars)


def _parallel_compliance(case: NutCase, point: NutPoint, bars: Bars) -> Ratio:
    """Difference of elongation of the free bodies between opposite ends."""
    if not case.elastic:
        return 0 * point.load
    return bars.first_share * (1 - bars.first_share) * np.sum(1 / bars.stiffness, axis=0)


def elastic_lift_off_load(case: NutCase, *numbers: Field) -> tuple[Field]:
    """The size of the load of either sign at which the last ball leaves the flanks that it relieves, bodies elastic.

    The overlap of the ball that is pressed the most falls with the load, in nearly a straight line: a search by secants
    that keeps a bracket. Zero where nothing is pressed without load.
    """
    point = _with_preload(case, NutPoint(*(np.broadcast_to(n, np.shape(numbers[0])) for n in numbers)))
    springs, bars, swelling = _springs(case, point), _bars(case, point), _swelling(case, point)
    if case.halves == 2:
        springs, _ = _braced(case, point, springs, bars, swelling)

    def overlap(size: Field) -> Field:
        loaded = point._replace(load=point.direction * size)
        balance = _balance(case, loaded, springs, bars, swelling, loaded.load)
        return _largest_overlap(point, balance.springs, balance.displacement)

    low, rigid = 0 * point.load, _lift_off_load(case, point, springs)
    high = np.where(rigid > 0, rigid, point.preload)
    at_low, at_high = overlap(low), overlap(high)
    is_braced = (at_low > 0) & (point.preload > 0)
    for _ in range(STEPS):
        pressed = is_braced & (at_high > 0)
        if not pressed.any():
            break
        low, at_low = np.where(pressed, high, low), np.where(pressed, at_high, at_low)
        high = np.where(pressed, BEYOND * high, high)
        at_high = overlap(high)
    size, last = high, 0 * low
    for _ in range(STEPS):
        part = at_low / np.where(at_low > at_high, at_low - at_high, 1.0)
        size = low + part * (high - low)
        left = overlap(size)
        pressed = left > 0
        # the Illinois rule: an end that stays twice counts half
        at_low = np.where(pressed, left, np.where(last < 0, at_low / 2, at_low))
        at_high = np.where(pressed, np.where(last > 0, at_high / 2, at_high), left)
        low, high, last = np.where(pressed, size, low), np.where(pressed, high, size), np.where(pressed, 1.0, -1.0)
        settled = (np.abs(left) <= NO_OVERLAP * point.centre_distance) | (high - low <= ROUNDING * high)
        if np.all(settled | ~is_braced):
            break
    return (np.where(is_braced, size, 0.0),)


def _largest_overlap(point: NutPoint, springs: BallSprings, displacement: Field) -> Length:
    """Distance of the flanks that the load relieves beyond where they just touch, at the ball that is pressed most."""
    overlaps = [
        np.where(
            each.facing == -point.direction,
            each.facing * displacement * point.lead_cosine + each.offset - springs.touch(each),
            -np.inf,
        )
        for each in springs.flanks
    ]
    return np.maximum.reduce(overlaps).max(axis=0)


def _lift_off_load(case: NutCase, point: NutPoint, springs: BallSprings) -> Force:
    """The size of the load of a rigid screw in a rigid nut when the flanks that it relieves just touch."""
    if not (case.halves == 2 or case.oversize):
        return 0 * point.load
    if not case.scatters:  # all balls are alike
        nut = RigidNut(*point[: len(RigidNut._fields)])
        return rigid_lift_off_load(nut, oversize=case.oversize, constant_angle=case.constant_angle)
    if case.elastic:
        case = case._replace(elastic=False, swells=False)
        springs = _springs(case, point)
        if case.halves == 2:
            springs, _ = _braced(case, point, springs, _bars(case, point), None)
    ahead = point.direction
    lets_go = [np.where(each.facing == -ahead, each.offset - springs.touch(each), -np.inf) for each in springs.flanks]
    lifted = ahead * np.maximum.reduce(lets_go).max(axis=0) / point.lead_cosine
    carried = [
        np.where(each.facing == ahead, springs.balls * ahead * springs.loads(each, lifted).axial_force, 0.0)
        for each in springs.flanks
    ]
    return np.sum(sum(carried), axis=0)
