"""Many designs at once: their balls, ratings, and every check of :func:`ballscrew.physics.sizing.checks.checks`, on
arrays.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.sizing.checks import (
    CHECKS,
    RUNNING_TIME,
    loads_at_point,
    values_of_installation,
    values_of_limits,
)
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.makers_tables import GENERAL
from ballscrew.physics.sizing.ratings import RatedGeometry, ratings_of

Numbers = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Designs:
    """Designs as arrays of one length: sizes in SI, balls as whole numbers, and the preload as a force."""

    pitch_circle_diameter: Numbers
    lead: Numbers
    ball_diameter: Numbers
    loaded_balls: Numbers
    #: Turns that these whole balls fill: what the ratings count.
    loaded_turns: Numbers
    dynamic_rating: Numbers
    static_rating: Numbers
    root_diameter: Numbers
    preload: Numbers

    @classmethod
    def of(cls, columns: Mapping[str, Numbers], screw: BallScrew) -> Designs:
        """The designs of free variables; contact angle and conformity are those of a screw.

        Balls are counted and rated as :class:`~ballscrew.physics.sizing.catalogue.CatalogueRow` does. Where none finds
        room, the ratings are NaN.
        """
        d_m, P_h, d_w = (columns[name] for name in ("pitch_circle_diameter", "lead", "ball_diameter"))
        alpha, phi = screw.contact_angle, geometry.lead_angle(P_h, d_m)
        per_turn = np.floor(np.pi * (d_m / d_w) / np.cos(phi))
        balls = np.maximum(1.0, np.round(per_turn * columns["loaded_turns"]))
        turns = balls / per_turn
        with np.errstate(all="ignore"):
            rated = ratings_of(RatedGeometry(d_m, d_w, alpha, phi, per_turn, turns, screw.nut.spacer_balls))
        d_r = geometry.groove_root_diameter(d_m, d_w, screw.screw_conformity, alpha)
        preload = columns["preload"] * rated.dynamic if "preload" in columns else np.zeros_like(d_m)
        return cls(d_m, P_h, d_w, balls, turns, rated.dynamic, rated.static, d_r, preload)

    @property
    def room(self) -> Numbers:
        """Ball diameter over the room between neighbouring turns: above one, balls overlap."""
        phi = geometry.lead_angle(self.lead, self.pitch_circle_diameter)
        return self.ball_diameter / (self.lead * np.cos(phi))

    def utilisations(
        self,
        *,
        axial_load: float,
        screw_speed: Numbers,
        left: Numbers,
        pressure: Numbers,
        young_modulus: float,
        installation: Installation | None,
        limits: Limits,
    ) -> dict[str, Numbers]:
        """Demand over capacity of each check that can be judged, by its name; at most one where it holds.

        ``left`` is the preload that is left under the load, ``pressure`` that of the most loaded contact.
        """
        # a geometry that is free has no make
        limit = GENERAL.value if limits.diameter_speed_product is None else limits.diameter_speed_product
        values = {
            "screw_speed": screw_speed,
            "pitch_circle_diameter": self.pitch_circle_diameter,
            "root_diameter": self.root_diameter,
            "young_modulus": young_modulus,
            **loads_at_point(axial_load, left),
            "maximum_pressure": pressure,
            "dynamic_load_rating": self.dynamic_rating,
            "static_load_rating": self.static_rating,
            **values_of_limits(limits),
            "limits.diameter_speed_product": limit,
            **({} if installation is None else values_of_installation(installation)),
        }
        # the life says what the running time does
        is_asked = limits.running_time is not None
        rows = [row for row in CHECKS if row.name != "life" and (RUNNING_TIME not in row.takes or is_asked)]
        result = {row.name: row.finds(values) for row in rows}
        shape = load_shape(self)
        return {name: np.broadcast_to(one["utilisation"], shape) for name, one in result.items() if one is not None}


def load_shape(designs: Designs) -> tuple[int, ...]:
    """The shape of the arrays of designs."""
    return np.shape(designs.lead)
