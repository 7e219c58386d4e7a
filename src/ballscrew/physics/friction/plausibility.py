"""Plausibility: inputs that are possible, and that no ball screw has, of all parts of a configuration.

That of one part by itself is judged by the usual ranges of its quantities (:mod:`ballscrew.basis.usual_ranges`).
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.records import Record
from ballscrew.basis.usual_ranges import IMPLAUSIBLE as IMPLAUSIBLE
from ballscrew.basis.usual_ranges import unusual
from ballscrew.physics.components.data_sheet import SHEET_TEMPERATURE, DataSheet
from ballscrew.physics.components.ratings import odd_preload
from ballscrew.physics.components.screw import MATERIALS, BallScrew

#: Constant of replenishment of a track with grease (SKF2018).
GREASE_REPLENISHMENT = 6e-8
#: Without a pour point or a range on the sheet, temperatures as far from 40 and 100 °C as this are extrapolated, K.
_COLD, _HOT = 273.15, 393.15


def named_parts(model: Any, screw: BallScrew, lubricant: Any, **others: Any) -> dict[str, Any]:
    """The parts of a configuration by the section that their fields have in a case file.

    Those of the nut are among them. ``others`` are further parts by section; None stands for one that there is not.
    """
    materials = zip(MATERIALS, screw.materials, strict=True)
    laws = {f"model.{slot}": law for slot, law in model.laws_with_coefficients.items()}
    return {
        "screw": screw,
        **{f"screw.{name}": material for name, material in materials},
        "lubricant": lubricant,
        **_parts_of_nut(screw),
        **{section: part for section, part in others.items() if part is not None},
        "model": model,
        **laws,
    }


def _parts_of_nut(screw: BallScrew) -> dict[str, Any]:
    """The nut, its bodies in the sizes they have for the screw, and what it loses."""
    parts = screw.nut.parts
    return parts | ({"bodies": screw.nut.bodies.sized(screw)} if screw.nut.bodies is not None else {})


def implausible(parts: Mapping[str, Any]) -> list[Record]:
    """A warning for each quantity of the parts that is somewhere outside its usual range, with the value farthest out.

    Relations of fields, such as the lead angle, are quantities of the part as well. A preload that does not go with the
    load rating, and an oil outside the range of its data sheet, are among them.
    """
    lubricant, screw = parts.get("lubricant"), parts.get("screw")
    sheet = getattr(lubricant, "sheet", None)
    odd = odd_preload(screw) if isinstance(screw, BallScrew) else []
    values = [
        record
        for section, part in [*parts.items(), *([] if sheet is None else [("lubricant", sheet)])]
        for record in unusual(section, part)
        if record.subject not in {one.subject for one in odd}
    ]
    return [*values, *odd, *beyond_data_sheet(lubricant), *_grease_as_oil(lubricant, parts.get("model.inlet"))]


def beyond_data_sheet(lubricant: Any) -> list[Record]:
    """Warnings of an oil below its pour point, or outside the range of its data sheet, at the temperature farthest out.

    Where the sheet states no end, a warning tells that the viscosity is extrapolated below 0 °C and above 120 °C.
    """
    sheet: DataSheet | None = getattr(lubricant, "sheet", None)
    if sheet is None:
        return []
    numbers = np.asarray(lubricant.temperature, dtype=float)
    numbers = numbers[np.isfinite(numbers)]
    coldest, hottest = float(numbers.min(initial=np.inf)), float(numbers.max(initial=-np.inf))

    def shown(temperature: float) -> str:
        return units.shown(temperature, SHEET_TEMPERATURE)

    extrapolated = "its viscosity is extrapolated far from the two points of its data sheet"
    records: list[Record] = []
    if sheet.pour_point is not None and coldest < sheet.pour_point:
        text = (
            f"oil at {shown(coldest)}, below its pour point {shown(sheet.pour_point)}: it does not flow "
            "by itself, and its viscosity is a guess; at the start it is more"
        )
        records.append(_of_sheet("below_pour_point", text, coldest, float(sheet.pour_point)))
    elif sheet.lowest_temperature is not None and coldest < sheet.lowest_temperature:
        text = (
            f"lubricant at {shown(coldest)}, below the {shown(sheet.lowest_temperature)} that its maker "
            "states: its viscosity is a guess"
        )
        records.append(_of_sheet("below_range", text, coldest, float(sheet.lowest_temperature)))
    elif sheet.pour_point is None and sheet.lowest_temperature is None and coldest < _COLD:
        text = f"oil at {shown(coldest)}: {extrapolated}; give its pour_point"
        records.append(_of_sheet("extrapolated_cold", text, coldest, _COLD))
    if sheet.highest_temperature is not None and hottest > sheet.highest_temperature:
        text = (
            f"lubricant at {shown(hottest)}, above the {shown(sheet.highest_temperature)} that its maker "
            "states: it does not last"
        )
        records.append(_of_sheet("above_range", text, hottest, float(sheet.highest_temperature)))
    elif sheet.highest_temperature is None and hottest > _HOT:
        text = f"oil at {shown(hottest)}: {extrapolated}; give its highest_temperature"
        records.append(_of_sheet("extrapolated_hot", text, hottest, _HOT))
    return records


def _grease_as_oil(lubricant: Any, inlet: Any) -> list[Record]:
    """A warning of a grease whose track is replenished as by an oil bath (SKF2018)."""
    sheet: DataSheet | None = getattr(lubricant, "sheet", None)
    constant = getattr(inlet, "replenishment_constant", None)
    if sheet is None or not sheet.is_grease or constant is None:
        return []
    least = float(np.min(constant))
    if least >= GREASE_REPLENISHMENT * (1 - 1e-9):
        return []
    message = (
        "grease computed as oil of a bath: its constant of replenishment is 6e-8; write [model] "
        "inlet.replenishment_constant = 6e-8"
    )
    return [
        Record(
            id="lubricant.grease_as_oil",
            subject="model.inlet.replenishment_constant",
            text=message,
            severity="warning",
            holds=False,
            value=least,
            limit=GREASE_REPLENISHMENT,
        )
    ]


def _of_sheet(name: str, text: str, value: float, limit: float) -> Record:
    return Record(
        id=f"lubricant.{name}",
        subject="lubricant.temperature",
        text=text,
        severity="warning",
        holds=False,
        value=value,
        limit=limit,
        unit="K",
    )
