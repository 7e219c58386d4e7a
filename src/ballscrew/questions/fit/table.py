"""Fits of several screws as a table: a row for each, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.basis.quantities import quantities_of
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.fit.compute import FitReport
from ballscrew.questions.shared.row_tables import Cells, RowTable, of_cells, put

_TORQUE = quantities_of(FrictionResult)["screw_torque"]


def of_fits(reports: Mapping[str, FitReport]) -> RowTable:
    """What was found for each screw from its log: the numbers with their errors and the ends of their 95 % interval."""
    return of_cells([_of_fit(name, report) for name, report in reports.items()])


def _of_fit(name: str, report: FitReport) -> Cells:
    model = report.model
    cells: Cells = {"name": name, "log": (model.rows.log.source or ("", ""))[0], "rows used": len(model.rows.log)}
    for estimate in model.estimates.values():
        ends = estimate.interval()
        number = estimate.name.rpartition(".")[2]
        put(cells, estimate.quantity, estimate.value, number)
        for what, value in (("error", estimate.std), ("low", ends and ends[0]), ("high", ends and ends[1])):
            put(cells, estimate.quantity, value, f"{number} {what}")
        cells[f"{number.replace('_', ' ')} identified"] = int(estimate.identified)
    put(cells, _TORQUE, model.residual_rms, "residual rms")
    put(cells, _TORQUE, model.holdout_rms, "held out rms")
    cells["verdicts"] = "; ".join(model.verdicts)
    cells["warnings"] = "; ".join(model.warnings)
    return cells
