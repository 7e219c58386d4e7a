r"""The equation of motion with the friction of the ball screw's model in it, fitted by Gauss–Newton steps.

.. math:: F = M a + F_g + \operatorname{sign}(v)
    \left[F_c + f_v |v| + S\left(|v|, \operatorname{sign}(v)(m a + F_g); \theta\right)\right]

S is the friction of the model, θ its free numbers, m the mass that the nut carries: M also holds what the rotating
parts weigh at the nut, J (2π/P_h)², whose force does not pass the nut. F_c and f_v are what no model of the balls has:
seals, guides, bearings, brushes of the motor. Neither is negative, so that the balls cannot be given more than the
whole.

Friction force of a ball screw over speed and load, tabulated: a log has many rows and few different points.

A log of 25 000 rows would take a preloaded nut some 25 000 solutions of its balance for every step of the fit. The
friction is smooth: it is evaluated on a grid of speeds and loads, and read between them; what that costs is stated.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.optimize import least_squares

from ballscrew.basis.errors import Fault, spoken
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.evaluator import Evaluator, evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.response import initial_value, resolve_input
from ballscrew.evidence.moving_logs.equation import LARGEST_ERROR, Equation, LeastSquares, block_length, relative_error
from ballscrew.files.torque_logs.motion import Floats

#: Speeds and loads of the grid.
SPEEDS, LOADS = 24, 9
#: The same for nuts whose balls differ, which take a hundred times as long for a point.
SPEEDS_BY_BALL, LOADS_BY_BALL = 10, 3
#: The slowest speed of the grid, as a share of the fastest; below it the friction is that of the slowest.
SLOWEST = 1e-3
#: A number may move by so many times what the case says, to either side.
LARGEST_FACTOR = 50.0
#: Points at which the table is compared with the model.
_COMPARED = 64


@dataclasses.dataclass(frozen=True, eq=False)
class ScrewFriction:
    """The friction force of the balls of a screw along the axis, N, for any values of its free numbers."""

    subject: Configuration
    #: The free numbers by their full names, and as they were asked for.
    names: tuple[str, ...]
    asked: tuple[str, ...]
    fastest: float
    largest_load: float

    @classmethod
    def of(
        cls, subject: Configuration, free: Sequence[str], fastest: float, largest_load: float, section: str = "fit"
    ) -> ScrewFriction:
        """``fastest`` is the largest speed of the nut (m/s), ``largest_load`` the largest axial load on it (N).

        Raises :class:`~ballscrew.basis.errors.InputError` for names that the model does not have.
        """
        names = tuple(resolve_input(subject, name, section) for name in free)
        return cls(subject, names, tuple(free), fastest, largest_load)

    @functools.cached_property
    def start(self) -> Floats:
        """The values of the free numbers in the case."""
        return np.array([initial_value(self.subject, name) for name in self.names])

    @functools.cached_property
    def bounds(self) -> tuple[Floats, Floats]:
        """Bounds of the free numbers: their own, and a factor to either side of the case."""
        low, high = np.empty(len(self.names)), np.empty(len(self.names))
        for place, (quantity, start) in enumerate(zip(self.quantities, self.start.tolist(), strict=True)):
            info = quantity.info
            ends = sorted((start / LARGEST_FACTOR, start * LARGEST_FACTOR)) if start else [0.0, math.inf]
            lows = [end for end in (info.at_least, info.above) if end is not None]
            highs = [end for end in (info.at_most, info.below) if end is not None]
            low[place], high[place] = max([ends[0], *lows]), min([ends[1], *highs])
        return low, high

    @property
    def quantities(self) -> list[Quantity]:
        """The quantities of the free numbers."""
        return [self.subject.inputs[name][1] for name in self.names]

    @property
    def per_torque(self) -> float:
        """Force along the axis for each torque at the shaft: 2π over the lead, 1/m."""
        return 2 * math.pi / float(self.subject.screw.lead)

    @functools.cached_property
    def _evaluator(self) -> Evaluator:
        # a grid of some hundred points does not pay for the compiler, which takes seconds for a preloaded nut
        subject = self.subject
        return evaluator(
            subject.model,
            subject.screw,
            subject.lubricant,
            inputs=("axial_load", "screw_speed", *self.names),
            outputs=("screw_torque",),
            engine="numpy",
        )

    def at(self, values: Floats, speed: Floats, load: Floats) -> Floats:
        """The friction force of the model itself, at speeds > 0 (m/s) and loads (N) against the motion."""
        result = self._evaluator(load, speed * self.per_torque, *values)
        return self.per_torque * np.asarray(result["screw_torque"], dtype=np.float64)

    def table(self, values: Floats) -> FrictionTable:
        """The friction force over speed and load for values of the free numbers."""
        return self.tables(values[np.newaxis])[0]

    def tables(self, values: Floats) -> list[FrictionTable]:
        """The tables for several values of the free numbers, one in each row, evaluated at once."""
        by_ball = self.subject.nut.one_by_one
        count = (SPEEDS_BY_BALL, LOADS_BY_BALL) if by_ball else (SPEEDS, LOADS)
        speeds = self.fastest * np.geomspace(SLOWEST, 1.0, count[0])
        loads = max(self.largest_load, 1e-9) * np.linspace(-1.0, 1.0, count[1])
        each = values.T[..., np.newaxis, np.newaxis]
        grids = self.at(each, *(np.broadcast_to(one, (len(values), *one.shape)) for one in np.meshgrid(speeds, loads)))
        return [FrictionTable(speeds, loads, grid) for grid in grids]

    def table_error(self, values: Floats, speed: Floats, load: Floats) -> float:
        """The largest difference of the table from the model at some of the given points, as a share of the largest."""
        chosen = np.random.default_rng(0).choice(speed.size, min(_COMPARED, speed.size), replace=False)
        speeds = np.clip(speed[chosen], SLOWEST * self.fastest, self.fastest)
        there = self.at(values, speeds, load[chosen])
        off = np.abs(self.table(values)(speeds, load[chosen]) - there)
        return float(np.max(off) / max(float(np.max(np.abs(there))), np.finfo(float).tiny))


class FrictionTable:
    """Friction force over speed (cubic, over its logarithm) and load (straight lines: it bends at zero)."""

    def __init__(self, speeds: Floats, loads: Floats, grid: Floats) -> None:
        self.is_finite = bool(np.isfinite(grid).all())
        self._speeds, self._loads = np.log(speeds), loads
        # a piece of a cubic for each interval of speed and each load
        self._pieces = CubicSpline(self._speeds, np.nan_to_num(grid).T).c

    def __call__(self, speed: Floats, load: Floats) -> Floats:
        """The friction force; beyond the ends of the grid that of its ends."""
        (before, after), share, _ = self._beside(speed, load)
        return (1 - share) * before + share * after

    def by_load(self, speed: Floats, load: Floats) -> Floats:
        """The slope by the load."""
        (before, after), _, width = self._beside(speed, load)
        return (after - before) / width

    def _beside(self, speed: Floats, load: Floats) -> tuple[tuple[Floats, Floats], Floats, float]:
        """The friction at the loads of the grid below and above, where between them, and how far they are apart."""
        x = np.log(np.clip(np.abs(speed), np.exp(self._speeds[0]), np.exp(self._speeds[-1])))
        place = np.clip(np.searchsorted(self._speeds, x, side="right") - 1, 0, self._speeds.size - 2)
        off = x - self._speeds[place]
        width = float(self._loads[1] - self._loads[0])
        within = np.clip((load - self._loads[0]) / width, 0.0, self._loads.size - 1.0)
        below = np.minimum(within.astype(np.int64), self._loads.size - 2)

        def at(column: NDArray[np.int64]) -> Floats:
            cubic, square, slope, value = (self._pieces[power, place, column] for power in range(4))
            return ((cubic * off + square) * off + slope) * off + value

        return (at(below), at(below + 1)), within - below, width


#: The numbers of the model, in the order of its columns.
NAMES = ("mass", "offset", "coulomb_force", "viscous_coefficient")
#: Columns scaled to one are told apart if the smallest singular value is at least this.
_DISTINCT = 0.02
#: A number takes part in a direction if its share of it is at least this.
_TAKES_PART = 0.3
#: A force changes its unit midway if one scale before and another after, so many times as large, explain it better:
#: less than this share of the sum of squares is left.
_OTHER_UNIT, _BETTER = 4.0, 0.5
#: The change of unit is looked for in this part of the rows.
_WITHIN = 0.03

_REMEDIES = {
    frozenset({"offset", "coulomb_force"}): "record strokes in both directions",
    frozenset({"coulomb_force", "viscous_coefficient"}): (
        "record strokes at several speeds, the slowest a tenth of the fastest"
    ),
    frozenset({"mass", "viscous_coefficient"}): "record ramps of several accelerations and strokes at steady speed",
    frozenset({"mass", "coulomb_force"}): "record ramps in both directions that speed up and that slow down",
}
_SLOW = "record faster ramps: the force of the acceleration must be clear of the noise"
_FEW_SPEEDS = "record strokes at several speeds in both directions"


@dataclasses.dataclass(frozen=True, eq=False)
class LinearModel:
    """The fit of F = M a + F_g + sign(v)·(F_c + f_v |v|): values in the order of :data:`NAMES`, in SI."""

    solution: LeastSquares
    relative_error: float
    #: True for the numbers that the log identifies.
    identified: tuple[bool, ...]
    warnings: tuple[Record, ...]

    @property
    def values(self) -> Floats:
        """Mass, offset, Coulomb force, viscous coefficient."""
        return self.solution.values

    def force(self, equation: Equation) -> Floats:
        """The force of the model at the rows that an equation uses."""
        return columns(equation) @ self.values


def columns(equation: Equation) -> Floats:
    """The columns of the linear model at the rows used."""
    speed, direction = equation.speed, equation.direction
    ones = np.ones(speed.size)
    return equation.filtered(np.stack([equation.acceleration, ones, direction, direction**2 * speed], axis=1))


def linear_model(equation: Equation) -> LinearModel:
    """The linear model of a log, with what the log does not tell named."""
    sides = columns(equation)
    solved = LeastSquares.of(sides, equation.force)
    size = float(np.sqrt(np.mean(equation.force**2)))
    scale = np.sqrt(np.mean(sides**2, axis=0))
    # a friction matters by its own size, or by a tenth of the whole force if it is less; a mass by its own
    matters = np.maximum(np.abs(solved.values), 0.1 * size / np.maximum(scale, np.finfo(float).tiny))
    matters[0] = abs(solved.values[0])
    known = np.asarray((scale > 0) & (solved.errors <= LARGEST_ERROR * matters))
    warnings: list[Record] = []
    normal = sides / np.maximum(np.linalg.norm(sides, axis=0), np.finfo(float).tiny)
    _, singular, directions = np.linalg.svd(normal, full_matrices=False)
    for value, direction in zip(singular, directions, strict=True):
        if value >= _DISTINCT:
            continue
        part = np.abs(direction) >= _TAKES_PART
        names = [name for name, takes in zip(NAMES, part, strict=True) if takes]
        known &= ~part
        warnings.append(_not_told(names))
    named = {name for warning in warnings for name in warning.subject.split(",")}
    alone = [name for name, one in zip(NAMES, known, strict=True) if not one and name not in named]
    warnings += [_not_told([name]) for name in alone if not (name == "offset" and abs(solved.values[1]) < 0.1 * size)]
    return LinearModel(solved, relative_error(solved.residuals, equation.force), tuple(known.tolist()), tuple(warnings))


def _not_told(names: list[str]) -> Record:
    """The warning about numbers that a log does not tell, or not apart."""
    remedy = next(
        (text for pair, text in _REMEDIES.items() if pair <= {*names}), _SLOW if "mass" in names else _FEW_SPEEDS
    )
    numbers = " and ".join(map(spoken, names))
    problem = f"cannot tell {numbers} apart" if len(names) > 1 else f"does not tell the {numbers}"
    message = f"the log {problem} · {remedy}"
    return Record.warning("fit.not_identified", ",".join(names), message)


def unit_change(equation: Equation, name: str) -> Fault | None:
    """The fault of a log in which the force, or the position, changes its unit midway; None where it does not."""
    sides = columns(equation)
    values = np.linalg.lstsq(sides, equation.force, rcond=None)[0]
    explained, force = sides @ values, equation.force
    own, both, rows = np.cumsum(explained**2), np.cumsum(explained * force), force.size
    place = np.arange(int(_WITHIN * rows), rows - int(_WITHIN * rows))
    if place.size < 2 or own[-1] <= 0:
        return None
    tiny = np.finfo(float).tiny
    before = both[place] / np.maximum(own[place], tiny)
    after = (both[-1] - both[place]) / np.maximum(own[-1] - own[place], tiny)
    # the split is looked for by ratios, since the part in the larger unit is nearly all of the sum of squares
    ratio = np.abs(after) / np.maximum(np.abs(before), tiny)
    total = float(force @ force)
    left = total - before * both[place] - after * (both[-1] - both[place])
    best = int(np.argmin(left))
    most = max(float(ratio[best]), 1 / max(float(ratio[best]), tiny))
    # a part in a far smaller unit is lost in the sum of squares: it is judged by its own
    power = np.cumsum(force**2)
    parts = [power[place[best]] / (place[best] + 1), (power[-1] - power[place[best]]) / (rows - 1 - place[best])]
    jump = max(parts) / max(min(parts), tiny)
    if most < _OTHER_UNIT or jump < _OTHER_UNIT**2:
        return None
    row = equation.log.line[equation.used[place[best]]]
    told = f"the force is {most:.3g} times {'larger' if ratio[best] > 1 else 'smaller'} from there on"
    return Fault(
        f"{name} near row {row}",
        "the unit of the force or of the position changes midway",
        told,
        "give all rows one unit",
    )


#: Numbers that every fit has, in this order; the free numbers of the model follow, and the mass that the nut carries.
MASS, OFFSET, CONSTANT, VISCOUS = range(4)
#: Step of a logarithm for derivatives by the numbers of the model.
_STEP = 1e-4
#: A number this near a bound, as a share of its scale, is at it.
_AT_BOUND = 1e-4
_EVALUATIONS = 40


@dataclasses.dataclass(frozen=True, eq=False)
class ScrewModelFit:
    """The fit of the screw's model: values and errors in SI; None where the log does not identify a number."""

    friction: ScrewFriction
    mass: float
    offset: float
    constant_force: float
    viscous_coefficient: float
    #: Values of the free numbers of the model.
    numbers: Floats
    carried_mass: float
    #: Standard errors in the order mass, offset, constant force, viscous coefficient, numbers, carried mass; NaN where
    #: not identified, at a bound, or given.
    errors: Floats
    half_widths: Floats
    #: True for the numbers that are at a bound.
    at_bound: NDArray[np.bool_]
    converged: bool
    relative_error: float
    #: Largest difference of the table of friction from the model, as a share of the largest friction.
    table_error: float

    def force(self, equation: Equation) -> Floats:
        """The force of the model at the rows that an equation uses."""
        values = np.array([self.mass, self.offset, self.constant_force, self.viscous_coefficient])
        table = self.friction.table(self.numbers)
        return _columns(equation, table, self.carried_mass, self.offset)[0] @ np.append(values, 1.0)

    def screw_force(self, speed: Floats, load: Floats | float = 0.0) -> Floats:
        """The part of the balls at speeds (m/s, either sign), N, with the sign of the speed."""
        direction = np.sign(speed)
        loads = np.broadcast_to(np.asarray(load) * direction, np.shape(speed))
        return direction * self.friction.table(self.numbers)(np.abs(speed), loads)


def fit_screw_model(
    equation: Equation, friction: ScrewFriction, linear: LeastSquares, carried_mass: float | None = None
) -> ScrewModelFit | None:
    """Fit of the model from the linear one on; None where the model has no friction at the speeds of the log.

    ``carried_mass`` (kg) is fitted between nothing and the whole mass where it is not given.
    """
    mass, offset = float(linear.values[0]), float(linear.values[1])
    count = friction.start.size
    if not friction.table(friction.start).is_finite:
        return None
    low_number, high_number = friction.bounds
    scale = np.abs(np.array([mass, max(abs(offset), 0.01 * float(np.max(np.abs(equation.force)))), 0.0, 0.0]))
    size = float(np.sqrt(np.mean(equation.force**2)))
    scale[CONSTANT], scale[VISCOUS] = size, size / friction.fastest
    scales = np.concatenate([scale, np.maximum(np.abs(friction.start), 1e-300), [max(mass, 1e-9)]])
    low = np.concatenate([[-np.inf, -np.inf, 0.0, 0.0], low_number, [0.0]]) / scales
    high = np.concatenate([[np.inf] * 4, high_number, [max(mass, 1e-9)]]) / scales
    # from about half the friction of the linear fit on, clear of the bounds
    constant = max(0.5 * float(linear.values[2]), 1e-3 * size)
    viscous = max(0.25 * float(linear.values[3]), 1e-3 * float(scale[VISCOUS]))
    carried = 0.5 * mass if carried_mass is None else min(carried_mass, mass)
    begin = np.concatenate([[mass, offset, constant, viscous], friction.start, [carried]]) / scales
    free = np.ones(scales.size, dtype=bool)
    free[-1] = carried_mass is None
    problem = _Problem(equation, friction, scales, begin)

    def residuals(some: Floats) -> Floats:
        return problem.at(_placed(begin, free, some))[0]

    def slopes(some: Floats) -> Floats:
        return problem.at(_placed(begin, free, some))[1][:, free]

    room = 1e-9 * np.maximum(np.where(np.isfinite(high - low), high - low, 1.0), 1e-300)
    inside = np.clip(begin, low + room, high - room)[free]
    jac: Any = slopes  # the hints of SciPy know only the names of methods
    solved = least_squares(
        residuals,
        inside,
        jac,
        bounds=(low[free], high[free]),
        method="trf",
        max_nfev=_EVALUATIONS,
        xtol=1e-5,
        ftol=1e-7,
    )
    result = _placed(begin, free, solved.x)
    final, derivatives = problem.at(result)
    near = (result - low <= _AT_BOUND + room) | (high - result <= _AT_BOUND + room)
    moves = free & ~near
    told = LeastSquares(result[moves], final, derivatives[:, moves], block_length(final))
    # a number matters by its own size, and a drag by that of the whole friction
    matters = np.maximum(np.abs(result), np.where(np.arange(result.size) < 4, 1.0, 0.0))
    errors, widths = np.full(result.size, np.nan), np.full(result.size, np.nan)
    errors[moves], widths[moves] = told.errors, told.half_width()
    unknown = ~(errors <= LARGEST_ERROR * np.maximum(matters, 1e-300))
    errors[unknown], widths[unknown] = np.nan, np.nan
    values = result * scales
    numbers = values[4 : 4 + count]
    if not friction.table(numbers).is_finite:
        return None
    load = _load(equation, values[-1], values[OFFSET])[equation.used]
    return ScrewModelFit(
        friction,
        float(values[MASS]),
        float(values[OFFSET]),
        float(values[CONSTANT]),
        float(values[VISCOUS]),
        numbers,
        float(values[-1]),
        errors * scales,
        widths * scales,
        near & free,
        bool(solved.status > 0),
        relative_error(final, equation.force),
        friction.table_error(numbers, np.abs(equation.speed[equation.used]), load),
    )


def _placed(begin: Floats, free: NDArray[np.bool_], some: Floats) -> Floats:
    whole = begin.copy()
    whole[free] = some
    return whole


def _load(equation: Equation, carried: float, offset: float) -> Floats:
    """Axial load on the nut in the direction of the motion: positive where it works against it."""
    return np.sign(equation.speed) * (carried * equation.acceleration + offset)


def _columns(equation: Equation, table: FrictionTable, carried: float, offset: float) -> tuple[Floats, Floats]:
    """Columns of mass, offset, constant, viscous and the screw's friction; its slope by the carried mass."""
    speed, direction = equation.speed, equation.direction
    load = _load(equation, carried, offset)
    screw = direction * table(speed, load)
    by_mass = table.by_load(speed, load) * equation.acceleration * direction**2
    ones = np.ones(speed.size)
    sides = np.stack([equation.acceleration, ones, direction, direction**2 * speed, screw, by_mass], axis=1)
    filtered = equation.filtered(sides)
    return filtered[:, :5], filtered[:, 5]


class _Problem:
    """Residuals and derivatives at numbers in units of their scales; the last are remembered."""

    def __init__(self, equation: Equation, friction: ScrewFriction, scales: Floats, begin: Floats) -> None:
        self._equation, self._friction, self._scales = equation, friction, scales
        self._offset = float(begin[OFFSET] * scales[OFFSET])
        self._at: Floats | None = None
        self._found: tuple[Floats, Floats] = (np.empty(0), np.empty((0, 0)))

    def at(self, scaled: Floats) -> tuple[Floats, Floats]:
        if self._at is None or not np.array_equal(self._at, scaled):
            self._found, self._at = self._evaluate(scaled * self._scales), scaled.copy()
        return self._found

    def _evaluate(self, values: Floats) -> tuple[Floats, Floats]:
        equation, friction = self._equation, self._friction
        numbers, carried = values[4:-1], float(values[-1])
        # the load is taken with the offset of the linear fit: a fraction of a newton changes no friction
        steps = _STEP * np.where(numbers != 0, numbers, self._scales[4:-1])
        steps = np.where(numbers + steps > friction.bounds[1], -steps, steps)
        # the numbers, then each of them one step further
        here, *further = friction.tables(numbers + np.vstack([np.zeros(numbers.size), np.diag(steps)]))
        sides, by_mass = _columns(equation, here, carried, self._offset)
        residuals = sides @ np.append(values[:4], 1.0) - equation.force
        load = _load(equation, carried, self._offset)
        slopes = [sides[:, place] for place in range(4)]
        before = here(equation.speed, load)
        for step, there in zip(steps, further, strict=True):
            change = there(equation.speed, load) - before
            slopes.append(equation.filtered(equation.direction * change / step))
        jacobian = np.stack([*slopes, by_mass], axis=1) * self._scales
        return residuals, jacobian
