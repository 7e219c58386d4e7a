"""The growth of a warm shaft as a compensation of positions: even steps along the axis, with what they miss."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ballscrew._arrays import ByValue
from ballscrew.axis_studies.warm_up import HOUR, WarmUpReport
from ballscrew.errors import Fault, InputError
from ballscrew.motion.states import Numbers
from ballscrew.quantities import Duration

#: Distance of the points of a list, m, and the number of points at most (SINUMERIK 808D).
STEP, MOST = 0.02, 200
#: How much finer the growth is looked at where the error is measured.
_FINER = 20


@dataclasses.dataclass(frozen=True, eq=False)
class PositionCompensation(ByValue):
    """Positions of an axis at even steps, and by how much the nut is farther along there than its encoder says, m.

    The encoder is that of the motor. It is the growth at the last instant of work, less that at the reference.
    """

    positions: Numbers
    errors: Numbers
    #: What straight lines between the positions miss of the growth, m.
    worst_error: float
    hours: float

    @property
    def step(self) -> float:
        """Distance of the positions, m."""
        return float((self.positions[-1] - self.positions[0]) / (len(self.positions) - 1))


def position_compensation(
    report: WarmUpReport, hours: float, *, zero: float = 0.0, step: float = STEP, reference: float | None = None
) -> PositionCompensation:
    """The compensation of the growth of a shaft after some hours of work.

    ``zero`` is the place on the shaft, from its fixed bearing, at which the position of the axis is zero; positions
    grow away from the bearing. At the ``reference``, a position of the axis, nothing is compensated: by default at the
    fixed bearing, which does not move. Raises :class:`~ballscrew.errors.InputError` for a step that is not positive
    or too small, for a reference beyond the shaft, and where the warm-up stopped before the hours.
    """
    if report.warm_up.stopped is not None:
        raise InputError(_stopped(report.warm_up.stopped, hours))
    length = float(report.warm_up.network.shaft.length)
    if not length / (MOST - 1) <= step <= length:
        given = f"{1000 * step:g} mm"
        remedy = f"give {1000 * length / (MOST - 1):.3g} mm to {1000 * length:.4g} mm"
        raise InputError(Fault("--step", f"makes more than {MOST} points, or less than two", given, remedy))
    at = 0.0 if reference is None else reference + zero
    if not 0 <= at <= length:
        ends = f"{-1000 * zero:g} mm to {1000 * (length - zero):g} mm"
        raise InputError(Fault("--reference", "is beyond the shaft", f"{1000 * (at - zero):g} mm", f"it is {ends}"))
    places, growth = report.warm_up.compensation_table(step / _FINER)
    even = np.linspace(0.0, length, int(np.ceil(length / step - 1e-9)) + 1)
    errors = np.interp(even, places, growth)
    missed = float(np.max(np.abs(np.interp(places, even, errors) - growth)))
    return PositionCompensation(even - zero, errors - float(np.interp(at, places, growth)), missed, hours)


def _stopped(stopped: Duration, hours: float) -> Fault:
    """The fault of a warm-up that never came as far as the hours."""
    reached = math.floor(100 * stopped / HOUR) / 100
    problem = f"the warm-up stops after {reached:.2f} h: beyond it oil or preload are outside what the model knows"
    less = f"write --hours {reached:g} at most, or " if reached else ""
    return Fault("--hours", problem, f"{hours:g}", f"{less}look at ballscrew warm-up: less work, or more cooling")
