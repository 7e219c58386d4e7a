"""``--to table``: the friction over load and speed, and other inputs with a range, as files that programs read."""

from __future__ import annotations

import csv
import importlib.util
import io
import json
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr

from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.exports.export import Export
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables import notes
from ballscrew.exports.tables.friction_table import OPTIONS as OF_TABLES
from ballscrew.exports.tables.friction_table import FrictionTable, as_export, friction_table
from ballscrew.exports.targets import Option
from ballscrew.exports.worst_error import WorstError

#: Kinds of files and the libraries that each needs.
KINDS: Mapping[str, tuple[str, ...]] = {"csv": (), "json": (), "nc": ("h5netcdf", "h5py"), "parquet": ("pyarrow",)}
OPTIONS: Mapping[str, Option] = {
    **OF_TABLES,
    "kinds": Option("", "kinds of files, csv,json,nc,parquet; if left out, those whose libraries are installed"),
}
_README = """\
Each file has the same table: a row or an element for each node, in SI. Interpolate screw_torque and ideal_torque along
straight lines; never interpolate drive_torque, which jumps at rest. The nodes are not even.
"""


def export(handed: HandOver) -> Export:
    """The table in each kind of file."""
    kinds = _kinds(str(handed.options["kinds"]))
    table = friction_table(handed)
    errors = table.worst_errors(handed)
    writers: Mapping[str, Callable[[HandOver, FrictionTable, Sequence[WorstError]], bytes]] = {
        "csv": _csv,
        "json": _json,
        "nc": _netcdf,
        "parquet": _parquet,
    }
    files = {f"friction.{kind}": writers[kind](handed, table, errors) for kind in kinds}
    files["README.txt"] = notes.text(handed, table.valid_range, errors, _README)
    return as_export(handed, table, "table", files, errors)


def _kinds(text: str) -> list[str]:
    asked = [kind.strip() for kind in text.split(",") if kind.strip()]
    missing = {kind: [n for n in needs if importlib.util.find_spec(n) is None] for kind, needs in KINDS.items()}
    for kind in asked:
        if kind not in KINDS:
            raise InputError(Fault("hand_over.kinds", "unknown kind of file", kind, nearest(kind, KINDS)))
        if missing[kind]:
            remedy = f"pip install {' '.join(missing[kind])}"
            raise InputError(Fault("hand_over.kinds", f"needs {' and '.join(missing[kind])}", kind, remedy))
    return list(dict.fromkeys(asked)) or [kind for kind in KINDS if not missing[kind]]


def dataset(handed: HandOver, table: FrictionTable, errors: Sequence[WorstError]) -> xr.Dataset:
    """The table with names, units, range, errors and provenance."""
    described = {name: {"units": handed.units[name], "long_name": handed.meanings[name]} for name in handed.meanings}
    dims = list(table.axes)
    values: dict[str, Any] = {name: (dims, array, described[name]) for name, array in table.values.items()}
    values["valid"] = (dims, table.valid.astype(np.int8), described["valid"])
    of_table = {
        "title": notes.made_of(handed)[0],
        "source": "ballscrew " + handed.provenance["version"],
        "references": ", ".join(handed.provenance["references"]),
        "comment": " ".join([notes.SIGNS, notes.AT_REST, notes.BEYOND]),
        "interpolation": "linear in screw_torque and ideal_torque",
        "error_between_nodes": table.error,
        **{f"worst_error_{one.output}": one.value for one in errors if one.output != "valid"},
        **{f"fixed_{name}": value for name, value in table.fixed.items()},
        "inputs": json.dumps(handed.provenance["inputs"], default=float),
    }
    coordinates = {name: (name, nodes, described[name]) for name, nodes in table.axes.items()}
    return xr.Dataset(values, coordinates, of_table)


def _rows(handed: HandOver, table: FrictionTable) -> dict[str, np.ndarray]:
    """A column for each axis and output, a row a node."""
    grid = np.meshgrid(*table.axes.values(), indexing="ij")
    columns = dict(zip(table.axes, grid, strict=True)) | dict(table.values)
    found = {_heading(handed, name): values.ravel() for name, values in columns.items()}
    return {**found, "valid": table.valid.ravel().astype(int)}


def _heading(handed: HandOver, name: str) -> str:
    return name if handed.units[name] == "1" else f"{name} [{handed.units[name]}]"


def _csv(handed: HandOver, table: FrictionTable, _: Sequence[WorstError]) -> bytes:
    """A heading with units, and a row a node, to the last digit."""
    columns = _rows(handed, table)
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(columns)
    writer.writerows(zip(*(values.tolist() for values in columns.values()), strict=True))
    return stream.getvalue().encode()


def _json(handed: HandOver, table: FrictionTable, errors: Sequence[WorstError]) -> bytes:
    """Axes, values as nested lists in the order of the axes, and all that is to be known of them."""

    def described(name: str, values: Any) -> dict[str, Any]:
        return {"unit": handed.units[name], "meaning": handed.meanings[name], "values": values.tolist()}

    document = {
        "axes": {name: described(name, nodes) for name, nodes in table.axes.items()},
        "outputs": {name: described(name, values) for name, values in table.values.items()}
        | {"valid": described("valid", table.valid.astype(int))},
        "fixed": {name: {"unit": handed.units[name], "value": value} for name, value in table.fixed.items()},
        "interpolation": "linear in screw_torque and ideal_torque",
        "signs": notes.SIGNS,
        "at_rest": notes.AT_REST,
        "beyond_range": notes.BEYOND,
        "error_between_nodes": table.error,
        "worst_error": {one.output: one.document() for one in errors},
        "provenance": handed.provenance,
    }
    return (json.dumps(document, default=float) + "\n").encode()


def _netcdf(handed: HandOver, table: FrictionTable, errors: Sequence[WorstError]) -> bytes:
    return bytes(dataset(handed, table, errors).to_netcdf(engine="h5netcdf"))


def _parquet(handed: HandOver, table: FrictionTable, errors: Sequence[WorstError]) -> bytes:
    """A row a node; range, errors and provenance stand in the metadata of the schema."""
    arrow = importlib.import_module("pyarrow")
    about = {name: str(value) for name, value in dataset(handed, table, errors).attrs.items()}
    rows = arrow.table(_rows(handed, table)).replace_schema_metadata(about)
    stream = io.BytesIO()
    importlib.import_module("pyarrow.parquet").write_table(rows, stream)
    return stream.getvalue()
