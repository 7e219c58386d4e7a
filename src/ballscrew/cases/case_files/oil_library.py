"""Oils and greases by name, as their makers state them: those shipped, or those of a file of the user's own."""

from __future__ import annotations

import dataclasses
import functools
import re
import tomllib
from collections.abc import Mapping
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from ballscrew.basis.atomic_files import read_bytes
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.schema.case_schema import read_table
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.data_sheet import DataSheet

#: Bytes of a file of oils at most.
LARGEST_FILE = 4_000_000
_FIELDS = fields_of(DataSheet)
TEXTS: Mapping[str, str] = {
    "source": "where the numbers are from",
    "base_oil": "kind of oil, or base oil of a grease",
    "thickener": "thickener of a grease: the viscosities are those of its base oil",
    "nlgi": "consistency of a grease",
}


class Oils(dict[str, DataSheet]):
    """Data sheets by name: ``bs.oils()["Arcanol LOAD150"]``; an unknown name raises an ``InputError``."""

    def __init__(self, sheets: Mapping[str, DataSheet], file: str) -> None:
        super().__init__(sheets)
        self.file = file

    def __missing__(self, name: str) -> DataSheet:
        like = [known for known, sheet in self.items() if _is_consistency(str(name), sheet)]
        remedy = f"greases of that consistency: {', '.join(like[:5])}" if like else nearest(str(name), self, most=5)
        raise InputError(Fault(self.file, "unknown oil", str(name), remedy))

    def named(self, name: str) -> DataSheet:
        """The oil of that name, whatever its capitals."""
        return self[next((known for known in self if known.casefold() == name.casefold()), name)]


def _is_consistency(name: str, sheet: DataSheet) -> bool:
    """Test whether a name is that of a class of consistency, and a grease of that class."""
    return re.sub(r"[\s_-]+", "-", name.casefold().strip()) in _consistency(sheet).split()


def oils(path: str | Path | None = None) -> Oils:
    """The oils and greases of the library, or of a file of one's own, by name: :class:`Oils`.

    ``path`` is that of the file; without it the library is read.
    ``bs.Lubricant.from_sheet(bs.oils()["Arcanol LOAD150"], temperature=313.15)`` is the oil at a temperature. A file
    has a table ``[oils."name"]`` with units for each (``data/oil_data_sheets.toml`` is of the same form). The numbers
    of a grease are those of its base oil.

    Raises :class:`~ballscrew.basis.errors.InputError` with all faults of the file.
    """
    if path is None:
        return _shipped()
    try:
        text = read_bytes(Path(path), LARGEST_FILE).decode("utf-8-sig")
    except UnicodeDecodeError:
        raise InputError(Fault(str(path), "is not text in UTF-8", "", "save it as UTF-8")) from None
    except (OSError, ValueError) as error:
        problem = "does not exist" if isinstance(error, FileNotFoundError) else "cannot be read"
        raise InputError(Fault(str(path), problem, "", "give the path of a file with oils")) from None
    return _parsed(text, Path(path).name)


def named_oil(name: str, file: str | None, folder: Path) -> DataSheet:
    """The oil that a case names, of the library or of a file beside the case."""
    try:
        return oils(None if file is None else folder / file).named(name)
    except InputError as error:
        where = {"library": "lubricant.oil"} if file is None else {}
        raise InputError(
            *(Fault(where.get(f.where, f.where), f.problem, f.given, f.remedy) for f in error.faults)
        ) from None


@functools.cache
def _shipped() -> Oils:
    text = resources.files("ballscrew").joinpath("data/oil_data_sheets.toml").read_text(encoding="utf-8")
    return _parsed(text, "library")


def _parsed(text: str, file: str) -> Oils:
    """The oils of a text. Raises ``InputError`` with all faults."""
    example = 'write [oils."My oil"] with kinematic_viscosity_40 = "100 cSt" and kinematic_viscosity_100'
    try:
        tables = tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(Fault(file, "is not TOML", str(error), example)) from None
    rows = tables.get("oils")
    faults = [Fault(f"{file}: {name}", "unknown section", "", example) for name in tables if name != "oils"]
    if not isinstance(rows, dict) or not rows:
        raise InputError(*faults, Fault(file, "has no oils", "", example))
    data_sheets: dict[str, DataSheet] = {}
    for name, row in rows.items():
        own: list[Fault] = []
        values = read_table("oils", _model(), row, own)
        try:
            if not own:
                data_sheets[name] = DataSheet(**{"source": file, **values}, name=name)
        except InputError as error:
            own += error.faults
        faults += [_of_row(fault, f'{file}: oils."{name}"') for fault in own]
    if faults:
        raise InputError(*faults)
    return Oils(data_sheets, file)


def _of_row(fault: Fault, where: str) -> Fault:
    """A fault of a row, named by its file and its oil."""
    return dataclasses.replace(fault, where=f"{where}.{fault.where.rpartition('.')[2]}")


@functools.cache
def _model() -> Any:
    texts: dict[str, Any] = {name: (Annotated[str, Field(description=words)], "") for name, words in TEXTS.items()}
    return section_of("Oil", _FIELDS, DataSheet, required=True, **texts)


# -- for people -----------------------------------------------------------------------------------


def _consistency(sheet: DataSheet) -> str:
    """``nlgi-2``; of a grease between two classes both."""
    return " ".join(f"nlgi-{one}" for one in sheet.nlgi.split("-") if one)


def chosen(known: Oils, words: str) -> list[DataSheet]:
    """The oils that have all these words in name, source, base oil, thickener or class of consistency (NLGI 2)."""
    data_sheets = [
        sheet
        for sheet in known.values()
        if all(
            word in f"{sheet.name} {sheet.source} {sheet.base_oil} {sheet.thickener} {_consistency(sheet)}".casefold()
            for word in re.sub(r"\bnlgi[\s_-]*(?=\d)", "nlgi-", words.casefold()).split()
        )
    ]
    if not data_sheets:
        raise InputError(Fault(known.file, "no oil has these words", words, "leave them out to see all oils"))
    return data_sheets
