"""Column names that tables of screws may use, from the declarations of the columns."""

from __future__ import annotations

from ballscrew.basis.quantities import Quantity
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.files.tables.headings import Column
from ballscrew.questions.shared.text_tables import markdown_table


def column_table() -> str:
    """One row for each column."""
    rows = [
        (
            f"`{column.name}`",
            "" if column.quantity is None else column.quantity.info.meaning,
            "yes" if column.required else "no",
            _cells(column),
            _listed(column.aliases),
            _listed(_own_hints(column)),
        )
        for column in COLUMNS
    ]
    return markdown_table(("column", "meaning", "needed", "unit", "other names", "only beside another name"), rows)


def _cells(column: Column) -> str:
    """The unit of numbers, and what else a cell may be."""
    words = list(dict.fromkeys(column.words.values()))
    return ", or ".join([_unit(column.quantity), *(["%"] if column.share else []), *map("`{}`".format, words)])


def _unit(quantity: Quantity | None) -> str:
    if quantity is None:
        return "text"
    return "none" if quantity.unit == "1" else quantity.shown_in


def _own_hints(column: Column) -> list[str]:
    return [hint for hint in column.hints if hint not in column.aliases]


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
