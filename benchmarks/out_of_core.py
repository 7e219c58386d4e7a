"""A sweep larger than the memory: rate, peak memory of the process, and size of the store.

``python benchmarks/out_of_core.py --points 1e8`` prints a table, ``--json`` one object. The store needs 6 bytes of disk
a value, in ``--folder``, and goes when all is done.
"""

from __future__ import annotations

import math
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from harness import asked, megabytes, seconds, told
from script import OUTPUTS

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


def measured(store: Path, points: int) -> dict[str, float]:
    """The figures of a store that is filled."""
    grid, model = axes(points), bs.FrictionModel.olaru2005()
    taken = seconds(lambda: bs.sweep(model, SCREW, OIL, outputs=OUTPUTS, to=store, **grid))
    total = math.prod(map(len, grid.values()))
    size = sum(path.stat().st_size for path in store.rglob("*") if path.is_file())
    numbers = 8 * total * len(OUTPUTS)
    return {
        "points": total,
        "outputs": len(OUTPUTS),
        "seconds": taken,
        "Mpoint_per_s": total / taken / 1e6,
        "numbers_MB_per_s": numbers / taken / 1e6,
        "disk_GB": size / 1e9,
        "disk_over_numbers": size / numbers,
        "memory_MB": megabytes(),
    }


if __name__ == "__main__":
    options = asked(__doc__, points=1e8, folder=Path)
    with tempfile.TemporaryDirectory(prefix="ballscrew-", dir=options.folder) as folder:
        told(measured(Path(folder) / "map.zarr", int(options.points)), options.json, LIMITS)
