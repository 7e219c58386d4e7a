"""The front of an optimisation as a table: a row for each member."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.basis.output.sheet import Cells, Columns, columns_of
from ballscrew.questions.check import sheet as check_sheet
from ballscrew.questions.optimise.compute import Member
from ballscrew.questions.optimise.design_space import VARIABLES
from ballscrew.questions.select.objectives import OBJECTIVES


def of_optimisation(members: Sequence[Member]) -> Columns:
    """The free variables and the objectives of each member, and what ``ballscrew check --to`` writes of a screw."""
    return columns_of("screws", [_cells(member) for member in members])


def _cells(member: Member) -> Cells:
    values: dict[str, tuple[Any, Any]] = {"holds": (int(member.holds), None), "pareto": (int(member.pareto), None)}
    for name, value in member.variables.items():
        if name == "preload":
            values["preload share [%]"] = (100 * value, None)
        else:
            values[VARIABLES[name].name] = (value, VARIABLES[name])
    for name, objective in OBJECTIVES.items():
        if name != "price_index":
            values[objective.quantity.name] = (member.objectives[name], objective.quantity)
    for check in member.checks:
        values[f"{check.name.replace('_', ' ')} utilisation"] = (check.utilisation, None)
    return {**values, **check_sheet.cells(member.checked)}
