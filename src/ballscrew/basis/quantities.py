"""Quantities: the unit lives in the type.

``Length = Annotated[Array, Unit("m")]`` and so on. A dataclass field adds an :class:`Info`
(symbol, meaning, bounds, display unit), and everything else that describes
the field reads it from there: constructor checks, case-file schema, command-line help, dataset
attributes, table headings.

Inside the package all values are SI, angles are radians, temperatures kelvin.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import operator
import sys
import types
from collections.abc import Iterator, Mapping
from typing import Annotated, Any, TypeAlias, Union, get_args, get_origin, get_type_hints

import numpy as np

from ballscrew.basis.arrays import namespace

#: A float, a NumPy array, or any foreign array the equations run on (JAX, SymPy, pint).
#: Deliberately open: the unit, not the container, is what the annotations are about.
Array: TypeAlias = Any


@dataclasses.dataclass(frozen=True, slots=True)
class Unit:
    """The SI unit of a value, in the spelling pint reads (``"N m"``, ``"1/Pa"``, ``"1"``)."""

    si: str


@dataclasses.dataclass(frozen=True, slots=True)
class Info:
    """The symbol, the meaning, the bounds and the display unit of a field.

    Values beyond the bounds are refused. ``usual`` is the range beyond which no ball screw is known; a value outside is
    computed, with a warning (:mod:`ballscrew.physics.friction.validity`).
    """

    symbol: str
    meaning: str
    shown_in: str = ""
    above: float | None = None
    at_least: float | None = None
    below: float | None = None
    at_most: float | None = None
    whole: bool = False
    address: str = ""
    hint: str = ""
    usual: tuple[float, float] | None = None


Ratio = Annotated[Array, Unit("1")]
Count = Annotated[Array, Unit("1")]
Mask = Annotated[Array, Unit("1")]
Length = Annotated[Array, Unit("m")]
Angle = Annotated[Array, Unit("rad")]
Force = Annotated[Array, Unit("N")]
Torque = Annotated[Array, Unit("N m")]
Power = Annotated[Array, Unit("W")]
Pressure = Annotated[Array, Unit("Pa")]
PressureCoefficient = Annotated[Array, Unit("1/Pa")]
Speed = Annotated[Array, Unit("m/s")]
AngularSpeed = Annotated[Array, Unit("rad/s")]
DiameterSpeed = Annotated[Array, Unit("m rad/s")]
Viscosity = Annotated[Array, Unit("Pa s")]
KinematicViscosity = Annotated[Array, Unit("m^2/s")]
Density = Annotated[Array, Unit("kg/m^3")]
Temperature = Annotated[Array, Unit("K")]
TemperatureDifference = Annotated[Array, Unit("K")]
Conductivity = Annotated[Array, Unit("W/(m K)")]
HeatCapacity = Annotated[Array, Unit("J/(kg K)")]
InverseLength = Annotated[Array, Unit("1/m")]
ArealDensity = Annotated[Array, Unit("1/m^2")]
Stiffness = Annotated[Array, Unit("N/m")]
RotationalStiffness = Annotated[Array, Unit("N m/rad")]
Compliance = Annotated[Array, Unit("m/N")]
StiffnessDensity = Annotated[Array, Unit("N/m^3")]
LoadDeflection = Annotated[Array, Unit("N/m^1.5")]
ShearRate = Annotated[Array, Unit("1/s")]
MomentOfInertia = Annotated[Array, Unit("kg m^2")]
RotationalDamping = Annotated[Array, Unit("N m s/rad")]
TemperatureCoefficient = Annotated[Array, Unit("1/K")]
Mass = Annotated[Array, Unit("kg")]
Duration = Annotated[Array, Unit("s")]
Frequency = Annotated[Array, Unit("Hz")]
Acceleration = Annotated[Array, Unit("m/s^2")]
Jerk = Annotated[Array, Unit("m/s^3")]
Energy = Annotated[Array, Unit("J")]
Conductance = Annotated[Array, Unit("W/K")]
HeatTransfer = Annotated[Array, Unit("W/(m^2 K)")]
ThermalResistance = Annotated[Array, Unit("K/W")]
ThermalCapacity = Annotated[Array, Unit("J/K")]


@dataclasses.dataclass(frozen=True, slots=True)
class Quantity:
    """An annotated name of a class, with its unit and its description."""

    name: str
    unit: str
    info: Info

    @property
    def shown_in(self) -> str:
        """The display unit; the SI unit where none is declared."""
        return self.info.shown_in or self.unit


def unit_of(annotation: object) -> str | None:
    """The SI unit declared by an annotation (also inside ``Force | None``), or None."""
    if get_origin(annotation) is Annotated:
        inner, *metadata = get_args(annotation)
        own = next((m.si for m in metadata if isinstance(m, Unit)), None)
        return own if own is not None else unit_of(inner)
    if isinstance(annotation, types.UnionType) or get_origin(annotation) is Union:
        return next((unit for unit in map(unit_of, get_args(annotation)) if unit is not None), None)
    return None


#: Parts of the names of units that a speed of rotation has; 1/min and Hz leave open what is counted.
_ANGLES = ("rad", "deg", "turn", "rev", "rpm", "rps", "cycle")


def carries_unit(value: Any) -> bool:
    """Return whether a value is a quantity of pint, or a sequence or an array of such quantities."""
    if isinstance(value, tuple) and hasattr(value, "_fields"):
        return False  # a part with fields, which is no sequence of numbers
    if isinstance(value, list | tuple) or (isinstance(value, np.ndarray) and value.dtype.kind == "O"):
        return any(carries_unit(element) for element in value if type(element) is not float)
    if isinstance(value, int | float | str | np.ndarray | np.generic):
        return False
    kind = type(value)
    return hasattr(kind, "magnitude") and hasattr(kind, "dimensionality")


def in_si(value: Any, unit: str) -> Array:
    """A value that carries a unit, in the SI unit given; converted by its own library, which is not imported here.

    Raises the errors of that library for a unit of another dimension, and ``ValueError`` for a sequence in which only
    some numbers have a unit.
    """
    if isinstance(value, list | tuple | np.ndarray):
        if not all(map(carries_unit, value)):
            raise ValueError("some of the numbers have a unit, others have none")
        return np.array([in_si(element, unit) for element in value])
    if unit == "rad/s" and not any(angle in str(value.units) for angle in _ANGLES):
        raise ValueError("could count radians or revolutions")
    return value.to(unit).magnitude


def info_of(annotation: object) -> Info | None:
    """The :class:`Info` carried by an annotation, or None."""
    if get_origin(annotation) is not Annotated:
        return None
    return next((m for m in get_args(annotation)[1:] if isinstance(m, Info)), None)


@functools.cache
def quantities_of(cls: type) -> Mapping[str, Quantity]:
    """All quantities of a class by name: annotated fields, then annotated (cached) properties."""
    values: dict[str, object] = dict(get_type_hints(cls, include_extras=True))
    for owner in reversed(cls.__mro__):
        for name, member in vars(owner).items():
            getter = member.fget if isinstance(member, property) else getattr(member, "func", None)
            if isinstance(member, property | functools.cached_property) and getter is not None:
                values[name] = get_type_hints(getter, include_extras=True).get("return")
    quantities: dict[str, Quantity] = {}
    for name, annotation in values.items():
        unit, info = unit_of(annotation), info_of(annotation)
        if unit is not None and info is not None:
            quantities[name] = Quantity(name, unit, info)
    return quantities


def fields_of(part: type | object) -> dict[str, Quantity]:
    """The quantities of a dataclass (or of the class of one) that are fields, by name."""
    return _fields_of(part if isinstance(part, type) else type(part))


@functools.cache
def _fields_of(cls: Any) -> dict[str, Quantity]:
    names = {field.name for field in dataclasses.fields(cls)}
    return {name: quantity for name, quantity in quantities_of(cls).items() if name in names}


#: What is wrong with a number beyond a bound, which stands in its braces.
BEYOND: Mapping[str, str] = {
    "finite": "must be a finite number",
    "whole": "must be a whole number",
    "positive": "must be positive",
    "above": "must be above {bound}",
    "not negative": "must not be negative",
    "at least": "must be at least {bound}",
    "below": "must be below {bound}",
    "at most": "must be at most {bound}",
}


def _conditions(info: Info, value: Array) -> Iterator[tuple[Mask, str, float | None]]:
    """Conditions on a finite number or on the elements of an array: mask, name of the condition, bound."""
    if info.whole:
        yield value % 1 == 0, "whole", None
    if info.above is not None:
        yield value > info.above, "positive" if info.above == 0 else "above", info.above
    if info.at_least is not None:
        yield value >= info.at_least, "not negative" if info.at_least == 0 else "at least", info.at_least
    if info.below is not None:
        yield value < info.below, "below", info.below
    if info.at_most is not None:
        yield value <= info.at_most, "at most", info.at_most


def within_bounds(info: Info, value: Array) -> Mask:
    """The mask of the elements of an array that are finite and within the declared bounds."""
    finite = namespace(value).isfinite(value)
    return functools.reduce(operator.and_, (holds for holds, _, _ in _conditions(info, value)), finite)


def ends_within(info: Info) -> tuple[float, float]:
    """The least and the greatest finite number within the declared bounds, whole or not."""
    least, greatest = -sys.float_info.max, sys.float_info.max
    if info.above is not None:
        least = max(least, math.nextafter(info.above, math.inf))
    if info.at_least is not None:
        least = max(least, info.at_least)
    if info.below is not None:
        greatest = min(greatest, math.nextafter(info.below, -math.inf))
    if info.at_most is not None:
        greatest = min(greatest, info.at_most)
    return least, greatest


def out_of_bounds(info: Info, value: float) -> tuple[str, float | None] | None:
    """The condition that a concrete number violates, of :data:`BEYOND`, and its bound; None if it holds all."""
    if not math.isfinite(value):
        return "finite", None
    return next(((condition, bound) for holds, condition, bound in _conditions(info, value) if not holds), None)
