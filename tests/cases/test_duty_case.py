"""Axis, motion and motor in case files: what they may say, what is refused, and that other commands stay the same."""

import math
import tomllib

import pytest

from ballscrew.axis.duty_cycle.axis import Motor
from ballscrew.axis.motion.profiles import SCurve, Segments, Sine, Trapezoid
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.descriptions import inputs
from ballscrew.cases.schema import case_schema
from ballscrew.physics.solvers import load_distribution
from ballscrew.questions.duty.compute import duty
from support.commands import ROOT
from support.own_screws import WITH_OIL as SCREW

MOVING = """
[axis]
mass = "400 kg"
[motion]
kind = "trapezoid"
stroke = "0.5 m"
speed = "30 m/min"
acceleration = "0.5 g"
"""
POINT = '[operation]\naxial_load = "4 kN"\nscrew_speed = "600 rpm"\n'


def built(text, *settings, moves=True, model=None):
    return case_file.build(case_file.override(tomllib.loads(text), settings), model, moves=moves)


def motion(text):
    return SCREW + MOVING.partition("[motion]")[0] + "[motion]\n" + text


def faults(text, *settings, moves=True, model=None):
    with pytest.raises(InputError) as refused:
        built(text, *settings, moves=moves, model=model)
    return str(refused.value)


@pytest.mark.slow
def test_the_loads_of_the_balls_are_solved_once_for_a_cycle(monkeypatch):
    """Speeds, oils and the fall under the weight alone do not change them: what a duty costs is its friction."""
    solved, calls = load_distribution.solved, []
    monkeypatch.setattr(load_distribution, "solved", lambda *given: calls.append(given) or solved(*given))
    tables = tomllib.loads((ROOT / "examples" / "vertical_axis.toml").read_text(encoding="utf-8"))
    case = case_file.build({**tables, "bodies": {}}, moves=True)
    assert case.screw.nut.one_by_one
    found = duty(case)
    assert len(calls) == 1
    alike = duty(case, recorded=True)
    assert dict(alike.numbers) == pytest.approx(dict(found.numbers), rel=1e-9)
    assert alike.brake.holding_torque == pytest.approx(found.brake.holding_torque, rel=1e-9)


def test_units_become_si():
    case = built(SCREW + MOVING, 'axis.inclination="90 deg"', 'motion.dwell="1 min"', "motion.return=false")
    assert case.axis.mass == 400
    assert case.axis.inclination == pytest.approx(math.pi / 2, rel=1e-15)
    assert case.motion == Trapezoid(stroke=0.5, speed=0.5, acceleration=0.5 * 9.80665, dwell=60.0, returns=False)


@pytest.mark.parametrize(
    ("written", "made"),
    [
        ('kind = "s-curve"\nstroke = "0.5 m"\nspeed = "0.5 m/s"\nacceleration = "5 m/s^2"\njerk = "100 m/s^3"',
         SCurve(stroke=0.5, speed=0.5, acceleration=5.0, jerk=100.0)),
        ('kind = "sine"\nstroke = "20 mm"\nfrequency = "2 Hz"\nforce = "1 kN"',
         Sine(stroke=0.02, frequency=2.0, force=1000.0)),
    ],
)  # fmt: skip
def test_kinds_of_motion(written, made):
    assert built(motion(written)).motion == made


def test_segments_have_their_own_units_and_names():
    text = 'kind = "segments"\nacceleration = "2 m/s^2"\n[[motion.segment]]\nname = "press"\nduration = "5 s"\n'
    text += 'speed = "200 mm/min"\nforce = "2 kN"\ntemperature = "50 degC"\n[[motion.segment]]\n'
    text += 'distance = "-10 mm"\nspeed = "1 m/min"'
    case = built(motion(text))
    assert isinstance(case.motion, Segments)
    press, back = case.motion.segments
    assert (press.name, press.duration, press.speed, press.force) == ("press", 5.0, pytest.approx(0.2 / 60), 2000.0)
    assert press.temperature == pytest.approx(323.15)
    assert back.distance == pytest.approx(-0.01)
    again = inputs(case)["motion"]
    assert again["segment"][0]["name"] == "press"
    assert again["kind"] == "segments"


def test_a_counterweight_is_a_mass_or_a_force():
    assert built(SCREW + MOVING, 'axis.counterweight="100 kg"').axis.counterweight == 100
    gas = built(SCREW + MOVING, 'axis.counterweight="1.5 kN"').axis
    assert (gas.counterweight, gas.counterforce) == (0.0, 1500.0)


def test_a_motor_has_its_curve():
    settings = ['motor.rated_torque="7 N m"', 'motor.peak_torque="20 N m"', 'motor.largest_speed="3000 rpm"']
    curve = 'motor.curve=[["0 rpm", "20 N m"], ["3000 rpm", "10 N m"]]'
    motor = built(SCREW + MOVING, *settings, curve).motor
    fastest = 3000 * math.pi / 30
    assert motor == Motor(
        rated_torque=7.0,
        peak_torque=20.0,
        largest_speed=motor.largest_speed,
        curve=((0.0, 20.0), (motor.largest_speed, 10.0)),
    )
    assert motor.largest_speed == pytest.approx(fastest, rel=1e-14)
    with pytest.raises(InputError, match=r"ends below the largest speed \(2500 rpm\)"):
        built(SCREW + MOVING, *settings, curve.replace('"3000', '"2500'))


def test_without_an_operating_point_it_has_that_of_steady_travel():
    case = built(SCREW + MOVING, 'axis.inclination="90 deg"')
    assert case.operation.axial_load == pytest.approx(400 * 9.80665)
    assert case.operation.screw_speed == pytest.approx(2 * math.pi * 0.5 / 0.01)
    assert "operation" not in inputs(case)


def test_a_case_of_other_commands_may_have_a_motion():
    plain, moving = (built(SCREW + POINT + more, moves=False) for more in ("", MOVING))
    assert plain.axis is None
    assert moving.operation == plain.operation
    assert moving.axis.mass == 400
    assert {k: v for k, v in inputs(moving).items() if k not in ("axis", "motion")} == inputs(plain)


def test_the_example_of_an_efficiency_can_be_written():
    """No screw gives more work than it takes."""
    (example,) = case_schema.json_schema()["$defs"]["Model"]["properties"]["efficiency"]["examples"]
    case = built(SCREW + MOVING, "model.name=constant-efficiency", f"model.efficiency={example}")
    assert 0 < case.efficiency <= 1


def test_one_efficiency_needs_no_oil():
    text = SCREW.partition("[lubricant]")[0] + MOVING
    case = built(text, "model.name=constant-efficiency", "model.efficiency=0.9")
    assert case.efficiency == 0.9
    assert inputs(case)["model"] == {"name": "constant-efficiency", "efficiency": 0.9}
    assert "lubricant: missing section" in faults(text)
    assert (
        built(SCREW + MOVING, "model.name=constant-efficiency", "model.efficiency=0.9", model="corrected").efficiency
        is None
    )


@pytest.mark.parametrize(
    ("settings", "line"),
    [
        (["motion.kind=trapez"], 'motion.kind: unknown kind of motion (trapez) · did you mean "trapezoid"?'),
        (['motion.jerk="5 m/s^3"'], 'motion.jerk: a motion of kind "trapezoid" has none (\'5 m/s^3\') · '
                                    'leave it out, or write kind = "s-curve" or "segments"'),
        (["motion.kind=s-curve"], 'motion.jerk: missing · add jerk = "… m/s^3"'),
        (['motion.speed="-1 m/s"'], "motion.speed: must be positive (-1 m/s) · rapid feeds have 10 m/min to 120 m/min"),
        (["motion.stroke=0.5"], 'motion.stroke: needs a unit (0.5) · write "0.5 mm"'),
        (["motion.dwel=0.5"], 'motion.dwel: unknown key · did you mean "dwell"?'),
        (['axis.mass="400 N"'], "axis.mass: wrong unit (400 N) · use a unit such as kg, lb or g"),
        (['axis.inclination="120 deg"'], "axis.inclination: must be at most 90 deg (120 deg) · "
                                        "0 deg for a horizontal axis, 90 deg for a vertical one"),
        (['axis.counterweight="5 N"', 'axis.counterforce="5 N"'],
         "axis.counterweight: is a force beside the counterforce (5 N) · give one of them"),
        (["model.efficiency=0.9"],
         'model.efficiency: a model computes it (0.9) · leave it out, or write name = "constant-efficiency"'),
        (["model.name=constant-efficiency"], "model.efficiency: missing · add efficiency = 0.9"),
        (["model.name=constant-efficiency", "model.efficiency=90"],
         "model.efficiency: must be at most 1 (90) · catalogues have 0.9"),
        (["model.name=constant-efficiency", "model.efficiency=0.9", "model.rolling=houpert"],
         "model.rolling: does not count with \"constant-efficiency\" ('houpert') · leave it out"),
        (['motor.rated_torque="7 N m"', 'motor.peak_torque="5 N m"', 'motor.largest_speed="1 rpm"'],
         "motor.peak_torque: is below the rated torque (5 N m) · give the peak of the sheet"),
        (['motor.rated_torque="7 N m"', 'motor.peak_torque="9 N m"', 'motor.largest_speed="1 rpm"',
          "motor.curve=[[1, 2, 3]]"],
         "motor.curve point 1: is not a speed and a torque ([1, 2, 3]) · "
         'write curve = [["0 rpm", "7 N m"], ["3000 rpm", "5 N m"]]'),
        (["motion.segment=4", "motion.kind=segments"], "motion.segment: must be a list (4) · write [[motion.segment]]"),
    ],
    ids=lambda value: value[0] if isinstance(value, list) else "",
)  # fmt: skip
def test_faults_name_field_value_and_remedy(settings, line):
    assert line in faults(SCREW + MOVING, *settings).splitlines()


def test_faults_of_segments_name_their_number():
    text = 'kind = "segments"\n[[motion.segment]]\nduration = "1 s"\n[[motion.segment]]\nduration = "1 s"\ndist = 3\n'
    assert 'motion.segment 2.dist: unknown key · did you mean "distance"?' in faults(motion(text))
    moves = 'kind = "segments"\n[[motion.segment]]\ndistance = "1 m"\n'
    assert "motion.segment 1.speed: missing · a move needs a speed" in faults(motion(moves))
    needs = "motion.segment 1.acceleration: missing · a move needs one, its own or that of the motion"
    assert needs in faults(motion(moves + 'speed = "1 m/s"\n'))


def test_other_commands_ask_for_an_operating_point_and_a_model():
    refused = faults(SCREW + MOVING, moves=False)
    assert refused == (
        "operation: missing section · add a table [operation]; "
        "only ballscrew duty and warm-up take the motion in its place"
    )
    refused = faults(SCREW + POINT, "model.name=constant-efficiency", "model.efficiency=0.9", moves=False)
    assert refused.startswith(
        "model.name: is a rule, which only ballscrew duty takes (constant-efficiency) · take a model"
    )
    refused = faults(SCREW + POINT)
    assert refused.splitlines() == [f"{name}: missing section · add a table [{name}]" for name in ("axis", "motion")]


def test_the_schema_knows_the_example_and_no_other_keys():
    jsonschema_rs = pytest.importorskip(
        "jsonschema_rs", reason="jsonschema_rs is not among the oldest packages that are tested"
    )
    tables = tomllib.loads((ROOT / "examples" / "vertical_axis.toml").read_text(encoding="utf-8"))
    known = case_schema.json_schema()
    jsonschema_rs.validate(known, tables)
    for table, key in (("axis", "mas"), ("motion", "dwel"), ("motor", "peak")):
        assert not jsonschema_rs.is_valid(known, {**tables, table: {**tables[table], key: "1 kg"}})
    without = {name: part for name, part in tables.items() if name != "operation"}
    jsonschema_rs.validate(known, without)
    assert not jsonschema_rs.is_valid(known, {name: part for name, part in without.items() if name != "motion"})
