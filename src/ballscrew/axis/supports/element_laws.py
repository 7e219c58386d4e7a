"""Bearings and guides by the names of their laws, and by the rows of catalogues.

Tables of values are checked against the fields of a law. What a catalogue does not print is not in its row.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import reprlib
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Annotated, Any

from ballscrew.axis.supports.bearing import MountedBearing, SupportBearing
from ballscrew.axis.supports.guide import CarriedMass, ContactGuide, GuidedTable, LinearGuide
from ballscrew.axis.supports.makers_bearing import KnownBearing, PalmgrenBearing, SKFBearing
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest
from ballscrew.basis.quantities import Angle, Force, Info, Length, Quantity, Ratio, Stiffness, fields_of

#: Laws of bearings and of guides by name; the first is meant where none is named.
BEARING_LAWS: Mapping[str, type] = {
    "contacts": SupportBearing,
    "skf": SKFBearing,
    "palmgren": PalmgrenBearing,
    "known": KnownBearing,
}
GUIDE_LAWS: Mapping[str, type] = {"maker": LinearGuide, "contacts": ContactGuide}
#: The laws of both as people read them.
LAW_WORDS: Mapping[str, str] = {
    "contacts": "by its contacts",
    "skf": "by the model of SKF2018",
    "palmgren": "by Palmgren's moments, a recalled form",
    "known": "of a known torque",
    "maker": "by the law of makers",
}
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


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SupportUnit(ByValue):
    """The fixed side of a support unit: two angular-contact bearings face to face, preloaded, in a housing.

    Its rigidity is the ``bearing_rigidity`` of an :class:`~ballscrew.physics.sizing.installation.Installation`. The
    maker prints neither a torque nor the preload.
    """

    model: str
    bearing: str
    contact_angle: Annotated[Angle, Info(r"\alpha", "contact angle", "deg")]
    dynamic_load_rating: Annotated[Force, Info("C_a", "dynamic load rating", "kN")]
    permissible_load: Annotated[Force, Info("P_0", "static permissible load", "kN")]
    rigidity: Annotated[Stiffness, Info("R_b", "axial rigidity", "N/um")]
    source: str
    #: Of the bearing by ISO 15, where its name tells its series; the maker of the unit prints none.
    bore: Length | None = None
    outside_diameter: Length | None = None


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class GuideRow(ByValue):
    """A carriage of a linear guide: the force of its seals, and the least and greatest coefficient of its series."""

    model: str
    series: str
    seal_force: Annotated[Force, Info("f", "force of the seals of one carriage", "N")]
    friction_coefficients: tuple[Ratio, Ratio]
    source: str

    def guide(self, carriages: int = 4) -> LinearGuide:
        """The guide with so many carriages, at the greatest coefficient of the series."""
        return LinearGuide(
            friction_coefficient=self.friction_coefficients[1], seal_force=self.seal_force, carriages=carriages
        )


class _Rows(dict[str, Any]):
    """Rows by name; a name that is not there is answered with the nearest one."""

    def __missing__(self, name: str) -> Any:
        raise InputError(Fault("catalogue", "unknown row", str(name), nearest(str(name), self, most=5)))


@functools.cache
def support_units() -> Mapping[str, SupportUnit]:
    """The support units shipped, by model (``data/support_units.toml``): EK, FK and BK of THK513E.

    A name that is not there raises :class:`~ballscrew.basis.errors.InputError` with the nearest one.
    """
    document = _document("support_units")
    return _Rows(
        {
            model: SupportUnit(
                model=model,
                contact_angle=math.radians(unit["contact_angle_degrees"]),
                source=document["source"],
                **{name: value for name, value in unit.items() if name not in ("models", "contact_angle_degrees")},
            )
            for unit in document["units"]
            for model in unit["models"]
        }
    )


@functools.cache
def guide_rows() -> Mapping[str, GuideRow]:
    """The carriages shipped, by model (``data/guides.toml``).

    A name that is not there raises :class:`~ballscrew.basis.errors.InputError` with the nearest one.
    """
    return _Rows(
        {
            model: GuideRow(
                model=model,
                series=series["name"],
                seal_force=force,
                friction_coefficients=tuple(series["friction_coefficients"]),
                source=series["source"],
            )
            for series in _document("guides")["series"]
            for model, force in series["seals"].items()
        }
    )


def _document(name: str) -> dict[str, Any]:
    return tomllib.loads(resources.files("ballscrew").joinpath(f"data/{name}.toml").read_text(encoding="utf-8"))
