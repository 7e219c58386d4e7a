"""From a catalogue row or a case to torque, efficiency, stiffness, ratings, life and checks."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew import __version__
from ballscrew.analyses.checks import Check, Ratings, checks, ratings_of
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.assembly import NutFriction
from ballscrew.components.catalogue import CatalogueRow
from ballscrew.components.nut import SingleNut
from ballscrew.components.screw import BallScrew
from ballscrew.faults import Fault, InputError, raise_if_any
from ballscrew.interfaces import catalogue, config, nut_report, nut_tables, report, units
from ballscrew.interfaces.documents import as_json
from ballscrew.interfaces.nut_report import NutResult
from ballscrew.interfaces.nuts import LISTED, kind_of
from ballscrew.interfaces.options import in_options
from ballscrew.interfaces.wrapping import beside, wrapped
from ballscrew.quantities import Info, Quantity, quantities_of
from ballscrew.solvers.load_distribution import BallLoads

#: What is assumed where nothing is given.
GRADE, TEMPERATURE, SPEED, SHARE_OF_RATING = "ISO VG 100", "40 degC", "600 rpm", 0.1
#: The units people think in, by the units of the checks.
_SHOWN_IN = {"N": "kN", "Pa": "MPa", "s": "h", "rad/s": "rpm", "m rad/s": "mm rpm"}
#: What to give, as it is given here.
_GIVE = {
    "give installation": "give --length and --ends, or [installation]",
    "give limits.running_time": 'give --set limits.running_time="20000 h"',
}
_RESULT, _LOADS = quantities_of(NutFriction), quantities_of(BallLoads)
_NAMES = {"dynamic_load_rating": "dynamic", "static_load_rating": "static"}
_HEADINGS = ("name", "load", "torque", "eff.", "eff. back", "rigidity", "life", "verdict")
_WIDTH = 66


class Asked(NamedTuple):
    """What the command line gives: values by section.field, settings, and the name of a model."""

    given: Mapping[str, str]
    settings: Sequence[str]
    model: str | None


@dataclasses.dataclass(frozen=True, eq=False)
class Checked:
    """A screw, what came out of it, and what was assumed."""

    name: str
    case: config.Case
    parts: NutParts
    result: NutResult
    #: Ratings by the geometry; None for a screw that no catalogue has.
    computed: Ratings | None
    checks: Sequence[Check]
    assumed: Sequence[str]

    @property
    def verdict(self) -> str:
        """All checks in a few words."""
        failed = [check.name.replace("_", " ") for check in self.checks if check.passes is False]
        open_ones = sum(check.passes is None for check in self.checks)
        words = f"fails: {', '.join(failed)}" if failed else "passes"
        words += f"; {open_ones} of {len(self.checks)} not judged" if open_ones else ""
        return words if self.result.found.valid else f"{words}; outside the model's validity"

    def check(self, name: str) -> Check:
        """The check of that name."""
        return next(check for check in self.checks if check.name == name)


def one(name: str, path: Path | None, asked: Asked, keep_going: bool) -> tuple[Checked, Sequence[str]]:
    """A case file, or the row of that name, and what is to be said of rows left out."""
    if path is None and Path(name).suffix.lower() in (".csv", ".xlsx"):
        raise InputError(Fault(name, "is a table, not a case", "", f"write --rows {name}"))
    if path is None and (Path(name).suffix == ".toml" or "/" in name or Path(name).is_file()):
        return _of_case(Path(name), asked), ()
    rows, notes = catalogue.load(path, keep_going)
    return _of_row(catalogue.named(rows, name, file=path), asked), notes


def every_row(
    name: str | None, path: Path | None, asked: Asked, keep_going: bool
) -> tuple[Sequence[Checked], Sequence[str]]:
    """All rows, or those with these words, and what is to be said of rows left out.

    Raises :class:`~ballscrew.faults.InputError` if there is any fault; with ``keep_going`` only if no row is good.
    """
    rows, notes = catalogue.load(path, keep_going)
    chosen = catalogue.chosen(rows, name or "", path)
    found: list[Checked] = []
    faults: dict[str, Sequence[Fault]] = {}
    for row in chosen:
        try:
            found.append(_of_row(row, asked))
        except InputError as error:
            faults[f"{row.name} ({row.source})"] = error.faults
    if faults and not found and len({tuple(map(str, those)) for those in faults.values()}) == 1:
        raise InputError(*next(iter(faults.values())))  # what was asked for is at fault, not the rows
    by_row = [dataclasses.replace(f, where=f"{where}, {f.where}") for where, those in faults.items() for f in those]
    if not (keep_going and found):
        raise_if_any(by_row)
    left_out = [f"{len(faults)} of {len(chosen)} rows left out"] if faults else []
    return found, [*notes, *map(str, by_row), *left_out]


# -- what is computed -----------------------------------------------------------------------------


def _of_case(path: Path, asked: Asked) -> Checked:
    tables = config.read(path)
    words: list[str] = []
    if "nut" not in tables:
        of_row = isinstance(tables.get("screw"), dict) and "catalogue" in tables["screw"]
        words.append(
            "no [nut] given: the nut of the row, without preload" if of_row else "no [nut] given: a single nut"
        )
        tables["nut"] = {} if of_row else {"type": "single"}
    tables = _put(tables, asked)
    if words and isinstance(tables["nut"], dict) and tables["nut"].get("type") != "single":
        tables["nut"].setdefault("preload", "0 N")
    return checked(path.name, _built(tables, asked, path.parent), words)


def _of_row(row: CatalogueRow, asked: Asked) -> Checked:
    """The row with what was asked for, and with what is usual where nothing was."""
    tables: dict[str, Any] = {name: {} for name in ("nut", "bodies", "lubricant", "operation")}
    tables = _put({"screw": {"catalogue": row.name}, **tables}, asked)
    words = _filled(tables, row)
    words += [text for name, text in catalogue.assumed(row).items() if name != "loaded_turns"]
    return checked(row.name, _built(tables, asked, rows={row.name: row}), words)


def _built(
    tables: dict[str, Any], asked: Asked, folder: Path = Path(), rows: Mapping[str, CatalogueRow] | None = None
) -> config.Case:
    """The case of tables; faults of what options gave name the options."""
    try:
        return config.build(tables, asked.model, folder, rows)
    except InputError as error:
        model = () if asked.model is None else ("model.name",)
        raise InputError(*in_options(error.faults, (*asked.given, *model))) from None


def _put(tables: dict[str, Any], asked: Asked) -> dict[str, Any]:
    """Tables with what was asked for."""
    for place, text in asked.given.items():
        section, _, field = place.partition(".")
        table = tables.setdefault(section, {})
        if isinstance(table, dict):
            table[field] = text
    return config.override(tables, asked.settings)


def _filled(tables: dict[str, Any], row: CatalogueRow) -> list[str]:
    """Put what is usual into tables where nothing is given, and say so."""
    words: list[str] = []

    def fill(section: str, field: str, value: str, text: str) -> None:
        if isinstance(tables[section], dict) and field not in tables[section]:
            tables[section][field] = value
            words.append(text)

    listed = row.dynamic_load_rating
    load = SHARE_OF_RATING * (ratings_of(row).dynamic if listed is None else listed)
    force = units.shown(load, LISTED["dynamic_load_rating"])
    fill("operation", "axial_load", f"{load!r} N", f"axial load {force}: a tenth of C_a")
    fill("operation", "screw_speed", SPEED, f"speed {SPEED}")
    if isinstance(tables["lubricant"], dict) and "viscosity" not in tables["lubricant"]:
        fill("lubricant", "grade", GRADE, f"oil {GRADE}: none was given")
        fill("lubricant", "temperature", TEMPERATURE, f"oil at {TEMPERATURE}: no temperature was given")
    kind = row.nut or "single"
    fill("nut", "type", kind, f"{kind} nut, {'as listed' if row.nut else 'as the row lists none'}")
    usual = catalogue.EXAMPLE_PRELOADS.get(str(tables["nut"].get("type")))
    if usual is not None:
        fill("nut", "preload", usual, f"preload {usual} of C_a, usual for such a nut: none was given")
    return words


def checked(name: str, case: config.Case, words: Sequence[str]) -> Checked:
    """What comes out of a case; without a nut, of a single one. ``words`` are what is assumed besides."""
    parts = NutParts(nut=SingleNut()) if case.parts is None else case.parts
    result = nut_report.evaluate(case, parts)
    computed = _computed(case)
    rated = {name: case.listed.get(name) for name in _NAMES}
    stand_ins = [name for name, value in rated.items() if value is None and computed is not None]
    if computed is not None:
        rated |= {name: getattr(computed, _NAMES[name]) for name in stand_ins}
    load, left = float(case.operation.axial_load), float(result.found.loads.remaining_preload)
    found = checks(
        case.screw,
        axial_load=load,
        screw_speed=float(case.operation.screw_speed),
        nut=parts.nut,
        **rated,
        half_loads=(load + left, left) if left > 0 else (load,),
        maximum_pressure=float(result.found.maximum_pressure),
        root_diameter=case.listed.get("root_diameter"),
        installation=case.installation,
        limits=case.limits,
    )
    said = [f"{name.replace('_', ' ')} computed from the geometry: none is listed" for name in stand_ins]
    assumed = list(
        dict.fromkeys([*words, *nut_report.assumptions(case, parts), *said, nut_report.left_out(case, parts)])
    )
    return Checked(name, case, parts, result, computed, found, assumed)


def _computed(case: config.Case) -> Ratings | None:
    try:
        return nut_tables.ratings(case.screw, case.row)
    except InputError:
        return None


# -- for people -----------------------------------------------------------------------------------


def _quantity(check: Check) -> Quantity:
    return Quantity(check.name, check.unit, Info("", check.name, _SHOWN_IN.get(check.unit, "")))


def shown(check: Check, value: float | None) -> str:
    """Four digits and the unit, up to a million without an exponent."""
    if value is None or not math.isfinite(value):
        return "–"
    quantity = _quantity(check)
    rounded = float(f"{value:.4g}") if quantity.unit == "1" else float(units.shown(value, quantity).split()[0])
    return f"{rounded:.6g}" + ("" if quantity.unit == "1" else f" {quantity.shown_in}")


def _line(what: str, value: str) -> str:
    return f"  {what:<{_WIDTH}} {value}"


def text(found: Checked) -> str:
    """All that is known of one screw."""
    case, result = found.case, found.result
    source = "" if case.row is None else f" ({case.row.source})"
    lines = [
        f"{found.name}{source}: {report.operating_point(case)}, {nut_report.nut_in_words(found.parts)}, "
        f"{report.model_in_words(case)}",
        "",
        *_geometry(found),
        "",
        "Torque and efficiency",
        *(
            _line(_RESULT[name].info.meaning, report.shown_or_dash(getattr(result.found, name), _RESULT[name]))
            for name in ("screw_torque", "drive_torque", "efficiency", "back_driving_efficiency", "friction_power")
        ),
        _line("torque without load", report.shown_or_dash(result.preload_drag, _RESULT["screw_torque"])),
        *(f"  {line}" for line in nut_report.verdicts(result)),
        "",
        "Stiffness",
        *_stiffness(result),
        "",
        *_ratings(found),
        "",
        *_checks(found),
        "",
        f"verdict: {found.verdict}",
        *(f"beware  {warning}" for warning in result.found.warnings),
        "",
        "assumed",
        *(f"  {words}" for words in found.assumed),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def _geometry(found: Checked) -> list[str]:
    screw, known = found.case.screw, quantities_of(BallScrew)
    lines = [
        _line(known[name].info.meaning, units.shown(getattr(screw, name), known[name]))
        for name in ("pitch_circle_diameter", "lead", "lead_angle", "ball_diameter", "loaded_balls", "contact_angle")
    ]
    root = nut_tables.root_diameter(screw, found.case.listed)
    return ["Geometry", *lines, _line(LISTED["root_diameter"].info.meaning, units.shown(root, LISTED["root_diameter"]))]


def _stiffness(result: NutResult) -> list[str]:
    names = ["deflection", "rigidity", *(["remaining_preload", "lift_off_load"] if result.preload else [])]
    loads = result.found.loads
    return [_line(_LOADS[n].info.meaning, report.shown_or_dash(float(getattr(loads, n)), _LOADS[n])) for n in names] + [
        _line(
            _RESULT["maximum_pressure"].info.meaning,
            report.shown_or_dash(result.found.maximum_pressure, _RESULT["maximum_pressure"]),
        )
    ]


def _ratings(found: Checked) -> list[str]:
    lines = [f"{'Ratings':<{_WIDTH + 2}} {'listed':>12} {'ISO 3408-5':>12}"]
    for name, field in _NAMES.items():
        quantity = LISTED[name]
        values = found.case.listed.get(name), None if found.computed is None else getattr(found.computed, field)
        cells = ("–" if value is None else units.shown(value, quantity) for value in values)
        lines.append(f"  {quantity.info.meaning:<{_WIDTH}} " + " ".join(f"{cell:>12}" for cell in cells))
    return lines


def _checks(found: Checked) -> list[str]:
    lines = [f"{'Checks':<26}{'value':>12} {'limit':>12} {'used':>7}  verdict"]
    for check in found.checks:
        used = "–" if check.utilisation is None else f"{check.utilisation:.1%}"
        verdict = {True: "passes", False: "FAILS", None: ""}[check.passes]
        words = check.words
        for given, here in _GIVE.items():
            words = words.replace(given, here)
        cells = f"{shown(check, check.value):>12} {shown(check, check.limit):>12} {used:>7}"
        prefix = f"  {check.name.replace('_', ' '):<24}{cells}  "
        lines.append(beside(prefix, ": ".join(filter(None, [verdict, words]))))
    return lines


def list_text(found: Sequence[Checked]) -> str:
    """One line a screw; a long verdict goes on below itself."""
    lines = [list(_HEADINGS), *map(_cells, found)]
    widths = [max(len(line[place]) for line in lines) for place in range(len(_HEADINGS))]
    return "\n".join(
        beside(
            "".join(
                (cell.rjust(width) if place else cell.ljust(width)) + "  "
                for place, (cell, width) in enumerate(zip(numbers, widths, strict=False))
            ),
            verdict,
        )
        for *numbers, verdict in lines
    )


def _cells(found: Checked) -> list[str]:
    result = found.result.found
    numbers = [
        units.shown(result.axial_load, LISTED["dynamic_load_rating"]),
        *(
            report.shown_or_dash(getattr(result, name), _RESULT[name])
            for name in ("screw_torque", "efficiency", "back_driving_efficiency")
        ),
    ]
    # at the same speed as all others: the revolutions would say no more
    life = shown(found.check("running_time"), found.check("running_time").value)
    rigidity = report.shown_or_dash(float(result.loads.rigidity), _LOADS["rigidity"])
    return [found.name, *numbers, rigidity, life, found.verdict]


# -- for programs ---------------------------------------------------------------------------------


def document(found: Checked) -> dict[str, Any]:
    """One screw in SI."""
    case, result = found.case, found.result
    known = quantities_of(BallScrew)
    return {
        "name": found.name,
        "nut": kind_of(found.parts.nut),
        "inputs": config.inputs(case),
        "geometry": {
            "lead_angle": case.screw.lead_angle,
            "root_diameter": nut_tables.root_diameter(case.screw, case.listed),
        },
        "results": nut_report.results(result),
        "loads": nut_report.loads(result),
        "ratings": {
            "listed": {name: case.listed.get(name) for name in _NAMES},
            "computed": None if found.computed is None else {n: getattr(found.computed, f) for n, f in _NAMES.items()},
        },
        "checks": [check._asdict() for check in found.checks],
        "verdict": found.verdict,
        "assumed": list(found.assumed),
        "units": {
            **nut_report.result_units(result.found),
            "geometry": {"lead_angle": known["lead_angle"].unit, "root_diameter": LISTED["root_diameter"].unit},
            "ratings": {name: LISTED[name].unit for name in _NAMES},
        },
        "warnings": nut_report.warnings(result),
        "provenance": {"version": __version__, "model": case.model.label, "references": config.references(case)},
    }


def json_text(found: Checked) -> str:
    """One JSON object; non-finite is null."""
    return as_json(document(found))


def list_json(found: Sequence[Checked]) -> str:
    """A list of objects, without the loads ball by ball."""
    documents = [document(screw) for screw in found]
    for each in documents:
        del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return as_json(documents)
