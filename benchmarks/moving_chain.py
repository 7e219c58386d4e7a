"""The balls of a circuit in motion: how long a steady state takes, and the force between balls of twelve sizes.

``python benchmarks/moving_chain.py`` prints a table in Markdown: of the double nuts of the shipped catalogue, each half
under 5 % of its rating, the share of the load that neighbours press with, at 10, 50 and 90 % of random gaps (0.05 to
1.05 balls a circuit, any as likely) and groove deviations (0.5 to 2 um, as likely in the logarithm), with a seed of the
grooves of its own each. Beside it the median of the law ``chain`` over the same draws, and what the return brakes with.
"""

from __future__ import annotations

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np

import ballscrew as bs
from ballscrew.compiler.kernels.kernel import available
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.laws.ball_chain import WALL_FACTOR, ChainBallForce
from ballscrew.physics.moving_balls.chain import MovingChain, chain_run, circuit_of
from ballscrew.physics.moving_balls.loaded_zone import loaded_zone
from ballscrew.questions.shared.text_tables import markdown_table
from harness import ROOT, asked, seconds

OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
MODEL = bs.FrictionModel.reference()
PRELOAD = 0.05
GAPS, DEVIATIONS = (0.05, 1.05), (0.5e-6, 2e-6)
QUANTILES = (0.1, 0.5, 0.9)
#: Columns that are of the machine.
TIMES = 2, 3


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


def moved(screw: bs.BallScrew, speed: float, circuits: int, draw: Draw) -> MovingChain:
    """The balls of a circuit that was drawn."""
    return bs.moving_chain(
        MODEL,
        screw,
        OIL,
        axial_load=0.0,
        screw_speed=speed,
        gap=draw.gap,
        groove_deviation=draw.deviation,
        seed=draw.seed,
        circuits=circuits,
    )


def by_law(screw: bs.BallScrew, speed: float, circuits: int, draw: Draw) -> float:
    """The share by the closed form."""
    law = ChainBallForce(gap=draw.gap, groove_deviation=draw.deviation, circuits=float(circuits))
    found: Any = dataclasses.replace(MODEL, ball_force=law)(screw, OIL, axial_load=0.0, screw_speed=speed)
    return float(found.kinds[0].friction.ball_to_ball_force / found.kinds[0].load)


def row(name: str, speed: float, circuits: int, drawn: list[Draw], plain: bool) -> list[str]:
    """One line of the table."""
    listed = bs.catalogue()[name]
    screw = listed.screw(nut=bs.DoubleNut(preload=PRELOAD * listed.dynamic_load_rating))
    runs: list[MovingChain] = []
    times = [seconds(lambda draw=draw: runs.append(moved(screw, speed, circuits, draw))) for draw in drawn]
    slow = "–"
    if plain:
        zone = loaded_zone(
            MODEL,
            screw,
            OIL,
            axial_load=0.0,
            screw_speed=speed,
            groove_deviation=drawn[0].deviation,
            seed=0,
            circuits=circuits,
        )
        circuit = circuit_of(MODEL, screw, OIL, zone, speed, drawn[0].gap, circuits, None, WALL_FACTOR)
        slow = f"{seconds(lambda: chain_run(circuit, speed, compiled=False)):.1f}"
    shares = np.quantile([run.share for run in runs], QUANTILES)
    law = np.median([by_law(screw, speed, circuits, draw) for draw in drawn])
    torque = MODEL(screw, OIL, axial_load=0.0, screw_speed=speed).screw_torque
    frame = MODEL.laws.frame(screw)
    push = float(np.median([run.exit_push for run in runs]))
    # both halves have as many circuits
    brake = 2 * circuits * ball_chain.return_torque(push, frame.path_radius, frame.curvature_ratio)
    return [
        name.removeprefix("rexroth-").removesuffix("-double"),
        f"{runs[0].places.shape[1]}",
        f"{np.median(times):.2f}",
        slow,
        " / ".join(f"{share:.1e}" for share in shares),
        f"{law:.1e}",
        f"{push:.2g}",
        f"{100 * brake / float(torque):.1f}",
    ]


HEADING = (
    "size", "balls a circuit", f"s a steady state ({'' if available() else 'not '}compiled)", "s by NumPy",
    "F_B/Q: 10 / 50 / 90 %", "law chain, median", "push of the return, N",
    "its torque / torque of the reference, %",
)  # fmt: skip


def main() -> None:
    """Print the table; ``--plain`` times a run without the compiler, ``--write`` stores it without times in docs."""
    options = asked(__doc__, draws=8, circuits=2, rpm=100.0, plain=False, write=False)
    speed, drawn = options.rpm * 2 * math.pi / 60, draws(options.draws)
    names = [name for name, listed in bs.catalogue().items() if listed.nut == "double"]
    rows = [row(name, speed, options.circuits, drawn, options.plain) for name in names]
    print(markdown_table(HEADING, rows), end="")
    if options.write:
        kept = [[cell for i, cell in enumerate(cells) if i not in TIMES] for cells in (HEADING, *rows)]
        (ROOT / "docs" / "moving_chain.inc").write_text(markdown_table(kept[0], kept[1:]), encoding="utf-8")


if __name__ == "__main__":
    main()
