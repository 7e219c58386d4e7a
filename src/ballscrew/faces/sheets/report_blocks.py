"""Blocks of a report as plain data: sections of paragraphs, lists, tables and pictures; those of a sheet.

Texts are texts: whoever writes a report to a file escapes them there.
"""

from __future__ import annotations

import dataclasses
import math
import re
from collections.abc import Mapping, Sequence
from typing import Any, TypeAlias

from ballscrew.basis import units
from ballscrew.basis.output.sheet import Bars, Chart, Lines, Map, Sheet, sentence, words
from ballscrew.basis.output.sheet import Table as SheetTable
from ballscrew.basis.output.text import plain
from ballscrew.basis.quantities import Quantity
from ballscrew.questions.shared.charts import named, svg_of


@dataclasses.dataclass(frozen=True)
class Bar:
    """A stretch of an axis from 0 to 1, with a mark on it where there is one; it repeats what numbers say."""

    start: float
    end: float
    mark: float | None = None


@dataclasses.dataclass(frozen=True)
class Paragraph:
    """Some sentences."""

    text: str
    strong: bool = False


@dataclasses.dataclass(frozen=True)
class Bullets:
    """A list."""

    entries: Sequence[str]


@dataclasses.dataclass(frozen=True)
class Links:
    """Sources: words, and the address where they are found, if there is one."""

    entries: Sequence[tuple[str, str]]


@dataclasses.dataclass(frozen=True)
class Table:
    """Columns by heading, and rows. The first cell of a row is its heading; ``texts`` are the columns of words."""

    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[str | Bar]]
    texts: Sequence[int] = (0,)
    #: The column that takes what room is left.
    wide: int = 0
    note: str = ""


@dataclasses.dataclass(frozen=True)
class Picture:
    """An SVG drawing, what it shows in words, and what stands below it."""

    svg: str
    words: str
    caption: str
    #: Share of the width of a page.
    width: float = 1.0


@dataclasses.dataclass(frozen=True)
class Columns:
    """Tables that stand beside each other where there is room."""

    left: Sequence[Table]
    right: Sequence[Table]

    @classmethod
    def of(cls, tables: Sequence[Table]) -> Columns:
        """Tables in their order, cut in two where both columns are as long as they can be alike."""
        lengths = [_HEAD + len(table.rows) for table in tables]
        cut = min(range(len(tables) + 1), key=lambda cut: max(sum(lengths[:cut]), sum(lengths[cut:])))
        return cls(tables[:cut], tables[cut:])


#: What people wrote stays as it is.
_OF_PEOPLE = ("heading",)
_BETWEEN_TAGS = re.compile(r">[^<]+<")
#: Rows that the title and the headings of a table take.
_HEAD = 2.5
Block: TypeAlias = Paragraph | Bullets | Links | Table | Picture | Columns


@dataclasses.dataclass(frozen=True)
class Section:
    """A heading and what stands below it."""

    title: str
    blocks: Sequence[Block]


@dataclasses.dataclass(frozen=True)
class Report:
    """A whole report."""

    title: str
    subtitle: Sequence[str]
    sections: Sequence[Section]
    #: What wrote it, on every page.
    made_by: str
    #: Pages at most, as far as a smaller type can do it.
    pages: int = 5
    #: Whose report it is, and of when, where somebody says so.
    heading: Sequence[str] = ()


def value(number: float, quantity: Quantity) -> str:
    """A number with its unit, written as people do; a dash where there is none."""
    if not math.isfinite(number):
        return "–"
    digits, unit = plain(units.rounded(number + 0.0, quantity)), units.label(quantity)
    return f"{digits} {unit}" if unit else digits


def as_data(report: Report) -> dict[str, Any]:
    """A report as JSON has it; each block and each bar with its kind. No text has a number with an exponent."""

    def data(part: Any, name: str = "") -> Any:
        if dataclasses.is_dataclass(part) and not isinstance(part, type):
            fields: Mapping[str, Any] = {f.name: data(getattr(part, f.name), f.name) for f in dataclasses.fields(part)}
            return {"kind": type(part).__name__, **fields}
        if isinstance(part, list | tuple):
            return [data(each, name) for each in part]
        if not isinstance(part, str) or name in _OF_PEOPLE:
            return part
        return _BETWEEN_TAGS.sub(lambda result: plain(result[0]), part) if name == "svg" else plain(part)

    values: dict[str, Any] = data(report)
    return values


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
