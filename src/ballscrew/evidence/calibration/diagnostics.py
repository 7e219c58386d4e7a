"""Diagnostics of a calibration: records of what its estimates do not show.

Plausible ranges of fitted numbers: a fit finds the numbers that follow a log, and not whether a screw can have them.

A log of another nut, a wrong unit or an effect that the model lacks ends in numbers that no screw has. A boundary
friction coefficient lies within :data:`BOUNDARY_FRICTION`, a constant torque drives no screw beyond chance and is not
more than :data:`MOST_CONSTANT` of the friction measured, the median of all rows, a preload is at most
:data:`HIGHEST_PRELOAD` of the dynamic load rating, and all other numbers lie in the usual range of their input
(:class:`~ballscrew.basis.quantities.Info`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import spoken
from ballscrew.basis.quantities import Force
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.evidence.calibration.fit_result import (
    AS_GIVEN,
    CALIBRATED,
    Estimate,
    FitResult,
)
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.robust import autocorrelation_lag, minimum_scatter
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction.loaded_balls import loads_of

_OF_LOG = "so in the row that starves the most, by the numbers of the fit"
FIFTHS = ("lowest", "lower", "middle", "higher", "highest")
#: What each row of a log has of its own.
_OF_ROWS = (*OPERATION, TEMPERATURE.name)
#: A share of outliers beyond which they are no longer a few.
MANY_OUTLIERS = 0.1
#: Residuals depend on something if their means over its parts differ by this much of what was measured.
TREND_SHARE, TREND_ERRORS = 0.02, 4.0
#: A prior that leaves more than this share of its variance has influenced the estimate.
PRIOR_SHARE = 0.05
#: Noise that is more than this share of the torque is no noise.
MAXIMUM_NOISE_SHARE = 0.3
#: A description without physics that is off by less than this share of the model says that the model is another screw.
BASELINE_RATIO = 0.5
#: Friction that is other by more than this share under the opposite load asks for the sign of the load; rows that are
#: looked at for it.
LOAD_SIGN_SHARE, SOME_ROWS = 0.01, 200
#: A larger ratio of residuals is not stated: what is nearer then follows the log to its rounding.
MAXIMUM_RATIO = 100.0


def warning_records(fit_result: FitResult) -> list[Record]:
    """Reasons not to trust the estimates, the gravest first."""
    judged = {record.subject.rpartition(".")[2] for record in fit_result.verdict_records}
    odd = [one for one in fit_result.subject.implausible({}) if one.subject.rpartition(".")[2] not in judged]
    return [
        *odd,
        *_starved(fit_result),
        *_not_identified(fit_result),
        *_of_bounds(fit_result),
        *_of_priors(fit_result),
        *_of_preload(fit_result),
        *_of_rows(fit_result),
        *_trends(fit_result),
    ]


def _starved(fit_result: FitResult) -> list[Record]:
    """Rows of the log at which the fitted model is starved of oil: a full bath would have asked for other numbers."""
    rows = {name: values for name, values in fit_result.response.points.items() if name in _OF_ROWS}
    return fit_result.subject.starvation(rows, _OF_LOG)


def product_of_powers(powers: Mapping[str, float]) -> str:
    """A product of powers, the largest first: ``boundary_friction_coefficient^0.98 · decay^-0.20``."""
    largest = sorted(powers.items(), key=lambda item: -abs(item[1]))
    return " · ".join(
        name if power == 1 else f"{name}^{units.fixed(power, 2)}" for name, power in largest if abs(power) >= 0.005
    )


def _value(estimate: Estimate) -> str:
    """The value of an estimate in SI."""
    return f"{estimate.value:.4g}"


def _not_identified(fit_result: FitResult) -> list[Record]:
    """Numbers that the log does not identify; those at a bound, and large residuals, have records of their own."""
    without = [
        name for name, e in fit_result.estimates.items() if not e.identified and not e.at_bound and not e.one_sided
    ]
    records: list[Record] = []
    for combination in fit_result.identifiability.combinations:
        if combination.identified:
            continue
        names = [name for name, power in combination.powers.items() if abs(power) >= 0.05]
        without = [name for name in without if name not in names]
        with_prior = [name for name in names if fit_result.estimates[name].identified]
        inputs = " and ".join(names)
        if len(names) == 1:
            (name,) = names
            flat = f"near {_value(fit_result.estimates[name])} the torques of this log hardly depend on it"
            if with_prior:
                text = f"{name} is known only together with its prior: {flat}"
                records.append(Record.warning("fit.confounded", name, text))
            else:
                records.append(Record.warning("fit.not_identified", name, f"{name} is not identified: {flat}"))
        elif with_prior:
            text = (
                f"{inputs} cannot be told apart by this log alone: the error of {' and '.join(with_prior)} stands on "
                "the prior, what was known before"
            )
            records.append(Record.warning("fit.confounded", ",".join(names), text))
        else:
            text = (
                f"{inputs} cannot be told apart by this log: it says nothing of "
                f"{product_of_powers(combination.powers)}; fix one of them, give one a prior, or measure elsewhere"
            )
            records.append(Record.warning("fit.confounded", ",".join(names), text))
    if CONSTANT_TORQUE.name in without and not fit_result.problem.has_torque_offset:
        without.remove(CONSTANT_TORQUE.name)
        text = (
            f"{CONSTANT_TORQUE.name} is not identified: friction of one sign cannot be told from a zero error of the "
            "sensor; measure in both directions"
        )
        records.append(Record.warning("fit.one_direction", CONSTANT_TORQUE.name, text))
    # those of few rows, and those that stand on their prior, have records of their own
    without = [name for name in without if fit_result.estimates[name].prior_share <= PRIOR_SHARE]
    imprecise = [] if fit_result.has_few_rows else without
    imprecisely = "is not identified: it is known to less than half of its size"
    return records + [Record.warning("fit.imprecise", name, f"{name} {imprecisely}") for name in imprecise]


def _of_bounds(fit_result: FitResult) -> list[Record]:
    one_sided = [e for e in fit_result.estimates.values() if e.one_sided and not e.at_bound]
    at_bound = [e for e in fit_result.estimates.values() if e.at_bound]
    records: list[Record] = []
    for e in one_sided:
        text = f"{e.name} is bounded on one side only: beyond {_value(e)} the torques hardly change"
        records.append(Record.warning("fit.one_sided", e.name, text, e.value, unit=e.quantity.unit))
    for e in at_bound:
        text = f"{e.name} came to rest at its bound ({_value(e)}): the model cannot follow the log any further"
        records.append(Record.warning("fit.at_bound", e.name, text, e.value, e.value, e.quantity.unit))
    return records


def _of_priors(fit_result: FitResult) -> list[Record]:
    records: list[Record] = []
    for e in fit_result.estimates.values():
        if e.prior_share > PRIOR_SHARE:
            by_prior = "is known by its prior, too" if e.identified else "is not identified, it stands on its prior"
            text = f"{e.name} {by_prior}: the log leaves {units.percent(e.prior_share)} of the prior's variance"
            records.append(Record.warning("fit.prior", e.name, text, e.prior_share, PRIOR_SHARE))
    return records


def _of_preload(fit_result: FitResult) -> list[Record]:
    """Rows at which the load has lifted the relieved balls off, where the preload was fitted."""
    if not {"preload", "nut.preload", "oversize", "nut.oversize"} & set(fit_result.response.names):
        return []
    loads = np.asarray(fit_result.rows.log.axial_load)
    limits = np.asarray(loads_of(fit_result.screw, np.where(loads < 0, -1.0, 1.0)).lift_off_load)
    most, lifted = float(np.min(limits)), int(np.count_nonzero(np.abs(loads) >= limits))
    if not lifted:
        return []
    text = (
        f"at {lifted} of {len(fit_result.rows.log)} rows the load lifts the relieved balls off (from "
        f"{units.in_unit(most, 'N')} on): those rows tell nothing of the preload"
    )
    return [Record.warning("fit.lift_off", "axial_load", text, most, unit="N")]


def _of_rows(fit_result: FitResult) -> list[Record]:
    return [
        *_of_scatter(fit_result),
        *_of_number(fit_result),
        *_of_baselines(fit_result),
        *_of_oil(fit_result),
        *_of_load_signs(fit_result),
    ]


def _of_scatter(fit_result: FitResult) -> list[Record]:
    """A fit that did not end, or that misses the rows by much."""
    records: list[Record] = []
    if not fit_result.solution.converged:
        text = "the fit did not come to rest: its numbers are not to be used"
        records.append(Record.warning("fit.not_converged", "estimates", text))
    typical = float(np.median(np.abs(fit_result.rows.friction)))
    scatter = float(np.median(fit_result.rows.scatter))
    if scatter > typical or fit_result.solution.noise.share > MAXIMUM_NOISE_SHARE:
        off, friction = (units.in_unit(torque, "N m", 2) for torque in (scatter, typical))
        text = f"rows miss by {off}, where friction is {friction}: look at their signs, units and conditions"
        records.append(Record.warning("fit.scatter", "torque", text, scatter, typical, "N m"))
    outlying = float(np.mean(fit_result.rows.outlying))
    if outlying > MANY_OUTLIERS:
        share = units.percent(outlying)
        text = f"{share} of the rows lie far from any fit: look at their signs, units and conditions"
        records.append(Record.warning("fit.outliers", "rows", text, outlying, MANY_OUTLIERS))
    return records


def _of_number(fit_result: FitResult) -> list[Record]:
    """Too few rows, or rows that are not independent."""
    records: list[Record] = []
    if fit_result.has_few_rows:
        text = "too few operating points for so many numbers: no estimate has an error; measure at more, or free fewer"
        records.append(Record.warning("fit.too_few", "rows", text, float(len(fit_result.rows.log))))
    if autocorrelation_lag(fit_result.solution.influence):
        text = "residuals that follow each other are alike: the errors are larger for it"
        records.append(Record.warning("fit.autocorrelated", "residuals", text))
    if not fit_result.rows.held_out.any():
        text = "too few rows to hold any out: how well the model predicts is not known"
        records.append(Record.warning("fit.no_holdout", "holdout_rms", text, float(len(fit_result.rows.log))))
    return records


def _of_baselines(fit_result: FitResult) -> list[Record]:
    """A description without physics that is nearer to the log than the model."""
    rms = {score.description: score.fitted for score in fit_result.scores}
    own = rms.pop(CALIBRATED)
    rms.pop(AS_GIVEN)
    best = min(rms, key=lambda description: rms[description])
    if not (rms[best] < BASELINE_RATIO * own and own > minimum_scatter(fit_result.rows.log.torque)):
        return []
    ratio = own / rms[best] if rms[best] * MAXIMUM_RATIO > own else MAXIMUM_RATIO
    times = units.fixed(ratio, 1) if ratio < MAXIMUM_RATIO else f"more than {units.fixed(MAXIMUM_RATIO)}"
    text = (
        f"the description without physics ({best}) is {times} times nearer to the log: look at units, kind of torque, "
        "and whether this is the screw"
    )
    return [Record.warning("fit.baseline_better", "residual_rms", text, own, rms[best], "N m")]


def _of_oil(fit_result: FitResult) -> list[Record]:
    """A viscosity that is fitted to a log with temperatures, and temperatures that change nothing."""
    if fit_result.rows.log.temperature is None:
        return []
    records: list[Record] = []
    if "viscosity" in fit_result.response.names:
        text = "viscosity is free: it counts for the whole log, whatever the temperatures"
        records.append(Record.warning("fit.viscosity_free", "viscosity", text))
    if not fit_result.lubricant.follows_temperature:
        text = (
            "the temperatures of the log are not used: the oil has a viscosity, and no sheet or grade that changes it"
        )
        records.append(Record.warning("fit.temperature_unused", "temperature", text))
    return records


def _of_load_signs(fit_result: FitResult) -> list[Record]:
    """Loads that may be sizes alone, in a nut that rubs otherwise under the opposite load."""
    load = fit_result.rows.log.axial_load
    if fit_result.rows.convention.ideal != "absent" or np.any(load < 0):
        return []
    some = np.unique(np.linspace(0, load.size - 1, min(load.size, SOME_ROWS)).astype(np.int64))
    points = {name: values[some] for name, values in fit_result.response.points.items()}
    torques, _ = fit_result.response.at({**points, "axial_load": -points["axial_load"]})(
        fit_result.solution.values[: len(fit_result.response.names)]
    )
    friction = fit_result.rows.friction[some]
    share = float(np.median(np.abs(torques[1] - friction)) / np.median(np.abs(friction)))
    if not share > LOAD_SIGN_SHARE:
        return []
    text = (
        "the loads of the log have no sign: they are taken as positive; friction under the opposite load differs by "
        f"{units.percent(share)} in this nut; give the loads their signs"
    )
    return [Record.warning("fit.load_sign", "axial_load", text, share, LOAD_SIGN_SHARE)]


def _trends(fit_result: FitResult) -> list[Record]:
    """Quantities on which the residuals depend: the model lacks an effect."""
    friction = float(np.median(np.abs(fit_result.rows.friction)))
    records: list[Record] = []
    for name, trend in fit_result.rows.trends.items():
        worst = int(np.argmax(np.abs(trend.means)))
        off = float(trend.means[worst])
        if abs(off) > max(TREND_ERRORS * trend.errors[worst], TREND_SHARE * friction):
            text = (
                f"friction is {'over' if off > 0 else 'under'}estimated by {units.percent(abs(off) / friction)} at the "
                f"{FIFTHS[worst]} fifth of the {name.replace('_', ' ')}: the model misses something that depends on it"
            )
            records.append(Record.warning("fit.trend", name, text, off, TREND_SHARE * friction, "N m"))
    return records


#: The largest share that the seals have of a torque without load, of the rows of Rexroth2006 with their standard seals.
MOST_CONSTANT = 0.8
#: A preload above this share of the dynamic load rating is more than vendors allow.
HIGHEST_PRELOAD = 0.1
#: From the friction of a film, which that of touching surfaces is not below, to the highest coefficient in use.
BOUNDARY_FRICTION = 0.05, 0.2
_BOUNDARY = (
    "what steel and oil have: 0.05 is the friction of a film, 0.12 to 0.15 that of bearings that touch "
    "(SKF2018), 0.2 the highest in use (Olaru2005)"
)
_CONSTANT = (
    f"seals and bearings drive no screw, and make at most {units.number(100 * MOST_CONSTANT)} % of a torque "
    "without load (Rexroth2006)"
)
_RATING = f"{units.number(100 * HIGHEST_PRELOAD)} % of the dynamic load rating is the most that makers set"
_USUAL = "what screws have"
_REACHES, _AVOID = "its interval reaches into it", "do not predict with this fit"
_PRELOADS = ("preload", "nut.preload")


class _Range(NamedTuple):
    low: float
    high: float
    #: What has such numbers.
    reason: str


def verdict_records(fit_result: FitResult, dynamic_load_rating: Force | None = None) -> list[Record]:
    """A verdict for each fitted number that no screw has, in the order of the estimates."""
    limits = {
        name: _range(fit_result, full, estimate, dynamic_load_rating) for name, full, estimate in _named(fit_result)
    }
    return [
        _record(estimate, limit)
        for name, estimate in fit_result.estimates.items()
        if (limit := limits[name]) is not None
        and not limit.low <= estimate.value <= limit.high
        and not (name == CONSTANT_TORQUE.name and _is_zero_by_chance(estimate))
    ]


def _is_zero_by_chance(estimate: Estimate) -> bool:
    """Test whether a number below zero reaches it by its interval: a true zero is found below it half of the time."""
    ends = estimate.interval()
    return estimate.value < 0 and ends is not None and ends[1] >= 0


def _named(fit_result: FitResult) -> list[tuple[str, str, Estimate]]:
    """The estimates with the names that they have as inputs."""
    full = [
        *fit_result.response.names,
        *([CONSTANT_TORQUE.name] if CONSTANT_TORQUE.name in fit_result.estimates else []),
    ]
    return [(name, inside, one) for inside, (name, one) in zip(full, fit_result.estimates.items(), strict=True)]


def _range(fit_result: FitResult, full: str, estimate: Estimate, rating: Force | None) -> _Range | None:
    if full == CONSTANT_TORQUE.name:
        rows = fit_result.rows
        measured = rows.friction + estimate.value - rows.direction * rows.residuals
        return _Range(0.0, MOST_CONSTANT * float(np.median(np.abs(measured))), _CONSTANT)
    if full in _PRELOADS and rating is not None:
        return _Range(0.0, HIGHEST_PRELOAD * float(rating), _RATING)
    if full.rpartition(".")[2] == "boundary_friction_coefficient":
        return _Range(*BOUNDARY_FRICTION, _BOUNDARY)
    usual = estimate.quantity.info.usual
    return None if usual is None else _Range(float(usual[0]), float(usual[1]), _USUAL)


def shown_with_interval(estimate: Estimate) -> str:
    """A fitted number with its interval, where it has one."""
    # at a bound but for rounding
    value = min(estimate.bounds, key=lambda end: abs(end - estimate.value)) if estimate.at_bound else estimate.value
    number, ends = units.shown(value, estimate.quantity), estimate.interval()
    if ends is None:
        return number
    low, high = units.ends(*ends, estimate.quantity)
    return f"{number} (95 %: {low} to {high})"


def _record(estimate: Estimate, limit: _Range) -> Record:
    ends = estimate.interval()
    reaches = ends is not None and ends[0] <= limit.high and ends[1] >= limit.low
    low, high = (units.shown(end, estimate.quantity) for end in (limit.low, limit.high))
    message = (
        f"implausible: {spoken(estimate.name)} {shown_with_interval(estimate)} is outside {low} to {high} "
        f"({limit.reason}); {_REACHES if reaches else _AVOID}: look at units, signs and the kind of nut, free what "
        "the model lacks, or hold this number"
    )
    return Record(
        "fit.implausible",
        estimate.name,
        message,
        severity="warning" if reaches else "error",
        holds=None if reaches else False,
        value=estimate.value,
        limit=limit.low if estimate.value < limit.low else limit.high,
        unit=estimate.quantity.unit,
    )
