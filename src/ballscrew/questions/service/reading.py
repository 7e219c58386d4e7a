"""A torque without load, in place of logs, as it is written."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.engine.uncertainty.distributions import Normal
from ballscrew.engine.uncertainty.uncertain_value import parse_uncertain
from ballscrew.questions.service.compute import TORQUE, Reading
from ballscrew.questions.service.question import ReadingOptions
from ballscrew.questions.shared.option_values import read


def check_question(logs: Sequence[Path], has_case: bool, written: Mapping[str, Any]) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a question that is none, or two."""
    faults: list[Fault] = []
    if not has_case:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if written["torque"] is None:
        if not logs:
            remedy = 'give NEW.csv WORN.csv, or WORN.csv alone, or --torque "0.4 N m" --speed "100 rpm"'
            faults.append(Fault("WORN", "missing", "", remedy))
        faults += [
            Fault(f"--{name}", "is for a torque without a log", written[name], "leave it out, or give --torque")
            for name in ("speed", "temperature")
            if written[name] is not None
        ]
    else:
        if logs:
            faults.append(Fault("--torque", "is given beside a log", written["torque"], "leave one of them out"))
        if written["speed"] is None:
            faults.append(Fault("--speed", "missing", "", 'say at which speed: --speed "100 rpm"'))
    if len(logs) > 2:
        faults.append(Fault("WORN", "more than two logs", str(len(logs)), "give the new one and the worn one"))
    raise_if_any(faults)


def reading(written: Mapping[str, Any]) -> Reading:
    """A torque without load. Raises :class:`~ballscrew.basis.errors.InputError` for faults in it."""
    options = read(ReadingOptions, written)
    assert options.torque is not None
    assert options.speed is not None
    faults: list[Fault] = []
    value = deviation = 0.0
    uncertain = parse_uncertain(options.torque, TORQUE)
    if isinstance(uncertain, Fault):
        faults.append(Fault("--torque", uncertain.problem, uncertain.given or options.torque, uncertain.remedy))
    elif uncertain is None:
        result = units.parse("--torque", options.torque, TORQUE)
        if isinstance(result, Fault):
            faults.append(result)
        else:
            value = result
    else:
        value = uncertain.central
        if isinstance(uncertain.distribution, Normal):
            deviation = uncertain.distribution.deviation
        elif uncertain.distribution is not None:
            remedy = '"0.40 ± 0.02 N m"'
            faults.append(Fault("--torque", "must be a value ± its 95 % interval", options.torque, remedy))
    raise_if_any(faults)
    return Reading(value, options.speed, deviation, options.temperature)
