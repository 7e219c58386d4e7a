"""The bands of the static page, as node runs its scripts, and those of the program for the same cases."""

import dataclasses
import json
import subprocess
from pathlib import Path

import numpy as np

from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.engine.uncertainty import bands
from ballscrew.faces.page import kinds
from ballscrew.questions.band.compute import of_makers
from support.judged_in_node import JudgedPage, case_at
from support.modules_in_node import ENGINE, PAGE
from support.node import node

SCRIPT = Path(__file__).with_name("node_bands.mjs")
#: Milliseconds of a step of the worker.
STEP = 40


class BandsPage(JudgedPage):
    """The page of some structures."""

    def question(self, start, structure, speeds=(), **changes):
        """What the page asks at a start, with changes."""
        lubricant = kinds.case_of(start, *structure).lubricant
        oil = {"grade": lubricant.grade or "", "temperature": lubricant.temperature or 313.15}
        inputs = self.inputs(start, structure, **changes)
        chosen = {"structure": "/".join(structure), "start": start, "kept": list(changes)}
        return {**chosen, "inputs": inputs, **oil, "speeds": list(speeds)}

    def bands(self, questions, step=STEP):
        """What the page finds."""
        asked = {"contents": self.contents, "questions": questions, "step": step}
        (self.folder / "questions.json").write_text(json.dumps(asked))
        command = [node(), SCRIPT, PAGE, ENGINE, self.folder]
        done = subprocess.run(command, capture_output=True, text=True, timeout=600)
        assert done.returncode == 0, done.stderr
        return json.loads((self.folder / "answers.json").read_text())


def arguments_of(start, structure, question):
    """What the program is given for the same case, with the calibrations of makers and without other laws."""
    case = case_at(start, structure, question["inputs"])
    if question["grade"]:  # an oil of a grade is uncertain by its temperature
        lubricant = dataclasses.replace(kinds.case_of(start, *structure).lubricant, temperature=question["temperature"])
        case = dataclasses.replace(case, lubricant=lubricant)
    uncertain = {name: one.distribution for name, one in uncertain_inputs.all_of(case).items()}
    parts = {"model": case.model, "screw": case.screw, "lubricant": case.lubricant}
    return {
        **parts,
        "distributions": uncertain,
        "axial_load": float(case.operation.axial_load),
        "alternatives": of_makers(case),
    }


def band_of_program(start, structure, question, samples, outputs):
    """The band of the program at the operating point."""
    given = arguments_of(start, structure, question)
    return bands.band(**given, screw_speed=question["inputs"]["screw_speed"], outputs=outputs, samples=samples)


def fan_of_program(start, structure, question, samples):
    """The band of the program over the speeds."""
    given = arguments_of(start, structure, question)
    return bands.band_along(
        **given,
        along="screw_speed",
        points=np.array(question["speeds"]),
        samples=samples,
        screw_speed=question["inputs"]["screw_speed"],
    )
