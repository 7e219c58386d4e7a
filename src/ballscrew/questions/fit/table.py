"""Fits of several screws as a table: a row for each, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.questions.fit.answer import results
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.shared.row_tables import Cells, RowTable, of_cells, put_columns


def of_fits(reports: Mapping[str, FitReport]) -> RowTable:
    """What was found for each screw from its log: the numbers with their errors and the ends of their 95 % interval."""
    return of_cells([_of_fit(name, report) for name, report in reports.items()])


def _of_fit(name: str, report: FitReport) -> Cells:
    model, found = report.model, results(report)
    cells: Cells = {"name": name, "log": (model.rows.log.source or ("", ""))[0], "rows used": found.rows.used}
    for full, estimate in model.estimates.items():
        put_columns(cells, found.estimates[full], full.rpartition(".")[2], estimate.quantity)
    put_columns(cells, found)
    cells["verdicts"] = "; ".join(model.verdicts)
    cells["warnings"] = "; ".join(model.warnings)
    return cells
