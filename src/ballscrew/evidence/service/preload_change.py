"""The preload of a nut then and now: from two logs of its torque, or from one log and the nominal preload.

The preload of a nut from one torque without load.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import ONE_BY_ONE, Fault, InputError, accepts_units, nearest, raise_if_any, renamed_keyword
from ballscrew.basis.quantities import AngularSpeed, Force, MomentOfInertia, Temperature, Torque
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, standard_normal_quantile
from ballscrew.engine.uncertainty.uncertain_value import NORMAL_95, default_distributions
from ballscrew.evidence.calibration.baselines import LOGGED_TEMPERATURE, UNKNOWN_TEMPERATURE
from ballscrew.evidence.calibration.fit import fit
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.evidence.calibration.response import VISCOSITY, torque_of_model
from ballscrew.evidence.calibration.robust import Vector
from ballscrew.evidence.service.alternatives import Alternative, alternatives, rows_that_count
from ballscrew.evidence.service.diagnostics import Mixture, PreloadEstimate, warning_records
from ballscrew.evidence.service.posterior import MINIMUM_SAMPLES, PRELOAD, Groups, Posterior, Readings, posterior
from ballscrew.files.torque_logs.log_rows import Kind
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

if TYPE_CHECKING:
    from ballscrew.engine.uncertainty.monte_carlo import JointNormal

Verdict = Literal["lost", "kept", "open"]
#: A preload is called lost, or kept, with this probability.
CERTAIN = 0.95
#: Φ(1).
ONE_DEVIATION = 0.8413447460685429
#: What a service may fit to each log.
FREE = PRELOAD, CONSTANT_TORQUE.name
#: What a nut has to be.
RIGID = "leave out [bodies] and [deviations]: without load the torque is nearly the same, under load it is another one"
#: What became of the preload, by the verdict.
VERDICTS = {
    "lost": "preload lost",
    "kept": "preload kept",
    "open": "lost or kept cannot be told",
}


def verdict_of(probability_of_loss: float) -> Verdict:
    """The verdict on a preload that is lost with a probability."""
    return "lost" if probability_of_loss >= CERTAIN else "kept" if probability_of_loss <= 1 - CERTAIN else "open"


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PreloadChange:
    """Result of :func:`preload_change`."""

    #: The preload before: of its log, or the nominal one.
    new: PreloadEstimate
    #: The preload after.
    worn: PreloadEstimate
    #: The logarithm of the ratio: errors that both preloads share have gone from it.
    logarithm: Mixture
    #: By unknown, the share of its variance that goes along with it.
    ratio_shares: Mapping[str, float]
    #: The means of the numbers of the model that the logs ask for, in standard deviations from what is known of them.
    scores: Mapping[str, float]
    #: The loss that is put up with, as a share of the preload.
    tolerance: float
    #: Other causes, had the preload stayed as it was.
    alternatives: Sequence[Alternative]
    #: Warnings as records.
    warning_records: Sequence[Record] = ()

    @property
    def ratio(self) -> float:
        """The preload left, as a share of the preload before: the median."""
        return math.exp(self.logarithm.quantile(0.5))

    def ratio_interval(self, level: float = 0.95) -> tuple[float, float]:
        """The interval of the ratio with probability ``level``; NaN where one of the preloads is not told."""
        return self.logarithm.interval(level)

    @property
    def probability_of_loss(self) -> float:
        """Probability that less than 1 − tolerance of the preload is left; NaN where one of them is not told."""
        return self.logarithm.share_below(math.log(1 - self.tolerance))

    @property
    def verdict(self) -> Verdict:
        """``"lost"`` or ``"kept"`` where that has a probability of :data:`CERTAIN`, otherwise ``"open"``."""
        return verdict_of(self.probability_of_loss)

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return [record.text for record in self.warning_records]


@renamed_keyword("uncertain", "distributions")
@accepts_units("service")
def preload_change(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    new: Any,
    worn: Any,
    *,
    free: Sequence[str] = (PRELOAD,),
    distributions: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    tolerance: float = 0.1,
    kind: Kind = "unknown",
    inertia: MomentOfInertia | None = None,
    dynamic_load_rating: Force | None = None,
    seed: int = 0,
    done: Callable[[int, int], None] | None = None,
) -> PreloadChange:
    """Preload of a nut in a log of its torque when new and in one when worn, N, and the share that is left.

    Returns a :class:`PreloadChange`. ``model``, ``screw`` and ``lubricant`` describe the nut as it should be. ``new``
    and ``worn`` are logs as :func:`~ballscrew.evidence.calibration.fit.fit` takes them; None for ``new`` stands for the
    nominal preload of the screw with its tolerance. ``kind`` says whether their torque is ``"friction"`` or ``"drive"``
    torque; ``inertia`` (kg m²) takes the acceleration out of the latter. ``free`` may have ``"constant_torque"`` beside
    ``"nut.preload"``: seals that lose another torque in each log.

    ``distributions`` are those of the numbers of the model (by default those of ``data/uncertainties.toml``),
    ``joint`` those among them that a calibration left correlated. They are unknowns beside the preloads, the same for
    both logs, and so is, for each log by itself, its oil temperature: 2 K either way where the log has it and the oil a
    grade, otherwise 10 K. A hotter oil then shows in how the torque goes with the speed, or makes the interval wider
    (:mod:`ballscrew.evidence.service.posterior`).

    ``tolerance`` is the share of the preload that may be lost; ``dynamic_load_rating`` (N) is what the preload is
    judged by. The answer is made of samples, the same for the same ``seed``. ``done(finished, total)`` is told the
    rounds of the fits, of each log anew.

    Raises :class:`~ballscrew.basis.errors.InputError` for a nut without preload or with elastic bodies, a tolerance out
    of (0, 1), one log given twice, and all that a fit raises.
    """
    subject = with_preload(Configuration(model, screw, lubricant))
    raise_if_any(_faults_of_options(free, tolerance))
    known = held_numbers(subject, distributions)
    logs = {"new": new, "worn": worn}
    logs = {label: TorqueLog.of(data) for label, data in logs.items() if data is not None}
    raise_if_any(_faults_of_logs(logs))
    logs = {label: _cleaned(log, label, inertia) for label, log in logs.items()}  # all, before a fit that takes long
    readings = {label: _read(subject, log, label, free, kind, inertia, done) for label, log in logs.items()}
    fits = [one.fit for one in readings.values()]
    result = posterior(subject, {n: Groups.of(one.fit) for n, one in readings.items()}, fits, known, joint, seed)
    labels = list(readings)
    estimates = {label: _estimate(subject, result, readings[label], place) for place, label in enumerate(labels)}
    then, now = estimates.get("new") or _nominal(subject, distributions), estimates["worn"]
    logarithm = now.logarithm.less(then.logarithm)
    other: list[Alternative] = []
    if logarithm.told and now.subject is not None:
        one = readings["worn"]
        preload = float(then.preload) if then.subject is None else float(then.subject.value_of(PRELOAD) or math.nan)
        other = alternatives(
            one, now.subject, now.warmer, preload, rows_that_count(one, now.subject, now.warmer), known
        )
    change = PreloadChange(
        new=then,
        worn=now,
        logarithm=logarithm,
        ratio_shares=_shares(result, logarithm, then if "new" not in labels else None),
        scores=result.mean_scores(),
        tolerance=tolerance,
        alternatives=other,
    )
    records = warning_records(then, now, subject, dynamic_load_rating, result)
    return dataclasses.replace(change, warning_records=tuple(records))


def _shares(result: Posterior, logarithm: Mixture, nominal: PreloadEstimate | None) -> dict[str, float]:
    """Shares of the variance of the ratio, by cause."""
    shares = result.shares(logarithm.mean, logarithm.variance)
    if nominal is not None and logarithm.told:
        shares["nominal preload"] = float(nominal.logarithm.variance[0] / logarithm.total_variance)
    return shares


def with_preload(subject: Configuration) -> Configuration:
    """The subject with a nut that is described by its preload.

    Raises ``InputError`` for one that has none, and for balls that are solved one by one: a change of the preload is
    sampled, and each sample would be thousands of such solutions.
    """
    nut: Any = subject.nut
    remedy = "choose the type double, oversize or offset, and give its preload, such as 4 kN"
    if not hasattr(nut, "preload"):
        raise InputError(Fault("nut", "has no preload", "a single nut", remedy))
    if nut.one_by_one:
        problem = "has elastic bodies or balls that differ, of which no preload is found"
        raise InputError(Fault("nut", problem, "", RIGID, id=ONE_BY_ONE))
    if nut.preload is None:
        loads = subject.model(subject.screw, subject.lubricant, axial_load=0.0, screw_speed=1.0).loads
        subject = subject.changed({PRELOAD: float(loads.remaining_preload)})
    preload: Any = subject.value_of(PRELOAD)
    if np.ndim(preload):
        raise InputError(Fault(PRELOAD, "is an array", "", "give one number"))
    if not preload > 0:
        raise InputError(Fault("nut", "has no preload", f"{float(preload):g} N", remedy))
    return subject


def held_numbers(subject: Configuration, uncertain: Mapping[str, Distribution] | None) -> dict[str, Distribution]:
    """The distributions of numbers of the model; conditions and preloads, which a log tells, are not among them.

    Nor is the viscosity of an oil without a grade: the temperature of each log stands for it.
    """
    if uncertain is None:
        usual = default_distributions(subject.model, subject.screw, subject.lubricant, exact={TEMPERATURE.name})
        uncertain = {name: distribution for name, (distribution, _) in usual.items()}
    conditions = {*OPERATION, TEMPERATURE.name, "preload", PRELOAD, "oversize", "nut.oversize"}
    if not subject.lubricant.follows_temperature:
        conditions.add(VISCOSITY)
    unknown = [name for name in uncertain if name not in subject.inputs]
    raise_if_any([Fault(f"service.distributions.{n}", "unknown name", "", nearest(n, subject.inputs)) for n in unknown])
    return {name: distribution for name, distribution in uncertain.items() if name not in conditions}


def _faults_of_options(free: Sequence[str], tolerance: Any) -> list[Fault]:
    faults: list[Fault] = []
    if isinstance(free, str) or PRELOAD not in free:
        faults.append(Fault("service.free", f"must have {PRELOAD} in it", str(free), f'free=["{PRELOAD}"]'))
    else:
        remedy = f"{' and '.join(FREE)} can be fitted; a distribution of a number in the case makes it unknown, too"
        faults += [
            Fault("service.free", "is not fitted to each log", name, remedy) for name in free if name not in FREE
        ]
    if not isinstance(tolerance, int | float) or not 0 < tolerance < 1:
        faults.append(Fault("service.tolerance", "must lie between 0 and 1", str(tolerance), "0.1 is usual"))
    return faults


def _faults_of_logs(logs: Mapping[str, TorqueLog]) -> list[Fault]:
    if "worn" not in logs:
        return [Fault("service.worn", "missing", "", "give the log that is asked about")]
    digests = [log.source[1] for log in logs.values() if log.source is not None]
    if len(digests) < 2 or digests[0] != digests[1]:
        return []
    names = ", ".join(log.source[0] for log in logs.values() if log.source is not None)
    remedy = "give the log of the new screw and that of the worn one"
    return [Fault("service", "both logs are the same file", names, remedy)]


def _read(
    subject: Configuration,
    log: TorqueLog,
    label: str,
    free: Sequence[str],
    kind: Kind,
    inertia: MomentOfInertia | None,
    done: Callable[[int, int], None] | None,
) -> Readings:
    """The rows of a log, with a first fit of the preload alone. Faults name the log."""
    try:
        result = fit(
            subject.model,
            subject.screw,
            subject.lubricant,
            log,
            free,
            kind=kind,
            inertia=inertia,
            holdout=0.0,
            temperature_error=0.0,
            done=done,  # the posterior has it, with what the other numbers say of it
        )
    except InputError as error:
        raise _naming(log, label, error) from None
    return Readings.of(result)


def _cleaned(log: TorqueLog, label: str, inertia: float | None) -> TorqueLog:
    """The rows of a log that a model can be fitted to. Faults name the log."""
    try:
        return log.cleaned(inertia=inertia)
    except InputError as error:
        raise _naming(log, label, error) from None


def _naming(log: TorqueLog, label: str, error: InputError) -> InputError:
    name = label if log.source is None else log.source[0]
    return InputError(*(dataclasses.replace(f, where=f"{name}: {f.where}") for f in error.faults))


def _statistical(one: Readings) -> float:
    """Standard deviation of the logarithm of the preload by the scatter of the rows, alike and neighbouring ones
    looked at; NaN where the log does not tell the preload.
    """
    from scipy.special import stdtrit  # slow to import: for those only who fit

    estimate = one.fit.estimates[PRELOAD]
    if estimate.std is None or not estimate.value > 0:
        return math.nan
    student = float(stdtrit(estimate.degrees_of_freedom, 0.975)) / NORMAL_95
    return student * estimate.std / estimate.value


def _estimate(subject: Configuration, result: Posterior, one: Readings, place: int) -> PreloadEstimate:
    log, first = one.fit.rows.log, one.fit.estimates[PRELOAD].value
    each = result.preloads[place]
    warmer = float(result.warmer[place][result.best])
    there = {**result.number_at_best(), PRELOAD: first * math.exp(each.mean[result.best])}
    subject = subject.changed(there)
    told = result.effective_samples >= MINIMUM_SAMPLES
    statistical = _statistical(one) if told else math.nan
    logarithm = Mixture(result.weights, math.log(max(first, 1e-300)) + each.mean, each.variance + statistical**2)
    loads = subject.model(subject.screw, subject.lubricant, axial_load=0.0, screw_speed=1.0).loads
    return PreloadEstimate(
        logarithm=logarithm,
        shares=result.shares(logarithm.mean, logarithm.variance),
        subject=subject,
        warmer=warmer,
        fit=one.fit,
        residual_rms=rows_that_count(one, subject, warmer).rms(subject, warmer),
        temperature=None if log.temperature is None else float(np.mean(log.temperature)),
        rows_beyond_lift_off=int(np.count_nonzero(np.abs(log.axial_load) >= float(loads.lift_off_load))),
    )


def _nominal(subject: Configuration, uncertain: Mapping[str, Distribution] | None) -> PreloadEstimate:
    """The preload of the case with its tolerance."""
    preload = float(subject.value_of(PRELOAD) or math.nan)
    given = None if uncertain is None else uncertain.get("preload", uncertain.get(PRELOAD))
    if uncertain is None:
        given = default_distributions(subject.model, subject.screw, subject.lubricant)["preload"][0]
    if given is None:
        return PreloadEstimate(logarithm=Mixture.of(math.log(preload), 0.0))
    low, high = (float(given.quantile(share)) for share in (1 - ONE_DEVIATION, ONE_DEVIATION))
    return PreloadEstimate(logarithm=Mixture.of(math.log(preload), (high - low) / 2 / preload))


#: A preload is looked for between these multiples of the nominal one, by so many halvings.
LEAST, MOST, HALVINGS = 1e-3, 1e2, 40
#: Screws that could be this one: a power of two, as Sobol' points want.
SAMPLES = 512
#: With fewer samples that could have the torque, nothing is said.
LEAST_POSSIBLE = 16


@renamed_keyword("uncertain", "distributions")
@accepts_units("service")
def preload_of_torque(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    torque: Torque,
    screw_speed: AngularSpeed,
    temperature: Temperature | None = None,
    torque_deviation: Torque = 0.0,
    distributions: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    seed: int = 0,
) -> PreloadEstimate:
    """Preload, N, of a nut that loses this torque without load at a speed: the median, and its interval.

    Returns a :class:`~ballscrew.evidence.service.diagnostics.PreloadEstimate` of the ``screw`` by the ``model``
    with its ``lubricant``. ``torque`` (N m) and ``screw_speed`` (rad/s) are one positive number each. ``distributions``
    are the distributions of the numbers of the model, by default those of ``data/uncertainties.toml``, and ``joint``
    those among them that a calibration left correlated; ``seed`` is that of the samples.

    For :data:`SAMPLES` samples of the numbers of the model, of the oil temperature (2 K either way where
    ``temperature`` is given in K, otherwise 10 K) and of the reading (``torque_deviation``, its standard deviation in
    N m) the preload is solved for; numbers with which no preload gives the torque are not those of this screw, and left
    out.

    Raises :class:`~ballscrew.basis.errors.InputError` for a nut without preload or with elastic bodies, a torque or a
    speed that is not positive, and a torque that no preload gives.
    """
    from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence  # loads xarray

    subject = with_preload(Configuration(model, screw, lubricant))
    for name, value in {"torque": torque, "screw_speed": screw_speed}.items():
        raise_if_any([Fault(f"service.{name}", "must be positive", f"{value:g}")] if not value > 0 else [])
    if not torque_deviation >= 0:
        raise InputError(Fault("service.torque_deviation", "must not be negative", f"{torque_deviation:g}"))
    oil = lubricant if temperature is None else lubricant.at(temperature)
    known = held_numbers(subject, distributions)
    together = () if joint is None else joint.names
    sampler = Sampler(subject, {n: one for n, one in known.items() if n not in together}, {}, (), joint)
    shares = sobol_sequence(len(sampler.names) + 2, SAMPLES, seed)
    values = {name: drawn for name, drawn in sampler.inputs_at(shares[2:]).items() if name in known}
    deviation = (LOGGED_TEMPERATURE if temperature is not None else UNKNOWN_TEMPERATURE) / NORMAL_95
    scores = np.asarray(standard_normal_quantile(shares[:2]))
    warmer, wanted = deviation * scores[0], torque + torque_deviation * scores[1]
    points = {"axial_load": np.zeros(SAMPLES), "screw_speed": np.full(SAMPLES, float(screw_speed))}
    if oil.follows_temperature:
        points[TEMPERATURE.name] = np.full(SAMPLES, oil.temperature, dtype=float)
    nominal = float(subject.value_of(PRELOAD) or math.nan)

    def torques(logarithm: Vector) -> Vector:
        there = subject.changed({**values, PRELOAD: nominal * np.exp(logarithm)})
        return torque_of_model(there, points, np.array([[0.0], [1.0]]), warmer)

    low, high = np.full(SAMPLES, math.log(LEAST)), np.full(SAMPLES, math.log(MOST))
    least, most = torques(low), torques(high)
    possible = (least < wanted) & (wanted < most)
    if np.count_nonzero(possible) < LEAST_POSSIBLE:
        without, much = float(np.nanmedian(least)), float(np.nanmedian(most))
        problem = (
            f"no preload gives it: the nut loses {units.to_significant(without, 3)} N m without any, "
            f"{units.to_significant(much, 3)} N m at {units.to_significant(MOST, 6)} times it"
        )
        remedy = "look at the unit, and at the seals in [losses]"
        raise InputError(Fault("service.torque", problem, f"{torque:.4g} N m", remedy))
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        above = torques(middle) > wanted
        low, high = np.where(above, low, middle), np.where(above, middle, high)
    logarithms = ((low + high) / 2)[possible]
    even = np.full(logarithms.size, 1 / logarithms.size)
    # a kernel of a width that Silverman's rule gives stands for what lies between samples
    width = float(np.std(logarithms)) * logarithms.size ** (-1 / 5) / 2
    unknowns = {"temperature": warmer, "reading": wanted if torque_deviation else np.zeros(SAMPLES), **values}
    return PreloadEstimate(
        logarithm=Mixture(even, math.log(nominal) + logarithms, np.full(logarithms.size, width**2)),
        shares={name: _share(drawn[possible], logarithms) for name, drawn in unknowns.items()},
        temperature=None if temperature is None else float(temperature),
    )


def _share(drawn: Vector, logarithms: Vector) -> float:
    """The share of the variance that goes with an input: the square of the correlation of their ranks."""
    if np.ptp(drawn) == 0:
        return 0.0
    ranks = [np.argsort(np.argsort(one)) for one in (drawn, logarithms)]
    return float(np.corrcoef(ranks[0], ranks[1])[0, 1] ** 2)
