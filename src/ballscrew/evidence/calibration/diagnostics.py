"""Diagnostics of a calibration: records of what its estimates do not show."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ballscrew.basis.records import Message, Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.evidence.calibration.fit_result import AS_GIVEN, CALIBRATED, MINIMUM_DEGREES_OF_FREEDOM, FitResult
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.robust import autocorrelation_lag, minimum_scatter
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.solvers.load_distribution import ball_loads

_OF_LOG = Message("so in the row that starves the most, by the numbers of the fit")
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
    plan = found.response.evaluation.plan
    rows = {name: values for name, values in plan.points(slice(0, plan.total)).items() if name in _OF_ROWS}
    return found.subject.starvation(rows, _OF_LOG)


def _warning(
    name: str, subject: str, text: str, value: float | None = None, limit: float | None = None, unit: str = "1"
) -> Record:
    return Record(
        id=f"fit.{name}",
        subject=subject,
        text=text,
        severity="warning",
        holds=False,
        value=value,
        limit=limit,
        unit=unit,
    )


def product_of_powers(powers: Mapping[str, float]) -> str:
    """A product of powers, the largest first: ``boundary_friction_coefficient^0.98 · decay^-0.20``."""
    largest = sorted(powers.items(), key=lambda item: -abs(item[1]))
    return " · ".join(name if power == 1 else f"{name}^{power:.2f}" for name, power in largest if abs(power) >= 0.005)


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
        if len(names) == 1:
            near = f"near {found.estimates[names[0]].value:.4g}"
            text = f"{names[0]} is not identified: {near} the torques of this log hardly depend on it"
            records.append(_warning("not_identified", names[0], text))
        elif with_prior:
            text = (
                f"{' and '.join(names)} cannot be told apart by this log alone: the error of "
                f"{' and '.join(with_prior)} stands on the prior, what was known before"
            )
            records.append(_warning("confounded", ",".join(names), text))
        else:
            text = (
                f"{' and '.join(names)} cannot be told apart by this log: it says nothing of "
                f"{product_of_powers(combination.powers)}; fix one of them, give one a prior, or measure elsewhere"
            )
            records.append(_warning("confounded", ",".join(names), text))
    if CONSTANT_TORQUE.name in without and not found.problem.has_torque_offset:
        without.remove(CONSTANT_TORQUE.name)
        text = (
            "constant_torque is not identified: friction of one sign cannot be told from a zero error of the sensor; "
            "measure in both directions"
        )
        records.append(_warning("one_direction", CONSTANT_TORQUE.name, text))
    return records + [
        _warning("imprecise", name, f"{name} is not identified: it is known to less than half of its size")
        for name in without
    ]


def _of_bounds(found: FitResult) -> list[Record]:
    one_sided = [e for e in found.estimates.values() if e.one_sided and not e.at_bound]
    at_bound = [e for e in found.estimates.values() if e.at_bound]
    return [
        *(
            _warning(
                "one_sided", e.name,
                f"{e.name} is bounded on one side only: beyond {e.value:.4g} the torques hardly change",
                e.value, unit=e.quantity.unit,
            )
            for e in one_sided
        ),
        *(
            _warning(
                "at_bound", e.name,
                f"{e.name} came to rest at its bound ({e.value:.4g}): the model cannot follow the log any further",
                e.value, e.value, e.quantity.unit,
            )
            for e in at_bound
        ),
    ]  # fmt: skip


def _of_priors(found: FitResult) -> list[Record]:
    return [
        _warning(
            "prior", e.name,
            f"{e.name} is known by its prior, too: the log leaves {e.prior_share:.0%} of the prior's variance",
            e.prior_share, PRIOR_SHARE,
        )
        for e in found.estimates.values()
        if e.prior_share > PRIOR_SHARE
    ]  # fmt: skip


def _of_preload(found: FitResult) -> list[Record]:
    """Rows at which the load has lifted the relieved balls off, where the preload was fitted."""
    nut = found.screw.nut
    if not {"preload", "nut.preload", "oversize", "nut.oversize"} & set(found.response.names):
        return []
    most = float(np.asarray(ball_loads(found.screw, nut, 0.0).lift_off_load))
    lifted = int(np.count_nonzero(np.abs(found.rows.log.axial_load) >= most))
    if not lifted:
        return []
    text = (
        f"at {lifted} of {len(found.rows.log)} rows the load lifts the relieved balls off (from {most:.4g} N on): "
        "those rows tell nothing of the preload"
    )
    return [_warning("lift_off", "axial_load", text, most, unit="N")]


def _of_rows(found: FitResult) -> list[Record]:
    records: list[Record] = []

    def warn(
        name: str, subject: str, text: str, value: float | None = None, limit: float | None = None, unit: str = "1"
    ) -> None:
        records.append(_warning(name, subject, text, value, limit, unit))

    if not found.solution.converged:
        warn("not_converged", "estimates", "the fit did not come to rest: its numbers are not to be used")
    typical = float(np.median(np.abs(found.rows.friction)))
    scatter = float(np.median(found.rows.scatter))
    if scatter > typical or found.solution.noise.share > MAXIMUM_NOISE_SHARE:
        text = f"rows miss by {scatter:.2g} N m, where friction is {typical:.2g} N m: "
        warn("scatter", "torque", f"{text}look at their signs, units and conditions", scatter, typical, "N m")
    outlying = float(np.mean(found.rows.outlying))
    if outlying > MANY_OUTLIERS:
        text = f"{outlying:.0%} of the rows lie far from any fit: look at their signs, units and conditions"
        warn("outliers", "rows", text, outlying, MANY_OUTLIERS)
    freedom = min(estimate.degrees_of_freedom for estimate in found.estimates.values())
    if freedom < MINIMUM_DEGREES_OF_FREEDOM:
        text = "too few operating points for so many numbers: no estimate has an error; measure at more, or free fewer"
        warn("too_few", "rows", text, float(len(found.rows.log)))
    if autocorrelation_lag(found.solution.influence):
        text = "residuals that follow each other are alike: the errors are larger for it"
        warn("autocorrelated", "residuals", text)
    if not found.rows.held_out.any():
        text = "too few rows to hold any out: how well the model predicts is not known"
        warn("no_holdout", "holdout_rms", text, float(len(found.rows.log)))
    rms = {score.description: score.fitted for score in found.scores}
    own = rms.pop(CALIBRATED)
    rms.pop(AS_GIVEN)
    best = min(rms, key=lambda description: rms[description])
    if rms[best] < BASELINE_RATIO * own and own > minimum_scatter(found.rows.log.torque):
        ratio = own / rms[best] if rms[best] * MAXIMUM_RATIO > own else MAXIMUM_RATIO
        times = f"{ratio:.1f} times" if ratio < MAXIMUM_RATIO else f"more than {MAXIMUM_RATIO:.0f} times"
        text = (
            f"the description without physics ({best}) is {times} nearer to the log: look at "
            "units, kind of torque, and whether this is the screw"
        )
        warn("baseline_better", "residual_rms", text, own, rms[best], "N m")
    if "viscosity" in found.response.names and found.rows.log.temperature is not None:
        text = "viscosity is free: it counts for the whole log, whatever the temperatures"
        warn("viscosity_free", "viscosity", text)
    if found.rows.log.temperature is not None and not found.lubricant.follows_temperature:
        text = (
            "the temperatures of the log are not used: the oil has a viscosity, and no sheet or grade that changes it"
        )
        warn("temperature_unused", "temperature", text)
    return records


def _trends(found: FitResult) -> list[Record]:
    """Quantities on which the residuals depend: the model lacks an effect."""
    friction = float(np.median(np.abs(found.rows.friction)))
    records: list[Record] = []
    for name, trend in found.rows.trends.items():
        worst = int(np.argmax(np.abs(trend.means)))
        off = float(trend.means[worst])
        if abs(off) > max(TREND_ERRORS * trend.errors[worst], TREND_SHARE * friction):
            which = ("lowest", "lower", "middle", "higher", "highest")[worst]
            text = (
                f"friction is {'over' if off > 0 else 'under'}estimated by {abs(off) / friction:.0%} at the {which} "
                f"fifth of the {name.replace('_', ' ')}: the model misses something that depends on it"
            )
            records.append(_warning("trend", name, text, off, TREND_SHARE * friction, "N m"))
    return records
