"""Friction over speed from the rows of a log at nearly constant speed: no mass, no filter, both directions apart."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.files.torque_logs.motion import Floats

#: Rows that follow each other count as steady if so many have speeds within this share of their mean.
LEAST_ROWS, STEADY = 4, 0.05
#: The speed of a stretch is so many times the step in which speeds are written, or more.
RESOLVED = 10.0
#: Stretches whose speeds differ by no more than this share are of one speed.
SAME_SPEED = 0.15
#: Speeds tell an exponent if the fastest is so many times the slowest.
WIDE = 3.0
#: Half of a 95 % interval over the standard error.
_QUANTILE = 1.96


@dataclasses.dataclass(frozen=True)
class SteadySpeed:
    """The drive at one speed: friction is half the difference of the two directions, the offset half their sum."""

    speed: float
    forward: float
    backward: float
    #: Standard error of the friction, by the scatter of the stretches.
    std: float
    rows: int
    stretches: int

    @property
    def friction(self) -> float:
        """What both directions need alike."""
        return (self.forward - self.backward) / 2

    @property
    def offset(self) -> float:
        """What one direction needs more than the other: gravity, and the zero error."""
        return (self.forward + self.backward) / 2


@dataclasses.dataclass(frozen=True)
class SteadyFriction:
    """Friction over speed, and its exponent with a 95 % interval; NaN where no two speeds differ by :data:`WIDE`."""

    speeds: Sequence[SteadySpeed]
    exponent: float
    interval: tuple[float, float]
    #: Step in which speeds are written, m/s.
    resolution: float


def steady_friction(*logs: MovingLog) -> SteadyFriction:
    """Friction over speed of ``logs`` of one axis, which have a speed, from their rows at nearly constant speed.

    What drives may be a force, or a current where no torque constant is known: the result is in its unit.

    Raises :class:`~ballscrew.basis.errors.InputError` for a log without a speed, or without such rows in both
    directions.
    """
    stretches: list[tuple[float, float, int]] = []
    resolution, name = 0.0, "log"
    for log in logs:
        name = log.source[0] if log.source else "log"
        if log.speed is None:
            raise InputError(Fault(name, "has no column of a speed", "", "log the speed, or fit the motion"))
        speed: Floats = np.asarray(log.speed, dtype=float)
        steps = np.diff(np.unique(np.abs(speed[np.isfinite(speed)])))
        step = float(np.min(steps[steps > 0], initial=np.inf))
        stretches += _stretches(speed, np.asarray(log.force, dtype=float), RESOLVED * step)
        resolution = max(resolution, step)
    speeds: list[SteadySpeed] = []
    while stretches:
        slowest = min(abs(one[0]) for one in stretches)
        near = [one for one in stretches if abs(one[0]) <= slowest * (1 + SAME_SPEED)]
        stretches = [one for one in stretches if one not in near]
        if (steady := _at_one_speed(near)) is not None:
            speeds.append(steady)
    if not speeds:
        remedy = "record strokes at constant speed in both directions"
        raise InputError(Fault(name, "has no rows at constant speed in both directions", "", remedy))
    return SteadyFriction(speeds, *_exponent(speeds), resolution)


def _stretches(speed: Floats, force: Floats, slowest: float) -> list[tuple[float, float, int]]:
    """Mean speed, mean force and rows of each stretch at nearly constant speed; its first and last row do not count."""
    stretches: list[tuple[float, float, int]] = []
    start = 0
    for row in range(1, speed.size + 1):
        mean = float(np.mean(speed[start:row]))
        if row < speed.size and abs(speed[row] - mean) <= STEADY * abs(mean):
            continue
        inner = slice(start + 1, row - 1)
        if row - start >= LEAST_ROWS and abs(mean) >= slowest and np.isfinite(force[inner]).all():
            stretches.append((mean, float(np.mean(force[inner])), row - start - 2))
        start = row
    return stretches


def _at_one_speed(near: Sequence[tuple[float, float, int]]) -> SteadySpeed | None:
    """The drive at the speed of some stretches; None unless two or more are of each direction."""
    forward = [force for speed, force, _ in near if speed > 0]
    backward = [force for speed, force, _ in near if speed < 0]
    if min(len(forward), len(backward)) < 2:
        return None
    errors = [float(np.std(one, ddof=1)) / np.sqrt(len(one)) for one in (forward, backward)]
    return SteadySpeed(
        speed=float(np.mean([abs(speed) for speed, *_ in near])),
        forward=float(np.mean(forward)),
        backward=float(np.mean(backward)),
        std=float(np.hypot(*errors)) / 2,
        rows=sum(rows for *_, rows in near),
        stretches=len(near),
    )


def _exponent(speeds: Sequence[SteadySpeed]) -> tuple[float, tuple[float, float]]:
    """The exponent n of friction ∝ speedⁿ by weighted least squares of the logarithms, with its 95 % interval."""
    known = [one for one in speeds if one.friction > 0 and one.std > 0]
    if not known or max(one.speed for one in known) < WIDE * min(one.speed for one in known):
        return np.nan, (np.nan, np.nan)
    x, y = (np.log([getattr(one, name) for one in known]) for name in ("speed", "friction"))
    weights: Any = np.array([(one.friction / one.std) ** 2 for one in known])
    x, y = x - np.average(x, weights=weights), y - np.average(y, weights=weights)
    spread = float(np.sum(weights * x**2))
    slope = float(np.sum(weights * x * y)) / spread
    # the scatter about the line where it is more than that of the stretches
    scatter = max(1.0, float(np.sum(weights * (y - slope * x) ** 2)) / max(len(known) - 2, 1))
    half = _QUANTILE * math.sqrt(scatter / spread)
    return slope, (slope - half, slope + half)
