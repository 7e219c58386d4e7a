"""The names of the columns that a table of one's own may have, from the declarations of the columns."""

from __future__ import annotations

from collections.abc import Iterator

from ballscrew.interfaces.catalogue import COLUMNS
from ballscrew.interfaces.headings import Column
from ballscrew.interfaces.units import example_of
from ballscrew.quantities import Quantity


def column_table() -> str:
    """One line a column."""
    return "\n".join(_lines()) + "\n"


def _lines() -> Iterator[str]:
    yield "| column | meaning | needed | unit | other names | only beside another name |"
    yield "|---|---|---|---|---|---|"
    for column in COLUMNS:
        quantity = column.quantity
        meaning = "" if quantity is None else quantity.info.meaning
        needed = "yes" if column.required else "no"
        yield (
            f"| `{column.name}` | {meaning} | {needed} | {_unit(quantity)} | {_listed(column.aliases)} |"
            f" {_listed(_own_hints(column))} |"
        )


def _unit(quantity: Quantity | None) -> str:
    if quantity is None:
        return "text"
    return "none" if quantity.unit == "1" else example_of(quantity).strip('"').removeprefix("1 ")


def _own_hints(column: Column) -> list[str]:
    return [hint for hint in column.hints if hint not in column.aliases]


def _listed(names: tuple[str, ...] | list[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)
