"""Nuts with elastic bodies: what each point has, what each ball has, and what follows from sums over the balls.

The friction under known loads of the balls is recorded, as :mod:`ballscrew.engine.evaluation.by_ball` does it; here all
numbers but the inputs of the export are constants. The loads themselves are solved where the export runs, by
``data/exports/ballscrew_loads.c``.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.compiler.tracing.grid import Split
from ballscrew.compiler.tracing.merging import Stages
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import CannotRecordError
from ballscrew.engine.evaluation.by_ball import stages_by_ball
from ballscrew.engine.evaluation.outputs import OF_LOADS, OPERATION
from ballscrew.engine.evaluation.structures import recorded_structure
from ballscrew.exports.export import refusal
from ballscrew.exports.subject import PRELOADS, HandOver
from ballscrew.physics.solvers.load_distribution import elastic_nut_numbers

#: What the solver in C finds besides the loads of the balls.
SOLVED = "residual"
_INSTEAD = "take a table (--to table)"


class ElasticNut(NamedTuple):
    """The numbers of a nut for the solver in C, in the order of its structure, in SI."""

    halves: int
    balls: int
    four_contacts: int
    swells: int
    load_deflection: float
    centre_distance: float
    contact_angle: float
    lead_cosine: float
    step: float
    spacing: float
    link: float
    first_share: float
    radial_stiffness: float

    @property
    def all_balls(self) -> int:
        """The balls of all halves."""
        return self.halves * self.balls


@dataclasses.dataclass(frozen=True)
class TwoLevels:
    """A recording of a nut with elastic bodies, in parts that run one after the other."""

    #: The inputs of the export that the programs read, as places among all; then the loads and the balls follow.
    inputs: tuple[int, ...]
    #: The place of the preload among the inputs of the export; None where the nut has none.
    preload: int | None
    nut: ElasticNut
    stages: Stages
    cut: Split

    @property
    def points(self) -> Program:
        """The program of what does not depend on the ball."""
        return self.cut.columns

    @property
    def each_ball(self) -> Program:
        """The program of what each ball has; its inputs are :attr:`tables`."""
        return self.cut.points

    @property
    def behind(self) -> Program:
        """The program of what follows from the results of the reductions, its last inputs."""
        return self.stages.behind

    @property
    def tables(self) -> list[tuple[bool, int | str]]:
        """Source of each input of a ball: True for an array over the balls, and which; or else the output at points."""
        first = len(self.inputs) + len(OF_LOADS)
        return [(True, int(name) - first) if kind == "points" else (False, name) for kind, name in self.cut.tables]

    @property
    def solved(self) -> int:
        """The place of the residual of the solver among the inputs of the programs."""
        return len(self.inputs) + OF_LOADS.index(SOLVED)


def two_levels(job: HandOver) -> TwoLevels:
    """The recording of a nut whose bodies are elastic.

    Raises :class:`~ballscrew.basis.errors.InputError` for balls or a lead that deviate, for an oversize instead of a
    preload, for inputs that change the bodies, for outputs that only Python's solver has, for derivatives, and for
    laws that cannot be recorded.
    """
    return job.once("two levels", lambda: _two_levels(job))


def _two_levels(job: HandOver) -> TwoLevels:
    subject = job.subject
    _check(job)
    names = [name for name in job.input_names if job.has_effect[name]]
    wanted = {output.name: output for output in job.outputs}
    try:
        program = recorded_structure(subject, wanted, names)
        stages, cut = stages_by_ball(program, names)
    except CannotRecordError as error:
        raise refusal("to", f"needs a model that can be recorded: {error}", "", _INSTEAD) from None
    levels = TwoLevels(
        tuple(job.input_names.index(name) for name in names),
        next((job.input_names.index(name) for name in PRELOADS if name in names), None),
        elastic_nut(job),
        stages,
        cut,
    )
    others = set(range(len(names), len(names) + len(OF_LOADS))) - {levels.solved}
    read = {
        int(o) for part in (levels.points, levels.behind) for _, s in part.steps for k, o in s.operands if k == "step"
    }
    if missing := others & (read | {*levels.behind.outputs.values()}):
        what = ", ".join(OF_LOADS[i - len(names)] for i in sorted(missing))
        raise refusal("outputs", f"need what the solver in C has not: {what}", "", _INSTEAD)
    return levels


def _check(job: HandOver) -> None:
    nut, faults = job.subject.nut, list[Fault]()
    if nut.deviations is not None or nut.bodies is None:
        problem, remedy = (
            "balls or a lead that deviate are solved in Python only",
            f"{_INSTEAD}, or leave [deviations] out",
        )
        faults.append(Fault("hand_over.to", problem, "", remedy))
    if getattr(nut, "oversize", None) is not None:
        faults.append(Fault("nut.oversize", "is not for elastic bodies here", "", "give the preload that it makes"))
    if job.derivatives:
        remedy = "leave them out, or leave [bodies] out"
        faults.append(Fault("hand_over.derivatives", "are not for elastic bodies", "", remedy))
    inputs = job.subject.inputs
    for name in job.input_names:
        of_bodies = job.has_effect[name] and inputs[name][0] in ("screw", "nut")
        if of_bodies and name not in (*OPERATION, *PRELOADS) and not name.startswith("losses."):
            remedy = "export each value by itself, or leave [bodies] out"
            faults.append(Fault("hand_over.parameters", "changes the loads of balls in elastic bodies", name, remedy))
    raise_if_any(faults)


def elastic_nut(job: HandOver) -> ElasticNut:
    """The numbers of the nut for the solver in C."""
    screw, nut = job.subject.screw, job.subject.nut
    assert nut.bodies is not None, "elastic bodies, as was checked"
    return ElasticNut(
        halves=nut.halves,
        balls=int(screw.carrying_balls),
        four_contacts=int(nut.contacts_per_ball == 4),
        swells=int(nut.bodies.swelling),
        **{name: float(value) for name, value in elastic_nut_numbers(screw, nut, nut.bodies)._asdict().items()},
    )
