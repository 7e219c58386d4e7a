"""The options of a service: text from the command line or a request as numbers in SI."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.uncertainty.distributions import Normal
from ballscrew.engine.uncertainty.uncertain_value import parse_uncertain
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.fit.compute import Options
from ballscrew.questions.fit.options import options
from ballscrew.questions.service.compute import TORQUE, Reading


def check_question(
    logs: Sequence[Path], case: Path | None, torque: str | None, speed: str | None, temperature: str | None
) -> Path:
    """The case file. Raises :class:`~ballscrew.basis.errors.InputError` for a question that is none, or two."""
    faults: list[Fault] = []
    if case is None:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if torque is None:
        if not logs:
            remedy = 'give NEW.csv WORN.csv, or WORN.csv alone, or --torque "0.4 N m" --speed "100 rpm"'
            faults.append(Fault("WORN", "missing", "", remedy))
        faults += [
            Fault(option, "is for a torque without a log", given, "leave it out, or give --torque")
            for option, given in (("--speed", speed), ("--temperature", temperature))
            if given is not None
        ]
    else:
        if logs:
            faults.append(Fault("--torque", "is given beside a log", torque, "leave one of them out"))
        if speed is None:
            faults.append(Fault("--speed", "missing", "", 'say at which speed: --speed "100 rpm"'))
    if len(logs) > 2:
        faults.append(Fault("WORN", "more than two logs", str(len(logs)), "give the new one and the worn one"))
    raise_if_any(faults)
    assert case is not None
    return case


def fit_options(
    case: Case,
    *,
    free: Sequence[str],
    columns: Sequence[str],
    kind: str | None,
    inertia: str | None,
    torque_constant: str | None,
    keep_going: bool,
) -> Options:
    """The options of both fits."""
    return options(
        case, free=[PRELOAD, *free], bounds=[], limits=[], columns=columns, kind=kind, inertia=inertia,
        torque_constant=torque_constant, holdout=0.0, seed=0, keep_going=keep_going,
    )  # fmt: skip


def reading(torque: str, speed: str, temperature: str | None) -> Reading:
    """A torque without load. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in the three texts."""
    faults: list[Fault] = []

    def number(option: str, text: str, quantity: Quantity) -> float:
        found = units.parse(option, text, quantity)
        if isinstance(found, Fault):
            faults.append(found)
            return 0.0
        return found

    deviation = 0.0
    uncertain = parse_uncertain(torque, TORQUE)
    if isinstance(uncertain, Fault):
        faults.append(Fault("--torque", uncertain.problem, uncertain.given or torque, uncertain.remedy))
        value = 0.0
    elif uncertain is None:
        value = number("--torque", torque, TORQUE)
    else:
        value = uncertain.central
        if isinstance(uncertain.distribution, Normal):
            deviation = uncertain.distribution.deviation
        elif uncertain.distribution is not None:
            faults.append(Fault("--torque", "must be a value ± its 95 % interval", torque, '"0.40 ± 0.02 N m"'))
    of_speed = number("--speed", speed, fields_of(OperatingState)["screw_speed"])
    warm = None if temperature is None else number("--temperature", temperature, TEMPERATURE)
    raise_if_any(faults)
    return Reading(value, of_speed, deviation, warm)
