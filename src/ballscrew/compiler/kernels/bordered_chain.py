"""Chains whose links push rings open: what that adds to the kernel of a chain.

A Newton step of a chain with an opening for each of two rings has a matrix with two columns more. Its tridiagonal part
is eliminated as without them. Where that has come through with a right side and with the columns, the sums of their
products over the pivots are the small matrix of the openings, and what is left for them; so nothing is walked twice.
"""

from __future__ import annotations

from collections.abc import Mapping

from ballscrew.compiler.kernels.ir import Value, Writer, constant


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
        """What is the same in all steps of a vector."""
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
        """Where a ring is out of balance by itself: what stiff bars make of rounded places would hide that."""
        w = self.w
        limit = w.exact("fadd", tolerance, w.exact("fmul", rounding, self.pushed))
        return w.on_masks("or", *(w.compare("ogt", left, limit) for left in self._left))

    def move(self, still: Value) -> None:
        """Take the step of the openings where a chain is still open."""
        for ring in (0, 1):
            w, before = self.w, self._opening[ring]
            w.named(f"%opening{ring}_next", w.choose(still, w.exact("fadd", before, self._step[ring]), before))

    def carried_back(self, carried: Value) -> Value:
        """What the links hand on with the step of the openings."""
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
