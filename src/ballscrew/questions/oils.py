"""Oils and greases of the library: data sheets as a document and as text, one of them over the temperature."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.output.text import aligned
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files.lubricants import TEXTS
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import DataSheet

_FIELDS = fields_of(DataSheet)


def document(sheets: Sequence[DataSheet]) -> dict[str, Any]:
    """All oils, SI."""
    return {
        "oils": [
            {
                "name": sheet.name,
                **{name: getattr(sheet, name) for name in _FIELDS},
                "viscosity_index": sheet.viscosity_index,
                **{name: getattr(sheet, name) or None for name in TEXTS},
            }
            for sheet in sheets
        ],
        "units": {name: quantity.unit for name, quantity in _FIELDS.items()},
        "provenance": {"version": __version__},
    }


_COLUMNS = ("name", "40 °C [cSt]", "100 °C [cSt]", "VI", "15 °C [kg/m³]", "from [°C]", "to [°C]", "thickener", "source")
#: Temperatures at which an oil is shown, °C.
_SHOWN_AT = (-40, -20, 0, 20, 40, 60, 80, 100, 120)
_OF_TEXT = (0, len(_COLUMNS) - 2, len(_COLUMNS) - 1)


def list_text(sheets: Sequence[DataSheet]) -> str:
    """One line an oil."""
    return "\n".join(aligned([_COLUMNS, *map(_cells, sheets)], _OF_TEXT))


def _cells(sheet: DataSheet) -> list[str]:
    def number(name: str) -> str:
        value = getattr(sheet, name)
        return "-" if value is None else f"{units.from_si(float(value), _FIELDS[name]):.5g}"

    lowest = "lowest_temperature" if sheet.lowest_temperature is not None else "pour_point"
    return [
        sheet.name,
        number("kinematic_viscosity_40"),
        number("kinematic_viscosity_100"),
        f"{sheet.viscosity_index:.0f}",
        number("density_15"),
        number(lowest),
        number("highest_temperature"),
        sheet.thickener or "-",
        sheet.source,
    ]


def show_text(sheet: DataSheet) -> str:
    """Statements of a data sheet, and the oil over the temperature, where it may be computed."""
    lines = [f"{sheet.name} ({sheet.source})", ""]
    if sheet.is_grease:
        lines += [
            f"  grease: {sheet.base_oil or 'base oil'}, {sheet.thickener}, NLGI {sheet.nlgi or '-'}",
            "  the viscosities are those of the base oil",
            "",
        ]
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
