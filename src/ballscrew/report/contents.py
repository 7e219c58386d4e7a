"""The report of a case: what is in it, as plain data, and as the bytes of a file."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any, Literal

import numpy as np

from ballscrew import __version__
from ballscrew.interfaces import answer as answers
from ballscrew.interfaces import band, bibliography, check, config, nut_report, report, report_inputs, report_results
from ballscrew.interfaces.answer import Answer
from ballscrew.interfaces.drawing import drawing
from ballscrew.interfaces.drawn_ball import drawn_ball
from ballscrew.interfaces.report_blocks import (
    Block,
    Columns,
    Links,
    Paragraph,
    Picture,
    Report,
    Section,
    Table,
    sentence,
)
from ballscrew.interfaces.report_curves import Curves, curves

Done = Callable[[int, int], None]
Kind = Literal["pdf", "html"]
#: How far along the work is after its steps, of a hundred: the answer, the band, the curves.
_ANSWERED, _BANDED, _DRAWN, _ALL = 5, 60, 85, 100
#: Sources of what a report says besides the model: the ratings and checks.
_OF_CHECKS = ("ISO3408-5", "ISO76")


def report_bytes(case: config.Case, kind: Kind, done: Done | None = None, samples: int | None = None) -> bytes:
    """The report of a case as a PDF or HTML file; equal cases give equal bytes.

    ``done(finished, total)`` is told how far it is. Needs the extra ``report``.
    """
    found = content(case, done, samples)
    if kind == "html":
        from ballscrew.interfaces.report_html import html_bytes

        written = html_bytes(found)
    else:
        from ballscrew.interfaces.report_pdf import pdf_bytes

        written = pdf_bytes(found)
    _tell(done, _ALL)
    return written


def _tell(done: Done | None, finished: int) -> None:
    if done is not None:
        done(finished, _ALL)


def content(case: config.Case, done: Done | None = None, samples: int | None = None) -> Report:
    """What is in the report of a case."""
    answer = answers.answer(case)
    _tell(done, _ANSWERED)

    def of_band(finished: int, total: int) -> None:
        _tell(done, _ANSWERED + (_BANDED - _ANSWERED) * finished // max(total, 1))

    uncertain = band.computed(case, band.Options(samples=samples), of_band)
    _tell(done, _BANDED)
    pictures = _pictures(curves(case))
    _tell(done, _DRAWN)
    inputs = report_inputs.tables(case)
    checked = check.checked("", case, ())
    sections = [
        Section("Result", [*_answer(answer), *_drawing(answer)]),
        Section("Where the torque comes from", report_results.parts(answer)),
        Section("Around the operating point", pictures),
        Section("How far off it may be", report_results.band_blocks(case, uncertain)),
        Section("Checks", report_results.checks(checked)),
        Section("What to beware of", report_results.beware(answer)),
        Section(
            "Inputs and model", [*_model(case), Columns.of([*inputs, report_inputs.laws(case)]), _origins(case, inputs)]
        ),
        Section("Sources", [Links(_sources(case, uncertain))]),
    ]
    return Report("Friction of a ball screw", _subtitle(case), sections, f"ballscrew {__version__}")


def _subtitle(case: config.Case) -> list[str]:
    of_row = [] if case.row is None else [f"{case.row.name} ({case.row.source})"]
    nut = [] if case.parts is None else [nut_report.nut_in_words(case.parts)]
    words = [*of_row, report.design(case, plain_text=True), *nut]
    return [*words, f"{report.operating_point(case)}; {report.model_in_words(case)}"]


def _answer(answer: Answer) -> list[Block]:
    # what a fit found besides belongs to every torque above
    lines = [f"{sentence(line)}." for line in (*report.constant_torque(answer.case), *answer.verdicts)]
    said = " ".join([report_results.headline(answer), *lines])
    return [Paragraph(said, strong=True), Columns.of(report_results.results(answer))]


def _drawing(answer: Answer) -> list[Block]:
    ball = "the most loaded ball" if answer.case.parts is not None else "a ball"
    drawn = drawing(answer)
    touching = drawn_ball(answer).contact
    slips = touching is not None and touching.slip is not None
    arrows = "; arrows: slip of the screw's surface over the ball" if slips else ""
    words = f"Drawing of {ball} between its grooves, and of its contact with the screw: {answer.title}."
    caption = (
        f"{sentence(ball)} between its grooves, to scale; how far the grooves reach is assumed"
        f"{'' if touching is None else '. On the right its contact with the screw as seen from the ball'}{arrows}."
    )
    return [Picture(drawn, words, caption, 0.8)]


def _pictures(found: Curves) -> list[Picture]:
    # matplotlib takes its time: only for those who want a report
    from ballscrew.interfaces.figures.report import named, pictures

    speed, load = (f"{value:.6g}" for value in found.here)
    here = "the dashed line is the operating point"
    words = {
        "speed": f"Friction torque by its parts and film parameter over the speed; at {speed} rpm "
        f"{_at(found.speeds, sum(found.parts.values()), found.here[0])} N m.",
        "load": f"Efficiency and contact pressure over the load; at {load} N an efficiency of "
        f"{_at(found.loads, found.efficiency, found.here[1])}.",
        "maps": f"Maps of efficiency and friction torque over load and speed; the operating point is {speed} rpm "
        f"and {load} N.",
    }
    masks = {"speed": found.valid_over_speed, "load": found.valid_over_load, "maps": found.valid_everywhere}
    veiled = {name: "" if np.all(mask) else " In grey: outside the model's validity." for name, mask in masks.items()}
    captions = {
        "speed": f"Friction torque, stacked from its parts, and film parameter over the speed at {load} N; {here}.",
        "load": f"Efficiency and greatest contact pressure over the load at {speed} rpm; {here}.",
        "maps": "Efficiency and friction torque over load and speed; the red dot is the operating point.",
    }
    return [
        Picture(named(svg, words[name]), words[name], captions[name] + veiled[name])
        for name, svg in pictures(found).items()
    ]


def _at(x: Any, y: Any, here: float) -> str:
    value = float(np.interp(here, x, np.broadcast_to(y, x.shape)))
    return f"{value:.3g}" if math.isfinite(value) else "no number of"


def _model(case: config.Case) -> Sequence[Block]:
    said = [f"{sentence(line)}." for line in (report.model_in_words(case), *report.of_fit(case))]
    if case.calibration is not None:
        said.append(f"Two numbers of it are from the calibration {case.calibration.name}.")
    return [Paragraph(" ".join(said))]


def _origins(case: config.Case, inputs: list[Table]) -> Paragraph:
    return Paragraph(f"Where values are from: {report_inputs.sources_in_words(case, inputs)}")


def _sources(case: config.Case, found: band.Found) -> list[tuple[str, str]]:
    keys = [*config.references(case), *_OF_CHECKS, *(one.source for one in found.inputs.values())]
    keys += [] if case.row is None else bibliography.of_catalogue(case.row.source)
    return [(f"{source.key}: {source.words}", source.link) for source in bibliography.sources(keys)]
