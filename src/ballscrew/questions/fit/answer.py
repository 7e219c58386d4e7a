"""Response models of the API for a fit."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, Number, Numbers, Record, Tables, Template, field


class Estimate(Closed):
    """A fitted number; without a standard error and an interval where the log does not tell it."""

    value: Number = Field(description="SI")
    std: Number = Field(description="standard error, SI")
    low: Number = Field(description="of the interval of 95 %, SI")
    high: Number
    identified: bool
    unit: str = Field(description="SI")
    start: Number = Field(description="before the fit, SI")
    at_bound: bool
    prior_share: Number
    temperature_share: Number = Field(description="of the variance, by the error of the oil temperature")
    per_kelvin: Number = Field(description="change for an oil that was a kelvin warmer than logged, SI")


class Score(Closed):
    """Root mean square of residuals."""

    fitted_rms: Number = field("over the rows fitted", "N m")
    holdout_rms: Number = field("over the rows held out", "N m")


class Trend(Closed):
    """Means of residuals by fifths of the rows."""

    values: list[Number]
    means: list[Number] = field("", "N m")
    errors: list[Number] = field("", "N m")


class NextTest(Closed):
    """The test that would teach most."""

    point: Numbers
    readings: int
    remaining_volume: Number
    random_remaining_volume: Number
    remaining_error: Numbers


class FitRows(Closed):
    """The rows of a log, and why some were left out."""

    read: int
    used: int
    held_out: int
    outliers: int
    left_out: dict[str, int]
    notes: list[str]
    torque: str = Field(description="what the torque was read as")


class FitWords(Closed):
    """What a fit says in words."""

    title: str
    trade_off: str = Field(description="numbers that make up for each other")
    next_test: list[str]


class FitDisplay(Closed):
    """The same to be shown in any units."""

    next_test: list[Template]


class Calibrated(Closed):
    """The case with the fitted numbers and ``[calibration]``."""

    toml: str
    case: Tables


class Fit(Closed):
    """A case fitted to a log."""

    estimates: dict[str, Estimate]
    temperature_error: Number = field("half the 95 % interval of the oil temperature, in the intervals", "K")
    residual_rms: Number
    holdout_rms: Number
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record] = Field(description="also what cannot be told apart")
    sensor: dict[str, Estimate]
    scores: dict[str, Score]
    identifiability: Tables
    covariance: Tables
    residuals: dict[str, Trend]
    next_test: NextTest | None
    rows: FitRows
    inputs: Tables
    provenance: Tables
    assumed: list[str] = field(optional=True)
    words: FitWords
    display: FitDisplay
    picture: Tables
    calibrated: Calibrated
