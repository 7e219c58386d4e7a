"""The fit of a moving log: mass, gravity, dead time, and friction by three models, with intervals that hold."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, accepts_units, raise_if_any, spoken
from ballscrew.basis.quantities import Force, Info, Quantity, Ratio, Unit, quantities_of
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.moving_logs.equation import AT_REST, DeadTime, Equation, dead_time, relative_error
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.power_law import PowerLaw, power_law
from ballscrew.evidence.moving_logs.screw_model import (
    NAMES,
    LinearModel,
    ScrewFriction,
    ScrewModelFit,
    fit_screw_model,
    linear_model,
    unit_change,
)
from ballscrew.files.torque_logs.log_rows import Time
from ballscrew.files.torque_logs.motion import Floats
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

#: The models, in the order of what they know.
LINEAR, POWER, SCREW = "coulomb-viscous", "power-law", "screw"
#: What is fitted of the screw's model by default: the scale of its friction over speed.
DEFAULT_FREE = ("viscosity",)
#: What is fitted as well where the preload of the case is too much.
PRELOAD = "nut.preload"
#: The filtered rows of a period are hardly independent: a fit needs so many periods for each number.
PERIODS_PER_NUMBER = 4
#: Factors of both cutoffs under which the linear model is fitted again.
FILTER_FACTORS = (0.5, 2.0)
#: The screw's model does not fit if it is so many times as far off as the linear one, which it holds as a special case.
WORSE = 1.02
#: An error of the table of friction that is said, as a share of the largest friction.
_TABLE_ERROR = 0.02
#: The axial load of the table of friction, as a share of the force of the largest acceleration.
_LOAD_ROOM = 1.1
_REST = Quantity("rest", "m/s", Info("v", "speed that is clear of its noise", "mm/s"))
_GRAVITY = (
    "the offset is gravity and the zero error of the force together · to tell them apart, record it once more "
    "with another mass, or read the force with the motor off"
)
_NO_EXPONENT = "the speeds of the log do not tell an exponent of the speed · record strokes from slow to fast"
_PRELOAD_FREED = (
    "with the preload of the case the screw has more friction than the whole axis: the preload is fitted as well "
    "· check the preload and the size in the case, or give --free viscosity to hold it"
)
_NO_FRICTION = "the model of the screw is not fitted: the model has no friction at some speeds of the log"
_NO_MASS = (
    "the model of the screw is not fitted: the log does not tell the mass or the friction that it would be fitted to"
)
_OTHER_SIZE = "another size or oil"

Mass = Annotated[Any, Unit("kg")]
Drag = Annotated[Any, Unit("N s/m")]


@dataclasses.dataclass(frozen=True)
class _Numbers:
    """Estimates of a fit of a moving log beside the numbers of the screw's model."""

    mass: Annotated[Mass, Info("M", "moved mass, with what the rotating parts weigh at the nut, J (2π/P_h)²")]
    offset: Annotated[Force, Info("F_g", "force at rest: gravity and the zero error of the force together")]
    coulomb_force: Annotated[Force, Info("F_c", "constant friction of the linear model")]
    viscous_coefficient: Annotated[Drag, Info("f_v", "friction of the linear model for each metre per second")]
    dead_time: Annotated[Time, Info("\\tau", "time by which the motion follows the force", "ms")]
    speed_exponent: Annotated[Ratio, Info("n", "exponent of the speed in F0 + c·vⁿ")]
    constant_force: Annotated[Force, Info("F_c", "constant friction beside that of the screw's model")]
    remaining_viscous_coefficient: Annotated[
        Drag, Info("f_v", "friction for each metre per second beside that of the screw's model")
    ]
    carried_mass: Annotated[Mass, Info("m", "mass whose force passes the nut")]


QUANTITIES: Mapping[str, Quantity] = quantities_of(_Numbers)


@dataclasses.dataclass(frozen=True)
class MotionEstimate:
    """An estimate in SI with its 95 % interval; no interval where the log does not identify it, or it was given."""

    name: str
    quantity: Quantity
    #: The model that it belongs to.
    model: str
    value: float
    std: float | None
    interval: tuple[float, float] | None
    identified: bool
    at_bound: bool = False
    #: Whether it was given, and not fitted.
    given: bool = False


class FilterEffect(NamedTuple):
    """The linear model under another filter: mass, offset, Coulomb force, viscous coefficient, relative error."""

    name: str
    values: Floats
    relative_error: float


@dataclasses.dataclass(frozen=True, eq=False)
class MotionFit:
    """The fit of a moving log by three models; see :func:`fit_motion`."""

    #: Estimates by name, each with its interval.
    estimates: Mapping[str, MotionEstimate]
    #: Root mean square of the residuals over that of the force, by model; both sides filtered alike.
    relative_errors: Mapping[str, float]
    #: The same on the other log, by model, nothing fitted to it; empty without one.
    cross_errors: Mapping[str, float]
    #: Constant and viscous friction.
    linear: LinearModel
    #: A free power of the speed; None where it was not found.
    power: PowerLaw | None
    #: The friction of the model given; None where it was not fitted.
    screw: ScrewModelFit | None
    #: Time by which the motion follows the force.
    dead_time: DeadTime
    #: The linear model under other filters.
    filter_effects: Sequence[FilterEffect]
    #: The rows used, filtered: what was fitted to.
    equation: Equation
    #: The equation of the other log.
    test: Equation | None
    #: Warnings as records.
    warning_records: tuple[Record, ...]

    @property
    def model(self) -> str:
        """The screw's model, or else, where there is none or it does not fit, the linear one."""
        screw, linear = (self.relative_errors.get(name, np.inf) for name in (SCREW, LINEAR))
        return SCREW if screw <= WORSE * linear else LINEAR

    @property
    def relative_error(self) -> float:
        """The relative error of :attr:`model`."""
        return self.relative_errors[self.model]

    @property
    def cross_error(self) -> float | None:
        """The relative error of :attr:`model` on the other log."""
        return self.cross_errors.get(self.model)

    @property
    def warnings(self) -> list[str]:
        """Warnings as text."""
        return [record.text for record in self.warning_records]

    def force(self, model: str, equation: Equation | None = None) -> Floats:
        """Force of a ``model`` (``"coulomb-viscous"``, ``"power-law"``, ``"screw"``) at the rows used, N.

        The rows are those of this log, or those of the ``equation`` of another.
        """
        result = {LINEAR: self.linear, POWER: self.power, SCREW: self.screw}[model]
        assert result is not None
        return result.force(equation or self.equation)


@accepts_units("fit_motion")
def fit_motion(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    data: Any,
    free: Sequence[str] | None = None,
    *,
    carried_mass: Annotated[float | None, Unit("kg")] = None,
    test: Any = None,
    keep_going: bool = False,
    seed: int = 0,
) -> MotionFit:
    """Fit a recorded motion of an axis: mass, gravity, dead time and friction.

    Returns a :class:`MotionFit`. ``model``, ``screw`` and ``lubricant`` are those of the axis, with the values from
    which the fit starts. ``data`` is a :class:`~ballscrew.evidence.moving_logs.moving_log.MovingLog`, or a mapping of
    arrays in SI: ``time``, ``position`` (or ``speed``) of the nut, and ``force`` of the motor at the nut (or its
    ``torque`` at the screw). The friction is fitted three times: constant and viscous
    (:mod:`~ballscrew.evidence.moving_logs.screw_model`, the inverse dynamic model of JanotGautierBrunot2019), a free
    power of the speed (:mod:`~ballscrew.evidence.moving_logs.power_law`), and the friction of the model given, whose
    numbers ``free`` names as :func:`~ballscrew.evidence.calibration.fit.fit` does, with a constant and a viscous part
    beside it (:mod:`~ballscrew.evidence.moving_logs.screw_model`). By default the viscosity is free; where the screw
    then has more friction than the whole axis, its preload as well, which is said.

    ``carried_mass`` (kg) is the mass whose force passes the nut; without it, it is fitted. ``test`` is another log of
    the same axis, to which nothing is fitted. ``keep_going`` uses the longest stretch without a fault. ``seed`` is that
    of the resampled logs.

    Intervals are of 95 % and hold for residuals that follow each other
    (:mod:`~ballscrew.evidence.moving_logs.equation`). They do not hold the friction that no model has: of the
    position along the screw, of temperature, of rest.

    Raises :class:`~ballscrew.basis.errors.InputError` for logs that cannot be used, with the row and the remedy, for a
    force of the wrong sign, and for unknown names.
    """
    raise_if_any(_faults(free, carried_mass, seed))
    asked = DEFAULT_FREE if free is None else free
    subject = Configuration(model, screw, lubricant)
    log = _log_of(data, screw).checked(keep_going=keep_going)
    first = _equation(log)
    delay, equation = dead_time(first)
    linear = linear_model(equation)
    name = log.source[0] if log.source else "log"
    if linear.identified[0] and linear.values[0] < 0:
        remedy = "turn the sign of the force or of the position: a positive force drives towards positive positions"
        raise InputError(
            Fault(name, "the force has the sign against the acceleration", f"{linear.values[0]:.4g} kg", remedy)
        )
    _check_mass(name, linear)
    power = power_law(equation, seed=seed)
    warnings = [*linear.warnings, *_remarks(power)]
    found_screw = None
    if all(linear.identified[place] for place in (0, 2)):
        friction = _screw_friction(subject, asked, equation, linear, carried_mass)
        found_screw = fit_screw_model(equation, friction, linear.solution, carried_mass)
        if free is None and PRELOAD in subject.inputs and _is_off(found_screw, linear):
            asked = (*asked, PRELOAD)
            friction = _screw_friction(subject, asked, equation, linear, carried_mass)
            found_screw = fit_screw_model(equation, friction, linear.solution, carried_mass)
            warnings.append(Record.warning("fit.preload_freed", PRELOAD, _PRELOAD_FREED))
        if found_screw is None:
            warnings.append(Record.warning("fit.no_screw_model", "screw", _NO_FRICTION))
    else:
        _screw_friction(subject, asked, equation, linear, carried_mass)  # names that are wrong are faults in any case
        warnings.append(Record.warning("fit.no_screw_model", "screw", _NO_MASS))
    errors = {LINEAR: linear.relative_error}
    if power is not None:
        errors[POWER] = power.relative_error
    if found_screw is not None:
        errors[SCREW] = found_screw.relative_error
        warnings += _of_screw(found_screw, linear, asked)
    estimates = _estimates(linear, power, found_screw, delay, carried_mass)
    warnings += _unidentified(estimates)
    motion_fit = MotionFit(
        estimates,
        errors,
        {},
        linear,
        power,
        found_screw,
        delay,
        _filter_effects(equation),
        equation,
        None,
        tuple(warnings),
    )
    if test is None:
        return motion_fit
    other = _equation(
        _log_of(test, screw).checked(keep_going=keep_going),
        cutoff=equation.cutoff,
        path_cutoff=equation.kinematics.cutoff,
        shift=equation.shift,
    )
    crossed = {name: relative_error(motion_fit.force(name, other) - other.force, other.force) for name in errors}
    return dataclasses.replace(motion_fit, cross_errors=crossed, test=other)


def _check_mass(name: str, linear: LinearModel) -> None:
    """Raise for a log that does not tell the mass, whose estimate is then none of a mass."""
    mass, half = float(linear.values[0]), float(linear.solution.half_width()[0])
    if mass <= 0:
        problem = "does not tell the mass"
        if np.isfinite(half):
            problem += f": by its accelerations it is {mass - half:.3g} to {mass + half:.3g} kg"
        remedy = "record more rows a second, or steeper ramps; the friction alone is that of rows at constant speed"
        raise InputError(Fault(name, problem, f"{mass:.3g} kg", remedy))


def _faults(free: Any, carried_mass: Any, seed: Any) -> list[Fault]:
    faults: list[Fault] = []
    if free is not None and (isinstance(free, str) or not len(free)):
        faults.append(Fault("fit.free", "must be a list of names", str(free), 'free=["viscosity"]'))
    if carried_mass is not None and not (isinstance(carried_mass, int | float) and carried_mass >= 0):
        faults.append(Fault("fit.carried_mass", "must not be negative", str(carried_mass), "give a mass in kg"))
    if not isinstance(seed, int) or seed < 0:
        faults.append(Fault("fit.seed", "must be a whole number, 0 or more", str(seed)))
    return faults


def _log_of(data: Any, screw: BallScrew) -> MovingLog:
    """A log from what is given; a torque at the screw as the force at the nut that it is without friction."""
    if not isinstance(data, MovingLog) and "force" not in data and "torque" in data:
        data = {**data, "force": np.asarray(data["torque"], dtype=np.float64) * 2 * np.pi / float(screw.lead)}
    return MovingLog.of(data)


def _equation(log: MovingLog, **options: float) -> Equation:
    """The equation of a log; raises for one that hardly moves above its noise, or changes a unit midway."""
    equation = Equation.of(log, **options)
    name = log.source[0] if log.source else "log"
    needed = PERIODS_PER_NUMBER * len(NAMES)
    if equation.periods < needed:
        rest = units.shown(equation.rest, _REST, 3)
        cutoff = units.in_unit(equation.cutoff, "Hz", 2)
        problem = (
            f"moves too little above its noise: {len(log) - equation.left_out.get(AT_REST, 0)} of {len(log)} rows "
            f"are faster than {rest}, which is {units.fixed(equation.periods, 1)} periods of the filter that the "
            f"noise asks for ({cutoff}), and a fit needs {needed}"
        )
        remedy = "record more rows a second, or longer strokes in both directions"
        raise InputError(Fault(name, problem, "", remedy))
    fault = unit_change(equation, name)
    raise_if_any([fault] if fault is not None else [])
    return equation


def _screw_friction(
    subject: Configuration, free: Sequence[str], equation: Equation, linear: LinearModel, carried_mass: float | None
) -> ScrewFriction:
    carried = abs(float(linear.values[0])) if carried_mass is None else carried_mass
    largest = carried * float(np.max(np.abs(equation.acceleration))) + abs(float(linear.values[1]))
    return ScrewFriction.of(subject, free, float(np.max(np.abs(equation.speed))), _LOAD_ROOM * largest)


def _filter_effects(equation: Equation) -> list[FilterEffect]:
    """The linear model under other cutoffs, and with the dead time left in where it was taken off."""
    own = {"cutoff": equation.cutoff, "path_cutoff": equation.kinematics.cutoff, "shift": equation.shift}
    changes = {
        f"{side} at {factor:g} × the cutoff": {name: factor * own[name]}
        for name, side in (("cutoff", "both sides"), ("path_cutoff", "position"))
        for factor in FILTER_FACTORS
    }
    if equation.shift:
        changes["dead time left in"] = {"shift": 0.0}
    filter_effects: list[FilterEffect] = []
    for name, change in changes.items():
        again = Equation.of(equation.log, **{**own, **change})
        if again.used.size < PERIODS_PER_NUMBER * len(NAMES):  # that filter leaves nothing to fit to
            continue
        linear = linear_model(again)
        filter_effects.append(FilterEffect(name, linear.values, linear.relative_error))
    return filter_effects


def _estimates(
    linear: LinearModel, power: PowerLaw | None, screw: ScrewModelFit | None, delay: DeadTime, carried: float | None
) -> dict[str, MotionEstimate]:
    errors, widths = linear.solution.errors, linear.solution.half_width()
    estimates: dict[str, MotionEstimate] = {}

    def add(name: str, model: str, value: float, std: float, half: float, **told: Any) -> None:
        quantity = told.pop("quantity", None) or QUANTITIES[name]
        known = bool(np.isfinite(half))
        low, high = value - half, value + half
        if known and told.pop("positive", False):
            low = max(low, 0.0)
        told.pop("positive", None)
        estimates[name] = MotionEstimate(
            name, quantity, model, value, std if known else None, (low, high) if known else None, known, **told
        )

    for place, name in enumerate(NAMES):
        known = linear.identified[place]
        half = float(widths[place]) if known else np.nan
        add(name, LINEAR, float(linear.values[place]), float(errors[place]), half)
    add("dead_time", LINEAR, delay.value, delay.half_width / 2, delay.half_width)
    if power is not None:
        low, high = power.interval
        std = (power.bootstrap[1] - power.bootstrap[0]) / 4
        estimates["speed_exponent"] = MotionEstimate(
            "speed_exponent",
            QUANTITIES["speed_exponent"],
            POWER,
            power.exponent,
            std,
            (low, high),
            bool(np.isfinite([low, high]).all()),
        )
    if screw is not None:
        values = [screw.constant_force, screw.viscous_coefficient, *screw.numbers.tolist(), screw.carried_mass]
        asked = screw.friction.asked
        names = ["constant_force", "remaining_viscous_coefficient", *asked, "carried_mass"]
        quantities = [None, None, *screw.friction.quantities, None]
        for place, (name, value, quantity) in enumerate(zip(names, values, quantities, strict=True), start=2):
            given = name == "carried_mass" and carried is not None
            add(
                name,
                SCREW,
                float(value),
                float(screw.errors[place]),
                float(screw.half_widths[place]),
                quantity=quantity,
                at_bound=bool(screw.at_bound[place]),
                given=given,
                positive=True,
            )
    return estimates


def _remarks(power: PowerLaw | None) -> list[Record]:
    remarks = [Record("fit.gravity_or_offset", "offset", _GRAVITY, holds=False)]
    if power is None:
        remarks.append(Record.warning("fit.no_exponent", "speed_exponent", _NO_EXPONENT))
    return remarks


def _is_off(screw: ScrewModelFit | None, linear: LinearModel) -> bool:
    """Test whether the screw's model does not fit."""
    return screw is not None and screw.relative_error > WORSE * linear.relative_error


def _of_screw(screw: ScrewModelFit, linear: LinearModel, free: Sequence[str]) -> list[Record]:
    """Warnings about a screw's model that does not fit, or whose table is coarse."""
    records: list[Record] = []
    if _is_off(screw, linear):
        preload = PRELOAD in screw.friction.subject.inputs and PRELOAD not in screw.friction.names
        remedy = f"--free {','.join([*free, PRELOAD])}" if preload else _OTHER_SIZE
        off = units.percent(screw.relative_error, 1)
        message = (
            f"the screw's model does not fit: it is off by {off}, the linear one by "
            f"{units.percent(linear.relative_error, 1)} · the screw of the case has more friction than the whole "
            f"axis: try {remedy}"
        )
        records.append(Record.warning("fit.screw_model_off", "screw", message))
    if screw.table_error > _TABLE_ERROR:
        error = units.percent(screw.table_error, 1)
        text = f"the table of the screw's friction is off by up to {error} of the largest friction"
        records.append(Record.warning("fit.table_error", "screw", text))
    return records


def _unidentified(estimates: Mapping[str, MotionEstimate]) -> list[Record]:
    """Warning of the numbers of the screw's model that the log does not identify, in one record."""
    names = [e.name for e in estimates.values() if e.model == SCREW and not (e.identified or e.at_bound or e.given)]
    if not names:
        return []
    text = (
        f"the log does not tell by itself: {', '.join(map(spoken, names))} · free fewer numbers, or give what is known"
    )
    return [Record.warning("fit.not_identified", ",".join(names), text)]
