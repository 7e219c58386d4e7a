"""The condition of a nut over time: from a series of torques of one axis to preloads, a trend and an alarm."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import AngularSpeed, MomentOfInertia, Temperature
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, standard_normal_share
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.condition_means import Means, Trend, chart, of_logs, of_series, robust_scatter, trend
from ballscrew.evidence.service.condition_records import records_of
from ballscrew.evidence.service.condition_values import Condition, Reduction, State, parts_of, reduced
from ballscrew.evidence.service.posterior import MODEL_ERROR
from ballscrew.evidence.service.preload_change import held_numbers, with_preload
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_series import TorqueSeries
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

#: Tests of the baseline by default, and at least.
BASELINE, LEAST_BASELINE = 5, 3
#: Tests at most: a longer table is a log.
MOST_TESTS = 1000
#: The share of healthy tests that give an alarm, by default: one in 500.
FALSE_ALARMS = 0.002


@renamed_keyword("uncertain", "distributions")
@accepts_units("condition")
def condition(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    tests: Any,
    *,
    screw_speed: AngularSpeed | None = None,
    baseline: int = BASELINE,
    false_alarms: float = FALSE_ALARMS,
    tolerance: float = 0.1,
    reference_temperature: Temperature | None = None,
    distributions: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    kind: Kind = "unknown",
    inertia: MomentOfInertia | None = None,
    seed: int = 0,
) -> Condition:
    """State of a nut in each test of a series: torque at one temperature, preload left, trend, and an alarm.

    Returns a :class:`~ballscrew.evidence.service.condition_values.Condition`. ``model``, ``screw`` and ``lubricant``
    describe the nut as it should be. ``tests`` is a table, as
    :meth:`~ballscrew.files.torque_logs.torque_series.TorqueSeries.of` takes it, of mean friction torques without load,
    or a list of logs of one load, as :meth:`~ballscrew.files.torque_logs.torque_log.TorqueLog.of` takes them, in their
    order. A table without speeds needs the ``screw_speed`` (rad/s). ``kind`` says whether the torque of logs is
    ``"friction"`` or ``"drive"`` torque; ``inertia`` (kg m²) takes the acceleration out of the latter.

    The first tests (``baseline``) are taken as healthy. The model is made to agree with them by a factor and reduces
    every torque to the ``reference_temperature`` (K; by default theirs) and speed. Each torque then asks for a preload.
    The numbers of the model are as uncertain as in :func:`~ballscrew.evidence.service.preload_change.preload_change`
    (``distributions``, ``joint``), the same in all tests, and drawn with the ``seed``. ``tolerance`` is the share of
    the preload that may be lost. The temperature of a test is off by 2 K (95 %) where it is logged and the oil has a
    grade, otherwise by 10 K.

    The alarm is a CUSUM of the reduced torque: beyond the scatter of the series, 2 % for the model (over the root of
    the number of speeds), and the doubts of the temperatures. ``false_alarms`` is the share of healthy tests that
    give one. Where no temperature is logged, the alarm says that the torque changed, and the intervals whether that
    can be the oil.

    Valid for a preloaded nut whose balls are alike. Raises :class:`~ballscrew.basis.errors.InputError` for a nut
    without preload or with elastic bodies, fewer tests than ``baseline`` + 1, shares out of (0, 1), and data that
    cannot be of one nut in one unit.
    """
    subject = with_preload(Configuration(model, screw, lubricant))
    raise_if_any(_faults(baseline, false_alarms, tolerance))
    known = held_numbers(subject, distributions)
    if isinstance(tests, list | tuple):
        raise_if_any(_faults_of_count(len(tests), baseline))
        means = of_logs(subject, tests, kind, inertia)
    else:
        series = TorqueSeries.of(tests)
        raise_if_any(_faults_of_count(len(series), baseline))
        means = of_series(series, screw_speed)
    result = reduced(subject, means, baseline, known, joint, reference_temperature, seed)
    graded = subject.lubricant.follows_temperature
    made = _judged(subject, means, result, baseline, false_alarms, tolerance, graded)
    warnings, verdicts = records_of(made, means, result, subject)
    return dataclasses.replace(made, warning_records=tuple(warnings), verdict_records=tuple(verdicts))


def _faults(baseline: Any, false_alarms: Any, tolerance: Any) -> list[Fault]:
    faults: list[Fault] = []
    if not isinstance(baseline, int) or baseline < LEAST_BASELINE:
        remedy = f"give {LEAST_BASELINE} or more: the scatter is estimated from them; {BASELINE} is usual"
        faults.append(Fault("condition.baseline", "is too short", str(baseline), remedy))
    shares = {"false_alarms": (false_alarms, 1e-4, 0.1), "tolerance": (tolerance, 0.0, 1.0)}
    for name, (value, low, high) in shares.items():
        if not isinstance(value, int | float) or not low < value < high:
            remedy = f"{FALSE_ALARMS} is usual" if name == "false_alarms" else "0.1 is usual"
            faults.append(
                Fault(
                    f"condition.{name}",
                    f"must lie between {units.to_significant(low, 6)} and {units.to_significant(high, 6)}",
                    str(value),
                    remedy,
                )
            )
    return faults


def _faults_of_count(count: int, baseline: int) -> list[Fault]:
    if count > MOST_TESTS:
        remedy = "a table has a row for each test: is this a log? Of logs give several, one for each test"
        return [Fault("condition.tests", f"more than {MOST_TESTS}", str(count), remedy)]
    if count > baseline:
        return []
    remedy = f"give {baseline + 1} or more, or a shorter baseline ({LEAST_BASELINE} or more)"
    return [Fault("condition.tests", f"too few: the baseline alone takes {baseline}", str(count), remedy)]


def _judged(
    subject: Configuration,
    means: Means,
    reduction: Reduction,
    baseline: int,
    false_alarms: float,
    tolerance: float,
    graded: bool,
) -> Condition:
    used = means.logged & graded
    of_temperature = reduction.temperature_deviation(means, graded)
    of_model = MODEL_ERROR / np.sqrt(means.speeds)
    # with no temperature at all, what the weather does to the torque is in its scatter, as far as it shows there
    weather = of_temperature if used.any() else np.zeros(means.count)
    besides = np.sqrt(weather**2 + of_model**2 + reduction.torque_doubt**2)
    scatter = robust_scatter(reduction.torque)
    first = math.sqrt(1 / baseline)
    # of tests without temperatures the first ones may all have been as warm
    shared = np.mean(of_temperature[:baseline]) * (first if used[:baseline].all() else 1.0)
    apart = np.sqrt(of_temperature**2 + shared**2 + (scatter**2 + of_model**2) * (1 + first**2))
    deviation_of_torque = np.sqrt(of_temperature**2 + scatter**2 + reduction.torque_doubt**2)
    deviation = np.hypot(apart / np.abs(reduction.exponent), reduction.preload_doubt)
    states = _states(subject, means, reduction, baseline, deviation_of_torque, deviation, used)
    last = float((math.log(1 - tolerance) - reduction.preload[-1]) / deviation[-1])
    return Condition(
        states=states,
        baseline=baseline,
        false_alarms=false_alarms,
        reference_temperature=reduction.temperature,
        reference_speed=reduction.screw_speed,
        chart=chart(reduction.torque, baseline, besides, false_alarms),
        trend=_trend(means.times, reduction.preload),
        per=means.per,
        scatter=scatter,
        tolerance=tolerance,
        probability_of_loss=standard_normal_share(last) if math.isfinite(last) else math.nan,
        per_kelvin=float(reduction.per_kelvin[-1]),
        exponent=float(reduction.exponent[-1]),
        factor=reduction.factor,
        factor_interval=reduction.factor_interval,
        temperatures=int(np.count_nonzero(used)),
        sources=means.sources,
        notes=means.notes,
    )


def _trend(times: Vector, preload: Vector) -> Trend:
    told = np.isfinite(preload)
    return trend(times[told], preload[told])


def _states(
    subject: Configuration,
    means: Means,
    reduction: Reduction,
    baseline: int,
    of_torque: Vector,
    of_preload: Vector,
    used: Any,
) -> list[State]:
    parts = parts_of(subject, means, reduction, baseline)
    states: list[State] = []
    for i, label in enumerate(means.labels):
        torque, preload = (
            _interval(*pair) for pair in ((reduction.torque[i], of_torque[i]), (reduction.preload[i], of_preload[i]))
        )
        warm = float(np.mean(means.temperature[means.test == i]))
        states.append(
            State(
                label,
                float(means.times[i]),
                warm if used[i] else None,
                torque[1],
                torque[0],
                torque[2],
                preload[1],
                preload[0],
                preload[2],
                parts[i],
            )
        )
    return states


def _interval(logarithm: float, deviation: float) -> tuple[float, float, float]:
    low, middle, high = (math.exp(logarithm + side * NORMAL_95 * deviation) for side in (-1, 0, 1))
    return low, middle, high
