"""Fits of the screws of a table, each to its own log: separate numbers for each, with their own errors."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Callable, Mapping
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files.case import Case
from ballscrew.files.torque_logs.torque_log import TorqueLog
from ballscrew.questions.fit.compute import FitReport, fit
from ballscrew.questions.fit.log import steady_log
from ballscrew.questions.fit.question import FitOptions
from ballscrew.questions.shared import every_row
from ballscrew.questions.shared.every_row import Done, OfRows, RowCase

#: What file names have not.
_ODD = re.compile(r"[^\w.+-]+")
#: The options of a fit of a case; they depend on what the nut of the case has.
OptionsOf = Callable[[Case], FitOptions]


def logs(
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


def fits(
    rows: Mapping[str, RowCase],
    logs: Mapping[str, TorqueLog],
    options: OptionsOf,
    *,
    keep_going: bool = False,
    each: Callable[[RowCase, FitReport], None] | None = None,
    done: Done | None = None,
) -> OfRows[FitReport]:
    """The fit of each row that has a log, by its place; ``each`` is told of every one as soon as it is done."""
    work = {row.place: row for row in rows.values() if row.place in logs}

    def fitted(row: RowCase) -> FitReport:
        report = fit(row.case, logs[row.place], options(row.case))
        if each is not None:
            each(row, report)
        return report

    return every_row.each(work, fitted, keep_going=keep_going, done=done)


def files(rows: Mapping[str, RowCase], folder: Path) -> dict[str, Path]:
    """The case file of each row in a folder, by the name of the row without what file names have not.

    Raises :class:`~ballscrew.basis.errors.InputError` for two rows with the same file.
    """
    paths = {name: folder / f"{_ODD.sub('_', name).strip('._') or '_'}.toml" for name in rows}
    taken: dict[str, str] = {}
    faults: list[Fault] = []
    for name, path in paths.items():
        other = taken.setdefault(path.name.casefold(), name)
        if other != name:
            problem = "would have the same file as another row"
            faults.append(Fault("--to", problem, f"{name} and {other}", "give the rows other names"))
    raise_if_any(faults)
    return paths
