"""``hand_over``: a model with its screw and oil, as files for another program."""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, accepts_units, nearest, raise_if_any, si_value
from ballscrew.basis.quantities import Quantity, within_bounds
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.exports.export import Export, Option, refusal, target
from ballscrew.exports.subject import ANY_TEMPERATURE, OUTPUTS, PRELOADS, TEMPERATURE, HandOver, Input, usual_range
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.validity import LARGEST_PRESSURE

#: Speeds of tables and fits, rad/s: both directions up to 2865 rpm, where most ball screws stop.
SPEEDS = (-300.0, 300.0)
#: Temperatures of tables and fits, K: 10 °C to 80 °C.
TEMPERATURES = (283.15, 353.15)
#: Preload and parameters of tables and fits, as shares of their value in the case.
SHARES = (0.5, 1.5)
#: Loads among which the largest is looked for, N, and how many more between two of them.
_LOADS, _BETWEEN = np.geomspace(1.0, 1e7, 15), 16


@accepts_units("hand_over")
def hand_over(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    to: str = "c",
    *,
    ranges: Mapping[str, tuple[float, float]] | None = None,
    parameters: Sequence[str] = (),
    outputs: Sequence[str] = (),
    derivatives: Sequence[str] = (),
    **options: Any,
) -> Export:
    """Hand a model over to another program: the files of a target, their range, and their worst error.

    Returns an :class:`~ballscrew.exports.export.Export` of ``model`` on ``screw`` with ``lubricant`` for the target
    ``to``, one of :data:`~ballscrew.exports.export.TARGETS`.

    The inputs of every export are ``axial_load``, ``screw_speed`` and ``temperature`` with their signs and in SI, the
    ``preload`` of a nut that has one, and the ``parameters`` named, which may be any inputs of a sweep, such as
    ``friction.boundary_friction_coefficient``. All else is as given here. The outputs are ``screw_torque``,
    ``drive_torque``, ``ideal_torque``, ``holding_torque``, ``friction_power``, further ``outputs`` named as those of a
    sweep, their ``derivatives`` by some inputs, and ``valid``.

    A target that is the model itself computes it within the bounds of the model. A table or a fit is made over
    ``ranges``, of inputs by name in SI; by default loads up to where the contacts yield (4.2 GPa, ISO76), 300 rad/s
    either way, 283.15 K to 353.15 K, and half to one and a half times each other value. Beyond its range an export
    takes the nearest value, and its ``valid`` is 0. ``options`` are choices of the target.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown targets, names and options, bad ranges, and a model
    that the target cannot take, with what to do instead.
    """
    job = export_job(
        model,
        screw,
        lubricant,
        to,
        ranges=ranges,
        parameters=parameters,
        outputs=outputs,
        derivatives=derivatives,
        **options,
    )
    return target(to).export(job)


def export_job(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    to: str,
    *,
    ranges: Mapping[str, tuple[float, float]] | None = None,
    parameters: Sequence[str] = (),
    outputs: Sequence[str] = (),
    derivatives: Sequence[str] = (),
    **options: Any,
) -> HandOver:
    """The job that :func:`hand_over` gives to the function of a target."""
    known = target(to).options
    subject = Configuration(model, screw, lubricant)
    of_nut = known_outputs(subject.nut)
    faults = [Fault(f"hand_over.{n}", "unknown option", "", nearest(n, known)) for n in options if n not in known]
    faults += _unknown("parameters", "unknown input", parameters, subject.inputs)
    raise_if_any([*faults, *_unknown("outputs", "unknown output", outputs, of_nut)])
    inputs = _inputs(subject, parameters, ranges or {})
    raise_if_any(_unknown("derivatives", "is no input", derivatives, [entry.name for entry in inputs]))
    return HandOver(
        subject,
        inputs,
        tuple(of_nut[name] for name in dict.fromkeys([*OUTPUTS, *outputs])),
        tuple(dict.fromkeys(derivatives)),
        {name: _option(name, entry, options.get(name, entry.default)) for name, entry in known.items()},
        frozenset(ranges or ()),
    )


def _unknown(where: str, problem: str, names: Iterable[str], known: Collection[str]) -> list[Fault]:
    """A fault for each name that is not known."""
    return [Fault(f"hand_over.{where}", problem, name, nearest(name, known)) for name in names if name not in known]


def _option(name: str, option: Option, value: Any) -> Any:
    """The value of a choice, of the type of its usual one."""
    value = si_value(f"hand_over.{name}", value, None if option.quantity is None else option.quantity.unit)
    kind = type(option.default)
    if kind is float and isinstance(value, int | np.floating) and not isinstance(value, bool):
        value = float(value)
    if type(value) is not kind:
        raise refusal(name, f"must be a {kind.__name__}", repr(value), option.meaning)
    missing = kind is float and np.isnan(value) and np.isnan(option.default)
    if kind is float and not np.isfinite(value) and not missing:
        raise refusal(name, "must be a finite number", f"{value:g}", option.meaning)
    if option.positive and not value > 0:
        unit = "" if option.quantity is None else option.quantity.unit
        raise refusal(name, "must be positive", f"{value:g} {unit}".strip(), option.positive)
    return value


def _inputs(
    subject: Configuration, parameters: Sequence[str], ranges: Mapping[str, tuple[float, float]]
) -> tuple[Input, ...]:
    """The inputs of an export, each with its bounds and its range."""
    known = subject.inputs
    names = [*OPERATION[:2], TEMPERATURE]
    names += [n for n in PRELOADS if n in known and subject.value_of(n) is not None]
    names = list(dict.fromkeys([*names, *(n.removeprefix("nut.") for n in parameters)]))
    raise_if_any(_unknown("ranges", "is no input", ranges, names))
    return tuple(_input(subject, name, ranges.get(name)) for name in names)


def _input(subject: Configuration, name: str, asked: tuple[float, float] | None) -> Input:
    fixed = name == TEMPERATURE and name not in subject.inputs
    quantity = ANY_TEMPERATURE if fixed else subject.inputs[name][1]
    value = 0.0 if name in OPERATION else 313.15 if fixed else subject.value_of(name)
    if value is None or np.ndim(value):
        raise refusal(name, "must have one value", "", "give it in the case")
    bounds = usual_range(quantity)
    return Input(name, quantity, float(value), bounds, _range(subject, name, quantity, float(value), bounds, asked))


def _range(
    subject: Configuration,
    name: str,
    quantity: Quantity,
    value: float,
    bounds: tuple[float, float],
    asked: tuple[float, float] | None,
) -> tuple[float, float]:
    """The range asked for, or the usual one, within the bounds."""
    if asked is not None:
        return _checked(name, quantity, asked)
    if name == OPERATION[0]:
        largest = _largest_load(subject)
        return -largest, largest
    usual = {OPERATION[1]: SPEEDS, TEMPERATURE: TEMPERATURES}
    least, greatest = usual.get(name, (min(s * value for s in SHARES), max(s * value for s in SHARES)))
    return max(least, bounds[0]), min(greatest, bounds[1])


def _checked(name: str, quantity: Quantity, asked: tuple[float, float]) -> tuple[float, float]:
    where = f"ranges.{name}"
    ends = np.asarray(si_value(f"hand_over.{where}", asked, quantity.unit), dtype=float)
    if ends.shape != (2,) or not np.all(np.isfinite(ends)) or not ends[0] < ends[1]:
        raise refusal(where, "must be the least and the greatest value", str(asked), "such as (-5e3, 5e3)")
    if not np.all(within_bounds(quantity.info, ends)):
        raise refusal(where, "is beyond the bounds of the model", str(asked), quantity.info.hint)
    return float(ends[0]), float(ends[1])


def _largest_load(subject: Configuration) -> float:
    """The largest load at which no contact yields, to two digits and downwards."""
    loads, largest = _LOADS, float(_LOADS[-1])
    for _ in range(2):
        with np.errstate(all="ignore"):
            friction = subject.at({OPERATION[0]: loads, OPERATION[1]: np.full_like(loads, 10.0)})
        pressure = np.asarray(friction.maximum_pressure, dtype=float)
        holds = np.isfinite(pressure) & (pressure <= LARGEST_PRESSURE)
        largest = float(loads[holds][-1]) if np.any(holds) else float(loads[-1])
        following = loads[loads > largest]
        loads = np.geomspace(largest, following[0] if following.size else largest, _BETWEEN)
    digit = 10.0 ** (np.floor(np.log10(largest)) - 1)
    return float(np.floor(largest / digit) * digit)


class Request(NamedTuple):
    """All that is asked for besides the target, as text."""

    ranges: Sequence[str] = ()
    parameters: Sequence[str] = ()
    outputs: Sequence[str] = ()
    derivatives: Sequence[str] = ()
    options: Sequence[str] = ()


def check_target(name: str) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for an unknown target, with the list of them."""
    target(name)


def of_case(case: Case, to: str, request: Request) -> Export:
    """The export of a case; its provenance is that of the case.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`~ballscrew.exports.hand_over.hand_over` does, and for
    text that cannot be read.
    """
    if case.efficiency is not None:
        remedy = "take a model of friction: --model reference"
        raise InputError(Fault("model.name", "a constant efficiency has nothing to hand over", "", remedy))
    export = hand_over(
        case.model,
        case.screw,
        case.lubricant,
        to,
        ranges=_ranges(Configuration(case.model, case.screw, case.lubricant), request.ranges),
        parameters=request.parameters,
        outputs=request.outputs,
        derivatives=request.derivatives,
        **{**target(to).options_of_case(case), **_options(to, request.options)},
    )
    return dataclasses.replace(export, provenance={**export.provenance, **descriptions.of_case(case)})


def _split(where: str, texts: Sequence[str], example: str) -> dict[str, str]:
    """``name=value`` as a dictionary."""
    raise_if_any(
        [Fault(where, "needs a name and a value", text, f"write {example}") for text in texts if "=" not in text]
    )
    return {name.strip(): value.strip() for name, _, value in (text.partition("=") for text in texts)}


def _ranges(subject: Configuration, texts: Sequence[str]) -> dict[str, tuple[float, float]]:
    # the temperature is an input of every export, also where the oil is given by its numbers
    known = {name: quantity for name, (_, quantity) in subject.inputs.items()}
    known.setdefault(TEMPERATURE, ANY_TEMPERATURE)
    ranges, faults = dict[str, tuple[float, float]](), list[Fault]()
    for name, text in _split("--range", texts, 'axial_load="-5:5 kN"').items():
        where = f"--range {name}"
        least, colon, greatest = (part.strip().strip("\"'") for part in text.partition(":"))
        if name not in known or not colon:
            remedy = 'write axial_load="-5:5 kN"' if name in known else nearest(name, known)
            faults.append(Fault(where, "is no range" if name in known else "unknown input", text, remedy))
            continue
        quantity = known[name]
        if not units.unit_in(least):  # the unit of the end is that of the beginning
            least = f"{least} {units.unit_in(greatest)}".strip()
        ends = [units.parse(where, end, quantity) for end in (least, greatest)]
        faults += [end for end in ends if isinstance(end, Fault)]
        if not any(isinstance(end, Fault) for end in ends):
            ranges[name.removeprefix("nut.")] = (ends[0], ends[1])  # pyright: ignore[reportArgumentType]  (neither is a Fault)
    raise_if_any(faults)
    return ranges


def _options(to: str, texts: Sequence[str]) -> dict[str, Any]:
    known, options, faults = target(to).options, dict[str, Any](), list[Fault]()
    for name, text in _split("--option", texts, "name=value").items():
        where = f"--option {name}"
        value = (
            Fault(where, "unknown option", "", nearest(name, known))
            if name not in known
            else _value(where, text, known[name])
        )
        faults += [value] if isinstance(value, Fault) else []
        options[name] = value
    raise_if_any(faults)
    return options


def _value(where: str, text: str, option: Option) -> Any | Fault:
    """The value of a choice, of the type of its usual one."""
    if isinstance(option.default, str):
        return text
    if isinstance(option.default, bool):
        words: Mapping[str, bool] = {"true": True, "yes": True, "false": False, "no": False}
        return words.get(text.lower(), Fault(where, "must be yes or no", text, option.meaning))
    if option.quantity is not None:
        return units.parse(where, text, option.quantity)
    try:
        return type(option.default)(text)
    except ValueError:
        return Fault(where, "must be a number", text, option.meaning)
