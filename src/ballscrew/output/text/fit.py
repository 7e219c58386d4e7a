"""What a calibration found, as tables on the terminal."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import numpy as np
from rich.console import Console
from rich.table import Table

from ballscrew.analyses.calibrated import CalibratedModel, Estimate
from ballscrew.analyses.calibration_words import product
from ballscrew.analyses.next_test import NextTest
from ballscrew.analyses.torque_log import quantities
from ballscrew.interfaces import units
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.files import whole
from ballscrew.interfaces.fitting import CONDITIONS, Fitted
from ballscrew.interfaces.report import design, model_in_words, table_of
from ballscrew.quantities import Quantity, quantities_of
from ballscrew.result import FrictionResult

_TORQUE = quantities_of(FrictionResult)["screw_torque"]
_FIFTHS = ("lowest", "lower", "middle", "higher", "highest")


def print_fit(case: Case, fitted: Fitted) -> None:
    """The log, the numbers, what the log cannot tell, how far all descriptions are off, residuals, the next test."""
    console, found = Console(highlight=False), fitted.model

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    log, (name, _) = found.rows.log, found.rows.log.source or ("log", "")
    say(f"{name}: {len(log)} of {log.rows} rows used, {model_in_words(case)}\n", "bold")
    for line in (*(f"left out: {count} rows, {reason}" for reason, count in log.left_out.items()), *log.notes):
        say(line, "dim")
    say(f"torque read as: {found.rows.reading.words}", "dim")
    if found.rows.outlying.any():
        say(f"outliers: {int(found.rows.outlying.sum())} rows, which count nothing", "dim")
    console.print()
    console.print(_estimates(found))
    for warning in found.warnings:
        say(f"beware  {warning}", "yellow")
    if len(found.estimates) > 1:
        console.print(_combinations(found))
    console.print(_scores(found))
    console.print(_residuals(found))
    if fitted.next_test is not None:
        for line in next_test_in_words(fitted.next_test, found):
            say(line)


def _estimates(found: CalibratedModel) -> Table:
    table = table_of("Fitted", "", "", "value", "± standard error", "95 % interval", "from")
    shown = [e for e in found.sensor.values() if not e.name.startswith("torque_wander")]
    for estimate in (*found.estimates.values(), *shown):
        table.add_row(
            in_words(estimate.name),
            estimate.quantity.shown_in.replace("um", "µm") if estimate.quantity.unit != "1" else "",
            _number(estimate, estimate.value),
            "not identified" if estimate.std is None else f"± {_number(estimate, estimate.std, 2)}",
            interval_in_words(estimate),
            _number(estimate, estimate.start),
        )
    return table


def interval_in_words(estimate: Estimate) -> str:
    """``0.101 to 0.118``; a dash where there is none."""
    interval = estimate.interval()
    if interval is None:
        return "–"
    low, high = (_number(estimate, end) for end in interval)
    return f"{low} to {high}"


def _number(estimate: Estimate, value: float, digits: int = 4) -> str:
    """A value of an estimate in the unit people think in, without the unit."""
    return f"{units.from_si(value, estimate.quantity):.{digits}g}"


def _combinations(found: CalibratedModel) -> Table:
    table = table_of("\nWhat the log tells, the best known first", "product of powers", "known to", "")
    for combination in found.identifiability.combinations:
        error = combination.relative_error
        table.add_row(
            product(combination.powers),
            f"{error:.2%}" if error < 1 else "–",
            "" if combination.identified else "not identified",
        )
    return table


def _scores(found: CalibratedModel) -> Table:
    table = table_of("\nHow far off, root mean square without outliers", "", "numbers", "rows fitted", "rows held out")
    for score in found.scores:
        held_out = "–" if math.isnan(score.held_out) else _shown(score.held_out, _TORQUE, 3)
        table.add_row(score.words, str(score.numbers), _shown(score.fitted, _TORQUE, 3), held_out)
    return table


def _residuals(found: CalibratedModel) -> Table:
    typical = float(np.median(found.rows.friction)) or 1.0
    size = _shown(typical, _TORQUE, 3)
    table = table_of(f"\nPredicted less measured, means by fifths of the rows, in % of {size}", "", *_FIFTHS)
    for name, trend in found.rows.trends.items():
        pairs = zip(trend.means, trend.errors, strict=True)
        cells = [f"{100 * mean / typical:+.1f} ± {100 * error / typical:.1f}" for mean, error in pairs]
        table.add_row(in_words(name), *cells)
    return table


def next_test_in_words(test: NextTest, found: CalibratedModel) -> list[str]:
    """Where to measure next and what that would teach, of which numbers."""
    known: Mapping[str, Quantity] = {name: quantity for name, (_, quantity) in found.subject.inputs.items()}
    where = ", ".join(units.shown(value, known[name], 3) for name, value in test.best.items())
    both = ", half of them in each direction" if found.rows.log.forward.any() and found.rows.log.backward.any() else ""
    errors = (f"{share:.0%} of the error of the {in_words(name)}" for name, share in test.remaining_error.items())
    left = f"{test.best_volume:.0%} of the volume of what is open (a random test {test.random_volume:.0%})"
    return [
        f"\nnext test: {where}; {test.readings} readings{both}",
        f"it would leave {left}, {', '.join(errors)}",
    ]


def in_words(name: str) -> str:
    """A number as people say it."""
    return name.rpartition(".")[2].replace("_", " ")


def _shown(value: float, quantity: Quantity, digits: int = 4) -> str:
    return units.shown(value + 0.0, quantity, digits)


def draw(case: Case, fitted: Fitted, to: Path) -> None:
    """Write the picture of a calibration, whole or not at all."""
    # matplotlib takes its time: only for those who want a picture
    from ballscrew.interfaces.figures import fit as figures
    from ballscrew.interfaces.figures import style

    found = fitted.model
    name, _ = found.rows.log.source or ("log", "")
    estimates = ", ".join(
        f"{in_words(e.name)} {_shown(e.value, e.quantity)}"
        + (" (not identified)" if e.std is None else f" ± {_shown(e.std, e.quantity, 2)}")
        for e in found.estimates.values()
    )
    remarks = (
        "Black: means of a fifth of the rows with twice their error. Star: the test to do next; white dots: the log."
    )
    caption = f"{design(case)}. Fitted (± standard error): {estimates}. {remarks}"
    known = {**{n: q for n, (_, q) in found.subject.inputs.items()}, "time": quantities()["time"]}
    axes = {n: _axis(n, q) for n, q in known.items() if n in (*CONDITIONS, "time")}
    buffer = io.BytesIO()
    with style.house_style():
        figure = figures.overview(f"{name}, {model_in_words(case)}", caption, found, fitted.next_test, axes)
        style.save_as(figure, buffer, to.suffix.lower().removeprefix("."))
    with whole("--picture", to) as path:
        path.write_bytes(buffer.getvalue())


def _axis(name: str, quantity: Quantity) -> tuple[Callable[[Any], Any], str]:
    """The scale and the label of an axis."""

    def scaled(values: Any) -> Any:
        return units.from_si(np.asarray(values), quantity)

    return scaled, f"{in_words(name)} [{quantity.shown_in}]"
