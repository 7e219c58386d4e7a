"""Rows of catalogues, and the screws they describe."""

from __future__ import annotations

import dataclasses
import functools
import math
import tomllib
from collections.abc import Mapping
from importlib import resources
from typing import Annotated, Any

from ballscrew.components.screw import BallScrew
from ballscrew.equations import geometry
from ballscrew.faults import Fault, InputError, faults_of, nearest, raise_if_any
from ballscrew.quantities import Angle, Count, Force, Info, Length, Ratio, Stiffness

#: Turns that carry no load where the balls of a nut leave and enter (ISO3408-5, as it fits the ratings of catalogues).
TURNS_WITHOUT_LOAD = 0.24

_OPTIONAL = ("pitch_circle_diameter", "root_diameter", "dynamic_load_rating", "static_load_rating", "rigidity")


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class CatalogueRow:
    """A ball screw as a catalogue lists it; what the catalogue leaves out is None or has a stated default.

    Defaults: a conformity of 0.54, which the root diameters of a catalogue imply and measured grooves
    (0.542, 0.544) confirm, good to about ±0.01; a contact angle of 45°; a pitch circle as large as the nominal diameter.
    Raises :class:`~ballscrew.faults.InputError` for values out of bounds.
    """

    name: str
    nominal_diameter: Annotated[Length, Info("d_0", "nominal diameter", "mm", above=0, hint="lengths are positive")]
    lead: Annotated[Length, Info("P_h", "advance of the nut in one turn", "mm", above=0, hint="lengths are positive")]
    ball_diameter: Annotated[Length, Info("d_w", "ball diameter", "mm", above=0, hint="lengths are positive")]
    turns: Annotated[
        Ratio,
        Info("i", "turns of balls in one nut body, all circuits together", above=TURNS_WITHOUT_LOAD, hint="2 to 6"),
    ]
    starts: Annotated[
        Count, Info("N", "number of thread starts", at_least=1, whole=True, hint="give a whole number, 1 or more")
    ] = 1
    pitch_circle_diameter: Annotated[
        Length | None,
        Info("d_m", "diameter of the helix of the ball centres", "mm", above=0, hint="lengths are positive"),
    ] = None
    root_diameter: Annotated[
        Length | None, Info("d_r", "diameter at the bottom of the groove", "mm", above=0, hint="lengths are positive")
    ] = None
    contact_angle: Annotated[
        Angle,
        Info(r"\alpha", "angle of the contact normal against the radial plane", "deg", above=0, below=math.pi / 2),
    ] = math.pi / 4
    conformity: Annotated[
        Ratio,
        Info("f", "groove radius / ball diameter, screw and nut", above=0.5, at_most=1, hint="catalogues have 0.54"),
    ] = 0.54
    dynamic_load_rating: Annotated[
        Force | None, Info("C_a", "dynamic axial load rating", "kN", above=0, hint="ratings are positive")
    ] = None
    static_load_rating: Annotated[
        Force | None, Info("C_{0a}", "static axial load rating", "kN", above=0, hint="ratings are positive")
    ] = None
    rigidity: Annotated[
        Stiffness | None, Info("R_{nu}", "axial stiffness of the nut", "N/um", above=0, hint="300 to 3000 N/um")
    ] = None
    source: str = ""

    def __post_init__(self) -> None:
        raise_if_any(faults_of(self.name or "row", self, optional=_OPTIONAL))

    @property
    def ball_circle(self) -> Length:
        """Pitch circle diameter; the nominal diameter where the catalogue gives none."""
        return self.nominal_diameter if self.pitch_circle_diameter is None else self.pitch_circle_diameter

    @property
    def balls_per_turn(self) -> int:
        """Whole balls that find room in one turn."""
        phi = geometry.lead_angle(self.lead, self.ball_circle)
        return math.floor(math.pi * self.ball_circle / (self.ball_diameter * math.cos(phi)))

    @property
    def loaded_turns(self) -> Ratio:
        """Turns that carry load."""
        return self.turns - TURNS_WITHOUT_LOAD

    def screw(self, **changes: Any) -> BallScrew:
        """The screw of the row, with the loaded balls of one nut body; ``changes`` are fields of ``BallScrew``."""
        fields: dict[str, Any] = {
            "pitch_circle_diameter": self.ball_circle,
            "lead": self.lead,
            "ball_diameter": self.ball_diameter,
            "loaded_balls": max(1, round(self.balls_per_turn * self.loaded_turns)),
            "contact_angle": self.contact_angle,
            "screw_conformity": self.conformity,
            "nut_conformity": self.conformity,
            "starts": self.starts,
        }
        return BallScrew(**{**fields, **changes})


@functools.cache
def catalogue() -> Mapping[str, CatalogueRow]:
    """The rows shipped, by name (``data/screws.toml``)."""
    text = resources.files("ballscrew").joinpath("data/screws.toml").read_text(encoding="utf-8")
    return {name: CatalogueRow(name=name, **row) for name, row in tomllib.loads(text).items()}


def row(name: str) -> CatalogueRow:
    """The row of that name. Raises :class:`~ballscrew.faults.InputError` with the nearest one if there is none."""
    rows = catalogue()
    if name not in rows:
        raise InputError(Fault("catalogue", "unknown row", name, nearest(name, rows)))
    return rows[name]
