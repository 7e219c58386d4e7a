"""Friction force of a ball screw over speed and load, tabulated: a log has many rows and few different points.

A log of 25 000 rows would take a preloaded nut some 25 000 solutions of its balance for every step of the fit. The
friction is smooth: it is evaluated on a grid of speeds and loads, and read between them; what that costs is stated.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from ballscrew.basis.quantities import Quantity
from ballscrew.engine.evaluation.evaluator import Evaluator, evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.response import initial_value, resolve_input
from ballscrew.files.torque_logs.motion import Floats

#: Speeds and loads of the grid.
SPEEDS, LOADS = 24, 9
#: The same for nuts whose balls differ, which take a hundred times as long for a point.
SPEEDS_BY_BALL, LOADS_BY_BALL = 10, 3
#: The slowest speed of the grid, as a share of the fastest; below it the friction is that of the slowest.
SLOWEST = 1e-3
#: A number may move by so many times what the case says, to either side.
LARGEST_FACTOR = 50.0
#: Points at which the table is compared with the model.
_COMPARED = 64


@dataclasses.dataclass(frozen=True, eq=False)
class ScrewFriction:
    """The friction force of the balls of a screw along the axis, N, for any values of its free numbers."""

    subject: Configuration
    #: The free numbers by their full names, and as they were asked for.
    names: tuple[str, ...]
    asked: tuple[str, ...]
    fastest: float
    largest_load: float

    @classmethod
    def of(
        cls, subject: Configuration, free: Sequence[str], fastest: float, largest_load: float, section: str = "fit"
    ) -> ScrewFriction:
        """``fastest`` is the largest speed of the nut (m/s), ``largest_load`` the largest axial load on it (N).

        Raises :class:`~ballscrew.basis.errors.InputError` for names that the model does not have.
        """
        names = tuple(resolve_input(subject, name, section) for name in free)
        return cls(subject, names, tuple(free), fastest, largest_load)

    @functools.cached_property
    def start(self) -> Floats:
        """The values of the free numbers in the case."""
        return np.array([initial_value(self.subject, name) for name in self.names])

    @functools.cached_property
    def bounds(self) -> tuple[Floats, Floats]:
        """Bounds of the free numbers: their own, and a factor to either side of the case."""
        low, high = np.empty(len(self.names)), np.empty(len(self.names))
        for place, (quantity, start) in enumerate(zip(self.quantities, self.start.tolist(), strict=True)):
            info = quantity.info
            ends = sorted((start / LARGEST_FACTOR, start * LARGEST_FACTOR)) if start else [0.0, math.inf]
            lows = [end for end in (info.at_least, info.above) if end is not None]
            highs = [end for end in (info.at_most, info.below) if end is not None]
            low[place], high[place] = max([ends[0], *lows]), min([ends[1], *highs])
        return low, high

    @property
    def quantities(self) -> list[Quantity]:
        """The quantities of the free numbers."""
        return [self.subject.inputs[name][1] for name in self.names]

    @property
    def per_torque(self) -> float:
        """Force along the axis for each torque at the shaft: 2π over the lead, 1/m."""
        return 2 * math.pi / float(self.subject.screw.lead)

    @functools.cached_property
    def _evaluator(self) -> Evaluator:
        # a grid of some hundred points does not pay for the compiler, which takes seconds for a preloaded nut
        subject = self.subject
        return evaluator(
            subject.model,
            subject.screw,
            subject.lubricant,
            inputs=("axial_load", "screw_speed", *self.names),
            outputs=("screw_torque",),
            engine="numpy",
        )

    def at(self, values: Floats, speed: Floats, load: Floats) -> Floats:
        """The friction force of the model itself, at speeds > 0 (m/s) and loads (N) against the motion."""
        result = self._evaluator(load, speed * self.per_torque, *values)
        return self.per_torque * np.asarray(result["screw_torque"], dtype=np.float64)

    def table(self, values: Floats) -> FrictionTable:
        """The friction force over speed and load for values of the free numbers."""
        return self.tables(values[np.newaxis])[0]

    def tables(self, values: Floats) -> list[FrictionTable]:
        """The tables for several values of the free numbers, one in each row, evaluated at once."""
        by_ball = self.subject.nut.one_by_one
        count = (SPEEDS_BY_BALL, LOADS_BY_BALL) if by_ball else (SPEEDS, LOADS)
        speeds = self.fastest * np.geomspace(SLOWEST, 1.0, count[0])
        loads = max(self.largest_load, 1e-9) * np.linspace(-1.0, 1.0, count[1])
        each = values.T[..., np.newaxis, np.newaxis]
        grids = self.at(each, *(np.broadcast_to(one, (len(values), *one.shape)) for one in np.meshgrid(speeds, loads)))
        return [FrictionTable(speeds, loads, grid) for grid in grids]

    def table_error(self, values: Floats, speed: Floats, load: Floats) -> float:
        """The largest difference of the table from the model at some of the given points, as a share of the largest."""
        chosen = np.random.default_rng(0).choice(speed.size, min(_COMPARED, speed.size), replace=False)
        speeds = np.clip(speed[chosen], SLOWEST * self.fastest, self.fastest)
        there = self.at(values, speeds, load[chosen])
        off = np.abs(self.table(values)(speeds, load[chosen]) - there)
        return float(np.max(off) / max(float(np.max(np.abs(there))), np.finfo(float).tiny))


class FrictionTable:
    """Friction force over speed (cubic, over its logarithm) and load (straight lines: it bends at zero)."""

    def __init__(self, speeds: Floats, loads: Floats, grid: Floats) -> None:
        self.is_finite = bool(np.isfinite(grid).all())
        self._speeds, self._loads = np.log(speeds), loads
        # a piece of a cubic for each interval of speed and each load
        self._pieces = CubicSpline(self._speeds, np.nan_to_num(grid).T).c

    def __call__(self, speed: Floats, load: Floats) -> Floats:
        """The friction force; beyond the ends of the grid that of its ends."""
        (before, after), share, _ = self._beside(speed, load)
        return (1 - share) * before + share * after

    def by_load(self, speed: Floats, load: Floats) -> Floats:
        """The slope by the load."""
        (before, after), _, width = self._beside(speed, load)
        return (after - before) / width

    def _beside(self, speed: Floats, load: Floats) -> tuple[tuple[Floats, Floats], Floats, float]:
        """The friction at the loads of the grid below and above, where between them, and how far they are apart."""
        x = np.log(np.clip(np.abs(speed), np.exp(self._speeds[0]), np.exp(self._speeds[-1])))
        place = np.clip(np.searchsorted(self._speeds, x, side="right") - 1, 0, self._speeds.size - 2)
        off = x - self._speeds[place]
        width = float(self._loads[1] - self._loads[0])
        within = np.clip((load - self._loads[0]) / width, 0.0, self._loads.size - 1.0)
        below = np.minimum(within.astype(np.int64), self._loads.size - 2)

        def at(column: NDArray[np.int64]) -> Floats:
            cubic, square, slope, value = (self._pieces[power, place, column] for power in range(4))
            return ((cubic * off + square) * off + slope) * off + value

        return (at(below), at(below + 1)), within - below, width
