"""A selection as a table: a row for each candidate, numbers in the units of their headings."""

from __future__ import annotations

import math
from collections.abc import Sequence

from ballscrew.questions.check.table import of_checks
from ballscrew.questions.duty.compute import NUMBERS
from ballscrew.questions.select.answer import BRAKE
from ballscrew.questions.select.compute import Ranked
from ballscrew.questions.select.document import verdict
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.shared.row_tables import RowTable, of_cells, put


def of_selection(ranked: Sequence[Ranked]) -> RowTable:
    """Rank, row, nut, preload and oil, the objectives, and all that ``ballscrew check --to`` writes of a screw.

    Of a need with a motion with the torques of motor and brake. Cells of what was not computed are empty.
    """
    complete = [each.candidate.checked for each in ranked if each.candidate.complete]
    table = of_checks(complete)
    kept = [place for place, heading in enumerate(table.headings) if heading not in ("name", "nut", "verdict")]
    of_check = iter(table.rows)
    rows: list[dict[str, object]] = []
    for each in ranked:
        found = each.candidate
        cells: dict[str, object] = {
            "rank": each.rank, "name": found.name, "nut": found.variant.nut, "preload as given": found.variant.preload,
            "oil": found.variant.oil_name, "holds": int(found.holds), "pareto": int(each.pareto),
            "largest utilisation": _finite(found.worst), "verdict": verdict(found),
        }  # fmt: skip
        for name, objective in OBJECTIVES.items():
            put(cells, objective.quantity, found.objectives[name])
        if found.duty is not None:
            for name, torque in found.duty.motor_torque.items():
                put(cells, NUMBERS[name], torque, f"motor {name}")
            for name in BRAKE:
                put(cells, NUMBERS["torque_peak"], getattr(found.duty.brake, name), f"brake {name}")
        for check in found.checks:
            cells[f"{check.name.replace('_', ' ')} utilisation"] = _finite(check.utilisation)
        if found.complete:
            row = next(of_check)
            cells |= {table.headings[place]: row[place] for place in kept}
        rows.append(cells)
    return of_cells(rows)


def _finite(share: float | None) -> float | None:
    """A share of a limit; none where nothing of the limit is left."""
    return share if share is not None and math.isfinite(share) else None
