"""A report of several designs: side by side first, then each by itself."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

from ballscrew.basis.output.sheet import Number, Share, words
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.faces.report import contents, input_tables
from ballscrew.faces.report.contents import ALL
from ballscrew.faces.sheets import report_blocks
from ballscrew.faces.sheets.report_blocks import (
    Block,
    Columns,
    Links,
    Paragraph,
    Report,
    Section,
    Table,
    sentence,
)
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.band import BandOptions, sheet
from ballscrew.questions.band import compute as band
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.band.sheet import tornado
from ballscrew.questions.check.answer import Checked, checked
from ballscrew.questions.compare import answer
from ballscrew.questions.run.compute import Run, run
from ballscrew.questions.run.sheet import meaning
from ballscrew.questions.shared import check_lines
from ballscrew.questions.shared.question import Done

#: Pages at most of what is side by side, and of each design.
_PAGES, _PAGES_OF_EACH = 2, 2
#: What designs are called, and so how many there may be: as many as fit side by side on paper.
_LETTERS = "ABCD"
MOST = len(_LETTERS)


class Design(NamedTuple):
    """A case by its name, and what came out of it."""

    name: str
    case: Case
    run: Run
    band: BandReport
    checked: Checked


def content(cases: Sequence[Case], done: Done | None = None, samples: int | None = None) -> Report:
    """Contents of the report of several cases, A, B and so on, each at its own load and speed."""
    designs: list[Design] = []
    for place, (case, name) in enumerate(zip(cases, _LETTERS[: len(cases)], strict=True)):
        result = run(case)

        def told(finished: int, total: int, place: int = place) -> None:
            if done is not None:
                done(int(ALL * (place + finished / max(total, 1)) / len(cases)), ALL)

        uncertain = band.band(case, BandOptions(samples=samples), told)
        designs.append(Design(name, case, result, uncertain, checked("", case, known=result)))
    sections = [
        Section("Answer", [_answer(one) for one in designs]),
        Section("Checks", [_checks(designs)]),
        Section("Side by side", [_table(designs), *_picture(designs)]),
    ]
    for one in designs:
        sections += [
            Section(f"Design {one.name}", _of_one(one)),
            Section(f"Inputs and model of {one.name}", _inputs(one)),
        ]
    sources = dict.fromkeys(source for one in designs for source in contents.sources(one.case, one.band))
    sections.append(Section("Sources", [Links(list(sources))]))
    subtitle = [f"{one.name}: {'; '.join(contents.subtitle(one.case))}" for one in designs]
    subtitle.append(f"designs {', '.join(one.name for one in designs)}")
    pages = _PAGES + _PAGES_OF_EACH * len(designs)
    title = f"Friction of {len(designs)} ball screws, side by side"
    return Report(title, subtitle, sections, f"ballscrew {__version__}", pages)


def _answer(one: Design) -> Paragraph:
    said = contents.answer(one.run, one.band).text
    return Paragraph(f"{one.name}: {said} Checks: {one.checked.verdict}.", strong=True)


def _checks(designs: Sequence[Design]) -> Table:
    """The share of each limit that is used, of all designs; the limits are in words where each design has its own."""
    names = list(dict.fromkeys(check.name for one in designs for check in one.checked.checks))
    rows = [(name.replace("_", " "), *(_used(one.checked.check(name)) for one in designs)) for name in names]
    rows.append(("all", *(sentence(one.checked.verdict) for one in designs)))
    texts = tuple(range(len(designs) + 1))
    return Table("Share of each limit that is used", ("", *(one.name for one in designs)), rows, texts)


def _used(check: Check) -> str:
    if check.holds is None:
        wanted = check.missing.rpartition(".")[2].replace("_", " ")
        return f"not judged: give {wanted}" if wanted else "not judged"
    used = "" if check.utilisation is None else f"{check.utilisation:.1%}: "
    value, limit = (check_lines.shown(check, number) for number in (check.value, check.limit))
    return f"{'' if check.holds else 'FAILS, '}{used}{value} against {limit}"


def _table(designs: Sequence[Design]) -> Table:
    """Results with their bands, and what they change against the first design."""
    rows: list[tuple[str, ...]] = [
        ("load and speed", *(descriptions.operating_point(one.case) for one in designs))
    ]  # fmt: skip
    for name in BAND_OUTPUTS:
        rows.append((meaning(name), *(_cell(one, name, designs[0]) for one in designs)))
    texts = tuple(range(len(designs) + 1))
    note = "In brackets the band, then the change of the value against the first design."
    return Table(
        "Results, each at its own load and speed", ("", *(one.name for one in designs)), rows, texts, note=note
    )


def _cell(one: Design, name: str, first: Design) -> str:
    quantity = known_outputs(one.case.screw.nut)[name].quantity
    value, start = (float(getattr(each.run.friction, name)) for each in (one, first))
    ends = one.band.band[name].both if sheet.has_band(one.band) else (math.nan, math.nan)
    share = name.endswith("efficiency")
    text = words(Share(value, band=ends) if share else Number(value, quantity, band=ends))
    # a ratio of torques of either sign says nothing
    if one is first or not (value > 0 < start and math.isfinite(value) and math.isfinite(start)):
        return text
    return f"{text}, {100 * (value - start):+.1f} points" if share else f"{text}, {value / start - 1:+.0%}"


def _picture(designs: Sequence[Design]) -> list[Block]:
    parts = {one.name: one.run.friction.contributions for one in designs}
    bands = {one.name: one.band.band["screw_torque"].both for one in designs}
    bars = answer.bars(parts, bands)
    if not any(bar.parts for bar in bars.bars):
        return []
    torques = ", ".join(
        f"{bar.name} {sum(part for _, part, _ in bar.parts):.3g} N m ({bands[bar.name][0]:.3g} to "
        f"{bands[bar.name][1]:.3g})"
        for bar in bars.bars
    )
    return [report_blocks.picture([bars], f"{torques}; by its parts, the line with ends is its band", "designs")]


def _of_one(one: Design) -> list[Block]:
    swings = sheet.swings(one.band, tornado(one.case, one.band))
    return [
        contents.results(one.run, one.band),
        *contents.parts(one.run),
        *([report_blocks.picture(swings, descriptions.title(one.case), f"swings-{one.name}")] if swings else []),
        *contents.vendor_rows(one.case),
        *contents.beware(one.run),
    ]


def _inputs(one: Design) -> list[Block]:
    inputs = input_tables.tables(one.case)
    return [Columns.of([*inputs, input_tables.laws(one.case)]), contents.origins(one.case, inputs)]
