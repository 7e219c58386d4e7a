"""A calibrated model as a case file: the case it was made from, the fitted numbers in it, and ``[calibration]``.

Every command takes it. Bands use the covariance of the numbers, as far as they are identified.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import of_case, references
from ballscrew.cases.case_files.lubricants import OF_NAMED_OIL
from ballscrew.cases.case_files.named_calibration import written_out
from ballscrew.cases.case_files.opened_file import moved
from ballscrew.engine.uncertainty.distributions import normal_half_width
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit import CONSTANT_LOSS
from ballscrew.evidence.calibration.fit_result import Estimate
from ballscrew.evidence.calibration.problem import CONSTANT_TORQUE
from ballscrew.physics.components.materials import Lubricant

_HEAD = "A calibrated model, written by ballscrew fit. Numbers that are not identified have no error behind them."
#: The name of a fitted constant torque among the inputs of a case.
CONSTANT_INPUT = f"losses.{CONSTANT_LOSS}.{CONSTANT_TORQUE.name}"
#: Digits of a fitted number: enough to give the same torques.
_DIGITS = 12


def save(to: Path, tables: Mapping[str, Any], folder: Path, case: Case, calibrated_model: CalibratedModel) -> None:
    """Write the case that ``tables`` from a file in ``folder`` describe, with the fitted numbers in place."""
    text = text_of(moved(tables, folder, to.parent), case, calibrated_model)
    with atomic_write("--to", to) as path:
        path.write_text(text, encoding="utf-8")


def text_of(tables: Mapping[str, Any], case: Case, calibrated_model: CalibratedModel) -> str:
    """The case that ``tables`` describe as TOML, with the fitted numbers in place and ``[calibration]``."""
    import tomlkit

    made = {**with_numbers(tables, case, calibrated_model), "calibration": calibration_of(case, calibrated_model)}
    return f"# {_HEAD}\n\n{tomlkit.dumps(_plain(made))}"


def with_numbers(tables: Mapping[str, Any], case: Case, calibrated_model: CalibratedModel) -> dict[str, Any]:
    """The tables of a case with the fitted numbers in place."""
    made = _copied(tables)
    made["model"] = {**written_out(made.get("model", {}), case), "name": case.model.name}
    known = calibrated_model.subject.inputs
    settings: list[str] = []
    for full, estimate in zip(calibrated_model.response.names, calibrated_model.estimates.values(), strict=False):
        settings.append(f'{_place(known, full)}="{_written(estimate)}"')
        if full == "viscosity" and case.origins.oil:
            # one of the two: what the grade or the data sheet gave is written out
            made["lubricant"] = {k: v for k, v in made["lubricant"].items() if k not in OF_NAMED_OIL}
            for name, quantity in fields_of(Lubricant).items():
                made["lubricant"].setdefault(name, _number(getattr(case.lubricant, name), quantity))
    constant = calibrated_model.estimates.get(CONSTANT_TORQUE.name)
    if constant is not None:
        made.setdefault("losses", {})[CONSTANT_LOSS] = {"law": "known", CONSTANT_TORQUE.name: _written(constant)}
    return case_file.override(made, settings)


def _place(known: Mapping[str, tuple[str, Quantity]], name: str) -> str:
    """The place of an input in a case file; those of the nut have theirs in the name, or are its own fields."""
    section = known[name][0]
    return name if name.startswith(("nut.", "losses.")) else f"{section}.{name}"


def _written(estimate: Estimate) -> str:
    """``0.1095 ± 0.0043``: behind the sign stands half the interval that holds 95 %."""
    value = _number(estimate.value, estimate.quantity)
    if estimate.std is None:
        return str(value)
    return f"{value} ± {_number(normal_half_width(0.95) * estimate.std, estimate.quantity)}"


def _number(value: float, quantity: Quantity) -> str:
    number = f"{units.from_si(value, quantity):.{_DIGITS}g}"
    return number if quantity.unit == "1" else f"{number} {quantity.shown_in}"


def provenance_of(case: Case, calibrated_model: CalibratedModel) -> dict[str, Any]:
    """Origin of a calibration: version, model, log with its hash, settings, sources."""
    name, digest = calibrated_model.rows.log.source or ("", "")
    of_log = {"log": name, "sha256": digest, "settings": calibrated_model.settings}
    return {**of_case(case), **of_log, "references": references(case)}


def calibration_of(case: Case, calibrated_model: CalibratedModel) -> dict[str, Any]:
    """Values of ``[calibration]``, in SI."""
    estimates = list(calibrated_model.estimates.values())
    told = [estimate.identified for estimate in estimates]
    full = [
        *calibrated_model.response.names,
        *([CONSTANT_INPUT] if CONSTANT_TORQUE.name in calibrated_model.estimates else []),
    ]
    names = [name for name, known in zip(full, told, strict=True) if known]
    covariance = calibrated_model.uncertainty.covariance[: len(told), : len(told)][np.ix_(told, told)]
    return {
        **provenance_of(case, calibrated_model),
        "numbers": names,
        "values": [estimate.value for estimate in estimates if estimate.identified],
        "covariance": covariance.tolist(),
        "not_identified": [n for n, known in zip(full, told, strict=True) if not known],
        "residual_rms": f"{calibrated_model.residual_rms:.6g} N m",
        **({} if calibrated_model.holdout_rms is None else {"holdout_rms": f"{calibrated_model.holdout_rms:.6g} N m"}),
        "verdicts": list(calibrated_model.verdicts),
        "warnings": list(calibrated_model.warnings),
    }


def _plain(value: Any) -> Any:
    """Tables that TOML can hold: no nulls."""
    if isinstance(value, Mapping):
        return {key: _plain(item) for key, item in value.items() if item is not None}
    return [_plain(item) for item in value] if isinstance(value, list | tuple) else value


def _copied(value: Any) -> Any:
    return {key: _copied(item) for key, item in value.items()} if isinstance(value, Mapping) else value
