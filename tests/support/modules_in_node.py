"""The modules of the static page run by node: what the browser would compute, as arrays."""

import json
import subprocess
from pathlib import Path

import numpy as np

import ballscrew
from ballscrew.exports.wasm_modules import module_of_oils, module_of_solver, oils
from ballscrew.faces.page import kinds, modules
from ballscrew.faces.page.banding import module_of_banding
from ballscrew.faces.page.contents import contents
from ballscrew.faces.page.judging import module_of_judging
from support.node import node

PAGE = Path(ballscrew.__file__).parent / "faces" / "page"
ENGINE = Path(ballscrew.__file__).parent / "faces" / "page" / "engine.js"
SCRIPT = Path(__file__).with_name("node_engine.mjs")


class Modules:
    """Modules of some structures in a folder, with what the page knows of them."""

    def __init__(self, folder, structures):
        self.folder = folder
        made = {pair: modules.module_of_structure(*pair) for pair in structures}
        of_oils, solver = module_of_oils(), module_of_solver()
        judging, banding = module_of_judging(), module_of_banding()
        found = {pair: modules.module_of_calibrated(*pair) for pair in structures}
        calibrated = {pair: module for pair, module in found.items() if module is not None}
        for module in (*made.values(), *calibrated.values(), of_oils, solver, judging.module, banding.module):
            (folder / module.file).write_bytes(module.code)
        self.contents = contents(made, of_oils, oils(), solver.file, judging, banding, calibrated)

    def evaluate(self, structure, points, one=None):
        """The outputs at points, arrays of one length by name; what is the same at all of them stands in ``one``."""
        return self._found({"structure": "/".join(structure), "one": one or {}}, points)

    def oil(self, grade, temperatures):
        """The numbers of a grade of oil at temperatures."""
        return self._found({"structure": next(iter(self.contents["structures"])), "grade": grade}, {"t": temperatures})

    def _found(self, asked, points):
        return evaluated(self.folder, self.contents, asked, points)[0]


def evaluated(folder, known, asked, points):
    """What node finds at points with the contents of a page and modules in a folder, and the milliseconds it took."""
    count = len(next(iter(points.values())))
    job = {**asked, "count": count, "names": list(points), "out": "job"}
    np.array(list(points.values()), dtype=float).tofile(folder / "job.in")
    (folder / "jobs.json").write_text(json.dumps({"contents": known, "jobs": [job]}))
    done = subprocess.run([node(), SCRIPT, ENGINE, folder], capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    said = json.loads((folder / "job.json").read_text())
    found = np.fromfile(folder / "job.out").reshape(len(said["names"]), count)
    return dict(zip(said["names"], found, strict=True)), said["milliseconds"]


def start_of(structure, start="rexroth-40x10x6-6-double"):
    """What is evaluated of a start with a model and a kind of nut."""
    return kinds.subject_of(kinds.case_of(start, *structure))
