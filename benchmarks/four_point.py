"""Slip on four contacts against the contact integral: how far apart, by how unlike the loads of the flanks are.

``python benchmarks/four_point.py`` prints a table for people, ``--markdown`` the same for the documentation,
``--json`` one object. The screws are those of ``benchmarks/reference.py``, with the contact load of each on one pair
of flanks and a part of it on the other; dry friction of 0.1, nothing else resists.
"""

from __future__ import annotations

import argparse
import json
import sys
import time
from collections.abc import Sequence
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).parents[1] / "tests"))  # the contact integral is an oracle of theirs

import ballscrew as bs
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction.balls import ball_contacts
from ballscrew.physics.friction.validity import LARGEST_PRESSURE
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.solvers.four_point_slip import FlankPair, FourPointBall, FourPointSlip, four_point_slip
from oracles.contact_integral import contact_integral
from oracles.tractions import Coulomb
from reference import DRY, Box, Numbers, box, dry, left_out

RATIOS = (1.0, 0.3, 0.1, 0.03, 0.01, 0.001)


def contact_load(cases: Box) -> Numbers:
    """Load of a ball on the one pair of flanks."""
    part = cases.screw
    return transmission.contact_load(cases.axial_load, part.loaded_balls, part.contact_angle, part.lead_angle)


def flank_pair(cases: Box, load: Numbers) -> FlankPair:
    """The contacts on one pair of flanks."""
    frame = helix_frame(cases.screw)
    v = frame.entrainment_speed(1.0)
    motion = Motion(v, 0 * v, 0 * v)
    laws = dry(bs.FrictionModel.reference()).contact_laws
    contacts = ball_contacts(laws, cases.screw, cases.oil, frame, load, (motion, motion))
    return FlankPair(*contacts, cases.screw.contact_angle)


def solve(cases: Box, ratio: float) -> FourPointSlip:
    """The slip of one ball of each screw."""
    frame, load = helix_frame(cases.screw), contact_load(cases)
    pairs = (flank_pair(cases, load), flank_pair(cases, ratio * load))
    ball = FourPointBall(*pairs, 0.0, 0.0, cases.screw.ball_diameter, frame.lead_angle, frame.path_radius)
    return four_point_slip(ball)


def row(cases: Box, used: Numbers, ratio: float) -> dict[str, float]:
    """One line of the table."""
    result, load = solve(cases, ratio), contact_load(cases)
    torque = sum(result.contributions.values())
    integrals = [
        contact_integral(cases.one(i), float(load[i]), Coulomb(DRY), flank_pairs=2, second_load=ratio * float(load[i]))
        for i in used
    ]
    found = np.array([integral.converged for integral in integrals])
    truth = np.array([integral.slip_torque for integral in integrals])[found]
    error = torque[used][found] / truth - 1
    return {
        "ratio": ratio,
        "n": len(error),
        "without_balance": int(np.sum(~found)),
        "settled": float(np.mean(result.converged[used])),
        "median": float(np.median(np.abs(error))),
        "p95": float(np.percentile(np.abs(error), 95)),
        "largest": float(np.max(np.abs(error))),
        "bias": float(np.median(error)),
    }


def speed(repeats: int = 5) -> float:
    """Balls a second on arrays."""
    cases, rates = box(50_000, 1), []
    pairs = flank_pair(cases, contact_load(cases)), flank_pair(cases, 0.3 * contact_load(cases))
    frame = helix_frame(cases.screw)
    ball = FourPointBall(*pairs, 0.0, 0.0, cases.screw.ball_diameter, frame.lead_angle, frame.path_radius)
    for _ in range(repeats):
        start = time.perf_counter()
        four_point_slip(ball)
        rates.append(50_000 / (time.perf_counter() - start))
    return float(np.median(rates))


def main(arguments: Sequence[str] | None = None) -> None:
    """Print what was asked for."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--cases", type=int, default=600, help="random screws (default %(default)s)")
    parser.add_argument("--seed", type=int, default=2005, help="of the random screws (default %(default)s)")
    parser.add_argument("--json", action="store_true", help="one JSON object")
    parser.add_argument("--markdown", action="store_true", help="the table for the documentation, without times")
    chosen = parser.parse_args(arguments)
    cases = box(chosen.cases, chosen.seed)
    heavier = flank_pair(cases, contact_load(cases))
    elastic = np.maximum(heavier.screw.maximum_pressure, heavier.nut.maximum_pressure) <= LARGEST_PRESSURE
    rows = [row(cases, np.flatnonzero(elastic), ratio) for ratio in RATIOS]
    if chosen.json:
        print(json.dumps({"rows": rows, "note": left_out(elastic), "balls_per_second": speed()}, indent=2))
        return
    print(f"**Slip torque on four contacts, dry friction of {DRY:g}, nothing else resists** ({left_out(elastic)})\n")
    print("| load of one pair / other | cases | settled | median | 95 % within | largest | bias |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for line in rows:
        print(
            f"| {line['ratio']:g} | {line['n']} | {line['settled']:.1%} | {line['median']:.2%} | {line['p95']:.2%} "
            f"| {line['largest']:.1%} | {line['bias']:+.2%} |"
        )
    if not chosen.markdown:
        print(f"\nfour contacts: {speed():.3g} balls/s")


if __name__ == "__main__":
    main()
