"""The document of a sweep: axes and outputs in SI, and the points outside the model's validity."""

from __future__ import annotations

from typing import Any

import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.records import Measured, Message, Record, documents
from ballscrew.basis.version import __version__
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.uncertainty.bands import ENDS
from ballscrew.questions.sweep.compute import Plan, implausible, starved


def document(case: Case, plan: Plan, dataset: xr.Dataset) -> dict[str, Any]:
    """Axes, outputs with the ends of their bands where there are bands, verdicts, checks and warnings, provenance."""

    def table(name: str, values: Any) -> dict[str, Any]:
        quantity = plan.quantities[name]
        return {"values": values, "unit": quantity.unit, "meaning": quantity.info.meaning}

    def output(name: str) -> dict[str, Any]:
        ends = {end: dataset[f"{name}_{end}"].to_numpy() for end in ENDS} if plan.banded else {}
        return {**table(name, dataset[name].to_numpy()), **ends}

    band = {name: dataset.attrs[f"band_{name}"] for name in ("level", "samples", "seed")} if plan.banded else None
    return {
        "axes": {name: table(name, values) for name, values in plan.axes.items()},
        "outputs": {name: output(name) for name in dict.fromkeys((*plan.outputs, "valid"))},
        **({} if band is None else {"band": band}),
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
