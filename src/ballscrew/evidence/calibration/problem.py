"""A fit as a problem of least squares: its parameters, and the torque of every row with its derivatives by them.

Priors: knowledge of parameters before a log is read, as residuals beside those of the log.

Torque conventions: whether the torque column of a log is friction or drive torque, and with which signs.

Rigs differ, and headings seldom state it. A torque is ``ideal · |M_Sa| + friction · M_S``, the two signs
by row. The conventions in use are far apart, so that the model identifies the one that was used. Both signs together
say on which side of the nut the load is, whatever sign the column of the load has.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, LogNormal, Normal, Triangular, Uniform
from ballscrew.evidence.calibration.baselines import robust_linear
from ballscrew.evidence.calibration.response import Response
from ballscrew.evidence.calibration.robust import (
    Prior,
    Vector,
    loss_of,
    scatter_of,
)
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog

#: Regularisation of unidentified parameters: a weak normal prior about the start with this many scales as deviation.
REGULARISATION_SCALE = 10.0


@dataclasses.dataclass(frozen=True, eq=False)
class Priors:
    """Distributions of some of the parameters of a fit, by place.

    A normal prior is the residual ``(x − mean)/deviation``, a log-normal one ``ln(x/median)/ln(factor)``; a triangular
    one counts as the normal of its mean and deviation, and a uniform one as bounds alone.
    """

    given: Mapping[int, Distribution]
    start: Vector
    scale: Vector

    @property
    def all(self) -> Prior:
        """The priors, and the weak regularisation of all parameters."""

        def residuals(x: Vector) -> Vector:
            return np.concatenate([self.residuals(x), (x - self.start) / (REGULARISATION_SCALE * self.scale)])

        def slopes(x: Vector) -> Vector:
            return np.vstack([self.slopes(x), np.diag(1 / (REGULARISATION_SCALE * self.scale))])

        return Prior(residuals, slopes)

    def residuals(self, x: Vector) -> Vector:
        """Residuals of the priors, in standard deviations."""
        return np.array([_residual(prior, x[i])[0] for i, prior in self._informative])

    def slopes(self, x: Vector) -> Vector:
        """Derivatives of the residuals by the parameters."""
        slopes = np.zeros((len(self._informative), x.size))
        for row, (i, prior) in enumerate(self._informative):
            slopes[row, i] = _residual(prior, x[i])[1]
        return slopes

    def deviation(self, place: int, value: float) -> float | None:
        """The standard deviation that the prior of a parameter leaves; None without one."""
        told = dict(self._informative)
        return None if place not in told else abs(1 / _residual(told[place], value)[1])

    @property
    def _informative(self) -> Sequence[tuple[int, Normal | LogNormal | Triangular]]:
        return [(i, prior) for i, prior in self.given.items() if not isinstance(prior, Uniform)]


def _residual(prior: Normal | LogNormal | Triangular, x: float) -> tuple[float, float]:
    """The residual of a prior and its derivative."""
    match prior:
        case LogNormal(median, factor):
            x = max(x, 1e-12 * median)
            return math.log(x / median) / math.log(factor), 1 / (x * math.log(factor))
        case Normal(mean, deviation):
            return (x - mean) / deviation, 1 / deviation
        case Triangular(low, mode, high):
            mean = (low + mode + high) / 3
            deviation = math.sqrt((low**2 + mode**2 + high**2 - low * mode - low * high - mode * high) / 18)
            return (x - mean) / deviation, 1 / deviation


#: The source of the sign of a part of the torque: load, speed, both (the direction of the power), or nothing.
Sign = Literal["load", "against load", "speed", "motion", "none", "absent"]


class TorqueConvention(NamedTuple):
    """The kind of a torque, and the sources of the signs of the ideal torque and the friction torque in it."""

    kind: Kind
    description: str
    ideal: Sign
    friction: Sign
    #: Whether the column has the opposite sign throughout.
    reversed: bool = False

    def loads(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The loads with the signs of the model: positive where a positive speed works against them.

        Those of the column, unless the torque says that it has their sizes alone or the opposite signs.
        """
        if self.ideal == "absent":
            return np.asarray(axial_load)
        ideal, friction = self._signs(axial_load, screw_speed)
        return np.abs(axial_load) * ideal * friction * np.sign(screw_speed)

    def weights(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The factors of ideal torque and friction torque under :meth:`loads`, of shape (2, rows)."""
        _, friction = self._signs(axial_load, screw_speed)
        # an ideal torque with the sign of its load works against friction where it has not that of the speed
        return np.stack([friction * np.sign(screw_speed) * (self.ideal != "absent"), friction])

    def _signs(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The signs of the size of the ideal torque and of the friction torque in the column, of shape (2, rows)."""
        load, speed = np.sign(axial_load), np.sign(screw_speed)
        nothing = np.zeros_like(screw_speed)
        signs: dict[Sign, Vector] = {
            "load": load,
            "against load": -load,
            "speed": speed,
            "motion": load * speed,
            "none": nothing + 1,
            "absent": nothing,
        }
        direction = -1.0 if self.reversed else 1.0
        return direction * np.stack([signs[self.ideal], signs[self.friction]])


#: The simplest first: of conventions that fit a log equally well, the first is taken.
CONVENTIONS: Sequence[TorqueConvention] = (
    TorqueConvention("friction", "friction torque, its sign that of the speed", "absent", "speed"),
    TorqueConvention("friction", "magnitude of the friction torque", "absent", "none"),
    TorqueConvention("drive", "torque on the shaft, load and speed with their signs", "load", "speed"),
    TorqueConvention("drive", "torque on the shaft, the load always against the motion", "speed", "speed"),
    TorqueConvention("drive", "torque on the shaft, loads with the opposite sign", "against load", "speed"),
    TorqueConvention("drive", "torque in the direction of the motion", "motion", "none"),
    TorqueConvention("drive", "magnitude of the driving torque", "none", "none"),
    TorqueConvention("drive", "magnitude of the torque on the shaft", "none", "motion"),
)
#: A convention replaces a simpler one if its residual is below this share of the other's.
DECISIVE_RATIO = 0.9
#: Friction of this ratio to the model's counts as a doubled residual: models are hardly further off.
IMPLAUSIBLE_RATIO = 5.0
#: Rows that the conventions are compared on, evenly spaced.
MAXIMUM_ROWS = 2000


def identify_convention(
    torque: Vector,
    torques: Vector,
    axial_load: Vector,
    screw_speed: Vector,
    drift: Vector | None = None,
    kind: Kind = "unknown",
    known: TorqueConvention | None = None,
) -> tuple[TorqueConvention, float]:
    """The convention under which a column is nearest to a model, and the scatter that remains.

    ``torques`` are the ideal torque and the friction torque of the model, of shape (2, rows). Friction may be any
    multiple of the model's and have a constant part, and the sensor a zero error and a ``drift`` where friction has
    both signs: the remaining scatter is that which no fit removes. A known ``kind`` restricts the conventions, one that
    is ``known`` itself is the only one.
    """
    some = np.linspace(0, torque.size - 1, min(torque.size, MAXIMUM_ROWS)).astype(np.int64)
    choices = [convention for convention in CONVENTIONS if kind in ("unknown", convention.kind)]
    choices += [one._replace(reversed=True, description=f"{one.description}; reversed") for one in choices]
    choices = choices if known is None else [known]

    def penalised_scatter(convention: TorqueConvention) -> tuple[float, float]:
        weights = convention.weights(axial_load[some], screw_speed[some])
        ideal = np.abs(torques[0][some]) * np.sign(convention.loads(axial_load[some], screw_speed[some]))
        columns = [weights[1] * torques[1][some], weights[1]]
        if np.any(weights[1] > 0) and np.any(weights[1] < 0):
            columns += [np.ones(some.size), *([] if drift is None else [drift[some]])]
        rest = torque[some] - weights[0] * ideal
        stacked = np.stack(columns, axis=1)
        result, _ = robust_linear(stacked, rest)
        scatter = scatter_of(stacked @ result - rest, torque)
        typical = float(np.median(torques[1][some])) or 1.0
        # friction at a typical row over the model's, constant part included
        factor = result[0] + result[1] / typical
        if not factor > 0:
            return np.inf, scatter
        return scatter * (1 + (np.log(factor) / np.log(IMPLAUSIBLE_RATIO)) ** 2), scatter

    scatters = [penalised_scatter(convention) for convention in choices]
    best = 0
    for place, (penalised, _) in enumerate(scatters):
        if penalised < DECISIVE_RATIO * scatters[best][0]:
            best = place
    return choices[best], scatters[best][1]


#: Friction that depends on nothing but the direction, and that no model of the balls has.
CONSTANT_TORQUE = Quantity(
    "constant_torque",
    "N m",
    Info("M_0", "friction torque of seals, bearings and wipers, the same at all loads and speeds"),
)
#: Errors of the torque sensor, which are fitted beside the friction where the log can tell them from it: the zero where
#: both directions were run, the drift also where the operating points did not change along with it (the sensor is
#: then right at the beginning).
TORQUE_OFFSET = Quantity("torque_offset", "N m", Info("T_0", "zero error of the torque sensor, mean of the log"))
TORQUE_DRIFT = Quantity("torque_drift", "N m", Info("T_1", "drift of the torque sensor over the log"))
#: Half waves over the log, for a zero that wanders: sensors and seals warm up.
WANDER_HALF_WAVES = (2, 3, 4)
TORQUE_WANDER = {
    waves: Quantity(f"torque_wander_{waves}", "N m", Info(f"T_{waves}", f"{waves} half waves of the zero over the log"))
    for waves in WANDER_HALF_WAVES
}
#: A zero is taken to wander by so many times the scatter of the log, not much more.
WANDER_DEVIATION = 3.0
#: The fit is insensitive to a parameter whose scale moves all torques together by less than this many scatters: it is
#: then started again from these multiples of its start.
INSENSITIVE, RESTART_FACTORS = 1.0, (3.0, 10.0, 1 / 3, 0.1)
#: A torque beyond all others, in units of the largest measured one.
BEYOND = 1e3
#: A drift of one direction is fitted if the numbers leave this share of it unexplained.
MINIMUM_INDEPENDENT_SHARE = 0.8
#: Fewer rows tell no drift, and fewer than these no wandering.
MINIMUM_ROWS_FOR_DRIFT, MINIMUM_ROWS_FOR_WANDER = 20, 60


@dataclasses.dataclass(frozen=True)
class Parameter:
    """One number to fit, in SI: what it is, where it starts, its bounds, and what a change of it is measured by."""

    name: str
    quantity: Quantity
    start: float
    scale: float
    low: float = -np.inf
    high: float = np.inf
    #: The standard deviation that it has anyway, about zero; None where nothing is known.
    deviation: float | None = None


@dataclasses.dataclass(frozen=True, eq=False)
class Problem:
    """The parameters of a fit: numbers of the model first, then those that the torque is linear in."""

    response: Response
    #: Number of free parameters; those of the sensor follow them.
    free: int
    parameters: Sequence[Parameter]
    #: Factors of ideal torque and friction torque in what was measured, of shape (2, rows).
    weights: Vector
    #: Derivatives by the linear parameters, of shape (rows, linear parameters).
    columns: Vector
    #: The torque that stands for numbers that do not fit together: far beyond all others.
    beyond: float

    @classmethod
    def of(
        cls,
        subject: Configuration,
        response: Response,
        asked: Mapping[str, str],
        log: TorqueLog,
        convention: TorqueConvention,
        scatter: float,
        torques: Vector,
        slopes: Vector,
        bounds: Mapping[str, tuple[float, float]],
    ) -> Problem:
        """``asked`` says which input a person means by each name; ``torques`` and ``slopes`` are what the
        response says at the start, ``scatter`` is what the torque convention leaves.

        Raises :class:`~ballscrew.basis.errors.InputError` for bounds that leave no room.
        """
        names = {full: name for name, full in asked.items()}
        parameters = [
            _parameter(names[full], subject.inputs[full][1], float(start))
            for full, start in zip(response.names, response.start, strict=True)
        ]
        weights = convention.weights(log.axial_load, log.screw_speed)
        usual = float(np.median(np.abs(torques[1]))) or 1.0
        columns: list[Vector] = []
        if CONSTANT_TORQUE.name in asked:
            parameters.append(Parameter(CONSTANT_TORQUE.name, CONSTANT_TORQUE, 0.0, usual))
            columns.append(weights[1])
        free = len(parameters)
        both = bool(np.any(weights[1] > 0) and np.any(weights[1] < 0))
        if both:
            # a zero error has the same sign in both directions, and friction has not
            parameters.append(Parameter(TORQUE_OFFSET.name, TORQUE_OFFSET, 0.0, usual))
            columns.append(np.ones(len(log)))
        drift, wander = drift_of(log), WANDER_DEVIATION * scatter
        if drift is not None and (both or _is_independent(drift, np.einsum("tr,trn->rn", weights, slopes))):
            parameters.append(Parameter(TORQUE_DRIFT.name, TORQUE_DRIFT, 0.0, usual))
            # without a zero error the sensor was right at the beginning
            columns.append(drift if both else drift + 0.5)
            if both and len(log) >= MINIMUM_ROWS_FOR_WANDER:
                for waves, quantity in TORQUE_WANDER.items():
                    parameters.append(Parameter(quantity.name, quantity, 0.0, usual, deviation=wander))
                    columns.append(np.cos(waves * np.pi * (drift + 0.5)))
        parameters = [_bounded(parameter, bounds) for parameter in parameters]
        linear = np.stack(columns, axis=1) if columns else np.empty((len(log), 0))
        beyond = BEYOND * max(usual, float(np.max(np.abs(log.torque))))
        return cls(response, free, parameters, weights, linear, beyond)

    @property
    def names(self) -> list[str]:
        """The names of the free parameters, as given."""
        return [parameter.name for parameter in self.parameters[: self.free]]

    @property
    def start(self) -> Vector:
        """The start values of the fit."""
        return np.array([parameter.start for parameter in self.parameters])

    @property
    def scale(self) -> Vector:
        """The scales of the parameters."""
        return np.array([parameter.scale for parameter in self.parameters])

    def scale_at(self, values: Vector) -> Vector:
        """The scales of the parameters at the solution."""
        numbers = len(self.response.names)
        pairs = zip(self.parameters, values, strict=True)
        # bounds that a person gives say what is wanted, not what matters
        own = [_scale(*_ends(p.quantity.info), float(v), p.scale) for p, v in pairs]
        return np.array([*own[:numbers], *np.maximum(self.scale, np.abs(values))[numbers:]])

    @property
    def bounds(self) -> tuple[Vector, Vector]:
        """Lower and upper bounds."""
        low, high = ([getattr(p, side) for p in self.parameters] for side in ("low", "high"))
        return np.array(low), np.array(high)

    @property
    def sensor_columns(self) -> Vector:
        """Derivatives by the errors of the sensor, of shape (rows, errors)."""
        return self.columns[:, self.free - len(self.response.names) :]

    @property
    def has_torque_offset(self) -> bool:
        """True where a zero error of the sensor is distinguished from friction."""
        return any(parameter.name == TORQUE_OFFSET.name for parameter in self.parameters)

    @property
    def deviations(self) -> dict[int, Distribution]:
        """Distributions that parameters have anyway, by place."""
        return {i: Normal(0.0, p.deviation) for i, p in enumerate(self.parameters) if p.deviation is not None}

    def quantity(self, name: str) -> Quantity:
        """The quantity of a parameter."""
        return next(parameter.quantity for parameter in self.parameters if parameter.name == name)

    def torque(self, values: Vector) -> tuple[Vector, Vector]:
        """The torque of every row as it would be measured, and its derivatives, of shape (rows, parameters).

        Where the model has no torque at some rows it is taken as zero that nothing changes, where it has none at all as
        far beyond what was measured: the fit sees it miss, and turns back.
        """
        numbers = len(self.response.names)
        torques, slopes = self.response(values[:numbers])
        told = np.asarray(np.isfinite(torques).all(axis=0) & np.isfinite(slopes).all(axis=(0, 2)))
        torque = np.where(told, np.sum(self.weights * torques, axis=0), 0.0 if told.any() else self.beyond)
        by_numbers = np.where(told[:, np.newaxis], np.einsum("tr,trn->rn", self.weights, slopes), 0.0)
        return torque + self.columns @ values[numbers:], np.hstack([by_numbers, self.columns])

    def on(self, chosen: NDArray[np.bool_]) -> Callable[[Vector], tuple[Vector, Vector]]:
        """:meth:`torque` of some of the rows."""

        def torque(values: Vector) -> tuple[Vector, Vector]:
            result, slopes = self.torque(values)
            return result[chosen], slopes[chosen]

        return torque


def escape_insensitive_start(
    problem: Problem, measured: Vector, scatter: float, start: Vector, chosen: NDArray[np.bool_]
) -> Vector:
    """A start from which the fit depends on every parameter: a flat one, as on the clamp of friction, is moved."""
    model, (low, high) = problem.on(chosen), problem.bounds
    torque, slopes = model(start)
    insensitive = np.linalg.norm(slopes, axis=0) * problem.scale < INSENSITIVE * scatter
    for i in np.flatnonzero(insensitive[: len(problem.response.names)]):
        least = loss_of(torque - measured, scatter)
        for factor in RESTART_FACTORS:
            tried = start.copy()
            tried[i] = np.clip(factor * start[i], low[i], high[i])
            off = loss_of(model(tried)[0] - measured, scatter)
            if off < least:
                start, least = tried, off
    return start


def drift_of(log: TorqueLog) -> Vector | None:
    """A line over the time of a log, or else over its rows, which come one after the other anyway."""
    time = np.asarray(log.line if log.time is None else log.time, dtype=float)
    return None if len(log) < MINIMUM_ROWS_FOR_DRIFT or np.ptp(time) == 0 else (time - time.min()) / np.ptp(time) - 0.5


def _is_independent(drift: Vector, slopes: Vector) -> bool:
    """Test whether a drift is independent of the effects of the parameters, unlike in a log run from slow to fast."""
    columns = np.hstack([np.ones((drift.size, 1)), slopes])
    columns = columns / np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    rest = drift - columns @ np.linalg.lstsq(columns, drift, rcond=None)[0]
    return float(rest @ rest) > MINIMUM_INDEPENDENT_SHARE * float(drift @ drift)


def _parameter(name: str, quantity: Quantity, start: float) -> Parameter:
    """A number of the model with the bounds it has anyway; its scale is its
    own size or what it has to its bound; its range where it is zero.
    """
    info = quantity.info
    low, high = _ends(info)
    scale = _scale(low, high, start, high - low if np.isfinite(high - low) else 1.0)
    # open bounds are kept clear of
    low += 1e-6 * scale * (info.above is not None)
    high -= 1e-6 * scale * (info.below is not None)
    return Parameter(name, quantity, start, scale, low, high)


def _ends(info: Info) -> tuple[float, float]:
    """The bounds that a quantity has anyway."""
    low = max((bound for bound in (info.at_least, info.above) if bound is not None), default=-np.inf)
    high = min((bound for bound in (info.at_most, info.below) if bound is not None), default=np.inf)
    return low, high


def _scale(low: float, high: float, value: float, otherwise: float) -> float:
    """The size of a value, or what it has to a bound: of a conformity what counts is what it has above one half."""
    sizes = [abs(value), *(abs(value - end) for end in (low, high) if np.isfinite(end))]
    return min((size for size in sizes if size > 0), default=otherwise) if value else otherwise


def _bounded(parameter: Parameter, bounds: Mapping[str, tuple[float, float]]) -> Parameter:
    """A parameter with the given bounds, within its own."""
    if parameter.name not in bounds:
        return parameter
    low, high = max(bounds[parameter.name][0], parameter.low), min(bounds[parameter.name][1], parameter.high)
    where, given = f"fit.bounds.{parameter.name}", f"{low:g} to {high:g}"
    raise_if_any([Fault(where, "leave no room", given, "put the lower one first")] if not low < high else [])
    return dataclasses.replace(parameter, low=low, high=high, start=float(np.clip(parameter.start, low, high)))
