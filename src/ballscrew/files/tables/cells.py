"""Cells of a table as numbers in SI, one cell at a time: plain numbers, numbers with a unit, products."""

from __future__ import annotations

import dataclasses
import re
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, as_float, fault_of
from ballscrew.files.tables import decimals
from ballscrew.files.tables.headings import PERCENT, Heading

#: The kind of fault of a cell that is a word where a number is to stand.
NOT_A_NUMBER = "not_a_number"
#: Marks of a number, at the begin of a cell.
_DIGITS = tuple("0123456789.,+-−")
_PRODUCT = re.compile(r"([\d.,]+)\s*[x×*]\s*([\d.,]+)", re.IGNORECASE)
_NUMBER = re.compile(r"[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf(?:inity)?)", re.IGNORECASE)


class Share(float):
    """A share of another number of its row, which stands there in per cent."""


def shown(cell: Any) -> str:
    """A cell as text, on one line and without what no terminal shows."""
    if isinstance(cell, float):
        return f"{cell:.12g}"
    return " ".join("".join(c if c.isprintable() else " " for c in str(cell)).split())


def value_of(where: str, cell: Any, text: str, heading: Heading, decimal: frozenset[str]) -> float | str | Fault:
    """A number in SI and within the bounds of its quantity, what a word stands for, or the fault in it."""
    words = heading.column.words
    if words and isinstance(cell, str):
        if (word := words.get(text.casefold())) is not None:
            return word
        if not text.startswith(_DIGITS):
            return Fault(where, "is neither a number nor a word that is known", text, _of_words(heading))
    if isinstance(cell, str):
        heading = _of_cell(text, heading)
    quantity = heading.quantity
    assert quantity is not None
    value = _number(where, cell, text, heading, decimal)
    fault = value if isinstance(value, Fault) else fault_of("", quantity, value)
    if fault is not None:
        if heading.unit == PERCENT:
            fault = _in_percent(fault, quantity.unit)
        fault = units.in_display_units(fault, quantity, fault.given if fault is value else text)
        return dataclasses.replace(fault, where=where, given=text)
    assert not isinstance(value, Fault)
    if heading.unit == PERCENT:
        return Share(value)
    return int(value) if quantity.info.whole else value


def _in_percent(fault: Fault, unit: str) -> Fault:
    """The fault of a share with its bound in per cent."""
    return fault.with_bound(unit, f"{100 * fault.bound:g} %") if fault.bound else fault


def _of_cell(text: str, heading: Heading) -> Heading:
    """The heading for a cell that may be a share: the unit of the cell comes before that of the heading."""
    unit = _unit_behind(text) if heading.column.share is not None else ""
    if not unit:
        return heading
    if unit == PERCENT:
        return dataclasses.replace(heading, unit=PERCENT, offset=0.0, scale=0.01)
    return dataclasses.replace(heading, unit="", offset=0.0, scale=1.0)


def _number(where: str, cell: Any, text: str, heading: Heading, decimal: frozenset[str]) -> float | Fault:
    """The number in a cell, in SI."""
    if isinstance(cell, float | int) and not isinstance(cell, bool):
        return _converted(where, as_float(cell), text, heading)
    if isinstance(cell, str):
        number = text.removesuffix(PERCENT).rstrip() if heading.unit == PERCENT else text
        return _parsed(where, number.replace("−", "-"), heading, decimal)
    remedy = "a spreadsheet makes dates of numbers: format the cell as a number"
    return Fault(where, "is not a number", text, remedy)


def text_of(where: str, text: str, heading: Heading) -> str | Fault:
    """A cell that is no number: as it stands, or what it means where the column has words of its own."""
    words = heading.column.words
    known = ", ".join(f'"{word}"' for word in dict.fromkeys(words.values()))
    result = words.get(text.casefold()) if words else text
    return Fault(where, "is not a word that is known", text, f"write one of {known}") if result is None else result


def _unit_behind(text: str) -> str:
    """What stands behind the digits of a number."""
    return text.lstrip("".join(_DIGITS)).strip() if text.startswith(_DIGITS) else ""


def _of_words(heading: Heading) -> str:
    quantity = heading.column.quantity
    assert quantity is not None
    known = ", ".join(f'"{word}"' for word in dict.fromkeys(heading.column.words.values()))
    return f"write {units.example_of(quantity)}, or {known}"


def _parsed(where: str, text: str, heading: Heading, decimal: frozenset[str]) -> float | Fault:
    """The number of a text; a unit of its own comes before that of the heading."""
    quantity = heading.quantity
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
    return Fault(where, "is not a number", text, remedy, id=NOT_A_NUMBER)


def _converted(where: str, number: float, text: str, heading: Heading) -> float | Fault:
    quantity = heading.quantity
    if quantity is not None and quantity.unit != "1" and not heading.unit:
        share = "" if heading.column.share is None else f' or "{text} {PERCENT}"'
        of_table = ", or the unit in the heading" if heading.in_table else ""
        return Fault(where, "needs a unit", text, f'write "{text} {quantity.shown_in}"{share}{of_table}')
    return heading.offset + heading.scale * number
