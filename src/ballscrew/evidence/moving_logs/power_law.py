"""Friction as a free power of the speed, F0 + c·vⁿ, and an interval of n that does not flatter.

The exponent of one fit has three digits, few of which mean anything: they move with the part of the log that is used,
with the filter, and with the slowest speed that counts. The interval here holds the moving-block bootstrap and the
exponents under all these choices.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from ballscrew.basis.errors import Fault, InputError
from ballscrew.evidence.moving_logs.equation import Equation, LeastSquares, bootstrap_sums, relative_error
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.files.torque_logs.motion import Floats

#: Exponents that are tried, between which a parabola finds the best.
EXPONENTS = np.round(np.arange(0.2, 2.01, 0.1), 10)
#: Columns beside the power: acceleration, offset, direction; in one direction the last two are one.
LINEAR, ONE_WAY = (0, 1, 2), (0, 2)
#: Resampled logs.
REPLICATES = 400
#: Factors of the cutoffs, and slowest speeds as shares of the largest, under which the exponent is found again.
CUTOFF_FACTORS = (0.5, 2.0)
SLOWEST_SHARES = (0.02, 0.05, 0.1, 0.15)
#: The error of a fit must fall by so much, as a share, from one end of the exponents to the best, or n is not told.
_SHARPNESS = 1e-3


@dataclasses.dataclass(frozen=True)
class PowerLaw:
    """The fit of F0 + c·vⁿ: exponent, its intervals (95 %), the other numbers, the relative error."""

    exponent: float
    #: Of the moving-block bootstrap.
    bootstrap: tuple[float, float]
    #: Exponents under other choices of filter, slowest speed, direction and part of the log, by name.
    choices: Mapping[str, float]
    mass: float
    offset: float
    constant_force: float
    coefficient: float
    relative_error: float

    @property
    def interval(self) -> tuple[float, float]:
        """The bootstrap's interval and all choices together."""
        values = [value for value in self.choices.values() if np.isfinite(value)]
        return min([self.bootstrap[0], *values]), max([self.bootstrap[1], *values])

    def friction(self, speed: Floats) -> Floats:
        """Friction force at speeds, N, with the sign of the speed."""
        return np.sign(speed) * (self.constant_force + self.coefficient * np.abs(speed) ** self.exponent)

    def force(self, equation: Equation) -> Floats:
        """The force of the model at the rows that an equation uses."""
        whole = self.mass * equation.acceleration + self.offset + equation.direction**2 * self.friction(equation.speed)
        return equation.filtered(whole)


def power_law(equation: Equation, *, replicates: int = REPLICATES, seed: int = 0) -> PowerLaw | None:
    """The free power law of a log; None where its speeds do not tell an exponent."""
    sides = _sides(equation)
    rows = np.arange(equation.used.size)
    exponent = _best(sides, equation.force, rows)
    if not np.isfinite(exponent):
        return None
    solved = LeastSquares.of(_columns(equation, exponent), equation.force)
    mass, offset, constant, coefficient = solved.values.tolist()
    return PowerLaw(
        exponent,
        _bootstrap(sides, equation.force, solved, exponent, replicates, seed),
        _choices(equation, sides),
        mass,
        offset,
        constant,
        coefficient,
        relative_error(solved.residuals, equation.force),
    )


def _columns(equation: Equation, exponent: float) -> Floats:
    speed, direction = equation.speed, equation.direction
    ones = np.ones(speed.size)
    return equation.filtered(
        np.stack([equation.acceleration, ones, direction, direction * np.abs(speed) ** exponent], axis=1)
    )


def _sides(equation: Equation) -> Floats:
    """The columns of the linear part, then those of each exponent, at the rows used."""
    speed, direction = equation.speed, equation.direction
    size = np.abs(speed) / float(np.max(np.abs(speed)))
    powers = [direction * size**n for n in EXPONENTS]
    return equation.filtered(np.stack([equation.acceleration, np.ones(speed.size), direction, *powers], axis=1))


def _lowest(losses: Floats) -> Floats:
    """The exponent of the lowest loss along the last axis, by a parabola through it and its neighbours."""
    best = np.clip(np.argmin(losses, axis=-1), 1, EXPONENTS.size - 2)[..., np.newaxis]
    before, here, after = (np.take_along_axis(losses, best + off, axis=-1)[..., 0] for off in (-1, 0, 1))
    bend = before - 2 * here + after
    with np.errstate(divide="ignore", invalid="ignore"):
        off = np.where(bend > 0, 0.5 * (before - after) / bend, np.sign(before - after))
    step = EXPONENTS[1] - EXPONENTS[0]
    return np.asarray(EXPONENTS[best[..., 0]] + step * np.clip(off, -1.0, 1.0), dtype=np.float64)


def _losses(products: Floats, linear: tuple[int, ...] = LINEAR) -> Floats:
    """Sums of squares that are left, for each exponent, of products of (columns, measured) summed over rows."""
    count = EXPONENTS.size
    losses = np.empty((*products.shape[:-2], count))
    for place in range(count):
        chosen = [*linear, len(LINEAR) + place]
        matrix = products[..., chosen, :][..., chosen]
        right = products[..., chosen, -1]
        values = np.linalg.solve(matrix, right[..., np.newaxis])[..., 0]
        losses[..., place] = products[..., -1, -1] - np.sum(values * right, axis=-1)
    return losses


def _products(sides: Floats, force: Floats) -> Floats:
    both = np.column_stack([sides / np.maximum(np.linalg.norm(sides, axis=0), np.finfo(float).tiny), force])
    return both[:, :, np.newaxis] * both[:, np.newaxis, :]


def _best(sides: Floats, force: Floats, rows: NDArray[np.int64], linear: tuple[int, ...] = LINEAR) -> float:
    """The best exponent of some rows; NaN where they do not tell one."""
    if rows.size < sides.shape[1]:
        return np.nan
    chosen = np.column_stack([sides[rows], force[rows]])
    chosen = chosen / np.maximum(np.linalg.norm(chosen, axis=0), np.finfo(float).tiny)
    try:
        losses = _losses(chosen.T @ chosen, linear)
    except np.linalg.LinAlgError:
        return np.nan
    if not np.isfinite(losses).all() or np.ptp(losses) < _SHARPNESS * max(float(losses.min()), 0.0):
        return np.nan
    return float(_lowest(losses))


def _bootstrap(
    sides: Floats, force: Floats, solved: LeastSquares, exponent: float, replicates: int, seed: int
) -> tuple[float, float]:
    """The 95 % interval of the exponent by the moving-block bootstrap.

    Resampled quantiles are too narrow for few blocks: they are widened about the estimate by Student's distribution and
    by the degrees of freedom that the numbers take.
    """
    sums = bootstrap_sums(_products(sides, force), solved.block, replicates, seed)
    try:
        lowest = _lowest(_losses(sums))
    except np.linalg.LinAlgError:
        return np.nan, np.nan
    low, high = np.quantile(lowest, [0.025, 0.975]) - exponent
    wider = solved.few_blocks(len(LINEAR) + 2)
    return float(exponent + wider * low), float(exponent + wider * high)


def _choices(equation: Equation, sides: Floats) -> dict[str, float]:
    """The exponent under other choices, by name."""
    log, motion, force = equation.log, equation.kinematics, equation.force

    def again(name: str, **changed: float) -> tuple[str, float]:
        options = {"cutoff": equation.cutoff, "path_cutoff": motion.cutoff, "shift": equation.shift, **changed}
        other = Equation.of(log, **options)
        return name, _best(_sides(other), other.force, np.arange(other.used.size))

    largest = float(np.max(np.abs(equation.speed)))
    values = [again(f"both sides at {f:g} × the cutoff", cutoff=f * equation.cutoff) for f in CUTOFF_FACTORS]
    values += [again(f"position at {f:g} × the cutoff", path_cutoff=f * motion.cutoff) for f in CUTOFF_FACTORS]
    values += [again(f"without speeds below {share:.0%}", slowest=share * largest) for share in SLOWEST_SHARES]
    half = equation.used.size // 2
    direction = equation.direction[equation.used]
    parts = {
        "first half": np.arange(half), "second half": np.arange(half, equation.used.size),
        "forward": np.flatnonzero(direction > 0), "backward": np.flatnonzero(direction < 0),
    }  # fmt: skip
    # in one direction the offset and the constant part are one column
    values += [(name, _best(sides, force, rows, ONE_WAY if "ward" in name else LINEAR)) for name, rows in parts.items()]
    return dict(values)


#: Rows that follow each other count as steady if so many have speeds within this share of their mean.
LEAST_ROWS, STEADY = 4, 0.05
#: The speed of a stretch is so many times the step in which speeds are written, or more.
RESOLVED = 10.0
#: Stretches whose speeds differ by no more than this share are of one speed, unless there is such a gap between them.
SAME_SPEED, GAP = 0.15, 0.05
#: Speeds tell an exponent if the fastest is so many times the slowest.
WIDE = 3.0
#: Scatter of forces over the largest, at least.
_EXACT = 1e-9
#: Mean speed, mean force and rows of a stretch at nearly constant speed.
Stretch = tuple[float, float, int]


@dataclasses.dataclass(frozen=True)
class SteadySpeed:
    """The drive at one speed: friction is half the difference of the two directions, the offset half their sum.

    Where the log has one direction of this speed alone, the other is NaN, and friction is what is left of the drive
    without the ``offset`` of the other speeds: gravity and the zero error do not depend on the speed.
    """

    speed: float
    forward: float
    backward: float
    #: Force that both directions need alike.
    friction: float
    #: Standard error of the friction, by the scatter of the stretches.
    std: float
    #: Force that one direction needs more than the other: gravity, and the zero error.
    offset: float
    rows: int
    stretches: int

    @property
    def is_one_way(self) -> bool:
        """True where one direction alone was logged at this speed."""
        return math.isnan(self.forward + self.backward)


@dataclasses.dataclass(frozen=True)
class SteadyFriction:
    """Friction over speed, and its exponent with a 95 % interval; NaN where no two speeds differ by :data:`WIDE`."""

    speeds: Sequence[SteadySpeed]
    exponent: float
    interval: tuple[float, float]
    #: Step in which speeds are written, m/s.
    resolution: float


def steady_friction(*logs: MovingLog) -> SteadyFriction:
    """Friction over speed of ``logs`` of one axis, which have a speed, from their rows at nearly constant speed.

    What drives may be a force, or a current where no torque constant is known: the result is in its unit.

    Raises :class:`~ballscrew.basis.errors.InputError` for a log without a speed, or without such rows in both
    directions.
    """
    stretches: list[Stretch] = []
    resolution, name = 0.0, "log"
    for log in logs:
        name = log.source[0] if log.source else "log"
        if log.speed is None:
            raise InputError(Fault(name, "has no column of a speed", "", "log the speed, or fit the motion"))
        speed: Floats = np.asarray(log.speed, dtype=float)
        steps = np.diff(np.unique(np.abs(speed[np.isfinite(speed)])))
        step = float(np.min(steps[steps > 0], initial=np.inf))
        stretches += _stretches(speed, np.asarray(log.force, dtype=float), RESOLVED * step)
        resolution = max(resolution, step)
    groups = _of_one_speed(stretches)
    ways = [forces for near in groups for forces in _by_direction(near) if len(forces) > 1]
    if not ways and stretches:
        remedy = "repeat the strokes at one speed at least: their scatter is the error"
        raise InputError(Fault(name, "has one stroke alone at each speed and direction", "", remedy))
    repeats = sum(len(forces) - 1 for forces in ways)
    scatter = math.sqrt(sum(np.var(forces) * len(forces) for forces in ways) / max(repeats, 1))
    # forces that repeat to the last digit were not measured: their error is not zero, but small
    scatter = max(scatter, _EXACT * max((abs(force) for _, force, _ in stretches), default=0.0))
    both_ways = [one for near in groups if (one := _at_one_speed(near, scatter)) is not None]
    if not both_ways:
        remedy = "record strokes at constant speed in both directions"
        raise InputError(Fault(name, "has no rows at constant speed in both directions", "", remedy))
    offsets = [one.offset for one in both_ways]
    # an offset that differs between speeds may differ at another speed by as much
    differs = float(np.std(offsets, ddof=1)) if len(offsets) > 1 else 0.0
    offset = (float(np.mean(offsets)), math.hypot(differs, *(one.std / len(both_ways) for one in both_ways)))
    speeds = [one for near in groups if (one := _at_one_speed(near, scatter, offset)) is not None]
    return SteadyFriction(speeds, *_exponent(speeds, repeats), resolution)


def _stretches(speed: Floats, force: Floats, slowest: float) -> list[Stretch]:
    """Mean speed, mean force and rows of each stretch at nearly constant speed; its first and last row do not count."""
    stretches: list[Stretch] = []
    start = 0
    for row in range(1, speed.size + 1):
        mean = float(np.mean(speed[start:row]))
        if row < speed.size and abs(speed[row] - mean) <= STEADY * abs(mean):
            continue
        inner = slice(start + 1, row - 1)
        if row - start >= LEAST_ROWS and abs(mean) >= slowest and np.isfinite(force[inner]).all():
            stretches.append((mean, float(np.mean(force[inner])), row - start - 2))
        start = row
    return stretches


def _of_one_speed(stretches: Sequence[Stretch]) -> list[list[Stretch]]:
    """The stretches by speed, by :data:`SAME_SPEED` and :data:`GAP`."""
    groups: list[list[Stretch]] = []
    for stretch in sorted(stretches, key=lambda stretch: abs(stretch[0])):
        speed, near = abs(stretch[0]), groups[-1] if groups else []
        if near and speed <= min(abs(near[0][0]) * (1 + SAME_SPEED), abs(near[-1][0]) * (1 + GAP)):
            near.append(stretch)
        else:
            groups.append([stretch])
    return groups


def _by_direction(near: Sequence[Stretch]) -> tuple[list[float], list[float]]:
    """Forces of the stretches forward, and of those backward."""
    return [force for speed, force, _ in near if speed > 0], [force for speed, force, _ in near if speed < 0]


def _at_one_speed(
    near: Sequence[Stretch], scatter: float, known_offset: tuple[float, float] | None = None
) -> SteadySpeed | None:
    """The drive at the speed of some stretches, with the ``scatter`` of those at all speeds.

    None where one direction is missing and no offset is known, with its standard error.
    """
    ways = _by_direction(near)
    forward, backward = (float(np.mean(forces)) if forces else math.nan for forces in ways)
    errors = [scatter / math.sqrt(len(forces)) for forces in ways if forces]
    if len(errors) == 2:
        friction, offset, std = (forward - backward) / 2, (forward + backward) / 2, math.hypot(*errors) / 2
    elif known_offset is not None:
        offset = known_offset[0]
        friction = offset - backward if math.isnan(forward) else forward - offset
        std = math.hypot(*errors, known_offset[1])
    else:
        return None
    return SteadySpeed(
        float(np.mean([abs(speed) for speed, *_ in near])),
        forward,
        backward,
        friction,
        std,
        offset,
        rows=sum(rows for *_, rows in near),
        stretches=len(near),
    )


def _exponent(speeds: Sequence[SteadySpeed], repeats: int) -> tuple[float, tuple[float, float]]:
    """The exponent n of friction ∝ speedⁿ by weighted least squares of the logarithms, with its 95 % interval.

    The errors have as many degrees of freedom as there are ``repeats``.
    """
    known = [one for one in speeds if one.friction > 0]
    if not known or max(one.speed for one in known) < WIDE * min(one.speed for one in known):
        return np.nan, (np.nan, np.nan)
    x, y = (np.log([getattr(one, name) for one in known]) for name in ("speed", "friction"))
    weights: Any = np.array([(one.friction / one.std) ** 2 for one in known])
    x, y = x - np.average(x, weights=weights), y - np.average(y, weights=weights)
    spread = float(np.sum(weights * x**2))
    slope = float(np.sum(weights * x * y)) / spread
    # the scatter about the line where it is more than that of the stretches
    scatter = max(1.0, float(np.sum(weights * (y - slope * x) ** 2)) / max(len(known) - 2, 1))
    half = float(stdtrit(repeats, 0.975)) * math.sqrt(scatter / spread)
    return slope, (slope - half, slope + half)
