"""Progress of requests that take seconds: clients name a ticket of their own, and ask by it how far the work is.

A request that was stopped by the limit of its time goes on where it stopped when it is sent again with its ticket.
"""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable
from typing import Any

#: Tickets that are kept; the oldest is forgotten first.
MOST_TICKETS = 64

#: Requests whose work is kept to be gone on with.
MOST_UNFINISHED = 2

_finished: OrderedDict[str, tuple[int, int]] = OrderedDict()
_unfinished: OrderedDict[tuple[str, str], dict[str, Any]] = OrderedDict()
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
    with _lock:
        found = _unfinished.setdefault((ticket, body), {})
        _unfinished.move_to_end((ticket, body))
        if len(_unfinished) > MOST_UNFINISHED:
            _unfinished.popitem(last=False)
        return found


def finish(ticket: str, body: str) -> None:
    """Forget what was found, as the request is answered."""
    with _lock:
        _unfinished.pop((ticket, body), None)
