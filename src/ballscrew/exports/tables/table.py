"""``--to table``: the friction over load and speed, and other inputs with a range, as files that programs read."""

from __future__ import annotations

import csv
import importlib.util
import io
import json
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import nearest
from ballscrew.exports.export import AT_REST, BEYOND, SIGNS, Export, Option, Target, made_of, refusal
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_table import OPTIONS, TableJob

#: Kinds of files and the libraries that each needs.
KINDS: Mapping[str, tuple[str, ...]] = {"csv": (), "json": (), "nc": ("h5netcdf", "h5py"), "parquet": ("pyarrow",)}
_README = """\
Each file has the same table: a row or an element for each node, in SI. Interpolate screw_torque and ideal_torque along
straight lines; never interpolate drive_torque, which jumps at rest. The nodes are not even.
"""


def export(job: HandOver) -> Export:
    """The table in each kind of file."""
    kinds = _kinds(str(job.options["kinds"]))
    made = TableJob.of(job)
    writers: Mapping[str, Callable[[TableJob], bytes]] = {
        "csv": _csv,
        "json": _json,
        "nc": lambda made: bytes(dataset(made).to_netcdf(engine="h5netcdf")),
        "parquet": _parquet,
    }
    return made.export("table", {f"friction.{kind}": writers[kind](made) for kind in kinds}, _README)


_KINDS = Option("", "kinds of files, csv,json,nc,parquet; if left out, those whose libraries are installed")
TABLE = Target(export, {**OPTIONS, "kinds": _KINDS})


def _kinds(text: str) -> list[str]:
    asked = [kind.strip() for kind in text.split(",") if kind.strip()]
    missing = {kind: [n for n in needs if importlib.util.find_spec(n) is None] for kind, needs in KINDS.items()}
    for kind in asked:
        if kind not in KINDS:
            raise refusal("kinds", "unknown kind of file", kind, nearest(kind, KINDS))
        if missing[kind]:
            remedy = f"pip install {' '.join(missing[kind])}"
            raise refusal("kinds", f"needs {' and '.join(missing[kind])}", kind, remedy)
    return list(dict.fromkeys(asked)) or [kind for kind in KINDS if not missing[kind]]


def dataset(made: TableJob) -> xr.Dataset:
    """The table with names, units, range, errors and provenance."""
    job, table = made.job, made.table
    described = {name: {"units": job.units[name], "long_name": job.meanings[name]} for name in job.meanings}
    dims = list(table.axes)
    values: dict[str, Any] = {name: (dims, array, described[name]) for name, array in table.values.items()}
    values["valid"] = (dims, table.valid.astype(np.int8), described["valid"])
    of_table = {
        "title": made_of(job)[0],
        "source": "ballscrew " + job.provenance["version"],
        "references": ", ".join(job.provenance["references"]),
        "comment": " ".join([SIGNS, AT_REST, BEYOND]),
        "interpolation": "linear in screw_torque and ideal_torque",
        "error_between_nodes": table.error,
        **{f"worst_error_{entry.output}": entry.value for entry in made.errors if entry.output != "valid"},
        **{f"fixed_{name}": value for name, value in table.fixed.items()},
        "inputs": json.dumps(job.provenance["inputs"], default=float),
    }
    coordinates = {name: (name, nodes, described[name]) for name, nodes in table.axes.items()}
    return xr.Dataset(values, coordinates, of_table)


def _rows(made: TableJob) -> dict[str, np.ndarray]:
    """A column for each axis and output, a row a node."""
    units, table = made.job.units, made.table
    grid = np.meshgrid(*table.axes.values(), indexing="ij")
    columns = dict(zip(table.axes, grid, strict=True)) | dict(table.values)
    headings = {name: name if units[name] == "1" else f"{name} [{units[name]}]" for name in columns}
    return {headings[name]: values.ravel() for name, values in columns.items()} | {
        "valid": table.valid.ravel().astype(int)
    }


def _csv(made: TableJob) -> bytes:
    """A heading with units, and a row a node, to the last digit."""
    columns = _rows(made)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))
    return stream.getvalue().encode()


def _json(made: TableJob) -> bytes:
    """Axes, values as nested lists in the order of the axes, and all that is to be known of them."""
    job, table = made.job, made.table

    def described(name: str, values: Any) -> dict[str, Any]:
        return {"unit": job.units[name], "meaning": job.meanings[name], "values": values.tolist()}

    document = {
        "axes": {name: described(name, nodes) for name, nodes in table.axes.items()},
        "outputs": {name: described(name, values) for name, values in table.values.items()}
        | {"valid": described("valid", table.valid.astype(int))},
        "fixed": {name: {"unit": job.units[name], "value": value} for name, value in table.fixed.items()},
        "interpolation": "linear in screw_torque and ideal_torque",
        "signs": SIGNS,
        "at_rest": AT_REST,
        "beyond_range": BEYOND,
        "error_between_nodes": table.error,
        "worst_error": {entry.output: entry.document() for entry in made.errors},
        "provenance": job.provenance,
    }
    return (json.dumps(document, default=float) + "\n").encode()


def _parquet(made: TableJob) -> bytes:
    """A row a node; range, errors and provenance stand in the metadata of the schema."""
    arrow = importlib.import_module("pyarrow")
    about = {name: str(value) for name, value in dataset(made).attrs.items()}
    rows = arrow.table(_rows(made)).replace_schema_metadata(about)
    stream = io.BytesIO()
    importlib.import_module("pyarrow.parquet").write_table(rows, stream)
    return stream.getvalue()
