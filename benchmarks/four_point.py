"""Slip on four contacts against the contact integral: how far apart, by how unlike the loads of the flanks are.

``python benchmarks/four_point.py`` prints a table, and a rate. The screws are of ``benchmarks/reference.py``, with
the contact load of each on one pair of flanks and a part of it on the other; dry friction of 0.1, nothing else resists.
"""

from __future__ import annotations

import numpy as np

import ballscrew as bs
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction.balls import ball_contacts
from ballscrew.physics.friction.validity import LARGEST_PRESSURE
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.solvers.four_point_slip import FlankPair, FourPointBall, four_point_slip
from ballscrew.questions.shared.text_tables import markdown_table
from harness import asked, seconds, told
from oracles.contact_integral import contact_integral
from oracles.tractions import Coulomb
from reference import DRY, ERRORS, Box, Numbers, box, dry, in_words, left_out, spread

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


def ball(cases: Box, ratio: float) -> FourPointBall:
    """One ball of each screw, with this part of its load on the other pair."""
    frame, load = helix_frame(cases.screw), contact_load(cases)
    pairs = (flank_pair(cases, load), flank_pair(cases, ratio * load))
    return FourPointBall(*pairs, 0.0, 0.0, cases.screw.ball_diameter, frame.lead_angle, frame.path_radius)


def row(cases: Box, used: Numbers, ratio: float) -> list[str]:
    """One line of the table."""
    result, load = four_point_slip(ball(cases, ratio)), contact_load(cases)
    torque = sum(result.contributions.values())
    integrals = [
        contact_integral(cases.one(i), float(load[i]), Coulomb(DRY), flank_pairs=2, second_load=ratio * float(load[i]))
        for i in used
    ]
    found = np.array([integral.converged for integral in integrals])
    truth = np.array([integral.slip_torque for integral in integrals])[found]
    error = torque[used][found] / truth - 1
    settled = float(np.mean(result.converged[used]))
    return [f"{ratio:g}", str(len(error)), f"{settled:.1%}", *in_words(spread(error))]


def speed(repeats: int = 5) -> float:
    """Balls a second on arrays."""
    balls = ball(box(50_000, 1), 0.3)
    return 50_000 / float(np.median([seconds(lambda: four_point_slip(balls)) for _ in range(repeats)]))


def table(number: int = 150, seed: int = 2005) -> str:
    """The table for the documentation: of a quarter of the screws, which tell the same in a quarter of 40 s."""
    cases = box(number, seed)
    heavier = flank_pair(cases, contact_load(cases))
    elastic = np.maximum(heavier.screw.maximum_pressure, heavier.nut.maximum_pressure) <= LARGEST_PRESSURE
    rows = [row(cases, np.flatnonzero(elastic), ratio) for ratio in RATIOS]
    title = f"**Slip torque on four contacts, dry friction of {DRY:g}, nothing else resists** ({left_out(elastic)})"
    return f"{title}\n\n{markdown_table(('load of one pair / other', 'cases', 'settled', *ERRORS), rows)}"


if __name__ == "__main__":
    options = asked(__doc__, cases=600, seed=2005)
    print(table(options.cases, options.seed), end="")
    told({"balls_per_second": speed()}, False)
