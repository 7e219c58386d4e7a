"""Response models of the API for a fit."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.fit.answer import FitResults
from ballscrew.questions.shared.answer_parts import Closed, Record, Shown, Tables, field
from ballscrew.questions.shared.declared import schema


class Calibrated(Closed):
    """The case with the fitted numbers and ``[calibration]``."""

    toml: str
    case: Tables


class Fit(schema(FitResults), Shown):
    """A case fitted to a log."""

    units: Tables
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record] = Field(description="also what cannot be told apart")
    inputs: Tables
    provenance: Tables
    assumed: list[str] = field(optional=True)
    calibrated: Calibrated
