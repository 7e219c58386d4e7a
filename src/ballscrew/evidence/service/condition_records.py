"""Records of a condition: what became of the axis, what else could be, and what not to trust, the gravest first."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import InputError, each_of, message_of
from ballscrew.basis.records import Measured, Message, Named, Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.evidence.calibration.oil_temperature import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE, torque_of_model
from ballscrew.evidence.calibration.response import resolve_input
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import BOUNDARY_FRICTION, FACTOR, KELVIN
from ballscrew.evidence.service.condition_means import Means
from ballscrew.evidence.service.condition_parts import CONSTANT, WARMER, Part
from ballscrew.evidence.service.condition_reduction import Reduction
from ballscrew.evidence.service.condition_values import Condition
from ballscrew.evidence.service.posterior import FRICTION, MODEL_ERROR, PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS
from ballscrew.evidence.service.temperature_trend import temperature_trend
from ballscrew.physics.components.materials import TEMPERATURE

#: A factor between measured torque and model beyond this, either way, is said.
LARGEST_FACTOR = 1.5
#: So many equal torques in a row are said, and so many kelvin between the first tests and the last.
REPEATED, DIFFERENCE = 4, 5.0
#: What a trend is of: seconds, and where no times are known a number of tests.
SPANS = {"a year": 365.25 * 86400, "1000 h": 3.6e6}
OF_TESTS = ("10 tests", 10.0)
_POINTS = 41
_ZERO_CELSIUS = 273.15
_OF_TESTS = Message("so in the test that starves the most")
#: Both ways of a difference of temperatures, by whether something is hotter.
_LAST_TEST = {
    True: Message("the last test is {difference} K hotter than the first ones: reduced to {reference} by the model"),
    False: Message("the last test is {difference} K colder than the first ones: reduced to {reference} by the model"),
}
_OTHER_OIL = {
    True: Message("an oil {difference} K hotter would explain the last test"),
    False: Message("an oil {difference} K colder would explain the last test"),
}
_OIL_THAN_TAKEN = {
    True: Message("had the preload stayed, the oil would be {difference} K hotter than taken"),
    False: Message("had the preload stayed, the oil would be {difference} K colder than taken"),
}
_WITHIN_KNOWN = {
    True: Message("{oil}: within what is known of it ({limit} K either way)"),
    False: Message("{oil}: beyond what is known of it ({limit} K either way)"),
}
_SOME_TEMPERATURES = Message(
    "{missing} of {tests} tests have no temperature: it is taken to be that of the case, {limit} K either way, "
    "which makes their intervals wide"
)
_NO_TEMPERATURE = Message(
    "no temperature is logged, and each kelvin is {each} of the torque: the alarm says that the torque has changed, "
    "not that the nut has worn. The intervals have {limit} K either way in them. Log the temperature of the nut"
)
_NO_TEMPERATURE_BUT_OIL = Message(
    "no temperature is logged, and each kelvin is {each} of the torque: the alarm says that the torque has changed, "
    "not that the nut has worn. The intervals have {limit} K either way in them; {oil}. "
    "Log the temperature of the nut"
)
_OF_BASELINE = Message(
    "the torque of the first {tests} tests, reduced to one temperature, {trend}. Tests colder or warmer than these may "
    "give an alarm for it, or hide one: compare tests of one temperature, or take a longer baseline"
)
_FACTOR = Message(
    "the first tests have {factor} times the torque of the model ({low} to {high}): is this the screw? The share of "
    "the preload is by how the model goes with it; were the rest a constant torque (wipers, bearings), more preload "
    "would be lost"
)
_REPEATED = Message(
    "{test}: the torque is the same to the last digit as in the {tests} tests before: were all of them measured? "
    "The scatter may be too small"
)
_NO_PRELOAD = Message("no preload gives the torque of {tests}: look at the unit, and at the seals in [losses]")
_RATE = Message("one healthy test in {tests} gives an alarm, {chance} of series as long as this")
_NO_ALARM = Message("no alarm: the torque is as in the first {tests} tests, within its scatter ({rate})")
#: By whether the torque has fallen.
_ALARM = {
    True: Message("alarm at {test}: the torque has fallen beyond its scatter, {change} ({rate})"),
    False: Message("alarm at {test}: the torque has risen beyond its scatter, {change} ({rate})"),
}
_NOT_THE_OIL = Message("{alarm}; without temperatures: from {test} on an oil within {limit} K does not explain it")
_MAYBE_THE_OIL = Message("{alarm}; without temperatures: it may be the oil")
_MORE_TORQUE = Message(
    "{alarm}; wear takes torque: look for dirt, lack of lubricant, another oil, a nut that was adjusted or exchanged"
)
_LEFT = Message(
    "{verdict}: {share} of the preload of the first tests is left in the last one ({low} to {high}), "
    "less than {least} of it with a probability of {probability}"
)
_LEFT_SINCE = Message("{left}; the interval lies below all of it since {test}")
_TREND = Message("trend of the preload: {each} in {span} ({low} to {high}, independent errors)")
_NO_TREND = Message("trend of the preload: {each} in {span} ({low} to {high}, independent errors): none can be told")
_SHARE_OF_PART = Message("beside each other, {cause}: {share} of before ({low} to {high})")
_TORQUE_OF_PART = Message("beside each other, {cause}: {value} ({low} to {high})")
_KELVIN_OF_PART = Message("beside each other, {cause}: {value} K ({low} to {high})")
_NOT_TOLD = Message("{part}; not told from the others")
#: Causes beside each other.
_CAUSES = {
    PRELOAD: Message("preload"),
    CONSTANT: Message("constant torque"),
    WARMER: Message("oil beside what was logged"),
}
_NO_OIL = Message("had the preload stayed, no oil within {limit} K would explain the last torque")
#: By whether it would be less.
_CONSTANT_TORQUE = {
    True: Message("had the preload stayed, a constant torque (seals, bearings) would be {torque} less"),
    False: Message("had the preload stayed, a constant torque (seals, bearings) would be {torque} more"),
}
_NO_BOUNDARY_FRICTION = Message("had the preload stayed, no boundary friction would explain the last torque")
_OTHER_BOUNDARY_FRICTION = Message("had the preload stayed, the boundary friction would be {value} instead of {now}")


def records_of(
    made: Condition, means: Means, found: Reduction, subject: Configuration
) -> tuple[list[Record], list[Record]]:
    """The warnings and the verdicts of a condition."""
    graded = subject.lubricant.follows_temperature
    change = float(found.torque[-1] - np.mean(found.torque[: made.baseline]))
    warnings = [
        *_starved(means, subject, graded),
        *_of_temperatures(made, means, found, subject, change, graded),
        *_of_baseline(made, means, found, graded),
        *_of_speeds(means),
        *_of_factor(made),
        *_of_torques(made, means),
        *means.warnings,
    ]
    verdicts = [_alarm(made, found), _preload(made), *_of_trend(made)]
    if means.speeds.min() > 1 and made.states[-1].parts:
        verdicts += _parts(made)
    elif abs(change) > NORMAL_95 * math.hypot(made.scatter, MODEL_ERROR):
        verdicts += _instead(made, found, subject, change)
    return warnings, verdicts


def _warning(name: str, subject: str, text: str | Message, **more: Any) -> Record:
    return units.record(message_of(text), id=f"condition.{name}", subject=subject, **{"severity": "warning", **more})


def _starved(means: Means, subject: Configuration, graded: bool) -> list[Record]:
    """That the model, which reduces each torque to one temperature and speed, is starved of oil in some test."""
    points = {"axial_load": means.axial_load, "screw_speed": means.screw_speed}
    own = subject.lubricant.temperature
    if graded and own is not None:
        points[TEMPERATURE.name] = np.where(np.isnan(means.temperature), float(own), means.temperature)
    return subject.starvation(points, _OF_TESTS)


# -- warnings -------------------------------------------------------------------------------------


def _of_temperatures(
    made: Condition, means: Means, found: Reduction, subject: Configuration, change: float, graded: bool
) -> list[Record]:
    count, known = len(made.states), means.logged
    if not graded and known.any():
        text = (
            "the temperatures are not used, as the oil has a viscosity and no grade that changes with it: give "
            "[lubricant] a grade"
        )
        return [_warning("temperature_unused", "temperature", text, holds=False)]
    if known.all():
        warm = np.array([float(np.mean(means.temperature[means.test == i])) for i in range(count)])
        warmer = float(warm[-1] - np.mean(warm[: made.baseline]))
        if abs(warmer) < DIFFERENCE:
            return []
        message = _LAST_TEST[warmer > 0].of(
            difference=units.fixed(abs(warmer)), reference=_whole_degrees(made.reference_temperature)
        )
        return [_warning("temperatures_differ", "temperature", message, severity="info", value=warmer, unit="K")]
    limit = units.fixed(UNKNOWN_TEMPERATURE)
    if known.any():
        missing = count - np.count_nonzero(known)
        message = _SOME_TEMPERATURES.of(missing=units.fixed(missing), tests=units.fixed(count), limit=limit)
        return [_warning("temperature_missing", "temperature", message, holds=False)]
    each = units.percent(abs(made.per_kelvin), 1)
    needed = _warmer(subject, found, change)
    if needed is not None and abs(needed) >= 1:
        oil = _OTHER_OIL[needed > 0].of(difference=units.fixed(abs(needed)))
        message = _NO_TEMPERATURE_BUT_OIL.of(each=each, limit=limit, oil=oil)
    else:
        message = _NO_TEMPERATURE.of(each=each, limit=limit)
    return [_warning("no_temperature", "temperature", message, holds=False)]


def _whole_degrees(temperature: float) -> Measured:
    celsius = round(temperature - _ZERO_CELSIUS)
    return Measured(celsius + _ZERO_CELSIUS, TEMPERATURE, written=f"{celsius} °C")


def _of_baseline(made: Condition, means: Means, found: Reduction, graded: bool) -> list[Record]:
    """A trend of the reduced torque with the temperature in the first tests, where the nut counts as healthy."""
    count = made.baseline
    if not (graded and means.logged[:count].all()):
        return []
    warm = np.array([float(np.mean(means.temperature[means.test == i])) for i in range(count)])
    trend = temperature_trend(found.torque[:count], warm)
    if trend is None or not trend.told:
        return []
    message = _OF_BASELINE.of(tests=units.fixed(count), trend=trend.message(made.per_kelvin))
    fields = {"value": trend.slope, "limit": 0.0, "unit": "1/K", "holds": False}
    return [_warning("temperature_trend", "temperature", message, **fields)]


def _of_speeds(means: Means) -> list[Record]:
    if means.speeds.min() > 1:
        return []
    text = (
        "one speed in each test: preload, constant torque and boundary friction cannot be told apart; the share is "
        "that of a preload that changed alone"
    )
    return [_warning("one_speed", "screw_speed", text, severity="info")]


def _of_factor(made: Condition) -> list[Record]:
    if 1 / LARGEST_FACTOR <= made.factor <= LARGEST_FACTOR:
        return []
    low, high = made.factor_interval
    message = _FACTOR.of(factor=units.fixed(made.factor, 2), low=units.fixed(low, 2), high=units.fixed(high, 2))
    return [_warning("factor", "torque", message, value=made.factor, limit=LARGEST_FACTOR, holds=False)]


def _of_torques(made: Condition, means: Means) -> list[Record]:
    records: list[Record] = []
    if np.array_equal(means.speeds, np.ones(len(made.states))):
        run = 1
        for i in range(1, len(made.states)):
            run = run + 1 if means.torque[i] == means.torque[i - 1] else 1
            if run == REPEATED:
                message = _REPEATED.of(test=made.states[i].label, tests=units.fixed(REPEATED - 1))
                records.append(_warning("repeated", f"states.{i}", message, holds=False))
    untold = [state.label for state in made.states if not math.isfinite(state.preload)]
    if untold:
        message = _NO_PRELOAD.of(tests=each_of(untold[:3]))
        records.append(_warning("no_preload", "preload", message, holds=False, value=float(len(untold))))
    return records


def _warmer(subject: Configuration, found: Reduction, change: float) -> float | None:
    """How much warmer an oil would be that changes the logarithm of the torque so much; None beyond 60 K."""
    steps = np.linspace(-KELVIN, KELVIN, _POINTS)
    return _crossing(steps, _at_reference(subject, found, {}, steps), change)


def _crossing(steps: Vector, values: Vector, change: float) -> float | None:
    off = values - values[steps.size // 2] - change
    known = np.isfinite(off)
    steps, off = steps[known], off[known]
    crossed = np.flatnonzero(np.diff(np.sign(off)) != 0)
    if not crossed.size:
        return None
    # the smallest change that does it
    places = [float(np.interp(0.0, *_rising(off[i : i + 2], steps[i : i + 2]))) for i in crossed]
    return min(places, key=abs)


def _rising(x: Vector, y: Vector) -> tuple[Vector, Vector]:
    order = np.argsort(x)
    return x[order], y[order]


def _at_reference(subject: Configuration, found: Reduction, changes: Any, warmer: Vector) -> Vector:
    size = max([warmer.size, *(np.size(one) for one in changes.values())])
    points: dict[str, Any] = {"axial_load": np.zeros(size), "screw_speed": np.full(size, found.screw_speed)}
    if math.isfinite(found.temperature):
        points[TEMPERATURE.name] = np.full(size, found.temperature)
    with np.errstate(all="ignore"):
        there = subject.changed(changes) if changes else subject
        return np.log(np.broadcast_to(torque_of_model(there, points, FRICTION, np.broadcast_to(warmer, size)), size))


# -- verdicts -------------------------------------------------------------------------------------


def _alarm(made: Condition, found: Reduction) -> Record:
    count = len(made.states) - made.baseline
    chance = 1 - (1 - made.false_alarms) ** count
    rate = _RATE.of(tests=units.fixed(1 / made.false_alarms), chance=units.percent(chance, 1))
    if made.alarm is None:
        message = _NO_ALARM.of(tests=units.fixed(made.baseline), rate=rate)
        return units.record(message, id="condition.alarm", subject="torque", holds=True)
    change = math.expm1(float(found.torque[made.alarm] - np.mean(found.torque[: made.baseline])))
    message = _ALARM[made.chart.falls].of(test=made.states[made.alarm].label, change=units.change(change), rate=rate)
    if not made.temperatures:
        since = "" if made.lost_since is None else made.states[made.lost_since].label
        if since:
            message = _NOT_THE_OIL.of(alarm=message, test=since, limit=units.fixed(UNKNOWN_TEMPERATURE))
        else:
            message = _MAYBE_THE_OIL.of(alarm=message)
    if not made.chart.falls:
        message = _MORE_TORQUE.of(alarm=message)
    return units.record(
        message, id="condition.alarm", subject="torque", severity="warning", holds=False, value=float(made.alarm)
    )


def _preload(made: Condition) -> Record:
    last = made.states[-1]
    if not math.isfinite(last.preload):
        message = Message("the preload cannot be told from the last test: see the warnings")
        return units.record(message, id="condition.preload_left", subject=PRELOAD, severity="warning")
    probability = min(max(made.probability_of_loss, 0.001), 0.999)
    message = _LEFT.of(
        verdict=VERDICTS[made.verdict],
        share=units.percent(last.preload),
        low=units.percent(last.preload_low),
        high=units.percent(last.preload_high),
        least=units.percent(1 - made.tolerance),
        probability=units.to_significant(probability, 3),
    )
    if made.lost_since is not None:
        message = _LEFT_SINCE.of(left=message, test=made.states[made.lost_since].label)
    return units.record(
        message, id="condition.preload_left", subject=PRELOAD, value=last.preload, limit=1 - made.tolerance,
        holds={"lost": False, "kept": True, "open": None}[made.verdict],
        severity="warning" if made.verdict == "lost" else "info",
    )  # fmt: skip


def span_of(made: Condition) -> tuple[str, float]:
    """What a trend is given for, and how much time or how many tests that is: years, 1000 h or ten tests."""
    if made.per == "test":
        return OF_TESTS
    whole = made.states[-1].time - made.states[0].time
    name = "a year" if whole > SPANS["a year"] / 4 else "1000 h"
    return name, SPANS[name]


def _of_trend(made: Condition) -> list[Record]:
    if not math.isfinite(made.trend.slope):
        return []
    name, span = span_of(made)
    each, low, high = (units.change(math.expm1(span * one), 1) for one in made.trend)
    message = (_TREND if made.trend.told else _NO_TREND).of(each=each, span=Message(name), low=low, high=high)
    return [
        units.record(
            message, id="condition.trend", subject=PRELOAD, value=made.trend.slope, limit=0.0,
            unit="1" if made.per == "test" else "1/s", holds=made.trend.told,
        )
    ]  # fmt: skip


def _parts(made: Condition) -> list[Record]:
    """The causes beside each other in the last test."""
    records: list[Record] = []
    for name, part in made.states[-1].parts.items():
        message = _of_part(name, part)
        if not part.told:
            message = _NOT_TOLD.of(part=message)
        unit = {CONSTANT: "N m", WARMER: "K"}.get(name, "1")
        records.append(
            units.record(message, id="condition.part", subject=name, value=part.value, unit=unit, holds=part.told)
        )
    return records


def _of_part(name: str, part: Part) -> Message:
    cause = _CAUSES.get(name, Named(name))
    if name == CONSTANT:
        value = units.signed(units.in_unit(part.value, "N m", 2))
        low, high = (units.signed(units.to_significant(end, 2)) for end in (part.low, part.high))
        return _TORQUE_OF_PART.of(cause=cause, value=value, low=low, high=high)
    if name == WARMER:
        value, low, high = (units.signed(units.to_significant(one, 2)) for one in (part.value, part.low, part.high))
        return _KELVIN_OF_PART.of(cause=cause, value=value, low=low, high=high)
    share, low, high = (units.percent(one) for one in (part.value, part.low, part.high))
    return _SHARE_OF_PART.of(cause=cause, share=share, low=low, high=high)


def _instead(made: Condition, found: Reduction, subject: Configuration, change: float) -> list[Record]:
    """What would explain the last torque, had the preload stayed."""
    records: list[Record] = []
    needed = _warmer(subject, found, change)
    limit = LOGGED_TEMPERATURE if made.states[-1].temperature is not None else UNKNOWN_TEMPERATURE
    if needed is None:
        records.append(_cause(WARMER, _NO_OIL.of(limit=units.fixed(KELVIN)), None, limit, "K", False))
    else:
        within = abs(needed) <= math.sqrt(2) * limit
        oil = _OIL_THAN_TAKEN[needed > 0].of(difference=units.fixed(abs(needed), 1))
        message = _WITHIN_KNOWN[within].of(oil=oil, limit=units.fixed(limit))
        records.append(_cause(WARMER, message, needed, limit, "K", within))
    torque = math.exp(float(np.mean(found.torque[: made.baseline]))) * math.expm1(change)
    message = _CONSTANT_TORQUE[torque < 0].of(torque=units.in_unit(abs(torque), "N m", 3))
    records.append(_cause(CONSTANT, message, torque, None, "N m", None))
    return [*records, *_of_boundary_friction(found, subject, change)]


def _of_boundary_friction(found: Reduction, subject: Configuration, change: float) -> list[Record]:
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        return []
    now = float(subject.value_of(name))
    if not now > 0:
        return []
    steps = np.linspace(-math.log(FACTOR), math.log(FACTOR), _POINTS)
    needed = _crossing(steps, _at_reference(subject, found, {name: now * np.exp(steps)}, np.zeros(1)), change)
    if needed is None:
        return [_cause(BOUNDARY_FRICTION, _NO_BOUNDARY_FRICTION, None, now, "1", False)]
    value = now * math.exp(needed)
    message = _OTHER_BOUNDARY_FRICTION.of(value=units.to_significant(value, 3), now=units.to_significant(now, 3))
    return [_cause(BOUNDARY_FRICTION, message, value, now, "1", None)]


def _cause(
    name: str, message: Message, value: float | None, limit: float | None, unit: str, holds: bool | None
) -> Record:
    return units.record(
        message, id="condition.alternative", subject=name, value=value, limit=limit, unit=unit, holds=holds
    )
