"""Newton's method for chains of springs as a kernel: bars between neighbours, and a spring to ground at each.

A chain has so many links, and there are many chains: a vector has a lane for each of them, and each stops when it has
settled, so that none depends on its neighbours. A step walks the links twice: forward through the forces, their
slopes and the elimination of the tridiagonal matrix, and backward through the displacements. A chain that a full step
has made worse is given up, and left to a slower method.

The links may stand on one or two rings that they push open, each with an opening of its own. A step then borders the
matrix by the openings: the elimination has a column for each, whose products give the small matrix of the rings, so
that the links are walked no more often.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.kernels import elementary
from ballscrew.kernels.buffers import aligned_array
from ballscrew.kernels.emission import SIGNATURE, StepEmitter, pointers
from ballscrew.kernels.ir import Value, constant
from ballscrew.kernels.kernel import Kernel
from ballscrew.kernels.rings import LoopWriter, RingWriter
from ballscrew.tracing.program import Program, Source

#: Chains in a vector.
LANES = 16

Field = NDArray[np.float64]


class Chains(NamedTuple):
    """Chains to balance: the first axis has the links, the last one the chains."""

    #: Displacements to begin with, (links, chains).
    start: Field
    #: Stiffness of the bar behind each link but the last, (links − 1, chains), or (links − 1, 1) for all chains.
    bars: Field
    #: Forces that enter at the first and at the last link, (chains).
    first_force: Field
    last_force: Field
    #: The size of an imbalance that counts as none, and what is added to it in units of the largest bar force.
    tolerance: Field
    rounding: float


class Rings(NamedTuple):
    """What the links of each chain push open: one ring for those before a link, and one for it and those behind."""

    #: (chains)
    stiffness: Field
    #: The first link of the second ring; with as many as there are links, it has none.
    second_from: int


class Balanced(NamedTuple):
    """Displacements, whether a chain has settled, and there: force and slope of all its springs, and what is left.

    That is the root of the sum of the squares of the imbalances, beyond rounding; those of rings are among them.
    """

    displacement: Field
    settled: NDArray[np.bool_]
    force: Field
    slope: Field
    imbalance: Field
    #: How far the rings open, (2, chains).
    opening: Field


def balanced_chains(
    kernel: Kernel, inputs: Sequence[Field], chains: Chains, steps: int, rings: Rings | None = None
) -> Balanced:
    """Balance chains by a kernel of :func:`chain_kernel`, in so many steps at most."""
    links, count = chains.start.shape
    wide = -(-count // LANES) * LANES
    moved = aligned_array((links + 1) * wide, float).reshape(
        links + 1, wide
    )  # with a link behind the last one, whose bar has no stiffness
    moved[:links, :count], moved[:links, count:], moved[links] = chains.start, chains.start[:, -1:], 0.0
    bars = np.vstack([chains.bars, np.zeros((1, chains.bars.shape[-1]))])
    bars = _padded(bars, wide) if kernel.sources[-1] == "points" else bars
    given = [
        np.ascontiguousarray(values, dtype=float) if source == "rows" else _padded(values, wide)
        for source, values in zip(kernel.sources, inputs, strict=False)
    ]
    forces = [_padded(values, wide) for values in (chains.first_force, chains.last_force, chains.tolerance)]
    found = np.empty((4, wide))
    scratch = np.empty((2, links, LANES))
    opening = np.zeros((2, wide))
    of_rings = ([], []) if rings is None else ([_padded(rings.stiffness, wide)], [*opening, *np.empty_like(scratch)])
    kernel.at_addresses(
        slice(0 if rings is None else rings.second_from, links), slice(0, wide), wide, steps,
        [*given, bars, *forces, np.array([chains.rounding]), *of_rings[0]],
        [moved, *found, *scratch, *of_rings[1]],
    )  # fmt: skip
    open_, force, slope, left = found[:, :count]
    return Balanced(moved[:links, :count], open_ == 0, force, slope, left, opening[:, :count])


def _padded(values: Field, wide: int) -> Field:
    """Values with the last column repeated."""
    values = np.asarray(values, dtype=float)
    missing = wide - values.shape[-1]
    if missing:
        values = np.concatenate([values, np.repeat(values[..., -1:], missing, axis=-1)], axis=-1)
    return np.ascontiguousarray(values)


def chain_kernel(program: Program, sources: Sequence[Source], *, on_rings: bool = False) -> Kernel:
    """The kernel of chains whose springs have the outputs ``force`` and ``slope`` of a program.

    Its first input is the displacement; ``sources`` say of the others whether they differ by link (``rows``), by chain
    (``columns``), or by both (``points``). The last one is that of the bars, which is no input.

    Chains on rings (``on_rings``) have the opening as a second input ahead of these, and further outputs: ``push``,
    which opens the ring, and its slopes ``push_by_opening`` and ``push_by_displacement``. The latter, with the other
    sign, is that of ``force`` by the opening.
    """
    return Kernel.of(_text(program, sources, LANES, on_rings=on_rings), sources)


def _text(program: Program, sources: Sequence[Source], lanes: int, *, on_rings: bool) -> str:
    w = LoopWriter(lanes)
    *sources, of_the_bars = sources
    given = len(sources)
    bars, first, last, tolerance, rounding = range(given, given + 5)
    rings = RingWriter(w, given + 5, 7) if on_rings else None
    zero, one, inf = constant(0.0), constant(1.0), constant(float("inf"))
    yes = Value("splat (i1 true)")
    no = Value("splat (i1 false)")

    def load_bar(link: str, place: str) -> Value:
        return w.load(f"%input{bars}", place) if of_the_bars == "points" else w.load_one(f"%input{bars}", link)

    w.lines += ["  %last_link = sub i64 %row_stop, 1", "  br label %vector", "vector:"]
    w.phi("%column", "i64", ("0", "entry"), ("%next_column", "vector_done"))
    values: dict[int, Value] = {}
    further = 1 if rings is None else 2
    for i, source in enumerate(sources):
        if source == "columns":
            values[i + further] = w.load(f"%input{i}", "%column")
    first_force, last_force, allowed = (w.load(f"%input{i}", "%column") for i in (first, last, tolerance))
    of_bars = w.load_one(f"%input{rounding}", "0")
    if rings:
        rings.before_steps()
    w.lines += ["  br label %newton", "newton:"]
    w.phi("%step", "i64", ("0", "vector"), ("%next_step", "backward_done"))
    before = w.phi("%before", w.doubles, (inf, "vector"), ("%size", "backward_done"))
    open_ = w.phi("%open", w.masks, (yes, "vector"), ("%still", "backward_done"))
    given_up = w.phi("%given_up", w.masks, (no, "vector"), ("%gives_up", "backward_done"))
    if rings:
        rings.before_links()
    start = w.load("%output0", "%column")
    w.lines += ["  br label %forward", "forward:"]
    w.phi("%link", "i64", ("0", "newton"), ("%next_link", "forward"))
    x = w.phi("%x", w.doubles, (start, "newton"), ("%x_next", "forward"))
    stiff = w.phi("%behind", w.doubles, (one, "newton"), ("%behind_next", "forward"))
    carried = w.phi("%carried", w.doubles, (zero, "newton"), ("%carried_next", "forward"))
    bar = w.phi("%bar", w.doubles, (zero, "newton"), ("%bar_next", "forward"))
    passed = w.phi("%passed", w.doubles, (zero, "newton"), ("%passed_next", "forward"))
    squares = w.phi("%squares", w.doubles, (zero, "newton"), ("%squares_next", "forward"))
    most = w.phi("%most", w.doubles, (zero, "newton"), ("%most_next", "forward"))
    force = w.phi("%force", w.doubles, (zero, "newton"), ("%force_next", "forward"))
    slope = w.phi("%slope", w.doubles, (zero, "newton"), ("%slope_next", "forward"))
    if rings:
        rings.begin_link()
    w.lines.append("  %next_link = add i64 %link, 1")
    w.lines.append("  %row_place = mul i64 %link, %columns")
    w.lines.append("  %place = add i64 %row_place, %column")
    w.lines.append("  %place_next = add i64 %place, %columns")
    values[0] = x
    if rings:
        values[1] = rings.opening_of_link()
    for i, source in enumerate(sources):
        if source == "rows":
            values[i + further] = w.load_one(f"%input{i}", "%link")
        elif source == "points":
            values[i + further] = w.load(f"%input{i}", "%place")
    emitter = StepEmitter(w, program, dict(values))
    of_spring, its_slope = (emitter.as_number(program.outputs[name]) for name in ("force", "slope"))
    w.named("%x_next", w.load("%output0", "%place_next"))
    w.named("%bar_next", load_bar("%link", "%place"))
    x_next, bar_next = Value("%x_next"), Value("%bar_next")
    w.named("%passed_next", w.exact("fmul", bar_next, w.exact("fsub", x_next, x)))
    w.lines.append("  %is_first = icmp eq i64 %link, 0")
    w.lines.append("  %is_last = icmp eq i64 %link, %last_link")
    left = w.exact("fsub", zero, of_spring)
    for flag, enters in (("%is_first", first_force), ("%is_last", last_force)):
        added = w.exact("fadd", left, enters)
        left = w.instruction(f"select i1 {flag}, {w.doubles} {added}, {w.doubles} {left}")
    left = w.exact("fsub", w.exact("fadd", left, Value("%passed_next")), passed)
    share = w.exact("fdiv", bar, w.exact("fadd", bar, stiff))
    w.named("%behind_next", w.exact("fadd", its_slope, w.exact("fmul", share, stiff)))
    w.named("%carried_next", w.exact("fadd", left, w.exact("fmul", share, carried)))
    w.lines.append(f"  %in_scratch = mul i64 %link, {lanes}")
    w.store(Value("%behind_next"), "%output5", "%in_scratch")
    w.store(Value("%carried_next"), "%output6", "%in_scratch")
    w.named("%squares_next", w.exact("fadd", squares, w.exact("fmul", left, left)))
    if rings:
        below = w.exact("fadd", bar_next, Value("%behind_next"))
        below = w.choose(w.compare("ogt", below, zero), below, one)
        pushes = {name: emitter.as_number(step) for name, step in program.outputs.items()}
        rings.end_link(pushes, share, Value("%carried_next"), below)
    pull = w.intrinsic("fabs", w.exact("fmul", bar_next, x_next))
    w.named("%most_next", w.choose(w.compare("ogt", pull, most), pull, most))
    w.named("%force_next", w.exact("fadd", force, of_spring))
    w.named("%slope_next", w.exact("fadd", slope, its_slope))
    w.lines.append("  %more_links = icmp slt i64 %next_link, %row_stop")
    w.lines += ["  br i1 %more_links, label %forward, label %forward_done", "forward_done:"]
    all_squares, rounded = Value("%squares_next"), Value("%most_next")
    if rings:
        all_squares = rings.after_links(all_squares)
        rounded = w.exact("fadd", rounded, rings.pushed)
    w.named("%size", w.intrinsic("sqrt", all_squares))
    size = Value("%size")
    limit = w.exact("fadd", allowed, w.exact("fmul", of_bars, rounded))
    not_worse = w.compare("olt", size, before)
    still = w.compare("ogt", size, limit)
    if rings:
        not_worse = w.on_masks("or", not_worse, w.compare("ole", size, limit))
        still = w.on_masks("or", still, rings.are_open(allowed, of_bars))
    worse = w.on_masks("and", open_, w.on_masks("xor", not_worse, yes))
    began = w.instruction("icmp sgt i64 %step, 0")
    worse = w.instruction(f"select i1 {began}, {w.masks} {worse}, {w.masks} {no}")
    w.named_mask("%gives_up", w.on_masks("or", given_up, worse))
    still = w.on_masks("and", open_, still)
    w.named_mask("%still", w.on_masks("and", still, w.on_masks("xor", Value("%gives_up"), yes)))
    if rings:
        rings.move(Value("%still"))
    bits = w.instruction(f"bitcast {w.masks} %still to i{lanes}")
    any_open = w.instruction(f"icmp ne i{lanes} {bits}, 0")
    w.lines.append("  %next_step = add i64 %step, 1")
    w.lines.append("  %may_step = icmp slt i64 %step, %tile")
    goes_on = w.instruction(f"and i1 {any_open}, %may_step")
    w.lines += [f"  br i1 {goes_on}, label %backward, label %vector_done", "backward:"]
    w.phi("%back", "i64", ("%last_link", "forward_done"), ("%next_back", "backward"))
    moved_behind = w.phi("%moved", w.doubles, (zero, "forward_done"), ("%moved_next", "backward"))
    w.lines.append("  %back_row = mul i64 %back, %columns")
    w.lines.append("  %back_place = add i64 %back_row, %column")
    w.lines.append(f"  %back_scratch = mul i64 %back, {lanes}")
    behind, its_carried = w.load("%output5", "%back_scratch"), w.load("%output6", "%back_scratch")
    if rings:
        its_carried = rings.carried_back(its_carried)
    its_bar = load_bar("%back", "%back_place")
    below = w.exact("fadd", its_bar, behind)
    below = w.choose(w.compare("ogt", below, zero), below, one)
    above = w.exact("fadd", its_carried, w.exact("fmul", its_bar, moved_behind))
    w.named("%moved_next", w.exact("fdiv", above, below))
    there = w.load("%output0", "%back_place")
    there = w.choose(Value("%still"), w.exact("fadd", there, Value("%moved_next")), there)
    w.store(there, "%output0", "%back_place")
    w.lines.append("  %next_back = sub i64 %back, 1")
    w.lines.append("  %more_back = icmp sge i64 %next_back, 0")
    w.lines += ["  br i1 %more_back, label %backward, label %backward_done", "backward_done:"]
    w.lines += ["  br label %newton", "vector_done:"]
    unsettled = w.on_masks("or", Value("%gives_up"), Value("%still"))
    w.store(w.instruction(f"uitofp {w.masks} {unsettled} to {w.doubles}"), "%output1", "%column")
    w.store(Value("%force_next"), "%output2", "%column")
    w.store(Value("%slope_next"), "%output3", "%column")
    beyond = w.exact("fsub", size, w.exact("fmul", of_bars, rounded))
    w.store(w.choose(w.compare("ult", beyond, zero), zero, beyond), "%output4", "%column")
    if rings:
        rings.store()
    w.lines.append(f"  %next_column = add i64 %column, {lanes}")
    w.lines.append("  %more_columns = icmp slt i64 %next_column, %column_stop")
    w.lines += ["  br i1 %more_columns, label %vector, label %done", "done:", "  ret void"]
    return "\n".join(
        [
            elementary.definitions(lanes),
            f"define void @kernel({SIGNATURE}) {{",
            "entry:",
            *pointers("input", given + 5 + on_rings),
            *pointers("output", 11 if on_rings else 7),
            *w.lines,
            "}",
            "",
        ]
    )
