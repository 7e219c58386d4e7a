"""A sheet as blocks of a report: verdicts, warnings, tables, charts as one picture, other lines; no details."""

from __future__ import annotations

from ballscrew.basis.output.sheet import Chart, Lines, Map, Sheet, words
from ballscrew.basis.output.sheet import Table as SheetTable
from ballscrew.questions.shared.chart_svg import named, svg_of
from ballscrew.questions.shared.report_blocks import Bar, Block, Bullets, Paragraph, Picture, Table, sentence


def blocks(sheet: Sheet, name: str) -> list[Block]:
    """All that a report says of a sheet; ``name`` keeps the identifiers of its picture apart from those of others."""
    from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

    lines = [line for block in sheet.of_kind(Lines) if not block.detail for line in block.lines]
    verdicts = [f"{sentence(line.text)}." for line in lines if line.kind == "verdict"]
    warned = [f"{sentence(line.text)}." for line in lines if line.kind == "warning"]
    others = [f"{sentence(line.text)}." for line in lines if line.kind in {"plain", "small"}]
    shown: list[Block] = [Paragraph(" ".join([f"{sentence(sheet.title)}.", *verdicts]), strong=True)]
    shown += [Bullets(warned)] if warned else []
    shown += [table(block) for block in sheet.of_kind(SheetTable) if not block.detail]
    charts = [block for block in sheet.of_kind(Chart, Map) if not block.detail]
    if charts:
        titles = "; ".join(chart.title for chart in charts)
        drawn = named(svg_of(lambda: pictures.page(charts), name), f"{sentence(titles)}: {sheet.title}.")
        shown.append(Picture(drawn, f"{sentence(titles)}: {sheet.title}.", f"{sentence(titles)}."))
    shown += [Bullets(others)] if others else []
    return shown


def table(block: SheetTable) -> Table:
    """A table of a report; shares with a bar have one beside them."""
    bars, texts = block.bars(), tuple(block.text_columns())
    rows: list[list[str | Bar]] = [list(map(words, row)) for row in block.rows]
    if not any(share is not None for share in bars):
        return Table(block.title, block.columns, rows, texts, note=" ".join(block.notes))
    for row, share in zip(rows, bars, strict=True):
        row.append("" if share is None else Bar(0.0, max(0.0, min(share, 1.0))))
    return Table(block.title, [*block.columns, ""], rows, texts, len(block.columns), " ".join(block.notes))
