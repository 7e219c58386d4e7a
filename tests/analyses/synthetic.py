"""Logs with a known truth: noise, outliers, drift of the sensor, both directions."""

from __future__ import annotations

import dataclasses
import math
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.analyses.olaru2005.case import SCREW

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
    outliers: float = 0.03,
    drift: float = 0.01,
    both: bool = True,
    kind: str = "drive",
    speeds: tuple[float, float] = (10, 1000),
    loads: tuple[float, float] = (200, 4000),
    temperatures: tuple[float, float] | None = None,
) -> dict[str, Any]:
    """Columns of a log in SI; torques in N m, speeds in rpm, loads in N, temperatures in K."""
    random = np.random.default_rng(seed)
    load = random.uniform(*loads, rows)
    speed = np.exp(random.uniform(*np.log(speeds), rows)) * RPM
    sign = np.where(random.random(rows) < 0.5, -1.0, 1.0) if both else np.ones(rows)
    columns: dict[str, Any] = {"axial_load": load, "screw_speed": sign * speed, "time": np.linspace(0, 3600, rows)}
    if temperatures is not None:
        columns["temperature"] = random.uniform(*temperatures, rows)
        oil = oil.at(columns["temperature"])
    result = model(SCREW, oil, axial_load=load, screw_speed=speed)
    torque = sign * result.screw_torque + (result.ideal_torque if kind == "drive" else 0.0)
    torque = torque + random.normal(0, noise, rows) + drift * columns["time"] / 3600
    wild = random.random(rows) < outliers
    columns["torque"] = torque + np.where(wild, random.normal(0, 20 * noise, rows), 0.0)
    return columns
