"""Numbers that no computer can compute with, said as a fault of the case."""

from __future__ import annotations

import contextlib
from collections.abc import Generator

from ballscrew.faults import Fault, InputError


@contextlib.contextmanager
def computable() -> Generator[None]:
    """Also a decorator: what overflows, as plain numbers do where arrays become infinite, is a fault of the input."""
    try:
        yield
    except (OverflowError, ZeroDivisionError) as error:
        problem, remedy = "has numbers too large or too small to compute with", "look for powers of ten too many"
        raise InputError(Fault("case", problem, str(error.args[-1]), remedy)) from error
