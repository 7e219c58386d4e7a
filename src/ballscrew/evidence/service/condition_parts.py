"""Causes told apart: preload, constant torque, boundary friction and temperature of each test, from its several speeds.

A preload changes the torque at all speeds by about the same factor, seals by the same torque, boundary friction most at
low speed, and the temperature most at high speed. Means at one speed tell none of them from the others.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.basis.errors import InputError
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.default_uncertainties import NORMAL_95
from ballscrew.evidence.calibration.oil_temperature import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE, torque_of_model
from ballscrew.evidence.calibration.response import resolve_input
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import BOUNDARY_FRICTION
from ballscrew.evidence.service.condition_means import Means, points_of
from ballscrew.evidence.service.condition_reduction import Reduction, of_first_tests
from ballscrew.evidence.service.posterior import FRICTION, MODEL_ERROR, PRELOAD

#: Names of the causes.
CONSTANT, WARMER = "constant_torque", "temperature"
#: What a change may be before the torques are looked at, as standard deviations: of the logarithms of preload and
#: boundary friction, and of a constant torque over the usual friction (judgement).
USUAL: Mapping[str, float] = {PRELOAD: 1.0, BOUNDARY_FRICTION: 0.5, CONSTANT: 0.5}
#: What tests at the same speeds differ by, where nothing changed, beside the scatter within a log (judgement); of tests
#: at different speeds it is the error of the model.
REPEATABILITY = 0.005
#: A cause is told from the others where its deviation is less than this share of that, and of one test it needs so many
#: speeds.
TOLD, LEAST_SPEEDS = 0.5, 3
#: Steps of Gauss and Newton, and the differences of their slopes.
_STEPS, _DIFFERENCE = 4, 1e-3


@dataclasses.dataclass(frozen=True)
class Part:
    """A cause in one test: what it is now with its 95 % interval, beside the others and since the first tests.

    A share of what it was for preload and boundary friction, N m for a constant torque, K for a temperature.
    """

    value: float
    low: float
    high: float
    #: Whether the torques tell it from the others; if not, the interval is hardly less than what was known before.
    told: bool


def parts_of(subject: Configuration, means: Means, reduction: Reduction, baseline: int) -> list[dict[str, Part]]:
    """The causes by name, for each test; nothing for tests of fewer speeds than :data:`LEAST_SPEEDS`."""
    if int(means.speeds.min()) < LEAST_SPEEDS:
        return [{} for _ in range(means.count)]
    names = _names(subject)
    keys = [PRELOAD, *names, CONSTANT, WARMER]
    usual = math.exp(float(np.mean(np.log(means.torque))))
    priors = np.array([USUAL[PRELOAD], *(USUAL[BOUNDARY_FRICTION] for _ in names), USUAL[CONSTANT] * usual])
    kelvin = np.where(means.logged, LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE) / NORMAL_95
    before = np.column_stack([np.broadcast_to(priors, (means.count, len(keys) - 1)), kelvin])
    state, spread = np.zeros((means.count, len(keys))), np.zeros((means.count, len(keys)))
    factor = np.exp(np.log(means.torque) - reduction.off - _logarithms(subject, means, {}, np.zeros(1)))
    factor = factor * np.exp(of_first_tests(reduction.off, means, baseline))
    error = REPEATABILITY if means.at_the_same_speeds else MODEL_ERROR
    for _ in range(_STEPS):
        now, slopes = _model(subject, means, names, state, factor)
        for test in range(means.count):
            rows = means.test == test
            prior = before[test]
            weight = 1 / (np.hypot(means.deviation[rows], error) * means.torque[rows])
            matrix = np.vstack([slopes[rows] * weight[:, np.newaxis], np.diag(1 / prior)])
            right = np.concatenate([(means.torque[rows] - now[rows]) * weight, -state[test] / prior])
            state[test] += np.clip(np.linalg.lstsq(matrix, right, rcond=None)[0], -prior, prior)
            spread[test] = np.sqrt(np.diagonal(np.linalg.inv(matrix.T @ matrix)))
    state = state - state[:baseline].mean(axis=0)
    deviation = spread * math.sqrt(1 + 1 / baseline)
    told = spread < TOLD * before
    return [
        {
            key: _part(key, float(state[test, i]), float(deviation[test, i]), bool(told[test, i]))
            for i, key in enumerate([PRELOAD, *(BOUNDARY_FRICTION for _ in names), CONSTANT, WARMER])
        }
        for test in range(means.count)
    ]


def _part(key: str, value: float, deviation: float, told: bool) -> Part:
    ends = value - NORMAL_95 * deviation, value, value + NORMAL_95 * deviation
    low, middle, high = map(math.exp, ends) if key in (PRELOAD, BOUNDARY_FRICTION) else map(float, ends)
    return Part(middle, low, high, told)


def _names(subject: Configuration) -> list[str]:
    """The boundary friction of the model, if it has one."""
    try:
        name = resolve_input(subject, BOUNDARY_FRICTION)
    except InputError:  # a law of one's own, without such a number
        return []
    return [name] if float(subject.value_of(name)) > 0 else []


def _logarithms(subject: Configuration, means: Means, changes: Mapping[str, Any], warmer: Vector) -> Vector:
    torque = torque_of_model(
        subject.changed(changes) if changes else subject, points_of(means, subject), FRICTION, warmer
    )
    return np.log(np.broadcast_to(torque, means.torque.shape))


def _model(
    subject: Configuration, means: Means, names: list[str], state: Vector, factor: Vector
) -> tuple[Vector, Vector]:
    """Torques of the means with the state of their tests, and their derivatives."""
    numbers = [PRELOAD, *names]
    nominal = {name: float(subject.value_of(name)) for name in numbers}

    def at(shift: Vector) -> Vector:
        own = (state + shift)[means.test]
        changes = {name: nominal[name] * np.exp(own[:, i]) for i, name in enumerate(numbers)}
        return factor * np.exp(_logarithms(subject, means, changes, own[:, -1])) + own[:, -2]

    steps = _DIFFERENCE * np.eye(state.shape[1])
    here = at(np.zeros(state.shape[1]))
    return here, np.stack([(at(step) - here) / _DIFFERENCE for step in steps], axis=1)
