"""The loads, stiffness, lost motion and critical speeds of an axis: computed, as a document, and as a sheet."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.supports.stiffness import SHARES, AxisStiffness, stiffness_over_stroke
from ballscrew.basis import units
from ballscrew.basis.arrays import lazy
from ballscrew.basis.errors import Fault, InputError, overflow_as_input_error
from ballscrew.basis.output.sheet import (
    Axis,
    Band,
    Block,
    Cell,
    Chart,
    Colour,
    Column,
    Columns,
    Curve,
    Level,
    Line,
    Lines,
    Number,
    Share,
    Sheet,
    Table,
    Vertical,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Quantity, Unit, quantities_of
from ballscrew.basis.records import Record, Severity
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.axis import AxisOptions
from ballscrew.questions.shared.check_lines import element_lines
from ballscrew.questions.shared.declared import FINITE, envelope, from_attributes, table_of
from ballscrew.questions.shared.question import Answer, Request, Work

#: Places within the travel that the terminal shows.
SHOWN = 5
_KNOWN = quantities_of(AxisStiffness)
LOST_MOTION = Quantity("lost_motion", "m", Info("u", "lost motion at a reversal by the friction of the guides", "um"))
FRICTION = Quantity("guide_friction", "N", Info("F_g", "friction of the guides at a reversal"))
LOAD = Quantity("largest_load", "N", Info("F_max", "largest size of the axial load", "kN"))
SPEED = Quantity("largest_speed", "rad/s", Info("n_max", "largest speed of the screw", "rpm"))
#: What is known at each place.
SERIES: Mapping[str, Quantity] = (
    {
        name: _KNOWN[name]
        for name in (
            "position",
            "total",
            "nut",
            "shaft",
            "bearings",
            "mount",
            "torsion",
        )
    }
    | {LOST_MOTION.name: LOST_MOTION}
    | {name: _KNOWN[name] for name in ("critical_speed", "buckling_load")}
)
#: The springs of the chain.
SPRINGS = ("nut", "shaft", "bearings", "mount", "torsion")


@dataclasses.dataclass(frozen=True, eq=False)
class ChainReport:
    """Parts that give way between the motor and the table of a case, and limits of its shaft."""

    case: Case
    chain: AxisStiffness
    #: Places of the nut between which it travels, m; those of the whole shaft where nothing tells.
    travel: tuple[Length, Length]
    travel_is_known: bool
    #: Places that the person asked for; empty for those that the travel has.
    asked: Sequence[Length]
    largest_load: Force
    largest_speed: AngularSpeed
    #: Friction of the guides at a reversal, N; NaN where no guides are known.
    guide_friction: Force
    assumed: Sequence[str]

    @lazy
    def series(self) -> Mapping[str, Numbers]:
        """Numbers over the place of the nut in SI, as :data:`SERIES` has them; infinite where a spring is not known."""
        values: dict[str, Any] = {name: getattr(self.chain, name) for name in SERIES if name != LOST_MOTION.name}
        values[LOST_MOTION.name] = self.chain.lost_motion(self.guide_friction)
        return {name: values[name] for name in SERIES}

    @lazy
    def shown(self) -> Sequence[int]:
        """Indices of the places that the terminal shows."""
        places = self.asked or np.linspace(*self.travel, SHOWN)
        return [int(np.argmin(np.abs(self.chain.position - place))) for place in places]

    @lazy
    def _within(self) -> NDArray[np.intp]:
        """Indices of the places within the travel, or of those that the person asked for."""
        if self.asked:
            return np.arange(self.chain.position.size)
        low, high = self.travel
        slack = 1e-9 * (high - low)
        return np.flatnonzero((self.chain.position >= low - slack) & (self.chain.position <= high + slack))

    @lazy
    def softest(self) -> int:
        """Index of the place in the travel where the chain gives way most."""
        return int(self._within[np.argmin(self.chain.total[self._within])])

    @lazy
    def lowest_critical_speed(self) -> int:
        """Index of the place in the travel where the critical speed of the shaft is lowest."""
        return int(self._within[np.argmin(self.chain.critical_speed[self._within])])

    @lazy
    def least_buckling_load(self) -> int:
        """Index of the place in the travel where the buckling load of the shaft is least."""
        return int(self._within[np.argmin(self.chain.buckling_load[self._within])])

    @lazy
    def verdicts(self) -> Sequence[Record]:
        """Records of where the chain is softest, and whether speed and load are within what the shaft stands."""
        return [self._softest_record(), self._speed_record(), self._load_record()]

    def _softest_record(self) -> Record:
        at = self.softest
        if not math.isfinite(float(self.chain.total[at])):
            unknown = "rigidity not known: a nut without preload has none without a load"
            return Record("verdict.rigidity", "total", unknown, severity="warning")
        shares = {name: float(share[at]) for name, share in self.chain.shares.items()}
        most = max(shares, key=lambda name: shares[name])
        total = float(self.chain.total[at])
        rigidity = units.shown(total, SERIES["total"])
        message = (
            f"softest in its travel with the nut at {self._place(at)}: {rigidity}, "
            f"{units.number(100 * shares[most], 2)} % of the compliance is that of the {most}"
        )
        return Record("verdict.rigidity", "total", message, value=total, unit="N/m")

    def _speed_record(self) -> Record:
        at, share = self.lowest_critical_speed, float(self.case.limits.critical_speed_share)
        critical = float(self.chain.critical_speed[at])
        holds = self.largest_speed <= share * critical
        speed = units.shown(self.largest_speed, SPEED)
        ratio = units.number(self.largest_speed / critical, 2)
        alone = units.shown(self.chain.without_nut[0], SPEED)
        message = (
            f"highest speed {speed}, {ratio} of the critical speed {units.shown(critical, SPEED)} with the nut a "
            f"support at {self._place(at)}; {units.number(share)} is permitted; {alone} is critical without it, "
            "as in the checks"
        )
        return _judged("critical_speed", message, holds, self.largest_speed, share * critical, "rad/s")

    def _load_record(self) -> Record:
        at, safety = self.least_buckling_load, float(self.case.limits.buckling_safety)
        buckling = float(self.chain.buckling_load[at])
        holds = self.largest_load * safety <= buckling
        alone = units.shown(self.chain.without_nut[1], SERIES["buckling_load"])
        load = units.shown(self.largest_load, LOAD)
        message = (
            f"buckling load {units.shown(buckling, SERIES['buckling_load'])} with the nut a support at "
            f"{self._place(at)}, {alone} without it as in the checks; the largest load is {load}, and a safety of "
            f"{units.number(safety)} is asked for"
        )
        return _judged("buckling_load", message, holds, self.largest_load, buckling / safety, "N")

    def _place(self, at: int) -> str:
        return units.shown(self.chain.position[at], SERIES["position"])


def _judged(subject: str, message: str, holds: bool, value: float, limit: float, unit: str) -> Record:
    severity: Severity = "info" if holds else "warning"
    name = f"verdict.{subject.removesuffix('_load')}"
    return Record(name, subject, message, severity=severity, holds=holds, value=value, limit=limit, unit=unit)


def moves(tables: Mapping[str, Any]) -> bool:
    """True of the tables of a case whose motion counts, and not its operating point."""
    return "motion" in tables and "axis" in tables


@overflow_as_input_error()
def chain_of(case: Case, positions: Sequence[Length] = ()) -> ChainReport:
    """The chain of a case at places of its nut, or over its travel and the whole shaft.

    Raises :class:`~ballscrew.basis.errors.InputError` for a case without ``[installation]``, for a motion that does
    not fit on the shaft, and as :func:`~ballscrew.axis.supports.stiffness.stiffness_over_stroke` does.
    """
    if case.installation is None:
        remedy = 'add a table [installation] with unsupported_length = "1 m" and ends = "fixed-supported"'
        raise InputError(Fault("installation", "missing section", "", remedy))
    length = float(case.installation.unsupported_length)
    loads, speeds = _loads_and_speeds(case)
    largest = float(np.max(np.abs(loads)))
    installation, words = case.installation, list[str]()
    if installation.bearing_rigidity is None and "fixed" in case.bearings:
        rigidity, of_what = case.bearings["fixed"].axial_rigidity(largest)
        if rigidity is not None:
            words.append(f"rigidity of the fixed bearing {of_what}")
        installation = dataclasses.replace(installation, bearing_rigidity=rigidity)
    travel = _travel(case, length)
    ends = travel or (SHARES[0] * length, SHARES[-1] * length)
    places = positions or np.unique(np.concatenate([length * SHARES, np.linspace(*ends, SHOWN)]))
    sizes: dict[str, Any] = case.sizes_of_nut(case.screw)
    stiffness = stiffness_over_stroke(
        case.screw,
        installation=installation,
        positions=np.asarray(places, dtype=float),
        axial_load=largest or None,
        root_diameter=case.origins.listed.get("root_diameter"),
        **sizes,
    )
    if travel is None:
        words.append("travels over nearly the whole shaft: no motion tells how far")
    elif case.surroundings is None or case.surroundings.first_position is None:
        words.append("travels in the middle of the shaft: surroundings.first_position is not given")
    axis = case.axis
    # where motion reverses, the table stands still for a moment
    rubs = math.nan if axis is None else axis.resting_guide_friction
    guided = axis is not None and (axis.guides is not None or rubs > 0)
    rubs = rubs if guided else math.nan
    if not guided:
        words.append("no lost motion: the friction of the guides is not given ([guides])")
    return ChainReport(
        case,
        stiffness,
        (float(ends[0]), float(ends[1])),
        travel is not None,
        tuple(positions),
        largest,
        float(np.max(np.abs(speeds))),
        float(rubs),
        (*stiffness.assumed, *words),
    )


def _loads_and_speeds(case: Case) -> tuple[Any, Any]:
    """Axial loads and speeds of the screw in the motion of a case, or at its operating point."""
    if case.axis is None or case.motion is None:
        return case.operation.axial_load, case.operation.screw_speed
    states = case.motion.states()
    return case.axis.loads(states).total, 2 * math.pi * states.speed / float(case.screw.lead)


def _travel(case: Case, length: Length) -> tuple[Length, Length] | None:
    """Places of the nut at the ends of its motion; None without a motion that moves."""
    if case.motion is None or case.axis is None:
        return None
    states = case.motion.states()
    if not states.stroke:
        return None
    places = states.places_on(length, None if case.surroundings is None else case.surroundings.first_position)
    return float(np.min(places)), float(np.max(places))


class AtPlace(table_of(SERIES)):
    """Numbers at one place of the nut."""


@dataclasses.dataclass(frozen=True, eq=False)
class ChainResults(table_of(SERIES, of=Sequence[float])):
    """Rigidity, lost motion, critical speed and buckling load over the place of the nut."""

    shares: Annotated[Mapping[str, Sequence[float]], Unit("1"), Info("", "share of each spring in the compliance")]
    travel: Annotated[Sequence[float], Unit("m"), Info("", "places of the nut at the ends of its travel", "mm"), FINITE]
    #: False where the places are those of the whole shaft.
    travel_is_known: bool
    #: The place in the travel where the chain gives way most.
    softest: AtPlace
    largest_load: Annotated[Force, LOAD.info]
    largest_speed: Annotated[AngularSpeed, SPEED.info]
    guide_friction: Annotated[Force, FRICTION.info]


def document(report: ChainReport) -> dict[str, Any]:
    """The document of a chain, in SI; a spring that is not known is null."""
    softest = AtPlace(**{name: values[report.softest] for name, values in report.series.items()})
    results = from_attributes(ChainResults, report, **report.series, shares=report.chain.shares, softest=softest)
    return envelope(
        report.case,
        results,
        assumed=report.assumed,
        warnings=report.case.implausible(),
        verdicts=report.verdicts,
    )


_POSITION = SERIES["position"]
_SHARE = Quantity("share", "1", Info("", "share of the compliance"))
#: What a table of places has, and its headings.
_PLACES: Mapping[str, str] = {
    "total": "rigidity",
    "lost_motion": "lost motion",
    "critical_speed": "critical speed",
    "buckling_load": "buckling load",
}
_COLOURS: Mapping[str, Colour] = dict(zip(SPRINGS, ("blue", "orange", "green", "grey", "purple"), strict=True))


# -- what people see of it -------------------------------------------------------------------------


def sheet(report: ChainReport) -> Sheet:
    """All that people see of the chain of an axis."""
    case = report.case
    return Sheet(
        title(report),
        [
            Lines(
                [Line(descriptions.design(case, plain_text=True), "small")]
                + [Line(text, "small") for text in element_lines(case)],
                detail=True,
            ),
            verdict_lines(report.verdicts),
            warning_lines(case.implausible()),
            _places(report),
            *_springs(report),
            *_charts(report),
            Columns(
                "axis",
                [Column(quantity.info.meaning, report.series[name], quantity) for name, quantity in SERIES.items()],
            ),
            Lines([Line(f"assumed: {text}", "small") for text in report.assumed]),
        ],
    )


def title(report: ChainReport) -> str:
    """``fixed–supported shaft of 1100 mm, nut from 250 mm to 850 mm: double nut, preload 3500 N``."""
    installation, case = report.chain.installation, report.case
    length = units.shown(installation.unsupported_length, _POSITION)
    ends = " to ".join(units.shown(end, _POSITION) for end in report.travel)
    nut = "" if case.nut is None else f": {descriptions.nut_text(case.nut)}"
    return f"{installation.ends.words} shaft of {length}, nut from {ends}{nut}"


def _places(report: ChainReport) -> Table:
    """One row for each place that is shown."""
    is_known = math.isfinite(report.guide_friction)
    names = [name for name in _PLACES if name != "lost_motion" or is_known]
    rows: list[list[Cell]] = [
        [place, *(Number(float(report.series[name][index]), SERIES[name]) for name in names)]
        for index, place in _shown_places(report).items()
    ]
    notes = [_origin_of_lost_motion(report)] if is_known else []
    return Table("places", "Nut at", ("", *(_PLACES[name] for name in names)), rows, notes)


def _origin_of_lost_motion(report: ChainReport) -> str:
    is_preloaded = bool(getattr(report.case.nut, "preload", 0))
    backlash = "the preloaded nut has no backlash" if is_preloaded else "backlash comes on top"
    return f"Lost motion from the {units.shown(report.guide_friction, FRICTION)} of the guides; {backlash}."


def _shown_places(report: ChainReport) -> dict[int, str]:
    return {index: units.shown(float(report.chain.position[index]), _POSITION) for index in report.shown}


def _springs(report: ChainReport) -> Iterator[Table]:
    """The rigidity of each spring that is known, and its share of the compliance, at the places that are shown."""
    shares, places = report.chain.shares, _shown_places(report)
    known = [name for name in SPRINGS if np.any(shares[name])]
    columns = ("", *places.values())
    rigidity = [[name, *(Number(float(report.series[name][i]), SERIES[name]) for i in places)] for name in known]
    yield Table("rigidity", "Rigidity", columns, rigidity)
    share = [[name, *(Share(float(shares[name][index]), bar=False) for index in places)] for name in known]
    yield Table("shares", "Share of the compliance", columns, share)


def _charts(report: ChainReport) -> Iterator[Block]:
    place, at = Axis("nut from the fixed bearing", _POSITION), report.chain.position
    travel = [Vertical("travel of the nut", report.travel[0]), Vertical("", report.travel[1])]

    def curve(name: str) -> list[Curve]:
        return [Curve("", at, report.series[name], "blue")]

    rigidity = Axis("rigidity", SERIES["total"], least=0.0)
    yield Chart("rigidity between motor and table", place, rigidity, [*curve("total"), *travel])
    yield Chart("share of the compliance", place, Axis("share", _SHARE), list(_stacked(report)))
    for name, limit, limit_name in (
        ("critical_speed", report.largest_speed, "largest speed"),
        ("buckling_load", report.largest_load, "largest load"),
    ):
        axis = Axis(_PLACES[name], SERIES[name], log=True)
        marks = [*curve(name), Level(limit_name, limit, "red"), *travel] if limit > 0 else [*curve(name), *travel]
        yield Chart(f"{_PLACES[name]} of the shaft", place, axis, marks)


def _stacked(report: ChainReport) -> Iterator[Band]:
    """The shares of the springs, one upon the other."""
    below = np.zeros_like(report.chain.position)
    for name in SPRINGS:
        share = np.asarray(report.chain.shares[name])
        if np.any(share):
            yield Band(name, report.chain.position, below, below + share, _COLOURS[name], solid=True)
            below = below + share


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, case = request.options(AxisOptions), request.load(moves)

    def answer(_: object) -> Answer:
        report = chain_of(case, options.at)
        return Answer(sheet(report), lambda: document(report), f"{len(report.chain.position)} places")

    return Work(answer)
