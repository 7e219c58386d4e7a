"""Files of cases, opened: a case file, a project, a table of screws, or a need, as named designs.

Nothing is computed and no case is built: one at fault is opened, too, and its faults are found when it is run.
"""

from __future__ import annotations

import dataclasses
import os
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ballscrew.basis.atomic_files import read_bytes
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files import case_file, case_text, project
from ballscrew.cases.case_files.project import Design
from ballscrew.cases.screw_tables import catalogue
from ballscrew.files.tables.sheets import is_spreadsheet
from ballscrew.physics.sizing.catalogue import CatalogueRow

#: Fields, in any table of a case, that name a file beside it.
FIELDS = ("file", "catalogue_file", "oil_file")


def moved(value: Any, old: Path, new: Path) -> Any:
    """Tables of a case in the folder ``old`` for one in ``new``: the same files, as they lie from there.

    A path that is absolute stays.
    """
    if isinstance(value, Mapping):
        return {
            key: _from(new, old / item)
            if key in FIELDS and isinstance(item, str) and not Path(item).is_absolute()
            else moved(item, old, new)
            for key, item in value.items()
        }
    return [moved(item, old, new) for item in value] if isinstance(value, list) else value


def _from(folder: Path, file: Path) -> str:
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # on another drive
        return file.resolve().as_posix()


#: Endings of files that are tables as text.
_TABLES = (".csv", ".tsv")
#: Columns of a log, of which it has one of either kind.
_TORQUES = frozenset({"torque", "friction_torque", "drive_torque", "current"})
_CONDITIONS = frozenset({"axial_load", "screw_speed", "feed_rate", "position", "time"})
#: What a document of results has, and no case.
_OF_RESULTS = ("inputs", "results")


@dataclasses.dataclass(frozen=True)
class OpenedFile:
    """The designs of a file, and what of it no design has."""

    #: ``case``, ``project``, ``table`` or ``need``.
    kind: str
    designs: Sequence[Design]
    #: The number of comments, which are in no design.
    comments: int = 0
    #: Columns that are not used, rows that are left out, and values that are kept as text.
    notes: Sequence[str] = ()


def opened(path: Path) -> OpenedFile:
    """The designs of a file. Raises :class:`~ballscrew.basis.errors.InputError` where it has none.

    Tables that no case has are kept aside. Values that JSON has not are kept as text: dates, what is not finite, and
    whole numbers beyond 2^53.
    """
    result = _opened(path)
    notes = list(result.notes)
    designs = [
        Design(one.name, *(case_text.for_json("", tables, notes) for tables in (one.tables, one.aside)))
        for one in result.designs
    ]
    return dataclasses.replace(result, designs=designs, notes=notes)


def is_table(path: Path) -> bool:
    """Test whether a file is opened as a table."""
    begin = read_bytes(path, case_text.LARGEST_FILE)[:8] if path.is_file() else b""
    return path.suffix.lower() in _TABLES or is_spreadsheet(path, begin)


def _opened(path: Path) -> OpenedFile:
    if is_table(path):
        rows = _screws(path)
        return OpenedFile("table", [Design(row.name, tables_of_row(row)) for row in rows.values()], notes=rows.notes)
    tables = case_text.tables_at(path)
    comments = case_text.comments_at(path)
    if project.is_project(tables):
        return OpenedFile("project", [_kept(one) for one in project.designs_of(tables, path.name)], comments)
    if "need" in tables and "screw" not in tables:
        return OpenedFile("need", [Design(path.stem, tables)], comments)
    if list(tables) == ["case"] and isinstance(tables["case"], dict):  # as the API takes it
        tables = tables["case"]
    if all(name in tables for name in _OF_RESULTS):
        remedy = "open the case file that it came from, or save that as TOML"
        raise InputError(Fault(path.name, "has results and no case", "", remedy))
    return OpenedFile("case", [_kept(Design(path.stem, tables))], comments)


def _screws(path: Path) -> catalogue.Screws:
    """The rows of a table of screws; a log of torques, which is opened elsewhere, is called what it is."""
    try:
        return catalogue.screws(path, keep_going=True)
    except InputError:
        if not _is_log(path):
            raise
    remedy = "use it in Calibrate or Service of the page, or by ballscrew fit or service"
    raise InputError(Fault(path.name, "is a log of torques and no table of screws", "", remedy))


def _is_log(path: Path) -> bool:
    """Test whether a table has a torque, and what belongs to it."""
    from ballscrew.files.torque_logs.reading import preview  # loads pandas: for tables that are no screws

    try:
        values = {column.taken_for for column in preview(path).columns}
    except InputError:
        return False
    return bool(values & _TORQUES) and bool(values & _CONDITIONS)


def _kept(design: Design) -> Design:
    """A design with all tables that no case has kept aside, beside what its file keeps so."""
    known = {name: value for name, value in design.tables.items() if name in case_file.SECTIONS}
    others: dict[str, Any] = {name: value for name, value in design.tables.items() if name not in known}
    aside = known.get(case_file.ASIDE)
    if isinstance(aside, dict):
        others |= known.pop(case_file.ASIDE)
    return Design(design.name, known, {**others, **design.aside})


def tables_of_row(row: CatalogueRow) -> dict[str, Any]:
    """The case of a row by its numbers, so that it needs no table: a usual oil, a tenth of its rating, 600 rpm."""
    return tomllib.loads(catalogue.case_text(row))
