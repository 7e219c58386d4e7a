"""Verdicts, warnings and checks are formulas: on a tape, on arrays and on numbers they say the same, and one thing."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.records import utilisation
from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.emission import kernel_text
from ballscrew.compiler.kernels.kernel import aligned_array
from ballscrew.compiler.tracing.program import Program
from ballscrew.compiler.tracing.tape import Tape
from ballscrew.engine.evaluation.outputs import known_outputs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.physics.sizing.checks import checks, loads_at_point
from ballscrew.physics.sizing.installation import Ends, Installation, Limits
from ballscrew.physics.sizing.judged import JUDGED, judged, outputs

POINTS = 500
TRUTHS = {name for row in JUDGED for name in row.truths}
#: Names of all values; how many checks there are is no value but counted.
NEEDS = [
    name
    for name in dict.fromkeys(name for row in JUDGED for name in (*row.needs, *row.takes))
    if not name.startswith("checks.")
]
BY_ID = {row.id: row for row in JUDGED}
#: Values that may have either sign, and that are often zero or no number.
SIGNED = (
    "axial_load", "screw_speed", "drive_torque", "holding_torque", "at_rest.holding_torque", "nut_torque",
    "remaining_preload", "power_imbalance",
)  # fmt: skip
#: Sizes about which positive values scatter.
SIZES = {"young_modulus": 2e11, "maximum_pressure": 4e9, "limits.shaft_stress": 1.5e8, "shaft_density": 7850.0} | {
    name: size
    for size, names in {
        5e3: (
            "axial_load",
            "half_load",
            "other_half_load",
            "largest_load",
            "largest_half_load",
            "preload",
            "remaining_preload",
            "lift_off_load",
        ),
        3e4: ("dynamic_load_rating", "static_load_rating"),
        0.03: ("root_diameter", "pitch_circle_diameter", "power_imbalance"),
        1e7: ("limits.running_time",),
        60.0: ("screw_speed",),
        4.0: ("buckling_root", "whirling_root", "limits.static_safety", "limits.buckling_safety"),
    }.items()
    for name in names
}


def random_values(seed=0):
    """Values of all names: powers of ten about their sizes, of both signs where they may be, zeros, and no numbers."""
    rng = np.random.default_rng(seed)
    found = {}
    for name in NEEDS:
        if name in TRUTHS:
            found[name] = rng.uniform(size=POINTS) < 0.7
            continue
        values = SIZES.get(name, 1.0) * 10 ** rng.uniform(-1, 1, POINTS)
        if name in SIGNED:
            values *= rng.choice([-1.0, 1.0], POINTS)
        drawn = rng.uniform(size=POINTS)
        values = np.where(drawn < 0.1, 0.0, values)
        found[name] = np.where(drawn > 0.95, np.nan, values)
    return found


def at(values, place):
    return {name: column[place] for name, column in values.items()}


def run(tape, made, inputs):
    """Outputs of a recording at points of its inputs, and which of them are masks."""
    program = Program.of(tape, made)
    masks = {name for name, step in program.outputs.items() if tape.is_mask(step)}
    names, points = (*program.outputs, *program.constants), len(inputs[0])
    found = {name: np.empty(points, dtype=bool if name in masks else float) for name in names}
    with np.errstate(all="ignore"):
        program.interpreter.run(inputs, found)
    return found, masks


def recorded():
    """All that is judged, recorded with every value an input; a truth value is a number that is not zero."""
    tape = Tape(len(NEEDS))
    traced = {name: tape.value(place) for place, name in enumerate(NEEDS)}
    traced |= {name: traced[name] != 0 for name in TRUTHS}
    return tape, outputs(judged(traced))


def columns(values):
    """The values as inputs of the recording."""
    return [np.ascontiguousarray(values[name], dtype=float) for name in NEEDS]


def test_recorded_as_on_numbers():
    """At random points, zeros of load and speed, all quadrants and missing numbers among them."""
    values = random_values()
    found, masks = run(*recorded(), columns(values))
    held = dict.fromkeys(masks, 0)
    for place in range(POINTS):
        plain = outputs(judged(at(values, place)))
        assert plain.keys() == found.keys()
        for name, value in plain.items():
            if name in masks:
                assert bool(found[name][place]) is bool(value), (name, at(values, place))
                held[name] += bool(value)
            else:
                assert found[name][place] == pytest.approx(float(value), rel=1e-12, nan_ok=True), name
    # each mask holds at some points and not at others: nothing above is true for want of points
    assert {name for name, count in held.items() if not 0 < count < POINTS} == set()


@pytest.mark.compiles
def test_compiled_as_interpreted():
    """All outputs as numbers, one for a mask that holds: as a program without truth values takes them."""
    values = random_values(5)
    tape, made = recorded()
    expected, masks = run(tape, made, columns(values))
    program = Program.of(tape, made)
    sources = ["points"] * len(NEEDS)
    compiled = kernel.Kernel.of(kernel_text(program, sources, dict.fromkeys(program.outputs, False)), sources)
    results = [aligned_array(POINTS, float) for _ in program.outputs]
    compiled(slice(0, 1), slice(0, POINTS), POINTS, columns(values), results)
    for name, found in zip(program.outputs, results, strict=True):
        if name in masks:
            assert np.array_equal(found, expected[name].astype(float)), name
        else:
            assert found == pytest.approx(expected[name], rel=1e-12, nan_ok=True), name


def test_arrays_as_numbers():
    values = random_values(1)
    found = outputs(judged(values))
    for place in range(0, POINTS, 7):
        for name, value in outputs(judged(at(values, place))).items():
            one = np.broadcast_to(found[name], (POINTS,))[place]
            assert one == value or (one != one and value != value) or one == pytest.approx(value, rel=1e-14), name


def test_each_row_gives_what_it_names():
    """Masks and numbers of the documents are those of the formulas; sentences ask for no other ones."""
    found = judged(at(random_values(), 3))
    for row in JUDGED:
        document = row.document()
        of_row = found[row.id]
        assert {*document["masks"], *document["numbers"]} == of_row.keys()
        assert {name for name, value in of_row.items() if isinstance(value, np.bool_ | bool)} == {*document["masks"]}
        assert named(document["sentences"]) <= of_row.keys()


def named(sentences):
    """The names of masks and numbers in sentences."""
    found = set()
    for sentence in sentences:
        found |= {sentence["said"]} - {None}
        for place in sentence["places"].values():
            found |= {place["number"]} if "number" in place else set()
            found |= named(place.get("sentences", ()))
    return found


def test_without_what_a_row_needs_it_is_left_out():
    values = at(random_values(), 0)
    for row in JUDGED:
        for name in row.needs:
            assert row.finds({**values, name: None}) is None
    assert judged({}) == {}


def test_at_most_one_thing_is_said_of_a_load():
    """At rest and in motion one of: it drives, it is held; none without load, nor where its torque is no number."""
    values = random_values(2)
    found = {name: one["said"] for name, one in judged(values).items() if "said" in one}
    load, speed = values["axial_load"], values["screw_speed"]
    motion = sum(found[f"verdict.{name}"].astype(int) for name in ("back_driving", "held_in_motion", "self_locking"))
    at_rest = sum(found[f"verdict.{name}.at_rest"].astype(int) for name in ("back_driving", "self_locking"))
    there = (load != 0) & (speed != 0) & np.isfinite(values["holding_torque"])
    assert np.array_equal(motion == 1, there)
    assert np.array_equal(at_rest == 1, (load != 0) & np.isfinite(values["at_rest.holding_torque"]))
    assert max(motion.max(), at_rest.max()) == 1
    assert not (found["verdict.skid"] & found["verdict.skid.at_rest"]).any()
    for name in ("verdict.quadrant", "verdict.skid", "verdict.skid.at_rest"):
        assert not (found["verdict.no_load"] & found[name]).any()


def test_the_quadrant_by_its_signs():
    """Power flows in where torque and speed have one sign: an independent reading of what the sentences say."""
    values = {"axial_load": -5.0, "screw_speed": 3.0}
    for torque, words in (
        (-1.0, "is back-driven forward: the load moves the way the screw turns; 1 N m on the shaft hold it back"),
        (
            2.0,
            "is back-driven forward: the load moves the way the screw turns, and does not suffice; "
            "2 N m on the shaft drive it",
        ),
    ):
        row = BY_ID["verdict.quadrant"]
        found = row.finds({**values, "drive_torque": torque})
        assert row.text(found, {}) == words
    assert not row.finds({**values, "drive_torque": math.nan})["said"]
    assert not row.finds({"axial_load": 5.0, "screw_speed": 3.0, "drive_torque": 1.0})["said"]


def test_utilisation_of_nothing():
    demand, capacity = np.array([0.0, 1.0, 0.0, 3.0, math.inf]), np.array([0.0, 0.0, 2.0, 2.0, 2.0])
    assert utilisation(demand, capacity).tolist() == [0.0, math.inf, 0.0, 1.5, math.inf]


PRELOAD = 2000.0
MOUNTED = Installation(unsupported_length=1.2, ends=Ends.FIXED_SUPPORTED)
LIMITS = Limits(running_time=3.6e6, diameter_speed_product=7.0)
ROW = bs.catalogue()["rexroth-40x10x6-6-double"]
OUTPUTS = ("screw_torque", "flooded_torque", "drive_torque", "holding_torque", "valid", "maximum_pressure")


def values_at(subject, load, speed):
    """The values of the tables at an operating point of a model, as who shows them would put them together."""
    known = known_outputs(subject.screw.nut)
    here, at_rest = (subject.at({"axial_load": load, "screw_speed": one}) for one in (speed, 0.0 * speed))
    found = {name: known[name].read(here) for name in OUTPUTS}
    found |= {f"validity_{reason}": mask for reason, mask in here.validity.items()}
    found |= {f"at_rest.{name}": known[name].read(at_rest) for name in ("holding_torque", "valid")}
    left = 0.0
    if subject.screw.nut.halves == 2:
        of_loads = {name: known[name].read(here) for name in ("remaining_preload", "lift_off_load")}
        found |= of_loads | {"preload": PRELOAD}
        left = of_loads["remaining_preload"]
    else:
        found["rolling_share"] = here.rolling_share
    found |= {f"limits.{name}": getattr(LIMITS, name) for name in ("static_safety", "running_time", "shaft_stress")}
    return found | {
        **loads_at_point(load, left),
        "axial_load": load,
        "screw_speed": speed,
        "outside_validity": np.logical_not(found["valid"]),
        "root_diameter": 0.034,
        "dynamic_load_rating": ROW.dynamic_load_rating,
        "static_load_rating": ROW.static_load_rating,
    }


@pytest.mark.slow
@pytest.mark.parametrize("nut", [bs.SingleNut(), bs.DoubleNut(preload=PRELOAD)], ids=["row", "double"])
@pytest.mark.parametrize("model", [bs.FrictionModel.olaru2005(), bs.FrictionModel.reference()], ids=["paper", "usual"])
def test_verdicts_on_the_tape_of_a_model(model, nut):
    """Model, verdicts and checks on one tape, at an operating point and at rest, from no load to beyond lift-off."""
    subject = Configuration(model, ROW.screw(nut=nut), bs.Lubricant(0.1, 2e-8))
    rng = np.random.default_rng(4)
    load = np.array([0.0, *rng.choice([-1, 1], 39) * 10 ** rng.uniform(0, 4.5, 39)])
    speed = np.array([*rng.choice([-1, 0, 1], 40) * 10 ** rng.uniform(-1, 2.5, 40)])
    tape = Tape(2)
    found, masks = run(tape, outputs(judged(values_at(subject, tape.value(0), tape.value(1)))), [load, speed])
    for place in range(40):
        plain = outputs(judged(values_at(subject, load[place], speed[place])))
        assert plain.keys() == found.keys()
        for name, value in plain.items():
            one = found[name][place]
            if name in masks:
                assert bool(one) is bool(value), name
            else:
                assert one == pytest.approx(float(value), rel=1e-11, nan_ok=True), name
    for name in ("verdict.no_load", "verdict.quadrant", "verdict.back_driving.at_rest"):
        assert 0 < found[f"{name}:said"].sum() < 40, name
    if nut.halves == 2:
        assert 0 < found["verdict.preload_lost:said"].sum() < 40


def test_checks_of_a_screw_are_the_table_at_a_point():
    """What :func:`checks` puts together is what its table says of values given by name."""
    screw = ROW.screw()
    values = {
        **loads_at_point(5000.0, 0.0),
        "screw_speed": 100.0,
        "pitch_circle_diameter": screw.pitch_circle_diameter,
        "root_diameter": 0.034,
        "young_modulus": screw.screw_material.young_modulus,
        "dynamic_load_rating": 5e4,
        "static_load_rating": 1.5e5,
        "maximum_pressure": 2e9,
        "unsupported_length": MOUNTED.unsupported_length,
        "shaft_density": MOUNTED.shaft_density,
        "buckling_root": MOUNTED.ends.buckling_root,
        "whirling_root": MOUNTED.ends.whirling_root,
        **{f"limits.{name}": value for name, value in vars(LIMITS).items()},
    }
    made = checks(
        screw,
        axial_load=-5000.0,
        screw_speed=-100.0,
        dynamic_load_rating=5e4,
        static_load_rating=1.5e5,
        maximum_pressure=2e9,
        root_diameter=0.034,
        installation=MOUNTED,
        limits=LIMITS,
    )
    found = judged(values)
    assert len(made) == 8
    for check in made:
        row = found[f"check.{check.name}"]
        assert (check.value, check.limit, check.utilisation, check.holds) == (
            row["value"],
            row["limit"],
            row["utilisation"],
            row["holds"],
        )


def test_the_sign_of_a_speed_is_nothing_to_a_check():
    values = random_values(7)
    forward, backward = (judged(values | {"screw_speed": sign * values["screw_speed"]}) for sign in (1, -1))
    for name in (name for name in forward if name.startswith("check.")):
        for key, value in forward[name].items():
            assert np.array_equal(value, backward[name][key], equal_nan=np.asarray(value).dtype.kind == "f"), name
