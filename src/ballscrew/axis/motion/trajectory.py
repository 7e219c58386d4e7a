"""Trajectories: a recorded motion as states, its noise measured and smoothed by no more than that asks for."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ballscrew.axis.motion.states import MotionStates, Numbers
from ballscrew.basis.arrays import ByValue, compact, lazy
from ballscrew.basis.errors import MISSING, Fault, raise_if_any, shown
from ballscrew.basis.quantities import Acceleration

#: Numbers of samples on either side that a smoothing reaches.
HALF_WIDTHS = (0, 1, 2, 4, 8, 16, 32, 64)
#: Noise of the acceleration, as a share of a typical acceleration, for which no wider smoothing is taken.
NOISE_SHARE = 0.05
#: Quantile of the sizes of the accelerations that stands for an acceleration of the motion.
_TYPICAL = 0.95
#: A step of time so many times the usual one is a gap.
LARGEST_STEP = 10.0
#: Usual steps of time outside these are no record of a machine, but a clock of another unit, s.
USUAL_STEPS = (1e-9, 1e5)
#: From the median of absolute fourth differences to the standard deviation of one sample: 1.4826/√70. A fourth
#: difference of a smooth motion is nearly zero, where its second one is an acceleration.
_FOURTH_DIFFERENCE = 1.4826 / math.sqrt(70.0)
#: Fourth differences below this share of the stroke are rounding; if fewer than this share of the samples have larger
#: ones, these are corners of the motion and no noise.
_ROUNDING, _HEARD = 1e-12, 0.05
#: Speeds within so many standard deviations of their noise count as rest.
_REST = 3.0
_NAME = "recorded motion"


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Trajectory(ByValue):
    r"""A recorded motion: times with positions or speeds, perhaps with forces of the process and temperatures.

    Speeds are slopes of straight lines through :math:`2 h + 1` positions, or means of as many speeds. The half width h
    is the smallest for which the noise of the acceleration is a twentieth of a typical acceleration; the noise itself
    is found from the fourth differences. Of each step of time there is one state in its middle, with the mean speed and
    the acceleration of the step, so that the kinetic energy is exact. Speeds within three deviations of their noise are
    rests. Raises :class:`~ballscrew.basis.errors.InputError` for neither positions nor speeds, arrays of different
    sizes, numbers that are not finite, times that do not rise, and gaps.
    """

    time: Numbers
    position: Numbers | None = None
    speed: Numbers | None = None
    #: Force of the process, positive against positive motion, N.
    force: Numbers | None = None
    #: Temperature of the oil, K; where a row has none, that between the rows beside it.
    temperature: Numbers | None = None
    #: Half width of the smoothing; None for the one that the noise asks for.
    half_width: int | None = None
    #: Where it was recorded, for people.
    source: str = ""

    def __post_init__(self) -> None:
        raise_if_any(self._faults())

    def _faults(self) -> list[Fault]:
        given = {"position": self.position, "speed": self.speed, "force": self.force, "temperature": self.temperature}
        faults = [
            Fault(f"trajectory.{name}", "has another size than the times", str(np.size(values)), "give one a time")
            for name, values in given.items()
            if values is not None and np.shape(values) != np.shape(self.time)
        ]
        if self.position is None and self.speed is None:
            faults.append(Fault("trajectory.position", MISSING, "", "give positions, or speeds"))
        if np.size(self.time) < 3:
            faults.append(Fault("trajectory.time", "has too few samples", str(np.size(self.time)), "3 at least"))
        if faults:
            return faults
        for name, values in {"time": self.time, **given}.items():
            if values is not None and name != "temperature" and not np.isfinite(values).all():
                sample = int(np.argmin(np.isfinite(values))) + 1
                faults.append(Fault(f"trajectory.{name}", "must be finite", f"sample {sample}", "leave it out"))
        return faults or faults_of_times(self.time, "trajectory.time sample {0}", np.arange(1, 1 + np.size(self.time)))

    @lazy
    def _step(self) -> float:
        return float(np.median(np.diff(self.time)))

    @lazy
    def _filled_temperature(self) -> Numbers:
        """Temperatures, between the rows that have one; NaN where none has."""
        none = np.broadcast_to(np.nan, np.shape(self.time))
        return none if self.temperature is None else _filled(self.time, np.asarray(self.temperature, dtype=float))

    @lazy
    def noise(self) -> float:
        """Standard deviation of one sample of what is recorded: of the position, m, or of the speed, m/s."""
        values = self.speed if self.position is None else self.position
        assert values is not None
        fourth = np.abs(np.diff(values, 4))
        # an encoder that counts steps is silent at rest, and at speeds of whole steps
        heard = fourth[fourth > _ROUNDING * float(np.ptp(values))]
        return _FOURTH_DIFFERENCE * float(np.median(heard)) if heard.size > _HEARD * fourth.size else 0.0

    def acceleration_noise(self, half_width: int) -> Acceleration:
        """Standard deviation that the noise gives the acceleration with a smoothing of that half width, m/s²."""
        return self.noise * float(np.linalg.norm(np.diff(self._kernel(half_width), prepend=0, append=0))) / self._step

    def _speed_noise(self, half_width: int) -> float:
        return self.noise * float(np.linalg.norm(self._kernel(half_width)))

    def _kernel(self, half_width: int) -> Numbers:
        """Weights of one sample for the speeds around it."""
        if self.position is None:
            return np.full(2 * half_width + 1, 1.0 / (2 * half_width + 1))
        place = np.arange(-max(half_width, 1), max(half_width, 1) + 1, dtype=float)
        return place / float(np.sum(place**2)) / self._step

    @lazy
    def chosen_half_width(self) -> int:
        """The half width of the smoothing: the one given, or the smallest that the noise allows."""
        if self.half_width is not None:
            return self.half_width
        widths = [width for width in HALF_WIDTHS if width or self.position is None]
        for width in widths:
            sizes = np.abs(np.diff(self._speeds(width)) / np.diff(self.time))
            if self.acceleration_noise(width) <= NOISE_SHARE * float(np.quantile(sizes, _TYPICAL)):
                return width
        return widths[-1]

    def _speeds(self, half_width: int) -> Numbers:
        """Speeds at the times."""
        if self.position is None:
            assert self.speed is not None
            return _means(self.speed, half_width) if half_width else self.speed
        return _slopes(self.time, self.position, max(half_width, 1))

    def smoothed_by(self, half_width: int) -> Trajectory:
        """The same record with another half width."""
        return dataclasses.replace(self, half_width=half_width)

    def states(self) -> MotionStates:
        """One state for each step of time."""
        width = self.chosen_half_width
        speed = self._speeds(width)
        resting = np.abs(speed) <= _REST * self._speed_noise(width)
        speed = np.where(resting, 0.0, speed)
        step = np.diff(self.time)
        mean = _middle(speed)
        position = self.position
        if position is None:
            position = np.concatenate([[0.0], np.cumsum(mean * step)])
        nothing = np.zeros_like(self.time)
        return MotionStates(
            time=_middle(self.time),
            weight=step,
            position=_middle(position),
            speed=mean,
            acceleration=np.diff(speed) / step,
            direction=np.sign(mean),
            force=compact(_middle(nothing if self.force is None else self.force)),
            temperature=compact(_middle(self._filled_temperature)),
            phase=compact(np.zeros(step.shape, dtype=np.intp)),
            phases=(_NAME,),
            speeds_of_ends=((float(speed[0]), float(speed[-1])),),
        )


def _filled(time: Numbers, values: Numbers) -> Numbers:
    """Values with straight lines where there are none, if there is any."""
    known = ~np.isnan(values)
    return np.interp(time, time[known], values[known]) if known.any() else values


def faults_of_times(time: Numbers, where: str, lines: np.ndarray) -> list[Fault]:
    """The first time that does not rise, a step that no machine is recorded at, and the first gap.

    ``where`` is a text with ``{0}`` for the line of a time.
    """
    step = np.diff(time)
    faults: list[Fault] = []
    back = np.flatnonzero(step <= 0)
    if back.size:
        at = int(back[0])
        problem = "time runs back" if step[at] < 0 else "time stands still"
        given = f"{shown(float(time[at + 1]), 's')} after {shown(float(time[at]), 's')}"
        faults.append(Fault(where.format(lines[at + 1]), problem, given, "sort the rows, or cut the record there"))
        return faults
    usual = float(np.median(step))
    least, greatest = USUAL_STEPS
    if not least <= usual <= greatest:
        remedy = f"{shown(least, 's')} to {shown(greatest, 's')}: check the unit of the time"
        return [Fault(where.format(lines[1]), "has an unlikely step of time", shown(usual, "s"), remedy)]
    gap = np.flatnonzero(step > LARGEST_STEP * usual)
    if gap.size:
        at = int(gap[0])
        given = f"{shown(float(step[at]), 's')}, usually {shown(usual, 's')}"
        remedy = "cut the record there, or fill in the rows that are missing"
        faults.append(Fault(where.format(lines[at + 1]), "comes after a gap", given, remedy))
    return faults


def _middle(values: Numbers) -> Numbers:
    return (values[1:] + values[:-1]) / 2


def _means(values: Numbers, half_width: int) -> Numbers:
    """Means of the values around each, of fewer at the ends."""
    sums = np.concatenate([[0.0], np.cumsum(values)])
    place = np.arange(values.size)
    reach = np.minimum(half_width, np.minimum(place, values.size - 1 - place))
    return (sums[place + reach + 1] - sums[place - reach]) / (2 * reach + 1)


def _slopes(time: Numbers, position: Numbers, half_width: int) -> Numbers:
    """Slopes of the lines through the positions around each, through fewer at the ends."""
    place = np.arange(time.size)
    sums = np.zeros((5, time.size))
    for offset in range(-half_width, half_width + 1):
        other = np.clip(place + offset, 0, time.size - 1)
        counts = other == place + offset
        dt, dx = np.where(counts, time[other] - time, 0.0), np.where(counts, position[other] - position, 0.0)
        sums += counts, dt, dx, dt * dx, dt * dt
    count, of_t, of_x, of_both, of_squares = sums
    slopes: Numbers = (of_both - of_t * of_x / count) / (of_squares - of_t**2 / count)
    return slopes
