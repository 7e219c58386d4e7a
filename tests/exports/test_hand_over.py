"""The frame of exports: targets, requests, ranges, files."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.exports import export, hand_over
from ballscrew.exports.export import TARGETS, Export, target, worst_errors
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.questions.hand_over.answer import _written

OIL = bs.Lubricant.from_grade("ISO VG 100", temperature=313.15)
LOAD = fields_of(OperatingState)["axial_load"]


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.corrected(), bs.DoubleNut(preload=900.0))


def test_every_target_has_a_module():
    assert all(callable(target(name).export) for name in TARGETS)


def test_an_unknown_target_is_refused_with_the_list(ballscrew, example, tmp_path):
    done = ballscrew("hand-over", example, "--to", "fortran", "-o", tmp_path / "out")
    assert done.returncode == 2
    assert done.stderr.startswith("hand_over.to: unknown target (fortran)")
    assert all(name in done.stderr for name in TARGETS)
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("name", "taker"), [("simulink", "matlab"), ("Octave", "matlab"), ("dymola", "modelica"), ("csv", "table")]
)
def test_a_program_named_for_a_target_is_answered_with_the_target(name, taker):
    with pytest.raises(InputError, match=rf'unknown target \({name}\) · write "{taker}", whose files {name} takes'):
        target(name)


def test_every_program_is_named_with_a_target():
    assert {*export._TAKEN_BY.values()} <= {*TARGETS}
    assert not {*export._TAKEN_BY} & {*TARGETS}


def test_the_recorded_model_is_the_model(handed):
    points = handed.sample(50)
    found = handed.evaluate(points)
    screw = handed.subject.screw
    for i in (0, 3, 10, 20, 30, 40):
        oil = bs.Lubricant.from_grade("ISO VG 100", temperature=points["temperature"][i])
        here = bs.BallScrew(**{**vars_of(screw), "nut": bs.DoubleNut(preload=points["preload"][i])})
        wanted = handed.subject.model(
            here, oil, axial_load=points["axial_load"][i], screw_speed=points["screw_speed"][i]
        )
        for name in ("screw_torque", "drive_torque", "holding_torque", "friction_power", "valid"):
            assert found[name][i] == pytest.approx(float(getattr(wanted, name)), rel=1e-11, abs=1e-14)


def vars_of(part):
    return {name: getattr(part, name) for name in part.__dataclass_fields__}


def test_beyond_the_bounds_the_nearest_value_counts_and_is_not_valid(handed):
    greatest = handed.formula_range["temperature"][1]
    state = {"axial_load": 1000.0, "screw_speed": 50.0}
    beyond, at = (handed.evaluate({**state, "temperature": value}) for value in (greatest + 50.0, greatest))
    assert beyond["screw_torque"] == at["screw_torque"]
    assert at["valid"]
    assert not beyond["valid"]


def test_ranges_that_nobody_gave(handed):
    """As the documentation of ``hand_over`` has them; the largest load is the one at which the first contact yields."""
    subject = handed.subject
    ranges = {
        one.name: one.range
        for one in hand_over.export_job(
            subject.model, subject.screw, subject.lubricant, "c", parameters=["friction.boundary_friction_coefficient"]
        ).inputs
    }
    coefficient = subject.model.friction.boundary_friction_coefficient
    assert ranges["screw_speed"] == (-300.0, 300.0)
    assert ranges["temperature"] == pytest.approx((283.15, 353.15))
    assert ranges["preload"] == pytest.approx((0.5 * subject.nut.preload, 1.5 * subject.nut.preload))
    assert ranges["friction.boundary_friction_coefficient"] == pytest.approx((0.5 * coefficient, 1.5 * coefficient))
    least, greatest = ranges["axial_load"]
    assert least == -greatest

    def pressure(load):
        return float(
            subject.model(subject.screw, subject.lubricant, axial_load=load, screw_speed=10.0).maximum_pressure
        )

    assert pressure(greatest) <= 4.2e9 < pressure(1.2 * greatest)  # looked for in steps of 8 %, given to two digits


def test_points_are_in_all_quadrants_and_at_rest(handed):
    points = handed.sample()
    load, speed = np.sign(points["axial_load"]), np.sign(points["screw_speed"])
    assert {(a, b) for a, b in zip(load, speed, strict=True)} >= {(1, 1), (1, -1), (-1, 1), (-1, -1), (1, 0), (0, 1)}


def test_the_worst_error_is_that_of_the_worst_point(handed):
    def off(points):
        found = handed.evaluate(points)
        found["drive_torque"] = found["drive_torque"] + np.where(points["axial_load"] > 0.0, 0.25, 0.125)
        return found

    errors = {one.output: one for one in worst_errors(handed, off)}
    assert errors["drive_torque"].value == pytest.approx(0.25, rel=1e-9)
    assert errors["drive_torque"].at["axial_load"] > 0
    assert errors["screw_torque"].value == errors["valid"].value == 0.0


@pytest.mark.parametrize(
    ("change", "expected"),
    [
        ({"parameters": ["friction.boundry"]}, "hand_over.parameters: unknown input"),
        ({"outputs": ["torque_of_screw"]}, "hand_over.outputs: unknown output"),
        ({"derivatives": ["lead"]}, "hand_over.derivatives: is no input (lead)"),
        ({"ranges": {"axial_load": (5.0, 1.0)}}, "hand_over.ranges.axial_load: must be the least and the greatest"),
        ({"ranges": {"axial_load": (5.0, 5.0)}}, "hand_over.ranges.axial_load: must be the least and the greatest"),
        (
            {"ranges": {"axial_load": (0.0, 1.0, 2.0)}},
            "hand_over.ranges.axial_load: must be the least and the greatest",
        ),
        ({"ranges": {"axial_load": (0.0, np.inf)}}, "hand_over.ranges.axial_load: must be the least and the greatest"),
        ({"ranges": {"temperature": (1.0, 300.0)}}, "hand_over.ranges.temperature: is beyond the bounds"),
        ({"digits": 4}, "hand_over.digits: unknown option"),
    ],
)
def test_faults_name_field_and_remedy(handed, change, expected):
    subject = handed.subject
    with pytest.raises(bs.InputError) as fault:
        bs.hand_over(subject.model, subject.screw, subject.lubricant, to="c", **change)
    assert str(fault.value).startswith(expected)


@pytest.mark.parametrize(
    ("to", "option", "value"),
    [
        ("beckhoff", "units_per_newton_metre", np.inf),
        ("drive", "ratio", np.inf),
        ("linuxcnc", "torque_unit", np.nan),
        ("urdf", "inertia", np.nan),
        ("urdf", "load", -np.inf),
    ],
)
def test_options_are_finite(handed, to, option, value):
    subject = handed.subject
    with pytest.raises(bs.InputError, match=rf"hand_over\.{option}: must be a finite number"):
        bs.hand_over(subject.model, subject.screw, subject.lubricant, to=to, **{option: value})


def test_a_law_that_cannot_be_recorded_is_refused_with_a_remedy(handed):
    def of_a_table(conditions):
        return np.interp(conditions.film_parameter, [0.0, 1.0, 3.0], [0.12, 0.06, 0.01])

    model = dataclasses.replace(handed.subject.model, friction=of_a_table)
    with pytest.raises(bs.InputError, match=r"hand_over\.to: needs a model that can be recorded.*--to table"):
        bs.hand_over(model, handed.subject.screw, OIL, to="c")


def test_nothing_is_written_where_a_place_is_taken(tmp_path):
    (tmp_path / "b").mkdir()
    export = Export(target="c", files={"a": b"1", "b": b"2"}, valid_range={}, worst_error=())
    with pytest.raises(bs.InputError, match="--out: cannot be written"):
        export.write(tmp_path)
    assert not (tmp_path / "a").exists()


def test_ranges_and_options_are_read_as_people_write_them(example):
    case = case_file.load(example)
    asked = hand_over.Request(
        ranges=['axial_load="-5:4 kN"', 'temperature="10:50 degC"'], options=["version=3"], outputs=["efficiency"]
    )
    export = hand_over.of_case(case, "fmu", asked)
    assert export.valid_range["axial_load"] == (-5000.0, 4000.0)
    assert export.provenance["references"][0] == "Olaru2005"
    assert export.valid_range["temperature"] == pytest.approx((283.15, 323.15))
    assert "hand_over.temperature" in [record.id for record in export.warnings]  # the oil of this case is its numbers


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ({"ranges": ["axial_load=5 kN"]}, "--range axial_load: is no range"),
        ({"ranges": ["axial_load=-5:x kN"]}, "--range axial_load: "),
        ({"ranges": ["load=-5:5 kN"]}, "--range load: unknown input"),
        ({"options": ["version"]}, "--option: needs a name and a value"),
        ({"options": ["version=two"]}, "--option version: must be a number"),
        ({"options": ["digits=2"]}, "--option digits: unknown option"),
    ],
)
def test_faults_of_text_name_the_option(example, asked, expected):
    with pytest.raises(bs.InputError) as fault:
        hand_over.of_case(case_file.load(example), "fmu", hand_over.Request(**asked))
    assert str(fault.value).startswith(expected)


def test_the_largest_relative_error_has_a_place_of_its_own(handed):
    """A tenth of the least torque is a smaller error than a hundredth of the largest, and a larger one in relation."""

    def off(points):
        found = dict(handed.evaluate(points))
        size = np.abs(found["screw_torque"])
        least = np.argmin(np.where(size > 0, size, np.inf))
        found["screw_torque"] = found["screw_torque"] * (1 + 0.001)
        found["screw_torque"][least] *= 1.01
        return found

    points = handed.sample()
    true = np.abs(handed.evaluate(points)["screw_torque"])
    least = int(np.argmin(np.where(true > 0, true, np.inf)))
    (error,) = worst_errors(handed, off, points=points, outputs=["screw_torque"])
    assert true[least] * 0.012 < 0.001 * true.max()
    assert (error.value, error.largest) == pytest.approx((0.001 * true.max(), true.max()), rel=1e-6)
    assert error.relative == pytest.approx(1.001 * 1.01 - 1, rel=1e-6)
    assert error.of_largest == pytest.approx(0.001, rel=1e-6)
    assert error.at["axial_load"] == points["axial_load"][int(np.argmax(true))]
    assert error.relative_at["axial_load"] == points["axial_load"][least]


def test_an_export_without_a_number_where_the_model_has_one_is_infinitely_off(handed):
    def broken(points):
        found = dict(handed.evaluate(points))
        found["screw_torque"] = np.where(
            points["axial_load"] == points["axial_load"].max(), np.nan, found["screw_torque"]
        )
        return found

    points = handed.sample()
    (error,) = worst_errors(handed, broken, points=points, outputs=["screw_torque"])
    assert error.value == error.relative == math.inf
    assert error.at["axial_load"] == points["axial_load"].max()


def test_where_the_model_has_no_number_nothing_is_compared(handed):
    points = handed.sample()
    true = dict(handed.evaluate(points))
    true["screw_torque"] = np.full_like(true["screw_torque"], np.nan)
    (error,) = worst_errors(handed, handed.evaluate, points=points, exact=true, outputs=["screw_torque"])
    assert (error.value, error.relative, error.largest) == (0.0, 0.0, 0.0)


@pytest.mark.parametrize(
    ("default", "quantity", "written"),
    [(True, None, "yes"), (False, None, "no"), (math.nan, None, ""), (5, None, "5"), (0.5, LOAD, "0.5 N")],
)
def test_the_usual_value_of_a_choice_as_it_is_written(default, quantity, written):
    option = SimpleNamespace(default=default, quantity=quantity)
    assert _written(option) == written
