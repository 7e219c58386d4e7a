"""The sheet of a fit: what the log is, the numbers and what it cannot tell of them, errors, the next test."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import spoken
from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Bar,
    Bars,
    Block,
    Cell,
    Cells,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Map,
    Number,
    Sheet,
    Table,
    columns_of,
    lines,
    verdict_lines,
    warning_lines,
    words,
)
from ballscrew.basis.quantities import Info, Quantity, quantities_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.diagnostics import FIFTHS
from ballscrew.evidence.calibration.fit_result import Estimate
from ballscrew.evidence.calibration.next_test import NextTest
from ballscrew.evidence.calibration.problem import TORQUE_WANDER
from ballscrew.files.torque_logs.log_rows import quantities
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.fit.answer import results
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.fit.log import CONDITIONS
from ballscrew.questions.shared.charts import Numbers, some
from ballscrew.questions.shared.declared import cells

_TORQUE = quantities_of(FrictionResult)["screw_torque"]
_COUNT = Quantity("numbers", "1", Info("", "numbers"))
_LEFT = Quantity("uncertainty_left", "1", Info("", "share of the uncertainty that is left"))
#: A change of a number that is less than this share of the largest is no part of a trade-off; one that a log does not
#: tell at all is shown of this size.
_LEAST_TRADED, _TRADED = 0.05, 0.1
#: A part of a squared error that is worth a word.
_LEAST_PART = 0.01
#: More points than this are a blot.
_MOST_POINTS = 4000
#: The axis of residuals reaches so many times their usual size.
_WIDEST = 5
#: Kinds of rows of a fit.
KINDS = ("fitted", "held_out", "outlier")
_COLOURS: Mapping[str, Colour] = {"fitted": "sky", "held_out": "orange", "outlier": "grey"}


def sheet(case: Case, report: FitReport) -> Sheet:
    """All that people see of a fit."""
    model = report.model
    log = model.rows.log
    return Sheet(
        f"{log_and_model(case, report)}: {len(log)} of {log.rows} rows used",
        [
            verdict_lines(model.verdict_records),
            lines((*_rows(report), design(case, plain_text=True)), "small", detail=True),
            _estimates(model),
            lines(_of_temperature(model)),
            warning_lines(model.warning_records),
            Lines([Line(trade_off(model))]),
            _scores(model),
            _trends(model),
            Lines([Line(message) for message in _next_test(report)]),
            *_charts(report),
            _columns(model),
        ],
    )


def log_and_model(case: Case, report: FitReport) -> str:
    """The name of the log and the model."""
    name, _ = report.model.rows.log.source or ("log", "")
    return f"{name}, {model_text(case)}"


def _rows(report: FitReport) -> Iterator[str]:
    """Rows left out of the log and why, remarks on it, and what its torque was read as."""
    rows = report.model.rows
    for reason, count in rows.log.left_out.items():
        yield f"left out: {_counted(count)}, {reason}"
    yield from rows.log.notes
    yield f"torque read as: {rows.convention.description}"
    if rows.outlying.any():
        yield f"outliers: {_counted(int(rows.outlying.sum()))}, not counted"
    yield from (f"assumed: {text}" for text in report.assumed)


def _counted(count: int) -> str:
    return f"{count} row" if count == 1 else f"{count} rows"


# -- tables and sentences -------------------------------------------------------------------------


def _estimates(model: CalibratedModel) -> Table:
    """The numbers with their errors, those of the sensor behind those of the screw."""
    shown = [*model.estimates.values(), *(e for e in model.sensor.values() if not _is_wandering(e.name))]
    rows: list[Sequence[Cell]] = [
        [
            spoken(estimate.name),
            _number(estimate),
            "not identified" if estimate.std is None else Number(estimate.std, estimate.quantity, 2),
            Number(estimate.start, estimate.quantity),
        ]
        for estimate in shown
    ]
    headings = ("", "value (95 % interval)", "standard error", "from")
    return Table("estimates", "Fitted", headings, rows)


def _number(estimate: Estimate) -> Number:
    """An estimate with its interval; an interval of what is not identified says nothing."""
    ends = estimate.interval() if estimate.identified else None
    return Number(estimate.value, estimate.quantity, band=None if ends is None else (ends[0], ends[1]))


def _of_temperature(model: CalibratedModel) -> list[str]:
    """The error of the oil temperature that the intervals have in them, and what part of each it makes."""
    error = model.temperature_error.half_width
    if not any(e.identified for e in (*model.estimates.values(), *model.sensor.values())):
        return []
    if not error:
        return ["in the errors: none of the oil temperature, which is taken to be exact"]
    shown = [e for e in (*model.estimates.values(), *model.sensor.values()) if not _is_wandering(e.name)]
    parts = [
        f"{e.temperature_share:.0%} for the {spoken(e.name)}"
        for e in shown
        if e.identified and e.temperature_share >= _LEAST_PART
    ]
    makes = f"; of the variance they make {', '.join(parts)}" if parts else ""
    return [f"in the errors: {error:g} K of oil temperature either way (95 %), the same in all rows{makes}"]


def _is_wandering(name: str) -> bool:
    """Test whether a number is a wave of the zero of the sensor, which says nothing of the screw."""
    return name in {quantity.name for quantity in TORQUE_WANDER.values()}


def trade_off(model: CalibratedModel) -> str:
    """Combination that the log determines least, as one sentence: numbers that make up for each other."""
    least = model.identifiability.combinations[-1]
    values = {name: estimate.value for name, estimate in model.estimates.items()}
    scales = dict(zip(values, model.uncertainty.scale, strict=False))
    # in shares of each number, where it has a size
    shares = {n: power * scales[n] / abs(values[n] or scales[n]) for n, power in least.powers.items()}
    largest = max(map(abs, shares.values()), default=0.0)
    kept = {name: share for name, share in shares.items() if abs(share) >= _LEAST_TRADED * largest}
    if len(kept) < 2:
        return _no_trade_off(model)
    (first, change), *others = sorted(kept.items(), key=lambda item: -abs(item[1]))
    sign = 1.0 if change > 0 else -1.0
    error = least.relative_error if least.identified else _TRADED / abs(change)
    one, *more = [_changed(name, sign * share * error) for name, share in [(first, change), *others]]
    change_of_all = f"Trade-off: {one} with {' and '.join(more)}"
    if not least.identified:
        effect = ", which determines only their combined effect" if _combined_effect_is_known(model) else ""
        return f"{change_of_all} makes no difference in this log{effect}"
    if unidentified := [name for name in kept if not model.estimates[name].identified]:
        return f"{change_of_all} fits the rows nearly as well; not identified: {_named(unidentified)}"
    return f"{change_of_all} fits the rows nearly as well (one standard error)"


def _named(names: Iterable[str]) -> str:
    return " and ".join(map(spoken, names))


def _no_trade_off(model: CalibratedModel) -> str:
    """The sentence on a log in which no number makes up for another."""
    estimates = model.estimates
    if unidentified := [name for name, estimate in estimates.items() if not estimate.identified]:
        return f"Trade-offs: none; the log does not determine: {_named(unidentified)}"
    if with_prior := [name for name in estimates if not model.identifiability.identified[name]]:
        return f"Trade-offs: none; the log determines {_named(with_prior)} only together with what was known before"
    return "Trade-offs: none; the log determines each number by itself"


def _combined_effect_is_known(model: CalibratedModel) -> bool:
    """Test whether the log determines all combinations but the least known, and has rows enough for errors."""
    others = model.identifiability.combinations[:-1]
    return not model.has_few_rows and all(combination.identified for combination in others)


def _changed(name: str, share: float) -> str:
    """``2.1 % more preload``."""
    return f"{abs(100 * share):.2g} % {'more' if share > 0 else 'less'} {spoken(name)}"


def _scores(model: CalibratedModel) -> Table:
    """Error of each description of the log, with and without physics."""
    rows: list[Sequence[Cell]] = [
        [
            score.description,
            Number(score.parameters, _COUNT),
            Number(score.fitted, _TORQUE, 3),
            Number(score.held_out, _TORQUE, 3),
        ]
        for score in model.scores
    ]
    unlisted = sum(map(_is_wandering, model.sensor))
    note = f"Among the numbers are {unlisted} for a sensor whose zero wanders slowly, not listed above."
    headings = ("", "numbers", "rows fitted", "rows held out")
    return Table("scores", "Error, root mean square without outliers", headings, rows, [note] if unlisted else [])


def _trends(model: CalibratedModel) -> Table:
    """Residuals by fifths of the rows, in the order of each quantity."""
    typical = float(np.median(model.rows.friction)) or 1.0
    rows: list[Sequence[Cell]] = []
    for name, trend in model.rows.trends.items():
        pairs = zip(trend.means, trend.errors, strict=True)
        rows.append(
            [spoken(name), *(f"{100 * mean / typical:+.1f} ± {100 * error / typical:.1f}" for mean, error in pairs)]
        )
    size = words(Number(typical, _TORQUE, 3))
    note = f"Predicted less measured, means by fifths of the rows, in % of {size}."
    return Table("residuals", "Residuals", ("", *FIFTHS), rows, [note])


def _next_test(report: FitReport) -> list[str]:
    return [] if report.next_test is None else describe_next_test(report.next_test, report.model)


def describe_next_test(test: NextTest, model: CalibratedModel) -> list[str]:
    """Recommended next test, and the reduction of uncertainty it would give."""
    known: Mapping[str, Quantity] = {name: quantity for name, (_, quantity) in model.subject.inputs.items()}
    where = ", ".join(units.shown(value, known[name], 3) for name, value in test.best.items())
    readings = "one reading" if test.readings == 1 else f"{test.readings} readings"
    if model.rows.log.forward.any() and model.rows.log.backward.any() and test.readings > 1:
        readings += ", half of them in each direction"
    errors = ", ".join(
        f"{_percent(share)}% of the error of the {spoken(name)}"
        if model.estimates[name].identified
        else f"{_percent(share)}% of the spread assumed for the {spoken(name)} (not identified)"
        for name, share in test.remaining_error.items()
    )
    return [
        f"next test: {where}; {readings}",
        f"it would leave {_percent(test.best_volume)}% of the uncertainty of all together "
        f"(a random test {_percent(test.random_volume)}%), {errors}",
        *_beside_the_log(test, model, known),
    ]


def _percent(share: float) -> str:
    return f"{100 * share:.0f}"


def _beside_the_log(test: NextTest, model: CalibratedModel, known: Mapping[str, Quantity]) -> list[str]:
    """Notes that the next test is beyond the log, or that only its loads and speeds were considered."""
    log = model.rows.log
    logged = {"axial_load": log.axial_load, "screw_speed": np.abs(log.screw_speed)}
    ends = {name: (min(float(values.min()), 0.0), max(float(values.max()), 0.0)) for name, values in logged.items()}
    nearest = {name: min(max(test.best[name], low), high) for name, (low, high) in ends.items()}
    beyond = [
        f"{spoken(name)} {units.shown(end, known[name], 3)}" for name, end in nearest.items() if test.best[name] != end
    ]
    if beyond:
        return [f"that is beyond the log, which ends at {' and '.join(beyond)}"]
    if any(
        float(test.tests[name].max()) > high * (1 + 1e-9) or float(test.tests[name].min()) < low * (1 + 1e-9)
        for name, (low, high) in ends.items()
    ):
        return []
    return ["of the loads and speeds that the log has; --limits of ballscrew fit say what else the rig can give"]


# -- charts and files -----------------------------------------------------------------------------


def _charts(report: FitReport) -> Iterator[Block]:
    model = report.model
    shown = some(np.arange(len(model.rows.log)), _MOST_POINTS)
    yield _against(model, shown)
    for name in ("screw_speed", "axial_load", "temperature", "time"):
        if name in model.rows.trends:
            yield _residuals(model, shown, name)
    yield _errors(model)
    if report.next_test is not None:
        yield _places_of_next_test(model, report.next_test, shown)


def _kinds(model: CalibratedModel) -> NDArray[np.int64]:
    """The place of the kind of each row in :data:`KINDS`."""
    return np.where(model.rows.outlying, 2, np.where(model.rows.held_out, 1, 0))


def _dots(model: CalibratedModel, shown: NDArray[np.int64], x: NDArray[Any], y: NDArray[Any]) -> Iterator[Curve]:
    """The rows as dots, in a colour for each kind."""
    kinds = _kinds(model)
    for place, kind in enumerate(KINDS):
        chosen = shown[kinds[shown] == place]
        if chosen.size:
            yield Curve(kind.replace("_", " "), x[chosen], y[chosen], _COLOURS[kind], "dots")


def measured_and_predicted(model: CalibratedModel) -> tuple[Numbers, Numbers]:
    """The friction torque of each row as it was measured, and by the calibrated model, N m."""
    rows = model.rows
    predicted = rows.friction + model.constant_torque
    return predicted - rows.residuals * rows.direction, predicted


def _against(model: CalibratedModel, shown: NDArray[np.int64]) -> Chart:
    measured, predicted = measured_and_predicted(model)
    ends = np.array([0.0, float(predicted.max()) * 1.05])
    x, y = Axis("measured friction torque", _TORQUE), Axis("predicted", _TORQUE, least=0.0)
    return Chart("model against log", x, y, [*_dots(model, shown, measured, predicted), Curve("", ends, ends)])


def _quantity(model: CalibratedModel, name: str) -> Quantity:
    return quantities()["time"] if name == "time" else model.subject.inputs[name][1]


def _values(model: CalibratedModel, name: str) -> NDArray[Any]:
    values = np.asarray(getattr(model.rows.log, name))
    return np.abs(values) if name in ("screw_speed", "axial_load") else values


def _residuals(model: CalibratedModel, shown: NDArray[np.int64], name: str) -> Chart:
    """Predicted less measured over one quantity: rows, and means of fifths within twice their errors."""
    rows, values, trend = model.rows, _values(model, name), model.rows.trends[name]
    off = rows.residuals * rows.direction
    is_near = np.abs(off) <= _WIDEST * float(np.median(np.abs(off))) / 0.6745
    means, errors = np.asarray(trend.means), 2 * np.asarray(trend.errors)
    is_wide = name == "screw_speed" and values.max() > 20 * values.min() > 0
    return Chart(
        f"residuals against {spoken(name)}",
        Axis(spoken(name), _quantity(model, name), log=bool(is_wide)),
        Axis("predicted − measured", _TORQUE),
        [
            *_dots(model, shown[is_near[shown]], values, off),
            Band("twice the error of the means", trend.values, means - errors, means + errors),
            Curve("means of fifths", trend.values, means),
            Level("", 0.0),
        ],
    )


def _errors(model: CalibratedModel) -> Bars:
    """The errors of all descriptions of the log, on the rows fitted and on those held out."""
    bars: list[Bar] = []
    for score in model.scores:
        bars.append(Bar(score.description, [("rows fitted", score.fitted, "sky")]))
        if math.isfinite(score.held_out):
            bars.append(Bar("", [("rows held out", score.held_out, "orange")]))
    return Bars("what physics buys: root mean square off", _TORQUE, bars)


def _places_of_next_test(model: CalibratedModel, test: NextTest, shown: NDArray[np.int64]) -> Block:
    """Uncertainty that a test at each load and speed would leave; the best, and where the log was."""
    best = test.best
    chosen = np.ones(test.remaining_volume.size, dtype=bool)
    if "temperature" in test.tests:
        chosen = test.tests["temperature"] == best["temperature"]
    speed, load = test.tests["screw_speed"][chosen], test.tests["axial_load"][chosen]
    speeds, columns = np.unique(speed, return_inverse=True)
    loads, rows = np.unique(load, return_inverse=True)
    left = np.full((loads.size, speeds.size), math.nan)  # points that are not valid are left out
    left[rows, columns] = test.remaining_volume[chosen]
    return Map(
        "where to measure next: share of the uncertainty that is left",
        Axis("speed of the screw", _quantity(model, "screw_speed"), log=True),
        Axis("axial load", _quantity(model, "axial_load"), log=bool(loads[0] > 0)),
        Axis("left", _LEFT),
        (speeds, loads),
        left,
        [
            Curve("log", np.abs(model.rows.log.screw_speed[shown]), model.rows.log.axial_load[shown], "grey", "dots"),
            Curve("best", np.array([best["screw_speed"]]), np.array([best["axial_load"]]), "green", "circles"),
        ],
    )


def _columns(model: CalibratedModel) -> Columns:
    """The rows of the log as they were used."""
    measured, predicted = measured_and_predicted(model)
    known = [name for name in (*CONDITIONS, "time") if getattr(model.rows.log, name, None) is not None]
    return Columns(
        "rows",
        [
            Column("kind", [KINDS[kind] for kind in _kinds(model)]),
            *(Column(spoken(name), getattr(model.rows.log, name), _quantity(model, name)) for name in known),
            Column("measured", measured, _TORQUE),
            Column("predicted", predicted, _TORQUE),
        ],
    )


# -- the screws of a table ------------------------------------------------------------------------


def of_rows(reports: Mapping[str, FitReport]) -> Sheet:
    """All that people see of the fits of the screws of a table: their numbers, and the warnings of each fit."""
    models = {name: report.model for name, report in reports.items()}
    return Sheet(
        f"{len(reports)} screws, each fitted to its log",
        [
            columns_of("screws", lambda: (_cells(name, report) for name, report in reports.items())),
            Lines([Line(f"{name}: {text}", "verdict") for name, model in models.items() for text in model.verdicts]),
            Table(
                "numbers",
                "name",
                ("", "log", "rows", "residual rms", "number", "value (95 % interval)", ""),
                [row for name, model in models.items() for row in _numbers(name, model)],
            ),
            Lines(
                [
                    Line(f"{name}: {record.text}", "warning", record.name)
                    for name, model in models.items()
                    for record in model.warning_records
                ]
            ),
        ],
    )


def _numbers(name: str, model: CalibratedModel) -> Iterator[Sequence[Cell]]:
    """A row for each number; the log and its residuals stand in the first."""
    log = (model.rows.log.source or ("", ""))[0]
    first: list[Cell] = [name, log, Number(len(model.rows.log), _COUNT), Number(model.residual_rms, _TORQUE, 3)]
    for estimate in model.estimates.values():
        identified = "" if estimate.identified else "not identified"
        yield [*first, spoken(estimate.name), _number(estimate), identified]
        first = [""] * len(first)


def _cells(name: str, report: FitReport) -> Cells:
    """Results for a screw from its log: the numbers with their errors and the ends of their 95 % interval."""
    model, result = report.model, results(report)
    values: dict[str, tuple[Any, Quantity | None]] = {
        "name": (name, None),
        "log": ((model.rows.log.source or ("", ""))[0], None),
        "rows used": (result.rows.used, None),
    }
    for full, estimate in model.estimates.items():
        values |= cells(result.estimates[full], full.rpartition(".")[2], estimate.quantity)
    values |= cells(result)
    return {**values, "verdicts": ("; ".join(model.verdicts), None), "warnings": ("; ".join(model.warnings), None)}
