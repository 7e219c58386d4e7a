"""The modules of the static page: their sizes, what they take to build and to run, and how near they are to Python.

``python benchmarks/static_page.py`` prints a table of all models and kinds of nut, ``--few`` of six. Each module is
built anew, run by node at random points (all numbers within a tenth, four quadrants, some without load or at rest),
and compared with the model on NumPy arrays: the worst difference of the torque, relative, and whether NaN, truth values
and the range of validity agree everywhere. ``curve`` is 41 speeds as the page draws them, one of many.
"""

from __future__ import annotations

import gzip
import tempfile
import time
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.engine.evaluation.outputs import OPERATION
from ballscrew.exports.wasm_modules import (
    NUT_DIAMETER,
    KeptModule,
    module_of,
    module_of_oils,
    module_of_solver,
    oils,
    outputs_of,
)
from ballscrew.faces.page import kinds
from ballscrew.faces.page.banding import module_of_banding
from ballscrew.faces.page.contents import contents
from ballscrew.faces.page.judging import Judging, module_of_judging
from ballscrew.faces.page.modules import inputs_of_module, varying_of
from ballscrew.questions.shared.text_tables import markdown_table
from harness import asked
from support.modules_in_node import evaluated

START = "rexroth-40x10x6-6-double"
#: Points of rigid nuts, and of nuts whose balls are solved at each of them.
POINTS, POINTS_OF_ELASTIC, CURVE, TIMES = 2000, 60, 41, 30
FEW = (
    ("reference", "row"), ("reference", "double"), ("reference", "oversize-balls"), ("reference", "double+elastic"),
    ("olaru2005", "row"), ("corrected", "double"),
)  # fmt: skip
#: Whole numbers, which are not varied.
WHOLE = ("starts", "loaded_balls")


def points_of(subject: Any, count: int, seed: int = 1) -> dict[str, Any]:
    """All numbers within a tenth of those of a case, loads and speeds of both signs and none."""
    rng = np.random.default_rng(seed)
    found: dict[str, Any] = {}
    for name in inputs_of_module(subject):
        usual = {"axial_load": 3000.0, "screw_speed": 50.0}.get(name) or float(subject.value_of(name))
        found[name] = np.full(count, usual) if name in WHOLE else usual * (1 + 0.1 * rng.uniform(-1, 1, count))
    for name in OPERATION:
        found[name] *= rng.choice([-1.0, 0.0, 1.0], count, p=[0.45, 0.1, 0.45])
    return found


def worst(subject: Any, points: dict[str, Any], found: dict[str, Any]) -> tuple[float, bool]:
    """The worst relative difference of the torque, and whether truth values and NaN agree everywhere."""
    result = subject.at({name: values[0] if name in WHOLE else values for name, values in points.items()})
    agree, count = True, len(points["axial_load"])
    for name, output in outputs_of(subject.nut).items():
        expected = np.broadcast_to(np.asarray(output.read(result), dtype=float), count)
        agree &= np.array_equal(np.isnan(expected), np.isnan(found[name]))
        agree &= output.dtype is not bool or np.array_equal(expected, found[name])
    torque = np.broadcast_to(result.screw_torque, count)
    with np.errstate(invalid="ignore", divide="ignore"):
        off = np.abs(found["screw_torque"] - torque) / np.abs(torque)
    return float(np.nanmax(np.where(torque == 0, 0.0, off))), bool(agree)


def row(structure: tuple[str, str], judging: Judging, folder: Path) -> list[str]:
    """The line of a module."""
    subject = kinds.subject_of(kinds.case_of(START, *structure))
    start = time.process_time()
    module = module_of(subject, varying=varying_of(subject))
    built = time.process_time() - start
    every, solver = module_of_oils(), module_of_solver()
    for each in (module, every, solver, judging.module):
        (folder / each.file).write_bytes(each.code)
    name = "/".join(structure)
    known = contents({structure: KeptModule.of(module)}, every, oils(), solver.file, judging, module_of_banding())
    count = POINTS_OF_ELASTIC if subject.nut.one_by_one else POINTS
    points = points_of(subject, count)
    found, _ = evaluated(folder, known, {"structure": name, "one": {NUT_DIAMETER: None}}, points)
    off, agree = worst(subject, points, found)
    one = {n: float(values[0]) for n, values in points.items() if n not in OPERATION}
    one |= {"axial_load": 3000.0, NUT_DIAMETER: None}
    asked = {"structure": name, "one": one, "times": TIMES}
    _, taken = evaluated(folder, known, asked, {"screw_speed": np.linspace(1.0, 100.0, CURVE)})
    packed = gzip.compress(module.code, mtime=0)
    agrees, times = ("yes" if agree else "NO"), (f"{taken[0]:.1f}", f"{np.median(taken):.2f}")
    sizes = f"{len(module.code) / 1e3:.0f}", f"{len(packed) / 1e3:.0f}"
    return [name, *sizes, f"{built:.1f}", str(count), f"{off:.0e}", agrees, *times]


HEADING = (
    "model/nut", "kB", "gzip kB", "built, s CPU", "points", "worst", "same NaN, truths", "first, ms", "curve, ms",
)  # fmt: skip

if __name__ == "__main__":
    chosen = FEW if asked(__doc__, few=False).few else kinds.structures()
    warnings.simplefilter("ignore")  # of inputs at random, many of which no ball screw has
    with tempfile.TemporaryDirectory() as folder:
        rows = [row(structure, module_of_judging(), Path(folder)) for structure in chosen]
    print(markdown_table(HEADING, rows), end="")
