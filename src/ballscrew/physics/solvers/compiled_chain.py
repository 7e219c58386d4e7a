"""Balls between elastic bodies by compiled kernels: their balance, what each carries then, and how far they give way.

The springs are recorded from :class:`~ballscrew.physics.solvers.ball_springs.BallSprings`, step by step as NumPy
evaluates them. :mod:`ballscrew.compiler.kernels.chain` takes the same Newton steps as
:func:`~ballscrew.physics.solvers.ball_springs.chain_balance`; what would need a part of a step is left to the latter.
Where bodies swell, their gaps are found in the same steps, where NumPy solves the chain anew for each gap.
"""

from __future__ import annotations

import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from ballscrew.compiler.kernels.chain import Balanced, Chains, Rings, balanced_chains, chain_kernel
from ballscrew.compiler.kernels.emission import kernel_text, lanes_for
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.grid import verbatim_program
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.physics.solvers.ball_springs import (
    BALANCED,
    ROUNDING,
    STEPS,
    BallSprings,
    Bars,
    Field,
    Flanks,
    PushedApart,
    chain_balance,
    chain_imbalance,
)
from ballscrew.physics.solvers.swelling import Swelling, Widened, widened_balance

#: Fewest points of an operation of NumPy whose sums over the balls do not depend on how many there are.
FEWEST_POINTS = 2
#: Points that are worked on at a time, ball after ball.
TILE = 128


class CarriedLoads(NamedTuple):
    """Loads and contact angles of each ball on both flanks, and its slopes; sums of the axial forces.

    Slopes of the radial push are left out where nothing swells.
    """

    forward_load: Field
    backward_load: Field
    forward_angle: Field
    backward_angle: Field
    slope: Field
    on_forward: Field
    on_backward: Field
    push_by_opening: Field | None = None
    push_by_displacement: Field | None = None


def compiled_chain_balance(springs: BallSprings, bars: Bars, load: Field, scale: Field, start: Field) -> Field:
    """The displacements at which a chain of bars carries a load."""
    result = _balanced(springs, bars, load, scale, start, STEPS)
    x, force, slope = result.displacement, result.force, result.slope
    x += np.where(slope > 0, (load - force) / np.where(slope > 0, slope, 1.0), 0.0)
    if not result.settled.all():
        open_ = np.flatnonzero(~result.settled)
        among = np.resize(open_, max(open_.size, FEWEST_POINTS))
        slow = chain_balance(springs.at(among), bars.at(among), load[among], scale[among], start[:, among])
        x[:, open_] = slow[:, : open_.size]
    return x


def compiled_widened_balance(
    springs: BallSprings, bars: Bars, swelling: Swelling, load: Field, scale: Field, start: Field
) -> Widened:
    """The displacements of such a chain and the gaps of its bodies, and what is left of either balance."""
    given, chains = _given(springs, bars, load, scale, start)
    sources = _sources([*_numbers(springs), bars.stiffness])
    kernel = _widened_kernel(len(springs.flanks), springs.constant_angle, sources)
    result = balanced_chains(kernel, given, chains, STEPS, _rings(swelling, load.size))
    x, force, slope, left = result.displacement, result.force, result.slope, result.imbalance
    gap = result.opening[: len(swelling.members)]
    x += np.where(slope > 0, (load - force) / np.where(slope > 0, slope, 1.0), 0.0)
    if not result.settled.all():
        open_ = np.flatnonzero(~result.settled)
        among = np.resize(open_, max(open_.size, FEWEST_POINTS))
        some, links, bodies = springs.at(among), bars.at(among), swelling.at(among)
        slow = widened_balance(some, links, bodies, load[among], scale[among], start[:, among])
        widened = bodies.widened(some, slow.gap)
        of_balls = chain_imbalance(widened, links, load[among], slow.displacement)
        x[:, open_], gap[:, open_] = (part[:, : open_.size] for part in (slow.displacement, slow.gap))
        left[open_] = np.maximum(of_balls, slow.imbalance)[: open_.size]
    return Widened(gap, x, left)


def compiled_widened_response(
    bars: Bars, swelling: Swelling, slope: Field, push_by_opening: Field, push_by_displacement: Field
) -> Field:
    """The displacements under a further force of one, which enters as a load does, chain and gaps together."""
    count = slope.shape[-1]
    share = np.broadcast_to(bars.first_share, (count,))
    nothing = np.broadcast_to(0.0, slope.shape)
    chains = Chains(nothing, bars.stiffness, share, 1 - share, np.zeros(count), 0.0)
    given = [slope, push_by_opening, push_by_displacement]
    kernel = _linear_widened_kernel(_sources([*given, bars.stiffness]))
    return balanced_chains(kernel, given, chains, 1, _rings(swelling, count)).displacement


def _rings(swelling: Swelling, count: int) -> Rings:
    return Rings(np.broadcast_to(swelling.stiffness, (count,)), int(swelling.members[0].sum()))


def compiled_imbalance(springs: BallSprings, bars: Bars, load: Field, displacement: Field) -> Field:
    """Root of the sum of the squares of what is left of the balance at the balls beyond rounding, N."""
    return _balanced(springs, bars, load, 0 * load, displacement, 0).imbalance


def _balanced(springs: BallSprings, bars: Bars, load: Field, scale: Field, start: Field, steps: int) -> Balanced:
    given, chains = _given(springs, bars, load, scale, start)
    sources = _sources([*_numbers(springs), bars.stiffness])
    return balanced_chains(_chain_kernel(len(springs.flanks), springs.constant_angle, sources), given, chains, steps)


def _given(springs: BallSprings, bars: Bars, load: Field, scale: Field, start: Field) -> tuple[list[Field], Chains]:
    links, count = start.shape
    entering = (bars.first_share * load, (1 - bars.first_share) * load)
    chains = Chains(start, bars.stiffness, *entering, BALANCED * scale, ROUNDING * np.sqrt(links))
    return [_whole(number, links, count) for number in _numbers(springs)], chains


def compiled_loads(springs: BallSprings, displacement: Field, works: Field, *, swells: bool = False) -> CarriedLoads:
    """The loads of balls at these displacements; none where a point does not work."""
    links, count = displacement.shape
    inputs = [displacement, works, *_numbers(springs)]
    sources: tuple[Source, ...] = ("points", "columns", *_sources(inputs[2:]))
    kernel, names, sums, spare = _load_kernel(len(springs.flanks), springs.constant_angle, swells, sources)
    values = {n: aligned_array(count + spare if n in sums else links * count, float) for n in names}
    whole = [np.ascontiguousarray(_whole(number, links, count)) for number in inputs]
    kernel(slice(0, links), slice(0, count), count, whole, list(values.values()), past_cache=False, tile=TILE)
    return CarriedLoads(**{n: held[:count] if n in sums else held.reshape(links, count) for n, held in values.items()})


def compiled_response(bars: Bars, slope: Field) -> Field:
    """The displacements of a chain of linear springs under a force of one, which enters as a load does."""
    count = slope.shape[-1]
    share = np.broadcast_to(bars.first_share, (count,))
    chains = Chains(np.broadcast_to(0.0, slope.shape), bars.stiffness, share, 1 - share, np.zeros(count), 0.0)
    kernel = _linear_kernel(_sources([slope, bars.stiffness]))
    return balanced_chains(kernel, [slope], chains, 1).displacement  # the first step is the answer


def _numbers(springs: BallSprings) -> list[Field]:
    """The numbers of springs, in the order of :func:`_made_of`."""
    K, A, alpha, c_phi, balls, _, flanks = springs
    return [K, A, alpha, c_phi, balls, *(part for each in flanks for part in each)]


def _made_of(constant_angle: bool, K: Any, A: Any, alpha: Any, c_phi: Any, balls: Any, *parts: Any) -> BallSprings:
    pairs = tuple(Flanks(*parts[k : k + 3]) for k in range(0, len(parts), 3))
    return BallSprings(K, A, alpha, c_phi, balls, constant_angle, pairs)


def _recorded(flanks: int, further: int, formula: Callable[..., Mapping[str, Any]]) -> Program:
    """A formula of some values and the numbers of springs."""
    return verbatim_program(further + len(BallSprings._fields) - 2 + 3 * flanks, formula)


@functools.cache
def _chain_kernel(flanks: int, constant_angle: bool, sources: tuple[Source, ...]) -> Kernel:
    def formula(x: Any, *numbers: Any) -> Mapping[str, Any]:
        force, slope = _made_of(constant_angle, *numbers).forces(x)
        return {"force": force, "slope": slope}

    return chain_kernel(_recorded(flanks, 1, formula), sources)


@functools.cache
def _widened_kernel(flanks: int, constant_angle: bool, sources: tuple[Source, ...]) -> Kernel:
    def formula(x: Any, gap: Any, *numbers: Any) -> Mapping[str, Any]:
        return _made_of(constant_angle, *numbers).pushed_apart(x, gap)._asdict()

    return chain_kernel(_recorded(flanks, 2, formula), sources, on_rings=True)


@functools.cache
def _linear_widened_kernel(sources: tuple[Source, ...]) -> Kernel:
    def formula(x: Any, gap: Any, slope: Any, by_opening: Any, cross: Any) -> Mapping[str, Any]:
        force, push = slope * x - cross * gap, cross * x + by_opening * gap
        return PushedApart(force, slope + 0.0, push, by_opening + 0.0, cross + 0.0)._asdict()

    return chain_kernel(verbatim_program(5, formula), sources, on_rings=True)


@functools.cache
def _linear_kernel(sources: tuple[Source, ...]) -> Kernel:
    def formula(x: Any, slope: Any) -> Mapping[str, Any]:
        return {"force": slope * x, "slope": slope + 0.0}

    return chain_kernel(verbatim_program(2, formula), sources)


@functools.cache
def _load_kernel(
    flanks: int, constant_angle: bool, swells: bool, sources: tuple[Source, ...]
) -> tuple[Kernel, tuple[str, ...], Mapping[str, Any], int]:
    """The kernel of what balls carry, its results, which are summed, and the room these need beyond the points."""
    names = CarriedLoads._fields[: None if swells else -2]

    def formula(x: Any, works: Any, *numbers: Any) -> Mapping[str, Any]:
        springs = _made_of(constant_angle, *numbers)
        pairs = [(each.facing, springs.loads(each, x)) for each in springs.flanks]
        values: dict[str, Any] = {"slope": springs.balls * sum(there.slope for _, there in pairs)}
        for side, facing in (("forward", 1), ("backward", -1)):
            load = sum(np.where(pair == facing, there.load, 0.0) for pair, there in pairs)
            angle = sum(np.where(pair == facing, np.arcsin(there.sine), 0.0) for pair, there in pairs)
            force = sum(np.where(pair == facing, facing * there.axial_force, 0.0) for pair, there in pairs)
            values |= {f"{side}_load": np.where(works != 0, load, 0.0), f"{side}_angle": angle}
            values[f"on_{side}"] = springs.balls * np.where(works != 0, force, 0.0)
        if swells:  # the springs are widened already
            pushes = springs.pushed_apart(x, 0.0 * x)
            values |= {name: getattr(pushes, name) for name in names[-2:]}
        return {name: values[name] for name in names}

    program = _recorded(flanks, 2, formula)
    sums: dict[str, Any] = {"on_forward": np.sum, "on_backward": np.sum}
    text = kernel_text(program, sources, dict.fromkeys(program.outputs, False), reduced=sums)
    return Kernel.of(text, sources), names, sums, lanes_for(program)


def _sources(numbers: Sequence[Field]) -> tuple[Source, ...]:
    kinds: dict[tuple[bool, bool], Source] = {(True, False): "points", (True, True): "rows"}
    return tuple(kinds.get((number.ndim > 1, number.shape[-1] == 1), "columns") for number in numbers)


def _whole(number: Field, links: int, count: int) -> Field:
    if number.ndim == 1:
        return np.broadcast_to(number, (count,))
    return number[:, 0] if number.shape[-1] == 1 else np.broadcast_to(number, (links, count))
