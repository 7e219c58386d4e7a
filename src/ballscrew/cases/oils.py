"""Oils and greases by name, as their makers state them: those shipped, or those of a file of the user's own."""

from __future__ import annotations

import dataclasses
import functools
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from ballscrew import units
from ballscrew._version import __version__
from ballscrew.cases.fields import section_of
from ballscrew.cases.schema import read_table
from ballscrew.components.data_sheet import DataSheet
from ballscrew.components.materials import Lubricant
from ballscrew.errors import Fault, InputError, nearest
from ballscrew.files import read_bytes
from ballscrew.quantities import fields_of

#: Bytes of a file of oils at most.
LARGEST_FILE = 4_000_000
_FIELDS = fields_of(DataSheet)
_TEXTS: Mapping[str, str] = {
    "source": "where the numbers are from",
    "base_oil": "base oil of a grease",
    "thickener": "thickener of a grease: the viscosities are those of its base oil",
    "nlgi": "consistency of a grease",
}
_COLUMNS = ("name", "40 °C [cSt]", "100 °C [cSt]", "VI", "15 °C [kg/m³]", "from [°C]", "to [°C]", "thickener", "source")
#: Temperatures at which an oil is shown, °C.
_SHOWN_AT = (-40, -20, 0, 20, 40, 60, 80, 100, 120)
_OF_TEXT = (0, len(_COLUMNS) - 2, len(_COLUMNS) - 1)


class Oils(dict[str, DataSheet]):
    """Data sheets by name: ``bs.oils()["Arcanol LOAD150"]``; an unknown name raises an ``InputError``."""

    def __init__(self, sheets: Mapping[str, DataSheet], file: str) -> None:
        super().__init__(sheets)
        self.file = file

    def __missing__(self, name: str) -> DataSheet:
        raise InputError(Fault(self.file, "unknown oil", str(name), nearest(str(name), self, most=5)))

    def named(self, name: str) -> DataSheet:
        """The oil of that name, whatever its capitals."""
        return self[next((known for known in self if known.casefold() == name.casefold()), name)]


def oils(path: str | Path | None = None) -> Oils:
    """The oils and greases of the library, or of a file of one's own, by name.

    ``bs.Lubricant.from_sheet(bs.oils()["Arcanol LOAD150"], temperature=313.15)`` is the oil at a temperature. A file
    has a table ``[oils."name"]`` with units for each (``data/oils.toml`` is of the same form). The numbers of a grease
    are those of its base oil.

    Raises :class:`~ballscrew.errors.InputError` with all faults of the file.
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
    text = resources.files("ballscrew").joinpath("data/oils.toml").read_text(encoding="utf-8")
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
    found: dict[str, DataSheet] = {}
    for name, row in rows.items():
        own: list[Fault] = []
        values = read_table("oils", _model(), row, own)
        try:
            if not own:
                found[name] = DataSheet(**{"source": file, **values}, name=name)
        except InputError as error:
            own += error.faults
        faults += [_of_row(fault, f'{file}: oils."{name}"') for fault in own]
    if faults:
        raise InputError(*faults)
    return Oils(found, file)


def _of_row(fault: Fault, where: str) -> Fault:
    """A fault of a row, named by its file and its oil."""
    return dataclasses.replace(fault, where=f"{where}.{fault.where.rpartition('.')[2]}")


@functools.cache
def _model() -> Any:
    texts: dict[str, Any] = {name: (Annotated[str, Field(description=words)], "") for name, words in _TEXTS.items()}
    return section_of("Oil", _FIELDS, DataSheet, required=True, **texts)


# -- for people -----------------------------------------------------------------------------------


def chosen(known: Oils, words: str) -> list[DataSheet]:
    """The oils that have all these words in name, source, base oil or thickener."""
    found = [
        sheet
        for sheet in known.values()
        if all(
            word in f"{sheet.name} {sheet.source} {sheet.base_oil} {sheet.thickener}".casefold()
            for word in words.casefold().split()
        )
    ]
    if not found:
        raise InputError(Fault(known.file, "no oil has these words", words, "leave them out to see all oils"))
    return found


def list_text(sheets: Sequence[DataSheet]) -> str:
    """One line an oil."""
    cells = [list(_COLUMNS), *map(_cells, sheets)]
    widths = [max(len(row[place]) for row in cells) for place in range(len(_COLUMNS))]
    lines = [
        "  ".join(
            cell.ljust(width) if place in _OF_TEXT else cell.rjust(width)
            for place, (cell, width) in enumerate(zip(row, widths, strict=True))
        ).rstrip()
        for row in cells
    ]
    return "\n".join(lines)


def _cells(sheet: DataSheet) -> list[str]:
    def number(name: str) -> str:
        value = getattr(sheet, name)
        return "-" if value is None else f"{units.from_si(float(value), _FIELDS[name]):.5g}"

    lowest = "lowest_temperature" if sheet.lowest_temperature is not None else "pour_point"
    return [
        sheet.name, number("kinematic_viscosity_40"), number("kinematic_viscosity_100"), f"{sheet.viscosity_index:.0f}",
        number("density_15"), number(lowest), number("highest_temperature"), sheet.thickener or "-", sheet.source,
    ]  # fmt: skip


def list_document(sheets: Sequence[DataSheet]) -> dict[str, Any]:
    """All oils, SI."""
    return {
        "oils": [
            {
                "name": sheet.name,
                **{name: getattr(sheet, name) for name in _FIELDS},
                "viscosity_index": sheet.viscosity_index,
                **{name: getattr(sheet, name) or None for name in _TEXTS},
            }
            for sheet in sheets
        ],
        "units": {name: quantity.unit for name, quantity in _FIELDS.items()},
        "provenance": {"version": __version__},
    }


def show_text(sheet: DataSheet) -> str:
    """What a data sheet states, and the oil over the temperature, where it may be computed."""
    lines = [f"{sheet.name} ({sheet.source})", ""]
    if sheet.is_grease:
        lines += [f"  grease: {sheet.base_oil or 'base oil'}, {sheet.thickener}, NLGI {sheet.nlgi or '-'}",
                  "  the viscosities are those of the base oil", ""]  # fmt: skip
    for name, quantity in _FIELDS.items():
        value = getattr(sheet, name)
        if value is not None:
            lines.append(f"  {quantity.info.meaning:<44} {units.shown(value, quantity)}")
    lines += [f"  {'viscosity index (ASTM D2270)':<44} {sheet.viscosity_index:.0f}", ""]
    known = fields_of(Lubricant)
    lines.append("  temperature   kinematic viscosity   viscosity        density")
    for degrees in _SHOWN_AT:
        oil = Lubricant.from_sheet(sheet, degrees + 273.15)
        low = sheet.pour_point if sheet.lowest_temperature is None else sheet.lowest_temperature
        beyond = low is not None and degrees + 273.15 < low
        beyond = beyond or (sheet.highest_temperature is not None and degrees + 273.15 > sheet.highest_temperature)
        lines.append(
            f"  {degrees:>8g} °C   {1e6 * oil.kinematic_viscosity:>12.5g} cSt       "
            f"{units.shown(oil.viscosity, known['viscosity']):>15}  {oil.density:>6.1f} kg/m³"
            + ("  outside the stated range" if beyond else "")
        )
    return "\n".join(lines)
