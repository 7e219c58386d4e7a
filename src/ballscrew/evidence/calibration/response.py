"""The torque of a log as a model has it, and its derivatives by the numbers that are free.

The error of the oil temperature of a log: one for all of its rows, as of a sensor beside the oil.

A fit takes the temperatures as they are, and so the error is not in its residuals: no number of rows makes it
smaller. It moves every estimate by what a warmer oil does to the torques.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.errors import (
    Fault,
    InputError,
    nearest,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.engine.evaluation.derivatives import Slopes, slopes_of
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import Engine
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: The torques that every reading of a log is made of, in this order.
TORQUES = ("ideal_torque", "screw_torque")
#: Relative step of a difference: the cube root of the rounding of a torque, at which its error is least; and the number
#: that a step is taken of where the value is zero.
STEP, SCALE_OF_ZERO = 1e-5, 1e-3


def resolve_input(subject: Configuration, name: str, section: str = "fit", beside: Sequence[str] = ()) -> str:
    """The input of that name: its own, that of a coefficient without its law, or either with its section.

    ``beside`` are names that may be given and are no inputs. Raises :class:`~ballscrew.basis.errors.InputError` for
    what no input or more than one is called.
    """
    known = subject.inputs
    bare = name.removeprefix("model.").removeprefix("screw.").removeprefix("lubricant.")
    result = [bare] if bare in known else [other for other in known if other.rpartition(".")[2] == bare]
    if len(result) > 1:
        raise InputError(Fault(f"{section}.free", "could be several numbers", name, f"one of {', '.join(result)}"))
    if not result:
        raise InputError(Fault(f"{section}.free", "unknown name", name, nearest(bare, [*beside, *known])))
    if result[0] in OPERATION or result[0] == TEMPERATURE.name:
        raise InputError(Fault(f"{section}.free", "is given by the log", name, "leave it out"))
    if known[result[0]][1].info.whole:
        raise InputError(Fault(f"{section}.free", "is a whole number, which cannot be fitted", name, "leave it out"))
    return result[0]


def initial_value(subject: Configuration, name: str) -> float:
    """The value that a number has before it is fitted."""
    value = subject.value_of(name)
    if value is None and name == "ball_to_ball_force":
        value = subject.model.imposed_ball_force(subject.screw)
    if value is None:
        raise InputError(Fault(f"fit.{name}", "has no value to start from", "", "set it in the case, or leave it out"))
    if np.ndim(value):
        raise InputError(Fault(f"fit.{name}", "is an array", "", "give one number"))
    return float(value)


@dataclasses.dataclass(frozen=True, eq=False)
class Response:
    """Both torques at every row of a log, and their derivatives, for any values of the free numbers.

    The formulas are recorded once, and compiled at most once. Derivatives are exact, but for a nut whose balls are
    solved one by one: there each is a difference between values :data:`STEP` above and below, all in one evaluation.
    """

    names: tuple[str, ...]
    start: NDArray[np.float64]
    #: The load with its sign, the size of the speed, and perhaps the temperature, of each row.
    points: Mapping[str, NDArray[np.float64]]
    evaluation: Evaluation

    @classmethod
    def of(
        cls,
        subject: Configuration,
        names: Sequence[str],
        points: Mapping[str, NDArray[np.float64]],
        *,
        engine: Engine | None = None,
        times: int = 1,
    ) -> Response:
        """``points`` are all of one length. ``times`` says how often the whole will be evaluated.

        Raises :class:`~ballscrew.basis.errors.InputError` for a law that cannot be recorded, and for values that are
        refused.
        """
        start = np.array([initial_value(subject, name) for name in names])
        if subject.nut.one_by_one:
            plan = Plan.of(
                subject, TORQUES, _beside(dict(zip(names, start, strict=True)), points, _steps(start)), "fit"
            )
        else:
            held = dict(zip(names, start.tolist(), strict=True))
            plan = slopes_of(subject, TORQUES, list(names), {**_in_rows(points), **held})
        return cls(tuple(names), start, points, Evaluation.of(plan, engine, times, shared=True))

    def at(self, points: Mapping[str, NDArray[np.float64]]) -> Response:
        """The same at other rows, which are not checked."""
        return dataclasses.replace(self, points=points)

    def fits(self, values: NDArray[np.float64]) -> bool:
        """Return whether the parts accept these values of the free numbers."""
        try:
            self.evaluation.plan.subject.changed(dict(zip(self.names, values.tolist(), strict=True)))
        except InputError:
            return False
        return True

    def __call__(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """The torques, of shape (torques, rows), and their derivatives, of shape (torques, rows, numbers).

        All NaN where the numbers do not fit together, such as balls too big for the screw.
        """
        if not self.fits(values):
            shape = (len(TORQUES), *next(iter(self.points.values())).shape)
            return np.full(shape, np.nan), np.full((*shape, values.size), np.nan)
        if isinstance(self.evaluation.plan, Slopes):
            return self._exact(values)
        return self._by_differences(values)

    def _exact(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        result = self._found({**_in_rows(self.points), **dict(zip(self.names, values.tolist(), strict=True))})
        torques = np.stack([result[torque] for torque in TORQUES])
        slopes = [[result[f"d_{torque}_d_{name.replace('.', '_')}"] for name in self.names] for torque in TORQUES]
        return torques, np.moveaxis(np.array(slopes), 1, 2)

    def _by_differences(self, values: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        steps = _steps(np.where(values == 0, self.start, values))
        result = self._found(_beside(dict(zip(self.names, values, strict=True)), self.points, steps))
        each = np.stack([result[torque] for torque in TORQUES]).reshape(len(TORQUES), 1 + 2 * values.size, -1)
        slopes = (each[:, 1::2] - each[:, 2::2]) / (2.0 * steps[:, np.newaxis])
        return each[:, 0], np.moveaxis(slopes, 1, 2)

    def _found(self, axes: Mapping[str, Any]) -> dict[str, NDArray[np.float64]]:
        made = self.evaluation.at(axes)
        outputs = made.empty(made.plan.total)
        made.fill(outputs, slice(0, made.plan.total))
        return outputs


def _in_rows(points: Mapping[str, NDArray[np.float64]]) -> dict[str, xr.DataArray]:
    return {name: xr.DataArray(held, dims="row") for name, held in points.items()}


def _steps(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Steps added to each number and taken from it."""
    return STEP * np.where(values == 0, SCALE_OF_ZERO, np.abs(values))


def _beside(
    values: Mapping[str, float], points: Mapping[str, NDArray[np.float64]], steps: NDArray[np.float64]
) -> dict[str, xr.DataArray]:
    """All rows with these values, then for each number in turn all rows with it a step above, and a step below."""
    blocks = 1 + 2 * len(values)
    count = next(iter(points.values())).size
    result = {name: np.tile(held, blocks) for name, held in points.items()}
    for place, (name, value) in enumerate(values.items()):
        each = np.full(blocks, value)
        each[1 + 2 * place] += steps[place]
        each[2 + 2 * place] -= steps[place]
        result[name] = np.repeat(each, count)
    return _in_rows(result)


#: Half the width of the 95 % interval of an oil temperature, K: that of a sensor near the nut, and without any.
LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE = 2.0, 10.0
#: It as a quantity, and a value of it that says nothing of the oil any more, K.
TEMPERATURE_ERROR = Quantity(
    "temperature_error", "K", Info(r"\Delta T", "half the width of the 95 % interval of the oil temperature of a log")
)
MOST_TEMPERATURE_ERROR = 100.0
#: The input that a temperature changes where the oil has no grade.
VISCOSITY = "viscosity"
#: The difference for slopes by the temperature, K.
_STEP = 0.5


def uses_temperatures(lubricant: Lubricant, log: TorqueLog) -> bool:
    """Test whether the temperatures of a log are used: there are some, and the oil follows them."""
    return bool(lubricant.follows_temperature and log.temperature is not None)


def usual_error(lubricant: Lubricant, log: TorqueLog) -> float:
    """Half the width of the 95 % interval of the oil temperature of a log, K: less where it is logged and used."""
    return LOGGED_TEMPERATURE if uses_temperatures(lubricant, log) else UNKNOWN_TEMPERATURE


def torque_of_model(subject: Configuration, points: Mapping[str, Any], weights: Vector, warmer: Any = 0.0) -> Vector:
    """The torque as it would be measured at the rows of a log, with an oil that is ``warmer`` by so many kelvin.

    What was changed of an oil keeps its ratio to that of the grade at all temperatures of the log.
    """
    oil = subject.lubricant
    if TEMPERATURE.name in points:
        oil = oil.at(points[TEMPERATURE.name] + warmer)
    elif np.any(warmer):
        oil = dataclasses.replace(oil, viscosity=oil.viscosity * np.exp(-warmer * oil.temperature_coefficient))
    model = subject.model(subject.screw, oil, **{name: points[name] for name in OPERATION})
    return weights[0] * model.ideal_torque + weights[1] * model.screw_torque


@dataclasses.dataclass(frozen=True, eq=False)
class TemperatureError:
    """The error of the oil temperature of a log, and what it does to the estimates of a fit."""

    #: Half the width of its 95 % interval, K.
    half_width: float
    #: Derivatives of the torques of the rows by the temperature of all, N m/K.
    torque_per_kelvin: Vector
    #: Change of each estimate for an oil that was a kelvin warmer than logged, in SI by K.
    shift: Vector

    @property
    def deviation(self) -> float:
        """Its standard deviation, K."""
        return self.half_width / NORMAL_95

    @property
    def covariance(self) -> Vector:
        """Addition to the covariance of the estimates: ``J J^T s^2``."""
        return np.outer(self.shift, self.shift) * self.deviation**2


def torque_per_kelvin(
    subject: Configuration, free: Collection[str], points: Mapping[str, Any], weights: Vector
) -> Vector:
    """Derivatives of the torques of rows by a temperature that they share, N m/K.

    Zero where the viscosity itself is free: it is that of the log, whatever its temperature.
    """
    size = weights.shape[1]
    if VISCOSITY in free:
        return np.zeros(size)
    down, up = np.full(size, -_STEP), np.full(size, _STEP)
    if TEMPERATURE.name in points:
        info, rows = subject.lubricant.temperature_quantity.info, np.asarray(points[TEMPERATURE.name], dtype=float)
        low, high = (end if end is not None else np.nan for end in (info.at_least, info.at_most))
        down, up = np.fmax(down, low - rows), np.fmin(up, high - rows)
    torques = [torque_of_model(subject, points, weights, warmer) for warmer in (down, up)]
    slopes = (torques[1] - torques[0]) / (up - down)
    return np.where(np.isfinite(slopes), slopes, 0.0)
