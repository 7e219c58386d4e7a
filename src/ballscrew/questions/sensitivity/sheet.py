"""The sheet of a sensitivity: what to find out next, each input with its measures, what is left, what was assumed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Bar,
    Bars,
    Cell,
    Colour,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    lines,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, title
from ballscrew.cases.case_files.spelling import THOUSANDS
from ballscrew.cases.case_files.uncertain_inputs import path_of
from ballscrew.engine.uncertainty.sensitivity import HALF, MEASURES, Method, Sensitivity
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.physics.friction.plausibility import IMPLAUSIBLE
from ballscrew.questions.sensitivity.compute import SensitivityReport, verdicts, warnings

#: Headings of what a method says of an input, and what they mean.
_HEADINGS: Mapping[str, str] = {
    "first_order": "alone",
    "total": "in all",
    "effect": "effect",
    "effect_deviation": "varies",
    "share": "share",
}
_MEANING: Mapping[Method, str] = {
    "sobol": (
        "alone: share of the variance that goes, on average, if the input is known; "
        "in all: with its part in what inputs do together"
    ),
    "morris": (
        "effect: mean absolute change for one standard deviation of the input; "
        "varies: standard deviation of these changes from place to place"
    ),
    "local": (
        "effect: slope at the medians times the standard deviation of the input; "
        "share: of the variance, if the slopes were the same everywhere"
    ),
}
_LEFT = "left: what is left of the standard deviation if the input is known"
LAWS_STAY = "inputs vary, each independent of the others; laws do not: see ballscrew compare"
#: Marks inputs whose distribution the case does not give; who says what is usual where no source does.
_USUAL_MARK, _JUDGEMENT = "*", "judgement"
#: The measures in the table, and those in the bars, with their colours.
_SHOWN: Mapping[Method, tuple[str, ...]] = {**MEASURES, "sobol": ("first_order", "total")}
_DRAWN: Mapping[Method, tuple[str, ...]] = {**_SHOWN, "local": ("effect",)}
_COLOURS: Sequence[Colour] = ("blue", "sky")
_PLAIN = Quantity("share", "1", Info("", "share"))
_DIGITS = 3
_CORRELATED = "sensitivity.correlated"


def sheet(case: Case, report: SensitivityReport) -> Sheet:
    """All that people see of a sensitivity."""
    records = [record for record in warnings(case, report) if record.id in (IMPLAUSIBLE, THOUSANDS, _CORRELATED)]
    return Sheet(
        f"what moves the {report.result.quantity.info.meaning}: {title(case)}",
        [
            Lines([Line(design(case, plain_text=True), "small"), Line(_mean_and_deviation(report.result), "small")]),
            verdict_lines(verdicts(report)),
            warning_lines(records),
            _table(case, report),
            lines(_remarks(report), "small"),
            *_bars(report),
        ],
    )


def _mean_and_deviation(result: Sensitivity) -> str:
    """Mean and standard deviation in words."""
    at = "at the medians of the inputs" if result.method == "local" else "mean"
    words = f"{result.quantity.info.meaning}: {at} {units.shown(result.mean, result.quantity)}"
    if not math.isfinite(result.deviation):
        return words
    relative = f" ({abs(result.deviation / result.mean):.1%})" if result.mean else ""
    return f"{words}, standard deviation {units.shown(result.deviation, result.quantity, _DIGITS)}{relative}"


def _remarks(report: SensitivityReport) -> Iterator[str]:
    """Meaning of the numbers, assumptions, and method."""
    yield _MEANING[report.result.method] + (f"; {_LEFT}" if report.result.first_order else "")
    sources = {name: uncertain.source for name, uncertain in report.uncertain.items() if not uncertain.given}
    if sources:
        named = [f"{report.describe(name)} ({source})" for name, source in sources.items() if source != _JUDGEMENT]
        by = "by judgement" + ", but for " * bool(named) if _JUDGEMENT in sources.values() else ""
        yield f"{_USUAL_MARK} not in the case, taken as usual: {by}{', '.join(named)}"
    yield _method_and_effort(report.result)
    yield LAWS_STAY


def _method_and_effort(result: Sensitivity) -> str:
    if result.method == "local":
        return "local: exact derivatives at the medians of the inputs"
    what, each = ("Sobol' indices", "samples") if result.method == "sobol" else ("Morris screening", "trajectories")
    left_out = f", {result.left_out} of them left out as they have no number" if result.left_out else ""
    return (
        f"{what} of {result.samples} {each}{left_out}: {result.evaluations} evaluations, seed {result.seed}, "
        f"intervals of {result.level:.0%}"
    )


def _table(case: Case, report: SensitivityReport) -> Table:
    result = report.result
    shown = _SHOWN[result.method]
    left = ["left"] if result.first_order else []
    rows: list[list[Cell]] = []
    for name in result.inputs:
        cells = [_cell(result, measure, result.measures[measure][name]) for measure in shown]
        known = [Share(result.left_if_known(name), bar=False)] if left else []
        rows.append([report.describe(name), *cells, *known, _distribution(report, name)])
    headings = ("", *(_HEADINGS[measure] for measure in shown), *left, "distribution")
    return Table("inputs", "Inputs", headings, rows, fields=[path_of(case, name) for name in result.inputs])


def _cell(result: Sensitivity, measure: str, estimate: Estimate) -> Cell:
    """A measure with its interval; what is exact has none."""
    band = None if result.method == "local" else (estimate.low, estimate.high)
    if measure.startswith("effect"):
        return Number(estimate.value, result.quantity, _DIGITS, band)
    return Share(estimate.value, bar=False, band=band)


def _distribution(report: SensitivityReport, name: str) -> str:
    """The distribution of an input, with a mark where the case does not give it."""
    uncertain = report.uncertain[name]
    return uncertain.description + f" {_USUAL_MARK}" * (not uncertain.given)


def _bars(report: SensitivityReport) -> Iterator[Bars]:
    """The measures of all inputs with their intervals, and the deviation left as the largest become known."""
    result = report.result
    drawn = _DRAWN[result.method]
    first, *_ = drawn
    bars: list[Bar] = []
    for name in result.inputs:
        for measure, colour in zip(drawn, _COLOURS, strict=False):
            estimate = result.measures[measure][name]
            part = (_HEADINGS[measure] if len(drawn) > 1 else "", estimate.value, colour)
            ends = None if result.method == "local" else (estimate.low, estimate.high)
            label, text = (report.describe(name), _distribution(report, name)) if measure == first else ("", "")
            bars.append(Bar(label, [part], ends, text))
    if result.method == "sobol":
        yield Bars("share of the variance", _PLAIN, bars)
    else:
        yield Bars("change by one deviation of the input", result.quantity, bars)
    if result.explained_variance:
        known = [(f"+ {report.describe(known.inputs[-1])}", known.remaining) for known in result.explained_variance]
        left = [Bar(name, [("", share, "orange")]) for name, share in [("nothing known", 1.0), *known]]
        yield Bars("deviation left", _PLAIN, left, [Vertical("half", HALF, "ink")])
