"""LLVM's assembly, written a vector at a time.

A :class:`Writer` collects the instructions of one function. Every value is a vector of ``lanes``
doubles, or of as many truth values; constants are spread over the lanes. Vectors are explicit, so
whether a loop is vectorised is not left to an optimiser that may decide otherwise in silence.

Elementary functions on vectors, as polynomials in LLVM's assembly.

Accurate to a few units in the last place (a power: times the magnitude of its exponent). Calls of a
mathematical library would be made lane by lane. The polynomials are near-minimax; the tests compare them
with high-precision values. Zero, infinity and NaN follow IEEE 754. A logarithm takes a subnormal number for
zero, and an exponential below 3e-308 is zero; sines are accurate up to a million radians.
"""

from __future__ import annotations

import math
import struct
import sys
from collections.abc import Callable, Sequence
from typing import NewType

#: The name or the constant that stands for a vector in the assembly.
Value = NewType("Value", str)


def constant(number: float) -> Value:
    """A number in every lane, to the last bit."""
    return Value(f"splat (double 0x{struct.unpack('<Q', struct.pack('<d', number))[0]:016X})")


def integer(number: int) -> Value:
    """A 64-bit integer in every lane."""
    return Value(f"splat (i64 {number})")


class Writer:
    """The instructions of one function, in order."""

    def __init__(self, lanes: int) -> None:
        self.lanes = lanes
        self.lines: list[str] = []
        self._names = 0
        self.doubles, self.integers, self.masks = (f"<{lanes} x {kind}>" for kind in ("double", "i64", "i1"))

    def new_name(self) -> Value:
        """A new name."""
        self._names += 1
        return Value(f"%v{self._names}")

    def instruction(self, text: str) -> Value:
        """Write ``name = text``."""
        name = self.new_name()
        self.lines.append(f"  {name} = {text}")
        return name

    def arithmetic(self, operation: str, left: Value, right: Value) -> Value:
        """``fadd``, ``fsub``, ``fmul``, ``fdiv``; sums of products may be fused into one rounding."""
        return self.instruction(f"{operation} contract {self.doubles} {left}, {right}")

    def exact(self, operation: str, left: Value, right: Value) -> Value:
        """An operation that must round by itself, where polynomials count on it."""
        return self.instruction(f"{operation} {self.doubles} {left}, {right}")

    def on_integers(self, operation: str, left: Value, right: Value) -> Value:
        """``add``, ``sub``, ``shl``, ``ashr``, ``and``, … of integers."""
        return self.instruction(f"{operation} {self.integers} {left}, {right}")

    def on_masks(self, operation: str, left: Value, right: Value) -> Value:
        """``and``, ``or``, ``xor`` of truth values."""
        return self.instruction(f"{operation} {self.masks} {left}, {right}")

    def multiply_add(self, factor: Value, other: Value, addend: Value) -> Value:
        """``factor · other + addend``, in one rounding where the machine can."""
        return self.intrinsic("fmuladd", factor, other, addend)

    def intrinsic(self, name: str, *operands: Value) -> Value:
        """A function of LLVM's own, from doubles to doubles."""
        listed = ", ".join(f"{self.doubles} {operand}" for operand in operands)
        return self.instruction(f"call {self.doubles} @llvm.{name}.v{self.lanes}f64({listed})")

    def call(self, function: str, *operands: Value) -> Value:
        """A function of this module, from doubles to doubles."""
        listed = ", ".join(f"{self.doubles} {operand}" for operand in operands)
        return self.instruction(f"call {self.doubles} @{function}({listed})")

    def compare(self, relation: str, left: Value, right: Value) -> Value:
        """A mask: ``oeq``, ``olt``, … as LLVM spells them."""
        return self.instruction(f"fcmp {relation} {self.doubles} {left}, {right}")

    def choose(self, mask: Value, yes: Value, no: Value) -> Value:
        """``yes`` where the mask holds, else ``no``."""
        return self.instruction(f"select {self.masks} {mask}, {self.doubles} {yes}, {self.doubles} {no}")

    def bits(self, value: Value) -> Value:
        """The bits of doubles as integers."""
        return self.instruction(f"bitcast {self.doubles} {value} to {self.integers}")

    def from_bits(self, value: Value) -> Value:
        """Doubles from their bits."""
        return self.instruction(f"bitcast {self.integers} {value} to {self.doubles}")

    def broadcast(self, kind: str, scalar: str) -> Value:
        """A scalar in every lane."""
        vector = f"<{self.lanes} x {kind}>"
        first = self.instruction(f"insertelement {vector} poison, {kind} {scalar}, i64 0")
        return self.instruction(
            f"shufflevector {vector} {first}, {vector} poison, <{self.lanes} x i32> zeroinitializer"
        )

    def polynomial(self, variable: Value, coefficients: Sequence[float]) -> Value:
        """Horner's scheme; the coefficients rise with the power."""
        result = constant(coefficients[-1])
        for coefficient in coefficients[-2::-1]:
            result = self.multiply_add(variable, result, constant(coefficient))
        return result

    def function(self, name: str, arguments: Sequence[Value], result: Value) -> str:
        """The instructions so far as a function that is always inlined."""
        listed = ", ".join(f"{self.doubles} {argument}" for argument in arguments)
        body = "\n".join([*self.lines, f"  ret {self.doubles} {result}"])
        return f"define internal {self.doubles} @{name}({listed}) alwaysinline {{\n{body}\n}}\n"


#: (exp(r) − 1 − r)/r² for |r| ≤ ln 2/2.
EXP = (
    0.5000000000000001, 0.16666666666666669, 0.04166666666662413, 0.008333333333330062, 0.0013888888917213717,
    0.00019841269863053618, 2.4801521295954376e-05, 2.7557268459997064e-06, 2.7620088445409746e-07,
    2.510038549551032e-08,
)  # fmt: skip
#: 2 artanh(s)/s in s², where s = (m − 1)/(m + 1) and m lies between √½ and √2.
LOG = (
    2.0,
    0.666666666666667, 0.39999999999899444, 0.2857142862600327, 0.22222211130259878, 0.18182889455674947,
    0.15331710618210773, 0.14616585424888623,
)  # fmt: skip
#: (arcsin(s) − s)/s³ in s² for s² ≤ ¼.
ARCSIN = (
    0.1666666666666665, 0.07500000000020869, 0.04464285710323956, 0.030381947379559158, 0.022372047201808885,
    0.01735526856395352, 0.013929545950485803, 0.011876344296279416, 0.0077986264075622334, 0.01604912458494932,
    -0.010773195325585556, 0.028187667142318098,
)  # fmt: skip
#: (arctan(s) − s)/s³ in s² for |s| ≤ √2 − 1.
ARCTAN = (
    -0.3333333333333333, 0.19999999999995516, -0.14285714284665682, 0.11111111015187018, -0.0909090457530649,
    0.07692183125376892, -0.06664510525508936, 0.05858140904866328, -0.050854078345894844, 0.03923044778479309,
    -0.019175404711104935,
)  # fmt: skip
#: (sin(s) − s)/s³ in s² for |s| ≤ π/4.
SIN = (
    -0.16666666666666666, 0.008333333333330946, -0.0001984126983675497, 2.755731610068303e-06,
    -2.5051131455427946e-08, 1.591810123027412e-10,
)  # fmt: skip
#: (cos(s) − 1 + s²/2)/s⁴ in s² for |s| ≤ π/4.
COS = (
    0.041666666666666664, -0.0013888888888887395, 2.4801587298763433e-05, -2.7557317270560326e-07,
    2.0876146024689747e-09, -1.1382614868556325e-11,
)  # fmt: skip
#: ln 2 and π/2 in parts: products of the first ones with small whole numbers are exact.
LN2 = (0.6931471803691238, 1.9082149292705877e-10)
HALF_PI = (1.5707963267341256, 6.077100506303966e-11, 2.0222662487959506e-21)

#: Exponents beyond which exp() is infinite or zero: the power of two overflows, or has no bits left.
LARGEST_EXPONENT, SMALLEST_EXPONENT = 710.0, -708.4
#: The bits of √½, about which logarithms count their mantissa.
ROOT_HALF_BITS = 0x3FE6A09E667F3BCD
FRACTION_BITS = 52
EXPONENT_BIAS = 1023
#: A double this large has no places behind the point left; and the bits of 2**52, which has none either.
ROUNDER = 1.5 * 2.0**FRACTION_BITS
INTEGER_BITS = (EXPONENT_BIAS + FRACTION_BITS) << FRACTION_BITS

ZERO, ONE, TWO, HALF = map(constant, (0.0, 1.0, 2.0, 0.5))
NOT_A_NUMBER, INFINITY, MINUS_INFINITY = map(constant, (math.nan, math.inf, -math.inf))

ARGUMENT = Value("%x")
#: The logarithm of a number known not to be negative, without the test of the sign.
LOG_OF_NONNEGATIVE = "log_of_nonnegative"


def _exp(w: Writer, x: Value) -> Value:
    """2**n · exp(r). Adding a large number rounds to n, and leaves the bits of 2**(n − 1) behind."""
    x = w.choose(w.compare("ogt", x, constant(LARGEST_EXPONENT)), constant(LARGEST_EXPONENT), x)
    x = w.choose(w.compare("olt", x, constant(SMALLEST_EXPONENT)), constant(SMALLEST_EXPONENT), x)
    rounded = w.multiply_add(x, constant(1 / math.log(2)), constant(ROUNDER + EXPONENT_BIAS - 1))
    n = w.exact("fsub", rounded, constant(ROUNDER + EXPONENT_BIAS - 1))
    r = _reduce_argument(w, x, n, LN2)
    p = w.multiply_add(w.exact("fmul", r, r), w.polynomial(r, EXP), r)
    twice = w.multiply_add(p, TWO, TWO)
    half_power = w.from_bits(w.on_integers("shl", w.bits(rounded), integer(FRACTION_BITS)))
    return w.exact("fmul", twice, half_power)


def _log(*, nonnegative: bool) -> Callable[[Writer, Value], Value]:
    """The exponent times ln 2, and 2 artanh(s) of the mantissa between √½ and √2."""

    def log(w: Writer, x: Value) -> Value:
        shifted = w.on_integers("sub", w.bits(x), integer(ROOT_HALF_BITS - (EXPONENT_BIAS << FRACTION_BITS)))
        fraction = w.on_integers("and", shifted, integer((1 << FRACTION_BITS) - 1))
        mantissa = w.from_bits(w.on_integers("add", fraction, integer(ROOT_HALF_BITS)))
        exponent = w.on_integers("lshr", shifted, integer(FRACTION_BITS))
        as_double = w.from_bits(w.on_integers("or", exponent, integer(INTEGER_BITS)))
        e = w.exact("fsub", as_double, constant(2.0**FRACTION_BITS + EXPONENT_BIAS))
        s = w.exact("fdiv", w.exact("fsub", mantissa, ONE), w.exact("fadd", mantissa, ONE))
        of_mantissa = w.exact("fmul", s, w.polynomial(w.exact("fmul", s, s), LOG))
        result = w.multiply_add(e, constant(math.log(2)), of_mantissa)
        result = w.choose(w.compare("ugt", x, constant(sys.float_info.max)), x, result)
        below = MINUS_INFINITY
        if not nonnegative:
            below = w.choose(w.compare("olt", x, ZERO), NOT_A_NUMBER, MINUS_INFINITY)
        return w.choose(w.compare("olt", x, constant(sys.float_info.min)), below, result)

    return log


def _reduce_argument(w: Writer, x: Value, n: Value, parts: tuple[float, ...]) -> Value:
    """The argument x − n · (sum of the parts), reduced part by part so that nothing is lost to cancellation."""
    for part in parts:
        x = w.multiply_add(n, constant(-part), x)
    return x


def _sine_shifted(quarters: int) -> Callable[[Writer, Value], Value]:
    """sin(x + quarters · π/2)."""

    def sine(w: Writer, x: Value) -> Value:
        n = w.intrinsic("roundeven", w.exact("fmul", x, constant(2 / math.pi)))
        r = _reduce_argument(w, x, n, HALF_PI)
        z = w.exact("fmul", r, r)
        sine = w.multiply_add(w.exact("fmul", r, z), w.polynomial(z, SIN), r)
        cosine = w.multiply_add(z, constant(-0.5), ONE)
        cosine = w.multiply_add(w.exact("fmul", z, z), w.polynomial(z, COS), cosine)
        # the quadrant, from an integer held as a double
        turn = w.exact("fadd", n, constant(float(quarters)))
        half = w.intrinsic("floor", w.exact("fmul", turn, HALF))
        odd = w.compare("one", w.exact("fmul", half, TWO), turn)
        result = w.choose(odd, cosine, sine)
        whole_turn = w.intrinsic("floor", w.exact("fmul", half, HALF))
        negative = w.compare("one", w.exact("fmul", whole_turn, TWO), half)
        return w.choose(negative, w.exact("fsub", constant(-0.0), result), result)

    return sine


def _arcsin(w: Writer, x: Value) -> Value:
    """A polynomial up to one half; beyond, π/2 − 2 arcsin √((1 − x)/2)."""
    size = w.intrinsic("fabs", x)
    steep = w.compare("ogt", size, HALF)
    folded = w.exact("fmul", w.exact("fsub", ONE, size), HALF)
    z = w.choose(steep, folded, w.exact("fmul", x, x))
    s = w.choose(steep, w.intrinsic("sqrt", folded), size)
    p = w.multiply_add(w.exact("fmul", s, z), w.polynomial(z, ARCSIN), s)
    # π/2 = c1 + c2, with c1 its double
    from_top = w.exact(
        "fsub", constant(math.pi / 2), w.exact("fsub", w.exact("fmul", p, TWO), constant(6.123233995736766e-17))
    )
    return w.intrinsic("copysign", w.choose(steep, from_top, p), x)


def _arctan(w: Writer, x: Value) -> Value:
    """A polynomial up to √2 − 1; beyond, a half or a quarter of π and the rest of the way."""
    size = w.intrinsic("fabs", x)
    far, middle = w.compare("ogt", size, constant(1 + math.sqrt(2))), w.compare("ogt", size, constant(math.sqrt(2) - 1))
    numerator = w.choose(far, constant(-1.0), w.choose(middle, w.exact("fsub", size, ONE), size))
    denominator = w.choose(far, size, w.choose(middle, w.exact("fadd", size, ONE), ONE))
    start = w.choose(far, constant(math.pi / 2), w.choose(middle, constant(math.pi / 4), ZERO))
    s = w.exact("fdiv", numerator, denominator)
    z = w.exact("fmul", s, s)
    p = w.multiply_add(w.exact("fmul", s, z), w.polynomial(z, ARCTAN), s)
    return w.intrinsic("copysign", w.exact("fadd", start, p), x)


def _tan(w: Writer, x: Value) -> Value:
    return w.exact("fdiv", w.call("sin", x), w.call("cos", x))


def _arccos(w: Writer, x: Value) -> Value:
    half = w.call("arcsin", w.intrinsic("sqrt", w.exact("fmul", w.exact("fsub", ONE, x), HALF)))
    return w.exact("fadd", half, half)


def _log1p(w: Writer, x: Value) -> Value:
    """log(u) · x/(u − 1) with u = 1 + x as it is rounded: the rounding of u cancels."""
    u = w.exact("fadd", ONE, x)
    change = w.exact("fsub", u, ONE)
    nothing = w.compare("oeq", change, ZERO)
    large = w.compare("ogt", w.intrinsic("fabs", x), constant(1e16))
    scaled = w.exact("fmul", w.call("log", u), w.exact("fdiv", x, w.choose(nothing, ONE, change)))
    return w.choose(nothing, x, w.choose(large, w.call("log", u), scaled))


def _expm1(w: Writer, x: Value) -> Value:
    """(u − 1) · x/log(u) with u = exp(x) as it is rounded; far from zero, u − 1."""
    u = w.call("exp", x)
    change, logarithm = w.exact("fsub", u, ONE), w.call("log", u)
    nothing = w.compare("oeq", logarithm, ZERO)
    near = w.compare("olt", w.intrinsic("fabs", x), ONE)
    scaled = w.exact("fmul", change, w.exact("fdiv", x, w.choose(nothing, ONE, logarithm)))
    return w.choose(nothing, x, w.choose(near, scaled, change))


def _arcsinh(w: Writer, x: Value) -> Value:
    """log1p(x + x²/(1 + √(1 + x²))) of the size, with the sign."""
    size = w.intrinsic("fabs", x)
    square = w.exact("fmul", size, size)
    root = w.intrinsic("sqrt", w.exact("fadd", ONE, square))
    more = w.exact("fdiv", square, w.exact("fadd", ONE, root))
    near = w.call("log1p", w.exact("fadd", size, more))
    far = w.exact("fadd", w.call("log", size), constant(math.log(2)))
    return w.intrinsic("copysign", w.choose(w.compare("ogt", size, constant(1e150)), far, near), x)


def _power(w: Writer, x: Value, y: Value) -> Value:
    """exp(y log |x|); a negative base has a sign for whole exponents and is NaN for others."""
    size = w.intrinsic("fabs", x)
    result = w.call("exp", w.exact("fmul", y, w.call("log", size)))
    half = w.exact("fmul", y, HALF)
    odd = w.compare("one", w.intrinsic("floor", half), half)
    signed = w.choose(odd, w.exact("fsub", constant(-0.0), result), result)
    broken = w.compare("one", w.intrinsic("floor", y), y)
    negative = w.choose(broken, NOT_A_NUMBER, signed)
    result = w.choose(w.compare("olt", x, ZERO), negative, result)
    trivial = w.on_masks("or", w.compare("oeq", y, ZERO), w.compare("oeq", x, ONE))
    return w.choose(trivial, ONE, result)


#: Each function after those it calls.
_ONE_ARGUMENT: dict[str, Callable[[Writer, Value], Value]] = {
    "exp": _exp,
    "log": _log(nonnegative=False),
    LOG_OF_NONNEGATIVE: _log(nonnegative=True),
    "sin": _sine_shifted(0),
    "cos": _sine_shifted(1),
    "tan": _tan,
    "arcsin": _arcsin,
    "arccos": _arccos,
    "arctan": _arctan,
    "log1p": _log1p,
    "expm1": _expm1,
    "arcsinh": _arcsinh,
}
NAMES = (*_ONE_ARGUMENT, "power")


def definitions(lanes: int) -> str:
    """All functions as text of a module; the compiler drops those that are not called."""
    text: list[str] = []
    for name, body in _ONE_ARGUMENT.items():
        writer = Writer(lanes)
        text.append(writer.function(name, [ARGUMENT], body(writer, ARGUMENT)))
    writer, exponent = Writer(lanes), Value("%y")
    text.append(writer.function("power", [ARGUMENT, exponent], _power(writer, ARGUMENT, exponent)))
    return "\n".join(text)
