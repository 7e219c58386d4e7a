"""A selection as a table: a row for each candidate."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ballscrew.basis.output.sheet import Cells, Columns, columns_of
from ballscrew.questions.check import sheet as check_sheet
from ballscrew.questions.duty.compute import NUMBERS
from ballscrew.questions.select.answer import BRAKE
from ballscrew.questions.select.compute import Ranked
from ballscrew.questions.select.document import verdict
from ballscrew.questions.select.objectives import OBJECTIVES


def of_selection(ranked: Sequence[Ranked]) -> Columns:
    """Rank, row, nut, preload and oil, the objectives, and all that ``ballscrew check --to`` writes of a screw.

    Of a need with a motion with the torques of motor and brake. Cells of what was not computed are empty.
    """
    return columns_of("screws", [_cells(each) for each in ranked])


def _cells(ranked: Ranked) -> Cells:
    candidate = ranked.candidate
    plain: dict[str, Any] = {
        "rank": ranked.rank,
        "name": candidate.name,
        "nut": candidate.variant.nut,
        "preload as given": candidate.variant.preload,
        "oil": candidate.variant.oil_name,
        "holds": int(candidate.holds),
        "pareto": int(ranked.pareto),
        "largest utilisation": _finite(candidate.worst),
        "verdict": verdict(candidate),
    }
    values: dict[str, tuple[Any, Any]] = {heading: (value, None) for heading, value in plain.items()}
    values |= {
        objective.quantity.name: (candidate.objectives[name], objective.quantity)
        for name, objective in OBJECTIVES.items()
    }
    if candidate.duty is not None:
        for name, torque in candidate.duty.motor_torque.items():
            values[f"motor {name}"] = (torque, NUMBERS[name])
        for name in BRAKE:
            values[f"brake {name}"] = (getattr(candidate.duty.brake, name), NUMBERS["torque_peak"])
    for check in candidate.checks:
        values[f"{check.name.replace('_', ' ')} utilisation"] = (_finite(check.utilisation), None)
    of_check = check_sheet.cells(candidate.checked) if candidate.complete else {}
    return {**values, **{heading: cell for heading, cell in of_check.items() if heading not in values}}


def _finite(share: float | None) -> float | None:
    """A share of a limit; none where nothing of the limit is left."""
    return share if share is not None and math.isfinite(share) else None
