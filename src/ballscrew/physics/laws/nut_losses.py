"""Losses of a nut without load: vendors' laws of preload drag, and terms beside the loaded contacts.

The drag laws are whole torques of a preloaded nut without load, to hold against a computed one. The
parasitic laws are terms to add to the friction of the loaded balls, each on its own. By default each of
them is nothing: no open data gives a number for every nut.
"""
# ruff: noqa: D102  (laws of one slot share one signature, said once)

from __future__ import annotations

import dataclasses
import functools
import math
import tomllib
from importlib import resources
from typing import Annotated, NamedTuple, Protocol

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, accepts_units, faults_of, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Count, Density, Force, Info, Length, Ratio, Speed, Torque
from ballscrew.physics.components.materials import GRAVITY, STEEL_DENSITY, Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import ball_chain, geometry, kinematics, nut_losses, transmission
from ballscrew.physics.laws.ball_chain import WALL_FACTOR
from ballscrew.physics.laws.frame import helix_frame

#: Coefficients behind the no-load torques of Rexroth2006: their middle meets the tables within their digits.
DOUBLE_NUT_DRAG = 0.0040
OVERSIZE_BALL_DRAG = 0.0100

#: Shear in the gap to a ball that turns as the oil drives it, a quarter as fast and the other way, over that between
#: balls that turn alike. The moment on a sphere by its own turning is 1/5 and by its neighbour's 1/20 of one size
#: (JeffreyOnishi1984): (1/5 - 1/4/20) / 2 / (1/5 + 1/20).
FREE_SPACER = 3 / 8

#: Diameters and leads this close are one, in m: a table gives whole millimetres.
SAME_SIZE = 1e-6


class ParasiticLaw(Protocol):
    """Torque on the screw of something beside the loaded contacts."""

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed, /) -> Torque: ...


# -- drag of the preload --------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False)
class JISDrag(ByValue):
    """The rule of JISB1192 for all preloaded nuts, as THK514E prints it."""

    drag_coefficient: Annotated[Ratio, Info("k_p", "factor of the rule", at_least=0, hint="the standard has 0.05")] = (
        0.05
    )
    drag_exponent: Annotated[
        Ratio, Info("m", "exponent of the tangent of the lead angle", at_least=0, hint="the standard has 0.5")
    ] = 0.5

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.jis_drag", self))

    @accepts_units("losses")
    def __call__(
        self, preload_force: Force, nominal_diameter: Length, pitch_circle_diameter: Length, lead: Length
    ) -> Torque:
        """Drag torque, N m."""
        phi = geometry.lead_angle(lead, pitch_circle_diameter)
        K_p = nut_losses.preload_torque_coefficient(phi, self.drag_coefficient, self.drag_exponent)
        return nut_losses.preload_torque(K_p, preload_force, lead)


@dataclasses.dataclass(frozen=True, eq=False)
class RexrothDrag(ByValue):
    """The rule behind the tables of Rexroth2006, at 100 rpm; the lead does not count."""

    drag_coefficient: Annotated[
        Ratio,
        Info("c_p", "friction coefficient on the nominal diameter", at_least=0, hint="0.004, with oversize balls 0.01"),
    ] = DOUBLE_NUT_DRAG

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.rexroth_drag", self))

    @accepts_units("losses")
    def __call__(
        self, preload_force: Force, nominal_diameter: Length, pitch_circle_diameter: Length, lead: Length
    ) -> Torque:
        """Drag torque, N m."""
        return nut_losses.diameter_drag_torque(preload_force, nominal_diameter, self.drag_coefficient)


@dataclasses.dataclass(frozen=True, eq=False)
class EfficiencyDrag(ByValue):
    """The drag of a double nut from the efficiency of its halves, with the same friction torque in both."""

    efficiency: Annotated[
        Ratio, Info(r"\eta", "efficiency of one half at the preload", above=0, at_most=1, hint="0.85 to 0.97")
    ]

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.efficiency_drag", self))

    @accepts_units("losses")
    def __call__(
        self, preload_force: Force, nominal_diameter: Length, pitch_circle_diameter: Length, lead: Length
    ) -> Torque:
        """Drag torque, N m."""
        eta_b = transmission.back_driving_efficiency(self.efficiency)
        K_p = nut_losses.preload_torque_coefficient_of_halves(self.efficiency, eta_b)
        return nut_losses.preload_torque(K_p, preload_force, lead)


# -- seals ----------------------------------------------------------------------------------------


class SealRow(NamedTuple):
    """Torque of the two standard seals of a vendor's nut; leads from the smallest to the largest."""

    nominal_diameter: float
    smallest_lead: float
    largest_lead: float
    torque: float

    def distance(self, nominal_diameter: float, lead: float) -> tuple[float, float]:
        """Distance of a screw from the row, in diameter and in lead."""
        outside = max(self.smallest_lead - lead, lead - self.largest_lead, 0.0)
        return abs(nominal_diameter - self.nominal_diameter), outside

    def __str__(self) -> str:
        diameter = f"{self.nominal_diameter * 1e3:g} mm"
        if math.isinf(self.largest_lead):
            return f"{diameter}, any lead"
        first, last = self.smallest_lead * 1e3, self.largest_lead * 1e3
        return f"{diameter}, lead {first:g} mm" + (f" to {last:g} mm" if last > first else "")


#: Whose standard seals the table has, in small letters, and its source.
SEAL_MAKER, SEAL_SOURCE = "rexroth", "Rexroth2006"


@functools.cache
def seal_table() -> tuple[SealRow, ...]:
    """The rows shipped (``data/seals.toml``, Rexroth2006)."""
    text = resources.files("ballscrew").joinpath("data/seals.toml").read_text(encoding="utf-8")
    rows: list[SealRow] = []
    for row in tomllib.loads(text)["seals"]:
        smallest, largest = row.get("leads", (0.0, math.inf))
        rows.append(SealRow(row["nominal_diameter"], smallest, largest, row["torque"]))
    return tuple(rows)


@dataclasses.dataclass(frozen=True, eq=False)
class Seals(ByValue):
    """Seals whose torque is known: measured, or a vendor's.

    Raises :class:`~ballscrew.basis.errors.InputError` for a negative torque.
    """

    seal_torque: Annotated[
        Torque,
        Info(
            "M_W",
            "torque of all seals of the nut",
            at_least=0,
            hint="rubber: 0.08 N m at 16 mm, 0.4 N m at 40 mm (Seals.of_table)",
            usual=(0.0, 50.0),
        ),
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.seals", self))

    @classmethod
    @accepts_units("losses.seals")
    def of_table(cls, nominal_diameter: Length, lead: Length) -> Seals:
        """The two standard seals of Rexroth2006, by ``nominal_diameter`` and ``lead``, m.

        Raises :class:`~ballscrew.basis.errors.InputError` with the nearest row for a screw that the table does not
        have.
        """
        result = min(seal_table(), key=lambda row: row.distance(nominal_diameter, lead))
        if not all(distance <= SAME_SIZE for distance in result.distance(nominal_diameter, lead)):
            given = f"{nominal_diameter * 1e3:g} mm, lead {lead * 1e3:g} mm"
            raise InputError(Fault("losses.seals", "not in the table of seal torques", given, f"nearest: {result}"))
        return cls(seal_torque=result.torque)

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque of the seals, N m; the same for any ``screw`` and ``lubricant``, and at any ``screw_speed``."""
        return self.seal_torque


@dataclasses.dataclass(frozen=True, eq=False)
class LipSeals(ByValue):
    """Seals whose lips rub all around the screw, on its pitch circle."""

    lip_friction: Annotated[
        nut_losses.LineForce,
        Info(
            "q",
            "friction force on each length of lip",
            at_least=0,
            hint="rubber has 61 N/m to 109 N/m",
            usual=(0.0, 2000.0),
        ),
    ] = 0.0
    lips: Annotated[
        Count, Info("n_l", "number of sealing lips", at_least=0, whole=True, hint="one at each end of the nut: 2")
    ] = 2

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.lip_seals", self))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque of the seals, N m; the same at any speed."""
        return nut_losses.seal_torque(self.lips, self.lip_friction, screw.pitch_circle_diameter)


@dataclasses.dataclass(frozen=True, eq=False)
class ConstantTorque(ByValue):
    """Friction that is the same at all loads and speeds, as a fit finds it: of seals, wipers and what else there is."""

    constant_torque: Annotated[
        Torque,
        Info("M_0", "friction torque at all loads and speeds", hint="what a fit found", usual=(0.0, 50.0)),
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.constant", self))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m."""
        return self.constant_torque


# -- oil and returns ------------------------------------------------------------------------------

OilShare = Annotated[
    Ratio,
    Info(
        "X",
        "share of the space around the balls that is oil",
        at_least=0,
        at_most=1,
        hint="1 if the nut is full of oil; no measured value is known for less",
    ),
]
MovingBalls = Annotated[
    Count | None,
    Info("z_m", "balls that move through the oil", at_least=0, whole=True, hint="all bodies of the nut and returns"),
]


@dataclasses.dataclass(frozen=True, eq=False)
class Churning(ByValue):
    """Oil in the way of the balls: the drag of single spheres, SchillerNaumann1933.

    Without a number of balls the loaded balls of the screw it is called with count; a nut calls it with all its balls.
    """

    oil_share: OilShare = 0.0
    balls: MovingBalls = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.churning", self, optional=("balls",)))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m."""
        eta_0, d_w, v_o = lubricant.viscosity, screw.ball_diameter, _orbital_speed(screw, screw_speed)
        R_e = nut_losses.ball_reynolds_number(lubricant.density, v_o, d_w, eta_0)
        force = nut_losses.ball_drag_force(self.oil_share, eta_0, d_w, v_o, R_e)
        return nut_losses.path_torque(_balls(self.balls, screw), force, _path_advance(screw))


@dataclasses.dataclass(frozen=True, eq=False)
class HarrisChurning(ByValue):
    """Oil in the way of the balls as bearings have it at high speed, Harris2001; thin oil only.

    Without a number of balls the loaded balls of the screw it is called with count; a nut calls it with all its balls.
    """

    oil_share: OilShare = 0.0
    drag_coefficient: Annotated[
        Ratio, Info("C_v", "drag coefficient of a ball", at_least=0, hint="a sphere has 0.44 in turbulent flow")
    ] = 0.44
    balls: MovingBalls = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.churning", self, optional=("balls",)))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m."""
        v_o = _orbital_speed(screw, screw_speed)
        force = nut_losses.ball_drag_force_harris(
            self.oil_share, self.drag_coefficient, lubricant.density, screw.ball_diameter, v_o
        )
        return nut_losses.path_torque(_balls(self.balls, screw), force, _path_advance(screw))


@dataclasses.dataclass(frozen=True, eq=False)
class Recirculation(ByValue):
    """The return of the balls: a force that the screw must push the train of balls with, through each return."""

    return_force: Annotated[
        Force,
        Info(
            "F_r",
            "force against the balls in one return",
            at_least=0,
            hint="no measured value is known",
            usual=(0.0, 1000.0),
        ),
    ] = 0.0
    returns: Annotated[
        Count, Info("n_r", "number of returns", at_least=0, whole=True, hint="one for each circuit of balls")
    ] = 1

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.recirculation", self))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m; the same at any speed."""
        return nut_losses.path_torque(self.returns, self.return_force, _path_advance(screw))


BallDensity = Annotated[
    Density,
    Info(
        r"\rho_b",
        "density of the balls",
        above=0,
        hint="steel has 7850 kg/m^3, silicon nitride 3200 kg/m^3",
        usual=(2000.0, 20000.0),
    ),
]


@dataclasses.dataclass(frozen=True, eq=False)
class ReturnBraking(ByValue):
    """The return of the balls by mechanics: the loaded balls push those in the return, by their weight and through oil.

    Without a number of balls in a return it is nothing. The factor of the wall is an assumption, to a factor of three.
    """

    return_balls: Annotated[
        Count,
        Info(
            "N_r",
            "balls in one return, between its last and its first loaded ball",
            at_least=0,
            whole=True,
            hint="a deflector over one turn: 4 to 8; a tube over three turns: 20 to 40",
        ),
    ] = 0
    wall_factor: Annotated[
        Ratio,
        Info(
            "k_w",
            "drag of a ball in the return over that of a ball far from walls",
            at_least=0,
            hint="of order 10; no measured value is known",
            usual=(1.0, 100.0),
        ),
    ] = WALL_FACTOR
    return_friction: Annotated[
        Ratio, Info(r"\mu_r", "friction coefficient of balls on the wall", at_least=0, hint="0.1", usual=(0.0, 1.0))
    ] = 0.1
    returns: Annotated[
        Count, Info("n_r", "number of returns", at_least=0, whole=True, hint="one for each circuit of balls")
    ] = 1
    ball_density: BallDensity = STEEL_DENSITY

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.recirculation", self))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m."""
        force = self.force(screw, lubricant, screw_speed)
        return nut_losses.path_torque(self.returns, force, _path_advance(screw))

    def force(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Force:
        """Force against the balls in one return, N."""
        d_w, v_o = screw.ball_diameter, _orbital_speed(screw, screw_speed)
        mass = ball_chain.ball_mass(d_w, self.ball_density)
        of_ball = ball_chain.return_resistance(
            self.return_friction, mass, GRAVITY, lubricant.viscosity, d_w, v_o, self.wall_factor
        )
        return self.return_balls * of_ball


@dataclasses.dataclass(frozen=True, eq=False)
class ShearedOil(ByValue):
    """Oil between neighbours, whose surfaces pass each other in the gap (JeffreyOnishi1984); nothing without oil.

    Without a number of balls the loaded balls of the screw it is called with count; a nut calls it with all its balls.
    A spacer ball that turns as the oil drives it leaves three eighths of the shear in each of its gaps.
    """

    oil_share: OilShare = 0.0
    oil_gap: Annotated[
        Length,
        Info(
            "h",
            "gap between neighbours",
            "um",
            above=0,
            hint="what is left of a circuit, over its balls: 10 um to 100 um",
            usual=(1e-7, 1e-2),
        ),
    ] = 5e-5
    balls: MovingBalls = None

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.sheared_oil", self, optional=("balls",)))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m."""
        frame, d_w = helix_frame(screw), screw.ball_diameter
        i_b = nut_losses.ball_turns(frame.path_radius, frame.curvature_ratio, d_w)
        gaps = self.oil_share * _balls(self.balls, screw) * (FREE_SPACER if screw.nut.spacer_balls else 1)
        return nut_losses.sheared_oil_torque(gaps, lubricant.viscosity, d_w, self.oil_gap, i_b, screw_speed)


@dataclasses.dataclass(frozen=True, eq=False)
class SpinUp(ByValue):
    """Balls that come out of the return without spin, and are spun up by sliding contacts; nothing without entries."""

    entries: Annotated[
        Count, Info("n_e", "places where balls enter", at_least=0, whole=True, hint="one for each circuit of balls")
    ] = 0
    lost_speed: Annotated[
        Ratio,
        Info(
            r"\sigma",
            "share of their speed that balls lose in the return",
            at_least=0,
            at_most=1,
            hint="0 without impacts, 1 for balls that are stopped",
        ),
    ] = 0.0
    ball_density: BallDensity = STEEL_DENSITY

    def __post_init__(self) -> None:
        raise_if_any(faults_of("losses.spin_up", self))

    def __call__(self, screw: BallScrew, lubricant: Lubricant, screw_speed: AngularSpeed) -> Torque:
        """Torque on the screw, N m; the same with any ``lubricant``."""
        frame, d_w = helix_frame(screw), screw.ball_diameter
        surface_speed = frame.entrainment_speed(screw_speed)  # of a ball that rolls: ω_b d_w/2
        mass = ball_chain.ball_mass(d_w, self.ball_density)
        work = nut_losses.entry_work(mass, _orbital_speed(screw, screw_speed), surface_speed, self.lost_speed)
        return nut_losses.entry_torque(self.entries, work, _path_advance(screw), d_w)


def _balls(balls: Count | None, screw: BallScrew) -> Count:
    return screw.loaded_balls if balls is None else balls


def _path_advance(screw: BallScrew) -> Length:
    frame = helix_frame(screw)
    return nut_losses.path_advance(frame.path_radius, frame.curvature_ratio)


def _orbital_speed(screw: BallScrew, screw_speed: AngularSpeed) -> Speed:
    frame = helix_frame(screw)
    rotation = kinematics.orbital_rotation(frame.entrainment_speed(screw_speed), frame.nut_contact_radius)
    return kinematics.orbital_speed(rotation, frame.path_radius)
