"""Filling a store: one block is evaluated while the one before it is written."""

from __future__ import annotations

import logging
import os
import shutil
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.evaluation.engines import Engine
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Plan
from ballscrew.engine.sweeps.cluster import check_cluster, fill_on_cluster
from ballscrew.engine.sweeps.store import Store, stopping_cleanly
from ballscrew.engine.sweeps.store_files import WHERE, Content, Lock, refuse_unsafe

#: Outputs of a block that are compressed and written at a time.
WRITERS = 4

_log = logging.getLogger(__name__)


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
    verify: bool = False,
    trust: bool = False,
) -> xr.Dataset:
    """Evaluate a plan into the store ``to``, from where it was stopped if it was, and open it.

    ``block_size`` is the number of points of a block at most; ``attributes`` are kept beside those
    of the plan. ``done(finished, total)`` reports points, first those finished before.
    Blocks whose files are damaged are computed again, and the log tells. Of finished blocks sizes and checksums are
    compared before a run goes on, of a complete store sizes, with ``verify`` also checksums.
    Raises :class:`~ballscrew.basis.errors.InputError` if something else is there or another process
    writes it, and :class:`~ballscrew.engine.sweeps.store.UnfinishedSweepError` if the disk is full or the cluster is
    lost.
    """
    if cluster is not None:
        check_cluster(cluster)
    store, evaluation = Store.of(to, plan, engine=engine, block_size=block_size, attributes=attributes, trust=trust)
    if not verify and store.is_intact:
        _log.info("%s: complete already, nothing was computed", store.path)
        return store.opened()
    lock = _locked(store, trust=trust)
    try:
        with stopping_cleanly(store):
            new = store.begin()
            pending = store.pending(new=new)
            if pending:
                _fill(store, evaluation, pending, new=new, threads=threads, done=done, cluster=cluster)
            elif store.is_complete:
                _log.info("%s: complete already, all checksums hold, nothing was computed", store.path)
            store.finish()
    finally:
        lock.release()
    return store.opened()


def _locked(store: Store, *, trust: bool) -> Lock:
    try:
        store.own.mkdir(parents=True, exist_ok=True)
        refuse_unsafe(store.path, trust=trust)  # once more, now that nobody else can have made the folder
        return Lock(store.own / "lock", WHERE, store.path)
    except OSError as error:
        why = f"{store.path}: {error.strerror or error}"
        raise InputError(Fault(WHERE, "cannot be written", why, "choose another place")) from None


def _fill(
    store: Store,
    evaluation: Evaluation,
    pending: Sequence[int],
    *,
    new: bool,
    threads: int | None,
    done: Callable[[int, int], None] | None,
    cluster: Any,
) -> None:
    """Evaluate the blocks that are not finished, here or on a cluster."""
    points = store.plan.total - sum(map(store.blocks.points, pending))

    def report(more: int) -> None:
        if done is not None:
            done(points + more, store.plan.total)

    report(0)
    try:
        if cluster is not None:
            fill_on_cluster(store, cluster, pending, report, threads=threads)
        else:
            fill(store, evaluation, pending, report, threads=threads)
    except InputError:
        if new and not store.finished():  # no block was written: remove the empty store
            shutil.rmtree(store.path, ignore_errors=True)
        raise


def fill(
    store: Store,
    evaluation: Evaluation,
    pending: Sequence[int],
    report: Callable[[int], None],
    *,
    threads: int | None = None,
) -> None:
    """Evaluate blocks and write them; two of them are in memory at a time. ``report`` gets points."""
    room = [evaluation.empty(store.blocks.largest) for _ in range(min(2, len(pending)))]
    being_written: list[tuple[int, Mapping[str, np.ndarray], dict[str, Future[Content]]]] = []
    points = 0

    def commit_pending() -> None:
        """Wait for the block being written and mark it as finished."""
        while being_written:
            number, results, writes = being_written.pop()
            wait(writes.values())
            store.commit(number, results, {name: write.result() for name, write in writes.items()})

    with ThreadPoolExecutor(WRITERS) as pool:
        try:
            for turn, number in enumerate(pending):
                span, before = store.blocks.span(number), points
                size = span.stop - span.start
                results = {name: values[:size] for name, values in room[turn % 2].items()}
                evaluation.fill(
                    results, span, threads=threads, done=lambda part, _, before=before: report(before + part)
                )
                points += size
                commit_pending()
                writes = {name: pool.submit(store.write, number, name, results[name]) for name in store.variables}
                being_written.append((number, results, writes))
        finally:
            commit_pending()
