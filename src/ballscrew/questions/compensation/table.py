"""Compensations of positions as lists that controls read: SINUMERIK, and TwinCAT CNC with the ISG kernel.

Each has the form of the example in its manual, and was never read by a control:

- SINUMERIK, Function Manual Extended Functions (6FC5397), K3, measuring system error compensation: positions and
  values in mm; the value is added to the actual position, so that a positive one moves the axis in the negative
  direction. Comments stand behind ``;``, as there.
- TwinCAT CNC TF5200, leadscrew error compensation ``kw.ssfk.*`` (infosys.beckhoff.com, "Example of a compensation
  value list"): positions and values in 0.1 µm; the value is the measured position less the programmed one. Lines of
  comment start with ``#`` and a blank ("Comments in the ASCII list file").

HEIDENHAIN's ``.COM`` tables are not written: no manual with their whole form was found.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

import numpy as np

from ballscrew.questions.compensation.compute import PositionCompensation

_WIDTH = 28


def sinumerik(position_compensation: PositionCompensation, axis: str) -> str:
    """``_N_AX_EEC_INI`` of a machine axis, ``X1``."""
    points = enumerate((1e3 * position_compensation.errors).tolist())
    first, last = (1e3 * float(position_compensation.positions[end]) for end in (0, -1))
    lines = [
        "%_N_AX_EEC_INI",
        "CHANDATA(1)",
        *(f"$AA_ENC_COMP[0,{k},{axis}]={value:.5f}" for k, value in points),
        f"$AA_ENC_COMP_STEP[0,{axis}]={1e3 * position_compensation.step:.6f}",
        f"$AA_ENC_COMP_MIN[0,{axis}]={first:.4f} ; {position_compensation.mounting}",
        f"$AA_ENC_COMP_MAX[0,{axis}]={last:.4f} ; {_state(position_compensation)}",
        f"$AA_ENC_COMP_IS_MODULO[0,{axis}]=0",
        "M17",
        "",
    ]
    return "\n".join(lines)


def isg(position_compensation: PositionCompensation, axis: str) -> str:
    """``kw.ssfk.*`` for both directions, of an axis by its name."""
    positions, values = (
        np.round(1e7 * each).astype(int).tolist()
        for each in (position_compensation.positions, position_compensation.errors)
    )
    entries: dict[str, object] = {
        "kopf.log_achs_name": axis,
        "kw.ssfk.interval": 0,
        "kw.ssfk.kw_startpos": positions[0],
        "kw.ssfk.kw_nr_max": len(positions),
        "kw.ssfk.unit": 1,
        "kw.ssfk.bilateral": 1,
    }
    for name, column in (("setpoint", positions), ("pos", values), ("neg", values)):
        entries |= {f"kw.ssfk.table[{k}].{name}": value for k, value in enumerate(column)}
    said = (f"# {line}" for line in (position_compensation.mounting, _state(position_compensation)))
    return "\n".join([*said, *(f"{name:<{_WIDTH}} {value}" for name, value in entries.items()), ""])


def _state(position_compensation: PositionCompensation) -> str:
    return f"holds after {position_compensation.hours:g} h of the work of its case only"


#: The lists by the name of the control.
LISTS: Mapping[str, Callable[[PositionCompensation, str], str]] = {"sinumerik": sinumerik, "isg": isg}
