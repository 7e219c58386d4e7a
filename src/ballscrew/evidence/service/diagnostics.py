"""Diagnostics of a service: records of what its preloads do not show.

The value of a preload that was found: with its interval, where that comes from, and the rows behind it.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import spoken
from ballscrew.basis.quantities import Force, Quantity
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.diagnostics import HIGHEST_PRELOAD
from ballscrew.evidence.calibration.fit import points_of
from ballscrew.evidence.calibration.fit_result import Rows
from ballscrew.evidence.calibration.identifiability import long_run_covariance
from ballscrew.evidence.calibration.response import torque_of_model, uses_temperatures
from ballscrew.evidence.calibration.robust import MINIMUM_ROWS, Vector, autocorrelation_lag
from ballscrew.evidence.service.posterior import FRICTION, MINIMUM_SAMPLES, MODEL_ERROR, MODEL_PARTS, PRELOAD, Posterior
from ballscrew.physics.friction.validity import STARVED


class Mixture(NamedTuple):
    """A number as a mixture of normal ones: weights that sum to 1, means, variances. NaN where it is not told."""

    weights: Vector
    mean: Vector
    variance: Vector

    @classmethod
    def of(cls, mean: float, deviation: float) -> Mixture:
        """A normal number."""
        return cls(np.ones(1), np.array([mean]), np.array([deviation**2]))

    @property
    def told(self) -> bool:
        """True where it has a distribution."""
        return bool(np.isfinite(self.variance).all() and np.isfinite(self.weights).all())

    @property
    def total_variance(self) -> float:
        """The variance of the number."""
        middle = float(self.weights @ self.mean)
        return float(self.weights @ (self.variance + (self.mean - middle) ** 2))

    def less(self, other: Mixture) -> Mixture:
        """The difference to another number: of the same samples, or of its own."""
        if other.weights.size == 1:
            return Mixture(self.weights, self.mean - other.mean[0], self.variance + other.variance[0])
        return Mixture(self.weights, self.mean - other.mean, self.variance + other.variance)

    def share_below(self, value: float) -> float:
        """Probability that it is less than a value."""
        from scipy.special import ndtr  # slow to import: for those only who fit

        if not self.told:
            return math.nan
        deviation = np.sqrt(np.maximum(self.variance, 1e-24))
        return float(self.weights @ ndtr((value - self.mean) / deviation))

    def quantile(self, share: float) -> float:
        """The value below which it lies with a probability; without a distribution the mean for the median, or NaN."""
        from scipy.optimize import brentq

        if not self.told:
            return float(np.median(self.mean)) if share == 0.5 else math.nan
        reach = 10 * np.sqrt(np.maximum(self.variance, 1e-24))
        counted = self.weights > 0
        low, high = float(np.min((self.mean - reach)[counted])), float(np.max((self.mean + reach)[counted]))

        def off(value: float) -> float:
            return self.share_below(value) - share

        result: Any = brentq(off, low, high, xtol=1e-9)
        return float(result)

    def interval(self, level: float) -> tuple[float, float]:
        """The interval of the number whose logarithm this is, with equal shares beyond its ends."""
        low, high = (self.quantile(0.5 + side * level / 2) for side in (-1, 1))
        return math.exp(low), math.exp(high)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PreloadEstimate:
    """A preload with its distribution."""

    #: The logarithm of the preload in N.
    logarithm: Mixture
    #: By unknown, the share of the variance of the logarithm that goes along with it.
    shares: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: The screw with the numbers that are the most probable, and how much warmer its oil is than logged, K.
    subject: Configuration | None = None
    warmer: float = 0.0
    #: The fit of the preload alone; None for a preload that is not from a log.
    fit: CalibratedModel | None = None
    #: Root mean square of the residuals, N m, outliers left out.
    residual_rms: float = math.nan
    #: Mean temperature of the log, K.
    temperature: float | None = None
    #: Rows whose load takes the preload off one side: they tell nothing of it.
    rows_beyond_lift_off: int = 0

    @property
    def preload(self) -> Force:
        """The preload, N: the median."""
        return math.exp(self.logarithm.quantile(0.5))

    def interval(self, level: float = 0.95) -> tuple[float, float]:
        """The interval of the preload, N; NaN where the log does not tell it."""
        return self.logarithm.interval(level)


#: A trend is said if chance makes one so clear in no more than this share of the tests in which there is none.
CHANCE = 0.01
#: Temperatures that differ by less than what a sensor is off by tell nothing, K.
LEAST_RANGE = LOGGED_TEMPERATURE
#: Half of the values beyond the interval of 95 %.
_LEVEL = 0.95


class TemperatureTrend(NamedTuple):
    """The slope of the logarithm of torques by their temperature, 1/K, with its 95 % interval."""

    slope: float
    low: float
    high: float
    #: Probability of a slope as clear as this without a trend.
    chance: float
    #: Between the coldest and the warmest torque, K.
    temperature_range: float

    @property
    def told(self) -> bool:
        """True where it is clear, by :data:`CHANCE`."""
        return self.chance < CHANCE

    def text(self, per_kelvin: float) -> str:
        """The trend and what it says of a model whose torque has this derivative of its logarithm, 1/K."""
        rises, over = self.slope > 0, self.slope * per_kelvin < 0
        low, high = (units.fixed(end, 2) for end in sorted(abs(100 * end) for end in (self.low, self.high)))
        verb = "rises" if rises else "falls"
        model = "over-corrects, it accounts for too much" if over else "under-corrects, it accounts for too little"
        return (
            f"still {verb} by {units.percent(abs(self.slope), 2)} a kelvin ({low} to {high} %, 95 %): "
            f"the model {model} of the temperature"
        )


def temperature_trend(logarithms: Vector, temperature: Vector, others: Vector | None = None) -> TemperatureTrend | None:
    """The trend of logarithms of torques by least squares, ``others`` (columns) accounted for; None where none is told.

    Values that follow each other may be alike: the error is the larger of that of independent ones and of that with
    the products of neighbours (NeweyWest1987).
    """
    from scipy.special import stdtr, stdtrit  # slow to import: for those only who have logs

    width = float(np.ptp(temperature)) if temperature.size else 0.0
    if width < LEAST_RANGE:
        return None
    columns = [np.ones(temperature.size), temperature - temperature.mean()]
    if others is not None:
        columns += [each - each.mean() for each in others.T if np.ptp(each) > 0]
    x = np.stack(columns, axis=1)
    x = x / np.linalg.norm(x, axis=0)
    freedom = temperature.size - x.shape[1]
    if freedom < 1 or np.linalg.matrix_rank(x) < x.shape[1]:
        return None
    inverse = np.linalg.inv(x.T @ x)
    result = inverse @ (x.T @ logarithms)
    off = logarithms - x @ result
    even = float(off @ off) / freedom * inverse
    along = inverse @ long_run_covariance(x * off[:, np.newaxis], autocorrelation_lag(off)) @ inverse
    scale = float(np.linalg.norm(temperature - temperature.mean()))
    slope, error = float(result[1]) / scale, float(np.sqrt(max(even[1, 1], along[1, 1]))) / scale
    half = float(stdtrit(freedom, 0.5 + _LEVEL / 2)) * error
    chance = 2 * float(stdtr(freedom, -abs(slope) / error)) if error > 0 else float(slope == 0)
    return TemperatureTrend(slope, slope - half, slope + half, chance, width)


#: A difference between the temperatures of two logs that is said, K.
TEMPERATURE_DIFFERENCE = 5.0
_NO_TEMPERATURE = (
    "no temperature: it is found from how the torque goes with the speed, 10 K either way; log the temperature "
    "of the nut"
)
_TEMPERATURE_UNUSED = (
    "its temperatures are not used, as the oil has a viscosity and no sheet or grade that changes with it: give "
    "[lubricant] a data sheet or a grade"
)
_BY_GRADE = "the oil's grade accounts for it"
_WITHOUT_GRADE = "give [lubricant] a grade to account for it"
_ONE_DIRECTION = "one direction only: a zero error of the sensor counts as friction; measure in both"
#: A misfit of a log that is seldom chance, and a number so many standard deviations from what is known of it, are said.
MISFIT_SHARE, LARGEST_SCORE = 1e-3, 2.0
#: Warnings of the fit of the preload alone that hold whatever the other numbers are.
_SAID = {
    STARVED,
    "fit.scatter",
    "fit.outliers",
    "fit.not_converged",
    "fit.at_bound",
    "fit.one_sided",
    "fit.not_identified",
}


def warning_records(
    new: PreloadEstimate,
    worn: PreloadEstimate,
    subject: Configuration,
    dynamic_load_rating: Force | None,
    posterior: Posterior,
) -> list[Record]:
    """Reasons not to trust the preloads, the gravest first."""
    logs = {label: one for label, one in (("new", new), ("worn", worn)) if one.fit is not None}
    return [
        *(record for label, one in logs.items() for record in _of_fit(label, one)),
        *_of_numbers(posterior, list(logs)),
        *_of_ratings({"new": new, "worn": worn}, subject, dynamic_load_rating),
        *(record for label, one in logs.items() for record in _of_lift_off(label, one)),
        *_of_temperatures(logs, subject),
        *(record for label, one in logs.items() for record in _of_trend(label, one)),
        *(record for label, one in logs.items() for record in _of_directions(label, one)),
    ]


def _record(name: str, subject: str, text: str, **more: Any) -> Record:
    fields: dict[str, Any] = {"severity": "warning", "holds": False, **more}
    return Record(f"service.{name}", subject, text, **fields)


def _log_record(name: str, label: str, subject: str, text: str, **more: Any) -> Record:
    """A record of what is said of one of the logs."""
    return _record(name, f"{label}.{subject}", f"{label} log: {text}", **more)


def _rows(one: PreloadEstimate) -> Rows:
    assert one.fit is not None
    return one.fit.rows


def _of_fit(label: str, one: PreloadEstimate) -> list[Record]:
    assert one.fit is not None
    said = [record for record in one.fit.warning_records if record.id in _SAID]
    return [
        dataclasses.replace(record, subject=f"{label}.{record.subject}", text=f"{label} log: {record.text}")
        for record in said
    ]


def _of_numbers(posterior: Posterior, labels: list[str]) -> list[Record]:
    from scipy.special import chdtri  # slow to import: for those only who fit

    records: list[Record] = []
    if not posterior.effective_samples >= MINIMUM_SAMPLES:
        text = "hardly any numbers that are known for such a screw explain the logs: no preload is told"
        records.append(
            _record("not_sampled", "preload", text, value=posterior.effective_samples, limit=float(MINIMUM_SAMPLES))
        )
    limit = float(chdtri(MODEL_PARTS, MISFIT_SHARE))
    for label, one in zip(labels, posterior.preloads, strict=True):
        misfit = float(one.misfit[posterior.best])
        if misfit > limit:
            message = (
                "with no preload does the model follow the torques, by more than the "
                f"{units.percent(MODEL_ERROR)} that it is taken to be off: is this the screw, and is the kind of "
                "torque right?"
            )
            records.append(_log_record("misfit", label, "torque", message, value=misfit, limit=limit))
    for name, score in posterior.mean_scores().items():
        if abs(score) > LARGEST_SCORE:
            message = (
                f"the logs ask for a {spoken(name)} {units.fixed(abs(score), 1)} standard deviations "
                f"{'above' if score > 0 else 'below'} what is known of it: is this the screw, or does the model miss "
                "something?"
            )
            records.append(_record("beyond_known", name, message, value=score, limit=LARGEST_SCORE))
    return records


def _of_ratings(
    both: dict[str, PreloadEstimate], subject: Configuration, dynamic_load_rating: Force | None
) -> list[Record]:
    if dynamic_load_rating is None:
        return []
    quantity: Quantity = subject.inputs[PRELOAD][1]
    limit = HIGHEST_PRELOAD * float(dynamic_load_rating)
    records: list[Record] = []
    for label, one in both.items():
        if one.preload <= limit:
            continue
        percent = units.number(100 * HIGHEST_PRELOAD)
        message = (
            f"{label} preload {units.shown(one.preload, quantity)} is more than {percent}% of the dynamic load "
            f"rating, {units.shown(limit, quantity)}: it costs life; look at the nut and the units of the log"
        )
        records.append(
            _record("preload_above_rating", f"{label}.preload", message, value=one.preload, limit=limit, unit="N")
        )
    return records


def _of_lift_off(label: str, one: PreloadEstimate) -> list[Record]:
    beyond, rows = one.rows_beyond_lift_off, len(_rows(one).log)
    if not beyond:
        return []
    message = (
        f"the load takes the preload off one side in {units.fixed(beyond)} of {units.fixed(rows)} rows, which "
        f"tell nothing of it: {units.fixed(rows - beyond)} rows do"
    )
    return [_log_record("lift_off", label, "axial_load", message, value=float(beyond), limit=0.0)]


def _of_temperatures(logs: dict[str, PreloadEstimate], subject: Configuration) -> list[Record]:
    graded = subject.lubricant.follows_temperature
    records: list[Record] = []
    known = {label: one.temperature for label, one in logs.items() if one.temperature is not None}
    for label in logs:
        if label not in known:
            records.append(_log_record("no_temperature", label, "temperature", _NO_TEMPERATURE))
        elif not graded:
            records.append(_log_record("temperature_unused", label, "temperature", _TEMPERATURE_UNUSED))
    if len(known) == 2:
        warmer = known["worn"] - known["new"]
        if abs(warmer) > TEMPERATURE_DIFFERENCE:
            message = (
                f"the worn log is {units.fixed(abs(warmer))} K {'hotter' if warmer > 0 else 'colder'} than the new "
                f"one: {_BY_GRADE if graded else _WITHOUT_GRADE}"
            )
            severity = "info" if graded else "warning"
            records.append(
                _record(
                    "temperatures_differ",
                    "temperature",
                    message,
                    severity=severity,
                    value=warmer,
                    limit=TEMPERATURE_DIFFERENCE,
                    unit="K",
                )
            )
    return records


def _of_trend(label: str, one: PreloadEstimate) -> list[Record]:
    """A trend of torques over those of the model with the temperature, loads and speeds accounted for."""
    rows, subject = _rows(one), one.subject
    log = rows.log
    if subject is None or not uses_temperatures(subject.lubricant, log):
        return []
    points = points_of(log, subject.lubricant, rows.convention)
    model = torque_of_model(subject, points, FRICTION, one.warmer)
    measured = rows.friction - rows.residuals * rows.direction
    with np.errstate(invalid="ignore", divide="ignore"):
        off = np.log(measured / model)
    kept = np.isfinite(off) & ~rows.outlying
    if np.count_nonzero(kept) < MINIMUM_ROWS:
        return []
    others = np.stack([np.log(points["screw_speed"]), np.abs(points["axial_load"])], axis=1)
    trend = temperature_trend(off[kept], np.asarray(log.temperature)[kept], others[kept])
    if trend is None or not trend.told or abs(trend.slope) * trend.temperature_range < MODEL_ERROR:
        return []
    warmer = torque_of_model(subject, points, FRICTION, one.warmer + 1.0)
    per_kelvin = float(np.mean(np.log(warmer / model)))
    message = (
        f"the torque over that of the model {trend.text(per_kelvin)}; a preload by "
        "logs of other temperatures is off by as much: compare logs of one temperature"
    )
    fields = {"value": trend.slope, "limit": 0.0, "unit": "1/K"}
    return [_log_record("temperature_trend", label, "temperature", message, **fields)]


def _of_directions(label: str, one: PreloadEstimate) -> list[Record]:
    log = _rows(one).log
    if np.any(log.forward) and np.any(log.backward):
        return []
    return [_log_record("one_direction", label, "screw_speed", _ONE_DIRECTION)]
