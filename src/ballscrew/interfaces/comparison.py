"""``ballscrew compare``: models and laws side by side, as a table, as JSON and as a picture."""

from __future__ import annotations

import dataclasses
import io
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console

from ballscrew import __version__
from ballscrew.analyses.comparison import Candidate, Comparison, Row, Spread, compare, same_law
from ballscrew.assembly import NUT_REASONS
from ballscrew.faults import Fault, InputError
from ballscrew.interfaces import config, nut_report, report
from ballscrew.interfaces.computable import computable
from ballscrew.interfaces.files import check_writable, whole
from ballscrew.interfaces.schema import LAWS, MODELS, PRINTED_FORMS, coefficients_of, name_of_law
from ballscrew.result import MECHANISMS, FrictionResult

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Headings of the mechanisms where there is little room.
SHORT: Mapping[str, str] = {
    "hydrodynamic_rolling": "roll.",
    "elastic_hysteresis": "elast.",
    "curvature": "curv.",
    "spin": "spin",
    "helix": "helix",
    "ball_to_ball": "balls",
}
PRINTED_MARK = "†"
PRINTED_WORDS = "the paper's own form, known to be incomplete or misprinted: shown, but in no spread of laws"
_LEGEND = (
    "η drive: the screw drives the nut; η load: the load drives the screw; "
    "out: letters of what lies outside the model's validity",
    "only laws are exchanged: coefficients are not varied here",
)
_PICTURES = (".png", ".svg", ".pdf")
#: Slots named in the line on what matters most.
_MOST_TELLING = 3


def candidates(case: config.Case) -> tuple[list[Candidate], list[Candidate]]:
    """All models, and the case's model with each other law of each slot.

    A law has its own coefficients, but keeps what the case has changed if it has that coefficient, too.
    """
    own = case.model
    # a model changed by nothing is the preset: one row stands for both
    models = [Candidate(name, own if own.label == name else model) for name, model in MODELS.items()]
    laws: list[Candidate] = []
    for slot in LAWS:
        for name, law in _other_laws(slot, own):
            counts = (slot, name) not in PRINTED_FORMS
            laws.append(Candidate(name, config.changed(own, {slot: law}), slot, counts))
    return models, laws


def _other_laws(slot: str, own: Any) -> list[tuple[str, Any]]:
    """The laws that a slot could have instead, by name; then other coefficients that a model has for them."""
    present = getattr(own, slot)
    named = name_of_law(slot, present)
    kept = _coefficients(present)
    found: list[tuple[str, Any]] = []
    for name, law in LAWS[slot].items():
        if name != named:
            known = coefficients_of(slot, name)
            values = {field: value for field, value in kept.items() if field in known}
            found.append((name, law(**values) if isinstance(law, type) else law))
    for name, model in MODELS.items():
        law = getattr(model, slot)
        if not any(same_law(law, other) for other in (present, *(other for _, other in found))):
            found.append((f"as in {name}", law))
    return found


def _coefficients(law: Any) -> dict[str, Any]:
    """The coefficients of a law; another law takes those it has too, so that only the law differs."""
    if not dataclasses.is_dataclass(law):
        return {}
    return {field.name: getattr(law, field.name) for field in dataclasses.fields(law)}


@computable()
def compared(case: config.Case, done: Callable[[int, int], None] | None = None) -> Comparison:
    """The comparison of a case; ``done(finished, total)`` is told its rows."""
    models, laws = candidates(case)
    return compare(case.model, models, laws, case.screw, case.lubricant, case.operation, case.parts, done)


def _unknown(case: config.Case) -> str:
    """The models that know no nut such as that of the case."""
    models, _ = candidates(case)
    names = [c.name for c in models if case.parts is not None and not case.parts.knows(c.model)]
    return f"left out: {', '.join(names)} and other laws of slip, which know no balls with four contacts" * bool(names)


# -- words ----------------------------------------------------------------------------------------


def name_of(row: Row) -> str:
    """What a row is called, with a mark where it does not count."""
    return _law_in_words(row.candidate.slot, row.candidate.name) + ("" if row.candidate.counts else f" {PRINTED_MARK}")


def slot_in_words(slot: str, case: config.Case) -> str:
    """A slot and the law that the case has in it."""
    return f"{slot.replace('_', ' ')}, in place of {_law_in_words(slot, name_of_law(slot, getattr(case.model, slot)))}"


def _law_in_words(slot: str, name: str) -> str:
    """The name of a law; no law of the full film is the constant coefficient that the friction law has."""
    return "constant" if (slot, name) == ("full_film", "none") else name


def summary(found: Comparison) -> list[str]:
    """The spread in words."""
    lines: list[str] = []
    models, laws = found.spread_of_models, found.spread_of_laws
    if models is not None:
        outside = [row.candidate.name for row in found.models if row.outside]
        beware = f"; not valid here: {', '.join(outside)}" if outside else ""
        lines.append(f"models       {_spread_in_words(models, found.models)}{beware}")
    if laws is None:
        lines.append("laws         none is valid here")
    else:
        valid = [row for row in (found.case, *found.laws) if row.candidate.counts and not row.outside]
        lines.append(f"valid laws   {_spread_in_words(laws, valid)}")
    telling = [(slot, span) for slot, span in found.spans.items() if max(map(abs, span)) >= 0.005]
    if telling:
        words = ", ".join(f"{slot.replace('_', ' ')} ({_span(span)})" for slot, span in telling[:_MOST_TELLING])
        lines.append(f"matters most {words}")
    return lines


def _spread_in_words(spread: Spread, rows: Sequence[Row]) -> str:
    """``0.15 N m (one) to 0.23 N m (other); efficiency 0.934 to 0.952``."""
    least, greatest = (f"{row.torque:.4g} N m ({_full_name(row)})" for row in spread)
    efficiencies = [float(row.result.efficiency) for row in rows if math.isfinite(float(row.result.efficiency))]
    ends = f"; efficiency {min(efficiencies):.3f} to {max(efficiencies):.3f}" if efficiencies else ""
    return f"{least} to {greatest}{ends}"


def _full_name(row: Row) -> str:
    slot = row.candidate.slot
    return f"{slot.replace('_', ' ')} {row.candidate.name}" if slot else row.candidate.name


def _span(span: tuple[float, float]) -> str:
    return " to ".join(_percent(end) for end in span if end)


def _percent(change: float) -> str:
    """``+12.3%``; no sign before zero, a dash where there is no change to tell."""
    text = f"{change:+.1%}"
    return "–" if not math.isfinite(change) else text[1:] if float(text[:-1]) == 0 else text


# -- the terminal ---------------------------------------------------------------------------------


def print_comparison(case: config.Case, found: Comparison) -> None:
    """The table on the terminal, and under it the spread and the reasons in words."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{_operating_point(case)}, model {case.model.label}\n", "bold")
    for line, style in _table(case, found):
        say(line, style)
    say("")
    for line in summary(found):
        say(line)
    for line in _LEGEND:
        say(line)
    if any(not row.candidate.counts for row in found.rows):
        say(f"{PRINTED_MARK}  {PRINTED_WORDS}")
    if unknown := _unknown(case):
        say(unknown)
    for reason, letter in _letters(found).items():
        say(f"{letter}  {reason}: {NUT_REASONS[reason]}", "yellow")


def _operating_point(case: config.Case) -> str:
    """Load and speed, and the nut where there is one."""
    nut = [] if case.parts is None else [nut_report.nut_in_words(case.parts)]
    return ", ".join([report.operating_point(case), *nut])


def _letters(found: Comparison) -> dict[str, str]:
    """A letter for each reason that fails somewhere."""
    failing = [reason for reason in NUT_REASONS if any(reason in row.outside for row in found.rows)]
    return dict(zip(failing, "abcdefghijklmnopqrstuvwxyz", strict=False))


def mechanisms_in(found: Comparison) -> list[str]:
    """The mechanisms that are not zero everywhere."""
    names = found.case.result.contributions
    return [name for name in names if any(float(row.result.contributions[name]) for row in found.rows)]


def _table(case: config.Case, found: Comparison) -> list[tuple[str, str | None]]:
    """The lines of the table and their styles. Headings run over all columns, which Rich's tables cannot."""
    unit, scale, decimals = _scale(found)
    shown, letters = mechanisms_in(found), _letters(found)

    def number(value: float) -> str:
        return f"{value * scale:.{decimals}f}" if math.isfinite(value) else "–"

    def cells(row: Row) -> list[str]:
        forward, back = float(row.result.efficiency), float(row.result.back_driving_efficiency)
        return [
            f" {name_of(row)}",
            number(row.torque),
            "case" if row is found.case else _percent(row.change),
            *(number(float(row.result.contributions[name])) for name in shown),
            f"{forward:.4f}" if math.isfinite(forward) else "–",
            "–" if math.isnan(back) else f"{back:.4f}" if back > 0 else "locks",
            "".join(letters[reason] for reason in row.outside),
        ]

    heading = [
        f"torque, {unit}",
        "total",
        "change",
        *(SHORT.get(name, name) for name in shown),
        "η drive",
        "η load",
        "out",
    ]
    groups = [(title, [(row, cells(row)) for row in rows]) for title, rows in _groups(case, found)]
    lines = [heading, *(line for _, rows in groups for _, line in rows)]
    widths = [max(len(line[column]) for line in lines) for column in range(len(heading))]

    def aligned(line: list[str]) -> str:
        first, *others = (
            cell.ljust(w) if i == 0 else cell.rjust(w) for i, (cell, w) in enumerate(zip(line, widths, strict=True))
        )
        return " ".join([first, *others]).rstrip()

    table: list[tuple[str, str | None]] = [(aligned(heading), "bold")]
    for title, rows in groups:
        table.append((title, "dim"))
        table += [(aligned(line), "bold" if row is found.case else None) for row, line in rows]
    return table


def _scale(found: Comparison) -> tuple[str, float, int]:
    """Unit, factor and decimals that show the greatest torque with four digits."""
    torques = [abs(row.torque) for row in found.rows if math.isfinite(row.torque)]
    greatest = max(torques, default=0.0)
    unit, scale = ("N m", 1.0) if greatest >= 0.1 or greatest == 0 else ("mN m", 1e3)
    digits = 0 if greatest == 0 else math.floor(math.log10(greatest * scale))
    return unit, scale, min(max(3 - digits, 0), 6)


# -- programs -------------------------------------------------------------------------------------


def document(case: config.Case, found: Comparison) -> dict[str, Any]:
    """Inputs, all rows in SI, the spread, provenance."""
    reasons = _letters(found)
    return {
        "inputs": config.inputs(case),
        "case": _row(found.case),
        "models": [_row(row) for row in found.models],
        "laws": [{"slot": row.candidate.slot, **_row(row), "counts": row.candidate.counts} for row in found.laws],
        "spread": {
            "models": _ends(found.spread_of_models),
            "valid_laws": _ends(found.spread_of_laws),
            "change_by_slot": {slot: list(span) for slot, span in found.spans.items()},
        },
        "units": {"screw_torque": "N m", "contributions": "N m", "holding_torque": "N m"},
        "reasons": {reason: NUT_REASONS[reason] for reason in reasons},
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


def _row(row: Row) -> dict[str, Any]:
    r = row.result
    return {
        "name": row.candidate.name,
        "screw_torque": r.screw_torque,
        "change": row.change,
        "contributions": dict(r.contributions),
        "efficiency": r.efficiency,
        "back_driving_efficiency": r.back_driving_efficiency,
        "holding_torque": float(row.result.holding_torque),
        "self_locking": bool(row.result.self_locking),
        "valid": not row.outside,
        "not_valid_because": list(row.outside),
    }


def _ends(spread: Spread | None) -> dict[str, Any] | None:
    if spread is None:
        return None
    return {
        end: {"slot": row.candidate.slot or None, "name": row.candidate.name, "screw_torque": row.torque}
        for end, row in zip(("least", "greatest"), spread, strict=True)
    }


# -- the picture ----------------------------------------------------------------------------------


def check_picture(to: Path, option: str = "--to") -> None:
    """Raise :class:`~ballscrew.faults.InputError` if no picture can be written there."""
    if to.suffix.lower() not in _PICTURES:
        raise InputError(Fault(option, "unknown kind of file", str(to), "end it in .png, .svg or .pdf"))
    check_writable(option, to)


def draw(case: config.Case, found: Comparison, to: Path) -> None:
    """Write the picture of the spread, whole or not at all."""
    # matplotlib takes its time: only for those who want a picture
    from ballscrew.interfaces.figures import style

    buffer = io.BytesIO()
    with style.house_style():
        style.save_as(picture(case, found), buffer, to.suffix.lower().removeprefix("."))
    with whole("--to", to) as path:
        path.write_bytes(buffer.getvalue())


def picture(case: config.Case, found: Comparison) -> Figure:
    """The picture of the spread; call within the house style."""
    from ballscrew.interfaces.figures import comparison as figures

    notes = _letters(found)
    title = f"{_operating_point(case)}, model {case.model.label}"
    result = found.case.result
    assumed = report.assumed(case, result if isinstance(result, FrictionResult) else None)
    caption = " ".join([f"{report.design(case)}; {assumed}.", *_remarks(found, notes)])
    lines: list[figures.Line] = []
    for heading, rows in _groups(case, found):
        lines.append(figures.Line(heading))
        lines += [figures.Line(name_of(row), row, _beside(row, found, notes)) for row in rows]
    shown = {name: MECHANISMS.get(name, name) for name in mechanisms_in(found)}
    return figures.spread(title, caption, lines, found.case, shown)


def _groups(case: config.Case, found: Comparison) -> list[tuple[str, list[Row]]]:
    """The rows under their headings: the models, then the laws slot by slot."""
    own = [] if found.case in found.models else [found.case]
    by_slot = {slot: [row for row in found.laws if row.candidate.slot == slot] for slot in LAWS}
    return [
        ("models as they are", [*own, *found.models]),
        *((slot_in_words(slot, case), rows) for slot, rows in by_slot.items() if rows),
    ]


def _beside(row: Row, found: Comparison, notes: Mapping[str, str]) -> str:
    """What stands beside a bar: torque, change, and the reasons why it is not valid."""
    torque = f"{row.torque:.4g}" if math.isfinite(row.torque) else "not finite"
    change = "the case" if row is found.case else _percent(row.change)
    return "  ".join([torque, change, " ".join(notes[reason] for reason in row.outside)]).rstrip()


def _remarks(found: Comparison, notes: Mapping[str, str]) -> list[str]:
    remarks: list[str] = []
    if any(not row.candidate.counts for row in found.rows):
        remarks.append(f"{PRINTED_MARK} {PRINTED_WORDS}.")
    if notes:
        reasons = "; ".join(f"{letter} {reason.replace('_', ' ')}" for reason, letter in notes.items())
        remarks.append(f"Hatched: not valid here for the reason beside the bar: {reasons}.")
    return remarks
