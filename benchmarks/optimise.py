"""How fast ``ballscrew optimise`` evaluates designs, and how much better its front is than random search.

``python benchmarks/optimise.py`` prints a table, ``--json`` one object; ``--seeds 5`` takes five seeds. The need is
``examples/needs/feed_axis.toml``; random search has as many designs, drawn evenly within the same bounds.
"""

from __future__ import annotations

import math
import statistics

import numpy as np
from pymoo.indicators.hv import HV

from ballscrew.questions.optimise import compute
from ballscrew.questions.optimise.compute import Found, search
from ballscrew.questions.optimise.design_model import DesignModel, design_space
from ballscrew.questions.select.need import need_of
from ballscrew.questions.select.requirements import front
from harness import ROOT, asked, seconds, told

NEED = ROOT / "examples" / "needs" / "feed_axis.toml"
POPULATION, GENERATIONS = 200, 60
#: Loss in W and inertia in kg m² beyond which nothing counts in the hypervolume: three times the least, and ten times.
REFERENCE = np.array([100.0, 1e-2])


def prepared(nut: str) -> tuple[DesignModel, float]:
    """The model of the need with a kind of nut, and the time to record and compile it."""
    need = need_of(NEED, [f"optimise.nut={nut}"])
    space = design_space(need)
    centre = {name: math.sqrt(low * high) for name, (low, high) in space.bounds.items()}
    options = {"model": None, "calibration": None, "allow_code": False}
    case = compute._case(need, space, centre, options)
    made: list[DesignModel] = []
    taken = seconds(lambda: made.append(DesignModel.of(case, need, space, 1.0)))
    return made[0], taken


def measured(nut: str, seeds: int) -> dict[str, float]:
    """Times of the searches, and the hypervolume of their fronts over that of random search."""
    model, recording = prepared(nut)
    space, own, others, times = model.space, [], [], []
    for seed in range(seeds):
        kept: list[Found] = []

        def work(seed: int = seed, kept: list[Found] = kept) -> None:
            kept.append(
                search(model.costs, space.lower, space.upper, population=POPULATION, generations=GENERATIONS, seed=seed)
            )

        times.append(seconds(work))
        own.append(float(HV(REFERENCE)(kept[0].costs)))
        shares = np.random.default_rng(seed).random((POPULATION * GENERATIONS, len(space.names)))
        costs, constraints = model.costs(space.lower + (space.upper - space.lower) * shares)
        fitting = costs[(constraints <= 0).all(axis=1)]
        others.append(float(HV(REFERENCE)(fitting[front(fitting)])))
    found = {
        "designs": float(POPULATION * GENERATIONS),
        "record_and_compile_s": recording,
        "search_s": statistics.median(times),
        "hypervolume": statistics.median(own),
        "hypervolume_of_random_search": statistics.median(others),
        "hypervolume_ratio": min(a / b for a, b in zip(own, others, strict=True)),
    }
    elastic = model.elastic
    if elastic is not None:
        start = kept[0].population
        elastic.costs(start)  # the first of each number of balls is prepared
        found["elastic_generation_s"] = seconds(lambda: elastic.costs(start))
    return found


if __name__ == "__main__":
    options = asked(__doc__, seeds=1)
    told({nut: measured(nut, options.seeds) for nut in ("single", "double")}, options.json)
