"""The condition of an axis over time, from its tests: alarm and preload left; its document, and its sheet."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of, raise_if_any
from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Block,
    Cell,
    Chart,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    verdict_line,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity, Unit
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text, nut_text
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.condition import condition
from ballscrew.evidence.service.condition_values import Condition, Part, State
from ballscrew.files.torque_logs import reading, torque_series
from ballscrew.files.torque_logs.torque_series import quantities
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.questions.condition import ConditionOptions
from ballscrew.questions.service.compute import distributions
from ballscrew.questions.shared.declared import FINITE, envelope, from_attributes, parts_like
from ballscrew.questions.shared.option_values import faults_named, flags_of, with_flag
from ballscrew.questions.shared.options import options_of
from ballscrew.questions.shared.question import (
    Answer,
    Done,
    Request,
    Work,
)

#: Flags of the command line by the fields in which a condition finds faults.
_FLAGS: Mapping[str, str] = {
    **flags_of("condition", ConditionOptions),
    "condition.screw_speed": "--speed",
    "lubricant.temperature": "--at",
}


def check_kind(count: int, written: Mapping[str, Any]) -> None:
    """Refuse options of logs beside a table, which is ``count`` 1, and of a table beside several logs.

    ``written`` has the options as they were written. Raises :class:`~ballscrew.basis.errors.InputError`.
    """
    if count > 1:
        names, problem, remedy = ["speed"], "is for a table", "leave it out: logs have their speeds"
    else:
        names, problem = ["kind", "inertia", "torque_constant"], "is for logs"
        remedy = "leave it out: a table has mean friction torques"
    flags = options_of(ConditionOptions)
    raise_if_any(
        [Fault(flags[name].flag, problem, written[name], remedy) for name in names if written[name] is not None]
    )


def of_files(
    case: Case, paths: Sequence[Path], options: ConditionOptions, done: Callable[[int, int], None] | None = None
) -> Condition:
    """The condition from the table in one file, or from logs in several, in their order."""
    _check_temperature(options.reference_temperature)
    tests: Any
    if len(paths) == 1:
        tests = torque_series.read(paths[0], options.columns, options.keep_going)
        speed = _speed(tests, options)
    else:
        tests = [
            reading.read(
                path,
                options.columns,
                torque_constant=options.torque_constant,
                lead=float(case.screw.lead),
                keep_going=options.keep_going,
                done=done,
            )
            for path in paths
        ]
        speed = None
    with faults_named(_FLAGS):
        result = condition(
            case.model,
            case.screw,
            case.lubricant,
            tests,
            screw_speed=speed,
            baseline=options.baseline,
            false_alarms=options.false_alarms,
            tolerance=options.tolerance,
            reference_temperature=options.reference_temperature,
            distributions=distributions(case),
            joint=joint_of(case, all_of(case)),
            kind=options.kind,
            inertia=options.inertia,
        )
    records = (*result.warning_records, *case.implausible())
    return dataclasses.replace(result, warning_records=records)


def _speed(series: torque_series.TorqueSeries, options: ConditionOptions) -> float | None:
    """The speed of tests that have none in the table; without one the condition refuses them."""
    if options.speed is not None and series.screw_speed is not None and np.isfinite(series.screw_speed).all():
        raise InputError(Fault("--speed", "is given beside a column of speeds", "", "leave one of them out"))
    return options.speed


def _check_temperature(temperature: float | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a temperature that no oil has a viscosity at."""
    if temperature is not None:
        fault = fault_of("lubricant", TEMPERATURE, temperature, units.shown(temperature, TEMPERATURE))
        if fault is not None:
            raise InputError(with_flag(fault, _FLAGS))


@dataclasses.dataclass(frozen=True, eq=False)
class TestState(parts_like(State, "label", "time", "temperature")):
    """The state of an axis in one test."""

    torque: Annotated[Estimate, Unit("N m"), Info("", "friction torque, reduced to one temperature and one speed")]
    #: Over that of the first tests.
    preload: Estimate
    #: Sum of the torque's changes downward, in standard deviations; null in the baseline.
    fall: float
    #: The same upward.
    rise: float
    #: Of both sums.
    limit: float
    #: Causes beside each other, for tests of several speeds.
    parts: Mapping[str, Part]


class TrendOfPreload(NamedTuple):
    """The slope of the logarithm of the preload; null where there are too few tests."""

    slope: float
    low: float
    high: float
    of: str
    unit: Literal["1", "1/s"]


@dataclasses.dataclass(frozen=True, eq=False)
class ConditionResults(
    parts_like(
        Condition,
        *("states", "alarm", "alarm_direction", "lost_since", "verdict", "probability_of_loss", "trend", "baseline"),
        *("tolerance", "false_alarms", "scatter", "exponent", "per_kelvin", "factor"),
        *("reference_temperature", "reference_speed", "temperatures"),
    )
):
    """The state in each test, the trend, and the alarm."""

    states: Sequence[TestState]
    trend: TrendOfPreload
    tolerance: Annotated[float, FINITE]
    false_alarms: Annotated[float, FINITE]
    #: Torque of the first tests over that of the model.
    factor: Estimate


def document(case: Case, result: Condition) -> dict[str, Any]:
    """Inputs, the state in each test, trend, alarm, warnings and provenance."""
    by_test, trend = result.per == "test", result.trend
    results = from_attributes(
        ConditionResults,
        result,
        states=[_state(number, state, result) for number, state in enumerate(result.states)],
        trend=TrendOfPreload(*trend, "logarithm of the preload", "1" if by_test else "1/s"),
        factor=Estimate(result.factor, *result.factor_interval),
    )
    sources = {
        "logs": [{"log": name, "sha256": digest} for name, digest in result.sources],
        "notes": list(result.notes),
    }
    units = {
        "torque": "N m",
        "temperature": "K",
        "preload": "1",
        "time": "1" if by_test else "s",
        "reference_speed": "rad/s",
        "per_kelvin": "1/K",
        "constant_torque": "N m",
    }
    return envelope(
        case,
        results,
        units=units,
        warnings=result.warning_records,
        verdicts=result.verdict_records,
        sources=sources,
    )


def _state(number: int, state: State, result: Condition) -> TestState:
    return from_attributes(
        TestState,
        state,
        torque=Estimate(state.torque, state.torque_low, state.torque_high),
        preload=Estimate(state.preload, state.preload_low, state.preload_high),
        **{name: values[number] for name, values in result.chart._asdict().items()},
    )


#: More tests than these are not all listed: the baseline, those about the alarm and the last ones are.
_MOST_ROWS = 40
#: Tests about the alarm that are listed.
_ABOUT = 5
#: Days of a series from which on its charts are over days.
_LONG, _DAY = 90, 86400.0
#: Preloads beyond this are not drawn: without temperatures an interval may end far above.
_MOST_DRAWN = 2.5
_TORQUE, _SPEED = quantities()["torque"], quantities()["screw_speed"]
_PLAIN = Quantity("ratio", "1", Info("", "ratio"))
_HOURS = Quantity("time", "s", Info("t", "time", "h"))


# -- what people see of it -------------------------------------------------------------------------


def sheet(case: Case, condition: Condition) -> Sheet:
    """All that people see of a condition over time."""
    warnings = [record for record in condition.warning_records if record.severity == "warning"]
    remarks = [record.text for record in condition.warning_records if record.severity != "warning"]
    first, *others = condition.verdict_records
    return Sheet(
        f"{_tests(condition)}: {nut_text(case.screw.nut)}, {model_text(case)}",
        [
            warning_lines(warnings),
            Lines([verdict_line(first), *(Line(record.text) for record in others)]),
            _table(condition),
            Lines([Line(design(case, plain_text=True), "small"), Line(_meaning(condition), "small")]),
            Lines([Line(f"note: {text}", "small") for text in (*remarks, *condition.notes)], detail=True),
            *_charts(condition),
            _columns(condition),
        ],
    )


def _tests(condition: Condition) -> str:
    """The files of the tests, or their number."""
    files = [name for name, _ in condition.sources]
    return ", ".join(files) if 0 < len(files) <= 3 else f"{len(condition.states)} tests"


def _meaning(condition: Condition) -> str:
    """Operating point that the torques are reduced to, and what the numbers are."""
    speed = units.shown(condition.reference_speed, _SPEED, 3)
    temperature = condition.reference_temperature
    at = f"{units.shown(temperature, TEMPERATURE, 3)} and {speed}" if math.isfinite(temperature) else speed
    return (
        f"torques at {at}, preload over that of the first {condition.baseline} tests, intervals of 95 %; CUSUM: sums "
        "of the changes after them in standard deviations, with their limit"
    )


def _table(condition: Condition) -> Table:
    rows: list[Sequence[Cell]] = []
    shown = _shown_rows(condition)
    for before, index in zip([-1, *shown], shown, strict=False):
        if index > before + 1:
            rows.append(["…", "", "", "", "", ""])
        state, chart = condition.states[index], condition.chart
        preload = (state.preload_low, state.preload_high)
        rows.append(
            [
                f"{state.label}{' alarm' if index == condition.alarm else ''}",
                None if state.temperature is None else Number(state.temperature, TEMPERATURE, 3),
                Number(state.torque, _TORQUE, 3, (state.torque_low, state.torque_high)),
                Share(state.preload, bar=False, band=preload),
                Number(max(chart.fall[index], chart.rise[index]), _PLAIN, 3),
                Number(chart.limit[index], _PLAIN, 3),
            ]
        )
    return Table("tests", "Tests", ("", "logged", "torque", "preload", "CUSUM", "limit"), rows)


def _shown_rows(condition: Condition) -> list[int]:
    count = len(condition.states)
    if count <= _MOST_ROWS:
        return list(range(count))
    alarm = condition.alarm
    near = range(0) if alarm is None else range(alarm - _ABOUT, alarm + _ABOUT + 1)
    rows = {*range(condition.baseline), *near, *range(count - 2 * _ABOUT, count)}
    return sorted(row for row in rows if 0 <= row < count)


def _trend(condition: Condition) -> Vector | None:
    """The preload by the trend at the time of each test, over that of the first tests; None where there is no trend.

    Of the slope b of the logarithm of the preload it is exp(a + b t), with the a that has as many tests above the curve
    as below.
    """
    if not math.isfinite(condition.trend.slope):
        return None
    times = np.array([state.time for state in condition.states])
    preload = np.array([state.preload for state in condition.states])
    middle = float(np.nanmedian(np.log(preload) - condition.trend.slope * times))
    return np.exp(middle + condition.trend.slope * times)


def _charts(condition: Condition) -> Iterator[Block]:
    """Torque, preload and sums over the time."""
    axis, times = _time(condition)
    common = [Vertical("end of the first tests", times[condition.baseline - 1])]
    if condition.alarm is not None:
        common.append(Vertical("alarm", times[condition.alarm], "red"))
    torque, low, high = (_values(condition, name) for name in ("torque", "torque_low", "torque_high"))
    healthy = float(np.exp(np.mean(np.log(torque[: condition.baseline]))))
    yield Chart(
        "torque at one temperature",
        axis,
        Axis("friction torque", _TORQUE, least=0.0),
        [
            Curve("torque", times, torque, "blue", "circles"),
            Band("95 %", times, low, high, "blue"),
            Level("first tests", healthy),
            *common,
        ],
    )
    preload, low, high = (_values(condition, name) for name in ("preload", "preload_low", "preload_high"))
    trend = _trend(condition)
    yield Chart(
        "preload left",
        axis,
        Axis("over that of the first tests", _PLAIN, least=0.0),
        [
            Curve("preload", times, preload, "blue", "circles"),
            Band("95 %", times, low, np.minimum(high, _MOST_DRAWN), "blue"),
            *([] if trend is None else [Curve("trend", times, trend)]),
            Level("tolerance", 1 - condition.tolerance, "orange"),
            *common,
        ],
    )
    yield Chart(
        "sums of changes (CUSUM)",
        axis,
        Axis("standard deviations", _PLAIN, least=0.0),
        [
            Curve("fall", times, np.array(condition.chart.fall), "blue"),
            Curve("rise", times, np.array(condition.chart.rise), "green"),
            Curve("limit", times, np.array(condition.chart.limit), "orange", "dashed"),
            *common,
        ],
    )


def _time(condition: Condition) -> tuple[Axis, np.ndarray]:
    """The axis of the time and the places of the tests on it; days are plain numbers."""
    times = _values(condition, "time")
    if condition.per == "test":
        return Axis("test", _PLAIN), times
    if np.ptp(times) > _LONG * _DAY:
        return Axis("days from the first test", _PLAIN), times / _DAY
    return Axis("time", _HOURS), times


def _values(condition: Condition, name: str) -> np.ndarray:
    return np.array([getattr(state, name) for state in condition.states], dtype=float)


def _columns(condition: Condition) -> Columns:
    """One row for each test."""
    preloads = ("preload", "preload_low", "preload_high")
    return Columns(
        "states",
        [
            Column("test", [state.label for state in condition.states]),
            Column("time", _values(condition, "time"), _PLAIN if condition.per == "test" else _HOURS),
            Column("temperature", _values(condition, "temperature"), TEMPERATURE),
            *(Column(name, _values(condition, name), _TORQUE) for name in ("torque", "torque_low", "torque_high")),
            *(Column(name, _values(condition, name), _PLAIN) for name in preloads),
            Column("fall", np.array(condition.chart.fall), _PLAIN),
            Column("rise", np.array(condition.chart.rise), _PLAIN),
            Column("limit", np.array(condition.chart.limit), _PLAIN),
        ],
    )


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    tests = request.files["tests"]
    _check_files(request)
    check_kind(len(tests), request.written)
    options, case = request.options(ConditionOptions), request.load()

    def answer(done: Done) -> Answer:
        condition = of_files(case, tests, options, done)
        return Answer(sheet(case, condition), lambda: document(case, condition), f"{len(condition.states)} tests")

    return Work(answer, "condition")


def _check_files(request: Request) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a question without case or tests."""
    faults: list[Fault] = []
    if request.case is None:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if not request.files["tests"]:
        faults.append(Fault("TABLE", "missing", "", "give a table with a row for each test, or the logs of the tests"))
    raise_if_any(faults)
