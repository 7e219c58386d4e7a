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


def document(case: Case, motion_fit: MotionFit) -> dict[str, Any]:
    """Estimates, errors of the three models, what the filter does, what cannot be identified, provenance."""
    crossed = {} if motion_fit.test is None else {"cross_error": motion_fit.cross_error}
    name, digest = motion_fit.equation.log.source or ("log", "")
    settings = {} if motion_fit.screw is None else {"free": list(motion_fit.screw.friction.asked)}
    own = keys_in(documentation(type(motion_fit))) + keys_in(documentation(fit_motion))
    return {
        "kind": "motion",
        "model": motion_fit.model,
        "estimates": {name: _estimate(estimate) for name, estimate in motion_fit.estimates.items()},
        "relative_error": motion_fit.relative_error,
        **crossed,
        "models": {name: _model(motion_fit, name) for name in motion_fit.relative_errors},
        "speed_exponent": _exponent(motion_fit),
        "filter": _filter(motion_fit),
        "verdicts": [],
        "checks": [],
        "warnings": documents(motion_fit.warning_records),
        "rows": _rows(motion_fit),
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


def _model(motion_fit: MotionFit, name: str) -> dict[str, Any]:
    """The numbers of one model, its relative error, and that on the other log."""
    crossed = {} if motion_fit.test is None else {"cross_error": motion_fit.cross_errors[name]}
    if name == SCREW and motion_fit.screw is not None:
        crossed |= {"table_error": motion_fit.screw.table_error}
    return {"numbers": _numbers(motion_fit, name), "relative_error": motion_fit.relative_errors[name], **crossed}


def _numbers(motion_fit: MotionFit, name: str) -> dict[str, float]:
    if name == LINEAR:
        return dict(zip(NAMES, motion_fit.linear.values.tolist(), strict=True))
    if name == POWER:
        assert motion_fit.power is not None
        shared = attributes(motion_fit.power, "mass", "offset", "constant_force", "coefficient")
        return {**shared, "speed_exponent": motion_fit.power.exponent}
    screw = motion_fit.screw
    assert name == SCREW
    assert screw is not None
    return {
        **attributes(screw, "mass", "offset", "constant_force"),
        "remaining_viscous_coefficient": screw.viscous_coefficient,
        **dict(zip(screw.friction.asked, screw.numbers.tolist(), strict=True)),
        "carried_mass": screw.carried_mass,
    }


def _exponent(motion_fit: MotionFit) -> dict[str, Any] | None:
    power = motion_fit.power
    if power is None:
        return None
    own = {"value": power.exponent, "bootstrap_interval": list(power.bootstrap)}
    return {**own, **attributes(power, "interval", "choices")}


def _filter(motion_fit: MotionFit) -> dict[str, Any]:
    """The filters that the noise asked for, and the linear model under others."""
    equation = motion_fit.equation
    effects = [
        {"name": e.name, **dict(zip(NAMES, e.values.tolist(), strict=True)), "relative_error": e.relative_error}
        for e in motion_fit.filter_effects
    ]
    return {
        "cutoff": equation.cutoff,
        "position_cutoff": equation.kinematics.cutoff,
        "unit": "Hz",
        "noise": equation.kinematics.noise,
        "noise_unit": "m" if equation.log.position is not None else "m/s",
        "dead_time_corrected": motion_fit.dead_time.corrected,
        "effects": effects,
    }


def _rows(motion_fit: MotionFit) -> dict[str, Any]:
    equation = motion_fit.equation
    return {
        "read": equation.log.rows,
        "checked": len(equation.log),
        "used": int(equation.used.size),
        "left_out": dict(equation.left_out),
        "block": motion_fit.linear.solution.block,
        "blocks": motion_fit.linear.solution.blocks,
        "notes": list(equation.log.notes),
    }
