"""All that the page knows without a server, besides its modules: words, schema, bounds, screws to start from."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import tomlkit

from ballscrew.basis.quantities import Quantity, fields_of, quantities_of
from ballscrew.basis.version import __version__
from ballscrew.cases.schema.case_schema import json_schema
from ballscrew.cases.screw_tables.catalogue import case_text
from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.engine.evaluation.outputs import OPERATION, known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.exports.wasm_modules import NUT_DIAMETER, KeptModule, Module, described
from ballscrew.faces.page import kinds
from ballscrew.faces.page.banding import Banding, contents_of_bands
from ballscrew.faces.page.judging import Judging, contents_of_judging, of_start
from ballscrew.faces.page.modules import inputs_of_module
from ballscrew.faces.page.starts import starts
from ballscrew.faces.page.vocabulary import vocabulary
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.friction.result import QUADRANTS
from ballscrew.physics.laws.contact import RaceState
from ballscrew.physics.sizing.catalogue import catalogue
from ballscrew.questions.curves import COLD, HOT, axes_around
from ballscrew.questions.run.answer import document
from ballscrew.questions.run.compute import run


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
    fields = _fields(subjects)
    return {
        "version": __version__,
        "models": {model: _values(subjects, model) for model in dict.fromkeys(model for model, _ in modules)},
        "kinds": {name: {"is_preloaded": kind.is_preloaded} for name, kind in kinds.KINDS.items()},
        "structures": {f"{model}/{kind}": module.document for (model, kind), module in modules.items()},
        "solver": solver,
        "oils": {"file": oils.file, "grades": {grade: described(function) for grade, function in of_oils}},
        "judging": contents_of_judging(judging),
        "bands": contents_of_bands(banding, list(modules), calibrated or {}),
        "fields": fields,
        "byPath": {field["path"]: name for name, field in fields.items()},
        "results": {name: _described(output.quantity) for name, output in known.items() if name in given},
        "race_names": list(quantities_of(RaceState)),
        "listed": {f"screw.{name}": _field(name, "screw", quantity) for name, quantity in LISTED.items()},
        "needed": [f"screw.{name}" for name in json_schema()["$defs"]["Screw"]["required"]],
        "templates": {f"{model}/{kind}": _inputs(model, kind) for model, kind in modules},
        "axes": {"row": axes_around(is_nut=False), "nut": axes_around(is_nut=True)},
        "vocabulary": {**words, "rows": [_row(row) for row in words["rows"]]},
        "schema": json_schema(),
        "quadrants": [[name, *signs] for name, signs in QUADRANTS.items()],
        "cold_and_hot": [COLD, HOT],
        "starts": {name: _start(name) for name in kinds.start_tables()},
    }


def _row(row: Mapping[str, Any]) -> dict[str, Any]:
    """A row of the catalogue; one that the page does not start from is computed by the program alone."""
    name = row["name"]
    alone = f"computed by the program: ballscrew check {name}"
    return {**row, "refusal": row["refusal"] or ("" if name in kinds.start_tables() else alone)}


def _inputs(model: str, kind: str) -> dict[str, Any]:
    """The inputs as a run has them in their tables, of a case with such a nut: the page puts its own numbers in."""
    inputs: dict[str, Any] = document(run(kinds.case_of(kinds.PAPER, model, kind)))["inputs"]
    return inputs


def _described(quantity: Quantity) -> dict[str, str]:
    return {"meaning": quantity.info.meaning, "unit": quantity.unit}


def _values(subjects: Mapping[tuple[str, str], Configuration], model: str) -> dict[str, Any]:
    """The numbers of a model, and what it is from."""
    values: dict[str, float] = {}
    for (of, _), subject in subjects.items():
        if of == model:
            values |= {
                n: float(subject.value_of(n)) for n in inputs_of_module(subject) if subject.inputs[n][0] == "model"
            }
    references = document(run(kinds.case_of(kinds.PAPER, model, "row")))["provenance"]["references"]
    return {"values": values, "references": references}


def _fields(subjects: Mapping[tuple[str, str], Configuration]) -> dict[str, Any]:
    """The inputs of all modules by name: where they stand in a case file, their units and bounds."""
    known = {name: subject.inputs[name] for subject in subjects.values() for name in inputs_of_module(subject)} | {
        TEMPERATURE.name: ("lubricant", TEMPERATURE),
        NUT_DIAMETER: ("bodies", fields_of(Bodies)["nut_outer_diameter"]),
    }
    return {name: _field(name, part, quantity) for name, (part, quantity) in known.items()}


def _field(name: str, part: str, quantity: Quantity) -> dict[str, Any]:
    info = quantity.info
    section = "" if name.startswith(("losses.", "bodies.")) else f"{part}."
    bounds = {"above": info.above, "at_least": info.at_least, "below": info.below, "at_most": info.at_most}
    return {
        "path": f"{section}{name}",
        **_described(quantity),
        **{bound: value for bound, value in bounds.items() if value is not None},
        "whole": info.whole,
    }


def _start(name: str) -> dict[str, Any]:
    """A case to start from: its tables, its numbers, and those of each kind of nut."""
    nuts: dict[str, Any] = {}  # null stands for a diameter of the usual size
    values: dict[str, float] = {}
    for kind in kinds.KINDS:
        case = kinds.case_of(name, kinds.MODELS[0], kind)
        subject = kinds.subject_of(case)
        parts = {n: subject.inputs[n][0] for n in inputs_of_structure(subject) if n not in OPERATION}
        values |= {n: float(subject.value_of(n)) for n, part in parts.items() if part in ("screw", "lubricant")}
        values |= {n: float(getattr(case.operation, n)) for n in OPERATION}
        of_nut: dict[str, Any] = {n: float(subject.value_of(n)) for n, part in parts.items() if part == "nut"}
        if subject.nut.bodies is not None:
            of_nut[NUT_DIAMETER] = subject.nut.bodies.nut_outer_diameter
        nuts[kind] = {"values": of_nut}
    return {
        "case": start_case(name),
        "values": values,
        "nuts": nuts,
        "judged": of_start(name),
    }


def start_case(name: str) -> Mapping[str, Any]:
    """The case of a start as the page begins with it: a row with its sizes."""
    if name == kinds.PAPER:
        tables: Mapping[str, Any] = starts()[name]["case"]
        return tables
    return tomlkit.parse(case_text(catalogue()[name])).unwrap()
