"""Rows of catalogues: support units of screws, and seals of guides. What a catalogue does not print is not here."""

from __future__ import annotations

import dataclasses
import functools
import math
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Annotated, Any

from ballscrew.axis.supports.guide import LinearGuide
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import Angle, Force, Info, Length, Ratio, Stiffness


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
