"""The JSON document of a run: inputs, results and units in SI, verdicts, checks, warnings, provenance."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from ballscrew.questions.run.answer import results, vendor_rows
from ballscrew.questions.run.compute import Run
from ballscrew.questions.run.nut_loads import nut_loads
from ballscrew.questions.shared.envelope import envelope


def document(run: Run) -> dict[str, Any]:
    """The document of a run; with a nut it has the loads of the balls, too."""
    return envelope(run.case, results(run), beside=beside(run), warnings=run.warnings, verdicts=run.verdicts)


def beside(run: Run) -> dict[str, Any]:
    """The loads of the balls of a nut, and the rows of a vendor that are like it."""
    loads = None if run.nut is None else nut_loads(run.nut)
    answers = {"loads": loads, "vendor_rows": vendor_rows(run.case)}
    return {name: answer for name, answer in answers.items() if answer is not None}


def list_document(runs: Mapping[str, Run]) -> list[dict[str, Any]]:
    """The documents of the screws of a table with their names, without the loads ball by ball."""
    listed: list[dict[str, Any]] = [{"name": name, **document(run)} for name, run in runs.items()]
    for each in listed:
        if "loads" in each:
            del each["loads"]["balls"], each["units"]["loads"]["balls"]
    return listed
