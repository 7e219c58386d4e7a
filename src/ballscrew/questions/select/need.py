"""Needs: what a screw has to do, read from a file that is written like a case file without its screw."""

from __future__ import annotations

import copy
import dataclasses
import re
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

from pydantic import Field

from ballscrew.basis import units
from ballscrew.basis.errors import MISSING, Fault, InputError, closest, nearest, raise_if_any
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.schema.case_schema import read_table, sections
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.oil_grades import grades
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.sizing.installation import Installation
from ballscrew.questions.select.requirements import (
    ALLOWED,
    FORBIDDEN,
    NEEDED,
    USUAL_LENGTH,
    USUAL_OBJECTIVES,
    Requirements,
    objectives_named,
)

#: The oil where a need names none: that of ``ballscrew check``.
GRADE, TEMPERATURE = "ISO VG 100", "40 degC"
#: Short names of an axis and its motion, and the places they stand for.
OF_MOTION: Mapping[str, str] = {
    "mass": "axis.mass",
    "inclination": "axis.inclination",
    "acceleration": "motion.acceleration",
    "dwell": "motion.dwell",
}
#: Short names, at the top of a file or in ``[need]``, and the places they stand for.
SHORT_NAMES: Mapping[str, str] = {
    **dict.fromkeys(("force", "load", "axial_load", "axial_force", "thrust"), "operation.axial_load"),
    **dict.fromkeys(("speed", "screw_speed", "rotational_speed"), "operation.screw_speed"),
    **dict.fromkeys(("feed", "feed_rate", "travel_speed"), "need.feed"),
    **dict.fromkeys(("stroke", "travel"), "need.stroke"),
    **dict.fromkeys(("length", "unsupported_length"), "installation.unsupported_length"),
    **dict.fromkeys(("ends", "mounting"), "installation.ends"),
    **dict.fromkeys(
        ("life", "running_time", "lifetime", "service_life", "required_life", "life_hours"), "limits.running_time"
    ),
    **dict.fromkeys(("nut", "nuts", "nut_type", "nut_types"), "nut.type"),
    **dict.fromkeys(("preload", "preloads", "preload_class"), "nut.preload"),
    **dict.fromkeys(("oil", "oils", "grade", "grades", "lubricant"), "lubricant.oils"),
    "temperature": "lubricant.temperature",
    **dict.fromkeys(("back_driving", "back_drive", "backdriving", "back_drives"), "need.back_driving"),
    **dict.fromkeys(("accuracy", "accuracy_class", "accuracy_grade"), "need.accuracy"),
    **OF_MOTION,
    "rows": "need.rows",
    "objectives": "need.objectives",
    "price_index": "need.price_index",
}
#: Other names of sections.
_SECTIONS = {"duty": "motion", "optimize": "optimise", "optimisation": "optimise", "requirements": "need"}
#: Names that could mean the speed under the load, or one that no load goes with.
_ANY_SPEED = ("max_speed", "maximum_speed", "largest_speed", "max_feed", "rapid", "rapid_feed", "rapid_traverse")
#: Sections of a file of a need that a case file has not, or has beside its sections.
_OTHERS = ("need", "optimise", "sweep", "calibration", "estimates", "price_index", "aside")
#: Kind of the faults of names that are not known: what they meant may then be missing.
_UNKNOWN = "unknown"
_BACK_DRIVING = {
    **dict.fromkeys(("true", "yes", "needed", "required", "must"), NEEDED),
    **dict.fromkeys(("false", "no", "forbidden", "not", "never", "self-locking"), FORBIDDEN),
    **dict.fromkeys(("allowed", "any", "may", "either"), ALLOWED),
}
#: Sections in which any short name is what it is at the top.
_ANYWHERE = ("operation", "installation")
_FEED, _SPEED = fields_of(Requirements)["feed"], fields_of(OperatingState)["screw_speed"]
_LENGTH = fields_of(Installation)["unsupported_length"]
_PLAIN = fields_of(Requirements)["counts_per_turn"]
_TURNS = ("need.feed", "operation.screw_speed")
#: What tells an oil, besides its temperature.
_OIL = ("grade", "oil", "viscosity", "kinematic_viscosity_40", "oil_file")


@dataclasses.dataclass(frozen=True, eq=False)
class Need:
    """A need: the tables of a case without its screw, the choices that are open, and what is required of each."""

    #: Tables of a case, without what is chosen: kind of nut, preload, oil.
    tables: Mapping[str, Any]
    requirements: Requirements
    #: Kinds of nuts, by name; empty for those that the rows list.
    nuts: Sequence[str]
    #: Preloads as they are written; empty for those of the rows, or usual ones.
    preloads: Sequence[str]
    #: Tables of the oils.
    oils: Sequence[Mapping[str, Any]]
    objectives: Sequence[str] = USUAL_OBJECTIVES
    #: Words that rows must have.
    rows: str = ""
    #: Prices against each other, by the names of rows.
    price_index: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    #: The table ``[optimise]``.
    optimise: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    #: Where files that it names lie.
    folder: Path = Path()
    #: What was assumed.
    notes: Sequence[str] = ()
    name: str = "need"
    #: Whether the stroke stands for the unsupported length in the tables.
    length_is_stroke: bool = False
    #: Places of what was assumed of the oil: ``lubricant.grade``.
    assumed_oil: Sequence[str] = ()

    @property
    def moves(self) -> bool:
        """True where it has a motion, and not one operating point."""
        return "motion" in self.tables

    def with_note(self, note: str) -> Need:
        """The need with one more assumption, once."""
        return dataclasses.replace(self, notes=tuple(dict.fromkeys((*self.notes, note))))


def need_of(need: str | Path | Mapping[str, Any] | Need, settings: Sequence[str] = ()) -> Need:
    """The need of a file, of tables as such a file has them, or the need itself.

    It is written like a case file without ``[screw]``; a case file with one is a need, too, whose sizes are left
    aside. Lists stand for choices: ``nut.type``, ``nut.preload``, ``lubricant.grade`` and ``lubricant.oil``. The table
    ``[need]`` has the fields of :class:`~ballscrew.questions.select.requirements.Requirements`, ``rows`` (words that
    rows must have), ``objectives`` and ``price_index``; the names of :data:`SHORT_NAMES` may stand there or at the top.

    Raises :class:`~ballscrew.basis.errors.InputError` with all faults of the file.
    """
    if isinstance(need, Need):
        return need
    if isinstance(need, Mapping):
        tables, folder, name = copy.deepcopy(dict(need)), Path(), "need"
    else:
        tables, folder, name = case_file.read(need), Path(need).parent, Path(need).name
    if isinstance(tables.get("duty"), list):
        remedy = "write [axis] and [motion], with [[motion.segment]] for its parts"
        raise InputError(Fault("duty", "must be a table", "a list", remedy))
    reader = NeedReader(case_file.override(tables, settings))
    reader.name_sections()
    reader.move_short_names()
    return reader.need(folder, name)


#: What a mass needs beside it, by place, with what to add.
_BESIDE: Mapping[str, str] = {
    "axis.mass": 'add mass = "400 kg", or write force and feed alone',
    "motion.acceleration": 'add acceleration = "3 m/s^2": with the mass it makes the load',
    "need.stroke": 'add stroke = "600 mm", the way of the mass',
    "need.feed": 'add feed = "15 m/min", the largest speed of the mass',
}
#: What is assumed of a motion.
_WITHOUT_RESTS = "motion: there and back over the stroke without rests, as no dwell was given"
_HORIZONTAL = "axis: horizontal, as no inclination was given"
#: What takes the place of a load and a speed beside a mass.
_INSTEAD: Mapping[str, str] = {
    "axial_load": "leave it out: mass, inclination and acceleration make the load; a force at work is [motion] force",
    "screw_speed": "write the feed: each lead then has a speed of its own",
}


@dataclasses.dataclass
class NeedReader:
    """The tables of a need, which become those of a case, with the faults that were found and what was assumed."""

    tables: dict[str, Any]
    faults: list[Fault] = dataclasses.field(default_factory=list[Fault])
    notes: list[str] = dataclasses.field(default_factory=list[str])
    #: Places of what was assumed of the oil.
    assumed_oil: list[str] = dataclasses.field(default_factory=list[str])

    def refuse(self, where: str, problem: str, given: str = "", remedy: str = "", *, id: str = "") -> None:
        """Add a fault."""
        self.faults.append(Fault(where, problem, given, remedy, id=id))

    def name_sections(self) -> None:
        """Give the sections the names that they have in a case; unknown sections are faults."""
        written, self.tables = self.tables, {}
        known = [*sections(), *_OTHERS, *_SECTIONS]
        for key, value in written.items():
            name = _SECTIONS.get(key, key)
            if name in self.tables:
                same = " and ".join(f"[{other}]" for other in written if _SECTIONS.get(other, other) == name)
                self.refuse(name, "is given twice", "", f"{same} are the same: leave one out")
            elif isinstance(value, dict) and name not in known:
                self.refuse(key, "unknown section", "", nearest(key, known[: -len(_SECTIONS)]), id=_UNKNOWN)
            else:
                self.tables[name] = value

    def move_short_names(self) -> None:
        """Move the short names to where they belong; places given twice are faults."""
        written = self.tables
        own = written.pop("need", {})
        if not isinstance(own, dict):
            self.refuse("need", "must be a table", str(own), "write [need]")
            own = {}
        self.tables = {key: dict(value) if isinstance(value, dict) else value for key, value in written.items()}
        self.tables["need"] = {}
        top = {key: value for key, value in written.items() if not isinstance(value, dict) or key == "price_index"}
        known = fields_of(Requirements)
        for where, short in (("need.", own), ("", top)):
            for key, value in short.items():
                place = SHORT_NAMES.get(key) or (f"need.{key}" if key in known else None)
                if place is None:
                    self.faults.append(_unknown(f"{where}{key}", key, value, known))
                    continue
                if not where:
                    del self.tables[key]
                self._put(place, value, f"{where}{key}")
        for section in ("operation", "installation", "limits", "lubricant", "nut"):
            self._move_from(section)
        for place, other, quantity in (("operation.screw_speed", "need.feed", _FEED), (*_TURNS, _SPEED)):
            self._move_by_unit(place, other, quantity)
        if any(name in top or name in own for name in OF_MOTION):
            self.make_motion()

    def _move_by_unit(self, place: str, other: str, quantity: Quantity) -> None:
        """Move a speed to where its unit belongs: ``speed = "15 m/min"`` is a feed."""
        section, _, field = place.partition(".")
        value = _at(self.tables, place)
        if isinstance(value, str) and not isinstance(units.parse("", value, quantity), Fault):
            del self.tables[section][field]
            self._put(other, value, place)

    def _move_from(self, section: str) -> None:
        """Move short names out of the section of a case, such as ``operation.feed`` and ``limits.life``."""
        table = self.tables.get(section)
        if not isinstance(table, dict):
            return
        known = sections()[section].model_fields
        for key in [key for key in table if key in SHORT_NAMES and key not in known]:
            place = SHORT_NAMES[key]
            # the length of a nut and the load of a limit are something else
            here = section in _ANYWHERE or place.partition(".")[0] in (section, "need")
            if here and place != f"{section}.{key}":
                self._put(place, table.pop(key), f"{section}.{key}")
        if not table:
            del self.tables[section]

    def _put(self, place: str, value: Any, where: str) -> None:
        section, _, field = place.partition(".")
        table = self.tables.setdefault(section, {})
        if not isinstance(table, dict):
            self.refuse(section, "must be a table", str(table), f"write [{section}]")
        elif field in table:
            self.refuse(where, "is given twice", str(value), f"{place} stands for the same: leave one out")
        else:
            table[field] = value

    def need(self, folder: Path, name: str) -> Need:
        """The need. Raises :class:`~ballscrew.basis.errors.InputError` with all faults that were found."""
        tables, own = self.tables, self.tables.pop("need")
        objectives, rows = own.pop("objectives", None), own.pop("rows", "")
        prices = own.pop("price_index", {})
        if "back_driving" in own:
            own["back_driving"] = _BACK_DRIVING.get(str(own["back_driving"]).lower(), str(own["back_driving"]))
        if "accuracy" in own:
            own["accuracy"] = str(own["accuracy"])
        has_feed = "feed" in own
        if has_feed and isinstance(units.parse("", own["feed"], _PLAIN), float):
            given = str(own.pop("feed"))
            self.refuse("need.feed", "needs a unit", given, f'write "{given} m/s", or "{given} m/min"')
        values = read_table("need", need_section(), own, self.faults)
        if not isinstance(rows, str):
            self.refuse("need.rows", "must be text", str(rows), 'write rows = "rexroth 40x"')
        prices = self._prices(prices)
        nut = self._section("nut")
        nuts, preloads = (self._texts(f"nut.{key}", nut.pop(key, [])) for key in ("type", "preload"))
        oils = self._oils()
        if nut:
            tables["nut"] = nut
        else:
            tables.pop("nut", None)
        optimise = self._section("optimise")
        tables.pop("optimise", None)
        tables.pop("sweep", None)
        if "bodies" not in tables:
            self.notes.append("elastic bodies of screw and nut of a usual size, as none were given")
        try:
            names = objectives_named(
                USUAL_OBJECTIVES if objectives is None else self._texts("need.objectives", objectives),
                "need.objectives",
            )
        except InputError as error:
            names = ()
            self.faults += error.faults
        if not any(fault.id == _UNKNOWN for fault in self.faults):
            self._check_operation(has_feed)
        raise_if_any(self.faults)
        required = Requirements(**values)
        raise_if_any(_misfit(tables.get("installation"), required))
        by_stroke = self._measure_by_stroke(required)
        if required.accuracy:
            self.notes.append(
                f"grade {required.accuracy} of ISO 3408-3 is not judged: no row lists its grades; ask the maker"
            )
        if objectives is None and prices:
            names = (*names, "price_index")
        return Need(
            tables,
            required,
            nuts,
            preloads,
            oils,
            names,
            rows,
            prices,
            optimise,
            folder,
            tuple(self.notes),
            name,
            by_stroke,
            tuple(self.assumed_oil),
        )

    def _section(self, name: str) -> dict[str, Any]:
        result = self.tables.get(name, {})
        if not isinstance(result, dict):
            self.refuse(name, "must be a table", str(result), f"write [{name}]")
            return {}
        return dict(result)

    def _texts(self, where: str, given: Any) -> list[str]:
        """One text, or a list of texts."""
        result = given if isinstance(given, list | tuple) else [given]
        if not all(isinstance(each, str) for each in result):
            self.refuse(where, "must be text, or a list of texts", str(given), 'write ["2 %", "5 %"]')
            return []
        return list(dict.fromkeys(result))

    def _prices(self, given: Any) -> dict[str, float]:
        if not isinstance(given, dict):
            self.refuse("need.price_index", "must be a table", str(given), "write [need.price_index]")
            return {}
        remedy = 'write "rexroth-40x10x6-6-double" = 1.3'
        for name, value in given.items():
            if isinstance(value, bool) or not isinstance(value, int | float) or not value > 0:
                self.refuse(f"need.price_index.{name}", "must be a positive number", str(value), remedy)
        return {str(name): value for name, value in given.items()}

    def _oils(self) -> list[dict[str, Any]]:
        """The tables of the oils: one for each grade and each oil that is named."""
        table = self._section("lubricant")
        short = self._texts("lubricant.oils", table.pop("oils", []))
        named = [_one_oil(name) for name in short]
        if isinstance(table.get("oil"), str) and "grade" not in table and "oil_file" not in table:
            table |= _one_oil(table.pop("oil"))
        for key in ("grade", "oil"):
            if isinstance(table.get(key), list):
                texts = self._texts(f"lubricant.{key}", table.pop(key))
                named += [{key: name} if key == "grade" or "oil_file" in table else _one_oil(name) for name in texts]
        if not named and not any(key in table for key in _OIL):
            named = [{"grade": GRADE}]
            self.assumed_oil.append("lubricant.grade")
            self.notes.append(f"oil {GRADE}: none was given")
        if "temperature" not in table and "viscosity" not in table:
            table["temperature"] = TEMPERATURE
            self.assumed_oil.append("lubricant.temperature")
            self.notes.append(f"oil at {TEMPERATURE}: no temperature was given")
        self.tables.pop("lubricant", None)
        return [{**table, **oil} for oil in named] or [table]

    def _check_operation(self, has_feed: bool) -> None:
        """Refuse a need without a force and a speed or a motion, and a feed beside a motion or a screw speed."""
        table = self._section("operation")
        if "motion" in self.tables:
            if has_feed:
                self.refuse("need.feed", "is given beside a motion", "", "leave it out: the motion has its speeds")
            return
        if "axial_load" not in table:
            remedy = 'add [operation] axial_load = "5 kN", or [axis] and [motion]'
            self.refuse("operation.axial_load", MISSING, "", remedy)
        if not has_feed and "screw_speed" not in table:
            remedy = 'add [operation] feed = "20 m/min", or screw_speed = "1500 rpm"'
            self.refuse("need.feed", MISSING, "", remedy)
        elif has_feed and "screw_speed" in table:
            self.refuse("need.feed", "is given beside a screw speed", "", "leave one of them out")

    def _measure_by_stroke(self, required: Requirements) -> bool:
        """Let a stroke stand for the unsupported length where none is given, if the ends are known; True if it does."""
        table = self.tables.get("installation")
        if required.stroke is None and table is None:
            length = units.in_unit(USUAL_LENGTH, "m")
            self.notes.append(f"inertia: that of a shaft of {length}, to compare diameters; no length was given")
        if required.stroke is None or (isinstance(table, dict) and "unsupported_length" in table):
            return False
        if isinstance(table, dict) and "ends" in table:
            self.tables["installation"] = {**table, "unsupported_length": f"{required.stroke!r} m"}
            return True
        if table is None:
            self.notes.append("inertia: that of the stroke alone; give the length of the shaft")
            self.notes.append("buckling and critical speed are not judged: give the ends of the shaft")
        return False

    def make_motion(self) -> None:
        """Make ``[motion]`` a trapezoid of stroke, feed and acceleration where it has no kind.

        The feed moves from ``[need]`` to the motion; what is missing is a fault, as is a force or a screw speed beside
        it.
        """
        tables = self.tables
        axis, motion = tables.setdefault("axis", {}), tables.setdefault("motion", {})
        if not isinstance(axis, dict) or not isinstance(motion, dict) or "kind" in motion:
            return
        missing = [Fault(place, MISSING, "", _BESIDE[place]) for place in _BESIDE if _at(tables, place) is None]
        operation = tables.get("operation", {})
        wrong = [
            Fault(f"operation.{name}", "is given beside a mass", str(operation[name]), _INSTEAD[name])
            for name in _INSTEAD
            if operation.get(name) is not None
        ]
        if missing or wrong:
            self.faults += [*missing, *wrong]
            tables["need"].pop("feed", None)  # it is no second fault
            return
        motion |= {"kind": "trapezoid", "stroke": tables["need"]["stroke"], "speed": tables["need"].pop("feed")}
        if "dwell" not in motion:
            self.notes.append(_WITHOUT_RESTS)
        if "inclination" not in axis:
            self.notes.append(_HORIZONTAL)


def _unknown(where: str, key: str, value: Any, known: Iterable[str]) -> Fault:
    """The fault of a name that is not known; it lists one name for each place."""
    if key in _ANY_SPEED:
        remedy = 'write feed = "15 m/min", the speed at which the load acts, and judge the fastest by a need of its own'
        return Fault(where, "could be two speeds", str(value), remedy, id=_UNKNOWN)
    result = closest(key, [*SHORT_NAMES, *known, *sections()])
    names = {place: name for name, place in reversed([*SHORT_NAMES.items()])}
    listed = dict.fromkeys([*reversed([*names.values()]), *known])
    remedy = f'did you mean "{result}"?' if result else f"known: {', '.join(listed)}"
    return Fault(where, "unknown name", str(value), remedy, id=_UNKNOWN)


def need_section() -> Any:
    """The table ``[need]`` as pydantic has it."""
    words = Annotated[str, Field(description="whether the load may, must (needed) or must not (forbidden) turn it")]
    grade = Annotated[str, Field(description="grade of ISO 3408-3: echoed, as no row lists its grades")]
    return section_of(
        "Need",
        fields_of(Requirements),
        Requirements,
        required=False,
        back_driving=(words, ALLOWED),
        accuracy=(grade, ""),
    )


def _one_oil(name: str) -> dict[str, str]:
    """A grade, however it is spelt, or an oil of the library."""
    known = {_spelt(grade): grade for grade in grades()}
    return {"grade": known[_spelt(name)]} if _spelt(name) in known else {"oil": name}


def _spelt(grade: str) -> str:
    return re.sub(r"[^a-z0-9]", "", grade.lower()).removeprefix("iso")


def _misfit(table: Any, required: Requirements) -> list[Fault]:
    """The fault of a stroke that the shaft is too short for."""
    if required.stroke is None or not isinstance(table, dict) or "unsupported_length" not in table:
        return []
    length = units.parse("", table["unsupported_length"], _LENGTH)
    if isinstance(length, Fault) or required.stroke < length:
        return []
    given = f"{units.shown(required.stroke, _LENGTH)} on {units.shown(length, _LENGTH)}"
    return [
        Fault("need.stroke", "does not fit between the bearings", given, "shorten the stroke, or lengthen the shaft")
    ]


def _at(tables: Mapping[str, Any], place: str) -> Any:
    section, _, name = place.partition(".")
    table = tables.get(section)
    return table.get(name) if isinstance(table, dict) else None
