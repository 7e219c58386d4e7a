"""Kernels that find the least and the greatest value of each input while they read it.

What a large array is checked for are its ends. To read it once more for them takes half as long as the kernel itself.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.emission import ENDS_OF_EACH
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.tracing.program import Source

#: The bits of infinity: of a positive number they are less, of NaN more; those of negative numbers are negative.
_INFINITY = 0x7FF0000000000000


class WatchedKernel:
    """A kernel of a ``watched`` assembly (:func:`~ballscrew.compiler.kernels.emission.kernel_text`)."""

    def __init__(self, text: str, sources: Sequence[Source], lanes: int) -> None:
        self._kernel = Kernel.of(text, sources)
        self._watched = [source == "points" for source in sources]
        self._lanes = lanes

    def __call__(
        self,
        count: int,
        inputs: Sequence[NDArray[np.float64]],
        results: Sequence[NDArray[Any]],
        *,
        past_cache: bool | None = None,
    ) -> list[NDArray[np.float64] | None]:
        """Evaluate points; return the ends of each input over them, NaN as both where it has one."""
        result = np.empty((sum(self._watched), ENDS_OF_EACH, self._lanes), dtype=np.int64)
        self._kernel(slice(0, 1), slice(0, count), count, inputs, [*results, result], past_cache=past_cache)
        bits = iter(result)
        return [
            self._ends(values, next(bits)) if watched else None
            for values, watched in zip(inputs, self._watched, strict=True)
        ]

    def _ends(self, values: NDArray[np.float64], bits: NDArray[np.int64]) -> NDArray[np.float64]:
        """The ends by the bits of whole vectors, and the last values; by all values where not all are positive."""
        least, greatest = bits[0].min(), bits[1].max()
        whole = values.size // self._lanes * self._lanes
        if whole == 0 or least < 0 or greatest > _INFINITY:
            return np.array([values.min(), values.max()])
        ends = np.array([least, greatest]).view(np.float64)
        rest = values[whole:]
        # NaN among the last comes out as both
        return np.array([np.min(rest, initial=ends[0]), np.max(rest, initial=ends[1])])
