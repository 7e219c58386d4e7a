"""Newton's method for chains of springs as a kernel: bars between neighbours, and a spring to ground at each.

A chain has so many links, and there are many chains: a vector has a lane for each of them, and each stops when it has
settled, so that none depends on its neighbours. A step walks the links twice: forward through the forces, their
slopes and the elimination of the tridiagonal matrix, and backward through the displacements. A chain that a full step
has made worse is given up, and left to a slower method.

The links may stand on one or two rings that they push open, each with an opening of its own. A step then borders the
matrix by the openings: the elimination has a column for each, whose products give the small matrix of the rings, so
that the links are walked no more often.

Chains whose links push rings open: what that adds to the kernel of a chain.

A Newton step of a chain with an opening for each of two rings has a matrix with two columns more. Its tridiagonal part
is eliminated as without them. Where that has come through with a right side and with the columns, the sums of their
products over the pivots are the small matrix of the openings, and what is left for them; so nothing is walked twice.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels import ir
from ballscrew.compiler.kernels.emission import SIGNATURE, StepEmitter, pointers
from ballscrew.compiler.kernels.ir import Value, Writer, constant
from ballscrew.compiler.kernels.kernel import Kernel, aligned_array
from ballscrew.compiler.tracing.program import Program, Source


class LoopWriter(Writer):
    """A writer of loops over arrays, whose values go round through names of their own."""

    def _at(self, array: str, place: str) -> Value:
        return self.instruction(f"getelementptr double, ptr {array}, i64 {place}")

    def load(self, array: str, place: str) -> Value:
        """A vector from a place of an array."""
        return self.instruction(f"load {self.doubles}, ptr {self._at(array, place)}, align 8")

    def load_one(self, array: str, place: str) -> Value:
        """One number of an array in every lane."""
        return self.broadcast("double", self.instruction(f"load double, ptr {self._at(array, place)}"))

    def store(self, value: Value, array: str, place: str) -> None:
        """A vector to a place of an array."""
        self.lines.append(f"  store {self.doubles} {value}, ptr {self._at(array, place)}, align 8")

    def phi(self, name: str, kind: str, *incoming: tuple[str, str]) -> Value:
        """A value that depends on the block that was left."""
        listed = ", ".join(f"[ {value}, %{block} ]" for value, block in incoming)
        self.lines.append(f"  {name} = phi {kind} {listed}")
        return Value(name)

    def named(self, name: str, value: Value) -> None:
        """Give a vector a name that an earlier phi refers to."""
        self.lines.append(f"  {name} = select i1 true, {self.doubles} {value}, {self.doubles} {value}")

    def named_mask(self, name: str, value: Value) -> None:
        """Give a mask such a name."""
        self.lines.append(f"  {name} = select i1 true, {self.masks} {value}, {self.masks} {value}")


class RingWriter:
    """The instructions that rings add to those of a chain."""

    def __init__(self, w: LoopWriter, stiffness: int, first_output: int) -> None:
        self.w = w
        self.stiffness = stiffness
        self.openings = [f"%output{first_output + ring}" for ring in (0, 1)]
        self.scratch = [f"%output{first_output + 2 + ring}" for ring in (0, 1)]
        self._sums: dict[str, Value] = {}

    def before_steps(self) -> None:
        """Compute what is the same in all steps of a vector."""
        self._stiffness = self.w.load(f"%input{self.stiffness}", "%column")

    def before_links(self) -> None:
        """The openings of a step."""
        zero = constant(0.0)
        self._opening = [
            self.w.phi(f"%opening{ring}", self.w.doubles, (zero, "vector"), (f"%opening{ring}_next", "backward_done"))
            for ring in (0, 1)
        ]

    def begin_link(self) -> None:
        """Sums over the links, and the elimination of the columns of the rings."""
        names = ["column0", "column1", "product00", "product01", "product11"]
        names += [f"{name}{ring}" for name in ("push", "slope", "through") for ring in (0, 1)]
        self._sums = {
            name: self.w.phi(
                f"%ring_{name}", self.w.doubles, (constant(0.0), "newton"), (f"%ring_{name}_next", "forward")
            )
            for name in names
        }

    def opening_of_link(self) -> Value:
        """The opening of the ring that a link is on."""
        self.w.lines.append("  %on_second = icmp sge i64 %link, %row_start")
        first, second = self._opening
        return self.w.instruction(f"select i1 %on_second, {self.w.doubles} {second}, {self.w.doubles} {first}")

    def end_link(self, outputs: Mapping[str, Value], share: Value, carried: Value, below: Value) -> None:
        """Add a link: ``carried`` has come through the elimination to it, ``below`` divides it."""
        w = self.w
        inverse = w.exact("fdiv", constant(1.0), below)
        come = w.exact("fmul", carried, inverse)
        columns: list[Value] = []
        for ring in (0, 1):
            here = {
                name: self._of_ring(ring, outputs[name]) for name in ("push", "push_by_opening", "push_by_displacement")
            }
            through = w.exact("fmul", share, self._sums[f"column{ring}"])
            columns.append(w.exact("fadd", here["push_by_displacement"], through))
            self._next(f"column{ring}", columns[ring])
            w.store(columns[ring], self.scratch[ring], "%in_scratch")
            self._add(f"push{ring}", here["push"])
            self._add(f"slope{ring}", here["push_by_opening"])
            self._add(f"through{ring}", w.exact("fmul", columns[ring], come))
        for one, other in ((0, 0), (0, 1), (1, 1)):
            product = w.exact("fmul", columns[one], columns[other])
            self._add(f"product{one}{other}", w.exact("fmul", product, inverse))

    def after_links(self, squares: Value) -> Value:
        """The squares of the imbalances with those of the rings; the step of the openings, by the small matrix."""
        w, total = self.w, {name: Value(f"%ring_{name}_next") for name in self._sums}
        right: list[Value] = []
        self._left: list[Value] = []
        self.pushed = w.exact("fadd", total["push0"], total["push1"])
        own: list[Value] = []
        for ring in (0, 1):
            left = w.exact("fsub", total[f"push{ring}"], w.exact("fmul", self._stiffness, self._opening[ring]))
            squares = w.exact("fadd", squares, w.exact("fmul", left, left))
            self._left.append(w.intrinsic("fabs", left))
            right.append(w.exact("fadd", left, total[f"through{ring}"]))
            stiff = w.exact("fsub", self._stiffness, total[f"slope{ring}"])
            own.append(w.exact("fsub", stiff, total[f"product{ring}{ring}"]))
        between = total["product01"]  # with the other sign
        both = w.exact("fsub", w.exact("fmul", *own), w.exact("fmul", between, between))
        self._step = [
            w.exact(
                "fdiv",
                w.exact("fadd", w.exact("fmul", right[ring], own[1 - ring]), w.exact("fmul", right[1 - ring], between)),
                both,
            )
            for ring in (0, 1)
        ]
        return squares

    def are_open(self, tolerance: Value, rounding: Value) -> Value:
        """Mask where a ring is out of balance by itself: what stiff bars make of rounded places would hide that."""
        w = self.w
        limit = w.exact("fadd", tolerance, w.exact("fmul", rounding, self.pushed))
        return w.on_masks("or", *(w.compare("ogt", left, limit) for left in self._left))

    def move(self, still: Value) -> None:
        """Take the step of the openings where a chain is still open."""
        for ring in (0, 1):
            w, before = self.w, self._opening[ring]
            w.named(f"%opening{ring}_next", w.choose(still, w.exact("fadd", before, self._step[ring]), before))

    def carried_back(self, carried: Value) -> Value:
        """Imbalance that the links hand on with the step of the openings."""
        for ring in (0, 1):
            column = self.w.load(self.scratch[ring], "%back_scratch")
            carried = self.w.exact("fadd", carried, self.w.exact("fmul", column, self._step[ring]))
        return carried

    def store(self) -> None:
        """The openings as they were in the last balance."""
        for ring in (0, 1):
            self.w.store(self._opening[ring], self.openings[ring], "%column")

    def _of_ring(self, ring: int, value: Value) -> Value:
        on, off = (value, constant(0.0)) if ring else (constant(0.0), value)
        return self.w.instruction(f"select i1 %on_second, {self.w.doubles} {on}, {self.w.doubles} {off}")

    def _next(self, name: str, value: Value) -> None:
        self.w.named(f"%ring_{name}_next", value)

    def _add(self, name: str, value: Value) -> None:
        self._next(name, self.w.exact("fadd", self._sums[name], value))


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
    """Rings that the links of each chain push open: one for those before a link, and one for it and those behind."""

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
    result = np.empty((4, wide))
    scratch = np.empty((2, links, LANES))
    opening = np.zeros((2, wide))
    of_rings = ([], []) if rings is None else ([_padded(rings.stiffness, wide)], [*opening, *np.empty_like(scratch)])
    kernel.at_addresses(
        slice(0 if rings is None else rings.second_from, links),
        slice(0, wide),
        wide,
        steps,
        [*given, bars, *forces, np.array([chains.rounding]), *of_rings[0]],
        [moved, *result, *scratch, *of_rings[1]],
    )
    open_, force, slope, left = result[:, :count]
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
    """The module with the kernel: a loop over vectors of chains, over steps in it, and over the links in these."""
    writer = _ChainWriter(LoopWriter(lanes), program, sources, on_rings=on_rings)
    forces = writer.begin_vector()
    before = writer.begin_step()
    writer.walk_forward(forces, before.start)
    imbalance = writer.judge_step(forces, before)
    writer.walk_backward()
    writer.end_vector(forces, imbalance)
    return "\n".join(
        [
            ir.definitions(lanes),
            f"define void @kernel({SIGNATURE}) {{",
            "entry:",
            *pointers("input", writer.inputs),
            *pointers("output", 11 if on_rings else 7),
            *writer.w.lines,
            "}",
            "",
        ]
    )


class _Forces(NamedTuple):
    """Forces that are the same in all steps of a vector of chains."""

    #: Inputs of the springs that differ by chain only, by their number in the program.
    of_springs: Mapping[int, Value]
    first: Value
    last: Value
    #: The size of an imbalance that counts as none, and what is added to it in units of the largest bar force.
    allowed: Value
    of_bars: Value


class _StepBefore(NamedTuple):
    """Data of the step before: its imbalance, the chains that are open, and those that are given up."""

    size: Value
    open_: Value
    given_up: Value
    #: The displacement of the first link.
    start: Value


class _LinkBefore(NamedTuple):
    """Values that have come to a link from those before it."""

    #: Its own displacement, loaded with that of the link before.
    x: Value
    #: The pivot of the elimination and its right side, at the link before.
    pivot: Value
    carried: Value
    #: Stiffness of the bar to the link before, and its force.
    bar: Value
    passed: Value
    #: Sums: of the squares of the imbalances, of forces and of slopes; and the largest force of an end of a bar.
    squares: Value
    most: Value
    force: Value
    slope: Value


class _Imbalance(NamedTuple):
    """Remainder of the balance of a chain, and the force that its rounding is measured by."""

    size: Value
    rounded: Value


_ZERO, _ONE, _INFINITY = constant(0.0), constant(1.0), constant(float("inf"))
_YES, _NO = Value("splat (i1 true)"), Value("splat (i1 false)")


class _ChainWriter:
    """The instructions of a kernel of chains, in the order of its methods."""

    def __init__(self, w: LoopWriter, program: Program, sources: Sequence[Source], *, on_rings: bool) -> None:
        self.w = w
        self.program = program
        *self._sources, self._of_the_bars = sources
        #: The inputs of the program that are no arrays: the displacement, and the opening of a ring.
        self._computed = 2 if on_rings else 1
        given = len(self._sources)
        self._bars, self._first, self._last, self._tolerance, self._rounding = range(given, given + 5)
        self._rings = RingWriter(w, given + 5, 7) if on_rings else None
        #: Number of arrays that are read.
        self.inputs = given + 5 + on_rings

    def begin_vector(self) -> _Forces:
        """The head of the loop over vectors of chains."""
        w = self.w
        w.lines += ["  %last_link = sub i64 %row_stop, 1", "  br label %vector", "vector:"]
        w.phi("%column", "i64", ("0", "entry"), ("%next_column", "vector_done"))
        of_springs = {
            i + self._computed: w.load(f"%input{i}", "%column")
            for i, source in enumerate(self._sources)
            if source == "columns"
        }
        first, last, allowed = (w.load(f"%input{i}", "%column") for i in (self._first, self._last, self._tolerance))
        of_bars = w.load_one(f"%input{self._rounding}", "0")
        if self._rings:
            self._rings.before_steps()
        return _Forces(of_springs, first, last, allowed, of_bars)

    def begin_step(self) -> _StepBefore:
        """The head of the loop over the steps of Newton's method."""
        w = self.w
        w.lines += ["  br label %newton", "newton:"]
        w.phi("%step", "i64", ("0", "vector"), ("%next_step", "backward_done"))
        size = w.phi("%before", w.doubles, (_INFINITY, "vector"), ("%size", "backward_done"))
        open_ = w.phi("%open", w.masks, (_YES, "vector"), ("%still", "backward_done"))
        given_up = w.phi("%given_up", w.masks, (_NO, "vector"), ("%gives_up", "backward_done"))
        if self._rings:
            self._rings.before_links()
        return _StepBefore(size, open_, given_up, w.load("%output0", "%column"))

    def walk_forward(self, forces: _Forces, start: Value) -> None:
        """The loop over the links through forces, slopes, and the elimination of the matrix."""
        w = self.w
        before = self._begin_link(start)
        spring = self._spring(forces, before.x)
        force, slope = (spring.as_number(self.program.outputs[name]) for name in ("force", "slope"))
        x_next, bar_next = self._next_link(before.x)
        left = self._left_at_link(forces, before, force)
        share = w.exact("fdiv", before.bar, w.exact("fadd", before.bar, before.pivot))
        w.named("%behind_next", w.exact("fadd", slope, w.exact("fmul", share, before.pivot)))
        w.named("%carried_next", w.exact("fadd", left, w.exact("fmul", share, before.carried)))
        w.lines.append(f"  %in_scratch = mul i64 %link, {w.lanes}")
        w.store(Value("%behind_next"), "%output5", "%in_scratch")
        w.store(Value("%carried_next"), "%output6", "%in_scratch")
        w.named("%squares_next", w.exact("fadd", before.squares, w.exact("fmul", left, left)))
        if self._rings:
            below = self._divisor(bar_next, Value("%behind_next"))
            pushes = {name: spring.as_number(step) for name, step in self.program.outputs.items()}
            self._rings.end_link(pushes, share, Value("%carried_next"), below)
        pull = w.intrinsic("fabs", w.exact("fmul", bar_next, x_next))
        w.named("%most_next", w.choose(w.compare("ogt", pull, before.most), pull, before.most))
        w.named("%force_next", w.exact("fadd", before.force, force))
        w.named("%slope_next", w.exact("fadd", before.slope, slope))
        w.lines.append("  %more_links = icmp slt i64 %next_link, %row_stop")
        w.lines += ["  br i1 %more_links, label %forward, label %forward_done", "forward_done:"]

    def _begin_link(self, start: Value) -> _LinkBefore:
        """The head of the loop over the links, with the places of a link in the arrays."""
        w = self.w
        w.lines += ["  br label %forward", "forward:"]
        w.phi("%link", "i64", ("0", "newton"), ("%next_link", "forward"))
        begins = {
            "x": start, "behind": _ONE, "carried": _ZERO, "bar": _ZERO, "passed": _ZERO,
            "squares": _ZERO, "most": _ZERO, "force": _ZERO, "slope": _ZERO,
        }  # fmt: skip
        phis = [
            w.phi(f"%{name}", w.doubles, (first, "newton"), (f"%{name}_next", "forward"))
            for name, first in begins.items()
        ]
        if self._rings:
            self._rings.begin_link()
        w.lines.append("  %next_link = add i64 %link, 1")
        w.lines.append("  %row_place = mul i64 %link, %columns")
        w.lines.append("  %place = add i64 %row_place, %column")
        w.lines.append("  %place_next = add i64 %place, %columns")
        return _LinkBefore(*phis)

    def _spring(self, forces: _Forces, x: Value) -> StepEmitter:
        """The spring of a link: the program, with what it reads there."""
        w, values = self.w, {**forces.of_springs, 0: x}
        if self._rings:
            values[1] = self._rings.opening_of_link()
        for i, source in enumerate(self._sources, start=self._computed):
            array = f"%input{i - self._computed}"
            if source == "rows":
                values[i] = w.load_one(array, "%link")
            elif source == "points":
                values[i] = w.load(array, "%place")
        return StepEmitter(w, self.program, values)

    def _next_link(self, x: Value) -> tuple[Value, Value]:
        """The displacement of the next link and the stiffness of the bar to it, whose force it gets."""
        w, x_next, bar_next = self.w, Value("%x_next"), Value("%bar_next")
        w.named("%x_next", w.load("%output0", "%place_next"))
        w.named("%bar_next", self._bar("%link", "%place"))
        w.named("%passed_next", w.exact("fmul", bar_next, w.exact("fsub", x_next, x)))
        return x_next, bar_next

    def _left_at_link(self, forces: _Forces, before: _LinkBefore, of_spring: Value) -> Value:
        """Remainder of the balance of a link: of what enters, its spring, and the bars on both sides."""
        w = self.w
        w.lines.append("  %is_first = icmp eq i64 %link, 0")
        w.lines.append("  %is_last = icmp eq i64 %link, %last_link")
        left = w.exact("fsub", _ZERO, of_spring)
        for flag, enters in (("%is_first", forces.first), ("%is_last", forces.last)):
            added = w.exact("fadd", left, enters)
            left = w.instruction(f"select i1 {flag}, {w.doubles} {added}, {w.doubles} {left}")
        return w.exact("fsub", w.exact("fadd", left, Value("%passed_next")), before.passed)

    def judge_step(self, forces: _Forces, before: _StepBefore) -> _Imbalance:
        """The imbalance of the chains, and which are open still; the way on if any is and may step."""
        w = self.w
        squares, rounded = Value("%squares_next"), Value("%most_next")
        if self._rings:
            squares = self._rings.after_links(squares)
            rounded = w.exact("fadd", rounded, self._rings.pushed)
        w.named("%size", w.intrinsic("sqrt", squares))
        imbalance = _Imbalance(Value("%size"), rounded)
        self._judge_chains(forces, before, imbalance)
        if self._rings:
            self._rings.move(Value("%still"))
        bits = w.instruction(f"bitcast {w.masks} %still to i{w.lanes}")
        any_open = w.instruction(f"icmp ne i{w.lanes} {bits}, 0")
        w.lines.append("  %next_step = add i64 %step, 1")
        w.lines.append("  %may_step = icmp slt i64 %step, %tile")
        goes_on = w.instruction(f"and i1 {any_open}, %may_step")
        w.lines.append(f"  br i1 {goes_on}, label %backward, label %vector_done")
        return imbalance

    def _judge_chains(self, forces: _Forces, before: _StepBefore, imbalance: _Imbalance) -> None:
        """``%gives_up`` where a full step has made a chain worse, and ``%still`` where one goes on."""
        w, size = self.w, imbalance.size
        limit = w.exact("fadd", forces.allowed, w.exact("fmul", forces.of_bars, imbalance.rounded))
        not_worse = w.compare("olt", size, before.size)
        still = w.compare("ogt", size, limit)
        if self._rings:
            not_worse = w.on_masks("or", not_worse, w.compare("ole", size, limit))
            still = w.on_masks("or", still, self._rings.are_open(forces.allowed, forces.of_bars))
        worse = w.on_masks("and", before.open_, w.on_masks("xor", not_worse, _YES))
        began = w.instruction("icmp sgt i64 %step, 0")
        worse = w.instruction(f"select i1 {began}, {w.masks} {worse}, {w.masks} {_NO}")
        w.named_mask("%gives_up", w.on_masks("or", before.given_up, worse))
        still = w.on_masks("and", before.open_, still)
        w.named_mask("%still", w.on_masks("and", still, w.on_masks("xor", Value("%gives_up"), _YES)))

    def walk_backward(self) -> None:
        """The loop over the links, last to first, through the displacements."""
        w = self.w
        w.lines.append("backward:")
        w.phi("%back", "i64", ("%last_link", "forward_done"), ("%next_back", "backward"))
        moved_behind = w.phi("%moved", w.doubles, (_ZERO, "forward_done"), ("%moved_next", "backward"))
        w.lines.append("  %back_row = mul i64 %back, %columns")
        w.lines.append("  %back_place = add i64 %back_row, %column")
        w.lines.append(f"  %back_scratch = mul i64 %back, {w.lanes}")
        pivot, carried = w.load("%output5", "%back_scratch"), w.load("%output6", "%back_scratch")
        if self._rings:
            carried = self._rings.carried_back(carried)
        bar = self._bar("%back", "%back_place")
        below = self._divisor(bar, pivot)
        above = w.exact("fadd", carried, w.exact("fmul", bar, moved_behind))
        w.named("%moved_next", w.exact("fdiv", above, below))
        there = w.load("%output0", "%back_place")
        there = w.choose(Value("%still"), w.exact("fadd", there, Value("%moved_next")), there)
        w.store(there, "%output0", "%back_place")
        w.lines.append("  %next_back = sub i64 %back, 1")
        w.lines.append("  %more_back = icmp sge i64 %next_back, 0")
        w.lines += ["  br i1 %more_back, label %backward, label %backward_done", "backward_done:"]
        w.lines.append("  br label %newton")

    def end_vector(self, forces: _Forces, imbalance: _Imbalance) -> None:
        """The stores of what was found of a vector of chains, and the ends of the loops."""
        w = self.w
        w.lines.append("vector_done:")
        unsettled = w.on_masks("or", Value("%gives_up"), Value("%still"))
        w.store(w.instruction(f"uitofp {w.masks} {unsettled} to {w.doubles}"), "%output1", "%column")
        w.store(Value("%force_next"), "%output2", "%column")
        w.store(Value("%slope_next"), "%output3", "%column")
        beyond = w.exact("fsub", imbalance.size, w.exact("fmul", forces.of_bars, imbalance.rounded))
        w.store(w.choose(w.compare("ult", beyond, _ZERO), _ZERO, beyond), "%output4", "%column")
        if self._rings:
            self._rings.store()
        w.lines.append(f"  %next_column = add i64 %column, {w.lanes}")
        w.lines.append("  %more_columns = icmp slt i64 %next_column, %column_stop")
        w.lines += ["  br i1 %more_columns, label %vector, label %done", "done:", "  ret void"]

    def _bar(self, link: str, place: str) -> Value:
        """Stiffness of the bar behind a link."""
        array = f"%input{self._bars}"
        return self.w.load(array, place) if self._of_the_bars == "points" else self.w.load_one(array, link)

    def _divisor(self, bar: Value, pivot: Value) -> Value:
        """The diagonal of the matrix at a link after the elimination; one where nothing holds the link."""
        below = self.w.exact("fadd", bar, pivot)
        return self.w.choose(self.w.compare("ogt", below, _ZERO), below, _ONE)
