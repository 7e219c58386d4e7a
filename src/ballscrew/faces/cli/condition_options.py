"""The options of ``ballscrew condition``: text from the command line as numbers in SI."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, fault_of, raise_if_any
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.service.posterior import PRELOAD
from ballscrew.files.torque_logs.torque_series import quantities
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.questions.condition.compute import Options
from ballscrew.questions.fit import options as fit_options


def check_question(tests: Sequence[Path], case: Path | None) -> Path:
    """The case file. Raises :class:`~ballscrew.basis.errors.InputError` for a question without case or tests."""
    faults: list[Fault] = []
    if case is None:
        faults.append(Fault("--case", "missing", "", "give the case file of the screw: --case FILE"))
    if not tests:
        faults.append(Fault("TABLE", "missing", "", "give a table with a row for each test, or the logs of the tests"))
    raise_if_any(faults)
    assert case is not None
    return case


def options(
    case: Case,
    tests: Sequence[Path],
    *,
    speed: str | None,
    at: str | None,
    baseline: int,
    tolerance: float,
    false_alarms: float,
    columns: Sequence[str],
    kind: str | None,
    inertia: str | None,
    torque_constant: str | None,
    keep_going: bool,
) -> Options:
    """The options as typed values. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in them."""
    faults: list[Fault] = []
    of_logs = {"--kind": kind, "--inertia": inertia, "--torque-constant": torque_constant}
    if len(tests) == 1:
        faults += [
            Fault(option, "is for logs", given, "leave it out: a table has mean friction torques")
            for option, given in of_logs.items()
            if given is not None
        ]
    elif speed is not None:
        faults.append(Fault("--speed", "is for a table", speed, "leave it out: logs have their speeds"))
    raise_if_any(faults)
    common = fit_options.options(
        case, free=[PRELOAD], bounds=[], limits=[], columns=columns, kind=kind, inertia=inertia,
        torque_constant=torque_constant, holdout=0.0, seed=0, keep_going=keep_going,
    )  # fmt: skip

    def number(option: str, text: str | None, quantity: Quantity) -> float | None:
        found = None if text is None else units.parse(option, text, quantity)
        if found is not None and not isinstance(found, Fault):
            found = fault_of("", quantity, found, text or "") or found
        if isinstance(found, Fault):
            faults.append(Fault(option, found.problem, text or "", found.remedy))
            return None
        return found

    chosen = Options(
        columns=common.columns,
        speed=number("--speed", speed, quantities()["screw_speed"]),
        reference_temperature=number("--at", at, TEMPERATURE),
        baseline=baseline,
        false_alarms=false_alarms,
        tolerance=tolerance,
        kind=common.kind,
        inertia=common.inertia,
        torque_constant=common.torque_constant,
        keep_going=keep_going,
    )
    raise_if_any(faults)
    return chosen
