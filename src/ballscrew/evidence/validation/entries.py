"""A model against what vendors and laboratories state: row by row, and what the rows say together.

A set of data (:mod:`ballscrew.evidence.validation.sets`) makes points of the rows of a table. A point has the value of
the model and that of the table, most often the middle of a vendor's band.
"""

from __future__ import annotations

import csv
import dataclasses
import functools
import math
import re
import tomllib
from collections.abc import Callable, Mapping, Sequence
from importlib import resources
from typing import Any, NamedTuple, TypeAlias

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import AngularSpeed, Info, Quantity, Temperature, Viscosity, fields_of
from ballscrew.basis.records import Record
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import DoubleNut, Nut, OffsetLeadNut, OversizeBallNut
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import calibrations
from ballscrew.physics.friction.model import FrictionModel

#: Rows that count as near, and how far off the nearest may be, as a distance of logarithms of diameter and lead.
NEAREST, FARTHEST = 6, math.log(1.6)
#: The set of a kind of nut.
_SETS: Mapping[type[Nut], str] = {
    DoubleNut: "rexroth-double-nut",
    OffsetLeadNut: "rexroth-double-nut",
    OversizeBallNut: "rexroth-single-nut",
}
#: A column of least torques at a share of the dynamic load rating.
_LEAST = re.compile(r"no_load_torque_(\d+)pct_min_Nm")
#: The column of the model as it is.
UNCALIBRATED = "uncalibrated"


class NearRows(NamedTuple):
    """The reference model against the rows of a vendor nearest in size and lead: model / middle of the band."""

    data: str
    rows: Sequence[str]
    mean: float
    scatter: float
    #: Of each row model / middle, and the ends of the vendor's band of the no-load torque, N m.
    ratios: Sequence[float]
    bands: Sequence[tuple[float, float]]


def near_rows(screw: BallScrew, calibration: str | None = None) -> NearRows | None:
    """The rows of a vendor most like a preloaded screw, by the ratios of diameters and of leads.

    The ratios are those of the reference model, with a calibration by its name or without, as
    ``benchmarks/fit_calibration.py --write`` stored them; no load, 100 rpm. With a calibration they are the
    rows that it was fitted to. None for a nut that no set is about, such as one with spacer balls, that is far from
    all rows, and for a calibration that was not stored.
    """
    name = _SETS.get(type(screw.nut))
    rows = [row for row in _ratios() if row["set"] == name]
    column = calibration or UNCALIBRATED
    if not rows or column not in rows[0] or screw.nut.spacer_balls:
        return None
    place = math.log(float(np.mean(screw.pitch_circle_diameter))), math.log(float(np.mean(screw.lead)))
    distances = [
        math.hypot(math.log(float(row["size"])) - place[0], math.log(float(row["lead"])) - place[1]) for row in rows
    ]
    if not min(distances) <= FARTHEST:
        return None
    near = [rows[i] for i in np.argsort(distances, kind="stable")[:NEAREST]]
    ratios = [float(row[column]) for row in near]
    names = [row["row"] for row in near]
    bands = [_bands(str(name))[row] for row in names]
    return NearRows(str(name), names, float(np.mean(ratios)), float(np.std(ratios, ddof=1)), ratios, bands)


@functools.cache
def _ratios() -> Sequence[Mapping[str, str]]:
    return _read("ratios")


@functools.cache
def _bands(data: str) -> Mapping[str, tuple[float, float]]:
    """The no-load torques of a vendor's rows, least and greatest, by the names that the stored ratios have."""
    bands: dict[str, tuple[float, float]] = {}
    for row in _read(data):
        sizes = "x".join(row[f"{name}_mm"] for name in ("nominal_diameter", "lead", "ball_diameter"))
        for column, least in row.items():
            if (share := _LEAST.fullmatch(column)) is not None:
                greatest = float(row[column.replace("_min_", "_max_")])
                bands[f"{sizes}-{row['circuits']} at {share[1]} %"] = float(least), greatest
    return bands


def _read(data: str) -> Sequence[Mapping[str, str]]:
    text = resources.files("ballscrew").joinpath(f"data/validation/{data}.csv").read_text(encoding="utf-8")
    return list(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))


RPM = math.pi / 30
#: Values of a row in SI (or text) by column.
Values: TypeAlias = Mapping[str, Any]


class Descriptor(NamedTuple):
    """A property of a row, to see which effect a model lacks."""

    description: str
    quantity: Quantity


def _descriptor(name: str, unit: str, words: str, shown_in: str = "") -> Descriptor:
    return Descriptor(words, Quantity(name, unit, Info(name, words, shown_in)))


#: What rows may differ in, by name.
DESCRIPTORS: Mapping[str, Descriptor] = {
    "size": _descriptor("size", "m", "nominal diameter", "mm"),
    "lead": _descriptor("lead", "m", "lead", "mm"),
    "steepness": _descriptor("steepness", "1", "lead / nominal diameter"),
    "ball": _descriptor("ball", "m", "ball diameter", "mm"),
    "preload_share": _descriptor("preload_share", "1", "preload / dynamic load rating"),
    "film_parameter": _descriptor("film_parameter", "1", "film parameter at the screw"),
    "speed": _descriptor("speed", "rad/s", "speed", "rpm"),
    "bore": _descriptor("bore", "m", "bore", "mm"),
    "preload": _descriptor("preload", "N", "preload"),
}


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Conditions:
    """Oil and speed at which a model is asked. The defaults are 100 rpm, which vendors name, and an assumed oil."""

    grade: str = "ISO VG 100"
    temperature: Temperature = 298.15
    #: In place of grade and temperature.
    viscosity: Viscosity | None = None
    screw_speed: AngularSpeed = 100 * RPM

    def of(self, values: Values) -> Conditions:
        """These conditions, but for those that a row has of its own.

        Raises :class:`~ballscrew.basis.errors.InputError` for a viscosity beside a grade or a temperature.
        """
        own = {name: values[name] for name in CONDITIONS if name in values}
        if "viscosity" in own and ("grade" in own or "temperature" in own):
            raise InputError(Fault("row.viscosity", "contradicts the grade", "", "give one of the two"))
        return dataclasses.replace(self, **own)

    @property
    def lubricant(self) -> Lubricant:
        """The oil. Raises :class:`~ballscrew.basis.errors.InputError` for an unknown grade, or a temperature out of
        range.
        """
        if self.viscosity is not None:
            return Lubricant(viscosity=self.viscosity)
        return Lubricant.from_grade(self.grade, self.temperature)


def _magnitude(quantity: Quantity) -> Quantity:
    """The quantity without its sign, as tables state it."""
    return dataclasses.replace(quantity, info=dataclasses.replace(quantity.info, at_least=0))


#: The conditions that a row may have of its own, by column; None is text.
CONDITIONS: Mapping[str, Quantity | None] = {
    "grade": None,
    "temperature": TEMPERATURE,
    "viscosity": fields_of(Lubricant)["viscosity"],
    "screw_speed": _magnitude(fields_of(OperatingState)["screw_speed"]),
}


class Band(NamedTuple):
    """The statement of a row: its middle, and the ends of the band where it has one."""

    middle: float
    low: float | None = None
    high: float | None = None

    def holds(self, value: float) -> bool | None:
        """True where a value lies in the band, ends included; None where there is no band or no value."""
        return (
            None
            if self.low is None or self.high is None or not math.isfinite(value)
            else self.low <= value <= self.high
        )


class UpperLimitOnly(NamedTuple):
    """A value of which a row states only a maximum: reported, but in no mean."""

    name: str
    value: float
    maximum: float

    @property
    def ratio(self) -> float:
        """Model / maximum."""
        return self.value / self.maximum


class OperatingPoint(NamedTuple):
    """The screw, the oil and the state that a value of a model is of."""

    screw: BallScrew
    lubricant: Lubricant
    axial_load: float
    screw_speed: float


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Point:
    """One value of a model and of a row, SI."""

    name: str
    value: float
    band: Band
    #: What the row is like, by the names of DESCRIPTORS.
    descriptors: Mapping[str, float]
    #: Ratios to the same middle of other definitions and of other laws, by name.
    definitions: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    laws: Mapping[str, float] = dataclasses.field(default_factory=dict[str, float])
    upper_limits: Sequence[UpperLimitOnly] = ()
    #: Conditions of the model that fail at the point.
    warnings: Sequence[Record] = ()
    #: What the row is one of, where rows of a set differ in kind: the kind of its nut, or its maker.
    group: str = ""
    #: What the value was computed of, where that is one state of one screw.
    computed_at: OperatingPoint | None = None
    #: The ends of the uncertainty band of the value, where one was computed.
    uncertainty: tuple[float, float] | None = None

    @property
    def ratio(self) -> float:
        """Model / middle of the band."""
        return self.value / self.band.middle

    @property
    def residual(self) -> float:
        """Model − middle of the band."""
        return self.value - self.band.middle

    @property
    def deviation(self) -> float | None:
        """Model − middle, in halves of the band; None where there is no band."""
        low, high = self.band.low, self.band.high
        return None if low is None or high is None else 2 * self.residual / (high - low)

    @property
    def in_band(self) -> bool | None:
        """True where the value lies in the band, ends included; None where there is no band or no value."""
        return self.band.holds(self.value)

    @property
    def in_uncertainty_band(self) -> bool | None:
        """True where the middle of the statement lies in the uncertainty band of the value; None without a band."""
        if self.uncertainty is None or not all(map(math.isfinite, self.uncertainty)):
            return None
        low, high = self.uncertainty
        return low <= self.band.middle <= high


Evaluation: TypeAlias = Callable[[FrictionModel, Values, Conditions], list[Point]]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class ValidationSet:
    """A declared set of data: the columns of its rows, and the evaluation of a model for a row.

    ``evaluate`` raises :class:`~ballscrew.basis.errors.InputError` for rows that make no sense.
    """

    name: str
    #: The quantity compared, and the values it is compared with.
    title: str
    reference: str
    source: str
    #: The file with the rows shipped, in ``data/validation``.
    file: str
    #: Unit of the values, and the one people think in.
    quantity: Quantity
    #: Who states the values, in a word.
    maker: str
    #: What the rows state, by column, beside the size of the screw; None is text.
    columns: Mapping[str, Quantity | None]
    #: Columns without which a row is no use; those of a catalogue row are asked for where it is of a screw.
    required: Sequence[str]
    evaluate: Evaluation
    #: Two names of DESCRIPTORS to draw the ratio against.
    axes: tuple[str, str]
    #: Details of the quantity compared.
    details: str = ""
    #: Other names of columns, by column.
    aliases: Mapping[str, tuple[str, ...]] = dataclasses.field(default_factory=dict[str, tuple[str, ...]])
    #: Oil and speed, where they count.
    conditions: Conditions = dataclasses.field(default_factory=Conditions)
    #: What of the reference model was chosen with these rows in sight, calibrations aside; empty where nothing was.
    used_for: Sequence[str] = ()
    #: Rules of one line that the stated values are computed by, as far as their digits tell.
    rules_behind: Sequence[str] = ()
    #: Names in documents of the ratios of definitions; ``""`` is that of the value compared.
    ratio_names: Mapping[str, str] = dataclasses.field(default_factory=dict[str, str])
    #: Whether rows are of screws of a catalogue.
    of_screws: bool = True
    #: Whether a friction coefficient or a ball-to-ball force moves the value.
    calibratable: bool = False
    #: Whether oil and speed move the value, and are those of :class:`Conditions`.
    conditioned: bool = False
    #: Whether the model must know balls with four contacts.
    four_contacts: bool = False
    #: Whether each row could be the one screw that was measured, so that only the range of the ratios says something.
    alternatives: bool = False
    #: Whether what is stated is of a whole that the screw is a part of: an upper bound, and no value to meet.
    bound: bool = False
    #: Whether the screws carry a load.
    loaded: bool = False
    #: Of a torque card who measured, when, and what is not stated.
    card: Mapping[str, Any] | None = None

    @property
    def calibrations(self) -> list[str]:
        """The calibrations that were fitted to the torques of these rows."""
        return [name for name, each in calibrations().items() if self.calibratable and self.file in each.data]

    @property
    def description(self) -> str:
        """The quantity compared, its details, and the values it is compared with."""
        return ", ".join(filter(None, (self.title, self.details, self.reference)))


@functools.cache
def fitted_rows(name: str) -> frozenset[str]:
    """The rows of a set that numbers may be fitted on, as ``data/validation/splits.toml`` declares; empty without."""
    text = resources.files("ballscrew").joinpath("data/validation/splits.toml").read_text(encoding="utf-8")
    return frozenset(tomllib.loads(text).get(name, {}).get("fitted", ()))


def may_be_fitted(name: str, point: Point) -> bool:
    """Test whether a point is of a row that may be fitted: that of ``16x5x3-4 at 7 %`` is ``16x5x3-4``."""
    return point.name.partition(" at ")[0] in fitted_rows(name)


@dataclasses.dataclass(frozen=True, kw_only=True)
class RuleEntry:
    """A rule of one line over the same rows as the model."""

    rule: str
    n: int
    mean_ratio: float
    std_ratio: float
    share_in_band: float | None
    #: Least and greatest ratio.
    range_ratio: tuple[float, float]
    #: Exponents of the ratio over diameter and lead, see :func:`exponents`.
    exponents: Mapping[str, float]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Entry:
    """A set evaluated with one model."""

    data: ValidationSet
    model: FrictionModel
    calibration: str | None
    points: Sequence[Point]

    @property
    def used_for(self) -> list[str]:
        """Choices made with these rows in sight: of the model, and the calibrations that were fitted to them."""
        return [*self.data.used_for, *(f"calibration {name}, fitted" for name in self.data.calibrations)]

    @property
    def counted(self) -> Sequence[Point]:
        """The points with a number."""
        return [point for point in self.points if math.isfinite(point.ratio)]

    @property
    def mean_ratio(self) -> float:
        """Mean of model / middle."""
        return mean([point.ratio for point in self.counted])

    @property
    def std_ratio(self) -> float:
        """Standard deviation of model / middle, of a sample: divided by n − 1. NaN for less than two points."""
        return scatter([point.ratio for point in self.counted])

    @property
    def range_ratio(self) -> tuple[float, float]:
        """Least and greatest ratio; NaN of nothing."""
        ratios = [point.ratio for point in self.counted]
        return (min(ratios), max(ratios)) if ratios else (math.nan, math.nan)

    @property
    def share_in_band(self) -> float | None:
        """Share of the points with a band that lie in theirs; None where no point has one."""
        return _share([point.in_band for point in self.counted])

    @property
    def share_in_uncertainty_band(self) -> float | None:
        """Share of the points whose uncertainty band holds the middle of their statement; None where none has one."""
        return _share([point.in_uncertainty_band for point in self.counted])

    @property
    def uncertainty_width(self) -> float | None:
        """Geometric mean of high / low of the uncertainty bands; None where there is none."""
        ends = [point.uncertainty for point in self.counted if point.in_uncertainty_band is not None]
        logs = [math.log(one[1] / one[0]) for one in ends if one is not None and one[0] > 0]
        return math.exp(mean(logs)) if logs else None

    @property
    def exponents(self) -> Mapping[str, float]:
        """Exponents of the ratio over diameter and lead, see :func:`exponents`."""
        return exponents(self.counted, [point.ratio for point in self.counted])

    @property
    def groups(self) -> dict[str, Entry]:
        """The points of each group by its name; empty where the points are of no groups."""
        names = dict.fromkeys(point.group for point in self.points if point.group)
        return {name: dataclasses.replace(self, points=[p for p in self.points if p.group == name]) for name in names}

    @property
    def rules(self) -> list[RuleEntry]:
        """The rules that have a value for all points, as if each were the model."""
        return [self._rule(name) for name in self.mean_laws]

    def _rule(self, name: str) -> RuleEntry:
        ratios = [point.laws[name] for point in self.points]
        # to twelve digits: a rule may be the very end of a band
        values = [float(f"{r * point.band.middle:.12g}") for r, point in zip(ratios, self.points, strict=True)]
        return RuleEntry(
            rule=name,
            n=len(ratios),
            mean_ratio=mean(ratios),
            std_ratio=scatter(ratios),
            range_ratio=(min(ratios), max(ratios)),
            share_in_band=_share([p.band.holds(value) for value, p in zip(values, self.points, strict=True)]),
            exponents=exponents(self.points, ratios),
        )

    @property
    def mean_laws(self) -> dict[str, float]:
        """Mean of law / middle by law, for the laws that all points have."""
        return _means([point.laws for point in self.points])

    @property
    def mean_definitions(self) -> dict[str, float]:
        """Mean ratio by other definition, for those that all points have."""
        return _means([point.definitions for point in self.points])

    @property
    def upper_limits(self) -> Sequence[UpperLimitOnly]:
        """The values with a maximum only, of all points."""
        return [apart for point in self.points for apart in point.upper_limits]


def mean(numbers: Sequence[float]) -> float:
    """Mean; NaN of nothing."""
    return float(np.mean(numbers)) if len(numbers) else math.nan


def scatter(numbers: Sequence[float]) -> float:
    """Standard deviation of a sample, divided by n − 1; NaN of less than two."""
    return float(np.std(numbers, ddof=1)) if len(numbers) > 1 else math.nan


def _share(inside: Sequence[bool | None]) -> float | None:
    """Share that is true of those that are known; None where none is."""
    known = [one for one in inside if one is not None]
    return sum(known) / len(known) if known else None


def _means(rows: Sequence[Mapping[str, float]]) -> dict[str, float]:
    names = [name for name in (rows[0] if rows else ()) if all(name in one for one in rows)]
    return {name: mean([one[name] for one in rows]) for name in names}


#: The descriptors of :func:`exponents`.
EXPONENTS = ("size", "lead")


def exponents(points: Sequence[Point], ratios: Sequence[float]) -> dict[str, float]:
    """The exponents a and b of ratio ∝ diameter^a · lead^b, one least-squares fit of both to the logarithms.

    Empty where the points do not tell both: fewer than four, or diameters and leads that go together.
    """
    if len(points) < 4 or not all(name in point.descriptors for name in EXPONENTS for point in points):
        return {}
    columns = [np.log([point.descriptors[name] for point in points]) for name in EXPONENTS]
    matrix = np.column_stack([np.ones(len(points)), *columns])
    if np.linalg.matrix_rank(matrix, tol=1e-6) < matrix.shape[1] or min(ratios) <= 0:
        return {}
    result, *_ = np.linalg.lstsq(matrix, np.log(ratios))
    return {name: float(value) for name, value in zip(EXPONENTS, result[1:], strict=True)}


# -- which effect is missing ----------------------------------------------------------------------


class Trend(NamedTuple):
    """Dependence of the ratio on a property of the rows: ratio ∝ descriptor ^ exponent."""

    descriptor: str
    exponent: float
    #: Half width of the interval of two standard errors around the exponent.
    half_width: float
    correlation: float


def trends(points: Sequence[Point]) -> list[Trend]:
    """The trends of the logarithm of the ratio, the strongest correlation first; each descriptor by itself.

    Descriptors that do not vary are left out. Sizes, balls and leads of real screws grow together: an effect of one
    shows in all of them.
    """
    result: list[Trend] = []
    log_ratio = np.log([point.ratio for point in points])
    for name in DESCRIPTORS:
        values = [point.descriptors[name] for point in points if name in point.descriptors]
        if len(values) < len(points) or len(points) < 3 or min(values) <= 0 or max(values) <= min(values) * (1 + 1e-9):
            continue
        x = np.log(values)
        x, y = x - x.mean(), log_ratio - log_ratio.mean()
        exponent = float(x @ y / (x @ x))
        left = y - exponent * x
        error = math.sqrt(float(left @ left) / (len(points) - 2) / float(x @ x))
        scatter = math.sqrt(float(x @ x) * float(y @ y))
        result.append(Trend(name, exponent, 2 * error, float(x @ y) / scatter if scatter else math.nan))
    return sorted(result, key=lambda trend: -abs(trend.correlation))
