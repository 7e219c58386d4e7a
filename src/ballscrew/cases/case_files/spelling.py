"""Texts of a case file that could be two numbers: ``"3.000 N"`` is 3 N, and 3000 N where a point parts thousands.

A point is that of decimals, in this package and in most programs, and trailing zeros are common: ``"6.350 mm"``. So
nothing is refused, and it is said only where the other number is plausible and the one that is read is not; of load,
speed and preload, of which either may be, wherever the other is plausible.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any, get_args

from pydantic import BaseModel

from ballscrew.basis import units
from ballscrew.basis.errors import Fault
from ballscrew.basis.quantities import Quantity, within_bounds
from ballscrew.basis.records import Record
from ballscrew.cases.schema.case_schema import sections
from ballscrew.physics.components.screw import PRELOAD_SHARES

#: The id of the warning.
THOUSANDS = "inputs.thousands"
#: One to three digits, a point, three digits, and a unit: as a number with its thousands parted, or three decimals.
_EITHER = re.compile(r"\s*([-+]?[1-9]\d{0,2})\.(\d{3})(?![\d.,'])\s*(\D.*)?")
#: What may be a thousand times as large on another screw.
_OF_ANY_SIZE = ("operation.axial_load", "operation.screw_speed", "nut.preload")
_FORCES = {"operation.axial_load": (0.0, 1.0), "nut.preload": PRELOAD_SHARES}


def doubtful(tables: Mapping[str, Any], dynamic_load_rating: float | None) -> list[Record]:
    """A warning for each number of a case that would be another, and a plausible one, if its point parted thousands.

    The force on the screw and the preload are plausible in relation to the dynamic load rating, where it is known.
    """
    return [
        record
        for section, table in tables.items()
        if section in sections() and isinstance(table, dict)
        for where, text, quantity in _texts(section, sections()[section], table)
        if (record := _doubt(where, text, quantity, dynamic_load_rating)) is not None
    ]


def _texts(where: str, model: type[BaseModel], table: Mapping[str, Any]) -> Iterator[tuple[str, str, Quantity]]:
    """The texts of a table that stand for quantities, with their places."""
    for name, value in table.items():
        field = model.model_fields.get(name)
        if field is None:
            continue
        quantity = next((each for each in field.metadata if isinstance(each, Quantity)), None)
        kinds: tuple[Any, ...] = (field.annotation, *get_args(field.annotation))
        inner = next((kind for kind in kinds if isinstance(kind, type) and issubclass(kind, BaseModel)), None)
        if isinstance(value, str) and quantity is not None:
            yield f"{where}.{name}", value, quantity
        elif isinstance(value, dict) and inner is not None:
            yield from _texts(f"{where}.{name}", inner, value)


def _doubt(where: str, text: str, quantity: Quantity, rating: float | None) -> Record | None:
    match = _EITHER.fullmatch(units.in_ascii(text)) if len(text) <= units.LONGEST_VALUE else None
    if match is None:
        return None
    whole, thousandths, unit = match[1], match[2], match[3] or ""
    read, other = (
        units.parse(where, f"{number} {unit}", quantity) for number in (_decimal(match), whole + thousandths)
    )
    if isinstance(read, Fault) or isinstance(other, Fault) or not _plausible(where, other, quantity, rating):
        return None
    if where not in _OF_ANY_SIZE and _plausible(where, read, quantity, rating):
        return None
    plain, with_thousands = (
        f"{number} {unit}".strip() for number in (f"{float(_decimal(match)):g}", whole + thousandths)
    )
    decimal = f"{_decimal(match)}0 {unit}".strip() if _EITHER.fullmatch(plain) else plain  # which is not asked again
    message = f'"{text.strip()}" is read as {plain}: write "{with_thousands}" if that is meant, else "{decimal}"'
    return Record.warning(THOUSANDS, where, message, value=read, limit=other, unit=quantity.unit)


def _decimal(match: re.Match[str]) -> str:
    """The number with its decimals."""
    return f"{match[1]}.{match[2]}"


def _plausible(where: str, value: float, quantity: Quantity, rating: float | None) -> bool:
    """Test whether a value may be one of this quantity."""
    if rating is not None and where in _FORCES:
        least, most = _FORCES[where]
        return least * rating <= abs(value) <= most * rating
    low, high = quantity.info.usual or (-float("inf"), float("inf"))
    return bool(within_bounds(quantity.info, value)) and low <= value <= high
