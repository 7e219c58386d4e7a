"""Bearings and guides by the names of their laws, and tables of values checked against the fields of a law."""

from __future__ import annotations

import dataclasses
import reprlib
from collections.abc import Mapping
from typing import Any

from ballscrew.axis.supports.bearing import MountedBearing, SupportBearing
from ballscrew.axis.supports.guide import CarriedMass, ContactGuide, GuidedTable, LinearGuide
from ballscrew.axis.supports.makers_bearing import KnownBearing, PalmgrenBearing, SKFBearing
from ballscrew.basis.errors import MISSING, Fault
from ballscrew.basis.quantities import Quantity, fields_of

#: Laws of bearings and of guides by name; the first is meant where none is named.
BEARING_LAWS: Mapping[str, type] = {
    "contacts": SupportBearing,
    "skf": SKFBearing,
    "palmgren": PalmgrenBearing,
    "known": KnownBearing,
}
GUIDE_LAWS: Mapping[str, type] = {"maker": LinearGuide, "contacts": ContactGuide}
#: What a bearing has besides the numbers of its law.
MOUNTING: Mapping[str, Quantity] = fields_of(MountedBearing)
#: Where the carriages are, and where the middle of the mass is on them.
STATICS: Mapping[str, Quantity] = {
    **{name: fields_of(GuidedTable)[name] for name in ("carriage_spacing", "rail_spacing")},
    **{name: fields_of(CarriedMass)[name] for name in ("along", "across", "above")},
}


#: Numbers that may have a distribution: friction goes with them in proportion.
UNCERTAIN = ("torque", "seal_torque", "friction_coefficient", "seal_force")


def fields_of_laws(laws: Mapping[str, type]) -> dict[str, Quantity]:
    """The numbers of all laws; of those of one name the first law's."""
    return {name: quantity for cls in reversed(list(laws.values())) for name, quantity in fields_of(cls).items()}


def name_of(element: Any, laws: Mapping[str, type]) -> str:
    """Name of the law of an element."""
    return next(name for name, cls in laws.items() if type(element) is cls)


def misplaced(where: str, law: str, laws: Mapping[str, type], values: Mapping[str, Any]) -> list[Fault]:
    """Faults of values that another law has."""
    faults: list[Fault] = []
    for name, value in values.items():
        if name in fields_of_laws(laws) and name not in fields_of(laws[law]):
            others = " or ".join(f'"{other}"' for other, cls in laws.items() if name in fields_of(cls))
            remedy = f"leave it out, or write law = {others}"
            faults.append(Fault(f"{where}.{name}", f'the law "{law}" has none', reprlib.repr(value), remedy))
    return faults


def missing(where: str, law: Any, values: Mapping[str, Any]) -> list[Fault]:
    """Faults of values that a law needs."""
    known, faults = fields_of(law), list[Fault]()
    for field in dataclasses.fields(law):
        if field.default is dataclasses.MISSING and field.name in known and field.name not in values:
            quantity = known[field.name]
            sample = "a number" if quantity.unit == "1" else f'"… {quantity.shown_in}"'
            faults.append(Fault(f"{where}.{field.name}", MISSING, "", f"add {field.name} = {sample}"))
    return faults


def numbers_of(element: Any, laws: Mapping[str, type] | None = None) -> dict[str, Any]:
    """Numbers of an element that are given, in SI, with its law and the viscosity of its oil."""
    numbers = {name: value for name in fields_of(type(element)) if (value := getattr(element, name)) is not None}
    if laws is None:
        return numbers
    oil = getattr(element, "lubricant", None)
    return {"law": name_of(element, laws), **numbers, **({} if oil is None else {"viscosity": oil.viscosity})}
