"""``ballscrew sensitivity``: a table of the inputs on the terminal, and the sentences of its picture."""

from __future__ import annotations

import math
from collections.abc import Mapping

from rich.console import Console

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files import case_file, descriptions
from ballscrew.cases.case_files.spelling import THOUSANDS
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.engine.uncertainty.sensitivity import MEASURES, Method, Sensitivity
from ballscrew.engine.uncertainty.sobol import Estimate
from ballscrew.physics.friction.plausibility import IMPLAUSIBLE
from ballscrew.questions.sensitivity.compute import SensitivityReport
from ballscrew.questions.sensitivity.document import verdicts, warnings

#: Headings of what a method says of an input, and what they mean.
HEADINGS: Mapping[str, str] = {
    "first_order": "alone",
    "total": "in all",
    "effect": "effect",
    "effect_deviation": "varies",
    "share": "share",
}
MEANING: Mapping[Method, str] = {
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
LEFT = "left: what is left of the standard deviation if the input is known"
LAWS_STAY = "inputs vary, each independent of the others; laws do not: see ballscrew compare"
#: Marks inputs whose distribution the case does not give; who says what is usual where no source does.
USUAL_MARK, JUDGEMENT = "*", "judgement"
#: The columns of a table in which shares come first by what counts for what to measure.
SHOWN: Mapping[Method, tuple[str, ...]] = {**MEASURES, "sobol": ("first_order", "total")}


# -- words ----------------------------------------------------------------------------------------


def output_meaning(result: Sensitivity) -> str:
    """``friction torque on the screw``."""
    return result.quantity.info.meaning


def mean_and_deviation(result: Sensitivity) -> str:
    """Mean and standard deviation in words."""
    at = "at the medians of the inputs" if result.method == "local" else "mean"
    words = f"{output_meaning(result)}: {at} {units.shown(result.mean, result.quantity)}"
    if not math.isfinite(result.deviation):
        return words
    relative = f" ({abs(result.deviation / result.mean):.1%})" if result.mean else ""
    return f"{words}, standard deviation {units.shown(result.deviation, result.quantity, 3)}{relative}"


def method_and_effort(result: Sensitivity) -> str:
    """The method and its effort in words."""
    if result.method == "local":
        return "local: exact derivatives at the medians of the inputs"
    what, each = ("Sobol' indices", "samples") if result.method == "sobol" else ("Morris screening", "trajectories")
    left_out = f", {result.left_out} of them left out as they have no number" if result.left_out else ""
    return (
        f"{what} of {result.samples} {each}{left_out}: {result.evaluations} evaluations, seed {result.seed}, "
        f"intervals of {result.level:.0%}"
    )


def remarks(case: case_file.Case, report: SensitivityReport) -> list[str]:
    """Meaning of the numbers, assumptions, and method."""
    meaning = MEANING[report.result.method] + (f"; {LEFT}" if report.result.first_order else "")
    found = warnings(case, report)
    correlated = [one.text for one in found if one.id == "sensitivity.correlated"]
    odd = [f"{one.name}: {one.text}" for one in found if one.id in (IMPLAUSIBLE, THOUSANDS)]
    return [meaning, *_assumed_inputs(report), method_and_effort(report.result), LAWS_STAY, *correlated, *odd]


def _assumed_inputs(report: SensitivityReport) -> list[str]:
    """Defaults used where the case gives no uncertainty, with their sources."""
    taken = {name: u.source for name, u in report.uncertain.items() if not u.given}
    if not taken:
        return []
    named = [f"{report.describe(name)} ({source})" for name, source in taken.items() if source != JUDGEMENT]
    by = ["by judgement" + ", but for " * bool(named)] if JUDGEMENT in taken.values() else [""]
    return [f"{USUAL_MARK} not in the case, taken as usual: {by[0]}{', '.join(named)}"]


def operating_point(case: case_file.Case) -> str:
    """Load and speed, the model, and the nut where there is one."""
    return descriptions.title(case)


# -- the terminal ---------------------------------------------------------------------------------


def print_sensitivity(case: case_file.Case, report: SensitivityReport) -> None:
    """The table on the terminal, what to find out, and what was assumed."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(wrapped(text), style=style, markup=False, soft_wrap=True)

    say(operating_point(case), "bold")
    say(descriptions.design(case, plain_text=True), "dim")
    say(mean_and_deviation(report.result))
    console.print()
    for number, line in enumerate(table(report)):
        console.print(line, style=None if number else "bold", markup=False, soft_wrap=True)
    console.print()
    for verdict in verdicts(report):
        say(verdict.text, "bold")
    for line in remarks(case, report):
        say(line, "dim")


def table(report: SensitivityReport) -> list[str]:
    """The lines of the table, headings first."""
    result = report.result
    shown = SHOWN[result.method]
    shown_in = unit(result.quantity)
    heading = [f"{HEADINGS[m]}, {shown_in}" if shown_in and m.startswith("effect") else HEADINGS[m] for m in shown]
    has_left = bool(result.first_order)
    rows = [["input", *heading, *["left"] * has_left]]
    for name in result.inputs:
        cells = [_cell(result, measure, result.measures[measure][name]) for measure in shown]
        left = result.left_if_known(name)
        rows.append([report.describe(name), *cells, *["–" if math.isnan(left) else f"{left:.0%}"] * has_left])
    distributions = ["distribution", *(distribution(report.uncertain[name]) for name in result.inputs)]
    return [f"{line}   {words}" for line, words in zip(aligned(rows), distributions, strict=True)]


def _cell(result: Sensitivity, measure: str, estimate: Estimate) -> str:
    """``0.281 (0.266 to 0.295)``; what is exact has no interval."""
    if measure.startswith("effect"):
        texts = [f"{units.from_si(value, result.quantity) + 0.0:.3g}" for value in estimate]
    else:
        texts = [_share(value) for value in estimate]
    return texts[0] if result.method == "local" else f"{texts[0]} ({texts[1]} to {texts[2]})"


def unit(quantity: Quantity) -> str:
    """The unit people think in; nothing for a plain number."""
    return "" if quantity.unit == "1" else quantity.shown_in.replace("um", "µm")


def _share(value: float) -> str:
    """Two decimals, and no minus before zero."""
    return f"{round(value, 2) + 0.0:.2f}"


def distribution(uncertain: Uncertain) -> str:
    """The distribution of an input, with a mark where the case does not give it."""
    return uncertain.description + f" {USUAL_MARK}" * (not uncertain.given)


def caption(case: case_file.Case, report: SensitivityReport) -> str:
    """The caption of the picture."""
    sentences = [descriptions.design(case), mean_and_deviation(report.result), *remarks(case, report)]
    return " ".join(f"{sentence[0].upper()}{sentence[1:]}." for sentence in sentences)
