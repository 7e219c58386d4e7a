"""The log that a case is fitted to, and what is asked of the fit.

Nothing here needs the solvers of the fit, which are slow to import: a log that is bad is refused before.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.evidence.moving_logs.moving_log import MovingLog
from ballscrew.evidence.moving_logs.reading import is_moving, read_moving
from ballscrew.files.torque_logs import reading
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.questions.fit import FitMotionOptions, FitOptions
from ballscrew.questions.shared import every_row
from ballscrew.questions.shared.every_row import OfRows, RowCase
from ballscrew.questions.shared.option_values import assignments, read
from ballscrew.questions.shared.question import Done

#: The quantities that describe a test.
CONDITIONS = ("axial_load", "screw_speed", "temperature")
#: The options of a fit of a case; they depend on what the nut of the case has.
OptionsOf = Callable[[Case], FitOptions]


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


def is_moving_log(path: Path, columns: Mapping[str, str] | Sequence[str]) -> bool:
    """Test whether a file is a moving log; ``columns`` are headings by name, or ``name=heading`` of a command line."""
    named = (text.partition("=") for text in assignments(columns))
    return is_moving(path, {name.strip(): heading.strip() for name, _, heading in named if heading.strip()})


def moving_log(case: Case, path: Path, options: FitMotionOptions, usual_gain: float | None = None) -> MovingLog:
    """The log of a file; ``usual_gain`` (N/V) holds where neither the file nor the options give one.

    Raises :class:`~ballscrew.basis.errors.InputError` for a log that cannot be used.
    """
    return read_moving(
        path,
        options.columns,
        lead=float(case.screw.lead),
        torque_constant=options.torque_constant,
        gain=options.gain,
        usual_gain=usual_gain,
        axis=options.axis,
        period=options.period,
        steady=options.steady,
        keep_going=options.keep_going,
    )


def logs_of_rows(
    rows: Mapping[str, RowCase],
    file: Path,
    options: OptionsOf,
    *,
    keep_going: bool = False,
    done: Done | None = None,
) -> OfRows[TorqueLog]:
    """The log of each row, by its place, read and cleaned before anything is fitted.

    Rows without a log are left out, with a note. Raises :class:`~ballscrew.basis.errors.InputError` with the faults of
    all logs; with ``keep_going`` only if none is good.
    """
    without = [row.row.name for row in rows.values() if row.log is None]
    if len(without) == len(rows):
        remedy = "give each screw the path of its log, beside the table"
        raise InputError(Fault(file.name, 'has no column "log" with a file', "", remedy))

    def read(named: tuple[Case, Path]) -> TorqueLog:
        case, path = named
        return steady_log(case, path, options(case))

    named = {row.place: (row.case, row.log) for row in rows.values() if row.log is not None}
    result = every_row.each(named, read, keep_going=keep_going, done=done)
    notes = [f"{file.name}: no log of {', '.join(without)}"] if without else []
    return dataclasses.replace(result, notes=[*notes, *result.notes])
