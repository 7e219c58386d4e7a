"""Commas and points in the numbers of a table: decimal marks, or separators of thousands."""

from __future__ import annotations

import re
from collections.abc import Iterable

from ballscrew.basis.errors import Fault

_NUMBER = re.compile(r"[-+]?[\d.,]*\d[\d.,]*")
_THOUSANDS = re.compile(r"[-+]?[1-9]\d{0,2}(?:[.,]\d{3})+")
_SPACED = re.compile(r"[-+]?\d{1,3}(?:[ \u00a0\u2009\u202f'’]\d{3})+\b")
_MARKS = (",", ".")


def evidence(texts: Iterable[str]) -> frozenset[str]:
    """The marks that must be decimal marks somewhere in these texts: "6,35" and "0,540", but not "3,175"."""
    return frozenset(mark for text in texts for mark in _MARKS if _certain(text, mark))


def _certain(text: str, mark: str) -> bool:
    number = _NUMBER.match(text)
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
    number = _NUMBER.match(text)
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
