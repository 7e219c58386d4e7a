"""Random nuts of all kinds, with bodies, deviations and losses, from no load through lift-off.

Nuts of the four kinds with 5 to 100 balls a half, elastic bodies, deviations and losses, at loads from nothing through
lift-off and speeds from rest to 5000 rpm; in a fifth of them numbers are replaced by those that no nut has. All models.

*Wrong*: at a valid point a negative friction, a ball that is pulled, or loads that did not converge; a model without
four contacts that takes oversize balls.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from benchmarks.hostile import workers
from benchmarks.hostile.screws import STRANGE, TORQUES, faults_of_efficiency, faults_of_parts
from benchmarks.hostile.tally import Outcome

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.nut_losses import Churning, HarrisChurning, LipSeals, ParasiticLaw, Recirculation, Seals
from ballscrew.physics.laws.traits import traits_of
from support.nut_cases import KINDS, NutCase, nut_case
from support.strategies import MODELS, RPM

COUNT, SECONDS = 2_000, 60.0

SIZE = 5


def attempt(seed: int, number: int, size: int) -> Outcome:
    """Some nuts of one kind with the same number of balls, with one model."""
    rng = np.random.default_rng([seed, number])
    kind = KINDS[number % len(KINDS)]
    name = str(rng.choice(list(MODELS)))
    drawn = nut_case(
        kind,
        size,
        int(rng.integers(1 << 31)),
        elastic=bool(rng.random() < 0.75),
        same_side=bool(rng.random() < 0.5),
        scatter=bool(rng.random() < 1 / 3),
        balls=int(rng.integers(5, 101)),
    )
    part = through_lift_off(drawn, rng)
    is_strange = bool(rng.random() < 0.2)
    speed = np.where(rng.random(size) < 0.1, 0.0, np.exp(rng.uniform(np.log(1e-3), np.log(5000), size))) * RPM
    words = f"attempt {number}, {kind}, {name}, {part.screw.loaded_balls} balls"
    knows = kind != "oversize" or 4 in traits_of(MODELS[name].slip).contacts_per_ball
    try:
        part = strange(part, rng) if is_strange else part
        oil = bs.Lubricant(float(np.exp(rng.uniform(np.log(0.005), 0))))
        nut = dataclasses.replace(part.nut, bodies=part.bodies, deviations=part.deviations, losses=losses(rng))
        if isinstance(nut, bs.SingleNut):
            nut = dataclasses.replace(nut, angle_under_load=True)
        screw = dataclasses.replace(part.screw, nut=nut)
        result = MODELS[name](screw, oil, axial_load=part.load, screw_speed=speed)
        wrong = faults_of(result, size)
    except InputError as error:
        if is_strange or not knows:
            return Outcome(refused=size)
        return Outcome(wrong=[f"{words}: {error}"] * size)
    except Exception as error:
        return Outcome(wrong=[f"{words}: {workers.last_line(error)}"] * size)
    if not knows:
        return Outcome(wrong=[f"{words}: oversize balls with two contacts"] * size)
    right = np.isin(np.arange(size), list(wrong), invert=True)
    valid = np.broadcast_to(result.valid, (size,))
    lines = [f"{words}, nut {i}: {fault}" for i, fault in sorted(wrong.items())]
    return Outcome(int(np.sum(valid & right)), int(np.sum(~valid & right)), lines)


def through_lift_off(part: NutCase, rng: np.random.Generator) -> NutCase:
    """The draw with loads of up to four preloads in one of two; lift-off of rigid bodies is at 2.8."""
    preload = getattr(part.nut, "preload", None)
    if preload is None or rng.random() < 0.5:
        return part
    return dataclasses.replace(part, load=preload * rng.uniform(0, 4, part.load.size))


def strange(part: NutCase, rng: np.random.Generator) -> NutCase:
    """The draw with one number of one nut replaced by one that no nut has."""
    parts: dict[str, Any] = {"screw": part.screw, "nut": part.nut, "bodies": part.bodies}
    arrays = [
        (name, field.name)
        for name, given in parts.items()
        if given is not None
        for field in dataclasses.fields(given)
        if isinstance(getattr(given, field.name), np.ndarray)
    ]
    name, field = arrays[int(rng.integers(len(arrays)))]
    values = getattr(parts[name], field).copy()
    values[int(rng.integers(values.size))] = rng.choice(STRANGE)
    return dataclasses.replace(part, **{name: dataclasses.replace(parts[name], **{field: values})})


def losses(rng: np.random.Generator) -> dict[str, ParasiticLaw]:
    """Some of the losses besides the balls."""
    known: dict[str, ParasiticLaw] = {
        "seals": Seals(float(rng.uniform(0, 1))),
        "lips": LipSeals(float(rng.uniform(0, 100))),
        "churning": Churning(float(rng.uniform(0, 1))),
        "harris": HarrisChurning(float(rng.uniform(0, 1))),
        "recirculation": Recirculation(float(rng.uniform(0, 10))),
    }
    return {name: law for name, law in known.items() if rng.random() < 0.3}


def faults_of(result: FrictionResult, size: int) -> dict[int, str]:
    """Words on the nuts with a wrong result."""
    values, valid, loads = {name: getattr(result, name) for name in TORQUES}, result.valid, result.loads
    faults = dict(faults_of_parts(values, {"friction": result.screw_torque}, valid, size))
    faults |= dict(faults_of_efficiency(result, size))
    with np.errstate(all="ignore"):
        pulled = np.any((loads.forward_load < 0) | (loads.backward_load < 0), axis=-1)
    faults["valid, and a ball is pulled"] = valid & pulled
    faults["valid, and its loads did not converge"] = valid & ~loads.converged
    return {int(i): fault for fault, mask in faults.items() for i in np.flatnonzero(np.broadcast_to(mask, (size,)))}
