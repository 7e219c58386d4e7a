"""Geometry of the drawing (:mod:`~ballscrew.faces.report.drawing`): a ball, its flanks, the slip at the screw."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.equations import kinematics, slip
from ballscrew.physics.laws.traits import traits_of
from ballscrew.questions.run.compute import Run, Touching

Field = NDArray[np.float64]
#: Heights across the ellipse at which the slip is asked for a change of sign.
_HEIGHTS = 4001
#: Places along and across the ellipse where the largest slip is looked for.
_PLACES = 181

AT_REST = "At rest nothing slips: neither arrows nor lines of pure rolling."
NO_LOAD = "Without load ball and grooves have no contact area: neither ellipse nor slip."
NO_NUMBER = "No contact is drawn: what came out is no number here."
NO_SLIP = "No slip is drawn: what came out is no number here."
FOUR_CONTACTS = "The slip on four contacts is not drawn: the result keeps the power that is lost in it, not its speeds."


@dataclasses.dataclass(frozen=True)
class SlipField:
    """Slip of the screw's surface over the ball as the screw drives, in the ellipse as it is seen from the ball; m/s.

    Heights t are across the path in units of a, positive where the groove is farther from the axis of the screw; places
    x along the path are in units of a, too, positive the way the screw's surface goes.
    """

    creep: float
    spin_rim: float
    lateral: float
    curvature: float
    semi_major_axis: float
    deformed_radius: float
    #: The model knows the slip along the path only.
    along_only: bool
    #: Half the distance of the lines of pure rolling where curvature is the only slip.
    offset: float | None
    entrainment_speed: float
    rolling_radius: float

    def along(self, height: Any) -> Any:
        """Slip along the path."""
        a = self.semi_major_axis
        if self.offset is not None:
            # Olaru2005 has the slip of the ball against the race
            return -kinematics.curvature_sliding_speed(
                self.entrainment_speed, self.rolling_radius, self.deformed_radius, height * a, self.offset * a
            )
        depth = slip.surface_depth(height, a, self.deformed_radius)
        return slip.path_slip_speed(self.creep, self.spin_rim, self.curvature, height, depth)

    def across(self, height: Any, place: Any) -> Any:
        """Slip across the path, positive towards greater heights."""
        if self.along_only:
            return 0.0 * (height + place)
        turn = slip.local_spin_speed(self.spin_rim, self.curvature, height)
        # a screw that drives is dragged towards the edge of its groove, one that is driven towards the bottom
        return slip.across_slip_speed(self.lateral, turn, place)

    @property
    def lines(self) -> list[float]:
        """Heights at which nothing slips along the path."""
        if self.offset is not None:
            return sorted({-self.offset, self.offset}) if 0 <= self.offset <= 1 else []
        t = np.linspace(-1, 1, _HEIGHTS)
        s = self.along(t)
        places = np.flatnonzero(np.sign(s[:-1]) * np.sign(s[1:]) < 0)
        between = [t[i] + (t[i + 1] - t[i]) * s[i] / (s[i] - s[i + 1]) for i in places]
        return sorted([*map(float, between), *map(float, t[s == 0])])

    def largest(self, axes_ratio: float) -> float:
        """Largest slip in the ellipse whose axes have the ratio b/a."""
        t, height = np.meshgrid(np.linspace(-1, 1, _PLACES), np.linspace(-1, 1, _PLACES))
        x = height * axes_ratio * np.sqrt(1 - t**2)
        return float(np.max(np.hypot(self.along(t), self.across(t, x))))


@dataclasses.dataclass(frozen=True)
class DrawnContact:
    """The contact of ball and screw, on the pair of flanks that carries the most."""

    semi_major_axis: float
    semi_minor_axis: float
    #: The semi-major axis at the nut.
    on_nut: float
    maximum_pressure: float
    #: None where there is none, or none that is known.
    slip: SlipField | None
    #: Why a part of the picture is missing; empty where none is.
    missing: str

    @property
    def axes_ratio(self) -> float:
        """b/a."""
        return self.semi_minor_axis / self.semi_major_axis


@dataclasses.dataclass(frozen=True)
class DrawnBall:
    """One ball between its grooves."""

    ball_diameter: float
    screw_conformity: float
    nut_conformity: float
    flanks: Sequence[Touching]
    #: None where nothing presses.
    contact: DrawnContact | None
    #: Why there is no contact.
    missing: str
    #: One of many balls with loads of their own.
    most_loaded: bool

    @property
    def load(self) -> float:
        """Load of the pair of flanks that carries the most."""
        return max(flank.load for flank in self.flanks)


def drawn_ball(run: Run) -> DrawnBall:
    """The ball of a run; of a nut the one with the greatest load."""
    screw, sides = run.case.screw, run.contacts
    contact, missing = _contact(run, run.touching, sides["screw"], sides["nut"]["semi_major_axis"])
    return DrawnBall(
        float(screw.ball_diameter),
        float(screw.screw_conformity),
        float(screw.nut_conformity),
        run.touching,
        contact,
        missing,
        run.nut is not None,
    )


def _contact(
    run: Run, flanks: Sequence[Touching], side: Mapping[str, float], on_nut: float
) -> tuple[DrawnContact | None, str]:
    a, b, pressure = (side[name] for name in ("semi_major_axis", "semi_minor_axis", "maximum_pressure"))
    if all(flank.load == 0 for flank in flanks):
        return None, NO_LOAD
    if not all(map(math.isfinite, (a, b, pressure))) or min(a, b) <= 0:
        return None, NO_NUMBER
    field, missing = _slip(run, flanks, side)
    return DrawnContact(a, b, on_nut, pressure, field, missing), ""


def _slip(run: Run, flanks: Sequence[Touching], side: Mapping[str, float]) -> tuple[SlipField | None, str]:
    case, omega = run.case, float(run.case.operation.screw_speed)
    if omega == 0:
        return None, AT_REST
    if "creep_speed" not in side or isinstance(case.nut, OversizeBallNut):
        return None, FOUR_CONTACTS
    flank = max(flanks, key=lambda flank: flank.load)
    at_angle = dataclasses.replace(case.screw, contact_angle=flank.angle)
    v, R_x = float(case.model.frame(at_angle).entrainment_speed(omega)), side["rolling_radius"]
    a, R_d = side["semi_major_axis"], side["deformed_radius"]
    of_slip = traits_of(case.model.slip)
    field = SlipField(
        creep=side["creep_speed"],
        spin_rim=side["spin"] * a,
        lateral=side["lateral_slip_speed"],
        curvature=float(slip.curvature_slip_speed(a, R_d, v / R_x)),
        semi_major_axis=a,
        deformed_radius=R_d,
        along_only=not of_slip.lateral_slip,
        offset=side["pure_rolling_offset"] if of_slip.curvature_alone else None,
        entrainment_speed=v,
        rolling_radius=R_x,
    )
    numbers = (
        field.creep,
        field.spin_rim,
        field.lateral,
        field.curvature,
        0.0 if field.offset is None else field.offset,
    )
    return (field, "") if all(map(math.isfinite, numbers)) else (None, NO_SLIP)
