"""The sheet of a compensation of positions: what it holds for, its numbers, and the warm-up that they come from."""

from __future__ import annotations

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Chart,
    Column,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Sheet,
    Table,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.questions.compensation.compute import PositionCompensation
from ballscrew.questions.warm_up.compute import WarmUpReport
from ballscrew.questions.warm_up.verdicts import verdicts, warnings

_POSITION = Quantity("position", "m", Info("x", "position of the axis", "mm"))
_ERROR = Quantity("error", "m", Info("e", "by how much the nut is farther along", "um"))


def sheet(result: PositionCompensation, report: WarmUpReport) -> Sheet:
    """All that people see of a compensation."""
    positions, errors = result.positions, result.errors
    return Sheet(
        f"compensation of {len(positions)} points at steps of {units.shown(result.step, _POSITION)}: "
        f"it holds after {result.hours:g} h of this work only",
        [
            verdict_lines(verdicts(report)),
            warning_lines(warnings(report)),
            Table(
                "range",
                "Growth of the shaft",
                ("", "from", "to"),
                [
                    ["position", Number(positions[0], _POSITION), Number(positions[-1], _POSITION)],
                    ["error", Number(errors.min(), _ERROR, 3), Number(errors.max(), _ERROR, 3)],
                ],
                [
                    result.missed,
                    f"taken: {result.mounting} (--direction, --zero); if that is not so, signs and places are wrong",
                    "format checked against the manual, not on a control",
                ],
            ),
            Chart(
                "error over position",
                Axis("position", _POSITION),
                Axis("error", _ERROR),
                [Curve("", positions, errors)],
            ),
            Lines([Line(f"assumed: {text}", "small") for text in report.assumed]),
            Columns("points", [Column("position", positions, _POSITION), Column("error", errors, _ERROR)]),
        ],
    )
