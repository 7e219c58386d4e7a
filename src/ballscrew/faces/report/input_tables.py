"""The inputs of a case for its report: each with its value and where that is from."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from typing import Any

from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.lubricants import described
from ballscrew.cases.schema.case_schema import name_of_law
from ballscrew.cases.screw_tables import catalogue
from ballscrew.cases.screw_tables.nut_kinds import ENDS, LISTED, kind_of
from ballscrew.engine.uncertainty.uncertain_value import describe_distribution
from ballscrew.faces.sheets.report_blocks import Table
from ballscrew.faces.sheets.report_blocks import value as value_of
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.oil_grades import TEMPERATURE, DataSheet, OilState, nominal_oil
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, BallScrew
from ballscrew.physics.friction.model import LAWS, coefficients
from ballscrew.physics.sizing.installation import Limits

#: Where a value is from, in a word; :data:`FROM_IN_WORDS` says what is meant.
CASE, ROW, USUAL, GRADE, DEFAULT, CALIBRATION = "case", "catalogue", "usual", "grade", "default", "calibration"
ESTIMATE = "estimate"
FROM_IN_WORDS: Mapping[str, str] = {
    CASE: "the case gives it",
    ESTIMATE: "estimated when the case was made, by the table of estimates in it: to be checked",
    ROW: "listed in the row of the catalogue, or computed from it",
    USUAL: "the catalogue does not list it: a usual value stands for it",
    GRADE: "of that oil at that temperature",
    DEFAULT: "the default of the program, also where the case gives that value",
    CALIBRATION: "found by the named calibration",
}
_COLUMNS, _TEXTS = ("", "value", "from"), (0, 2)
_OF_LAWS = ("", "law or value")
_USUAL_LIMITS = Limits()


def tables(case: Case) -> list[Table]:
    """All inputs, section by section."""
    values = [
        Table("Screw", _COLUMNS, _screw(case), _TEXTS),
        Table("Lubricant", _COLUMNS, _lubricant(case), _TEXTS),
        Table("Operating point", _COLUMNS, _operation(case), _TEXTS),
    ]
    others = {
        "Nut": _nut(case),
        "Installation": _installation(case),
        "Limits of the checks": _limits(case),
        **_moved(case),
    }
    values += [Table(title, _COLUMNS, rows, _TEXTS) for title, rows in others.items() if rows]
    return values


def sources_in_words(case: Case, result: list[Table]) -> str:
    """Legend of the words in the last column, of those that occur."""
    used = {str(row[-1]) for table in result for row in table.rows}
    words = [f"{name}: {text}" for name, text in FROM_IN_WORDS.items() if name in used]
    row = [] if case.origins.row is None else [f'the row is "{case.origins.row.name}" ({case.origins.row.source})']
    return f"{'; '.join([*words, *row])}."


Rows = list[tuple[str, str, str]]


def _source(case: Case, place: str, source: str) -> str:
    """The source of a value at a place in the case, which may say that it is an estimate."""
    return ESTIMATE if source == CASE and place in case.origins.estimated else source


def _part(
    case: Case, part: Any, known: Mapping[str, Quantity], section: str, source: Callable[[str], str] | None = None
) -> Rows:
    """The fields of a part, with their distribution where the case gives one.

    By itself the ``source`` of a value is the case, or the default that it equals.
    """
    rows, usual = list[tuple[str, str, str]](), _defaults(type(part))
    for name, quantity in known.items():
        value = getattr(part, name)
        if value is not None:
            given = case.origins.uncertain.get(name)
            words = value_of(value, quantity) if given is None else describe_distribution(given, quantity)
            exact = " ± 0" if name in case.origins.exact else ""
            own = DEFAULT if value == usual.get(name) else CASE
            word = CASE if given is not None else own if source is None else source(name)
            rows.append((quantity.info.meaning, words + exact, _source(case, f"{section}.{name}", word)))
    return rows


def _defaults(kind: Any) -> Mapping[str, Any]:
    return {field.name: field.default for field in dataclasses.fields(kind) if field.default is not dataclasses.MISSING}


def _screw(case: Case) -> Rows:
    usual, of_row = _defaults(BallScrew), None if case.origins.row is None else case.origins.row.screw()
    assumed = frozenset[str]() if case.origins.row is None else catalogue.assumed_fields(case.origins.row)

    def source(name: str) -> str:
        value = getattr(case.screw, name)
        if name in usual and value == usual[name] and (of_row is None or name not in assumed):
            return DEFAULT
        if of_row is not None and value == getattr(of_row, name):
            return USUAL if name in assumed else ROW
        return CASE

    rows = _part(case, case.screw, fields_of(BallScrew), "screw", source)
    for name, value in case.origins.listed.items():
        listed = case.origins.row is not None and getattr(case.origins.row, name) == value
        word = ROW if listed else _source(case, f"screw.{name}", CASE)
        rows.append((LISTED[name].info.meaning, value_of(value, LISTED[name]), word))
    return [*rows, *_materials(case.screw)]


def _materials(screw: BallScrew) -> Rows:
    """The materials of balls, screw and nut; one for all where the case gives none."""
    usual, materials = _defaults(BallScrew), {name: getattr(screw, name) for name in MATERIALS}
    if all(material is usual[name] for name, material in materials.items()):
        one = next(iter(materials.values()))
        return [(f"{meaning} of balls, screw, nut", value, DEFAULT) for meaning, value, _ in _material(one)]
    return [
        (f"{meaning} of the {name.partition('_')[0]}", value, DEFAULT if material is usual[name] else CASE)
        for name, material in materials.items()
        for meaning, value, _ in _material(material)
    ]


def _material(material: Any) -> Rows:
    return [(q.info.meaning, value_of(getattr(material, n), q), "") for n, q in fields_of(material).items()]


def _lubricant(case: Case) -> Rows:
    oil, usual = case.lubricant, _defaults(Lubricant)
    rows: Rows = []
    of_grade: OilState | None = None
    if case.origins.oil:
        of_grade = nominal_oil(oil)
        name = "grade" if "grade" in case.origins.oil else "oil"
        rows.append((name, described(case.origins.oil), _source(case, f"lubricant.{name}", CASE)))
        rows += [
            (q.info.meaning, value_of(case.origins.oil[n], q), CASE)
            for n, q in fields_of(DataSheet).items()
            if n in case.origins.oil
        ]
        if "temperature" in case.origins.oil:
            given = case.origins.uncertain.get("temperature")
            shown = value_of(case.origins.oil["temperature"], TEMPERATURE)
            words = shown if given is None else describe_distribution(given, TEMPERATURE)
            rows.append((TEMPERATURE.info.meaning, words, _source(case, "lubricant.temperature", CASE)))

    def source(name: str) -> str:
        value = getattr(oil, name)
        if name in usual and value == usual[name]:
            return DEFAULT
        return GRADE if of_grade is not None and value == getattr(of_grade, name, None) else CASE

    return [*rows, *_part(case, oil, fields_of(Lubricant), "lubricant", source)]


def _operation(case: Case) -> Rows:
    return _part(case, case.operation, fields_of(OperatingState), "operation", lambda _: CASE)


def _nut(case: Case) -> Rows:
    nut = case.nut
    if nut is None:
        return []
    of_row = case.origins.row is not None and (case.origins.row.nut or "single") == kind_of(nut)
    rows: Rows = [("kind of nut", kind_of(nut), ROW if of_row else CASE)]
    rows += (
        [
            (
                "spacer balls",
                "every second ball",
                ROW if case.origins.row is not None and case.origins.row.spacer_balls else CASE,
            )
        ]
        if nut.spacer_balls
        else []
    )
    own = {name: quantity for name, quantity in fields_of(nut).items() if getattr(nut, name) is not None}
    rows += _part(case, nut, own, "nut")
    given = nut.bodies
    if given is not None:
        bodies = given.sized(case.screw)
        rows += _part(
            case, bodies, fields_of(bodies), "bodies", lambda n: DEFAULT if getattr(given, n) is None else CASE
        )
    for section, part in nut.parts.items():
        if section not in ("nut", "bodies"):
            rows += _part(case, part, fields_of(part), section)
    return rows


def _installation(case: Case) -> Rows:
    mounted = case.installation
    if mounted is None:
        return []
    ends = next(name for name, known in ENDS.items() if known is mounted.ends)
    return [("ends of the screw", ends, CASE), *_part(case, mounted, fields_of(mounted), "installation")]


def _limits(case: Case) -> Rows:
    changed = {
        name: quantity
        for name, quantity in fields_of(Limits).items()
        if getattr(case.limits, name) != getattr(_USUAL_LIMITS, name)
    }
    return _part(case, case.limits, changed, "limits", lambda _: CASE)


def _moved(case: Case) -> dict[str, Rows]:
    """Axis with its bearings and guides, motion with its segments, motor, and surroundings."""
    segments: tuple[Any, ...] = getattr(case.motion, "segments", ())
    parts = {"Axis": case.axis, "Motion": case.motion, "Motor": case.motor, "Surroundings": case.surroundings}
    parts |= {f"Segment {number}: {part.name}".rstrip(": "): part for number, part in enumerate(segments, start=1)}
    parts |= {bearing.name.capitalize(): bearing.element for bearing in case.bearings.values()}
    parts |= {"Guides": None if case.axis is None else case.axis.guides}
    rows: dict[str, Rows] = {}
    for title, part in parts.items():
        if part is not None:
            given = {name: quantity for name, quantity in fields_of(part).items() if getattr(part, name) is not None}
            rows[title] = _part(case, part, given, title.lower())
    return rows


def laws(case: Case) -> Table:
    """The laws of the model with their coefficients, and its numbers."""
    model = case.model
    changed = set(model.changes)
    by_calibration = (
        set() if case.origins.calibration is None else {"ball_force", "friction"}
    )  # what components of a model a named calibration sets
    rows: Rows = []
    for slot in LAWS:
        law = getattr(model, slot)
        name = name_of_law(slot, law)
        known = coefficients(law)
        numbers = [
            f"{coefficient.replace('_', ' ')} "
            + (
                value_of(getattr(law, coefficient), quantity)
                if f"{slot}.{coefficient}" not in case.origins.uncertain
                else describe_distribution(case.origins.uncertain[f"{slot}.{coefficient}"], quantity)
            )
            for coefficient, quantity in known.items()
        ]
        source = CALIBRATION if slot in by_calibration and slot in changed else CASE if slot in changed else ""
        rows.append((slot.replace("_", " "), ": ".join(filter(None, [name, ", ".join(numbers)])), source))
    rows += _part(case, model, fields_of(model), "model", lambda n: CASE if n in changed else "")
    said = [(what, words + (f" (from: {source})" if source else "")) for what, words, source in rows]
    return Table(
        f"Laws and numbers of the model; what is not marked is that of {model.name}", _OF_LAWS, said, (0, 1), 1
    )
