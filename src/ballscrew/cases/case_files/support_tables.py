"""The bearings and guides of a case, from its sections ``[bearings.fixed]`` and ``[guides]``."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.catalogue_rows import guide_rows, support_units
from ballscrew.axis.supports.element_laws import (
    BEARING_LAWS,
    GUIDE_LAWS,
    MOUNTING,
    STATICS,
    UNCERTAIN,
    fields_of_laws,
    misplaced,
    missing,
    numbers_of,
)
from ballscrew.axis.supports.guide import CarriedMass, GuidedTable
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest, shown
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.lubricants import named_oil
from ballscrew.cases.schema.duty_schema import OIL
from ballscrew.cases.schema.sections import Sections
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.uncertain_value import UncertainValue, parse_uncertain
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.sizing.installation import Ends, Installation

#: What a row of a catalogue tells of a bearing.
_OF_UNIT = ("bore", "outside_diameter", "contact_angle")


def bearings(
    sections: Sections, folder: Path, lubricant: Lubricant | None, mounted: Installation | None, faults: list[Fault]
) -> Mapping[str, MountedBearing]:
    """The bearings of the shaft by their place; none where the case has no table of them."""
    if "bearings" not in sections:
        return {}
    before = len(faults)
    tables = sections.values_of("bearings", faults)
    faults += _contradictions(sections, tables, mounted) if len(faults) == before else []
    if len(faults) > before:
        return {}
    share = 0.5 if "second_fixed" in tables else 1.0
    result = {
        place: _bearing(place, dict(values), 0.0 if place == "floating" else share, folder, lubricant, faults)
        for place, values in tables.items()
    }
    return {place: bearing for place, bearing in result.items() if bearing is not None}


def _contradictions(sections: Sections, tables: Mapping[str, Any], mounted: Installation | None) -> list[Fault]:
    """Faults of bearings that are given twice, or do not fit the ends of the shaft."""
    faults: list[Fault] = []
    torque = _of_axis(sections).get("bearing_torque")
    if torque is not None:
        remedy = 'leave it out, or write [bearings.fixed] with law = "known" and this torque'
        faults.append(Fault("axis.bearing_torque", "is given beside the bearings", str(torque), remedy))
    if "fixed" not in tables:
        faults.append(Fault("bearings.fixed", MISSING, "", "add a table [bearings.fixed]: it holds the shaft"))
    if "second_fixed" in tables and "floating" in tables:
        remedy = "leave one out"
        faults.append(Fault("bearings.floating", "is at the end of the second fixed bearing", "", remedy))
    own = [place for place, table in tables.items() if place != "floating" and "rigidity" in table]
    if mounted is not None and mounted.bearing_rigidity is not None and own:
        remedy = f"leave one out: the other is bearings.{own[0]}.rigidity"
        given = shown(mounted.bearing_rigidity, "N/m")
        faults.append(Fault("installation.bearing_rigidity", "is given beside that of the bearing", given, remedy))
    far = {Ends.FIXED_FIXED: "second_fixed", Ends.FIXED_SUPPORTED: "floating"}
    given = next((place for place in far.values() if place in tables), None)
    if mounted is not None and given is not None and far.get(mounted.ends) != given:
        fitting = next(ends.words.replace("–", "-") for ends, place in far.items() if place == given)
        remedy = f'write ends = "{fitting}"'
        faults.append(
            Fault("installation.ends", f"has no {given.replace('_', ' ')} bearing", mounted.ends.words, remedy)
        )
    return faults


def _bearing(
    place: str, values: dict[str, Any], share: float, folder: Path, lubricant: Lubricant | None, faults: list[Fault]
) -> MountedBearing | None:
    where, before = f"bearings.{place}", len(faults)
    law, row = values.pop("law", next(iter(BEARING_LAWS))), values.pop("catalogue", None)
    if law not in BEARING_LAWS:
        faults.append(Fault(f"{where}.law", "unknown law of a bearing", law, nearest(law, BEARING_LAWS)))
        return None
    known = fields_of(BEARING_LAWS[law])
    mounting = {name: values.pop(name) for name in MOUNTING if name in values}
    oil = {name: values.pop(name) for name in OIL if name in values}
    faults += misplaced(where, law, BEARING_LAWS, values)
    if row is not None:
        unit = _made(where, lambda: support_units()[row], faults)
        if unit is None:
            return None
        of_row = {name: getattr(unit, name) for name in _OF_UNIT if name in known}
        values = {**{name: value for name, value in of_row.items() if value is not None}, **values}
        mounting = {"rigidity": unit.rigidity, **mounting}
        if "preload" in known and "preload" not in values:
            faults.append(Fault(f"{where}.preload", "is not printed in the catalogue", row, 'add preload = "… N"'))
    faults += missing(where, BEARING_LAWS[law], values)
    if "lubricant" in BEARING_LAWS[law].__dataclass_fields__:
        values["lubricant"] = _lubricant(where, oil, folder, lubricant, faults)
    elif oil:
        faults.append(Fault(f"{where}.{next(iter(oil))}", f'a bearing of law "{law}" has none', "", "leave it out"))
    if len(faults) > before:
        return None
    element = _made(where, lambda: BEARING_LAWS[law](**values), faults)
    if element is None:
        return None
    return _made(
        where, lambda: MountedBearing(place=place, element=element, **{"load_share": share, **mounting}), faults
    )


def mounted_on(mounted: Installation | None, mounted_bearings: Mapping[str, MountedBearing]) -> Installation | None:
    """The installation with the rigidity that the maker of its fixed bearing prints, unless it has its own."""
    rigidity = mounted_bearings["fixed"].rigidity if "fixed" in mounted_bearings else None
    if mounted is None or mounted.bearing_rigidity is not None or rigidity is None:
        return mounted
    return dataclasses.replace(mounted, bearing_rigidity=rigidity)


def guided(
    sections: Sections, axis: Axis | None, folder: Path, lubricant: Lubricant | None, faults: list[Fault]
) -> Axis | None:
    """The axis with its guides, where the case has a table of them."""
    if "guides" not in sections:
        return axis
    before = len(faults)
    values = sections.values_of("guides", faults)
    if "axis" not in sections:
        faults.append(Fault("guides", "carry the mass of an axis", "", 'add a table [axis] with mass = "400 kg"'))
    if len(faults) > before:
        return None
    for name in ("guide_friction_coefficient", "guide_seal_force"):
        if name in _of_axis(sections):
            given = str(_of_axis(sections)[name])
            faults.append(Fault(f"axis.{name}", "is given beside the guides", given, "leave it out"))
    law, row = values.pop("law", next(iter(GUIDE_LAWS))), values.pop("catalogue", None)
    if law not in GUIDE_LAWS:
        faults.append(Fault("guides.law", "unknown law of guides", law, nearest(law, GUIDE_LAWS)))
        return None
    where = {name: values.pop(name) for name in STATICS if name in values}
    oil = {name: values.pop(name) for name in OIL if name in values}
    faults += misplaced("guides", law, GUIDE_LAWS, values)
    if row is not None:
        carriage = _made("guides", lambda: guide_rows()[row], faults)
        if carriage is None:
            return None
        own = {"friction_coefficient": carriage.friction_coefficients[1], "seal_force": carriage.seal_force}
        values = {**{name: value for name, value in own.items() if name in fields_of(GUIDE_LAWS[law])}, **values}
    faults += missing("guides", GUIDE_LAWS[law], values)
    if "lubricant" in GUIDE_LAWS[law].__dataclass_fields__:
        values["lubricant"] = _lubricant("guides", oil, folder, lubricant, faults)
    elif oil:
        faults.append(Fault(f"guides.{next(iter(oil))}", f'guides of law "{law}" have none', "", "leave it out"))
    if len(faults) > before or axis is None:
        return None
    table = _table(axis, where, values.get("carriages", 4), faults)
    guides = _made("guides", lambda: GUIDE_LAWS[law](**values), faults)
    return None if len(faults) > before else dataclasses.replace(axis, guides=guides, table=table)


def _of_axis(sections: Sections) -> Mapping[str, Any]:
    """The table of the axis as it is written; empty where it is none."""
    table = sections.tables.get("axis")
    return table if isinstance(table, dict) else {}


def _table(axis: Axis, where: Mapping[str, float], carriages: float, faults: list[Fault]) -> GuidedTable | None:
    """Where the mass is on four carriages; None where the case does not tell."""
    if not where:
        return None
    for name in ("carriage_spacing", "rail_spacing"):
        if name not in where:
            remedy = f'add {name} = "… mm", or leave {", ".join(where)} out'
            faults.append(Fault(f"guides.{name}", MISSING, "", remedy))
    if carriages != 4:
        remedy = f"leave {', '.join(where)} out: all carriages then bear alike"
        faults.append(Fault("guides.carriages", "must be four for the loads of each", f"{carriages:g}", remedy))
    if faults:
        return None
    spacing = {name: where[name] for name in ("carriage_spacing", "rail_spacing")}
    place = {name: where[name] for name in ("along", "across", "above") if name in where}
    return GuidedTable(masses=(CarriedMass(mass=axis.mass, **place),), inclination=axis.inclination, **spacing)


def _lubricant(
    where: str, oil: dict[str, Any], folder: Path, lubricant: Lubricant | None, faults: list[Fault]
) -> Lubricant | None:
    """The oil of an element, at the temperature of that of the screw, or else the screw's."""
    if "grade" in oil and "oil" in oil:
        faults.append(Fault(f"{where}.grade", "contradicts oil", str(oil["grade"]), "give one of the two"))
    if "oil_file" in oil and "oil" not in oil:
        faults.append(Fault(f"{where}.oil_file", "needs the name of an oil", str(oil["oil_file"]), 'add oil = "…"'))
    if not oil:
        if lubricant is None:
            faults.append(Fault(f"{where}.grade", MISSING, "", 'add grade = "ISO VG 68", or a [lubricant]'))
        return lubricant
    at = {} if lubricant is None or lubricant.temperature is None else {"temperature": lubricant.temperature}
    if "grade" in oil:
        return _made(where, lambda: Lubricant.from_grade(oil["grade"], **at), faults)
    if "oil" in oil:
        return _made(
            where, lambda: Lubricant.from_sheet(named_oil(oil["oil"], oil.get("oil_file"), folder), **at), faults
        )
    return None


def _made(where: str, make: Callable[[], Any], faults: list[Fault]) -> Any:
    """What ``make`` returns; its faults are those of a place in the file."""
    try:
        return make()
    except InputError as error:
        for fault in error.faults:
            section, _, field = fault.where.rpartition(".")
            field = field if section else "catalogue"
            faults.append(dataclasses.replace(fault, where=f"{where}.{field}"))
        return None


def distributions(sections: Sections) -> Mapping[str, Distribution]:
    """The distributions of numbers of bearings and guides: ``bearings.fixed.torque``, ``guides.seal_force``."""
    places = {f"bearings.{place}": table for place, table in sections.tables.get("bearings", {}).items()}
    known, result = {**fields_of_laws(GUIDE_LAWS), **fields_of_laws(BEARING_LAWS)}, dict[str, Distribution]()
    for where, table in {**places, "guides": sections.tables.get("guides", {})}.items():
        for name in UNCERTAIN:
            written = parse_uncertain(table.get(name), known[name])
            if isinstance(written, UncertainValue) and written.distribution is not None:
                result[f"{where}.{name}"] = written.distribution
    return result


def inputs(mounted_bearings: Mapping[str, MountedBearing], axis: Axis | None) -> dict[str, Any]:
    """Bearings and guides in SI, by section, as far as a case has them."""
    parts: dict[str, Any] = {}
    if mounted_bearings:
        parts["bearings"] = {
            place: {**numbers_of(bearing.element, BEARING_LAWS), **numbers_of(bearing)}
            for place, bearing in mounted_bearings.items()
        }
    if axis is not None and axis.guides is not None:
        parts["guides"] = numbers_of(axis.guides, GUIDE_LAWS)
        if axis.table is not None:
            parts["guides"] |= {**numbers_of(axis.table), **numbers_of(axis.table.masses[0])}
    return parts
