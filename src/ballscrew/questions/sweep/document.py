"""The document of a sweep: axes and outputs in SI, and the points outside the model's validity."""

from __future__ import annotations

from typing import Any

import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.records import Measured, Message, Record, documents
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.shared import declared
from ballscrew.questions.sweep.answer import results
from ballscrew.questions.sweep.compute import Plan, implausible, starved


def document(case: Case, plan: Plan, dataset: xr.Dataset) -> dict[str, Any]:
    """Axes, outputs with the ends of their bands where there are bands, verdicts, checks and warnings, provenance."""
    return {
        **declared.document(results(plan, dataset)),
        "verdicts": [],
        "checks": [],
        "warnings": documents([*implausible(case, plan), *starved(dataset), *warnings(dataset)]),
        "provenance": {"version": __version__, "model": case.model.label, "references": case_file.references(case)},
    }


def warnings(dataset: xr.Dataset) -> list[Record]:
    """A warning where the model is not valid at some of the points."""
    valid = dataset["valid"].to_numpy()
    count = int(valid.size - valid.sum())
    if not count:
        return []
    message = Message(
        "{count} of {all} points lie outside the model's validity",
        {"count": Measured(count, digits=9), "all": Measured(valid.size, digits=9)},
    )
    return [
        units.record(
            message, id="validity.points", subject="valid", severity="warning", holds=False,
            value=float(count), limit=0.0,
        )
    ]  # fmt: skip
