"""The dynamic load rating of a screw by its geometry, and preloads that no nut of that rating has."""

from __future__ import annotations

from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.arrays import as_array, namespace
from ballscrew.basis.quantities import Angle, Count, Force, Info, Length, Mask, Quantity, Ratio
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE, Written
from ballscrew.physics.components.nut import PRELOAD
from ballscrew.physics.equations import geometry, rating

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
    f_c = rating.geometry_factor(rating.contact_angle_factor(contact_angle), rating.curvature_factor(gamma), conformity)
    C_s = rating.screw_turn_rating(f_c, contact_angle, balls_per_turn, ball_diameter, lead_angle)
    C_i = rating.turn_rating(C_s, rating.turn_rating_ratio(gamma, conformity, conformity))
    return rating.dynamic_load_rating(C_i, loaded_turns)


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
    return [
        Record(
            id=IMPLAUSIBLE,
            subject="nut.preload",
            text=message,
            severity="warning",
            holds=False,
            value=share,
            limit=high if share > high else low,
        )
    ]
