"""Exported programs at inputs of every size, numbers next to zero among them, against the model in Python.

Loads, speeds, preloads and temperatures of both signs and of every power of ten from the smallest number above zero to
the largest, for the three models with a nut of each kind, in the interpreter in C that programs and FMUs carry.

*Wrong*: another number than the model in Python to 1e-12 of the largest part of its kind, a NaN on one side only,
another validity.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Mapping

import numpy as np
from benchmarks.hostile import workers
from benchmarks.hostile.tally import Outcome, Tally
from numpy.typing import NDArray

import ballscrew as bs
from ballscrew.exports import hand_over
from ballscrew.exports.programs.interpreter import Interpreted, program_file, runs_here
from ballscrew.exports.subject import HandOver
from support.strategies import MODELS

COUNT, SECONDS = 40_000, 120.0

SIZE = 400
#: Relative: of the same operations in another order.
ROUNDING = 1e-12
NUTS = {
    "single": bs.SingleNut(),
    "double": bs.DoubleNut(preload=700.0),
    "oversize": bs.OversizeBallNut(preload=700.0),
}
KINDS = tuple(itertools.product(MODELS, NUTS))


def run(tally: Tally, seed: int) -> None:
    """Try inputs of every size."""
    if not runs_here():
        tally.notes.append("The prebuilt interpreter does not run on this machine: nothing was tried.")
        return
    workers.run(attempt, tally, seed, SIZE)


@functools.cache
def _handed(model: str, nut: str) -> tuple[HandOver, Interpreted]:
    screw = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=NUTS[nut])
    found = hand_over.export_job(
        MODELS[model], screw, bs.Lubricant.from_grade("ISO VG 100", temperature=313.15), "program"
    )
    return found, Interpreted(program_file(found))


def _of_every_size(rng: np.random.Generator, size: int, largest: float) -> NDArray[np.float64]:
    """Numbers of both signs: usual, zero, next to zero, huge."""
    usual = rng.uniform(-largest, largest, size)
    any_size = rng.choice([-1.0, 1.0], size) * 10.0 ** rng.uniform(-323.3, 308.2, size)
    least = rng.choice([0.0, -0.0, 5e-324, -5e-324, 2.2250738585072014e-308], size)
    kind = rng.random(size)
    return np.where(kind < 0.5, usual, np.where(kind < 0.95, any_size, least))


def _by_model(handed: HandOver, points: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
    """The outputs of the model as it is called in Python, not of what was recorded of it."""
    limits = handed.formula_range
    clamped = {name: np.clip(values, *limits[name]) for name, values in points.items()}
    within = np.logical_and.reduce([clamped[name] == values for name, values in points.items()])
    result = handed.subject.at({name: values for name, values in clamped.items() if handed.has_effect[name]})
    found = {one.name: np.broadcast_to(one.read(result), within.shape) for one in handed.outputs}
    return {**found, "valid": found["valid"].astype(bool) & within}


def attempt(seed: int, number: int, size: int) -> Outcome:
    """One program at some points."""
    rng = np.random.default_rng([seed, number])
    model, nut = KINDS[number % len(KINDS)]
    try:
        handed, program = _handed(model, nut)
    except bs.InputError:  # a model without such a nut
        return Outcome(refused=size)
    points = {
        "axial_load": _of_every_size(rng, size, 8e3),
        "screw_speed": _of_every_size(rng, size, 300.0),
        "preload": np.where(rng.random(size) < 0.9, rng.uniform(200.0, 2e3, size), _of_every_size(rng, size, 2e3)),
        "temperature": np.where(
            rng.random(size) < 0.9, rng.uniform(263.0, 353.0, size), _of_every_size(rng, size, 400.0)
        ),
    }
    points = {name: points[name] for name in handed.input_names}
    with np.errstate(all="ignore"):
        wanted, found = _by_model(handed, points), program.at(points)
    wrong = np.zeros(size, bool)
    words = np.full(size, "", object)
    valid = wanted["valid"]
    for name, values in wanted.items():
        expected, given = np.asarray(values, float), found[name]
        with np.errstate(all="ignore"):
            scale = np.maximum(np.abs(expected), np.abs(wanted["drive_torque"]) if name.endswith("torque") else 0.0)
            same = (expected == given) | (np.abs(expected - given) <= ROUNDING * scale)
        same |= np.isnan(expected) & np.isnan(given)
        same |= (np.abs(expected) < 1e-300) & (np.abs(given) < 1e-300)
        bad = ~same & (valid | (name == "valid"))
        words[bad & ~wrong] = name
        wrong |= bad
    lines = [
        f"attempt {number} ({model}, {nut}): {words[i]} {found[words[i]][i]!r}, not {float(wanted[words[i]][i])!r}, at "
        + ", ".join(f"{name} {points[name][i]!r}" for name in points)
        for i in np.flatnonzero(wrong)
    ]
    return Outcome(int(np.sum(valid & ~wrong)), int(np.sum(~valid & ~wrong)), lines)
