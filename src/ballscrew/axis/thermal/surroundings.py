"""The surroundings of a screw: where its heat goes. Most numbers are assumptions, and say so."""

from __future__ import annotations

import dataclasses
from typing import Annotated

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, faults_of, raise_if_any
from ballscrew.basis.quantities import Conductance, HeatTransfer, Info, Length, Mass, Ratio, Temperature

#: Air at 40 °C: kinematic viscosity m²/s, thermal conductivity W/(m K), Prandtl number; as recalled.
AIR_VISCOSITY, AIR_CONDUCTIVITY, AIR_PRANDTL = 17.0e-6, 0.0270, 0.706
#: How halves may be braced, and the sign with which the growth of the shaft between them adds to their preload.
BRACINGS = {"apart": -1.0, "together": 1.0}
#: How uncertain inputs of the surroundings are called, and those that may be uncertain: how heat flows, and not where
#: the screw is.
PREFIX = "surroundings."
VARIED = (
    "ambient", "nut_conductance", "nut_mass", "ball_conductance", "shaft_share", "shaft_convection", "coolant",
    "coolant_convection", "bearing_conductance", "bearing_mass", "shaft_to_bearing",
)  # fmt: skip
#: Convection of a body that does not move, W/(m² K): natural convection and radiation together, an assumption.
STILL = 9.0


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Surroundings(ByValue):
    """Ambient temperature, and the ways of heat out of the screw.

    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds, and for a bore without a coolant.
    """

    ambient: Annotated[
        Temperature,
        Info("T_a", "temperature of the surroundings", "degC", above=0, hint="20 degC", usual=(230.0, 340.0)),
    ] = 293.15
    nut_conductance: Annotated[
        Conductance,
        Info(
            "G_a",
            "heat from the nut to its surroundings, for each kelvin",
            "W/K",
            at_least=0,
            hint="2 W/K in air, 10 to 80 W/K bolted to a table or cooled",
            usual=(0, 1000),
        ),
    ] = 10.0
    nut_mass: Annotated[
        Mass | None,
        Info("m_n", "mass of nut and flange that warms up with it", "kg", above=0, hint="2 kg", usual=(1e-3, 500)),
    ] = None
    ball_conductance: Annotated[
        Conductance | None,
        Info(
            "G_b",
            "heat from nut to shaft through balls and grease, for each kelvin",
            "W/K",
            above=0,
            hint="1 to 6 W/K; the least known of all, computed where it is not given",
            usual=(0.01, 100),
        ),
    ] = None
    shaft_share: Annotated[
        Ratio,
        Info("s", "share of the friction heat that enters the shaft", at_least=0, at_most=1, hint="0.5: an assumption"),
    ] = 0.5
    shaft_convection: Annotated[
        HeatTransfer | None,
        Info(
            "h",
            "heat transfer of the shaft to the air",
            "W/(m^2 K)",
            at_least=0,
            hint="9 at rest, 40 to 80 at high speed; by the speed where it is not given",
            usual=(0, 1000),
        ),
    ] = None
    shaft_length: Annotated[
        Length | None, Info("L", "shaft between its bearings", "m", above=0, hint="1.2 m", usual=(0.02, 20))
    ] = None
    first_position: Annotated[
        Length | None,
        Info(
            "x_0", "distance of the nut from the fixed bearing where its motion starts", "mm", at_least=0, hint="200 mm"
        ),
    ] = None
    stroke: Annotated[
        Length | None,
        Info(
            "s",
            "way to and fro of a screw at one operating point",
            "mm",
            above=0,
            hint="half the shaft where it is not given",
            usual=(1e-5, 20.0),
        ),
    ] = None
    bore: Annotated[
        Length, Info("d_b", "diameter of a bore of the shaft", "mm", at_least=0, hint="0 mm for none", usual=(0, 0.3))
    ] = 0.0
    coolant: Annotated[
        Temperature | None, Info("T_c", "temperature of the coolant in the bore", "degC", above=0, hint="20 degC")
    ] = None
    coolant_convection: Annotated[
        HeatTransfer,
        Info(
            "h_c",
            "heat transfer to the coolant in the bore",
            "W/(m^2 K)",
            at_least=0,
            hint="500 to 3000: an assumption",
        ),
    ] = 1000.0
    bearing_conductance: Annotated[
        Conductance,
        Info(
            "G_L",
            "heat from each bearing to its housing's surroundings",
            "W/K",
            at_least=0,
            hint="5 to 20 W/K",
            usual=(0, 1000),
        ),
    ] = 8.0
    bearing_mass: Annotated[
        Mass, Info("m_L", "mass of each bearing with its housing", "kg", above=0, hint="3 kg", usual=(1e-3, 1000))
    ] = 3.0
    shaft_to_bearing: Annotated[
        Conductance,
        Info("G_s", "heat from the end of the shaft to its bearing", "W/K", at_least=0, hint="3 W/K", usual=(0, 1000)),
    ] = 3.0
    stretch: Annotated[
        Length | None,
        Info(
            "s_0",
            "stretch of a shaft that is pulled between two fixed ends",
            "um",
            at_least=0,
            hint="that of 3 K",
            usual=(0, 1e-3),
        ),
    ] = None

    #: How the halves of a preloaded nut are braced: pushed "apart" (a spacer, the usual way), pulled "together"; empty
    #: where it is not known, and then only the radial growth counts.
    bracing: str = ""

    def __post_init__(self) -> None:
        optional = (
            "nut_mass",
            "ball_conductance",
            "shaft_convection",
            "shaft_length",
            "first_position",
            "stroke",
            "coolant",
            "stretch",
        )
        faults = faults_of("surroundings", self, optional=optional)
        if self.bracing not in ("", *BRACINGS):
            remedy = f"write {' or '.join(BRACINGS)}, or leave it out"
            faults.append(Fault("surroundings.bracing", "unknown way of bracing", str(self.bracing), remedy))
        if self.coolant is not None and not self.bore:
            faults.append(Fault("surroundings.coolant", "has no bore to flow through", "", 'give bore = "12 mm"'))
        raise_if_any(faults)
