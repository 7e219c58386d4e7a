"""Causes that move the friction torque of a case, and what to find out next: its document, and its sheet."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Annotated, Any, NamedTuple, cast

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
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
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.case_text import THOUSANDS
from ballscrew.cases.case_files.descriptions import design, title
from ballscrew.cases.case_files.uncertain_inputs import NOTHING_GIVEN, Uncertain, all_of, path_of
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty import sensitivity as analysis
from ballscrew.engine.uncertainty.sensitivity import ANOTHER_METHOD, HALF, MEASURES, METHODS, Method, Sensitivity
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import MATERIALS
from ballscrew.questions.sensitivity import SensitivityOptions
from ballscrew.questions.shared.declared import FINITE, LEFT_OUT, OneOf, envelope, from_attributes
from ballscrew.questions.shared.question import Answer, Done, Request, Work


@dataclasses.dataclass(frozen=True, eq=False)
class SensitivityReport:
    """The sensitivity of a case, its uncertain inputs, and the part and quantity of each input."""

    result: Sensitivity
    uncertain: Mapping[str, Uncertain]
    known: Mapping[str, tuple[str, Quantity]]

    def describe(self, name: str) -> str:
        """The meaning of an input, short enough for a table."""
        law, _, field = name.rpartition(".")
        if law in MATERIALS:
            return f"{law} {field}".replace("_", " ")
        # "decay" and "share of load" alone say little
        if name == TEMPERATURE.name or field == "share_of_load" or (law and "_" not in field):
            return self.known[name][1].info.meaning
        return field.replace("_", " ")


def sensitivity(
    case: Case, options: SensitivityOptions, done: Callable[[int, int], None] | None = None
) -> SensitivityReport:
    """Sensitivity of a case. Raises ``InputError`` that names options of the command line."""
    uncertain = all_of(case, options.only_given)
    if not uncertain:
        raise InputError(NOTHING_GIVEN)
    point = {name: getattr(case.operation, name) for name in fields_of(case.operation)}
    try:
        result = analysis.sensitivity(
            case.model,
            case.screw,
            case.lubricant,
            distributions={name: u.distribution for name, u in uncertain.items()},
            output=options.output.replace(".", "_"),
            method=cast("Method", options.method),
            samples=options.samples,
            seed=options.seed,
            done=done,
            **point,
        )
    except InputError as error:
        raise InputError(*(_of_command_line(fault) for fault in error.faults)) from None
    known = Configuration(case.model, case.screw, case.lubricant).inputs
    return SensitivityReport(result, uncertain, known)


def _of_command_line(fault: Fault) -> Fault:
    """The fault of an argument, as one of the option that gives it."""
    section, _, name = fault.where.partition(".")
    where = f"--{name}" if section == "sensitivity" and "." not in name else fault.where
    remedy = "add --method sobol or --method morris" if fault.remedy == ANOTHER_METHOD else fault.remedy
    return dataclasses.replace(fault, where=where, remedy=remedy)


CORRELATED = "the numbers of the calibration vary one by one, too, though the fit left them correlated"


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SensitiveInput:
    """An uncertain input, and what the method says of it: the measures of that method, and no others."""

    #: As in sweeps.
    name: str
    #: Its kind and its parameters, SI.
    distribution: Mapping[str, Any]
    #: True where the case gives it; otherwise it is taken as usual.
    given: bool
    #: Given, judgement, a key of the bibliography, or a calibration.
    source: str
    #: With sobol the share of the variance in which it has a part.
    total: Annotated[Estimate | None, LEFT_OUT] = None
    #: With sobol the share of the variance that it has by itself.
    first_order: Annotated[Estimate | None, LEFT_OUT] = None
    #: Change of the output by one standard deviation of the input.
    effect: Annotated[Estimate | None, LEFT_OUT] = None
    #: With morris the standard deviation of these changes.
    effect_deviation: Annotated[Estimate | None, LEFT_OUT] = None
    #: With local the share of the variance, were the slopes the same.
    share: Annotated[Estimate | None, LEFT_OUT] = None
    #: Share of the standard deviation that is left if it is known.
    left_if_known: float


class IfKnown(NamedTuple):
    """Some inputs, and the share of the standard deviation that is left if they are known."""

    inputs: Sequence[str]
    left: float


class Indices(NamedTuple):
    """The inputs of an output, the one that matters most first."""

    output: str
    method: Annotated[str, OneOf(METHODS)]
    #: Over all samples; with local the value at the medians of the inputs; SI.
    mean: float
    #: SI; null with morris.
    standard_deviation: float
    #: The inputs, the one that matters most first.
    inputs: Sequence[SensitiveInput]
    #: The largest inputs, one more each time.
    knowing: Sequence[IfKnown]
    #: The inputs to find out so that half is left; null where there are none.
    to_halve: IfKnown | None
    #: Of the intervals.
    level: Annotated[float, FINITE]
    samples: int
    #: Samples without a number.
    left_out: int
    evaluations: int
    seed: int


def document(case: Case, report: SensitivityReport) -> dict[str, Any]:
    """Inputs, indices, what to measure next, units and provenance."""
    result = report.result
    indices = from_attributes(
        Indices,
        result,
        standard_deviation=result.deviation,
        inputs=[_input(report, name) for name in result.inputs],
        knowing=[IfKnown(*known) for known in result.explained_variance],
        to_halve=None if result.to_halve is None else IfKnown(*result.to_halve),
    )
    return envelope(
        case,
        indices,
        named="sensitivity",
        units={
            result.output: result.quantity.unit,
            **{name: report.known[name][1].unit for name in result.inputs},
        },
        warnings=warnings(case, report),
        verdicts=verdicts(report),
    )


def _input(report: SensitivityReport, name: str) -> SensitiveInput:
    uncertain, kind = report.uncertain[name], type(report.uncertain[name].distribution)
    return SensitiveInput(
        name=name,
        distribution={"kind": kind.__name__.lower(), **dataclasses.asdict(uncertain.distribution)},
        given=uncertain.given,
        source=uncertain.source,
        **{measure: of_input[name] for measure, of_input in report.result.measures.items()},
        left_if_known=report.result.left_if_known(name),
    )


def verdicts(report: SensitivityReport) -> list[Record]:
    """The inputs to measure next in order to halve the band."""
    result, meaning = report.result, report.result.quantity.info.meaning

    def verdict(name: str, subject: str, message: str, value: float | None = None, holds: bool | None = None) -> Record:
        limit = None if value is None else HALF
        return Record(f"sensitivity.{name}", subject, message, value=value, limit=limit, holds=holds)

    if result.is_constant:
        message = f"the {meaning} does not depend on any of these inputs"
        return [verdict("constant", result.output, message)]
    if result.method == "morris":
        message = "screening ranks the inputs; what to find out next: --method sobol"
        return [verdict("screening", result.output, message)]
    if result.to_halve is None:
        message = f"to know all of these inputs would not halve the band of the {meaning}"
        return [verdict("not_halved", result.output, message, holds=False)]
    inputs, left = result.to_halve
    names = [report.describe(name) for name in inputs]
    message = f"to halve the band of the {meaning}, find out: {', '.join(names)} (leaves {units.percent(left)})"
    records = [verdict("to_halve", ",".join(inputs), message, left, True)]
    if len(names) > 1:
        alone = result.explained_variance[0].remaining
        message = f"{names[0]} alone leaves {units.percent(alone)}"
        records.append(verdict("first_input", inputs[0], message, alone, False))
    return records


def warnings(case: Case, report: SensitivityReport) -> list[Record]:
    """Implausible inputs, samples without a number, and the correlation of a calibration, which is not sampled."""
    records = case.implausible()
    result = report.result
    if result.left_out:
        message = f"{units.fixed(result.left_out)} samples or trajectories are left out as they have no number"
        records.append(
            Record.warning("sensitivity.left_out", result.output, message, value=float(result.left_out), limit=0.0)
        )
    if case.origins.calibration is not None:
        records.append(Record("sensitivity.correlated", "calibration", CORRELATED, severity="warning"))
    return records


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


# -- what people see of it -------------------------------------------------------------------------


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


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, case = request.options(SensitivityOptions), request.load()

    def answer(done: Done) -> Answer:
        report = sensitivity(case, options, done)
        return Answer(sheet(case, report), lambda: document(case, report), f"{len(report.result.inputs)} inputs")

    return Work(answer, "sensitivity")
