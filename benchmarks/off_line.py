"""Balls off the line of their grooves: where they lie, what it changes, and two ways to compute it, for six screws.

python benchmarks/off_line.py             the table as Markdown
python benchmarks/off_line.py --write     the same into docs/off_line.inc
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import SCREW
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.across_groove import preload_off_line
from ballscrew.physics.moving_balls.brush import BallContacts, Brush
from ballscrew.questions.shared.text_tables import markdown_table
from harness import study
from support.screws import screw

REFERENCE = bs.FrictionModel.reference()
OIL = bs.Lubricant.from_grade("VG 100", temperature=313.15)
SPEED = 2 * math.pi * 100 / 60


def _screw(d_m: float, lead: float, d_w: float) -> BallScrew:
    """A screw with the usual grooves, by its sizes in millimetres."""
    return screw(pitch_circle_diameter=d_m * 1e-3, lead=lead * 1e-3, ball_diameter=d_w * 1e-3, loaded_balls=30)


#: Screws, and the load of a ball, N, at about 5 % of the dynamic rating.
SCREWS: Mapping[str, tuple[BallScrew, float]] = {
    "6 × 1": (_screw(6.2, 1, 0.8), 1.4),
    "20 × 5": (_screw(20.5, 5, 3), 12.0),
    "the paper's (f = 0.515)": (dataclasses.replace(SCREW, loaded_balls=30), 12.0),
    "40 × 10": (_screw(41, 10, 6), 41.0),
    "63 × 10": (_screw(64, 10, 6), 33.0),
    "125 × 20": (_screw(128, 20, 12.7), 128.0),
}


def _row(name: str, screw: BallScrew, load: float) -> list[str]:
    axial = load * screw.loaded_balls * math.sin(screw.contact_angle) * math.cos(float(screw.lead_angle))
    found = REFERENCE(screw, OIL, axial_load=axial, screw_speed=SPEED)
    ball = found.kinds[0].friction
    share = float(ball.lateral_force) / load
    brush = Brush(BallContacts.of(screw, found.frame, ball.screw, ball.nut))
    cell = brush.ball.cell / brush.ball.rolled
    crossing = float(ball.lateral_force) / brush.ball.hold / (brush.ball.lateral / 2)
    step = brush.turn(cell)
    for _ in range(math.ceil(4 * crossing / cell)):
        step = brush.turn(cell)
    (up,), (down,) = (
        bs.off_line_balls(REFERENCE, screw, OIL, axial_load=axial, screw_speed=way * SPEED) for way in (1, -1)
    )
    ratios = [
        preload_off_line(dataclasses.replace(screw, nut=bs.DoubleNut(preload=axial, bodies=bodies)), math.atan(share))
        / axial
        for bodies in (None, bs.Bodies())
    ]
    return [
        name,
        f"{math.degrees(2 * math.atan(share)):.1f}°",
        f"{math.degrees(2 * math.atan(step.lateral_force / load)):.1f}°",
        f"{1e6 * abs(step.distance):.1f}",
        f"{float(ratios[0]):.2f}, {float(ratios[1]):.2f}",
        f"{float(up.spin_share):.2f}, {float(down.spin_share):.2f}",
        f"{float(up.torque_ratio):.2f}, {float(down.torque_ratio):.2f}",
        f"{1e6 * float(up.axial_step):.1f}",
    ]


HEADING = (
    "screw", "contact angles differ by", "by bristles", "off the line [µm]", "load of braced halves, rigid, elastic",
    "spin, lifted and lowered", "torque, lifted and lowered", "axial step [µm]",
)  # fmt: skip


def table() -> str:
    """The table as Markdown."""
    return markdown_table(HEADING, [_row(name, *of) for name, of in SCREWS.items()]).replace("-0.", "−0.")


if __name__ == "__main__":
    study(__doc__, table, "off_line.inc")
