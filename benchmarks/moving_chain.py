"""The balls of a circuit in motion: the force between balls of twelve sizes.

``python benchmarks/moving_chain.py`` prints a table in Markdown, ``--write`` stores it in docs/moving_chain.inc: of the
double nuts of the shipped catalogue, each half under 5 % of its rating, the share of the load that neighbours press
with, at 10, 50 and 90 % of random gaps (0.05 to 1.05 balls a circuit, any as likely) and groove deviations (0.5 to 2
um, as likely in the logarithm), with a seed of the grooves of its own each. Beside it the median of the law ``chain``
over the same draws, and what the return brakes with.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np

import ballscrew as bs
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.laws.ball_chain import ChainBallForce
from ballscrew.physics.sizing.catalogue import printed_rows
from ballscrew.questions.shared.text_tables import markdown_table
from harness import study

OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
MODEL = bs.FrictionModel.reference()
PRELOAD = 0.05
GAPS, DEVIATIONS = (0.05, 1.05), (0.5e-6, 2e-6)
QUANTILES = (0.1, 0.5, 0.9)
#: Circuits of each half, draws, and the speed, rad/s.
CIRCUITS, DRAWS, SPEED = 2, 8, 100 * math.tau / 60


class Draw(NamedTuple):
    """A circuit as it may be."""

    gap: float
    deviation: float
    seed: int


def draws(number: int) -> list[Draw]:
    """Random circuits, the same every time."""
    generator = np.random.default_rng(2026)
    gaps = generator.uniform(*GAPS, number)
    deviations = np.exp(generator.uniform(*np.log(DEVIATIONS), number))
    return [Draw(float(gap), float(e), seed) for seed, (gap, e) in enumerate(zip(gaps, deviations, strict=True))]


def by_law(screw: bs.BallScrew, draw: Draw) -> float:
    """The share by the closed form."""
    law = ChainBallForce(gap=draw.gap, groove_deviation=draw.deviation, circuits=float(CIRCUITS))
    found: Any = dataclasses.replace(MODEL, ball_force=law)(screw, OIL, axial_load=0.0, screw_speed=SPEED)
    return float(found.kinds[0].friction.ball_to_ball_force / found.kinds[0].load)


def row(name: str, drawn: list[Draw]) -> list[str]:
    """One line of the table."""
    listed = bs.catalogue()[name]
    screw = listed.screw(nut=bs.DoubleNut(preload=PRELOAD * listed.dynamic_load_rating))
    at = {"axial_load": 0.0, "screw_speed": SPEED}
    runs = [
        bs.moving_chain(
            MODEL, screw, OIL, **at, gap=d.gap, groove_deviation=d.deviation, seed=d.seed, circuits=CIRCUITS
        )
        for d in drawn
    ]
    shares = np.quantile([run.share for run in runs], QUANTILES)
    law = np.median([by_law(screw, draw) for draw in drawn])
    torque = MODEL(screw, OIL, **at).screw_torque
    frame = MODEL.laws.frame(screw)
    push = float(np.median([run.exit_push for run in runs]))
    # both halves have as many circuits
    brake = 2 * CIRCUITS * ball_chain.return_torque(push, frame.path_radius, frame.curvature_ratio)
    return [
        name.removeprefix("rexroth-").removesuffix("-double"),
        f"{runs[0].places.shape[1]}",
        " / ".join(f"{share:.1e}" for share in shares),
        f"{law:.1e}",
        f"{push:.2g}",
        f"{100 * brake / float(torque):.1f}",
    ]


HEADING = (
    "size", "balls a circuit", "F_B/Q: 10 / 50 / 90 %", "law chain, median", "push of the return, N",
    "its torque / torque of the reference, %",
)  # fmt: skip


def table() -> str:
    """The table as Markdown."""
    drawn = draws(DRAWS)
    return markdown_table(HEADING, [row(listed.name, drawn) for listed in printed_rows() if listed.nut == "double"])


if __name__ == "__main__":
    study(__doc__, table, "moving_chain.inc")
