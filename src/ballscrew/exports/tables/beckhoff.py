"""``--to beckhoff``: the friction over speed as entries of a compensation list of TwinCAT CNC (TF5200) and ISG-kernel.

The form is that of the example of the manual (infosys.beckhoff.com, tf5200_friction_comp, "Parameterisation"): at most
20 entries of a speed in µm/s, at least zero and ascending, and of a torque in the units of the drive. It was checked
against that example, and never read by a control.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.records import Record
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_curve import OPTIONS as OF_CURVES
from ballscrew.exports.tables.friction_curve import FrictionCurve, about, friction_curve, options_of_case
from ballscrew.exports.targets import Option

__all__ = ["OPTIONS", "export", "options_of_case"]

#: Entries of the list at most, if the control is not told otherwise (P-COMP-00042, P-COMP-00062).
ENTRIES = 20
#: All of the compensation, in 0.1 % (P-COMP-00045).
_WHOLE = 1000
OPTIONS: Mapping[str, Option] = {
    **OF_CURVES,
    "units_per_newton_metre": Option(1000.0, "units of the drive for one N m at the screw: 1000 for mN m"),
}
_WIDTH = 40


def export(handed: HandOver) -> Export:
    """The entries of the list."""
    scale = float(handed.options["units_per_newton_metre"])
    if not scale > 0:
        remedy = "give the units of the drive for one N m"
        raise InputError(Fault("hand_over.units_per_newton_metre", "must be positive", f"{scale:g}", remedy))
    # the entry of rest takes one place
    curve = friction_curve(handed, ENTRIES - 1)
    found = curve.export(handed, "beckhoff", _files(handed, curve, scale))
    rounding = 0.5 / scale
    share = rounding / float(curve.torques.min())
    percent = units.to_significant(100 * share, 2)
    message = f"torques are whole numbers of the drive: rounding adds up to {percent} % of the friction"
    record = Record(
        text=message,
        id="hand_over.rounding",
        subject="screw_torque",
        severity="warning" if share > 0.01 else "info",
        holds=share <= 0.01,
        value=share,
        limit=0.01,
    )
    return found if share <= 1e-3 else _with(found, record)


def _with(found: Export, record: Record) -> Export:
    return dataclasses.replace(found, warnings=(*found.warnings, record))


def _text(handed: HandOver, curve: FrictionCurve, scale: float) -> str:
    per_speed = 1e6 * float(handed.subject.screw.lead) / (2 * math.pi)
    speeds = np.unique(np.round(curve.speeds * per_speed)).astype(int)
    speeds = speeds[speeds > 0]
    torques = np.interp(speeds / per_speed, curve.speeds, curve.torques)
    pairs = [(0, 0), *zip(speeds.tolist(), np.round(torques * scale).astype(int).tolist(), strict=True)]
    entries: dict[str, int] = {
        "mode": 3,
        "table_entries": len(pairs),
        "position_delay": 0,
        "reversal_lookahead": 0,
        "scaling_factor": _WHOLE,
        "delay_cycles": 0,
    }
    for k, (speed, torque) in enumerate(pairs):
        entries |= {f"table[{k}].in": speed, f"table[{k}].out": torque}
    return "\n".join([*(f"{'frict_comp.' + name:<{_WIDTH}}{value}" for name, value in entries.items()), ""])


def _files(handed: HandOver, curve: FrictionCurve, scale: float) -> dict[str, bytes]:
    """The list, and its text beside it: the manual has no comments in lists."""
    text = [
        *about(handed, curve),
        f"in: µm/s of the axis; out: units of the drive, {scale:g} for one N m at the screw shaft; at rest none.",
        "Format checked against the example of the manual, not on a control. Switch it on with lr_param.frict_comp 1.",
        "",
    ]
    return {"friction_comp.lis": _text(handed, curve, scale).encode(), "README.txt": "\n".join(text).encode()}
