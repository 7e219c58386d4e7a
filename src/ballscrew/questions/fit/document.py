"""``ballscrew fit --json``: the document of a fit; all in SI."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit_result import Estimate
from ballscrew.evidence.calibration.next_test import NextTest
from ballscrew.questions.fit.compute import FitReport


def document(case: Case, report: FitReport) -> dict[str, Any]:
    """Estimates, residuals, what cannot be identified, the next test, warnings and provenance."""
    model = report.model
    return {
        "estimates": _estimates(model, model.estimates, 0),
        "temperature_error": model.temperature_error.half_width,
        "residual_rms": model.residual_rms,
        "holdout_rms": model.holdout_rms,
        "verdicts": documents(model.verdict_records),
        "checks": [],
        "warnings": documents(model.warning_records),
        "sensor": _estimates(model, model.sensor, len(model.estimates)),
        "scores": {s.description: {"fitted_rms": s.fitted, "holdout_rms": s.held_out} for s in model.scores},
        "identifiability": {
            "singular_values": model.identifiability.singular_values,
            "combinations": [dataclasses.asdict(c) for c in model.identifiability.combinations],
        },
        "covariance": {"names": list(model.estimates), "matrix": _covariance(model)},
        "residuals": {name: trend._asdict() for name, trend in model.rows.trends.items()},
        "next_test": None if report.next_test is None else _next_test(report.next_test),
        "rows": _rows(model),
        "inputs": case_file.inputs(case),
        "provenance": fitted_case.provenance_of(case, model),
        **({"assumed": list(report.assumed)} if report.assumed else {}),
    }


def _next_test(test: NextTest) -> dict[str, Any]:
    return {
        "point": test.best,
        "readings": test.readings,
        "remaining_volume": test.best_volume,
        "random_remaining_volume": test.random_volume,
        "remaining_error": test.remaining_error,
    }


def _estimates(model: CalibratedModel, found: Mapping[str, Estimate], first: int) -> dict[str, Any]:
    """Estimates by name, of which the first has this place among all parameters."""
    shift = model.temperature_error.shift[first:].tolist()
    return {
        name: {**_estimate(estimate), "per_kelvin": by_temperature}
        for (name, estimate), by_temperature in zip(found.items(), shift, strict=False)
    }


def _estimate(estimate: Estimate) -> dict[str, Any]:
    low, high = estimate.interval() or (None, None)
    return {
        "value": estimate.value,
        "std": estimate.std,
        "low": low,
        "high": high,
        "identified": estimate.identified,
        "unit": estimate.quantity.unit,
        "start": estimate.start,
        "at_bound": estimate.at_bound,
        "prior_share": estimate.prior_share,
        "temperature_share": estimate.temperature_share,
    }


def _covariance(model: CalibratedModel) -> list[list[float | None]]:
    """Covariance of the numbers asked for; null where one of the two is not identified."""
    identified = [estimate.identified for estimate in model.estimates.values()]
    matrix = model.uncertainty.covariance[: len(identified), : len(identified)].tolist()
    return [[x if identified[i] and identified[j] else None for j, x in enumerate(row)] for i, row in enumerate(matrix)]


def _rows(model: CalibratedModel) -> dict[str, Any]:
    log = model.rows.log
    return {
        "read": log.rows,
        "used": len(log),
        "held_out": int(model.rows.held_out.sum()),
        "outliers": int(model.rows.outlying.sum()),
        "left_out": dict(log.left_out),
        "notes": list(log.notes),
        "torque": model.rows.convention.description,
    }
