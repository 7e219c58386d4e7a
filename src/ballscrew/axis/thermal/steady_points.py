"""Steady states of many operating points and designs, each going to and fro by itself until it is warm."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np

from ballscrew.axis.duty_cycle.duty import to_and_fro
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.friction_map import FrictionMap, grid_of, torque_at
from ballscrew.axis.thermal.network import (
    Network,
    approach_of,
    conductance_of_balls,
    convection_of,
    network_of,
    nut_length_of,
    power_of_supports,
)
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.axis.thermal.warm_up import equilibrium
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import Length
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.nut import SingleNut
from ballscrew.physics.components.operating_state import FrictionElement
from ballscrew.physics.solvers.load_distribution import preload_of

#: Inputs that follow from the heat, and cannot be given to each point.
OF_HEAT = ("temperature", "viscosity", "pressure_viscosity_coefficient", "temperature_coefficient")
#: Points whose maps are made together.
_AT_ONCE = 64


@dataclasses.dataclass(frozen=True, eq=False)
class SteadyPoints(ByValue):
    """Steady states, one for each point; NaN where there is none, but for the margin."""

    #: Temperatures, K.
    oil_temperature: Numbers
    nut_temperature: Numbers
    shaft_temperature: Numbers
    #: Preload, N, and growth of the shaft, m.
    preload: Numbers
    growth: Numbers
    #: Stability margin of the thermal loop, and whether there is a steady state.
    margin: Numbers
    exists: Any
    #: The network of one of the points that move; None where none does.
    network: Network | None


def steady_points(
    subject: Configuration,
    points: Mapping[str, Numbers],
    surroundings: Surroundings,
    *,
    stroke: Length,
    shaft_length: Length | None = None,
    also: Mapping[str, FrictionElement] | None = None,
    done: Callable[[int, int], None] | None = None,
) -> SteadyPoints:
    """The steady state of each point, whose load and speed it has; one that stands is as warm as its surroundings.

    ``points`` has one value for each point of each input; ``also`` is what rubs on the shaft besides. Raises
    :class:`~ballscrew.basis.errors.InputError` for inputs that follow from the heat, and as
    :func:`~ballscrew.axis.thermal.network.network_of` does.
    """
    remedy = "leave it out: it follows from the heat"
    raise_if_any([Fault(f"sweep.{name}", "is not free", "", remedy) for name in OF_HEAT if name in points])
    if subject.lubricant.temperature is None:
        remedy = 'make the oil with Lubricant.from_grade("ISO VG 100", temperature), or from two viscosities'
        raise InputError(Fault("lubricant", "has no temperature: its viscosity is the same for ever", "", remedy))
    count = points[OPERATION[0]].size
    names = [name for name in points if name not in OPERATION]
    result = {name: np.full(count, np.nan) for name in _NUMBERS}
    exists, last = np.zeros(count, dtype=bool), None
    finished = 0
    for own, at in _designs(points, names, count):
        design = subject.changed(own) if own else subject
        still = at[points["screw_speed"][at] == 0]
        at_rest = {**dict.fromkeys(_NUMBERS, float(surroundings.ambient)), "growth": 0.0, "margin": 1.0}
        at_rest["preload"] = float(preload_of(design.screw, design.nut))
        for name, values in result.items():
            values[still] = at_rest[name]
        exists[still] = True
        moving = at[points["screw_speed"][at] != 0]
        for some in np.array_split(moving, max(1, -(-moving.size // _AT_ONCE))):
            networks = (
                _networks(design, points, some, surroundings, stroke, shaft_length, also or {}) if some.size else ()
            )
            for place, network in zip(some, networks, strict=False):
                end, last = equilibrium(network), network
                exists[place] = end.exists
                for name, values in result.items():
                    values[place] = float(getattr(end, name))
            finished += some.size
            if done is not None:
                done(finished, count)
    return SteadyPoints(**result, exists=exists, network=last)


_NUMBERS = ("oil_temperature", "nut_temperature", "shaft_temperature", "preload", "growth", "margin")


def _designs(points: Mapping[str, Numbers], names: list[str], count: int) -> Iterator[tuple[dict[str, float], Any]]:
    """Distinct designs, and the points of each."""
    if not names:
        yield {}, np.arange(count)
        return
    columns = np.stack([np.broadcast_to(points[name], count) for name in names])
    distinct, back = np.unique(columns, axis=1, return_inverse=True)
    for i in range(distinct.shape[1]):
        yield dict(zip(names, map(float, distinct[:, i]), strict=True)), np.flatnonzero(back.reshape(-1) == i)


def _networks(
    design: Configuration,
    points: Mapping[str, Numbers],
    at: Any,
    surroundings: Surroundings,
    stroke: Length,
    shaft_length: Length | None,
    also: Mapping[str, FrictionElement],
) -> list[Network]:
    """The networks of some points of one design: that of the first, with speed, friction and contacts of each."""
    load, speed = points["axial_load"][at], np.abs(points["screw_speed"][at])
    model, screw, oil = design.model, design.screw, design.lubricant
    duties = [
        to_and_fro(model, screw, oil, axial_load=float(F), screw_speed=float(n), stroke=stroke, also=also)
        for F, n in zip(load, speed, strict=True)
    ]
    maps = _maps(design, load, speed)
    network = network_of(duties[0], surroundings, shaft_length=shaft_length, friction=maps[0])
    loaded = np.where(network.preload_set > 0, network.preload_set, np.maximum(np.abs(load), 1.0))
    row = dataclasses.replace(screw, nut=SingleNut())
    at_load = model(row, oil, axial_load=loaded, screw_speed=np.maximum(speed, 1e-3))
    balls = np.broadcast_to(conductance_of_balls(at_load, screw.nut, nut_length_of(screw)), at.shape)
    approach = np.broadcast_to(approach_of(at_load), at.shape)
    given = surroundings.ball_conductance
    return [
        dataclasses.replace(
            network,
            shaft=dataclasses.replace(
                network.shaft, convection=convection_of(surroundings, network.shaft.diameter, float(speed[i]))
            ),
            ball_conductance=float(balls[i]) if given is None else given,
            friction=maps[i],
            approach_set=float(approach[i]),
            bearing_power=power_of_supports(duties[i]),
        )
        for i in range(at.size)
    ]


def _maps(design: Configuration, load: Numbers, speed: Numbers) -> list[FrictionMap]:
    """The maps of friction of some points, forth and back."""
    temperatures, preloads = grid_of(design.screw)
    inputs: dict[str, Any] = {
        "axial_load": load[:, None, None, None],
        "screw_speed": speed[:, None, None, None] * np.array([1.0, -1.0]),
        "temperature": temperatures[:, None, None],
    }
    if preloads.size > 1:
        inputs["nut.preload"] = preloads[:, None]
    shape = (load.size, temperatures.size, preloads.size, 2)
    power = np.mean(np.broadcast_to(torque_at(design, inputs), shape), axis=-1) * speed[:, None, None]
    return [FrictionMap(temperatures, preloads, one) for one in power]
