"""Sweeps of the screws of a table: one dataset with a dimension ``screw``."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.engine.evaluation.outputs import NUT_OUTPUTS, known_outputs
from ballscrew.questions.shared import every_row
from ballscrew.questions.shared.every_row import OfRows, RowCase
from ballscrew.questions.sweep import compute
from ballscrew.questions.sweep.compute import Plan

#: The dimension of the screws, and its coordinate: their names.
SCREW = "screw"


def plans(
    rows: Mapping[str, RowCase], vary: Sequence[str], wanted: Sequence[str], to: Path | None, keep_going: bool
) -> OfRows[tuple[RowCase, Plan]]:
    """The plan of each row; without outputs asked for, those that all of them have.

    Raises :class:`~ballscrew.basis.errors.InputError` before anything is computed.
    """
    if to is not None and compute.is_store(to):
        remedy = "end it in .nc, .csv or .xlsx, or fill a store of each screw: --row NAME --to NAME.zarr"
        raise InputError(Fault("--to", "holds one screw", str(to), remedy))
    nuts = [row.case.screw.nut for row in rows.values()]
    if not wanted and not all(nut.is_row for nut in nuts):
        wanted = [name for name in NUT_OUTPUTS if all(name in known_outputs(nut) for nut in nuts)]
    of_rows = every_row.each(
        {row.place: row for row in rows.values()},
        lambda row: (row, compute.plan(row.case, vary, wanted, to)),
        keep_going=keep_going,
    )
    # outputs are those of all, so the full bath stands beside every torque where it counts for one of them
    if any(
        compute.FLOODED in compute.with_flooded_torque(row.case, plan).outputs for row, plan in of_rows.found.values()
    ):
        both = {
            place: (row, plan if compute.FLOODED in plan.outputs else compute.with_column_of_bath(row.case, plan))
            for place, (row, plan) in of_rows.found.items()
        }
        of_rows = dataclasses.replace(of_rows, found=both)
    size = sum(_size(plan) * len(plan.outputs) for _, plan in of_rows.found.values())
    if size > compute.MOST_VALUES:
        remedy = "take fewer values an axis, or fewer outputs, or one screw: --row NAME"
        raise_if_any([Fault("sweep", "too many values", f"{size:,}", remedy)])
    return of_rows


def _size(plan: Plan) -> int:
    return math.prod(len(values) for values in plan.axes.values())


def sweep(
    planned: Mapping[str, tuple[RowCase, Plan]],
    to: Path | None,
    *,
    keep_going: bool = False,
    done: Callable[[int, int], None] | None = None,
) -> tuple[xr.Dataset, OfRows[xr.Dataset]]:
    """The sweeps of all rows as one dataset, and of each row, by place. ``done`` gets the points."""
    total, before = sum(_size(plan) for _, plan in planned.values()), 0

    def swept(row: tuple[RowCase, Plan]) -> xr.Dataset:
        nonlocal before
        case, plan = row
        start = before

        def tell(finished: int, _: int) -> None:
            if done is not None:
                done(start + finished, total)

        swept = compute.sweep(case.case, plan, tell, to)
        before += _size(plan)
        return swept

    result = every_row.each(planned, swept, keep_going=keep_going)
    datasets = {planned[place][0].row.name: dataset for place, dataset in result.found.items()}
    return together(datasets, plan_of(planned).units), result


def together(datasets: Mapping[str, xr.Dataset], units: Mapping[str, str]) -> xr.Dataset:
    """The datasets along the dimension ``screw``; what differs between the screws are coordinates along it.

    A condition that the nut of a screw cannot break holds there; another output that it does not have is NaN.
    """
    names: dict[str, xr.DataArray] = {}
    for dataset in datasets.values():
        for name, values in dataset.data_vars.items():
            names.setdefault(str(name), values)
    whole: list[xr.Dataset] = []
    for dataset in datasets.values():
        missing = {
            name: xr.full_like(values, values.dtype == bool or np.nan)
            for name, values in names.items()
            if name not in dataset
        }
        whole.append(dataset.drop_attrs(deep=False).assign(missing))
    combined = xr.concat(whole, dim=xr.DataArray(list(datasets), dims=SCREW, name=SCREW), join="exact", data_vars="all")
    combined[SCREW].attrs["long_name"] = "name of the screw in its table"
    return _with_attributes(combined, [dataset.attrs for dataset in datasets.values()], units)


def _with_attributes(
    dataset: xr.Dataset, attributes: Sequence[Mapping[str, Any]], units: Mapping[str, str]
) -> xr.Dataset:
    """Attributes that all have the same; others as coordinates along the screws, a number that is missing NaN."""
    every = dict.fromkeys(name for own in attributes for name in own)
    for name in every:
        values = [own.get(name) for own in attributes]
        if all(type(value) is type(values[0]) and np.all(value == values[0]) for value in values):
            dataset.attrs[name] = values[0]
        elif all(value is None or (isinstance(value, int | float) and not isinstance(value, bool)) for value in values):
            numbers = [math.nan if value is None else float(value) for value in values]
            dataset = dataset.assign_coords({name: (SCREW, numbers, {"units": units[name]} if name in units else {})})
        else:
            texts = ["" if value is None else str(value) for value in values]
            dataset = dataset.assign_coords({name: (SCREW, texts)})
    return dataset


def plan_of(planned: Mapping[str, tuple[RowCase, Plan]]) -> Plan:
    """The plan that all rows have in common: axes, outputs, and the quantities and units of all."""
    every = [plan for _, plan in planned.values()]
    quantities = {name: quantity for plan in every for name, quantity in plan.quantities.items()}
    si = {name: unit for plan in every for name, unit in plan.units.items()}
    return dataclasses.replace(every[0], quantities=quantities, units=si)
