"""Sweeps from the command line, and their tables as CSV, XLSX or NetCDF."""

from __future__ import annotations

import csv
import dataclasses
import importlib.util
import io
import math
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.analyses.sweep import DEFAULT_OUTPUTS, inputs_of, known_outputs, sweep
from ballscrew.faults import Fault, InputError, fault_of, nearest
from ballscrew.interfaces import units
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.files import check_writable, whole
from ballscrew.quantities import Quantity

_RANGE = re.compile(r"\s*(?P<start>[^:]+):(?P<stop>[^:]+):\s*(?P<count>\d+)\s*(?P<unit>\D.*)?")
#: "operation.axial_load" and "axial_load" are the same axis.
_SECTION = re.compile(r"^(operation|screw|lubricant|model)\.")
#: What each kind of file needs beyond the core, and what to install for it.
_NEEDS = {".csv": (), ".xlsx": ("xlsxwriter",), ".nc": ("h5netcdf", "h5py")}
#: A worksheet ends here; larger sweeps belong into NetCDF.
_XLSX_ROWS = 1_048_575
#: Above this, a sweep in memory is refused.
_MOST_VALUES = 200_000_000


@dataclasses.dataclass(frozen=True, eq=False)
class Plan:
    """Axes in SI by field, and the outputs wanted."""

    axes: Mapping[str, np.ndarray]
    outputs: tuple[str, ...]
    quantities: Mapping[str, Quantity]

    @property
    def is_table(self) -> bool:
        """One output over two axes reads best as a table."""
        return len(self.axes) == 2 and len(self.outputs) == 1


def plan(case: Case, vary: Sequence[str], wanted: Sequence[str], to: Path | None) -> Plan:
    """What to sweep. Raises :class:`~ballscrew.faults.InputError` before anything is computed."""
    faults: list[Fault] = []
    texts = dict(case.sweep) if not vary else {}
    for axis in vary:
        name, equals, text = axis.partition("=")
        if not equals:
            faults.append(Fault("--vary", "is not field=values", axis, 'write axial_load="100:4000:14 N"'))
        texts[_SECTION.sub("", name.strip())] = text
    known = {name: quantity for name, (_, quantity) in inputs_of(case.model, case.screw, case.lubricant).items()}
    axes: dict[str, np.ndarray] = {}
    for name, text in texts.items():
        if name not in known:
            faults.append(Fault(f"sweep.{name}", "unknown field", "", nearest(name, known)))
        else:
            values = _axis(f"sweep.{name}", text, known[name])
            faults += values if isinstance(values, list) else []
            axes |= {} if isinstance(values, list) else {name: values}
    if not texts:
        axes = {
            name: np.linspace(0.1, 1.0, 10) * (getattr(case.operation, name) or 1.0)
            for name in ("axial_load", "screw_speed")
        }
    chosen = tuple(wanted) or (("efficiency",) if to is None and len(axes) == 2 else DEFAULT_OUTPUTS)
    faults += [
        Fault("--output", "unknown output", n, nearest(n, known_outputs())) for n in chosen if n not in known_outputs()
    ]
    faults += _file_faults(to)
    size = math.prod(len(values) for values in axes.values())
    if size * len(chosen) > _MOST_VALUES:
        faults.append(
            Fault("sweep", "too many values", f"{size:,} points", "take fewer values an axis, or fewer outputs")
        )
    if to is not None and to.suffix == ".xlsx" and size > _XLSX_ROWS:
        faults.append(Fault("--to", "too many rows for a worksheet", f"{size:,}", "write .nc or .csv"))
    if faults:
        raise InputError(*faults)
    if to is not None:
        check_writable("--to", to)
    return Plan(axes, chosen, {**known, **{name: known_outputs()[name].quantity for name in chosen}})


def _file_faults(to: Path | None) -> list[Fault]:
    if to is None:
        return []
    if to.suffix not in _NEEDS:
        return [Fault("--to", "unknown kind of file", str(to), "end it in .csv, .xlsx or .nc")]
    missing = [name for name in _NEEDS[to.suffix] if importlib.util.find_spec(name) is None]
    return [Fault("--to", f"needs {name}", str(to), 'pip install "ballscrew[data]"') for name in missing]


def _axis(where: str, text: str, quantity: Quantity) -> np.ndarray | list[Fault]:
    """``"100:4000:14 N"`` (start:stop:count) or ``"100, 200, 500 N"`` in SI, or the faults in it."""
    text = text.strip().strip("\"'")
    span = _RANGE.fullmatch(text)
    *firsts, last = [span["start"], f"{span['stop']} {span['unit'] or ''}"] if span else text.split(",")
    tail = units.parse(where, last.strip(), quantity)
    unit = re.sub(r"^[-+\d.eE\s]+(?=\D|$)", "", last.strip()) if quantity.unit != "1" else ""
    values = [*(units.parse(where, _with_unit(first, unit), quantity) for first in firsts), tail]
    numbers = [value for value in values if not isinstance(value, Fault)]
    faults = [value for value in values if isinstance(value, Fault)]
    for number in numbers:
        fault = fault_of("sweep", quantity, number)
        faults += [] if fault is None else [units.in_people_units(fault, quantity, text)]
    if span and not 1 <= int(span["count"]) <= 10_000_000:
        faults.append(Fault(where, "bad number of values", span["count"], "start:stop:count, count at least 1"))
    if faults:
        return faults[:1]
    return np.linspace(numbers[0], numbers[1], int(span["count"])) if span else np.array(numbers)


def _with_unit(text: str, unit: str) -> str:
    """The unit after the last value counts for all; one may still carry its own."""
    text = text.strip()
    return text if re.search(r"[^\d.eE+\-\s]", text) else f"{text} {unit}"


def evaluate(case: Case, plan: Plan, done: Callable[[int, int], None] | None = None) -> xr.Dataset:
    """The dataset of a plan; load and speed are those of the case where they are not varied."""
    fixed = {name: getattr(case.operation, name) for name in ("axial_load", "screw_speed") if name not in plan.axes}
    return sweep(
        case.model, case.screw, case.lubricant, outputs=plan.outputs, done=done, **plan.axes, **fixed
    )  # fmt: skip


def size_in_words(dataset: xr.Dataset) -> str:
    """``14 x 11 points, 3 outputs``."""
    points = " x ".join(str(size) for size in dataset.sizes.values()) or "1"
    return f"{points} points, {len(dataset.data_vars)} outputs"


def csv_text(dataset: xr.Dataset, plan: Plan) -> str:
    """The rows as CSV text."""
    buffer = io.StringIO()
    _write_csv(buffer, dataset, plan)
    return buffer.getvalue()


def write(dataset: xr.Dataset, plan: Plan, to: Path) -> None:
    """Write .csv, .xlsx or .nc, whole or not at all."""
    with whole("--to", to) as path:
        if to.suffix == ".nc":
            dataset.to_netcdf(path, engine="h5netcdf")
        elif to.suffix == ".xlsx":
            _write_xlsx(path, dataset, plan)
        else:
            with path.open("w", encoding="utf-8", newline="") as stream:
                _write_csv(stream, dataset, plan)


def _write_csv(stream: Any, dataset: xr.Dataset, plan: Plan) -> None:
    writer = csv.writer(stream, lineterminator="\n")
    rows = table(dataset, plan, plan.outputs[0]) if plan.is_table else _rows(dataset, plan)
    writer.writerows(rows)


def table(dataset: xr.Dataset, plan: Plan, name: str) -> Iterator[list[Any]]:
    """One output over two axes: the first axis down, the second across, in people's units."""
    down, across = plan.axes
    corner = (
        f"{units.heading(plan.quantities[name], name)}: {_heading(plan, down)} down, {_heading(plan, across)} across"
    )
    yield [corner, *_shown(dataset[across], plan, across)]
    values = _shown(dataset[name].transpose(down, across), plan, name)
    for position, row in zip(_shown(dataset[down], plan, down), values, strict=True):
        yield [position, *row]


def _rows(dataset: xr.Dataset, plan: Plan) -> Iterator[list[Any]]:
    """A heading, then one row a point."""
    names = [*plan.axes, *plan.outputs]
    yield [_heading(plan, name) for name in names]
    shape = tuple(dataset.sizes.values())
    columns = [np.broadcast_to(_shown(dataset[name], plan, name, dataset), shape).ravel() for name in names]
    yield from (list(row) for row in zip(*(column.tolist() for column in columns), strict=True))


def _heading(plan: Plan, name: str) -> str:
    return units.heading(plan.quantities[name], name)


def _shown(array: xr.DataArray, plan: Plan, name: str, like: xr.Dataset | None = None) -> np.ndarray:
    """Values in people's units, rounded to 12 digits so that 4000.0000000000005 N reads 4000."""
    if like is not None:
        array = array.broadcast_like(xr.DataArray(0, coords={}).broadcast_like(like)).transpose(*like.sizes)
    values = array.to_numpy()
    if values.dtype == bool:
        return values.astype(int)
    values = np.asarray(units.from_si(values, plan.quantities[name]), dtype=float)
    with np.errstate(all="ignore"):
        digits = 11 - np.floor(np.log10(np.abs(np.where((values == 0) | ~np.isfinite(values), 1.0, values))))
        scale = 10.0**digits
        return np.where(np.isfinite(values), np.round(values * scale) / scale, values)


def _write_xlsx(path: Path, dataset: xr.Dataset, plan: Plan) -> None:
    """One sheet a table where there are two axes, and one sheet with a row a point."""
    import xlsxwriter

    workbook = xlsxwriter.Workbook(str(path), {"in_memory": True, "nan_inf_to_errors": True})
    bold = workbook.add_format({"bold": True})
    sheets: dict[str, Iterator[list[Any]]] = {}
    if len(plan.axes) == 2:
        sheets |= {name[:31]: table(dataset, plan, name) for name in plan.outputs}
    sheets["points"] = _rows(dataset, plan)
    for title, rows in sheets.items():
        sheet = workbook.add_worksheet(title)
        sheet.freeze_panes(1, 1 if title != "points" else 0)
        for number, row in enumerate(rows):
            sheet.write_row(number, 0, row, bold if number == 0 else None)
        sheet.autofit()
    workbook.close()
