"""A sweep on a cluster: tasks of Dask's ``distributed``, each of which writes one block of a store.

A task gets the number of a block, makes its inputs, evaluates it, and writes its chunks itself; only
the number goes back. So **all workers must see the store under the same path**: a folder that the
nodes share. A block is the same whoever writes it, and as often as it is written; the loss of a
worker costs the blocks it was at, which others do again.

A task evaluates on one thread, so that a worker with a thread for each core keeps all of them busy
and no core has two. For each thread it takes about 100 MB, three times the results of a block.
"""

from __future__ import annotations

import asyncio
import contextlib
import importlib.util
import itertools
import threading
import time
import uuid
from collections import Counter
from collections.abc import Callable, Generator, Sequence
from typing import Any

from ballscrew.analyses.evaluation import Evaluation
from ballscrew.analyses.store import FULL, Store
from ballscrew.faults import Fault, InputError

#: Tasks for each thread of the cluster that are under way or wait at the workers: some, so that no
#: worker waits for the scheduler; few, so that the scheduler does not hold a million of them.
IN_FLIGHT = 3
#: Tasks are sent when at least this part of them is done, so that the scheduler is told of many at a time.
REFILLED_BY = 8
#: Tasks under way where nobody works yet: enough for a cluster that grows with its work.
IN_FLIGHT_AT_LEAST = 8
#: Seconds after which the threads are counted again: workers come and go.
COUNTED_EVERY = 5.0
#: How often a block is tried that fails for reasons that may pass.
ATTEMPTS = 4
#: Seconds to wait for a scheduler.
PATIENCE = 5.0

_WHERE = "sweep.cluster"
_lock = threading.Lock()
#: The evaluation of the store that this process works for.
_evaluations: dict[tuple[str, str], Evaluation] = {}


def check(cluster: Any) -> None:
    """Raise :class:`~ballscrew.faults.InputError` for what is no client of a cluster with workers."""
    if importlib.util.find_spec("distributed") is None:
        raise InputError(Fault(_WHERE, "needs distributed", "", 'pip install "ballscrew[cluster]"'))
    import distributed

    if not isinstance(cluster, distributed.Client):
        remedy = 'give a distributed.Client("tcp://host:8786")'
        raise InputError(Fault(_WHERE, "is not a client of a cluster", repr(cluster), remedy))
    _wait_for_a_worker(cluster)


@contextlib.contextmanager
def connected(address: str, where: str = _WHERE) -> Generator[Any]:
    """A client of the scheduler at an address.

    Raises :class:`~ballscrew.faults.InputError` if nobody answers there.
    """
    if importlib.util.find_spec("distributed") is None:
        raise InputError(Fault(where, "needs distributed", address, 'pip install "ballscrew[cluster]"'))
    import distributed

    try:
        # a client would wait for ever for an answer that makes no sense
        asyncio.run(asyncio.wait_for(_identity(address), PATIENCE))
        client = distributed.Client(address, timeout=PATIENCE, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        remedy = "give the address that the scheduler says as it starts, such as tcp://host:8786"
        raise InputError(Fault(where, "no scheduler answers", f"{address}{_because(error)}", remedy)) from None
    with client:
        yield client


async def _identity(address: str) -> Any:
    """What a scheduler says of itself."""
    import distributed

    arguments = distributed.Security().get_connection_args("client")
    async with distributed.rpc(address, connection_args=arguments) as scheduler:
        return await scheduler.identity(n_workers=0)


def _because(error: Exception) -> str:
    return f": {error}" if str(error) else ""


def fill_on_cluster(
    store: Store, client: Any, pending: Sequence[int], tell: Callable[[int], None], *, threads: int | None = None
) -> None:
    """Evaluate and write blocks on the workers of a client, each task on so many threads (one)."""
    import distributed
    from distributed.comm.core import CommClosedError

    run = uuid.uuid4().hex[:8]
    sent = client.scatter(store, broadcast=True, hash=False)
    tried: Counter[int] = Counter()
    under_way: dict[str, tuple[int, Any]] = {}
    completed = distributed.as_completed(loop=client.loop)
    waiting = iter(pending)
    points, room, counted = 0, 0, -COUNTED_EVERY
    try:
        while True:
            if time.monotonic() - counted > COUNTED_EVERY:
                room = max(IN_FLIGHT_AT_LEAST, IN_FLIGHT * sum(client.nthreads().values()))
                counted = time.monotonic()
            free = room - len(under_way)
            if free >= room // REFILLED_BY and (numbers := list(itertools.islice(waiting, free))):
                keys = [f"ballscrew-{run}-{number}-{tried[number]}" for number in numbers]
                futures = client.map(_write_block, numbers, store=sent, threads=threads or 1, key=keys, pure=False)
                under_way |= zip(keys, zip(numbers, futures, strict=True), strict=True)
                completed.update(futures)
            if not under_way:
                return
            lost = False
            for future in completed.next_batch():
                number, _ = under_way.pop(future.key)
                if future.status == "finished":
                    points += store.blocks.points(number)
                    continue
                tried[number] += 1
                _raise_unless_passing(future, number, tried[number])
                lost |= future.status != "error"
                waiting = itertools.chain([number], waiting)
            if lost:  # all who had the plan are gone
                sent = client.scatter(store, broadcast=True, hash=False, timeout=PATIENCE)
            tell(points)
    except CommClosedError:
        raise ConnectionError("the scheduler is gone") from None
    except TimeoutError:
        raise ConnectionError("all workers are gone") from None
    finally:
        client.cancel([future for _, future in under_way.values()])


def _wait_for_a_worker(client: Any) -> None:
    try:
        client.wait_for_workers(1, timeout=PATIENCE)
    except TimeoutError:
        remedy = f"start some: dask worker {client.scheduler.address}"
        raise InputError(Fault(_WHERE, "has no workers", client.scheduler.address, remedy)) from None


def _raise_unless_passing(future: Any, number: int, tried: int) -> None:
    """Raise what stopped a block, unless another try may go well."""
    import distributed

    if future.status != "error":
        if tried >= ATTEMPTS:
            raise ConnectionError(f"block {number} was lost {tried} times")
        return
    error = future.exception()
    if isinstance(error, distributed.KilledWorker):
        remedy = "give the workers more memory, or a smaller block_size"
        raise InputError(Fault(_WHERE, "workers died of it again and again", f"block {number}", remedy))
    if not isinstance(error, OSError) or error.errno in FULL or tried >= ATTEMPTS:
        future.result()


def _write_block(number: int, store: Store, threads: int) -> int:
    """One task: evaluate a block, write it, and return its number."""
    evaluation = _ready(store)
    results = evaluation.empty(store.blocks.points(number))
    evaluation.fill(results, store.blocks.span(number), threads=threads)
    store.commit(number, results, [store.write(number, name, results[name]) for name in store.variables])
    return number


def _ready(store: Store) -> Evaluation:
    """The evaluation of a store, made once in each worker, after a look whether all is in place."""
    which = str(store.path), store.digest
    with _lock:
        if which not in _evaluations:
            store.check_from_worker()
            evaluation = Evaluation.of(store.plan, store.told["engine"])
            if evaluation.fingerprint != store.told["formulas"]:
                remedy = "install the same version of ballscrew on all nodes"
                raise InputError(Fault(_WHERE, "a worker has other formulas", store.told["version"], remedy))
            _evaluations.clear()
            _evaluations[which] = evaluation
        return _evaluations[which]
