"""All rows of a table, one after the other: what is computed of each, and which are left out, and why."""

from __future__ import annotations

import csv
import dataclasses
import importlib.util
import io
from collections.abc import Callable, Container, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, Generic, TypeAlias, TypeVar

from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables import catalogue
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.components.nut import NUTS, Bodies
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.ratings import lists_preload
from ballscrew.questions.shared.question import Done

T = TypeVar("T")
R = TypeVar("R")


@dataclasses.dataclass(frozen=True, eq=False)
class OfRows(Generic[R]):
    """Results for each row, by its name, and what is to be said of the others."""

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


#: Endings of files that are written.
KINDS = (".csv", ".xlsx")
#: The rows of a table, the first of which has its headings.
Rows: TypeAlias = Iterable[Sequence[Any]]


# -- files ----------------------------------------------------------------------------------------


def check_path(to: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later."""
    if to.suffix.lower() not in KINDS:
        raise InputError(Fault("--to", "unknown kind of file", str(to), "end it in .csv or .xlsx"))
    if to.suffix.lower() == ".xlsx" and importlib.util.find_spec("xlsxwriter") is None:
        raise InputError(Fault("--to", "needs xlsxwriter", str(to), 'pip install "ballscrew[data]"'))
    check_writable("--to", to)


def write_csv(path: Path, rows: Rows) -> None:
    """The rows of a table as CSV."""
    with path.open("w", encoding="utf-8", newline="") as stream:
        csv.writer(stream, lineterminator="\n").writerows(rows)


def xlsx_bytes(tables: Mapping[str, Rows], without_names: Container[str] = ()) -> bytes:
    """A workbook with a sheet for each table, by title; the first column stays in sight, where it has names."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True, "nan_inf_to_errors": True})
    bold = workbook.add_format({"bold": True})
    for title, rows in tables.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 0 if title in without_names else 1)
        for number, row in enumerate(rows):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()


#: What a row says of the screw; the rest, as roughness and materials, is that of the case.
_OF_ROW = frozenset(
    {
        "catalogue", "catalogue_file", "pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls",
        "contact_angle", "screw_conformity", "nut_conformity", "starts", *LISTED,
    }
)  # fmt: skip
#: What braces a nut: given by a row, or by the case.
_BRACING = ("preload", "oversize")


def tables_of_row(tables: Mapping[str, Any], row: CatalogueRow, file: Path | None) -> dict[str, Any]:
    """The tables of a case with the screw of a row of a file, or of one shipped, in place of its own.

    The geometry is that of the row, and so are the nut, its preload, its seals and its outer diameter where the row
    lists them; what it does not list is that of the case. Sizes of bodies of the case belong to its own screw.
    """
    made = dict(tables)
    screw = made.get("screw", {})
    if isinstance(screw, Mapping):
        kept = {name: value for name, value in screw.items() if name not in _OF_ROW}
        of_file = {} if file is None else {"catalogue_file": str(file.resolve())}
        made["screw"] = {"catalogue": row.name, **of_file, **kept}
    if isinstance(nut := made.get("nut"), Mapping):
        made["nut"] = _nut(nut, row)
    if isinstance(bodies := made.get("bodies"), Mapping):
        made["bodies"] = {name: value for name, value in bodies.items() if name not in fields_of(Bodies)}
    if isinstance(losses := made.get("losses"), Mapping) and row.seal_torque is not None:
        made["losses"] = {name: value for name, value in losses.items() if name != "seals"}
    return made


def _nut(nut: Mapping[str, Any], row: CatalogueRow) -> dict[str, Any]:
    """The section of the nut without what the row lists, and what its kind of nut does not have."""
    nut = {name: value for name, value in nut.items() if name != "spacer_balls" or row.spacer_balls is None}
    if not row.nut:
        return nut
    known = fields_of(NUTS[row.nut])
    listed = _BRACING if lists_preload(row) else ()
    # a name that no nut has stays: it is a fault of the case
    of_others = {name for kind in NUTS.values() for name in fields_of(kind)} - set(known)
    return {name: value for name, value in nut.items() if name not in {"type", *listed, *of_others}}
