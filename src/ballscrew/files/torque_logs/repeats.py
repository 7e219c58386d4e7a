"""Rows of a log that repeat earlier ones, as in a file that was appended to itself: they are no further evidence.

Single rows are often alike where a logger has few digits. What repeats is a sequence, so long that chance does not
explain it, of rows that are alike in all columns but the time: a copy may have a clock of its own.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from ballscrew.files.torque_logs.motion import Floats

#: The least number of rows in a repeated sequence that differ from each other.
DISTINCT_ROWS = 10
#: The least number of rows, beyond those of chance, of a repeated sequence that no step back in time begins.
LEAST_ROWS = 50
#: Probability that chance repeats any sequence of a log.
CHANCE = 1e-6


def repeated_rows(columns: Sequence[Floats], time: Floats | None = None) -> NDArray[np.bool_]:
    """The rows within sequences that occurred before, from columns of equal length.

    Two rows are alike with the probability ``c = Σ p²``, so that a sequence of ``ln(rows² / CHANCE) / ln(1 / c)`` rows
    is not repeated by chance. Readings of few digits that follow each other are alike more often than that: a sequence
    also has so many distinct rows as :data:`DISTINCT_ROWS`. A test plan that is measured twice with few digits is no
    repeat: where the clock does not step back at its begin, a sequence has at least :data:`LEAST_ROWS` rows more than
    chance needs, and as many as a tenth of the rows that are no repeats.
    """
    keys = _hashed(np.stack([np.asarray(values, dtype=np.float64) for values in columns], axis=1))
    _, number, counts = np.unique(keys, return_inverse=True, return_counts=True)
    alike = float(np.sum((counts / keys.size) ** 2))
    result = np.zeros(keys.size, dtype=bool)
    if counts.size < DISTINCT_ROWS or counts.max() == 1:
        return result
    length = max(DISTINCT_ROWS, math.ceil(math.log(keys.size**2 / CHANCE) / -math.log(alike)))
    if 2 * length > keys.size:
        return result
    windows = np.zeros(keys.size - length + 1, dtype=np.uint64)
    for place, factor in enumerate(_factors(length)):
        windows += factor * keys[place : place + windows.size]
    _, first, same = np.unique(windows, return_index=True, return_inverse=True)
    earlier = first[same.reshape(-1)]
    begins = np.flatnonzero(earlier + length <= np.arange(windows.size))
    if not begins.size:
        return result
    # windows one after the other, all as far behind what they repeat
    breaks = (np.diff(begins) != 1) | (np.diff(begins - earlier[begins]) != 0)
    sequences = [(part[0], part[-1] + length, part.size) for part in np.split(begins, np.flatnonzero(breaks) + 1)]
    repeated = np.zeros(keys.size, dtype=bool)
    for begin, end, _ in sequences:
        repeated[begin:end] = True
    least = max(LEAST_ROWS, np.count_nonzero(~repeated) / 10)
    for begin, end, size in sequences:
        steps_back = time is not None and begin > 0 and time[begin] < time[begin - 1]
        distinct = np.unique(number.reshape(-1)[begin:end]).size
        if (steps_back or size >= least) and distinct >= DISTINCT_ROWS:
            result[begin:end] = True
    return result


def _hashed(table: Floats) -> NDArray[np.uint64]:
    """A number for each row, the same for rows that are alike."""
    bits = np.ascontiguousarray(table + 0.0).view(np.uint64)  # no negative zeros
    return np.asarray(np.sum((bits ^ (bits >> np.uint64(29))) * _factors(table.shape[1]), axis=1, dtype=np.uint64))


def _factors(count: int) -> NDArray[np.uint64]:
    """Odd random numbers, always the same."""
    return np.random.default_rng(1).integers(0, 2**64, count, dtype=np.uint64) | np.uint64(1)
