"""The front of an optimisation as a table: a row for each member, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.questions.check.table import of_checks
from ballscrew.questions.optimise.compute import Member
from ballscrew.questions.optimise.design_space import VARIABLES
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.shared.row_tables import RowTable, put


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
