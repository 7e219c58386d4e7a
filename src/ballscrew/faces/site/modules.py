"""The modules of the static page: those of its models and kinds of nut."""

from __future__ import annotations

from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structure_kernels import keep, name_of
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.engine.uncertainty.default_uncertainties import default_uncertainties
from ballscrew.exports.wasm_modules import OUTPUTS, KeptModule, kept_module, module_of
from ballscrew.faces.site import kinds


def varying_of(subject: Configuration) -> tuple[str, ...]:
    """The exponents that are inputs as well, as a band draws them: the others are constants of a module."""
    known = inputs_of_structure(subject)
    return tuple(
        name
        for name in default_uncertainties()
        if name.endswith("exponent") and name in subject.inputs and name not in known
    )


def inputs_of_module(subject: Configuration) -> tuple[str, ...]:
    """The names of all inputs of the module of a structure."""
    return inputs_of_structure(subject, varying_of(subject))


def module_of_structure(model: str, kind: str) -> KeptModule:
    """The module of a model and a kind of nut: as it was kept on disk, or made, and kept."""
    subject = kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind))
    name = name_of("module of the static page", subject, OUTPUTS, inputs_of_module(subject))
    found = None if name is None else kept_module(name)
    if found is not None:
        return found
    made = KeptModule.of(module_of(subject, varying=varying_of(subject)))
    if name is not None:
        keep(name, made.document, made.code)
    return made
