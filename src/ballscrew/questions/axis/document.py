"""The JSON document of the chain of an axis: rigidity, lost motion, critical speed and buckling over its stroke."""

from __future__ import annotations

from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.axis.compute import FRICTION, LOAD, SERIES, SPEED, ChainReport


def document(report: ChainReport) -> dict[str, Any]:
    """The document of a chain, in SI; a spring that is not known is null."""
    chain = report.chain
    return {
        "inputs": case_file.inputs(report.case),
        "results": {
            **{name: [float(value) for value in values] for name, values in report.series.items()},
            "shares": {name: [float(share) for share in values] for name, values in chain.shares.items()},
            "travel": list(report.travel),
            "travel_is_known": report.travel_is_known,
            "softest": _at(report, report.softest),
            LOAD.name: report.largest_load,
            SPEED.name: report.largest_speed,
            FRICTION.name: report.guide_friction,
        },
        "units": {
            **{name: quantity.unit for name, quantity in SERIES.items()},
            "shares": "1",
            "travel": "m",
            "softest": {name: quantity.unit for name, quantity in SERIES.items()},
            **{quantity.name: quantity.unit for quantity in (LOAD, SPEED, FRICTION)},
        },
        "assumed": list(report.assumed),
        "warnings": documents(report.case.implausible()),
        "verdicts": documents(report.verdicts),
        "checks": [],
        "provenance": provenance.of_case(report.case),
    }


def _at(report: ChainReport, place: int) -> dict[str, float]:
    return {name: float(values[place]) for name, values in report.series.items()}
