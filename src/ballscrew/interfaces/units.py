"""Units at the edge: text with a unit in, SI inside, units people think in out."""

from __future__ import annotations

import functools
import re
import reprlib
from importlib import resources
from typing import TYPE_CHECKING, Any

from ballscrew.faults import Fault, as_float, nearest
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
def registry() -> pint.UnitRegistry[Any]:
    """The units of ``data/units.txt``; a fraction of pint's own list, and quick to load."""
    import pint

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


def to_si(value: float, unit: str, quantity: Quantity) -> float:
    """Convert to the SI unit of a quantity. Raises pint's errors for units that do not fit."""
    units = registry()
    return float(units.Quantity(value, _pint_unit(unit)).to(_pint_unit(quantity.unit)).magnitude)


def from_si(value: Any, quantity: Quantity) -> Any:
    """Convert a value or an array from SI to the unit people think in."""
    if quantity.shown_in == quantity.unit or quantity.unit == "1":
        return value
    units = registry()
    return units.Quantity(value, _pint_unit(quantity.unit)).to(_pint_unit(quantity.shown_in)).magnitude


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
    match = _VALUE.fullmatch(raw)
    if match is None:
        problem = "is not a number" if quantity.unit == "1" else "is not a number with a unit"
        return Fault(where, problem, given, "write a decimal point" if "," in given else _fix(quantity))
    number, unit = as_float(match["number"]), match["unit"] or ""
    if quantity.unit == "1":
        return number if not unit else Fault(where, "takes no unit", given, f"write {match['number']}")
    if not unit:
        return Fault(where, "needs a unit", given, f"write {example_of(quantity, match['number'])}")
    return _converted(where, number, unit, quantity, given)


def unit_in(text: str) -> str:
    """The unit at the end of a value, or nothing."""
    match = _VALUE.fullmatch(text)
    return (match["unit"] or "") if match else ""


def _fix(quantity: Quantity) -> str:
    return "write a plain number" if quantity.unit == "1" else f"write it like {example_of(quantity)}"


def _converted(where: str, number: float, unit: str, quantity: Quantity, given: str) -> float | Fault:
    import pint

    try:
        if len(unit) > _LONGEST_UNIT or not _UNIT.fullmatch(unit):
            raise pint.UndefinedUnitError(unit)
        return to_si(number, unit, quantity)
    except pint.DimensionalityError:
        remedy = f"use a unit such as {quantity.shown_in}"
        if quantity.name == "viscosity":
            remedy += '; for a kinematic viscosity multiply by the density, or give grade = "ISO VG 100"'
        if quantity.unit == "rad/s":
            remedy += " (rpm, not 1/min)"
        return Fault(where, "wrong unit", given, remedy)
    except Exception:  # pint and Python's tokenizer raise many kinds for text that is no unit
        guess = nearest(
            unit[:_LONGEST_UNIT], [quantity.shown_in, quantity.unit, *(n for n in dir(registry()) if n.isalpha())]
        )
        advice = f"use a unit such as {quantity.shown_in}"
        return Fault(where, "unknown unit", given, f"{guess} · {advice}" if guess.startswith("did") else advice)
