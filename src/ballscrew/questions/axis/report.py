"""The chain of an axis in its report: rigidity, lost motion, critical speed and buckling load over the stroke."""

from __future__ import annotations

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.axis import figure as figures
from ballscrew.questions.axis import text
from ballscrew.questions.axis.compute import ChainReport, chain_of
from ballscrew.questions.shared.chart_svg import named, svg_of
from ballscrew.questions.shared.report_blocks import Block, Bullets, Paragraph, Picture, Table, sentence


def blocks_of(case: Case) -> list[Block]:
    """The chain of a case with an installation; where it cannot be computed, the reason."""
    try:
        return blocks(chain_of(case))
    except InputError as error:
        said = "; ".join(str(fault) for fault in error.faults)
        return [Paragraph(f"Stiffness is not computed: {said}.")]


def blocks(report: ChainReport) -> list[Block]:
    """All that a report says of the chain."""
    said = [f"{sentence(record.text)}." for record in report.verdicts]
    words = (
        "Rigidity between motor and table, shares of the compliance, critical speed and buckling load over the place "
        f"of the nut: {text.title(report)}."
    )
    drawn = named(svg_of(lambda: figures.panels(report), "axis"), words)
    caption = (
        "Rigidity, shares of the compliance, critical speed and buckling load over the place of the nut, from the "
        "fixed bearing; shaded: its travel."
    )
    return [
        Paragraph(" ".join([f"{sentence(text.title(report))}.", *said]), strong=True),
        _places(report),
        _springs(report),
        Picture(drawn, words, caption),
        Bullets([f"Assumed: {line}." for line in report.assumed]),
    ]


def _places(report: ChainReport) -> Table:
    heads, *rows = text.place_rows(report)
    note = text.note_of_lost_motion(report)
    return Table("Over the stroke", heads, rows, note=f"{sentence(note)}." if note else "")


def _springs(report: ChainReport) -> Table:
    heads, *rows = text.spring_rows(report)
    return Table("Rigidity and shares of the compliance", heads, rows)
