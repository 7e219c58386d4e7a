r"""The equation of motion of an axis at the rows of a log, both sides through one low-pass.

.. math:: F = M a + F_g + \operatorname{sign}(v) \\cdot F_f(|v|, \dots)
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.moving_logs.filtering import (
    EDGE_PERIODS,
    Kinematics,
    band_of_force,
    kinematics,
    low_pass,
)
from ballscrew.evidence.moving_logs.moving_log import REST, MovingLog
from ballscrew.evidence.moving_logs.regression import LeastSquares
from ballscrew.files.torque_logs.motion import Floats

#: A speed is rest if it is not so many times its noise.
CLEAR = 6.0
#: A row counts if so much of what the low-pass takes in is motion: friction at rest is no number.
_MOVING = 0.9
#: Rows of the filtered sides are thinned to so many for each period of the cutoff.
ROWS_PER_PERIOD = 5.0
#: A dead time is corrected if it is at least one step of time, its interval included; so often it is found anew.
_ROUNDS = 3
#: No dead time is known better than this share of a step of time, within which nobody says when a sample was taken.
_OF_A_STEP = 0.1


#: Reasons for leaving rows out.
FAULTY, AT_REST = "outside the longest stretch without a fault", "at rest or too slow"
AT_ENDS, THINNED = (
    "at the ends, where the filters have no neighbours",
    "thinned to one in {}: filtered, they tell no more",
)


@dataclasses.dataclass(frozen=True, eq=False)
class Equation:
    """Both sides of the equation of motion: the force, and what the models make their side from."""

    log: MovingLog
    kinematics: Kinematics
    #: Cutoff of the low-pass of both sides, Hz.
    cutoff: float
    #: Delay of the motion behind the force that was taken off, s.
    shift: float
    #: The rows that the fit uses: those that move, thinned.
    used: NDArray[np.int64]
    #: The filtered force at these rows.
    force: Floats
    #: Speeds at or below this are rest, m/s.
    rest: float
    #: Rows of the log that are not used, by reason; with those used, all that were read.
    left_out: Mapping[str, int] = dataclasses.field(default_factory=dict[str, int])

    @classmethod
    def of(
        cls,
        log: MovingLog,
        *,
        cutoff: float | None = None,
        path_cutoff: float | None = None,
        shift: float = 0.0,
        slowest: float = 0.0,
    ) -> Equation:
        """The equation of a checked log.

        ``cutoff`` (of both sides) and ``path_cutoff`` (of the position), in Hz, stand in place of what the noise asks
        for; rows slower than ``slowest`` (m/s) are left out; ``shift`` (s) is how long the motion follows the force.
        """
        path = log.columns[log.path_column]
        motion = kinematics(path, log.step, is_speed=log.position is None, cutoff=path_cutoff)
        rest = max(CLEAR * motion.speed_noise, REST * float(np.max(np.abs(motion.speed))))
        if cutoff is None:
            columns = _linear_columns(motion)
            values = np.linalg.lstsq(columns, log.force, rcond=None)[0]
            explained = columns @ values
            cutoff = band_of_force(explained, log.force - explained, log.step)
        # never beyond what is left of the position, nor so low that the log is one period
        cutoff = float(np.clip(cutoff, min(2.0 / (log.time[-1] - log.time[0]), motion.cutoff), motion.cutoff))
        moving = low_pass((np.abs(motion.speed) > max(rest, slowest)).astype(float), cutoff, log.step) > _MOVING
        turning = np.count_nonzero(moving)
        edge = min(int(EDGE_PERIODS / (cutoff * log.step)), len(log) // 10)
        moving[:edge] = moving[len(log) - edge :] = False
        stride = max(1, int(1 / (ROWS_PER_PERIOD * cutoff * log.step)))
        inside = np.flatnonzero(moving)
        used = inside[inside % stride == 0]
        counts = {
            FAULTY: log.rows - len(log),
            AT_REST: len(log) - int(turning),
            AT_ENDS: int(turning) - inside.size,
            THINNED.format(stride): inside.size - used.size,
        }
        left_out = {reason: count for reason, count in counts.items() if count > 0}
        made = cls(log, motion, cutoff, shift, used, np.empty(0), rest, left_out)
        force = np.interp(log.time - shift, log.time, log.force) if shift else log.force
        return dataclasses.replace(made, force=made.filtered(force))

    def filtered(self, values: Floats) -> Floats:
        """Values at every row of the log through the low-pass of both sides, at the rows that are used."""
        return low_pass(values, self.cutoff, self.log.step)[self.used]

    @property
    def speed(self) -> Floats:
        """Speed at every row of the log, m/s."""
        return self.kinematics.speed

    @property
    def acceleration(self) -> Floats:
        """Acceleration at every row of the log, m/s²."""
        return self.kinematics.acceleration

    @property
    def direction(self) -> Floats:
        """Sign of the speed at every row of the log, zero at rest."""
        return np.where(
            np.abs(self.speed) > min(self.rest, CLEAR * self.kinematics.speed_noise), np.sign(self.speed), 0.0
        )

    @property
    def duration(self) -> float:
        """Time that the rows used stand for, s."""
        stride = int(np.min(np.diff(self.used))) if self.used.size > 1 else 1
        return self.used.size * stride * self.log.step

    @property
    def periods(self) -> float:
        """Periods of the cutoff in that time."""
        return self.duration * self.cutoff


def _linear_columns(motion: Kinematics) -> Floats:
    speed = motion.speed
    return np.stack([motion.acceleration, np.ones(speed.size), np.sign(speed), speed], axis=1)


@dataclasses.dataclass(frozen=True)
class DeadTime:
    """How long the motion follows the force, s, with half its interval; ``corrected`` where it is taken off."""

    value: float
    half_width: float
    corrected: bool


def dead_time(equation: Equation) -> tuple[DeadTime, Equation]:
    """The dead time of a log, and its equation with it taken off if it is a step of time or more.

    The force is followed by what it does: F(t) = f(t + τ) ≈ f + τ f′ with f the right-hand side. A dead time below one
    step of time is within the way that samples are taken, and stays.
    """
    total, result = equation.shift, np.zeros(2)
    for _ in range(_ROUNDS):
        columns = _linear_columns(equation.kinematics)
        sides = equation.filtered(columns)
        values = np.linalg.lstsq(sides, equation.force, rcond=None)[0]
        slope = equation.filtered(
            np.gradient(low_pass(columns @ values, equation.kinematics.cutoff, equation.log.step))
        )
        solved = LeastSquares.of(np.column_stack([sides, slope / equation.log.step]), equation.force)
        result = np.array([solved.values[-1], solved.half_width()[-1]])
        step = equation.log.step
        if abs(result[0]) - result[1] < step or abs(total + result[0]) > equation.log.step * len(equation.log) / 20:
            break
        total += float(result[0])
        equation = Equation.of(
            equation.log, cutoff=equation.cutoff, path_cutoff=equation.kinematics.cutoff, shift=total
        )
    corrected = equation.shift != 0
    value = equation.shift + float(result[0])
    return DeadTime(value, max(float(result[1]), _OF_A_STEP * equation.log.step), corrected), equation
