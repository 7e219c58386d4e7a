"""The model against sets of stated values: which sets, under which conditions, and the values row by row."""

from __future__ import annotations

import dataclasses
import functools
import hashlib
from collections.abc import Hashable, Iterator, Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, fault_of, nearest, raise_if_any
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case, Origins
from ballscrew.cases.case_files.uncertain_inputs import Uncertain
from ballscrew.cases.schema.case_schema import MODELS
from ballscrew.cases.screw_tables.catalogue import COLUMNS
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.band_evaluation import PointGroup, bands_of
from ballscrew.evidence.validation.entries import (
    CONDITIONS,
    Conditions,
    Entry,
    OperatingPoint,
    Point,
    ValidationSet,
    Values,
)
from ballscrew.evidence.validation.sets import SETS
from ballscrew.files.tables.headings import Column
from ballscrew.files.tables.rows import made, read
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import Calibration, calibrated, calibration, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.traits import traits_of
from ballscrew.questions import card
from ballscrew.questions.band import compute

DEFAULT_CALIBRATION = "rexroth-2006"
_ALIASES: Mapping[str, tuple[str, ...]] = {
    "screw_speed": ("speed", "rpm", "rotational speed"),
    "grade": ("oil", "oil grade"),
    "temperature": ("oil temperature",),
}

# -- the request ---------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Request:
    """Sets to evaluate, with the model, the calibration and the conditions."""

    sets: Sequence[ValidationSet]
    model: FrictionModel
    calibration: Calibration | None
    #: Oil and speed in place of those of the sets, by the names of CONDITIONS.
    given: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])
    rows: Path | None = None
    keep_going: bool = False
    #: Torque cards and folders of them, in place of the sets.
    cards: Sequence[Path] = ()
    #: What is left out of all sets, and why.
    notes: Sequence[str] = ()
    #: Whether no set was named.
    everything: bool = False

    def conditions_of(self, data: ValidationSet) -> Conditions:
        """Oil and speed of a set, but for those that were given."""
        return dataclasses.replace(data.conditions, **self.given)


def request(
    names: Sequence[str] = (),
    *,
    model: str = "reference",
    calibration_name: str | None = None,
    rows: Path | None = None,
    keep_going: bool = False,
    grade: str | None = None,
    temperature: str | None = None,
    speed: str | None = None,
    cards: Sequence[Path] = (),
    summary: bool = False,
    to: Path | None = None,
    report: Path | None = None,
) -> Request:
    """The request that options mean. Raises :class:`~ballscrew.basis.errors.InputError` with all faults found."""
    has_conditions = grade is not None or temperature is not None or speed is not None
    faults = _faults_of_names(names, model, rows)
    if cards and (names or rows is not None or has_conditions):
        faults.append(Fault("--card", "goes with no set, rows or conditions", "", "a card has its own"))
    if summary and (cards or to is not None or report is not None):
        problem = "is a table of the sets" if cards else "is no picture and no paper"
        option = "--card" if cards else "--to" if to else "--report"
        remedy = f"leave {option} out"
        faults.append(Fault("--summary", problem, "", remedy))
    given = _conditions(grade, temperature, speed, faults)
    raise_if_any(faults)
    result, notes = _sets(names, MODELS[model]) if not cards else ([], [])
    if has_conditions and not any(data.conditioned for data in result):
        raise InputError(Fault("validate", "oil and speed do not move these sets", ", ".join(names), "leave them out"))
    chosen = calibration(calibration_name or DEFAULT_CALIBRATION)
    return Request(
        sets=result,
        model=MODELS[model],
        # a calibration goes with its model, unless it is asked for
        calibration=chosen if calibration_name or chosen.model == model else None,
        given=given,
        rows=rows,
        keep_going=keep_going,
        cards=cards,
        notes=notes,
        everything=not names and not cards,
    )


def _faults_of_names(names: Sequence[str], model: str, rows: Path | None) -> list[Fault]:
    """Sets and models that are not known, and rows of more or less than one set."""
    faults = [Fault("validate", "unknown set", name, nearest(name, SETS)) for name in names if name not in SETS]
    if model not in MODELS:
        faults.append(Fault("--model", "unknown model", model, nearest(model, MODELS)))
    if rows is not None and len(names) != 1:
        given = ", ".join(names) or "none"
        faults.append(Fault("--rows", "needs exactly one set", given, "name the set whose columns the file has"))
    return faults


def _sets(names: Sequence[str], model: FrictionModel) -> tuple[list[ValidationSet], list[str]]:
    """The sets asked for, or all those that the model can do."""
    wanted = [SETS[name] for name in dict.fromkeys(names)] or list(SETS.values())
    cannot = [data.name for data in wanted if data.four_contacts and 4 not in traits_of(model.slip).contacts_per_ball]
    if names and cannot:
        problem = f"model {model.name} knows no balls with four contacts"
        raise InputError(*(Fault(name, problem, "", "take the model reference") for name in cannot))
    notes = [f"{name}: left out, the model {model.name} knows no balls with four contacts" for name in cannot]
    return [data for data in wanted if data.name not in cannot], notes


def _conditions(
    grade: str | None, temperature: str | None, speed: str | None, faults: list[Fault]
) -> Mapping[str, Any]:
    """The conditions of the options; what is wrong with them goes to the list of faults."""
    given: dict[str, Any] = {} if grade is None else {"grade": grade}
    for option, name, text in (("--temperature", "temperature", temperature), ("--speed", "screw_speed", speed)):
        quantity = CONDITIONS[name]
        if text is None or quantity is None:
            continue
        value = units.parse(option, text, quantity)
        fault = value if isinstance(value, Fault) else fault_of(option, quantity, value)
        if fault is None:
            given[name] = value
        else:
            people = fault if fault is value else units.in_display_units(fault, quantity, text)
            faults.append(dataclasses.replace(people, where=option))
    try:
        _ = Conditions(**given).lubricant
    except InputError as error:
        faults += [dataclasses.replace(fault, where="--grade") for fault in error.faults if "grade" in fault.where]
    return given


# -- rows -----------------------------------------------------------------------------------------


def columns_of(data: ValidationSet) -> list[Column]:
    """The columns that a table of a set may have."""
    screw = [column for column in COLUMNS if column.name not in data.columns] if data.of_screws else []
    own = [Column(name, quantity) for name, quantity in data.columns.items()]
    further = [] if not data.conditioned else list(CONDITIONS.items())
    conditions = [Column(name, quantity, _ALIASES.get(name, ())) for name, quantity in further]
    return [
        dataclasses.replace(
            column,
            required=column.required or column.name in data.required,
            aliases=(*column.aliases, *data.aliases.get(column.name, ())),
        )
        for column in (*screw, *own, *conditions)
    ]


def evaluate(request: Request) -> Iterator[tuple[list[Entry], list[str]]]:
    """Each set or card with its entries, uncalibrated first, and notes on rows left out or on the card."""
    if request.cards:
        yield from card.evaluate(request.cards, request.model, request.calibration)
    for data in request.sets:
        models: list[tuple[FrictionModel, str | None]] = [(request.model, None)]
        if data.calibratable and request.calibration is not None:
            models.append((calibrated(request.model, request.calibration), request.calibration.name))
        entries, notes = entries_of(data, models, request)
        # of screws each of which could be the one measured, only the range says something
        yield entries if data.alternatives else [with_bands(entry) for entry in entries], notes


def entries_of(
    data: ValidationSet, models: Sequence[tuple[FrictionModel, str | None]], request: Request
) -> tuple[list[Entry], list[str]]:
    """A set with models and the names of their calibrations, without uncertainty bands, and notes on rows left out."""
    if request.rows is None:
        with resources.as_file(_shipped(data.file)) as path:
            points, notes = _points(path, data, models, request)
    else:
        points, notes = _points(request.rows, data, models, request)
        # nothing was chosen on rows that somebody brings
        data = dataclasses.replace(data, file="", used_for=(), rules_behind=())
    entries = [
        Entry(data=data, model=model, calibration=name, points=[point for row in points for point in row[i]])
        for i, (model, name) in enumerate(models)
    ]
    return entries, notes


def _points(
    path: Path, data: ValidationSet, models: Sequence[tuple[FrictionModel, str | None]], request: Request
) -> tuple[list[list[list[Point]]], list[str]]:
    """The points of each row, model by model."""
    table = read(path, columns_of(data))
    return made(
        table if request.rows else dataclasses.replace(table, unused=()),  # of a shipped table users can change nothing
        lambda row: [data.evaluate(model, row.values, request.conditions_of(data)) for model, _ in models],
        request.keep_going,
    )


@functools.cache
def shipped_rows(data: ValidationSet) -> tuple[Values, ...]:
    """The rows shipped with a set, SI."""
    with resources.as_file(_shipped(data.file)) as path:
        return tuple(made(read(path, columns_of(data)), lambda row: row.values)[0])


def _shipped(file: str) -> Any:
    return resources.files("ballscrew").joinpath("data/validation", file)


def fingerprint(file: str) -> str:
    """SHA-256 of a file of rows shipped, whatever its line ends."""
    text = _shipped(file).read_text(encoding="utf-8")
    return hashlib.sha256(text.encode()).hexdigest()


#: Samples of a row. The ends of a band of so many scatter by some per cent, which the width of the band hides.
SAMPLES = 256
_TORQUE = "screw_torque"


def with_bands(entry: Entry, samples: int = SAMPLES) -> Entry:
    """The entry with the ends of the uncertainty band of each of its points that is one state of one screw.

    Inputs have their usual distributions, laws their alternatives, as in a case without uncertainties of its own.
    Rows with nuts of one kind are evaluated together.
    """
    cases = {place: _case(entry, point.computed_at) for place, point in enumerate(entry.points) if point.computed_at}
    drawn = {place: uncertain_inputs.all_of(case) for place, case in cases.items()}
    alike: dict[Hashable, list[int]] = {}
    for place, case in cases.items():
        alike.setdefault(_kind(case, drawn[place]), []).append(place)
    points = list(entry.points)
    for places in alike.values():
        result = _bands([cases[place] for place in places], [drawn[place] for place in places], samples)
        for place, ends in zip(places, result, strict=True):
            points[place] = dataclasses.replace(points[place], uncertainty=ends)
    return dataclasses.replace(entry, points=points)


def _case(entry: Entry, at: OperatingPoint) -> Case:
    return Case(
        model=entry.model,
        screw=at.screw,
        lubricant=at.lubricant,
        operation=OperatingState(at.axial_load, at.screw_speed),
        origins=Origins(calibration=None if entry.calibration is None else calibrations()[entry.calibration]),
    )


def _kind(case: Case, inputs: Mapping[str, Uncertain]) -> Hashable:
    """Key that must be the same in cases that are evaluated together."""
    nut = case.screw.nut
    return type(nut), nut.spacer_balls, tuple(nut.losses), case.lubricant, tuple(inputs)


def _bands(cases: Sequence[Case], inputs: Sequence[Mapping[str, Uncertain]], samples: int) -> list[tuple[float, float]]:
    """The ends of the bands of cases of one kind."""
    first = cases[0]
    distributions = [compute.distributions(case, one) for case, one in zip(cases, inputs, strict=True)]
    # other than the first in nothing but numbers
    numbers = {name: [getattr(case.screw, name) for case in cases] for name in fields_of(BallScrew)}
    values = {name: np.array(of, dtype=float) for name, of in numbers.items() if any(one != of[0] for one in of)}
    values["preload"] = np.array([case.screw.nut.value_of("preload") for case in cases], dtype=float)
    values |= {
        name: np.array([getattr(case.operation, name) for case in cases], dtype=float)
        for name in fields_of(OperatingState)
    }
    group = PointGroup(
        Configuration(first.model, first.screw, first.lubricant),
        compute.alternatives(first),
        values,
        [independent for independent, _ in distributions],
        [joint for _, joint in distributions],
    )
    # so few points are sooner computed by the model itself than recorded
    both = bands_of(group, [_TORQUE], count=samples, seed=0, level=compute.LEVEL, engine="model").both[_TORQUE]
    return [(float(low), float(high)) for low, high in zip(*both, strict=True)]
