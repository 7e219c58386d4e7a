"""Least squares whose residuals follow each other: covariance, blocks, and resampling of blocks.

Filtered rows are far from independent, and what a model misses at one speed it misses at every pass. Ordinary standard
errors are then far too small. Two remedies, which share the length of a block:

* the covariance of NeweyWest1987, with Student's distribution on the number of blocks less that of parameters;
* the moving-block bootstrap of Kunsch1989: blocks of rows that follow each other are drawn with replacement.
"""

from __future__ import annotations

import dataclasses
import functools

import numpy as np
from numpy.typing import NDArray
from scipy.special import stdtrit

from ballscrew.files.torque_logs.motion import Floats

#: A log has so many blocks at least, whatever the autocorrelation: fewer give no error at all.
FEWEST_BLOCKS = 8
#: The block is so many times the lag at which the autocorrelation is first below its own noise.
BLOCK_FACTOR = 2
#: A number is identified if its standard error is at most this share of the change of it that matters.
LARGEST_ERROR = 0.5
#: Singular values below this share of the largest are rounding.
ROUNDING = 1e-9


def block_length(residuals: Floats) -> int:
    """Rows of a block: twice the lag at which the autocorrelation first falls below two standard errors of none."""
    rows = residuals.size
    longest = max(1, rows // FEWEST_BLOCKS)
    centred = residuals - residuals.mean()
    size = 1 << (2 * rows - 1).bit_length()
    power = np.abs(np.fft.rfft(centred, size)) ** 2
    correlation = np.fft.irfft(power, size)[: longest + 1]
    if correlation[0] <= 0:
        return 1
    below = np.flatnonzero(correlation < 2 / np.sqrt(rows) * correlation[0])
    return int(min(longest, BLOCK_FACTOR * int(below[0]) if below.size else longest))


@dataclasses.dataclass(frozen=True, eq=False)
class LeastSquares:
    """A solution of least squares: values, residuals (model − measured), derivatives, rows of a block."""

    values: Floats
    residuals: Floats
    slopes: Floats
    block: int

    @classmethod
    def of(cls, columns: Floats, measured: Floats) -> LeastSquares:
        """The linear problem; a direction that the rows do not tell gets the smallest values."""
        scale = np.maximum(np.linalg.norm(columns, axis=0), np.finfo(float).tiny)
        values = np.linalg.lstsq(columns / scale, measured, rcond=ROUNDING)[0] / scale
        residuals = columns @ values - measured
        return cls(values, residuals, columns, block_length(residuals))

    @property
    def blocks(self) -> float:
        """The number of blocks."""
        return self.residuals.size / self.block

    def few_blocks(self, parameters: int) -> float:
        """The factor by which an interval of 95 % is wider than that of many blocks."""
        freedom = max(self.blocks - parameters, 1.0)
        many = float(stdtrit(np.inf, 0.975))
        return float(stdtrit(freedom, 0.975)) / many * float(np.sqrt(self.blocks / freedom))

    @functools.cached_property
    def covariance(self) -> Floats:
        """``(XᵀX)⁻¹ S (XᵀX)⁻¹`` with the long-run covariance S of the scores (NeweyWest1987, Bartlett's weights)."""
        scale = np.maximum(np.linalg.norm(self.slopes, axis=0), np.finfo(float).tiny)
        slopes = self.slopes / scale
        inverse = np.linalg.pinv(slopes.T @ slopes, rcond=ROUNDING)
        scores = self.residuals[:, np.newaxis] * slopes
        # Bartlett's weights are the sums over all blocks of this length, each squared
        padded = np.pad(np.cumsum(scores, axis=0), ((1, 0), (0, 0)))
        block, rows = self.block, scores.shape[0]
        begins = np.arange(1 - block, rows)
        sums = padded[np.minimum(begins + block, rows)] - padded[np.maximum(begins, 0)]
        spread = sums.T @ sums / block
        freedom = max(self.blocks - self.values.size, 1.0)
        return inverse @ spread @ inverse / np.outer(scale, scale) * (self.blocks / freedom)

    @property
    def errors(self) -> Floats:
        """Standard errors of the values."""
        return np.sqrt(np.maximum(np.diag(self.covariance), 0.0))

    def half_width(self, level: float = 0.95) -> Floats:
        """Half the interval of each value, by Student's distribution on the number of blocks."""
        freedom = max(self.blocks - self.values.size, 1.0)
        return float(stdtrit(freedom, 0.5 + level / 2)) * self.errors


def bootstrap_sums(products: Floats, block: int, replicates: int, seed: int = 0) -> Floats:
    """Sums of rows over resampled blocks, of shape (replicates, ...); ``products`` has the rows along its first axis.

    Blocks may begin at any row; each replicate has as many rows as the log, to within a block.
    """
    rows = products.shape[0]
    random = np.random.default_rng(seed)
    padded = np.concatenate([np.zeros((1, *products.shape[1:])), np.cumsum(products, axis=0)])
    sums = padded[block:] - padded[:-block]
    starts: NDArray[np.int64] = random.integers(0, sums.shape[0], size=(replicates, max(1, round(rows / block))))
    counts = np.zeros((replicates, sums.shape[0]))
    for replicate, drawn in enumerate(starts):
        np.add.at(counts[replicate], drawn, 1.0)
    flat = counts @ sums.reshape(sums.shape[0], -1)
    return flat.reshape(replicates, *products.shape[1:])


def relative_error(residuals: Floats, measured: Floats) -> float:
    """Root mean square of the residuals over that of the measured values."""
    size = float(np.linalg.norm(measured))
    return float(np.linalg.norm(residuals)) / size if size > 0 else np.nan
