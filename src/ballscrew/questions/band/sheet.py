"""The sheet of a band: verdicts, its causes, what follows from it, laws and inputs that make it, and their charts."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence

from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Bar,
    Bars,
    Block,
    Cell,
    Chart,
    Colour,
    Curve,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    lines,
    sentence,
    verdict_lines,
    warning_lines,
    words,
)
from ballscrew.basis.output.text import plain
from ballscrew.basis.quantities import Info, Quantity, fields_of, quantities_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import design, title
from ballscrew.cases.case_files.named_calibration import vendor_rows_like
from ballscrew.cases.case_files.uncertain_inputs import GIVEN, Uncertain
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.uncertainty.bands import BandCurve, Interval, OutputBand
from ballscrew.engine.uncertainty.sensitivity import Swing, one_at_a_time
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.questions.band.answer import verdicts, warnings
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.run.compute import Run


@dataclasses.dataclass(frozen=True, eq=False)
class Tornado:
    """The friction torque of a case with one uncertain input at a time at either end, and its band."""

    swings: Sequence[Swing]
    torque: OutputBand
    level: float
    inputs: Mapping[str, Uncertain]


def tornado(case: Case, report: BandReport) -> Tornado:
    """The tornado of a case with the inputs and the level of its band."""
    swings = one_at_a_time(
        case.model,
        case.screw,
        case.lubricant,
        uncertain={name: one.distribution for name, one in report.inputs.items()},
        axial_load=case.operation.axial_load,
        screw_speed=case.operation.screw_speed,
        level=report.band.level,
    )
    return Tornado(swings, report.band["screw_torque"], report.band.level, report.inputs)


_RESULT = quantities_of(FrictionResult)
_TORQUE = _RESULT["screw_torque"]
_RATIO = Quantity("ratio", "1", Info("", "model / vendor's middle"))
#: Outputs that are shown beside the friction torque, and meanings where there is little room.
_SHOWN = ("drive_torque", "holding_torque", "efficiency", "back_driving_efficiency", "friction_power")
_SHORT = {"holding_torque": "torque that holds the load", "back_driving_efficiency": "efficiency, load drives"}
CAUSES: Sequence[str] = ("inputs and laws", "inputs alone", "laws alone")
#: Inputs that are drawn, and the share of the widest swing below which an input is left out.
_MOST, _LEAST = 12, 0.01


def sheet(
    case: Case,
    report: BandReport,
    curve: BandCurve | None = None,
    tornado: Tornado | None = None,
    heating: Sequence[Record] = (),
) -> Sheet:
    """All that people see of a band, with the curve and the swings of its inputs where they were computed."""
    return Sheet(
        title(case),
        [
            Lines([Line(record.text) for record in heating]),
            verdict_lines(verdicts(case, report)),
            *([_causes(report), _others(case, report)] if has_band(report) else []),
            *_laws(case, report),
            *_inputs(report),
            warning_lines([*case.implausible(), *warnings(report)]),
            lines(_remarks(case, report, curve), "small"),
            *([] if curve is None else [_along(report, curve), *_bars(report)]),
            *([] if tornado is None else swings(report, tornado)),
        ],
    )


def has_band(report: BandReport) -> bool:
    """Test whether there is a band: a friction torque that is a number and not zero for certain."""
    torque = report.band["screw_torque"]
    return math.isfinite(torque.median) and torque.both != (0.0, 0.0)


def answer(run: Run, report: BandReport) -> list[str]:
    """The answer in some sentences, the numbers of the first one with their bands."""
    sentences = [_headline(run, report), *(record.text for record in run.verdicts)]
    if has_band(report):
        causes = "inputs and laws" if report.band.alternatives else "the inputs alone"
        sentences.append(f"the ends in brackets hold {_level(report)} of the samples of {causes}")
    return sentences


def _headline(run: Run, report: BandReport) -> str:
    friction, bands = run.friction, report.band
    if not math.isfinite(float(friction.screw_torque)):
        return "no friction torque came out: it is no number here"

    def with_band(name: str) -> str:
        value, ends = float(getattr(friction, name)), bands[name].both
        return words(
            Share(value, band=ends) if name.endswith("efficiency") else Number(value, _RESULT[name], band=ends)
        )

    parts = [f"friction torque on the screw {with_band('screw_torque')}"]
    if math.isfinite(float(friction.efficiency)):
        parts.append(f"efficiency {with_band('efficiency')}")
    elif float(friction.axial_load) != 0:
        parts.append(f"efficiency, the load drives the screw, {with_band('back_driving_efficiency')}")
    parts.append(f"power lost {with_band('friction_power')}")
    return ", ".join(parts) + ("" if friction.valid else " (outside the model's validity)")


def _level(report: BandReport) -> str:
    return f"{100 * report.band.level:.4g} %"


# -- tables and lines -----------------------------------------------------------------------------


def _intervals(output: OutputBand) -> Sequence[Interval]:
    """The intervals of an output, one for each of :data:`CAUSES`."""
    return output.both, output.parameters, output.model_form


def _causes(report: BandReport) -> Table:
    """The friction torque because of inputs and laws together, and of each alone."""
    torque = report.band["screw_torque"]
    shares = (None, torque.share_of_parameters, 1 - torque.share_of_parameters)
    rows: list[list[Cell]] = [
        [
            name,
            Number(interval.low, _TORQUE, toward=-1),
            Number(interval.high, _TORQUE, toward=1),
            None if share is None else Share(share),
        ]
        for name, interval, share in zip(CAUSES, _intervals(torque), shares, strict=True)
    ]
    heading = f"Friction torque on the screw, {_level(report)} of the samples"
    return Table("causes", heading, ("", "from", "to", "share of the variance"), rows)


def _others(case: Case, report: BandReport) -> Table:
    rows: list[list[Cell]] = []
    for name in _SHOWN:
        if name == "holding_torque" and not case.operation.axial_load:
            continue  # nothing to hold
        quantity, output = known_outputs(case.screw.nut)[name].quantity, report.band[name]
        rows.append(
            [
                _SHORT.get(name, quantity.info.meaning),
                Number(output.value, quantity),
                Number(output.median, quantity),
                Number(output.both.low, quantity, toward=-1),
                Number(output.both.high, quantity, toward=1),
            ]
        )
    return Table("others", "What follows from it", ("", "case", "median", "from", "to"), rows, detail=True)


def _laws(case: Case, report: BandReport) -> list[Block]:
    """The laws that were drawn instead of the model's, slot by slot; nothing for a fit, which exchanges none."""
    if case.origins.fit:
        return []
    if not report.band.alternatives:
        return [Lines([Line("no other law is valid here: the band is that of the inputs alone")])]
    rows = [
        [slot.replace("_", " "), ", ".join(f"{law.name} {math.expm1(law.shift):+.1%}" for law in laws)]
        for slot, laws in report.band.alternatives.items()
    ]
    note = "They are valid here and could stand in place of those of the model."
    return [Table("laws", "Other laws", ("", "change of the torque with each"), rows, [note])]


def _inputs(report: BandReport) -> list[Lines]:
    """The uncertain inputs: those of the case file, then those assumed, with their source."""
    given = [f"{_spoken(name)} {u.description}{_source(u)}" for name, u in report.inputs.items() if u.given]
    assumed = [
        f"{_spoken(name)} {u.description} ({u.source}: {u.reason})" for name, u in report.inputs.items() if not u.given
    ]
    lists = {
        "uncertain, as the case says:": given,
        "assumed to be uncertain; write them with ± in the case file if you know better:": assumed,
    }
    blocks = [
        Lines([Line(heading), *(Line(f"  {text}") for text in texts)]) for heading, texts in lists.items() if texts
    ]
    return blocks or [Lines([Line("no input is uncertain")])]


def _source(uncertain: Uncertain) -> str:
    return "" if uncertain.source == GIVEN else f" ({uncertain.source})"


def _spoken(name: str) -> str:
    """The name of an input without underscores and dots."""
    return name.replace("_", " ").replace(".", " ")


def input_counts(report: BandReport) -> str:
    """The number of samples, of uncertain inputs, and of those assumed."""
    count = len(report.inputs)
    return (
        f"{report.band.count} samples of {count} uncertain inputs: {report.given} by the case, "
        f"{count - report.given} assumed, {report.judged} of these by judgement"
    )


def _remarks(case: Case, report: BandReport, curve: BandCurve | None) -> Iterator[str]:
    yield input_counts(report)
    if curve is not None:
        yield design(case, plain_text=True)
        exact = f", and the {_spoken(curve.along)} is exact" if curve.along in report.inputs else ""
        yield f"the curve is of {curve.count} samples{exact}"


# -- charts ---------------------------------------------------------------------------------------


def _along(report: BandReport, curve: BandCurve) -> Chart:
    """The torque along a load or a speed."""
    quantity, level, torque = fields_of(OperatingState)[curve.along], _level(report), report.band["screw_torque"]
    here = curve.points[len(curve.points) // 2]  # the operating point is the middle of the curve
    return Chart(
        f"over the {quantity.info.meaning}",
        Axis(quantity.info.meaning, quantity, least=float(curve.points[0])),
        Axis("friction torque on the screw", _TORQUE, least=0.0),
        [
            Band(f"{level}, inputs and laws", curve.points, *curve.both),
            Band(f"{level}, inputs alone", curve.points, *curve.parameters, "sky"),
            Curve("median", curve.points, curve.median),
            Curve("the case as it is", curve.points, curve.value, "blue", "dashed"),
            Curve("median here", [here], [torque.median], "red", "circles"),
        ],
    )


def _bars(report: BandReport) -> Iterator[Bars]:
    """Causes of the band at the operating point: both causes, and each law that could stand in place of another."""
    torque = report.band["screw_torque"]
    if not has_band(report):
        return
    causes = [
        Bar(name, [("", interval.high - interval.low, colour)], start=interval.low)
        for name, interval, colour in zip(CAUSES, _intervals(torque), ("sky", "blue", "orange"), strict=True)
    ]
    laws = [
        Bar(f"{slot.replace('_', ' ')}: {law.name}", [("", torque.value * math.expm1(law.shift), "orange")])
        for slot, alternatives in report.band.alternatives.items()
        for law in alternatives
    ]
    marks = [Vertical("median", torque.median, "red")]
    yield Bars("what makes it, at the operating point", _TORQUE, [*causes, *laws], marks, origin=torque.value)


def swings(report: BandReport, tornado: Tornado) -> list[Bars]:
    """The friction torque with each uncertain input at either end of its distribution, the widest on top."""
    finite = [swing for swing in tornado.swings if math.isfinite(swing.width)]
    widest = [swing for swing in finite if swing.width > _LEAST * finite[0].width][:_MOST]
    if not widest or not has_band(report):
        return []
    value, laws = tornado.torque.value, tornado.torque.model_form
    bars = [
        Bar(plain(f"{_spoken(swing.input)}: {tornado.inputs[swing.input].description}"), _swing(swing, value))
        for swing in widest
    ]
    if laws.high > laws.low:
        name = "other laws that are valid here, together"
        bars.append(Bar(name, [("", laws.high - laws.low, "grey")], start=laws.low))
    title = f"one uncertain input at a time, at either end of its {_level(report)}"
    return [Bars(title, _TORQUE, bars, origin=value)]


def _swing(swing: Swing, value: float) -> list[tuple[str, float, Colour]]:
    """The ends of a swing, from the value of the case; where both lie on one side the nearer, and what is beyond it."""
    ends: list[tuple[str, float, Colour]] = [
        ("input at its lower end", swing.at_lower - value, "sky"),
        ("at its upper end", swing.at_upper - value, "orange"),
    ]
    near, far = sorted(ends, key=lambda end: abs(end[1]))
    return [near, (far[0], far[1] - near[1], far[2])] if near[1] * far[1] > 0 else ends


# -- the rows of a vendor -------------------------------------------------------------------------


def vendor_rows(case: Case) -> tuple[str, Table] | None:
    """The rows of a vendor most like the nut: a sentence, and their no-load torque beside that of the model."""
    near = vendor_rows_like(case)
    if near is None:
        return None
    rows: list[list[Cell]] = []
    for row, (low, high), ratio in zip(near.rows, near.bands, near.ratios, strict=True):
        middle = (low + high) / 2
        model = Number(ratio * middle, _TORQUE, 3)
        rows.append([row, Number(middle, _TORQUE, band=(low, high)), model, Number(ratio, _RATIO, 3)])
    how = (
        "without calibration"
        if case.origins.calibration is None
        else f"with the calibration {case.origins.calibration.name}"
    )
    text = (
        f"for the {len(rows)} rows of {near.data} most like this nut in diameter and lead the model gives "
        f"{near.mean:.2f} ± {near.scatter:.2f} times the vendor's no-load torque, {how}"
    )
    whose = descriptions.whose_rows(case, near.data)
    if whose:
        text = f"{text}. {sentence(whose)}"
    note = "At 100 rpm without wipers, ISO VG 100 at 25 degC; after the sizes the preload, by the dynamic rating."
    headings = ("diameter x lead x ball - turns", "vendor", "model", "model / vendor's middle")
    return text, Table("vendor", "Torque without load", headings, rows, [note])
