"""Mutated case files, read and run in process, and some of them by the command.

The example case files and one with all tables, with numbers, units, names, types, lines, sections, letters and bytes
changed; read, run and written as JSON and text in process, one in 60 also by `ballscrew run`.

*Wrong*: a refusal after more than 10 s (1 s is asked for; other work on the machine is allowed for); of the command
output with exit code 2, or another answer than in process.
"""

from __future__ import annotations

import math
import subprocess
import sys
import time
from typing import Any

import numpy as np
from benchmarks.hostile import ROOT, workers
from benchmarks.hostile.mutations import chosen, mutated_text
from benchmarks.hostile.screws import TORQUES
from benchmarks.hostile.tally import Outcome

from ballscrew.basis.output.json_text import as_json
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.questions.run import answer, compute
from ballscrew.questions.run.sheet import sheet

COUNT, SECONDS = 3_000, 130.0

#: One in so many is also tried by the command.
BY_COMMAND = 60
TOO_SLOW = 10.0
COMMAND_SECONDS = 25.0

#: A case with all tables.
WHOLE = """
[screw]
catalogue = "rexroth-40x10x6-6-double"
screw_roughness = "0.2 um"

[lubricant]
grade = "ISO VG 68"
temperature = "35 degC"

[operation]
axial_load = "3 kN ± 10 %"
screw_speed = "300 rpm"

[model]
name = "reference"
friction.boundary_friction_coefficient = "0.13 ± 0.04"

[nut]
type = "double"
preload = "2 kN"

[bodies]
same_side = false

[deviations]
ball_diameter = "0.5 um"
lead = "1 um"

[losses]
seals.seal_torque = "0.2 N m"

[installation]
unsupported_length = "900 mm"
ends = "fixed-free"

[limits]
running_time = "5000 h"
"""


def texts() -> list[str]:
    """The case files that are mutated."""
    return [WHOLE, *(path.read_text(encoding="utf-8") for path in sorted((ROOT / "examples").glob("*.toml")))]


def attempt(seed: int, number: int, _: int) -> Outcome:
    """One file."""
    rng = np.random.default_rng([seed, number])
    done, content = mutated_text(chosen(rng, texts()), rng)
    path = workers.folder() / f"{number}.toml"
    path.write_bytes(content)
    begun = time.monotonic()
    found = workers.judged(f"attempt {number} ({done})", lambda: not_finite(path))
    wrong = ""
    if found.refused and time.monotonic() - begun > TOO_SLOW:
        wrong = f"refused after {time.monotonic() - begun:.1f} s"
    elif not found.wrong and number % BY_COMMAND == 0:
        wrong = wrong_command(path, is_answer=bool(found.answered))
    path.unlink()
    return Outcome(wrong=[f"attempt {number} ({done}): {wrong}"]) if wrong else found


def not_finite(path: Any) -> str:
    """Run a case and write its result; words on a number that is not finite without a warning."""
    case = case_file.load(path)
    found = compute.run(case)
    document = answer.document(found)
    as_json(document)
    terminal.text(sheet(found))
    bad = [name for name in TORQUES if not math.isfinite(float(getattr(found.friction, name)))]
    return f"{', '.join(bad)} not finite, without a warning" if bad and not document["warnings"] else ""


def wrong_command(path: Any, *, is_answer: bool) -> str:
    """Words on what the command does wrong with a file; empty where it does as it should."""
    command = [sys.executable, "-W", "error::RuntimeWarning", "-m", "ballscrew.faces.cli", "run", str(path)]
    try:
        done = subprocess.run(
            command, capture_output=True, check=False, timeout=COMMAND_SECONDS, encoding="utf-8", errors="replace"
        )
    except subprocess.TimeoutExpired:
        return f"the command took more than {COMMAND_SECONDS:g} s"
    if faults := workers.faults_of_command(done.returncode, done.stderr):
        return f"the command {faults[0]}"
    if done.returncode == 2 and done.stdout:
        return "the command refused it and wrote to its output"
    if (done.returncode == 0) != is_answer:
        return f"the command ended with {done.returncode}, and in process it was {'' if is_answer else 'not '}answered"
    return ""
