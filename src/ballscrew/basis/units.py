"""Conversion of units: text with a unit in, SI inside, display units out."""

from __future__ import annotations

import dataclasses
import decimal
import functools
import importlib
import math
import re
import reprlib
import sys
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any

from ballscrew.basis import pint_plugins
from ballscrew.basis.errors import Fault, as_float
from ballscrew.basis.quantities import Info, Quantity

_VALUE = re.compile(
    r"\s*(?P<number>[-+]?(?:(?:\d+(?:[' \u00a0\u2009\u202f]\d{3}(?!\d))*[.,\d]*|[.,]\d+)(?:e[-+]?\d+)?"
    r"|nan|inf(?:inity)?))"
    r"\s*(?P<unit>1\s*/.*?|[^\d\s.,'].*?)?\s*",
    re.IGNORECASE,
)
#: A fraction of whole numbers with its unit, as sizes in inches are written: 1/4 in, 1 3/16 in.
_FRACTION = re.compile(r"\s*(?:(?P<whole>\d+)[ -])?(?P<part>\d+)/(?P<parts>0*[1-9]\d*)(?P<unit>\s*[^\W\d].*)")
# a product or quotient of named units with small powers, and nothing else: pint would also evaluate
# "m**9**9**9", which takes long
_FACTOR = r"(?:[A-Za-zµμ°]+(?:(?:\^|\*\*)?[-+]?\d|[²³]|⁻[¹²³])?)"
_PRODUCT = rf"{_FACTOR}(?:(?:\s*[*·/]\s*|\s+){_FACTOR}){{0,4}}"
_UNIT = re.compile(rf"(?:1\s*/\s*)?{_PRODUCT}(?:\s*/\s*\({_PRODUCT}\))?")
_LONGEST_UNIT = 40
#: Most characters of a value; regular expressions are slow on longer text.
LONGEST_VALUE = 200
#: Distinct unit texts after which the registry is rebuilt: its cache of parsed units has no bound.
_MOST_PARSED = 1000
#: Converted numbers that are kept.
_MOST_KEPT = 10_000
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
    "m^2/s": ("cSt", "mm^2/s"),
    "K": ("degC", "K", "degF"),
    "kg": ("kg", "lb", "g"),
    "m/s": ("m/min", "m/s", "mm/s", "mm/min", "in/min"),
    "m/s^2": ("m/s^2", "mm/s^2"),
    "s": ("s", "min", "h"),
}
_NAMED = 3
#: Below this a length is what rounding leaves of none, m: a nucleus is as small.
SMALLEST_LENGTH = 1e-15
#: Spellings of revolutions per minute, without blanks.
PER_MINUTE = ("1/min", "/min", "U/min", "r/min", "min-1", "min^-1", "min⁻¹", "RPM")
#: Spellings of units of a torque, and how they are read.
TORQUES: Mapping[str, str] = {
    "Nm": "N m", "Nmm": "N mm", "Ncm": "N cm", "mNm": "mN m", "kNm": "kN m", "N.m": "N m", "N-m": "N m",
    "in-lb": "in lbf", "lb-in": "in lbf", "ft-lb": "ft lbf", "lb-ft": "ft lbf",
}  # fmt: skip
#: Digits in groups of three: between blanks or apostrophes, points or commas; the other mark is that of decimals.
_GROUPED = (
    re.compile(r"([-+]?\d{1,3}(?:[' \u00a0\u2009\u202f]\d{3})+)(?:[.,](\d*))?"),
    re.compile(r"([-+]?\d{1,3}(?:\.\d{3})+),(\d*)"),
    re.compile(r"([-+]?\d{1,3}(?:,\d{3})+)\.(\d*)"),
)
_PLAIN = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+|nan|inf(?:inity)?)", re.IGNORECASE)
_WITH_COMMA = re.compile(r"([-+]?\d*),(\d*)")
#: Spellings that pint's parser does not have, and their replacements.
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
    "m2": "m**2",
    "m3": "m**3",
}


@functools.cache
def _pint() -> Any:
    """The library pint, imported without the optional libraries hidden by :mod:`ballscrew.basis.pint_plugins`."""
    hidden = [name for name in pint_plugins.hidden_from_pint if name not in sys.modules]
    absent: Any = None  # importing it fails, as if it were not installed
    for name in hidden:
        sys.modules[name] = absent
    try:
        return importlib.import_module("pint")
    finally:
        for name in hidden:
            del sys.modules[name]


@functools.cache
def registry() -> Any:
    """The units of ``data/units.txt``; a fraction of pint's own list, and quick to load."""
    # None: an empty registry
    units = _pint().UnitRegistry(None, autoconvert_offset_to_baseunit=True)
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


_parsed: set[str] = set()


def to_si(value: float, unit: str, quantity: Quantity) -> float:
    """Convert to the SI unit of a quantity. Raises pint's errors for units that do not fit."""
    _parsed.add(unit)
    if len(_parsed) > _MOST_PARSED:
        registry.cache_clear()
        _parsed.clear()
    return _converted_number(float(value).hex(), unit, quantity.unit)


@functools.lru_cache(maxsize=_MOST_KEPT)
def _converted_number(exact: str, unit: str, other: str) -> float:
    """A number of one unit in another, kept: the same few come with every row of a table; zeros keep their sign."""
    return float(registry().Quantity(float.fromhex(exact), _pint_unit(unit)).to(_pint_unit(other)).magnitude)


def from_si(value: Any, quantity: Quantity) -> Any:
    """Convert a value or an array from SI to the display unit."""
    if quantity.shown_in == quantity.unit or quantity.unit == "1":
        return value
    if type(value) is float:
        return _converted_number(value.hex(), quantity.unit, quantity.shown_in)
    units = registry()
    return units.Quantity(value, _pint_unit(quantity.unit)).to(_pint_unit(quantity.shown_in)).magnitude


def written(value: Any, quantity: Quantity) -> str:
    """A value with its unit as a case file has it, to twelve digits."""
    number = f"{from_si(float(value), quantity):.12g}"
    return number if quantity.unit == "1" else f"{number} {quantity.shown_in}"


#: Significant digits of a number for people, with a band as without; zeros at the end are left out.
DIGITS = 4
#: From where on a large number has an exponent, whatever its significant digits.
_WITH_EXPONENT = 1e6
#: Digits beyond which a number is that of its rounding errors.
_EXACT = 12


def rounded(value: Any, quantity: Quantity, digits: int = DIGITS, toward: int = 0) -> str:
    """The digits of a value in its display unit, rounded for reading; a length smaller than a nucleus is zero."""
    number = float(value)
    if quantity.unit == "m" and abs(number) < SMALLEST_LENGTH:
        number = 0.0
    return to_digits(from_si(number, quantity), digits, toward)


def to_digits(number: float, digits: int = DIGITS, toward: int = 0) -> str:
    """A number with so many significant digits: to the nearest, or down or up with a ``toward`` of -1 or 1.

    The ends of a band are rounded outward: what is written holds no less than what was computed.
    """
    if toward and math.isfinite(number):
        context = decimal.Context(digits, decimal.ROUND_CEILING if toward > 0 else decimal.ROUND_FLOOR)
        number = float(context.create_decimal(f"{number:.{_EXACT}g}"))
    text = f"{number:.{digits}g}"
    # as the page has it: 24000, not 2.4e+04
    return f"{float(text):.0f}" if "e+" in text and abs(float(text)) < _WITH_EXPONENT else text


def label(quantity: Quantity) -> str:
    """The display unit as it is printed; empty for a number without one."""
    return "" if quantity.unit == "1" else quantity.shown_in.replace("um", "µm")


#: What stands in the names of units for their usual symbols.
_SYMBOLS = (
    (r"\bu(?=m\b|in\b|N\b)", "µ"),
    (r"\bdeg(?=[CF]\b)", "°"),
    (r"^deg\b", "°"),
    (r"\^2", "²"),
    (r"\^3", "³"),
    (r"\bohm\b", "Ω"),
    (" ", "·"),
)


def symbol(unit: str) -> str:
    """A unit in its usual symbols, as pages show it: µm, °C, m/s², N·m."""
    for written, usual in _SYMBOLS:
        unit = re.sub(written, usual, unit)
    return unit


def shown(value: Any, quantity: Quantity, digits: int = DIGITS, toward: int = 0) -> str:
    """A value with its unit, rounded for reading."""
    return " ".join(filter(None, (rounded(value, quantity, digits, toward), label(quantity))))


def number(value: Any, digits: int = DIGITS) -> str:
    """A plain number to so many digits, without the exponent of programs where a person writes none."""
    return f"{float(f'{value:.{digits}g}'):.10g}"


def ends(low: Any, high: Any, quantity: Quantity) -> tuple[str, str]:
    """The ends of a band with their units, rounded outward."""
    return shown(low, quantity, toward=-1), shown(high, quantity, toward=1)


def in_display_units(fault: Fault, quantity: Quantity, given: str) -> Fault:
    """A fault found in SI, with its bound in the display unit and the value as it was written."""
    if fault.bound is not None:
        digits = 9 if quantity.info.whole else DIGITS
        fault = fault.with_bound(quantity.unit, shown(fault.bound, quantity, digits))
    return dataclasses.replace(fault, given=given)


def heading(quantity: Quantity, name: str | None = None) -> str:
    """A column heading: ``axial load [N]``."""
    words = (name or quantity.name).replace("_", " ").replace(".", " ")
    return words if quantity.unit == "1" else f"{words} [{quantity.shown_in}]"


def example_of(quantity: Quantity, number: str = "1") -> str:
    """An example of valid text for a quantity."""
    return f'"{number} {quantity.shown_in}"'


#: Signs and digits that programs and keyboards of East Asia write, the minus sign and full-width forms, and ASCII.
_IN_ASCII = {0x2212: "-", 0x3000: " "} | {code: chr(code - 0xFEE0) for code in range(0xFF01, 0xFF5F)}


def in_ascii(text: str) -> str:
    """A text with its digits, signs and letters in ASCII where there is more than one way to write them."""
    return text if text.isascii() else text.translate(_IN_ASCII)


def parse(where: str, raw: object, quantity: Quantity) -> float | Fault:
    """A value from a file or the command line in SI, or the fault in it.

    A dimensional value is text with its unit; a bare number there is refused, and so is a unit on a
    plain number.
    """
    given = raw if isinstance(raw, str) else str(raw).lower() if isinstance(raw, bool) else reprlib.repr(raw)
    if isinstance(raw, bool) or not isinstance(raw, int | float | str):
        problem = "must be a number" if quantity.unit == "1" else "must be a number with a unit"
        return Fault(where, problem, given, _fix(quantity))
    if not isinstance(raw, str):
        if quantity.unit == "1":
            return as_float(raw)
        return Fault(where, "needs a unit", given, _written_like(quantity, given))
    if len(raw) > LONGEST_VALUE:
        return Fault(where, f"has more than {LONGEST_VALUE} letters", given, _fix(quantity))
    fraction = _FRACTION.fullmatch(in_ascii(raw)) if quantity.unit == "m" else None
    if fraction is not None:
        size = int(fraction["whole"] or 0) + int(fraction["part"]) / int(fraction["parts"])
        return _converted(where, size, fraction["unit"].strip(), quantity, given)
    match = _VALUE.fullmatch(in_ascii(raw))
    if match is None:
        problem = "is not a number" if quantity.unit == "1" else "is not a number with a unit"
        return Fault(where, problem, given, "write a decimal point" if "," in given else _fix(quantity))
    plain, unit = _plain(match["number"]), match["unit"] or ""
    if isinstance(plain, Fault):
        return Fault(where, plain.problem, given, plain.remedy)
    number = as_float(plain)
    if quantity.unit == "1":
        return number if not unit else Fault(where, "takes no unit", given, _plain_number(number, unit, quantity))
    if not unit:
        return Fault(where, "needs a unit", given, _written_like(quantity, match["number"]))
    return _converted(where, number, unit, quantity, given)


def _plain(written: str) -> str | Fault:
    """A number as Python reads it, of digits in groups or with a decimal comma, or the fault where it could be two."""
    mantissa, e, exponent = written.lower().partition("e") if "inf" not in written.lower() else (written, "", "")
    for grouped in _GROUPED:
        if match := grouped.fullmatch(mantissa):
            return re.sub(r"[^-+\d]", "", match[1]) + f".{match[2] or ''}{e}{exponent}"
    match = _WITH_COMMA.fullmatch(mantissa)
    if match and len(match[2]) == 3 and match[1].strip("+-0"):
        thousands, fraction = f"{match[1]}{match[2]}", f"{match[1]}.{match[2].rstrip('0') or '0'}"
        remedy = f"write {thousands} for thousands, {fraction} for a decimal"
        return Fault("", "could be two numbers", written, remedy)
    if match and (match[1] or match[2]):
        return f"{match[1]}.{match[2]}{e}{exponent}"
    if _PLAIN.fullmatch(mantissa):
        return written
    return Fault("", "is not a number", written, "write a decimal point, and no other marks between digits")


def unit_in(text: str) -> str:
    """The unit at the end of a value, or nothing."""
    match = _VALUE.fullmatch(in_ascii(text)) if len(text) <= LONGEST_VALUE else None
    return (match["unit"] or "") if match else ""


def fixed(value: Any, decimals: int = 0) -> str:
    """A plain number with so many decimals."""
    return f"{float(value):.{decimals}f}"


def to_significant(value: Any, digits: int) -> str:
    """A plain number to so many digits."""
    return f"{float(value):.{digits}g}"


def grouped(number: int) -> str:
    """A whole number with its thousands in groups."""
    return f"{number:,}"


def percent(share: Any, decimals: int = 0) -> str:
    """A share in per cent: ``12%``."""
    return f"{float(share):.{decimals}%}"


def change(share: Any, decimals: int = 0) -> str:
    """A change in per cent, with its sign: ``+12%``."""
    return f"{float(share):+.{decimals}%}"


def signed(number: str) -> str:
    """A number with its sign: ``+0.2 N m``."""
    return number if number.startswith("-") else f"+{number}"


def in_unit(value: Any, unit: str, digits: int = DIGITS) -> str:
    """A number in an SI unit, where no quantity is at hand."""
    return shown(value, Quantity("", unit, Info("", "")), digits)


def _written_like(quantity: Quantity, number: str) -> str:
    return f"write {example_of(quantity, number)}"


def _fix(quantity: Quantity) -> str:
    return "write a plain number" if quantity.unit == "1" else f"write it like {example_of(quantity)}"


def _plain_number(number: float, unit: str, quantity: Quantity) -> str:
    """The remedy for a plain number with a unit; to drop the unit could make another number of it."""
    if quantity.name == "loaded_balls":
        return "a number of balls: about turns · pi · pitch_circle_diameter / ball_diameter"
    if unit == "%" and not quantity.info.whole:
        return f"write {number / 100:.12g}"
    return f"it is a plain number: {quantity.info.hint}" if quantity.info.hint else "it is a plain number"


def _usual(quantity: Quantity) -> list[str]:
    """The units people use for a quantity, the one it is shown in first."""
    return list(dict.fromkeys([quantity.shown_in, *USUAL.get(quantity.unit, ()), quantity.unit]))


def _advice(quantity: Quantity) -> str:
    """A remedy that names units of a quantity."""
    if quantity.unit == "rad/s":
        return 'write it in rpm, such as "1500 rpm"'
    *others, last = _usual(quantity)[:_NAMED]
    return f"use a unit such as {', '.join(others)} or {last}" if others else f"use the unit {last}"


def _meant_or_usual(meant: str, quantity: Quantity) -> str:
    return f'did you mean "{meant}"?' if meant else _advice(quantity)


def _similar_unit(unit: str, quantity: Quantity) -> str:
    """The usual unit that is written the same but for capitals, blanks and points; nothing else is guessed."""

    def bare(text: str) -> str:
        return re.sub(r"[\s·*]", "", text).replace("µ", "u").replace("μ", "u").lower()

    return next((usual for usual in _usual(quantity) if bare(usual) == bare(unit)), "")


def _converted(where: str, number: float, unit: str, quantity: Quantity, given: str) -> float | Fault:
    pint = _pint()

    if quantity.unit == "rad/s" and unit.replace(" ", "") in PER_MINUTE:
        unit = "rpm"
    if quantity.unit.startswith("N m"):  # also of a torque for each ampere
        torque, slash, other = unit.partition("/")
        unit = f"{TORQUES.get(torque.strip(), torque)}{slash}{other}"
    if quantity.unit == "m/s^2" and unit == "g":  # of an acceleration no gram
        unit = "gravity"
    try:
        if len(unit) > _LONGEST_UNIT or not _UNIT.fullmatch(unit):
            raise pint.UndefinedUnitError(unit)
        return to_si(number, unit, quantity)
    except pint.DimensionalityError:
        remedy = _meant_or_usual(_similar_unit(unit, quantity), quantity)
        if quantity.name == "viscosity":
            remedy = (
                f"{remedy}; for a kinematic viscosity multiply by the density, or give kinematic_viscosity_40 and "
                'kinematic_viscosity_100, or grade = "ISO VG 100"'
            )
        return Fault(where, "wrong unit", given, remedy)
    # errors of pint are of several kinds; a unit to the power of none is a KeyError
    except (pint.PintError, ValueError, ArithmeticError, TypeError, LookupError):
        meant = _similar_unit(unit[:_LONGEST_UNIT], quantity)
        return Fault(where, "unknown unit", given, _meant_or_usual(meant, quantity))
