"""Mean friction torques of the tests of an axis: of a table one for each test, of a log one for each speed.

Detection of a change in a short series: a CUSUM with a stated rate of false alarms, and a robust trend.

The scatter and the mean of a healthy series are not known but estimated from it. The limits of the CUSUM are those of
series whose mean and scatter are estimated in the same way, so the rate holds from five tests on; with limits for a
known mean it would not.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.files.torque_logs.torque_series import JUMP, TorqueSeries
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: The allowance of the CUSUM in standard deviations: half of the change that it finds soonest.
ALLOWANCE = 1.0
#: A single test counts for no more standard deviations than these, so that one wild test is no alarm.
LARGEST_SCORE = 4.0
#: The standard deviation of a normal distribution over the median of the absolute values.
OF_MAD = 1.4826
#: Healthy series that the limits are from, and their seed.
_SERIES, _SEED = 50_000, 20261122


class Chart(NamedTuple):
    """A CUSUM chart: by test the sums of a fall and of a rise, and the limit; NaN in the tests of the baseline."""

    fall: Vector
    rise: Vector
    limit: Vector

    @property
    def alarm(self) -> int | None:
        """The first test beyond its limit."""
        beyond = np.flatnonzero(np.fmax(self.fall, self.rise) > self.limit)
        return int(beyond[0]) if beyond.size else None

    @property
    def falls(self) -> bool:
        """True where there is an alarm and it is of a fall."""
        return self.alarm is not None and bool(self.fall[self.alarm] > self.limit[self.alarm])


class Trend(NamedTuple):
    """The slope of a series over its times, with its 95 % interval."""

    slope: float
    low: float
    high: float

    @property
    def told(self) -> bool:
        """True where the interval leaves out zero."""
        return bool(self.low > 0 or self.high < 0)


def scatter_of(values: Vector) -> Vector:
    """Scatter of a series up to each of its values: root mean square of the successive differences over √2.

    A slow drift is hardly in it (the mean of the squared successive differences, MSSD). NaN for the first value; the
    last axis is the series.
    """
    squares = np.cumsum(np.diff(values, axis=-1) ** 2, axis=-1)
    count = np.arange(1, values.shape[-1])
    start = np.full((*values.shape[:-1], 1), math.nan)
    return np.concatenate([start, np.sqrt(squares / (2 * count))], axis=-1)


def robust_scatter(values: Vector) -> float:
    """Scatter of a series by the median of its successive differences: a step is not in it, nor is a wild value."""
    return OF_MAD * float(np.median(np.abs(np.diff(values)))) / math.sqrt(2)


def chart(values: Vector, baseline: int, besides: Vector, rate: float) -> Chart:
    r"""CUSUM of a series against the mean of its first tests (Page1954).

    ``S_i = max(0, S_{i−1} ± z_i − k)`` with ``z_i = (y_i − ȳ) / √(s_i² + b_i²)``: ȳ is the mean of the ``baseline``,
    s the scatter up to the test, b the standard deviations ``besides`` it. ``rate`` is the share of healthy tests, with
    normal errors, that give the first alarm; b > 0 makes alarms rarer.
    """
    scatter = scatter_of(values)
    deviation = np.sqrt(scatter**2 + besides**2)
    off = values - np.mean(values[:baseline])
    # values that are all the same have no deviation
    score = np.clip(off / np.where(deviation > 0, deviation, math.inf), -LARGEST_SCORE, LARGEST_SCORE)
    fall, rise = (np.full(values.size, math.nan) for _ in range(2))
    low = high = 0.0
    for i in range(baseline, values.size):
        low, high = max(0.0, low - score[i] - ALLOWANCE), max(0.0, high + score[i] - ALLOWANCE)
        fall[i], rise[i] = low, high
    limit = np.concatenate([np.full(baseline, math.nan), limits(baseline, values.size - baseline, rate)])
    return Chart(fall, rise, limit)


@functools.lru_cache(maxsize=16)
def _simulated(baseline: int, count: int, rate: float) -> tuple[float, ...]:
    random = np.random.default_rng(_SEED)
    first = random.standard_normal((_SERIES, baseline))
    mean, last = first.mean(axis=1), first[:, -1]
    squares = np.sum(np.diff(first, axis=1) ** 2, axis=1)
    differences = baseline - 1
    fall = rise = np.zeros(_SERIES)
    values: list[float] = []
    for _ in range(count):
        value = random.standard_normal(mean.size)
        squares = squares + (value - last) ** 2
        differences += 1
        score = np.clip((value - mean) / np.sqrt(squares / (2 * differences)), -LARGEST_SCORE, LARGEST_SCORE)
        fall, rise = np.maximum(0, fall - score - ALLOWANCE), np.maximum(0, rise + score - ALLOWANCE)
        worst = np.maximum(fall, rise)
        limit = float(np.quantile(worst, 1 - rate))
        values.append(limit)
        healthy = worst <= limit  # series with an alarm have ended
        mean, last, squares, fall, rise = (one[healthy] for one in (mean, value, squares, fall, rise))
    return tuple(values)


def limits(baseline: int, count: int, rate: float) -> Vector:
    """Limits of the CUSUM in the tests after the baseline: of healthy series without an alarm so far, the share
    ``rate`` is beyond.
    """
    # rounded up, so that a series that grows by a test simulates nothing anew
    whole = 50 * math.ceil(count / 50)
    return np.array(_simulated(baseline, whole, rate)[:count])


def trend(times: Vector, values: Vector) -> Trend:
    """Slope by Theil and Sen with the interval by Kendall's statistic (Sen1968, by SciPy).

    Nearly a third of the values may be wild. The interval holds for errors that are independent from test to test. NaN
    for fewer than three times that differ.
    """
    from scipy.stats import theilslopes  # slow to import: for those only who ask for it

    if np.unique(times).size < 3:
        return Trend(math.nan, math.nan, math.nan)
    result: Any = theilslopes(values, times, 0.95)  # SciPy's types have no names
    return Trend(float(result.slope), float(result.low_slope), float(result.high_slope))


#: Speeds of a log at most, and rows of a mean in one direction at least.
MOST_SPEEDS, LEAST_ROWS = 12, 3
#: A reason for leaving rows out.
FEW_OF_A_SPEED = f"fewer than {LEAST_ROWS} of their speed in a direction"
#: Speeds within this factor of each other are one.
ONE_SPEED = 1.1
#: Loads of a log that differ by more than this share of the preload are not those of one test.
LOAD_SHARE = 0.2
#: The standard deviation of a median over that of a mean.
_OF_MEDIAN = 1.2533


@dataclasses.dataclass(frozen=True, eq=False)
class Means:
    """Mean friction torques, one row for each, in SI: those of a test have its number."""

    #: The number of the test, from 0.
    test: NDArray[np.int64]
    screw_speed: Vector
    axial_load: Vector
    #: NaN where none was logged.
    temperature: Vector
    torque: Vector
    #: Standard deviation over the torque by the scatter within a log; 0 where nothing is known of it.
    deviation: Vector
    #: By test.
    labels: Sequence[str]
    times: Vector
    #: What the times count: ``"s"`` or ``"test"``.
    per: str
    sources: Sequence[tuple[str, str]] = ()
    warnings: Sequence[Record] = ()
    notes: Sequence[str] = ()

    @property
    def count(self) -> int:
        """Number of tests."""
        return len(self.labels)

    @property
    def logged(self) -> NDArray[np.bool_]:
        """Mask of the tests whose temperature is known."""
        known = np.isfinite(self.temperature)
        return np.array([bool(known[self.test == i].all()) for i in range(self.count)])

    @property
    def at_the_same_speeds(self) -> bool:
        """True where every test has the same speeds."""
        if np.ptp(self.speeds) > 0:
            return False
        speeds = np.log(self.screw_speed).reshape(self.count, -1)
        return bool(np.all(np.abs(speeds - speeds[0]) < math.log(ONE_SPEED)))

    @property
    def speeds(self) -> NDArray[np.int64]:
        """Number of means of each test."""
        return np.bincount(self.test, minlength=self.count)


def of_series(series: TorqueSeries, screw_speed: float | None) -> Means:
    """The means of a table. Raises :class:`~ballscrew.basis.errors.InputError` if no speed is known."""
    count = len(series)
    unknown = np.full(count, math.nan)
    speed = unknown if series.screw_speed is None else np.asarray(series.screw_speed, dtype=np.float64)
    if screw_speed is not None:
        speed = np.where(np.isfinite(speed), speed, screw_speed)
    if not (np.isfinite(speed).all() and (speed > 0).all()):
        remedy = 'add a column "speed [rpm]", or give the speed of all tests: --speed "100 rpm"'
        raise InputError(Fault("condition.screw_speed", "is not known", "", remedy))
    return Means(
        test=np.arange(count),
        screw_speed=speed,
        axial_load=np.zeros(count),
        temperature=unknown if series.temperature is None else np.asarray(series.temperature, dtype=np.float64),
        torque=np.asarray(series.torque, dtype=np.float64),
        deviation=np.zeros(count),
        labels=series.labels,
        times=np.asarray(series.time, dtype=np.float64),
        per=series.per,
        sources=() if series.source is None else (series.source,),
        notes=series.notes,
    )


def of_logs(subject: Configuration, logs: Sequence[Any], kind: Kind, inertia: float | None) -> Means:
    """The means of logs, one log for each test, in their order.

    Over rows of alike speed, the friction is half the difference between the medians forward and backward, each row
    over the torque of the model there: a zero error of the sensor and a constant load go out, and it does not matter
    that rows are not quite at one speed or temperature.

    Raises :class:`~ballscrew.basis.errors.InputError` for logs that cannot be used, of many loads, and given twice.
    """
    parts: list[tuple[int, _Mean]] = []
    warnings: list[Record] = []
    sources: list[tuple[str, str]] = []
    labels: list[str] = []
    faults: list[Fault] = []
    notes: list[str] = []
    read = [TorqueLog.of(data) for data in logs]
    raise_if_any(_faults_of_sources(read))
    for number, log in enumerate(read):
        name = f"log {number + 1}" if log.source is None else log.source[0]
        labels.append(name)
        if log.source is not None:
            sources.append(log.source)
        try:
            clean = log.cleaned(inertia=inertia)
            result, clean = _means(subject, clean, kind if kind != "unknown" else log.kind)
        except InputError as error:
            faults += [dataclasses.replace(fault, where=f"{name}: {fault.where}") for fault in error.faults]
            continue
        parts += [(number, one) for one in result]
        notes += [f"{name}: {line}" for line in (clean.usage, *clean.notes)]
        if not (np.any(clean.forward) and np.any(clean.backward)):
            warnings.append(
                Record.warning(
                    "condition.one_direction",
                    name,
                    f"{name}: one direction only: a zero error of the sensor counts as friction; measure in both",
                )
            )
    raise_if_any(faults)
    raise_if_any(_faults_of_jumps(parts, labels))
    columns = [np.array([getattr(one, name) for _, one in parts]) for name in _Mean.__annotations__]
    return Means(
        np.array([number for number, _ in parts], dtype=np.int64),
        *columns,
        labels=labels,
        times=np.arange(1.0, len(labels) + 1),
        per="test",
        sources=tuple(sources),
        warnings=tuple(warnings),
        notes=tuple(notes),
    )


def _faults_of_sources(logs: Sequence[TorqueLog]) -> list[Fault]:
    names: dict[str, str] = {}
    faults: list[Fault] = []
    for name, digest in (log.source for log in logs if log.source is not None):
        if digest in names:
            given = f"{names[digest]}, {name}"
            faults.append(Fault("condition", "two logs are the same file", given, "give each log once"))
        names[digest] = name
    return faults


def _faults_of_jumps(parts: Sequence[tuple[int, _Mean]], labels: Sequence[str]) -> list[Fault]:
    """Faults of logs whose torque is far from that of the log before, as that of another nut or in another unit."""
    usual = [float(np.median([one.torque for number, one in parts if number == i])) for i in range(len(labels))]
    remedy = "is it of the same nut, and in the same unit or with the same torque constant?"
    return [
        Fault(
            f"{labels[i]}: log",
            f"has {units.to_significant(usual[i] / usual[i - 1], 3)} times the friction of {labels[i - 1]}",
            "",
            remedy,
        )
        for i in range(1, len(labels))
        if abs(math.log(usual[i] / usual[i - 1])) > math.log(JUMP)
    ][:1]


@dataclasses.dataclass(frozen=True)
class _Mean:
    screw_speed: float
    axial_load: float
    temperature: float
    torque: float
    deviation: float


def _means(subject: Configuration, log: TorqueLog, kind: Kind) -> tuple[list[_Mean], TorqueLog]:
    """The means of a log, and the rows of it that are in them."""
    load, speed = np.asarray(log.axial_load), np.abs(log.screw_speed)
    preload: Any = subject.value_of(PRELOAD)
    if np.ptp(load) > LOAD_SHARE * float(preload):
        given = f"{np.min(load):.4g} to {np.max(load):.4g} N"
        raise InputError(Fault("log", "has many loads", given, "give the rows of one load, best of none"))
    used = log.temperature is not None and subject.lubricant.follows_temperature
    oil = subject.lubricant.at(log.temperature) if used else subject.lubricant
    model = subject.model(subject.screw, oil, axial_load=load, screw_speed=speed)
    friction = np.broadcast_to(model.screw_torque, speed.shape)
    if not (np.isfinite(friction).all() and (friction > 0).all()):
        raise InputError(Fault("log", "has rows at which the model has no torque", "", "look at loads and speeds"))
    both = bool(np.any(log.forward) and np.any(log.backward))
    ideal = np.zeros(speed.size)
    if not both and kind != "friction":
        if kind == "unknown" and np.any(load):
            remedy = "say --kind friction or --kind drive, or measure in both directions"
            raise InputError(
                Fault("log", "has a load and one direction, and the kind of torque is not known", "", remedy)
            )
        ideal = np.broadcast_to(model.ideal_torque, speed.shape)
    share = (np.asarray(log.torque) - ideal) * np.sign(log.screw_speed) / friction
    result: list[_Mean] = []
    kept = np.zeros(speed.size, dtype=bool)
    for rows in _of_one_speed(speed):
        sides = _sides(log, rows)
        if len(sides) < (2 if both else 1):
            continue
        kept[np.concatenate(sides)] = True
        result.append(_mean(log, rows, sides, share, friction))
    if not result:
        remedy = f"give {LEAST_ROWS} rows or more of each speed, in both directions or in one"
        raise InputError(Fault("log", "has no speed with enough rows", "", remedy))
    return result, log.select(kept, FEW_OF_A_SPEED)


def _sides(log: TorqueLog, rows: NDArray[np.int64]) -> list[NDArray[np.int64]]:
    """The rows forward, and those backward, where there are enough of them."""
    direction = np.sign(log.screw_speed)
    sides = [rows[direction[rows] == side] for side in (1, -1)]
    return [side for side in sides if side.size >= LEAST_ROWS]


def _mean(
    log: TorqueLog, rows: NDArray[np.int64], sides: Sequence[NDArray[np.int64]], share: Vector, friction: Vector
) -> _Mean:
    """The mean over rows of alike speed, of the ``share`` that was measured of the model's ``friction``."""
    load, speed = np.asarray(log.axial_load), np.abs(log.screw_speed)
    medians = [float(np.median(share[side])) for side in sides]
    deviations = [
        _OF_MEDIAN * OF_MAD * float(np.median(np.abs(share[side] - middle))) / math.sqrt(side.size)
        for side, middle in zip(sides, medians, strict=True)
    ]
    ratio = float(np.mean(medians))
    if not ratio > 0:
        remedy = "is the kind of torque right, and are the signs of torque and speed?"
        raise InputError(Fault("log", "has a mean friction torque that is not positive", "", remedy))
    return _Mean(
        screw_speed=math.exp(float(np.mean(np.log(speed[rows])))),
        axial_load=float(np.mean(load[rows])),
        temperature=math.nan if log.temperature is None else float(np.mean(np.asarray(log.temperature)[rows])),
        # over rows of alike speed the mean of the logarithms is the logarithm at the mean point
        torque=ratio * math.exp(float(np.mean(np.log(friction[rows])))),
        deviation=math.hypot(*deviations) / len(sides) / ratio,
    )


def _of_one_speed(speed: Vector) -> list[NDArray[np.int64]]:
    """Rows of alike speeds: by the gaps between the speeds, or evenly where there are none."""
    order = np.argsort(speed, kind="stable")
    gaps = np.flatnonzero(np.diff(np.log(speed[order])) > math.log(ONE_SPEED)) + 1
    parts = np.split(order, gaps)
    if len(parts) > MOST_SPEEDS:
        return np.array_split(order, MOST_SPEEDS)
    wide = any(speed[part].max() > 2 * ONE_SPEED * speed[part].min() for part in parts)
    return np.array_split(order, max(1, min(MOST_SPEEDS, speed.size // (4 * LEAST_ROWS)))) if wide else parts


def points_of(means: Means, subject: Configuration) -> dict[str, Vector]:
    """The operating points of the means; a temperature that is not known is that of the case."""
    points = {"axial_load": means.axial_load, "screw_speed": means.screw_speed}
    if subject.lubricant.follows_temperature:
        usual: Any = subject.lubricant.temperature
        points[TEMPERATURE.name] = np.where(np.isfinite(means.temperature), means.temperature, float(usual))
    return points
