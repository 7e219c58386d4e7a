"""The job of a hand-over: the recorded model with its inputs and outputs, their names, units and ranges."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.basis.records import Record
from ballscrew.basis.references import citations_of
from ballscrew.basis.version import __version__
from ballscrew.compiler.tracing.gradient import UnknownDerivativeError, partials
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Interpreter, Program
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape
from ballscrew.engine.evaluation.evaluator import Evaluator, evaluator
from ballscrew.engine.evaluation.outputs import OPERATION, Output, slope_name
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.recordings import recording

T = TypeVar("T")

#: The temperature, which is an input of every export: of an oil that is given by its numbers it changes nothing.
TEMPERATURE = "temperature"
#: What sets the preload of a nut, of which it has one.
PRELOADS = ("preload", "oversize")
#: Points at which an error is measured.
POINTS = 2000
_OF_RANGE = (
    "so where the range of the inputs starves the most; [model] inlet.replenishment_constant = 0 hands over the "
    "full bath"
)
#: Shares of the largest load and of the largest speed of the range at which starvation is looked for.
_SHARES = {OPERATION[0]: np.array([0.0, 0.1, 1.0]), OPERATION[1]: np.array([0.1, 1.0])}
#: The outputs of every export: they are finite wherever the model holds.
OUTPUTS = ("screw_torque", "drive_torque", "ideal_torque", "holding_torque", "friction_power", "valid")
#: Temperatures of a fixed oil, K.
ANY_TEMPERATURE = Quantity(TEMPERATURE, "K", Info("T", "oil temperature; without effect here", "degC", usual=(0, 1e4)))


@dataclasses.dataclass(frozen=True)
class Input:
    """An input of an export: its quantity, its usual value, and its ranges, in SI."""

    #: The name, as sweeps have it: ``preload``, ``friction.boundary_friction_coefficient``.
    name: str
    quantity: Quantity
    #: The value of the case; of load and speed zero.
    value: float
    #: The range over which the model is computed, by the bounds of the quantity.
    bounds: tuple[float, float]
    #: The range over which tables are made, parameters fitted and errors measured.
    range: tuple[float, float]


@dataclasses.dataclass(frozen=True, eq=False)
class HandOver:
    """A recorded model with named inputs and outputs in SI; :func:`~ballscrew.exports.hand_over.hand_over` makes it.

    The inputs are ``axial_load``, ``screw_speed``, ``temperature``, the preload of a nut that has one, and the
    parameters asked for.
    """

    subject: Configuration
    inputs: tuple[Input, ...]
    outputs: tuple[Output, ...]
    #: Inputs by which the outputs are derived as well.
    derivatives: tuple[str, ...]
    #: Choices of the target, complete.
    options: Mapping[str, Any]
    #: Whether the person gave ranges; if not, targets that are the model itself have its bounds.
    ranges_given: frozenset[str] = frozenset()

    @property
    def input_names(self) -> tuple[str, ...]:
        """The names of the inputs, in their order."""
        return tuple(entry.name for entry in self.inputs)

    @property
    def output_names(self) -> tuple[str, ...]:
        """The names of the outputs and of their derivatives, ``valid`` last."""
        numbers = [o.name for o in self.outputs if o.dtype is not bool]
        slopes = [slope_name(name, x) for name in numbers for x in self.derivatives]
        return (*[o.name for o in self.outputs if o.name != "valid"], *slopes, "valid")

    @functools.cached_property
    def units(self) -> Mapping[str, str]:
        """The SI unit of each input, output and derivative."""
        result = {entry.name: entry.quantity.unit for entry in self.inputs}
        result |= {o.name: "1" if o.dtype is bool else o.quantity.unit for o in self.outputs}
        for o in self.outputs:
            result |= {slope_name(o.name, x): f"({o.quantity.unit})/({result[x]})" for x in self.derivatives}
        return result

    @functools.cached_property
    def meanings(self) -> Mapping[str, str]:
        """A few words for each input, output and derivative."""
        result = {entry.name: entry.quantity.info.meaning for entry in self.inputs}
        result |= {o.name: o.quantity.info.meaning for o in self.outputs}
        result["valid"] = "1 where the model holds and no input is beyond its range, else 0"
        for o in self.outputs:
            result |= {slope_name(o.name, x): f"derivative of {o.name} by {x}" for x in self.derivatives}
        return result

    @property
    def formula_range(self) -> dict[str, tuple[float, float]]:
        """The range of a target that is the model itself: its bounds, or what was asked for."""
        return {entry.name: entry.range if entry.name in self.ranges_given else entry.bounds for entry in self.inputs}

    @property
    def working_range(self) -> dict[str, tuple[float, float]]:
        """The range of a target that is a table or a fit."""
        return {entry.name: entry.range for entry in self.inputs}

    @property
    def has_effect(self) -> Mapping[str, bool]:
        """A truth for each input, where the model has it: not the temperature of an oil given by its numbers."""
        return {name: name in self.subject.inputs for name in self.input_names}

    @functools.cached_property
    def starvation(self) -> Sequence[Record]:
        """The record of a range in which the model is starved of oil: an export has the inlet as the case gives it."""
        ranges = self.working_range
        ends: dict[str, Any] = {name: np.max(np.abs(ranges[name])) * some for name, some in _SHARES.items()}
        if self.has_effect[TEMPERATURE]:
            ends[TEMPERATURE] = np.array(ranges[TEMPERATURE])
        every = (entry.reshape(-1) for entry in np.meshgrid(*ends.values(), indexing="ij"))
        return self.subject.starvation(dict(zip(ends, every, strict=True)), _OF_RANGE)

    @functools.cached_property
    def program(self) -> Program:
        """The recorded model: inputs in their order, an output for each name. It neither clamps nor checks ranges.

        It is recorded once for all targets that the same model is handed over to. Raises
        :class:`~ballscrew.basis.errors.InputError` for a model that cannot be recorded as one list of steps.
        """

        def key() -> Any:
            return HandOver, self.subject, self.input_names, self.output_names, self.derivatives

        return recording(key, self._recorded).program

    def _recorded(self) -> Program:
        tape = Tape(len(self.inputs), None, [self._is_nonnegative(entry.name) for entry in self.inputs])
        points = {n: tape.value(i) for i, n in enumerate(self.input_names) if self.has_effect[n]}
        try:
            with self.subject.recording():
                result = self.subject.at(points)
                values = {o.name: o.read(result) for o in self.outputs}
                by = [self.input_names.index(x) for x in self.derivatives]
                for o in self.outputs:
                    if by and o.dtype is not bool:
                        slopes = partials(tape, values[o.name], by)
                        values |= {slope_name(o.name, x): s for x, s in zip(self.derivatives, slopes, strict=True)}
                return merged_program(tape, {name: values[name] for name in self.output_names})
        except CannotRecordError as error:
            remedy = "take a table (--to table), or a nut without bodies, deviations and scatter"
            raise InputError(
                Fault("hand_over.to", f"needs a model that can be recorded: {error}", "", remedy)
            ) from None
        except UnknownDerivativeError as unknown:
            raise InputError(Fault("hand_over.derivatives", f"{unknown} has no derivative here", "", "")) from None

    def _is_nonnegative(self, name: str) -> bool:
        return self.has_effect[name] and self.subject.is_nonnegative(name)

    def evaluate(self, points: Mapping[str, Any]) -> dict[str, NDArray[Any]]:
        """The model at points, by NumPy: the truth for the worst error.

        Inputs that are missing have their usual value; arrays broadcast. Beyond the bounds of the model the nearest
        value counts, and ``valid`` is False.
        """
        given = {entry.name: np.asarray(points.get(entry.name, entry.value), dtype=float) for entry in self.inputs}
        limits = self.formula_range
        inside = functools.reduce(
            np.logical_and, [(limits[n][0] <= values) & (values <= limits[n][1]) for n, values in given.items()]
        )
        clamped = {n: np.clip(values, *limits[n]) for n, values in given.items()}
        result = self._by_program(clamped, inside.shape) if self.is_recordable else self._by_solver(clamped)
        result = {n: np.array(np.broadcast_to(values, inside.shape)) for n, values in result.items()}
        result["valid"] = result["valid"].astype(bool) & inside
        return result

    @functools.cached_property
    def _made(self) -> dict[str, Any]:
        return {}

    def once(self, name: str, make: Callable[[], T]) -> T:
        """Something that targets make of it, made once."""
        if name not in self._made:
            self._made[name] = make()
        return self._made[name]

    @property
    def has_elastic_bodies(self) -> bool:
        """True where each ball is solved by itself, between elastic bodies or with deviations."""
        return self.subject.nut.one_by_one

    @functools.cached_property
    def is_recordable(self) -> bool:
        """True where the model is one list of steps: not where each ball is solved by itself, on plain arrays."""
        try:
            _ = self.program
        except InputError:
            return False
        return True

    def _by_program(self, given: Mapping[str, NDArray[Any]], shape: tuple[int, ...]) -> dict[str, NDArray[Any]]:
        program = self.program
        arrays = [np.ascontiguousarray(np.broadcast_to(values, shape)).ravel() for values in given.values()]
        masks = {i for i, step in program.steps if step.is_mask}
        result = {
            n: np.empty(arrays[0].size, dtype=bool if program.outputs.get(n) in masks else float)
            for n in self.output_names
        }
        with np.errstate(all="ignore"):
            self._interpreter.run(arrays, result)
        return {name: values.reshape(shape) for name, values in result.items()}

    @functools.cached_property
    def _interpreter(self) -> Interpreter:
        """The interpreter of the program, with buffers that go with this."""
        return self.program.interpreter.with_own_buffers()

    def _by_solver(self, given: Mapping[str, NDArray[Any]]) -> dict[str, NDArray[Any]]:
        return self._evaluator(**{n: values for n, values in given.items() if self.has_effect[n]})

    @functools.cached_property
    def _evaluator(self) -> Evaluator:
        inputs = [name for name in self.input_names if self.has_effect[name]]
        outputs = [o.name for o in self.outputs]
        subject = self.subject
        return evaluator(
            subject.model,
            subject.screw,
            subject.lubricant,
            inputs=inputs,
            outputs=outputs,
            by=self.derivatives,
            engine="numpy",
        )

    def sample(self, count: int = POINTS, seed: int = 20) -> dict[str, NDArray[np.float64]]:
        """Random points of the working range in all four quadrants, the same each time.

        Half of the loads and speeds are spread evenly, half by ratios down to a ten-thousandth of the range; some are
        zero. The first points are the corners of load and speed at the middle of all else.
        """
        random = np.random.default_rng(seed)
        result: dict[str, NDArray[np.float64]] = {}
        for entry in self.inputs:
            least, greatest = entry.range
            values = random.uniform(least, greatest, count)
            if entry.name in OPERATION:
                small = values * 10.0 ** random.uniform(-4, 0, count)
                values = np.where(random.random(count) < 0.5, np.clip(small, least, greatest), values)
                values = np.where((random.random(count) < 0.01) & (least <= 0 <= greatest), 0.0, values)
            values[:4] = 0.5 * (least + greatest)
            result[entry.name] = values
        ends = [entry.range for entry in self.inputs[:2]]
        result[OPERATION[0]][:4] = np.repeat(ends[0], 2)[:count]
        result[OPERATION[1]][:4] = np.tile(ends[1], 2)[:count]
        return result

    @functools.cached_property
    def provenance(self) -> dict[str, Any]:
        """Version, model, sources and the values of all inputs that are numbers, in SI."""
        subject = self.subject
        values = {n: subject.value_of(n) for n, (part, _) in subject.inputs.items() if part != "operation"}
        numbers = {n: v for n, v in values.items() if v is not None and np.ndim(v) == 0 and not n.startswith("nut.")}
        return {
            "version": __version__,
            "model": subject.model.label,
            "nut": type(subject.nut).__name__,
            "references": list(citations_of(subject.model)),
            "inputs": numbers,
        }


def usual_range(quantity: Quantity) -> tuple[float, float]:
    """The bounds of a quantity, and where it has none the range beyond which no ball screw is known."""
    info = quantity.info
    usual = info.usual or (-np.inf, np.inf)
    ends = (info.above, info.at_least, usual[0]), (info.below, info.at_most, usual[1])
    least, greatest = (next(float(end) for end in result if end is not None) for result in ends)
    return least, greatest
