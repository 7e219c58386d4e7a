"""``ballscrew fit --json`` on a moving log: the document of the fit; all in SI."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.basis.references import documentation, keys_in
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.moving_logs.linear_model import NAMES
from ballscrew.evidence.moving_logs.motion_fit import LINEAR, POWER, SCREW, MotionEstimate, MotionFit, fit_motion
from ballscrew.questions.shared.declared import attributes


def document(case: Case, found: MotionFit) -> dict[str, Any]:
    """Estimates, errors of the three models, what the filter does, what cannot be identified, provenance."""
    crossed = {} if found.test is None else {"cross_error": found.cross_error}
    name, digest = found.equation.log.source or ("log", "")
    settings = {} if found.screw is None else {"free": list(found.screw.friction.asked)}
    own = keys_in(documentation(type(found))) + keys_in(documentation(fit_motion))
    return {
        "kind": "motion",
        "model": found.model,
        "estimates": {name: _estimate(estimate) for name, estimate in found.estimates.items()},
        "relative_error": found.relative_error,
        **crossed,
        "models": {name: _model(found, name) for name in found.relative_errors},
        "speed_exponent": _exponent(found),
        "filter": _filter(found),
        "verdicts": [],
        "checks": [],
        "warnings": documents(found.warning_records),
        "rows": _rows(found),
        "inputs": case_file.inputs(case),
        "provenance": {
            **provenance.of_case(case),
            "log": name,
            "sha256": digest,
            "settings": settings,
            "references": list(dict.fromkeys([*provenance.references(case), *own])),
        },
    }


def _estimate(estimate: MotionEstimate) -> dict[str, Any]:
    return {
        **attributes(estimate, "value", "std", "interval", "identified"),
        "unit": estimate.quantity.unit,
        **attributes(estimate, "model", "at_bound", "given"),
    }


def _model(found: MotionFit, name: str) -> dict[str, Any]:
    """The numbers of one model, its relative error, and that on the other log."""
    crossed = {} if found.test is None else {"cross_error": found.cross_errors[name]}
    if name == SCREW and found.screw is not None:
        crossed |= {"table_error": found.screw.table_error}
    return {"numbers": _numbers(found, name), "relative_error": found.relative_errors[name], **crossed}


def _numbers(found: MotionFit, name: str) -> dict[str, float]:
    if name == LINEAR:
        return dict(zip(NAMES, found.linear.values.tolist(), strict=True))
    if name == POWER:
        assert found.power is not None
        shared = attributes(found.power, "mass", "offset", "constant_force", "coefficient")
        return {**shared, "speed_exponent": found.power.exponent}
    screw = found.screw
    assert name == SCREW
    assert screw is not None
    return {
        **attributes(screw, "mass", "offset", "constant_force"),
        "remaining_viscous_coefficient": screw.viscous_coefficient,
        **dict(zip(screw.friction.asked, screw.numbers.tolist(), strict=True)),
        "carried_mass": screw.carried_mass,
    }


def _exponent(found: MotionFit) -> dict[str, Any] | None:
    power = found.power
    if power is None:
        return None
    own = {"value": power.exponent, "bootstrap_interval": list(power.bootstrap)}
    return {**own, **attributes(power, "interval", "choices")}


def _filter(found: MotionFit) -> dict[str, Any]:
    """The filters that the noise asked for, and the linear model under others."""
    equation = found.equation
    effects = [
        {"name": e.name, **dict(zip(NAMES, e.values.tolist(), strict=True)), "relative_error": e.relative_error}
        for e in found.filter_effects
    ]
    return {
        "cutoff": equation.cutoff,
        "position_cutoff": equation.kinematics.cutoff,
        "unit": "Hz",
        "noise": equation.kinematics.noise,
        "noise_unit": "m" if equation.log.position is not None else "m/s",
        "dead_time_corrected": found.dead_time.corrected,
        "effects": effects,
    }


def _rows(found: MotionFit) -> dict[str, Any]:
    equation = found.equation
    return {
        "read": equation.log.rows,
        "checked": len(equation.log),
        "used": int(equation.used.size),
        "left_out": dict(equation.left_out),
        "block": found.linear.solution.block,
        "blocks": found.linear.solution.blocks,
        "notes": list(equation.log.notes),
    }
