"""The chain of an axis as a table in a file: one row for each place of the nut."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.questions.axis.compute import SERIES, ChainReport
from ballscrew.questions.shared.row_tables import RowTable, put


def places(report: ChainReport) -> RowTable:
    """One row for each place; a spring that is not known is empty."""
    rows: list[list[object]] = []
    for at in range(len(report.chain.position)):
        cells: dict[str, object] = {}
        for name, quantity in SERIES.items():
            put(cells, quantity, float(report.series[name][at]), quantity.info.meaning)
        rows.append(list(cells.values()))
    return RowTable([units.heading(quantity, quantity.info.meaning) for quantity in SERIES.values()], rows)
