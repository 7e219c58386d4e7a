"""A sheet as blocks of a report: verdicts, warnings, tables, charts as one picture, other lines; no details."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.basis.output.sheet import Bars, Chart, Lines, Map, Sheet, words
from ballscrew.basis.output.sheet import Table as SheetTable
from ballscrew.questions.shared.charts import named, svg_of
from ballscrew.questions.shared.report_blocks import Bar, Block, Bullets, Paragraph, Picture, Table, sentence


def blocks(sheet: Sheet, name: str) -> list[Block]:
    """All that a report says of a sheet; ``name`` keeps the identifiers of its picture apart from those of others."""
    lines = [line for block in sheet.of_kind(Lines) if not block.detail for line in block.lines]
    verdicts = [f"{sentence(line.text)}." for line in lines if line.kind == "verdict"]
    warned = [f"{sentence(line.text)}." for line in lines if line.kind == "warning"]
    shown: list[Block] = [Paragraph(" ".join([f"{sentence(sheet.title)}.", *verdicts]), strong=True)]
    shown += [Bullets(warned)] if warned else []
    shown += [table(block) for block in sheet.of_kind(SheetTable) if not block.detail]
    charts = [block for block in sheet.of_kind(Chart, Map, Bars) if not block.detail]
    if charts:
        shown.append(picture(charts, sheet.title, name))
    return [*shown, *_other_lines(sheet)]


def _other_lines(sheet: Sheet) -> list[Block]:
    """Lines that are neither verdict nor warning as one list; those below a heading as a list of their own."""
    shown: list[Block] = []
    others: list[str] = []
    for block in sheet.of_kind(Lines):
        texts = [sentence(line.text.strip()) for line in block.lines if line.kind in {"plain", "small"}]
        if block.detail or not texts:
            continue
        if texts[0].endswith(":"):
            shown += [Paragraph(texts[0]), Bullets([f"{text}." for text in texts[1:]])]
        else:
            others += [f"{text}." for text in texts]
    return [*([Bullets(others)] if others else []), *shown]


def picture(charts: Sequence[Chart | Map | Bars], title: str, name: str) -> Picture:
    """Charts as one picture of a report; ``name`` keeps its identifiers apart from those of others."""
    from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

    titles = sentence("; ".join(chart.title for chart in charts))
    drawn = named(svg_of(lambda: pictures.page(charts), name), f"{titles}: {title}.")
    return Picture(drawn, f"{titles}: {title}.", f"{titles}.")


def table(block: SheetTable) -> Table:
    """A table of a report; shares with a bar have one beside them."""
    bars, texts = block.bars(), tuple(block.text_columns())
    note = " ".join(f"{sentence(note.removesuffix('.'))}." for note in block.notes)
    rows: list[list[str | Bar]] = [[words(cell, with_unit=not block.is_compact) for cell in row] for row in block.rows]
    if not any(share is not None for share in bars):
        return Table(block.title, block.columns, rows, texts, texts[-1], note)
    for row, share in zip(rows, bars, strict=True):
        row.append("" if share is None else Bar(0.0, max(0.0, min(share, 1.0))))
    return Table(block.title, [*block.columns, ""], rows, texts, len(block.columns), note)
