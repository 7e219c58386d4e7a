"""Random screws, half of them with numbers that no screw has, through all models: as arrays and one by one.

Screws, oils and operating points drawn from all that is sold and a little more; in every second thousand numbers are
replaced by zero, negative, tiny, huge, infinite or NaN. The three models on arrays; one in 50 also by the constructors,
one by one.

*Wrong*: at a valid point an efficiency that is not finite where the screw drives the load, or is finite elsewhere, a
negative part (of the torque as printed, else of the dissipated power), or power in that is not power lost to 1e-9
(corrected, reference); a point valid in an array that the constructor refuses, or whose torque differs from that alone
by more than 1e-9.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import numpy as np
from benchmarks.hostile import workers
from benchmarks.hostile.tally import Outcome
from numpy.typing import NDArray

from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.physics.components.operating_state import settled
from ballscrew.physics.friction.result import FrictionResult
from support.strategies import MODELS, Case, box

COUNT, SECONDS = 100_000, 90.0

SIZE, ALONE = 1000, 50
#: Relative: of a sum, and of numbers added in another order.
BALANCE, ROUNDING = 1e-9, 1e-12
BALANCED = ("corrected", "reference")
STRANGE = np.array([0.0, -0.0, -1.0, 0.5, 1.0, 1e-300, 1e-30, 1e-12, 1e6, 1e30, 1e300, np.nan, np.inf, -np.inf])
TORQUES = ("screw_torque", "nut_torque", "ideal_torque", "drive_torque", "friction_power")

Mask = NDArray[np.bool_]


def attempt(seed: int, number: int, size: int) -> Outcome:
    """One array of screws."""
    rng = np.random.default_rng([seed, number])
    case = box(size, int(rng.integers(1 << 31)))
    case = strange(case, rng) if number % 2 else case
    valid, wrong = np.ones(size, bool), dict[int, str]()
    for name in MODELS:
        found = checked(name, case, np.arange(size))
        valid &= found[0]
        wrong |= found[1]
    for i in range(0, size, ALONE):
        if words := alone(case, i):
            wrong[i] = words
    right = np.isin(np.arange(size), list(wrong), invert=True)
    lines = [f"attempt {number}, screw {i}: {words}" for i, words in sorted(wrong.items())]
    return Outcome(int(np.sum(valid & right)), int(np.sum(~valid & right)), lines)


def strange(case: Case, rng: np.random.Generator) -> Case:
    """The case with some numbers replaced by those that no screw has, and some scaled by up to 1e±12."""

    def replaced(values: Any) -> Any:
        size = len(values)
        new = np.where(rng.random(size) < 0.5, rng.choice(STRANGE, size), values * 10 ** rng.uniform(-12, 12, size))
        return np.where(rng.random(size) < 0.06, new, values)

    return changed(case, replaced)


def changed(case: Case, change: Callable[[Any], Any]) -> Case:
    """The case with all its arrays changed."""

    def part(given: Any) -> Any:
        arrays = {n: getattr(given, n) for n in fields_of(given) if isinstance(getattr(given, n), np.ndarray)}
        return dataclasses.replace(given, **{name: change(values) for name, values in arrays.items()})

    return Case(part(case.screw), part(case.oil), change(case.axial_load), change(case.screw_speed))


def some(case: Case, which: Any) -> Case:
    """Points of a case: an index array makes arrays, a number a case of numbers that constructors have checked."""
    return changed(case, lambda values: values[which] if np.ndim(which) else float(values[which]))


def checked(name: str, case: Case, which: NDArray[np.int_]) -> tuple[Mask, dict[int, str]]:
    """Which points are valid, and words on those that are wrong; what raises is halved until one point is left."""
    valid = np.zeros(len(which), bool)
    try:
        result = some(case, which)(MODELS[name])
        faults = dict(faults_of(name, result, len(which)))
        valid = np.broadcast_to(result.valid, which.shape)
    except Exception as error:
        if len(which) == 1:
            return valid, {int(which[0]): f"{name}: {workers.last_line(error)}"}
        half = len(which) // 2
        first, second = checked(name, case, which[:half]), checked(name, case, which[half:])
        return np.concatenate([first[0], second[0]]), first[1] | second[1]
    words = {int(which[i]): f"{name}: {fault}" for fault, mask in faults.items() for i in np.flatnonzero(mask)}
    return valid, words


def faults_of(name: str, result: FrictionResult, size: int) -> Iterator[tuple[str, Mask]]:
    """The conditions for a wrong result, with masks."""
    values = {torque: getattr(result, torque) for torque in TORQUES}
    # what creep dissipates counts as curvature slip, while its torque may fall below zero by some millionths
    parts = result.dissipation if name in BALANCED else result.contributions
    yield from faults_of_parts(values, parts, result.valid, size)
    yield from faults_of_efficiency(result, size)
    if name in BALANCED:
        with np.errstate(all="ignore"):
            power = result.screw_torque * np.abs(settled(result.screw_speed))  # what counts as rest has none
            gap, scale = np.abs(power - result.friction_power), sum(np.abs(part) for part in parts.values())
            yield "valid, and power in is not power lost", result.valid & ~(gap <= BALANCE * scale)


def faults_of_parts(
    values: Mapping[str, Any], parts: Mapping[str, Any], valid: Any, size: int
) -> Iterator[tuple[str, Mask]]:
    """The conditions that screws and nuts share: torques are finite, parts are not negative."""
    with np.errstate(all="ignore"):
        for torque, value in values.items():
            yield f"valid, and {torque} is not finite", np.broadcast_to(valid & ~np.isfinite(value), (size,))
        scale = sum(np.abs(part) for part in parts.values())
        for mechanism, part in parts.items():
            yield f"valid, and {mechanism} is negative", np.broadcast_to(valid & (part < -ROUNDING * scale), (size,))


def faults_of_efficiency(result: FrictionResult, size: int) -> Iterator[tuple[str, Mask]]:
    """It is a number where the screw drives the load, at rest in the limit, and nowhere else."""
    with np.errstate(all="ignore"):
        load, motion = np.sign(result.axial_load), np.sign(result.screw_speed)
        drives, known = (load != 0) & (load * motion >= 0), np.isfinite(result.efficiency)
        yield "valid, and efficiency is not finite", np.broadcast_to(result.valid & drives & ~known, (size,))
        yield "valid, and efficiency of nothing driven", np.broadcast_to(result.valid & ~drives & known, (size,))


def alone(case: Case, i: int) -> str:
    """Words on a screw whose constructors or scalars disagree with the arrays; empty for the others."""
    for name, model in MODELS.items():
        of_array = some(case, np.array([i]))(model)
        valid = bool(np.all(of_array.valid))
        try:
            one = some(case, i)(model)
            torque, is_valid = float(one.screw_torque), bool(one.valid)
        except InputError as error:
            if valid:
                return f"{name}: valid in an array, and refused alone: {error.lines()[0]}"
            continue
        except Exception as error:
            return f"{name}, alone: {workers.last_line(error)}"
        if valid != is_valid:
            return f"{name}: valid {valid} in an array, {is_valid} alone"
        with np.errstate(all="ignore"):
            gap = abs(torque - float(of_array.screw_torque[0]))
            scale = sum(abs(float(part)) for part in one.contributions.values())
        if valid and not gap <= BALANCE * scale:
            return f"{name}: torque {torque!r} alone, {float(of_array.screw_torque[0])!r} in an array"
    return ""
