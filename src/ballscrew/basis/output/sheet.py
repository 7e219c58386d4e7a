"""Sheets: everything that people see of a result, as plain data, in the order in which they read it.

A question makes a sheet of its result; the terminal, reports, pictures, files and the page render it and know no
question. Numbers are SI with their quantity, and whoever renders them shows them in the units of who looks. Texts are
plain texts, which a renderer escapes.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from typing import Any, ClassVar, Literal, TypeAlias

from ballscrew.basis import units
from ballscrew.basis.output.text import plain
from ballscrew.basis.quantities import Array, Quantity
from ballscrew.basis.records import Record

#: Colours by name; each renderer has its own shades of them.
Colour = Literal["ink", "grey", "blue", "orange", "green", "purple", "sky", "red", "yellow"]


@dataclasses.dataclass(frozen=True)
class Number:
    """A number in SI, with the ends of its band where it has one."""

    value: float
    quantity: Quantity
    digits: int = 4
    band: tuple[float, float] | None = None
    #: Rounded down (-1) or up (1), as the end of a band is.
    toward: int = 0


@dataclasses.dataclass(frozen=True)
class Share:
    """A share of a whole, in per cent, and as a bar where there is room, with the ends of its band where it has one."""

    value: float
    bar: bool = True
    band: tuple[float, float] | None = None
    #: A change, with its sign.
    is_change: bool = False


#: A text, a number, a share, or nothing that is known.
Cell: TypeAlias = str | Number | Share | None


#: What a line is: an answer, something to beware of, what was assumed, or anything else.
Kind = Literal["plain", "verdict", "warning", "small"]


@dataclasses.dataclass(frozen=True)
class Line:
    """A sentence without its full stop; a warning has its name before it."""

    text: str
    kind: Kind = "plain"
    name: str = ""
    #: A verdict that something does not hold, or is to be seen to.
    is_bad: bool = False


@dataclasses.dataclass(frozen=True)
class Lines:
    """Sentences, one below the other."""

    kind: ClassVar = "lines"
    lines: Sequence[Line]
    #: Left out where room is short, on pages of a report.
    detail: bool = False


def lines(texts: Iterable[str], kind: Kind = "plain", *, detail: bool = False) -> Lines:
    """Texts of one kind, one below the other."""
    return Lines([Line(text, kind) for text in texts], detail)


def verdict_lines(records: Iterable[Record]) -> Lines:
    """Verdicts."""
    return Lines([verdict_line(record) for record in records])


def verdict_line(record: Record) -> Line:
    """A verdict."""
    return Line(record.text, "verdict", is_bad=record.severity != "info")


def warning_lines(records: Iterable[Record]) -> Lines:
    """Warnings with their names."""
    return Lines([Line(record.text, "warning", record.name) for record in records])


@dataclasses.dataclass(frozen=True)
class Table:
    """Rows of cells below their headings; the first cell of a row is its name, the first heading is empty."""

    kind: ClassVar = "table"
    #: Its key, the name of its sheet in a workbook.
    name: str
    title: str
    columns: Sequence[str]
    rows: Sequence[Sequence[Cell]]
    #: Sentences below it.
    notes: Sequence[str] = ()
    #: Left out where room is short, on pages of a report.
    detail: bool = False
    #: Numbers have no unit, it stands in the title.
    is_compact: bool = False
    #: The fields of the case that its rows are of, for who edits it beside.
    fields: Sequence[str] = ()

    def text_columns(self) -> list[int]:
        """Places of the columns that have texts in them."""
        cells = {index: [row[index] for row in self.rows] for index in range(len(self.columns))}
        return [i for i, column in cells.items() if i == 0 or not any(isinstance(c, Number | Share) for c in column)]

    def bars(self) -> list[float | None]:
        """The share of each row that is drawn as a bar."""
        shares = [[cell.value for cell in row if isinstance(cell, Share) and cell.bar] for row in self.rows]
        return [row[0] if row else None for row in shares]


@dataclasses.dataclass(frozen=True)
class Axis:
    """The axis of a chart."""

    name: str
    quantity: Quantity
    log: bool = False
    #: Where it begins, in SI; by what is drawn where it is not given.
    least: float | None = None


@dataclasses.dataclass(frozen=True)
class Curve:
    """Points of a chart in SI: joined, dashed, as dots or circles, or an area down to zero."""

    name: str
    x: Array
    y: Array
    colour: Colour = "ink"
    style: Literal["line", "dashed", "dotted", "dots", "circles", "area"] = "line"
    #: Drawn on the second axis.
    second: bool = False
    #: Texts beside its first points.
    labels: Sequence[str] = ()


@dataclasses.dataclass(frozen=True)
class Band:
    """The area between two curves, in a light shade, or solid as a part of what is stacked."""

    name: str
    x: Array
    low: Array
    high: Array
    colour: Colour = "ink"
    solid: bool = False


@dataclasses.dataclass(frozen=True)
class Level:
    """A value of the vertical axis that holds along the whole chart."""

    name: str
    y: float
    colour: Colour = "grey"


@dataclasses.dataclass(frozen=True)
class Vertical:
    """A value of the horizontal axis that holds along the whole chart."""

    name: str
    x: float
    colour: Colour = "grey"


@dataclasses.dataclass(frozen=True)
class Chart:
    """Curves over a horizontal axis."""

    kind: ClassVar = "chart"
    title: str
    x: Axis
    y: Axis
    marks: Sequence[Curve | Band | Level | Vertical]
    second: Axis | None = None
    #: Left out where room is short, on pages of a report.
    detail: bool = False


@dataclasses.dataclass(frozen=True)
class Map:
    """Values over two axes as colours, in rows along the horizontal one."""

    kind: ClassVar = "map"
    title: str
    x: Axis
    y: Axis
    value: Axis
    places: tuple[Array, Array]
    values: Array
    marks: Sequence[Curve | Level | Vertical] = ()
    #: Left out where room is short, on pages of a report.
    detail: bool = False


@dataclasses.dataclass(frozen=True)
class Bar:
    """A bar by its name: parts one after the other, each with its name, value and colour; a heading has none."""

    name: str
    parts: Sequence[tuple[str, float, Colour]] = ()
    #: The ends of the band of their sum.
    band: tuple[float, float] | None = None
    #: What stands to its right.
    text: str = ""
    hatched: bool = False
    #: Where it begins, if not where all bars do.
    start: float | None = None


@dataclasses.dataclass(frozen=True)
class Bars:
    """Values by name, from the top down."""

    kind: ClassVar = "bars"
    title: str
    quantity: Quantity
    bars: Sequence[Bar]
    marks: Sequence[Vertical] = ()
    #: Where bars begin; their parts are what goes beyond.
    origin: float = 0.0
    #: Left out where room is short, on pages of a report.
    detail: bool = False


@dataclasses.dataclass(frozen=True)
class Column:
    """Values of one kind: numbers in SI, or texts where there is no quantity."""

    name: str
    values: Array
    quantity: Quantity | None = None


@dataclasses.dataclass(frozen=True)
class Columns:
    """A long table for files."""

    kind: ClassVar = "columns"
    name: str
    columns: Sequence[Column]


#: Values of a row by the names of their columns: numbers in SI with their quantity, or what has no unit.
Cells: TypeAlias = Mapping[str, tuple[Any, Quantity | None]]


class _OfRows(Sequence[Column]):
    """Columns of rows, which are made when they are first read: few faces show them."""

    def __init__(self, rows: Callable[[], Iterable[Cells]]) -> None:
        self._rows = rows

    @functools.cached_property
    def _columns(self) -> Sequence[Column]:
        rows = list(self._rows())
        quantities = {heading: quantity for cells in reversed(rows) for heading, (_, quantity) in cells.items()}
        headings = dict.fromkeys(heading for cells in rows for heading in cells)
        return [
            Column(heading, [cells.get(heading, (None, None))[0] for cells in rows], quantities[heading])
            for heading in headings
        ]

    def __getitem__(self, place: Any) -> Any:
        return self._columns[place]

    def __len__(self) -> int:
        return len(self._columns)


def columns_of(name: str, rows: Callable[[], Iterable[Cells]]) -> Columns:
    """A table of rows that need not have the same columns; those of the first come first."""
    return Columns(name, _OfRows(rows))


Block: TypeAlias = Lines | Table | Chart | Map | Bars | Columns


@dataclasses.dataclass(frozen=True)
class Sheet:
    """A title in one sentence, and blocks in the order of reading."""

    title: str
    blocks: Sequence[Block]

    def __post_init__(self) -> None:
        names = [block.name for block in self.of_kind(Table, Columns)]
        assert len({*names}) == len(names), f"two tables of one name: {names}"

    def of_kind(self, *kinds: type[Any]) -> Iterator[Any]:
        """The blocks of some kinds, in their order."""
        return (block for block in self.blocks if isinstance(block, kinds))


def words(cell: Cell, *, with_unit: bool = True) -> str:
    """A cell as people write it: numbers in display units, ends of a band rounded outward, a dash for nothing."""
    match cell:
        case None:
            return "–"
        case Number(value, quantity, digits, band, toward):
            has_band = band is not None and math.isfinite(value)
            ends = _band_in_words(band, lambda end, to: plain(units.rounded(end, quantity, digits, to))) * has_band
            return f"{_in_words(value, quantity, digits, toward, with_unit)}{ends}"
        case Share(value, is_change=True):
            return f"{value:+.1%}" if math.isfinite(value) and round(value, 3) else words(Share(value))
        case Share(value, _, band):
            if not math.isfinite(value):
                return "–"
            tenths = round(value, 3) + 0.0  # no "-0.0%"
            return f"{tenths:.1%}{_band_in_words(band, _percent)}"
        case _:
            return cell


def _band_in_words(band: tuple[float, float] | None, written: Callable[[float, int], str]) -> str:
    """The ends of a band behind a value, written as rounded down and up; nothing where they are not apart."""
    if band is None or not all(map(math.isfinite, band)) or not band[1] > band[0]:
        return ""
    return f" ({written(band[0] + 0.0, -1)} to {written(band[1] + 0.0, 1)})"


def _percent(end: float, toward: int) -> str:
    """The end of the band of a share, to a tenth down or up."""
    tenths = round(1000 * end, 9)  # 0.29 is a little less than it
    return f"{(math.ceil(tenths) if toward > 0 else math.floor(tenths)) / 10 + 0.0:.1f}%"


def _in_words(value: float, quantity: Quantity, digits: int, toward: int, with_unit: bool) -> str:
    if math.isfinite(value):
        written = units.shown if with_unit else units.rounded
        return plain(written(value + 0.0, quantity, digits, toward))  # adding zero: no "-0"
    return "infinite" if value > 0 else "–"


def document(sheet: Sheet) -> dict[str, Any]:
    """A sheet as JSON: each block with its kind, each number with its value in SI and its unit."""
    blocks = [block for block in sheet.blocks if not isinstance(block, Lines) or block.lines]
    return {"title": sheet.title, "blocks": [{"kind": block.kind, **_data(block)} for block in blocks]}


def _data(part: Any) -> Any:
    if isinstance(part, Quantity):
        return {"unit": part.unit, "shown_in": part.shown_in}
    if isinstance(part, Number):
        band = {} if part.band is None else {"band": [_data(end) for end in part.band]}
        shown = {"unit": part.quantity.unit, "shown_in": part.quantity.shown_in, "digits": part.digits}
        toward = {"toward": part.toward} if part.toward else {}
        infinite = {"infinite": True} if math.isinf(part.value) and part.value > 0 else {}
        return {"value": _data(part.value), **shown, **toward, **infinite, **band}
    if isinstance(part, Share):
        band = {} if part.band is None else {"band": [_data(end) for end in part.band]}
        return {"share": _data(part.value), "bar": part.bar, "is_change": part.is_change, **band}
    if dataclasses.is_dataclass(part):
        return {field.name: _data(getattr(part, field.name)) for field in dataclasses.fields(part)}
    if hasattr(part, "tolist"):  # an array of NumPy, or a number of its own
        return _data(part.tolist())
    if isinstance(part, float):
        return part if math.isfinite(part) else None
    if isinstance(part, str | bool | int | None):
        return part
    return [_data(each) for each in part]


def sentence(words: str) -> str:
    """Words with a capital at their beginning."""
    return f"{words[:1].upper()}{words[1:]}"
