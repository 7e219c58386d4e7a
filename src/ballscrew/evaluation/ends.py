"""The ends of arrays: least and greatest element, of large arrays on a few threads and in one pass over the memory."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew._arrays import map_blocks

#: Numbers of a block: they are in the cache when they are read for the second time.
BLOCK = 2**18


def ends(values: NDArray[Any]) -> NDArray[Any]:
    """The least and the greatest element of an array with at least one; NaN as both where it has one."""
    if values.size <= 2 * BLOCK or not values.flags.c_contiguous:
        return np.array([values.min(), values.max()])
    flat = values.reshape(-1)
    found = np.empty((2, math.ceil(flat.size / BLOCK)), dtype=values.dtype)

    def of_block(block: slice) -> None:
        part = flat[block]
        found[:, block.start // BLOCK] = part.min(), part.max()

    map_blocks(of_block, flat.size, block_size=BLOCK)
    return np.array([found[0].min(), found[1].max()])
