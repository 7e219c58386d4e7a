"""``ballscrew fit``: tables of a calibration on the terminal, and the caption of its picture."""

from __future__ import annotations

import math
from collections.abc import Mapping

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew.basis import units
from ballscrew.basis.errors import both
from ballscrew.basis.quantities import Quantity, quantities_of
from ballscrew.basis.records import Message, Named
from ballscrew.cases.case_files.case_file import Case
from ballscrew.cases.case_files.descriptions import design, model_text
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit_result import Estimate
from ballscrew.evidence.calibration.next_test import NextTest
from ballscrew.evidence.calibration.problem import TORQUE_WANDER
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.shared.text_tables import spoken, table_of

_TORQUE = quantities_of(FrictionResult)["screw_torque"]
#: A change of a number that is less than this share of the largest is no part of a trade-off; one that a log does not
#: tell at all is shown of this size.
_LEAST_TRADED, _TRADED = 0.05, 0.1
#: A part of a squared error that is worth a word.
_LEAST_PART = 0.01
_FIFTHS = ("lowest", "lower", "middle", "higher", "highest")


def print_fit(case: Case, report: FitReport) -> None:
    """The log, the numbers, what the log cannot tell, how far all descriptions are off, residuals, the next test."""
    console, model = Console(highlight=False), report.model

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    for verdict in model.verdicts:
        say(f"{verdict}\n", "bold red")
    log, (name, _) = model.rows.log, model.rows.log.source or ("log", "")
    say(f"{name}: {len(log)} of {log.rows} rows used, {model_text(case)}\n", "bold")
    for line in (*(f"left out: {_rows(count)}, {reason}" for reason, count in log.left_out.items()), *log.notes):
        say(line, "dim")
    say(f"torque read as: {model.rows.convention.description}", "dim")
    if model.rows.outlying.any():
        say(f"outliers: {_rows(int(model.rows.outlying.sum()))}, not counted", "dim")
    for line in report.assumed:
        say(f"assumed: {line}", "dim")
    console.print()
    console.print(_estimates(model))
    for line in _of_temperature(model):
        say(line, "dim")
    for warning in model.warnings:
        say(f"beware  {warning}", "yellow")
    say(f"\n{units.filled(trade_off(model))}")
    console.print(_scores(model))
    if unlisted := sum(map(_is_wandering, model.sensor)):
        say(f"among the numbers are {unlisted} for a sensor whose zero wanders slowly, not listed above", "dim")
    console.print(_residuals(model))
    if report.next_test is not None:
        console.print()
        for line in describe_next_test(report.next_test, model):
            say(units.filled(line))


def _rows(count: int) -> str:
    return f"{count} row" if count == 1 else f"{count} rows"


def _estimates(model: CalibratedModel) -> Table:
    table = table_of("Fitted", "", "", "value", "± standard error", "95 % interval", "from")
    shown = [e for e in model.sensor.values() if not _is_wandering(e.name)]
    for estimate in (*model.estimates.values(), *shown):
        table.add_row(
            spoken(estimate.name),
            estimate.quantity.shown_in.replace("um", "µm") if estimate.quantity.unit != "1" else "",
            _number(estimate, estimate.value),
            "not identified" if estimate.std is None else f"± {_number(estimate, estimate.std, 2)}",
            interval(estimate),
            _number(estimate, estimate.start),
        )
    return table


def _of_temperature(model: CalibratedModel) -> list[str]:
    """The error of the oil temperature that the intervals have in them, and what part of each it makes."""
    error = model.temperature_error.half_width
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
    """Whether a number is a wave of the zero of the sensor, which says nothing of the screw."""
    return name in {quantity.name for quantity in TORQUE_WANDER.values()}


def interval(estimate: Estimate) -> str:
    """``0.101 to 0.118``; a dash where there is none."""
    ends = estimate.interval()
    if ends is None:
        return "–"
    low, high = (_number(estimate, end) for end in ends)
    return f"{low} to {high}"


def _number(estimate: Estimate, value: float, digits: int = 4) -> str:
    """A value of an estimate in the unit people think in, without the unit."""
    return units.to_digits(units.from_si(value, estimate.quantity), digits)


def trade_off(model: CalibratedModel) -> Message:
    """What the log tells least of, as one sentence: numbers that make up for each other."""
    least = model.identifiability.combinations[-1]
    values = {name: estimate.value for name, estimate in model.estimates.items()}
    scales = dict(zip(values, model.uncertainty.scale, strict=False))
    # in shares of each number, where it has a size
    shares = {n: power * scales[n] / abs(values[n] or scales[n]) for n, power in least.powers.items()}
    largest = max(map(abs, shares.values()), default=0.0)
    kept = {name: share for name, share in shares.items() if abs(share) >= _LEAST_TRADED * largest}
    if unknown := [name for name, estimate in model.estimates.items() if len(kept) < 2 and not estimate.identified]:
        return Message("Trade-offs: none; the log does not determine: {names}").of(names=both(map(Named, unknown)))
    if len(kept) < 2:
        return Message("Trade-offs: none; the log determines each number by itself")
    (first, change), *others = sorted(kept.items(), key=lambda item: -abs(item[1]))
    sign = 1.0 if change > 0 else -1.0
    error = least.relative_error if least.identified else _TRADED / abs(change)
    one, *more = [_changed(name, sign * share * error) for name, share in [(first, change), *others]]
    message = Message("Trade-off: {one} with {others} fits the rows nearly as well (one standard error)")
    if not least.identified:
        message = Message(
            "Trade-off: {one} with {others} makes no difference in this log, which determines only their combined "
            "effect"
        )
    return message.of(one=one, others=both(more))


def _changed(name: str, share: float) -> Message:
    """``2.1 % more preload``."""
    message = Message("{percent} % more {name}") if share > 0 else Message("{percent} % less {name}")
    return message.of(percent=f"{abs(100 * share):.2g}", name=Named(name))


def _scores(model: CalibratedModel) -> Table:
    table = table_of("\nError, root mean square without outliers", "", "numbers", "rows fitted", "rows held out")
    for score in model.scores:
        held_out = "–" if math.isnan(score.held_out) else _shown(score.held_out, _TORQUE, 3)
        table.add_row(score.description, str(score.parameters), _shown(score.fitted, _TORQUE, 3), held_out)
    return table


def _residuals(model: CalibratedModel) -> Table:
    typical = float(np.median(model.rows.friction)) or 1.0
    size = _shown(typical, _TORQUE, 3)
    table = table_of(f"\nPredicted less measured, means by fifths of the rows, in % of {size}", "", *_FIFTHS)
    for name, trend in model.rows.trends.items():
        pairs = zip(trend.means, trend.errors, strict=True)
        cells = [f"{100 * mean / typical:+.1f} ± {100 * error / typical:.1f}" for mean, error in pairs]
        table.add_row(spoken(name), *cells)
    return table


def describe_next_test(test: NextTest, model: CalibratedModel) -> list[Message]:
    """Recommended next test, and the reduction of uncertainty it would give."""
    known: Mapping[str, Quantity] = {name: quantity for name, (_, quantity) in model.subject.inputs.items()}
    where = [Message("{value}", {"value": units.shown(value, known[name], 3)}) for name, value in test.best.items()]
    message = Message("next test: {where}; {readings} readings")
    if model.rows.log.forward.any() and model.rows.log.backward.any():
        message = Message("next test: {where}; {readings} readings, half of them in each direction")
    errors = [
        Message("{percent}% of the error of the {name}", {"percent": _percent(share), "name": Named(name)})
        for name, share in test.remaining_error.items()
    ]
    left = Message("it would leave {percent}% of the uncertainty of all together (a random test {random}%), {errors}")
    return [
        message.of(where=where, readings=str(test.readings)),
        left.of(percent=_percent(test.best_volume), random=_percent(test.random_volume), errors=errors),
        *_beside_the_log(test, model, known),
    ]


def _percent(share: float) -> str:
    return f"{100 * share:.0f}"


def _beside_the_log(test: NextTest, model: CalibratedModel, known: Mapping[str, Quantity]) -> list[Message]:
    """That the next test asks for more than the log has shown the rig to give, or that no such test was thought of."""
    log = model.rows.log
    logged = {"axial_load": log.axial_load, "screw_speed": np.abs(log.screw_speed)}
    ends = {name: (min(float(values.min()), 0.0), max(float(values.max()), 0.0)) for name, values in logged.items()}
    nearest = {name: min(max(test.best[name], low), high) for name, (low, high) in ends.items()}
    beyond = [
        Message("{name} {value}", {"name": Named(name), "value": units.shown(end, known[name], 3)})
        for name, end in nearest.items()
        if test.best[name] != end
    ]
    if beyond:
        return [Message("that is beyond the log, which ends at {ends}", {"ends": both(beyond)})]
    if any(
        float(test.tests[name].max()) > high * (1 + 1e-9) or float(test.tests[name].min()) < low * (1 + 1e-9)
        for name, (low, high) in ends.items()
    ):
        return []
    return [
        Message("of the loads and speeds that the log has; --limits of ballscrew fit say what else the rig can give")
    ]


def _shown(value: float, quantity: Quantity, digits: int = 4) -> str:
    return units.shown(value + 0.0, quantity, digits)


def log_and_model(case: Case, report: FitReport) -> str:
    """The name of the log and the model."""
    name, _ = report.model.rows.log.source or ("log", "")
    return f"{name}, {model_text(case)}"


def caption(case: Case, report: FitReport) -> str:
    """The caption of the picture."""
    estimates = ", ".join(
        f"{spoken(e.name)} {_shown(e.value, e.quantity)}"
        + (" (not identified)" if e.std is None else f" ± {_shown(e.std, e.quantity, 2)}")
        for e in report.model.estimates.values()
    )
    remarks = (
        "Black: means of a fifth of the rows with twice their error. Star: the test to do next; white dots: the log."
    )
    return f"{design(case)}. Fitted (± standard error): {estimates}. {remarks}"
