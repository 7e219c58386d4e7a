"""Mean friction torques of the tests of an axis: of a table one for each test, of a log one for each speed."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.change_detection import OF_MAD
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.files.torque_logs.torque_series import JUMP, TorqueSeries
from ballscrew.physics.components.oil_grades import TEMPERATURE

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
        """How many tests there are."""
        return len(self.labels)

    @property
    def logged(self) -> NDArray[np.bool_]:
        """By test, whether its temperature is known."""
        known = np.isfinite(self.temperature)
        return np.array([bool(known[self.test == i].all()) for i in range(self.count)])

    @property
    def at_the_same_speeds(self) -> bool:
        """Whether every test has the same speeds."""
        if np.ptp(self.speeds) > 0:
            return False
        speeds = np.log(self.screw_speed).reshape(self.count, -1)
        return bool(np.all(np.abs(speeds - speeds[0]) < math.log(ONE_SPEED)))

    @property
    def speeds(self) -> NDArray[np.int64]:
        """By test, how many means it has."""
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
