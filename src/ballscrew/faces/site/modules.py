"""The modules of the static page: those of its models and kinds of nut."""

from __future__ import annotations

from ballscrew.exports.wasm_modules import (
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
)
from ballscrew.faces.site import kinds

__all__ = (
    "NUT_DIAMETER", "OF_POINT", "OUTPUTS", "TILE", "ByBall", "Function", "Module", "OfBall", "module_of",
    "module_of_oils", "module_of_solver", "module_of_structure", "oils",
)  # fmt: skip


def module_of_structure(model: str, kind: str) -> Module:
    """The module of a model and a kind of nut."""
    return module_of(kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind)))
