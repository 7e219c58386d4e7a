"""A request of the command line: a case handed over, with ranges and options as people write them."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.cases.case_files import provenance
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.exports.export import Export, Option
from ballscrew.exports.hand_over import hand_over
from ballscrew.exports.subject import ANY_TEMPERATURE, TEMPERATURE
from ballscrew.exports.targets import target


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
    return dataclasses.replace(export, provenance={**export.provenance, **provenance.of_case(case)})


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
