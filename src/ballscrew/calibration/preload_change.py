"""The preload of a nut then and now: from two logs of its torque, from one log, or from one torque without load."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from ballscrew.calibration.calibrated_model import CalibratedModel
from ballscrew.calibration.fit import fit
from ballscrew.calibration.preload_alternatives import VISCOSITY, Alternative, alternatives
from ballscrew.calibration.preload_diagnostics import warning_records
from ballscrew.calibration.preload_estimate import (
    LOGGED_TEMPERATURE,
    ONE_DEVIATION,
    PRELOAD,
    UNKNOWN_TEMPERATURE,
    PreloadEstimate,
    combined,
    of_log,
    torque_of_model,
)
from ballscrew.components.materials import TEMPERATURE, Lubricant
from ballscrew.components.screw import BallScrew
from ballscrew.errors import Fault, InputError, accepts_units, raise_if_any
from ballscrew.evaluation.outputs import OPERATION
from ballscrew.evaluation.plan import Configuration
from ballscrew.friction.model import FrictionModel
from ballscrew.quantities import AngularSpeed, Force, MomentOfInertia, Temperature, Torque
from ballscrew.records import Record
from ballscrew.torque_logs.log_rows import Kind
from ballscrew.torque_logs.torque_log import TorqueLog
from ballscrew.uncertainty.default_uncertainties import NORMAL_95, default_distributions
from ballscrew.uncertainty.distributions import Distribution, LogNormal, normal_half_width, standard_normal_share

if TYPE_CHECKING:
    from ballscrew.uncertainty.sampling import JointNormal

Verdict = Literal["lost", "kept", "open"]
#: A preload is called lost, or kept, with this probability.
CERTAIN = 0.95
#: A preload of a torque is looked for between these multiples of the nominal one.
LEAST, MOST = 1e-3, 1e2
_STEP = 1e-3


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class PreloadChange:
    """Result of :func:`preload_change`."""

    new: PreloadEstimate
    worn: PreloadEstimate
    #: Standard deviation of the logarithm of the ratio: errors that both preloads share have gone from it.
    ratio_deviation: float
    #: By input, the effect of one standard deviation on the logarithm of the ratio.
    ratio_effects: Mapping[str, float]
    #: The loss that is put up with, as a share of the preload.
    tolerance: float
    #: Other causes, had the preload stayed as it was.
    alternatives: Sequence[Alternative]
    warning_records: Sequence[Record] = ()

    @property
    def ratio(self) -> float:
        """The preload left, as a share of the preload before."""
        return float(self.worn.preload / self.new.preload)

    def ratio_interval(self, level: float = 0.95) -> tuple[float, float]:
        """The interval of the ratio; NaN where one of the preloads is not told."""
        factor = math.exp(normal_half_width(level) * self.ratio_deviation)
        return self.ratio / factor, self.ratio * factor

    @property
    def probability_of_loss(self) -> float:
        """Probability that less than 1 − tolerance of the preload is left; NaN where one of them is not told."""
        distance = math.log(max(self.ratio, 1e-300)) - math.log(1 - self.tolerance)
        if not math.isfinite(self.ratio_deviation):
            return math.nan
        if self.ratio_deviation == 0:
            return float(distance < 0)
        return standard_normal_share(-distance / self.ratio_deviation)

    @property
    def verdict(self) -> Verdict:
        """``"lost"`` or ``"kept"`` where that has a probability of :data:`CERTAIN`, otherwise ``"open"``."""
        probability = self.probability_of_loss
        return "lost" if probability >= CERTAIN else "kept" if probability <= 1 - CERTAIN else "open"

    @property
    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return [record.text for record in self.warning_records]


@accepts_units("service")
def preload_change(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    new: Any,
    worn: Any,
    *,
    free: Sequence[str] = (PRELOAD,),
    uncertain: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
    tolerance: float = 0.1,
    kind: Kind = "unknown",
    inertia: MomentOfInertia | None = None,
    dynamic_load_rating: Force | None = None,
    done: Callable[[int, int], None] | None = None,
) -> PreloadChange:
    """Preload of a nut in a log of its torque when new and in one when worn, N, and the share that is left.

    ``new`` and ``worn`` are logs as :func:`~ballscrew.calibration.fit.fit` takes them; None for ``new`` stands for the
    nominal preload of the screw with its tolerance. ``free`` is fitted to each log, ``nut.preload`` among it. Where a
    log has temperatures and the oil a grade, the viscosity of each row follows; where not, the viscosity is fitted,
    too, with a prior of 10 K either way: a hotter oil then shows in how the torque goes with the speed, or makes the
    interval wider.

    ``uncertain`` are the distributions of the numbers that are held (of a case by default: see
    ``data/uncertainties.toml``), ``joint`` those among them that a calibration left correlated. They are off by the
    same in both logs, so that in the ratio only the difference of their effects counts. Each log has for itself the
    scatter of its rows, the zero error of its sensor, and its temperature (2 K either way).

    Preloads and ratio are log-normal. ``tolerance`` is the share of the preload that may be lost;
    ``dynamic_load_rating`` (N) is what the preload is judged by.

    Raises :class:`~ballscrew.errors.InputError` for a nut without preload, balls that differ, a tolerance out of
    (0, 1), one log given twice, and all that a fit raises.
    """
    subject = _with_preload(Configuration(model, screw, lubricant))
    raise_if_any(_faults_of_options(free, tolerance))
    known = _held_numbers(subject, uncertain)
    logs = [None if data is None else TorqueLog.of(data) for data in (new, worn)]
    sources = [None if log is None else log.source for log in logs]
    if sources[0] is not None and sources[1] is not None and sources[0][1] == sources[1][1]:
        remedy = "give the log of the new screw and that of the worn one"
        raise InputError(Fault("service", "both logs are the same file", sources[1][0], remedy))
    estimates = [
        _nominal(subject, uncertain)
        if log is None
        else _estimate(subject, log, label, free, known, joint, kind, inertia, done)
        for log, label in zip(logs, ("new", "worn"), strict=True)
    ]
    then, now = estimates
    effects = {name: now.common.get(name, 0.0) - then.common.get(name, 0.0) for name in {**then.common, **now.common}}
    deviation = math.hypot(then.own_deviation, now.own_deviation, combined(effects, known, joint))
    told = math.isfinite(deviation) and now.fit is not None
    other = alternatives(now.fit, then.preload, known) if told and now.fit is not None else []
    found = PreloadChange(
        new=then, worn=now, ratio_deviation=deviation, ratio_effects=effects, tolerance=tolerance, alternatives=other
    )
    records = warning_records(found.new, found.worn, subject, dynamic_load_rating)
    return dataclasses.replace(found, warning_records=tuple(records))


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
    uncertain: Mapping[str, Distribution] | None = None,
    joint: JointNormal | None = None,
) -> PreloadEstimate:
    """Preload, N, of a nut that loses this torque (N m) without load at a speed (rad/s).

    The error has that of the reading (``torque_deviation``, its standard deviation), that of the oil temperature (2 K
    either way where ``temperature`` is given in K, otherwise 10 K), and those of the numbers of the model, as in
    :func:`preload_change`.

    Raises :class:`~ballscrew.errors.InputError` for a nut without preload, and for a torque that no preload gives.
    """
    subject = _with_preload(Configuration(model, screw, lubricant))
    oil = lubricant if temperature is None else lubricant.at(temperature)
    given = {"torque": torque, "screw_speed": screw_speed}
    raise_if_any(
        [
            Fault(f"service.{name}", "must be positive", f"{value:g}", "give its magnitude")
            for name, value in given.items()
            if not value > 0
        ]
    )
    if not torque_deviation >= 0:
        raise InputError(Fault("service.torque_deviation", "must not be negative", f"{torque_deviation:g}"))
    graded = oil.grade is not None
    points = {"axial_load": np.zeros(1), "screw_speed": np.array([float(screw_speed)])}
    if graded:
        points[TEMPERATURE.name] = np.array([float(oil.temperature)])
    weights = np.array([[0.0], [1.0]])

    def torque_at(logarithm: float, one: Configuration = subject, warmer: float = 0.0) -> float:
        preload = float(subject.value_of(PRELOAD)) * math.exp(logarithm)
        return float(torque_of_model(one.changed({PRELOAD: preload}), points, weights, warmer)[0])

    x = _solved(torque_at, float(torque))
    slope = (torque_at(x + _STEP) - torque_at(x - _STEP)) / (2 * _STEP)

    def effect(low: float, high: float) -> float:
        return -(high - low) / 2 / slope

    known = _held_numbers(subject, uncertain)
    own: dict[str, float] = {}
    if graded:
        usual = (UNKNOWN_TEMPERATURE if temperature is None else LOGGED_TEMPERATURE) / NORMAL_95
        own[TEMPERATURE.name] = effect(*(torque_at(x, subject, sign * usual) for sign in (-1, 1)))
    common: dict[str, float] = {}
    for name, distribution in known.items():
        ends = (float(distribution.quantile(share)) for share in ONE_DEVIATION)
        common[name] = effect(*(torque_at(x, subject.changed({name: value})) for value in ends))
    return PreloadEstimate(
        preload=float(subject.value_of(PRELOAD)) * math.exp(x),
        statistical=abs(float(torque_deviation) / slope),
        own=own,
        common=common,
        common_deviation=combined(common, known, joint),
        temperature=temperature,
    )


def _solved(torque_at: Callable[[float], float], torque: float) -> float:
    """The logarithm of the preload over the nominal one that gives a torque."""
    from scipy.optimize import brentq

    low, high = math.log(LEAST), math.log(MOST)
    least, most = torque_at(low), torque_at(high)
    if not least < torque < most:
        remedy = "look at the unit, and whether seals are in [losses]" if torque <= least else "look at the unit"
        problem = (
            f"no preload gives it: the nut loses {least:.3g} N m without any, {most:.3g} N m at {MOST:g} times its own"
        )
        raise InputError(Fault("service.torque", problem, f"{torque:.4g} N m", remedy))
    return float(brentq(lambda x: torque_at(x) - torque, low, high, xtol=1e-10, rtol=1e-12))


def _with_preload(subject: Configuration) -> Configuration:
    """The subject with a nut that is described by its preload. Raises ``InputError`` for one that has none."""
    nut: Any = subject.nut
    kind = type(nut).__name__
    remedy = 'give one: type = "double" (or "oversize", "offset") and preload = "4 kN"'
    if not hasattr(nut, "preload"):
        raise InputError(Fault("nut", "has no preload", kind, remedy))
    if nut.preload is None:
        loads = subject.model(subject.screw, subject.lubricant, axial_load=0.0, screw_speed=1.0).loads
        subject = subject.changed({PRELOAD: float(loads.remaining_preload)})
    if np.ndim(subject.value_of(PRELOAD)):
        raise InputError(Fault(PRELOAD, "is an array", "", "give one number"))
    if not float(subject.value_of(PRELOAD)) > 0:
        raise InputError(Fault("nut", "has no preload", f"{float(subject.value_of(PRELOAD)):g} N", remedy))
    return subject


def _faults_of_options(free: Sequence[str], tolerance: Any) -> list[Fault]:
    faults: list[Fault] = []
    if isinstance(free, str) or PRELOAD not in free:
        faults.append(Fault("service.free", f"must have {PRELOAD} in it", str(free), f'free=["{PRELOAD}"]'))
    elif VISCOSITY in free:
        remedy = "leave it out: it is fitted where a log has no temperature that can be used"
        faults.append(Fault("service.free", "must not have the viscosity in it", VISCOSITY, remedy))
    if not isinstance(tolerance, int | float) or not 0 < tolerance < 1:
        faults.append(Fault("service.tolerance", "must lie between 0 and 1", str(tolerance), "0.1 is usual"))
    return faults


def _held_numbers(subject: Configuration, uncertain: Mapping[str, Distribution] | None) -> dict[str, Distribution]:
    """The distributions of numbers that a fit of the preload holds; the conditions of a log are not among them."""
    if uncertain is None:
        usual = default_distributions(subject.model, subject.screw, subject.lubricant, exact={TEMPERATURE.name})
        uncertain = {name: distribution for name, (distribution, _) in usual.items()}
    conditions = {*OPERATION, TEMPERATURE.name, "preload", PRELOAD, "oversize", "nut.oversize"}
    unknown = [name for name in uncertain if name not in subject.inputs]
    raise_if_any(
        [Fault(f"service.uncertain.{name}", "unknown name", "", "name it as a sweep does") for name in unknown]
    )
    return {name: distribution for name, distribution in uncertain.items() if name not in conditions}


def _nominal(subject: Configuration, uncertain: Mapping[str, Distribution] | None) -> PreloadEstimate:
    """The preload of the case with its tolerance."""
    preload = float(subject.value_of(PRELOAD))
    given = None if uncertain is None else uncertain.get("preload", uncertain.get(PRELOAD))
    if uncertain is None:
        usual = default_distributions(subject.model, subject.screw, subject.lubricant)
        given = usual["preload"][0]
    if given is None:
        return PreloadEstimate(preload=preload, statistical=0.0)
    low, high = (float(given.quantile(share)) for share in ONE_DEVIATION)
    return PreloadEstimate(preload=preload, statistical=(high - low) / 2 / preload)


def _estimate(
    subject: Configuration,
    log: TorqueLog,
    label: str,
    free: Sequence[str],
    known: Mapping[str, Distribution],
    joint: JointNormal | None,
    kind: Kind,
    inertia: MomentOfInertia | None,
    done: Callable[[int, int], None] | None,
) -> PreloadEstimate:
    """The preload of one log. Faults name the log."""
    oil = subject.lubricant
    priors: dict[str, Distribution] = {name: known[name] for name in free if name in known}
    try:
        log = log.cleaned(inertia=inertia)
        temperature_used = oil.grade is not None and log.temperature is not None
        if not temperature_used and VISCOSITY not in free:
            free = [*free, VISCOSITY]
            share = UNKNOWN_TEMPERATURE * float(oil.temperature_coefficient) / NORMAL_95
            priors[VISCOSITY] = LogNormal(float(oil.viscosity), math.exp(share))
        found: CalibratedModel = fit(
            subject.model, subject.screw, oil, log, free, priors=priors, kind=kind, holdout=0.0, done=done
        )
    except InputError as error:
        name = label if log.source is None else log.source[0]
        raise InputError(*(dataclasses.replace(f, where=f"{name}: {f.where}") for f in error.faults)) from None
    return of_log(found, known, joint, temperature_used)
