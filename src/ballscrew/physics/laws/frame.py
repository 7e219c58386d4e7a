"""The frame in which a ball rolls: the plane of a bearing, or the helix of a screw."""

from __future__ import annotations

import dataclasses

from ballscrew.basis.quantities import Angle, AngularSpeed, Length, Ratio, Speed
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, kinematics
from ballscrew.physics.laws.traits import law_traits


@dataclasses.dataclass(frozen=True, eq=False)
class Frame:
    """The geometric quantities through which the helix enters the equations."""

    lead_angle: Angle
    path_radius: Length
    curvature_ratio: Ratio
    rolling_plane_cosine: Ratio
    rolling_plane_sine: Ratio

    @property
    def screw_contact_radius(self) -> Length:
        """Lever of the tangential force at the screw."""
        return geometry.screw_contact_radius(self.path_radius, self.curvature_ratio)

    @property
    def nut_contact_radius(self) -> Length:
        """Lever of the tangential force at the nut."""
        return geometry.nut_contact_radius(self.path_radius, self.curvature_ratio)

    def entrainment_speed(self, screw_speed: AngularSpeed) -> Speed:
        """Mean surface speed at the contacts."""
        return kinematics.entrainment_speed(screw_speed, self.path_radius, self.curvature_ratio)


@law_traits(excluded="leaves the helix out: a known error, and no doubt")
def bearing_frame(screw: BallScrew) -> Frame:
    """The paper's: the balls roll as in a bearing, the helix angle is neglected (Olaru2005 §2)."""
    return _frame(screw, 0.0)


@law_traits(alternative=True)
def helix_frame(screw: BallScrew) -> Frame:
    """The balls roll along their helix; its osculating plane takes the place of the bearing's.

    With a lead of zero this is :func:`bearing_frame`.
    """
    return _frame(screw, screw.lead_angle)


def _frame(screw: BallScrew, lead_angle: Angle) -> Frame:
    d_m, d_w, alpha = screw.pitch_circle_diameter, screw.ball_diameter, screw.contact_angle
    return Frame(
        lead_angle=lead_angle,
        path_radius=geometry.path_radius(d_m, lead_angle),
        curvature_ratio=geometry.curvature_ratio(d_w, d_m, alpha, lead_angle),
        rolling_plane_cosine=geometry.rolling_plane_cosine(alpha, lead_angle),
        rolling_plane_sine=geometry.rolling_plane_sine(alpha, lead_angle),
    )
