"""What is said of a cycle: which way an axis goes with its motor off, what holds it, and what is strange."""

import dataclasses
import math

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.questions.duty.compute import duty
from ballscrew.questions.duty.sheet import title
from ballscrew.questions.duty.verdicts import verdicts, warnings

SCREW = """
[screw]
catalogue = "rexroth-40x10x6-6-double"
[nut]
type = "double"
preload = "1 kN"
[lubricant]
grade = "ISO VG 100"
"""
RULE = '[model]\nname = "constant-efficiency"\nefficiency = 0.9\n'
MOTION = '[motion]\nkind = "trapezoid"\nstroke = "0.3 m"\nspeed = "0.2 m/s"\nacceleration = "2 m/s^2"\ndwell = "1 s"\n'


@pytest.fixture
def report(tmp_path):
    def of(axis, model=RULE, motion=MOTION, more="", screw=SCREW):
        path = tmp_path / "case.toml"
        lines = "\n".join(f"{name} = {value!r}".replace("'", '"') for name, value in axis.items())
        path.write_text(f"{screw}{model}[axis]\n{lines}\n{motion}{more}", encoding="utf-8")
        return duty(case_file.load(path, [], moves=True))

    return of


def of_brake(report):
    return next(record for record in verdicts(report) if record.id == "verdict.brake")


@pytest.mark.parametrize(
    ("axis", "said"),
    [
        ({"mass": "100 kg", "inclination": "90 deg"}, "falls with"),
        ({"mass": "100 kg", "inclination": "-30 deg"}, "falls with"),
        ({"mass": "100 kg", "inclination": "90 deg", "counterweight": "150 kg"}, "rises with"),
        ({"mass": "100 kg", "inclination": "-90 deg", "counterforce": "2 kN"}, "rises with"),
        ({"mass": "100 kg", "counterforce": "500 N"}, "moves with"),
        ({"mass": "100 kg"}, "no brake is needed"),
    ],
)
def test_the_way_of_an_axis_that_is_let_go(report, axis, said):
    found = report(axis)
    record = of_brake(found)
    assert record.text.startswith(said)
    falls = not said.startswith("no")
    assert (record.severity, record.holds) == (("warning", False) if falls else ("info", True))
    if falls:
        assert "(in all conditions)" in record.text


def test_what_stays_by_its_friction_says_by_how_much(report):
    """A screw of 45 % loses 1/0.45 − 1 of the load."""
    upright = {"mass": "100 kg", "inclination": "90 deg"}
    locks = of_brake(report(upright, RULE.replace("0.9", "0.45")))
    assert (locks.severity, locks.holds, locks.value) == ("info", True, 0.0)
    assert "at least 1.222 times the torque of the load" in locks.text


def test_what_barely_stays_is_said_with_its_margin(report):
    """A screw of 49.83 % loses 1/0.4983 − 1 = 1.007 of the load."""
    barely = of_brake(report({"mass": "100 kg", "inclination": "90 deg"}, RULE.replace("0.9", "0.4983")))
    assert "at least 1.007 times the torque of the load: a margin of 0.68 % only" in barely.text
    assert "do not rely on it" in barely.text


def test_of_all_conditions_the_one_that_holds_the_least_counts(report):
    """Friction that is twice as much in a second condition makes the axis no safer."""
    found = report({"mass": "100 kg", "inclination": "90 deg"}, RULE.replace("0.9", "0.45"))
    (one,) = found.brake.conditions
    twice = dataclasses.replace(one, breakaway_torque=2 * one.breakaway_torque)
    vars(found)["brake"] = dataclasses.replace(found.brake, conditions=[twice, one])
    assert "at least 1.222 times" in of_brake(found).text


@pytest.mark.parametrize(("held", "said"), [("0.17 N m", "stays by the 0.17 N m of"), ("0.1 N m", "falls with the")])
def test_what_the_motor_holds_without_current_is_counted_at_rest(report, held, said):
    """100 kg at a lead of 10 mm are 1.561 N m; a screw of 52.3 % loses 0.912 of them, the rest is 0.137 N m."""
    motor = '[motor]\nrated_torque = "9 N m"\npeak_torque = "9 N m"\nlargest_speed = "3000 rpm"\n'
    motor = f'{motor}holding_torque = "{held}"\n'
    upright = {"mass": "100 kg", "inclination": "90 deg"}
    record = of_brake(report(upright, RULE.replace("0.9", "0.523"), more=motor))
    assert record.text.startswith(said)
    assert record.severity == "warning"


def test_a_nut_with_play_loses_it_where_the_load_changes_its_flank(report):
    """A mass without friction pushes back from where it slows down: 10 mm before each end, at 0.2 m/s and 2 m/s²."""
    loose = SCREW.replace('"double"', '"single"').replace('preload = "1 kN"', 'axial_play = "20 um"')
    result = report({"mass": "100 kg"}, screw=loose)
    places = [(change.position, change.time, change.lost_motion) for change in result.flank_changes]
    cruise = 0.28 / 0.2
    assert places == [
        pytest.approx((0.29, 0.1 + cruise, 20e-6)),
        pytest.approx((0.01, 1.2 + 0.1 + 2 * cruise, 20e-6)),
    ]
    (record,) = (record for record in verdicts(result) if record.id == "verdict.flank_changes")
    assert "2 times in a cycle, where the position loses the play of 20 µm: at 290 mm (“forth: slows" in record.text
    unknown = report({"mass": "100 kg"}, screw=loose.replace('axial_play = "20 um"', ""))
    (record,) = (record for record in verdicts(unknown) if record.id == "verdict.flank_changes")
    assert record.text.endswith("play unknown: give nut.axial_play")
    preloaded = report({"mass": "100 kg"})
    assert [change.lost_motion for change in preloaded.flank_changes] == [0.0, 0.0]
    assert "verdict.flank_changes" not in {record.id for record in verdicts(preloaded)}
    # upright, the weight stays on one flank
    assert not report({"mass": "100 kg", "inclination": "90 deg"}, screw=loose).flank_changes


#: A shaft of 40 mm and 1 m: half its mass times the square of its radius, kg m².
SHAFT = math.pi * 0.020**2 * 7850 * 0.020**2 / 2
MOUNTED = '[installation]\nunsupported_length = "1 m"\nends = "fixed-supported"\n'
FIRM = RULE.replace("0.9", "1.0")


def torque(inertia):
    """Of 100 kg and this inertia at 2 m/s² and a lead of 10 mm, without friction, N m."""
    return 100 * 2 * 0.010 / math.tau + inertia * 2 * math.tau / 0.010


@pytest.mark.parametrize(
    ("axis", "more", "inertia", "said"),
    [
        ({}, MOUNTED, SHAFT, "screw (a cylinder of 40 mm and 1000 mm) 19.73 kg cm^2; not given: motor, coupling"),
        ({}, "", 0.3 * SHAFT, "as long as the stroke of 300 mm: give its length) 5.919 kg cm^2; not given: motor"),
        ({"motor_inertia": "20 kg cm^2", "coupling_inertia": "3 kg cm^2"}, MOUNTED, SHAFT + 23e-4, "motor 20 kg cm^2"),
        ({"screw_inertia": "15 kg cm^2"}, MOUNTED, 15e-4, "screw 15 kg cm^2; not given: motor, coupling"),
        ({"inertia": "45 kg cm^2"}, MOUNTED, 45e-4, "as given for motor, coupling and screw: none is added"),
        ({}, MOUNTED + '[surroundings]\nbore = "20 mm"\nshaft_length = "1 m"\n', SHAFT * 15 / 16, "screw"),
    ],
)
def test_what_turns_is_accelerated_and_named(report, axis, more, inertia, said):
    found = report({"mass": "100 kg", **axis}, FIRM, more=more)
    assert found.numbers["torque_peak"] == pytest.approx(torque(inertia), rel=1e-9)
    (counted,) = (record for record in verdicts(found) if record.id == "verdict.inertia")
    assert counted.value == pytest.approx(inertia, rel=1e-9)
    assert said in counted.text


def test_gears_reduce_the_inertia_of_the_screw_alone(report):
    """At half the speed of the motor a quarter of it counts."""
    found = report({"mass": "100 kg", "transmission_ratio": 2.0, "motor_inertia": "20 kg cm^2"}, FIRM, more=MOUNTED)
    assert found.axis.turning_inertia == pytest.approx(SHAFT / 4 + 20e-4, rel=1e-9)


def test_an_inertia_that_is_missing_or_too_small_is_a_warning(report):
    def warned(axis, more=MOUNTED):
        return {one.id: one.text for one in warnings(report({"mass": "100 kg", **axis}, more=more))}

    assert "accelerates: motor, coupling; give [axis] motor_inertia" in warned({})["duty.no_inertia"]
    assert "screw alone has 19.73 kg cm^2" in warned({"inertia": "15 kg cm^2"})["duty.inertia_too_small"]
    for complete in ({"inertia": "45 kg cm^2"}, {"motor_inertia": "20 kg cm^2"}):
        assert not {"duty.no_inertia", "duty.inertia_too_small"} & set(warned(complete))


def test_the_inertia_of_all_that_turns_has_no_parts_beside_it(report):
    with pytest.raises(InputError, match="motor_inertia: is given beside the inertia of all that turns"):
        report({"mass": "100 kg", "inertia": "45 kg cm^2", "motor_inertia": "20 kg cm^2"})


def test_strange_numbers_of_segments_and_of_bearings_are_named(report):
    segments = '[motion]\nkind = "segments"\n[[motion.segment]]\nduration = "2 s"\nspeed = "1 m/s"\nforce = "20 MN"\n'
    bearing = '[bearings.fixed]\nlaw = "known"\ntorque = "200 N m"\n'
    found = report({"mass": "100 kg", "inertia": "1 kg cm^2"}, motion=segments, more=bearing)
    subjects = {record.subject for record in warnings(found) if record.id == "inputs.implausible"}
    assert subjects >= {"motion.segment 1.force", "bearings.fixed.torque"}


def test_what_does_not_move_has_no_stroke_that_is_too_short(report):
    rest = '[motion]\nkind = "segments"\n[[motion.segment]]\nduration = "2 s"\n'
    found = report({"mass": "100 kg"}, motion=rest)
    assert [record.id for record in warnings(found)] == []


def test_the_faster_way_counts_where_it_is_the_way_back(report):
    """0.1 m/s there and 0.3 m/s back on a lead of 10 mm: 600 and, backwards, 1800 revolutions a minute."""
    ways = [(0.3, 0.1), (-0.3, 0.3)]
    segments = "".join(f'[[motion.segment]]\ndistance = "{way} m"\nspeed = "{speed} m/s"\n' for way, speed in ways)
    motion = f'[motion]\nkind = "segments"\nacceleration = "2 m/s^2"\n{segments}'
    motor = '[motor]\nrated_torque = "9 N m"\npeak_torque = "9 N m"\nlargest_speed = "1000 rpm"\n'
    found = report({"mass": "100 kg"}, motion=motion, more=motor)
    (said,) = [record.text for record in warnings(found) if record.id == "duty.motor_speed"]
    assert "at up to 1800 rpm, above its largest speed 1000 rpm" in said


@pytest.mark.parametrize(
    ("inclination", "words"),
    [
        ("0 deg", "horizontal axis"),
        ("90 deg", "vertical axis"),
        ("-90 deg", "vertical axis"),
        ("30 deg", "axis at 30 deg"),
    ],
)
def test_the_title_says_how_the_axis_stands_and_moves(report, inclination, words):
    line = title(report({"mass": "100 kg", "inclination": inclination}))
    assert (
        line == f"{words}, 100 kg, trapezoid over 300 mm at up to 12 m/min: double nut, preload 1000 N, efficiency 0.9"
    )
