"""The modules of the static page: those of its models and kinds of nut."""

from __future__ import annotations

import json

from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.structure_kernels import keep, name_of
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.exports.wasm_modules import (
    BALL,
    NUT_DIAMETER,
    OF_POINT,
    OUTPUTS,
    TILE,
    ByBall,
    Function,
    Module,
    OfBall,
    module_of,
    module_of_oils,
    module_of_solver,
    oils,
    outputs_of,
)
from ballscrew.faces.site import kinds

__all__ = (
    "BALL", "NUT_DIAMETER", "OF_POINT", "OUTPUTS", "TILE", "ByBall", "Function", "Module", "OfBall", "module_of",
    "module_of_oils", "module_of_solver", "module_of_structure", "oils", "outputs_of",
)  # fmt: skip


def module_of_structure(model: str, kind: str) -> Module:
    """The module of a model and a kind of nut: as it was kept on disk, or made, and kept."""
    subject = kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind))
    name = name_of("module of the static page", subject, OUTPUTS, inputs_of_structure(subject))
    found = None if name is None else kernel.kept(name)
    if found is not None:
        return Module.of(json.loads(found[0]), found[1])
    made = module_of(subject)
    if name is not None:
        keep(name, made.described, made.code)
    return made
