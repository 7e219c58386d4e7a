"""Ratings, rigidities and the numbers of an elastic nut are formulas: recorded, they give what plain numbers give."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.sizing.installation import Ends, Installation
from ballscrew.physics.sizing.ratings import RatedGeometry, ratings_of
from ballscrew.physics.sizing.rigidity import rigidity_iso3408, usual_nut_outer_diameter
from ballscrew.physics.solvers.load_distribution import elastic_nut_numbers

ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
#: Inputs of a configuration that the numbers of a nut depend on.
OF_NUT = (
    "pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls", "contact_angle", "screw_conformity",
    "nut_conformity",
)  # fmt: skip
POINTS = 40


def recorded(function, names, points):
    """The numbers of a function of named inputs, recorded and run at points of each."""
    tape = Tape(len(names), nonnegative=[True] * len(names))
    program = Program.of(tape, function({name: tape.value(i) for i, name in enumerate(names)}))
    found = {name: np.empty(POINTS) for name in (*program.outputs, *program.constants)}
    with np.errstate(all="ignore"):
        program.interpreter.run([points[name] for name in names], found)
    return found


def compare(function, points):
    names = list(points)
    found = recorded(function, names, points)
    for place in range(POINTS):
        plain = function({name: float(points[name][place]) for name in names})
        assert plain.keys() == found.keys()
        for name, value in plain.items():
            assert found[name][place] == pytest.approx(value, rel=1e-12, nan_ok=True), name


def around(usual, seed):
    """Random values of inputs, each up to a twentieth about its usual one."""
    rng = np.random.default_rng(seed)
    found = {name: value * rng.uniform(0.95, 1.05, POINTS) for name, value in usual.items()}
    return {name: np.round(values) if name == "loaded_balls" else values for name, values in found.items()}


def usual(names):
    part = ROW.screw()
    return {name: float(getattr(part, name)) for name in names}


@pytest.mark.slow
@pytest.mark.implausible
@pytest.mark.parametrize("swelling", [True, False])
@pytest.mark.parametrize("same_side", [True, False])
@pytest.mark.parametrize("nut_outer_diameter", [None, 0.070])
def test_numbers_of_an_elastic_nut(swelling, same_side, nut_outer_diameter):
    bodies = Bodies(same_side=same_side, swelling=swelling, nut_outer_diameter=nut_outer_diameter)
    nut = bs.DoubleNut(preload=1000.0, spacing=0.03, bodies=bodies)
    subject = Configuration(bs.FrictionModel.reference(), ROW.screw(nut=nut), bs.Lubricant(0.1, 2e-8))

    def numbers(values):
        screw = subject.changed(values).screw
        return elastic_nut_numbers(screw, screw.nut, screw.nut.bodies)._asdict()

    compare(numbers, around(usual(OF_NUT) | {"nut.spacing": 0.03}, seed=1))


@pytest.mark.implausible
def test_an_outer_diameter_that_is_recorded_is_not_judged():
    """A wall is looked for where its size is known; a recording has only its formula, and numbers are refused."""
    tape = Tape(1)
    assert Bodies(nut_outer_diameter=tape.value(0)).sized(ROW.screw()).nut_outer_diameter is not None
    with pytest.raises(bs.InputError, match="leaves no wall"):
        Bodies(nut_outer_diameter=0.03, nut_inner_diameter=0.02).sized(ROW.screw())
    with pytest.raises(bs.InputError, match="must exceed the inner diameter"):
        Bodies(nut_outer_diameter=np.array([0.06, 0.03]), nut_inner_diameter=0.04)


@pytest.mark.parametrize("spacer_balls", [True, False])
def test_ratings_of_a_geometry(spacer_balls):
    names = ("ball_circle", "ball_diameter", "contact_angle", "lead_angle", "balls_per_turn", "loaded_turns")

    def ratings(values):
        return ratings_of(RatedGeometry(**values, spacer_balls=spacer_balls))._asdict()

    compare(ratings, around({name: float(getattr(ROW, name)) for name in names}, seed=2))
    assert type(ratings_of(ROW).dynamic) is float


@pytest.mark.slow
@pytest.mark.implausible
@pytest.mark.parametrize("ends", [Ends.FIXED_FIXED, Ends.FIXED_FREE])
@pytest.mark.parametrize("preload", [None, 900.0])
@pytest.mark.parametrize("outer", [None, 0.063])
def test_rigidities(ends, preload, outer):
    """With loads and preloads of nothing among them, of which one leaves a nut without rigidity."""
    names = tuple(field.name for field in dataclasses.fields(bs.AxialRigidity))[:8]
    given = usual(OF_NUT) | {"axial_load": 3000.0, "l": 1.2, "R_b": 8e8, "f_a": 0.55}
    points = around(
        given | ({} if preload is None else {"preload": preload}) | ({} if outer is None else {"outer": outer}), 3
    )
    points["axial_load"][:3] = 0.0
    if preload is not None:
        points["preload"][2:6] = 0.0

    def rigidities(values):
        nut = bs.SingleNut() if preload is None else bs.DoubleNut(preload=values["preload"])
        screw = dataclasses.replace(ROW.screw(nut=nut), **{name: values[name] for name in OF_NUT})
        mounted = Installation(unsupported_length=values["l"], ends=ends, bearing_rigidity=values["R_b"])
        found = rigidity_iso3408(
            screw,
            axial_load=values["axial_load"],
            installation=mounted,
            accuracy_factor=values["f_a"],
            nut_outer_diameter=values.get("outer"),
        )
        return {name: getattr(found, name) for name in names}

    compare(rigidities, points)


def test_the_usual_width_is_a_line_between_the_sizes():
    """The sizes of DIN 69051-5 as printed, the middle of two, and their walls beyond the ends."""
    sizes, fine = [0.016, 0.020, 0.063, 0.080], [0.028, 0.036, 0.090, 0.105]
    assert [usual_nut_outer_diameter(size, 0.005) for size in sizes] == pytest.approx(fine, rel=1e-14)
    assert usual_nut_outer_diameter(0.080, 0.020) == pytest.approx(0.125, rel=1e-14)
    assert usual_nut_outer_diameter(0.018, 0.005) == pytest.approx((0.028 + 0.036) / 2, rel=1e-14)
    assert usual_nut_outer_diameter(0.010, 0.005) == pytest.approx(0.010 + 0.012, rel=1e-14)
    assert usual_nut_outer_diameter(0.100, 0.040) == pytest.approx(0.100 + 0.045, rel=1e-14)
