"""Diagnostics of a calibration: records of what its estimates do not show."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import both, chained, message_of
from ballscrew.basis.records import Measured, Message, Named, Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.evidence.calibration.fit_result import (
    AS_GIVEN,
    CALIBRATED,
    Estimate,
    FitResult,
)
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.robust import autocorrelation_lag, minimum_scatter
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.friction.loaded_balls import loads_of

_OF_LOG = Message("so in the row that starves the most, by the numbers of the fit")
_FLAT = Message("{name} is not identified: near {value} the torques of this log hardly depend on it")
_BY_PRIORS = Message(
    "{names} cannot be told apart by this log alone: the error of {with_prior} stands on the prior, what was known "
    "before"
)
_CONFOUNDED = Message(
    "{names} cannot be told apart by this log: it says nothing of {product}; fix one of them, give one a prior, "
    "or measure elsewhere"
)
_BY_PRIOR = Message(
    "{name} is known only together with its prior: near {value} the torques of this log hardly depend on it"
)
_PRODUCT, _POWER = Message("{others} · {last}"), Message("{name}^{power}")
_ONE_DIRECTION = Message(
    "{name} is not identified: friction of one sign cannot be told from a zero error of the sensor; "
    "measure in both directions"
)
_IMPRECISE = Message("{name} is not identified: it is known to less than half of its size")
_ONE_SIDED = Message("{name} is bounded on one side only: beyond {value} the torques hardly change")
_AT_BOUND = Message("{name} came to rest at its bound ({value}): the model cannot follow the log any further")
_LOAD_SIGN = Message(
    "the loads of the log have no sign: they are taken as positive; friction under the opposite load differs by "
    "{share} in this nut; give the loads their signs"
)
_PRIOR = Message("{name} is known by its prior, too: the log leaves {share} of the prior's variance")
_PRIOR_ALONE = Message(
    "{name} is not identified, it stands on its prior: the log leaves {share} of the prior's variance"
)
_LIFT_OFF = Message(
    "at {lifted} of {rows} rows the load lifts the relieved balls off (from {load} on): "
    "those rows tell nothing of the preload"
)
_SCATTER = Message("rows miss by {scatter}, where friction is {friction}: look at their signs, units and conditions")
_OUTLIERS = Message("{share} of the rows lie far from any fit: look at their signs, units and conditions")
_BASELINE = Message(
    "the description without physics ({baseline}) is {times} nearer to the log: look at units, kind of torque, and "
    "whether this is the screw"
)
_OVER = Message(
    "friction is overestimated by {share} at the {fifth} of the {name}: the model misses something that depends on it"
)
_UNDER = Message(
    "friction is underestimated by {share} at the {fifth} of the {name}: the model misses something that depends on it"
)
_FIFTHS = (
    Message("lowest fifth"), Message("lower fifth"), Message("middle fifth"), Message("higher fifth"),
    Message("highest fifth"),
)  # fmt: skip
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


def warning_records(found: FitResult) -> list[Record]:
    """Reasons not to trust the estimates, the gravest first."""
    judged = {record.subject.rpartition(".")[2] for record in found.verdict_records}
    odd = [one for one in found.subject.implausible({}) if one.subject.rpartition(".")[2] not in judged]
    return [
        *odd,
        *_starved(found),
        *_not_identified(found),
        *_of_bounds(found),
        *_of_priors(found),
        *_of_preload(found),
        *_of_rows(found),
        *_trends(found),
    ]


def _starved(found: FitResult) -> list[Record]:
    """Rows of the log at which the fitted model is starved of oil: a full bath would have asked for other numbers."""
    rows = {name: values for name, values in found.response.points.items() if name in _OF_ROWS}
    return found.subject.starvation(rows, _OF_LOG)


def _warning(
    name: str,
    subject: str,
    text: str | Message,
    value: float | None = None,
    limit: float | None = None,
    unit: str = "1",
) -> Record:
    return units.record(
        message_of(text), id=f"fit.{name}", subject=subject, severity="warning", holds=False, value=value, limit=limit,
        unit=unit,
    )  # fmt: skip


def powers_of(powers: Mapping[str, float]) -> Message:
    """A product of powers, the largest first: ``boundary_friction_coefficient^0.98 · decay^-0.20``."""
    largest = sorted(powers.items(), key=lambda item: -abs(item[1]))
    parts = [
        Named(name, name) if power == 1 else _POWER.of(name=Named(name, name), power=units.fixed(power, 2))
        for name, power in largest
        if abs(power) >= 0.005
    ]
    return chained(_PRODUCT, parts) if parts else Message("")


def product_of_powers(powers: Mapping[str, float]) -> str:
    """:func:`powers_of` as text."""
    return units.filled(powers_of(powers))


def _value(estimate: Estimate) -> Measured:
    """The value of an estimate, which the text has in SI."""
    return Measured(estimate.value, estimate.quantity, written=f"{estimate.value:.4g}")


def _not_identified(found: FitResult) -> list[Record]:
    """Numbers that the log does not identify; those at a bound, and large residuals, have records of their own."""
    without = [name for name, e in found.estimates.items() if not e.identified and not e.at_bound and not e.one_sided]
    records: list[Record] = []
    for combination in found.identifiability.combinations:
        if combination.identified:
            continue
        names = [name for name, power in combination.powers.items() if abs(power) >= 0.05]
        without = [name for name in without if name not in names]
        with_prior = [name for name in names if found.estimates[name].identified]
        inputs = both(Named(name, name) for name in names)
        if len(names) == 1 and with_prior:
            message = _BY_PRIOR.of(name=Named(names[0], names[0]), value=_value(found.estimates[names[0]]))
            records.append(_warning("confounded", names[0], message))
        elif len(names) == 1:
            message = _FLAT.of(name=Named(names[0], names[0]), value=_value(found.estimates[names[0]]))
            records.append(_warning("not_identified", names[0], message))
        elif with_prior:
            message = _BY_PRIORS.of(names=inputs, with_prior=both(Named(name, name) for name in with_prior))
            records.append(_warning("confounded", ",".join(names), message))
        else:
            message = _CONFOUNDED.of(names=inputs, product=powers_of(combination.powers))
            records.append(_warning("confounded", ",".join(names), message))
    if CONSTANT_TORQUE.name in without and not found.problem.has_torque_offset:
        without.remove(CONSTANT_TORQUE.name)
        message = _ONE_DIRECTION.of(name=Named(CONSTANT_TORQUE.name, CONSTANT_TORQUE.name))
        records.append(_warning("one_direction", CONSTANT_TORQUE.name, message))
    # those of few rows, and those that stand on their prior, have records of their own
    without = [name for name in without if found.estimates[name].prior_share <= PRIOR_SHARE]
    imprecise = [] if found.has_few_rows else without
    return records + [_warning("imprecise", name, _IMPRECISE.of(name=Named(name, name))) for name in imprecise]


def _of_bounds(found: FitResult) -> list[Record]:
    one_sided = [e for e in found.estimates.values() if e.one_sided and not e.at_bound]
    at_bound = [e for e in found.estimates.values() if e.at_bound]
    return [
        *(
            _warning(
                "one_sided", e.name, _ONE_SIDED.of(name=Named(e.name, e.name), value=_value(e)),
                e.value, unit=e.quantity.unit,
            )
            for e in one_sided
        ),
        *(
            _warning(
                "at_bound", e.name, _AT_BOUND.of(name=Named(e.name, e.name), value=_value(e)),
                e.value, e.value, e.quantity.unit,
            )
            for e in at_bound
        ),
    ]  # fmt: skip


def _of_priors(found: FitResult) -> list[Record]:
    return [
        _warning(
            "prior", e.name,
            (_PRIOR if e.identified else _PRIOR_ALONE).of(
                name=Named(e.name, e.name), share=units.percent(e.prior_share)
            ),
            e.prior_share, PRIOR_SHARE,
        )
        for e in found.estimates.values()
        if e.prior_share > PRIOR_SHARE
    ]  # fmt: skip


def _of_preload(found: FitResult) -> list[Record]:
    """Rows at which the load has lifted the relieved balls off, where the preload was fitted."""
    if not {"preload", "nut.preload", "oversize", "nut.oversize"} & set(found.response.names):
        return []
    loads = np.asarray(found.rows.log.axial_load)
    limits = np.asarray(loads_of(found.screw, np.where(loads < 0, -1.0, 1.0)).lift_off_load)
    most, lifted = float(np.min(limits)), int(np.count_nonzero(np.abs(loads) >= limits))
    if not lifted:
        return []
    message = _LIFT_OFF.of(
        lifted=units.fixed(lifted), rows=units.fixed(len(found.rows.log)), load=units.in_unit(most, "N")
    )
    return [_warning("lift_off", "axial_load", message, most, unit="N")]


def _of_rows(found: FitResult) -> list[Record]:
    return [*_of_scatter(found), *_of_number(found), *_of_baselines(found), *_of_oil(found), *_of_load_signs(found)]


def _of_scatter(found: FitResult) -> list[Record]:
    """A fit that did not end, or that misses the rows by much."""
    records: list[Record] = []
    if not found.solution.converged:
        text = "the fit did not come to rest: its numbers are not to be used"
        records.append(_warning("not_converged", "estimates", text))
    typical = float(np.median(np.abs(found.rows.friction)))
    scatter = float(np.median(found.rows.scatter))
    if scatter > typical or found.solution.noise.share > MAXIMUM_NOISE_SHARE:
        message = _SCATTER.of(scatter=units.in_unit(scatter, "N m", 2), friction=units.in_unit(typical, "N m", 2))
        records.append(_warning("scatter", "torque", message, scatter, typical, "N m"))
    outlying = float(np.mean(found.rows.outlying))
    if outlying > MANY_OUTLIERS:
        message = _OUTLIERS.of(share=units.percent(outlying))
        records.append(_warning("outliers", "rows", message, outlying, MANY_OUTLIERS))
    return records


def _of_number(found: FitResult) -> list[Record]:
    """Too few rows, or rows that are not independent."""
    records: list[Record] = []
    if found.has_few_rows:
        text = "too few operating points for so many numbers: no estimate has an error; measure at more, or free fewer"
        records.append(_warning("too_few", "rows", text, float(len(found.rows.log))))
    if autocorrelation_lag(found.solution.influence):
        text = "residuals that follow each other are alike: the errors are larger for it"
        records.append(_warning("autocorrelated", "residuals", text))
    if not found.rows.held_out.any():
        text = "too few rows to hold any out: how well the model predicts is not known"
        records.append(_warning("no_holdout", "holdout_rms", text, float(len(found.rows.log))))
    return records


def _of_baselines(found: FitResult) -> list[Record]:
    """A description without physics that is nearer to the log than the model."""
    rms = {score.description: score.fitted for score in found.scores}
    own = rms.pop(CALIBRATED)
    rms.pop(AS_GIVEN)
    best = min(rms, key=lambda description: rms[description])
    if not (rms[best] < BASELINE_RATIO * own and own > minimum_scatter(found.rows.log.torque)):
        return []
    ratio = own / rms[best] if rms[best] * MAXIMUM_RATIO > own else MAXIMUM_RATIO
    if ratio < MAXIMUM_RATIO:
        times = Message("{ratio} times", {"ratio": units.fixed(ratio, 1)})
    else:
        times = Message("more than {ratio} times", {"ratio": units.fixed(MAXIMUM_RATIO)})
    message = _BASELINE.of(baseline=Message(best), times=times)
    return [_warning("baseline_better", "residual_rms", message, own, rms[best], "N m")]


def _of_oil(found: FitResult) -> list[Record]:
    """A viscosity that is fitted to a log with temperatures, and temperatures that change nothing."""
    if found.rows.log.temperature is None:
        return []
    records: list[Record] = []
    if "viscosity" in found.response.names:
        text = "viscosity is free: it counts for the whole log, whatever the temperatures"
        records.append(_warning("viscosity_free", "viscosity", text))
    if not found.lubricant.follows_temperature:
        text = (
            "the temperatures of the log are not used: the oil has a viscosity, and no sheet or grade that changes it"
        )
        records.append(_warning("temperature_unused", "temperature", text))
    return records


def _of_load_signs(found: FitResult) -> list[Record]:
    """Loads that may be sizes alone, in a nut that rubs otherwise under the opposite load."""
    load = found.rows.log.axial_load
    if found.rows.convention.ideal != "absent" or np.any(load < 0):
        return []
    some = np.unique(np.linspace(0, load.size - 1, min(load.size, SOME_ROWS)).astype(np.int64))
    points = {name: values[some] for name, values in found.response.points.items()}
    torques, _ = found.response.at({**points, "axial_load": -points["axial_load"]})(
        found.solution.values[: len(found.response.names)]
    )
    friction = found.rows.friction[some]
    share = float(np.median(np.abs(torques[1] - friction)) / np.median(np.abs(friction)))
    if not share > LOAD_SIGN_SHARE:
        return []
    return [_warning("load_sign", "axial_load", _LOAD_SIGN.of(share=units.percent(share)), share, LOAD_SIGN_SHARE)]


def _trends(found: FitResult) -> list[Record]:
    """Quantities on which the residuals depend: the model lacks an effect."""
    friction = float(np.median(np.abs(found.rows.friction)))
    records: list[Record] = []
    for name, trend in found.rows.trends.items():
        worst = int(np.argmax(np.abs(trend.means)))
        off = float(trend.means[worst])
        if abs(off) > max(TREND_ERRORS * trend.errors[worst], TREND_SHARE * friction):
            column = Message("time") if name == "time" else Named(name)
            message = (_OVER if off > 0 else _UNDER).of(
                share=units.percent(abs(off) / friction),
                fifth=_FIFTHS[worst],
                name=column,
            )
            records.append(_warning("trend", name, message, off, TREND_SHARE * friction, "N m"))
    return records
