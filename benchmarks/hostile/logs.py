"""Mutated logs of torques, read and fitted.

Logs of 40 to 120 rows as CSV, XLSX, MATLAB 5 and MATLAB 7.3 with other separators, decimal commas, headings, units,
encodings, gaps, texts, outliers, repeated rows, clocks that start again, and damaged bytes; read and fitted, one in two
with `--keep-going`.

*Wrong*: a process that is silent for 30 s.
"""

from __future__ import annotations

import csv
import io
import math
import tomllib
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
from benchmarks.hostile import workers
from benchmarks.hostile.mutations import OF_BYTES, OF_TEXT_BYTES, Random, chosen
from benchmarks.hostile.tally import Outcome

from ballscrew.cases.case_files import case_file
from ballscrew.questions.fit import FitOptions, compute
from ballscrew.questions.fit.log import steady_log
from support.fit_logs import FRICTION, HEADINGS, OFFSET, PAPER, columns

COUNT, SECONDS = 300, 120.0

Columns = dict[str, Any]
Cells = list[list[str]]


# -- columns --------------------------------------------------------------------------------------


def _some(change: Callable[[Any, Random], Any], share: float) -> Callable[[Columns, Random], Columns]:
    """A mutation of a share of one column."""

    def mutate(data: Columns, rng: Random) -> Columns:
        name = chosen(rng, list(data))
        values = np.array(data[name], float)
        which = rng.random(values.size) < share
        return {**data, name: np.where(which, change(values, rng), values)}

    return mutate


def _rows(change: Callable[[int, Random], Any]) -> Callable[[Columns, Random], Columns]:
    """A mutation of the order and number of the rows."""

    def mutate(data: Columns, rng: Random) -> Columns:
        order = change(len(data["torque"]), rng)
        return {name: np.asarray(values)[order] for name, values in data.items()}

    return mutate


def _without(data: Columns, rng: Random) -> Columns:
    name = chosen(rng, list(data))
    return {other: values for other, values in data.items() if other != name}


OF_COLUMNS: dict[str, Callable[[Columns, Random], Columns]] = {
    "nothing": lambda data, _: data,
    "gaps": _some(lambda values, _: np.full(values.size, np.nan), 0.1),
    "an empty column": _some(lambda values, _: np.full(values.size, np.nan), 1.1),
    "zeros": _some(lambda values, _: 0 * values, 1.1),
    "other signs": _some(lambda values, _: -values, 0.5),
    "another unit from row to row": _some(lambda values, _: 1e3 * values, 0.5),
    "outliers": _some(lambda values, rng: values * 10 ** rng.uniform(0, 9, values.size), 0.05),
    "huge": _some(lambda values, _: values * 1e300, 0.1),
    "tiny": _some(lambda values, _: values * 1e-300, 1.1),
    "infinite": _some(lambda values, _: np.full(values.size, np.inf), 0.05),
    "constant": _some(lambda values, _: np.full(values.size, values[0]), 1.1),
    "a saturated sensor": _some(lambda values, _: np.clip(values, -0.5, 0.5), 1.1),
    "repeated rows": _rows(lambda n, rng: np.sort(rng.integers(n, size=2 * n))),
    "one row again and again": _rows(lambda n, rng: np.full(n, rng.integers(n))),
    "few rows": _rows(lambda n, rng: rng.permutation(n)[: int(rng.integers(0, 12))]),
    "rows out of order": _rows(lambda n, rng: rng.permutation(n)),
    "a clock that starts again": lambda data, _: {**data, "time": np.arange(len(data["torque"])) % 17},
    "a clock that runs backward": lambda data, _: {**data, "time": -np.arange(float(len(data["torque"])))},
    "a missing column": _without,
}

# -- cells ----------------------------------------------------------------------------------------

TEXTS = (
    "NaN", "nan", "-", "", " ", "n/a", "#DIV/0!", "#N/A", "ERR", "1.000,5", "1,5", "1e400", "-inf", "0x10", "--5",
    "5 kN", "1 N",
    "12:00:01", "2024-01-01", "True", "١٢", "=A1+1", '"', "'", "1 000", "1\u00a0000", "½", "9" * 400,
)  # fmt: skip
TITLES = (
    "torque", "torque [N]", "Torque (Nm)", "M [N m]", "T_ist/Nm", "speed", "n [1/min]", "rpm", "force [kN]",
    "axial load [lbf]", "",
    "time [s]", "t", "temperature [degC]", "Motorstrom [A]", "feed rate [mm/min]", "speed [rpm]", "[N m]",
    "größe [µm]", "x" * 500,
)  # fmt: skip


def _cell(cells: Cells, rng: Random) -> Cells:
    for _ in range(int(rng.choice([1, 3, 40]))):
        row = chosen(rng, cells[1:] or cells)
        if row:
            row[int(rng.integers(len(row)))] = chosen(rng, TEXTS)
    return cells


def _title(cells: Cells, rng: Random) -> Cells:
    cells[0][int(rng.integers(len(cells[0])))] = chosen(rng, TITLES)
    return cells


def _ragged(cells: Cells, rng: Random) -> Cells:
    row = chosen(rng, cells)
    row[:] = chosen(rng, (row[:1], row + row, [], [*row, ""]))
    return cells


def _inserted(lines: Cells) -> Callable[[Cells, Random], Cells]:
    def mutate(cells: Cells, rng: Random) -> Cells:
        where = int(rng.integers(len(cells) + 1))
        return [*cells[:where], *[list(line) for line in lines], *cells[where:]]

    return mutate


OF_CELLS: dict[str, Callable[[Cells, Random], Cells]] = {
    "nothing": lambda cells, _: cells,
    "texts among numbers": _cell,
    "another heading": _title,
    "the same headings": lambda cells, _: [[cells[0][0]] * len(cells[0]), *cells[1:]],
    "no headings": lambda cells, _: cells[1:] or cells,
    "headings again": lambda cells, _: [*cells, *cells],
    "headings below": lambda cells, _: [*cells[1:], cells[0]],
    "rows of other lengths": _ragged,
    "a comment": _inserted([["# measured by hand"]]),
    "empty rows": _inserted([[], ["", "", ""]]),
    "a row of units": _inserted([["s", "rpm", "N", "N m"]]),
    "decimal commas": lambda cells, _: [cells[0], *([text.replace(".", ",") for text in row] for row in cells[1:])],
}

# -- files ----------------------------------------------------------------------------------------


def _csv(cells: Cells, rng: Random) -> bytes:
    out = io.StringIO()
    csv.writer(out, delimiter=chosen(rng, ",,;;\t| "), lineterminator="\n").writerows(cells)
    return out.getvalue().encode("utf-8", "surrogatepass")


def _number(text: str) -> float | str:
    try:
        return float(text)
    except ValueError:
        return text


def _xlsx(cells: Cells, rng: Random) -> bytes:
    import openpyxl

    book, out = openpyxl.Workbook(), io.BytesIO()
    for row in cells:
        values = (_number(text) for text in row)
        book.active.append([v if isinstance(v, str) or math.isfinite(v) else None for v in values])
    book.save(out)
    if rng.random() < 0.5:
        return out.getvalue()
    changed, name = io.BytesIO(), chosen(rng, book_parts := zipfile.ZipFile(out).namelist())
    with zipfile.ZipFile(changed, "w") as new:
        for part in book_parts:
            content = zipfile.ZipFile(out).read(part)
            new.writestr(part, chosen(rng, list(OF_BYTES.values()))(content, rng) if part == name else content)
    return changed.getvalue()


def _variables(cells: Cells) -> dict[str, Any]:
    """The columns as variables of MATLAB, under names that it allows."""
    names = {
        heading: "".join(c if c.isascii() and c.isalnum() else "_" for c in f"x_{heading}")[:60] for heading in cells[0]
    }
    rows = [[value if isinstance(value := _number(t), float) else math.nan for t in row] for row in cells[1:]]
    length = min((len(row) for row in rows), default=0)
    table = np.array([row[:length] for row in rows]).reshape(len(rows), length)
    known = {"time": "time_s", "speed": "speed_rpm", "axial load": "axial_load_N", "torque": "torque_Nm"}
    return {known.get(h.partition(" [")[0], names[h]): table[:, i] for i, h in enumerate(cells[0][:length])}


def _mat5(cells: Cells, _: Random) -> bytes:
    import scipy.io

    out = io.BytesIO()
    scipy.io.savemat(out, _variables(cells))
    return out.getvalue()


def _mat73(cells: Cells, _: Random) -> bytes:
    import h5py

    out = io.BytesIO()
    with h5py.File(out, "w", userblock_size=512) as file:
        for name, values in _variables(cells).items():
            file[name] = values[None, :]
    return b"MATLAB 7.3 MAT-file".ljust(512, b" ") + out.getvalue()[512:]


FILES: dict[str, Callable[[Cells, Random], bytes]] = {"csv": _csv, "xlsx": _xlsx, "mat": _mat5, "7.3.mat": _mat73}


def written(data: Columns, headings: dict[str, str], rng: Random, wild: float) -> tuple[str, str, bytes]:
    """A suffix, and the mutations and the content of a file of these columns; a share of its bytes is ``wild``."""
    suffix, done = chosen(rng, ["csv", "csv", "csv", *FILES]), chosen(rng, list(OF_CELLS))
    cells: Cells = [[headings[name] for name in data]]
    cells += [[f"{value:.9g}" for value in row] for row in zip(*data.values(), strict=True)]
    content = FILES[suffix](OF_CELLS[done](cells, rng), rng) if data else b""
    if rng.random() >= wild:
        return suffix, done, content
    damages = OF_TEXT_BYTES if suffix == "csv" else OF_BYTES
    damage = chosen(rng, list(damages))
    return suffix, f"{done}, {damage}", damages[damage](content, rng)


def attempt(seed: int, number: int, _: int) -> Outcome:
    """One log."""
    rng = np.random.default_rng([seed, number])
    rows, done = int(rng.integers(40, 121)), chosen(rng, list(OF_COLUMNS))
    data: Columns = {"time": np.arange(float(rows)), **columns(rows, seed=int(rng.integers(1 << 31)))}
    suffix, others, content = written(OF_COLUMNS[done](data, rng), HEADINGS, rng, 0.4)
    path = workers.folder() / f"log.{suffix}"
    path.write_bytes(content)
    options = FitOptions(free=chosen(rng, ([FRICTION], [FRICTION, OFFSET])), keep_going=bool(number % 2))

    def work() -> str:
        case = case_file.build(tomllib.loads(PAPER), None, Path())
        found = compute.fit(case, steady_log(case, path, options), options).model
        estimates = {name: estimate.value for name, estimate in found.estimates.items()}
        return "" if all(map(math.isfinite, estimates.values())) else f"estimates {estimates}"

    return workers.judged(f"attempt {number} (.{suffix}: {done}, {others})", work)
