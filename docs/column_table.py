"""Column names that tables of screws may use, from the declarations of the columns."""

from __future__ import annotations

from collections.abc import Iterator

from ballscrew.basis.quantities import Quantity
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.files.tables.headings import Column


def column_table() -> str:
    """One row for each column."""
    return "\n".join(_lines()) + "\n"


def _lines() -> Iterator[str]:
    yield "| column | meaning | needed | unit | other names | only beside another name |"
    yield "|---|---|---|---|---|---|"
    for column in COLUMNS:
        quantity = column.quantity
        meaning = "" if quantity is None else quantity.info.meaning
        needed = "yes" if column.required else "no"
        yield (
            f"| `{column.name}` | {meaning} | {needed} | {_cells(column)} | {_listed(column.aliases)} |"
            f" {_listed(_own_hints(column))} |"
        )


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
