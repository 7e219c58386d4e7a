"""``ballscrew compare``: models and laws as a table on the terminal, and the words of its picture."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence

from rich.console import Console

from ballscrew.basis.output.wrapping import aligned
from ballscrew.cases.case_files import case_file, descriptions
from ballscrew.cases.case_files.spelling import THOUSANDS
from ballscrew.cases.schema.case_schema import LAWS, name_of_law
from ballscrew.engine.evaluation.comparison import Comparison, Row
from ballscrew.physics.friction.plausibility import IMPLAUSIBLE
from ballscrew.physics.friction.result import MECHANISMS
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.questions.compare.compute import models_without_nut
from ballscrew.questions.compare.document import percent, verdicts, warnings

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
TOGETHER = ("ball_to_ball", "chain_braking")
PRINTED_MARK = "†"
PRINTED_WORDS = "the paper's own form, known to be incomplete or misprinted: shown, but in no spread of laws"
_LEGEND = (
    "η drive: the screw drives the nut; η load: the load drives the screw; "
    "out: letters of what lies outside the model's validity",
    "only laws are exchanged: coefficients are not varied here",
)
#: Words before the verdicts.
_LABELS = {"compare.models": "models", "compare.laws": "valid laws", "compare.largest_effect": "matters most"}


def name_of(row: Row) -> str:
    """Label of a row, with a mark where it is outside its validity."""
    return _law_in_words(row.candidate.slot, row.candidate.name) + ("" if row.candidate.counts else f" {PRINTED_MARK}")


def slot_in_words(slot: str, case: case_file.Case) -> str:
    """A slot and the law that the case has in it."""
    return f"{slot.replace('_', ' ')}, in place of {_law_in_words(slot, name_of_law(slot, getattr(case.model, slot)))}"


def _law_in_words(slot: str, name: str) -> str:
    """The name of a law; no law of the full film is the constant coefficient that the friction law has."""
    return "constant" if (slot, name) == ("full_film", "none") else name


# -- the terminal ---------------------------------------------------------------------------------


def print_comparison(case: case_file.Case, found: Comparison) -> None:
    """The table on the terminal, and under it the spread and the reasons in words."""
    console = Console(highlight=False)

    def say(text: str, style: str | None = None) -> None:
        console.print(text, style=style, markup=False, soft_wrap=True)

    say(f"{operating_point(case)}, model {case.model.label}\n", "bold")
    for line, style in _table(case, found):
        say(line, style)
    say("")
    for line, style in rules_table(found):
        say(line, style)
    say("")
    for verdict in verdicts(found):
        label = "laws" if verdict.holds is False else _LABELS[verdict.id]
        say(f"{label:<12} {verdict.text}")
    for line in _LEGEND:
        say(line)
    if any(not row.candidate.counts for row in found.rows):
        say(f"{PRINTED_MARK}  {PRINTED_WORDS}")
    if names := models_without_nut(case):
        say(f"left out: {', '.join(names)} and other laws of slip, which know no balls with four contacts")
    for record in warnings(case, found):
        if record.id in (IMPLAUSIBLE, THOUSANDS):  # the others are in the table, by their letters
            say(f"beware  {record.name}: {record.text}", "yellow")
    for reason, letter in reason_letters(found).items():
        say(f"{letter}  {reason}: {NUT_REASONS[reason]}", "yellow")


def operating_point(case: case_file.Case) -> str:
    """Load and speed, and the nut where there is one."""
    return descriptions.operating_point_and_nut(case)


def reason_letters(found: Comparison) -> dict[str, str]:
    """A letter for each reason that fails somewhere."""
    failing = [reason for reason in NUT_REASONS if any(reason in row.outside for row in found.rows)]
    return dict(zip(failing, "abcdefghijklmnopqrstuvwxyz", strict=False))


def mechanisms_in(found: Comparison) -> list[str]:
    """The mechanisms that are not zero everywhere."""
    names = found.case.result.contributions
    return [name for name in names if any(float(row.result.contributions[name]) for row in found.rows)]


def _table(case: case_file.Case, found: Comparison) -> list[tuple[str, str | None]]:
    """The lines of the table and their styles. Headings run over all columns, which Rich's tables cannot."""
    columns = _Columns.of(found)
    groups = row_groups(case, found)
    heading, *lines = aligned([columns.heading, *(columns.cells(row) for _, rows in groups for row in rows)], gap=1)
    following = iter(lines)
    table: list[tuple[str, str | None]] = [(heading, "bold")]
    for title, rows in groups:
        table.append((title, "dim"))
        table += [(next(following), "bold" if row is found.case else None) for row in rows]
    return table


@dataclasses.dataclass(frozen=True)
class _Columns:
    """The columns of the table: the mechanisms by their headings, and the digits of torques."""

    found: Comparison
    letters: Mapping[str, str]
    mechanisms: Mapping[str, Sequence[str]]
    unit: str
    scale: float
    decimals: int

    @classmethod
    def of(cls, found: Comparison) -> _Columns:
        """Those of a comparison."""
        mechanisms: dict[str, Sequence[str]] = {}
        for name in mechanisms_in(found):
            names = TOGETHER if name in TOGETHER else (name,)
            mechanisms[SHORT.get(names[0], name)] = names
        return cls(found, reason_letters(found), mechanisms, *_scale(found))

    @property
    def heading(self) -> list[str]:
        """The headings."""
        return [f"torque, {self.unit}", "total", "change", *self.mechanisms, "η drive", "η load", "out"]

    def cells(self, row: Row) -> list[str]:
        """The cells of a row."""
        forward, back = float(row.result.efficiency), float(row.result.back_driving_efficiency)
        return [
            f" {name_of(row)}",
            self._number(row.torque),
            "case" if row is self.found.case else percent(row.change),
            *(
                self._number(sum(float(row.result.contributions[name]) for name in names))
                for names in self.mechanisms.values()
            ),
            f"{forward:.4f}" if math.isfinite(forward) else "–",
            "–" if math.isnan(back) else f"{back:.4f}" if back > 0 else "locks",
            "".join(self.letters[reason] for reason in row.outside),
        ]

    def _number(self, value: float) -> str:
        return f"{value * self.scale:.{self.decimals}f}" if math.isfinite(value) else "–"


def rules_table(found: Comparison) -> list[tuple[str, str | None]]:
    """Rules of one line beside the case: friction torque, efficiency, and drag torque."""
    unit, scale, decimals = _scale(found)

    def cells(torque: float, change: str, efficiency: float, drag: float, drag_change: str) -> list[str]:
        numbers = [f"{value * scale:.{decimals}f}" if math.isfinite(value) else "–" for value in (torque, drag)]
        eta = f"{efficiency:.4f}" if math.isfinite(efficiency) else "–"
        return [numbers[0], change, eta, numbers[1], drag_change]

    own, balls = found.case, found.of_balls
    losses = [] if balls is None else [MECHANISMS.get(name, name) for name in balls.losses]
    mark, whose = ("case", "this case") if balls is None else ("", f"this case, with {' and '.join(losses)}")
    lines = [
        ["in place of a model", f"torque, {unit}", "change", "η drive", "drag torque", "change"],
        [whose, *cells(own.torque, mark, float(own.result.efficiency), found.drag_torque, mark)],
    ]
    if balls is not None:
        numbers = cells(balls.screw_torque, "case", balls.efficiency, balls.drag_torque, "case")
        lines.append([f"this case, without {' and '.join(losses)}, as all below", *numbers])
    for rule in found.rules:
        changes = percent(rule.change), percent(rule.drag_change)
        numbers = cells(rule.screw_torque, changes[0], rule.efficiency, rule.drag_torque, changes[1])
        lines.append([rule.title, *numbers])
    bold = 2 if balls is None else 3
    table = [(line, "bold" if place < bold else None) for place, line in enumerate(aligned(lines))]
    return [*table, *((f"{rule.title}: {rule.formula}; {rule.source}", "dim") for rule in found.rules)]


def _scale(found: Comparison) -> tuple[str, float, int]:
    """Unit, factor and decimals that show the greatest torque with four digits."""
    torques = [abs(row.torque) for row in found.rows if math.isfinite(row.torque)]
    greatest = max(torques, default=0.0)
    unit, scale = ("N m", 1.0) if greatest >= 0.1 or greatest == 0 else ("mN m", 1e3)
    digits = 0 if greatest == 0 else math.floor(math.log10(greatest * scale))
    return unit, scale, min(max(3 - digits, 0), 6)


def row_groups(case: case_file.Case, found: Comparison) -> list[tuple[str, list[Row]]]:
    """The rows under their headings: the models, then the laws slot by slot."""
    own = [] if found.case in found.models else [found.case]
    by_slot = {slot: [row for row in found.laws if row.candidate.slot == slot] for slot in LAWS}
    return [
        ("models as they are", [*own, *found.models]),
        *((slot_in_words(slot, case), rows) for slot, rows in by_slot.items() if rows),
    ]


def _remarks(found: Comparison, notes: Mapping[str, str]) -> list[str]:
    remarks: list[str] = []
    if any(not row.candidate.counts for row in found.rows):
        remarks.append(f"{PRINTED_MARK} {PRINTED_WORDS}.")
    if notes:
        reasons = "; ".join(f"{letter} {reason.replace('_', ' ')}" for reason, letter in notes.items())
        remarks.append(f"Hatched: not valid here for the reason beside the bar: {reasons}.")
    return remarks


def caption(case: case_file.Case, found: Comparison) -> str:
    """The caption of the picture."""
    result = found.case.result
    force = getattr(result, "ball_to_ball_force", None)  # that of all balls, which a nut has not
    assumed = "; ".join(descriptions.common_assumptions(case, None if force is None else float(force)))
    return " ".join([f"{descriptions.design(case)}; {assumed}.", *_remarks(found, reason_letters(found))])


def row_label(row: Row, found: Comparison, notes: Mapping[str, str]) -> str:
    """Torque, change, and the reasons why it is not valid, for the end of a bar."""
    torque = f"{row.torque:.4g}" if math.isfinite(row.torque) else "not finite"
    change = "the case" if row is found.case else percent(row.change)
    return "  ".join([torque, change, " ".join(notes[reason] for reason in row.outside)]).rstrip()
