"""A sweep larger than the memory: rate, peak memory and size of the store; and what a kill -9 costs.

``python benchmarks/out_of_core.py --points 1e8`` fills a store in a process of its own. ``--kill``
fills a second one whose process is killed three times on the way, and checks that finished blocks
stayed as they were and that the two stores are the same, file by file. The stores need 6 bytes of disk
a value, two at a time with ``--kill``, in ``--folder``, and go when all is done.
"""

from __future__ import annotations

import filecmp
import math
import os
import signal
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.sweeps.store_plan import Blocks
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from harness import asked, megabytes, told
from script import OUTPUTS

#: At which parts of the way the process is killed.
KILLED_AT = (0.25, 0.5, 0.8)
#: Largest memory that is asked for.
LIMITS = {"memory_MB": (600.0, False)}


def axes(points: int) -> dict[str, Any]:
    """A grid of about so many points in load, speed and viscosity."""
    columns = 100
    rows = max(1, round(math.sqrt(points / columns)))
    return {
        "axial_load": np.linspace(100, 4000, rows),
        "screw_speed": np.linspace(1, 100, max(1, round(points / columns / rows))),
        "viscosity": np.linspace(0.05, 0.5, columns),
    }


def plan_of(points: int, outputs: int) -> Plan:
    """What is swept."""
    return Plan.of(Configuration(bs.FrictionModel.olaru2005(), SCREW, OIL), OUTPUTS[:outputs], axes(points))


def fill(path: str, points: int, outputs: int) -> None:
    """The process that is measured, or killed."""
    start = time.perf_counter()
    bs.sweep(bs.FrictionModel.olaru2005(), SCREW, OIL, outputs=OUTPUTS[:outputs], to=path, **axes(points))
    print(time.perf_counter() - start)


def started(path: Path, points: int, outputs: int) -> subprocess.Popen[str]:
    """A process that fills a store."""
    given = ["--points", str(points), "--outputs", str(outputs), "--fill", str(path)]
    return subprocess.Popen([sys.executable, __file__, *given], stdout=subprocess.PIPE, text=True)


def filled(path: Path, points: int, outputs: int) -> tuple[float, float]:
    """Seconds and peak memory in MB of a process that fills a store to its end."""
    process = started(path, points, outputs)
    said = process.stdout.read() if process.stdout else ""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode:
        sys.exit(f"the sweep ended with {process.returncode}")
    return float(said), megabytes(usage)


def files(folder: Path) -> Iterator[Path]:
    """All files of a store, from its top."""
    return (path.relative_to(folder) for path in folder.rglob("*") if path.is_file())


def finished(path: Path) -> list[str]:
    """The finished blocks of a store that is being filled."""
    return [block.name for block in (path / ".ballscrew" / "blocks").glob("*")]


def times(path: Path, numbers: list[str], blocks: Blocks, outputs: int) -> dict[str, int]:
    """When the chunks of blocks were written."""
    chunks = ["/".join(map(str, np.unravel_index(int(number), blocks.along))) for number in numbers]
    names = [f"{name}/c/{chunk}" for name in OUTPUTS[:outputs] for chunk in chunks]
    return {name: (path / name).stat().st_mtime_ns for name in names}


def killed(path: Path, points: int, outputs: int) -> dict[str, float]:
    """Kill a process at parts of the way, and go on each time; what was finished must stay as it was."""
    blocks = Blocks.of(plan_of(points, outputs))
    before: dict[str, int] = {}
    kept: list[int] = []
    for part in KILLED_AT:
        process = started(path, points, outputs)
        while len(finished(path)) < part * blocks.count and process.poll() is None:
            time.sleep(0.005)
        process.send_signal(signal.SIGKILL)
        process.communicate()
        if process.returncode != -signal.SIGKILL:
            sys.exit("the sweep was over before it could be killed; take more points")
        kept.append(len(finished(path)))
        now = times(path, finished(path), blocks, outputs)
        assert all(now[name] == at for name, at in before.items())
        before = now
    seconds, memory = filled(path, points, outputs)
    assert times(path, [str(n) for n in range(blocks.count)], blocks, outputs).items() >= before.items()
    return {f"finished_at_kill_{i + 1}": count for i, count in enumerate(kept)} | {
        "last_part_s": seconds,
        "last_part_memory_MB": memory,
    }


def same(one: Path, other: Path) -> bool:
    """Whether two stores are the same, byte for byte."""
    names = sorted(files(one))
    return names == sorted(files(other)) and all(filecmp.cmp(one / name, other / name, shallow=False) for name in names)


def measured(folder: Path, points: int, outputs: int, *, kill: bool) -> dict[str, float]:
    """The figures of one store, and of one that was killed."""
    whole = folder / "whole.zarr"
    plan = plan_of(points, outputs)
    seconds, memory = filled(whole, points, outputs)
    size = sum((whole / name).stat().st_size for name in files(whole))
    figures: dict[str, float] = {
        "points": plan.total,
        "outputs": outputs,
        "blocks": Blocks.of(plan).count,
        "seconds": seconds,
        "Mpoint_per_s": plan.total / seconds / 1e6,
        "numbers_MB_per_s": plan.total * outputs * 8 / seconds / 1e6,
        "disk_GB": size / 1e9,
        "disk_over_numbers": size / (plan.total * outputs * 8),
        "memory_MB": memory,
    }
    if kill:
        figures |= killed(folder / "killed.zarr", points, outputs)
        figures["same"] = same(whole, folder / "killed.zarr")
    return figures


def main() -> None:
    """Measure, and print."""
    options = asked(__doc__, points=1e8, outputs=len(OUTPUTS), kill=False, folder=Path, fill=str)
    points = int(options.points)
    if options.fill:
        fill(options.fill, points, options.outputs)
        return
    with tempfile.TemporaryDirectory(prefix="ballscrew-", dir=options.folder) as name:
        told(measured(Path(name), points, options.outputs, kill=options.kill), options.json, LIMITS)


if __name__ == "__main__":
    main()
