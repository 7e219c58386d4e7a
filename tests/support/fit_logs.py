"""Logs for tests of ``ballscrew fit``, and what it answers."""

import csv
import dataclasses
import io
import tomllib
from pathlib import Path

import numpy as np

from ballscrew.cases.case_files import case_file

EXAMPLES = Path(__file__).parents[2] / "examples"


RPM = 2 * np.pi / 60


FRICTION, OFFSET = "boundary_friction_coefficient", "pure_rolling_offset"


TRUE_FRICTION, NOISE = 0.11, 0.004


HEADINGS = {"time": "time [s]", "speed": "speed [rpm]", "load": "axial load [N]", "torque": "torque [N m]"}


PAPER = """
[screw]
pitch_circle_diameter = "40 mm"
lead = "5 mm"
ball_diameter = "3.175 mm"
loaded_balls = 56
contact_angle = "45 deg"
screw_conformity = 0.515
nut_conformity = 0.515

[lubricant]
viscosity = "0.1 Pa s"

[operation]
axial_load = "2 kN"
screw_speed = "100 rpm"

[model]
name = "olaru2005"
"""


def columns(rows=120, seed=0, loads=(200, 4000), speeds=(10, 1000), noise=NOISE):
    """A drive torque in both directions, in the units of people, at single settings in random order."""
    random = np.random.default_rng(seed)
    made = case_file.build(tomllib.loads(PAPER), None, EXAMPLES)
    friction = dataclasses.replace(made.model.friction, boundary_friction_coefficient=TRUE_FRICTION)
    true = dataclasses.replace(made.model, friction=friction)
    load = random.uniform(*loads, rows)
    speed = np.exp(random.uniform(*np.log(speeds), rows))
    sign = np.where(random.random(rows) < 0.5, -1.0, 1.0)
    result = true(made.screw, made.lubricant, axial_load=load, screw_speed=speed * RPM)
    torque = result.ideal_torque + sign * result.screw_torque + random.normal(0, noise, rows)
    return {"speed": sign * speed, "load": load, "torque": torque}


def text_of(data, **headings):
    """The columns as CSV; ``headings`` of some of them."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([{**HEADINGS, **headings}[name] for name in data])
    for row in zip(*data.values(), strict=True):
        writer.writerow([x if isinstance(x, str) else "" if np.isnan(x) else repr(float(x)) for x in row])
    return out.getvalue()


def refused(done, words):
    """Bad input: exit code 2, one line a fault, nothing else, nothing written."""
    assert done.returncode == 2, done.stdout
    assert done.stdout == ""
    assert words in done.stderr
    assert "Traceback" not in done.stderr
    assert list(done.place.iterdir()) == []
    return done.stderr.strip().splitlines()


def changed(**new):
    return {**columns(), **new}
