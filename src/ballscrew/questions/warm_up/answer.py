"""The results of warming up, declared once: JSON, its units and its schema follow from the annotations."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Annotated, Any, Literal, NamedTuple

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
)  # fmt: skip
from ballscrew.questions.warm_up.compute import AT_START, PLACE, Equilibrium, Heat, OverTime, WarmUpReport

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


def results(report: WarmUpReport) -> WarmUpResults:
    """The results of a case that warms up."""
    found, network, full = report.warm_up, report.warm_up.network, report.full_bath
    return WarmUpResults(
        **_over_time(report),
        flooded_torque=found.flooded_torque,
        full_bath=None if full is None else FullBath(**_over_time(full)),
        works=found.works,
        source="spread" if found.along is None else "moving",
        heat=Heat(**{name: float(values[-1]) for name, values in found.heat.items()}),
        drift=Drift(*report.drift),
        compensation=Compensation(*report.compensation),
        shaft=Shaft(found.places.tolist(), found.shaft_temperature.tolist()),
        stretch_left=found.stretch_left,
        network=Network(
            network.ball_conductance, network.shaft.convection, network.nut_mass, network.shaft.length,
            report.duty.mean_speed, report.duty.states.stroke, network.bearing_power,
        ),
    )  # fmt: skip


def _over_time(report: WarmUpReport) -> dict[str, Any]:
    """The fields of :class:`FullBath`, in a full bath of oil or not."""
    end = report.warm_up.equilibrium
    return {
        **{name: report.series[name] for name in fields_of(OverTime)},
        "stopped": report.warm_up.stopped,
        "equilibrium": Equilibrium(end.exists, end.margin, **report.equilibrium),
    }
