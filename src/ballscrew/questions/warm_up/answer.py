"""The results of warming up, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Literal, NamedTuple

from ballscrew.basis.atomic_files import check_writable, write_error
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.basis.quantities import (
    AngularSpeed,
    Conductance,
    Duration,
    HeatTransfer,
    Info,
    Length,
    Mass,
    Torque,
    Unit,
    fields_of,
)
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import duty_tables
from ballscrew.questions.shared import every_row
from ballscrew.questions.shared.charts import SUFFIXES
from ballscrew.questions.shared.declared import envelope
from ballscrew.questions.shared.option_values import read, without_band
from ballscrew.questions.shared.question import Answer, Done, Request, Work
from ballscrew.questions.warm_up import DriftOptions, WarmUpOptions, compute, verdicts
from ballscrew.questions.warm_up.compute import AT_START, PLACE, Equilibrium, Heat, OverTime, WarmUpReport
from ballscrew.questions.warm_up.sheet import sheet

if TYPE_CHECKING:
    from ballscrew.questions.warm_up.band import WarmUpBandReport


_Places = Annotated[Sequence[float], Unit("m"), PLACE.info]
_GROWTH = Info(r"\Delta L", "growth there", "um")


@dataclasses.dataclass(frozen=True, eq=False)
class FullBath(OverTime):
    """Numbers over time in a full bath of oil, and where they end."""

    #: Time after which oil or preload are outside what is known; null where they stay inside.
    stopped: Duration | None
    #: The steady state.
    equilibrium: Equilibrium


class Drift(NamedTuple):
    """Growth over time at the ends of the stroke and in its middle: instants by places."""

    place: _Places
    growth: Annotated[Sequence[Sequence[float]], Unit("m"), _GROWTH]


class Compensation(NamedTuple):
    """Growth along the shaft at the last instant of work."""

    place: _Places
    growth: Annotated[Sequence[float], Unit("m"), _GROWTH]


class Shaft(NamedTuple):
    """Temperatures along the shaft over time: instants by places."""

    place: _Places
    temperature: Annotated[Sequence[Sequence[float]], Unit("K"), Info("T", "temperature of the shaft", "degC")]


class Network(NamedTuple):
    """Numbers that the network of heat was made with."""

    #: Conductance from nut to shaft.
    ball_conductance: Conductance
    #: Heat transfer from the shaft to the air.
    shaft_convection: HeatTransfer
    #: Mass of the nut.
    nut_mass: Mass
    #: Length of the shaft.
    shaft_length: Length
    #: Mean speed of the screw.
    mean_speed: AngularSpeed
    #: Stroke of the nut.
    stroke: Length
    #: Mean friction power of the fixed and of the other bearing.
    bearing_power: Annotated[Sequence[float], Unit("W")]


@dataclasses.dataclass(frozen=True, eq=False)
class WarmUpResults(FullBath):
    """Numbers over time, where they end, and what heat does at places."""

    flooded_torque: Annotated[Torque, Info("M_f", f"{AT_START.info.meaning}, in a full bath of oil")]
    #: The same in a full bath of oil; null where nothing is starved of oil.
    full_bath: FullBath | None
    #: True at instants of work, false while the axis stands.
    works: Sequence[bool]
    #: Heat is spread over the stroke, or goes with the nut.
    source: Literal["spread", "moving"]
    #: Heat until the end.
    heat: Heat
    #: Growth of places in the stroke.
    drift: Drift
    #: Growth along the shaft at the last instant of work.
    compensation: Compensation
    #: Temperatures along the shaft.
    shaft: Shaft
    stretch_left: Annotated[Sequence[float] | None, Unit("m"), Info("", "stretch left of a shaft between fixed ends")]
    #: The network of heat.
    network: Network


def document(report: WarmUpReport) -> dict[str, Any]:
    """The document of warming up, in SI, with the surroundings that count where the case gives none."""
    result = envelope(
        report.case,
        results(report),
        assumed=report.assumed,
        warnings=verdicts.warnings(report),
        verdicts=verdicts.verdicts(report),
    )
    return {**result, "inputs": {**duty_tables.inputs(None, None, None, report.surroundings), **result["inputs"]}}


def with_band(warm_up_band_report: WarmUpBandReport) -> dict[str, Any]:
    """The document of warming up with its bands."""
    whole, bands = document(warm_up_band_report.report), warm_up_band_report.bands
    return {
        **whole,
        "warnings": [*whole["warnings"], *documents(verdicts.band_records(warm_up_band_report))],
        "band": {
            "level": bands.level,
            "samples": bands.count,
            "time": list(bands.time),
            **{
                name: {"low": list(one.low), "median": list(one.median), "high": list(one.high)}
                for name, one in bands.series.items()
            },
            "known_share": list(bands.known_share),
            "equilibrium": {
                "exists_share": bands.steady_share,
                "margin": bands.margin._asdict(),
                **{name: one._asdict() for name, one in bands.steady.items()},
            },
            "inputs": {
                name: {"distribution": one.description, "source": one.source, "given": one.given}
                for name, one in warm_up_band_report.inputs.items()
            },
        },
    }


def results(report: WarmUpReport) -> WarmUpResults:
    """The results of a case that warms up."""
    result, network, full = report.warm_up, report.warm_up.network, report.full_bath
    return WarmUpResults(
        **_over_time(report),
        flooded_torque=result.flooded_torque,
        full_bath=None if full is None else FullBath(**_over_time(full)),
        works=result.works,
        source="spread" if result.along is None else "moving",
        heat=Heat(**{name: float(values[-1]) for name, values in result.heat.items()}),
        drift=Drift(*report.drift),
        compensation=Compensation(*report.compensation),
        shaft=Shaft(result.places.tolist(), result.shaft_temperature.tolist()),
        stretch_left=result.stretch_left,
        network=Network(
            network.ball_conductance,
            network.shaft.convection,
            network.nut_mass,
            network.shaft.length,
            report.duty.mean_speed,
            report.duty.states.stroke,
            network.bearing_power,
        ),
    )


def _over_time(report: WarmUpReport) -> dict[str, Any]:
    """The fields of :class:`FullBath`, in a full bath of oil or not."""
    end = report.warm_up.equilibrium
    return {
        **{name: report.series[name] for name in fields_of(OverTime)},
        "stopped": report.warm_up.stopped,
        "equilibrium": Equilibrium(end.exists, end.margin, **report.equilibrium),
    }


_TO = "--to"

#: Files that a folder gets, with the columns that they have alone.
_FILES = {
    "warm_up.csv": "over time",
    "warm_up.xlsx": "",
    "compensation.csv": "compensation",
    "warm_up_band.csv": "band",
    "warm_up.png": "",
}


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    drift, cool_down = request.options(DriftOptions), request.written["cool_down"]
    rest = (compute.REST if drift.drift_cycle else 0.0) if cool_down is None else cool_down
    options = read(WarmUpOptions, {**request.written, "cool_down": rest})
    if not options.band:
        of_band = {"--samples": options.samples, "--level": options.level, "--only-given": options.only_given or None}
        raise_if_any(without_band(of_band))
    compute.check_hours(options.hours, options.cool_down)
    if drift.feed_share is not None and not drift.drift_cycle:
        raise InputError(Fault("--feed-share", "needs --drift-cycle", f"{drift.feed_share:g}", "add --drift-cycle"))
    case = request.load(compute.moves)
    if drift.drift_cycle:
        case = compute.drift_cycle(case, compute.FEED_SHARE if drift.feed_share is None else drift.feed_share)

    def answer(done: Done) -> Answer:
        if not options.band:
            report = compute.warmed_up(case, options.hours, options.cool_down)
            return Answer(sheet(report), lambda: document(report))
        from ballscrew.questions.warm_up.band import band  # loads xarray

        bands = band(
            case,
            options.hours,
            options.cool_down,
            samples=options.samples,
            level=options.level,
            only_given=options.only_given,
            done=done,
        )
        return Answer(sheet(bands.report, bands), lambda: with_band(bands))

    files = [file for place in request.to for file in _files(place, options.band).items()]
    return Work(answer, "band" if options.band else "", dict(files))


def _files(place: Path, has_band: bool) -> dict[Path, str]:
    """The files of a place: itself if it ends as one, or those of a folder, which is made. They can be written."""
    known = (*every_row.KINDS, *SUFFIXES)
    if place.suffix and not place.is_dir():
        if place.suffix.lower() not in known:
            remedy = f"end it in {', '.join(known[:-1])} or {known[-1]}, or name a folder"
            raise InputError(Fault(_TO, "unknown kind of file", str(place), remedy))
        files = {place: ""}
    else:
        try:
            place.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise write_error(_TO, place, error) from None
        files = {place / name: columns for name, columns in _FILES.items() if has_band or columns != "band"}
    for path in files:
        if path.suffix.lower() in every_row.KINDS:
            every_row.check_path(path)
        else:
            check_writable(_TO, path)
    return files
