"""The sheet of warming up: verdicts, instants, the steady state, heat, drift, charts, and what is assumed."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING

import numpy as np

from ballscrew.basis import units
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
    Map,
    Number,
    Sheet,
    Table,
    verdict_lines,
    warning_lines,
)
from ballscrew.basis.quantities import Array, Info, Quantity
from ballscrew.cases.case_files import descriptions
from ballscrew.physics.friction.validity import FULL_BATH
from ballscrew.questions.duty.compute import NUMBERS
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, PLACE, SERIES, WarmUpReport
from ballscrew.questions.warm_up.verdicts import band_records, verdicts, warnings

if TYPE_CHECKING:  # slow to import
    from ballscrew.questions.warm_up.band import WarmUpBandReport

_TIME, _GROWTH, _TORQUE = SERIES["time"], SERIES["shaft_growth"], SERIES["screw_torque"]
_TEMPERATURE = SERIES["shaft_temperature"]
_MARGIN = Quantity("margin", "1", Info("", "stability margin of the thermal loop"))
_MARGIN_NOTE = "The stability margin is 1 without feedback, and 0 at thermal runaway."
#: Columns of the table of instants.
_SHOWN = {
    "nut_temperature": "nut",
    "shaft_temperature": "shaft, mean",
    "shaft_growth": "growth",
    "preload": "preload",
    "screw_torque": "torque",
    "friction_power": "friction",
}
#: Instants of the table, besides the first and the last of work and of rest.
_INSTANTS = 6
_TEMPERATURES: Mapping[str, Colour] = {
    "nut_temperature": "red",
    "oil_temperature": "orange",
    "shaft_temperature": "blue",
    "first_bearing_temperature": "grey",
}
_PLACES: tuple[Colour, ...] = ("green", "orange", "purple")


def sheet(report: WarmUpReport, bands: WarmUpBandReport | None = None) -> Sheet:
    """All that people see of warming up, with the bands of its numbers where they were computed."""
    records = [*warnings(report), *(() if bands is None else band_records(bands))]
    bath = report.full_bath
    return Sheet(
        title(report),
        [
            Lines([Line(descriptions.design(report.case, plain_text=True), "small")], detail=True),
            verdict_lines(verdicts(report)),
            warning_lines(records),
            _instants(report, "instants", "Over time"),
            *(() if bath is None else [_instants(bath, "instants in a full bath", f"Over time, {FULL_BATH}")]),
            *_end_of_work(bands),
            _steady(report, bands),
            _drift(report),
            _heat(report),
            *_charts(report, bands),
            Lines([Line(f"assumed: {text}", "small") for text in report.assumed]),
            *_files(report, bands),
        ],
    )


def title(report: WarmUpReport) -> str:
    """``stroke 500 mm at 1000 rpm in the mean, 4 h of work, 1 h of rest: double nut, …``."""
    case, time = report.case, report.warm_up.time
    work = float(time[report.last_at_work])
    rest = float(time[-1]) - work
    stroke = units.shown(report.duty.states.stroke, PLACE)
    speed = units.shown(report.duty.mean_speed, NUMBERS["mean_speed"])
    hours = f"{units.shown(work, _TIME)} of work" + (f", {units.shown(rest, _TIME)} of rest" if rest else "")
    nut = [] if case.nut is None else [descriptions.nut_text(case.nut)]
    return f"stroke {stroke} at {speed} in the mean, {hours}: {', '.join([*nut, descriptions.model_text(case)])}"


def _rests(report: WarmUpReport) -> bool:
    return report.warm_up.time.size - 1 > report.last_at_work


def _with_preload(names: Sequence[str], report: WarmUpReport) -> list[str]:
    """Names of numbers, without the preload of a nut that has none."""
    return [name for name in names if name != "preload" or report.warm_up.network.preload_set]


def _instants(report: WarmUpReport, key: str, heading: str) -> Table:
    """A few instants of work and of rest."""
    last, size = report.last_at_work, report.warm_up.time.size
    indices = np.linspace(0, last, _INSTANTS + 1).round().astype(int).tolist()
    if _rests(report):
        indices += np.linspace(last, size - 1, 3).round().astype(int).tolist()
    names, rows = _with_preload(list(_SHOWN), report), list[list[Cell]]()
    for index in dict.fromkeys(indices):
        cells = [Number(float(report.series[name][index]), SERIES[name]) for name in names]
        state = "" if report.warm_up.works[index] else "stands; torque if it moved"
        rows.append([units.shown(float(report.series["time"][index]), _TIME, 3), *cells, state])
    columns = ("", *(_SHOWN[name] for name in names), *(["state"] if _rests(report) else []))
    return Table(key, heading, columns, [row[: len(columns)] for row in rows], detail=True)


def _end_of_work(bands: WarmUpBandReport | None) -> Iterator[Table]:
    """The numbers at the end of work with their bands, and the inputs that these come from."""
    if bands is None:
        return
    report, last, rows = bands.report, bands.bands.last_at_work, list[list[Cell]]()
    stopped = report.warm_up.stopped is not None
    for name in _with_preload(list(bands.bands.series), report):
        band, quantity = bands.bands.series[name], SERIES[name]
        value = float("nan") if stopped else float(report.series[name][report.last_at_work])
        ends = (float(band.low[last]), float(band.high[last]))
        median = Number(float(band.median[last]), quantity)
        rows.append([quantity.info.meaning, Number(value, quantity, band=ends), median])
    yield Table("end of work", "At the end of work", ("", "value", "median"), rows, list(_origin(bands)))


def _origin(bands: WarmUpBandReport) -> Iterator[str]:
    given = sum(uncertain.given for uncertain in bands.inputs.values())
    yield (
        f"Bands: {100 * bands.bands.level:.4g} % of {bands.bands.count} samples of {len(bands.inputs)} uncertain "
        f"inputs of surroundings, screw, oil and model, {given} of them given by the case; motion and laws are taken "
        f"as exact. {100 * bands.bands.steady_share:.4g} % of the samples have a steady state. Of the surroundings:"
    )
    for name, uncertain in bands.of_surroundings.items():
        yield f"{name} {uncertain.description}{'' if uncertain.given else ': ' + uncertain.reason}"


def _steady(report: WarmUpReport, bands: WarmUpBandReport | None) -> Table:
    """The steady state, in a full bath of oil too; its margin alone where there is none."""
    end = report.warm_up.equilibrium
    reports = [report] if report.full_bath is None else [report, report.full_bath]
    margins = [Number(each.warm_up.equilibrium.margin, _MARGIN, 3) for each in reports]
    columns = ("", "value", FULL_BATH)[: 1 + len(reports)]
    if not end.exists:
        row = [f"{_MARGIN.info.meaning}; below 0 there is none", *margins]
        return Table("steady state", "Steady state: none", columns, [row])
    steady, rows = {} if bands is None else bands.bands.steady, list[list[Cell]]()
    for name in _with_preload(list(EQUILIBRIUM), report):
        quantity = EQUILIBRIUM[name]
        band = (float(steady[name][0]), float(steady[name][1])) if name in steady else None
        numbers = [Number(each.equilibrium[name], quantity, band=band if each is report else None) for each in reports]
        rows.append([quantity.info.meaning, *numbers])
    return Table("steady state", "Steady state", columns, [*rows, [_MARGIN.info.meaning, *margins]], [_MARGIN_NOTE])


def _drift(report: WarmUpReport) -> Table:
    places, growth = report.drift
    ends = [report.last_at_work, *([-1] if _rests(report) else [])]
    rows: list[list[Cell]] = [
        [f"at {units.shown(float(place), PLACE)}", *(Number(float(values[index]), _GROWTH) for index in ends)]
        for place, values in zip(places, growth.T, strict=True)
    ]
    columns = ("", "at the end of work", "at the end of rest")[: 1 + len(ends)]
    return Table("drift", "Growth of the shaft at ends and middle of the stroke", columns, rows)


def _heat(report: WarmUpReport) -> Table:
    names = [name for name in SERIES if name.startswith("heat_")]
    rows = [[SERIES[name].info.meaning, Number(float(report.series[name][-1]), SERIES[name])] for name in names]
    return Table("heat", "Heat until the end", ("", "value"), rows)


def _charts(report: WarmUpReport, bands: WarmUpBandReport | None) -> Iterator[Block]:
    result, time = report.warm_up, Axis("time", _TIME)
    yield Map(
        "temperature of the shaft; dotted: the stroke",
        time,
        Axis("place", PLACE),
        Axis("temperature", _TEMPERATURE),
        (result.time, result.places),
        result.shaft_temperature.T,
        [Level("", float(end)) for end in result.network.ends],
        detail=True,
    )
    curves = [
        Curve(SERIES[name].info.meaning.replace("temperature of the ", ""), result.time, report.series[name], colour)
        for name, colour in _TEMPERATURES.items()
    ]
    steady = {name: report.equilibrium[name] for name in _TEMPERATURES if name in report.equilibrium}
    levels = [
        Level("" if index else "steady state", value, _TEMPERATURES[name])
        for index, (name, value) in enumerate(steady.items())
        if np.isfinite(value)
    ]
    shaded = _bands(bands, "nut_temperature", "red")
    yield Chart("temperatures", time, Axis("temperature", SERIES["nut_temperature"]), [*curves, *levels, *shaded])
    places, growth = report.drift
    grown = [
        Curve(f"at {units.shown(float(place), PLACE)}", result.time, values, colour)
        for place, values, colour in zip(places, growth.T, _PLACES, strict=True)
    ]
    whole = Curve("whole shaft", result.time, report.series["shaft_growth"], style="dotted")
    marks = [*grown, whole, *_bands(bands, "shaft_growth", "ink")]
    yield Chart("growth at ends and middle of the stroke", time, Axis("growth", _GROWTH), marks)
    name = "preload" if result.network.preload_set else "friction_power"
    yield _over_time(report, bands, name, "purple")
    yield _over_time(report, bands, "screw_torque", "red")
    at, compensation = report.compensation
    yield Chart(
        "compensation at the end of work",
        Axis("place", PLACE),
        Axis("growth", _GROWTH),
        [Curve("", at, compensation), Curve("", at, compensation, style="dots")],
        detail=True,
    )


def _over_time(report: WarmUpReport, bands: WarmUpBandReport | None, name: str, colour: Colour) -> Chart:
    """A number at work, dotted while the axis stands, in a full bath of oil, and in the steady state."""
    quantity, time, values = SERIES[name], report.warm_up.time, np.asarray(report.series[name])
    works, end = np.asarray(report.warm_up.works), report.equilibrium["power" if name == "friction_power" else name]
    marks: list[Curve | Band | Level] = [Curve("", time[works], values[works], colour)]
    if _rests(report):
        resting = slice(report.last_at_work, None)
        words = "while it stands" if name == "preload" else "if it moved"
        marks.append(Curve(words, time[resting], values[resting], colour, "dotted"))
    bath = report.full_bath
    if bath is not None:
        marks.append(Curve(FULL_BATH, bath.warm_up.time, bath.series[name], "blue"))
    if np.isfinite(end):
        marks.append(Level("steady state", end))
    words = name.replace("_", " ").replace("screw ", "")
    return Chart(
        quantity.info.meaning, Axis("time", _TIME), Axis(words, quantity), [*marks, *_bands(bands, name, colour)]
    )


def _bands(bands: WarmUpBandReport | None, name: str, colour: Colour) -> Iterator[Band]:
    if bands is not None and name in bands.bands.series:
        band = bands.bands.series[name]
        words = f"{100 * bands.bands.level:.4g} % of samples"
        yield Band(words, bands.bands.time, band.low, band.high, colour)


def _files(report: WarmUpReport, bands: WarmUpBandReport | None) -> Iterator[Columns]:
    """Numbers and shaft over time, the compensation of the growth, and the bands."""
    result = report.warm_up
    columns = [Column(quantity.info.meaning, report.series[name], quantity) for name, quantity in SERIES.items()]
    if report.full_bath is not None:
        bath = report.full_bath.warm_up
        torque = np.interp(result.time, bath.time, bath.screw_torque, right=np.nan)
        columns.append(Column(f"{_TORQUE.info.meaning}, {FULL_BATH}", torque, _TORQUE))
    places, growth = report.drift
    columns += _at_places("growth at", places, growth, _GROWTH)
    yield Columns("over time", [*columns, Column("works", [int(works) for works in result.works])])
    places, growth = report.compensation
    yield Columns("compensation", [Column("place", places, PLACE), Column("growth", growth, _GROWTH)])
    temperatures = _at_places("at", result.places, result.shaft_temperature, _TEMPERATURE)
    yield Columns("shaft", [Column("time", result.time, _TIME), *temperatures])
    if bands is not None:
        ends = [
            Column(f"{SERIES[name].info.meaning}, {end}", getattr(band, end), SERIES[name])
            for name, band in bands.bands.series.items()
            for end in ("low", "median", "high")
        ]
        known = Column("share of samples known", [float(share) for share in bands.bands.known_share])
        yield Columns("band", [Column("time", bands.bands.time, _TIME), *ends, known])


def _at_places(words: str, places: Array, values: Array, quantity: Quantity) -> list[Column]:
    """A column for each place, of values over time."""
    return [
        Column(f"{words} {units.shown(float(place), PLACE)}", column, quantity)
        for place, column in zip(places, values.T, strict=True)
    ]
