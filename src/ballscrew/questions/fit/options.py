"""The options of a fit: text from the command line or a request as numbers in SI."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, cast, get_args

from ballscrew.basis import units
from ballscrew.basis.atomic_files import check_writable
from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.basis.quantities import Quantity
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.files.torque_logs.log_rows import INERTIA, TORQUE_CONSTANT, Kind
from ballscrew.questions.fit.log import CONDITIONS, DEFAULT_FREE, Options, Range


def options(
    case: Case,
    *,
    free: Sequence[str],
    bounds: Sequence[str],
    limits: Sequence[str],
    columns: Sequence[str],
    kind: str | None,
    inertia: str | None,
    torque_constant: str | None,
    holdout: float,
    seed: int,
    keep_going: bool,
    temperature_error: str | None = None,
) -> Options:
    """The options as typed values. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in them."""
    names = [name.strip() for given in free or [DEFAULT_FREE] for name in given.split(",") if name.strip()]
    faults: list[Fault] = []
    if not names:
        faults.append(Fault("--free", "has no names", ", ".join(free), f"write --free {DEFAULT_FREE}"))
    conditions = {name: q for name, (_, q) in inputs_of(case.model, case.screw, case.lubricant).items()}
    found = Options(
        free=names,
        bounds=_ranges("--bounds", bounds, _bounded(case, names) if bounds else {}, faults),
        limits=_ranges("--limits", limits, {n: conditions[n] for n in CONDITIONS if n in conditions}, faults),
        inertia=number_of("--inertia", inertia, INERTIA, faults),
        torque_constant=number_of("--torque-constant", torque_constant, TORQUE_CONSTANT, faults),
        columns=columns_of(columns, faults),
        kind=cast("Kind", kind or "unknown"),
        holdout=holdout,
        temperature_error=_temperature_error(temperature_error, faults),
        seed=seed,
        keep_going=keep_going,
    )
    if kind is not None and kind not in get_args(Kind):
        faults.append(Fault("--kind", "unknown kind of torque", kind, "friction or drive"))
    raise_if_any(faults)
    return found


def check_to(to: Path, case: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` if no case file can be written there, or if it is the case
    itself.
    """
    if to.resolve() == case.resolve():
        raise InputError(
            Fault("--to", "is the case itself", str(to), "choose another name: its comments would be lost")
        )
    if to.suffix.lower() != ".toml":
        raise InputError(Fault("--to", "is no case file", str(to), "end it in .toml; a picture is --picture"))
    check_writable("--to", to)


def _bounded(case: Case, names: Sequence[str]) -> Mapping[str, Quantity]:
    """Quantities of the free numbers, which bounds need."""
    from ballscrew.questions.fit.compute import free_quantities  # slow to import: only where bounds are given

    return free_quantities(case, names)


def _ranges(option: str, given: Sequence[str], known: Mapping[str, Quantity], faults: list[Fault]) -> dict[str, Range]:
    """``name=low:high unit`` in SI."""
    found: dict[str, Range] = {}
    for text in given:
        name, equals, values = text.partition("=")
        name, (low, colon, high) = name.strip(), values.strip().partition(":")
        if not equals or not colon:
            faults.append(Fault(option, "is not name=low:high", text, f'write {option} name="low:high unit"'))
        elif name not in known:
            faults.append(Fault(f"{option} {name}", "unknown name", "", nearest(name, known)))
        else:
            unit = units.unit_in(high)
            texts = (end.strip() if units.unit_in(end) else f"{end.strip()} {unit}".strip() for end in (low, high))
            ends = [_value(f"{option} {name}", end, known[name]) for end in texts]
            wrong = [end for end in ends if isinstance(end, Fault)]
            faults += wrong
            if not wrong:
                found[name] = cast("Range", tuple(ends))
                if found[name][0] >= found[name][1]:
                    faults.append(Fault(f"{option} {name}", "leaves no room", values, "put the lower end first"))
    return found


def _value(where: str, text: str, quantity: Quantity) -> float | Fault:
    plain: Any = text
    if quantity.unit == "1":
        try:
            plain = float(text)
        except ValueError:
            plain = text
    return units.parse(where, plain, quantity)


def number_of(
    option: str, text: str | None, quantity: Quantity, faults: list[Fault], least: float | None = None
) -> float | None:
    """A number above zero, or of at least ``least``; None where none is given or it is a fault."""
    if text is None:
        return None
    found = units.parse(option, text, quantity)
    if isinstance(found, Fault):
        faults.append(found)
        return None
    if least is not None and found < least:
        faults.append(Fault(option, "must not be negative", text))
    elif least is None and found <= 0:
        faults.append(Fault(option, "must be positive", text))
    return found


def _temperature_error(text: str | None, faults: list[Fault]) -> float | None:
    """A difference of temperatures in kelvin; None where none is given or it is a fault."""
    if text is None:
        return None
    from ballscrew.evidence.calibration.oil_temperature import TEMPERATURE_ERROR  # loads xarray

    option = "--temperature-error"
    if units.unit_in(text) not in ("K", "kelvin", ""):
        # "2 degC" would be 275 K
        number = text.replace(units.unit_in(text), "").strip()
        faults.append(Fault(option, "is a difference of temperatures, in K", text, f'write {option} "{number} K"'))
        return None
    return number_of(option, text, TEMPERATURE_ERROR, faults, least=0.0)


def columns_of(given: Sequence[str], faults: list[Fault]) -> dict[str, str]:
    """``torque="M_ist [N m]"`` as a mapping; the reader of logs checks the names."""
    found: dict[str, str] = {}
    for text in given:
        name, equals, heading = text.partition("=")
        if not equals or not name.strip() or not heading.strip():
            faults.append(Fault("--column", "is not name=heading", text, 'write --column torque="M_ist [N m]"'))
        found[name.strip()] = heading.strip()
    return found
