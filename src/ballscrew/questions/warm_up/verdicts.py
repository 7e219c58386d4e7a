"""Verdicts and warnings of warming up: where it ends, what becomes of the preload, and what is strange."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.basis import units
from ballscrew.basis.records import Record
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.validity import implausible
from ballscrew.questions.warm_up.compute import AT_END, AT_START, PLACE, SERIES, WarmUpReport

if TYPE_CHECKING:  # its room of distributions is slow to import
    from ballscrew.questions.warm_up.band import WarmUpBandReport

#: So many times as far while it stands as at work, and it is said.
_FARTHER = 1.05


def verdicts(report: WarmUpReport) -> list[Record]:
    """Starvation, where it ends, whether it was stopped, a lost stretch, and the preload."""
    return [*_starved(report), *report.warm_up.records, *_preload(report), *_long_cycle(report)]


def _starved(report: WarmUpReport) -> list[Record]:
    """The torque at the start and in the steady state, each as the inlet is given and in a full bath of oil."""
    full = report.full_bath
    if full is None:
        return []
    start = [float(one.warm_up.screw_torque[0]) for one in (report, full)]
    end = [float(one.equilibrium["screw_torque"]) for one in (report, full)]
    numbers = [validity.BothTorques(AT_START, *start)]
    if np.isfinite(end).all():
        numbers.append(validity.BothTorques(AT_END, *end))
    said = validity.records(numbers)
    ends = full.warm_up.equilibrium
    if ends.exists or not report.warm_up.equilibrium.exists:
        return said
    message = "in a full bath of oil there is no steady state: thermal runaway, or too hot for the model"
    record = Record(
        "verdict.equilibrium_of_full_bath",
        "equilibrium",
        message,
        severity="error",
        holds=False,
        value=ends.margin,
        limit=0.0,
    )
    return [*said, record]


def _preload(report: WarmUpReport) -> list[Record]:
    """The farthest that the preload goes from what was set at work, and where it goes on while the axis stands."""
    warm_up = report.warm_up
    if not warm_up.network.preload_set:
        return []
    start, at = float(warm_up.preload[0]), _farthest(warm_up.preload[warm_up.works])
    farthest = float(warm_up.preload[at])
    lost = farthest <= 0
    message = (
        f"the preload {_force(start)} is lost at work: the nut grows away from the shaft"
        if lost
        else f"the preload goes from {_force(start)} to {_force(farthest)} ({_change(farthest, start)}) at work"
    )
    worst = float(warm_up.preload[_farthest(warm_up.preload)])
    if abs(worst - start) > _FARTHER * abs(farthest - start):
        message = (
            f"{message}, and while it stands to {_force(worst)} ({_change(worst, start)}): nut and shaft cool at "
            "their own rates"
        )
    return [
        Record(
            "verdict.preload",
            "preload",
            message,
            severity="warning" if lost else "info",
            holds=not lost,
            value=farthest,
            unit="N",
        )
    ]


def _farthest(preload: Numbers) -> int:
    return int(np.argmax(np.abs(preload - preload[0])))


def _force(value: float) -> str:
    return units.shown(value, SERIES["preload"])


def _change(value: float, start: float) -> str:
    """A change in whole per cent, with its sign."""
    percent = abs(round(100 * (value / start - 1)))
    return f"{'+' if value >= start else '-'}{units.number(percent)} %"


def warnings(report: WarmUpReport) -> list[Record]:
    """Warnings of strange inputs and the oil as warm as it becomes, and what of the motion does not count."""
    case = report.case
    warmest = case.lubricant.at(float(np.max(report.warm_up.oil_temperature)))
    parts = {"surroundings": report.surroundings, "lubricant": warmest}
    strange = [*case.implausible(), *implausible(parts)]
    once = {(record.id, record.subject): record for record in strange}
    return [*once.values(), *_assumed_length(report), *_own_temperatures(report)]


def band_records(warm_up_band_report: WarmUpBandReport) -> list[Record]:
    """Records of what the bands leave out: bracing of the halves, samples without a steady state, unknown friction."""
    bands, said = warm_up_band_report.bands, list[Record]()
    if bands.warm_up.network.by_bracing:
        message = (
            "the bands have the radial growth alone: how the halves of the nut are braced moves the preload "
            "farther; give [surroundings] bracing"
        )
        said.append(Record("band.bracing", "preload", message, severity="warning"))
    away, lost = 1 - bands.steady_share, 1 - float(bands.known_share[-1])
    if not away and not lost:
        return said
    message = (
        f"{units.number(100 * away, 2)} % of {units.number(bands.count, 9)} samples have no steady state within "
        f"the range of oil and preload, and {units.number(100 * lost, 2)} % leave it before the end: from then on "
        "they are not in the bands, whose ends are too narrow"
    )
    return [
        *said,
        Record("band.no_steady_state", "equilibrium", message, severity="warning", value=away),
    ]


def _assumed_length(report: WarmUpReport) -> list[Record]:
    if not report.length_is_assumed:
        return []
    length = report.warm_up.network.shaft.length
    message = (
        f"the length of the shaft is not given and taken as {units.shown(length, PLACE)}, on which the growth "
        "depends: give surroundings.shaft_length, or an [installation]"
    )
    return [
        Record(
            "warm_up.assumed_length",
            "surroundings.shaft_length",
            message,
            severity="warning",
            value=float(length),
            unit="m",
        )
    ]


def _own_temperatures(report: WarmUpReport) -> list[Record]:
    given = report.duty.states.temperature
    if np.isnan(given).all():
        return []
    message = (
        "the motion has temperatures of the oil of its own, which do not count: the oil is as warm as nut and shaft"
    )
    return [Record("warm_up.own_temperatures", "motion.segment", message, severity="warning")]


def _long_cycle(report: WarmUpReport) -> list[Record]:
    """A cycle that is not short against the hours, whose heat goes along with the nut."""
    if report.warm_up.along is None:
        return []
    cycle, hours = report.duty.states.cycle_time, float(report.warm_up.time[report.last_at_work])
    shown = SERIES["time"]
    message = (
        f"a cycle takes {units.shown(cycle, shown, 3)} of {units.shown(hours, shown, 3)}: the heat goes along "
        "with the nut; torque is the mean of a cycle at the oil and preload of each instant, and the steady "
        "state that of heat spread over the stroke"
    )
    return [Record("verdict.long_cycle", "motion", message, holds=True, value=cycle, unit="s")]
