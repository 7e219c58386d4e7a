"""Time of one call, for the benchmarks."""

from __future__ import annotations

import time
from collections.abc import Callable
from typing import Any


def seconds(work: Callable[[], Any]) -> float:
    """Time of one call, s; the first has what is done once in it."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start
