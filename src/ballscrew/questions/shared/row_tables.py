"""Tables with a row for each screw as CSV or XLSX, numbers in the units of their headings."""

from __future__ import annotations

import csv
import importlib.util
import io
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from ballscrew import units
from ballscrew.errors import Fault, InputError
from ballscrew.files import atomic_write, check_writable
from ballscrew.friction.result import FrictionResult
from ballscrew.quantities import Quantity, quantities_of
from ballscrew.screw_tables.nut_kinds import LISTED, NUT_FIELDS, kind_of
from ballscrew.solvers.load_distribution import BallLoads
from ballscrew.studies.check import RATINGS, Checked
from ballscrew.studies.run import Run
from ballscrew.text.check import quantity_of

if TYPE_CHECKING:  # its solvers are slow to import
    from ballscrew.studies.fit import FitReport

_RESULT = quantities_of(FrictionResult)
_RIGIDITY = quantities_of(BallLoads)["rigidity"]
_OPERATION = ("axial_load", "screw_speed")
#: The results of a run, beside the nut without load.
_OF_RUN = (
    "screw_torque", "nut_torque", "ideal_torque", "drive_torque", "efficiency", "back_driving_efficiency",
    "friction_power",
)  # fmt: skip
_DIGITS = 12
#: Endings of files that are written.
KINDS = (".csv", ".xlsx")


class RowTable(NamedTuple):
    """Headings, and the cells of each row below them."""

    headings: Sequence[str]
    rows: Sequence[Sequence[Any]]


#: A cell, by its heading.
_Cells = dict[str, Any]


def put(cells: _Cells, quantity: Quantity, value: Any, name: str | None = None) -> None:
    """Put a number into its column, in the display unit; none where it is not finite."""
    number = None if value is None else float(units.from_si(float(value), quantity))
    shown = None if number is None or not math.isfinite(number) else float(f"{number:.{_DIGITS}g}") + 0.0
    cells[units.heading(quantity, name)] = shown


def of_cells(rows: Sequence[_Cells]) -> RowTable:
    """Rows that need not have the same columns; those of the first come first."""
    headings = list(dict.fromkeys(heading for cells in rows for heading in cells))
    return RowTable(headings, [[cells.get(heading) for heading in headings] for cells in rows])


def of_runs(runs: Mapping[str, Run]) -> RowTable:
    """The results of each screw at its operating point."""
    return of_cells([_of_run(name, run) for name, run in runs.items()])


def _of_run(name: str, run: Run) -> _Cells:
    cells: _Cells = {"name": name, "nut": "" if run.nut is None else kind_of(run.nut.nut)}
    for field in (*_OPERATION, *_OF_RUN):
        put(cells, _RESULT[field], getattr(run.friction, field))
    nut = run.nut
    put(cells, NUT_FIELDS["preload"], None if nut is None else nut.preload)
    put(cells, _RESULT["screw_torque"], None if nut is None else nut.preload_drag, "torque without load")
    put(cells, _RIGIDITY, None if nut is None else nut.loads.rigidity)
    cells["valid"] = int(run.friction.valid)
    cells["warnings"] = "; ".join(record.text for record in run.warnings)
    return cells


def of_checks(screws: Sequence[Checked]) -> RowTable:
    """The results, ratings and checks of each screw; of a check its value, and the share of the limit that is used."""
    return of_cells([_of_check(screw) for screw in screws])


def _of_check(found: Checked) -> _Cells:
    cells = _of_run(found.name, found.run)
    for name, field in RATINGS.items():
        computed = None if found.computed is None else getattr(found.computed, field)
        put(cells, LISTED[name], found.case.listed.get(name))
        put(cells, LISTED[name], computed, f"{name} by geometry")
    for check in found.checks:
        put(cells, quantity_of(check), check.value)
        cells[f"{check.name.replace('_', ' ')} used"] = check.utilisation
    return {**cells, "verdict": found.verdict}


def of_fits(reports: Mapping[str, FitReport]) -> RowTable:
    """What was found for each screw from its log: the numbers with their errors and the ends of their 95 % interval."""
    return of_cells([_of_fit(name, report) for name, report in reports.items()])


def _of_fit(name: str, report: FitReport) -> _Cells:
    model = report.model
    cells: _Cells = {"name": name, "log": (model.rows.log.source or ("", ""))[0], "rows used": len(model.rows.log)}
    for estimate in model.estimates.values():
        ends = estimate.interval()
        number = estimate.name.rpartition(".")[2]
        put(cells, estimate.quantity, estimate.value, number)
        for what, value in (("error", estimate.std), ("low", ends and ends[0]), ("high", ends and ends[1])):
            put(cells, estimate.quantity, value, f"{number} {what}")
        cells[f"{number.replace('_', ' ')} identified"] = int(estimate.identified)
    put(cells, _RESULT["screw_torque"], model.residual_rms, "residual rms")
    put(cells, _RESULT["screw_torque"], model.holdout_rms, "held out rms")
    cells["verdicts"] = "; ".join(model.verdicts)
    cells["warnings"] = "; ".join(model.warnings)
    return cells


# -- files ----------------------------------------------------------------------------------------


def check_path(to: Path) -> None:
    """Raise :class:`~ballscrew.errors.InputError` now for a file that could not be written later."""
    if to.suffix.lower() not in KINDS:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .csv or .xlsx"))
    if to.suffix.lower() == ".xlsx" and importlib.util.find_spec("xlsxwriter") is None:
        raise InputError(Fault("--to", "needs xlsxwriter", str(to), 'pip install "ballscrew[data]"'))
    check_writable("--to", to)


def write(to: Path, table: RowTable, sheet: str = "screws") -> None:
    """Write .csv or .xlsx, with a sheet of that name, whole or not at all."""
    with atomic_write("--to", to) as path:
        if to.suffix.lower() == ".xlsx":
            path.write_bytes(xlsx_bytes({sheet: table}))
            return
        write_csv(path, table)


def write_csv(path: Path, table: RowTable) -> None:
    """The rows of a table as CSV, below its headings."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([table.headings, *table.rows])


def xlsx_bytes(tables: Mapping[str, RowTable]) -> bytes:
    """A workbook with a sheet for each table, by title."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True})
    bold = workbook.add_format({"bold": True})
    for title, table in tables.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1)
        for number, row in enumerate([table.headings, *table.rows]):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()
