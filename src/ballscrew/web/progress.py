"""Progress of requests that take seconds: clients name a ticket of their own, and ask by it how far the work is.

A request that was stopped by the limit of its time goes on where it stopped when it is sent again with its ticket.
"""

from __future__ import annotations

import hashlib
import threading
import time
from collections import OrderedDict
from collections.abc import Callable
from typing import Any

from ballscrew.web.request_queue import HEAVY, MOST_WAITING, TIME_LIMIT

#: Tickets that are kept; the oldest is forgotten first.
MOST_TICKETS = 64

#: Requests whose work is kept to be gone on with: all that compute or wait, or they would forget each other's.
MOST_UNFINISHED = HEAVY + MOST_WAITING
#: Seconds after which the next such request forgets it: longer than one may wait for those before it.
OLDEST = TIME_LIMIT * (2 + MOST_WAITING)

_finished: OrderedDict[str, tuple[int, int]] = OrderedDict()
#: When each was last asked for, and what it has found, by ticket and digest of the body; the oldest is first.
_unfinished: OrderedDict[tuple[str, bytes], tuple[float, dict[str, Any]]] = OrderedDict()
_lock = threading.Lock()


def reported(ticket: str, done: Callable[[int, int], None]) -> Callable[[int, int], None]:
    """``done`` that also keeps its numbers by a ticket; itself where there is no ticket."""
    if not ticket:
        return done

    def both(finished: int, total: int) -> None:
        with _lock:
            _finished[ticket] = finished, total
            _finished.move_to_end(ticket)
            if len(_finished) > MOST_TICKETS:
                _finished.popitem(last=False)
        done(finished, total)

    return both


def progress_of(ticket: str) -> tuple[int, int]:
    """How much is done of how much; zeros of a ticket that nothing is known of."""
    with _lock:
        return _finished.get(ticket, (0, 0))


def unfinished(ticket: str, body: str) -> dict[str, Any]:
    """What the work of a request with this ticket and body has found so far, by name; nothing without a ticket."""
    if not ticket:
        return {}
    key, now = _key(ticket, body), time.monotonic()
    with _lock:
        _, found = _unfinished.pop(key, (now, {}))
        _unfinished[key] = now, found
        while len(_unfinished) > MOST_UNFINISHED or next(iter(_unfinished.values()))[0] < now - OLDEST:
            _unfinished.popitem(last=False)
        return found


def finish(ticket: str, body: str) -> None:
    """Forget what was found, as the request is answered or nobody waits for it."""
    with _lock:
        _unfinished.pop(_key(ticket, body), None)


def _key(ticket: str, body: str) -> tuple[str, bytes]:
    """The ticket and a digest of the body, which is not kept."""
    return ticket, hashlib.sha256(body.encode()).digest()
