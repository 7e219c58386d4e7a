"""A small sweep for tests of stores, and the files that it leaves."""

import math
import subprocess
import sys

import numpy as np

import ballscrew as bs
from ballscrew.engine.sweeps.store import Store

RPM = math.pi / 30


MODEL = bs.FrictionModel.olaru2005()


AXES = {"axial_load": np.linspace(10, 4000, 7), "screw_speed": np.linspace(1, 100, 9), "viscosity": [0.05, 0.1, 0.3]}


SMALL = {"outputs": ["screw_torque", "efficiency", "valid"], "block_size": 12, **AXES}


def files(folder):
    """All that lies in a folder, byte for byte."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def times(folder, names):
    return {name: (folder / name).stat().st_mtime_ns for name in names}


#: A sweep in a process of its own: its store, a pause after each block, the sizes of its axes, and of its blocks.
KILLED = """
import sys, time
import numpy as np
import ballscrew as bs
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
store, pause, *sizes, block_size = sys.argv[1:]
ends = {"axial_load": (10, 4000), "screw_speed": (1, 100), "viscosity": (0.05, 0.5)}
axes = {name: np.linspace(*ends[name], int(size)) for name, size in zip(ends, sizes)}
bs.sweep(
    bs.FrictionModel.olaru2005(), SCREW, OIL, outputs=["screw_torque", "efficiency", "valid"], to=store,
    block_size=int(block_size), done=lambda finished, total: time.sleep(float(pause)), **axes,
)
"""
KILLED_SIZES, KILLED_BLOCK_SIZE, KILLED_BLOCKS = (100, 200, 100), 20_000, 100


def started(path, pause, sizes=KILLED_SIZES, block_size=KILLED_BLOCK_SIZE):
    given = map(str, (path, pause, *sizes, block_size))
    return subprocess.Popen([sys.executable, "-c", KILLED, *given], stderr=subprocess.PIPE, text=True)


def blocks_of(path):
    return list((path / ".ballscrew" / "blocks").glob("*"))


def stop_at(number, error, monkeypatch):
    """Let the commit of a block end otherwise."""
    commit = Store.commit

    def committed(self, block, *others):
        if block == number:
            raise error
        commit(self, block, *others)

    monkeypatch.setattr(Store, "commit", committed)
