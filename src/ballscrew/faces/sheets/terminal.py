"""A sheet as text on the terminal: its lines and tables; charts and long tables are for pictures and files."""

from __future__ import annotations

import itertools
import operator
from collections.abc import Iterator

from ballscrew.basis.output.sheet import Line, Lines, Sheet, Table, words
from ballscrew.basis.output.text import aligned, beside, wrapped

_BAR = 24


def text(sheet: Sheet, encoding: str = "utf-8") -> str:
    """The title, then each block after an empty line; bars in letters that the encoding has."""
    bar = "█" if "utf" in encoding.lower() else "#"
    lines = [wrapped(sheet.title)]
    for block in sheet.of_kind(Lines, Table):
        is_text = isinstance(block, Lines)
        shown = [wrapped(line_text(line)) for line in block.lines] if is_text else list(_table(block, bar))
        lines += ["", *shown] if shown else []
    return "\n".join(lines)


def line_text(line: Line) -> str:
    """A line of a sheet; a warning has its name before it."""
    return f"warning  {line.name}: {line.text}" if line.kind == "warning" else line.text


def _table(table: Table, bar: str) -> Iterator[str]:
    texts, last = table.text_columns(), len(table.columns) - 1
    cells = [[f"  {row[0]}", *(words(cell, with_unit=not table.is_compact) for cell in row[1:])] for row in table.rows]
    is_heading = [last > 0 and not any(row[1:]) for row in cells]  # it runs over all columns
    rows = [[table.title, *table.columns[1:]], *itertools.compress(cells, map(operator.not_, is_heading))]
    if last > 0 and last in texts:  # words go on below themselves
        ends = [row.pop() for row in rows]
    else:
        ends = ["", *(bar * round(_BAR * max(0.0, min(share or 0.0, 1.0))) for share in table.bars())]
    prefixes = aligned(rows, texts)
    width = max(map(len, prefixes)) + 2
    lines = [beside(prefix.ljust(width), end).rstrip() for prefix, end in zip(prefixes, ends, strict=False)]
    yield lines.pop(0)
    for row, heads in zip(cells, is_heading, strict=True):
        yield row[0] if heads else lines.pop(0)
    yield from (wrapped(f"  {note}") for note in table.notes)
