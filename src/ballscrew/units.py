"""Units at the edge: text with a unit in, SI inside, units people think in out."""

from __future__ import annotations

import functools
import importlib
import re
import reprlib
import sys
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import TYPE_CHECKING, Any

from ballscrew import interfaces
from ballscrew.faults import Fault, as_float
from ballscrew.quantities import Quantity

if TYPE_CHECKING:
    import pint

_VALUE = re.compile(
    r"\s*(?P<number>[-+]?(?:(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?|nan|inf(?:inity)?))\s*(?P<unit>1\s*/.*?|[^\d\s.,].*?)?\s*",
    re.IGNORECASE,
)
# a product or quotient of named units with small powers, and nothing else: pint would also work out
# "m**9**9**9", and takes its time
_FACTOR = r"(?:[A-Za-zµμ°]+(?:(?:\^|\*\*)?[-+]?\d|[²³]|⁻[¹²³])?)"
_PRODUCT = rf"{_FACTOR}(?:(?:\s*[*·/]\s*|\s+){_FACTOR}){{0,4}}"
_UNIT = re.compile(rf"(?:1\s*/\s*)?{_PRODUCT}(?:\s*/\s*\({_PRODUCT}\))?")
_LONGEST_UNIT = 40
#: Letters of a value. What is longer was never meant as one, and patterns take their time on it.
LONGEST_VALUE = 200
#: Writings of units after which the library of units begins anew: it keeps each one that it was ever asked for.
_MOST_WRITINGS = 1000
#: Units that people use for a quantity, by its SI unit; the first ones are named in messages.
USUAL: Mapping[str, Sequence[str]] = {
    "m": ("mm", "um", "in", "m", "cm", "nm", "uin"),
    "rad": ("deg", "rad"),
    "rad/s": ("rpm", "rev/s", "rad/s", "deg/s"),
    "N": ("N", "kN", "lbf", "MN", "kgf"),
    "N m": ("N m", "N mm", "lbf in"),
    "Pa": ("MPa", "GPa", "psi", "Pa", "bar"),
    "1/Pa": ("1/GPa", "1/Pa"),
    "Pa s": ("mPa s", "Pa s", "cP"),
    "K": ("degC", "K", "degF"),
}
_NAMED = 3
#: Writings that pint's parser does not know, and what stands for them.
_SPELLINGS = {
    "µ": "u",
    "μ": "u",
    "°C": "degC",
    "°F": "degF",
    "°": "deg",
    "·": "*",
    "²": "**2",
    "³": "**3",
    "⁻¹": "**-1",
}


@functools.cache
def _pint() -> Any:
    """The library of units; on the command line without the libraries it looks for in vain."""
    hidden = [name for name in interfaces.hidden_from_pint if name not in sys.modules]
    absent: Any = None  # importing it fails, as if it were not installed
    for name in hidden:
        sys.modules[name] = absent
    try:
        return importlib.import_module("pint")
    finally:
        for name in hidden:
            del sys.modules[name]


@functools.cache
def registry() -> pint.UnitRegistry[Any]:
    """The units of ``data/units.txt``; a fraction of pint's own list, and quick to load."""
    pint = _pint()
    no_file: Any = None  # an empty registry, which pint's own types do not know of
    units: pint.UnitRegistry[Any] = pint.UnitRegistry(no_file, autoconvert_offset_to_baseunit=True)
    text = resources.files("ballscrew").joinpath("data/units.txt").read_text(encoding="utf-8")
    for line in text.splitlines():
        if line and not line.startswith("#"):
            units.define(line)
    return units


def _pint_unit(unit: str) -> str:
    for written, known in _SPELLINGS.items():
        unit = unit.replace(written, known)
    # "Pa s" and "N m" multiply; pint reads a blank between names as a product already
    return unit.replace("^", "**").strip()


_writings: set[str] = set()


def to_si(value: float, unit: str, quantity: Quantity) -> float:
    """Convert to the SI unit of a quantity. Raises pint's errors for units that do not fit."""
    units = registry()
    _writings.add(unit)
    if len(_writings) > _MOST_WRITINGS:
        registry.cache_clear()
        _writings.clear()
    return float(units.Quantity(value, _pint_unit(unit)).to(_pint_unit(quantity.unit)).magnitude)


def from_si(value: Any, quantity: Quantity) -> Any:
    """Convert a value or an array from SI to the unit people think in."""
    if quantity.shown_in == quantity.unit or quantity.unit == "1":
        return value
    units = registry()
    return units.Quantity(value, _pint_unit(quantity.unit)).to(_pint_unit(quantity.shown_in)).magnitude


def written(value: Any, quantity: Quantity) -> str:
    """A value with its unit as a case file has it, to twelve digits."""
    number = f"{from_si(float(value), quantity):.12g}"
    return number if quantity.unit == "1" else f"{number} {quantity.shown_in}"


def shown(value: Any, quantity: Quantity, digits: int = 4) -> str:
    """A value with its unit, as people read it."""
    number = f"{from_si(float(value), quantity):.{digits}g}"
    return number if quantity.unit == "1" else f"{number} {quantity.shown_in.replace('um', 'µm')}"


def in_people_units(fault: Fault, quantity: Quantity, given: str) -> Fault:
    """A fault found in SI, in the words of the person who wrote the value."""
    bound = "" if fault.bound is None else shown(fault.bound, quantity)
    problem, remedy = (text.replace("{bound}", bound) for text in (fault.problem, fault.remedy))
    return Fault(fault.where, problem, given, remedy)


def heading(quantity: Quantity, name: str | None = None) -> str:
    """A column heading: ``axial load [N]``."""
    words = (name or quantity.name).replace("_", " ").replace(".", " ")
    return words if quantity.unit == "1" else f"{words} [{quantity.shown_in}]"


def example_of(quantity: Quantity, number: str = "") -> str:
    """What a person could write for this quantity."""
    return f'"{number or "1"} {quantity.shown_in}"'


def parse(where: str, raw: object, quantity: Quantity) -> float | Fault:
    """A value from a file or the command line in SI, or the fault in it.

    A dimensional value is text with its unit; a bare number there is refused, and so is a unit on a
    plain number.
    """
    given = raw if isinstance(raw, str) else str(raw).lower() if isinstance(raw, bool) else reprlib.repr(raw)
    if isinstance(raw, bool) or not isinstance(raw, int | float | str):
        return Fault(
            where, "must be a number" + ("" if quantity.unit == "1" else " with a unit"), given, _fix(quantity)
        )
    if not isinstance(raw, str):
        if quantity.unit == "1":
            return as_float(raw)
        return Fault(where, "needs a unit", given, f"write {example_of(quantity, given)}")
    if len(raw) > LONGEST_VALUE:
        return Fault(where, f"has more than {LONGEST_VALUE} letters", given, _fix(quantity))
    match = _VALUE.fullmatch(raw)
    if match is None:
        problem = "is not a number" if quantity.unit == "1" else "is not a number with a unit"
        return Fault(where, problem, given, "write a decimal point" if "," in given else _fix(quantity))
    number, unit = as_float(match["number"]), match["unit"] or ""
    if quantity.unit == "1":
        return number if not unit else Fault(where, "takes no unit", given, _plain_number(number, unit, quantity))
    if not unit:
        return Fault(where, "needs a unit", given, f"write {example_of(quantity, match['number'])}")
    return _converted(where, number, unit, quantity, given)


def unit_in(text: str) -> str:
    """The unit at the end of a value, or nothing."""
    match = _VALUE.fullmatch(text) if len(text) <= LONGEST_VALUE else None
    return (match["unit"] or "") if match else ""


def _fix(quantity: Quantity) -> str:
    return "write a plain number" if quantity.unit == "1" else f"write it like {example_of(quantity)}"


def _plain_number(number: float, unit: str, quantity: Quantity) -> str:
    """The remedy for a plain number with a unit; to drop the unit could make another number of it."""
    if quantity.name == "loaded_balls":
        return "a number of balls: about turns · pi · pitch_circle_diameter / ball_diameter"
    if unit == "%" and not quantity.info.whole:
        return f"write {number / 100:.12g}"
    return "it is a plain number" + (f": {quantity.info.hint}" if quantity.info.hint else "")


def _usual(quantity: Quantity) -> list[str]:
    """The units people use for a quantity, the one it is shown in first."""
    return list(dict.fromkeys([quantity.shown_in, *USUAL.get(quantity.unit, ()), quantity.unit]))


def _advice(quantity: Quantity) -> str:
    """What unit to write."""
    if quantity.unit == "rad/s":
        return 'write it in rpm, such as "1500 rpm"'
    *others, last = _usual(quantity)[:_NAMED]
    return f"use a unit such as {', '.join(others)} or {last}" if others else f"use the unit {last}"


def _meant(unit: str, quantity: Quantity) -> str:
    """The usual unit that is written the same but for capitals, blanks and points; nothing else is guessed."""

    def bare(text: str) -> str:
        return re.sub(r"[\s·*]", "", text).replace("µ", "u").replace("μ", "u").lower()

    return next((usual for usual in _usual(quantity) if bare(usual) == bare(unit)), "")


def _converted(where: str, number: float, unit: str, quantity: Quantity, given: str) -> float | Fault:
    pint = _pint()

    try:
        if len(unit) > _LONGEST_UNIT or not _UNIT.fullmatch(unit):
            raise pint.UndefinedUnitError(unit)
        return to_si(number, unit, quantity)
    except pint.DimensionalityError:
        meant = _meant(unit, quantity)
        remedy = f'did you mean "{meant}"?' if meant else _advice(quantity)
        if quantity.name == "viscosity":
            remedy += '; for a kinematic viscosity multiply by the density, or give grade = "ISO VG 100"'
        return Fault(where, "wrong unit", given, remedy)
    except Exception:  # pint and Python's tokenizer raise many kinds for text that is no unit
        meant = _meant(unit[:_LONGEST_UNIT], quantity)
        return Fault(where, "unknown unit", given, f'did you mean "{meant}"?' if meant else _advice(quantity))
