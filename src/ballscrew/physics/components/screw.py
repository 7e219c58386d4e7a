"""The ball screw: its geometry, its surfaces and its materials."""

from __future__ import annotations

import dataclasses
import math
from typing import Annotated, Any, cast

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, as_array, namespace
from ballscrew.basis.errors import Fault, faults_of, is_concrete, names_keywords, raise_if_any, shown
from ballscrew.basis.quantities import Angle, Count, Force, Info, Length, Mask, Pressure, Quantity, Ratio
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE, Written, warn_at_once
from ballscrew.physics.components.materials import Material
from ballscrew.physics.components.nut import PRELOAD, Nut, NutParts, SingleNut
from ballscrew.physics.equations import geometry, hertz, life

#: With this conformity the formulas of ISO3408-5 give the ratings of catalogues (HIWIN2016), whose grooves have 0.54.
RATING_CONFORMITY = 0.52
#: Shares of the dynamic load rating that no preload of a nut lies outside of. Makers give 2 to 10 % (Rexroth2006); the
#: ends leave room for the lightest classes, and for ratings of a geometry that is known roughly.
PRELOAD_SHARES = (1e-3, 1.0)
_RATING = Quantity("dynamic_load_rating", "N", Info("C_a", "dynamic load rating", "kN"))
_PRELOAD = Quantity("preload", "N", PRELOAD)


def dynamic_load_rating(
    ball_circle: Length,
    ball_diameter: Length,
    contact_angle: Angle,
    lead_angle: Angle,
    balls_per_turn: Count,
    loaded_turns: Ratio,
    conformity: Ratio = RATING_CONFORMITY,
) -> Force:
    """Dynamic axial load rating by the geometry, of balls that carry (ISO3408-5, as recalled)."""
    # the standard leaves the lead out of the curvature
    gamma = geometry.curvature_ratio(ball_diameter, ball_circle, contact_angle, lead_angle=0.0)
    f_c = life.geometry_factor(life.contact_angle_factor(contact_angle), life.curvature_factor(gamma), conformity)
    C_s = life.screw_turn_rating(f_c, contact_angle, balls_per_turn, ball_diameter, lead_angle)
    C_i = life.turn_rating(C_s, life.turn_rating_ratio(gamma, conformity, conformity))
    return life.dynamic_load_rating(C_i, loaded_turns)


def rating_of(screw: Any) -> Force:
    """Dynamic axial load rating of one nut body of a ball screw by its geometry; NaN where there is none."""
    d_m, d_w, phi = (as_array(v) for v in (screw.pitch_circle_diameter, screw.ball_diameter, screw.lead_angle))
    with np.errstate(all="ignore"):
        in_a_turn = np.floor(np.pi * d_m / d_w / np.cos(phi))
        carrying = in_a_turn * screw.carrying_balls / screw.loaded_balls
        turns = screw.loaded_balls / in_a_turn
        return dynamic_load_rating(d_m, d_w, screw.contact_angle, phi, carrying, turns)


def is_odd_preload(preload: Force, rating: Force) -> Mask:
    """Mask: a preload that no nut with this dynamic load rating has; no preload at all is fine. Elementwise."""
    share, (low, high) = preload / rating, PRELOAD_SHARES
    return (preload > 0) & namespace(share).isfinite(share) & ((share < low) | (share > high))


def odd_preload(screw: Any, written: Written = units.shown) -> list[Record]:
    """A warning of a preload that no nut with the dynamic load rating of a ball screw has; of arrays the farthest out.

    No preload at all is fine.
    """
    preload = getattr(screw.nut, "preload", None)
    if preload is None:
        return []
    preloads, ratings = np.broadcast_arrays(np.asarray(preload, float), rating_of(screw))
    with np.errstate(all="ignore"):
        shares = preloads / ratings
        low, high = PRELOAD_SHARES
        odd = is_odd_preload(preloads, ratings)
        if not odd.any():
            return []
        at = int(np.argmax(np.where(odd, np.maximum(low / shares, shares / high), 0.0)))
    share = float(shares.flat[at])
    message = (
        f"preload {written(preloads.flat[at], _PRELOAD)} is {units.number(100 * share, 2)} % of the dynamic load "
        f"rating {written(ratings.flat[at], _RATING)}, computed from the geometry; nuts have 2 % to 10 %: check the "
        "number and its unit"
    )
    return [Record.warning(IMPLAUSIBLE, "nut.preload", message, value=share, limit=high if share > high else low)]


STEEL = Material()
SINGLE_NUT = SingleNut()
#: The fields of a screw that are materials.
MATERIALS = ("ball_material", "screw_material", "nut_material")


@dataclasses.dataclass(frozen=True, eq=False)
class Raceway(ByValue):
    """One side of the screw as the ball sees it."""

    conformity: Ratio
    roughness: Length
    material: Material


@names_keywords
@dataclasses.dataclass(frozen=True, eq=False)
class BallScrew(ByValue):
    """A ball screw: shaft, nut and balls (ISO 3408-1).

    Without a ``nut`` it has a single one without preload, rigid: a row of equal balls, each of which touches one flank
    of screw and nut. Of a double nut the loaded balls are those of one half.
    Raises :class:`~ballscrew.basis.errors.InputError` (a ``ValueError``) with one fault for each value
    out of bounds, and for a ball too big for the pitch circle or for the lead.
    """

    pitch_circle_diameter: Annotated[
        Length,
        Info(
            "d_m",
            "diameter of the helix of the ball centres",
            "mm",
            above=0,
            hint="lengths are positive",
            usual=(1e-3, 0.5),
        ),
    ]
    lead: Annotated[
        Length,
        Info("P_h", "advance of the nut in one turn", "mm", above=0, hint="lengths are positive", usual=(2e-4, 0.5)),
    ]
    ball_diameter: Annotated[
        Length, Info("d_w", "ball diameter", "mm", above=0, hint="lengths are positive", usual=(2e-4, 0.06))
    ]
    loaded_balls: Annotated[
        Count,
        Info(
            "z",
            "number of balls that carry load, any spacer balls between them counted, too",
            at_least=1,
            at_most=10_000,
            whole=True,
            hint="give a whole number, 1 to 10000",
            usual=(1, 2000),
        ),
    ]
    contact_angle: Annotated[
        Angle,
        Info(
            r"\alpha",
            "angle of the contact normal against the radial plane",
            "deg",
            above=0,
            below=math.pi / 2,
            hint='angles lie between 0 and 90 deg; in a file write "45 deg", in Python math.radians(45)',
            usual=(math.radians(20), math.radians(70)),
        ),
    ]
    screw_conformity: Annotated[
        Ratio,
        Info(
            "f_s",
            "screw groove radius / ball diameter",
            above=0.5,
            at_most=1,
            hint="grooves have 0.515 to 0.54",
            usual=(0.505, 0.65),
        ),
    ]
    nut_conformity: Annotated[
        Ratio,
        Info(
            "f_n",
            "nut groove radius / ball diameter",
            above=0.5,
            at_most=1,
            hint="grooves have 0.515 to 0.54",
            usual=(0.505, 0.65),
        ),
    ]
    ball_roughness: Annotated[
        Length,
        Info(
            r"\sigma_b",
            "RMS roughness of the balls",
            "um",
            above=0,
            hint="balls have 0.02 um to 0.1 um",
            usual=(1e-9, 2e-6),
        ),
    ] = 0.08e-6
    screw_roughness: Annotated[
        Length,
        Info(
            r"\sigma_s",
            "RMS roughness of the screw race",
            "um",
            above=0,
            hint="ground races have 0.2 um to 0.4 um",
            usual=(5e-9, 1e-5),
        ),
    ] = 0.3e-6
    nut_roughness: Annotated[
        Length,
        Info(
            r"\sigma_n",
            "RMS roughness of the nut race",
            "um",
            above=0,
            hint="ground races have 0.2 um to 0.4 um",
            usual=(5e-9, 1e-5),
        ),
    ] = 0.3e-6
    starts: Annotated[
        Count,
        Info(
            "N", "number of thread starts", at_least=1, whole=True, hint="give a whole number, 1 or more", usual=(1, 12)
        ),
    ] = 1
    #: Elastic constants of the balls.
    ball_material: Material = STEEL
    #: Elastic constants of the screw.
    screw_material: Material = STEEL
    #: Elastic constants of the nut.
    nut_material: Material = STEEL
    nut: Nut = SINGLE_NUT

    def __post_init__(self) -> None:
        faults = faults_of("screw", self)
        faults += [
            Fault(f"screw.{name}", "must be a Material", repr(material), "give ballscrew.Material(young_modulus=…)")
            for name, material in zip(MATERIALS, cast("tuple[Any, ...]", self.materials), strict=True)
            if not isinstance(material, Material)
        ]
        if not isinstance(cast("Any", self.nut), NutParts):
            faults.append(Fault("screw.nut", "must be a nut", repr(self.nut), "give ballscrew.DoubleNut(preload=…)"))
        raise_if_any(faults)
        raise_if_any(self._misfits())
        warn_at_once("screw", self, odd_preload)

    def _misfits(self) -> list[Fault]:
        """Faults between fields that are fine one by one."""
        if self.nut.spacer_balls and is_concrete(self.loaded_balls) and self.loaded_balls < 2:
            remedy = "count the spacer balls, too: 2 or more"
            given = f"{self.loaded_balls:g}"
            return [Fault("screw.loaded_balls", "leaves no ball beside the spacer", given, remedy)]
        sizes = (self.pitch_circle_diameter, self.ball_diameter, self.lead, self.starts)
        if not all(map(is_concrete, sizes)) or self.fits:
            return []
        where, given = "screw.ball_diameter", shown(self.ball_diameter, "m")
        if self.ball_diameter < self._room_in_the_circle:
            problem = "too big for the lead: balls of neighbouring turns overlap"
            room = float(self._room_in_the_lead)
            remedy = f"keep it below lead · cos(lead angle) / starts = {shown(room, 'm')}"
            return [Fault(where, problem, given, remedy, bound=room)]
        room = float(self._room_in_the_circle)
        remedy = f"keep it below half the pitch circle diameter, {shown(room, 'm')}"
        return [Fault(where, "too big for the pitch circle", given, remedy, bound=room)]

    @property
    def materials(self) -> tuple[Material, Material, Material]:
        """The materials of balls, screw and nut."""
        return self.ball_material, self.screw_material, self.nut_material

    @property
    def fits(self) -> Mask:
        """Faults of balls without room in the pitch circle or between neighbouring turns."""
        return (self.ball_diameter < self._room_in_the_circle) & (self.ball_diameter < self._room_in_the_lead)

    @property
    def _room_in_the_circle(self) -> Length:
        return self.pitch_circle_diameter / 2

    @property
    def _room_in_the_lead(self) -> Length:
        return self.lead / self.starts * namespace(self.lead_angle).cos(self.lead_angle)

    @property
    def lead_angle(
        self,
    ) -> Annotated[
        Angle,
        Info(
            r"\varphi",
            "lead angle of the helix of the ball centres",
            "deg",
            usual=(math.radians(0.2), math.radians(55)),
        ),
    ]:
        """Lead angle of the helix of the ball centres."""
        return geometry.lead_angle(self.lead, self.pitch_circle_diameter)

    @property
    def relative_ball_diameter(
        self,
    ) -> Annotated[Ratio, Info("d_w/d_m", "ball diameter / pitch circle diameter", usual=(0.02, 0.4))]:
        """Ball diameter over pitch circle diameter."""
        return self.ball_diameter / self.pitch_circle_diameter

    @property
    def groove_pitch(
        self,
    ) -> Annotated[
        Ratio,
        Info("P_h/(N d_w)", "distance of neighbouring grooves / ball diameter, by lead and starts", usual=(1.0, 12.0)),
    ]:
        """Distance of neighbouring grooves along the screw, in ball diameters: shipped rows have 1.3 to 7."""
        return self.lead / self.starts / self.ball_diameter

    @property
    def loaded_turns(self) -> Annotated[Ratio, Info("i_l", "turns that the loaded balls fill", usual=(0.02, 20.0))]:
        """Turns that the loaded balls fill, one touching the next, on a path without slope."""
        return self.loaded_balls * self.ball_diameter / (math.pi * self.pitch_circle_diameter)

    @property
    def carrying_balls(self) -> Annotated[Ratio, Info("z_c", "balls that carry load, without spacer balls")]:
        """Balls that carry load: all loaded balls, or half of them where every second one is a spacer.

        An odd number has no half: as balls enter and leave, one more and one less carry in turn, and this is the mean.
        """
        return self.loaded_balls / 2 if self.nut.spacer_balls else self.loaded_balls

    @property
    def screw_raceway(self) -> Raceway:
        """The groove of the screw."""
        return Raceway(self.screw_conformity, self.screw_roughness, self.screw_material)

    @property
    def nut_raceway(self) -> Raceway:
        """The groove of the nut."""
        return Raceway(self.nut_conformity, self.nut_roughness, self.nut_material)

    def equivalent_modulus(self, raceway: Raceway) -> Pressure:
        """Equivalent modulus of ball and race, Pa; ``raceway`` is the groove of the screw or of the nut."""
        ball, race = self.ball_material, raceway.material
        return hertz.equivalent_modulus(ball.young_modulus, ball.poisson_ratio, race.young_modulus, race.poisson_ratio)
