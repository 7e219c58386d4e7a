"""``ballscrew sensitivity``: what a result owes its band to, as a table, as JSON and as a picture."""

from __future__ import annotations

import dataclasses
import io
import math
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, cast

from rich.console import Console

from ballscrew import __version__
from ballscrew.analyses.plan import Subject
from ballscrew.analyses.sensitivity import ANOTHER_METHOD, MEASURES, Method, Sensitivity
from ballscrew.analyses.sensitivity import sensitivity as analysed
from ballscrew.analyses.variance import Estimate
from ballscrew.components.materials import TEMPERATURE
from ballscrew.faults import Fault, InputError
from ballscrew.interfaces import config, nut_report, report, units
from ballscrew.interfaces.documents import as_json
from ballscrew.interfaces.files import whole
from ballscrew.interfaces.uncertain import Uncertain, all_of
from ballscrew.interfaces.wrapping import aligned, wrapped
from ballscrew.quantities import Quantity, fields_of

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
CORRELATED = "the numbers of the calibration vary one by one, too, though the fit left them correlated"
#: Marks inputs whose distribution the case does not give; who says what is usual where no source does.
USUAL_MARK, JUDGEMENT = "*", "judgement"
#: The columns of a table in which shares come first by what counts for what to measure.
_SHOWN: Mapping[Method, tuple[str, ...]] = {**MEASURES, "sobol": ("first_order", "total")}


class Asked(NamedTuple):
    """What a person asks for."""

    output: str = "screw_torque"
    method: str = "sobol"
    samples: int | None = None
    seed: int = 0
    only_given: bool = False


@dataclasses.dataclass(frozen=True, eq=False)
class Found:
    """The sensitivity of a case, its uncertain inputs, and what these are."""

    result: Sensitivity
    uncertain: Mapping[str, Uncertain]
    known: Mapping[str, tuple[str, Quantity]]

    def words(self, name: str) -> str:
        """An input in words, short enough for a table."""
        law, _, field = name.rpartition(".")
        if name == TEMPERATURE.name or (law and "_" not in field):  # "decay" alone says little
            return self.known[name][1].info.meaning
        return field.replace("_", " ")


def found(case: config.Case, asked: Asked, done: Callable[[int, int], None] | None = None) -> Found:
    """The sensitivity of a case. Raises ``InputError`` in the words of the command line."""
    uncertain = all_of(case, asked.only_given)
    if not uncertain:
        remedy = 'write one, such as screw_conformity = "0.54 ± 0.01", or leave --only-given out'
        raise InputError(Fault("--only-given", "the case gives no input a distribution", "", remedy))
    point = {name: getattr(case.operation, name) for name in fields_of(case.operation)}
    try:
        result = analysed(
            case.model,
            case.screw,
            case.lubricant,
            uncertain={name: u.distribution for name, u in uncertain.items()},
            nut=case.parts,
            output=asked.output.replace(".", "_"),
            method=cast("Method", asked.method),
            samples=asked.samples,
            seed=asked.seed,
            done=done,
            **point,
        )
    except InputError as error:
        raise InputError(*(_of_command_line(fault) for fault in error.faults)) from None
    known = Subject(case.model, case.screw, case.lubricant, case.parts).inputs
    return Found(result, uncertain, known)


def _of_command_line(fault: Fault) -> Fault:
    """A fault in an argument as one in the option that gives it."""
    section, _, name = fault.where.partition(".")
    where = f"--{name}" if section == "sensitivity" and "." not in name else fault.where
    remedy = "add --method sobol or --method morris" if fault.remedy == ANOTHER_METHOD else fault.remedy
    return dataclasses.replace(fault, where=where, remedy=remedy)


# -- words ----------------------------------------------------------------------------------------


def output_in_words(result: Sensitivity) -> str:
    """``friction torque on the screw``."""
    return result.quantity.info.meaning


def band(result: Sensitivity) -> str:
    """Mean and standard deviation in words."""
    at = "at the medians of the inputs" if result.method == "local" else "mean"
    words = f"{output_in_words(result)}: {at} {units.shown(result.mean, result.quantity)}"
    if not math.isfinite(result.deviation):
        return words
    relative = f" ({abs(result.deviation / result.mean):.1%})" if result.mean else ""
    return f"{words}, standard deviation {units.shown(result.deviation, result.quantity, 3)}{relative}"


def how(result: Sensitivity) -> str:
    """The method and its effort in words."""
    if result.method == "local":
        return "local: exact derivatives at the medians of the inputs"
    what, each = ("Sobol' indices", "samples") if result.method == "sobol" else ("Morris screening", "trajectories")
    left_out = f", {result.left_out} of them left out as they have no number" if result.left_out else ""
    return (
        f"{what} of {result.samples} {each}{left_out}: {result.evaluations} evaluations, seed {result.seed}, "
        f"intervals of {result.level:.0%}"
    )


def measure_next(found: Found) -> list[str]:
    """What to find out to halve the band."""
    result, words = found.result, output_in_words(found.result)
    if result.is_constant:
        return [f"the {words} does not depend on any of these inputs"]
    if result.method == "morris":
        return ["screening ranks the inputs; what to find out next: --method sobol"]
    if result.to_halve is None:
        return [f"to know all of these inputs would not halve the band of the {words}"]
    names = [found.words(name) for name in result.to_halve.inputs]
    lines = [f"to halve the band of the {words}, find out: {', '.join(names)} (leaves {result.to_halve.left:.0%})"]
    if len(names) > 1:
        lines.append(f"{names[0]} alone leaves {result.knowing[0].left:.0%}")
    return lines


def remarks(case: config.Case, found: Found) -> list[str]:
    """What the numbers mean, what was assumed, and how they were found."""
    meaning = MEANING[found.result.method] + (f"; {LEFT}" if found.result.first_order else "")
    fitted = [] if case.calibration is None else [CORRELATED]
    return [meaning, *_usual(found), how(found.result), LAWS_STAY, *fitted]


def _usual(found: Found) -> list[str]:
    """What the case does not say, and who does."""
    taken = {name: u.source for name, u in found.uncertain.items() if not u.given}
    if not taken:
        return []
    named = [f"{found.words(name)} ({source})" for name, source in taken.items() if source != JUDGEMENT]
    by = ["by judgement" + ", but for " * bool(named)] if JUDGEMENT in taken.values() else [""]
    return [f"{USUAL_MARK} not in the case, taken as usual: {by[0]}{', '.join(named)}"]


def operating_point(case: config.Case) -> str:
    """Load and speed, the model, and the nut where there is one."""
    nut = [] if case.parts is None else [nut_report.nut_in_words(case.parts)]
    return ", ".join([report.operating_point(case), *nut, report.model_in_words(case)])


# -- the terminal ---------------------------------------------------------------------------------


def print_found(case: config.Case, found: Found) -> None:
    """The table on the terminal, what to find out, and what was assumed."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(wrapped(text), style=style, markup=False, soft_wrap=True)

    say(operating_point(case), "bold")
    say(report.design(case, plain_text=True), "dim")
    say(band(found.result))
    console.print()
    for number, line in enumerate(_table(found)):
        console.print(line, style=None if number else "bold", markup=False, soft_wrap=True)
    console.print()
    for line in measure_next(found):
        say(line, "bold")
    for line in remarks(case, found):
        say(line, "dim")


def _table(found: Found) -> list[str]:
    result = found.result
    shown = _SHOWN[result.method]
    unit = _unit(result.quantity)
    heading = [f"{HEADINGS[m]}, {unit}" if unit and m.startswith("effect") else HEADINGS[m] for m in shown]
    has_left = bool(result.first_order)
    rows = [["input", *heading, *["left"] * has_left]]
    for name in result.inputs:
        cells = [_cell(result, measure, result.measures[measure][name]) for measure in shown]
        left = result.left_if_known(name)
        rows.append([found.words(name), *cells, *["–" if math.isnan(left) else f"{left:.0%}"] * has_left])
    distributions = ["distribution", *(_distribution(found.uncertain[name]) for name in result.inputs)]
    return [f"{line}   {words}" for line, words in zip(aligned(rows), distributions, strict=True)]


def _cell(result: Sensitivity, measure: str, estimate: Estimate) -> str:
    """``0.281 (0.266 to 0.295)``; what is exact has no interval."""
    if measure.startswith("effect"):
        texts = [f"{units.from_si(value, result.quantity) + 0.0:.3g}" for value in estimate]
    else:
        texts = [_share(value) for value in estimate]
    return texts[0] if result.method == "local" else f"{texts[0]} ({texts[1]} to {texts[2]})"


def _unit(quantity: Quantity) -> str:
    """The unit people think in; nothing for a plain number."""
    return "" if quantity.unit == "1" else quantity.shown_in.replace("um", "µm")


def _share(value: float) -> str:
    """Two decimals, and no minus before zero."""
    return f"{round(value, 2) + 0.0:.2f}"


def _distribution(uncertain: Uncertain) -> str:
    return uncertain.words + f" {USUAL_MARK}" * (not uncertain.given)


# -- programs -------------------------------------------------------------------------------------


def json_text(case: config.Case, found: Found) -> str:
    """One JSON object: inputs, indices and what to find out, in SI; provenance. Non-finite is null."""
    result = found.result
    halve = result.to_halve
    document = {
        "inputs": config.inputs(case),
        "sensitivity": {
            "output": result.output,
            "method": result.method,
            "mean": result.mean,
            "standard_deviation": result.deviation,
            "inputs": [_row(found, name) for name in result.inputs],
            "knowing": [_knowing(inputs, left) for inputs, left in result.knowing],
            "to_halve": None if halve is None else _knowing(*halve),
            "level": result.level,
            "samples": result.samples,
            "left_out": result.left_out,
            "evaluations": result.evaluations,
            "seed": result.seed,
        },
        "units": {
            result.output: result.quantity.unit,
            **{name: found.known[name][1].unit for name in result.inputs},
        },
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }
    return as_json(document)


def _knowing(inputs: tuple[str, ...], left: float) -> dict[str, Any]:
    return {"inputs": list(inputs), "left": left}


def _row(found: Found, name: str) -> dict[str, Any]:
    result, uncertain = found.result, found.uncertain[name]
    distribution = uncertain.distribution
    return {
        "name": name,
        "distribution": {"kind": type(distribution).__name__.lower(), **dataclasses.asdict(distribution)},
        "given": uncertain.given,
        "source": uncertain.source,
        **{measure: of_input[name]._asdict() for measure, of_input in result.measures.items()},
        "left_if_known": result.left_if_known(name),
    }


# -- the picture ----------------------------------------------------------------------------------


def draw(case: config.Case, found: Found, to: Path) -> None:
    """Write the picture, whole or not at all."""
    # matplotlib takes its time: only for those who want a picture
    from ballscrew.interfaces.figures import style

    buffer = io.BytesIO()
    with style.house_style():
        style.save_as(picture(case, found), buffer, to.suffix.lower().removeprefix("."))
    with whole("--to", to) as path:
        path.write_bytes(buffer.getvalue())


def picture(case: config.Case, found: Found) -> Figure:
    """The picture of the measures of all inputs; call within the house style."""
    from ballscrew.interfaces.figures import sensitivity as figures

    result = found.result
    sentences = [report.design(case), band(result), *remarks(case, found)]
    caption = " ".join(f"{sentence[0].upper()}{sentence[1:]}." for sentence in sentences)
    axis = "share of the variance"
    if result.method != "sobol":
        unit = _unit(result.quantity)
        axis = "change by one deviation of the input" + (f" ({unit})" if unit else "")
    shown = ("effect",) if result.method == "local" else _SHOWN[result.method]
    return figures.bars(
        [f"What moves the {output_in_words(result)}", operating_point(case)],
        caption,
        axis,
        [f"{found.words(name)}\n{_distribution(found.uncertain[name])}" for name in result.inputs],
        {HEADINGS[m]: [_as_shown(result, result.measures[m][name]) for name in result.inputs] for m in shown},
        [(found.words(known.inputs[-1]), known.left) for known in result.knowing],
    )


def _as_shown(result: Sensitivity, estimate: Estimate) -> Estimate:
    """A share as it is, an effect in the unit people think in."""
    if result.method == "sobol":
        return estimate
    return Estimate(*(float(units.from_si(value, result.quantity)) for value in estimate))
