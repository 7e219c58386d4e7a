"""Filling a store: one block is evaluated while the one before it is written."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.analyses.cluster import check, fill_on_cluster
from ballscrew.analyses.engines import Engine
from ballscrew.analyses.evaluation import Evaluation
from ballscrew.analyses.lock import Lock
from ballscrew.analyses.plan import Plan
from ballscrew.analyses.store import Store, stopping_cleanly
from ballscrew.analyses.store_rows import WHERE
from ballscrew.faults import Fault, InputError

#: Outputs of a block that are compressed and written at a time.
WRITERS = 4


def stream(
    plan: Plan,
    to: str | os.PathLike[str],
    *,
    engine: Engine | None = None,
    block_size: int | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    cluster: Any = None,
    attributes: Mapping[str, Any] | None = None,
) -> xr.Dataset:
    """Evaluate a plan into the store ``to``, from where it was stopped if it was, and open it.

    ``block_size`` is the number of points of a block at most; ``attributes`` are kept beside those
    of the plan. ``done(finished, total)`` is told points, first those finished before.
    Raises :class:`~ballscrew.faults.InputError` if something else lies there or somebody else
    writes it, and :class:`~ballscrew.analyses.store.Unfinished` if the disk or the cluster gives out.
    """
    if cluster is not None:
        check(cluster)
    store, evaluation = Store.of(to, plan, engine=engine, block_size=block_size, attributes=attributes)
    if store.is_complete and store.is_tidy:
        return store.opened()
    lock = _locked(store)
    try:
        with stopping_cleanly(store):
            store.begin()
            if not store.is_complete:
                _fill(store, evaluation, threads=threads, done=done, cluster=cluster)
            store.finish()
    finally:
        lock.release()
    return store.opened()


def _locked(store: Store) -> Lock:
    try:
        store.own.mkdir(parents=True, exist_ok=True)
        return Lock(store.own / "lock", WHERE, store.path)
    except OSError as error:
        why = f"{store.path}: {error.strerror or error}"
        raise InputError(Fault(WHERE, "cannot be written", why, "choose another place")) from None


def _fill(
    store: Store,
    evaluation: Evaluation,
    *,
    threads: int | None,
    done: Callable[[int, int], None] | None,
    cluster: Any,
) -> None:
    """All blocks that are not finished, here or on a cluster."""
    finished = store.finished()
    pending = [number for number in range(store.blocks.count) if number not in finished]
    points = sum(map(store.blocks.points, finished))

    def tell(more: int) -> None:
        if done is not None:
            done(points + more, store.plan.total)

    tell(0)
    try:
        if cluster is not None:
            fill_on_cluster(store, cluster, pending, tell, threads=threads)
        else:
            fill(store, evaluation, pending, tell, threads=threads)
    except InputError:
        if not store.finished():  # nothing is left of what never began
            shutil.rmtree(store.path, ignore_errors=True)
        raise


def fill(
    store: Store,
    evaluation: Evaluation,
    pending: Sequence[int],
    tell: Callable[[int], None],
    *,
    threads: int | None = None,
) -> None:
    """Evaluate blocks and write them; two of them are in memory at a time. ``tell`` is told points."""
    room = [evaluation.empty(store.blocks.largest) for _ in range(min(2, len(pending)))]
    waiting: list[tuple[int, Mapping[str, np.ndarray], list[Future[str]]]] = []
    points = 0

    def settle() -> None:
        """Say of the block being written that it is finished, once it is."""
        while waiting:
            number, results, writes = waiting.pop()
            wait(writes)
            store.commit(number, results, [write.result() for write in writes])

    with ThreadPoolExecutor(WRITERS) as pool:
        try:
            for turn, number in enumerate(pending):
                span, before = store.blocks.span(number), points
                size = span.stop - span.start
                results = {name: values[:size] for name, values in room[turn % 2].items()}
                evaluation.fill(results, span, threads=threads, done=lambda part, _, before=before: tell(before + part))
                points += size
                settle()
                writes = [pool.submit(store.write, number, name, results[name]) for name in store.variables]
                waiting.append((number, results, writes))
        finally:
            settle()
