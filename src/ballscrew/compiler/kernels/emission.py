"""A program as a kernel in LLVM's assembly: one fused loop over the points of a rectangle of a grid.

A result goes to place ``row · columns + column`` of its array; points without a grid are one row. An input is an array
over the points or over the columns, or one number for each row; or it has a stride, 1 or 0, that stands behind the
table of the addresses: an input of stride 0 is a vector that is read again at all points. Rows are walked through a
tile of columns at a time, so that what is read of the columns stays in the cache. The last points of a row run through
the same instructions as all others, with room to spare, so that a point's result does not depend on where blocks begin
and end.
"""

from __future__ import annotations

import dataclasses
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.compiler.kernels import ir
from ballscrew.compiler.kernels.ir import Value, Writer, constant
from ballscrew.compiler.tracing.program import Program, Source
from ballscrew.compiler.tracing.tape import Operand, Step, choose

#: Steps of a piece: of four thousand, a compiler needs a tenth of the time for each that it needs of forty thousand.
STEPS = 3000

#: Emits the steps of a program: writer, program and the values of its inputs; returns values by their number.
Emit = Callable[[Writer, Program, dict[int, Value]], Mapping[int, Value]]


@dataclasses.dataclass(frozen=True)
class Pieces:
    """The functions of the pieces as text, and where each value has its place in the table."""

    functions: str
    count: int
    places: Mapping[int, int]

    def write(self, w: Writer, inputs: Mapping[int, Value], wanted: Iterable[int]) -> dict[int, Value]:
        """Emit the stores of the inputs, the calls of the pieces, and the loads of what is wanted."""
        for i, value in inputs.items():
            if i in self.places:
                _store(w, self.places[i], value)
        for k in range(self.count):
            w.lines.append(f"  call void @piece{k}(ptr %table)")
        return {i: _load(w, self.places[i]) for i in dict.fromkeys(wanted)}

    def table(self, w: Writer) -> list[str]:
        """The room for the table."""
        return [f"  %table = alloca [{max(len(self.places), 1)} x {w.doubles}], align 64"]


def pieces_of(program: Program, lanes: int, emit: Emit) -> Pieces:
    """A program in pieces of :data:`STEPS` steps."""
    chunks = [program.steps[k : k + STEPS] for k in range(0, len(program.steps), STEPS)]
    places = _places(program, chunks)
    texts = [_function(program, k, chunk, places, lanes, emit) for k, chunk in enumerate(chunks)]
    return Pieces("\n".join(texts), len(chunks), places)


def _places(program: Program, chunks: list[tuple[tuple[int, Step], ...]]) -> dict[int, int]:
    """A place for each step that a piece reads from before it, and for each output; a truth is a number."""
    crossing = set(program.outputs.values())
    for chunk in chunks:
        here = {i for i, _ in chunk}
        crossing |= {o for _, step in chunk for o in step.read if o not in here}
    return {i: place for place, i in enumerate(sorted(crossing))}


def _function(
    program: Program,
    number: int,
    chunk: tuple[tuple[int, Step], ...],
    places: Mapping[int, int],
    lanes: int,
    emit: Emit,
) -> str:
    w = Writer(lanes)
    here = {i for i, _ in chunk}
    read = dict.fromkeys(o for _, step in chunk for o in step.read if o not in here)
    result = emit(w, dataclasses.replace(program, steps=chunk), {i: _load(w, places[i]) for i in read})
    for i, step in chunk:
        if i in places:
            value = result[i]
            if step.is_mask:
                value = w.instruction(f"uitofp {w.masks} {value} to {w.doubles}")
            _store(w, places[i], value)
    body = "\n".join([*w.lines, "  ret void"])
    return f"define internal void @piece{number}(ptr noalias %table) noinline {{\n{body}\n}}\n"


def _load(w: Writer, place: int) -> Value:
    address = w.instruction(f"getelementptr {w.doubles}, ptr %table, i64 {place}")
    return w.instruction(f"load {w.doubles}, ptr {address}, align 16")


def _store(w: Writer, place: int, value: Value) -> None:
    address = w.instruction(f"getelementptr {w.doubles}, ptr %table, i64 {place}")
    w.lines.append(f"  store {w.doubles} {value}, ptr {address}, align 16")


#: Lanes of a vector, for programs of at most so many steps: a short program waits for its longest chain of
#: operations, and many lanes keep the machine busy meanwhile; a long one runs out of registers and takes long to
#: compile.
LANES = ((1000, 32), (20_000, 16))
FEWEST_LANES = 8
#: A short program with more inputs than this runs out of cache lines, and has half as many lanes.
FEW_INPUTS = 12

_ARITHMETIC = {np.add: "fadd", np.subtract: "fsub", np.multiply: "fmul", np.divide: "fdiv"}
_RELATIONS = {
    np.equal: "oeq", np.not_equal: "une", np.less: "olt", np.less_equal: "ole", np.greater: "ogt",
    np.greater_equal: "oge",
}  # fmt: skip
_ON_MASKS = {
    np.bitwise_and: "and", np.bitwise_or: "or", np.bitwise_xor: "xor",
    np.logical_and: "and", np.logical_or: "or", np.logical_xor: "xor",
}  # fmt: skip
_EXTREMES = {np.maximum: "ogt", np.minimum: "olt"}
_NOT = {np.invert, np.logical_not}
#: How the absolute value compares with infinity; that of a NaN does not even with itself.
_TO_INFINITY = {np.isnan: "uno", np.isfinite: "olt", np.isinf: "oeq"}
_INTRINSICS = {np.sqrt: "sqrt", np.absolute: "fabs", np.floor: "floor", np.ceil: "ceil"}
_TRUE, _ZERO, _ONE = Value("splat (i1 true)"), constant(0.0), constant(1.0)

SIGNATURE = (
    "i64 %row_start, i64 %row_stop, i64 %column_start, i64 %column_stop, i64 %columns, i64 %tile, "
    "i1 %stream, ptr noalias %inputs, ptr noalias %outputs"
)


class UnknownOperationError(Exception):
    """An operation of a program that kernels do not have; the program is then run by NumPy."""


def lanes_for(program: Program) -> int:
    """The number of points in a vector."""
    lanes = next((lanes for steps, lanes in LANES if len(program.steps) <= steps), FEWEST_LANES)
    is_short = len(program.steps) <= LANES[0][0]
    return lanes // 2 if is_short and program.inputs > FEW_INPUTS else lanes


def kernel_text(
    program: Program,
    sources: Sequence[Source],
    masks: Mapping[str, bool],
    *,
    lanes: int | None = None,
    watched: bool = False,
    reduced: Mapping[str, Any] | None = None,
    in_pieces: bool = False,
) -> str:
    """The module with the kernel of a program.

    ``sources`` has the origin of the values of each input, ``masks`` whether the array of each output
    holds truth values. A ``watched`` kernel has one more output, the ends of what it reads, so that inputs need not be
    read twice to be checked: for each input over points :data:`ENDS_OF_EACH` vectors of integers, the least and the
    greatest bits by lane over all whole vectors. Outputs that are ``reduced``, by ``numpy.sum`` or ``numpy.max`` over
    the rows, have a place for each column, and room for a vector more. A long program ``in_pieces`` is sooner compiled
    (:mod:`ballscrew.compiler.kernels.emission`). Raises :class:`UnknownOperationError`.
    """
    w = Writer(lanes or lanes_for(program))
    seen = [i for i, source in enumerate(sources) if source == "points"] if watched else []
    values = dict(enumerate(_emit_loops_and_loads(w, sources, seen)))
    is_long = in_pieces and len(program.steps) > STEPS
    parts = pieces_of(program, w.lanes, _steps) if is_long else None
    if parts is not None:
        values, program = parts.write(w, values, program.outputs.values()), dataclasses.replace(program, steps=())
    emitter = StepEmitter(w, program, values)
    results = [
        (j, name, emitter.as_mask(i) if masks[name] else emitter.as_number(i))
        for j, (name, i) in enumerate(program.outputs.items())
    ]
    reduced = reduced or {}
    for j, name, result in results:
        if name in reduced:
            _emit_reduction(w, j, reduced[name], result)
    whole = [_stored(w, j, result, masks[name]) for j, name, result in results if name not in reduced]
    _emit_stores_and_loop_ends(w, whole)
    lines = [*w.lines, *_emit_ends(w, seen, len(program.outputs)), "  ret void"]
    return "\n".join(
        [
            ir.definitions(w.lanes),
            *([] if parts is None else [parts.functions]),
            f"define void @kernel({SIGNATURE}) {{",
            "entry:",
            f"  %spare = alloca {w.doubles}, align 64",
            f"  store {w.doubles} zeroinitializer, ptr %spare",
            *([] if parts is None else parts.table(w)),
            *pointers("input", len(sources)),
            *pointers("output", len(program.outputs)),
            *_strides(sources),
            *(line for i in seen for line in _ends_of_nothing(w, i)),
            *lines,
            "}",
            "declare void @llvm.memcpy.p0.p0.i64(ptr, ptr, i64, i1)",
            "!0 = !{i32 1}",
            "",
        ]
    )


def _steps(w: Writer, program: Program, values: dict[int, Value]) -> Mapping[int, Value]:
    return StepEmitter(w, program, values).values


def pointers(name: str, count: int) -> list[str]:
    """The arrays behind the table of their addresses: ``%input0``, ``%input1``, …"""
    lines: list[str] = []
    for i in range(count):
        lines.append(f"  %{name}_entry{i} = getelementptr ptr, ptr %{name}s, i64 {i}")
        lines.append(f"  %{name}{i} = load ptr, ptr %{name}_entry{i}")
    return lines


def _strides(sources: Sequence[Source]) -> list[str]:
    """The strides behind the table of the addresses of the inputs: ``%stride0``, ``%stride1``, …"""
    lines: list[str] = []
    for i, source in enumerate(sources):
        if source == "strided":
            lines.append(f"  %stride_entry{i} = getelementptr i64, ptr %inputs, i64 {len(sources) + i}")
            lines.append(f"  %stride{i} = load i64, ptr %stride_entry{i}")
    return lines


#: What a watched kernel finds of each input: a name, the comparison, and the bits to begin with, those of ∞ and 0.
_ENDS = (("least", "slt", 0x7FF0000000000000), ("greatest", "sgt", 0))
ENDS_OF_EACH = len(_ENDS)


def _ends_of_nothing(w: Writer, i: int) -> list[str]:
    lines: list[str] = []
    for name, _, start in _ENDS:
        lines.append(f"  %{name}{i} = alloca {w.integers}, align 64")
        lines.append(f"  store {w.integers} splat (i64 {start}), ptr %{name}{i}")
    return lines


def _emit_watch(w: Writer, i: int, value: Value) -> None:
    """Emit the comparison of a vector with the ends so far, as integers, in the order of numbers of positive sign."""
    bits = w.bits(value)
    for name, relation, _ in _ENDS:
        before = w.instruction(f"load {w.integers}, ptr %{name}{i}")
        is_beyond = w.instruction(f"icmp {relation} {w.integers} {bits}, {before}")
        after = w.instruction(f"select {w.masks} {is_beyond}, {w.integers} {bits}, {w.integers} {before}")
        w.lines.append(f"  store {w.integers} {after}, ptr %{name}{i}")


def _emit_ends(w: Writer, seen: Sequence[int], outputs: int) -> list[str]:
    """The stores of the ends, when all is done."""
    lines = [f"  %ends_entry = getelementptr ptr, ptr %outputs, i64 {outputs}", "  %ends = load ptr, ptr %ends_entry"]
    places = [
        (f"%{name}{i}", w.lanes * (ENDS_OF_EACH * k + j))
        for k, i in enumerate(seen)
        for j, (name, _, _) in enumerate(_ENDS)
    ]
    for k, (name, place) in enumerate(places):
        lines.append(f"  %end{k} = load {w.integers}, ptr {name}")
        lines.append(f"  %to_end{k} = getelementptr i64, ptr %ends, i64 {place}")
        lines.append(f"  store {w.integers} %end{k}, ptr %to_end{k}, align 8")
    return lines if seen else []


def _emit_loops_and_loads(w: Writer, sources: Sequence[Source], seen: Sequence[int]) -> list[Value]:
    """Emit the heads of the loops over tiles, rows and points; return the inputs at the points of a vector."""
    values: dict[int, Value] = {}
    w.lines += ["  br label %tile_loop", "tile_loop:"]
    w.lines.append("  %tile_start = phi i64 [ %column_start, %entry ], [ %next_tile, %tile_done ]")
    w.lines.append("  %next_tile = add i64 %tile_start, %tile")
    w.lines.append("  %is_last_tile = icmp sge i64 %next_tile, %column_stop")
    w.lines.append("  %tile_stop = select i1 %is_last_tile, i64 %column_stop, i64 %next_tile")
    w.lines += ["  br label %row_loop", "row_loop:"]
    w.lines.append("  %row = phi i64 [ %row_start, %tile_loop ], [ %next_row, %row_done ]")
    w.lines.append("  %first_place = mul i64 %row, %columns")
    for i, source in enumerate(sources):
        if source == "rows":
            address = w.instruction(f"getelementptr double, ptr %input{i}, i64 %row")
            values[i] = w.broadcast("double", w.instruction(f"load double, ptr {address}"))
    w.lines += ["  br label %point_loop", "point_loop:"]
    w.lines.append("  %column = phi i64 [ %tile_start, %row_loop ], [ %next_column, %points_done ]")
    w.lines.append("  %place = add i64 %first_place, %column")
    w.lines.append("  %points_left = sub i64 %tile_stop, %column")
    w.lines.append(f"  %is_full = icmp sge i64 %points_left, {w.lanes}")
    w.lines.append("  %bytes_left = shl i64 %points_left, 3")
    from_arrays = {i: "%column" if s == "columns" else "%place" for i, s in enumerate(sources) if s in _ARRAYS}
    for i, source in enumerate(sources):
        if source == "strided":
            from_arrays[i] = str(w.instruction(f"mul i64 %place, %stride{i}"))
    addresses = {i: w.instruction(f"getelementptr double, ptr %input{i}, i64 {at}") for i, at in from_arrays.items()}
    w.lines += ["  br i1 %is_full, label %load_all, label %load_some", "load_all:"]
    whole = {i: w.instruction(f"load {w.doubles}, ptr {address}, align 8") for i, address in addresses.items()}
    for i in seen:
        _emit_watch(w, i, whole[i])
    w.lines += ["  br label %evaluate", "load_some:"]
    some: dict[int, Value] = {}
    for i, address in addresses.items():
        w.lines.append(f"  call void @llvm.memcpy.p0.p0.i64(ptr %spare, ptr {address}, i64 %bytes_left, i1 false)")
        some[i] = w.instruction(f"load {w.doubles}, ptr %spare")
    w.lines += ["  br label %evaluate", "evaluate:"]
    for i in addresses:
        values[i] = w.instruction(f"phi {w.doubles} [ {whole[i]}, %load_all ], [ {some[i]}, %load_some ]")
    return [values[i] for i in range(len(sources))]


#: Sources that are arrays, read a vector at a time.
_ARRAYS = ("points", "columns", "strided")


def _emit_reduction(w: Writer, output: int, function: Any, value: Value) -> None:
    """Emit the sum or the greatest value, NaN if one is, over the rows so far: of the first row the value itself."""
    address = w.instruction(f"getelementptr double, ptr %output{output}, i64 %column")
    before = w.instruction(f"load {w.doubles}, ptr {address}, align 8")
    if function is np.sum:
        instruction = w.exact("fadd", before, value)
    elif function is np.max:
        keeps = w.on_masks("or", w.compare("oge", before, value), w.compare("uno", before, before))
        instruction = w.choose(keeps, before, value)
    else:
        raise UnknownOperationError(function.__name__)
    is_first = w.instruction("icmp eq i64 %row, %row_start")
    instruction = w.instruction(f"select i1 {is_first}, {w.doubles} {value}, {w.doubles} {instruction}")
    w.lines.append(f"  store {w.doubles} {instruction}, ptr {address}, align 8")


@dataclasses.dataclass(frozen=True)
class _Stored:
    """A result as its array holds it: the number of the output, a vector, and whether its elements are bytes."""

    output: int
    value: Value
    is_mask: bool


def _stored(w: Writer, output: int, result: Value, is_mask: bool) -> _Stored:
    """A result as its array holds it; truth values are bytes there."""
    return _Stored(output, w.instruction(f"zext {w.masks} {result} to {_bytes(w)}") if is_mask else result, is_mask)


def _bytes(w: Writer) -> str:
    return f"<{w.lanes} x i8>"


def _emit_stores_and_loop_ends(w: Writer, results: Sequence[_Stored]) -> None:
    """Emit the stores of the results, non-temporal where asked for, and the ends of the loops."""
    addresses = [
        w.instruction(f"getelementptr {'i8' if one.is_mask else 'double'}, ptr %output{one.output}, i64 %place")
        for one in results
    ]
    vectors = [f"{_bytes(w) if one.is_mask else w.doubles} {one.value}" for one in results]
    stores = list(zip(vectors, addresses, [one.is_mask for one in results], strict=True))
    w.lines += ["  br i1 %is_full, label %store_all, label %store_some", "store_all:"]
    w.lines += ["  br i1 %stream, label %store_past_cache, label %store_to_cache", "store_past_cache:"]
    for vector, address, is_mask in stores:
        past = "align 1" if is_mask else "align 64, !nontemporal !0"
        w.lines.append(f"  store {vector}, ptr {address}, {past}")
    w.lines += ["  br label %points_done", "store_to_cache:"]
    for vector, address, is_mask in stores:
        w.lines.append(f"  store {vector}, ptr {address}, align {1 if is_mask else 8}")
    w.lines += ["  br label %points_done", "store_some:"]
    for vector, address, is_mask in stores:
        size = "%points_left" if is_mask else "%bytes_left"
        w.lines.append(f"  store {vector}, ptr %spare")
        w.lines.append(f"  call void @llvm.memcpy.p0.p0.i64(ptr {address}, ptr %spare, i64 {size}, i1 false)")
    w.lines += ["  br label %points_done", "points_done:"]
    w.lines.append(f"  %next_column = add i64 %column, {w.lanes}")
    w.lines.append("  %more_points = icmp slt i64 %next_column, %tile_stop")
    w.lines += ["  br i1 %more_points, label %point_loop, label %row_done", "row_done:"]
    w.lines.append("  %next_row = add i64 %row, 1")
    w.lines.append("  %more_rows = icmp slt i64 %next_row, %row_stop")
    w.lines += ["  br i1 %more_rows, label %row_loop, label %tile_done", "tile_done:"]
    w.lines += ["  br i1 %is_last_tile, label %done, label %tile_loop", "done:"]


class StepEmitter:
    """The steps of a program as instructions.

    What divides several times is inverted once: a vector of quotients takes as long as a dozen products.
    """

    def __init__(self, w: Writer, program: Program, values: dict[int, Value]) -> None:
        self.w = w
        self.values = values
        self.nonnegative = program.nonnegative
        self.is_mask = {i: step.is_mask for i, step in program.steps}
        divisors = [step.operands[1] for _, step in program.steps if step.function is np.divide]
        self.shared = {divisor for divisor, times in Counter(divisors).items() if times > 1}
        self.inverted: dict[tuple[str, Operand], Value] = {}
        for i, step in program.steps:
            self.values[i] = self._emit(step)

    def as_number(self, index: int) -> Value:
        """The value of a step as doubles; truth counts as one."""
        value = self.values[index]
        if not self.is_mask.get(index, False):
            return value
        return self.w.instruction(f"uitofp {self.w.masks} {value} to {self.w.doubles}")

    def as_mask(self, index: int) -> Value:
        """The value of a step as truth values; nonzero is true."""
        value = self.values[index]
        return value if self.is_mask.get(index, False) else self.w.compare("une", value, _ZERO)

    def _number(self, operand: tuple[str, Operand]) -> Value:
        kind, what = operand
        return self.as_number(int(what)) if kind == "step" else constant(float(what))

    def _mask(self, operand: tuple[str, Operand]) -> Value:
        kind, what = operand
        return self.as_mask(int(what)) if kind == "step" else Value(f"splat (i1 {'true' if what else 'false'})")

    def _emit(self, step: Step) -> Value:
        function, operands = step.function, step.operands
        if function is choose:
            return self._choice(step)
        if step.is_mask and (function in _ON_MASKS or function in _NOT):
            return self._of_masks(function, operands)
        if function is np.power and operands[1][0] == "constant":
            return self._power(self._number(operands[0]), float(operands[1][1]))
        numbers = [self._number(operand) for operand in operands]
        if function is np.log and operands[0][1] in self.nonnegative:
            return self.w.call(ir.LOG_OF_NONNEGATIVE, *numbers)
        if function is np.divide and operands[1] in self.shared and operands[0] != operands[1]:
            return self._product_with_inverse(operands[0], operands[1], numbers)
        if function in _ARITHMETIC:
            return self.w.arithmetic(_ARITHMETIC[function], numbers[0], numbers[1])
        if function in _EXTREMES:
            return self._extreme(_EXTREMES[function], operands, numbers)
        return self._of_numbers(function, numbers)

    def _choice(self, step: Step) -> Value:
        w, operands = self.w, step.operands
        if step.is_mask:
            mask, yes, no = map(self._mask, operands)
            return w.instruction(f"select {w.masks} {mask}, {w.masks} {yes}, {w.masks} {no}")
        return w.choose(self._mask(operands[0]), *map(self._number, operands[1:]))

    def _of_masks(self, function: Any, operands: Sequence[tuple[str, Operand]]) -> Value:
        """The result of a function of truth values."""
        if function in _NOT:
            return self.w.on_masks("xor", self._mask(operands[0]), _TRUE)
        return self.w.on_masks(_ON_MASKS[function], *map(self._mask, operands))

    def _of_numbers(self, function: Any, numbers: Sequence[Value]) -> Value:
        """The result of any other function of numbers, whatever step or constant they are."""
        w = self.w
        if function in _RELATIONS:
            return w.compare(_RELATIONS[function], numbers[0], numbers[1])
        if function in _INTRINSICS:
            return w.intrinsic(_INTRINSICS[function], *numbers)
        if function is np.remainder:
            turns = w.intrinsic("floor", w.exact("fdiv", numbers[0], numbers[1]))
            return w.exact("fsub", numbers[0], w.exact("fmul", turns, numbers[1]))
        if function in _TO_INFINITY:
            size = w.intrinsic("fabs", numbers[0])
            return w.compare(_TO_INFINITY[function], size, size if function is np.isnan else ir.INFINITY)
        if function.__name__ in ir.NAMES:
            return w.call(function.__name__, *numbers)
        raise UnknownOperationError(function.__name__)

    def _product_with_inverse(
        self, above: tuple[str, Operand], below: tuple[str, Operand], numbers: Sequence[Value]
    ) -> Value:
        if below not in self.inverted:
            self.inverted[below] = self.w.arithmetic("fdiv", _ONE, numbers[1])
        inverse = self.inverted[below]
        return inverse if above == ("constant", 1.0) else self.w.arithmetic("fmul", numbers[0], inverse)

    def _extreme(self, relation: str, operands: Sequence[tuple[str, Operand]], numbers: list[Value]) -> Value:
        """The larger or smaller of two; NaN if either is."""
        w = self.w
        kept, other = numbers if operands[0][0] == "step" else numbers[::-1]
        result = w.choose(w.compare(relation, other, kept), other, kept)  # keeps a NaN of the first
        if all(kind == "step" for kind, _ in operands):
            result = w.choose(w.compare("uno", other, other), other, result)
        return result

    def _power(self, base: Value, exponent: float) -> Value:
        """A constant power; integer powers are multiplied out."""
        w = self.w
        if exponent == 0.5:
            return w.intrinsic("sqrt", base)
        if exponent != int(exponent):
            return w.call("exp", w.exact("fmul", w.call("log", base), constant(exponent)))
        result, square, left = _ONE, base, int(abs(exponent))
        while left:
            if left % 2:
                result = square if result == _ONE else w.exact("fmul", result, square)
            left //= 2
            square = w.exact("fmul", square, square) if left else square
        return result if exponent >= 0 else w.exact("fdiv", _ONE, result)
