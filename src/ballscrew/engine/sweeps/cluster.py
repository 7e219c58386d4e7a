"""A sweep on a cluster: tasks of Dask's ``distributed``, each of which writes one block of a store.

A task gets the number of a block, makes its inputs, evaluates it, and writes its chunks itself; only
the number goes back. So **all workers must see the store under the same path**: a folder that the
nodes share. A block is the same whoever writes it, and as often as it is written; the blocks
of a lost worker are evaluated again by others.

A task evaluates on one thread, so that a worker with a thread for each core keeps all of them busy
and no core has two. For each thread it takes about 100 MB, three times the results of a block.

Filling a store: one block is evaluated while the one before it is written.
"""

from __future__ import annotations

import asyncio
import contextlib
import importlib.util
import itertools
import logging
import os
import shutil
import threading
import time
import uuid
from collections import Counter
from collections.abc import Callable, Generator, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor, wait
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.fingerprint import package_digest
from ballscrew.engine.evaluation.plan import Plan
from ballscrew.engine.evaluation.recordings import Engine
from ballscrew.engine.sweeps.store import FULL, Store, stopping_cleanly
from ballscrew.engine.sweeps.store_plan import WHERE, Content, Lock, refuse_unsafe

#: Tasks for each thread of the cluster that are under way or wait at the workers: some, so that no
#: worker waits for the scheduler; few, so that the scheduler does not hold a million of them.
IN_FLIGHT = 3
#: Tasks are sent in batches of at least one part in so many of those in flight.
REFILL_SHARE = 8
#: Least tasks in flight, also without workers: enough for a cluster that scales with its queue.
IN_FLIGHT_AT_LEAST = 8
#: Seconds after which the threads of the cluster are counted again.
RECOUNT_INTERVAL = 5.0
#: Attempts at a block that fails for a transient reason.
ATTEMPTS = 4
#: Seconds to wait for a scheduler or a worker.
TIMEOUT = 5.0

_WHERE = "sweep.cluster"
_lock = threading.Lock()
#: The evaluation of the store that this process works for.
_evaluations: dict[tuple[str, str], Evaluation] = {}


def _check_installed(where: str, given: str = "") -> None:
    if importlib.util.find_spec("distributed") is None:
        raise InputError(Fault(where, "needs distributed", given, 'pip install "ballscrew[cluster]"'))


def check_cluster(cluster: Any) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` unless it is a client of a cluster with workers."""
    _check_installed(_WHERE)
    import distributed

    if not isinstance(cluster, distributed.Client):
        remedy = 'give a distributed.Client("tcp://host:8786")'
        raise InputError(Fault(_WHERE, "is not a client of a cluster", repr(cluster), remedy))
    _wait_for_a_worker(cluster)


@contextlib.contextmanager
def cluster_client(address: str, where: str = _WHERE) -> Generator[Any]:
    """A client of the scheduler at an address.

    Raises :class:`~ballscrew.basis.errors.InputError` if no scheduler answers.
    """
    _check_installed(where, address)
    import distributed

    try:
        # distributed.Client never gives up on an answer it cannot read; a notebook's thread already runs a loop
        with ThreadPoolExecutor(1) as thread:
            thread.submit(asyncio.run, asyncio.wait_for(_identity(address), TIMEOUT)).result()
        client = distributed.Client(address, timeout=TIMEOUT, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        remedy = "give the address that the scheduler says as it starts, such as tcp://host:8786"
        raise InputError(Fault(where, "no scheduler answers", f"{address}{_reason_of(error)}", remedy)) from None
    with client:
        yield client


async def _identity(address: str) -> Any:
    """The identity that a scheduler answers with."""
    import distributed

    arguments = distributed.Security().get_connection_args("client")
    async with distributed.rpc(address, connection_args=arguments) as scheduler:
        return await scheduler.identity(n_workers=0)


def _reason_of(error: Exception) -> str:
    return f": {error}" if str(error) else ""


def fill_on_cluster(
    store: Store, client: Any, pending: Sequence[int], report: Callable[[int], None], *, threads: int | None = None
) -> None:
    """Evaluate and write blocks on the workers of a client, each task on so many threads (one)."""
    import distributed
    from distributed.comm.core import CommClosedError

    run = uuid.uuid4().hex[:8]
    sent = client.scatter(store, broadcast=True, hash=False)
    attempts: Counter[int] = Counter()
    in_flight: dict[str, tuple[int, Any]] = {}
    completed = distributed.as_completed(loop=client.loop)
    pending_blocks = iter(pending)
    points, room, counted = 0, 0, -RECOUNT_INTERVAL
    try:
        while True:
            if time.monotonic() - counted > RECOUNT_INTERVAL:
                room = max(IN_FLIGHT_AT_LEAST, IN_FLIGHT * sum(client.nthreads().values()))
                counted = time.monotonic()
            free = room - len(in_flight)
            if free >= room // REFILL_SHARE and (numbers := list(itertools.islice(pending_blocks, free))):
                keys = [f"ballscrew-{run}-{number}-{attempts[number]}" for number in numbers]
                futures = client.map(_write_block, numbers, store=sent, threads=threads or 1, key=keys, pure=False)
                in_flight |= zip(keys, zip(numbers, futures, strict=True), strict=True)
                completed.update(futures)
            if not in_flight:
                return
            lost = False
            for future in completed.next_batch():
                number, _ = in_flight.pop(future.key)
                if future.status == "finished":
                    points += store.blocks.points(number)
                    continue
                attempts[number] += 1
                _raise_unless_transient(future, number, attempts[number])
                lost |= future.status != "error"
                pending_blocks = itertools.chain([number], pending_blocks)
            if lost:  # every worker that held the plan may be lost
                sent = client.scatter(store, broadcast=True, hash=False, timeout=TIMEOUT)
            report(points)
    except CommClosedError:
        raise ConnectionError("the scheduler is gone") from None
    except TimeoutError:
        raise ConnectionError("all workers are gone") from None
    finally:
        client.cancel([future for _, future in in_flight.values()])


def _wait_for_a_worker(client: Any) -> None:
    try:
        client.wait_for_workers(1, timeout=TIMEOUT)
    except TimeoutError:
        remedy = f"start some: dask worker {client.scheduler.address}"
        raise InputError(Fault(_WHERE, "has no workers", client.scheduler.address, remedy)) from None


def _raise_unless_transient(future: Any, number: int, attempts: int) -> None:
    """Raise the error of a block, unless it is transient and the block can be tried again."""
    import distributed

    if future.status != "error":
        if attempts >= ATTEMPTS:
            raise ConnectionError(f"block {number} was lost {attempts} times")
        return
    error = future.exception()
    if isinstance(error, distributed.KilledWorker):
        remedy = "give the workers more memory, or a smaller block_size"
        raise InputError(Fault(_WHERE, "workers died of it again and again", f"block {number}", remedy))
    if not isinstance(error, OSError) or error.errno in FULL or attempts >= ATTEMPTS:
        future.result()


def _write_block(number: int, store: Store, threads: int) -> int:
    """One task: evaluate a block, write it, and return its number."""
    evaluation = _evaluation_of(store)
    results = evaluation.empty(store.blocks.points(number))
    evaluation.fill(results, store.blocks.span(number), threads=threads)
    store.commit(number, results, {name: store.write(number, name, results[name]) for name in store.variables})
    return number


def _is_same(evaluation: Evaluation, store: Store) -> bool:
    """Return whether this process evaluates the formulas of a store.

    A model that cannot be compared was sent with the store, so that the package is all that may differ.
    """
    if evaluation.identity.unknown:
        return store.description.get("package") == package_digest()
    return evaluation.fingerprint == store.description["formulas"]


def _evaluation_of(store: Store) -> Evaluation:
    """The evaluation of a store, made once in each worker after the store is checked."""
    which = str(store.path), store.digest
    with _lock:
        if which not in _evaluations:
            store.check_from_worker()
            evaluation = Evaluation.of(store.plan, store.description["engine"])
            if not _is_same(evaluation, store):
                remedy = "install the same version of ballscrew on all nodes"
                raise InputError(Fault(_WHERE, "a worker has other formulas", store.description["version"], remedy))
            _evaluations.clear()
            _evaluations[which] = evaluation
        return _evaluations[which]


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
