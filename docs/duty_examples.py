"""Worked examples of catalogues for the torque of a motor, beside the same duty by mechanics.

Facts of the examples: THKGeneral (two examples of selecting a ball screw, horizontal and vertical), the selection
example of Omron's servomotors, and the formula of Rockford Ball Screw; the last two by transcriptions of their numbers.
Sources round in between; weight there is that of 9.8 m/s².
"""

from __future__ import annotations

import dataclasses
import math
from types import SimpleNamespace
from typing import Any

from ballscrew.axis.duty_cycle.axis import GRAVITY, Axis
from ballscrew.axis.duty_cycle.drive_sizing import CycleLife, VendorRule
from ballscrew.axis.duty_cycle.duty import Duty, duty
from ballscrew.axis.motion.profiles import Motion, Segment, Segments, Trapezoid
from ballscrew.physics.components.nut import SingleNut
from ballscrew.questions.shared.text_tables import markdown_table


@dataclasses.dataclass(frozen=True)
class Example:
    """A worked example: the duty, the efficiency that it uses, and what the source prints in N m."""

    name: str
    axis: Axis
    motion: Motion
    lead: float
    efficiency: float
    printed_rms: float | None
    printed_peak: float

    @property
    def duty(self) -> Duty:
        """The duty by mechanics, with the efficiency of the source."""
        screw: Any = SimpleNamespace(lead=self.lead)
        return duty(self.efficiency, screw, axis=self.axis, motion=self.motion)

    @property
    def rule(self) -> VendorRule:
        """The duty by the rule of the source."""
        return VendorRule(self.duty, self.efficiency)


_VERTICAL = {"speed": 0.3, "acceleration": 1.5}

EXAMPLES = (
    Example(
        "THK, horizontal, 80 kg",
        Axis(mass=80.0, guide_friction_coefficient=0.003, guide_seal_force=15.0, inertia=1e-3 + 1.48e-4),
        Trapezoid(stroke=1.0, speed=1.0, acceleration=1 / 0.15, dwell=2.6),
        0.040,
        0.9,
        1.305,
        4.73,
    ),
    Example(
        "THK, vertical, 50 kg",
        Axis(mass=50.0, inclination=math.pi / 2, guide_seal_force=20.0, inertia=5e-5 + 3.12e-5),
        Segments(
            segments=(
                Segment(name="up", distance=0.6, **_VERTICAL),
                Segment(name="down", distance=-0.6, **_VERTICAL),
                # the work of 10 kg has been taken off
                Segment(name="rest", duration=7.6, force=-10 * GRAVITY),
            )
        ),
        0.010,
        0.9,
        0.743,
        1.100,
    ),
    Example(
        "Omron, horizontal, 5 kg",
        # the load's inertia of the source, 1.63e-4 kg m², has the mass in it
        Axis(
            mass=5.0,
            guide_friction_coefficient=0.1,
            inertia=1.23e-5 + 1.63e-4 - 5 * (0.010 / 2 / math.pi) ** 2,
        ),
        Trapezoid(stroke=0.36, speed=0.3, acceleration=1.5, dwell=0.2, returns=False),
        0.010,
        1.0,
        0.0828,
        0.173,
    ),
    Example(
        "Rockford, 500 lbf, lead 0.25 in",
        Axis(mass=0.0),
        Segments(segments=(Segment(duration=1.0, speed=0.1, force=500 * 4.4482216152605),)),
        0.25 * 0.0254,
        0.9,
        None,
        22.1 * 0.0254 * 4.4482216152605,
    ),
)

#: The life of the first example: rating in N, factor on the loads, mean load in N and life in turns as printed.
THK_LIFE = (5400.0, 1.5, 225.0, 4.1e9)


def life_of_thk() -> CycleLife:
    """Mean loads and life of THK's horizontal example."""
    rating, factor, *_ = THK_LIFE
    return CycleLife(EXAMPLES[0].duty, SingleNut(), 0.0, rating, factor)


def table() -> str:
    """The examples as they are printed, by their rule, and by mechanics at the same efficiency."""
    rows: list[tuple[str, ...]] = []
    for example in EXAMPLES:
        rule, ours = example.rule, example.duty
        pairs = {
            "RMS torque": (example.printed_rms, rule.torque_rms, ours.torque_rms),
            "peak torque": (example.printed_peak, rule.torque_peak, ours.torque_peak),
        }
        for quantity, found in pairs.items():
            if found[0] is not None:
                rows.append((example.name, quantity, *(f"{number:.4g} N m" for number in found)))
    life, name = life_of_thk(), EXAMPLES[0].name
    mean, turns = THK_LIFE[2:]
    ours = f"{life.mean_load:.4g} N"
    rows.append((name, "mean load", f"{mean:.4g} N", ours, f"{ours} on each flank"))
    worse, both = life.revolutions_of_the_worse, life.revolutions
    rows.append((name, "life", f"{turns:.2g} turns", f"{worse:.2g} turns", f"{both:.2g} turns, both flanks"))
    return markdown_table(("example", "quantity", "printed", "by its rule", "by mechanics"), rows)
