"""Exact derivatives: how an output answers to each input and coefficient, at every point of a sweep."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.arrays import blocks
from ballscrew.basis.errors import MISSING, Fault, InputError, nearest, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.compiler.tracing.gradient import UnknownDerivativeError, partials
from ballscrew.compiler.tracing.merging import merged_program
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import CannotRecordError
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import OPERATION, Output, known_outputs, slope_name
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.evaluation.recordings import Engine, engine_faults
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel

Field = NDArray[np.float64]

#: Up to so many points the operations run one by one: a few seconds for the reference model, half a minute to compile.
UNCOMPILED = 8192
#: Points of a compiled block. The way back needs what the way forth has computed: 26 kB a point in the reference model.
BLOCK = 4096
#: Without this, the compiler for processors works out again, in each of its loops, what several of them need:
#: for the reference model it takes more than eight minutes in place of half a one.
FOR_PROCESSORS = {"xla_disable_hlo_passes": "fusion"}


def jax_value_and_partials(
    outputs_of: Callable[[Mapping[str, Any]], Mapping[str, Any]],
    points: Mapping[str, Field],
    outputs: Sequence[str],
    by: Sequence[str],
) -> tuple[dict[str, Field], dict[tuple[str, str], Field]]:
    """Outputs and their partial derivatives at points, in double precision.

    ``outputs_of`` maps the named inputs to the outputs, elementwise; ``points`` has the inputs as
    arrays of one length. The derivatives come as ``(output, input)``. Many points are compiled once and go block
    by block; few are not worth compiling. Values differ from NumPy's by rounding. Runs where JAX runs,
    on a graphics processor if it has one; JAX is switched to double precision for this call alone.

    Raises :class:`~ballscrew.basis.errors.InputError` without JAX.
    """
    try:
        import jax
    except ImportError:
        fault = Fault("derivatives.method", "needs JAX", "jax", 'pip install "ballscrew[jax]"')
        raise InputError(fault) from None
    size = len(next(iter(points.values())))
    values = {output: np.empty(size) for output in outputs}
    partials = {(output, name): np.empty(size) for output in outputs for name in by}
    compiled, block_size = (True, BLOCK) if size > UNCOMPILED else (False, max(size, 1))
    with jax.enable_x64(True):
        options = FOR_PROCESSORS if jax.default_backend() == "cpu" else None
        # each output for itself: what several have in common takes longer to find than to compute again
        for output in outputs:
            evaluate = functools.partial(_value_and_slopes, outputs_of, output, by)
            evaluate = jax.jit(evaluate, compiler_options=options) if compiled else evaluate
            for block in blocks(size, block_size):
                count = block.stop - block.start
                # the last block is filled up, as another shape would be compiled again
                filled = {n: np.pad(v[block], (0, block_size - count), mode="edge") for n, v in points.items()}
                value, slopes = evaluate({name: jax.numpy.asarray(numbers) for name, numbers in filled.items()})
                values[output][block] = np.asarray(value)[:count]
                for name in by:
                    partials[output, name][block] = np.asarray(slopes[name])[:count]
    return values, partials


def _value_and_slopes(
    outputs_of: Callable[[Mapping[str, Any]], Mapping[str, Any]],
    output: str,
    by: Sequence[str],
    inputs: Mapping[str, Any],
) -> tuple[Any, Mapping[str, Any]]:
    """One output at all points, and its slopes by the inputs asked for."""
    import jax

    shape = next(iter(inputs.values())).shape

    def along(moved: Mapping[str, Any]) -> Any:
        # an output that depends on nothing is a plain number
        return jax.numpy.broadcast_to(jax.numpy.asarray(outputs_of({**inputs, **moved})[output], float), shape)

    value, back = jax.vjp(along, {name: inputs[name] for name in by})
    (slopes,) = back(jax.numpy.ones_like(value))
    return value, slopes


#: How derivatives can be had.
Method = Literal["tape", "jax"]
METHODS: tuple[Method, ...] = ("tape", "jax")
JAX_INSTEAD = 'try method="jax"'


def derivatives(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    by: Sequence[str],
    outputs: Sequence[str] = ("screw_torque",),
    method: Method = "tape",
    engine: Engine | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    **varied: Any,
) -> xr.Dataset:
    r"""Outputs and their partial derivatives by inputs and coefficients, as labelled arrays in SI.

    ``model`` is evaluated on ``screw`` with ``lubricant``. ``by`` names the inputs as
    :func:`~ballscrew.engine.sweeps.sweep.sweep` does (``"axial_load"``, ``"ball_diameter"``,
    ``"friction.boundary_friction_coefficient"``), varied or not; ``varied`` gives the points, and ``outputs`` names the
    results, as there. For each output ``y`` and input ``x`` the dataset has ``y`` and ``d_y_d_x``
    (:math:`\partial y/\partial x`, all other inputs held).

    The derivatives are those of the formulas as they are evaluated, without differencing. Of the ``method`` ``"tape"``
    differentiates what is recorded in reverse (:mod:`ballscrew.compiler.tracing.gradient`) and evaluates it with either
    ``engine`` on so many ``threads``, telling ``done(finished, total)`` the points; ``"jax"`` leaves it to JAX (the
    extra ``jax``), an independent way to the same numbers. At a bend, such as the clamp of the friction coefficient, it
    is the slope of the branch taken; where a power has no slope (no load, at rest) it is infinite or NaN. A number of
    balls counts as continuous.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, outputs that are truth values,
    inputs without a value, and laws that cannot be recorded.
    """
    faults = engine_faults("derivatives", engine)
    if method not in METHODS:
        faults.append(Fault("derivatives.method", "unknown method", str(method), f"one of {', '.join(METHODS)}"))
    raise_if_any(faults)
    slopes = slopes_of(Configuration(model, screw, lubricant), outputs, by, varied)
    if method == "jax":
        return _by_jax(slopes)
    evaluation = Evaluation.of(slopes, engine, shared=True)
    results = evaluation.empty(slopes.total)
    evaluation.fill(results, slice(0, slopes.total), threads=threads, done=done)
    return slopes.dataset(results).assign_attrs(evaluation.attributes)


def slopes_of(subject: Configuration, outputs: Sequence[str], by: Sequence[str], varied: Mapping[str, Any]) -> Slopes:
    """A plan for outputs and their derivatives. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in
    it.
    """
    by = (by,) if isinstance(by, str) else tuple(dict.fromkeys(by))
    known = subject.inputs
    faults = [Fault("derivatives.by", "unknown input", name, nearest(name, known)) for name in by if name not in known]
    faults += [] if by else [Fault("derivatives.by", MISSING, "", 'name the inputs: by=["axial_load"]')]
    raise_if_any(faults)
    held = {n: subject.value_of(n) for n in by if n not in varied and n not in OPERATION}
    raise_if_any(
        [
            Fault(f"derivatives.{name}", "has no value to differentiate by", "", f"give it one: {name}=…")
            for name, value in held.items()
            if value is None
        ]
    )
    plan = Plan.of(subject, outputs, {**varied, **held}, "derivatives")
    raise_if_any(
        [
            Fault("derivatives.outputs", "is true or false, and has no derivative", name, "choose a number")
            for name, output in plan.wanted.items()
            if output.dtype is bool
        ]
    )
    return Slopes(subject, plan.axes, plan.sizes, plan.outputs, by)


@dataclasses.dataclass(frozen=True, eq=False)
class Slopes(Plan):
    """A plan whose results are the outputs and their derivatives."""

    by: tuple[str, ...] = ()

    @property
    def varying(self) -> list[str]:
        """The inputs that are not the same at all points, or that are differentiated by."""
        return [name for name, axis in self.axes.items() if axis.dims or name in self.by]

    @functools.cached_property
    def wanted(self) -> dict[str, Output]:
        """The outputs, each followed by its derivatives."""
        outputs: dict[str, Output] = {}
        for name in self.outputs:
            outputs[name] = known_outputs(self.subject.nut)[name]
            outputs |= {slope_name(name, x): self._slope(outputs[name], x) for x in self.by}
        return outputs

    def _slope(self, output: Output, name: str) -> Output:
        above, below = output.quantity, self.subject.inputs[name][1]
        divisor = f"({below.unit})" if {" ", "/"} & set(below.unit) else below.unit
        unit = above.unit if divisor == "1" else f"{above.unit}/{divisor}"
        info = Info(
            rf"\partial {above.info.symbol}/\partial {below.info.symbol}",
            f"{above.info.meaning}, by {below.info.meaning}",
        )
        return Output(slope_name(output.name, name), Quantity(slope_name(output.name, name), unit, info), _unreadable)

    def recorded(self, groups: Sequence[int] | None = None) -> Program:
        """The outputs and their derivatives as a program of the varying inputs."""
        varying, tape = self.varying, self.tape(groups)
        values: dict[str, Any] = {}
        try:
            with self.subject.recording():
                result = self.subject.at(self.fixed | self.traced(tape))
                for name in self.outputs:
                    values[name] = known_outputs(self.subject.nut)[name].read(result)
                    slopes = partials(tape, values[name], [varying.index(x) for x in self.by])
                    values |= {slope_name(name, x): slope for x, slope in zip(self.by, slopes, strict=True)}
        except UnknownDerivativeError as unknown:
            raise InputError(Fault("derivatives", f"{unknown} has no derivative here", "", JAX_INSTEAD)) from None
        except CannotRecordError as why:
            raise InputError(Fault("derivatives", f"a law cannot be recorded: {why}", "", JAX_INSTEAD)) from None
        return merged_program(tape, values)


def _unreadable(_: Any) -> Any:
    """A result does not hold its derivatives."""
    raise TypeError("derivatives are recorded, not read")


def _by_jax(slopes: Slopes) -> xr.Dataset:

    everywhere = np.arange(slopes.total)
    shape = everywhere.shape
    points = {n: np.broadcast_to(v, shape) for n, v in slopes.points_at(everywhere).items()}

    def outputs_of(values: Mapping[str, Any]) -> dict[str, Any]:
        result = slopes.subject.at({**slopes.fixed, **values})
        return {name: known_outputs(slopes.subject.nut)[name].read(result) for name in slopes.outputs}

    values, outcome = jax_value_and_partials(outputs_of, points, slopes.outputs, slopes.by)
    named = {slope_name(output, x): slope for (output, x), slope in outcome.items()}
    return slopes.dataset({name: (values | named)[name] for name in slopes.wanted})
