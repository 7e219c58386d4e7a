"""Friction over speed of a log at constant speeds: its sheet and its document."""

from __future__ import annotations

import math
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.output.sheet import Axis, Chart, Curve, Number, Sheet, Table, lines
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.version import __version__
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.power_law import SteadyFriction, steady_friction

_SPEED = Quantity("speed", "m/s", Info("v", "speed", "mm/s"))
_NUMBERS = ("forward", "backward", "friction", "std", "offset")


def of_logs(log: MovingLog, other: MovingLog | None) -> SteadyFriction:
    """Friction of a log, and of another one of the same axis."""
    return steady_friction(*[one for one in (log, other) if one is not None])


def sheet(friction: SteadyFriction, log: MovingLog) -> Sheet:
    """The table of the speeds, the exponent, and the chart."""
    drive = Quantity("drive", log.unit, Info("", "drive"))
    rows = [
        [
            units.shown(one.speed, _SPEED, digits=3),
            *(Number(getattr(one, name), drive, 3) for name in _NUMBERS),
            str(one.rows),
            str(one.stretches),
        ]
        for one in friction.speeds
    ]
    headings = ("speed", "forward", "backward", "friction", "standard error", "offset", "rows", "stretches")
    low, high = friction.interval
    exponent = "the speeds do not tell an exponent"
    if not math.isnan(low):
        exponent = f"friction as the speed to the power of {friction.exponent:.2f} ({low:.2f} to {high:.2f})"
    speeds, values = ([getattr(one, name) for one in friction.speeds] for name in ("speed", "friction"))
    return Sheet(
        f"{(log.source or ('log', ''))[0]}: friction at constant speed",
        [
            Table("speeds", "Drive at constant speed", headings, rows),
            lines(
                [exponent, f"speeds are written in steps of {1e3 * friction.resolution:.3g} mm/s", *log.notes], "small"
            ),
            Chart(
                "friction over speed",
                Axis("speed", _SPEED),
                Axis("friction", drive),
                [Curve("friction", speeds, values, "blue", "circles")],
            ),
        ],
    )


def document(friction: SteadyFriction, log: MovingLog) -> dict[str, Any]:
    """The same for programs, in SI or amperes."""
    low, high = friction.interval
    return {
        "kind": "steady",
        "unit": log.unit,
        "speeds": [
            {name: getattr(one, name) for name in ("speed", *_NUMBERS, "rows", "stretches")} for one in friction.speeds
        ],
        "speed_exponent": None if math.isnan(low) else {"value": friction.exponent, "interval": [low, high]},
        "resolution": friction.resolution,
        "notes": list(log.notes),
        "provenance": {"version": __version__, "log": (log.source or ("log", ""))[0]},
    }
