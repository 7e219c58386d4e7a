"""Case files: TOML or JSON with units in, checked parts out.

Every fault of a file is found before anything is computed, and each is one line in the words of
:mod:`ballscrew.basis.errors`.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.basis import units
from ballscrew.basis.errors import UNKNOWN, Fault, InputError, closest, nearest
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.units import in_display_units
from ballscrew.cases.case_files import case_text, duty_tables, nut_tables, project, support_tables, uncertain_inputs
from ballscrew.cases.case_files.case import USUAL_LIMITS, Case, Origins
from ballscrew.cases.case_files.case_text import doubtful
from ballscrew.cases.case_files.lubricants import lubricant_of
from ballscrew.cases.case_files.named_calibration import calibrated_by_table, of_make, with_calibration
from ballscrew.cases.case_files.uncertain_inputs import written_bands
from ballscrew.cases.schema.case_schema import DEFAULT_MODEL, MODELS, NUT_TABLES, law_of, name_of_law, places_of
from ballscrew.cases.schema.duty_schema import DUTY_TABLES, SUPPORT_TABLES
from ballscrew.cases.schema.fields import NutSpeed, is_nut_speed
from ballscrew.cases.schema.reader import Reader, in_options
from ballscrew.cases.screw_tables.nut_kinds import LISTED, LOSSES
from ballscrew.physics.components.materials import Lubricant, Material
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import MATERIALS, BallScrew, rating_of
from ballscrew.physics.friction import calibrations
from ballscrew.physics.friction.model import LAWS, FrictionModel, coefficients
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.installation import Installation

_NEEDED = ("screw", "lubricant", "operation")
#: What somebody keeps with a case; no command reads it.
ASIDE = "aside"
#: Values that were estimated when the case was made, by section, as the case has them.
ESTIMATES = "estimates"
#: The sections that a case may have.
SECTIONS = (*_NEEDED, *NUT_TABLES, *DUTY_TABLES, *SUPPORT_TABLES, "model", "sweep", "calibration", ESTIMATES, ASIDE)


def load(
    path: str | Path,
    settings: Sequence[str] = (),
    model: str | None = None,
    *,
    calibration: str | None = None,
    allow_code: bool = False,
    moves: bool = False,
) -> Case:
    """The case of a file, with settings from the command line. Raises ``InputError`` with all faults.

    One that ``moves`` has an axis and a motion, see :func:`build`.
    """
    tables = override(read(path), settings)
    return build(tables, model, Path(path).parent, calibration=calibration, allow_code=allow_code, moves=moves)


def read(path: str | Path) -> dict[str, Any]:
    """The tables of a case file, TOML or JSON, or of a design in a project file: ``project.toml#name``.

    Raises :class:`~ballscrew.basis.errors.InputError` if it is none, and for a project of several designs without a
    name.
    """
    result = project.read(path)
    if len(result) > 1:
        names = ", ".join(design.name for design in result)
        remedy = f'name one: "{path}#{result[0].name}"; ballscrew compare takes them all'
        raise InputError(Fault(str(path), "is a project of several designs", names, remedy))
    return dict(result[0].tables)


def override(tables: dict[str, Any], settings: Sequence[str]) -> dict[str, Any]:
    """Tables with ``section.field=value`` settings put in; a value is TOML, or else text.

    Without a value the field is taken away.
    """
    faults: list[Fault] = []
    for setting in settings:
        # bytes of the command line that are no text come as surrogates
        path, equals, text = setting.encode("utf-8", "replace").decode().partition("=")
        *parents, field = path.strip().split(".")
        if not equals or not parents or not all([*parents, field]):
            places = places_of(path.strip()) if equals else []
            remedy = f"write {places[0]}={text}" if places else 'write operation.axial_load="4 kN"'
            faults.append(Fault("--set", "is not section.field=value", setting, remedy))
            continue
        table: dict[str, Any] = tables
        for parent in parents:
            inner = table.setdefault(parent, {})
            if parents == ["model", parent] and parent in LAWS and isinstance(inner, str):
                inner = table[parent] = {"law": inner}  # a law by name takes coefficients, too
            if not isinstance(inner, dict):
                faults.append(Fault(f"--set {path}", "is not a table", parent, f"set {parent} itself"))
                break
            table = inner
        else:
            if text.strip():
                table[field] = _literal(text.strip())
            else:
                table.pop(field, None)
    if faults:
        raise InputError(*faults)
    return tables


def _literal(text: str) -> Any:
    """A value from the command line, where quotes are often eaten by the shell."""
    try:
        return case_text.toml(f"value = {text}")["value"]
    except (ValueError, RecursionError):
        return text


def build(
    tables: Mapping[str, Any],
    model: str | None = None,
    folder: Path = Path(),
    rows: Mapping[str, CatalogueRow] | None = None,
    *,
    calibration: str | None = None,
    allow_code: bool = False,
    moves: bool = False,
) -> Case:
    """The case that tables describe. Raises ``InputError`` with all faults found.

    ``model`` and ``calibration`` win over the names in ``[model]``; the calibration ``"none"`` is the model as it is.

    A catalogue row is one of ``rows``, or of the file in ``folder`` that the case names, or of those shipped. Laws
    that it names as ``module:name`` are imported, from ``folder`` too, where ``allow_code`` says so. A case that
    ``moves`` needs an axis and a motion and no operating point: without one it has that of steady travel.
    """
    tables, chosen = with_calibration(tables, calibration), () if calibration is None else ("model.calibration",)
    reader = Reader(tables, folder, rows, _unknown_sections(tables))
    efficiency = duty_tables.efficiency(reader, model, moves)
    reader.faults += _missing_sections(tables, duty_tables.needed(_NEEDED, moves, efficiency))
    made = _screw(reader) if "screw" in reader else _NO_SCREW
    if (known := of_make(reader, tables, made.row)) is not tables:
        tables, reader = known, dataclasses.replace(reader, tables=known)
    lubricant, oil = lubricant_of(reader) if "lubricant" in reader else (None, {})
    moved = duty_tables.moved(reader)
    moved = moved._replace(axis=support_tables.guided(reader, moved.axis, lubricant))
    if efficiency is None:
        friction_model = _model(reader, model, folder if allow_code else None)
    else:  # no model counts, and no oil of the screw: any stands in
        friction_model = MODELS[DEFAULT_MODEL]
    sweep, fit = _sweep(reader, tables.get("sweep", {})), _fit(reader, tables.get("calibration", {}))
    estimated = _estimated(reader, tables)
    nut, notes = nut_tables.nut_of(reader, *made)
    mounted, bearings = _mounting(reader, lubricant)
    limits = nut_tables.limits(reader) if "limits" in reader else USUAL_LIMITS
    screw = made.screw if made.screw is None or nut is None else dataclasses.replace(made.screw, nut=nut)
    travels = moves and "operation" not in reader
    operation = _travel(moved, screw) if travels else _operation(reader, screw)
    root = None if screw is None else nut_tables.root_diameter(screw, made.listed)
    reader.faults += [*duty_tables.misfits(moved, mounted, root), *nut_tables.faults_of_root(screw, made.listed)]
    if efficiency is not None and lubricant is None:
        lubricant = Lubricant.from_grade("ISO VG 100")
    if reader.faults or screw is None or lubricant is None or operation is None or friction_model is None:
        raise InputError(*in_options(reader.faults, chosen))
    inputs, exact = uncertain_inputs.parse_distributions(tables, friction_model, screw, lubricant)
    of_air, exact_air = written_bands(tables.get("surroundings", {}))
    calibrated_by = tables.get("model", {}).get("calibration")
    return Case(
        model=friction_model,
        screw=screw,
        lubricant=lubricant,
        operation=operation,
        sweep=sweep,
        origins=Origins(
            oil=oil,
            row=made.row,
            listed=made.listed,
            notes=notes,
            calibration=None if calibrated_by is None else calibrations.calibration(calibrated_by),
            fit=fit,
            uncertain=inputs,
            exact=exact | exact_air,
            uncertain_surroundings=of_air,
            given_surroundings=frozenset(tables.get("surroundings", {})),
            uncertain_supports=support_tables.distributions(reader),
            estimated=estimated,
            doubtful_numbers=doubtful(tables, _rating(screw, made)),
            travels=travels,
            speed_of_nut=is_nut_speed(tables.get("operation", {}).get("screw_speed")),
        ),
        efficiency=efficiency,
        installation=mounted,
        limits=limits,
        axis=moved.axis,
        motion=moved.motion,
        motor=moved.motor,
        surroundings=moved.surroundings,
        bearings=bearings,
    )


def _unknown_sections(tables: Mapping[str, Any]) -> list[Fault]:
    """The faults of sections that no case has."""
    return [
        Fault(name, "unknown section", "", _meant(name, content), id=UNKNOWN)
        for name, content in tables.items()
        if name not in SECTIONS
    ]


def _missing_sections(tables: Mapping[str, Any], needed: Sequence[str]) -> list[Fault]:
    """The faults of sections that a case needs; one that is misspelt has its fault already."""
    misspelt = {closest(name, SECTIONS) for name in tables if name not in SECTIONS}
    return [
        Fault(
            name,
            "missing section",
            "",
            f"add a table [{name}]{_MOVE if name == 'operation' and 'motion' in tables else ''}",
        )
        for name in needed
        if name not in tables and name not in misspelt
    ]


def _rating(screw: BallScrew, made: _MadeScrew) -> float | None:
    """The dynamic load rating of a screw, as listed or by its geometry; None where it has none."""
    result = made.listed.get("dynamic_load_rating", float(rating_of(screw)))
    return result if math.isfinite(result) else None


def _meant(name: str, content: Any) -> str:
    """The place that was probably meant: that of a law or a loss which stands by itself, or a section written alike."""
    section = "model" if name in LAWS else "losses" if name in LOSSES else ""
    if not section:
        return nearest(name, SECTIONS)
    inner = [f".{field}" for field in content] if isinstance(content, dict) else [""]
    names = ", ".join(f"{section}.{name}{field}" for field in inner)
    return f"write {names}"


_WRITE_ESTIMATES = 'write [estimates.installation] and unsupported_length = "1 m"'
#: A motion stands in the file of another command.
_MOVE = "; only ballscrew duty and warm-up take the motion in its place"


class _MadeScrew(NamedTuple):
    """A screw, the row it was made from, and what is listed of it."""

    screw: BallScrew | None
    row: CatalogueRow | None
    listed: Mapping[str, float]


_NO_SCREW = _MadeScrew(None, None, {})


def _screw(reader: Reader) -> _MadeScrew:
    """The screw of a table, or of a catalogue row with what the table changes."""
    part = reader.part()
    table, values = reader.tables["screw"], reader.values_of("screw")
    row = nut_tables.row_of(reader, table) if isinstance(table, dict) else None
    if part.is_faulty:
        return _NO_SCREW
    given = {name: value for name, value in values.items() if name not in ("catalogue", "catalogue_file")}
    of_row = {} if row is None else {name: getattr(row, name) for name in LISTED}
    listed = {name: given.pop(name, of_row.get(name)) for name in LISTED}
    for name in MATERIALS:
        if name in given:
            given[name] = Material(**given[name])
    try:
        screw = BallScrew(**given) if row is None else row.screw(**given)
    except InputError as error:
        known = fields_of(BallScrew)
        for fault in error.faults:
            quantity = known.get(fault.where.rpartition(".")[2])
            if quantity is None:  # of the nut, whatever its numbers
                reader.faults.append(dataclasses.replace(fault, where="screw.catalogue", given=row.name if row else ""))
                continue
            written = table.get(quantity.name)
            if written is None and row is not None:
                written = units.shown(getattr(row, quantity.name), quantity)
            reader.faults.append(in_display_units(fault, quantity, str(written)))
        return _NO_SCREW
    return _MadeScrew(screw, row, {name: value for name, value in listed.items() if value is not None})


def _operation(reader: Reader, screw: BallScrew | None) -> OperatingState | None:
    """The load and the speed; a speed of the nut turns the screw by its lead. None without such a section."""
    if "operation" not in reader:
        return None
    part = reader.part()
    values = reader.values_of("operation")
    speed = values.get("screw_speed")
    if isinstance(speed, NutSpeed):
        if screw is None:
            return None  # its own faults are there already
        values["screw_speed"] = 2 * math.pi * speed / screw.lead
    return OperatingState(**values) if not part.is_faulty else None


def _travel(moved: duty_tables.Moved, screw: BallScrew | None) -> OperatingState | None:
    """The operating point of steady travel in the motion; None where a part of it is faulty."""
    if moved.axis is None or moved.motion is None or screw is None:
        return None
    return duty_tables.travel(moved.axis, moved.motion, screw.lead)


def _mounting(reader: Reader, lubricant: Lubricant | None) -> tuple[Installation | None, Mapping[str, MountedBearing]]:
    """The installation of the screw, and the bearings of its shaft by their place."""
    mounted = nut_tables.installation(reader) if "installation" in reader else None
    bearings = support_tables.bearings(reader, lubricant, mounted)
    return support_tables.mounted_on(mounted, bearings), bearings


def _model(reader: Reader, chosen: str | None, code: Path | None) -> FrictionModel | None:
    """A preset with the fields of the table put in; ``chosen`` on the command line wins over its name."""
    part = reader.part()
    table, values = reader.tables.get("model", {}), reader.values_of("model")
    named = table.get("name", DEFAULT_MODEL) if isinstance(table, dict) else DEFAULT_MODEL
    name = named if chosen is None else chosen
    if isinstance(name, str) and name not in MODELS:
        reader.refuse("model.name", "unknown model", name, nearest(name, MODELS))
    preset = MODELS.get(name) if isinstance(name, str) else None
    changes = _laws(reader, table, preset or MODELS[DEFAULT_MODEL], code) if isinstance(table, dict) else {}
    # a model that only the command line chose may leave aside what the case says for its own
    preset_force = preset.ball_force if preset is not None and name == named else None
    force = changes.get("ball_force", preset_force)
    if not traits_of(force).uses_imposed_force and "ball_to_ball_force" in table:
        problem = f'does not count with ball_force = "{name_of_law("ball_force", force)}"'
        names = " and ".join(f"ball_force.{name}" for name in coefficients(force))
        remedy = f'leave it out{f" and set {names}" if names else ""}, or write ball_force = "imposed"'
        reader.refuse("model.ball_to_ball_force", problem, str(table["ball_to_ball_force"]), remedy)
    if part.is_faulty or preset is None:
        return None
    numbers = {field: value for field, value in values.items() if field in fields_of(FrictionModel)}
    try:
        model = changed(preset, {**changes, **numbers})
        return calibrated_by_table(model, table) if "calibration" in table else model
    except InputError as error:
        reader.faults += error.faults
        return None


def _laws(reader: Reader, table: Mapping[str, Any], preset: FrictionModel, code: Path | None) -> dict[str, Any]:
    """The laws that a table puts into slots."""
    return {
        slot: law_of(slot, written, getattr(preset, slot), reader.faults, code)
        for slot, written in table.items()
        if slot in LAWS
    }


def changed(model: FrictionModel, changes: Mapping[str, Any]) -> FrictionModel:
    """A model with other laws and numbers. The offset that the paper imposes goes with its slip law."""
    if "slip" in changes and not traits_of(changes["slip"]).curvature_alone:
        changes = {"pure_rolling_offset": None, **changes}
    return dataclasses.replace(model, **changes)


def _sweep(reader: Reader, table: Any) -> Mapping[str, str]:
    if not isinstance(table, dict):
        reader.refuse("sweep", "must be a table", str(table), "write [sweep]")
        return {}
    remedy = 'write "100:4000:14 N" or "100, 200, 500 N"'
    reader.faults += [
        Fault(f"sweep.{n}", "must be text", str(v), remedy) for n, v in table.items() if not isinstance(v, str)
    ]
    return table


def _estimated(reader: Reader, tables: Mapping[str, Any]) -> frozenset[str]:
    """The places of values that the case still has as its table of estimates has them; others were changed since."""
    estimates = tables.get(ESTIMATES, {})
    if not isinstance(estimates, dict) or not all(isinstance(values, dict) for values in estimates.values()):
        reader.refuse(ESTIMATES, "must be a table of sections", str(estimates), _WRITE_ESTIMATES)
        return frozenset()
    return frozenset(
        f"{section}.{name}"
        for section, values in estimates.items()
        if isinstance(given := tables.get(section), dict)
        for name, value in values.items()
        if name in given and given[name] == value
    )


def _fit(reader: Reader, table: Any) -> dict[str, Any]:
    """The table [calibration], as a fit wrote it."""
    if not isinstance(table, dict):
        reader.refuse("calibration", "must be a table", str(table), "leave it as ballscrew fit wrote it")
        return {}
    if "constant_torque" in table:
        remedy = 'fit again, or move it: [losses] constant = {law = "known", constant_torque = "…"}'
        problem = "is of an earlier version, in which it was left out of the torque"
        reader.refuse("calibration.constant_torque", problem, str(table["constant_torque"]), remedy)
    return table
