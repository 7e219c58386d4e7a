"""Models handed over as C and as FMU: sizes, times, and how far they are from Python, for every preset and kind of nut.

``python benchmarks/hand_over.py`` prints a table, ``--preset reference`` that of one model. It
needs gcc, and Linux on x86-64 for the prebuilt interpreter. All points are random, in four
quadrants, at 10 to 80 °C and half to one and a half times the preload.
"""

from __future__ import annotations

import ctypes
import subprocess
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.exports.hand_over import export_job
from ballscrew.exports.programs import c99, fmu, interpreter
from ballscrew.exports.programs.two_levels import two_levels
from ballscrew.exports.subject import HandOver
from ballscrew.questions.shared.text_tables import markdown_table
from harness import asked, seconds

PRESETS = ("olaru2005", "corrected", "reference")
NUTS = {
    "row of balls": bs.SingleNut(),
    "single": bs.SingleNut(angle_under_load=True),
    "double": bs.DoubleNut(preload=900.0),
    "offset lead": bs.OffsetLeadNut(preload=900.0),
    "oversize balls": bs.OversizeBallNut(preload=900.0),
    "double, elastic": bs.DoubleNut(preload=900.0, bodies=bs.Bodies()),
}
#: Points at which a nut with elastic bodies is evaluated: each takes Python milliseconds.
POINTS_OF_ELASTIC_BODIES = 1000
HEADINGS = (
    "model", "nut", "steps", "export to C, s", "source, kB", "gcc -O2, s", "compiled, µs", "interpreted, µs",
    "export to FMU, s", "FMU, kB", "largest relative difference", "other validity",
)  # fmt: skip


def difference(found: dict[str, np.ndarray], wanted: dict[str, np.ndarray]) -> tuple[float, int]:
    """The largest relative difference of torques and power, and the number of points of another validity."""
    worst = 0.0
    for name in ("screw_torque", "friction_power"):
        size = np.abs(wanted[name])
        off = np.abs(found[name] - wanted[name])
        worst = max(worst, float(np.max(np.divide(off, size, out=np.zeros_like(off), where=size > 0))))
    # a difference of two torques, near zero relative to what it is the difference of
    size = np.maximum(np.abs(wanted["ideal_torque"]), wanted["screw_torque"])
    off = np.abs(found["drive_torque"] - wanted["drive_torque"])
    worst = max(worst, float(np.max(np.divide(off, size, out=np.zeros_like(off), where=size > 0))))
    return worst, int(np.sum(found["valid"] != wanted["valid"]))


_MANY = """\
#include "ballscrew.h"

void many(const double *inputs, double *outputs, int n);

void many(const double *inputs, double *outputs, int n)
{
    for (; n > 0; n--, inputs += BALLSCREW_INPUT_COUNT, outputs += BALLSCREW_OUTPUT_COUNT)
        ballscrew_evaluate(inputs, outputs);
}
"""


def compiled(one: HandOver, folder: Path) -> tuple[float, Any]:
    """The time of compiling the source, s, and its evaluation of many points."""
    (folder / "ballscrew.c").write_text(c99.source(one))
    (folder / "ballscrew.h").write_text(c99.header(one))
    (folder / "many.c").write_text(_MANY)
    made = folder / "ballscrew.so"
    command = ["gcc", "-std=c99", "-O2", "-Wall", "-Wextra", "-pedantic", "-Werror", "-shared", "-fPIC"]
    command += ["ballscrew.c", "many.c"]
    took = seconds(lambda: subprocess.run([*command, "-o", made, "-lm"], cwd=folder, check=True))
    return took, ctypes.CDLL(str(made)).many


def steps(one: HandOver) -> int:
    """Steps of a program, of a nut with elastic bodies those of each ball."""
    return len((two_levels(one).each_ball if one.has_elastic_bodies else one.program).steps)


def rows(presets: tuple[str, ...], most: int) -> Iterator[tuple[str, ...]]:
    """A row for each model and nut."""
    oil = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
    for preset in presets:
        for kind, nut in NUTS.items():
            screw = bs.catalogue()["rexroth-16x5x3-4-double"].screw(nut=nut)
            model = getattr(bs.FrictionModel, preset)()
            try:
                one = export_job(model, screw, oil, "c")
            except bs.InputError:
                continue  # its slip knows no balls with four contacts
            to_c = seconds(lambda model=model, screw=screw: bs.hand_over(model, screw, oil, to="c"))
            to_fmu = seconds(lambda model=model, screw=screw: bs.hand_over(model, screw, oil, to="fmu"))
            count = min(most, POINTS_OF_ELASTIC_BODIES) if one.has_elastic_bodies else most
            points = one.sample(count)
            wanted = one.evaluate(points)
            given = np.ascontiguousarray(np.stack([points[name] for name in one.input_names], axis=-1))
            results = np.empty((count, len(one.output_names)))
            with tempfile.TemporaryDirectory() as folder:
                took, many = compiled(one, Path(folder))
                places = ctypes.c_void_p(given.ctypes.data), ctypes.c_void_p(results.ctypes.data)
                call = min(seconds(lambda many=many, places=(*places, count): many(*places)) for _ in range(3)) / count
            worst, others = difference(dict(zip(one.output_names, results.T, strict=True)), wanted)
            run = interpreter.Interpreted(interpreter.program_file(one))
            read = min(seconds(lambda run=run, points=points: run.at(points)) for _ in range(3)) / count
            size = len(bs.hand_over(model, screw, oil, to="fmu").files[f"{fmu.IDENTIFIER}.fmu"])
            source = len(c99.source(one))
            yield (
                preset,
                kind,
                f"{steps(one):,}",
                f"{to_c:.2f}",
                f"{source / 1e3:.0f}",
                f"{took:.1f}",
                f"{1e6 * call:.1f}",
                f"{1e6 * read:.1f}",
                f"{to_fmu:.2f}",
                f"{size / 1e3:.0f}",
                f"{worst:.1e}",
                f"{others}",
            )


if __name__ == "__main__":
    options = asked(__doc__, preset=list(PRESETS), points=10_000)
    print(markdown_table(HEADINGS, list(rows(options.preset or PRESETS, options.points))), end="")
