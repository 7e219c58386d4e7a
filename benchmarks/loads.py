"""Loads of the balls on random nuts: which fail, how well the rest balance, and how fast.

``python benchmarks/loads.py`` prints a table for people, ``--markdown`` the same for the documentation without
times, ``--json`` one object. A double nut is three chains: each half under the preload, and both under the load.

Each draw is one kind of nut with one number of balls, and a hundred operating points of it. In a draw: 5 to 100
balls, on rigid bodies once in four, otherwise on elastic ones held on one side or on opposite ones; once in three
balls scatter by 0.01 µm to 1 µm and the lead by 0.01 µm to 3 µm (standard deviations, evenly over the orders).
In a point: pitch circles of 8 mm to 150 mm and leads of a twentieth of them to all of them, evenly over the
orders; balls of 0.05 to 0.2 pitch circles that fit; angles of 20° to 70°; conformities of 0.505 to 0.56; a core of
the screw 0.7 to 1.2 balls and a bore of the nut 0.3 to 1 balls from the pitch circle, an outer diameter of 1.35 to 2
pitch circles; halves 0 to 3 leads apart. The load is a millionth to all of 150 N per mm² of ball diameter squared,
beyond the static rating of any screw, and nothing in one of ten; the preload a hundred-thousandth to a fifth of it,
and nothing in one of twenty. Always the same for the same ``--seed``.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import time
from collections.abc import Iterator, Sequence
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
from ballscrew.physics.solvers.load_distribution import BallLoads, ball_loads

POINTS = 100
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

    def __call__(self) -> BallLoads:
        """The loads of the balls."""
        return ball_loads(self.screw, self.nut, self.load, bodies=self.bodies, deviations=self.deviations)


def draws(cases: int, seed: int) -> Iterator[Draw]:
    """The draws, all kinds in turn."""
    rng = np.random.default_rng(seed)
    for number in range(-(-cases // POINTS)):
        yield draw(KINDS[number % len(KINDS)], rng)


def draw(
    kind: str,
    rng: np.random.Generator,
    points: int = POINTS,
    *,
    balls: int | None = None,
    elastic: bool | None = None,
    scatters: bool | None = None,
) -> Draw:
    """One draw; what is given is not drawn."""

    def evenly(low: float, high: float) -> np.ndarray[Any, np.dtype[np.float64]]:
        return np.exp(rng.uniform(np.log(low), np.log(high), points))

    drawn = int(rng.integers(5, 101)), bool(rng.random() < 0.75), bool(rng.random() < 1 / 3), bool(rng.random() < 0.5)
    z, elastic, scatters, same_side = (
        drawn[0] if balls is None else balls,
        drawn[1] if elastic is None else elastic,
        drawn[2] if scatters is None else scatters,
        drawn[3],
    )
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


@dataclasses.dataclass
class Tally:
    """What came out for one kind of nut."""

    cases: int = 0
    failures: int = 0
    largest_residual: float = 0.0
    deflections: list[Any] = dataclasses.field(default_factory=list)
    uneven: list[Any] = dataclasses.field(default_factory=list)

    def add(self, part: Draw, r: BallLoads) -> None:
        """Count a draw. A case fails that is out of balance, pulls a ball, or has anything that is no number."""
        numbers = [getattr(r, field.name) for field in dataclasses.fields(r)]
        finite = np.all([np.isfinite(n) if n.ndim == 1 else np.all(np.isfinite(n), axis=-1) for n in numbers], axis=0)
        pushed = np.all((r.forward_load >= 0) & (r.backward_load >= 0), axis=-1) & (r.remaining_preload >= 0)
        self.cases += part.load.size
        self.failures += int(np.sum(~(r.converged & finite & pushed)))
        self.largest_residual = max(self.largest_residual, float(np.max(r.residual)))
        loaded = part.load > 0
        self.deflections.append(r.deflection[loaded])
        if part.bodies is not None or part.deviations is not None:
            first = r.forward_load[loaded][:, : int(part.screw.loaded_balls)]
            mean = np.mean(first, axis=-1)
            self.uneven.append(np.max(first, axis=-1)[mean > 0] / mean[mean > 0])

    def row(self) -> dict[str, float]:
        """Numbers of the table."""
        return {
            "cases": self.cases,
            "failures": self.failures,
            "largest_residual": self.largest_residual,
            "median_deflection": float(np.median(np.concatenate(self.deflections))),
            "median_largest_over_mean": float(np.median(np.concatenate(self.uneven))),
        }


def tallies(cases: int, seed: int) -> dict[str, dict[str, float]]:
    """All draws, by kind of nut."""
    found = {kind: Tally() for kind in KINDS}
    for part in draws(cases, seed):
        found[part.kind].add(part, part())
    return {kind: tally.row() for kind, tally in found.items()}


def speeds(seed: int, points: int = 4000, repeats: int = 3) -> dict[str, float]:
    """Solves per second on arrays, the best of a few, for 20, 50 and 100 balls on rigid and elastic bodies."""
    rng = np.random.default_rng(seed)
    rates: dict[str, float] = {}
    for kind in ("single", "oversize", "double"):
        for balls in (20, 50, 100):
            for name, elastic, scatters in (("elastic", True, False), ("rigid, scatter", False, True)):
                part = draw(kind, rng, points, balls=balls, elastic=elastic, scatters=scatters)
                times: list[float] = []
                for _ in range(repeats):
                    start = time.perf_counter()
                    part()
                    times.append(time.perf_counter() - start)
                rates[f"{kind}, {balls} balls, {name}"] = points / min(times)
    return rates


def main(arguments: Sequence[str] | None = None) -> None:
    """Print what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=100_000, help="operating points (default %(default)s)")
    parser.add_argument("--seed", type=int, default=2005, help="of the random nuts (default %(default)s)")
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--markdown", action="store_true", help="the table for the documentation, without times")
    chosen = parser.parse_args(arguments)
    rows = tallies(chosen.cases, chosen.seed)
    if chosen.json:
        print(json.dumps({"nuts": rows, "solves_per_second": speeds(chosen.seed)}, indent=2))
        return
    print("| nut | cases | failures | largest residual | deflection, median | most loaded ball / mean, median |")
    print("| --- | --- | --- | --- | --- | --- |")
    for kind, row in rows.items():
        print(
            f"| {kind} | {row['cases']} | {row['failures']} | {row['largest_residual']:.1e} "
            f"| {row['median_deflection'] * 1e6:.2g} µm | {row['median_largest_over_mean']:.3f} |"
        )
    if not chosen.markdown:
        print()
        for name, rate in speeds(chosen.seed).items():
            print(f"{name}: {rate:.3g} solves/s")


if __name__ == "__main__":
    main()
