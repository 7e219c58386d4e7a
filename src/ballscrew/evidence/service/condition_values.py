"""The value of a condition over time: the state in each test, trend, alarm, warnings and verdicts."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Literal

from ballscrew.basis.quantities import AngularSpeed, Temperature, TemperatureCoefficient
from ballscrew.basis.records import Record
from ballscrew.evidence.service.change_detection import Chart, Trend
from ballscrew.evidence.service.condition_parts import Part
from ballscrew.evidence.service.preload_change import CERTAIN, Verdict


@dataclasses.dataclass(frozen=True)
class State:
    """The state of an axis in one test; intervals hold 95 %."""

    #: Its time as written, or its name.
    label: str
    #: In s from the first test, or the number of the test.
    time: float
    #: As it was logged, K; None where it was not.
    temperature: Temperature | None
    #: Friction torque at the reference temperature and speed, N m; its interval has the temperature's doubt in it.
    torque: float
    torque_low: float
    torque_high: float
    #: Preload over that of the first tests, were nothing else changed; NaN where no preload gives the torque.
    preload: float
    preload_low: float
    preload_high: float
    #: Preload, constant torque, boundary friction and temperature beside each other, for tests of several speeds.
    parts: Mapping[str, Part]

    @property
    def preload_lost(self) -> bool:
        """Whether the interval of the preload lies below that of the first tests."""
        return self.preload_high < 1


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Condition:
    """Result of :func:`~ballscrew.evidence.service.condition.condition`."""

    #: Torque and preload of each test.
    states: Sequence[State]
    #: Number of the first tests, that the others are held against.
    baseline: int
    #: Share of healthy tests that give an alarm.
    false_alarms: float
    #: Temperature that is reduced to, K; NaN for an oil without a grade.
    reference_temperature: Temperature
    #: Speed that is reduced to, rad/s.
    reference_speed: AngularSpeed
    #: Sums of the torque's changes with their limits.
    chart: Chart
    #: Of the logarithm of the preload, by s or by test (``per``).
    trend: Trend
    #: What the trend is by: ``"s"``, or ``"test"`` for numbers of tests.
    per: str
    #: Standard deviation of the logarithm of the torque from test to test.
    scatter: float
    #: Share of the preload that may be lost.
    tolerance: float
    #: Probability that less than 1 − tolerance of the preload is left in the last test.
    probability_of_loss: float
    #: Derivative of the logarithm of the torque by the temperature at the reference in the last test, 1/K.
    per_kelvin: TemperatureCoefficient
    #: Derivative of the logarithm of the torque by that of the preload in the last test.
    exponent: float
    #: The torque of the first tests over that of the model.
    factor: float
    #: The interval of the factor.
    factor_interval: tuple[float, float]
    #: Tests whose temperature was logged and is used.
    temperatures: int
    #: Name and SHA-256 of the files.
    sources: Sequence[tuple[str, str]] = ()
    #: Remarks on the data, one line each.
    notes: Sequence[str] = ()
    #: Warnings as records.
    warning_records: Sequence[Record] = ()
    #: Verdicts as records.
    verdict_records: Sequence[Record] = ()

    @property
    def alarm(self) -> int | None:
        """The first test, from 0, in which the torque has changed beyond its scatter; None if there is none."""
        return self.chart.alarm

    @property
    def alarm_direction(self) -> Literal["fall", "rise"] | None:
        """Whether the torque falls or rises where there is an alarm."""
        return None if self.alarm is None else "fall" if self.chart.falls else "rise"

    @property
    def lost_since(self) -> int | None:
        """The first test, from the alarm on, whose interval of the preload, with all doubts, lies below the first."""
        if self.alarm is None:
            return None
        later = range(self.alarm, len(self.states))
        return next((i for i in later if self.states[i].preload_lost), None)

    @property
    def verdict(self) -> Verdict:
        """``"lost"`` or ``"kept"`` where that has a probability of :data:`CERTAIN`, otherwise ``"open"``."""
        probability = self.probability_of_loss
        return "lost" if probability >= CERTAIN else "kept" if probability <= 1 - CERTAIN else "open"

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return [record.text for record in self.warning_records]
