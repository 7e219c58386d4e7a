"""Derivatives by JAX: the model runs on JAX arrays and is differentiated in reverse mode.

Every output at a point depends on the inputs of that point alone. So one pass backwards from the sum
of an output over the points gives its slopes by all inputs, at all points.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import blocks
from ballscrew.basis.errors import Fault, InputError

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
