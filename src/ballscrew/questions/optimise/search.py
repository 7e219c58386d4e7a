"""The search itself: NSGA-II of pymoo on a function of many designs. Nothing of ball screws is in it."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError

Numbers = NDArray[np.float64]
#: Costs, all to be small, and constraints, at most zero where they hold, of designs: one row each.
Evaluate = Callable[[Numbers], tuple[Numbers, Numbers]]
#: What stands for a constraint that is no number: worse than any other.
_WORST = 1e6


class Found(NamedTuple):
    """The designs of the front with their costs, and how many were evaluated; empty where none holds."""

    designs: Numbers
    costs: Numbers
    evaluations: int
    #: The last generation, from which another search may go on.
    population: Numbers


def search(
    evaluate: Evaluate,
    lower: Numbers,
    upper: Numbers,
    *,
    population: int,
    generations: int,
    seed: int,
    start: Numbers | None = None,
    done: Callable[[int], None] | None = None,
) -> Found:
    """The Pareto front of a constrained problem by NSGA-II.

    As pymoo has it (BlankDeb2020): designs that hold before those that do not, these by the sum of what they exceed.
    The same seed gives the same front; ``start`` has designs of the first generation. A design whose costs or
    constraints are no numbers counts as one that does not hold. ``done`` is told the designs that were evaluated, after
    each generation.

    Raises :class:`~ballscrew.basis.errors.InputError` where pymoo is not installed.
    """
    pymoo = _pymoo()
    costs, constraints = _sound(*evaluate((lower + upper)[np.newaxis] / 2))
    count, evaluated = population * generations, 0

    class Problem(pymoo.Problem):
        def __init__(self) -> None:
            counts = {"n_obj": costs.shape[1], "n_ieq_constr": constraints.shape[1]}
            super().__init__(n_var=len(lower), xl=lower, xu=upper, **counts)

        def _evaluate(self, x: Numbers, out: dict[str, Any], *_: Any, **__: Any) -> None:
            nonlocal evaluated
            out["F"], out["G"] = _sound(*evaluate(np.asarray(x, dtype=float)))
            evaluated += len(x)
            if done is not None:
                done(min(evaluated, count))

    first = {} if start is None else {"sampling": start}
    result = pymoo.minimize(
        Problem(), pymoo.NSGA2(pop_size=population, **first), ("n_gen", generations), seed=seed, verbose=False
    )
    last = np.asarray(result.pop.get("X"), dtype=float)
    if result.X is None:
        return Found(np.empty((0, len(lower))), np.empty((0, costs.shape[1])), count, last)
    designs = np.atleast_2d(result.X).astype(float)
    return Found(designs, np.atleast_2d(result.F).astype(float), count, last)


def _sound(costs: Numbers, constraints: Numbers) -> tuple[Numbers, Numbers]:
    """Costs and constraints without NaN: such a design does not hold."""
    bad = ~np.isfinite(costs).all(axis=1) | np.isnan(constraints).any(axis=1)
    limited = np.clip(np.nan_to_num(constraints, nan=_WORST, posinf=_WORST, neginf=-_WORST), -_WORST, _WORST)
    return (
        np.where(np.isfinite(costs), costs, _WORST),
        np.column_stack([limited, np.where(bad, 1.0, -1.0)]),
    )


class _Pymoo(NamedTuple):
    Problem: Any
    NSGA2: Any
    minimize: Any


def _pymoo() -> _Pymoo:
    try:
        result = [
            getattr(importlib.import_module(f"pymoo.{module}"), name)
            for module, name in (
                ("core.problem", "Problem"),
                ("algorithms.moo.nsga2", "NSGA2"),
                ("optimize", "minimize"),
            )
        ]
    except ImportError:
        raise InputError(Fault("optimise", "needs pymoo", "", 'pip install "ballscrew[optimise]"')) from None
    return _Pymoo(*result)


def spread(costs: Numbers, most: int) -> list[int]:
    """The places of at most so many rows, spread evenly over a front: its ends, then the farthest from those taken."""
    if len(costs) <= most:
        return list(range(len(costs)))
    span = np.ptp(costs, axis=0)
    scaled = (costs - costs.min(axis=0)) / np.where(span > 0, span, 1.0)
    taken = list(dict.fromkeys(int(place) for place in np.argmin(scaled, axis=0)))[:most]
    distance = np.min([np.linalg.norm(scaled - scaled[place], axis=1) for place in taken], axis=0)
    while len(taken) < most:
        place = int(np.argmax(distance))
        taken.append(place)
        distance = np.minimum(distance, np.linalg.norm(scaled - scaled[place], axis=1))
    return sorted(taken)
