"""Logs with a known truth: noise, outliers, drift of the sensor, both directions."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005.case import SCREW

RPM = 2 * math.pi / 60
OIL = bs.Lubricant(viscosity=0.1)
TRUE_FRICTION = 0.11


def truth(model: bs.FrictionModel | None = None, **coefficients: float) -> bs.FrictionModel:
    """The model of the paper (or another) with the coefficients of friction that the log is made with."""
    model = model or bs.FrictionModel.olaru2005()
    changed: Any = model.friction
    changed = dataclasses.replace(changed, **{"boundary_friction_coefficient": TRUE_FRICTION, **coefficients})
    return dataclasses.replace(model, friction=changed)


def log(
    model: bs.FrictionModel,
    *,
    seed: int = 0,
    rows: int = 400,
    oil: bs.Lubricant = OIL,
    noise: float = 0.01,
    share: float = 0.0,
    outliers: float = 0.03,
    one_sided: bool = False,
    drift: float = 0.01,
    wander: float = 0.0,
    both: bool = True,
    kind: str = "drive",
    design: str = "random",
    speeds: tuple[float, float] = (10, 1000),
    loads: tuple[float, float] = (200, 4000),
    temperatures: tuple[float, float] | None = None,
) -> dict[str, Any]:
    """Columns of a log in SI; torques in N m, speeds in rpm, loads in N, temperatures in K.

    Noise has a constant part and a ``share`` of the torque. Outliers may lie all to one side. The zero of the
    sensor has a ``drift`` over the log and a sine of amplitude ``wander``.
    """
    random = np.random.default_rng(seed)
    load, speed, sign = _operating_points(random, design, rows, loads, speeds)
    if not both:
        sign = np.ones(rows)
    time = np.linspace(0, 1, rows)
    columns: dict[str, Any] = {"axial_load": load, "screw_speed": sign * speed, "time": 3600 * time}
    if temperatures is not None:
        columns["temperature"] = random.uniform(*temperatures, rows)
        oil = oil.at(columns["temperature"])
    result = model(SCREW, oil, axial_load=load, screw_speed=speed)
    torque = sign * result.screw_torque + (result.ideal_torque if kind == "drive" else 0.0)
    torque = torque + random.normal(0, 1, rows) * np.hypot(noise, share * torque)
    torque = torque + drift * time + wander * np.sin(2 * np.pi * (time + random.random()))
    wild, off = random.random(rows) < outliers, random.normal(0, 20 * noise, rows)
    columns["torque"] = torque + np.where(wild, np.abs(off) if one_sided else off, 0.0)
    return columns


def _operating_points(
    random: np.random.Generator, design: str, rows: int, loads: tuple[float, float], speeds: tuple[float, float]
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Loads, speeds in rad/s and directions: at random, or on a grid that is run through in order.

    "strokes" is the grid forward from end to end and then backward, "alternating" changes direction at every row.
    """
    place = np.arange(rows)
    if design == "random":
        load = random.uniform(*loads, rows)
        speed = np.exp(random.uniform(*np.log(speeds), rows))
        sign = np.where(random.random(rows) < 0.5, -1.0, 1.0)
    else:
        points = rows // 2
        point = place // 2 if design == "alternating" else place % points
        sign = np.where(place % 2 if design == "alternating" else place >= points, -1.0, 1.0)
        steps = math.isqrt(points)
        load = np.linspace(*loads, steps)[np.minimum(point // -(-points // steps), steps - 1)]
        speed = np.geomspace(*speeds, -(-points // steps))[point % -(-points // steps)]
    return load, speed * RPM, sign


def autoregressive(rows: int, correlation: float, seed: int = 0) -> NDArray[np.floating]:
    """A series whose neighbours are alike: x[i] = φ x[i-1] + e[i]."""
    found = np.random.default_rng(seed).standard_normal(rows)
    for i in range(1, rows):
        found[i] += correlation * found[i - 1]
    return found
