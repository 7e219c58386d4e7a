"""The JSON document of warming up: numbers over time, steady state, heat, drift and compensation."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ballscrew.basis.quantities import Quantity
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, duty_tables, provenance
from ballscrew.questions.warm_up import records as warm_up_records
from ballscrew.questions.warm_up.compute import EQUILIBRIUM, SERIES, WarmUpReport
from ballscrew.questions.warm_up.records import band_records

if TYPE_CHECKING:
    from ballscrew.questions.warm_up.band import WarmUpBandReport

#: The parts of the heat, which stand together.
_HEAT = "heat_"
#: What the network of heat was made with, and its units.
_NETWORK: Mapping[str, str] = {
    "ball_conductance": "W/K", "shaft_convection": "W/(m^2 K)", "nut_mass": "kg", "shaft_length": "m",
    "mean_speed": "rad/s", "stroke": "m", "bearing_power": "W",
}  # fmt: skip


def document(report: WarmUpReport) -> dict[str, Any]:
    """The document of warming up, in SI."""
    return {
        # with the surroundings that count where the case gives none
        "inputs": {**duty_tables.inputs(None, None, None, report.surroundings), **case_file.inputs(report.case)},
        "results": results(report),
        "units": _units(),
        "assumed": list(report.assumed),
        "warnings": documents(warm_up_records.warnings(report)),
        "verdicts": documents(warm_up_records.verdicts(report)),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }


def with_band(found: WarmUpBandReport) -> dict[str, Any]:
    """The document of warming up with its bands."""
    whole, bands = document(found.report), found.bands
    return {
        **whole,
        "warnings": [*whole["warnings"], *documents(band_records(found))],
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
                for name, one in found.inputs.items()
            },
        },
    }


def results(report: WarmUpReport) -> dict[str, Any]:
    """All results in SI: lists over time, heat at the end."""
    found, network = report.warm_up, report.warm_up.network
    places, drift = report.drift
    along, growth = report.compensation
    stretch = found.stretch_left
    return {
        **{name: list(values) for name, values in report.series.items() if not name.startswith(_HEAT)},
        "flooded_torque": found.flooded_torque,
        "full_bath": _full_bath(report.full_bath),
        "works": [bool(value) for value in found.works],
        "stopped": found.stopped,
        "source": "spread" if found.along is None else "moving",
        "equilibrium": {
            "exists": found.equilibrium.exists, "margin": found.equilibrium.margin, **report.equilibrium,
        },
        "heat": {name: float(values[-1]) for name, values in found.heat.items()},
        "drift": {"place": list(places), "growth": [list(row) for row in drift]},
        "compensation": {"place": list(along), "growth": list(growth)},
        "shaft": {"place": list(found.places), "temperature": [list(row) for row in found.shaft_temperature]},
        "stretch_left": None if stretch is None else list(stretch),
        "network": {
            "ball_conductance": network.ball_conductance,
            "shaft_convection": network.shaft.convection,
            "nut_mass": network.nut_mass,
            "shaft_length": network.shaft.length,
            "mean_speed": report.duty.mean_speed,
            "stroke": report.duty.states.stroke,
            "bearing_power": list(network.bearing_power),
        },
    }  # fmt: skip


def _full_bath(report: WarmUpReport | None) -> dict[str, Any] | None:
    """Numbers over time and the steady state in a full bath of oil; None where nothing is starved of oil."""
    if report is None:
        return None
    end = report.warm_up.equilibrium
    return {
        **{name: list(values) for name, values in report.series.items() if not name.startswith(_HEAT)},
        "stopped": report.warm_up.stopped,
        "equilibrium": {"exists": end.exists, "margin": end.margin, **report.equilibrium},
    }


def _units() -> dict[str, Any]:
    def of(known: Mapping[str, Quantity]) -> dict[str, str]:
        return {name: quantity.unit for name, quantity in known.items() if not name.startswith(_HEAT)}

    table = {"place": "m", "growth": "m"}
    over_time = {**of(SERIES), "stopped": "s", "equilibrium": {"margin": "1", **of(EQUILIBRIUM)}}
    return {
        **over_time,
        "flooded_torque": "N m",
        "full_bath": over_time,
        "heat": {"generated": "J", "stored": "J", "lost": "J"},
        "drift": table,
        "compensation": table,
        "shaft": {"place": "m", "temperature": "K"},
        "stretch_left": "m",
        "network": dict(_NETWORK),
    }
