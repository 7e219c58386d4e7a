"""The modules of the static page: those of its models and kinds of nut."""

from __future__ import annotations

import json
from collections.abc import Mapping

from ballscrew.basis.quantities import Info, Quantity, quantities_of
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.outputs import Output
from ballscrew.engine.evaluation.structure_kernels import name_of
from ballscrew.engine.evaluation.structures import inputs_of_structure
from ballscrew.exports.wasm_modules import (
    NUT_DIAMETER,
    OF_POINT,
    OUTPUTS,
    TILE,
    ByBall,
    Function,
    Module,
    OfBall,
    compiled,
    module_of,
    module_of_oils,
    module_of_solver,
    oils,
    outputs_shown,
)
from ballscrew.faces.site import kinds
from ballscrew.physics.components.nut import Nut
from ballscrew.physics.friction.touching import MostLoadedBall, most_loaded_ball
from ballscrew.physics.solvers.load_distribution import BallLoads

__all__ = (
    "BALL", "NUT_DIAMETER", "OF_POINT", "OUTPUTS", "TILE", "ByBall", "Function", "Module", "OfBall", "compiled",
    "module_of", "module_of_oils", "module_of_solver", "module_of_structure", "oils", "outputs_shown",
)  # fmt: skip

#: What the most loaded ball carries.
BALL = MostLoadedBall._fields
#: What a module gives besides, of which sweeps do not ask.
_BESIDE: Mapping[str, Output] = {
    "power_imbalance": Output(
        "power_imbalance",
        Quantity("power_imbalance", "1", Info("", "power of the torque beyond what is dissipated, as a share of that")),
        lambda result: result.power_imbalance,
    ),
    **{
        name: Output(
            name,
            quantities_of(BallLoads)[name],
            lambda result, n=name: getattr(most_loaded_ball(result.loads), n),
        )
        for name in BALL
    },
}


def outputs_of(nut: Nut) -> dict[str, Output]:
    """The outputs of the modules of such a nut, by name."""
    beside = {name: one for name, one in _BESIDE.items() if not (nut.is_row and name in BALL)}
    return outputs_shown(nut) | beside


def module_of_structure(model: str, kind: str) -> Module:
    """The module of a model and a kind of nut: as it was kept on disk, or made, and kept."""
    subject = kinds.subject_of(kinds.case_of(kinds.PAPER, model, kind))
    name = name_of("module of the static page", subject, (*OUTPUTS, *_BESIDE), inputs_of_structure(subject))
    found = None if name is None else kernel.kept(name)
    if found is not None:
        return Module.of(json.loads(found[0]), found[1])
    made = module_of(subject, outputs_of(subject.nut))
    if name is not None:
        kernel.keep(name, json.dumps(made.described).encode(), made.code)
    return made
