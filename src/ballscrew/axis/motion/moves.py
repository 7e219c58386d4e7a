"""Moves from rest to rest in closed form: with a limit of acceleration, and with one of jerk."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.axis.motion.states import PolynomialPhase
from ballscrew.basis.quantities import Acceleration, Duration, Force, Jerk, Length, Speed, Temperature


class Timing(NamedTuple):
    """Durations of the phases of a move from rest to rest; the deceleration mirrors the acceleration."""

    #: Time in which the acceleration grows, and in which it falls again; zero without a limit of jerk.
    ramp: Duration
    #: Time at the full acceleration.
    full: Duration
    #: Time at the full speed.
    cruise: Duration
    acceleration: Acceleration

    @property
    def total(self) -> Duration:
        """Duration of the move."""
        return 2 * (2 * self.ramp + self.full) + self.cruise


def timing(distance: Length, speed: Speed, acceleration: Acceleration, jerk: Jerk = math.inf) -> Timing:
    r"""Fastest move from rest to rest over a distance, within speed, acceleration and jerk.

    .. math:: T = 2 T_a + \frac{D - v T_a}{v}, \quad T_a = \frac{v}{a} + \frac{a}{j} \text{ if } v j \ge a^2,
       \text{ else } 2 \sqrt{v/j}

    where :math:`D \ge v T_a`. Shorter moves do not reach the speed,
    :math:`T = a/j + \sqrt{(a/j)^2 + 4 D/a}` where :math:`D \ge 2 a^3/j^2`, and the shortest not even the acceleration,
    :math:`T = 4 (D/2j)^{1/3}`. Any positive values; without a limit of jerk a trapezoid of speed, or a triangle.
    """
    D, v, a, j = float(distance), float(speed), float(acceleration), float(jerk)
    ramp = min(a / j, math.sqrt(v / j))
    full = max(v / a - ramp, 0.0)
    to_speed = 2 * ramp + full
    if v * to_speed <= D:
        return Timing(ramp, full, D / v - to_speed, a if full else j * ramp)
    if D * j**2 >= 2 * a**3 or math.isinf(j):
        whole = a / j + math.sqrt((a / j) ** 2 + 4 * D / a)
        return Timing(a / j, max(whole / 2 - 2 * a / j, 0.0), 0.0, a)
    ramp = (D / (2 * j)) ** (1 / 3)
    return Timing(ramp, 0.0, 0.0, j * ramp)


def move(
    start: Length,
    distance: Length,
    speed: Speed,
    acceleration: Acceleration,
    jerk: Jerk = math.inf,
    *,
    force: Force = 0.0,
    temperature: Temperature | None = None,
    name: str = "",
) -> Sequence[PolynomialPhase]:
    """The phases of a move from rest to rest; a negative ``distance`` is a move backwards."""
    result = timing(abs(distance), speed, acceleration, jerk)
    sign = math.copysign(1.0, distance)
    peak = sign * result.acceleration
    j = 0.0 if math.isinf(jerk) or not result.ramp else peak / result.ramp
    speeds_up, cruises, slows_down = (
        f"{name}: {what}" if name else what for what in ("accelerates", "cruises", "slows down")
    )
    plan = (
        (speeds_up, result.ramp, 0.0, j),
        (speeds_up, result.full, peak, 0.0),
        (speeds_up, result.ramp, peak, -j),
        (cruises, result.cruise, 0.0, 0.0),
        (slows_down, result.ramp, 0.0, -j),
        (slows_down, result.full, -peak, 0.0),
        (slows_down, result.ramp, -peak, j),
    )
    phases: list[PolynomialPhase] = []
    x, v = float(start), 0.0
    for what, duration, a, jerk_now in plan:
        if duration > 0:
            phase = PolynomialPhase(what, duration, x, v, a, jerk_now, force, temperature)
            phases.append(phase)
            x, v, _ = phase.end
    return phases


def rest(position: Length, duration: Duration, *, force: Force = 0.0, name: str = "rests") -> PolynomialPhase:
    """A phase of rest."""
    return PolynomialPhase(name, duration, position, force=force)
