"""Random nuts: one kind with one number of balls, and operating points of it, from no load to beyond any rating.

5 to 100 balls, on rigid bodies once in four, otherwise on elastic ones held on one side or on opposite ones; once in
three balls scatter by 0.01 µm to 1 µm and the lead by 0.01 µm to 3 µm (standard deviations, evenly over the orders). In
a point: pitch circles of 8 mm to 150 mm and leads of a twentieth of them to all of them, evenly over the orders; balls
of 0.05 to 0.2 pitch circles that fit; angles of 20° to 70°; conformities of 0.505 to 0.56; a core of the screw 0.7 to
1.2 balls and a bore of the nut 0.3 to 1 balls from the pitch circle, an outer diameter of 1.35 to 2 pitch circles;
halves 0 to 3 leads apart. The load is a millionth to all of 150 N per mm² of ball diameter squared, beyond the static
rating of any screw, and nothing in one of ten; the preload a hundred-thousandth to a fifth of it, and nothing in one of
twenty.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.physics.components.nut import (
    Bodies,
    Deviations,
    DoubleNut,
    Nut,
    OffsetLeadNut,
    OversizeBallNut,
    SingleNut,
)

KINDS = ("single", "oversize", "double", "offset")
HALVES = ("double", "offset")
#: N/m²: load of a ball over its diameter squared.
HEAVIEST = 1.5e8


@dataclasses.dataclass(frozen=True)
class Draw:
    """Operating points of one kind of nut."""

    kind: str
    screw: bs.BallScrew
    nut: Nut
    load: np.ndarray[Any, np.dtype[np.float64]]
    bodies: Bodies | None
    deviations: Deviations | None


def draw(kind: str, rng: np.random.Generator, points: int) -> Draw:
    """Some points of a kind of nut."""

    def evenly(low: float, high: float) -> np.ndarray[Any, np.dtype[np.float64]]:
        return np.exp(rng.uniform(np.log(low), np.log(high), points))

    z, elastic, scatters = int(rng.integers(5, 101)), bool(rng.random() < 0.75), bool(rng.random() < 1 / 3)
    same_side = bool(rng.random() < 0.5)
    d_m = evenly(0.008, 0.150)
    lead = d_m * evenly(1 / 20, 1)
    d_w = np.minimum(d_m * rng.uniform(0.05, 0.2, points), 0.98 * lead * np.cos(np.arctan(lead / (np.pi * d_m))))
    screw = bs.BallScrew(
        pitch_circle_diameter=d_m,
        lead=lead,
        ball_diameter=d_w,
        loaded_balls=z,
        contact_angle=np.radians(rng.uniform(20, 70, points)),
        screw_conformity=rng.uniform(0.505, 0.56, points),
        nut_conformity=rng.uniform(0.505, 0.56, points),
    )
    most = HEAVIEST * d_w**2 * z * np.sin(screw.contact_angle) * np.cos(screw.lead_angle)
    load = most * evenly(1e-6, 1) * (rng.random(points) > 0.1)
    preload = most * evenly(1e-5, 0.2) * (rng.random(points) > 0.05)
    spacing = lead * rng.uniform(0, 3, points)
    nuts: dict[str, Nut] = {
        "single": SingleNut(),
        "oversize": OversizeBallNut(preload),
        "double": DoubleNut(preload, spacing),
        "offset": OffsetLeadNut(preload),
    }
    bodies = Bodies(
        screw_diameter=d_m - d_w * rng.uniform(0.7, 1.2, points),
        nut_outer_diameter=d_m * rng.uniform(1.35, 2, points),
        nut_inner_diameter=d_m + d_w * rng.uniform(0.3, 1, points),
        same_side=same_side,
    )
    deviations = Deviations.scattered(
        z * (2 if kind in HALVES else 1),
        seed=int(rng.integers(1 << 31)),
        ball_diameter=10 ** rng.uniform(-8, -6),
        lead=10 ** rng.uniform(-8, np.log10(3e-6)),
    )
    return Draw(kind, screw, nuts[kind], load, bodies if elastic else None, deviations if scatters else None)
