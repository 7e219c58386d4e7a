"""Nuts with elastic bodies: the solver of the loads in C against Python's, and the exports against the model."""

import ctypes
import math
import re
from importlib import resources
from typing import get_type_hints

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.exports.programs import c99, interpreter
from ballscrew.exports.programs.two_levels import ElasticNut, elastic_nut, two_levels
from ballscrew.physics.components.nut import Bodies, Scatter
from ballscrew.physics.friction.loaded_balls import loads_of

from .compiled import library, needs_a_compiler
from .test_c99 import compare, compiled, needs_the_library

LOADS = np.array([0.0, 1e-3, -5.0, 200.0, -1000.0, 1500.0, 3000.0, -20000.0])
NUTS = {
    "single": lambda bodies: bs.SingleNut(bodies=bodies),
    "double": lambda bodies: bs.DoubleNut(preload=900.0, spacing=0.02, bodies=bodies),
    "offset": lambda bodies: bs.OffsetLeadNut(preload=900.0, bodies=bodies),
    "oversize": lambda bodies: bs.OversizeBallNut(preload=900.0, bodies=bodies),
    "no preload": lambda bodies: bs.DoubleNut(preload=0.0, bodies=bodies),
}


class Nut(ctypes.Structure):
    _fields_ = [
        (name, ctypes.c_int if kind is int else ctypes.c_double) for name, kind in get_type_hints(ElasticNut).items()
    ]


@pytest.fixture(scope="module")
def solver(tmp_path_factory):
    folder = resources.files("ballscrew").joinpath("data", "exports")
    made = library(tmp_path_factory.mktemp("solver"), folder.joinpath("ballscrew_loads.c"), level="-O2").ballscrew_loads
    pointer = ctypes.c_void_p
    made.restype, made.argtypes = ctypes.c_double, [pointer, ctypes.c_double, ctypes.c_double, pointer, pointer]
    return made


@needs_a_compiler
@pytest.mark.parametrize("swelling", [True, False])
@pytest.mark.parametrize("same_side", [True, False])
@pytest.mark.parametrize("kind", NUTS)
def test_loads_of_the_balls_are_those_of_python(handed_over, solver, kind, same_side, swelling):
    nut = NUTS[kind](Bodies(same_side=same_side, swelling=swelling))
    handed = handed_over(bs.FrictionModel.reference(), nut)
    numbers = elastic_nut(handed)
    balls = numbers.all_balls
    room, found = np.empty(11 * balls), np.empty(4 * balls)
    wanted = loads_of(handed.subject.screw, LOADS)
    preload = getattr(nut, "preload", None) or 0.0
    for k, load in enumerate(LOADS):
        residual = solver(ctypes.byref(Nut(*numbers)), load, preload, room.ctypes.data, found.ctypes.data)
        exact = np.array([wanted.forward_load[k], wanted.backward_load[k]])
        mean = max((abs(load) + preload) / balls, 1e-9)
        assert np.max(np.abs(found.reshape(4, balls)[:2] - exact)) <= 1e-10 * mean  # both end at 1e-13 of the forces
        angles = np.array([wanted.forward_angle[k], wanted.backward_angle[k]])
        assert np.max(np.abs(found.reshape(4, balls)[2:] - angles), where=exact > 0.0, initial=0.0) <= 1e-12
        assert residual <= 1e-10


@needs_a_compiler
def test_compiled_is_the_model(handed_over, tmp_path):
    nut = bs.DoubleNut(preload=900.0, bodies=Bodies())
    more = ["maximum_pressure", "contact_load"]  # a greatest value, and one at the ball where another is greatest
    handed = handed_over(bs.FrictionModel.olaru2005(), nut, outputs=more)
    points = handed.sample(300)
    wanted = handed.evaluate(points)
    compare(compiled(handed, tmp_path)(points), wanted)


def test_the_stack_that_is_stated_is_that_of_the_arrays(handed_over):
    """Eight bytes for each number of the arrays of an evaluation, in whole kB."""
    nut = bs.DoubleNut(preload=900.0, bodies=Bodies())
    export = c99.export(handed_over(bs.FrictionModel.olaru2005(), nut))
    text = next(
        one.decode() for name, one in export.files.items() if name.endswith(".c") and b"BALLSCREW_LOADS_ROOM" in one
    )
    balls = int(re.search(r"found\[BALLSCREW_LOADS_SIZE\((\d+)\)\]", text)[1])
    sizes = re.findall(r"^ +double [abcz]\[(\d+)\](?:, b\[(\d+)\], c\[(\d+)\], y\[(\d+)\])?", text, re.MULTILINE)
    numbers = sum(int(size) for one in sizes for size in one if size) + (4 + 11) * balls
    said = int(re.search(r"needs (\d+) kB of stack", "".join(one.decode() for one in export.files.values()))[1])
    assert said == math.ceil(numbers * 8 / 1000)


@needs_the_library
@pytest.mark.parametrize(
    ("preset", "kind"), [("olaru2005", "double"), ("olaru2005", "single"), ("olaru2005", "no preload")]
)
def test_interpreted_is_the_model(handed_over, preset, kind):
    handed = handed_over(getattr(bs.FrictionModel, preset)(), NUTS[kind](Bodies()), outputs=["contact_load"])
    points = handed.sample(30)
    points["axial_load"][-2:], points["screw_speed"][-1] = 0.0, 0.0
    found = interpreter.Interpreted(interpreter.program_file(handed)).at(points)
    compare(found, handed.evaluate(points))


@needs_the_library
def test_a_cut_program_is_refused(handed_over):
    whole = interpreter.program_file(handed_over(bs.FrictionModel.olaru2005(), NUTS["double"](Bodies())))
    for length in range(0, len(whole), 97):
        with pytest.raises(ValueError, match="damaged"):
            interpreter.Interpreted(whole[:length])


@pytest.mark.parametrize(
    ("nut", "asked", "expected"),
    [
        (bs.DoubleNut(preload=900.0, deviations=Scatter(ball_diameter=1e-7)), {}, "hand_over.to: balls or a lead that"),
        (bs.OversizeBallNut(oversize=3e-6, bodies=Bodies()), {}, "nut.oversize: is not for elastic bodies"),
        (bs.DoubleNut(preload=900.0, bodies=Bodies()), {"derivatives": ["screw_speed"]}, "hand_over.derivatives: are"),
        (bs.DoubleNut(preload=900.0, bodies=Bodies()), {"parameters": ["lead"]}, "hand_over.parameters: changes the"),
        (bs.DoubleNut(preload=900.0, bodies=Bodies()), {"outputs": ["rigidity"]}, "hand_over.outputs: need what"),
    ],
)
def test_what_the_solver_in_c_has_not_is_refused(handed_over, nut, asked, expected):
    with pytest.raises(bs.InputError, match=expected):
        two_levels(handed_over(bs.FrictionModel.reference(), nut, **asked))
