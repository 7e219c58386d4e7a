"""All rows of a table, one after the other: what is computed of each, and which of them are left out, and why."""

from __future__ import annotations

import csv
import dataclasses
import importlib.util
import io
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, Generic, NamedTuple, TypeVar

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables import catalogue
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.questions.shared.own_screws import tables_of_row

T = TypeVar("T")
R = TypeVar("R")
#: Told how many rows of how many are done.
Done = Callable[[int, int], None]


@dataclasses.dataclass(frozen=True, eq=False)
class OfRows(Generic[R]):
    """What was found for each row, by its name, and what is to be said of the others."""

    found: Mapping[str, R]
    notes: Sequence[str]
    #: Ctrl-C came before all rows were done.
    interrupted: bool = False


@dataclasses.dataclass(frozen=True, eq=False)
class RowCase:
    """The case of a row: the tables it was built from, and the log that the row names."""

    row: CatalogueRow
    tables: Mapping[str, Any]
    case: Case
    log: Path | None = None

    @property
    def place(self) -> str:
        """The name of the row and where it stands, for messages."""
        return place_of(self.row)


def place_of(row: CatalogueRow) -> str:
    """``A-40x10 (screws.csv row 3)``."""
    return f"{row.name} ({row.source})"


def cases(
    case: Path,
    table: Path,
    name: str | None = None,
    *,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
    keep_going: bool = False,
    done: Done | None = None,
) -> OfRows[RowCase]:
    """The case of a file with each screw of a table, or with that of one row, in place of its own.

    Settings are put into each. Raises :class:`~ballscrew.basis.errors.InputError` with the faults of all rows; with
    ``keep_going`` only if none is good.
    """
    tables = case_file.read(case)
    screws = catalogue.screws(table, keep_going=keep_going)
    chosen = list(screws.values()) if name is None else [catalogue.named(screws, name, file=table)]

    def built(row: CatalogueRow) -> RowCase:
        own = case_file.override(copied(tables_of_row(tables, row, table)), settings)
        made = case_file.build(own, model, case.parent, {row.name: row}, calibration=calibration, allow_code=allow_code)
        return RowCase(row, own, made, screws.logs.get(row.name))

    result = each({place_of(row): row for row in chosen}, built, keep_going=keep_going, done=done)
    return dataclasses.replace(
        result, found={row.row.name: row for row in result.found.values()}, notes=[*screws.notes, *result.notes]
    )


def copied(value: Any) -> Any:
    """Nested tables, to be changed."""
    return {key: copied(item) for key, item in value.items()} if isinstance(value, dict) else value


def each(
    rows: Mapping[str, T], work: Callable[[T], R], *, keep_going: bool = False, done: Done | None = None
) -> OfRows[R]:
    """The work for each row, by the words that name the row in messages.

    Raises :class:`~ballscrew.basis.errors.InputError` with the faults of all rows, or with those of one where all are
    the same; with ``keep_going`` only if no row is good. On Ctrl-C what is done by then is returned, if anything is.
    """
    results: dict[str, R] = {}
    faults: dict[str, Sequence[Fault]] = {}
    interrupted = False
    try:
        for number, (place, row) in enumerate(rows.items(), start=1):
            try:
                results[place] = work(row)
            except InputError as error:
                faults[place] = error.faults
            if done is not None:
                done(number, len(rows))
    except KeyboardInterrupt:
        if not results:
            raise
        interrupted = True
    if faults and not results and len({tuple(map(str, those)) for those in faults.values()}) == 1:
        raise InputError(*next(iter(faults.values())))  # the options or the case are at fault, not the rows
    by_row = [dataclasses.replace(f, where=f"{place}, {f.where}") for place, those in faults.items() for f in those]
    if not (keep_going and results):
        raise_if_any(by_row)
    notes = [*map(str, by_row), *([f"{len(faults)} of {len(rows)} rows left out"] if faults else [])]
    if interrupted:
        done_by_then = f"{len(results)} of {len(rows)} are done and kept, the last is {list(results)[-1]}"
        notes.append(f"interrupted: {done_by_then} · run the same again for all")
    return OfRows(results, notes, interrupted)


_DIGITS = 12
#: Endings of files that are written.
KINDS = (".csv", ".xlsx")


class RowTable(NamedTuple):
    """Headings, and the cells of each row below them."""

    headings: Sequence[str]
    rows: Sequence[Sequence[Any]]


# -- files ----------------------------------------------------------------------------------------


def check_path(to: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later."""
    if to.suffix.lower() not in KINDS:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .csv or .xlsx"))
    if to.suffix.lower() == ".xlsx" and importlib.util.find_spec("xlsxwriter") is None:
        raise InputError(Fault("--to", "needs xlsxwriter", str(to), 'pip install "ballscrew[data]"'))
    check_writable("--to", to)


def write_csv(path: Path, table: RowTable) -> None:
    """The rows of a table as CSV, below its headings."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows([table.headings, *table.rows])


def xlsx_bytes(tables: Mapping[str, RowTable]) -> bytes:
    """A workbook with a sheet for each table, by title."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True})
    bold = workbook.add_format({"bold": True})
    for title, table in tables.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1)
        for number, row in enumerate([table.headings, *table.rows]):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()
