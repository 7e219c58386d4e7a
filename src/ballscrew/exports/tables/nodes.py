"""Nodes of tables: as few values of an axis as straight lines between them need."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def chord_errors(positions: Floats, values: Floats, scale: Floats) -> Floats:
    """The worst error of a straight line from each position to each later one; 0 between neighbours.

    ``values`` has the axis first; the worst of its columns counts. Errors are shares of the ``scale`` of each value.
    """
    columns, scales = values.reshape(len(positions), -1), scale.reshape(len(positions), -1)
    errors = np.zeros((len(positions), len(positions)))
    for first, last in itertools.combinations(range(len(positions)), 2):
        if last - first > 1:
            between = slice(first + 1, last)
            share = (positions[between] - positions[first]) / (positions[last] - positions[first])
            line = columns[first] + share[:, None] * (columns[last] - columns[first])
            errors[first, last] = (np.abs(line - columns[between]) / scales[between]).max()
    return errors


def nodes_within(chords: Floats, tolerance: float, kept: Sequence[int] = ()) -> list[int]:
    """Indices of the fewest nodes between which straight lines stay within a tolerance of all values.

    The ends are nodes, and so are ``kept``. Nodes are chosen among the positions of the :func:`chord_errors`: lines
    are as good as these are dense.
    """
    return _walk(chords, tolerance, _ends(len(chords), kept))


def best_nodes(chords: Floats, count: int, kept: Sequence[int] = ()) -> list[int]:
    """Indices of at most ``count`` nodes with the least worst error of straight lines between them.

    The ends are nodes, and so are ``kept``: ``count`` is at least their number.
    """
    ends = _ends(len(chords), kept)
    tolerances = np.unique(chords[np.triu_indices(len(chords), 1)])
    low, high = 0, len(tolerances) - 1
    while low < high:  # the least tolerance that is met
        middle = (low + high) // 2
        if len(_walk(chords, float(tolerances[middle]), ends)) <= count:
            high = middle
        else:
            low = middle + 1
    return _walk(chords, float(tolerances[low]), ends)


def _ends(size: int, kept: Sequence[int]) -> list[int]:
    return sorted({0, size - 1, *kept})


def _walk(chords: Floats, tolerance: float, ends: Sequence[int]) -> list[int]:
    """From each node to the farthest one that a straight line reaches within the tolerance."""
    found = [ends[0]]
    for end in ends[1:]:
        while found[-1] < end:
            here = found[-1]
            reached = np.nonzero(chords[here, here + 1 : end + 1] <= tolerance)[0]
            found.append(here + 1 + int(reached[-1]))
    return found
