"""Tables of a sweep as CSV, XLSX or NetCDF."""

from __future__ import annotations

import csv
import dataclasses
import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np
import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.errors import Fault, InputError, raise_if_any
from ballscrew.engine.evaluation.outputs import NUT_OUTPUTS, OPERATION, known_outputs
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


def write_csv(stream: IO[str], dataset: xr.Dataset, plan: Plan) -> None:
    """The rows as CSV, one after the other."""
    is_table = plan.is_table and SCREW not in dataset.dims
    rows = table(dataset, plan, plan.outputs[0]) if is_table else _rows(dataset, plan)
    csv.writer(stream, lineterminator="\n").writerows(rows)


def write(dataset: xr.Dataset, plan: Plan, to: Path) -> None:
    """Write .csv, .xlsx or .nc, whole or not at all.

    What other libraries write is made in memory first: on a full disk they end worse than in an
    ``OSError``.
    """
    with atomic_write("--to", to) as path:
        match to.suffix.lower():
            case ".nc":
                path.write_bytes(dataset.to_netcdf(engine="h5netcdf"))
            case ".xlsx":
                path.write_bytes(_xlsx(dataset, plan))
            case _:
                with path.open("w", encoding="utf-8", newline="") as stream:
                    write_csv(stream, dataset, plan)


def table(dataset: xr.Dataset, plan: Plan, name: str) -> Iterator[list[Any]]:
    """One output over two axes: the first axis down, the second across, in display units."""
    down, across = plan.axes
    corner = (
        f"{units.heading(plan.quantities[name], name)}: {_heading(plan, down)} down; {_heading(plan, across)} across"
    )
    yield [corner, *_shown(dataset[across], plan, across)]
    values = _cells(dataset, plan, name).reshape(len(dataset[down]), len(dataset[across]))
    for position, row in zip(_shown(dataset[down], plan, down), values, strict=True):
        yield [position, *row]


def _rows(dataset: xr.Dataset, plan: Plan) -> Iterator[list[Any]]:
    """A heading, then one row a point; of several screws the name of each comes first."""
    names = [*plan.axes, *plan.columns]
    headings = [_heading(plan, name) for name in names]
    if SCREW not in dataset.dims:
        yield headings
        yield from _points(dataset, plan, names)
        return
    yield [SCREW, *headings]
    for number, screw in enumerate(dataset[SCREW].to_numpy().tolist()):
        yield from ([screw, *row] for row in _points(dataset.isel({SCREW: number}), plan, names))


def _points(dataset: xr.Dataset, plan: Plan, names: list[str]) -> Iterator[list[Any]]:
    columns = [_cells(dataset, plan, name).ravel() for name in names]
    yield from (list(row) for row in zip(*(column.tolist() for column in columns), strict=True))


def _heading(plan: Plan, name: str) -> str:
    return units.heading(plan.quantities[name], name)


def _cells(dataset: xr.Dataset, plan: Plan, name: str) -> np.ndarray:
    """One variable at all points; empty where the inputs make no sense."""
    order = tuple(plan.axes)
    whole_grid = dataset["valid"].transpose(*order)
    cells = _shown(xr.broadcast(dataset[name], whole_grid)[0].transpose(*order), plan, name)
    if name in plan.axes or name.startswith("valid"):
        return cells
    return np.where(dataset["validity_inputs"].transpose(*order).to_numpy(), cells, np.array(None, dtype=object))


def _shown(array: xr.DataArray, plan: Plan, name: str) -> np.ndarray:
    """Values in display units, rounded to 12 digits so that 4000.0000000000005 N reads 4000."""
    values = array.to_numpy()
    if values.dtype == bool:
        return values.astype(int)
    values = np.asarray(units.from_si(values, plan.quantities[name]), dtype=float)
    with np.errstate(all="ignore"):
        digits = 11 - np.floor(np.log10(np.abs(np.where((values == 0) | ~np.isfinite(values), 1.0, values))))
        scale = 10.0**digits
        rounded = np.round(values * scale) / scale
    # what is not finite is an empty cell: no spreadsheet reads "inf"
    cells = rounded.astype(object)
    cells[~np.isfinite(values)] = None
    return cells


def _inputs(dataset: xr.Dataset, plan: Plan) -> Iterator[list[Any]]:
    """All that is not varied, in SI, as numbers with their units, and where the numbers come from."""
    yield ["input", "value", "unit (SI)"]
    fixed = {name: dataset[name] for name in OPERATION if name not in plan.axes}
    for name, value in fixed.items():
        if not value.ndim:
            yield [f"operation_{name}", float(value), plan.quantities[name].unit]
        elif value.dims == ("lead",):  # that of a nut whose speed is given
            for lead, number in zip(plan.axes["lead"], value.to_numpy(), strict=True):
                yield [f"operation_{name}, lead {lead:g} m", float(number), plan.quantities[name].unit]
    for name, value in dataset.attrs.items():
        number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
        yield [name, float(value) if number else str(value), plan.units.get(str(name), "") if number else ""]
    for name, values in dataset.coords.items():
        if values.dims == (SCREW,) and name != SCREW:
            for screw, value in zip(dataset[SCREW].to_numpy().tolist(), values.to_numpy().tolist(), strict=True):
                yield [f"{name}, {screw}", None if value != value else value, values.attrs.get("units", "")]


def _xlsx(dataset: xr.Dataset, plan: Plan) -> bytes:
    """One sheet a table where there are two axes, and one sheet with a row a point."""
    sheets: dict[str, Iterator[list[Any]]] = {}
    if len(plan.axes) == 2 and SCREW not in dataset.dims:
        sheets |= {name[:31]: table(dataset, plan, name) for name in plan.columns}
    sheets["points"] = _rows(dataset, plan)
    sheets["inputs"] = _inputs(dataset, plan)
    return every_row.xlsx_bytes(sheets, without_names=("points",))
