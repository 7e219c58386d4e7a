"""Response models of the API for a condition over time."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, Number, Record, Shown, Tables, field


class Interval(Closed):
    """A number with its 95 % interval; null where there is none."""

    value: Number
    low: Number
    high: Number


class PartOfState(Interval):
    """One cause beside the others."""

    told: bool = Field(description="whether the tests tell it from the others")


class TestState(Closed):
    """The state of an axis in one test."""

    label: str = Field(description="its time as written, or its name")
    time: Number = Field(description="in the unit of time, from the first test, or the number of the test")
    temperature: Number = field("as it was logged; null where it was not", "K")
    torque: Interval = field("friction torque, reduced to one temperature and one speed", "N m")
    preload: Interval = Field(description="over that of the first tests")
    fall: Number = Field(
        description="sum of the torque's changes downward, in standard deviations; null in the baseline"
    )
    rise: Number = Field(description="the same upward")
    limit: Number = Field(description="of both sums")
    parts: dict[str, PartOfState] = Field(description="causes beside each other, for tests of several speeds")


class TrendOfPreload(Closed):
    """The slope of the logarithm of the preload; null where there are too few tests."""

    slope: Number
    low: Number
    high: Number
    of: str
    unit: Literal["1", "1/s"]


class ConditionResults(Closed):
    """The state in each test, the trend, and the alarm."""

    states: list[TestState]
    alarm: int | None = Field(description="the first test, from 0, whose torque has changed beyond its scatter")
    alarm_direction: Literal["fall", "rise"] | None
    lost_since: int | None = Field(description="the first test, from the alarm on, whose interval lies below the first")
    verdict: Literal["lost", "kept", "open"]
    probability_of_loss: Number = Field(description="that more than the tolerance is lost in the last test")
    trend: TrendOfPreload
    baseline: int = Field(description="number of the first tests, that the others are held against")
    tolerance: float
    false_alarms: float
    scatter: Number = Field(description="standard deviation of the logarithm of the torque")
    exponent: Number = Field(description="derivative of the logarithm of the torque by that of the preload")
    per_kelvin: Number = field("derivative of the logarithm of the torque by the temperature", "1/K")
    factor: Interval = Field(description="torque of the first tests over that of the model")
    reference_temperature: Number = field("null for an oil without a grade", "K")
    reference_speed: Number = field("", "rad/s")
    temperatures: int = Field(description="tests whose temperature is used")


class Condition(Shown):
    """The state of a nut over time."""

    inputs: Tables
    results: ConditionResults
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
