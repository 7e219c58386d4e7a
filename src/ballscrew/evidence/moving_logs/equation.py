r"""The equation of motion of an axis at the rows of a log, both sides through one low-pass.

.. math:: F = M a + F_g + \operatorname{sign}(v) \cdot F_f(|v|, \dots)

Least squares whose residuals follow each other: covariance, blocks, and resampling of blocks.

Filtered rows are far from independent, and what a model misses at one speed it misses at every pass. Ordinary standard
errors are then far too small. Two remedies, which share the length of a block:

* the covariance of NeweyWest1987, with Student's distribution on the number of blocks less that of parameters;
* the moving-block bootstrap of Kunsch1989: blocks of rows that follow each other are drawn with replacement.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray
from scipy import signal
from scipy.special import stdtrit

from ballscrew.evidence.moving_logs.moving_log import REST, MovingLog
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


#: Order of the Butterworth filters; run forwards and backwards, they attenuate as twice the order.
ORDER = 4
#: The position tells more than noise where its spectrum is so many times the noise.
ABOVE_NOISE = 4.0
#: The force is explained by the motion where the spectrum of the explained part is so many times that of the rest.
EXPLAINED = 10.0
#: Share of the power of the force that the filter of both sides keeps at least.
KEPT_POWER = 0.95
#: No filter is narrower in frequency than this share of the sampling rate, none wider than that.
NARROWEST, WIDEST = 1e-3, 0.4
#: Rows of a segment of a spectrum at most, and the number of segments at least.
_SEGMENT, _SEGMENTS = 2048, 8
#: Frequencies beside each other over which a spectrum is averaged.
_SMOOTHED = 5
#: Rows left out at either end: so many periods of the cutoff of the filter of both sides.
EDGE_PERIODS = 1.0
#: Five-point central differences: weights of the rows two and one away for the speed, and of all for the acceleration.
_FIRST, _SECOND = (-1 / 12, 8 / 12), (-1 / 12, 16 / 12, -30 / 12)


@dataclasses.dataclass(frozen=True, eq=False)
class Kinematics:
    """Speed and acceleration at the rows of a log, and the noise of the position (or speed) they were found from."""

    speed: Floats
    acceleration: Floats
    #: Cutoff of the filter of the position, Hz.
    cutoff: float
    #: Standard deviation of the noise of one position (m), or of one speed (m/s) where there is no position.
    noise: float
    #: Standard deviation of the noise that is left in the speed, m/s.
    speed_noise: float


def low_pass(values: Floats, cutoff: float, step: float) -> Floats:
    """Values without what lies above a frequency (Hz), without delay: Butterworth, forwards and backwards.

    Arrays of several columns are filtered along the first axis. A cutoff at or beyond :data:`WIDEST` filters nothing.
    """
    if cutoff >= WIDEST / step:
        return values
    sections = signal.butter(ORDER, cutoff * 2 * step, output="sos")
    padded = min(values.shape[0] - 1, int(3 / (cutoff * step)))
    return np.asarray(signal.sosfiltfilt(sections, values, axis=0, padlen=padded), dtype=np.float64)


def spectrum(values: Floats, step: float) -> tuple[Floats, Floats]:
    """Frequencies (Hz) and one-sided power spectral density by Welch's method."""
    segment = max(16, min(_SEGMENT, values.size // _SEGMENTS))
    frequency, density = signal.welch(values, 1 / step, nperseg=segment)
    return frequency[1:], np.asarray(density[1:], dtype=np.float64)


def noise_cutoff(path: Floats, step: float) -> tuple[float, float]:
    """The frequency (Hz) at which a path sinks into its noise, and the standard deviation of that noise.

    The noise is white: its density is the median over the upper half of all frequencies. Second differences are
    transformed, and divided by their gain (2 sin πfΔt)⁴, because a path that wanders has no spectrum of its own.
    """
    frequency, density = spectrum(np.diff(path, 2), step)
    density = density / (2 * np.sin(np.pi * frequency * step)) ** 4
    nyquist = 0.5 / step
    floor = float(np.median(density[frequency > nyquist / 2]))
    smooth = np.convolve(density, np.ones(_SMOOTHED) / _SMOOTHED, mode="same")
    sunk = np.flatnonzero(smooth < ABOVE_NOISE * floor)
    cutoff = float(frequency[sunk[0]]) if sunk.size else nyquist
    return float(np.clip(cutoff, NARROWEST / step, WIDEST / step)), float(np.sqrt(floor * nyquist))


def kinematics(path: Floats, step: float, *, is_speed: bool = False, cutoff: float | None = None) -> Kinematics:
    """Speed and acceleration from a position, or from a speed; ``cutoff`` (Hz) in place of the one the noise asks for.

    Five-point central differences follow the slope of a wave of f Δt = 0.05 to 3·10⁻⁴ of its size.
    """
    result, noise = noise_cutoff(path, step)
    result = result if cutoff is None else float(np.clip(cutoff, NARROWEST / step, WIDEST / step))
    smooth = low_pass(path, result, step)
    first, second = _differences(smooth, step)
    speed, acceleration = (smooth, first) if is_speed else (first, second)
    # density of white noise times the square of the gain of a derivative, integrated up to the cutoff
    share = 2 * step * result
    gain = 1.0 if is_speed else (2 * np.pi * result) ** 2 / 3
    return Kinematics(speed, acceleration, result, noise, float(noise * np.sqrt(share * gain)))


def _differences(values: Floats, step: float) -> tuple[Floats, Floats]:
    """First and second derivative; at the two rows of either end that of the row beside them."""
    two, one = _FIRST
    far, near, here = _SECOND
    first = (two * (values[4:] - values[:-4]) + one * (values[3:-1] - values[1:-3])) / step
    second = (far * (values[4:] + values[:-4]) + near * (values[3:-1] + values[1:-3]) + here * values[2:-2]) / step**2
    return np.pad(first, 2, mode="edge"), np.pad(second, 2, mode="edge")


def band_of_force(explained: Floats, rest: Floats, step: float) -> float:
    """The frequency (Hz) up to which the motion explains the force, at least that which keeps most of its power."""
    frequency, signal_density = spectrum(explained, step)
    _, rest_density = spectrum(rest, step)
    ones = np.ones(_SMOOTHED) / _SMOOTHED
    ratio = np.convolve(signal_density, ones, mode="same") / np.maximum(
        np.convolve(rest_density, ones, mode="same"), np.finfo(float).tiny
    )
    lost = np.flatnonzero(ratio < EXPLAINED)
    cutoff = float(frequency[lost[0]]) if lost.size else WIDEST / step
    power = np.cumsum(signal_density) / np.sum(signal_density)
    least = float(frequency[min(int(np.searchsorted(power, KEPT_POWER)), frequency.size - 1)])
    return float(np.clip(max(cutoff, least), NARROWEST / step, WIDEST / step))


#: A speed is rest if it is not so many times its noise.
CLEAR = 6.0
#: A row counts if so much of what the low-pass takes in is motion: friction at rest is no number.
_MOVING = 0.9
#: Rows of the filtered sides are thinned to so many for each period of the cutoff.
ROWS_PER_PERIOD = 5.0
#: A dead time is corrected if it is at least one step of time, its interval included; so often it is found anew.
_ROUNDS = 3
#: No dead time is known better than this share of a step of time, within which nobody says when a sample was taken.
_OF_A_STEP = 0.1


#: Reasons for leaving rows out.
FAULTY, AT_REST = "outside the longest stretch without a fault", "at rest or too slow"
AT_ENDS, THINNED = (
    "at the ends, where the filters have no neighbours",
    "thinned to one in {}: filtered, they tell no more",
)


@dataclasses.dataclass(frozen=True, eq=False)
class Equation:
    """Both sides of the equation of motion: the force, and what the models make their side from."""

    log: MovingLog
    kinematics: Kinematics
    #: Cutoff of the low-pass of both sides, Hz.
    cutoff: float
    #: Delay of the motion behind the force that was taken off, s.
    shift: float
    #: The rows that the fit uses: those that move, thinned.
    used: NDArray[np.int64]
    #: The filtered force at these rows.
    force: Floats
    #: Speeds at or below this are rest, m/s.
    rest: float
    #: Rows of the log that are not used, by reason; with those used, all that were read.
    left_out: Mapping[str, int] = dataclasses.field(default_factory=dict[str, int])

    @classmethod
    def of(
        cls,
        log: MovingLog,
        *,
        cutoff: float | None = None,
        path_cutoff: float | None = None,
        shift: float = 0.0,
        slowest: float = 0.0,
    ) -> Equation:
        """The equation of a checked log.

        ``cutoff`` (of both sides) and ``path_cutoff`` (of the position), in Hz, stand in place of what the noise asks
        for; rows slower than ``slowest`` (m/s) are left out; ``shift`` (s) is how long the motion follows the force.
        """
        path = log.columns[log.path_column]
        motion = kinematics(path, log.step, is_speed=log.position is None, cutoff=path_cutoff)
        rest = max(CLEAR * motion.speed_noise, REST * float(np.max(np.abs(motion.speed))))
        if cutoff is None:
            columns = _linear_columns(motion)
            values = np.linalg.lstsq(columns, log.force, rcond=None)[0]
            explained = columns @ values
            cutoff = band_of_force(explained, log.force - explained, log.step)
        # never beyond what is left of the position, nor so low that the log is one period
        cutoff = float(np.clip(cutoff, min(2.0 / (log.time[-1] - log.time[0]), motion.cutoff), motion.cutoff))
        moving = low_pass((np.abs(motion.speed) > max(rest, slowest)).astype(float), cutoff, log.step) > _MOVING
        turning = np.count_nonzero(moving)
        edge = min(int(EDGE_PERIODS / (cutoff * log.step)), len(log) // 10)
        moving[:edge] = moving[len(log) - edge :] = False
        stride = max(1, int(1 / (ROWS_PER_PERIOD * cutoff * log.step)))
        inside = np.flatnonzero(moving)
        used = inside[inside % stride == 0]
        counts = {
            FAULTY: log.rows - len(log),
            AT_REST: len(log) - int(turning),
            AT_ENDS: int(turning) - inside.size,
            THINNED.format(stride): inside.size - used.size,
        }
        left_out = {reason: count for reason, count in counts.items() if count > 0}
        made = cls(log, motion, cutoff, shift, used, np.empty(0), rest, left_out)
        force = np.interp(log.time - shift, log.time, log.force) if shift else log.force
        return dataclasses.replace(made, force=made.filtered(force))

    def filtered(self, values: Floats) -> Floats:
        """Values at every row of the log through the low-pass of both sides, at the rows that are used."""
        return low_pass(values, self.cutoff, self.log.step)[self.used]

    @property
    def speed(self) -> Floats:
        """Speed at every row of the log, m/s."""
        return self.kinematics.speed

    @property
    def acceleration(self) -> Floats:
        """Acceleration at every row of the log, m/s²."""
        return self.kinematics.acceleration

    @property
    def direction(self) -> Floats:
        """Sign of the speed at every row of the log, zero at rest."""
        return np.where(
            np.abs(self.speed) > min(self.rest, CLEAR * self.kinematics.speed_noise), np.sign(self.speed), 0.0
        )

    @property
    def duration(self) -> float:
        """Time that the rows used stand for, s."""
        stride = int(np.min(np.diff(self.used))) if self.used.size > 1 else 1
        return self.used.size * stride * self.log.step

    @property
    def periods(self) -> float:
        """Periods of the cutoff in that time."""
        return self.duration * self.cutoff


def _linear_columns(motion: Kinematics) -> Floats:
    speed = motion.speed
    return np.stack([motion.acceleration, np.ones(speed.size), np.sign(speed), speed], axis=1)


@dataclasses.dataclass(frozen=True)
class DeadTime:
    """Delay of the motion behind the force, s, with half its interval; ``corrected`` where it is taken off."""

    value: float
    half_width: float
    corrected: bool


def dead_time(equation: Equation) -> tuple[DeadTime, Equation]:
    """The dead time of a log, and its equation with it taken off if it is a step of time or more.

    The force is followed by what it does: F(t) = f(t + τ) ≈ f + τ f′ with f the right-hand side. A dead time below one
    step of time is within the way that samples are taken, and stays.
    """
    total, result = equation.shift, np.zeros(2)
    for _ in range(_ROUNDS):
        columns = _linear_columns(equation.kinematics)
        sides = equation.filtered(columns)
        values = np.linalg.lstsq(sides, equation.force, rcond=None)[0]
        slope = equation.filtered(
            np.gradient(low_pass(columns @ values, equation.kinematics.cutoff, equation.log.step))
        )
        solved = LeastSquares.of(np.column_stack([sides, slope / equation.log.step]), equation.force)
        result = np.array([solved.values[-1], solved.half_width()[-1]])
        step = equation.log.step
        if abs(result[0]) - result[1] < step or abs(total + result[0]) > equation.log.step * len(equation.log) / 20:
            break
        total += float(result[0])
        equation = Equation.of(
            equation.log, cutoff=equation.cutoff, path_cutoff=equation.kinematics.cutoff, shift=total
        )
    corrected = equation.shift != 0
    value = equation.shift + float(result[0])
    return DeadTime(value, max(float(result[1]), _OF_A_STEP * equation.log.step), corrected), equation
