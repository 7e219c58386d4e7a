"""Uncertain values written as text: a number, its distribution, and units.

``"0.54 ± 0.01"``, ``"uniform(0.52, 0.56)"``, ``"40 mm js6"`` are parsed once, into an :class:`UncertainValue`.

Default uncertainties of inputs that are rarely known: ``data/uncertainties.toml``, about the values of a case.
"""

from __future__ import annotations

import bisect
import dataclasses
import functools
import math
import operator
import re
import tomllib
from collections.abc import Callable, Collection, Mapping, Sequence
from importlib import resources
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of, nearest
from ballscrew.basis.quantities import Force, Info, Length, Quantity, Ratio
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.uncertainty.distributions import Distribution, LogNormal, Normal, Triangular, Uniform, within
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.load_distribution import preload_growth

#: Half the width of the interval that holds 95 % of a normal distribution, in standard deviations.
NORMAL_95 = 1.959963984540054
#: Share of a value that is known to be of a kind, where others of its quantity lie ``between`` two numbers.
NEAR = 0.1
#: What stands for a source where there is none.
JUDGEMENT = "judgement"
#: The viscosity of an oil whose grade and temperature are known.
_OF_GRADE = "viscosity_of_grade"
#: The viscosity of an oil of a data sheet at a temperature that is known.
_OF_SHEET = "viscosity_of_sheet"


@dataclasses.dataclass(frozen=True, kw_only=True)
class DefaultUncertainty:
    """Default uncertainty of an input, in one of five forms, with its source and the reason in a sentence.

    ``half_width``, ``share``, ``limits``, ``between`` and ``factor`` are as the head of the file says.
    """

    name: str
    source: str
    reason: str
    half_width: float | None = None
    share: float | None = None
    limits: float | None = None
    between: tuple[float, float] | None = None
    factor: float | None = None

    def about(self, value: float, info: Info) -> Distribution | None:
        """The distribution about a value of a quantity, SI; None for one at its lower bound, which was switched off."""
        bound = info.at_least if info.above is None else info.above
        above = value - (bound or 0.0)
        if above <= 0:
            return None
        if self.half_width is not None:
            distribution: Distribution = Normal(value, self.half_width / NORMAL_95)
        elif self.share is not None:
            distribution = Normal(value, self.share * above / NORMAL_95)
        elif self.between is not None:
            low, high = self.between
            known = Normal(value, NEAR * value / NORMAL_95)
            distribution = Triangular(low, value, high) if low < value < high else known
        elif self.limits is not None:
            distribution = Uniform(value * (1 - self.limits), value * (1 + self.limits))
        else:
            assert self.factor is not None, self.name
            distribution = LogNormal(value, math.exp(math.log(self.factor) / NORMAL_95))
        return within(distribution, info)


@functools.cache
def default_uncertainties() -> Mapping[str, DefaultUncertainty]:
    """Those shipped, by the name of the input."""
    text = resources.files("ballscrew").joinpath("data/uncertainties.toml").read_text(encoding="utf-8")
    tables: dict[str, dict[str, Any]] = tomllib.loads(text)
    return {name: DefaultUncertainty(name=name, **_hashable(table)) for name, table in tables.items()}


def _hashable(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table with tuples for its lists."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}


def default_distributions(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    given: Collection[str] = (),
    exact: Collection[str] = (),
) -> Mapping[str, tuple[Distribution, DefaultUncertainty]]:
    """The usual distributions of inputs, about the values they have, and where they are from.

    Left out are those whose distribution is ``given`` and those that are known exactly. Of an oil of a grade or
    of a data sheet the temperature is uncertain and the viscosity follows, or, where the temperature is exact, the
    viscosity is by what a grade leaves open: never both, as one would undo the other. The preload of oversize balls is
    as uncertain as that of other nuts, and by what is uncertain of their size.
    """
    inputs, known = inputs_of(model, screw, lubricant), default_uncertainties()
    parts = {"screw": screw, "lubricant": lubricant, "model": model, "nut": screw.nut}
    result: dict[str, tuple[Distribution, DefaultUncertainty]] = {}
    for name in known:
        if name not in inputs or name in given or name in exact or not _counts(name, model, lubricant, exact):
            continue
        part, quantity = inputs[name]
        of_loss = name.startswith("losses.")
        value = screw.nut.value_of(name) if of_loss else operator.attrgetter(name)(parts[part])
        if value is None and name == "ball_to_ball_force":
            value = model.imposed_ball_force(screw)
        if value is None:
            continue  # preload of balls whose oversize is given
        uncertainty = known[_of_oil(lubricant) if name == "viscosity" else name]
        if name == "preload" and isinstance(screw.nut, OversizeBallNut) and value > 0:
            uncertainty = _of_oversize_balls(uncertainty, known["oversize"], screw, float(value))
        distribution = uncertainty.about(float(value), quantity.info)
        if distribution is not None:
            result[name] = distribution, uncertainty
    return result


def _of_oversize_balls(
    usual: DefaultUncertainty, oversize: DefaultUncertainty, screw: BallScrew, preload: Force
) -> DefaultUncertainty:
    """The uncertainty of a preload that balls of an uncertain oversize make: both causes are independent."""
    assert usual.share is not None
    assert oversize.half_width is not None
    by_size = preload_growth(screw, preload, screw.nut.bodies) * oversize.half_width
    share = math.hypot(usual.share, by_size)
    reason = f"{usual.share:.0%} as of other nuts, and {by_size:.0%} for half a gauge of balls: {oversize.reason}"
    return dataclasses.replace(usual, share=share, source=oversize.source, reason=reason)


def _of_oil(lubricant: Lubricant) -> str:
    """The default of the viscosity by what the oil was made from."""
    if lubricant.sheet is not None:
        return _OF_SHEET
    return "viscosity" if lubricant.grade is None else _OF_GRADE


def _counts(name: str, model: FrictionModel, lubricant: Lubricant, exact: Collection[str]) -> bool:
    """Test whether an input affects the result."""
    if name == "ball_to_ball_force":
        return traits_of(model.ball_force).uses_imposed_force
    if name == "friction.full_film_friction_coefficient":
        return model.full_film is None
    if name == "limiting_shear_coefficient":
        return traits_of(model.full_film).reads_limiting_shear
    if name == "viscosity" and lubricant.follows_temperature:
        return TEMPERATURE.name in exact
    return True


#: Ends of the size steps, mm (ISO286-1). The first step counts from 1 mm.
SIZE_STEPS = (1, 3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)
#: Standard tolerances as multiples of the tolerance factor i, by grade (ISO286-1): from IT6 on, ten times as much
#: every five grades.
MULTIPLES: Mapping[int, float] = {
    5: 7, 6: 10, 7: 16, 8: 25, 9: 40, 10: 64, 11: 100, 12: 160, 13: 250, 14: 400, 15: 640, 16: 1000, 17: 1600, 18: 2500,
}  # fmt: skip
#: Variation of the diameters within a lot of steel balls, m, by grade (ISO3290-1).
BALL_LOT_VARIATION: Mapping[int, Length] = {
    3: 0.13e-6, 5: 0.25e-6, 10: 0.5e-6, 16: 0.8e-6, 20: 1e-6, 24: 1.2e-6, 28: 1.4e-6, 40: 2e-6, 60: 3e-6, 100: 5e-6,
    200: 10e-6,
}  # fmt: skip
#: Travel variation over 300 mm, as a share of the travel, by class (ISO3408-3): 3.5, 6, 12, 23, 52 and 210 µm.
TRAVEL_VARIATION: Mapping[int, Ratio] = {
    grade: microns * 1e-6 / 0.3 for grade, microns in {0: 3.5, 1: 6, 3: 12, 5: 23, 7: 52, 10: 210}.items()
}


def standard_tolerance(size: Length, grade: int) -> Length | None:
    """Width of the tolerance zone of a size, m, by its grade; None for a grade or a size that has no formula.

    ISO286-1: a multiple of i = 0.45 D^⅓ + 0.001 D (i in µm, D in mm the geometric mean of the ends of the size
    step), rounded to whole micrometres up to 100 µm; within 1 µm of the printed table there. Larger ones are as
    the formula has them.
    """
    mm = round(1e3 * size, 6)  # 0.018 m are 18 mm, and no more
    if grade not in MULTIPLES or not 0 < mm <= SIZE_STEPS[-1]:
        return None
    step = max(1, bisect.bisect_left(SIZE_STEPS, mm))
    mean = math.sqrt(SIZE_STEPS[step - 1] * SIZE_STEPS[step])
    width = MULTIPLES[grade] * (0.45 * mean ** (1 / 3) + 0.001 * mean)
    return (round(width) if width <= 100 else width) * 1e-6


@dataclasses.dataclass(frozen=True)
class UncertainValue:
    """A central value with its distribution, in SI, and the text of both; without a distribution it is exact."""

    central: float
    distribution: Distribution | None
    text: str


class _Kind(NamedTuple):
    """A distribution written by its name: the names of its parameters, and its constructor."""

    numbers: Sequence[str]
    make: Callable[..., Distribution]


#: The distributions by the names that they are written by.
_KINDS: Mapping[str, _Kind] = {
    "uniform": _Kind(("low", "high"), Uniform),
    "normal": _Kind(("mean", "standard deviation"), Normal),
    "lognormal": _Kind(("median", "factor"), LogNormal),
    "triangular": _Kind(("low", "mode", "high"), Triangular),
}
#: Parameters that are a difference of two values, and those that are a plain number.
_DIFFERENCES, _RATIOS = frozenset({"standard deviation"}), frozenset({"factor"})
_PLUS_MINUS = re.compile(r"±|\+\s*(?:/\s*)?[-−–]")
_BY_NAME = re.compile(r"\s*(?P<name>[A-Za-z][A-Za-z_\s-]*?)\s*\((?P<numbers>[^()]*)\)\s*(?P<unit>.*?)\s*")
_BRACKETS = re.compile(r"\s*\((?P<inside>[^()]*)\)\s*(?P<unit>.*?)\s*")
_TOLERANCE = re.compile(r"(?P<value>.*\S)\s+(?P<letters>[A-Za-z]{1,2})\s?(?P<grade>\d{1,2})\s*")
_BALL_GRADE = re.compile(r"(?P<value>.*\S)\s+(?:grade\s*|G\s?)(?P<grade>\d+)\s*", re.IGNORECASE)
_LEAD_CLASS = re.compile(r"(?P<value>.*\S)\s+(?:class\s*|[PT]\s?)(?P<grade>\d+)\s*", re.IGNORECASE)
_EXAMPLE = {True: "0.54 ± 0.01", False: "40 mm ± 0.1 mm"}


def parse_uncertain(raw: object, quantity: Quantity) -> UncertainValue | Fault | None:
    """The uncertain value in a text; None where the text has no distribution; or the fault in it.

    The fault names no place. Tails are cut at the bounds of the quantity.
    """
    return _parsed(raw, quantity) if isinstance(raw, str) and len(raw) <= units.LONGEST_VALUE else None


@functools.lru_cache(maxsize=1024)
def _parsed(raw: str, quantity: Quantity) -> UncertainValue | Fault | None:
    """The same, once for each text: a case file and the uncertain inputs of its case both ask."""
    try:
        written = _by_pattern(units.in_ascii(raw), quantity)
    except InputError as error:
        return _as_written(error.faults[0], raw)
    if written is None or isinstance(written, Fault):
        return written
    fault = _fault_in(written, quantity, raw)
    if fault is not None or written.distribution is None:
        return fault or written
    if quantity.info.whole:
        central = units.to_significant(written.central, 6)
        return Fault("", "is a whole number, which has no distribution", raw, f'write "{central}"')
    return dataclasses.replace(written, distribution=within(written.distribution, quantity.info))


def refuse_distribution(raw: object, quantity: Quantity) -> Fault | None:
    """The fault of a distribution where none can stand; None where the text has none."""
    written = parse_uncertain(raw, quantity)
    if written is None or isinstance(written, Fault):
        return written
    example = units.example_of(quantity, f"{units.from_si(written.central, quantity):.6g}")
    remedy = f"write one number: {example}"
    return Fault("", "takes no distribution", str(raw), remedy)


def describe_distribution(distribution: Distribution, quantity: Quantity) -> str:
    """A distribution in display units: ``0.54 ± 0.01``, ``uniform, 0.52 to 0.56``."""
    match distribution:
        case Normal(mean, deviation):
            return f"{units.shown(mean, quantity)} ± {format_difference(NORMAL_95 * deviation, quantity)}"
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


def format_difference(difference: float, quantity: Quantity) -> str:
    """A difference of two values with its unit, as people read it; of temperatures it is in kelvin."""
    if quantity.unit == "K":
        return f"{difference:.4g} K"
    return units.shown(difference, quantity)


# -- the notations ------------------------------------------------------------------------


def _by_pattern(raw: str, quantity: Quantity) -> UncertainValue | Fault | None:
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


def _plus_minus(raw: str, quantity: Quantity) -> UncertainValue | Fault:
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
    return UncertainValue(central, Normal(central, half_width / NORMAL_95) if half_width else None, raw)


def _by_name(raw: str, match: re.Match[str], quantity: Quantity) -> UncertainValue | Fault:
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
    return UncertainValue(float(distribution.quantile(0.5)), distribution, raw)


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


def _tolerance(raw: str, match: re.Match[str], quantity: Quantity) -> UncertainValue | Fault | None:
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
    return _symmetric(value, width / 2, raw)


def _of_grade(
    raw: str,
    match: re.Match[str],
    quantity: Quantity,
    what: str,
    known: Mapping[int, float],
    half_width: Callable[[float, float], float],
) -> UncertainValue | Fault:
    """A grade or class that a table knows: uniform about the value."""
    value = units.parse("", match["value"], quantity)
    if isinstance(value, Fault):
        return value
    grade = int(match["grade"])
    if grade not in known:
        return Fault("", f"unknown {what}", raw, f"known: {', '.join(map(str, known))}")
    return _symmetric(value, half_width(value, known[grade]), raw)


def _symmetric(value: float, half_width: float, raw: str) -> UncertainValue:
    """A uniform distribution about a value."""
    return UncertainValue(value, Uniform(value - half_width, value + half_width), raw)


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
    # as the value is read, whatever its unit is spelt like
    zero = units.parse("", f"0 {units.unit_in(text) or unit}", quantity)
    return zero if isinstance(zero, Fault) else value - zero


def _plain(text: str, raw: str) -> float | Fault:
    try:
        return float(text)
    except ValueError:
        return Fault("", "is not a plain number where it needs one", raw, "factors and shares have no unit")


# -- faults ---------------------------------------------------------------------------------------


def _fault_in(written: UncertainValue, quantity: Quantity, raw: str) -> Fault | None:
    """The fault of a central value or an end beyond the bounds of the quantity."""
    ends = () if written.distribution is None else written.distribution.characteristic_values
    for value in (written.central, *ends):
        fault = fault_of("", quantity, float(value))
        if fault is not None:
            return units.in_display_units(fault, quantity, raw)
    return None


def _as_written(fault: Fault, raw: str) -> Fault:
    """A fault of the parameters of a distribution, with the text that has them."""
    section, _, field = fault.where.partition(".")
    problem = f"{field} of the {section.replace('_', '-')} distribution {fault.problem}"
    return Fault("", problem, raw, fault.remedy)
