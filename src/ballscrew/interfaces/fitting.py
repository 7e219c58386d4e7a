"""``ballscrew fit``: a case and a log of torques in, a calibrated model out; and what ``--json`` prints of it."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, cast, get_args

from ballscrew import __version__
from ballscrew.analyses.calibrated import CalibratedModel, Estimate
from ballscrew.analyses.calibration import fit
from ballscrew.analyses.fit_problem import CONSTANT_TORQUE
from ballscrew.analyses.next_test import NextTest
from ballscrew.analyses.outputs import inputs_of
from ballscrew.analyses.plan import Subject
from ballscrew.analyses.response import resolved
from ballscrew.analyses.torque_log import INERTIA, TORQUE_CONSTANT, Kind, TorqueLog
from ballscrew.faults import Fault, InputError, nearest, raise_if_any
from ballscrew.interfaces import config, logs, units
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.documents import as_json
from ballscrew.quantities import Quantity

#: What is fitted unless told otherwise.
USUALLY_FREE = "boundary_friction_coefficient"
#: What a test is described by.
CONDITIONS = ("axial_load", "screw_speed", "temperature")
#: What a fault of the fit is called on the command line.
_OPTIONS: Mapping[str, str] = {f"fit.{name}": f"--{name}" for name in ("free", "holdout", "kind", "seed")}
_LIMITS = "fit.limits."


@dataclasses.dataclass(frozen=True)
class Asked:
    """What was asked for on the command line beside case and log."""

    free: Sequence[str] = ()
    bounds: Sequence[str] = ()
    limits: Sequence[str] = ()
    columns: Sequence[str] = ()
    kind: str | None = None
    inertia: str | None = None
    torque_constant: str | None = None
    holdout: float = 0.2
    seed: int = 0
    keep_going: bool = False


@dataclasses.dataclass(frozen=True, eq=False)
class Fitted:
    """A calibration, and the test that would teach most."""

    model: CalibratedModel
    #: None where no point within the limits is valid.
    next_test: NextTest | None
    log: TorqueLog


def fitted(case: Case, path: Path, asked: Asked, done: Callable[[int, int], None] | None = None) -> Fitted:
    """Read a log and fit a case to it. Raises :class:`~ballscrew.faults.InputError` in the words of the command line.

    A distribution that the case gives a free number is its prior.
    """
    if case.parts is not None:
        remedy = "leave out [nut] and what belongs to it, or fit a case without"
        raise InputError(Fault("nut", "a whole nut cannot be fitted yet", "", remedy))
    free = [name.strip() for given in asked.free or [USUALLY_FREE] for name in given.split(",") if name.strip()]
    known = _quantities(case, free)
    faults: list[Fault] = []
    if not free:
        faults.append(Fault("--free", "has no names", ", ".join(asked.free), f"write --free {USUALLY_FREE}"))
    bounds = _ranges("--bounds", asked.bounds, known, faults)
    conditions = {name: q for name, (_, q) in inputs_of(case.model, case.screw, case.lubricant).items()}
    limits = _ranges("--limits", asked.limits, {n: conditions[n] for n in CONDITIONS if n in conditions}, faults)
    inertia = _number("--inertia", asked.inertia, INERTIA, faults)
    constant = _number("--torque-constant", asked.torque_constant, TORQUE_CONSTANT, faults)
    columns = _columns(asked.columns, faults)
    if asked.kind is not None and asked.kind not in get_args(Kind):
        faults.append(Fault("--kind", "unknown kind of torque", asked.kind, "friction or drive"))
    raise_if_any(faults)
    log = logs.read(path, columns, torque_constant=constant, keep_going=asked.keep_going, done=done)
    subject = Subject(case.model, case.screw, case.lubricant)
    priors = {
        name: case.uncertain[full]
        for name in free
        if name in known and (full := _full(subject, name)) is not None and full in case.uncertain
    }
    again = bool(priors) and log.source is not None and case.fit.get("sha256") == log.source[1]
    if again:  # what was found in this log is no news for it
        priors = {}
    try:
        found = fit(
            case.model, case.screw, case.lubricant, log, free, priors=priors, bounds=bounds,
            kind=cast("Kind", asked.kind or "unknown"), inertia=inertia, holdout=asked.holdout, seed=asked.seed,
        )  # fmt: skip
    except InputError as error:
        raise InputError(*(_in_words(fault) for fault in error.faults)) from None
    if again:
        said = "the case was fitted to this very log before: its errors are not taken as priors"
        found = dataclasses.replace(found, warnings=(*found.warnings, said))
    try:
        return Fitted(found, found.next_test(limits), log)
    except InputError as error:
        # the fit is not lost for it
        said = tuple(f"no next test: {_in_words(fault)}" for fault in error.faults)
        return Fitted(dataclasses.replace(found, warnings=(*found.warnings, *said)), None, log)


def _in_words(fault: Fault) -> Fault:
    where = fault.where
    if where.startswith(_LIMITS):
        return dataclasses.replace(fault, where=f"--limits {where.removeprefix(_LIMITS)}")
    return dataclasses.replace(fault, where=_OPTIONS.get(where, where))


def _full(subject: Subject, name: str) -> str | None:
    """The full name of a free number; None for one that no model has."""
    try:
        return resolved(subject, name)
    except InputError:
        return None


def _quantities(case: Case, free: Sequence[str]) -> dict[str, Quantity]:
    """What the free numbers are, as far as they are known: the fit says what is wrong with the others."""
    subject = Subject(case.model, case.screw, case.lubricant)
    full = {name: _full(subject, name) for name in free}
    known = {name: subject.inputs[found][1] for name, found in full.items() if found is not None}
    return known | ({CONSTANT_TORQUE.name: CONSTANT_TORQUE} if CONSTANT_TORQUE.name in free else {})


def _ranges(
    option: str, given: Sequence[str], known: Mapping[str, Quantity], faults: list[Fault]
) -> dict[str, tuple[float, float]]:
    """``name=low:high unit`` in SI."""
    found: dict[str, tuple[float, float]] = {}
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
                found[name] = cast("tuple[float, float]", tuple(ends))
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


def _number(option: str, text: str | None, quantity: Quantity, faults: list[Fault]) -> float | None:
    if text is None:
        return None
    found = units.parse(option, text.replace("Nm", "N m"), quantity)
    if isinstance(found, Fault):
        faults.append(found)
        return None
    if found <= 0:
        faults.append(Fault(option, "must be positive", text))
    return found


def _columns(given: Sequence[str], faults: list[Fault]) -> dict[str, str]:
    """``torque="M_ist [N m]"`` as a mapping; logs say what is wrong with the names."""
    found: dict[str, str] = {}
    for text in given:
        name, equals, heading = text.partition("=")
        if not equals or not name.strip() or not heading.strip():
            faults.append(Fault("--column", "is not name=heading", text, 'write --column torque="M_ist [N m]"'))
        found[name.strip()] = heading.strip()
    return found


# -- for programs ---------------------------------------------------------------------------------


def json_text(case: Case, fitted: Fitted) -> str:
    """One JSON object in SI: estimates, what is left, what cannot be told, the next test, warnings, provenance."""
    found = fitted.model
    document = {
        "estimates": {name: _estimate(estimate) for name, estimate in found.estimates.items()},
        "residual_rms": found.residual_rms,
        "holdout_rms": found.holdout_rms,
        "warnings": list(found.warnings),
        "sensor": {name: _estimate(estimate) for name, estimate in found.sensor.items()},
        "scores": {s.words: {"fitted_rms": s.fitted, "holdout_rms": s.held_out} for s in found.scores},
        "identifiability": {
            "singular_values": found.identifiability.singular_values,
            "combinations": [dataclasses.asdict(c) for c in found.identifiability.combinations],
        },
        "covariance": {"names": list(found.estimates), "matrix": _covariance(found)},
        "residuals": {name: trend._asdict() for name, trend in found.rows.trends.items()},
        "next_test": None if fitted.next_test is None else _next_test(fitted.next_test),
        "rows": _rows(found),
        "inputs": config.inputs(case),
        "provenance": provenance(case, found),
    }
    return as_json(document)


def _next_test(test: NextTest) -> dict[str, Any]:
    return {
        "point": test.best,
        "readings": test.readings,
        "remaining_volume": test.best_volume,
        "random_remaining_volume": test.random_volume,
        "remaining_error": test.remaining_error,
    }


def _estimate(estimate: Estimate) -> dict[str, Any]:
    return {
        "value": estimate.value,
        "std": estimate.std,
        "identified": estimate.identified,
        "unit": estimate.quantity.unit,
        "start": estimate.start,
        "at_bound": estimate.at_bound,
        "prior_share": estimate.prior_share,
    }


def _covariance(found: CalibratedModel) -> list[list[float | None]]:
    """Covariance of the numbers asked for; null where one of the two is not identified."""
    told = [estimate.identified for estimate in found.estimates.values()]
    matrix = found.uncertainty.covariance[: len(told), : len(told)].tolist()
    return [[x if told[i] and told[j] else None for j, x in enumerate(row)] for i, row in enumerate(matrix)]


def _rows(found: CalibratedModel) -> dict[str, Any]:
    log = found.rows.log
    return {
        "read": log.rows,
        "used": len(log),
        "held_out": int(found.rows.held_out.sum()),
        "outliers": int(found.rows.outlying.sum()),
        "left_out": dict(log.left_out),
        "notes": list(log.notes),
        "torque": found.rows.reading.words,
    }


def provenance(case: Case, found: CalibratedModel) -> dict[str, Any]:
    """Where a calibration is from: version, model, log with its hash, settings, sources."""
    name, digest = found.rows.log.source or ("", "")
    return {
        "version": __version__,
        "model": case.model.label,
        "log": name,
        "sha256": digest,
        "settings": found.settings,
        "references": config.references(case),
    }
