"""The sheet of designs side by side: what each needs against the first, its checks, and the parts of its torque."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence

from ballscrew.basis.output.sheet import Bar, Bars, Cell, Line, Lines, Number, Share, Sheet, Table, columns_of, lines
from ballscrew.basis.quantities import quantities_of
from ballscrew.cases.case_files import descriptions
from ballscrew.physics.friction.result import MECHANISMS, FrictionResult
from ballscrew.questions.check import sheet as check_sheet
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.compare_designs.compute import COMPARED, SideBySide, change_of
from ballscrew.questions.shared.chart_colours import colour_of

_RESULT = quantities_of(FrictionResult)
_HEADINGS = {
    "screw_torque": "torque",
    "drive_torque": "drive torque",
    "efficiency": "eff.",
    "back_driving_efficiency": "eff. back",
    "friction_power": "heat",
}


def sheet(designs: SideBySide) -> Sheet:
    """All that people see of designs side by side."""
    first = designs.designs[0]
    if designs.own:
        at = [f"{design.name}: {descriptions.operating_point(design.case)}" for design in designs.designs]
    else:
        at = [f"all at {descriptions.operating_point(first.case)}; --own takes each at its own load and speed"]
    warnings = [
        Line(f"{design.name}: {record.text}", "warning", record.name)
        for design in designs.designs
        for record in design.run.warnings
    ]
    parts = {design.name: design.run.friction.contributions for design in designs.designs}
    return Sheet(
        f"{len(designs.designs)} designs side by side",
        [
            lines(at),
            Lines([Line(f"{design.name}: checks {design.verdict}", "verdict") for design in designs.designs]),
            _results(designs.designs, first),
            Lines(warnings),
            bars(parts, {}),
            columns_of("screws", [check_sheet.cells(design) for design in designs.designs]),
        ],
    )


def _results(designs: Sequence[Checked], first: Checked) -> Table:
    """Each result with its change against the first design."""
    rows: list[list[Cell]] = []
    for design in designs:
        cells: list[Cell] = [design.name]
        for name in COMPARED:
            change = None if design is first else change_of(name, design, first)
            cells.append(Number(float(getattr(design.run.friction, name)), _RESULT[name]))
            cells.append("" if change is None else Share(change, bar=False, is_change=True))
        rows.append(cells)
    columns = ["", *(heading for name in COMPARED for heading in (_HEADINGS[name], ""))]
    return Table("designs", "design", columns, rows, [f"Changes are against {first.name}."])


def bars(parts: Mapping[str, Mapping[str, float]], bands: Mapping[str, tuple[float, float]]) -> Bars:
    """The friction torque of each design by its parts, with the band of its torque where there is one."""
    shown = [
        Bar(
            name,
            [
                (MECHANISMS.get(mechanism, mechanism), float(part), colour_of(mechanism))
                for mechanism, part in of_design.items()
                if math.isfinite(float(part)) and float(part)
            ],
            bands.get(name),
        )
        for name, of_design in parts.items()
    ]
    return Bars("friction torque on the screw", _RESULT["screw_torque"], shown)
