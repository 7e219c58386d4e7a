"""What the static page judges, says and draws, as node runs its scripts."""

import dataclasses
import json
import subprocess
from pathlib import Path

from ballscrew.faces.page import kinds
from support.modules_in_node import PAGE, Modules
from support.node import node

SCRIPT = Path(__file__).with_name("node_judgements.mjs")


class JudgedPage(Modules):
    """The page of some structures."""

    def inputs(self, start, structure, **changes):
        """The inputs of the page at a start, with changes, SI."""
        model, kind = structure
        own = self.contents["starts"][start]
        values = {**self.contents["models"][model]["values"], **own["values"], **own["nuts"][kind]["values"]}
        assert changes.keys() <= values.keys()
        return {**values, **changes}

    def point(self, start, structure, given=None, **changes):
        """A point as the page has it."""
        inputs = self.inputs(start, structure, **changes)
        return {"structure": "/".join(structure), "start": start, "inputs": inputs, "given": given or {}}

    def judged(self, points):
        """What the page finds at points."""
        (self.folder / "points.json").write_text(json.dumps({"contents": self.contents, "points": points}))
        command = [node(), SCRIPT, PAGE, self.folder]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr
        return json.loads((self.folder / "judged.json").read_text())


def case_at(start, structure, inputs, **parts):
    """The case of a start with these inputs in place; ``parts`` are further fields of it, such as limits."""
    case = kinds.case_of(start, *structure)
    subject = kinds.subject_of(case)
    own = {
        name: inputs[name] for name in inputs if name in subject.inputs and name not in ("axial_load", "screw_speed")
    }
    changed = subject.changed(own)
    operation = dataclasses.replace(case.operation, **{name: inputs[name] for name in ("axial_load", "screw_speed")})
    return dataclasses.replace(
        case, model=changed.model, screw=changed.screw, lubricant=changed.lubricant, operation=operation, **parts
    )
