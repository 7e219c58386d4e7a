"""The sheet of a service: what became of the preload, both preloads, the logs, other causes, and their charts."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import spoken
from ballscrew.basis.output.sheet import (
    Axis,
    Bar,
    Bars,
    Block,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Line,
    Lines,
    Number,
    Sheet,
    Table,
    lines,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, model_text, nut_text
from ballscrew.evidence.service.diagnostics import PreloadEstimate
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.service.compute import TORQUE, ServiceReport, curves, preload_quantity, verdicts

#: Causes of an interval that are no input of the model.
#: Causes of an interval that are named.
_MOST_CAUSES = 3
#: A cause that is less than this share of an interval is not named.
_LEAST_CAUSE = 0.1
#: More than this share of an interval is most of it.
_MOST = 0.5
#: More points than this are a blot.
_MOST_POINTS = 3000
#: A curve whose speeds are further apart than this is over the logarithm of the speed.
_WIDE = 20
_COUNT = Quantity("rows", "1", Info("", "rows"))
_SPEED = fields_of(OperatingState)["screw_speed"]
_COLOURS: Mapping[str, Colour] = {"new": "blue", "worn": "orange", "preload": "blue"}
_CURVES = (
    "lines: the model with the preload found, at the median load and the mean temperature of each log; dots: what was "
    "measured, moved there by the model; bars: 95 % intervals"
)


def sheet(case: Case, report: ServiceReport) -> Sheet:
    """All that people see of a service."""
    first, *others = verdicts(case, report)
    has_change = report.change is not None
    origin = "case" if report.change is None or report.change.new.fit is None else "new log"
    warnings = [record for record in report.warnings if record.severity == "warning"]
    remarks = [record for record in report.warnings if record.severity != "warning"]
    return Sheet(
        f"{', '.join(names(report))}: {nut_text(case.screw.nut)}, {model_text(case)}",
        [
            verdict_lines([first]),
            *([_preloads(case, report)] if has_change else []),
            lines(_logs(report)),
            Lines([Line(cause) for cause in causes(report)]),
            warning_lines(warnings),
            Lines([Line(f"note: {record.text}") for record in remarks]),
            Lines([Line(f"with the preload of the {origin}: {record.text}") for record in others]),
            Lines([Line(design(case, plain_text=True), "small"), Line(_CURVES, "small")]),
            *_charts(report),
            _bars(case, report),
        ],
    )


def names(report: ServiceReport) -> list[str]:
    """The logs by the names of their files, or the reading."""
    if report.reading is not None:
        return [f"drag torque {units.shown(report.reading.torque, TORQUE)}"]
    logs = {label: estimate.fit.rows.log for label, estimate in report.estimates.items() if estimate.fit is not None}
    return [label if log.source is None else log.source[0] for label, log in logs.items()]


def causes(report: ServiceReport) -> list[str]:
    """Causes of the interval, the largest cause first."""
    by_cause = report.change.ratio_shares if report.change is not None else {}
    by_cause = report.preload.shares if report.preload is not None else by_cause
    shares = sorted(((share, name) for name, share in by_cause.items() if math.isfinite(share)), reverse=True)
    largest = ", ".join(
        f"{spoken(name)} ({100 * share:.0f}%)" for share, name in shares[:_MOST_CAUSES] if share >= _LEAST_CAUSE
    )
    if not largest:
        return []
    if sum(share for share, _ in shares[:_MOST_CAUSES]) > _MOST:
        return [f"most of the interval is from: {largest}"]
    return [f"no cause makes most of the interval; the largest: {largest}"]


def _logs(report: ServiceReport) -> list[str]:
    """Rows of each log that are used, why the others are not, and what was done to it."""
    logs = {label: estimate.fit.rows.log for label, estimate in report.estimates.items() if estimate.fit is not None}
    return [f"{label} log: {line}" for label, log in logs.items() for line in (log.usage, *log.notes)]


def _preloads(case: Case, report: ServiceReport) -> Table:
    quantity = preload_quantity(case)
    rows: list[list[Cell]] = [
        [
            _label(label, estimate),
            None if estimate.fit is None else Number(len(estimate.fit.rows.log), _COUNT, 9),
            None if estimate.temperature is None else Number(estimate.temperature, TEMPERATURE, 3),
            Number(estimate.preload, quantity, band=estimate.interval()),
            None if estimate.fit is None else Number(estimate.residual_rms, TORQUE, 2),
        ]
        for label, estimate in report.estimates.items()
    ]
    headings = ("", "rows", "temperature", "preload", "residual")
    return Table("preload", "Preload", headings, rows, ["In brackets the interval of 95 %."])


def _label(label: str, estimate: PreloadEstimate) -> str:
    """``new``, ``worn``; a preload that is not from a log is the nominal one."""
    return "nominal" if label == "new" and estimate.fit is None else label


def _charts(report: ServiceReport) -> Iterator[Block]:
    """Both logs over the speed with the fitted curves; all points of the chart as columns."""
    lines = curves(report, _MOST_POINTS)
    marks: list[Curve] = []
    for label, curve in lines.items():
        marks.append(Curve(f"measured, {label}", curve.measured_speed, curve.measured, _COLOURS[label], "dots"))
        marks.append(Curve(label, curve.speed, curve.torque, _COLOURS[label]))
    if report.reading is not None:
        speed, torque = report.reading.screw_speed, report.reading.torque
        marks.append(Curve("measured", np.array([speed]), np.array([torque]), "blue", "circles"))
    log = any(curve.speed[-1] > _WIDE * curve.speed[0] for curve in lines.values())
    speed_axis = Axis("speed", _SPEED, log)
    yield Chart("torque over speed", speed_axis, Axis("friction torque", TORQUE, least=0.0), marks)
    if lines:
        rows = [
            (label, *point) for label, c in lines.items() for point in zip(c.measured_speed, c.measured, strict=True)
        ]
        labels, speeds, torques = zip(*rows, strict=True)
        columns = [Column("log", labels), Column("speed", speeds, _SPEED), Column("friction torque", torques, TORQUE)]
        yield Columns("measured", columns)


def _bars(case: Case, report: ServiceReport) -> Bars:
    bars = [
        Bar(_label(label, estimate), [("", estimate.preload, _COLOURS[label])], estimate.interval())
        for label, estimate in report.estimates.items()
    ]
    return Bars("preload with its 95 % interval", preload_quantity(case), bars)
