"""Monte Carlo: what the uncertainty of the inputs makes of the results, without keeping a sample.

The number of a sample is enough to know its random numbers (:mod:`ballscrew.compiler.kernels.random`), and a
sketch is enough to know how results are distributed (:mod:`ballscrew.compiler.kernels.sketch`). So samples
are made, evaluated and counted a few thousand at a time, and nothing grows with their number.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ballscrew.basis.arrays import blocks, map_blocks
from ballscrew.basis.errors import MISSING, Fault, InputError, raise_if_any
from ballscrew.compiler.kernels import random
from ballscrew.compiler.kernels.emission import UnknownOperationError, kernel_text
from ballscrew.compiler.kernels.kernel import Kernel
from ballscrew.compiler.kernels.sketch import UNIT, Moments, Sketch
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import CannotRecordError, Tape
from ballscrew.engine.evaluation.by_ball import BLOCK_OF_BALLS, ByBall, by_ball
from ballscrew.engine.evaluation.engines import (
    ASKED_FOR,
    PAYS,
    Engine,
    engine_faults,
    may_be_compiled,
    why_numpy,
    worth_compiling,
)
from ballscrew.engine.evaluation.outputs import OPERATION, attributes_of
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.uncertainty.distributions import Distribution, distribution_fault
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import (
    FrictionModel,
)

#: Samples of a block, which is evaluated on one thread and whose sums are merged in the order of the
#: blocks; and how many of them NumPy evaluates at a time. Whole units, for the sake of the sums.
BLOCK = 8 * UNIT
NUMPY_STEP = 4 * UNIT
#: Seeds are less than this.
SEEDS = 2**63

#: Evaluates the samples of a slice into arrays of its length.
_SampleEvaluator = Callable[[slice, Mapping[str, NDArray[Any]]], None]


def monte_carlo(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    distributions: Mapping[str, Distribution],
    samples: int,
    seed: int = 0,
    outputs: Sequence[str] | None = None,
    quantiles: Sequence[float] = (0.025, 0.5, 0.975),
    engine: Engine | None = None,
    threads: int | None = None,
    done: Callable[[int, int], None] | None = None,
    **fixed: Any,
) -> xr.Dataset:
    """Evaluate a model over random samples of its inputs, and return how its results are distributed, as a dataset.

    ``model``, ``screw`` and ``lubricant`` have the values of all other inputs. ``distributions`` names uncertain inputs
    as :func:`~ballscrew.engine.sweeps.sweep.sweep` names what it varies, ``fixed`` gives single numbers to others;
    between them they have ``axial_load`` and ``screw_speed``. Inputs are independent of each other. Of ``samples``
    samples, sample i of input j, in the order of the mapping, is the quantile of a uniform number that depends on i, j
    and the ``seed`` alone: the dataset is the same to the last bit for any number of ``threads``, and engines agree to
    rounding. ``outputs`` are named as those of a sweep.

    Of each output ``x`` that is a number the dataset has ``x_mean``, ``x_standard_deviation``, ``x_minimum``,
    ``x_maximum``, ``x_quantiles`` along ``quantile`` (the shares ``quantiles``, to 0.05 %, see
    :meth:`~ballscrew.compiler.kernels.sketch.Sketch.quantile`) and ``x_missing_share``, that of samples which are NaN
    and left out of the others; of each that is true or not, ``x_share``, where it is true. ``invalid_share`` is that of
    samples that are not valid; an input beyond its bounds is a reason too. They are counted in all the same, as a sweep
    returns them.

    The ``engine`` is chosen by the size of the work; ``done(finished, total)`` is told the progress.

    Raises :class:`~ballscrew.basis.errors.InputError` for unknown names, missing or bad values, and an
    engine that cannot be had.
    """
    subject = Configuration(model, screw, lubricant)
    faults = _faults_of_options(samples, seed, quantiles, engine, threads)
    raise_if_any(faults + _faults_of_inputs(subject, distributions, fixed))
    plan = _planned(subject, outputs, distributions, fixed)
    evaluate, step, compiled, reason = _by_engine(plan, distributions, samples, seed, engine)
    tally = _Tally(plan, evaluate, step, compiled=compiled)
    map_blocks(
        tally.take,
        samples,
        block_size=BLOCK,
        threads=threads,
        done=None if done is None else lambda finished: done(finished, samples),
    )
    known = subject.inputs
    words = {
        f"distribution_{known[name][0]}_{name.replace('.', '_')}": distribution.describe(known[name][1].unit)
        for name, distribution in distributions.items()
    }
    of_quantile = {"long_name": "share of the samples that lies below", "units": "1"}
    coordinates = {name: ((), value, attributes_of(known[name][1])) for name, value in plan.fixed.items()}
    return xr.Dataset(
        tally.variables(quantiles, samples),
        {"quantile": ("quantile", np.asarray(quantiles, dtype=float), of_quantile), **coordinates},
        plan.attributes
        | {"samples": samples, "seed": seed, **words}
        | {"engine": "compiled" if compiled else "numpy", "engine_reason": reason},
    )


def _faults_of_options(samples: Any, seed: Any, quantiles: Any, engine: Any, threads: Any) -> list[Fault]:
    faults = [
        Fault(f"monte_carlo.{name}", "must be a whole number, 1 or more", str(value))
        for name, value in {"samples": samples, "threads": 1 if threads is None else threads}.items()
        if not isinstance(value, int | np.integer) or value < 1
    ]
    if not isinstance(seed, int | np.integer) or not 0 <= seed < SEEDS:
        faults.append(Fault("monte_carlo.seed", "must be a whole number from 0 to 2^63 − 1", str(seed)))
    faults += [
        Fault("monte_carlo.quantiles", "must lie between 0 and 1", str(share), "0.5 is the median")
        for share in quantiles
        if not 0 <= share <= 1
    ]
    return faults + engine_faults("monte_carlo", engine)


def _faults_of_inputs(
    subject: Configuration, distributions: Mapping[str, Any], fixed: Mapping[str, Any]
) -> list[Fault]:
    """Faults that a sweep would not find, or would not put in these words."""
    known = subject.inputs
    given = {*distributions, *fixed}
    faults: list[Fault] = []
    if not distributions:
        faults.append(Fault("monte_carlo.distributions", "is empty", "", "name at least one uncertain input"))
    for name in OPERATION:
        if name not in given:
            remedy = f"give {name}=… or a distribution of it"
            faults.append(Fault(f"monte_carlo.{name}", MISSING, "", remedy))
    for name, distribution in distributions.items():
        where = f"monte_carlo.distributions.{name}"
        fault = distribution_fault(where, name, distribution, known, f"give {name}=…")
        faults += [] if fault is None else [fault]
        if name in fixed:
            faults.append(Fault(where, "is given as one number too", str(fixed[name]), "leave one of them out"))
    for name, value in fixed.items():
        if isinstance(value, Distribution):
            remedy = f'distributions={{"{name}": …}}'
            faults.append(Fault(f"monte_carlo.{name}", "is a distribution", str(value), remedy))
        elif np.ndim(value):
            faults.append(Fault(f"monte_carlo.{name}", "must be one number", "", "for several, call again for each"))
    for name, (part, _) in known.items():
        if part != "operation" and name not in given and np.ndim(subject.value_of(name)):
            faults.append(Fault(f"{part}.{name}", "is an array", "", "give one number, or a distribution of it"))
    return faults


def _planned(
    subject: Configuration,
    outputs: Sequence[str] | None,
    distributions: Mapping[str, Distribution],
    fixed: Mapping[str, Any],
) -> Plan:
    """Plan of a sweep over the ends or the middles of the distributions.

    So names, bounds and outputs are checked as they are there; whether samples are valid is always asked for.
    """
    named = (outputs,) if isinstance(outputs, str) else outputs or ()
    samples = {
        name: xr.DataArray(
            [distribution.characteristic_values[0], distribution.characteristic_values[-1]], dims="sample"
        )
        for name, distribution in distributions.items()
    }
    return Plan.of(subject, [*named, "valid"] if named else None, {**samples, **fixed}, "monte_carlo")


def _by_engine(
    plan: Plan, distributions: Mapping[str, Distribution], samples: int, seed: int, engine: Engine | None
) -> tuple[_SampleEvaluator, int, bool, str]:
    """Evaluator of samples, its batch size, whether it is compiled, and the reason."""
    if plan.subject.nut.one_by_one:
        ready = by_ball(plan, engine, max(1, samples // plan.total), varying=list(distributions))
        if isinstance(ready, ByBall):
            return _ball_by_ball(plan, distributions, ready, seed), NUMPY_STEP, ready.engine == "compiled", ready.reason
        if engine == "compiled":
            raise InputError(Fault("monte_carlo.engine", f"cannot be had: {ready}", engine, 'take engine="numpy"'))
        return _by_numpy(plan, distributions, None, seed), NUMPY_STEP, False, ready
    program: Program | None = None
    try:
        program = _recorded(plan, distributions)
        why = why_numpy(engine)
        if may_be_compiled(program, samples, engine):
            sources: list[Source] = ["random"] * program.inputs
            text = kernel_text(program, sources, {name: output.dtype is bool for name, output in plan.wanted.items()})
            if engine or worth_compiling(program, samples, text):
                chosen = ASKED_FOR if engine else PAYS
                return _by_kernel(Kernel.of(text, sources), program, seed), UNIT, True, chosen
    except CannotRecordError as error:
        why = f"the model itself, on plain arrays: {error}"
    except UnknownOperationError as unknown:
        why = f"{unknown} is not known to kernels"
    if engine == "compiled":
        raise InputError(Fault("monte_carlo.engine", f"cannot be had: {why}", engine, 'take engine="numpy"'))
    return _by_numpy(plan, distributions, program, seed), NUMPY_STEP, False, why


def _recorded(plan: Plan, distributions: Mapping[str, Distribution]) -> Program:
    """The model as a program of uniform numbers."""
    tape = Tape(len(distributions))
    drawn = {name: distribution.quantile(tape.value(i)) for i, (name, distribution) in enumerate(distributions.items())}
    return plan.subject.recorded(tape, plan.fixed | drawn, plan.wanted)


def _ball_by_ball(plan: Plan, distributions: Mapping[str, Distribution], ready: ByBall, seed: int) -> _SampleEvaluator:
    size = max(1, BLOCK_OF_BALLS // plan.subject.balls)

    def evaluate(part: slice, results: Mapping[str, NDArray[Any]]) -> None:
        for block in blocks(part.stop - part.start, size):
            numbers = random.uniform(slice(part.start + block.start, part.start + block.stop), len(distributions), seed)
            drawn = zip(distributions.items(), numbers, strict=True)
            points = {name: distribution.quantile(u) for (name, distribution), u in drawn}
            ready.evaluate(plan.subject, plan.fixed | points, {name: held[block] for name, held in results.items()})

    return evaluate


def _by_numpy(
    plan: Plan, distributions: Mapping[str, Distribution], program: Program | None, seed: int
) -> _SampleEvaluator:
    interpreter = None if program is None else program.interpreter

    def evaluate(part: slice, results: Mapping[str, NDArray[Any]]) -> None:
        numbers = random.uniform(part, len(distributions), seed)
        with np.errstate(all="ignore"):
            if interpreter is not None:
                interpreter.run(numbers, results)
                return
            drawn = zip(distributions.items(), numbers, strict=True)
            points = {name: distribution.quantile(u) for (name, distribution), u in drawn}
            result = plan.subject.at(plan.fixed | points)
            for name, output in plan.wanted.items():
                results[name][...] = output.read(result)

    return evaluate


def _by_kernel(kernel: Kernel, program: Program, seed: int) -> _SampleEvaluator:
    names = list(program.outputs)

    def evaluate(part: slice, results: Mapping[str, NDArray[Any]]) -> None:
        for name, value in program.constants.items():
            results[name][...] = value
        if names:
            blank = [None] * program.inputs
            here = [results[name] for name in names]
            kernel(slice(0, 1), part, part.stop, blank, here, first=part.start, seed=seed)

    return evaluate


class _Tally:
    """All that is kept of the samples evaluated so far.

    Counts come in whatever order the threads are done: a few sketches go from hand to hand. Sums wait
    for those of the blocks before.
    """

    def __init__(self, plan: Plan, evaluate: _SampleEvaluator, step: int, *, compiled: bool) -> None:
        self.plan = plan
        self.numbers = [name for name, output in plan.wanted.items() if output.dtype is not bool]
        self.truths = [name for name, output in plan.wanted.items() if output.dtype is bool]
        self.true = np.zeros(len(self.truths), dtype=np.int64)
        self._evaluate, self._step, self._compiled = evaluate, step, compiled
        self._lock = threading.Lock()
        self._idle: list[Sketch] = []
        self._moments = Moments.empty(len(self.numbers))
        self._waiting: dict[int, Moments] = {}
        self._next_start = 0

    def take(self, block: slice) -> None:
        """Evaluate and count the samples of a block."""
        with self._lock:
            sketch = self._idle.pop() if self._idle else Sketch(len(self.numbers), compiled=self._compiled)
        values = np.empty((len(self.numbers), self._step))
        masks = np.empty((len(self.truths), self._step), dtype=bool)
        true = np.zeros_like(self.true)
        for start in range(block.start, block.stop, self._step):
            part = slice(start, min(start + self._step, block.stop))
            count = part.stop - part.start
            rows = [*values[:, :count], *masks[:, :count]]
            self._evaluate(part, dict(zip([*self.numbers, *self.truths], rows, strict=True)))
            if self.numbers:
                sketch.add(values[:, :count])
            true += np.count_nonzero(masks[:, :count], axis=1)
        with self._lock:
            self._idle.append(sketch)
            self.true += true
            self._waiting[block.start] = sketch.take_moments()
            while self._next_start in self._waiting:
                self._moments = self._moments.merged(self._waiting.pop(self._next_start))
                self._next_start += BLOCK

    def variables(self, quantiles: Sequence[float], samples: int) -> dict[str, Any]:
        """Statistics of each output, in the order of the outputs."""
        sketch = Sketch(len(self.numbers))
        for part in self._idle:
            sketch.merge(part)
        sketch.moments = self._moments
        by_share = np.array([sketch.quantile(float(share)) for share in quantiles]).reshape(len(quantiles), -1)
        parts: list[tuple[str, str, NDArray[np.float64], dict[str, str]]] = [
            ("mean", "mean of", sketch.mean, {"cell_methods": "realization: mean"}),
            (
                "standard_deviation",
                "standard deviation of",
                sketch.deviation,
                {"cell_methods": "realization: standard_deviation"},
            ),
            ("minimum", "least", sketch.minimum, {"cell_methods": "realization: minimum"}),
            ("maximum", "largest", sketch.maximum, {"cell_methods": "realization: maximum"}),
        ]
        found: dict[str, Any] = {}
        for name, output in self.plan.wanted.items():
            attributes = attributes_of(output.quantity)
            meaning = attributes["long_name"]
            if name in self.numbers:
                i = self.numbers.index(name)
                for suffix, words, values, more in parts:
                    found[f"{name}_{suffix}"] = (
                        (),
                        values[i],
                        {**attributes, "long_name": f"{words} {meaning}", **more},
                    )
                of_quantiles = {**attributes, "long_name": f"quantiles of {meaning}"}
                found[f"{name}_quantiles"] = ("quantile", by_share[:, i], of_quantiles)
                of_missing = {"long_name": f"share of samples without a value of {meaning}", "units": "1"}
                found[f"{name}_missing_share"] = ((), sketch.missing[i] / samples, of_missing)
            else:
                true = int(self.true[self.truths.index(name)])
                of_share = {"long_name": f"share of samples with {meaning}", "units": "1"}
                if name == "valid":
                    name, true = "invalid", samples - true
                    of_share["long_name"] = "share of samples where the model is not to be trusted"
                found[f"{name}_share"] = ((), true / samples, of_share)
        return found
