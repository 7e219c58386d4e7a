"""Support bearings by the formulas of bearing makers, to hold against the contact core."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Annotated, Any

import numpy as np

from ballscrew.axis.supports import formulas
from ballscrew.axis.supports.bearing import (
    Bore,
    OutsideDiameter,
    PairPreload,
    Rows,
    SealTorque,
    faults_of_arrays,
    faults_of_sizes,
)
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, faults_of, raise_if_any, shown
from ballscrew.basis.quantities import Array, Force, Info, KinematicViscosity, Mask, Power, Ratio, Torque
from ballscrew.basis.records import Record
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.sizing.checks import loads_of_halves


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SKFConstants(ByValue):
    """Constants of a series of angular-contact ball bearings in the model of SKF2018, in its units."""

    rolling: Annotated[Ratio, Info("R_1", "constant of rolling", above=0)]
    axial_rolling: Annotated[Ratio, Info("R_2", "weight of the axial load in rolling", above=0)]
    sliding: Annotated[Ratio, Info("S_1", "constant of sliding", above=0)]
    axial_sliding: Annotated[Ratio, Info("S_2", "weight of the axial load in sliding", above=0)]
    centrifugal: Annotated[Ratio, Info("R_3", "constant of the centrifugal load", at_least=0)] = 0.0
    geometry: Annotated[Ratio, Info("K_Z", "constant of the type of bearing", above=0)] = 4.4

    def __post_init__(self) -> None:
        raise_if_any(faults_of("constants", self))


#: The series 72 B(E), single row, 40 degrees, of SKF2018. Its table was not at hand when this file was written, nor was
#: a worked example: the numbers are those that the page on validation has always compared with.
#: Its R_3 is not known here. A public program has 1.9e-12 for another series (unchecked, as it says); with that the
#: centrifugal load is 38 N at 3000 rpm and a mean diameter of 38.5 mm, and 890 N at 85 mm.
SERIES_72_B = SKFConstants(rolling=4.33e-7, axial_rolling=2.02, sliding=1.82e-2, axial_sliding=0.71)


@dataclasses.dataclass(frozen=True, eq=False)
class MakersFriction(ByValue):
    """Friction of a bearing or a guide by a formula, at an operating state or an array of them."""

    #: Torque (N m), or force of a guide (N), by mechanism.
    contributions: Mapping[str, Array]
    #: Speed of the shaft (rad/s), or along the rail (m/s).
    speed: Array

    @lazy
    def friction_effort(self) -> Array:
        """Friction torque about the shaft (N m), or force along the rail (N), its magnitude."""
        return np.sum(np.broadcast_arrays(*self.contributions.values()), axis=0)

    @property
    def friction_power(self) -> Power:
        """Power dissipated, W."""
        return self.friction_effort * np.abs(self.speed)

    @property
    def validity(self) -> Mapping[str, Mask]:
        """Mask: the numbers are finite. Formulas of makers state no other limits here."""
        return {"inputs": np.isfinite(self.friction_effort)}

    @property
    def warning_records(self) -> list[Record]:
        """A warning where a number is not finite."""
        if np.all(self.validity["inputs"]):
            return []
        message = "the friction is not a finite number somewhere: check load, speed and oil"
        return [Record.warning("validity.inputs", "inputs", message)]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SKFBearing(ByValue):
    """An angular-contact ball bearing by the maker's model of 2018: rolling and sliding moments, and the seals.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement`. The two sides of a preloaded pair carry
    the loads of two springs braced against each other (:func:`~ballscrew.physics.sizing.checks.loads_of_halves`), and
    the rows of one side share its load. Purely axial loads, without the drag of an oil bath. The constants are of the
    series 72 B(E) by default; those of bearings made for screws are not printed. In motion the boundary friction is
    0.12; at rest the torque is that of sliding alone.

    The centrifugal load of the balls needs the constant R_3, which is not known for the default series: it is left out
    there. With that of another series it adds 4 % to a 7205 and 29 % to a 7212 at 3000 rpm and 2 % of their ratings,
    3 % at most at 1000 rpm.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    bore: Bore
    outside_diameter: OutsideDiameter
    lubricant: Lubricant
    rows: Rows = 2
    preload: PairPreload = 0.0
    seal_torque: SealTorque = 0.0
    constants: SKFConstants = SERIES_72_B
    replenishment_constant: Annotated[
        Ratio, Info("K_rs", "replenishment", at_least=0, hint="3e-8 for oil of low level, 6e-8 for grease")
    ] = 3e-8
    boundary_friction_coefficient: Annotated[
        Ratio, Info(r"\mu_{bl}", "friction coefficient of the boundary film", at_least=0, hint="0.12 in motion")
    ] = 0.12
    film_friction_coefficient: Annotated[
        Ratio, Info(r"\mu_{EHL}", "friction coefficient of the oil film", at_least=0, hint="0.05 for mineral oils")
    ] = 0.05

    def __post_init__(self) -> None:
        raise_if_any(_faults("skf_bearing", self))

    def __call__(self, state: OperatingState, /) -> MakersFriction:
        """Friction at a state: the axial load (N), the speed (rad/s), the temperature (K).

        Raises :class:`~ballscrew.basis.errors.InputError` for a temperature of an oil without a grade.
        """
        nu, omega = _oil(self.lubricant, state), np.abs(state.screw_speed)
        d, D = self.bore, self.outside_diameter
        d_m, c = (d + D) / 2, self.constants
        heat = formulas.inlet_heating_factor(nu, omega, d_m)
        film = formulas.bearing_replenishment_factor(nu, omega, d, D, self.replenishment_constant, c.geometry)
        share = formulas.bearing_boundary_share(nu, omega, d_m)
        mu_0, mu_f = self.boundary_friction_coefficient, self.film_friction_coefficient
        F_g = formulas.bearing_centrifugal_load(omega, d_m, c.centrifugal)
        mu = formulas.bearing_sliding_coefficient(share, mu_0, mu_f)

        def rolling(load: Force) -> Torque:
            return heat * film * formulas.bearing_rolling_moment(load, F_g, nu, omega, d_m, c.rolling, c.axial_rolling)

        def sliding(load: Force) -> Torque:
            return formulas.bearing_sliding_moment(load, F_g, mu, d_m, c.sliding, c.axial_sliding)

        parts = {"rolling": _over_rows(self, state, rolling), "sliding": _over_rows(self, state, sliding)}
        return MakersFriction({**parts, "seals": self.seal_torque}, state.screw_speed)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PalmgrenBearing(ByValue):
    """A bearing by Palmgren's two moments, :math:`M_0 + M_1`, and its seals. Recalled: nothing takes it by default.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement`. The form is Harris2001's as recalled, and
    neither factor has a default: both are read in a maker's table for the type of bearing and the way it is lubricated.
    The load here is the axial one; what a table makes of it (1.4 times, for some bearings) belongs into
    ``load_factor``.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    bore: Bore
    outside_diameter: OutsideDiameter
    lubricant: Lubricant
    viscous_factor: Annotated[Ratio, Info("f_0", "factor of the moment without load", at_least=0, hint="of a table")]
    load_factor: Annotated[Ratio, Info("f_1", "factor of the moment by load", at_least=0, hint="of a table")]
    rows: Rows = 2
    preload: PairPreload = 0.0
    seal_torque: SealTorque = 0.0

    def __post_init__(self) -> None:
        raise_if_any(_faults("palmgren_bearing", self))

    def __call__(self, state: OperatingState, /) -> MakersFriction:
        """Friction at a state: the axial load (N), the speed (rad/s), the temperature (K)."""
        nu, d_m = _oil(self.lubricant, state), (self.bore + self.outside_diameter) / 2
        viscous = formulas.palmgren_viscous_moment(nu, np.abs(state.screw_speed), d_m, self.viscous_factor)
        by_load = _over_rows(self, state, lambda load: formulas.palmgren_load_moment(load, d_m, self.load_factor))
        parts = {"without load": self.rows * viscous, "by load": by_load, "seals": self.seal_torque}
        return MakersFriction(parts, state.screw_speed)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class KnownBearing(ByValue):
    """A bearing of one friction torque at all loads and speeds, as it was measured or as a catalogue prints it.

    A :class:`~ballscrew.physics.components.operating_state.FrictionElement`. Torques of catalogues are those of the
    preloaded bearing, often at the start and without a load; speed, load and temperature change them.
    Raises :class:`~ballscrew.basis.errors.InputError` for a negative torque.
    """

    torque: Annotated[
        Torque,
        Info("M_R", "friction torque of the bearing", "N m", at_least=0, hint="0.02 N m to 1 N m", usual=(0.0, 100.0)),
    ]

    def __post_init__(self) -> None:
        raise_if_any(faults_of("known_bearing", self))

    def __call__(self, state: OperatingState, /) -> MakersFriction:
        """Friction at a state, of which nothing counts."""
        return MakersFriction({"known": self.torque}, state.screw_speed)


def _faults(section: str, bearing: SKFBearing | PalmgrenBearing) -> list[Fault]:
    faults = faults_of(section, bearing)
    faults = faults or faults_of_arrays(section, bearing, "bore", "outside_diameter", "rows", "preload")
    if faults:
        return faults
    faults = faults_of_sizes(section, bearing)
    if bearing.rows == 1 and bearing.preload > 0:
        given = shown(bearing.preload, "N")
        faults.append(Fault(f"{section}.preload", "one row braces nothing", given, "give rows = 2"))
    return faults


def _oil(lubricant: Lubricant, state: OperatingState) -> KinematicViscosity:
    oil = lubricant if state.temperature is None else lubricant.at(state.temperature)
    return oil.viscosity / oil.density


def _over_rows(
    bearing: SKFBearing | PalmgrenBearing, state: OperatingState, of_row: Callable[[Force], Torque]
) -> Torque:
    """Sum over all rows of a moment that depends on the load of a row."""
    load: Any = np.abs(state.axial_load)
    beside = max(int(bearing.rows) // 2, 1)
    sides = (load,) if bearing.rows == 1 else loads_of_halves(DoubleNut(preload=bearing.preload), load)
    moments: list[Torque] = [beside * of_row(side / beside) for side in sides]
    return sum(moments[1:], moments[0])
