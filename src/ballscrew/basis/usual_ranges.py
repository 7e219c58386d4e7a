"""Usual ranges: values that are possible, and that no ball screw has.

Bounds that cannot be exceeded and usual ranges stand in the one annotation of a quantity
(:class:`~ballscrew.basis.quantities.Info`). The first are refused; outside the second, values are computed. Each is
named in a record of the result, and at once, as a warning of Python, where a program makes a part of plain numbers.
"""

from __future__ import annotations

import inspect
import warnings
from collections.abc import Callable, Sequence
from types import FrameType
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import ImplausibleInput, is_concrete, shown
from ballscrew.basis.quantities import Info, Mask, Quantity, fields_of, quantities_of
from ballscrew.basis.records import Record

#: The id of the warning, whose last part is its name.
IMPLAUSIBLE = "inputs.implausible"
#: How a number is written, of a value and its quantity.
Written = Callable[[Any, Quantity], str]
#: Relations that say nothing new where another quantity of the same part is named.
_RELATED = ("groove_pitch",)
#: Functions between a part that is being made and whoever makes it.
_MAKING = frozenset({"__post_init__", "__init__", "replace", "_replace", "__replace__"})
_PACKAGE = __name__.partition(".")[0]


def in_si(value: Any, quantity: Quantity) -> str:
    """A value in its SI unit, as programs give it."""
    return shown(value, quantity.unit)


def unusual(section: str, part: Any, written: Written = units.shown) -> list[Record]:
    """A warning for each quantity of a part that is somewhere outside its usual range, with the value farthest out.

    Relations of fields, such as the lead angle, are quantities of the part as well.
    """
    values = {
        name: _record(f"{section}.{name}", quantity, value, written)
        for name, quantity in quantities_of(type(part)).items()
        if quantity.info.usual is not None and (value := _farthest_out(quantity, getattr(part, name))) is not None
    }
    return [record for name, record in values.items() if name not in _RELATED or len(values) == 1]


def warn_at_once(section: str, part: Any, also: Callable[[Any, Written], Sequence[Record]] | None = None) -> None:
    """Warn (:class:`~ballscrew.basis.errors.ImplausibleInput`) of a part whose plain numbers no ball screw has.

    ``also`` gives further records of the part, with numbers as they are written here. Nothing is said of arrays, nor of
    parts that this package makes: it says so in the records of its results.
    """
    frame, level = _maker()
    if frame is None or frame.f_globals.get("__name__", "").partition(".")[0] == _PACKAGE:
        return
    values = [value for name in fields_of(part) if (value := getattr(part, name)) is not None]
    if not all(map(is_concrete, values)):
        return
    beyond = (
        []
        if all(_is_usual(quantity, part) for quantity in quantities_of(type(part)).values())
        else unusual(section, part, in_si)
    )
    for record in [*beyond, *([] if also is None else also(part, in_si))]:
        text = f"{record.subject}: {record.text}; numbers without a unit are in SI units"
        warnings.warn(text, ImplausibleInput, stacklevel=level)


def _is_usual(quantity: Quantity, part: Any) -> bool:
    """Test whether a plain number is surely within its usual range; cheap, as parts are made by the thousand."""
    if quantity.info.usual is None or (value := getattr(part, quantity.name)) is None:
        return True
    low, high = quantity.info.usual
    return bool(low <= value <= high)


def _maker() -> tuple[FrameType | None, int]:
    """The frame that makes a part, and its place on the stack as seen from :func:`warn_at_once`."""
    frame, level = inspect.currentframe(), 0
    for _ in range(2):  # this function, and warn_at_once
        frame, level = None if frame is None else frame.f_back, level + 1
    while frame is not None and frame.f_code.co_name in _MAKING:
        frame, level = frame.f_back, level + 1
    return frame, level


def is_unusual(info: Info, value: Any) -> Mask:
    """Mask: a value is outside the usual range of a quantity. Elementwise: numbers, and values that are recorded.

    Where the bound is zero and the range begins above it, zero says that there is none.
    """
    low, high = info.usual or (-np.inf, np.inf)
    beyond = (value < low) | (value > high)
    return beyond & (value != 0) if low > 0 and info.at_least == 0 else beyond


def _farthest_out(quantity: Quantity, values: Any) -> float | None:
    """The value farthest outside the usual range, by its ratio to the end; None if all are within it.

    Where the bound is zero and the range begins above it, zero says that there is none.
    """
    if values is None or quantity.info.usual is None:
        return None
    low, high = quantity.info.usual
    numbers = np.asarray(values, dtype=float)
    numbers = numbers[np.isfinite(numbers)]
    if low > 0 and quantity.info.at_least == 0:
        numbers = numbers[numbers != 0]
    least, most = numbers.min(initial=low), numbers.max(initial=high)
    if least >= low and most <= high:
        return None
    return float(most if most > high and (least >= low or most / high > low / max(least, 1e-300)) else least)


def _record(subject: str, quantity: Quantity, value: float, written: Written) -> Record:
    assert quantity.info.usual is not None
    low, high = quantity.info.usual
    number, least, most = (written(one, quantity) for one in (value, low, high))
    return Record.warning(
        IMPLAUSIBLE,
        subject,
        f"{quantity.info.meaning} {number} lies outside the usual {least} to {most}: check the number and its unit",
        value=value,
        limit=high if value > high else low,
        unit=quantity.unit,
    )
