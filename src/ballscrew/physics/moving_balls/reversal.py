"""Friction over the angle of the screw after a reversal, or from rest."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.quantities import Angle, Array, Length, Torque

#: The parts of the torque after a reversal, by how they come back.
MECHANISMS: Mapping[str, str] = {
    "rolling": "rolling resistance, at once",
    "spin_and_curvature": "spin and curvature slip, within the contacts",
    "helix": "helix slip, as the balls roll across their grooves",
    "ball_to_ball": "ball to ball and return, as the gaps close",
    "losses": "losses of the nut, at once",
}


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Reversal:
    """Friction over the angle that the screw has turned since it reversed, or since it started."""

    #: Angle of the screw since then, rad, increasing from zero.
    screw_angle: Angle
    #: Travel of the nut since then, m.
    travel: Length
    #: Friction torque against the new direction, N m: from minus the steady torque (zero from rest) to plus it.
    screw_torque: Torque
    #: Its parts by mechanism, N m; they sum to it.
    contributions: Mapping[str, Array]
    #: The friction torque of steady motion, N m, which it goes to, and its parts.
    steady_torque: Torque
    steady_contributions: Mapping[str, Torque]
    #: How far the balls lie off the line of their grooves, m; of the half that carries the load first.
    displacement: Any
    from_rest: bool
