"""Memory of the server: what heavy work leaves behind is given back to the system."""

from __future__ import annotations

import ctypes
import gc
import sys
from collections.abc import Callable
from typing import Any, TypeVar

from ballscrew.engine.evaluation import recordings

Argument = TypeVar("Argument")
Result = TypeVar("Result")


def _trimming() -> Callable[[int], int] | None:
    """``malloc_trim`` of glibc, which keeps what was freed; no other allocator needs it."""
    library: Any = ctypes.CDLL(None) if sys.platform == "linux" else None
    return getattr(library, "malloc_trim", None)


_TRIM = _trimming()


def keep_loaded() -> None:
    """Spare the collector what is loaded by now and stays: each collection is the quicker."""
    gc.collect()
    gc.freeze()


def releasing(work: Callable[[Argument], Result]) -> Callable[[Argument], Result]:
    """The work; after it its cycles (figures, tapes) are collected, and their memory goes back to the system.

    Recordings are dropped, too: each case of a user has its own, which few will ask for again. Those that serve every
    case of a kind stay, and the collector is spared them.
    """

    def released(argument: Argument) -> Result:
        made = recordings.Structures.made
        try:
            return work(argument)
        finally:
            recordings.forget()
            if recordings.Structures.made == made:
                gc.collect()
            else:
                keep_loaded()
            if _TRIM is not None:
                _TRIM(0)

    return released
