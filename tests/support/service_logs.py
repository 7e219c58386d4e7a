"""Logs of a double nut when new and when worn, of a screw whose numbers are not quite those of the case."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95, default_distributions

RPM = 2 * math.pi / 60
PRELOAD = 4326.0
SCREW = bs.catalogue()["rexroth-40x10x6-6-double"].screw(nut=bs.DoubleNut(preload=PRELOAD))
WARM = 313.15
OIL = bs.Lubricant.from_grade("ISO VG 100", WARM)


def another_screw(model: bs.FrictionModel, seed: int) -> Configuration:
    """The same screw with numbers that are off by as much as numbers usually are, another for each seed."""
    subject = Configuration(model, SCREW, OIL)
    random = np.random.default_rng([seed, 1])
    usual = default_distributions(model, SCREW, OIL, exact={"temperature"})
    drawn = {name: float(one.quantile(random.random())) for name, (one, _) in usual.items() if name != "preload"}
    return subject.changed(drawn)


def log(
    true: Configuration,
    preload: float,
    seed: int,
    *,
    temperature: float = WARM,
    sensor_error: float | None = None,
    rows: int = 150,
    noise: float = 0.006,
    drift: float = 0.02,
    outliers: float = 0.03,
    speeds: tuple[float, float] = (10, 1000),
    loads: tuple[float, float] = (0, 0),
) -> dict[str, Any]:
    """Columns of a log in SI, in both directions; with a ``sensor_error`` (K) also the temperature, off by that."""
    random = np.random.default_rng([seed, 2])
    speed = RPM * np.exp(random.uniform(*np.log(speeds), rows))
    sign, load = np.where(random.random(rows) < 0.5, -1.0, 1.0), random.uniform(*loads, rows)
    there = dataclasses.replace(true.screw, nut=dataclasses.replace(true.screw.nut, preload=preload))
    oil = true.lubricant.at(np.full(rows, temperature))
    result = true.model(there, oil, axial_load=load, screw_speed=speed)
    time = np.linspace(0, 1, rows)
    torque = result.ideal_torque + sign * result.screw_torque + 0.01 + drift * time + random.normal(0, noise, rows)
    torque[random.random(rows) < outliers] += 0.2
    found = {"axial_load": load, "screw_speed": sign * speed, "torque": torque, "time": 600 * time}
    if sensor_error is not None:
        found["temperature"] = np.full(rows, temperature + sensor_error)
    return found


def sensor_error(seed: int) -> float:
    """How far off a logged temperature is, K."""
    return float(np.random.default_rng([seed, 3]).normal(0, 2 / NORMAL_95))


def pair(
    model: bs.FrictionModel, seed: int, left: float, *, warmer: float = 0.0, logged: bool = True, **options: Any
) -> tuple[dict[str, Any], dict[str, Any]]:
    """A log when new and one when so much of the preload is left, whose oil is ``warmer`` by so many kelvin.

    Where no temperature is logged, that of each day is not quite that of the case, unless it is the ``warmer`` one.
    """
    true, random = another_screw(model, seed), np.random.default_rng([seed, 4])
    preload, day = PRELOAD * math.exp(random.normal(0, 0.1)), WARM + (0 if logged or warmer else random.normal(0, 5, 2))
    days = np.broadcast_to(day, 2) + np.array([0.0, warmer])
    errors = [sensor_error(2 * seed + i) if logged else None for i in range(2)]
    new, worn = (
        log(true, share * preload, 2 * seed + i, temperature=float(days[i]), sensor_error=errors[i], **options)
        for i, share in enumerate((1.0, left))
    )
    return new, worn
