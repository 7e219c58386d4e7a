"""The rows of a vendor that are most like a nut, and how the model compares with them."""

from __future__ import annotations

import csv
import functools
import math
import re
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import NamedTuple

import numpy as np

from ballscrew.physics.components.nut import DoubleNut, Nut, OffsetLeadNut, OversizeBallNut
from ballscrew.physics.components.screw import BallScrew

#: Rows that count as near, and how far off the nearest may be, as a distance of logarithms of diameter and lead.
NEAREST, FARTHEST = 6, math.log(1.6)
#: The set of a kind of nut.
_SETS: Mapping[type[Nut], str] = {
    DoubleNut: "rexroth-double-nut",
    OffsetLeadNut: "rexroth-double-nut",
    OversizeBallNut: "rexroth-single-nut",
}
#: A column of least torques at a share of the dynamic load rating.
_LEAST = re.compile(r"no_load_torque_(\d+)pct_min_Nm")
#: The column of the model as it is.
UNCALIBRATED = "uncalibrated"


class NearRows(NamedTuple):
    """The reference model against the rows of a vendor nearest in size and lead: model / middle of the band."""

    data: str
    rows: Sequence[str]
    mean: float
    scatter: float
    #: Of each row model / middle, and the ends of the vendor's band of the no-load torque, N m.
    ratios: Sequence[float]
    bands: Sequence[tuple[float, float]]


def near_rows(screw: BallScrew, calibration: str | None = None) -> NearRows | None:
    """The rows of a vendor most like a preloaded screw, by the ratios of diameters and of leads.

    The ratios are those of the reference model, with a calibration by its name or without, as
    ``benchmarks/fit_calibration.py --write`` stored them; no load, 100 rpm. With a calibration they are the
    rows that it was fitted to. None for a nut that no set is about, such as one with spacer balls, that is far from
    all rows, and for a calibration that was not stored.
    """
    name = _SETS.get(type(screw.nut))
    rows = [row for row in _ratios() if row["set"] == name]
    column = calibration or UNCALIBRATED
    if not rows or column not in rows[0] or screw.nut.spacer_balls:
        return None
    place = math.log(float(np.mean(screw.pitch_circle_diameter))), math.log(float(np.mean(screw.lead)))
    distances = [
        math.hypot(math.log(float(row["size"])) - place[0], math.log(float(row["lead"])) - place[1]) for row in rows
    ]
    if not min(distances) <= FARTHEST:
        return None
    near = [rows[i] for i in np.argsort(distances, kind="stable")[:NEAREST]]
    ratios = [float(row[column]) for row in near]
    names = [row["row"] for row in near]
    bands = [_bands(str(name))[row] for row in names]
    return NearRows(str(name), names, float(np.mean(ratios)), float(np.std(ratios, ddof=1)), ratios, bands)


@functools.cache
def _ratios() -> Sequence[Mapping[str, str]]:
    return _read("ratios")


@functools.cache
def _bands(data: str) -> Mapping[str, tuple[float, float]]:
    """The no-load torques of a vendor's rows, least and greatest, by the names that the stored ratios have."""
    bands: dict[str, tuple[float, float]] = {}
    for row in _read(data):
        sizes = "x".join(row[f"{name}_mm"] for name in ("nominal_diameter", "lead", "ball_diameter"))
        for column, least in row.items():
            if (share := _LEAST.fullmatch(column)) is not None:
                greatest = float(row[column.replace("_min_", "_max_")])
                bands[f"{sizes}-{row['circuits']} at {share[1]} %"] = float(least), greatest
    return bands


def _read(data: str) -> Sequence[Mapping[str, str]]:
    text = resources.files("ballscrew").joinpath(f"data/validation/{data}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
