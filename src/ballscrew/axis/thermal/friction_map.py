"""Friction heat of a cycle over the temperature of the oil and the preload: a map, computed once."""

from __future__ import annotations

import dataclasses
import functools
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline, RectBivariateSpline

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.duty_cycle.screw_friction import ModelledScrew
from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Duration, Force, Power, Temperature
from ballscrew.engine.evaluation.evaluator import evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.solvers.load_distribution import preload_of

#: Temperatures of the oil that the map has, K; beyond them the answer has no meaning.
COLDEST, HOTTEST = 258.15, 393.15
#: Preload of the map over that of the nut as it was set.
LARGEST_PRELOAD = 4.0
_TEMPERATURES, _PRELOADS = 24, 13
#: More balls than this in all points together, and the model is compiled.
WORTH_COMPILING = 200_000


@dataclasses.dataclass(frozen=True, eq=False)
class FrictionMap(ByValue):
    """Mean power that the friction of the screw takes over a cycle, W.

    By a bicubic spline over temperature and preload (over its square root: friction bends where the preload vanishes).
    A nut without preload, or an element without an oil, has fewer axes.
    """

    temperatures: Numbers
    #: Those of the map, N; one alone where the nut has none.
    preloads: Numbers
    #: Mean friction power, W, temperatures by preloads.
    power: Numbers

    @functools.cached_property
    def _spline(self) -> RectBivariateSpline | None:
        if self.preloads.size == 1:
            return None
        return RectBivariateSpline(self.temperatures, np.sqrt(self.preloads), self.power, kx=3, ky=3)

    @functools.cached_property
    def _curve(self) -> Any:
        return CubicSpline(self.temperatures, self.power[:, 0])

    def at(self, temperature: Temperature, preload: Force) -> Power:
        """Mean friction power at a temperature of the oil and a preload, both kept within the map."""
        warm = min(max(temperature, self.temperatures[0]), self.temperatures[-1])
        if self._spline is None:
            return float(self._curve(warm))
        held = min(max(preload, 0.0), self.preloads[-1])
        return float(self._spline.ev(warm, np.sqrt(held)))

    def at_all(self, temperatures: Numbers, preloads: Numbers) -> Numbers:
        """The same at many temperatures and preloads; NaN where the map has not the point."""
        known = (temperatures >= self.temperatures[0]) & (temperatures <= self.temperatures[-1])
        warm = np.where(known, temperatures, self.temperatures[0])
        if self._spline is None:
            return np.where(known, self._curve(warm), np.nan)
        known &= preloads <= self.preloads[-1]
        held = np.where(known, np.maximum(preloads, 0.0), 0.0)
        return np.where(known, self._spline.ev(warm, np.sqrt(held)), np.nan)

    def has(self, temperature: Temperature, preload: Force) -> bool:
        """True where the map has the point."""
        inside = self.temperatures[0] <= temperature <= self.temperatures[-1]
        return bool(inside and (self.preloads.size == 1 or preload <= self.preloads[-1]))


@dataclasses.dataclass(frozen=True, eq=False)
class StateMaps(ByValue):
    """Friction power of each distinct state of a duty, W, and the time for which each state has it."""

    temperatures: Numbers
    preloads: Numbers
    #: Temperatures by preloads by distinct states.
    power: Numbers
    #: The distinct state of each state that makes heat, and which states those are.
    back: Any
    used: Any

    def mean(self, weights: Numbers, time: Duration) -> FrictionMap:
        """The map of the mean over a time, in which each state of the duty counts by its weight, s."""
        of_distinct = np.bincount(self.back, weights=weights[self.used], minlength=self.power.shape[2])
        return FrictionMap(self.temperatures, self.preloads, self.power @ of_distinct / time)


@functools.lru_cache(maxsize=4)
def state_maps(duty: Duty) -> StateMaps:
    """The friction of the distinct states of a duty at every temperature and preload; kept for the next surroundings.

    Raises :class:`~ballscrew.basis.errors.InputError` for an element without an oil, and for an oil that has no
    temperature.
    """
    driven = duty.driven
    if not isinstance(driven, ModelledScrew):
        remedy = 'take a model of friction, such as "reference"'
        raise InputError(Fault("model", "knows no oil, so that nothing changes as it warms up", "", remedy))
    if driven.lubricant.temperature is None:
        remedy = 'make it with Lubricant.from_grade("ISO VG 100", temperature), or from two viscosities'
        raise InputError(Fault("lubricant", "has no temperature: its viscosity is the same for ever", "", remedy))
    states = np.stack([duty.axial_load, duty.screw_speed])
    used = duty.states.weight * np.abs(duty.screw_speed) > 0
    distinct, back = np.unique(states[:, used], axis=1, return_inverse=True)
    load, speed = distinct
    temperatures, preloads = grid_of(driven.screw)
    inputs: dict[str, Any] = {"axial_load": load, "screw_speed": speed, "temperature": temperatures[:, None, None]}
    if preloads.size > 1:
        inputs["nut.preload"] = preloads[None, :, None]
    subject = Configuration(driven.model, driven.screw, driven.lubricant)
    heat = torque_at(subject, inputs) * np.abs(speed)
    power = np.array(np.broadcast_to(heat, (temperatures.size, preloads.size, load.size)))
    return StateMaps(temperatures, preloads, power, back.reshape(-1), used)


def friction_map(duty: Duty) -> FrictionMap:
    """The map of the mean over a cycle of a duty. Raises as :func:`state_maps` does."""
    return state_maps(duty).mean(duty.states.weight, duty.states.cycle_time)


def grid_of(screw: BallScrew) -> tuple[Numbers, Numbers]:
    """Temperatures and preloads of a map; one preload alone where the nut has none."""
    set_to = float(preload_of(screw, screw.nut))
    preloads = set_to * np.linspace(0.0, np.sqrt(LARGEST_PRELOAD), _PRELOADS) ** 2 if set_to else np.zeros(1)
    return np.linspace(COLDEST, HOTTEST, _TEMPERATURES), preloads


def torque_at(subject: Configuration, inputs: dict[str, Any]) -> Numbers:
    """Friction torque at all combinations of the inputs; compiled where there are many."""
    shape = np.broadcast_shapes(*(np.shape(values) for values in inputs.values()))
    if np.prod(shape) * subject.balls > WORTH_COMPILING:
        ready = evaluator(
            subject.model, subject.screw, subject.lubricant, inputs=tuple(inputs), outputs=["screw_torque"]
        )
        return ready(**inputs)["screw_torque"]
    return subject.at({name: np.broadcast_to(values, shape) for name, values in inputs.items()}).screw_torque
