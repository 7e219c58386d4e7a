"""The bearings and guides of a case, from its sections ``[bearings.fixed]`` and ``[guides]``."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

from ballscrew.axis.duty_cycle.axis import Axis
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.element_laws import (
    BEARING_LAWS,
    GUIDE_LAWS,
    MOUNTING,
    STATICS,
    UNCERTAIN,
    fields_of_laws,
    guide_rows,
    misplaced,
    missing,
    numbers_of,
    support_units,
)
from ballscrew.axis.supports.guide import CarriedMass, GuidedTable
from ballscrew.basis.errors import MISSING, Fault, nearest, shown
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.lubricants import named_oil
from ballscrew.cases.schema.duty_schema import OIL
from ballscrew.cases.schema.reader import Reader
from ballscrew.engine.uncertainty.distributions import Distribution
from ballscrew.engine.uncertainty.uncertain_value import UncertainValue, parse_uncertain
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.sizing.installation import Ends, Installation

#: What a row of a catalogue tells of a bearing.
_OF_UNIT = ("bore", "outside_diameter", "contact_angle")


def bearings(reader: Reader, lubricant: Lubricant | None, mounted: Installation | None) -> Mapping[str, MountedBearing]:
    """The bearings of the shaft by their place; none where the case has no table of them."""
    if "bearings" not in reader:
        return {}
    part = reader.part()
    tables = reader.values_of("bearings")
    reader.faults += _contradictions(reader, tables, mounted) if not part.is_faulty else []
    if part.is_faulty:
        return {}
    share = 0.5 if "second_fixed" in tables else 1.0
    result = {
        place: _bearing(reader, place, dict(values), 0.0 if place == "floating" else share, lubricant)
        for place, values in tables.items()
    }
    return {place: bearing for place, bearing in result.items() if bearing is not None}


def _contradictions(reader: Reader, tables: Mapping[str, Any], mounted: Installation | None) -> list[Fault]:
    """Faults of bearings that are given twice, or do not fit the ends of the shaft."""
    faults: list[Fault] = []
    torque = _of_axis(reader).get("bearing_torque")
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
    reader: Reader, place: str, values: dict[str, Any], share: float, lubricant: Lubricant | None
) -> MountedBearing | None:
    where, part = f"bearings.{place}", reader.part()
    law, row = values.pop("law", next(iter(BEARING_LAWS))), values.pop("catalogue", None)
    if law not in BEARING_LAWS:
        reader.refuse(f"{where}.law", "unknown law of a bearing", law, nearest(law, BEARING_LAWS))
        return None
    known = fields_of(BEARING_LAWS[law])
    mounting = {name: values.pop(name) for name in MOUNTING if name in values}
    oil = {name: values.pop(name) for name in OIL if name in values}
    reader.faults += misplaced(where, law, BEARING_LAWS, values)
    if row is not None:
        unit = _made(reader, where, lambda: support_units()[row])
        if unit is None:
            return None
        of_row = {name: getattr(unit, name) for name in _OF_UNIT if name in known}
        values = {**{name: value for name, value in of_row.items() if value is not None}, **values}
        mounting = {"rigidity": unit.rigidity, **mounting}
        if "preload" in known and "preload" not in values:
            reader.refuse(f"{where}.preload", "is not printed in the catalogue", row, 'add preload = "… N"')
    reader.faults += missing(where, BEARING_LAWS[law], values)
    if "lubricant" in BEARING_LAWS[law].__dataclass_fields__:
        values["lubricant"] = _lubricant(reader, where, oil, lubricant)
    elif oil:
        reader.refuse(f"{where}.{next(iter(oil))}", f'a bearing of law "{law}" has none', "", "leave it out")
    if part.is_faulty:
        return None
    element = _made(reader, where, lambda: BEARING_LAWS[law](**values))
    if element is None:
        return None
    return _made(
        reader, where, lambda: MountedBearing(place=place, element=element, **{"load_share": share, **mounting})
    )


def mounted_on(mounted: Installation | None, mounted_bearings: Mapping[str, MountedBearing]) -> Installation | None:
    """The installation with the rigidity that the maker of its fixed bearing prints, unless it has its own."""
    rigidity = mounted_bearings["fixed"].rigidity if "fixed" in mounted_bearings else None
    if mounted is None or mounted.bearing_rigidity is not None or rigidity is None:
        return mounted
    return dataclasses.replace(mounted, bearing_rigidity=rigidity)


def guided(reader: Reader, axis: Axis | None, lubricant: Lubricant | None) -> Axis | None:
    """The axis with its guides, where the case has a table of them."""
    if "guides" not in reader:
        return axis
    part = reader.part()
    values = reader.values_of("guides")
    if "axis" not in reader:
        reader.refuse("guides", "carry the mass of an axis", "", 'add a table [axis] with mass = "400 kg"')
    if part.is_faulty:
        return None
    for name in ("guide_friction_coefficient", "guide_seal_force"):
        if name in _of_axis(reader):
            given = str(_of_axis(reader)[name])
            reader.refuse(f"axis.{name}", "is given beside the guides", given, "leave it out")
    law, row = values.pop("law", next(iter(GUIDE_LAWS))), values.pop("catalogue", None)
    if law not in GUIDE_LAWS:
        reader.refuse("guides.law", "unknown law of guides", law, nearest(law, GUIDE_LAWS))
        return None
    where = {name: values.pop(name) for name in STATICS if name in values}
    oil = {name: values.pop(name) for name in OIL if name in values}
    reader.faults += misplaced("guides", law, GUIDE_LAWS, values)
    if row is not None:
        carriage = _made(reader, "guides", lambda: guide_rows()[row])
        if carriage is None:
            return None
        own = {"friction_coefficient": carriage.friction_coefficients[1], "seal_force": carriage.seal_force}
        values = {**{name: value for name, value in own.items() if name in fields_of(GUIDE_LAWS[law])}, **values}
    reader.faults += missing("guides", GUIDE_LAWS[law], values)
    if "lubricant" in GUIDE_LAWS[law].__dataclass_fields__:
        values["lubricant"] = _lubricant(reader, "guides", oil, lubricant)
    elif oil:
        reader.refuse(f"guides.{next(iter(oil))}", f'guides of law "{law}" have none', "", "leave it out")
    if part.is_faulty or axis is None:
        return None
    table = _table(reader, axis, where, values.get("carriages", 4))
    guides = _made(reader, "guides", lambda: GUIDE_LAWS[law](**values))
    return None if part.is_faulty else dataclasses.replace(axis, guides=guides, table=table)


def _of_axis(reader: Reader) -> Mapping[str, Any]:
    """The table of the axis as it is written; empty where it is none."""
    table = reader.tables.get("axis")
    return table if isinstance(table, dict) else {}


def _table(reader: Reader, axis: Axis, where: Mapping[str, float], carriages: float) -> GuidedTable | None:
    """Table with its mass on four carriages; None where the case does not tell."""
    if not where:
        return None
    for name in ("carriage_spacing", "rail_spacing"):
        if name not in where:
            remedy = f'add {name} = "… mm", or leave {", ".join(where)} out'
            reader.refuse(f"guides.{name}", MISSING, "", remedy)
    if carriages != 4:
        remedy = f"leave {', '.join(where)} out: all carriages then bear alike"
        reader.refuse("guides.carriages", "must be four for the loads of each", f"{carriages:g}", remedy)
    if reader.faults:
        return None
    spacing = {name: where[name] for name in ("carriage_spacing", "rail_spacing")}
    place = {name: where[name] for name in ("along", "across", "above") if name in where}
    return GuidedTable(masses=(CarriedMass(mass=axis.mass, **place),), inclination=axis.inclination, **spacing)


def _lubricant(reader: Reader, where: str, oil: dict[str, Any], lubricant: Lubricant | None) -> Lubricant | None:
    """The oil of an element, at the temperature of that of the screw, or else the screw's."""
    if "grade" in oil and "oil" in oil:
        reader.refuse(f"{where}.grade", "contradicts oil", str(oil["grade"]), "give one of the two")
    if "oil_file" in oil and "oil" not in oil:
        reader.refuse(f"{where}.oil_file", "needs the name of an oil", str(oil["oil_file"]), 'add oil = "…"')
    if not oil:
        if lubricant is None:
            reader.refuse(f"{where}.grade", MISSING, "", 'add grade = "ISO VG 68", or a [lubricant]')
        return lubricant
    at = {} if lubricant is None or lubricant.temperature is None else {"temperature": lubricant.temperature}
    if "grade" in oil:
        return _made(reader, where, lambda: Lubricant.from_grade(oil["grade"], **at))
    if "oil" in oil:
        return _made(
            reader, where, lambda: Lubricant.from_sheet(named_oil(oil["oil"], oil.get("oil_file"), reader.folder), **at)
        )
    return None


def _made(reader: Reader, where: str, make: Callable[[], Any]) -> Any:
    """Return what ``make`` returns; its faults are those of a place in the file."""

    def place_of(field: str) -> str:
        section, _, name = field.rpartition(".")
        return f"{where}.{name if section else 'catalogue'}"

    return reader.made(make, place_of)


def distributions(reader: Reader) -> Mapping[str, Distribution]:
    """The distributions of numbers of bearings and guides: ``bearings.fixed.torque``, ``guides.seal_force``."""
    places = {f"bearings.{place}": table for place, table in reader.tables.get("bearings", {}).items()}
    known, result = {**fields_of_laws(GUIDE_LAWS), **fields_of_laws(BEARING_LAWS)}, dict[str, Distribution]()
    for where, table in {**places, "guides": reader.tables.get("guides", {})}.items():
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
