"""A shaft that its bearings and its nut hold sideways: where it buckles and whirls, by the place of the nut.

A uniform beam of Euler and Bernoulli on three supports, in cubic elements. The roots stand in the formulas of
:mod:`ballscrew.physics.equations.shaft` as those of :class:`~ballscrew.physics.sizing.installation.Ends` do.
"""

from __future__ import annotations

import functools
import math
from typing import Any, cast

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from ballscrew.physics.sizing.installation import Ends

Matrix = NDArray[np.float64]

#: Elements of each of the two stretches: the roots are good to 1e-6.
ELEMENTS = 24
#: Which of the two ends are held against sliding sideways and against turning.
_HELD = {
    Ends.FIXED_FIXED: ((True, True), (True, True)),
    Ends.FIXED_SUPPORTED: ((True, True), (True, False)),
    Ends.SUPPORTED_SUPPORTED: ((True, False), (True, False)),
    Ends.FIXED_FREE: ((True, True), (False, False)),
}


@functools.cache
def whirling_root(ends: Ends, share: float, *, nut_holds_slope: bool = False) -> float:
    """Root of the lowest bending vibration of a shaft whose nut is at a share of its length, 0 to 1."""
    stiffness, mass, _ = _beam(ends, share, nut_holds_slope)
    least: Any = eigh(stiffness, mass, eigvals_only=True, subset_by_index=[0, 0])
    return float(least[0]) ** 0.25


@functools.cache
def buckling_root(ends: Ends, share: float, *, nut_holds_slope: bool = False) -> float:
    """Root of the load of the nut, at a share of the length, under which the shaft buckles, for the whole length.

    One bearing, the first, holds the load; of a shaft that is fixed at both ends each holds its part of it, and the
    worse of the two directions counts. The stretch that is pulled is not counted as stiffer.
    """
    stiffness, _, compressed = _beam(ends, share, nut_holds_slope)
    both = ends is Ends.FIXED_FIXED
    parts = (1 - share, share) if both else (1.0,)
    roots = [
        _root(part * by_load, stiffness) for part, by_load in zip(parts, compressed, strict=False) if np.any(by_load)
    ]
    return min(roots)


def _root(by_load: Matrix, stiffness: Matrix) -> float:
    last = len(stiffness) - 1
    result: Any = eigh(by_load, stiffness, eigvals_only=True, subset_by_index=[last, last])
    return 1 / math.sqrt(float(result[0])) if result[0] > 0 else math.inf


def _beam(ends: Ends, share: float, nut_holds_slope: bool) -> tuple[Matrix, Matrix, tuple[Matrix, Matrix]]:
    """Matrices of stiffness, mass, and of a unit push in each stretch, of a beam of unit length, held as it is."""
    lengths = [length for length in (share, 1 - share) if length > 0]
    places = ELEMENTS * len(lengths) + 1
    stiffness, mass = np.zeros((2, 2 * places, 2 * places))
    pushed = np.zeros((2, 2 * places, 2 * places))
    for stretch, length in enumerate(lengths):
        h = length / ELEMENTS
        bent, heavy, tipped = _element(h)
        for first in range(stretch * ELEMENTS, (stretch + 1) * ELEMENTS):
            own = slice(2 * first, 2 * first + 4)
            stiffness[own, own] += bent
            mass[own, own] += heavy
            # with the nut at the first bearing the only stretch is the second
            pushed[stretch + (share <= 0), own, own] += tipped
    held = np.zeros((places, 2), dtype=bool)
    held[0], held[-1] = _HELD[ends]
    nut = 0 if share <= 0 else ELEMENTS
    held[nut] |= (True, nut_holds_slope)
    free = np.flatnonzero(~held.ravel())
    at = np.ix_(free, free)
    return stiffness[at], mass[at], (cast("Matrix", pushed[0][at]), cast("Matrix", pushed[1][at]))


def _element(h: float) -> tuple[Matrix, Matrix, Matrix]:
    """Stiffness, consistent mass and effect of a push of a cubic beam element of a length, for unit EI and ρA."""
    bent = np.array([[12, 6, -12, 6], [6, 4, -6, 2], [-12, -6, 12, -6], [6, 2, -6, 4]]) / h**3
    heavy = np.array([[156, 22, 54, -13], [22, 4, 13, -3], [54, 13, 156, -22], [-13, -3, -22, 4]]) * h / 420
    tipped = np.array([[36, 3, -36, 3], [3, 4, -3, -1], [-36, -3, 36, -3], [3, -1, -3, 4]]) / (30 * h)
    turned = np.array([1, h, 1, h])
    scale = np.outer(turned, turned)
    return bent * scale, heavy * scale, tipped * scale
