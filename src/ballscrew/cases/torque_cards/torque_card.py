"""Torque cards: a measured screw as a file, with its torque without load over the speed, both ways.

The sections on screw, nut and oil are those of a case file, so a card can be computed, fitted and made a case of.
Format and bounds come from the models below; ``ballscrew card schema`` prints them as JSON Schema.
"""

from __future__ import annotations

import dataclasses
import datetime
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, create_model

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest, raise_if_any
from ballscrew.basis.quantities import AngularSpeed, Info, Length, Quantity, Temperature, Torque, fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.opened_file import moved
from ballscrew.cases.schema.case_schema import read_table, sections, without_null
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.solvers.load_distribution import preload_of

#: The version of the format that this program writes and reads.
FORMAT = 1
#: Sections that mean what they mean in a case file.
CASE_SECTIONS = ("screw", "nut", "lubricant", "bodies", "deviations", "losses")
_NEEDED = ("card", "screw", "nut", "lubricant", "setup", "points")
_KNOWN = (*_NEEDED, "bodies", "deviations", "losses")
#: A reading this many times another in the same card is a slip of the unit.
LARGEST_RATIO = 1000.0


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class TorquePoint:
    """Mean torques at one steady speed without load, as magnitudes; one of the two directions at least."""

    screw_speed: Annotated[AngularSpeed, Info("n", "steady speed of the screw", "rpm", above=0, hint="a magnitude")]
    torque_forward: Annotated[
        Torque | None, Info("T_f", "mean torque, positive rotation", "N m", above=0, hint="a magnitude, nut unloaded")
    ] = None
    torque_backward: Annotated[
        Torque | None, Info("T_b", "mean torque, negative rotation", "N m", above=0, hint="a magnitude, nut unloaded")
    ] = None
    temperature: Annotated[
        Temperature | None, Info("T", "temperature at the nut during this point", "degC", above=0, hint='"24 degC"')
    ] = None

    @property
    def signed_readings(self) -> dict[int, float]:
        """The torques that were measured, by the direction of rotation: 1 and -1."""
        measured = {1: self.torque_forward, -1: self.torque_backward}
        return {direction: float(torque) for direction, torque in measured.items() if torque is not None}

    @property
    def readings(self) -> tuple[float, ...]:
        """The torques of both directions, as far as they were measured."""
        return tuple(self.signed_readings.values())

    @property
    def torque(self) -> float:
        """Mean of both directions."""
        return sum(self.readings) / len(self.readings)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Setup:
    """Quantities of the measurement; what is text stands beside them in the card."""

    torque_uncertainty: Annotated[
        Torque,
        Info(
            "U", "uncertainty of a mean torque, which holds 95 %", "N m", above=0, hint="of the instrument, offset too"
        ),
    ]
    nut_outer_diameter: Annotated[
        Length | None, Info("D_1", "outer diameter of the nut body", "mm", above=0, hint="as the catalogue has it")
    ] = None


class _About(BaseModel):
    """People, subject and date of a measurement, and what others may do with it."""

    model_config = ConfigDict(extra="forbid", title="Card")

    format: Literal[1] = Field(description="version of the format")
    title: str = Field(min_length=1, description="a line by which the screw is known")
    made_by: Literal["measurement", "model"] = Field(description="model: a synthetic card, which proves nothing")
    who: str = Field(min_length=1, description="person or laboratory that measured")
    when: datetime.date = Field(description="date of the measurement, 2026-11-22")
    licence: str = Field(min_length=1, description="what others may do with the card: CC0-1.0, CC-BY-4.0")
    source: str | None = Field(default=None, description="address of the raw data, or of a publication")
    notes: str | None = Field(default=None, description="what else a reader must know, and what is not known")


class _SetupText(BaseModel):
    """Remarks on the set-up that are no quantities."""

    wipers: bool = Field(strict=True, description="whether wipers or seals were fitted during the measurement")
    instrument: str = Field(min_length=1, description="sensor and how the nut is held")
    lubrication: str | None = Field(default=None, description="product, amount, how it was put in")
    run_in: str | None = Field(default=None, description="what the screw had run before")


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class TorqueCard:
    """A card read and checked: its screw as a case, and its points in SI."""

    name: str
    about: Mapping[str, Any]
    setup: Setup
    #: ``wipers``, ``instrument``, ``lubrication``, ``run_in``.
    remarks: Mapping[str, Any]
    case: Case
    points: Sequence[TorquePoint]
    #: The tables as they are written.
    tables: Mapping[str, Any]

    @property
    def synthetic(self) -> bool:
        """True where a model made the numbers."""
        return self.about["made_by"] == "model"

    @property
    def title(self) -> str:
        """The title, with a mark where the card is synthetic."""
        return f"{'SYNTHETIC, made by a model: ' if self.synthetic else ''}{self.about['title']}"

    @property
    def notes(self) -> list[str]:
        """Reasons why the card cannot be compared as it is, and what is not stated."""
        notes: list[str] = []
        if self.synthetic:
            notes.append("synthetic: made by a model, says nothing of a screw")
        if self.remarks["wipers"] and not self.case.screw.nut.losses:
            notes.append("wipers were fitted, and [losses] has no torque of them: the model leaves them out")
        if any(len(point.readings) == 1 for point in self.points):
            notes.append("some points have one direction only: an offset of the sensor is in them")
        if all(point.temperature is None for point in self.points):
            notes.append("no temperature by point: that of the oil holds for all")
        notes += [f"not stated: setup.{name}" for name in ("lubrication", "run_in") if self.remarks.get(name) is None]
        return notes


def _quantities(cls: type) -> dict[str, Quantity]:
    """The quantities of a class; a temperature may be written with its zero point."""
    return {name: TEMPERATURE if name == "temperature" else quantity for name, quantity in fields_of(cls).items()}


def _point_model() -> type[BaseModel]:
    return section_of("Point", _quantities(TorquePoint), TorquePoint, required=True)


def _setup_model() -> type[BaseModel]:
    text: dict[str, Any] = {name: (field.annotation, field) for name, field in _SetupText.model_fields.items()}
    return section_of("Setup", _quantities(Setup), Setup, required=True, uncertain=(), **text)


def json_schema() -> dict[str, Any]:
    """JSON Schema of a torque card."""
    case = sections()
    point: Any = _point_model()
    description = "steady speeds, without axial load"
    fields: dict[str, Any] = {
        "card": (_About, ...),
        "screw": (case["screw"] | case["screw_of_row"], ...),
        "nut": (case["nut"], ...),
        "lubricant": (case["lubricant"], ...),
        "setup": (_setup_model(), ...),
        "points": (list[point], Field(min_length=1, description=description)),
        **{name: (case[name], Field(default=None)) for name in ("bodies", "deviations", "losses")},
    }
    config = ConfigDict(extra="forbid", title="ballscrew torque card")
    schema = create_model("BallscrewTorqueCard", __config__=config, **fields).model_json_schema()
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **without_null(schema)}


def read(path: Path) -> TorqueCard:
    """The card of a file. Raises :class:`~ballscrew.basis.errors.InputError` with all faults found."""
    tables = case_file.read(path)
    faults = [Fault(name, "unknown section", "", nearest(name, _KNOWN)) for name in tables if name not in _KNOWN]
    faults += [Fault(name, "missing section", "", _remedy(name)) for name in _NEEDED if name not in tables]
    about = read_table("card", _About, tables["card"], faults) if "card" in tables else {}
    setup = read_table("setup", _setup_model(), tables["setup"], faults) if "setup" in tables else {}
    points = _points(tables["points"], faults) if "points" in tables else []
    case = _case(tables, path.parent, faults)
    if case is not None and not case.origins.oil and any("temperature" in point for point in points):
        remedy = 'write lubricant.grade = "ISO VG 68", so that the viscosity follows the temperature'
        faults.append(Fault("points.temperature", "needs an oil of a data sheet or a grade", "", remedy))
    if faults or case is None:
        raise InputError(*(dataclasses.replace(fault, where=f"{path.name}: {fault.where}") for fault in faults))
    remarks = {name: setup.pop(name, None) for name in _SetupText.model_fields}
    return TorqueCard(
        name=path.stem,
        about=about,
        setup=Setup(**setup),
        remarks=remarks,
        case=case,
        points=[TorquePoint(**point) for point in points],
        tables=tables,
    )


def _remedy(name: str) -> str:
    if name == "points":
        return "add a table [[points]] for each speed"
    return f"add a table [{name}]"


def _case(tables: Mapping[str, Any], folder: Path, faults: list[Fault]) -> Case | None:
    """The screw of a card as a case without load; a nut without preload, which has no drag, is a fault."""
    if not all(name in tables for name in ("screw", "nut", "lubricant")):
        return None
    try:
        case = case_file.build(case_tables(tables), folder=folder)
    except InputError as error:
        faults += error.faults
        return None
    if not float(preload_of(case.screw, case.screw.nut)):
        remedy = "a card is of a preloaded nut; for torques under load use ballscrew fit"
        faults.append(Fault("nut.preload", MISSING, "", remedy))
    return case


def case_tables(tables: Mapping[str, Any]) -> dict[str, Any]:
    """The tables of a case file with the screw, the nut and the oil of a card, without load at 100 rpm."""
    own = {name: tables[name] for name in CASE_SECTIONS if name in tables}
    return {**own, "operation": {"axial_load": "0 N", "screw_speed": "100 rpm"}}


def _points(written: Any, faults: list[Fault]) -> list[dict[str, Any]]:
    """The points in SI; what is wrong goes to the list of faults."""
    if not isinstance(written, list) or not written:
        faults.append(Fault("points", "must be tables", "", "write [[points]] for each speed"))
        return []
    model, before = _point_model(), len(faults)
    rows: list[dict[str, Any]] = []
    for place, table in enumerate(written, 1):
        own = len(faults)
        values = read_table(f"points.{place}", model, table, faults)
        if len(faults) == own and not {"torque_forward", "torque_backward"} & set(values):
            remedy = 'add torque_forward = "… N m", torque_backward, or both'
            faults.append(Fault(f"points.{place}.torque_forward", MISSING, "", remedy))
        rows.append(values)
    return _plausible(rows, faults) if len(faults) == before else []


def _plausible(points: list[dict[str, Any]], faults: list[Fault]) -> list[dict[str, Any]]:
    """The points, unless two readings cannot be of one screw."""
    torques = [value for point in points for name, value in point.items() if name.startswith("torque")]
    if max(torques) > LARGEST_RATIO * min(torques):
        quantity = fields_of(TorquePoint)["torque_forward"]
        given = f"{units.shown(min(torques), quantity)} to {units.shown(max(torques), quantity)}"
        faults.append(Fault("points", "has torques too far apart for one screw", given, "check the units"))
    return points


def read_all(paths: Sequence[Path]) -> list[TorqueCard]:
    """The cards of files, and of folders the files ``*.toml`` in them; all faults of all of them in one error."""
    files = [file for path in paths for file in (sorted(path.glob("*.toml")) if path.is_dir() else [path])]
    empty = [path for path in paths if path.is_dir() and not any(path.glob("*.toml"))]
    faults = [Fault(str(path), "has no torque cards", "", "put files *.toml into it") for path in empty]
    cards: list[TorqueCard] = []
    for file in files:
        try:
            cards.append(read(file))
        except InputError as error:
            faults += error.faults
    raise_if_any(faults)
    return cards


def log_rows(card: TorqueCard) -> list[dict[str, float]]:
    """The readings as rows of a log for a fit: a row for each direction, with its sign; SI."""
    return [
        {
            "screw_speed": direction * float(point.screw_speed),
            "axial_load": 0.0,
            "torque": direction * torque,
            "temperature": math.nan if point.temperature is None else float(point.temperature),
        }
        for point in card.points
        for direction, torque in point.signed_readings.items()
    ]


_HEADINGS = ("speed [rpm]", "axial load [N]", "torque [N m]", "temperature [degC]")


def write(card: TorqueCard, folder: Path, log: Path, case: Path) -> None:
    """Write the log and the case file of a card from a folder."""
    import tomlkit

    tables = moved(case_tables(card.tables), folder, case.parent)
    head = f"# Of the torque card {card.name}: {card.title}\n"
    with atomic_write("--case", case) as path:
        path.write_text(f"{head}\n{tomlkit.dumps(tables)}", encoding="utf-8")
    speed, torque = (fields_of(TorquePoint)[name] for name in ("screw_speed", "torque_forward"))
    lines = [",".join(_HEADINGS)]
    for row in log_rows(card):
        temperature = row["temperature"]
        cells = (
            units.from_si(row["screw_speed"], speed),
            row["axial_load"],
            units.from_si(row["torque"], torque),
            "" if math.isnan(temperature) else units.from_si(temperature, TEMPERATURE),
        )
        lines.append(",".join(cell if isinstance(cell, str) else f"{cell:.9g}" for cell in cells))
    with atomic_write("--to", log) as path:
        path.write_text(head + "\n".join(lines) + "\n", encoding="utf-8")
