"""The friction of a ball screw as a table over its inputs, with straight lines between its values."""

from __future__ import annotations

import dataclasses
import functools
import itertools
import logging
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RegularGridInterpolator

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.records import Record
from ballscrew.engine.evaluation.evaluator import evaluator
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import (
    Export,
    Option,
    Values,
    WorstError,
    refusal,
    table_lines,
    table_readme,
    warning,
    worst_errors,
)
from ballscrew.exports.subject import POINTS, HandOver
from ballscrew.physics.friction import directions

Floats = NDArray[np.float64]
_log = logging.getLogger(__name__)

#: Choices of every target that is a table.
OPTIONS: Mapping[str, Option] = {
    "tolerance": Option(0.01, "error of the friction that a table may have, as a share of the friction: 0.01"),
}
#: Friction below this share of the largest, or beyond the validity of the model, counts with this share of the largest.
LEAST_SHARE = 0.05
#: The numbers that straight lines interpolate; all else is made of them.
INTERPOLATED = ("screw_torque", "ideal_torque")
#: What jumps at rest, and is not interpolated.
DRIVE = "drive_torque"
#: What is made of the others.
_MADE_OF_OTHERS = ("holding_torque", "friction_power")
#: Positions among which nodes are chosen: a ladder up from this share of the largest, and even steps.
_LEAST_LOAD, _LEAST_SPEED = 1e-5, 1e-8
_LADDER, _EVEN_STEPS, _OTHER_STEPS = 60, 61, 17
#: Values of the other axes at which the nodes of an axis are chosen, by the number of axes.
_PROBES: Mapping[int, int] = {2: 9, 3: 5, 4: 5}
_FEWEST_PROBES = 3
_CHECKED_POINTS = 4000
#: Points at which the error of a nut is measured whose balls are solved one by one.
_SLOW_POINTS = 200
_TRIES = 4
#: Nodes of a table at most: more would be no table that people read.
MOST_NODES = 200_000
#: A finer table is worth its size where it brings the error down to this share.
_WORTH = 0.7


@dataclasses.dataclass(frozen=True, eq=False)
class FrictionTable:
    """Friction over a grid of load, speed and perhaps other inputs, in SI. Everything is finite.

    Between the nodes ``screw_torque`` and ``ideal_torque`` are read along straight lines. The torque on the shaft is
    not: it jumps at rest, and is made of the two as ``ideal_torque + sign(screw_speed) · screw_torque``.
    """

    #: The nodes of each axis.
    axes: Mapping[str, Floats]
    #: Values at the nodes: those interpolated, ``drive_torque``, and further outputs asked for.
    values: Mapping[str, Floats]
    valid: NDArray[np.bool_]
    #: The values of the inputs that are no axes.
    fixed: Mapping[str, float]
    #: Error of the friction between the nodes as a share of it, or of a twentieth of the largest where it is smaller.
    error: float

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of nodes of each axis."""
        return self.valid.shape

    @property
    def valid_range(self) -> dict[str, tuple[float, float]]:
        """The ends of the axes, and the value of each other input twice."""
        ends = {name: (float(nodes[0]), float(nodes[-1])) for name, nodes in self.axes.items()}
        return {**ends, **{name: (value, value) for name, value in self.fixed.items()}}

    @property
    def torque_of_load(self) -> float:
        """Torque without friction over the load: every law of it is a straight line through zero."""
        load, ideal = self.axes[OPERATION[0]], self.values[INTERPOLATED[1]][:, 0]
        end = 0 if abs(load[0]) > abs(load[-1]) else -1
        return float(ideal[end] / load[end])

    def at(self, points: Values) -> dict[str, NDArray[Any]]:
        """Outputs at points as a program computes them with the table: the friction, and the torques made of it.

        Beyond the axes the nearest value counts. A point is valid where all nodes around it are.
        """
        where = np.column_stack([np.clip(points[name], nodes[0], nodes[-1]) for name, nodes in self.axes.items()])
        outputs = {name: interpolated(self.axes, self.values[name], where) for name in self.values if name != DRIVE}
        friction, ideal = (outputs[name] for name in INTERPOLATED)
        outputs[DRIVE] = ideal + np.sign(points[OPERATION[1]]) * friction
        outputs["holding_torque"] = directions.holding_torque(ideal, friction)
        inside = [(nodes[0] <= points[name]) & (points[name] <= nodes[-1]) for name, nodes in self.axes.items()]
        surrounded = interpolated(self.axes, self.valid.astype(float), where) > 1 - 1e-9
        return {**outputs, "valid": np.logical_and.reduce([surrounded, *inside])}

    def worst_errors(self, job: HandOver) -> tuple[WorstError, ...]:
        """The worst error of each output against the model, over points of the range."""
        count = POINTS if job.is_recordable else _SLOW_POINTS
        points = job.sample(count)
        points |= {name: np.full(count, value) for name, value in self.fixed.items()}
        names = [name for name in (*self.values, "holding_torque", "valid") if name in job.output_names]
        return worst_errors(job, self.at, points=points, outputs=names)

    def warnings(self, job: HandOver) -> list[Record]:
        """A warning where the table is coarser than was asked for."""
        tolerance = job.options["tolerance"]
        if self.error <= tolerance:
            return []
        text = (
            f"the friction between the nodes is off by up to {units.to_significant(100 * self.error, 2)} %, not "
            f"{units.to_significant(100 * tolerance, 2)} %; a smaller range makes it finer: --range "
            'axial_load="-5:5 kN"'
        )
        return [warning("tolerance", INTERPOLATED[0], text, value=self.error, limit=tolerance)]


@dataclasses.dataclass(frozen=True, eq=False)
class TableJob:
    """A job of which a table is made, with the worst error of it."""

    job: HandOver
    table: FrictionTable
    errors: tuple[WorstError, ...]

    @classmethod
    def of(cls, job: HandOver, of_load_and_speed: str = "") -> TableJob:
        """The table of a job; where a name of what takes it is given, it can only be over load and speed.

        Raises :class:`~ballscrew.basis.errors.InputError` as :func:`friction_table` does, and for another axis there.
        """
        table = friction_table(job)
        others = [name for name in table.axes if name not in OPERATION]
        if of_load_and_speed and others:
            remedy = "leave its range out, and the value of the case counts"
            raise refusal(f"ranges.{others[0]}", f"cannot be an axis of {of_load_and_speed}", "", remedy)
        return cls(job, table, table.worst_errors(job))

    @functools.cached_property
    def about(self) -> list[str]:
        """Lines for the head of a file."""
        return table_lines(self.job, self.table.valid_range, self.errors)

    def export(
        self, target: str, files: Mapping[str, str | bytes], of_files: str, warnings: Sequence[Record] = ()
    ) -> Export:
        """The export of a target with these files and a README, which begins with what the files are."""
        return Export.of(
            self.job,
            target,
            {**files, "README.txt": table_readme(self.job, self.about, of_files)},
            self.errors,
            valid_range=self.table.valid_range,
            measured_range=self.table.valid_range,
            warnings=[*self.table.warnings(self.job), *warnings],
        )


def friction_table(job: HandOver) -> FrictionTable:
    """The friction over a grid that is fine enough for the option ``tolerance``.

    Axes are load and speed, and each other input whose range was asked for. Zero load and rest are nodes where the
    ranges have them. The nodes are not even: friction is steep near rest and, without preload, near zero load. The
    error is measured against the model at points drawn anew between the nodes, and is what it is: a tolerance that
    cannot be met is no fault.

    Raises :class:`~ballscrew.basis.errors.InputError` where the friction, or an output asked for, is no finite number.
    """
    tolerance = float(job.options["tolerance"])
    if not 1e-4 <= tolerance < 1:
        raise refusal("tolerance", "must be from 0.0001 to below 1", f"{tolerance:g}", "give 0.01")
    chosen = {n: ends for n, ends in job.working_range.items() if n in OPERATION or n in job.ranges_given}
    ranges = {name: ends for name, ends in chosen.items() if job.has_effect[name]}
    fixed = {entry.name: entry.value for entry in job.inputs if entry.name not in ranges}
    evaluate = model_over(job, list(ranges), fixed)
    candidates = {name: _candidates(name, *ends) for name, ends in ranges.items()}
    chords = {name: chord_errors(values, *_along(evaluate, name, candidates)) for name, values in candidates.items()}
    allowed, best = tolerance / len(ranges), None
    for _ in range(_TRIES):  # errors of axes add up to less than their sum, at points that were looked at
        axes = {name: values[_nodes(name, values, chords[name], allowed)] for name, values in candidates.items()}
        size = math.prod(len(values) for values in axes.values())
        if size > MOST_NODES:
            if best is None:
                raise _too_many(size)
            break
        made = _table_over(axes, evaluate, fixed)
        if best is not None and made.error > _WORTH * best.error:
            break
        best = made
        if made.error <= tolerance:
            break
        allowed *= _WORTH * tolerance / made.error
    assert best is not None
    return best


def _table_over(axes: Mapping[str, Floats], evaluate: _Evaluate, fixed: Mapping[str, float]) -> FrictionTable:
    """The friction at the nodes of axes, with its error between them."""
    values = evaluate(*np.meshgrid(*axes.values(), indexing="ij"))
    valid = values.pop("valid")
    for name, array in values.items():
        _check_finite(name, axes, array)
    error = _measured(evaluate, axes, values[INTERPOLATED[0]])
    _log.info("a table of %s nodes is off by up to %.2g of the friction", valid.shape, error)
    return FrictionTable(axes, values, valid, fixed, error)


def _too_many(size: int) -> InputError:
    problem = f"needs a table of {units.grouped(size)} nodes, more than {units.grouped(MOST_NODES)}"
    remedy = "give a larger tolerance (--option tolerance=0.05), fewer axes or smaller ranges"
    return refusal("tolerance", problem, "", remedy)


def interpolated(axes: Mapping[str, Floats], values: Floats, points: Floats) -> Floats:
    """Values along straight lines between the nodes of axes, at points (one a row) within them."""
    return RegularGridInterpolator(tuple(axes.values()), values)(points)


_Evaluate = Callable[..., dict[str, Any]]


def model_over(job: HandOver, axes: Sequence[str], fixed: Mapping[str, float]) -> _Evaluate:
    """The model as a function of the axes: as it was recorded, or, with balls solved one by one, compiled."""
    wanted = [entry.name for entry in job.outputs if entry.name not in _MADE_OF_OTHERS]
    if job.is_recordable:

        def evaluate(*values: Any) -> dict[str, Any]:
            outputs = job.evaluate({**fixed, **dict(zip(axes, values, strict=True))})
            return {name: outputs[name] for name in wanted}

        return evaluate
    subject = job.subject
    held: dict[str, Any] = {name: value for name, value in fixed.items() if job.has_effect[name]}
    return evaluator(subject.model, subject.screw, subject.lubricant, inputs=axes, outputs=wanted, **held)


def speed_candidates(slowest: float, fastest: float) -> Floats:
    """Positive speeds among which nodes are chosen: a ladder, and even steps."""
    even = np.linspace(0.0, fastest, _EVEN_STEPS)
    return np.unique(np.concatenate([np.geomspace(slowest, fastest, 2 * _LADDER), even[even > slowest]]))


def _candidates(name: str, low: float, high: float) -> Floats:
    """Positions among which the nodes of an axis are chosen, zero among them where it is in the range."""
    if name not in OPERATION:
        return np.linspace(low, high, _OTHER_STEPS)
    largest = max(abs(low), abs(high))
    ladder = np.geomspace(_LEAST_LOAD if name == OPERATION[0] else _LEAST_SPEED, 1, _LADDER) * largest
    even = np.linspace(-largest, largest, _EVEN_STEPS)
    positions = np.unique(np.concatenate([-ladder, [0.0, low, high], even[np.abs(even) > ladder[0]], ladder]))
    return positions[(positions >= low) & (positions <= high)]


def _along(evaluate: _Evaluate, name: str, candidates: Mapping[str, Floats]) -> tuple[Floats, Floats]:
    """The friction at all candidates of an axis, for a few values of each other axis, and its scale; the axis first."""
    count = _PROBES.get(len(candidates), _FEWEST_PROBES)
    grid = {n: values if n == name else _probes(values, count) for n, values in candidates.items()}
    outputs = evaluate(*np.meshgrid(*grid.values(), indexing="ij"))
    friction = outputs[INTERPOLATED[0]]
    _check_finite(INTERPOLATED[0], grid, friction)
    place = list(candidates).index(name)
    return np.moveaxis(friction, place, 0), np.moveaxis(_scale(friction, outputs["valid"]), place, 0)


def _scale(friction: Floats, valid: NDArray[np.bool_]) -> Floats:
    """The size that an error is a share of."""
    largest = float(np.abs(friction).max())
    return np.where(valid, np.maximum(np.abs(friction), LEAST_SHARE * largest), largest)


def _probes(values: Floats, count: int) -> Floats:
    return values[np.unique(np.linspace(0, len(values) - 1, count).round().astype(int))]


def _nodes(name: str, positions: Floats, chords: Floats, tolerance: float) -> list[int]:
    kept = np.nonzero(positions == 0)[0].tolist() if name in OPERATION else []
    return nodes_within(chords, tolerance, kept)


def _measured(evaluate: _Evaluate, axes: Mapping[str, Floats], friction: Floats) -> float:
    """The worst error at points drawn within cells of the grid, each cell as likely as any other."""
    random = np.random.default_rng(20250101)
    columns: list[Floats] = []
    for values in axes.values():
        cells = random.integers(0, len(values) - 1, _CHECKED_POINTS)
        columns.append(values[cells] + random.random(_CHECKED_POINTS) * (values[cells + 1] - values[cells]))
    exact = evaluate(*columns)
    between = interpolated(axes, friction, np.column_stack(columns))
    return float(np.max(np.abs(between - exact[INTERPOLATED[0]]) / _scale(exact[INTERPOLATED[0]], exact["valid"])))


def _check_finite(output: str, axes: Mapping[str, Floats], values: Floats) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` with the first point at which a value is none."""
    bad = np.argwhere(~np.isfinite(values))
    if len(bad):
        where = ", ".join(f"{name} = {axes[name][i]:.4g}" for name, i in zip(axes, bad[0], strict=True))
        problem = f"{output} is no finite number at {len(bad)} nodes, the first {where} (SI)"
        remedy = 'leave this output out, or give a smaller range: --range axial_load="1:5 kN"'
        raise refusal("to", problem, "", remedy)


def chord_errors(positions: Floats, values: Floats, scale: Floats) -> Floats:
    """The worst error of a straight line from each position to each later one; 0 between neighbours.

    ``values`` has the axis first; the worst of its columns counts. Errors are shares of the ``scale`` of each value.
    """
    columns, scales = values.reshape(len(positions), -1), scale.reshape(len(positions), -1)
    errors = np.zeros((len(positions), len(positions)))
    for first, last in itertools.combinations(range(len(positions)), 2):
        if last - first > 1:
            between = slice(first + 1, last)
            share = (positions[between] - positions[first]) / (positions[last] - positions[first])
            line = columns[first] + share[:, None] * (columns[last] - columns[first])
            errors[first, last] = (np.abs(line - columns[between]) / scales[between]).max()
    return errors


def nodes_within(chords: Floats, tolerance: float, kept: Sequence[int] = ()) -> list[int]:
    """Indices of the fewest nodes between which straight lines stay within a tolerance of all values.

    The ends are nodes, and so are ``kept``. Nodes are chosen among the positions of the :func:`chord_errors`: lines
    are as good as these are dense.
    """
    return _walk(chords, tolerance, _ends(len(chords), kept))


def best_nodes(chords: Floats, count: int) -> list[int]:
    """Indices of at most ``count`` nodes with the least worst error of straight lines between them.

    The ends are nodes: ``count`` is at least two.
    """
    ends = _ends(len(chords), ())
    tolerances = np.unique(chords[np.triu_indices(len(chords), 1)])
    low, high = 0, len(tolerances) - 1
    while low < high:  # the least tolerance that is met
        middle = (low + high) // 2
        if len(_walk(chords, float(tolerances[middle]), ends)) <= count:
            high = middle
        else:
            low = middle + 1
    return _walk(chords, float(tolerances[low]), ends)


def _ends(size: int, kept: Sequence[int]) -> list[int]:
    return sorted({0, size - 1, *kept})


def _walk(chords: Floats, tolerance: float, ends: Sequence[int]) -> list[int]:
    """Nodes, each the farthest that a straight line from the one before reaches within the tolerance."""
    nodes = [ends[0]]
    for end in ends[1:]:
        while nodes[-1] < end:
            here = nodes[-1]
            reached = np.nonzero(chords[here, here + 1 : end + 1] <= tolerance)[0]
            nodes.append(here + 1 + int(reached[-1]))
    return nodes
