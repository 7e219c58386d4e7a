"""Warming up: temperatures, preload, torque and growth over hours of a duty, and the state in which it ends.

That state has the stability margin of the thermal loop.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import root_scalar

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import friction_map
from ballscrew.axis.thermal.moving_source import Itinerary, Slot, is_long, itinerary_of, marched
from ballscrew.axis.thermal.network import Network, network_of
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue, lazy
from ballscrew.basis.errors import Fault, InputError, accepts_units
from ballscrew.basis.quantities import Duration, Energy, Info, Length, Power, Quantity, Ratio, Torque
from ballscrew.basis.records import Record
from ballscrew.physics.friction.validity import NEARLY_ALL, differs

#: Points of the powers among which an equilibrium is looked for.
_POWERS = 400


@dataclasses.dataclass(frozen=True, eq=False)
class Equilibrium(ByValue):
    """The state in which a duty ends, if it ends in one.

    ``margin`` is 1 − g, g being the gain of the loop heat → temperature → friction → heat there: above zero the
    state is stable. Where there is no equilibrium in the range in which oil and preload are known, the margin is the
    greatest surplus of what the surroundings take over the friction, as a share of the friction, and negative.
    """

    network: Network
    exists: bool
    margin: Ratio
    #: Mean friction power of the nut, W; NaN where there is no equilibrium.
    power: Power
    #: Temperatures of shaft cells, nut and bearings, K; NaN where there is no equilibrium.
    temperatures: Numbers

    @property
    def shown_margin(self) -> str:
        """The margin as people read it."""
        return units.number(self.margin, 3)

    @property
    def nut_temperature(self) -> float:
        """Temperature of the nut, K."""
        return float(self.temperatures[-3])

    @property
    def oil_temperature(self) -> float:
        """Temperature of the oil, K."""
        return float(self.network.of_oil @ self.temperatures)

    @property
    def shaft_temperature(self) -> float:
        """Mean temperature of the shaft, K."""
        return float(np.mean(self.temperatures[:-3]))

    @property
    def preload(self) -> float:
        """Preload, N."""
        return float(self.network.preload(self.network.of_excess @ self.temperatures))

    @property
    def growth(self) -> Length:
        """Growth of the shaft between its bearings, m."""
        shaft = self.network.shaft
        return float(shaft.growth_at(self.temperatures[:-3], self.network.surroundings.ambient, shaft.length)[0])


def equilibrium(network: Network) -> Equilibrium:
    r"""The steady state, by one equation for the friction power: :math:`P = f(T(P))`, T being linear in P.

    Of several the coolest is taken, which is the one that a cold machine reaches.
    """
    idle, per_watt = np.linalg.solve(network.conductances, np.stack([network.constant, network.source], axis=1)).T

    def surplus(power: Power) -> Power:
        """Friction beyond the power that the temperatures are those of."""
        return network.power(idle + per_watt * power) - power

    largest = 2 * max(float(np.max(network.friction.power)), 1e-9)
    powers = np.concatenate([[0.0], np.geomspace(1e-6, 1.0, _POWERS) * largest])
    values = network.powers(idle + powers[:, None] * per_watt) - powers
    known = np.isfinite(values)
    for i in range(powers.size - 1):
        if values[i] >= 0 > values[i + 1] and known[i] and known[i + 1]:
            power = root_scalar(surplus, bracket=(powers[i], powers[i + 1]), xtol=1e-12, rtol=1e-14).root
            step = 1e-4 * power
            gain = (surplus(power + step) - surplus(power - step)) / (2 * step) + 1 if step else 0.0
            return Equilibrium(network, True, 1 - gain, power, idle + per_watt * power)
    here = known & (powers > 0)
    friction = values[here] + powers[here]
    margin = float(np.max(-values[here] / np.maximum(friction, 1e-12))) if here.any() else -1.0
    return Equilibrium(network, False, min(margin, 0.0), math.nan, np.full(network.size, np.nan))


@accepts_units("steady_heat")
def steady_heat(
    duty: Duty, surroundings: Surroundings | None = None, *, shaft_length: Length | None = None
) -> Equilibrium:
    """Temperatures, preload, friction and growth in which a duty ends, and the stability margin of the thermal loop.

    Returns an :class:`~ballscrew.axis.thermal.warm_up.Equilibrium` of ``duty`` in its ``surroundings``, by default
    ``Surroundings()``. Of one operating point take the duty of
    :func:`~ballscrew.axis.duty_cycle.duty.to_and_fro`. ``shaft_length`` (m) is taken where the surroundings have
    none.

    Raises :class:`~ballscrew.basis.errors.InputError` as
    :func:`~ballscrew.axis.thermal.network.network_of` does.
    """
    return equilibrium(network_of(duty, surroundings or Surroundings(), shaft_length=shaft_length))


#: Relative and absolute tolerance of the integration; temperatures are then right to a millikelvin.
RTOL, ATOL = 1e-6, 1e-6
#: The shortest time of work, s, for which what ended at once is computed in a full bath of oil.
_SHORTEST = 1.0
#: A share of a step that is rounding.
_ROUNDING = 1e-9
#: Quantities of the verdicts, in the units that people read.
_TEMPERATURE = Quantity("nut_temperature", "K", Info("", "temperature of the nut", "degC"))
_PRELOAD = Quantity("preload", "N", Info("", "preload of the nut", "N"))
_HOURS = Quantity("time", "s", Info("", "time", "h"))
_STRETCH = Quantity("stretch", "m", Info("", "stretch of the shaft", "um"))


@accepts_units("warm_up")
def warm_up(
    duty: Duty,
    surroundings: Surroundings | None = None,
    *,
    time: Duration = 4 * 3600.0,
    cool_down: Duration = 0.0,
    outputs: int = 121,
    shaft_length: Length | None = None,
    moving: bool | None = None,
) -> WarmUp:
    """Temperatures over hours of a duty that starts with everything at the ambient temperature: a :class:`WarmUp`.

    The ``duty`` repeats in its ``surroundings`` for a ``time`` (s), of which ``outputs`` instants at even steps are
    kept. The nut heats the shaft as often as it is at a place where the cycle is short against the hours, and goes
    along with its heat where it is long (:mod:`~ballscrew.axis.thermal.moving_source`); ``moving`` chooses one. Then
    the axis may stand for a time (``cool_down``, s), in still air unless the convection is given. ``shaft_length`` (m)
    is taken where the surroundings have none. The oil is as warm as nut and shaft make it, whatever temperatures a
    motion gives.

    Raises :class:`~ballscrew.basis.errors.InputError` for times that are not positive, and as
    :func:`~ballscrew.axis.thermal.network.network_of` does.
    """
    if not time > 0 or not cool_down >= 0:
        raise InputError(Fault("warm_up.time", "must be positive", f"{time:g} s", 'give "4 h"'))
    network = network_of(duty, surroundings or Surroundings(), shaft_length=shaft_length)
    start = np.full(network.size, float(network.surroundings.ambient))
    instants = np.linspace(0.0, time, outputs)
    along = itinerary_of(duty, network) if (is_long(duty, time) if moving is None else moving) else None
    last = network
    if along is None:
        instants, states, stopped = _integrated(network, start, instants, works=True)
    else:
        instants, states, stopped = _followed(network, along, start, instants)
        last = dataclasses.replace(network, spread=along.spreads_until(instants[-1:])[0])
    works = np.ones(instants.size, dtype=bool)
    if cool_down and stopped is None:
        later = np.linspace(0.0, cool_down, max(2, round(outputs * cool_down / time)))
        later, cooling, _ = _integrated(last.standing, states[:, -1], later, works=False)
        states = np.concatenate([states, cooling[:, 1:]], axis=1)
        instants = np.concatenate([instants, time + later[1:]])
        works = np.concatenate([works, np.zeros(later.size - 1, dtype=bool)])
    return WarmUp(duty, network, instants, states, works, stopped, along)


def _followed(
    network: Network, along: Itinerary, start: Numbers, instants: Numbers
) -> tuple[Numbers, Numbers, Duration | None]:
    """Integrate like :func:`_integrated`, with the heat where the nut is."""
    slots = [Slot.of([one]) for one in along.networks(network)]
    columns = [np.concatenate([start, [0.0, 0.0]])]
    for state in marched(slots, along.pieces(instants), start[None, :], grows=False):
        columns.append(np.concatenate([state.temperatures[0], state.generated, state.lost]))
        if not np.isfinite(columns[-1]).all():
            columns.pop()
            break
    known = instants[: len(columns)]
    return known, np.array(columns).T, None if known.size == instants.size else float(known[-1])


def _integrated(
    network: Network, start: Numbers, instants: Numbers, *, works: bool
) -> tuple[Numbers, Numbers, Duration | None]:
    """Instants, temperatures and below them generated and lost heat, and the time at which friction was unknown.

    That time is the last instant where there is one.
    """
    A, C = network.conductances, network.capacity
    n = network.size
    first = start if start.size > n else np.concatenate([start, [0.0, 0.0]])
    given = network.constant if works else network.losses * network.outside
    of_bearings = network.constant - network.losses * network.outside

    def power(temperatures: Numbers) -> Power:
        return network.power(temperatures) if works else 0.0

    of_caller = np.geterr()

    def rate(_: float, state: Numbers) -> Numbers:
        temperatures = state[:n]
        with np.errstate(**of_caller):
            friction = power(temperatures)
            heating = (given + network.source * friction - A @ temperatures) / C
            generated = friction + (float(np.sum(of_bearings)) if works else 0.0)
            lost = float(network.losses @ (temperatures - network.outside))
        return np.concatenate([heating, [generated, lost]])

    # the friction's own slope is left to the iterations of the solver: it is small against the conductances
    slope = np.zeros((n + 2, n + 2))
    slope[:n, :n] = -A / C[:, None]
    slope[n + 1, :n] = network.losses

    def leaves(_: float, state: Numbers) -> float:
        with np.errstate(**of_caller):
            return 1.0 if network.inside(state[:n]) else -1.0

    leaves.terminal = True  # pyright: ignore[reportFunctionMemberAccess]  (the solver reads it there)
    # the solver, and it alone, subtracts rows of its table that nothing was written to yet: any number may lie there
    with np.errstate(invalid="ignore", over="ignore"):
        result = solve_ivp(
            rate,
            (float(instants[0]), float(instants[-1])),
            first,
            method="BDF",
            t_eval=instants,
            jac=slope,
            rtol=RTOL,
            atol=ATOL,
            events=leaves if works else None,
        )
    if not result.success:
        raise InputError(Fault("warm_up", "could not be integrated", str(result.message), "check the surroundings"))
    if not works or not result.t_events[0].size:
        return np.asarray(result.t), np.asarray(result.y), None
    stopped, last = float(result.t_events[0][0]), np.asarray(result.y_events[0][0])
    earlier = result.t < stopped
    states = np.concatenate([result.y[:, earlier], last[:, None]], axis=1)
    return np.append(result.t[earlier], stopped), states, stopped


@dataclasses.dataclass(frozen=True, eq=False)
class WarmUp(ByValue):
    """Temperatures over time, and what follows from them; made by :func:`warm_up`."""

    duty: Duty
    network: Network
    #: Instants, s.
    time: Numbers
    #: Temperatures of shaft cells, nut and two bearings, K, then generated and lost heat, J; one column an instant.
    states: Numbers
    #: True while the axis moves.
    works: Any
    #: The time after which friction was not known any more (oil too hot, preload too high), s; None where it is known.
    stopped: Duration | None
    #: Where the nut is slot by slot, if its heat goes along with it; None where it is spread over the stroke.
    along: Itinerary | None = None

    @lazy
    def _spreads(self) -> Numbers:
        """Shares of the cells in the nut: one row, or one for each instant; while it stands, those of the last move."""
        if self.along is None:
            return self.network.spread[None, :]
        last = self.time[np.flatnonzero(self.works)[-1]]
        return self.along.spreads_until(np.clip(self.time, 0.0, last))

    @lazy
    def _in_nut(self) -> Numbers:
        """Temperature of the shaft in the nut, K."""
        return np.sum(self._spreads * self.shaft_temperature, axis=1)

    @property
    def shaft_temperature(self) -> Numbers:
        """Temperatures of the shaft, K: instants by places (:attr:`places`)."""
        return self.states[: self.network.shaft.cells].T

    @property
    def places(self) -> Numbers:
        """Places on the shaft, m from the first bearing."""
        return self.network.shaft.places

    @property
    def nut_temperature(self) -> Numbers:
        """Temperature of the nut, K."""
        return self.states[self.network.size - 3]

    @property
    def bearing_temperatures(self) -> Numbers:
        """Temperatures of the two bearings, K."""
        return self.states[self.network.size - 2 : self.network.size]

    @lazy
    def _temperatures(self) -> Numbers:
        return self.states[: self.network.size]

    @lazy
    def oil_temperature(self) -> Numbers:
        """Temperature of the oil, K: between nut and shaft."""
        return (self.nut_temperature + self._in_nut) / 2

    @lazy
    def preload(self) -> Numbers:
        """Preload, N."""
        return self.network.preload(self._in_nut - self.nut_temperature)

    @lazy
    def friction_power(self) -> Numbers:
        """Mean friction power of a cycle at the oil and the preload of each instant, W; NaN where it is not known.

        Also what it would be while the axis stands.
        """
        return self.network.friction.at_all(self.oil_temperature, self.preload)

    @lazy
    def screw_torque(self) -> Numbers:
        """Mean friction torque of the screw, by its work: power over mean speed, N m."""
        return self.friction_power / self.duty.mean_speed if self.duty.mean_speed else np.full(self.time.size, np.nan)

    @lazy
    def starved(self) -> bool:
        """True where, at any instant, the mean friction torque differs from that of a full bath of the same oil."""
        duty, moving = self.duty, self.duty.states.direction != 0
        driven: Any = duty.driven
        coldest = np.full(int(np.sum(moving)), np.min(self.oil_temperature))
        if duty.flooded is duty or driven.least_replenished(duty.screw_speed[moving], coldest) >= NEARLY_ALL:
            return False
        flooded = friction_map(duty.flooded).at_all(self.oil_temperature, self.preload)
        return bool(np.any(differs(self.friction_power, flooded)))

    @lazy
    def flooded(self) -> WarmUp:
        """The same for as long in a full bath of oil; itself where nothing of the oil comes back late."""
        full = self.duty.flooded
        if full is self.duty:
            return self
        last = int(np.flatnonzero(self.works)[-1])
        work = float(self.time[last])
        return warm_up(
            full,
            self.network.surroundings,
            time=max(work, _SHORTEST),
            cool_down=float(self.time[-1]) - work,
            outputs=max(last + 1, 2),
            shaft_length=self.network.shaft.length,
            moving=self.along is not None,
        )

    @lazy
    def flooded_torque(self) -> Torque:
        """Mean friction torque of the screw at the start, in a full bath of oil, N m."""
        duty, full = self.duty, self.duty.flooded
        if full is duty or self.starved:
            return float(self.flooded.screw_torque[0])
        start = np.full_like(duty.screw_speed, self.oil_temperature[0])
        torque = full.driven.along(duty.axial_load, duty.screw_speed, start).torque
        power = duty.states.integral(torque * np.abs(duty.screw_speed)) / duty.states.cycle_time
        return float(power / duty.mean_speed) if duty.mean_speed else math.nan

    @lazy
    def shaft_growth(self) -> Numbers:
        """Growth of the shaft between its bearings, m, if it is free to grow."""
        return self.growth_at(self.network.shaft.length)[:, 0]

    def growth_at(self, place: Any) -> Numbers:
        """Growth between the fixed bearing and places, m: instants by places. What a rotary encoder does not see."""
        return self.network.shaft.growth_at(self.shaft_temperature, self.network.surroundings.ambient, place)

    @lazy
    def stretch_left(self) -> Numbers | None:
        """Stretch that is left of a shaft pulled between fixed ends, m; below zero it pushes. None without one."""
        given = self.network.surroundings.stretch
        return None if given is None else given - self.shaft_growth

    @property
    def generated(self) -> Energy:
        """Heat made by friction, J."""
        return float(self.heat["generated"][-1])

    @lazy
    def heat(self) -> Mapping[str, Numbers]:
        """Heat generated, stored and lost until each instant, J."""
        n = self.network.size
        stored = self.network.capacity @ (self._temperatures - self._temperatures[:, :1])
        return {"generated": self.states[n], "stored": stored, "lost": self.states[n + 1]}

    @functools.cached_property
    def equilibrium(self) -> Equilibrium:
        """The state in which the duty ends."""
        return equilibrium(self.network)

    def compensation_table(self, step: Length = 0.05) -> tuple[Numbers, Numbers]:
        """Places from the fixed bearing at even steps and the end, and the growth there at the last instant of work, m.

        Raises :class:`~ballscrew.basis.errors.InputError` for a step that is not positive.
        """
        shaft = self.network.shaft
        if not step > 0:
            raise InputError(Fault("warm_up.step", "must be positive", f"{step:g} m", "give 0.05 m"))
        even = step * np.arange(math.floor(shaft.length / step + _ROUNDING) + 1)
        places = even if shaft.length - even[-1] <= _ROUNDING * step else np.append(even, shaft.length)
        last = int(np.flatnonzero(self.works)[-1])
        growth = shaft.growth_at(self.shaft_temperature[last], self.network.surroundings.ambient, places)
        return places, growth

    @property
    def records(self) -> Sequence[Record]:
        """Verdicts: where it ends, and what is lost on the way."""
        return _records(self)


def _ending(bracing: str, end: Equilibrium) -> str:
    """The preload in a steady state of one way to brace the halves, or that there is none."""
    return f"{bracing} {units.shown(end.preload, _PRELOAD)}" if end.exists else f"{bracing} no steady state"


def _records(result: WarmUp) -> list[Record]:
    end = result.equilibrium
    message = "no equilibrium within the range of oil and preload: thermal runaway, or too hot for the model"
    if end.exists:
        message = (
            f"settles with the nut at {units.shown(end.nut_temperature, _TEMPERATURE, 3)}; stability margin of the "
            f"thermal loop {end.shown_margin}, thermal runaway at 0"
        )
    verdicts = [
        Record(
            "verdict.equilibrium",
            "equilibrium",
            message,
            severity="info" if end.exists and end.margin > 0 else "error",
            holds=end.exists,
            value=end.margin,
            limit=0.0,
        )
    ]
    both = {name: equilibrium(one) for name, one in result.network.by_bracing.items()}
    if both:
        endings = ", ".join(_ending(name, one) for name, one in both.items())
        message = (
            "the growth of the shaft between the halves of the nut is left out, as it is not said how they are "
            f"braced: {endings}; give [surroundings] bracing"
        )
        verdicts.append(Record.warning("warning.bracing", "preload", message))
    if result.stopped is not None:
        time = units.shown(result.stopped, _HOURS, 3)
        message = f"stopped after {time}: beyond it oil or preload are outside what the model knows"
        verdicts.append(Record("warning.stopped", "time", message, severity="error", value=result.stopped, unit="s"))
    left = result.stretch_left
    if left is not None and np.min(left) < 0:
        stretch = units.shown(np.min(left), _STRETCH, 2)
        message = f"the stretch of the shaft is lost: {stretch} at the worst, and the shaft pushes"
        verdicts.append(
            Record.warning("verdict.stretch", "stretch", message, value=float(np.min(left)), limit=0.0, unit="m")
        )
    return verdicts
