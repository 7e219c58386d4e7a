"""``ballscrew sweep``: the size of a sweep, and a warning of its points outside the model's validity."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case_file import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.sweeps.store_check import count_false
from ballscrew.engine.sweeps.store_plan import Blocks
from ballscrew.physics.friction.validity import REASONS
from ballscrew.questions.sweep.compute import Plan, implausible, is_store, reasons_of, starved

#: Why a point that heats itself may not be valid, besides the reasons of the model.
_OF_HEAT = {
    "steady_state": "no steady state in the range of oil and preload: thermal runaway, or too hot for the model"
}


@dataclasses.dataclass(frozen=True)
class _False:
    """Count of false values of a mask, and the first block that has one."""

    count: int
    region: Mapping[str, slice]


def warning(case: Case, plan: Plan, dataset: xr.Dataset, to: Path | None = None) -> str:
    """Number of points outside the model's validity with the reasons, as text; empty if none is.

    Of the points that cannot be computed at all, the first is named, with what ``run`` says of it.
    A store ``to`` knows the numbers block by block, so that it need not be read.
    """
    false = _false_in_store(dataset, to) if to is not None and is_store(to) else _false_in(dataset)
    unusual = [f"beware  {record.name}: {record.text}" for record in implausible(case, plan)]
    unusual += [f"beware  {record.text}" for record in starved(dataset)]
    if "valid" not in false:
        return "\n".join(unusual)
    reasons = {**reasons_of(case), **_OF_HEAT}
    counts = {reason: found.count for reason in reasons if (found := false.get(f"validity_{reason}"))}
    told = ", ".join(f"{reason} {count}" for reason, count in counts.items())
    size = dataset["valid"].size
    lines = [*unusual, f"beware: {false['valid'].count} of {size} points lie outside the model's validity ({told})"]
    lines += [f"beware  {reason}: {reasons[reason]}" for reason in counts]
    if impossible := false.get("validity_inputs"):
        lines.append(_first_impossible(case, plan, dataset["validity_inputs"], impossible))
    return "\n".join(lines)


def _false_in(dataset: xr.Dataset) -> dict[str, _False]:
    """The masks that are false somewhere."""
    masks = {str(name): mask for name, mask in dataset.data_vars.items() if mask.dtype == bool}
    return {name: _False(int((~mask).sum()), {}) for name, mask in masks.items() if not mask.all()}


def _false_in_store(dataset: xr.Dataset, to: Path) -> dict[str, _False]:
    sizes = dataset["valid"].sizes
    blocks = Blocks(tuple(sizes.values()), tuple(dataset["valid"].encoding["chunks"]))
    return {
        name: _False(count, dict(zip(map(str, sizes), blocks.region(first), strict=True)))
        for name, (count, first) in count_false(to).items()
    }


def _first_impossible(case: Case, plan: Plan, possible: xr.DataArray, impossible: _False) -> str:
    """The first point that is empty, and why."""
    part = possible.isel(impossible.region).to_numpy()
    position = np.unravel_index(int(np.argmin(part)), part.shape)
    begin = {name: where.start for name, where in impossible.region.items()}
    at = {str(name): begin.get(str(name), 0) + place for name, place in zip(possible.dims, position, strict=True)}
    point = {name: float(values[at[name]]) for name, values in plan.axes.items()}
    words = ", ".join(f"{n.replace('_', ' ')} {units.shown(v, plan.quantities[n])}" for n, v in point.items())
    return f"empty cells: {impossible.count} points, the first at {words}: {_reason(case, point)}"


def _reason(case: Case, point: Mapping[str, float]) -> str:
    """Faults of a screw of these numbers."""
    known = inputs_of(case.model, case.screw, case.lubricant)
    changes = {name: value for name, value in point.items() if name in known and known[name][0] == "screw"}
    try:
        dataclasses.replace(case.screw, **changes)
    except InputError as error:
        sizes = fields_of(case.screw)
        found: list[str] = []
        for fault in error.faults:
            quantity = sizes[fault.where.rpartition(".")[2]]
            given = units.shown(getattr(case.screw, quantity.name), quantity)
            given = units.shown(point[quantity.name], quantity) if quantity.name in point else given
            found.append(str(units.in_display_units(fault, quantity, given)))
        return "; ".join(found)
    return REASONS["inputs"]


def assumed(dataset: xr.Dataset) -> str:
    """What a sweep that heats itself assumes of the heat, one line each; empty if nothing is."""
    lines = [line for line in str(dataset.attrs.get("assumed", "")).split("\n") if line]
    return (
        "\n".join(
            [
                "assumed of the heat; where a number depends on the speed, it is that of the last point",
                *(f"  {line}" for line in lines),
            ]
        )
        if lines
        else ""
    )


def size(dataset: xr.Dataset, plan: Plan) -> str:
    """``14 x 11 points, 3 outputs``."""
    points = " x ".join(str(size) for size in dataset.sizes.values()) or "1"
    return f"{points} points, {len(plan.outputs)} output{'s' if len(plan.outputs) > 1 else ''}"
