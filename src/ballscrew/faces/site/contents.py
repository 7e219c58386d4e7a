"""All that the static page knows besides its modules: names, units, bounds, words, and the screws to start from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity
from ballscrew.basis.version import __version__
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.exports.wasm_modules import NUT_DIAMETER, KeptModule, Module, described
from ballscrew.faces.site import kinds
from ballscrew.faces.site.banding import Banding, contents_of_bands
from ballscrew.faces.site.judging import Judging, contents_of_judging, of_start
from ballscrew.faces.site.modules import inputs_of_module
from ballscrew.faces.web.vocabulary import sizes_of, vocabulary
from ballscrew.physics.components.materials import TEMPERATURE
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.check.compute import TEMPERATURE as USUAL_TEMPERATURE


def contents(
    modules: Mapping[tuple[str, str], KeptModule],
    oils: Module,
    grades: tuple[str, ...],
    solver: str,
    judging: Judging,
    banding: Banding,
    calibrated: Mapping[tuple[str, str], KeptModule] | None = None,
) -> dict[str, Any]:
    """The contents as one JSON document; numbers are in SI.

    ``modules`` are those of models and kinds of nut, ``oils`` that of the ``grades``, ``solver`` the file of that of
    the balls, ``judging`` that of verdicts and checks, ``banding`` that of the values that a band draws, ``calibrated``
    those of structures as makers' torques ask for them.
    """
    words = vocabulary()
    subjects = {pair: kinds.subject_of(kinds.case_of(kinds.PAPER, *pair)) for pair in modules}
    known = {name: output for subject in subjects.values() for name, output in known_outputs(subject.nut).items()}
    given = {name for module in modules.values() for name in module.document["outputs"]}
    of_oils = zip(grades, oils.functions, strict=True)
    return {
        "version": __version__,
        "models": {model: _values(subjects, model) for model in dict.fromkeys(model for model, _ in modules)},
        "kinds": {
            name: {"words": kind.words, "is_preloaded": kind.is_preloaded, "nut": kind.nut}
            for name, kind in kinds.KINDS.items()
        },
        "structures": {f"{model}/{kind}": module.document for (model, kind), module in modules.items()},
        "solver": solver,
        "oils": {"file": oils.file, "grades": {grade: described(function) for grade, function in of_oils}},
        "judging": contents_of_judging(judging),
        "bands": contents_of_bands(banding, list(modules), calibrated or {}),
        "fields": _fields(subjects),
        "results": {name: _described(output.quantity) for name, output in known.items() if name in given},
        "mechanisms": words["mechanisms"],
        "reasons": words["reasons"],
        "symbols": words["symbols"],
        "units": words["units"],
        "usual_temperature": USUAL_TEMPERATURE,
        "starts": {name: _start(name) for name in kinds.start_tables()},
    }


def _described(quantity: Quantity) -> dict[str, Any]:
    offset = units.to_si(0.0, quantity.shown_in, quantity)
    return {
        "meaning": quantity.info.meaning,
        "symbol": quantity.info.symbol,
        "unit": quantity.unit,
        "shown_in": quantity.shown_in,
        "factor": units.to_si(1.0, quantity.shown_in, quantity) - offset,
        "offset": offset,
    }


def _values(subjects: Mapping[tuple[str, str], Configuration], model: str) -> dict[str, Any]:
    """The numbers of a model."""
    values: dict[str, float] = {}
    for (of, _), subject in subjects.items():
        if of == model:
            values |= {
                n: float(subject.value_of(n)) for n in inputs_of_module(subject) if subject.inputs[n][0] == "model"
            }
    return {"values": values}


def _fields(subjects: Mapping[tuple[str, str], Configuration]) -> dict[str, Any]:
    """The inputs of all modules by name: where they stand in a case file, their units and bounds."""
    known = {name: subject.inputs[name] for subject in subjects.values() for name in inputs_of_structure(subject)} | {
        TEMPERATURE.name: ("lubricant", TEMPERATURE)
    }
    return {name: _field(name, part, quantity) for name, (part, quantity) in known.items()}


def _field(name: str, part: str, quantity: Quantity) -> dict[str, Any]:
    info = quantity.info
    section = "" if name.startswith("losses.") else f"{part}."
    bounds = {"above": info.above, "at_least": info.at_least, "below": info.below, "at_most": info.at_most}
    return {
        "path": f"{section}{name}",
        **_described(quantity),
        **{bound: value for bound, value in bounds.items() if value is not None},
        "usual": info.usual,
        "whole": info.whole,
    }


def _start(name: str) -> dict[str, Any]:
    """A case to start from: its tables, its numbers, and those of each kind of nut."""
    row = catalogue().get(name) if name != kinds.PAPER else None
    nuts: dict[str, Any] = {}  # null stands for a diameter of the usual size
    values: dict[str, float] = {}
    temperature: Any = None
    for kind in kinds.KINDS:
        case = kinds.case_of(name, kinds.MODELS[0], kind)
        subject, temperature = kinds.subject_of(case), case.lubricant.temperature
        parts = {n: subject.inputs[n][0] for n in inputs_of_structure(subject) if n not in OPERATION}
        values |= {n: float(subject.value_of(n)) for n, part in parts.items() if part in ("screw", "lubricant")}
        values |= {n: float(getattr(case.operation, n)) for n in OPERATION}
        tables = kinds.tables_of(name, kinds.MODELS[0], kind)
        of_nut: dict[str, Any] = {n: float(subject.value_of(n)) for n, part in parts.items() if part == "nut"}
        if subject.nut.bodies is not None:
            of_nut[NUT_DIAMETER] = subject.nut.bodies.nut_outer_diameter
        nuts[kind] = {
            "values": of_nut,
            "tables": {section: tables[section] for section in ("nut", "bodies", "losses") if section in tables},
        }
    oil = kinds.start_tables()[name]["lubricant"]
    return {
        "title": "" if row is None else row.name,
        "make": "" if row is None else row.make,
        "source": "" if row is None else row.source,
        "sizes": [] if row is None else sizes_of(row),
        "kind": kinds.kind_of_start(name),
        "tables": kinds.start_tables()[name],
        "grade": oil.get("grade"),
        "temperature": temperature,
        "values": values,
        "nuts": nuts,
        "judged": of_start(name),
    }
