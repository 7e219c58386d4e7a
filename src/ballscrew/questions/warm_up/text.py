"""Text of warming up on the terminal: a few instants, the steady state, the heat, and what was taken."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned, wrapped
from ballscrew.cases.case_files import descriptions
from ballscrew.questions.duty.compute import NUMBERS
from ballscrew.questions.shared.text_tables import ends_or_dashes, shown_or_dash
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, PLACE, SERIES, WarmUpReport

if TYPE_CHECKING:
    from ballscrew.questions.warm_up.band import WarmUpBandReport

_SHOWN = ("nut_temperature", "shaft_temperature", "shaft_growth", "preload", "screw_torque", "friction_power")
_SHORT = {"nut_temperature": "nut", "shaft_temperature": "shaft, mean", "shaft_growth": "growth",
          "screw_torque": "torque", "friction_power": "friction"}  # fmt: skip
#: Instants of the table, besides the first and the last of work and of rest.
_INSTANTS = 6
_WIDTH = 66
_MEAN_SPEED = NUMBERS["mean_speed"]


def text(report: WarmUpReport) -> str:
    """Warming up in full."""
    lines = [
        title(report),
        "",
        descriptions.design(report.case, plain_text=True),
        "",
        *_table(report),
        *_in_full_bath(report),
        "",
        *(record.text for record in warm_up_verdicts.verdicts(report)),
        *(f"beware  {record.name}: {record.text}" for record in warm_up_verdicts.warnings(report)),
        "",
        *_steady(report),
        *_steady_in_full_bath(report),
        "",
        *_heat(report),
        "",
        *_drift(report),
        "",
        "assumed",
        *(f"  {line}" for line in report.assumed),
    ]
    return "\n".join(line if "\n" in line else wrapped(line) for line in lines)


def band_text(found: WarmUpBandReport) -> str:
    """The bands at the end of work and in the steady state, and the inputs that they come from."""
    bands, report = found.bands, found.report
    last, stopped = bands.last_at_work, report.warm_up.stopped is not None
    head = f"Band: {100 * bands.level:.4g} % of {bands.count} samples"
    rows = [[head, "case", "median", "from", "to", "steady, from", "to"]]
    for name, one in bands.series.items():
        if name == "preload" and not report.warm_up.network.preload_set:
            continue
        quantity = SERIES[name]
        steady = bands.steady["growth" if name == "shaft_growth" else name]
        central = float("nan") if stopped else report.series[name][report.last_at_work]
        numbers = (shown_or_dash(float(value), quantity) for value in (central, one.median[last]))
        at_work = ends_or_dashes(float(one.low[last]), float(one.high[last]), quantity)
        low, high = map(float, steady)
        rows.append([f"  {quantity.info.meaning}", *numbers, *at_work, *ends_or_dashes(low, high, quantity)])
    given = sum(one.given for one in found.inputs.values())
    said = (
        f"at the end of work, of {len(found.inputs)} uncertain inputs of surroundings, screw, oil and model, "
        f"{given} of them given by the case; motion and laws are taken as exact. Of the surroundings:"
    )
    inputs = [
        f"  {name} {one.description}{'' if one.given else ': ' + one.reason}"
        for name, one in found.of_surroundings.items()
    ]
    steady = f"{100 * bands.steady_share:.4g} % of the samples have a steady state"
    beware = [f"beware  {record.name}: {record.text}" for record in warm_up_verdicts.band_records(found)]
    return "\n".join(["", *aligned(rows), "", *(wrapped(line) for line in (said, *inputs, steady, *beware))])


def title(report: WarmUpReport) -> str:
    """``stroke 500 mm at 1000 rpm in the mean, 4 h of work, 1 h of rest: double nut, …``."""
    found, case = report.warm_up, report.case
    time = SERIES["time"]
    work = float(found.time[report.last_at_work])
    rest = float(found.time[-1]) - work
    stroke = units.shown(report.duty.states.stroke, PLACE)
    speed = units.shown(report.duty.mean_speed, _MEAN_SPEED)
    hours = f"{units.shown(work, time)} of work" + (f", {units.shown(rest, time)} of rest" if rest else "")
    nut = [] if case.nut is None else [descriptions.nut_text(case.nut)]
    return f"stroke {stroke} at {speed} in the mean, {hours}: {', '.join([*nut, descriptions.model_text(case)])}"


def _instants(report: WarmUpReport) -> Sequence[int]:
    """Indices of the instants of the table."""
    last, size = report.last_at_work, report.warm_up.time.size
    work = np.unique(np.linspace(0, last, _INSTANTS + 1).round().astype(int))
    rest = np.unique(np.linspace(last, size - 1, 3).round().astype(int)) if size - 1 > last else []
    return [int(at) for at in dict.fromkeys([*work, *rest])]


def _table(report: WarmUpReport) -> list[str]:
    shown = [name for name in _SHOWN if name != "preload" or report.warm_up.network.preload_set]
    rows = [["time", *(_SHORT.get(name, name) for name in shown), ""]]
    for at in _instants(report):
        cells = [shown_or_dash(float(report.series[name][at]), SERIES[name]) for name in shown]
        works = "" if report.warm_up.works[at] else "stands; torque if it moved"
        rows.append([units.shown(float(report.series["time"][at]), SERIES["time"], 3), *cells, works])
    return aligned(rows)


def _in_full_bath(report: WarmUpReport) -> list[str]:
    """The same instants in a full bath of oil, where the screw is starved of it."""
    return [] if report.full_bath is None else ["", "In a full bath of oil", *_table(report.full_bath)]


def _line(what: str, value: str) -> str:
    return f"  {what:<{_WIDTH}} {value}"


def _steady(report: WarmUpReport) -> list[str]:
    end = report.warm_up.equilibrium
    if not end.exists:
        return [f"Steady state: none (margin {end.margin:.3g})"]
    lines = [
        _line(quantity.info.meaning, shown_or_dash(report.equilibrium[name], quantity))
        for name, quantity in EQUILIBRIUM.items()
        if name != "preload" or report.warm_up.network.preload_set
    ]
    return [
        f"Steady state, stability margin of the thermal loop {end.margin:.3g} (1: no feedback, 0: thermal runaway)",
        *lines,
    ]


def _steady_in_full_bath(report: WarmUpReport) -> list[str]:
    if report.full_bath is None:
        return []
    first, *others = _steady(report.full_bath)
    return ["", f"In a full bath of oil: {first[0].lower()}{first[1:]}", *others]


def _heat(report: WarmUpReport) -> list[str]:
    return [
        "Heat until the end",
        *(
            _line(SERIES[name].info.meaning, units.shown(float(report.series[name][-1]), SERIES[name]))
            for name in SERIES
            if name.startswith("heat_")
        ),
    ]


def _drift(report: WarmUpReport) -> list[str]:
    places, growth = report.drift
    rows = [["Drift of a place on the shaft", *(units.shown(float(place), PLACE) for place in places)]]
    for at, when in ((report.last_at_work, "  at the end of work"), (-1, "  at the end of rest")):
        rows.append([when, *(units.shown(float(value), SERIES["shaft_growth"]) for value in growth[at])])
    return aligned(rows if len(report.warm_up.time) - 1 > report.last_at_work else rows[:2])
