"""``--to matlab``: the table as a .mat file, a function that reads it, and a component in the language of Simscape."""

from __future__ import annotations

import io
import math
from collections.abc import Sequence
from typing import Any

import numpy as np
from scipy.io import savemat

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.export import Export, Target, filled
from ballscrew.exports.subject import HandOver
from ballscrew.exports.tables.friction_table import INTERPOLATED, OPTIONS, FrictionTable, TableJob

#: The name of the files and of the function.
NAME = "ballscrew_friction"

_README = """\
ballscrew_friction.m interpolates the table of ballscrew_friction.mat, in MATLAB and in Octave; ballscrew_friction.ssc
is a component of Simscape, written by the manual of the language and never run.
"""


def export(job: HandOver) -> Export:
    """The table, its function, and the component."""
    made = TableJob.of(job, "the lookup table")
    files = {
        f"{NAME}.mat": _mat(made),
        f"{NAME}.m": filled("friction.m", notes="\n".join(f"%   {line}" for line in made.about)),
        f"{NAME}.ssc": _simscape(job, made.table, made.about),
    }
    return made.export("matlab", files, _README)


MATLAB = Target(export, OPTIONS)


def _mat(made: TableJob) -> bytes:
    """Axes as columns, values with loads down and speeds across, units and errors as structures, all else as text."""
    table = made.table
    names = [*table.axes, *table.values, "valid"]
    content: dict[str, Any] = {
        **{name: nodes[:, None] for name, nodes in table.axes.items()},
        **table.values,
        "valid": table.valid,
        "units": {name: made.job.units[name] for name in names},
        "worst_error": {entry.output: entry.value for entry in made.errors if entry.output != "valid"},
        "fixed": dict(table.fixed),
        "about": "\n".join(made.about),
    }
    stream = io.BytesIO()
    savemat(stream, content, do_compression=True, oned_as="column")
    return stream.getvalue()


def _simscape(job: HandOver, table: FrictionTable, about: Sequence[str]) -> str:
    load, speed = (table.axes[name] for name in OPERATION[:2])
    return filled(
        "friction.ssc",
        notes="\n".join(f"% {line}" for line in about),
        f=f"[{_row(load)}]",
        w=f"[{_row(speed)}]",
        m="[" + ";\n    ".join(map(_row, table.values[INTERPOLATED[0]])) + "]",
        travel=float(job.subject.screw.lead) / (2 * math.pi),
        ideal=table.torque_of_load,
    )


def _row(values: np.ndarray) -> str:
    return " ".join(map(repr, values.tolist()))
