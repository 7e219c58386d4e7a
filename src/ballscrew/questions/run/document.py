"""The JSON document of a run: inputs, results and units in SI, verdicts, checks, warnings, provenance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, provenance
from ballscrew.questions.run.answer import results, vendor_rows
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.nut_loads import nut_loads
from ballscrew.questions.shared import declared


def document(run: Run) -> dict[str, Any]:
    """The document of a run; with a nut it has the loads of the balls, too."""
    return {
        "inputs": case_file.inputs(run.case),
        **numbers(run),
        "warnings": documents(run.warnings),
        "verdicts": documents(run.verdicts),
        "checks": [],
        "provenance": provenance.of_case(run.case),
    }


def numbers(run: Run) -> dict[str, Any]:
    """The results, the loads of the balls of a nut, the rows of a vendor that are like it, and the units of all."""
    found, near = results(run), vendor_rows(run.case)
    loads = {} if run.nut is None else {"loads": nut_loads(run.nut)}
    beside = loads if near is None else {**loads, "vendor_rows": near}
    return {
        "results": declared.document(found),
        **{name: declared.document(one) for name, one in beside.items()},
        "units": {**declared.units(found), **{name: declared.units(one) for name, one in beside.items()}},
    }


def list_document(runs: Mapping[str, Run]) -> list[dict[str, Any]]:
    """The documents of the screws of a table with their names, without the loads ball by ball."""
    listed: list[dict[str, Any]] = [{"name": name, **document(run)} for name, run in runs.items()]
    for each in listed:
        if "loads" in each:
            del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return listed
