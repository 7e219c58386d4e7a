"""``ballscrew compare`` of several designs: one line for each, and what fails."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.compare.document import percent
from ballscrew.questions.compare_designs.compute import SideBySide
from ballscrew.questions.compare_designs.document import COMPARED, change_of

_RESULT = quantities_of(FrictionResult)
_HEADINGS = ("design", "torque", "", "drive torque", "", "eff.", "", "eff. back", "", "heat", "")


def text(found: SideBySide) -> str:
    """The table, the verdicts of the checks, and load and speed."""
    first = found.designs[0]
    rows = [list(_HEADINGS), *([one.name, *_cells(one, first)] for one in found.designs)]
    if found.own:
        at = [f"{one.name}: {descriptions.operating_point(one.case)}" for one in found.designs]
    else:
        at = [f"all at {descriptions.operating_point(first.case)}; --own takes each at its own load and speed"]
    checks = [f"{one.name}: checks {one.verdict}" for one in found.designs]
    beware = [
        f"{one.name}: beware {record.name}: {record.text}" for one in found.designs for record in one.run.warnings
    ]
    changes = f"changes are against {first.name}"
    return "\n".join([*aligned(rows), "", *map(wrapped, [*at, changes]), "", *map(wrapped, [*checks, *beware])])


def _cells(one: Checked, first: Checked) -> list[str]:
    """Each result with its change against the first design."""
    cells: list[str] = []
    for name in COMPARED:
        value = float(getattr(one.run.friction, name))
        cells.append(units.shown(value, _RESULT[name]) if value == value else "–")
        change = None if one is first else change_of(name, one, first)
        cells.append("" if change is None else percent(change))
    return cells
