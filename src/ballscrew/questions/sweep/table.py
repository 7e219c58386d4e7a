"""Tables of a sweep as CSV, XLSX or NetCDF."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

import numpy as np
import xarray as xr

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.questions.sweep.compute import Plan
from ballscrew.questions.sweep.rows import SCREW


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
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True, "nan_inf_to_errors": True})
    bold = workbook.add_format({"bold": True})
    sheets: dict[str, Iterator[list[Any]]] = {}
    if len(plan.axes) == 2 and SCREW not in dataset.dims:
        sheets |= {name[:31]: table(dataset, plan, name) for name in plan.columns}
    sheets["points"] = _rows(dataset, plan)
    sheets["inputs"] = _inputs(dataset, plan)
    for title, rows in sheets.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1 if title != "points" else 0)
        for number, row in enumerate(rows):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
    return buffer.getvalue()
