"""The modules of the page without a server: those of its models and kinds of nut."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence

from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import inputs_of_structure, keep, name_of
from ballscrew.engine.uncertainty.uncertain_value import default_uncertainties
from ballscrew.exports.wasm_modules import OUTPUTS, KeptModule, kept_module, module_of
from ballscrew.faces.page import kinds
from ballscrew.questions.band.compute import of_makers

#: What is asked of a calibrated model, besides the conditions of validity.
_OF_CALIBRATED = ("screw_torque",)


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
    return _module_of(kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind)), OUTPUTS)


def module_of_calibrated(model: str, kind: str) -> KeptModule | None:
    """The module of the same as makers' torques ask for it, which a band draws beside it; None where none are drawn."""
    case = kinds.case_of(kinds.PAPER, model, kind)
    drawn = of_makers(case)
    if not drawn:
        return None
    # they differ by the force between the balls alone, which is an input
    return _module_of(dataclasses.replace(kinds.subject_of(case), model=drawn[0].model), _OF_CALIBRATED)


def _module_of(subject: Configuration, outputs: Sequence[str]) -> KeptModule:
    name = name_of("module of the static page", subject, outputs, inputs_of_module(subject))
    module = None if name is None else kept_module(name)
    if module is not None:
        return module
    made = KeptModule.of(module_of(subject, outputs, varying_of(subject)))
    if name is not None:
        keep(name, made.document, made.code)
    return made
