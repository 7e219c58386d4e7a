"""Cells of a table as numbers in SI, one cell at a time: plain numbers, numbers with a unit, products.

Commas and points in the numbers of a table: decimal marks, or separators of thousands.

Columns of a table as numbers in SI, all cells at once: those that are plain numbers within their bounds.
"""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterable
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, as_float, fault_of
from ballscrew.basis.quantities import within_bounds
from ballscrew.files.tables.headings import NOTHING, PERCENT, Heading
from ballscrew.files.tables.sheets import is_error

_DIGITS_AND_MARKS = re.compile(r"[-+]?[\d.,]*\d[\d.,]*")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:[.,]\d{3})+")
_SPACED = re.compile(r"[-+]?\d{1,3}(?:[ \u00a0\u2009\u202f'’]\d{3})+\b")
_MARKS = (",", ".")


def evidence(texts: Iterable[str]) -> frozenset[str]:
    """The marks that must be decimal marks somewhere in these texts: "6,35" and "0,540", but not "3,175"."""
    return frozenset(mark for text in texts for mark in _MARKS if _certain(text, mark))


def _certain(text: str, mark: str) -> bool:
    number = _DIGITS_AND_MARKS.match(text)
    if number is None or number[0].count(mark) != 1 or _THOUSANDS.fullmatch(number[0]):
        return False
    others = [other for other in _MARKS if other != mark and other in number[0]]
    return all(number[0].index(other) < number[0].index(mark) for other in others)


def _fraction(digits: str, decimal: frozenset[str]) -> str:
    """A number that may have a separator of thousands, as the fraction that it may be, written so that it is read."""
    whole, thousandths = re.split("[.,]", digits, maxsplit=1)
    (mark,) = decimal if len(decimal) == 1 else (".",)
    fraction = f"{whole}{mark}{thousandths.rstrip('0') or '0'}"
    return f"{fraction}0" if len(decimal) > 1 and _THOUSANDS.fullmatch(fraction) else fraction


def with_point(where: str, text: str, decimal: frozenset[str]) -> str | Fault:
    """A number with a decimal point, whatever follows it, or the fault of one that may mean two numbers.

    ``decimal`` are the marks that are decimal marks elsewhere in the table.
    """
    spaced = _SPACED.match(text)
    if spaced is not None:
        plain = re.sub(r"[^\d+-]", "", spaced[0]) + text[spaced.end() :]
        return Fault(where, "has a separator of thousands", text, f"write {plain}")
    number = _DIGITS_AND_MARKS.match(text)
    if number is None:
        return text
    digits, rest = number[0], text[number.end() :]
    marks = [mark for mark in _MARKS if mark in digits]
    if len(marks) == 2 or any(digits.count(mark) > 1 for mark in marks):
        return Fault(where, "has a separator of thousands", text, "write it without, with a point as decimal mark")
    if not marks:
        return text
    # without evidence a point is a decimal mark, and a comma may be either
    alone = decimal == frozenset(marks) or (not decimal and marks[0] == ".")
    if _THOUSANDS.fullmatch(digits) and not alone:
        remedy = f"write {digits.replace(marks[0], '')} for thousands, {_fraction(digits, decimal)} for a decimal"
        return Fault(where, "may have a separator of thousands", text, remedy)
    return digits.replace(",", ".") + rest


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
    """Text behind the digits of a number."""
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
    plain = with_point(where, text, decimal)
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


#: The decimal marks of a file with decimal commas only.
COMMA = frozenset(",")
#: Marks of a missing value.
MISSING = (*NOTHING, "nan", "NaN", "NAN", "-nan", "-NaN")
#: Cells examined for a decimal mark, if the top of the file has none.
_EXAMINED = 10_000


def column_numbers(
    cells: Any, heading: Heading, decimal: frozenset[str]
) -> tuple[NDArray[np.float64], NDArray[np.int64]]:
    """The numbers of a column in SI, and the places of cells that are not plain numbers, or out of bounds.

    :func:`~ballscrew.files.tables.cells.value_of` reads the cells at those places, one by one.
    """
    quantity = heading.column.quantity
    assert quantity is not None
    array = np.asarray(cells)
    if array.dtype.kind in "fiu":
        values = array.astype(np.float64)
        given = ~np.isnan(values)
    else:
        values = _plain_numbers(array, decimal)
        given = np.array([not is_missing(cell) for cell in array], dtype=bool)  # of no cells, too
    values = heading.offset + heading.scale * values if heading.unit else np.full(values.shape, np.nan)
    return values, np.flatnonzero(given & ~within_bounds(quantity.info, values))


def is_missing(cell: Any) -> bool:
    """Test whether a cell has no value, or an error of a spreadsheet in place of one."""
    if isinstance(cell, str):
        return cell in MISSING or is_error(cell)
    return cell is None or (isinstance(cell, float) and np.isnan(cell))


def _plain_numbers(cells: NDArray[Any], decimal: frozenset[str]) -> NDArray[np.float64]:
    """The cells that are plain numbers, whatever their decimal mark is, as long as it can be no other; else NaN."""
    import pandas  # for columns of text only

    pd: Any = pandas  # its own types know little of what comes out
    texts = pd.Series([cell if isinstance(cell, str) else None for cell in cells], dtype=object)
    decimal = decimal or evidence(cell for cell in cells[:_EXAMINED] if isinstance(cell, str))
    if decimal == COMMA:
        texts = texts.where(~texts.str.contains(".", regex=False, na=False)).str.replace(",", ".", regex=False)
    values = pd.to_numeric(texts, errors="coerce").to_numpy(dtype=np.float64, copy=True)
    for place, cell in enumerate(cells):
        if isinstance(cell, int | float) and not isinstance(cell, bool):
            values[place] = cell
    return values
