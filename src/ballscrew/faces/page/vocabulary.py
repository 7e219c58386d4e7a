"""Vocabulary of the page: units, meanings and colours of results, and cases to start from."""

from __future__ import annotations

import functools
import importlib.metadata
from collections.abc import Mapping
from typing import Any
from urllib.parse import urlsplit

from pydantic import BaseModel, ConfigDict

from ballscrew.axis.duty_cycle.axis import Axis, Motor
from ballscrew.axis.motion.profiles import SCurve, Segment, Sine
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis import units
from ballscrew.basis.quantities import Info, Quantity, fields_of, quantities_of
from ballscrew.basis.version import __version__
from ballscrew.cases.schema.case_schema import DEFAULT_MODEL, MODELS
from ballscrew.cases.schema.duty_schema import MOTIONS, fields_of_motion
from ballscrew.cases.screw_tables.catalogue import EXAMPLE_PRELOADS
from ballscrew.cases.screw_tables.nut_kinds import LISTED, LOSSES, NUT_FIELDS
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.faces.page.starts import starts
from ballscrew.physics.components.materials import Lubricant, Material
from ballscrew.physics.components.nut import NUTS, Bodies, Scatter
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import LAWS, FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import NUT_REASONS
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.moving_balls.friction_states import Dahl, LuGre
from ballscrew.physics.sizing.catalogue import CatalogueRow, catalogue
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.solvers.load_distribution import BallLoads
from ballscrew.questions.condition import ConditionOptions
from ballscrew.questions.duty.compute import NUMBERS
from ballscrew.questions.fit import FitOptions
from ballscrew.questions.optimise import OptimiseOptions
from ballscrew.questions.reversal import ReversalOptions
from ballscrew.questions.ripple import RippleOptions
from ballscrew.questions.sensitivity import SensitivityOptions
from ballscrew.questions.service import ServiceOptions
from ballscrew.questions.shared.charts import MECHANISM_COLOURS
from ballscrew.questions.shared.options import Kind, vocabulary_of
from ballscrew.questions.warm_up.compute import SERIES

#: Units of inches and pounds, by the metric units that they replace; other units are the same in both.
_INCHES: Mapping[str, str] = {
    "mm": "in", "um": "uin", "N": "lbf", "kN": "lbf", "N m": "lbf in", "N mm": "lbf in", "MPa": "psi", "GPa": "psi",
    "degC": "degF", "m": "in", "m/min": "in/min",
}  # fmt: skip

#: The options of the questions, of which the page draws fields.
OPTIONS: Mapping[str, type] = {
    "condition": ConditionOptions, "fit": FitOptions, "optimise": OptimiseOptions, "reversal": ReversalOptions,
    "ripple": RippleOptions, "sensitivity": SensitivityOptions, "service": ServiceOptions,
}  # fmt: skip


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid")


class UnitChoice(_Table):
    """A unit that people use: SI = number × factor + offset."""

    unit: str
    factor: float
    offset: float


class ResultQuantity(_Table):
    """Meaning, symbol and units of a result."""

    meaning: str
    symbol: str
    unit: str
    shown_in: str


class Mechanism(_Table):
    """A part of the torque in words, and its colour."""

    words: str
    colour: str


class OptionOfQuestion(_Table):
    """An option of a question: its flag on the command line, what it is as it is written, and what it means."""

    name: str
    flag: str
    kind: Kind
    meaning: str
    unit: str | None
    default: float | bool | str | list[str] | dict[str, str] | None
    choices: list[str]


class NutKind(_Table):
    """The fields of a kind of nut, its halves with loaded balls each, and the preload that vendors give it."""

    fields: list[str]
    halves: int
    usual_preload: str | None


class Start(_Table):
    """A case to start from; one that moves has an axis and a motion."""

    title: str
    moves: bool
    case: dict[str, Any]


class StartRow(_Table):
    """A row of the catalogue to start from."""

    name: str
    source: str
    nut: str
    #: What the row stands under in a list: its source, or its maker and family.
    group: str
    #: Nominal diameter, lead and ball, mm.
    sizes: list[float]
    #: Why no torque is computed of it; empty where one is.
    refusal: str


class Vocabulary(_Table):
    """Units and their factors, results and mechanisms by name, models, and cases to start from."""

    version: str
    documentation: str | None
    units: dict[str, list[UnitChoice]]
    systems: dict[str, dict[str, str]]
    symbols: dict[str, str]
    results: dict[str, ResultQuantity]
    mechanisms: dict[str, Mechanism]
    reasons: dict[str, str]
    models: list[str]
    default_model: str
    limits: dict[str, float | None]
    nuts: dict[str, NutKind]
    motions: dict[str, list[str]]
    options: dict[str, list[OptionOfQuestion]]
    starts: dict[str, Start]
    rows: list[StartRow]


@functools.cache
def vocabulary() -> dict[str, Any]:
    """The vocabulary as one document."""
    return {
        "version": __version__,
        "documentation": _documentation(),
        "units": _units(),
        "systems": {"metric": {}, "inch": dict(_INCHES)},
        "symbols": _symbols(),
        "results": _results(),
        "mechanisms": _mechanisms(),
        "reasons": dict(NUT_REASONS),
        "models": list(MODELS),
        "default_model": DEFAULT_MODEL,
        "limits": {name: getattr(Limits(), name) for name in fields_of(Limits)},
        "nuts": {
            name: {"fields": list(fields_of(kind)), "halves": kind.halves, "usual_preload": EXAMPLE_PRELOADS.get(name)}
            for name, kind in NUTS.items()
        },
        "motions": {kind: list(fields_of_motion(kind)) for kind in MOTIONS},
        "options": {question: vocabulary_of(options) for question, options in OPTIONS.items()},
        "starts": starts(),
        "rows": [
            {
                "name": row.name,
                "source": row.source,
                "nut": row.nut or "single",
                "group": f"{row.make} {row.family}" if row.family else row.source,
                "sizes": sizes_of(row),
                "refusal": row.refusal and f"no torque is computed of it; {row.refusal}",
            }
            for row in catalogue().values()
        ],
    }


def sizes_of(row: CatalogueRow) -> list[float]:
    """Nominal diameter, lead and ball of a row, mm: those by which people search for it."""
    return [float(f"{1e3 * size:.12g}") for size in (row.nominal_diameter, row.lead, row.ball_diameter)]


def _documentation() -> str | None:
    """The address of the documentation, where the project gives one; the page asks nothing of it by itself."""
    try:
        addresses = importlib.metadata.metadata("ballscrew").get_all("Project-URL") or []
    except importlib.metadata.PackageNotFoundError:  # run from its sources: nothing says one
        return None
    for written in addresses:
        label, _, address = str(written).partition(",")
        # a name below .example is nobody's (RFC 2606): a project without a home has no documentation to link to
        if label.strip().lower() == "documentation" and not urlsplit(address.strip()).netloc.endswith(".example"):
            return address.strip()
    return None


def _units() -> dict[str, Any]:
    """The units people use, by SI unit: SI = number × factor + offset."""
    known = {si: dict.fromkeys((*usual, si)) for si, usual in units.USUAL.items()}
    of_models = (*quantities_of(Dahl).values(), *quantities_of(LuGre).values())
    for quantity in (*_known_results().values(), *NUMBERS.values(), *SERIES.values(), *_known_fields(), *of_models):
        if quantity.unit != "1":
            known.setdefault(quantity.unit, {})[quantity.shown_in] = None
    return {si: [_unit(unit, si) for unit in those] for si, those in known.items()}


def _symbols() -> dict[str, str]:
    """The symbols of units by their names, where they differ."""
    known = {one["unit"] for choices in _units().values() for one in choices}
    values = {unit: units.symbol(unit) for unit in sorted(known | {*_INCHES, *_INCHES.values()})}
    return {unit: symbol for unit, symbol in values.items() if symbol != unit}


def _unit(unit: str, si: str) -> dict[str, Any]:
    quantity = Quantity("", si, Info("", ""))
    offset = units.to_si(0.0, unit, quantity)
    return {"unit": unit, "factor": units.to_si(1.0, unit, quantity) - offset, "offset": offset}


def _known_fields() -> list[Quantity]:
    """The quantities that a case file can have."""
    parts = (
        BallScrew, Lubricant, OperatingState, Material, Bodies, Scatter, Installation, Limits, FrictionModel,
        Axis, Motor, SCurve, Sine, Segment, Surroundings,
    )  # fmt: skip
    laws = [law for slot in (*LAWS.values(), *LOSSES.values()) for law in slot.values() if isinstance(law, type)]
    return [*NUT_FIELDS.values(), *LISTED.values(), *(q for part in (*parts, *laws) for q in fields_of(part).values())]


def _described(quantity: Quantity) -> dict[str, str]:
    return {
        "meaning": quantity.info.meaning,
        "symbol": quantity.info.symbol,
        "unit": quantity.unit,
        "shown_in": quantity.shown_in,
    }


def _results() -> dict[str, Any]:
    """Results by name, as ``run`` and ``sweep`` name them."""
    return {name: _described(quantity) for name, quantity in _known_results().items()}


def _known_results() -> dict[str, Quantity]:
    known = {name: output.quantity for name, output in known_outputs().items()}
    for part in (FrictionResult, RaceState, BallLoads):
        known |= quantities_of(part)
    return known


def _mechanisms() -> dict[str, Any]:
    """The parts of the torque in words, and their colours; losses of the nut come after the balls."""
    more = ("#999999", "#8A6FB0", "#5B1A3A", "#2F6B7A", "#B07A4A", "#6B5B00")
    parts = {name: {"words": words, "colour": MECHANISM_COLOURS[name]} for name, words in MECHANISMS.items()}
    return parts | {slot: {"words": slot, "colour": colour} for slot, colour in zip(LOSSES, more, strict=True)}
