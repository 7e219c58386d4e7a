"""Response models of the API for logs, services and hand-overs."""

from __future__ import annotations

from pydantic import Field

from ballscrew.api_answers.parts import Closed, Number, Numbers, Record, Tables, Template, field


class SeenColumn(Closed):
    """A column of a file."""

    heading: str
    bare_heading: str = Field(description="without its unit")
    taken_for: str = Field(description="the name of a column of a log; empty where it is not used")
    unit: str
    cells: list[str] = Field(description="the first cells, as written")


class KnownColumn(Closed):
    """A column that a log may have."""

    name: str
    meaning: str
    unit: str = Field(description="SI")
    shown_in: str
    required: bool


class Candidate(Closed):
    """A number that may be fitted."""

    name: str
    meaning: str
    symbol: str
    unit: str = Field(description="SI")
    shown_in: str
    value: Number = Field(description="in the case, SI")


class ColumnFault(Closed):
    """A fault of the columns of a log."""

    where: str
    problem: str
    given: str
    remedy: str = Field(description="on the command line")
    column: str = Field(description="that it is about; may be empty")


class Log(Closed):
    """The columns of a log, and what may be fitted to it."""

    file: str
    moving: bool = Field(description="of a moving axis: ballscrew fit takes it, this address does not")
    columns: list[SeenColumn]
    more_columns: int
    constants: Numbers = Field(description="values that count in every row, SI")
    known: list[KnownColumn]
    missing: list[str] = Field(description="columns that are needed and not there")
    free: list[Candidate] = Field(description="numbers that are usually uncertain")
    faults: list[ColumnFault] = Field(description="for which the log cannot be read as it is")


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


class ServiceWords(Closed):
    """What a service says beside its verdicts."""

    title: str
    causes: list[str]


class ServiceDisplay(Closed):
    """The verdicts, to be shown in any units."""

    verdicts: list[Template]


class Service(Closed):
    """The preload that is left in a nut."""

    inputs: Tables
    results: Tables
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
    words: ServiceWords
    display: ServiceDisplay
    picture: Tables


class ExampleLog(Closed):
    """A log to try."""

    name: str
    text: str


class Example(Closed):
    """A case, and logs that belong to it."""

    file: str
    case: Tables
    logs: list[ExampleLog]
    free: list[str] = Field(description="numbers to fit to the logs")


class Examples(Closed):
    """Logs to try; no screw was measured for them."""

    fit: Example
    service: Example


class Choice(Closed):
    """A choice that a target has."""

    name: str
    default: str
    meaning: str


class Target(Closed):
    """A target of a hand-over."""

    name: str
    meaning: str
    options: list[Choice]


class Targets(Closed):
    """The targets of a hand-over."""

    targets: list[Target]


class SentContent(Closed):
    """A file of a hand-over, or a zip archive of several."""

    name: str
    media_type: str
    base64: str


class HandOverWords(Closed):
    """What a hand-over says: ranges, worst errors, warnings."""

    lines: list[str]


class HandOver(Closed):
    """A model handed over: its files, their range and their worst error."""

    inputs: Tables
    results: Tables
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
    words: HandOverWords
    file: SentContent
