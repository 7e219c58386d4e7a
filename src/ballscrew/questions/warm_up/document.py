"""The JSON document of warming up: numbers over time, steady state, heat, drift and compensation."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, duty_tables, provenance
from ballscrew.questions.shared import declared
from ballscrew.questions.warm_up import verdicts as warm_up_verdicts
from ballscrew.questions.warm_up.answer import results
from ballscrew.questions.warm_up.compute import WarmUpReport
from ballscrew.questions.warm_up.verdicts import band_records

if TYPE_CHECKING:
    from ballscrew.questions.warm_up.band import WarmUpBandReport


def document(report: WarmUpReport) -> dict[str, Any]:
    """The document of warming up, in SI."""
    found = results(report)
    return {
        # with the surroundings that count where the case gives none
        "inputs": {**duty_tables.inputs(None, None, None, report.surroundings), **case_file.inputs(report.case)},
        "results": declared.document(found),
        "units": declared.units(found),
        "assumed": list(report.assumed),
        "warnings": documents(warm_up_verdicts.warnings(report)),
        "verdicts": documents(warm_up_verdicts.verdicts(report)),
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
