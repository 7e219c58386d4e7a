"""The values of options from what was written on the command line, in a request or on the page: numbers in SI.

Faults name the flags of the command line.
"""

from __future__ import annotations

import contextlib
import dataclasses
from collections.abc import Callable, Generator, Mapping, Sequence
from typing import Any, TypeVar, cast

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError, either, fault_of, nearest, raise_if_any
from ballscrew.basis.quantities import Info, Quantity
from ballscrew.questions.shared.options import OptionField, Range, options_of

T = TypeVar("T")
#: The quantities that ranges may be given for: from the name of the option, and the options before it.
QuantitiesOf = Callable[[str, Mapping[str, Any]], Mapping[str, Quantity]]


def read(cls: type[T], written: Mapping[str, Any], quantities_of: QuantitiesOf | None = None) -> T:
    """The options as values. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in them.

    ``written`` has each option as :data:`~ballscrew.questions.shared.options.Kind` says, of a table also the texts
    ``name=text`` of a command line; one that is None, or not there, has its default. ``quantities_of`` says which
    ranges there may be.
    """
    faults: list[Fault] = []
    values: dict[str, Any] = {}
    for name, option in options_of(cls).items():
        given = written.get(name)
        if given is None or given == option.written_default:
            values[name] = option.default
            continue
        try:
            if option.kind == "ranges":
                known = {} if quantities_of is None else quantities_of(name, values)
                values[name] = _ranges(option.flag, assignments(given), known)
            else:
                values[name] = _READERS.get(option.kind, _as_it_is)(option, given)
        except InputError as error:
            faults += error.faults
    raise_if_any(faults)
    return cls(**values)


def flags_of(section: str, *classes: type) -> dict[str, str]:
    """The flags of options by the fields, ``section.field``, in which a computation finds their faults."""
    return {f"{section}.{name}": option.flag for cls in classes for name, option in options_of(cls).items()}


@contextlib.contextmanager
def faults_named(flags: Mapping[str, str]) -> Generator[None]:
    """Let faults name the flag by which their field was given, see :func:`with_flag`."""
    try:
        yield
    except InputError as error:
        raise InputError(*(with_flag(fault, flags) for fault in error.faults)) from None


def with_flag(fault: Fault, flags: Mapping[str, str]) -> Fault:
    """A fault with the flag in place of its field; a key ``section.`` is for all fields that begin so."""
    where = fault.where
    known = next((key for key in flags if where == key or (key.endswith(".") and where.startswith(key))), "")
    return dataclasses.replace(fault, where=flags[known] + where.removeprefix(known)) if known else fault


def without_band(given: Mapping[str, Any]) -> list[Fault]:
    """The faults of options of a band, by their flags, where none is asked for."""
    return [Fault(flag, "needs --band", str(value), "add --band") for flag, value in given.items() if value is not None]


def assignments(given: Mapping[str, str] | Sequence[str]) -> list[str]:
    """``name=text`` of each entry of a table, as on the command line."""
    return [f"{name}={text}" for name, text in given.items()] if isinstance(given, Mapping) else list(given)


def _as_it_is(_option: OptionField, given: Any) -> Any:
    return given


def _choice(option: OptionField, given: str) -> str:
    if given not in option.choices:
        known = either((each for each in option.choices if each != option.default), quote="")
        problem = f"unknown {option.option.noun or option.name}"
        raise InputError(Fault(option.flag, problem, given, known))
    return given


def _names(option: OptionField, given: Sequence[str]) -> Sequence[str]:
    names = [name.strip() for text in given for name in text.split(",") if name.strip()]
    if not names and option.default:
        usual = ",".join(option.default)
        remedy = f"write {option.flag} {usual}"
        raise InputError(Fault(option.flag, "has no names", ", ".join(given), remedy))
    return names


def _texts(option: OptionField, given: Mapping[str, str] | Sequence[str]) -> Any:
    if option.option.is_table:
        return assignments(given)
    texts: dict[str, str] = {}
    faults: list[Fault] = []
    for text in assignments(given):
        name, equals, value = text.partition("=")
        if not equals or not name.strip() or not value.strip():
            noun = option.option.noun or "text"
            remedy = f"write {option.flag} {option.option.example}"
            faults.append(Fault(option.flag, f"is not name={noun}", text, remedy))
        texts[name.strip()] = value.strip()
    raise_if_any(faults)
    return texts


def _quantity(option: OptionField, text: str) -> float:
    """A number in SI within its bounds."""
    said, flag = option.option, option.flag
    if said.is_difference and units.unit_in(text) not in ("K", "kelvin", ""):
        number = text.replace(units.unit_in(text), "").strip()
        remedy = f'write {flag} "{number} K"'
        raise InputError(Fault(flag, "is a difference of temperatures, in K", text, remedy))
    info = Info("", said.meaning, said.shown_in, above=said.above, at_least=said.at_least)
    quantity = Quantity(option.name, said.unit, info)
    value = units.parse(flag, text, quantity)
    if isinstance(value, Fault):
        raise InputError(value)
    fault = fault_of("", quantity, value)
    if fault is not None:
        raise InputError(dataclasses.replace(fault, where=flag, given=text, remedy=said.hint))
    return value


def _quantities(option: OptionField, given: Sequence[str]) -> list[float]:
    values: list[float] = []
    faults: list[Fault] = []
    for text in given:
        try:
            values.append(_quantity(option, text))
        except InputError as error:
            faults += error.faults
    raise_if_any(faults)
    return values


_READERS: Mapping[str, Callable[[OptionField, Any], Any]] = {
    "choice": _choice, "names": _names, "texts": _texts, "quantity": _quantity,
    "quantities": _quantities,
}  # fmt: skip


def _ranges(flag: str, given: Sequence[str], known: Mapping[str, Quantity]) -> dict[str, Range]:
    """``name=low:high unit`` in SI."""
    ranges: dict[str, Range] = {}
    faults: list[Fault] = []
    for text in given:
        name, equals, values = text.partition("=")
        name, (low, colon, high) = name.strip(), values.strip().partition(":")
        if not equals or not colon:
            faults.append(Fault(flag, "is not name=low:high", text, f'write {flag} name="low:high unit"'))
        elif name not in known:
            faults.append(Fault(f"{flag} {name}", "unknown name", "", nearest(name, known)))
        else:
            unit = units.unit_in(high)
            texts = (end.strip() if units.unit_in(end) else f"{end.strip()} {unit}".strip() for end in (low, high))
            ends = [_end(f"{flag} {name}", end, known[name]) for end in texts]
            wrong = [end for end in ends if isinstance(end, Fault)]
            faults += wrong
            if not wrong:
                ranges[name] = cast("Range", tuple(ends))
                if ranges[name][0] >= ranges[name][1]:
                    faults.append(Fault(f"{flag} {name}", "leaves no room", values, "put the lower end first"))
    raise_if_any(faults)
    return ranges


def _end(where: str, text: str, quantity: Quantity) -> float | Fault:
    plain: Any = text
    if quantity.unit == "1":
        try:
            plain = float(text)
        except ValueError:
            plain = text
    return units.parse(where, plain, quantity)
