"""Sweeps from the command line, and their tables as CSV, XLSX or NetCDF."""

from __future__ import annotations

import contextlib
import csv
import dataclasses
import importlib.util
import io
import logging
import math
import re
from collections.abc import Callable, Generator, Iterator, Mapping, Sequence
from pathlib import Path
from typing import IO, Any

import numpy as np
import xarray as xr

from ballscrew.analyses.cluster import connected
from ballscrew.analyses.engines import FEW_POINTS
from ballscrew.analyses.outputs import DEFAULT_OUTPUTS, NUT_OUTPUTS, OPERATION, inputs_of, known_outputs
from ballscrew.analyses.plan import Plan as Swept
from ballscrew.analyses.plan import Subject
from ballscrew.analyses.stream import stream
from ballscrew.analyses.sweep import sweep
from ballscrew.assembly import NUT_REASONS
from ballscrew.components.laws import ProportionalBallForce
from ballscrew.components.materials import TEMPERATURE, Lubricant, Material
from ballscrew.components.screw import MATERIALS
from ballscrew.faults import Fault, InputError, fault_of, nearest
from ballscrew.interfaces import units
from ballscrew.interfaces.computable import computable
from ballscrew.interfaces.config import Case
from ballscrew.interfaces.files import check_writable, whole
from ballscrew.quantities import Quantity, fields_of
from ballscrew.validity import REASONS

_RANGE = re.compile(r"(?P<start>[^:]+):(?P<stop>[^:]+):\s*(?P<count>\d{1,18})\s*(?P<unit>1\s*/.*|[^\d\s.].*)?")
_SECTIONS = ("operation", "screw", "lubricant", "model", "nut")
#: A folder that is filled block by block, so that a sweep need not fit into memory.
STORE = ".zarr"
#: What each kind of file needs beyond the core, and what to install for it.
_NEEDS = {".csv": (), ".xlsx": ("xlsxwriter",), ".nc": ("h5netcdf", "h5py"), STORE: ("zarr",)}
#: A worksheet ends here; larger sweeps belong into NetCDF.
_XLSX_ROWS = 1_048_576
_XLSX_COLUMNS = 16_384
_LONGEST_AXIS = 10_000_000
#: What of an oil of a grade depends on its temperature.
OF_TEMPERATURE = ("viscosity", "pressure_viscosity_coefficient", "temperature_coefficient")
#: Above this, a sweep in memory is refused.
_MOST_VALUES = 200_000_000


@dataclasses.dataclass(frozen=True, eq=False)
class Plan:
    """Axes in SI by field, and the outputs wanted."""

    axes: Mapping[str, np.ndarray]
    outputs: tuple[str, ...]
    quantities: Mapping[str, Quantity]
    #: SI units of the inputs, by section_field.
    units: Mapping[str, str]

    @property
    def is_table(self) -> bool:
        """One output over two axes reads best as a table."""
        return len(self.axes) == 2 and len(self.outputs) == 1

    @property
    def columns(self) -> tuple[str, ...]:
        """The outputs wanted, and whether a point is valid."""
        return tuple(dict.fromkeys((*self.outputs, "valid")))


def plan(case: Case, vary: Sequence[str], wanted: Sequence[str], to: Path | None) -> Plan:
    """What to sweep. Raises :class:`~ballscrew.faults.InputError` before anything is computed."""
    faults: list[Fault] = []
    known = dict(inputs_of(case.model, case.screw, case.lubricant, case.parts))
    if "grade" in case.oil:
        known["temperature"] = ("lubricant", TEMPERATURE)
    axes: dict[str, np.ndarray] = {}
    for written, text in _texts(vary, faults).items() if vary else case.sweep.items():
        section, name = _split(written)
        if name not in known or section not in ("", known[name][0]):
            remedy = nearest(name, known)
            if name == "temperature" and section in ("", "lubricant"):
                remedy = 'give the oil by its grade, such as grade = "ISO VG 100", or vary the viscosity'
            faults.append(Fault(f"sweep.{written}", "unknown field", "", remedy))
            continue
        if name in axes:
            faults.append(Fault(f"sweep.{written}", "is given twice", "", "give each field once"))
            continue
        values = _axis(f"sweep.{name}", text, known[name][1])
        if isinstance(values, Fault):
            faults.append(values)
        else:
            axes[name] = values
    if not vary and not case.sweep:
        axes = {name: np.linspace(0.1, 1.0, 10) * (getattr(case.operation, name) or 1.0) for name in OPERATION}
    usual = DEFAULT_OUTPUTS if case.parts is None else NUT_OUTPUTS
    chosen = tuple(name.replace(".", "_") for name in wanted)
    chosen = chosen or (("efficiency",) if to is None and len(axes) == 2 else usual)
    possible = known_outputs(case.parts)
    faults += [Fault("--output", "unknown output", n, nearest(n, possible)) for n in chosen if n not in possible]
    faults += [
        Fault("--output", "is what is varied", n, "leave it out: it is a column anyway") for n in chosen if n in axes
    ]
    if "ball_to_ball_force" in axes and isinstance(case.model.ball_force, ProportionalBallForce):
        remedy = "vary ball_force.share_of_load"
        faults.append(Fault("sweep.ball_to_ball_force", 'does not count with ball_force = "proportional"', "", remedy))
    of_temperature = [name for name in OF_TEMPERATURE if "temperature" in axes and name in axes]
    faults += [Fault(f"sweep.{n}", "goes with the temperature", "", "vary one of the two") for n in of_temperature]
    if "loaded_balls" in axes and case.parts is not None and case.parts.one_by_one:
        remedy = "leave out [bodies] and [deviations]"
        faults.append(Fault("sweep.loaded_balls", "cannot be varied where balls differ", "", remedy))
    size = math.prod(len(values) for values in axes.values())
    if size * len(chosen) > _MOST_VALUES and not is_store(to):
        remedy = "take fewer values an axis, or fewer outputs, or write to a folder: --to map.zarr"
        faults.append(Fault("sweep", "too many values", f"{size:,} points", remedy))
    faults += _file_faults(to, [len(values) for values in axes.values()])
    if faults:
        raise InputError(*faults)
    if to is not None and not is_store(to):
        check_writable("--to", to)
    quantities = {name: quantity for name, (_, quantity) in known.items()}
    si = {f"{part}_{name.replace('.', '_')}": quantity.unit for name, (part, quantity) in known.items()}
    si |= {
        f"screw_{part}_{name}": quantity.unit for part in MATERIALS for name, quantity in fields_of(Material).items()
    }
    return Plan(axes, chosen, quantities | {name: possible[name].quantity for name in (*chosen, "valid")}, si)


def _split(written: str) -> tuple[str, str]:
    """Section and field: ``operation.axial_load`` and ``axial_load`` are the same axis."""
    section, dot, name = written.partition(".")
    return (section, name) if dot and section in _SECTIONS else ("", written)


def _texts(vary: Sequence[str], faults: list[Fault]) -> dict[str, str]:
    """The ``field=values`` of the command line."""
    texts: dict[str, str] = {}
    for axis in vary:
        name, equals, text = (part.strip() for part in axis.partition("="))
        if not equals:
            faults.append(Fault("--vary", "is not field=values", axis, 'write axial_load="100:4000:14 N"'))
        elif name in texts:
            faults.append(Fault("--vary", "is given twice", name, "give each field once"))
        else:
            texts[name] = text
    return texts


def is_store(to: Path | None) -> bool:
    """Whether a sweep goes to a store on disk block by block."""
    return to is not None and to.suffix.lower() == STORE


def _file_faults(to: Path | None, lengths: Sequence[int]) -> list[Fault]:
    """What is wrong with a file before a byte of it is written."""
    if to is None:
        return []
    kind = to.suffix.lower()
    if kind not in _NEEDS:
        return [Fault("--to", "unknown kind of file", str(to), "end it in .csv, .xlsx, .nc or .zarr")]
    missing = [name for name in _NEEDS[kind] if importlib.util.find_spec(name) is None]
    if missing:
        return [Fault("--to", f"needs {' and '.join(missing)}", str(to), 'pip install "ballscrew[data]"')]
    too_wide = len(lengths) == 2 and lengths[1] >= _XLSX_COLUMNS
    if kind == ".xlsx" and (math.prod(lengths) >= _XLSX_ROWS or too_wide):
        return [Fault("--to", "too large for a worksheet", " x ".join(map(str, lengths)), "write .nc or .csv")]
    return []


def length_of(text: str) -> int:
    """How many values an axis has, before they are made."""
    span = _RANGE.fullmatch(text.strip().strip("\"'"))
    return int(span["count"]) if span else text.count(",") + 1


def _axis(where: str, text: str, quantity: Quantity) -> np.ndarray | Fault:
    """``"100:4000:14 N"`` (start:stop:count) or ``"100, 200, 500 N"`` in SI, or the first fault in it."""
    text = text.strip().strip("\"'")
    span = _RANGE.fullmatch(text)
    if span is None and ":" in text:
        return Fault(
            where, "is not start:stop:count", text, f'write "1:10:4{_blank_unit(quantity)}", count a whole number'
        )
    if span and quantity.unit != "1" and not span["unit"]:
        return Fault(where, "needs a unit", text, f'write "{text} {quantity.shown_in}"')
    if span:
        items, unit = [span["start"], span["stop"]], span["unit"] or ""
    else:
        items = text.split(",")
        unit = units.unit_in(items[-1])
    # the unit after the last value counts for all; one may still carry its own
    values = [units.parse(where, item if units.unit_in(item) else f"{item} {unit}".strip(), quantity) for item in items]
    for value in values:
        fault = value if isinstance(value, Fault) else fault_of("sweep", quantity, value)
        if fault is not None:
            return units.in_people_units(fault, quantity, fault.given if fault is value else text)
    ends = [value for value in values if not isinstance(value, Fault)]
    if span is None:
        return np.array(ends)
    if not 1 <= int(span["count"]) <= _LONGEST_AXIS:
        return Fault(
            where, "bad number of values", span["count"], f"start:stop:count, count from 1 to {_LONGEST_AXIS:,}"
        )
    numbers = np.linspace(ends[0], ends[1], int(span["count"]))
    if quantity.info.whole and np.any(numbers % 1):
        return Fault(where, "must be whole numbers", text, "choose a count that gives whole steps, or list them")
    return numbers


def _blank_unit(quantity: Quantity) -> str:
    return "" if quantity.unit == "1" else f" {quantity.shown_in}"


@computable()
def evaluate(
    case: Case,
    plan: Plan,
    done: Callable[[int, int], None] | None = None,
    to: Path | None = None,
    cluster: Any = None,
) -> xr.Dataset:
    """The dataset of a plan; load and speed are those of the case where they are not varied.

    It also says which points are valid, and why not, whether that was asked for or not. With a
    store ``to`` it is filled first, by the workers of a ``cluster`` if there is one.
    """
    fixed = {name: getattr(case.operation, name) for name in OPERATION if name not in plan.axes}
    names = dict.fromkeys((*plan.outputs, "valid", *(f"validity_{reason}" for reason in reasons_of(case))))
    varied: dict[str, Any] = {}
    for name, values in plan.axes.items():
        varied |= _oils(case, values) if name == "temperature" else {name: values}
    oil = {f"lubricant_{name}": value for name, value in case.oil.items() if name not in plan.axes}
    if to is not None and is_store(to):
        subject = Subject(case.model, case.screw, case.lubricant, case.parts)
        swept = Swept.of(subject, tuple(names), varied | fixed)
        return stream(swept, to, done=done, cluster=cluster, attributes=oil)
    # files of all kinds have the same bits; what is only looked at may be quicker
    few = to is None and math.prod(len(values) for values in plan.axes.values()) <= FEW_POINTS
    dataset = sweep(
        case.model, case.screw, case.lubricant, nut=case.parts, outputs=tuple(names),
        engine="model" if few else None, done=done, **varied, **fixed,
    )  # fmt: skip
    dataset.attrs |= oil
    return dataset


@contextlib.contextmanager
def workers(scheduler: str | None, to: Path | None) -> Generator[Any]:
    """A client of the cluster with a scheduler at this address; None without an address."""
    if scheduler is None:
        yield None
        return
    if not is_store(to):
        remedy = "add --to map.zarr, in a folder that all workers share"
        raise InputError(Fault("--scheduler", "needs a store", scheduler, remedy))
    with connected(scheduler, "--scheduler") as client:
        # what it logs of a scheduler that is gone, the command says in a line
        logging.getLogger("distributed.client").setLevel(logging.CRITICAL)
        yield client


def reasons_of(case: Case) -> Mapping[str, str]:
    """What can be wrong with a point, in words."""
    return REASONS if case.parts is None else NUT_REASONS


def _oils(case: Case, temperatures: np.ndarray) -> dict[str, xr.DataArray]:
    """What of an oil depends on its temperature; what the case gives itself stays as it is."""
    oils = Lubricant.from_grade(case.oil["grade"], temperatures)
    made = Lubricant.from_grade(**case.oil)
    own = [name for name in OF_TEMPERATURE if getattr(made, name) == getattr(case.lubricant, name)]
    dim, attributes = "temperature", {"units": TEMPERATURE.unit, "long_name": TEMPERATURE.info.meaning}
    coords = {dim: xr.DataArray(temperatures, dims=dim, attrs=attributes)}
    return {name: xr.DataArray(np.broadcast_to(getattr(oils, name), temperatures.shape), coords, dim) for name in own}


def size_in_words(dataset: xr.Dataset, plan: Plan) -> str:
    """``14 x 11 points, 3 outputs``."""
    points = " x ".join(str(size) for size in dataset.sizes.values()) or "1"
    return f"{points} points, {len(plan.outputs)} output{'s' if len(plan.outputs) > 1 else ''}"


def write_csv(stream: IO[str], dataset: xr.Dataset, plan: Plan) -> None:
    """The rows as CSV, one after the other."""
    rows = table(dataset, plan, plan.outputs[0]) if plan.is_table else _rows(dataset, plan)
    csv.writer(stream, lineterminator="\n").writerows(rows)


def write(dataset: xr.Dataset, plan: Plan, to: Path) -> None:
    """Write .csv, .xlsx or .nc, whole or not at all.

    What other libraries write is made in memory first: on a full disk they end worse than in an
    ``OSError``.
    """
    with whole("--to", to) as path:
        match to.suffix.lower():
            case ".nc":
                path.write_bytes(dataset.to_netcdf(engine="h5netcdf"))
            case ".xlsx":
                path.write_bytes(_xlsx(dataset, plan))
            case _:
                with path.open("w", encoding="utf-8", newline="") as stream:
                    write_csv(stream, dataset, plan)


def table(dataset: xr.Dataset, plan: Plan, name: str) -> Iterator[list[Any]]:
    """One output over two axes: the first axis down, the second across, in people's units."""
    down, across = plan.axes
    corner = (
        f"{units.heading(plan.quantities[name], name)}: {_heading(plan, down)} down, {_heading(plan, across)} across"
    )
    yield [corner, *_shown(dataset[across], plan, across)]
    values = _cells(dataset, plan, name).reshape(len(dataset[down]), len(dataset[across]))
    for position, row in zip(_shown(dataset[down], plan, down), values, strict=True):
        yield [position, *row]


def _rows(dataset: xr.Dataset, plan: Plan) -> Iterator[list[Any]]:
    """A heading, then one row a point."""
    names = [*plan.axes, *plan.columns]
    yield [_heading(plan, name) for name in names]
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
    """Values in people's units, rounded to 12 digits so that 4000.0000000000005 N reads 4000."""
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
        yield [f"operation_{name}", float(value), plan.quantities[name].unit]
    for name, value in dataset.attrs.items():
        number = isinstance(value, int | float | np.number) and not isinstance(value, bool)
        yield [name, float(value) if number else str(value), plan.units.get(str(name), "") if number else ""]


def _xlsx(dataset: xr.Dataset, plan: Plan) -> bytes:
    """One sheet a table where there are two axes, and one sheet with a row a point."""
    import xlsxwriter

    buffer = io.BytesIO()
    workbook = xlsxwriter.Workbook(buffer, {"in_memory": True, "nan_inf_to_errors": True})
    bold = workbook.add_format({"bold": True})
    sheets: dict[str, Iterator[list[Any]]] = {}
    if len(plan.axes) == 2:
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
