"""Nuts whose balls differ: their loads are solved on arrays, the friction under them is recorded, and compiled.

The recording has two levels: what each operating point has, and what each of its balls has, whose loads and contact
angles are inputs like any other. Sums and greatest values over the balls lead from the second to the first
(:mod:`ballscrew.compiler.tracing.merging`). The program is cut there, and its first part along points and balls:
what does not depend on the ball is evaluated once for each point, by NumPy, and what does in one loop over balls and
points.

All plain numbers of the parts are inputs, so that nothing is recorded again when one changes
(:mod:`ballscrew.engine.evaluation.structures`): they cost nothing at any ball.
"""

from __future__ import annotations

import dataclasses
import hashlib
import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import as_array
from ballscrew.compiler.kernels import kernel as kernels
from ballscrew.compiler.kernels.emission import UnknownOperationError, kernel_text, lanes_for
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array, code_of
from ballscrew.compiler.tracing.grid import Split, split
from ballscrew.compiler.tracing.merging import Reduction, Stages, cut_at_reductions, reduced, sums_of
from ballscrew.compiler.tracing.program import (
    Program,
    Source,
    as_document,
    can_be_written,
    from_document,
    required_steps,
)
from ballscrew.compiler.tracing.tape import REDUCTIONS, CannotRecordError
from ballscrew.engine.evaluation.outputs import OF_LOADS, OPERATION, ends
from ballscrew.engine.evaluation.plan import Configuration, Plan, read_input
from ballscrew.engine.evaluation.recordings import (
    ASKED_FOR,
    KNOWN,
    PAYS,
    Engine,
    Recording,
    Structures,
    why_numpy,
    worth_compiling,
)
from ballscrew.engine.evaluation.structures import (
    MOST_STEPS_OPTIMISED,
    OF_BALLS,
    groups_by_ball,
    inputs_of_structure,
    keep,
    kept,
    name_of,
    numbers_alone,
    outputs_of_structure,
    recorded_structure,
    structure_key,
)
from ballscrew.physics.friction.loaded_balls import loads_of

#: Balls at all points that have to be asked for, in one call or in several, before a recording is made; that of balls
#: with four contacts has ten times as many steps.
ENOUGH_TO_RECORD, ENOUGH_OF_FOUR_CONTACTS = 100_000, 1_000_000
#: Balls at all points of one call from which the code of a long kernel is optimised.
ENOUGH_TO_OPTIMISE = 5_000_000
#: Operating points of a kernel that are worked on at a time, ball after ball.
TILE = 128
#: Numbers of balls that are evaluated in a block: large enough for the steps of NumPy at the points, small enough
#: for the cache.
BLOCK_OF_BALLS = 2**18
_structures = Structures()


class ByBall:
    """The outputs of a plan for a nut whose balls differ, made ready by one of the engines."""

    def __init__(self, plan: Plan, cut: CutByBall, engine: Engine, reason: str) -> None:
        self.engine: Engine = engine
        self.reason = reason
        self._cut = cut
        self._of_points = cut.columns.interpreter.with_own_buffers()
        self._behind = cut.behind_of(plan.outputs).interpreter
        self._kernel = None if engine == "numpy" else cut.kernel
        self._before = None if cut.points is None else cut.points.interpreter.with_own_buffers()

    @property
    def formulas(self) -> str:
        """A digest of all formulas as they are evaluated."""
        return self._cut.formulas

    def evaluator_of(self, plan: Plan) -> Callable[..., None]:
        """The evaluator of a slice of the flattened grid, into arrays that begin at the given place; it notes ends."""

        def evaluate(part: slice, results: Mapping[str, NDArray[Any]], first: int, result: Mapping[str, Any]) -> None:
            points = plan.points(part)
            for name, noted in result.items():
                noted.append(ends(points[name]))
            here = {name: values[part.start - first : part.stop - first] for name, values in results.items()}
            self.evaluate(plan.subject, plan.fixed | points, here)

        return evaluate

    def evaluate(self, subject: Configuration, points: Mapping[str, Any], results: Mapping[str, NDArray[Any]]) -> None:
        """Evaluate at points into arrays of results. Raises what the solver of the loads raises."""
        count = len(next(iter(results.values())))
        if count == 1:  # two, so that sums have the same order as among others
            twice = {name: np.repeat(values, 2) if np.ndim(values) else values for name, values in points.items()}
            result = {name: np.repeat(held, 2) for name, held in results.items()}
            self.evaluate(subject, twice, result)
            for name, held in results.items():
                held[...] = result[name][:1]
            return
        changed = subject.changed({name: values for name, values in points.items() if name not in OPERATION})
        with np.errstate(all="ignore"):
            loads = loads_of(changed.screw, as_array(points[OPERATION[0]]), compiled=self.engine == "compiled")
            known, parts = changed.inputs, changed.by_section
            of_points = [points[n] if n in OPERATION else read_input(parts[known[n][0]], n) for n in self._cut.names]
            # the load that lifts off is a search
            unread = {"lift_off_load": np.full(count, np.nan)} if "lift_off_load" not in results else {}
            of_points += [unread[name] if name in unread else getattr(loads, name) for name in OF_LOADS]
            of_balls = [_balls_first(getattr(loads, name), count) for name in OF_BALLS]
            tables = self._tables(of_points, count)
            inputs = [
                tables[name] if source == "columns" else of_balls[int(name) - len(of_points)]
                for source, name in self._cut.tables
            ]
            values, done = self._over_balls(inputs, len(of_balls[0]), count)
            result = reduced(self._cut.reductions, values, done)
            self._behind.run([*of_points, *([None] * len(OF_BALLS)), *result], results)

    def _tables(self, of_points: Sequence[Any], count: int) -> dict[str, NDArray[np.float64]]:
        """Values that do not depend on the ball, for each point."""
        program = self._cut.columns
        masks = {i for i, step in program.steps if step.is_mask}
        result = {n: np.empty(count, dtype=bool if i in masks else float) for n, i in program.outputs.items()}
        if result:
            self._of_points.run([*of_points, *([None] * len(OF_BALLS))], result)
        return {name: values.astype(float, copy=False) for name, values in result.items()}

    def _over_balls(
        self, inputs: Sequence[NDArray[np.float64]], balls: int, count: int
    ) -> tuple[dict[str, NDArray[Any]], dict[str, NDArray[Any]]]:
        """Values of each ball, by name, and what is reduced already."""
        sums = self._cut.sums
        names = self._cut.outputs
        if self._kernel is not None:
            result = {n: aligned_array(count + self._cut.lanes if n in sums else balls * count, float) for n in names}
            self._kernel(
                slice(0, balls), slice(0, count), count, inputs, list(result.values()), past_cache=False, tile=TILE
            )
            values = {name: held.reshape(balls, count) for name, held in result.items() if name not in sums}
            return values, {name: held[:count] for name, held in result.items() if name in sums}
        assert self._before is not None, "a kernel, or NumPy"
        result = {name: np.empty(balls * count) for name in names}
        whole = [values.reshape(-1) if values.ndim > 1 else np.tile(values, balls) for values in inputs]
        if names:
            self._before.run(whole, result)
        return {name: held.reshape(balls, count) for name, held in result.items()}, {}


def by_ball(
    plan: Plan,
    engine: Engine | None,
    times: int = 1,
    varying: Sequence[str] | None = None,
    *,
    always: bool = False,
    shared: bool = False,
) -> ByBall | str:
    """A plan for a nut whose balls differ, made ready; or the reason why the model itself has to evaluate it.

    ``varying`` names the inputs that vary where it is not the axes of the plan. Without an ``engine`` little work is
    left to the model itself until so much of its kind has been asked for that a recording pays. With ``always`` it is
    recorded however little it is, and neither what is compiled nor what was asked for before counts. A kernel that an
    earlier process has kept is taken for an ``engine`` that was asked for, or where it may be ``shared``.
    """
    names = inputs_of_structure(plan.subject, [*plan.axes, *(varying or ())])
    wanted = outputs_of_structure(plan.subject, plan.outputs)
    work = plan.total * times * plan.subject.balls
    why = "the model itself, on plain arrays: the work is too short to record it"
    key = structure_key(plan.subject, tuple(wanted), names)
    kept_as = {} if key is None or engine == "numpy" else _names(plan.subject, tuple(wanted), names)
    cut = _kept_of(kept_as, work) if engine or shared else None
    if cut is not None:
        return ByBall(plan, cut, "compiled", ASKED_FOR if engine else KNOWN)
    made_of = None if key is None else _structures.get(key)
    asked = work if key is None else _structures.asked(key, work)
    enough = ENOUGH_TO_RECORD if plan.subject.nut.contacts_per_ball == 2 else ENOUGH_OF_FOUR_CONTACTS
    if made_of is None and engine is None and not always and asked < enough:
        return why
    try:
        if made_of is None:
            subject = plan.subject if key is None else numbers_alone(plan.subject)
            program = recorded_structure(subject, wanted, names)
            made_of = Recording(program) if key is None else _structures.add(key, program)
        is_quick = len(made_of.program.steps) > MOST_STEPS_OPTIMISED and work < ENOUGH_TO_OPTIMISE
        how = kept_as.get(is_quick), 0 if is_quick else None
        return _by_an_engine(plan, engine, names, made_of, work if always else asked, how, anew=always)
    except CannotRecordError as error:
        return f"the model itself, on plain arrays: {error}"


def _names(subject: Configuration, outputs: tuple[str, ...], names: Sequence[str]) -> dict[bool, str]:
    """The names under which kernels are kept, by whether they were compiled quickly."""
    values = {quick: name_of(f"by ball, {quick}", subject, outputs, names) for quick in (False, True)}
    return {quick: name for quick, name in values.items() if name is not None}


def _kept_of(kept_as: Mapping[bool, str], work: int) -> CutByBall | None:
    """Kept cut, the optimised one first; one that was compiled quickly is not for long work."""
    for quick, name in kept_as.items():
        cut: CutByBall | None = kept.get(name, _read)
        if cut is not None and (not quick or work < ENOUGH_TO_OPTIMISE):
            return cut
    return None


def _by_an_engine(
    plan: Plan,
    engine: Engine | None,
    names: tuple[str, ...],
    made_of: Recording,
    asked: int,
    how: tuple[str | None, int | None],
    *,
    anew: bool,
) -> ByBall | str:
    stages, cut = made_of.once("stages", lambda: stages_by_ball(made_of.program, names))
    why = why_numpy(engine)
    try:
        if engine != "numpy" and kernels.available():
            text = _text(made_of, stages, cut)
            if engine or worth_compiling(cut.points, asked, text, anew=anew):
                result = _compiled(CutByBall.of(stages, cut, names, f"{text}\n{made_of.program.text}"), text, *how)
                return ByBall(plan, result, "compiled", ASKED_FOR if engine else PAYS)
    except UnknownOperationError as unknown:
        why = f"{unknown} is not known to kernels"
        if engine == "compiled":
            return why
    result = made_of.once("by NumPy", lambda: CutByBall.of(stages, cut, names, made_of.program.text, cut.points))
    return ByBall(plan, result, "numpy", why)


def _compiled(cut: CutByBall, text: str, kept_as: str | None, optimisation: int | None) -> CutByBall:
    """The same with its kernel, which is kept under a name where there is one."""
    if kept_as is None:
        return cut.with_kernel(Kernel.of(text, cut.sources))
    with kept.making:
        cut_by_ball = kept.get(kept_as, _read)
        if cut_by_ball is None:
            machine_code = code_of(text, optimisation)
            if cut.can_be_written:
                keep(kept_as, cut.header, machine_code)
            cut_by_ball = kept.add(kept_as, cut.with_kernel(Kernel(machine_code, cut.sources)))
        return cut_by_ball


def _read(header: bytes, machine_code: bytes) -> CutByBall:
    cut = CutByBall.from_header(json.loads(header))
    return cut.with_kernel(Kernel(machine_code, cut.sources))


@dataclasses.dataclass(frozen=True, eq=False)
class CutByBall:
    """A recording by ball as it is evaluated: what each point has, what each of its balls has, and what is behind."""

    names: tuple[str, ...]
    columns: Program
    #: The inputs of what each ball has, and its outputs, some of them reduced over the balls.
    tables: tuple[tuple[Source, str], ...]
    outputs: tuple[str, ...]
    reductions: tuple[Reduction, ...]
    behind: Program
    #: Points of a vector.
    lanes: int
    #: A digest of all formulas as they are evaluated.
    formulas: str
    #: What each ball has, for NumPy, or as a kernel.
    points: Program | None = None
    kernel: Kernel | None = None
    _behind: dict[tuple[str, ...], Program] = dataclasses.field(default_factory=dict[tuple[str, ...], Program])

    @classmethod
    def of(
        cls, stages: Stages, cut: Split, names: tuple[str, ...], formulas: str, points: Program | None = None
    ) -> CutByBall:
        """Build it from a recording that was cut; ``points`` for NumPy."""
        digest = hashlib.sha256(formulas.encode()).hexdigest()
        outputs = tuple(cut.points.outputs)
        return cls(
            names,
            cut.columns,
            cut.tables,
            outputs,
            stages.reductions,
            stages.behind,
            _lanes(cut.points),
            digest,
            points,
        )

    def with_kernel(self, kernel: Kernel) -> CutByBall:
        """The same with the kernel of what each ball has."""
        return dataclasses.replace(self, kernel=kernel)

    @property
    def sources(self) -> list[Source]:
        """Sources of the inputs of what each ball has."""
        return [source for source, _ in self.tables]

    @property
    def sums(self) -> dict[str, Any]:
        """The outputs of each ball of which only the sum or the greatest value is needed, and which."""
        return sums_of(self.reductions)

    def behind_of(self, outputs: tuple[str, ...]) -> Program:
        """Program behind the reductions, for some of the outputs."""
        if outputs not in self._behind:
            self._behind[outputs] = _of(self.behind, outputs)
        return self._behind[outputs]

    @property
    def can_be_written(self) -> bool:
        """True where all steps are functions that are known by their names."""
        return all(can_be_written(program) for program in (self.columns, self.behind))

    @property
    def header(self) -> dict[str, Any]:
        """All but the kernel, as JSON knows it."""
        return {
            "names": self.names,
            "columns": as_document(self.columns),
            "tables": self.tables,
            "outputs": self.outputs,
            "reductions": [(one.function.__name__, one.values, one.place) for one in self.reductions],
            "behind": as_document(self.behind),
            "lanes": self.lanes,
            "formulas": self.formulas,
        }

    @classmethod
    def from_header(cls, held: Mapping[str, Any]) -> CutByBall:
        """The reverse of :attr:`header`."""
        functions = {function.__name__: function for function in REDUCTIONS}
        return cls(
            tuple(held["names"]),
            from_document(held["columns"]),
            tuple((source, name) for source, name in held["tables"]),
            tuple(held["outputs"]),
            tuple(Reduction(functions[name], values, place) for name, values, place in held["reductions"]),
            from_document(held["behind"]),
            held["lanes"],
            held["formulas"],
        )


def stages_by_ball(program: Program, names: Sequence[str]) -> tuple[Stages, Split]:
    """Such a program cut at its reductions, and its first part cut along points and balls."""
    groups = groups_by_ball(names)
    stages = cut_at_reductions(program, groups)
    return stages, split(stages.before, groups)


def _of(program: Program, outputs: Sequence[str]) -> Program:
    """Some of the outputs of a program."""
    values = {name: program.outputs[name] for name in outputs if name in program.outputs}
    constants = {name: program.constants[name] for name in outputs if name in program.constants}
    steps = required_steps(dict(program.steps), values.values())
    return dataclasses.replace(program, steps=steps, outputs=values, constants=constants)


def _text(made_of: Recording, stages: Stages, cut: Split) -> str:
    """The assembly of what each ball has."""
    sources: list[Source] = [source for source, _ in cut.tables]
    masks = dict.fromkeys(cut.points.outputs, False)
    return made_of.once(
        "text", lambda: kernel_text(cut.points, sources, masks, lanes=_lanes(cut.points), reduced=stages.sums)
    )


def _lanes(program: Program) -> int:
    """The number of points in a vector: most inputs are tables of a tile, which stay in the cache."""
    return lanes_for(dataclasses.replace(program, inputs=len(OF_BALLS)))


def _balls_first(values: NDArray[np.float64], count: int) -> NDArray[np.float64]:
    """Values of the balls at each point, or the same at all of them, with the ball axis first."""
    first = np.moveaxis(values, -1, 0)
    return np.ascontiguousarray(np.broadcast_to(first[:, None] if first.ndim == 1 else first, (len(first), count)))
