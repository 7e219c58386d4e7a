"""Mutated recorded motions, from which a duty is computed.

Recorded motions of 20 to 200 rows with the damage of the logs, with nothing but NUL, blank lines, separators or one
row, with jumps, rests and clocks that stand still; the duty of a vertical axis over each, as JSON and as text.

*Wrong*: a process that is silent for 30 s.
"""

from __future__ import annotations

import functools
import math
import tomllib
from collections.abc import Callable
from typing import Any

import numpy as np
from benchmarks.hostile import ROOT, logs, workers
from benchmarks.hostile.mutations import Random, chosen
from benchmarks.hostile.tally import Outcome

from ballscrew.basis.output.json_text import as_json
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions.duty import answer, compute, verdicts
from ballscrew.questions.duty.sheet import sheet

COUNT, SECONDS = 300, 120.0

HEADINGS = {"time": "time [s]", "position": "position [mm]", "force": "force [N]", "temperature": "temperature [degC]"}
NUMBERS = ("torque_peak", "torque_rms", "power_peak", "energy_drawn", "energy_lost")
#: Files that hold no table.
EMPTY: dict[str, bytes] = {
    "nothing": b"",
    "NUL": b"\0" * 300,
    "blank lines": b"\n" * 40,
    "lines of blanks": b"   \n\t\n" * 20,
    "lines of separators": b",,,\n;;;\n" * 20,
    "quotes": b'""\n' * 20,
    "a mark of the byte order": b"\xef\xbb\xbf",
    "headings": b"time [s],position [mm]\n",
    "one row": b"time [s],position [mm]\n0,0\n",
    "two rows": b"time [s],position [mm]\n0,0\n1,5\n",
    "comments": b"# measured by hand\n" * 20,
}


def _jump(data: dict[str, Any], rng: Random) -> dict[str, Any]:
    moved = np.array(data["position"])
    moved[rng.integers(moved.size) :] += 10.0 ** rng.uniform(-3, 6)
    return {**data, "position": moved}


def _scaled_clock(data: dict[str, Any], rng: Random) -> dict[str, Any]:
    return {**data, "time": np.asarray(data["time"]) * 10.0 ** rng.uniform(-300, 300)}


OF_COLUMNS: dict[str, Callable[[dict[str, Any], Random], dict[str, Any]]] = {
    **logs.OF_COLUMNS,
    "a jump": _jump,
    "a rest": lambda data, _: {**data, "position": 0 * np.asarray(data["position"])},
    "a clock that stands still": lambda data, _: {**data, "time": 0 * np.asarray(data["time"])},
    "a clock of another unit": _scaled_clock,
}


def trace(rng: Random) -> tuple[str, str, bytes]:
    """The suffix, the mutations and the content of a mutated motion."""
    if rng.random() < 0.15:
        name = chosen(rng, list(EMPTY))
        return chosen(rng, ["csv", "txt", "xlsx", "mat"]), name, EMPTY[name]
    rows = int(rng.integers(20, 201))
    time = np.linspace(0, 4, rows)
    data: dict[str, Any] = {"time": time, "position": 200 * (1 - np.cos(math.pi / 2 * time))}
    data["force"] = rng.normal(0, 100, rows)
    if rng.random() < 0.3:
        data["temperature"] = np.linspace(-10, 40, rows)
    # the mutations of logs take the length from the torque
    changed = OF_COLUMNS[done := chosen(rng, list(OF_COLUMNS))]({**data, "torque": time}, rng)
    data = {name: values for name, values in changed.items() if name != "torque"}
    kind, others, content = logs.written(data, HEADINGS, rng, 0.2)
    return kind, f"{done}, {others}", content


@functools.cache
def _tables() -> dict[str, Any]:
    return tomllib.loads((ROOT / "examples" / "vertical_axis.toml").read_text(encoding="utf-8"))


def attempt(seed: int, number: int, _: int) -> Outcome:
    """One motion."""
    rng = np.random.default_rng([seed, number])
    kind, done, content = trace(rng)
    path = workers.folder() / f"trace.{kind}"
    path.write_bytes(content)

    def work() -> str:
        tables = {**_tables(), "motion": {"kind": "trajectory", "file": str(path)}}
        report = compute.duty(case_file.build(tables, None, ROOT / "examples", moves=True))
        as_json(answer.document(report))
        terminal.text(sheet(report))
        bad = [name for name in NUMBERS if not math.isfinite(report.numbers[name])]
        return f"{', '.join(bad)} not finite, without a warning" if bad and not verdicts.warnings(report) else ""

    return workers.judged(f"attempt {number} (.{kind}: {done})", work)
