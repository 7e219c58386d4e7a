"""The balls of a circuit in motion: how long a steady state takes, and the force between balls of twelve sizes.

``python benchmarks/moving_chain.py`` prints a table in Markdown: of the double nuts of the shipped catalogue, each half
under 5 % of its rating, the share of the load that neighbours press with, at 10, 50 and 90 % of random gaps (0.05 to
1.05 balls a circuit, any as likely) and groove deviations (0.5 to 2 um, as likely in the logarithm), with a seed of the
grooves of its own each. Beside it the median of the law ``chain`` over the same draws, and what the return brakes with.
"""

from __future__ import annotations

import argparse
import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

import ballscrew as bs
from ballscrew.compiler.kernels.kernel import available
from ballscrew.physics.equations import ball_chain
from ballscrew.physics.laws.ball_chain import WALL_FACTOR, ChainBallForce
from ballscrew.physics.moving_balls.chain import MovingChain, chain_run, circuit_of
from ballscrew.physics.moving_balls.loaded_zone import loaded_zone
from timing import seconds

OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
MODEL = bs.FrictionModel.reference()
PRELOAD = 0.05
GAPS, DEVIATIONS = (0.05, 1.05), (0.5e-6, 2e-6)
QUANTILES = (0.1, 0.5, 0.9)
PAGE = Path(__file__).parents[1] / "docs" / "moving_chain.inc"
#: Columns that are of the machine.
TIMES = slice(2, 4)


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
        MODEL, screw, OIL, axial_load=0.0, screw_speed=speed, gap=draw.gap, groove_deviation=draw.deviation,
        seed=draw.seed, circuits=circuits,
    )  # fmt: skip


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
            MODEL, screw, OIL, axial_load=0.0, screw_speed=speed, groove_deviation=drawn[0].deviation, seed=0,
            circuits=circuits,
        )  # fmt: skip
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


def _line(cells: Sequence[str]) -> str:
    return f"| {' | '.join(cells)} |"


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--draws", type=int, default=8, help="random circuits of each size")
    parser.add_argument("--circuits", type=int, default=2, help="circuits of each half of a nut")
    parser.add_argument("--rpm", type=float, default=100.0, help="speed of the screw")
    parser.add_argument("--plain", action="store_true", help="time a run without the compiler, too")
    parser.add_argument("--write", action="store_true", help="write the table without the times into docs, too")
    options = parser.parse_args()
    speed, drawn = options.rpm * 2 * math.pi / 60, draws(options.draws)
    compiled = "compiled" if available() else "not compiled"
    heading = [
        "size", "balls a circuit", f"s a steady state ({compiled})", "s by NumPy", "F_B/Q: 10 / 50 / 90 %",
        "law chain, median", "push of the return, N", "its torque / torque of the reference, %",
    ]  # fmt: skip
    rows = [heading, ["---"] * len(heading)]
    print("\n".join(map(_line, rows)))
    for name, listed in bs.catalogue().items():
        if listed.nut == "double":
            rows.append(row(name, speed, options.circuits, drawn, options.plain))
            print(_line(rows[-1]), flush=True)
    if options.write:
        for cells in rows:
            del cells[TIMES]
        PAGE.write_text("".join(f"{_line(cells)}\n" for cells in rows), encoding="utf-8")


if __name__ == "__main__":
    main()
