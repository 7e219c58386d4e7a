"""The oil of a case: by its viscosity, its data sheet, its name in a library, or its grade."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.errors import MISSING, Fault, InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.units import in_display_units
from ballscrew.cases.case_files.oil_library import named_oil
from ballscrew.cases.schema.sections import Sections
from ballscrew.physics.components.data_sheet import SHEET_TEMPERATURE, DataSheet
from ballscrew.physics.components.materials import Lubricant

#: What tells an oil, each on its own; a library and a data sheet go together, the sheet over the library.
_POINTS = ("kinematic_viscosity_40", "kinematic_viscosity_100")
#: The keys of an oil that follows the temperature.
OF_NAMED_OIL = ("grade", "oil", "oil_file", "temperature", *fields_of(DataSheet))


def lubricant_of(sections: Sections, folder: Path, faults: list[Fault]) -> tuple[Lubricant | None, Mapping[str, Any]]:
    """The oil of a section and, where it follows the temperature, what it was made from."""
    before = len(faults)
    table, values = sections.tables["lubricant"], sections.values_of("lubricant", faults)
    if isinstance(table, dict):
        faults += _contradictions(table)
    if len(faults) > before:
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
            sheet = DataSheet(**of_sheet) if name is None else named_oil(name, file, folder)
            sheet = dataclasses.replace(sheet, **of_sheet)
            oil = Lubricant.from_sheet(sheet, **temperature)
            named = {} if name is None else {"oil": sheet.name, "oil_source": sheet.source}
            written = {key: getattr(sheet, key) for key in fields_of(DataSheet) if getattr(sheet, key) is not None}
            made_from = {**named, **written, **temperature}
    except InputError as error:
        faults += [_shown(fault, table) for fault in error.faults]
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
