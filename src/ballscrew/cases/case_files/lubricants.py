"""The oil of a case: by its viscosity, its data sheet, its name in a library, or its grade."""

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

from ballscrew.basis import units
from ballscrew.basis.atomic_files import read_bytes
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.units import in_display_units
from ballscrew.cases.schema.case_schema import read_table
from ballscrew.cases.schema.fields import section_of
from ballscrew.cases.schema.reader import Reader
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import SHEET_TEMPERATURE, DataSheet

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


#: What tells an oil, each on its own; a library and a data sheet go together, the sheet over the library.
_POINTS = ("kinematic_viscosity_40", "kinematic_viscosity_100")
#: The keys of an oil that follows the temperature.
OF_NAMED_OIL = ("grade", "oil", "oil_file", "temperature", *fields_of(DataSheet))


def lubricant_of(reader: Reader) -> tuple[Lubricant | None, Mapping[str, Any]]:
    """The oil of a section and, where it follows the temperature, what it was made from."""
    part = reader.part()
    table, values = reader.tables["lubricant"], reader.values_of("lubricant")
    if isinstance(table, dict):
        reader.faults += _contradictions(table)
    if part.is_faulty:
        return None, {}
    temperature = {name: values.pop(name) for name in ("temperature",) if name in values}
    of_sheet = {name: values.pop(name) for name in fields_of(DataSheet) if name in values}
    grade, name, file = (values.pop(key, None) for key in ("grade", "oil", "oil_file"))
    if not temperature and not of_sheet and grade is None and name is None:
        return Lubricant(**values), {}
    try:
        if grade is not None:
            oil = Lubricant.from_grade(grade, **temperature)
            made_from: dict[str, Any] = {"grade": grade, **temperature}
        else:
            sheet = DataSheet(**of_sheet) if name is None else named_oil(name, file, reader.folder)
            sheet = dataclasses.replace(sheet, **of_sheet)
            oil = Lubricant.from_sheet(sheet, **temperature)
            named = {} if name is None else {"oil": sheet.name, "oil_source": sheet.source}
            written = {key: getattr(sheet, key) for key in fields_of(DataSheet) if getattr(sheet, key) is not None}
            made_from = {**named, **written, **temperature}
    except InputError as error:
        reader.faults += [_shown(fault, table) for fault in error.faults]
        return None, {}
    return dataclasses.replace(oil, **values), made_from


def _contradictions(table: Mapping[str, Any]) -> list[Fault]:
    """Faults of a table that tells its oil in two ways, in half a way, or not at all."""
    return [*_told_twice(table), *_told_in_half(table), *_not_told(table)]


def _points(table: Mapping[str, Any]) -> list[str]:
    """The viscosities of a data sheet that a table has."""
    return [name for name in _POINTS if name in table]


def _of_data_sheet(table: Mapping[str, Any]) -> list[str]:
    """The other numbers of a data sheet that a table has."""
    return [name for name in fields_of(DataSheet) if name in table and name not in _POINTS]


def _follows_temperature(table: Mapping[str, Any]) -> bool:
    """Test whether a table tells an oil at all temperatures."""
    return "grade" in table or "oil" in table or bool(_points(table))


def _told_twice(table: Mapping[str, Any]) -> list[Fault]:
    """Faults of a table with two ways of telling an oil."""
    pairs = [("viscosity", "grade", "the grade")]
    pairs += [(other, name, name) for name in ("oil", *_points(table)[:1]) for other in ("grade", "viscosity")]
    return [
        Fault(
            f"lubricant.{one}",
            f"contradicts {words}",
            f"{table[one]} and {table[other]}",
            f"give one of the two; --set lubricant.{other}= takes this away",
        )
        for one, other, words in pairs
        if one in table and other in table
    ]


def _told_in_half(table: Mapping[str, Any]) -> list[Fault]:
    """Faults of keys that tell an oil only beside others, which a table lacks."""
    faults: list[Fault] = []
    points, others = _points(table), _of_data_sheet(table)
    if "temperature" in table and not _follows_temperature(table):
        remedy = 'add grade = "ISO VG 100", or kinematic_viscosity_40 and kinematic_viscosity_100'
        faults.append(
            Fault("lubricant.temperature", "needs a grade or a data sheet", str(table["temperature"]), remedy)
        )
    if "oil" in table:
        return faults
    if len(points) == 1:
        missing = next(name for name in _POINTS if name not in table)
        faults.append(Fault(f"lubricant.{missing}", MISSING, "", f'add {missing} = "… cSt"'))
    if others and not points:
        remedy = "add kinematic_viscosity_40 and kinematic_viscosity_100, or leave it out"
        faults.append(Fault(f"lubricant.{others[0]}", "is of a data sheet", str(table[others[0]]), remedy))
    if "oil_file" in table:
        faults.append(Fault("lubricant.oil_file", "needs the name of an oil", str(table["oil_file"]), 'add oil = "…"'))
    return faults


def _not_told(table: Mapping[str, Any]) -> list[Fault]:
    """The fault of a table that tells no oil at all."""
    if _follows_temperature(table) or _of_data_sheet(table) or {"viscosity", "temperature"} & set(table):
        return []
    remedy = (
        'add kinematic_viscosity_40 and kinematic_viscosity_100, or grade = "ISO VG 100", and a temperature, '
        'or viscosity = "… mPa s"'
    )
    return [Fault("lubricant.viscosity", MISSING, "", remedy)]


def _shown(fault: Fault, table: Mapping[str, Any]) -> Fault:
    """A fault with its bound in display units and its value as it is written."""
    known = {**fields_of(DataSheet), "temperature": SHEET_TEMPERATURE}
    name = fault.where.rpartition(".")[2]
    if fault.bound is None or name not in known:
        return fault
    return in_display_units(fault, known[name], str(table.get(name, fault.given)))


def described(oil: Mapping[str, Any]) -> str:
    """The oil by what it was made from: ``ISO VG 100``, ``with 100 cSt at 40 °C and 11.1 cSt at 100 °C``."""
    if "grade" in oil:
        return str(oil["grade"])
    if "oil" in oil:
        return str(oil["oil"])
    known = fields_of(DataSheet)
    warm, hot = (units.shown(oil[name], known[name]) for name in _POINTS)
    return f"with {warm} at 40 °C and {hot} at 100 °C"
