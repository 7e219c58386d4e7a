"""Speed and acceleration of a moving log, filtered as far as the noise found in it asks for and no further.

Both sides of the equation of motion pass one low-pass without phase, so that what it takes from the force it takes from
the model as well; the speed and the acceleration themselves are filtered only beyond the frequency at which the
spectrum of the position sinks into its noise.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from scipy import signal

from ballscrew.files.torque_logs.motion import Floats

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
