"""The checks of screws as a table: a row for each, numbers in the units of their headings."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.questions.check.compute import Checked, Rated
from ballscrew.questions.run.table import of_run
from ballscrew.questions.shared.check_lines import quantity_of
from ballscrew.questions.shared.row_tables import Cells, RowTable, of_cells, put


def of_checks(screws: Sequence[Checked]) -> RowTable:
    """The results, ratings and checks of each screw; of a check its value, and the share of the limit that is used."""
    return of_cells([_of_check(screw) for screw in screws])


def _of_check(found: Checked) -> Cells:
    cells = of_run(found.name, found.run)
    ratings = found.ratings
    for name in Rated._fields:
        put(cells, LISTED[name], getattr(ratings.listed, name))
        put(cells, LISTED[name], getattr(ratings.computed, name, None), f"{name} by geometry")
    for check in found.checks:
        put(cells, quantity_of(check), check.value)
        cells[f"{check.name.replace('_', ' ')} used"] = check.utilisation
    return {**cells, "verdict": found.verdict}
