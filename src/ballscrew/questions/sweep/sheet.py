"""The sheet of a sweep: its size, points outside the model's validity, and its outputs over the axes."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.output.sheet import Axis, Band, Chart, Column, Columns, Curve, Line, Lines, Map, Sheet
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.sweeps.store_check import count_false
from ballscrew.engine.sweeps.store_plan import Blocks
from ballscrew.physics.friction.validity import REASONS
from ballscrew.questions.sweep.compute import Plan, implausible, is_store, reasons_of, starved

#: Why a point that heats itself may not be valid, besides the reasons of the model.
_OF_HEAT = {
    "steady_state": "no steady state in the range of oil and preload: thermal runaway, or too hot for the model"
}


def sheet(case: Case, plan: Plan, dataset: xr.Dataset, to: Path | None = None) -> Sheet:
    """All that people see of a sweep; of one in a store ``to`` without its numbers, which need not fit into memory."""
    return Sheet(
        f"{size(dataset, plan)}, model {case.model.label}",
        [
            Lines(warnings(case, plan, dataset, to)),
            Lines(assumed(dataset)),
            *([] if is_store(to) else [*_charts(dataset, plan), _points(dataset, plan)]),
        ],
    )


def size(dataset: xr.Dataset, plan: Plan) -> str:
    """``14 x 11 points, 3 outputs``."""
    points = " x ".join(str(size) for size in dataset.sizes.values()) or "1"
    return f"{points} points, {len(plan.outputs)} output{'s' if len(plan.outputs) > 1 else ''}"


def assumed(dataset: xr.Dataset) -> list[Line]:
    """Assumptions of a sweep that heats itself of the heat."""
    texts = [text for text in str(dataset.attrs.get("assumed", "")).split("\n") if text]
    heading = "assumed of the heat; where a number depends on the speed, it is that of the last point:"
    return [Line(heading, "small"), *(Line(f"  {text}", "small") for text in texts)] if texts else []


# -- validity -------------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class _False:
    """Count of false values of a mask, and the first block that has one."""

    count: int
    region: Mapping[str, slice]


def warnings(case: Case, plan: Plan, dataset: xr.Dataset, to: Path | None = None) -> list[Line]:
    """Points outside the model's validity with the reasons, and inputs that are unusual.

    Of the points that cannot be computed at all, the first is named, with what ``run`` says of it.
    A store ``to`` knows the numbers block by block, so that it need not be read.
    """
    false = _false_in_store(dataset, to) if to is not None and is_store(to) else _false_in(dataset)
    records = [*implausible(case, plan), *starved(dataset)]
    lines = [Line(record.text, "warning", record.name) for record in records]
    if "valid" not in false:
        return lines
    reasons = {**reasons_of(case), **_OF_HEAT}
    counts = {reason: mask.count for reason in reasons if (mask := false.get(f"validity_{reason}"))}
    told = ", ".join(f"{reason} {count}" for reason, count in counts.items())
    points = dataset["valid"].size
    text = f"{false['valid'].count} of {points} points lie outside the model's validity ({told})"
    lines.append(Line(text, "warning", "valid"))
    lines += [Line(reasons[reason], "warning", reason) for reason in counts]
    if impossible := false.get("validity_inputs"):
        first = _first_impossible(case, plan, dataset["validity_inputs"], impossible)
        lines.append(Line(first, "warning", "inputs"))
    return lines


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
        names: list[str] = []
        for fault in error.faults:
            quantity = sizes[fault.where.rpartition(".")[2]]
            given = units.shown(getattr(case.screw, quantity.name), quantity)
            given = units.shown(point[quantity.name], quantity) if quantity.name in point else given
            names.append(str(units.in_display_units(fault, quantity, given)))
        return "; ".join(names)
    return REASONS["inputs"]


# -- numbers --------------------------------------------------------------------------------------


def _charts(dataset: xr.Dataset, plan: Plan) -> Iterator[Chart | Map]:
    """Each output over one or two axes; of more axes none."""
    axes = {name: Axis(name.replace("_", " "), plan.quantities[name]) for name in plan.axes}
    for name in plan.outputs:
        values = dataset[name]
        title = name.replace("_", " ")
        if len(axes) == 1 and values.ndim == 1:
            ((along, x),) = axes.items()
            ends = plan.ends_of(name)
            marks: list[Band | Curve] = [Curve("", plan.axes[along], values.to_numpy(), "blue")]
            if ends:
                low, high = (dataset[end].to_numpy() for end in ends)
                marks.insert(0, Band("", plan.axes[along], low, high))
            yield Chart(title, x, Axis(title, plan.quantities[name]), marks)
        elif len(axes) == 2 and values.ndim == 2 and min(values.shape) > 1:
            (down, y), (across, x) = axes.items()
            places = plan.axes[across], plan.axes[down]
            rows = values.transpose(down, across).to_numpy()
            yield Map(title, x, y, Axis(title, plan.quantities[name]), places, rows)


def _points(dataset: xr.Dataset, plan: Plan) -> Columns:
    """A row a point: the axes, then the outputs."""
    whole = dataset["valid"].transpose(*plan.axes)
    names = [*plan.axes, *plan.columns]
    arrays = {name: xr.broadcast(dataset[name], whole)[0].transpose(*plan.axes).to_numpy().ravel() for name in names}
    return Columns(
        "points",
        [
            Column(name.replace("_", " "), values.astype(int) if values.dtype == bool else values, quantity)
            for name, values in arrays.items()
            for quantity in (None if values.dtype == bool else plan.quantities[name],)
        ],
    )
