"""Overflow of plain numbers, reported as an error in the input."""

from __future__ import annotations

import contextlib
from collections.abc import Generator

from ballscrew.basis.errors import Fault, InputError


@contextlib.contextmanager
def overflow_as_input_error() -> Generator[None]:
    """Turn an overflow or a division by zero of plain floats into an input error; also a decorator.

    Arrays become infinite or NaN instead, and are covered by the validity.
    """
    try:
        yield
    except (OverflowError, ZeroDivisionError) as error:
        if hasattr(error, "raised_by_law"):  # a law from outside, whose author wants to see it
            raise
        problem, remedy = "has numbers too large or too small to compute with", "look for powers of ten too many"
        raise InputError(Fault("case", problem, str(error.args[-1]), remedy)) from error
