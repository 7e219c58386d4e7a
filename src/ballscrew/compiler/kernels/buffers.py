"""Large arrays for results, in memory that has been used before where there is some.

Of memory that is new to the process the system first clears each page, which takes as long as a kernel needs to fill
it. So the memory of large arrays is kept when the last array in it is gone, for the next ones. The system is told
that it may take it back whenever it needs it (``MADV_FREE``); where it cannot be told so, nothing is kept.
"""

from __future__ import annotations

import contextlib
import mmap
import os
from collections import deque
from typing import Any

import numpy as np
from numpy.typing import NDArray

#: Alignment in bytes that non-temporal stores need.
ALIGNMENT = 64
#: Size of a huge page, and the least size of what is kept.
HUGE_PAGE, LEAST_KEPT = 2 * 2**20, 2**20
#: Most memory that is kept in bytes, and the most pieces of it.
MOST_KEPT, MOST_PIECES = 2**30, 64
#: A piece is taken for an array of at least this share of its size.
LEAST_SHARE = 0.5

_MAY_BE_KEPT = hasattr(mmap, "MADV_FREE") and hasattr(mmap, "MAP_ANONYMOUS")
#: Memory that no array is in; a deque, as its methods need no lock, which a finaliser could not wait for.
_kept: deque[mmap.mmap] = deque()


def aligned_array(count: int, dtype: type) -> NDArray[Any]:
    """An uninitialised array aligned for non-temporal stores."""
    size = count * np.dtype(dtype).itemsize
    if size >= LEAST_KEPT and _MAY_BE_KEPT:
        return np.asarray(_Piece(_taken(size) or _mapped(size), size)).view(dtype)
    raw = np.empty(size + ALIGNMENT, dtype=np.uint8)
    start = -raw.ctypes.data % ALIGNMENT
    return raw[start : start + size].view(dtype)


def forget() -> None:
    """Give what is kept back to the system."""
    _kept.clear()


class _Piece:
    """Memory with arrays in it, which hold it; it is kept when the last of them is gone."""

    def __init__(self, memory: mmap.mmap, size: int) -> None:
        self._memory = memory
        address = np.frombuffer(memory, np.uint8, 1).__array_interface__["data"][0]
        address += -address % HUGE_PAGE
        self.__array_interface__ = {"version": 3, "shape": (size,), "typestr": "|u1", "data": (address, False)}

    def __del__(self) -> None:
        """Keep the memory, as long as there is not too much."""
        # not kept where the system refuses, another thread is quicker, or Python is being shut down
        with contextlib.suppress(OSError, RuntimeError, IndexError, TypeError, AttributeError):
            self._memory.madvise(mmap.MADV_FREE)
            _kept.append(self._memory)
            while len(_kept) > MOST_PIECES or sum(map(len, _kept.copy())) > MOST_KEPT:
                _kept.popleft()


def _mapped(size: int) -> mmap.mmap:
    """New memory with room to begin at a huge page."""
    whole = -(-size // HUGE_PAGE) * HUGE_PAGE + HUGE_PAGE
    memory = mmap.mmap(-1, whole, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    if hasattr(mmap, "MADV_HUGEPAGE"):
        with contextlib.suppress(OSError):  # a system without them
            memory.madvise(mmap.MADV_HUGEPAGE)
    return memory


def _taken(size: int) -> mmap.mmap | None:
    """The smallest piece that is kept and large enough, but not too large."""
    for memory in sorted(_kept.copy(), key=len):
        if size + HUGE_PAGE <= len(memory) and size >= LEAST_SHARE * (len(memory) - 2 * HUGE_PAGE):
            try:
                _kept.remove(memory)
            except ValueError:  # another thread was quicker
                continue
            return memory
    return None


if hasattr(os, "register_at_fork"):  # what a child writes into it would be copied page by page
    os.register_at_fork(after_in_child=forget)
