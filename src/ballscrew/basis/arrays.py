"""Arrays: one namespace for many kinds of number, and a blocked map over big ones."""

from __future__ import annotations

import dataclasses
import functools
import math
import numbers
import os
import sys
import threading
from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from types import SimpleNamespace
from typing import Any, TypeVar, cast

import numpy as np
from numpy.typing import NDArray

Scalar = TypeVar("Scalar", bound=np.generic)
T = TypeVar("T")

#: Points per block: a dozen buffers of this size stay in a shared cache of a few MiB, and one
#: operation on them lasts long enough that two threads do not fight for the interpreter lock.
BLOCK_SIZE = 64_000


#: What is compared by its value.
_PLAIN = (numbers.Number, np.generic, str, bytes, tuple, Mapping, type(None))
_NUMBERS = frozenset({np.float64, float})
#: The usual types, for which NumPy is the namespace.
_OWN = frozenset({np.float64, np.ndarray, float, int, np.bool_})


def namespace(*values: Any) -> Any:
    """The module whose ``exp``, ``where``, … understand these values.

    NumPy unless a value comes from JAX or SymPy. Foreign libraries are recognised by the name of
    the module of the value's type and never imported here: if a value of theirs is in hand, they
    are loaded already. pint quantities answer to NumPy's functions.
    """
    for value in values:
        kind = type(value)
        if kind in _OWN:  # asked some twenty times in a single call of a model
            continue
        package = kind.__module__.partition(".")[0]
        if package in {"jax", "jaxlib"}:
            return sys.modules["jax"].numpy
        if package == "sympy":
            return _symbolic()
    return np


def where(mask: Any, yes: Any, no: Any) -> Any:
    """``where`` of the namespace of the values; a number for numbers."""
    if type(mask) is np.bool_ and type(yes) in _NUMBERS and type(no) in _NUMBERS:  # NumPy takes six times as long
        return np.float64(yes if mask else no)
    result = namespace(mask, yes, no).where(mask, yes, no)
    return result[()] if isinstance(result, np.ndarray) else result


def _symbolic() -> SimpleNamespace:
    """NumPy's spelling of the few functions the equations use, in SymPy."""
    sympy = sys.modules["sympy"]

    def expm1(exponent: Any) -> Any:
        return sympy.exp(exponent) - 1

    return SimpleNamespace(
        exp=sympy.exp,
        expm1=expm1,
        log=sympy.log,
        sqrt=sympy.sqrt,
        sin=sympy.sin,
        cos=sympy.cos,
        tan=sympy.tan,
        arcsin=sympy.asin,
        arcsinh=sympy.asinh,
        arctan=sympy.atan,
        maximum=sympy.Max,
        minimum=sympy.Min,
        pi=sympy.pi,
    )


class lazy(cached_property[T]):
    """A property computed when first asked for, and kept; limits and NaN come without warnings."""

    def __get__(self, instance: Any, owner: type | None = None) -> Any:
        """The value; the first time, by the rules of IEEE 754 and in silence."""
        with np.errstate(all="ignore"):
            return super().__get__(instance, owner)


def same(one: Any, other: Any) -> bool:
    """Return whether two values are one object, equal plain values, equal NumPy arrays, or dataclasses of such values.

    Values of other libraries, which may not be known yet, are the same only if they are one object.
    """
    if one is other:
        return True
    if isinstance(one, np.ndarray) and isinstance(other, np.ndarray):
        return np.array_equal(one, other, equal_nan=one.dtype.kind == other.dtype.kind == "f")
    if dataclasses.is_dataclass(one) and type(one) is type(other):
        fields = (field.name for field in dataclasses.fields(one) if field.compare)
        return all(same(getattr(one, name), getattr(other, name)) for name in fields)
    return isinstance(one, _PLAIN) and isinstance(other, _PLAIN) and bool(one == other)


class ByValue:
    """Equality by :func:`same`, for dataclasses whose fields may be arrays (``eq=False``)."""

    def __eq__(self, other: object) -> bool:
        return same(self, other) if type(other) is type(self) else NotImplemented

    def __hash__(self) -> int:
        values = (getattr(self, field.name) for field in dataclasses.fields(cast("Any", self)) if field.compare)
        # arrays and mappings have no hash; those of a kind share one
        return hash((type(self), *(value if isinstance(value, Hashable) else type(value) for value in values)))


def as_array(value: Any) -> Any:
    """A number or sequence as NumPy sees it; foreign arrays pass untouched.

    Scalars become ``numpy.float64``, so that limits such as 0**-0.073 follow the rules of IEEE 754
    and not those of Python's ``float``.
    """
    if isinstance(value, int | float | list | tuple | np.ndarray | np.generic):
        array = np.asarray(value)
        return array.astype(np.float64, copy=False)[()] if array.dtype.kind in "fiu" else value
    return value


def compact(values: NDArray[Scalar]) -> NDArray[Scalar]:
    """The same values, read-only and in the memory of one where all are equal: a million zeros cost nothing."""
    if values.size < 2 or values.strides == (0,) * values.ndim:
        return values
    first = values.flat[0]
    equal = np.isnan(values) if first != first else values == first
    return np.broadcast_to(first, values.shape) if equal.all() else values


def total(parts: Iterable[NDArray[np.float64]]) -> NDArray[np.float64]:
    """The sum of arrays of one shape, one after the other: a stack of them would take the memory of all once more."""
    return functools.reduce(np.add, parts)


def processors() -> int:
    """The processors this process may use."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity is not None else (os.cpu_count() or 1)


def blocks(size: int, block_size: int = BLOCK_SIZE) -> Iterator[slice]:
    """Slices that cover ``range(size)`` in blocks."""
    for start in range(0, size, block_size):
        yield slice(start, min(start + block_size, size))


def in_blocks(function: Callable[..., Sequence[Any]], *values: Any, block_size: int = 16_384) -> Sequence[Any]:
    """``function(*values)``, elementwise; big NumPy arrays go through it block by block, on a few threads.

    For long chains of operations, whose intermediate arrays then stay in the cache. Numbers pass as
    they are, as do arrays too small to gain and values of other libraries.
    """
    if not all(isinstance(value, int | float | np.ndarray | np.generic) for value in values):
        return function(*values)
    shape = np.broadcast_shapes(*(np.shape(value) for value in values))
    size = math.prod(shape)
    if size <= 2 * block_size:
        return function(*values)
    flat = [np.broadcast_to(value, shape).reshape(-1) if np.ndim(value) else value for value in values]
    results: list[Any] = []

    def evaluate(block: slice) -> None:
        with np.errstate(all="ignore"):  # each thread has its own
            parts = function(*(value[block] if np.ndim(value) else value for value in flat))
        for result, part in zip(results, parts, strict=True):
            result[block] = part

    first = function(*(value[:1] if np.ndim(value) else value for value in flat))
    results.extend(np.empty(size) for _ in first)
    map_blocks(evaluate, size, block_size=block_size)
    return [result.reshape(shape) for result in results]


def map_blocks(
    evaluate: Callable[[slice], None],
    size: int,
    *,
    block_size: int = BLOCK_SIZE,
    threads: int | None = None,
    done: Callable[[int], None] | None = None,
) -> None:
    """Call ``evaluate(block)`` for every block of ``range(size)`` on a few threads, the calling one among them.

    NumPy releases the interpreter lock inside its loops, so threads share the work; a block is
    evaluated whole on one thread, so results do not depend on the number of threads. ``done`` gets
    the number of points finished so far, from the calling thread.
    """
    pending = iter(list(blocks(size, block_size)))
    workers = min(threads or processors(), math.ceil(size / block_size))
    lock, stopped = threading.Lock(), threading.Event()
    finished = reported = 0

    def work(report: Callable[[int], None] | None = None) -> None:
        nonlocal finished, reported
        try:
            while not stopped.is_set():
                with lock:
                    block = next(pending, None)
                if block is None:
                    return
                evaluate(block)
                with lock:
                    finished += block.stop - block.start
                if report is not None:
                    reported = finished
                    report(reported)
        except BaseException:
            stopped.set()
            raise

    if workers <= 1:
        work(done)
        return
    with ThreadPoolExecutor(workers - 1) as pool:
        others = [pool.submit(work) for _ in range(workers - 1)]
        work(done)
        for other in others:
            other.result()
    if done is not None and reported != finished:
        done(finished)
