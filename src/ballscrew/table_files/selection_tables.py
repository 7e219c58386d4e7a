"""A selection, and the front of an optimisation, as tables: numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.documents.selection import verdict
from ballscrew.optimisation.design_space import VARIABLES
from ballscrew.optimisation.optimisation import Member
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


def of_optimisation(members: Sequence[Member]) -> RowTable:
    """The free variables and the objectives of each member, and what ``ballscrew check --to`` writes of a screw."""
    checked = of_checks([each.checked for each in members])
    headings: list[str] = []
    rows: list[list[object]] = []
    for each, of_check in zip(members, checked.rows, strict=True):
        cells: dict[str, object] = {"holds": int(each.holds), "pareto": int(each.pareto)}
        for name, value in each.variables.items():
            if name == "preload":
                cells["preload share [%]"] = 100 * value
            else:
                put(cells, VARIABLES[name], value)
        for name, objective in OBJECTIVES.items():
            if name != "price_index":
                put(cells, objective.quantity, each.objectives[name])
        for check in each.checks:
            cells[f"{check.name.replace('_', ' ')} utilisation"] = check.utilisation
        headings = headings or [*cells, *checked.headings]
        rows.append([*cells.values(), *of_check])
    return RowTable(headings, rows)
