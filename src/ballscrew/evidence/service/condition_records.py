"""Records of a condition: what became of the axis, what else could be, and what not to trust, the gravest first."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.response import resolve_input, torque_of_model
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import BOUNDARY_FRICTION, FACTOR, KELVIN
from ballscrew.evidence.service.condition_means import Means
from ballscrew.evidence.service.condition_values import CONSTANT, WARMER, Condition, Part, Reduction
from ballscrew.evidence.service.diagnostics import temperature_trend
from ballscrew.evidence.service.posterior import FRICTION, MODEL_ERROR, PRELOAD
from ballscrew.evidence.service.preload_change import VERDICTS
from ballscrew.physics.components.oil_grades import TEMPERATURE

#: A factor between measured torque and model beyond this, either way, is said.
LARGEST_FACTOR = 1.5
#: So many equal torques in a row are said, and so many kelvin between the first tests and the last.
REPEATED, DIFFERENCE = 4, 5.0
#: What a trend is of: seconds, and where no times are known a number of tests.
SPANS = {"a year": 365.25 * 86400, "1000 h": 3.6e6}
OF_TESTS = ("10 tests", 10.0)
_POINTS = 41
_ZERO_CELSIUS = 273.15
_OF_TESTS = "so in the test that starves the most"
#: Causes beside each other.
_CAUSES = {PRELOAD: "preload", CONSTANT: "constant torque", WARMER: "oil beside what was logged"}
_NO_TEMPERATURE = (
    "no temperature is logged, and each kelvin is {each} of the torque: the alarm says that the torque has changed, "
    "not that the nut has worn. The intervals have {limit} K either way in them{oil}. Log the temperature of the nut"
)
_STAYED = "had the preload stayed"


def records_of(
    made: Condition, means: Means, reduction: Reduction, subject: Configuration
) -> tuple[list[Record], list[Record]]:
    """The warnings and the verdicts of a condition."""
    graded = subject.lubricant.follows_temperature
    change = float(reduction.torque[-1] - np.mean(reduction.torque[: made.baseline]))
    warnings = [
        *_starved(means, subject, graded),
        *_of_temperatures(made, means, reduction, subject, change, graded),
        *_of_baseline(made, means, reduction, graded),
        *_of_speeds(means),
        *_of_factor(made),
        *_of_torques(made, means),
        *means.warnings,
    ]
    verdicts = [_alarm(made, reduction), _preload(made), *_of_trend(made)]
    if means.speeds.min() > 1 and made.states[-1].parts:
        verdicts += _parts(made)
    elif abs(change) > NORMAL_95 * math.hypot(made.scatter, MODEL_ERROR):
        verdicts += _instead(made, reduction, subject, change)
    return warnings, verdicts


def _warning(name: str, subject: str, text: str, **more: Any) -> Record:
    fields: dict[str, Any] = {"severity": "warning", **more}
    return Record(f"condition.{name}", subject, text, **fields)


def _starved(means: Means, subject: Configuration, graded: bool) -> list[Record]:
    """Warn that the model, which reduces each torque to one temperature and speed, is starved of oil in some test."""
    points = {"axial_load": means.axial_load, "screw_speed": means.screw_speed}
    own = subject.lubricant.temperature
    if graded and own is not None:
        points[TEMPERATURE.name] = np.where(np.isnan(means.temperature), float(own), means.temperature)
    return subject.starvation(points, _OF_TESTS)


# -- warnings -------------------------------------------------------------------------------------


def _of_temperatures(
    made: Condition, means: Means, reduction: Reduction, subject: Configuration, change: float, graded: bool
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
        reference = round(made.reference_temperature - _ZERO_CELSIUS)
        text = (
            f"the last test is {units.fixed(abs(warmer))} K {_hotter(warmer)} than the first ones: reduced to "
            f"{reference} °C by the model"
        )
        return [_warning("temperatures_differ", "temperature", text, severity="info", value=warmer, unit="K")]
    limit = units.fixed(UNKNOWN_TEMPERATURE)
    if known.any():
        missing = count - np.count_nonzero(known)
        text = (
            f"{missing} of {count} tests have no temperature: it is taken to be that of the case, {limit} K either "
            "way, which makes their intervals wide"
        )
        return [_warning("temperature_missing", "temperature", text, holds=False)]
    each = units.percent(abs(made.per_kelvin), 1)
    needed = _warmer(subject, reduction, change)
    oil = ""
    if needed is not None and abs(needed) >= 1:
        oil = f"; an oil {units.fixed(abs(needed))} K {_hotter(needed)} would explain the last test"
    text = _NO_TEMPERATURE.format(each=each, limit=limit, oil=oil)
    return [_warning("no_temperature", "temperature", text, holds=False)]


def _hotter(kelvin: float) -> str:
    return "hotter" if kelvin > 0 else "colder"


def _of_baseline(made: Condition, means: Means, reduction: Reduction, graded: bool) -> list[Record]:
    """A trend of the reduced torque with the temperature in the first tests, where the nut counts as healthy."""
    count = made.baseline
    if not (graded and means.logged[:count].all()):
        return []
    warm = np.array([float(np.mean(means.temperature[means.test == i])) for i in range(count)])
    trend = temperature_trend(reduction.torque[:count], warm)
    if trend is None or not trend.told:
        return []
    text = (
        f"the torque of the first {count} tests, reduced to one temperature, "
        f"{trend.text(made.per_kelvin)}. Tests colder or warmer than these may give an alarm for it, "
        "or hide one: compare tests of one temperature, or take a longer baseline"
    )
    fields = {"value": trend.slope, "limit": 0.0, "unit": "1/K", "holds": False}
    return [_warning("temperature_trend", "temperature", text, **fields)]


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
    factor, low, high = (units.fixed(value, 2) for value in (made.factor, *made.factor_interval))
    text = (
        f"the first tests have {factor} times the torque of the model ({low} to {high}): is this the screw? The share "
        "of the preload is by how the model goes with it; were the rest a constant torque (wipers, bearings), more "
        "preload would be lost"
    )
    return [_warning("factor", "torque", text, value=made.factor, limit=LARGEST_FACTOR, holds=False)]


def _of_torques(made: Condition, means: Means) -> list[Record]:
    records: list[Record] = []
    if np.array_equal(means.speeds, np.ones(len(made.states))):
        run = 1
        for i in range(1, len(made.states)):
            run = run + 1 if means.torque[i] == means.torque[i - 1] else 1
            if run == REPEATED:
                text = (
                    f"{made.states[i].label}: the torque is the same to the last digit as in the {REPEATED - 1} tests "
                    "before: were all of them measured? The scatter may be too small"
                )
                records.append(_warning("repeated", f"states.{i}", text, holds=False))
    untold = [state.label for state in made.states if not math.isfinite(state.preload)]
    if untold:
        tests = ", ".join(untold[:3])
        text = f"no preload gives the torque of {tests}: look at the unit, and at the seals in [losses]"
        records.append(_warning("no_preload", "preload", text, holds=False, value=float(len(untold))))
    return records


def _warmer(subject: Configuration, reduction: Reduction, change: float) -> float | None:
    """Rise of the oil temperature that changes the logarithm of the torque so much; None beyond 60 K."""
    steps = np.linspace(-KELVIN, KELVIN, _POINTS)
    return _crossing(steps, _at_reference(subject, reduction, {}, steps), change)


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


def _at_reference(subject: Configuration, reduction: Reduction, changes: Any, warmer: Vector) -> Vector:
    size = max([warmer.size, *(np.size(one) for one in changes.values())])
    points: dict[str, Any] = {"axial_load": np.zeros(size), "screw_speed": np.full(size, reduction.screw_speed)}
    if math.isfinite(reduction.temperature):
        points[TEMPERATURE.name] = np.full(size, reduction.temperature)
    with np.errstate(all="ignore"):
        there = subject.changed(changes) if changes else subject
        return np.log(np.broadcast_to(torque_of_model(there, points, FRICTION, np.broadcast_to(warmer, size)), size))


# -- verdicts -------------------------------------------------------------------------------------


def _alarm(made: Condition, reduction: Reduction) -> Record:
    count = len(made.states) - made.baseline
    chance = 1 - (1 - made.false_alarms) ** count
    rate = (
        f"one healthy test in {units.fixed(1 / made.false_alarms)} gives an alarm, {units.percent(chance, 1)} of "
        "series as long as this"
    )
    if made.alarm is None:
        text = f"no alarm: the torque is as in the first {made.baseline} tests, within its scatter ({rate})"
        return Record("condition.alarm", "torque", text, holds=True)
    change = math.expm1(float(reduction.torque[made.alarm] - np.mean(reduction.torque[: made.baseline])))
    test, way = made.states[made.alarm].label, "fallen" if made.chart.falls else "risen"
    text = f"alarm at {test}: the torque has {way} beyond its scatter, {units.change(change)} ({rate})"
    if not made.temperatures:
        since = "" if made.lost_since is None else made.states[made.lost_since].label
        limit = units.fixed(UNKNOWN_TEMPERATURE)
        not_oil = f"from {since} on an oil within {limit} K does not explain it"
        text += f"; without temperatures: {not_oil if since else 'it may be the oil'}"
    if not made.chart.falls:
        text += (
            "; wear takes torque: look for dirt, lack of lubricant, another oil, a nut that was adjusted or exchanged"
        )
    return Record.warning("condition.alarm", "torque", text, value=float(made.alarm))


def _preload(made: Condition) -> Record:
    last = made.states[-1]
    if not math.isfinite(last.preload):
        text = "the preload cannot be told from the last test: see the warnings"
        return Record("condition.preload_left", PRELOAD, text, severity="warning")
    probability = min(max(made.probability_of_loss, 0.001), 0.999)
    share, low, high, least = (
        units.percent(value) for value in (last.preload, last.preload_low, last.preload_high, 1 - made.tolerance)
    )
    text = (
        f"{VERDICTS[made.verdict]}: {share} of the preload of the first tests is left in the last one ({low} to {high})"
        f", less than {least} of it with a probability of {units.to_significant(probability, 3)}"
    )
    if made.lost_since is not None:
        text += f"; the interval lies below all of it since {made.states[made.lost_since].label}"
    return Record(
        "condition.preload_left",
        PRELOAD,
        text,
        value=last.preload,
        limit=1 - made.tolerance,
        holds={"lost": False, "kept": True, "open": None}[made.verdict],
        severity="warning" if made.verdict == "lost" else "info",
    )


def span_of(made: Condition) -> tuple[str, float]:
    """Unit that a trend is given for, and how much time or how many tests that is: years, 1000 h or ten tests."""
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
    text = f"trend of the preload: {each} in {name} ({low} to {high}, independent errors)"
    if not made.trend.told:
        text += ": none can be told"
    unit = "1" if made.per == "test" else "1/s"
    return [
        Record("condition.trend", PRELOAD, text, holds=made.trend.told, value=made.trend.slope, limit=0.0, unit=unit)
    ]


def _parts(made: Condition) -> list[Record]:
    """The causes beside each other in the last test."""
    records: list[Record] = []
    for name, part in made.states[-1].parts.items():
        text = f"beside each other, {_of_part(name, part)}"
        if not part.told:
            text += "; not told from the others"
        unit = {CONSTANT: "N m", WARMER: "K"}.get(name, "1")
        records.append(Record("condition.part", name, text, value=part.value, unit=unit, holds=part.told))
    return records


def _of_part(name: str, part: Part) -> str:
    cause = _CAUSES.get(name, name.rpartition(".")[2].replace("_", " "))
    if name == CONSTANT:
        value = units.signed(units.in_unit(part.value, "N m", 2))
        low, high = (units.signed(units.to_significant(end, 2)) for end in (part.low, part.high))
        return f"{cause}: {value} ({low} to {high})"
    if name == WARMER:
        value, low, high = (units.signed(units.to_significant(one, 2)) for one in (part.value, part.low, part.high))
        return f"{cause}: {value} K ({low} to {high})"
    share, low, high = (units.percent(one) for one in (part.value, part.low, part.high))
    return f"{cause}: {share} of before ({low} to {high})"


def _instead(made: Condition, reduction: Reduction, subject: Configuration, change: float) -> list[Record]:
    """Other explanations of the last torque, had the preload stayed."""
    records: list[Record] = []
    needed = _warmer(subject, reduction, change)
    limit = LOGGED_TEMPERATURE if made.states[-1].temperature is not None else UNKNOWN_TEMPERATURE
    if needed is None:
        text = f"{_STAYED}, no oil within {units.fixed(KELVIN)} K would explain the last torque"
        records.append(_cause(WARMER, text, None, limit, "K", False))
    else:
        within = abs(needed) <= math.sqrt(2) * limit
        text = (
            f"{_STAYED}, the oil would be {units.fixed(abs(needed), 1)} K {_hotter(needed)} than taken: "
            f"{'within' if within else 'beyond'} what is known of it ({units.fixed(limit)} K either way)"
        )
        records.append(_cause(WARMER, text, needed, limit, "K", within))
    torque = math.exp(float(np.mean(reduction.torque[: made.baseline]))) * math.expm1(change)
    way = "less" if torque < 0 else "more"
    text = f"{_STAYED}, a constant torque (seals, bearings) would be {units.in_unit(abs(torque), 'N m', 3)} {way}"
    records.append(_cause(CONSTANT, text, torque, None, "N m", None))
    return [*records, *_of_boundary_friction(reduction, subject, change)]


def _of_boundary_friction(reduction: Reduction, subject: Configuration, change: float) -> list[Record]:
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        return []
    now = float(subject.value_of(name))
    if not now > 0:
        return []
    steps = np.linspace(-math.log(FACTOR), math.log(FACTOR), _POINTS)
    needed = _crossing(steps, _at_reference(subject, reduction, {name: now * np.exp(steps)}, np.zeros(1)), change)
    if needed is None:
        text = f"{_STAYED}, no boundary friction would explain the last torque"
        return [_cause(BOUNDARY_FRICTION, text, None, now, "1", False)]
    value = now * math.exp(needed)
    other, own = units.to_significant(value, 3), units.to_significant(now, 3)
    text = f"{_STAYED}, the boundary friction would be {other} instead of {own}"
    return [_cause(BOUNDARY_FRICTION, text, value, now, "1", None)]


def _cause(name: str, text: str, value: float | None, limit: float | None, unit: str, holds: bool | None) -> Record:
    return Record("condition.alternative", name, text, value=value, limit=limit, unit=unit, holds=holds)
