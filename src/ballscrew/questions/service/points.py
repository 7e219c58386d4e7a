"""Curves of a service: the model with the preload that was found, and the rows of its logs; SI."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ballscrew.evidence.calibration.fit import points_of
from ballscrew.evidence.calibration.fit_result import Rows
from ballscrew.evidence.calibration.oil_temperature import torque_of_model
from ballscrew.evidence.service.preload_estimate import PreloadEstimate
from ballscrew.questions.service.compute import ServiceReport
from ballscrew.questions.shared.log_points import Numbers, some

#: Points of a curve.
CURVE_POINTS = 80


class Curve(NamedTuple):
    """A log of a service over the speed: the model with its preload, and the rows moved to its load and temperature."""

    speed: Numbers
    torque: Numbers
    measured_speed: Numbers
    measured: Numbers


def curves(report: ServiceReport, most: int) -> dict[str, Curve]:
    """The curve of each log, with at most so many of its rows that are no outliers.

    Rows of other loads and temperatures are shown by what they are off the curve.
    """
    result: dict[str, Curve] = {}
    for label, one in report.estimates.items():
        if one.fit is None:
            continue
        rows = one.fit.rows
        x = np.abs(rows.log.screw_speed)
        along = np.geomspace(float(x.min()), float(x.max()), CURVE_POINTS) if np.ptp(x) > 0 else x[:1]
        curve = _friction(one, {**_usual(rows), "screw_speed": along})
        own = points_of(rows.log, one.fit.lubricant, rows.convention)
        measured = rows.friction + one.fit.constant_torque - rows.residuals * rows.direction
        measured = measured + _friction(one, {**_usual(rows), "screw_speed": x}) - _friction(one, own)
        places = some(np.flatnonzero(~rows.outlying), most)
        result[label] = Curve(along, curve, x[places], measured[places])
    return result


def _usual(rows: Rows) -> dict[str, Any]:
    """The median size of the load, with the sign that more of it has, and the mean temperature of a log."""
    load = rows.convention.loads(rows.log.axial_load, rows.log.screw_speed)
    usual: dict[str, Any] = {"axial_load": float(np.copysign(np.median(np.abs(load)), np.sum(load)))}
    if rows.log.temperature is not None:
        usual["temperature"] = float(np.mean(rows.log.temperature))
    return usual


def _friction(one: PreloadEstimate, points: Mapping[str, Any]) -> Numbers:
    """The friction torque with the preload and the numbers that were found."""
    assert one.subject is not None
    graded = one.subject.lubricant.follows_temperature
    there: dict[str, Any] = {"temperature": one.subject.lubricant.temperature, **points} if graded else dict(points)
    if not graded:
        there.pop("temperature", None)
    size = np.broadcast_arrays(*there.values())
    return torque_of_model(one.subject, dict(zip(there, size, strict=True)), np.array([[0.0], [1.0]]), one.warmer)
