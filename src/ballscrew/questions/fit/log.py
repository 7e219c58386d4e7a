"""The log that a case is fitted to, and what is asked of the fit.

Nothing here needs the solvers of the fit, which are slow to import: a log that is bad is refused before.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.questions.fit.question import FitOptions
from ballscrew.questions.shared.option_values import read

#: The quantities that describe a test.
CONDITIONS = ("axial_load", "screw_speed", "temperature")


def read_options(case: Case, written: Mapping[str, Any]) -> FitOptions:
    """The options of a fit as numbers in SI. Raises :class:`~ballscrew.basis.errors.InputError` with all faults."""

    def quantities(name: str, values: Mapping[str, Any]) -> Mapping[str, Quantity]:
        if name == "bounds":
            from ballscrew.questions.fit.compute import free_quantities  # slow to import: only where bounds are given

            return free_quantities(case, values["free"])
        inputs = inputs_of(case.model, case.screw, case.lubricant)
        return {name: inputs[name][1] for name in CONDITIONS if name in inputs}

    return read(FitOptions, written, quantities)


def steady_log(
    case: Case, path: Path, options: FitOptions, done: Callable[[int, int], None] | None = None
) -> TorqueLog:
    """The rows of the log in a file at which the motion is steady. ``done`` gets the bytes read and those of the file.

    Raises :class:`~ballscrew.basis.errors.InputError` for a case that cannot be fitted, and for a log that cannot be
    used.
    """
    log = reading.read(
        path,
        options.columns,
        torque_constant=options.torque_constant,
        lead=float(case.screw.lead),
        keep_going=options.keep_going,
        done=done,
    )
    return log.cleaned(inertia=options.inertia)
