"""States of motion: position, speed and acceleration at instants, each with the time for which it stands.

Among the instants are those within phases where a quantity changes its sign, or is the largest. Between kinks a
quantity is smooth in a part of a phase, and the polynomial through its values there is as good as the quadrature of the
same nodes: nothing is computed again.
"""

from __future__ import annotations

import dataclasses
import functools
import itertools
from collections.abc import Callable, Iterable, Iterator, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Acceleration, Duration, Force, Jerk, Length, Speed, Temperature

Numbers = NDArray[np.float64]

#: Nodes of the quadrature of a phase. With 16, the mean of a friction that grows with the root of the speed is exact
#: to 1e-4 where the speed starts from zero, and powers of the time up to 31 are exact.
NODES = 16
#: Cuts of a phase that are nearer to each other, or to its ends, than this share of it, are one.
_NEAR = 1e-9


class Phase(Protocol):
    """A part of a motion in which speed and acceleration are smooth and the direction does not change."""

    @property
    def name(self) -> str:
        """Name for people: ``accelerates``, ``dwells``."""
        ...

    @property
    def duration(self) -> Duration:
        """Its time, s."""
        ...

    @property
    def force(self) -> Force:
        """Force of the process on the mass, positive against positive motion, N."""
        ...

    @property
    def temperature(self) -> Temperature | None:
        """Temperature of the oil in it, K; None for that of the case."""
        ...

    def at(self, time: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        """Position, speed and acceleration at times since its start."""
        ...


@dataclasses.dataclass(frozen=True)
class PolynomialPhase:
    """A phase of constant jerk."""

    name: str
    duration: Duration
    position: Length
    speed: Speed = 0.0
    acceleration: Acceleration = 0.0
    jerk: Jerk = 0.0
    force: Force = 0.0
    temperature: Temperature | None = None

    def at(self, time: Numbers) -> tuple[Numbers, Numbers, Numbers]:
        """Position, speed and acceleration at times since its start."""
        t, a, j = time, self.acceleration, self.jerk
        speed = self.speed + t * (a + t * j / 2)
        position = self.position + t * (self.speed + t * (a / 2 + t * j / 6))
        return position, speed, a + t * j + 0 * t

    @property
    def end(self) -> tuple[float, float, float]:
        """Position, speed and acceleration at its end."""
        position, speed, acceleration = self.at(np.asarray(float(self.duration)))
        return float(position), float(speed), float(acceleration)


@dataclasses.dataclass(frozen=True, eq=False)
class MotionStates(ByValue):
    """States of one cycle, in order of time.

    ``weight`` is the time for which a state stands: sums over the states with their weights are integrals over the
    cycle. Ends of phases have no weight: they are there for extremes and for pictures. ``direction`` is that of the
    motion, also at an end where the speed is zero; it is zero only in phases of rest.
    """

    time: Numbers
    weight: Numbers
    position: Numbers
    speed: Numbers
    acceleration: Numbers
    direction: Numbers
    #: Force of the process on the mass, positive against positive motion.
    force: Numbers
    #: NaN where it is that of the case.
    temperature: Numbers
    #: The index of the phase of each state.
    phase: NDArray[np.intp]
    #: The names of the phases.
    phases: tuple[str, ...]
    #: Speeds before and after each phase: of the kinetic energy, which a jump between phases does not count in.
    speeds_of_ends: tuple[tuple[float, float], ...]
    #: The phases in closed form, which can be cut; none of a recorded motion.
    source: tuple[Phase, ...] = ()

    @property
    def cycle_time(self) -> float:
        """Time of the cycle, s."""
        return float(np.sum(self.weight))

    def integral(self, values: Numbers) -> float:
        """Integral of values over the cycle."""
        return float(np.sum(self.weight * values))

    @property
    def travel(self) -> float:
        """Way of the cycle, forth and back, m."""
        return self.integral(np.abs(self.speed))

    @property
    def parts(self) -> Sequence[slice]:
        """The states of each part of a phase in closed form, from one end to the other; phases that rest are none."""
        if not self.source:
            return ()
        ends = np.flatnonzero(self.weight == 0).reshape(-1, 2)
        return [slice(int(first), int(last) + 1) for first, last in ends if self.direction[first] != 0]

    def cut_at(self, instants: Iterable[float]) -> MotionStates:
        """The same motion with its phases cut at these instants, too, and nodes of quadrature in each part."""
        return states_of(self.source, cuts=[*self.time[self.weight == 0].tolist(), *instants])

    def places_of(self, cut: MotionStates) -> NDArray[np.intp]:
        """The place among these states of each state of the same motion with more cuts; -1 of one in another part."""
        own, others = (np.bincount(states.phase, minlength=len(self.phases)) for states in (self, cut))
        shift = np.cumsum(own) - own - (np.cumsum(others) - others)
        result = np.arange(cut.time.size) + shift[cut.phase]
        return np.where((own == others)[cut.phase], result, -1)

    @property
    def stroke(self) -> float:
        """Distance between the ends of the motion, m."""
        return float(np.ptp(self.position))

    def places_on(self, shaft_length: Length, first_position: Length | None = None) -> Numbers:
        """Places of the nut on a shaft between its bearings, m from the first one.

        The motion starts at ``first_position`` (m), or is in the middle. Raises
        :class:`~ballscrew.basis.errors.InputError` where one that moves does not fit.
        """
        low, high = float(np.min(self.position)), float(np.max(self.position))
        start = (shaft_length - self.stroke) / 2 - low if first_position is None else float(first_position)
        if high > low and not 0 < start + low < start + high < shaft_length:
            ends = f"from {1e3 * (start + low):.4g} mm to {1e3 * (start + high):.4g} mm on {1e3 * shaft_length:.4g} mm"
            remedy = "shorten the stroke, move surroundings.first_position, or lengthen the shaft"
            raise InputError(Fault("motion", "does not fit between the bearings", ends, remedy))
        return start + self.position


@functools.cache
def _nodes(number: int) -> tuple[Numbers, Numbers]:
    """Nodes and weights of Gauss and Legendre on 0 to 1, between the two ends, which have no weight."""
    nodes, weights = np.polynomial.legendre.leggauss(number)
    return np.array([0.0, *(nodes + 1) / 2, 1.0]), np.array([0.0, *weights / 2, 0.0])


def states_of(phases: Sequence[Phase], cuts: Iterable[float] = ()) -> MotionStates:
    """States of phases one after the other, each with nodes of its own; a rest has one, besides its ends.

    A phase that moves is cut at the instants of ``cuts`` (s) that lie in it, and each part has its own nodes: they go
    where a quantity bends, or is the largest.
    """
    columns: list[tuple[Numbers, ...]] = []
    ends: list[tuple[float, float]] = []
    start, instants = 0.0, sorted(cuts)
    for number, phase in enumerate(phases):
        duration = float(phase.duration)
        middle = phase.at(np.asarray(duration / 2))
        rests = float(middle[1]) == 0 == float(middle[2])
        share, weight = _nodes(1 if rests else NODES)
        if not rests:
            share, weight = _cut(share, weight, [(at - start) / duration for at in instants])
        x, v, a = phase.at(share * duration)
        direction = np.sign(float(middle[1])) * np.ones_like(share)
        v = np.where(v * direction > 0, v, 0.0)  # what rounding leaves at an end
        columns.append(
            (
                start + share * duration,
                weight * duration,
                x,
                v,
                a,
                direction,
                np.full_like(share, phase.force),
                np.full_like(share, np.nan if phase.temperature is None else phase.temperature),
                np.full_like(share, number),
            )
        )
        ends.append((float(v[0]), float(v[-1])))
        start += duration
    time, weight, x, v, a, direction, force, temperature, index = (
        np.concatenate(c) for c in zip(*columns, strict=True)
    )
    names = tuple(phase.name for phase in phases)
    return MotionStates(
        time, weight, x, v, a, direction, force, temperature, index.astype(np.intp), names, tuple(ends), tuple(phases)
    )


def _cut(share: Numbers, weight: Numbers, at: Sequence[float]) -> tuple[Numbers, Numbers]:
    """Shares of a duration and their weights, repeated in each part between the cuts."""
    inside = [one for one in at if _NEAR < one < 1 - _NEAR]
    edges = [0.0, *(after for before, after in itertools.pairwise([0.0, *inside]) if after - before > _NEAR), 1.0]
    parts = [(first + share * (last - first), weight * (last - first)) for first, last in itertools.pairwise(edges)]
    shares, weights = (np.concatenate(every) for every in zip(*parts, strict=True))
    return shares, weights


#: Values below this share of the largest are rounding; a largest value that is so little above those at the nodes, too.
_ROUNDING, _GAIN = 1e-12, 1e-7


def sign_changes(states: MotionStates, values: Numbers) -> list[float]:
    """The instants within phases at which a quantity changes its sign, s; ``values`` is it at the states."""
    from scipy.optimize import brentq  # for duties only

    result: list[float] = []
    known = np.abs(values[np.isfinite(values)])
    least = _ROUNDING * float(np.max(known, initial=0.0))
    for time, own in _parts(states, values):
        seen = np.flatnonzero(np.abs(own) > least)
        sign = np.sign(own[seen])
        for at in np.flatnonzero(sign[1:] != sign[:-1]):
            ends = float(time[seen[at]]), float(time[seen[at + 1]])
            root: Any = brentq(_through(time, own), *ends, xtol=1e-14 * (ends[1] - ends[0]))
            result.append(float(root))
    return result


def largest_within(states: MotionStates, values: Numbers) -> list[float]:
    """The instants at which a quantity is larger than at all states of its part of a phase, and than zero, s."""
    from scipy.optimize import minimize_scalar  # for duties only

    result: list[float] = []
    for time, own in _parts(states, values):
        at = int(np.argmax(own))
        if not 0 < at < own.size - 1 or not own[at] > 0 or not np.ptp(own) > _GAIN * own[at]:
            continue
        near = 1e-7 * (time[at + 1] - time[at - 1])
        best: Any = minimize_scalar(
            _through(time, -own), bounds=(time[at - 1], time[at + 1]), method="bounded", options={"xatol": near}
        )
        if -best.fun > own[at] * (1 + _GAIN):
            result.append(float(best.x))
    return result


def _parts(states: MotionStates, values: Numbers) -> Iterator[tuple[Numbers, Numbers]]:
    """Times and values in each part of a phase in which all of them are known, and the times differ in their digits."""
    for part in states.parts:
        time = states.time[part]
        if np.isfinite(values[part]).all() and np.all(np.diff(time) > 0):
            yield time, values[part]


def _through(time: Numbers, values: Numbers) -> Callable[[float], float]:
    """The polynomial through values by time, in its barycentric form; SciPy's has its nodes in a random order."""
    scale = 4.0 / (time[-1] - time[0])  # with which products of many gaps stay near one
    gaps = scale * (time[:, None] - time)
    np.fill_diagonal(gaps, 1.0)
    weights = 1.0 / np.prod(gaps, axis=1)

    def through(at: float) -> float:
        away = scale * (at - time)
        if not np.all(away):
            return float(values[np.argmin(np.abs(away))])
        shares = weights / away
        return float(shares @ values / np.sum(shares))

    return through
