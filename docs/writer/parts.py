"""Generated parts of pages: tables, figures and numbers, made again if a file has changed."""

from __future__ import annotations

from pathlib import Path

import command
import kept
from command import MADE
from kept import ROOT, Kept, Record

#: What makes each part. A name with a suffix is a file, else it is a folder.
PARTS = {
    "validation": "validation_tables:parts",
    "nuts": "effect_study.nut_figures:parts",
    "four_point.md": "four_point:table",
    "accuracy": "reference:parts",
    "olaru2005": "ballscrew.questions.reproduce.reproduction:reproduce_olaru2005",
    "effects": "effect_tables:parts",
    "theory": "theory_figures:parts",
    "uncertainty": "uncertainty_tables:parts",
    "warm_up": "warm_up_tables:tables",
    "starvation/cold.md": "starvation_tables:table",
    "calibration_example.txt": "calibration_example",
    "errata.md": "errata_page:rest",
    "equation_table.md": "equation_table:table",
    "bearings/bearings.md": "bearing_comparison:table",
    "bearings/bearings.svg": "bearing_comparison:picture",
    "api": "api_tables:parts",
    "cards.md": "case_tables:card_tables",
    "columns.md": "case_tables:column_table",
    "gallery.md": "gallery_table:table",
    "fields.md": "case_tables:field_table",
    "slots.md": "case_tables:slots_table",
    "laws.md": "case_tables:laws_table",
    "duty_examples.md": "duty_examples:table",
    "bibliography.md": "sources:listed",
}
#: Numbers by what their names begin with; the last has all others.
NUMBERS = {
    "validation_": ("numbers/validation.json", "validation_tables:numbers"),
    "t_": ("numbers/theory.json", "theory_numbers:numbers"),
    "errata_": ("numbers/errata.json", "errata_page:numbers"),
    "": ("numbers/effects.json", "effect_tables:numbers"),
}
MAKERS = {**dict(NUMBERS.values()), **PARTS}


def part_of(name: str) -> str:
    """The part that a file belongs to: ``warm_up/effects.md`` to ``warm_up``."""
    whole = [part for part in PARTS if name == part or name.startswith(f"{part}/")]
    if not whole:
        raise LookupError(f"nothing makes {name}")
    return max(whole, key=len)


def numbers_of(name: str) -> str:
    """The part that has a number."""
    return next(part for begin, (part, _) in NUMBERS.items() if name.startswith(begin))


class Part:
    """A part, and the record of what it was made from."""

    def __init__(self, name: str) -> None:
        self.name, self._kept, self._what = name, Kept(MADE / "kept"), ("part", name, MAKERS[name])

    def at_hand(self) -> Record | None:
        """The record, if it holds and all files are as they were made."""
        record = self._kept.find(*self._what)
        return record if record and all(kept.digest_of(MADE / n) == d for n, d in record.made.items()) else None

    def make(self) -> Record:
        """Make it, and write down what."""
        arguments = [str(MADE), self.name, MAKERS[self.name]]
        before = {path: path.stat().st_mtime_ns for path in self._there()}
        code, said = command.program_at_hand().together(arguments, ROOT, {"COLUMNS": "100"}, "make_part")
        if code:
            raise RuntimeError(f"{self.name}: {MAKERS[self.name]} ended with {code}\n{said}")
        made = {
            path.relative_to(MADE).as_posix(): kept.digest_of(path)
            for path in self._there()
            if path.stat().st_mtime_ns != before.get(path)
        }
        return self._kept.keep(Record("", made), *self._what)

    def _there(self) -> list[Path]:
        target = MADE / self.name
        if target.suffix:
            return [target] if target.is_file() else []
        return sorted(path for path in target.rglob("*") if path.is_file())
