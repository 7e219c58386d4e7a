"""Distributions as people write them in a case file: a number, how far it may be off, and units.

``"0.54 ± 0.01"``, ``"uniform(0.52, 0.56)"``, ``"40 mm js6"``: the central value goes where a number went, and the
distribution beside it.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Callable, Mapping, Sequence
from typing import NamedTuple

from ballscrew.analyses.distributions import Distribution, LogNormal, Normal, Triangular, Uniform, within
from ballscrew.analyses.known_uncertainties import NORMAL_95
from ballscrew.components.tolerances import BALL_LOT_VARIATION, TRAVEL_VARIATION, standard_tolerance
from ballscrew.faults import Fault, InputError, fault_of, nearest
from ballscrew.interfaces import units
from ballscrew.quantities import Quantity


class Written(NamedTuple):
    """A number with its distribution; without one it is known exactly."""

    central: float
    distribution: Distribution | None


class _Kind(NamedTuple):
    """A distribution that is written by its name: what its numbers are called, and how it is made of them."""

    numbers: Sequence[str]
    make: Callable[..., Distribution]


#: The names of the distributions stand here and nowhere else.
_KINDS: Mapping[str, _Kind] = {
    "uniform": _Kind(("low", "high"), Uniform),
    "normal": _Kind(("mean", "standard deviation"), Normal),
    "lognormal": _Kind(("median", "factor"), LogNormal),
    "triangular": _Kind(("low", "mode", "high"), Triangular),
}
#: What is a difference or a pure number, and no value of the quantity.
_DIFFERENCES, _RATIOS = frozenset({"standard deviation"}), frozenset({"factor"})
_PLUS_MINUS = re.compile(r"±|\+\s*(?:/\s*)?[-−–]")
_BY_NAME = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z_\s-]*?)\s*\((?P<numbers>[^()]*)\)\s*(?P<unit>.*?)\s*")
_BRACKETS = re.compile(r"\s*\((?P<inside>[^()]*)\)\s*(?P<unit>.*?)\s*")
_TOLERANCE = re.compile(r"(?P<value>.*\S)\s+(?P<letters>[A-Za-z]{1,2})\s?(?P<grade>\d{1,2})\s*")
_BALL_GRADE = re.compile(r"(?P<value>.*\S)\s+(?:grade\s*|G\s?)(?P<grade>\d+)\s*", re.IGNORECASE)
_LEAD_CLASS = re.compile(r"(?P<value>.*\S)\s+(?:class\s*|[PT]\s?)(?P<grade>\d+)\s*", re.IGNORECASE)
_EXAMPLE = {True: "0.54 ± 0.01", False: "40 mm ± 0.1 mm"}


def read(raw: object, quantity: Quantity) -> Written | Fault | None:
    """The number and the distribution in a text, in SI; None where the text has none; or the fault in it.

    The fault names no place. Tails are cut at the bounds of the quantity.
    """
    if not isinstance(raw, str) or len(raw) > units.LONGEST_VALUE:
        return None
    try:
        written = _read(raw, quantity)
    except InputError as error:
        return _of_person(error.faults[0], raw)
    if written is None or isinstance(written, Fault):
        return written
    fault = _fault_in(written, quantity, raw)
    if fault is not None or written.distribution is None:
        return fault or written
    if quantity.info.whole:
        return Fault("", "is a whole number, which has no distribution", raw, f'write "{written.central:g}"')
    return Written(written.central, within(written.distribution, quantity.info))


def refused(raw: object, quantity: Quantity) -> Fault | None:
    """The fault of a distribution where none can stand; None where the text has none."""
    written = read(raw, quantity)
    if written is None or isinstance(written, Fault):
        return written
    remedy = f"write one number: {units.example_of(quantity, f'{units.from_si(written.central, quantity):.6g}')}"
    return Fault("", "takes no distribution", str(raw), remedy)


def in_words(distribution: Distribution, quantity: Quantity) -> str:
    """A distribution in the units people think in: ``0.54 ± 0.01``, ``uniform, 0.52 to 0.56``."""
    match distribution:
        case Normal(mean, deviation):
            return f"{units.shown(mean, quantity)} ± {difference_shown(NORMAL_95 * deviation, quantity)}"
        case LogNormal(median, factor):
            return f"{_range(median / factor**NORMAL_95, median * factor**NORMAL_95, quantity)} (95 %), log-normal"
        case Uniform(low, high):
            return f"{_range(low, high, quantity)}, uniform"
        case Triangular(low, mode, high):
            return f"{_range(low, high, quantity)}, triangular about {units.shown(mode, quantity)}"


def _range(low: float, high: float, quantity: Quantity) -> str:
    """``0.52 to 0.56``, with as many digits as it takes to tell the ends apart."""
    digits = 2 + math.ceil(math.log10(max(abs(low), abs(high)) / (high - low)))
    return " to ".join(units.shown(end, quantity, max(4, digits)) for end in (low, high))


def difference_shown(difference: float, quantity: Quantity) -> str:
    """A difference of two values with its unit, as people read it; of temperatures it is in kelvin."""
    if quantity.unit == "K":
        return f"{difference:.4g} K"
    return units.shown(difference, quantity)


# -- the ways to write one ------------------------------------------------------------------------


def _read(raw: str, quantity: Quantity) -> Written | Fault | None:
    if _PLUS_MINUS.search(raw):
        return _plus_minus(raw, quantity)
    by_name = _BY_NAME.fullmatch(raw)
    if by_name is not None:
        return _by_name(raw, by_name, quantity)
    if quantity.unit != "m":
        return None
    if quantity.name == "ball_diameter" and (match := _BALL_GRADE.fullmatch(raw)):
        return _of_grade(raw, match, quantity, "ball grade", BALL_LOT_VARIATION, lambda _, width: width / 2)
    if quantity.name == "lead" and (match := _LEAD_CLASS.fullmatch(raw)):
        return _of_grade(raw, match, quantity, "lead class", TRAVEL_VARIATION, lambda lead, share: lead * share)
    if match := _TOLERANCE.fullmatch(raw):
        return _tolerance(raw, match, quantity)
    return None


def _plus_minus(raw: str, quantity: Quantity) -> Written | Fault:
    """``value ± half width``: the half width of the interval that holds 95 % of a normal distribution."""
    bracketed = _BRACKETS.fullmatch(raw)
    text, common = (bracketed["inside"], bracketed["unit"]) if bracketed else (raw, "")
    parts = [part.strip() for part in _PLUS_MINUS.split(text)]
    if len(parts) != 2:
        return Fault("", "has more than one ±", raw, f'write it like "{_EXAMPLE[quantity.unit == "1"]}"')
    middle, half = parts
    unit = common or units.unit_in(half).replace("%", "") or units.unit_in(middle)
    central = _value(middle, unit, quantity, raw)
    if isinstance(central, Fault):
        return central
    if half.endswith("%"):
        share = _plain(half[:-1], raw)
        half_width: float | Fault = share if isinstance(share, Fault) else share / 100 * abs(central)
    else:
        half_width = _difference(half, common or units.unit_in(middle) or unit, quantity, raw)
    if isinstance(half_width, Fault):
        return half_width
    if not half_width >= 0 or math.isinf(half_width):
        return Fault("", "must have a number of 0 or more behind ±", raw, "0 means that it is known exactly")
    return Written(central, Normal(central, half_width / NORMAL_95) if half_width else None)


def _by_name(raw: str, match: re.Match[str], quantity: Quantity) -> Written | Fault:
    """``uniform(low, high)`` and the others; a unit behind the bracket, or the last one, is that of all."""
    name = re.sub(r"[\s_-]", "", match["name"]).lower()
    if name not in _KINDS:
        return Fault("", "unknown distribution", raw, nearest(name, _KINDS))
    names, make = _KINDS[name]
    texts = [text.strip() for text in match["numbers"].split(",")]
    wanted = f"{name}({', '.join(names)})"
    if len(texts) != len(names) or not all(texts):
        return Fault("", f"must have {len(names)} numbers in its brackets", raw, f"write {wanted}")
    given = [units.unit_in(text) for text in texts]
    unit = match["unit"] or next((unit for unit in reversed(given) if unit and unit != "%"), "")
    numbers: list[float] = []
    for what, text in zip(names, texts, strict=True):
        number = _number(what, text, unit, quantity, raw, numbers)
        if isinstance(number, Fault):
            return number
        numbers.append(number)
    distribution = make(*numbers)
    return Written(float(distribution.quantile(0.5)), distribution)


def _number(what: str, text: str, unit: str, quantity: Quantity, raw: str, before: Sequence[float]) -> float | Fault:
    """One of the numbers in brackets: a value, a difference, or a pure number."""
    if what in _RATIOS:
        return _plain(text, raw)
    if what not in _DIFFERENCES:
        return _value(text, unit, quantity, raw)
    if text.endswith("%"):
        share = _plain(text[:-1], raw)
        return share if isinstance(share, Fault) else share / 100 * abs(before[0])
    return _difference(text, unit, quantity, raw)


def _tolerance(raw: str, match: re.Match[str], quantity: Quantity) -> Written | Fault | None:
    """A tolerance class of ISO 286-1 whose zone is symmetric: uniform over the zone."""
    letters, grade = match["letters"], int(match["grade"])
    value = units.parse("", match["value"], quantity)
    if isinstance(value, Fault):
        return None  # no number with a unit stands before it: the usual fault says more
    if letters.lower() not in ("js", "it"):
        remedy = 'a class with a symmetric zone is "js6" or "IT6"; write others as uniform(low, high)'
        return Fault("", "unknown tolerance class", raw, remedy)
    width = standard_tolerance(value, grade)
    if width is None:
        return Fault("", "has no standard tolerance", raw, "js and IT are known from 5 to 18, and up to 500 mm")
    return _about(value, width / 2)


def _of_grade(
    raw: str,
    match: re.Match[str],
    quantity: Quantity,
    what: str,
    known: Mapping[int, float],
    half_width: Callable[[float, float], float],
) -> Written | Fault:
    """A grade or class that a table knows: uniform about the value."""
    value = units.parse("", match["value"], quantity)
    if isinstance(value, Fault):
        return value
    grade = int(match["grade"])
    if grade not in known:
        return Fault("", f"unknown {what}", raw, f"known: {', '.join(map(str, known))}")
    return _about(value, half_width(value, known[grade]))


def _about(value: float, half_width: float) -> Written:
    return Written(value, Uniform(value - half_width, value + half_width))


# -- numbers --------------------------------------------------------------------------------------


def _value(text: str, unit: str, quantity: Quantity, raw: str) -> float | Fault:
    """A value of the quantity in SI; without a unit of its own it has that of the others."""
    written = text if units.unit_in(text) or not unit else f"{text} {unit}"
    value = units.parse("", written, quantity)
    return dataclasses.replace(value, given=raw) if isinstance(value, Fault) else value


def _difference(text: str, unit: str, quantity: Quantity, raw: str) -> float | Fault:
    """A difference of two values in SI: 5 degC apart are 5 K."""
    value = _value(text, unit, quantity, raw)
    if isinstance(value, Fault) or quantity.unit == "1":
        return value
    own = units.unit_in(text) or unit
    return value - units.to_si(0.0, own, quantity)


def _plain(text: str, raw: str) -> float | Fault:
    try:
        return float(text)
    except ValueError:
        return Fault("", "is not a plain number where it needs one", raw, "factors and shares have no unit")


# -- faults ---------------------------------------------------------------------------------------


def _fault_in(written: Written, quantity: Quantity, raw: str) -> Fault | None:
    """What is out of the bounds of the quantity: the central value, or an end."""
    ends = () if written.distribution is None else written.distribution.telling
    for value in (written.central, *ends):
        fault = fault_of("", quantity, float(value))
        if fault is not None:
            return units.in_people_units(fault, quantity, raw)
    return None


def _of_person(fault: Fault, raw: str) -> Fault:
    """A fault of a distribution's numbers in the words of the person who wrote them."""
    section, _, field = fault.where.partition(".")
    what = f"{field} of the {section.replace('_', '-')} distribution "
    return Fault("", what + fault.problem, raw, fault.remedy)
