"""Cells of a table as numbers in SI, one cell at a time: plain numbers, numbers with a unit, products."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

from ballscrew import units
from ballscrew.errors import Fault, as_float, fault_of
from ballscrew.tables import decimals
from ballscrew.tables.headings import Heading

_PRODUCT = re.compile(r"([\d.,]+)\s*[x×*]\s*([\d.,]+)", re.IGNORECASE)
_NUMBER = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf(?:inity)?)", re.IGNORECASE)


def shown(cell: Any) -> str:
    """A cell as text, on one line and without what no terminal shows."""
    if isinstance(cell, float):
        return f"{cell:.12g}"
    return " ".join("".join(c if c.isprintable() else " " for c in str(cell)).split())


def value_of(where: str, cell: Any, text: str, heading: Heading, decimal: frozenset[str]) -> float | int | Fault:
    """A number in SI and within the bounds of its quantity, or the fault in it."""
    quantity = heading.column.quantity
    assert quantity is not None
    if isinstance(cell, float | int) and not isinstance(cell, bool):
        value = _converted(where, as_float(cell), text, heading)
    elif isinstance(cell, str):
        value = _parsed(where, text.replace("−", "-"), heading, decimal)
    else:
        value = Fault(
            where, "is not a number", text, "a spreadsheet makes dates of numbers: format the cell as a number"
        )
    fault = value if isinstance(value, Fault) else fault_of("", quantity, value)
    if fault is not None:
        fault = units.in_display_units(fault, quantity, fault.given if fault is value else text)
        return dataclasses.replace(fault, where=where, given=text)
    assert not isinstance(value, Fault)
    return int(value) if quantity.info.whole else value


def _parsed(where: str, text: str, heading: Heading, decimal: frozenset[str]) -> float | Fault:
    """The number of a text; a unit of its own comes before that of the heading."""
    quantity = heading.column.quantity
    assert quantity is not None
    product = _PRODUCT.fullmatch(text) if heading.column.product else None
    if product is not None:
        one, other = (_parsed(where, factor, heading, decimal) for factor in product.groups())
        return one if isinstance(one, Fault) else other if isinstance(other, Fault) else one * other
    plain = decimals.with_point(where, text, decimal)
    if isinstance(plain, Fault):
        return plain
    if _NUMBER.fullmatch(plain):
        return _converted(where, as_float(plain), text, heading)
    if units.unit_in(plain):
        return units.parse(where, plain, quantity)
    remedy = (
        "write a plain number" if quantity.unit == "1" else f"write a number in {heading.unit or quantity.shown_in}"
    )
    return Fault(where, "is not a number", text, remedy)


def _converted(where: str, number: float, text: str, heading: Heading) -> float | Fault:
    quantity = heading.column.quantity
    if quantity is not None and quantity.unit != "1" and not heading.unit:
        return Fault(where, "needs a unit", text, f'write "{text} {quantity.shown_in}", or the unit in the heading')
    return heading.offset + heading.scale * number
