"""A selection as a table: one row for each candidate, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.documents.selection import verdict
from ballscrew.selection.objectives import OBJECTIVES
from ballscrew.selection.selection import Ranked
from ballscrew.table_files.row_tables import RowTable, of_checks, put


def of_selection(ranked: Sequence[Ranked]) -> RowTable:
    """Rank, row, nut, preload and oil, the objectives, and all that ``ballscrew check --to`` writes of a screw."""
    checked = of_checks([each.candidate.checked for each in ranked])
    kept = [place for place, heading in enumerate(checked.headings) if heading not in ("name", "nut", "verdict")]
    headings: list[str] = []
    rows: list[list[object]] = []
    for each, of_check in zip(ranked, checked.rows, strict=True):
        found = each.candidate
        cells: dict[str, object] = {
            "rank": each.rank, "name": found.name, "nut": found.variant.nut, "preload as given": found.variant.preload,
            "oil": found.variant.oil_name, "holds": int(found.holds), "pareto": int(each.pareto),
            "largest utilisation": found.worst, "verdict": verdict(found),
        }  # fmt: skip
        for name, objective in OBJECTIVES.items():
            put(cells, objective.quantity, found.objectives[name])
        for check in found.checks:
            cells[f"{check.name.replace('_', ' ')} utilisation"] = check.utilisation
        headings = headings or [*cells, *(checked.headings[place] for place in kept)]
        rows.append([*cells.values(), *(of_check[place] for place in kept)])
    return RowTable(headings, rows)
