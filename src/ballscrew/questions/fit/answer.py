"""The documents of a fit: its results and the columns of a log, all in SI."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Info, TemperatureDifference, Torque
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import fitted_case
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.evidence.calibration.calibrated_model import CalibratedModel
from ballscrew.evidence.calibration.fit_result import Estimate, Trend
from ballscrew.evidence.calibration.identifiability import Combination
from ballscrew.evidence.calibration.response import TEMPERATURE_ERROR
from ballscrew.files.tables.headings import NO_COLUMN
from ballscrew.files.torque_logs.columns import COLUMNS
from ballscrew.files.torque_logs.reading import Preview, SeenColumn
from ballscrew.questions.fit.compute import Candidate, FitReport
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import Column, from_attributes


class FittedNumber(NamedTuple):
    """A fitted number; without a standard error and an interval where the log does not tell it."""

    #: The estimate, SI.
    value: Annotated[float, Column("")]
    #: Standard error, SI.
    std: Annotated[float | None, Column("error")]
    #: Lower end of the interval of 95 %, SI.
    low: Annotated[float | None, Column("low")]
    #: Upper end of the interval of 95 %, SI.
    high: Annotated[float | None, Column("high")]
    #: True where the log tells it.
    identified: Annotated[bool, Column("identified")]
    #: SI unit of the number.
    unit: str
    #: The value before the fit, SI.
    start: float
    #: True at a bound of the number.
    at_bound: bool
    #: Variance after the fit over that of the prior: 1 where the log adds nothing, 0 without a prior.
    prior_share: float
    #: Share of the variance by the error of the oil temperature.
    temperature_share: float
    #: Change for an oil that was a kelvin warmer than logged, SI.
    per_kelvin: float


class Score(NamedTuple):
    """Root mean square of residuals, without outliers."""

    fitted_rms: Annotated[Torque, Info("", "over the rows fitted")]
    holdout_rms: Annotated[Torque, Info("", "over the rows held out")]


class Identifiability(NamedTuple):
    """The numbers and products of numbers that the log tells."""

    #: Singular values of the derivatives by the scaled numbers, the largest first.
    singular_values: NDArray[np.float64]
    #: Products of powers of the numbers, the best known first.
    combinations: Sequence[Combination]


class Covariance(NamedTuple):
    """Covariance of the fitted numbers, SI; null where one of the two is not identified."""

    #: The numbers, in the order of rows and columns.
    names: Sequence[str]
    #: One row for each number.
    matrix: Sequence[Sequence[float | None]]


class NextTest(NamedTuple):
    """The test that would teach most."""

    #: Its operating point, SI.
    point: Mapping[str, float]
    #: Readings of the test; in both directions where the log has both.
    readings: int
    #: Volume of the joint confidence region of the numbers, over that without the test.
    remaining_volume: float
    #: The same after a random test, the median.
    random_remaining_volume: float
    #: By number, the standard error after the test over that before.
    remaining_error: Mapping[str, float]


class FitRows(NamedTuple):
    """The rows of a log, and why some were left out."""

    #: Rows of the log.
    read: int
    #: Rows that count, those held out among them.
    used: int
    #: Rows that were not fitted to.
    held_out: int
    #: Rows that are outliers.
    outliers: int
    #: Rows that were left out, by reason.
    left_out: Mapping[str, int]
    #: What is to be said of the log.
    notes: Sequence[str]
    #: What the torque was read as.
    torque: str


@dataclasses.dataclass(frozen=True, eq=False)
class FitResults:
    """A case fitted to a log."""

    #: Fitted numbers, by name.
    estimates: Mapping[str, FittedNumber]
    temperature_error: Annotated[TemperatureDifference, TEMPERATURE_ERROR.info]
    residual_rms: Annotated[Torque, Info("", "residuals of the rows fitted, root mean square"), Column("residual rms")]
    holdout_rms: Annotated[
        Torque | None, Info("", "residuals of the rows held out, root mean square"), Column("held out rms")
    ]
    #: Errors of the sensor that were fitted, by name.
    sensor: Mapping[str, FittedNumber]
    #: How far off the model is before and after the fit, and descriptions without physics.
    scores: Mapping[str, Score]
    #: What the log tells of the numbers together.
    identifiability: Identifiability
    #: Covariance of the fitted numbers.
    covariance: Covariance
    #: Means of the residuals by fifths of the rows, in the order of each column of the log.
    residuals: Mapping[str, Trend]
    #: The test that would teach most; null where no point within the limits is valid.
    next_test: NextTest | None
    #: The rows of the log.
    rows: FitRows


def results(report: FitReport) -> FitResults:
    """The results of a fit."""
    model, test, shift = report.model, report.next_test, report.model.temperature_error.shift.tolist()
    return from_attributes(
        FitResults,
        model,
        estimates=_numbers(model.estimates, shift),
        temperature_error=model.temperature_error.half_width,
        sensor=_numbers(model.sensor, shift[len(model.estimates) :]),
        scores={one.description: Score(one.fitted, one.held_out) for one in model.scores},
        identifiability=from_attributes(Identifiability, model.identifiability),
        covariance=Covariance(list(model.estimates), _covariance(model)),
        residuals=model.rows.trends,
        next_test=test
        and from_attributes(
            NextTest,
            test,
            point=test.best,
            remaining_volume=test.best_volume,
            random_remaining_volume=test.random_volume,
        ),
        rows=_rows(model),
    )


def _numbers(estimates: Mapping[str, Estimate], shifts: Sequence[float]) -> dict[str, FittedNumber]:
    """Estimates by name, with their shifts by the temperature of the oil."""
    return {
        name: fitted_number(estimate, per_kelvin)
        for (name, estimate), per_kelvin in zip(estimates.items(), shifts, strict=False)
    }


def fitted_number(estimate: Estimate, per_kelvin: float) -> FittedNumber:
    """An estimate with its interval of 95 %."""
    low, high = estimate.interval() or (None, None)
    unit = estimate.quantity.unit
    return from_attributes(FittedNumber, estimate, low=low, high=high, unit=unit, per_kelvin=per_kelvin)


def _covariance(model: CalibratedModel) -> list[list[float | None]]:
    identified = [estimate.identified for estimate in model.estimates.values()]
    matrix = model.uncertainty.covariance[: len(identified), : len(identified)].tolist()
    return [[x if identified[i] and identified[j] else None for j, x in enumerate(row)] for i, row in enumerate(matrix)]


def _rows(model: CalibratedModel) -> FitRows:
    rows, log = model.rows, model.rows.log
    return FitRows(
        read=log.rows,
        used=len(log),
        held_out=int(rows.held_out.sum()),
        outliers=int(rows.outlying.sum()),
        left_out=log.left_out,
        notes=log.notes,
        torque=rows.convention.description,
    )


def document(case: Case, report: FitReport) -> dict[str, Any]:
    """Estimates, residuals, what cannot be identified, the next test, warnings and provenance."""
    model, result = report.model, results(report)
    return {
        **declared.document(result),
        "units": declared.units(result),
        "verdicts": documents(model.verdict_records),
        "checks": [],
        "warnings": documents(model.warning_records),
        "inputs": inputs(case),
        "provenance": fitted_case.provenance_of(case, model),
        **({"assumed": list(report.assumed)} if report.assumed else {}),
    }


class KnownColumn(NamedTuple):
    """A column that a log may have."""

    name: str
    meaning: str
    #: SI.
    unit: str
    shown_in: str
    required: bool


class FreeNumber(NamedTuple):
    """A number that may be fitted."""

    name: str
    meaning: str
    symbol: str
    #: SI.
    unit: str
    shown_in: str
    #: In the case, SI.
    value: float


class LogColumns(NamedTuple):
    """The columns of a log, and what may be fitted to it."""

    file: str
    #: Of a moving axis: ballscrew fit takes it, this address does not.
    moving: bool
    columns: Sequence[SeenColumn]
    more_columns: int
    #: Values that count in every row, SI.
    constants: Mapping[str, float]
    known: Sequence[KnownColumn]
    #: Columns that are needed and not there.
    missing: Sequence[str]
    #: Numbers that are usually uncertain.
    free: Sequence[FreeNumber]


def columns_document(preview: Preview, candidates: Sequence[Candidate], *, moving: bool) -> dict[str, Any]:
    """The columns of a file, the columns that a log may have, and the numbers that may be fitted."""
    answer = from_attributes(
        LogColumns,
        preview,
        moving=moving,
        known=[
            KnownColumn(column.name, quantity.info.meaning, quantity.unit, quantity.shown_in, column.required)
            for column in COLUMNS
            if (quantity := column.quantity) is not None
        ],
        missing=[fault.column for fault in preview.faults if fault.id == NO_COLUMN],
        free=[
            FreeNumber(name, quantity.info.meaning, quantity.info.symbol, quantity.unit, quantity.shown_in, value)
            for name, quantity, value in candidates
        ],
    )
    faults = [{**fault.document(), "column": fault.column} for fault in preview.faults]
    return {**declared.document(answer), "faults": faults}
