"""What a sweep into a store costs: larger than the memory, and on a cluster.

``python benchmarks/stores.py`` prints a table, ``--json`` one object, ``--only`` one of its parts. Stores go when all
is done; they need 6 bytes of disk a value, in ``--folder``.

- ``store``: rate, peak memory of the process, and size of the store, ``--points 1e8``.
- ``cluster``: a scheduler and two workers on this machine, empty tasks through the loop that sweeps go through, then
  blocks of a store. Seconds of a block are those of a worker alone and of two that share the disk.
"""

from __future__ import annotations

import dataclasses
import math
import statistics
import tempfile
import time
from pathlib import Path
from typing import Any

import distributed
import numpy as np

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.sweeps import cluster
from ballscrew.engine.sweeps.store import Store
from ballscrew.engine.sweeps.store_plan import Blocks
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from harness import asked, megabytes, seconds, told
from script import OUTPUTS

MODEL = bs.FrictionModel.olaru2005()
#: Largest memory that is asked for.
LIMITS = {"memory_MB": (600.0, False)}
#: Empty tasks under way.
WINDOW = 512


def axes(points: int) -> dict[str, Any]:
    """A grid of about so many points in load, speed and viscosity."""
    columns = 100
    rows = max(1, round(math.sqrt(points / columns)))
    return {
        "axial_load": np.linspace(100, 4000, rows),
        "screw_speed": np.linspace(1, 100, max(1, round(points / columns / rows))),
        "viscosity": np.linspace(0.05, 0.5, columns),
    }


def of_store(folder: Path | None, points: int, _: int) -> dict[str, float]:
    """The figures of a store that is filled."""
    grid = axes(points)
    with tempfile.TemporaryDirectory(prefix="ballscrew-", dir=folder) as name:
        asked_for = {"outputs": OUTPUTS, "to": Path(name) / "map.zarr", **grid}
        taken = seconds(lambda: bs.sweep(MODEL, SCREW, OIL, **asked_for))
        size = sum(path.stat().st_size for path in Path(name).rglob("*") if path.is_file())
    total = math.prod(map(len, grid.values()))
    numbers = 8 * total * len(OUTPUTS)
    return {
        "points": total,
        "outputs": len(OUTPUTS),
        "seconds": taken,
        "Mpoint_per_s": total / taken / 1e6,
        "numbers_MB_per_s": numbers / taken / 1e6,
        "disk_GB": size / 1e9,
        "disk_over_numbers": size / numbers,
        "memory_MB": megabytes(),
    }


def nothing(number: int, store: Store, threads: int) -> int:  # noqa: ARG001  (the signature of a task)
    """A task without work."""
    return number


def tasks_per_second(client: Any, store: Store, tasks: int) -> float:
    """How many tasks go through the loop of a sweep, one scheduler, this client."""
    many = dataclasses.replace(store, blocks=Blocks.of(store.plan, store.plan.total // tasks))
    real, cluster._write_block = cluster._write_block, nothing
    few, cluster.IN_FLIGHT_AT_LEAST = cluster.IN_FLIGHT_AT_LEAST, WINDOW  # as many as a large cluster has
    try:
        start = time.perf_counter()
        cluster.fill_on_cluster(many, client, range(many.blocks.count), lambda _: None)
        return many.blocks.count / (time.perf_counter() - start)
    finally:
        cluster._write_block, cluster.IN_FLIGHT_AT_LEAST = real, few


def timed_block(store: Store, number: int) -> tuple[float, float]:
    """Seconds to evaluate and to write a block."""
    evaluation = cluster._evaluation_of(store)
    start = time.perf_counter()
    results = evaluation.empty(store.blocks.points(number))
    evaluation.fill(results, store.blocks.span(number), threads=1)
    evaluated = time.perf_counter()
    store.commit(number, results, {name: store.write(number, name, results[name]) for name in store.variables})
    written = time.perf_counter()
    return evaluated - start, written - evaluated


def blocks(client: Any, store: Store, workers: list[str], numbers: range) -> list[tuple[float, float]]:
    """Blocks done by these workers, one at a time each."""
    sent = client.scatter(store, broadcast=True, hash=False)
    futures = [
        client.submit(timed_block, sent, number, workers=[workers[number % len(workers)]], pure=False)
        for number in numbers
    ]
    return client.gather(futures)


def of_cluster(folder: Path | None, points: int, tasks: int) -> dict[str, Any]:
    """The figures of a cluster."""
    plan = Plan.of(Configuration(MODEL, SCREW, OIL), OUTPUTS, axes(points))
    given = {"processes": True, "n_workers": 2, "threads_per_worker": 1, "dashboard_address": ":0"}
    with (
        tempfile.TemporaryDirectory(prefix="ballscrew-", dir=folder) as name,
        distributed.LocalCluster(host="127.0.0.1", local_directory=name, **given) as local,
        distributed.Client(local) as client,
    ):
        store, evaluation = Store.of(Path(name) / "blocks.zarr", plan)
        store.own.mkdir(parents=True)
        store.pending(new=store.begin())
        workers = list(client.nthreads())
        before = list(client.run(megabytes).values())
        rate = tasks_per_second(client, store, tasks)
        count = store.blocks.count // 2
        blocks(client, store, workers, range(2))  # compiled
        alone = blocks(client, store, workers[:1], range(count))
        both = blocks(client, store, workers, range(count, 2 * count))
        return {
            "tasks_per_s": rate,
            "task_overhead_ms": 1e3 / rate,
            "blocks": store.blocks.count,
            "points_per_block": store.blocks.largest,
            "evaluate_s": statistics.median(block[0] for block in alone),
            "write_s": statistics.median(block[1] for block in alone),
            "evaluate_both_s": statistics.median(block[0] for block in both),
            "write_both_s": statistics.median(block[1] for block in both),
            "worker_idle_memory_MB": max(before),
            "worker_memory_MB": max(client.run(megabytes).values()),
            "engine": evaluation.engine,
        }


PARTS = {"store": of_store, "cluster": of_cluster}

if __name__ == "__main__":
    options = asked(__doc__, points=2e7, tasks=20_000, folder=Path, only=list(PARTS))
    chosen = {name: PARTS[name] for name in options.only or PARTS}
    told(
        {name: part(options.folder, int(options.points), options.tasks) for name, part in chosen.items()},
        options.json,
        LIMITS,
    )
