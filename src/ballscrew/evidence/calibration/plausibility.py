"""Plausible ranges of fitted numbers: a fit finds the numbers that follow a log, and not whether a screw can have them.

A log of another nut, a wrong unit or an effect that the model lacks ends in numbers that no screw has. A boundary
friction coefficient lies within :data:`BOUNDARY_FRICTION`, a constant torque drives no screw beyond chance and is not
more than :data:`MOST_CONSTANT` of the friction measured, the median of all rows, a preload is at most
:data:`HIGHEST_PRELOAD` of the dynamic load rating, and all other numbers lie in the usual range of their input
(:class:`~ballscrew.basis.quantities.Info`).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import spoken
from ballscrew.basis.quantities import Force
from ballscrew.basis.records import Record
from ballscrew.evidence.calibration.fit_result import Estimate, FitResult
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE

#: The largest share that the seals have of a torque without load, of the rows of Rexroth2006 with their standard seals.
MOST_CONSTANT = 0.8
#: A preload above this share of the dynamic load rating is more than vendors allow.
HIGHEST_PRELOAD = 0.1
#: From the friction of a film, which that of touching surfaces is not below, to the highest coefficient in use.
BOUNDARY_FRICTION = 0.05, 0.2
_BOUNDARY = (
    "what steel and oil have: 0.05 is the friction of a film, 0.12 to 0.15 that of bearings that touch "
    "(SKF2018), 0.2 the highest in use (Olaru2005)"
)
_CONSTANT = (
    f"seals and bearings drive no screw, and make at most {units.number(100 * MOST_CONSTANT)} % of a torque "
    "without load (Rexroth2006)"
)
_RATING = f"{units.number(100 * HIGHEST_PRELOAD)} % of the dynamic load rating is the most that makers set"
_USUAL = "what screws have"
_REACHES, _AVOID = "its interval reaches into it", "do not predict with this fit"
_PRELOADS = ("preload", "nut.preload")


class _Range(NamedTuple):
    low: float
    high: float
    #: What has such numbers.
    reason: str


def verdict_records(fit_result: FitResult, dynamic_load_rating: Force | None = None) -> list[Record]:
    """A verdict for each fitted number that no screw has, in the order of the estimates."""
    limits = {
        name: _range(fit_result, full, estimate, dynamic_load_rating) for name, full, estimate in _named(fit_result)
    }
    return [
        _record(estimate, limit)
        for name, estimate in fit_result.estimates.items()
        if (limit := limits[name]) is not None
        and not limit.low <= estimate.value <= limit.high
        and not (name == CONSTANT_TORQUE.name and _is_zero_by_chance(estimate))
    ]


def _is_zero_by_chance(estimate: Estimate) -> bool:
    """Whether a number below zero reaches it by its interval: a true zero is found below it half of the time."""
    ends = estimate.interval()
    return estimate.value < 0 and ends is not None and ends[1] >= 0


def _named(fit_result: FitResult) -> list[tuple[str, str, Estimate]]:
    """The estimates with the names that they have as inputs."""
    full = [
        *fit_result.response.names,
        *([CONSTANT_TORQUE.name] if CONSTANT_TORQUE.name in fit_result.estimates else []),
    ]
    return [(name, inside, one) for inside, (name, one) in zip(full, fit_result.estimates.items(), strict=True)]


def _range(fit_result: FitResult, full: str, estimate: Estimate, rating: Force | None) -> _Range | None:
    if full == CONSTANT_TORQUE.name:
        rows = fit_result.rows
        measured = rows.friction + estimate.value - rows.direction * rows.residuals
        return _Range(0.0, MOST_CONSTANT * float(np.median(np.abs(measured))), _CONSTANT)
    if full in _PRELOADS and rating is not None:
        return _Range(0.0, HIGHEST_PRELOAD * float(rating), _RATING)
    if full.rpartition(".")[2] == "boundary_friction_coefficient":
        return _Range(*BOUNDARY_FRICTION, _BOUNDARY)
    usual = estimate.quantity.info.usual
    return None if usual is None else _Range(float(usual[0]), float(usual[1]), _USUAL)


def shown_with_interval(estimate: Estimate) -> str:
    """A fitted number with its interval, where it has one."""
    # at a bound but for rounding
    value = min(estimate.bounds, key=lambda end: abs(end - estimate.value)) if estimate.at_bound else estimate.value
    number, ends = units.shown(value, estimate.quantity), estimate.interval()
    if ends is None:
        return number
    low, high = (units.shown(end, estimate.quantity) for end in ends)
    return f"{number} (95 %: {low} to {high})"


def _record(estimate: Estimate, limit: _Range) -> Record:
    ends = estimate.interval()
    reaches = ends is not None and ends[0] <= limit.high and ends[1] >= limit.low
    low, high = (units.shown(end, estimate.quantity) for end in (limit.low, limit.high))
    message = (
        f"implausible: {spoken(estimate.name)} {shown_with_interval(estimate)} is outside {low} to {high} "
        f"({limit.reason}); {_REACHES if reaches else _AVOID}: look at units, signs and the kind of nut, free what "
        "the model lacks, or hold this number"
    )
    return Record(
        "fit.implausible",
        estimate.name,
        message,
        severity="warning" if reaches else "error",
        holds=None if reaches else False,
        value=estimate.value,
        limit=limit.low if estimate.value < limit.low else limit.high,
        unit=estimate.quantity.unit,
    )
