"""Response models of the API for a validation."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.shared.answer_parts import (
    Number,
    Open,
)


class ValidationRow(Open):
    """One measured or stated value, and the model beside it."""

    name: str
    unit: str
    value: Number = Field(description="of the model, SI")
    middle: Number = Field(description="of the data, SI")
    low: Number = Field(description="of the vendor's band, SI")
    high: Number = Field(description="of the vendor's band, SI")
    band: list[Number] | None = Field(description="low and high in one; null where there is no band")
    ratio: Number
    in_band: bool | None
    residual: Number = Field(description="SI")
    residual_in_half_bands: Number
    in_uncertainty_band: bool | None = Field(
        default=None, description="whether the model's own 95 % band holds the middle of the data"
    )
    warnings: list[Any]


class ValidationEntry(Open):
    """A set of data against a model."""

    set: str
    model: str
    calibration: str | None
    n: int
    mean_ratio: Number
    std_ratio: Number
    share_in_band: Number
    used_for: list[str] = Field(description="choices of the model that were made with these rows in sight; [] for none")
    rows: list[ValidationRow]
