"""The oil of a case: by its viscosity, its data sheet, its name in a library, or its grade."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ballscrew import units
from ballscrew.case_schema.sections import Sections
from ballscrew.cases.oils import named_oil
from ballscrew.components.data_sheet import SHEET_TEMPERATURE, DataSheet
from ballscrew.components.materials import TEMPERATURE, Lubricant
from ballscrew.errors import MISSING, Fault, InputError
from ballscrew.quantities import fields_of
from ballscrew.units import in_display_units

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
    faults: list[Fault] = []
    points = [name for name in _POINTS if name in table]
    if "grade" in table and "viscosity" in table:
        given = f"{table['viscosity']} and {table['grade']}"
        faults.append(Fault("lubricant.viscosity", "contradicts the grade", given, "give one of the two"))
    for name in ("oil", *points[:1]):
        for other in ("grade", "viscosity"):
            if name in table and other in table:
                given = f"{table[other]} and {table[name]}"
                faults.append(Fault(f"lubricant.{other}", f"contradicts {name}", given, "give one of the two"))
    follows = "grade" in table or "oil" in table or bool(points)
    if not follows and "temperature" in table:
        remedy = 'add {lubricant.grade}"ISO VG 100", or kinematic_viscosity_40 and kinematic_viscosity_100'
        faults.append(
            Fault("lubricant.temperature", "needs a grade or a data sheet", str(table["temperature"]), remedy)
        )
    if len(points) == 1 and "oil" not in table:
        missing = next(name for name in _POINTS if name not in table)
        faults.append(Fault(f"lubricant.{missing}", MISSING, "", f'add {{lubricant.{missing}}}"… cSt"'))
    others = [name for name in fields_of(DataSheet) if name in table and name not in _POINTS]
    if others and not points and "oil" not in table:
        remedy = "add kinematic_viscosity_40 and kinematic_viscosity_100, or leave it out"
        faults.append(Fault(f"lubricant.{others[0]}", "is of a data sheet", str(table[others[0]]), remedy))
    if "oil_file" in table and "oil" not in table:
        faults.append(Fault("lubricant.oil_file", "needs the name of an oil", str(table["oil_file"]), 'add oil = "…"'))
    if not follows and not others and not {"viscosity", "temperature"} & set(table):
        remedy = (
            'add kinematic_viscosity_40 and kinematic_viscosity_100, or grade = "ISO VG 100", and a temperature, '
            'or viscosity = "… mPa s"'
        )
        faults.append(Fault("lubricant.viscosity", MISSING, "", remedy))
    return faults


def _shown(fault: Fault, table: Mapping[str, Any]) -> Fault:
    """A fault with its bound in display units and its value as it is written."""
    known = {**fields_of(DataSheet), "temperature": SHEET_TEMPERATURE}
    name = fault.where.rpartition(".")[2]
    if fault.bound is None or name not in known:
        return fault
    return in_display_units(fault, known[name], str(table.get(name, fault.given)))


def described(oil: Mapping[str, Any]) -> str:
    """The oil in words by what it was made from: ``ISO VG 100``, ``100 and 11.1 cSt at 40 and 100 °C``."""
    if "grade" in oil:
        return str(oil["grade"])
    if "oil" in oil:
        return str(oil["oil"])
    known = fields_of(DataSheet)
    warm, hot = (units.shown(oil[name], known[name]) for name in _POINTS)
    return f"with {warm} at 40 °C and {hot} at 100 °C"


def shown_temperature(oil: Mapping[str, Any], default: float) -> str:
    """The temperature that an oil was made at."""
    return units.shown(oil.get("temperature", default), TEMPERATURE)
