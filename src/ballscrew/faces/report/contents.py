"""The report of a case: what is in it, as plain data."""

from __future__ import annotations

import datetime
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ballscrew.basis import references
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.output.sheet import Table as SheetTable
from ballscrew.basis.records import Record
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.report import input_tables
from ballscrew.faces.report.curves import Curves, curves
from ballscrew.faces.report.drawing import drawing
from ballscrew.faces.report.drawing_contact import drawn_ball
from ballscrew.faces.sheets import report_blocks
from ballscrew.faces.sheets.report_blocks import (
    Block,
    Bullets,
    Columns,
    Links,
    Paragraph,
    Picture,
    Report,
    Section,
    Table,
    sentence,
)
from ballscrew.physics.sizing.makers_tables import GENERAL, speed_limit_of
from ballscrew.questions.band import BandOptions, compute, sheet
from ballscrew.questions.band.sheet import tornado
from ballscrew.questions.check.answer import Checked, checked
from ballscrew.questions.check.sheet import unlisted_ratings
from ballscrew.questions.duty.compute import DutyReport, duty
from ballscrew.questions.run import sheet as run_sheet
from ballscrew.questions.run.compute import Run, run
from ballscrew.questions.shared.check_lines import check_table
from ballscrew.questions.shared.question import Done

if TYPE_CHECKING:
    from ballscrew.questions.duty.band import DutyBandReport

#: Letters of the name of a project.
LONGEST = 120


class Heading(NamedTuple):
    """The name of a project and a date, as they stand on a report; empty where there are none."""

    project: str = ""
    date: str = ""

    @classmethod
    def of(cls, project: str | None, date: str | None) -> Heading:
        """The heading of texts that people gave; ``today`` is a date, too.

        Raises :class:`~ballscrew.basis.errors.InputError` for a name of several lines or too many letters, and for a
        date that is not one of the calendar, such as 2026-11-23.
        """
        faults: list[Fault] = []
        name, day = (project or "").strip(), (date or "").strip()
        if len(name) > LONGEST or not name.isprintable():
            remedy = f"one line of {LONGEST} letters at most"
            faults.append(Fault("--project", "cannot stand on a report", repr(name[:40]), remedy))
        if day == "today":
            day = datetime.date.today().isoformat()
        if day and not _is_date(day):
            faults.append(Fault("--date", "is no date", day[:40], "write it as 2026-11-23, or leave it out"))
        raise_if_any(faults)
        return cls(name, day)

    @property
    def lines(self) -> list[str]:
        """Lines below the title."""
        said = [f"Project: {self.project}"] * bool(self.project) + [f"Date: {self.date}"] * bool(self.date)
        return [" · ".join(said)] if said else []


def _is_date(text: str) -> bool:
    try:
        return datetime.date.fromisoformat(text).isoformat() == text
    except ValueError:
        return False


#: How far along the work is after its steps, of a hundred: the answer, the band, the curves.
_ANSWERED, _BANDED, _DRAWN, ALL = 5, 60, 85, 100
#: Pages at most, and how many more a cycle of motion, the stiffness over its stroke and the heat may take.
_PAGES, _PAGES_OF_CYCLE, _PAGES_OF_STIFFNESS, _PAGES_OF_HEAT = 5, 2, 1, 1
#: Hours of work that the section on heat shows.
HOURS = 4.0
#: Sources of what a report says besides the model: the ratings and checks.
_OF_CHECKS = ("ISO3408-5", "ISO76")
#: Samples of the bands of a cycle, and where its balls are solved one by one: a fifth of the time of a report.
_CYCLE_SAMPLES, _CYCLE_SAMPLES_BY_BALL = 256, 64


def _tell(done: Done | None, finished: int) -> None:
    if done is not None:
        done(finished, ALL)


def content(case: Case, done: Done | None = None, samples: int | None = None) -> Report:
    """Contents of the report of a case."""
    result = run(case)
    _tell(done, _ANSWERED)

    def of_band(finished: int, total: int) -> None:
        _tell(done, _ANSWERED + (_BANDED - _ANSWERED) * finished // max(total, 1))

    uncertain = compute.band(case, BandOptions(samples=samples), of_band)
    _tell(done, _BANDED)
    pictures = _pictures(curves(case))
    _tell(done, _DRAWN)
    inputs = input_tables.tables(case)
    vendor = vendor_rows(case)
    cycle = _duty(case)
    seen = sheet.sheet(case, uncertain, tornado=tornado(case, uncertain))
    sections = [
        Section("Answer", _answer(cycle, answer(result, uncertain), case)),
        _checks(case, result, cycle),
        Section("Result", [results(result, uncertain), *_drawing(result)]),
        Section("Where the torque comes from", parts(result)),
        Section("Around the operating point", pictures),
        Section("How far off it may be", report_blocks.blocks(seen, "band")),
        *([Section("Beside a vendor's rows", vendor)] if vendor else []),
        *_cycle(cycle),
        *_stiffness(case),
        *_heat(case),
        Section("What to beware of", beware(result)),
        Section(
            "Inputs and model", [*_model(case), Columns.of([*inputs, input_tables.laws(case)]), origins(case, inputs)]
        ),
        Section("Sources", [Links(sources(case, uncertain))]),
    ]
    pages = _PAGES + (case.motion is not None) * _PAGES_OF_CYCLE + _has_stiffness(case) * _PAGES_OF_STIFFNESS
    pages += (case.surroundings is not None) * _PAGES_OF_HEAT
    return Report("Friction of a ball screw", subtitle(case), sections, f"ballscrew {__version__}", pages)


def _duty(case: Case) -> DutyReport | None:
    """The cycle of a case that has an axis and a motion."""
    if case.axis is None or case.motion is None:
        return None
    return duty(case)


def _answer(cycle: DutyReport | None, of_point: Paragraph, case: Case) -> list[Block]:
    """The answer to what the case asks: over its cycle where it has one, and then at the operating point."""
    if cycle is None:
        return [of_point]
    from ballscrew.questions.duty.sheet import answers

    of_cycle = " ".join(f"{sentence(line.text)}." for line in answers(cycle))
    return [
        Paragraph(of_cycle, strong=True),
        Paragraph(f"At {descriptions.operating_point(case)} alone: {of_point.text}"),
    ]


def _checks(case: Case, result: Run, cycle: DutyReport | None) -> Section:
    """The checks over the cycle where there is one, else of the operating point: one verdict, and of what it is."""
    of_point = checked("", case, known=result)
    if cycle is None:
        return Section(
            "Checks", [_verdict(of_point.verdict, of_point), report_blocks.table(check_table(of_point.checks, {}))]
        )
    from ballscrew.questions.duty.verdicts import verdicts

    verdict = next(record for record in verdicts(cycle) if record.id == "verdict.checks")
    limits = report_blocks.table(check_table(cycle.checks, {}))
    return Section("Checks over the cycle", [_verdict(verdict.text, of_point), limits])


def _verdict(verdict: str, of_point: Checked) -> Paragraph:
    """The verdict on checks, and on what they rest."""
    no_nut = "" if of_point.case.nut else "the case has no nut: it is checked as a single nut without preload"
    texts = filter(None, [verdict, no_nut, unlisted_ratings(of_point)])
    return Paragraph(" ".join(f"{sentence(text)}." for text in texts), strong=True)


# -- the operating point --------------------------------------------------------------------------


def answer(result: Run, uncertain: compute.BandReport) -> Paragraph:
    """The answer at the operating point with its bands."""
    return Paragraph(" ".join(f"{sentence(text)}." for text in sheet.answer(result, uncertain)), strong=True)


def results(result: Run, uncertain: compute.BandReport) -> Columns:
    """Torque, efficiency and power with their bands; of a nut how it gives way; and the contacts with screw and nut."""
    bands = uncertain.band.outputs if sheet.has_band(uncertain) else {}
    tables = run_sheet.sheet(result, bands).of_kind(SheetTable)
    return Columns.of([report_blocks.table(table) for table in tables if not table.detail and table.name != "parts"])


def parts(result: Run) -> list[Block]:
    """The parts of the friction torque, the greatest first, as numbers and bars."""
    tables = [report_blocks.table(table) for table in run_sheet.parts(result)]
    return [*tables] or [Paragraph("There is no friction torque to take apart: it is zero, or no number, here.")]


def vendor_rows(case: Case) -> list[Block]:
    """The rows of a vendor most like the nut, and what the model says of them."""
    near = sheet.vendor_rows(case)
    return [] if near is None else [Paragraph(f"{sentence(near[0])}."), report_blocks.table(near[1])]


def beware(result: Run) -> list[Block]:
    """Limits of validity, assumptions, and neglected effects."""
    warned = [f"Beware: {text}." for text in map(_warning, result.warnings)]
    holds = Paragraph("All conditions of the model hold at the operating point.")
    assumed = descriptions.assumed(result.case, result.ball_to_ball_force)
    return [Bullets(warned) if warned else holds, Bullets([f"{sentence(line)}." for line in assumed])]


def _warning(record: Record) -> str:
    """The reason and its text; the loss of the preload is a sentence of its own."""
    return f"{record.name}: {record.text}" if record.id == f"validity.{record.name}" else record.text


# -- the cycle, the stroke, heat ------------------------------------------------------------------


def _cycle(cycle: DutyReport | None) -> list[Section]:
    """The section on the cycle of a case."""
    if cycle is None:
        return []
    from ballscrew.questions.duty.sheet import sheet

    return [Section("Over a cycle of the motion", report_blocks.blocks(sheet(cycle, _bands(cycle)), "duty"))]


def _bands(cycle: DutyReport) -> DutyBandReport | None:
    """The bands of a cycle; None for a screw without inputs that are uncertain."""
    from ballscrew.questions.duty.band import band

    try:
        return band(cycle, _CYCLE_SAMPLES_BY_BALL if cycle.case.screw.nut.one_by_one else _CYCLE_SAMPLES)
    except InputError:
        return None


def _has_stiffness(case: Case) -> bool:
    """Test whether a case tells the ends of its shaft and how the nut travels between them."""
    return case.installation is not None and case.axis is not None and case.motion is not None


def _stiffness(case: Case) -> list[Section]:
    """The section on what gives way between motor and table, and on what the shaft stands."""
    if not _has_stiffness(case):
        return []
    from ballscrew.questions.axis.answer import chain_of, sheet

    try:
        blocks = report_blocks.blocks(sheet(chain_of(case)), "axis")
    except InputError as error:
        blocks = [Paragraph(f"Stiffness is not computed: {'; '.join(map(str, error.faults))}.")]
    return [Section("Stiffness over the stroke", blocks)]


def _heat(case: Case) -> list[Section]:
    """The section on the heat of a case that has surroundings."""
    if case.surroundings is None:
        return []
    from ballscrew.questions.warm_up.compute import warmed_up
    from ballscrew.questions.warm_up.sheet import sheet

    try:
        blocks = report_blocks.blocks(sheet(warmed_up(case, HOURS)), "warm_up")
    except InputError as error:
        blocks = [Paragraph(f"Heat is not computed: {'; '.join(map(str, error.faults))}.")]
    return [Section("As it warms up", blocks)]


def subtitle(case: Case) -> list[str]:
    """Row, screw, nut, operating point and model of a case, a line each."""
    of_row = [] if case.origins.row is None else [f"{case.origins.row.name} ({case.origins.row.source})"]
    nut = [] if case.nut is None else [descriptions.nut_text(case.nut)]
    lines = [*of_row, descriptions.design(case, plain_text=True), *nut]
    return [*lines, f"{descriptions.operating_point(case)}; {descriptions.model_text(case)}"]


def _drawing(result: Run) -> list[Block]:
    ball = "the most loaded ball" if result.nut is not None else "a ball"
    drawn = drawing(result)
    touching = drawn_ball(result).contact
    slips = touching is not None and touching.slip is not None
    arrows = "; arrows: slip of the screw's surface over the ball" if slips else ""
    words = (
        f"Drawing of {ball} between its grooves, and of its contact with the screw: {descriptions.title(result.case)}."
    )
    caption = (
        f"{sentence(ball)} between its grooves, to scale; how far the grooves reach is assumed"
        f"{'' if touching is None else '. On the right its contact with the screw as seen from the ball'}{arrows}."
    )
    return [Picture(drawn, words, caption, 0.8)]


def _pictures(result: Curves) -> list[Picture]:
    # matplotlib takes its time: only for those who want a report
    from ballscrew.faces.report.curve_figures import pictures
    from ballscrew.questions.shared.charts import named

    speed, load = (f"{value:.6g}" for value in result.here)
    here = "the dashed line is the operating point"
    words = {
        "speed": f"Friction torque by its parts and film parameter over the speed; at {speed} rpm "
        f"{_at(result.speeds, sum(result.parts.values()), result.here[0])} N m.",
        "load": f"Efficiency and contact pressure over the load; at {load} N an efficiency of "
        f"{_at(result.loads, result.efficiency, result.here[1])}.",
        "maps": f"Maps of efficiency and friction torque over load and speed; the operating point is {speed} rpm "
        f"and {load} N.",
    }
    masks = {"speed": result.valid_over_speed, "load": result.valid_over_load, "maps": result.valid_everywhere}
    veiled = {name: "" if np.all(mask) else " In grey: outside the model's validity." for name, mask in masks.items()}
    captions = {
        "speed": f"Friction torque, stacked from its parts, and film parameter over the speed at {load} N; {here}.",
        "load": f"Efficiency and greatest contact pressure over the load at {speed} rpm; {here}.",
        "maps": "Efficiency and friction torque over load and speed; the red dot is the operating point.",
    }
    return [
        Picture(named(svg, words[name]), words[name], captions[name] + veiled[name])
        for name, svg in pictures(result).items()
    ]


def _at(x: Any, y: Any, here: float) -> str:
    value = float(np.interp(here, x, np.broadcast_to(y, x.shape)))
    return f"{value:.3g}" if math.isfinite(value) else "no number of"


def _model(case: Case) -> Sequence[Block]:
    said = [f"{sentence(line)}." for line in (descriptions.model_text(case), *descriptions.of_fit(case))]
    if case.origins.calibration is not None:
        said.append(f"Two numbers of it are from the calibration {case.origins.calibration.name}.")
    return [Paragraph(" ".join(said))]


def origins(case: Case, inputs: list[Table]) -> Paragraph:
    """Sources of the values of the inputs."""
    return Paragraph(f"Where values are from: {input_tables.sources_in_words(case, inputs)}")


def sources(case: Case, band_report: compute.BandReport) -> list[tuple[str, str]]:
    """Sources of a case and its band, in words, each with its address."""
    keys = [*descriptions.references(case), *_OF_CHECKS, *(one.source for one in band_report.inputs.values())]
    keys += [] if case.origins.row is None else references.of_catalogue(case.origins.row.source)
    if case.limits.diameter_speed_product is None:
        keys += (speed_limit_of(case.origins.row) or GENERAL).sources
    return [(f"{source.key}: {source.words}", source.link) for source in references.sources(keys)]
