"""Random nuts under load: each draw is many operating points of one kind of nut, which one call solves."""

import dataclasses

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
from support.strategies import HEAVIEST, box

KINDS = ("single", "oversize", "double", "offset")


@dataclasses.dataclass(frozen=True)
class NutCase:
    """Screws that differ in all but their number of balls, with one kind of nut, under loads from nothing on."""

    screw: bs.BallScrew
    nut: Nut
    load: np.ndarray
    bodies: Bodies | None
    deviations: Deviations | None

    @property
    def preload(self) -> np.ndarray:
        return np.broadcast_to(getattr(self.nut, "preload", 0.0), self.load.shape)

    def one(self, i: int) -> "NutCase":
        """One of the operating points, as numbers."""

        def pick(part):
            if part is None:
                return None
            values = {field.name: getattr(part, field.name) for field in dataclasses.fields(part)}
            return dataclasses.replace(
                part, **{name: float(value[i]) for name, value in values.items() if np.ndim(value)}
            )

        return NutCase(pick(self.screw), pick(self.nut), self.load[i], pick(self.bodies), self.deviations)


def nut_case(
    kind: str, size: int, seed: int, *, elastic: bool, same_side: bool = True, scatter: bool = False, balls: int = 0
) -> NutCase:
    """Up to the static rating, a tenth without load, some without preload; halves, where there are two, apart.

    Balls scatter by 0.01 µm to 1 µm, the lead by 0.01 µm to 3 µm; without a number, there are 1 to 100 balls.
    """
    rng = np.random.default_rng(seed)
    z = balls or int(rng.integers(1, 101))
    screw = dataclasses.replace(box(size, seed=int(rng.integers(1 << 31))).screw, loaded_balls=z)
    d_m, d_w = screw.pitch_circle_diameter, screw.ball_diameter
    most = HEAVIEST * d_w**2 * z * np.sin(screw.contact_angle) * np.cos(screw.lead_angle)
    load = most * 10 ** rng.uniform(-6, 0, size) * (rng.random(size) > 0.1)
    preload = most * 10 ** rng.uniform(-5, -0.7, size) * (rng.random(size) > 0.05)
    spacing = screw.lead * rng.uniform(0, 3, size)
    nut: Nut = {
        "single": SingleNut(),
        "oversize": OversizeBallNut(preload),
        "double": DoubleNut(preload, spacing),
        "offset": OffsetLeadNut(preload),
    }[kind]
    bodies = Bodies(
        screw_diameter=d_m - d_w * rng.uniform(0.7, 1.2, size),
        nut_outer_diameter=d_m * rng.uniform(1.35, 2, size),
        nut_inner_diameter=d_m + d_w * rng.uniform(0.3, 1, size),
        same_side=same_side,
    )
    deviations = Deviations.scattered(
        z * (2 if kind in {"double", "offset"} else 1),
        seed=seed,
        ball_diameter=10 ** rng.uniform(-8, -6),
        lead=10 ** rng.uniform(-8, -5.5),
    )
    return NutCase(screw, nut, load, bodies if elastic else None, deviations if scatter else None)
