"""Errors in the input: one line each, with the same text from Python and the command line.

A line reads ``section.field: what is wrong (value) · remedy``.

An overflow of plain numbers is such an error, too.
"""

from __future__ import annotations

import contextlib
import dataclasses
import difflib
import functools
import inspect
import math
import numbers
import warnings
from collections.abc import Callable, Generator, Iterable, Mapping, Sequence
from typing import Any, ParamSpec, TypeVar, cast, get_type_hints

import numpy as np

from ballscrew.basis.quantities import BEYOND, Quantity, carries_unit, fields_of, in_si, out_of_bounds, unit_of

P = ParamSpec("P")
R = TypeVar("R")
T = TypeVar("T")

#: At most this many lines are printed; the last one then says how many more there are.
LINES_AT_MOST = 10
#: Most characters of a given value in a message.
LONGEST_VALUE = 200
#: The kind of fault of a key or a section that is not known.
UNKNOWN = "unknown"
#: The kind of a fault of a nut whose balls differ, which rigid and equal parts mend.
ONE_BY_ONE = "one_by_one"
#: The problem of a field that is not given.
MISSING = "missing"


@dataclasses.dataclass(frozen=True, slots=True)
class Fault:
    """One error in one field."""

    where: str
    problem: str
    given: str = ""
    remedy: str = ""
    #: The known name that was probably meant, where the remedy suggests one.
    meant: str = ""
    #: The kind of fault, where callers tell kinds apart: no caller reads the texts.
    id: str = ""
    #: The column that the fault is about, where ``where`` is a place in a file.
    column: str = ""
    #: The part of the field that it is about, where the field has several: ``point 2`` of a curve.
    part: str = ""
    #: The bound that its texts name, in SI: who knows how the field is written writes it like that.
    bound: float | None = None

    def __str__(self) -> str:
        return f"{self.field}: {self.text}"

    @property
    def field(self) -> str:
        """The section and field, cut to a length that people read."""
        return _one_line(_cut(f"{self.where} {self.part}" if self.part else self.where))

    @property
    def text(self) -> str:
        """The problem, the value given, and the remedy."""
        problem, given, remedy = self.parts
        return _one_line(f"{problem}{f' ({given})' if given else ''}{f' · {remedy}' if remedy else ''}")

    @property
    def parts(self) -> tuple[str, str, str]:
        """The problem, the value given and the remedy as English texts of one line."""
        return _one_line(self.problem), _one_line(_cut(self.given)), _one_line(self.remedy)

    def document(self) -> dict[str, Any]:
        """The fault as it stands in JSON."""
        problem, given, remedy = self.parts
        return {
            "where": self.field,
            "path": _one_line(_cut(self.where)),
            "id": self.id,
            "text": self.text,
            "line": str(self),
            "problem": problem,
            "given": given,
            "remedy": remedy,
        }

    def with_bound(self, unit: str, written: str) -> Fault:
        """The fault with its bound, of this SI unit, as it is ``written``."""
        if self.bound is None:
            return self
        number = shown(self.bound, unit)
        if number in self.problem:
            return dataclasses.replace(self, problem=self.problem.replace(number, written), bound=None)
        if not self.bound:  # "must be positive" names no number
            return self
        return dataclasses.replace(self, remedy=self.remedy.replace(number, written), bound=None)


def _cut(text: str) -> str:
    return text if len(text) <= LONGEST_VALUE else f"{text[:LONGEST_VALUE]}…"


def _one_line(text: str) -> str:
    return " ".join("".join(c if c.isprintable() else " " for c in text).split())


class InputError(ValueError):
    """Invalid input: carries every fault found, prints one line for each."""

    def __init__(self, *faults: Fault) -> None:
        self.faults = faults
        super().__init__("\n".join(self.lines()))

    def lines(self) -> list[str]:
        """One line per fault, ten lines at most."""
        lines = [str(fault) for fault in self.faults]
        if len(lines) > LINES_AT_MOST:
            hidden = len(lines) - LINES_AT_MOST + 1
            lines = [*lines[: LINES_AT_MOST - 1], f"and {hidden} more"]
        return lines


class ImplausibleInput(UserWarning):
    """Plain numbers of a part that are possible, and that no ball screw has: a lead of 10, which is 10 m.

    It is said where a program makes the part. Arrays are never warned of; results name them in their ``warnings``.
    """


def nearest(word: str, known: Iterable[str], most: int | None = None) -> str:
    """``did you mean "…"?`` for the closest known word, else the list of known words, ``most`` of them at most."""
    candidates = list(known)
    if result := closest(word, candidates):
        return f'did you mean "{result}"?'
    is_cut = most is not None and len(candidates) > most
    return f"known: {', '.join(candidates[:most])}{', …' if is_cut else ''}"


def either(names: Iterable[str], quote: str = '"') -> str:
    """``"a" or "b" or "c"``."""
    return " or ".join(f"{quote}{name}{quote}" for name in names)


def closest(word: str, known: Iterable[str]) -> str:
    """The known word that was probably meant; empty if none is close."""
    candidates = list(known)
    alike = [name for name in candidates if len(word) > 2 and (name.startswith(word) or name.endswith(f"_{word}"))]
    alike.sort(key=lambda name: not name.endswith(f"_{word}"))
    close = alike or difflib.get_close_matches(word, candidates, n=1, cutoff=0.55)
    close = close or [name for name in candidates if len(word) > 3 and name.startswith(word[:4])]
    return close[0] if close else ""


def is_concrete(value: Any) -> bool:
    """Return whether a value is a plain number that can be checked now (arrays and tracers are not)."""
    if isinstance(value, np.ndarray):
        return value.ndim == 0 and value.dtype.kind in "fiu"
    return isinstance(value, numbers.Real) and value is not True and value is not False


def holds_somewhere(mask: Any) -> bool:
    """Return whether a mask of NumPy holds anywhere; False for that of a value which is only being recorded."""
    return isinstance(mask, bool | np.bool_ | np.ndarray) and bool(np.any(mask))


def plain(value: Any) -> Any:
    """A concrete number as a float; arrays and tracers as they are."""
    return float(value) if is_concrete(value) else value


def as_float(value: Any) -> float:
    """A concrete number as a float; infinite on overflow."""
    try:
        return float(value)
    except OverflowError:
        return math.inf


def shown(value: Any, unit: str) -> str:
    """A value in its unit, as it stands in a message."""
    if not is_concrete(value):
        return repr(value)
    number = f"{as_float(value):.6g}"
    return number if unit == "1" else f"{number} {unit}"


def spoken(path: str) -> str:
    """The name of a field, a law or a result as people read it, by its path: ``nut.preload_share``."""
    return path.rpartition(".")[2].replace("_", " ")


def in_file(path: str) -> str:
    """A field by its place in a case file, by its path: ``[axis] mass``."""
    section, _, key = path.partition(".")
    return f"[{section}] {key}"


def to_set(path: str) -> str:
    """Text that a file has before the value of a field, by its path: ``preload = ``."""
    return f"{path.rpartition('.')[2]} = "


def fault_of(section: str, quantity: Quantity, value: Any, given: str = "") -> Fault | None:
    """The fault of one concrete value, or None. ``given`` is the text of the input, if known."""
    where = f"{section}.{quantity.name}"
    if isinstance(value, str | bytes | bool) or value is None:
        problem = "must be a number" if quantity.unit == "1" else f"must be a number in {quantity.unit}"
        return Fault(where, problem, given or shown(value, quantity.unit), "give a number without quotes")
    complex_number = isinstance(value, numbers.Number) and not isinstance(value, numbers.Real)
    of_others = isinstance(value, np.ndarray) and value.dtype.kind not in "fiu"
    if isinstance(value, list | tuple) or complex_number or of_others:
        remedy = "give a float or a numpy.array of floats"
        return Fault(where, "must be a number or an array of numbers", given or shown(value, quantity.unit), remedy)
    if not is_concrete(value):
        return None
    violated = out_of_bounds(quantity.info, as_float(value))
    if violated is None:
        return None
    condition, bound = violated
    problem = BEYOND[condition] if bound is None else BEYOND[condition].format(bound=shown(bound, quantity.unit))
    return Fault(where, problem, given or shown(value, quantity.unit), quantity.info.hint, bound=bound)


def without_unit(where: str, value: Any, unit: str | None) -> Any | Fault:
    """A value of pint in the SI unit given, any other value as it is; the fault where the unit does not fit.

    None stands for what takes no unit.
    """
    if _is_number(value) or not carries_unit(value):
        return value
    if unit is None:
        return Fault(where, "takes no unit", str(value), "give a plain number")
    try:
        return in_si(value, unit)
    # of pint: a wrong dimension, an offset unit, an unknown one
    except (TypeError, ValueError, AttributeError) as error:
        in_unit = f"give a quantity in {unit}, or a plain number in {unit}"
        return Fault(where, "wrong unit", f"{value}: {error}", "give a plain number" if unit == "1" else in_unit)


def fault_of_declared_unit(where: str, labelled: Any, unit: str) -> Fault | None:
    """The fault of a labelled array whose attribute ``units`` is another unit; None where it has none."""
    declared = str(labelled.attrs.get("units", unit))
    if declared == unit:
        return None
    return Fault(where, "is in another unit by its attribute units", declared, f"give it in {unit}")


def _is_number(value: Any) -> bool:
    """Return whether a value is a plain number, as most are, and needs no other look."""
    return isinstance(value, float)


def names_keywords(cls: type[T]) -> type[T]:
    """Let the constructor of a dataclass say which keyword was probably meant by one that it does not have."""
    made = cls.__init__

    @functools.wraps(made)
    def __init__(self: Any, *args: Any, **kwargs: Any) -> None:
        _refuse_unknown(cls.__name__, kwargs, cast("Any", cls).__dataclass_fields__)
        made(self, *args, **kwargs)

    cls.__init__ = __init__
    return cls


def _refuse_unknown(name: str, given: Iterable[str], known: Iterable[str]) -> None:
    """Raise the ``TypeError`` of a keyword that is not known, with the one that was probably meant."""
    for word in given:
        if word not in known:
            raise TypeError(f"{name}() has no keyword {word!r}: {nearest(word, known)}")


#: What the docstring of a function says that is decorated by :func:`accepts_units`.
OF_PINT = "Quantities of pint are converted to these units; what is returned are plain numbers, in SI."


def accepts_units(section: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Convert arguments that are quantities of pint to the SI units of the parameters' annotations; a decorator.

    Raises :class:`InputError` for a unit that does not fit, and for a unit where the annotation has none.
    """

    def decorated(function: Callable[P, R]) -> Callable[P, R]:
        @functools.cache
        def signature() -> tuple[inspect.Signature, Mapping[str, str | None]]:
            hints = get_type_hints(function, include_extras=True)
            return inspect.signature(function), {name: unit_of(hint) for name, hint in hints.items()}

        code = inspect.unwrap(function).__code__
        named = code.co_varnames[: code.co_argcount + code.co_kwonlyargcount]
        keywords = None if code.co_flags & inspect.CO_VARKEYWORDS else frozenset(named) - {"self", "cls"}

        @functools.wraps(function)
        def converting(*args: P.args, **kwargs: P.kwargs) -> R:
            if keywords is not None and not keywords.issuperset(kwargs):
                _refuse_unknown(function.__qualname__, kwargs, sorted(keywords))
            if not any(carries_unit(value) for value in (*args, *kwargs.values()) if not _is_number(value)):
                return function(*args, **kwargs)
            declared, units = signature()
            bound = declared.bind(*args, **kwargs)
            for name, value in bound.arguments.items():
                if carries_unit(value):
                    bound.arguments[name] = si_value(f"{section}.{name}", value, units.get(name))
            return function(*bound.args, **bound.kwargs)

        converting.__doc__ = f"{inspect.getdoc(function) or ''}\n\n{OF_PINT}"
        return converting

    return decorated


def renamed_keyword(old: str, new: str) -> Callable[[Callable[P, R]], Callable[P, R]]:
    """Take the ``old`` name of a keyword for the ``new`` one, with a ``DeprecationWarning``; a decorator."""

    def decorated(function: Callable[P, R]) -> Callable[P, R]:
        @functools.wraps(function)
        def renaming(*args: P.args, **kwargs: P.kwargs) -> R:
            if old in kwargs:
                warnings.warn(f"{function.__name__}: write {new}=… for {old}=…", DeprecationWarning, stacklevel=2)
                kwargs.setdefault(new, kwargs.pop(old))
            return function(*args, **kwargs)

        return renaming

    return decorated


def si_value(where: str, value: Any, unit: str | None) -> Any:
    """Convert like :func:`without_unit`, but raise a fault as an :class:`InputError`."""
    converted = without_unit(where, value, unit)
    if isinstance(converted, Fault):
        raise InputError(converted)
    return converted


def faults_of(section: str, part: Any, optional: Sequence[str] = ()) -> list[Fault]:
    """Faults of every concrete annotated field of a dataclass instance that is being made.

    Fields that were given as quantities of pint become numbers in SI.
    """
    faults: list[Fault] = []
    for name, quantity in fields_of(part).items():
        given = getattr(part, name)
        if given is None and name in optional:
            continue
        if type(given) is float and out_of_bounds(quantity.info, given) is None:  # as most are
            continue
        value = without_unit(f"{section}.{name}", given, quantity.unit)
        if isinstance(value, Fault):
            faults.append(value)
            continue
        if value is not given:
            object.__setattr__(part, name, value)
        fault = fault_of(section, quantity, value)
        if fault is not None:
            faults.append(fault)
    return faults


def raise_if_any(faults: Sequence[Fault]) -> None:
    """Raise :class:`InputError` with all faults, if there are any."""
    if faults:
        raise InputError(*faults)


@contextlib.contextmanager
def overflow_as_input_error() -> Generator[None]:
    """Turn an overflow or a division by zero of plain floats into an input error; also a decorator.

    Arrays become infinite or NaN instead, and are covered by the validity.
    """
    try:
        yield
    except (OverflowError, ZeroDivisionError) as error:
        if hasattr(error, "raised_by_law"):  # a law from outside, whose author wants to see it
            raise
        problem, remedy = "has numbers too large or too small to compute with", "look for powers of ten too many"
        raise InputError(Fault("case", problem, str(error.args[-1]), remedy)) from error
