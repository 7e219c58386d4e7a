"""The sheet of a comparison: what models and laws span, each of them with its parts, rules of one line, and bars."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

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
    columns_of,
    lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity, quantities_of
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.case_text import THOUSANDS
from ballscrew.cases.schema.case_schema import name_of_law
from ballscrew.engine.evaluation.comparison import Comparison, Row
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import LAWS
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.questions.compare.compute import models_without_nut, percent, verdicts, warnings
from ballscrew.questions.shared.charts import colour_of

#: Headings of the mechanisms where there is little room.
SHORT: Mapping[str, str] = {
    "hydrodynamic_rolling": "roll.",
    "elastic_hysteresis": "elast.",
    "curvature": "curv.",
    "spin": "spin",
    "helix": "helix",
    "ball_to_ball": "balls",
}
#: What stands in one column where there is little room: neighbours that rub, and their braking.
_TOGETHER = ("ball_to_ball", "chain_braking")
_PRINTED = "†"
_NOTES = (
    "η drive: the screw drives the nut; η load: the load drives the screw.",
    "Only laws are exchanged: coefficients are not varied here.",
)
_PRINTED_NOTE = (
    f"{_PRINTED} The paper's own form, known to be incomplete or misprinted: shown, but in no spread of laws."
)
#: Words before the verdicts.
_LABELS = {"compare.models": "models", "compare.laws": "valid laws", "compare.largest_effect": "matters most"}
_RESULT = quantities_of(FrictionResult)
_EFFICIENCY = _RESULT["efficiency"]
#: Torques below this are shown in thousandths.
_SMALL = 0.1


def sheet(case: Case, comparison: Comparison, heating: Sequence[Record] = ()) -> Sheet:
    """All that people see of a comparison of models and laws."""
    torque = _torque(comparison)
    own = [record for record in warnings(case, comparison) if record.id in (IMPLAUSIBLE, THOUSANDS)]
    names = models_without_nut(case)
    left_out = f"left out: {', '.join(names)} and other laws of slip, which know no balls with four contacts"
    return Sheet(
        f"{descriptions.operating_point_and_nut(case)}, model {case.model.label}",
        [
            Lines([Line(record.text) for record in heating]),
            Lines([Line(f"{_label(record)}: {record.text}", "verdict") for record in verdicts(comparison)]),
            _laws(case, comparison, torque),
            Lines([Line(left_out)] if names else []),
            _rules(comparison, torque),
            Lines([Line(f"{rule.title}: {rule.formula}; {rule.source}", "plain") for rule in comparison.rules]),
            warning_lines(own),
            Lines([Line(text, "warning", reason) for reason, text in _outside(comparison).items()]),
            lines(_assumed(case, comparison), "small"),
            _bars(case, comparison, torque),
            columns_of("laws", lambda: (_cells(row) for row in comparison.rows)),
        ],
    )


def _label(record: Record) -> str:
    return "laws" if record.holds is False else _LABELS[record.id]


def _torque(comparison: Comparison) -> Quantity:
    """The torque in N m, or in mN m where all are small."""
    torques = [abs(row.torque) for row in comparison.rows if math.isfinite(row.torque)]
    is_small = 0 < max(torques, default=0.0) < _SMALL
    return Quantity("screw_torque", "N m", Info("", "friction torque", "mN m" if is_small else "N m"))


def _outside(comparison: Comparison) -> dict[str, str]:
    """The reasons that fail somewhere, each with the rows where it does."""
    reasons: dict[str, str] = {}
    for reason in NUT_REASONS:
        names = [_full_name(row) for row in comparison.rows if reason in row.outside]
        if names:
            whose = "everywhere" if len(names) == len(comparison.rows) else f"of {', '.join(names)}"
            reasons[reason] = f"{NUT_REASONS[reason]}, {whose}"
    return reasons


def _assumed(case: Case, comparison: Comparison) -> list[str]:
    force = getattr(comparison.case.result, "ball_to_ball_force", None)  # that of all balls, which a nut has not
    assumed = descriptions.common_assumptions(case, None if force is None else float(force))
    return [descriptions.design(case, plain_text=True), *assumed]


# -- rows -----------------------------------------------------------------------------------------


def _name(row: Row) -> str:
    """The name of a row, with a mark where it stands in no spread."""
    return _law_in_words(row.candidate.slot, row.candidate.name) + ("" if row.candidate.counts else f" {_PRINTED}")


def _full_name(row: Row) -> str:
    return f"{row.candidate.slot.replace('_', ' ')} {_name(row)}".strip()


def _law_in_words(slot: str, name: str) -> str:
    """The name of a law; no law of the full film is the constant coefficient that the friction law has."""
    return "constant" if (slot, name) == ("full_film", "none") else name


def _groups(case: Case, comparison: Comparison) -> list[tuple[str, list[Row]]]:
    """The rows under their headings: the models, then the laws slot by slot."""
    own = [] if comparison.case in comparison.models else [comparison.case]
    by_slot = {slot: [row for row in comparison.laws if row.candidate.slot == slot] for slot in LAWS}
    return [
        ("models as they are", [*own, *comparison.models]),
        *((_slot(slot, case), rows) for slot, rows in by_slot.items() if rows),
    ]


def _slot(slot: str, case: Case) -> str:
    """A slot and the law that the case has in it."""
    return f"{slot.replace('_', ' ')}, in place of {_law_in_words(slot, name_of_law(slot, getattr(case.model, slot)))}"


def _mechanisms(comparison: Comparison) -> list[str]:
    """The mechanisms that are not zero everywhere."""
    names = comparison.case.result.contributions
    return [name for name in names if any(float(row.result.contributions[name]) for row in comparison.rows)]


def _laws(case: Case, comparison: Comparison, torque: Quantity) -> Table:
    """Each model and law: torque and its change, its parts, efficiency in both directions."""
    headings: dict[str, Sequence[str]] = {}
    for name in _mechanisms(comparison):
        names = _TOGETHER if name in _TOGETHER else (name,)
        headings[SHORT.get(names[0], name)] = names
    rows: list[Sequence[Cell]] = []
    for title, group in _groups(case, comparison):
        rows.append([title, *[""] * (4 + len(headings))])
        rows += [_law(row, comparison, torque, [*headings.values()]) for row in group]
    columns = ("", "total", "change", *headings, "η drive", "η load")
    has_printed = any(not row.candidate.counts for row in comparison.rows)
    notes = [*_NOTES, *([_PRINTED_NOTE] if has_printed else [])]
    return Table("models", f"Torque, {units.label(torque)}", columns, rows, notes, is_compact=True)


def _law(row: Row, comparison: Comparison, torque: Quantity, mechanisms: Sequence[Sequence[str]]) -> list[Cell]:
    forward, back = float(row.result.efficiency), float(row.result.back_driving_efficiency)
    parts = [sum(float(row.result.contributions[name]) for name in names) for names in mechanisms]
    return [
        f"  {_name(row)}",
        Number(row.torque, torque),
        "case" if row is comparison.case else _change(row.change),
        *(Number(part, torque, 3) for part in parts),
        Number(forward, _EFFICIENCY),
        "locks" if back <= 0 else Number(back, _EFFICIENCY),
    ]


def _rules(comparison: Comparison, torque: Quantity) -> Table:
    """Rules of one line beside the case: friction torque, efficiency, and drag torque."""
    own, balls = comparison.case, comparison.of_balls

    def row(name: str, screw: float, change: Cell, efficiency: float, drag: float, drag_change: Cell) -> list[Cell]:
        numbers = (Number(screw, torque), Number(efficiency, _EFFICIENCY), Number(drag, torque))
        return [name, numbers[0], change, *numbers[1:], drag_change]

    losses = "" if balls is None else " and ".join(MECHANISMS.get(name, name) for name in balls.losses)
    efficiency = float(own.result.efficiency)
    rows = [
        row("this case", own.torque, "case", efficiency, comparison.drag_torque, "case")
        if balls is None
        else row(f"this case, with {losses}", own.torque, "", efficiency, comparison.drag_torque, "")
    ]
    if balls is not None:
        name = f"this case, without {losses}, as all below"
        rows.append(row(name, balls.screw_torque, "case", balls.efficiency, balls.drag_torque, "case"))
    for rule in comparison.rules:
        changes = _change(rule.change), _change(rule.drag_change)
        rows.append(row(rule.title, rule.screw_torque, changes[0], rule.efficiency, rule.drag_torque, changes[1]))
    columns = ("", "torque", "change", "η drive", "drag torque", "change of it")
    return Table("rules", "In place of a model", columns, rows)


def _change(change: float) -> Share:
    return Share(change, bar=False, is_change=True)


# -- pictures and files ---------------------------------------------------------------------------


def _bars(case: Case, comparison: Comparison, torque: Quantity) -> Bars:
    """The torque of each row by mechanism; hatched where it is not valid."""
    mechanisms = _mechanisms(comparison)
    bars: list[Bar] = []
    for title, group in _groups(case, comparison):
        bars.append(Bar(title))
        for row in group:
            parts: list[tuple[str, float, Colour]] = [
                (MECHANISMS.get(name, name), float(row.result.contributions[name]), colour_of(name))
                for name in mechanisms
            ]
            bars.append(Bar(_name(row), parts, text=_beside(row, comparison), hatched=bool(row.outside)))
    marks = [Vertical("", comparison.case.torque, "ink")] if math.isfinite(comparison.case.torque) else []
    return Bars("friction torque on the screw; hatched: not valid here", torque, bars, marks)


def _beside(row: Row, comparison: Comparison) -> str:
    """Torque, change and efficiency, for the end of a bar."""
    torque = f"{row.torque:.4g}" if math.isfinite(row.torque) else "not finite"
    change = "the case" if row is comparison.case else percent(row.change)
    efficiency = float(row.result.efficiency)
    return "  ".join([torque, change, *([f"η {efficiency:.3f}"] if math.isfinite(efficiency) else [])])


def _cells(row: Row) -> dict[str, tuple[object, Quantity | None]]:
    parts = {
        MECHANISMS.get(name, name): (float(part), _RESULT["screw_torque"])
        for name, part in row.result.contributions.items()
    }
    return {
        "slot": (row.candidate.slot, None),
        "name": (row.candidate.name, None),
        "friction torque": (row.torque, _RESULT["screw_torque"]),
        "change": (row.change, None),
        **parts,
        "efficiency": (float(row.result.efficiency), _EFFICIENCY),
        "efficiency, load drives": (float(row.result.back_driving_efficiency), _EFFICIENCY),
        "outside": (", ".join(row.outside), None),
    }
