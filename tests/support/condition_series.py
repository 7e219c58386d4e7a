"""Series of torques of a nut whose numbers are not quite those of the case, with a known loss of preload."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

import ballscrew as bs
from support.service_logs import PRELOAD, RPM, WARM, another_screw, sensor_error

#: Speed of the tests.
SPEED = 100 * RPM


def series(
    model: bs.FrictionModel,
    seed: int,
    *,
    tests: int = 30,
    lost: float = 0.0,
    since: int = 5,
    noise: float = 0.01,
    warmer: float = 0.0,
    logged: bool = True,
) -> dict[str, Any]:
    """A table in SI. From test ``since`` on the preload goes down evenly, to ``1 - lost`` in the last test; over the
    series the oil gets ``warmer`` by so many kelvin, beside a scatter of 1 K from day to day.
    """
    true, random = another_screw(model, seed), np.random.default_rng([seed, 5])
    number = np.arange(tests)
    left = 1 - lost * np.clip((number - since) / (tests - 1 - since), 0, 1)
    warm = WARM + warmer * number / (tests - 1) + random.normal(0, 1, tests)
    there = dataclasses.replace(true.screw, nut=dataclasses.replace(true.screw.nut, preload=PRELOAD * left))
    torque = true.model(there, true.lubricant.at(warm), axial_load=0.0, screw_speed=SPEED).screw_torque
    found = {"number": 1.0 + number, "torque": torque * (1 + random.normal(0, noise, tests))}
    if logged:
        found["temperature"] = warm + sensor_error(seed) + random.normal(0, 0.3, tests)
    return found


def logs(
    model: bs.FrictionModel, seed: int, shares: list[float], *, seals: list[float] | None = None, noise: float = 0.004
) -> list[dict[str, Any]]:
    """Logs at seven speeds in both directions, one for each share of the preload, with so much torque of seals, N m."""
    true, random = another_screw(model, seed), np.random.default_rng([seed, 6])
    speed = np.repeat(RPM * np.array([10, 20, 50, 100, 200, 400, 800]), 12)
    sign = np.tile(np.repeat([1.0, -1.0], 6), 7)
    found: list[dict[str, Any]] = []
    for share, lip in zip(shares, seals or [0.0] * len(shares), strict=True):
        warm = WARM + random.normal(0, 1)
        there = dataclasses.replace(true.screw, nut=dataclasses.replace(true.screw.nut, preload=share * PRELOAD))
        torque = lip + true.model(there, true.lubricant.at(warm), axial_load=0.0, screw_speed=speed).screw_torque
        found.append(
            {
                "axial_load": np.zeros(speed.size),
                "screw_speed": sign * speed,
                "torque": sign * torque + 0.01 + random.normal(0, noise, speed.size),
                "temperature": np.full(speed.size, warm + sensor_error(seed)),
                "time": 2.0 * np.arange(speed.size),
            }
        )
    return found
