"""Progress of requests that take seconds: clients name a ticket of their own, and ask by it how far the work is."""

from __future__ import annotations

import threading
from collections import OrderedDict
from collections.abc import Callable

#: Tickets that are kept; the oldest is forgotten first.
MOST_TICKETS = 64

_finished: OrderedDict[str, tuple[int, int]] = OrderedDict()
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
