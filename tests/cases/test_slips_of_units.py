"""A slip of a unit, a point or a count is named at once: by every command, and where Python makes a part."""

import dataclasses
import json
import math
import warnings

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.physics.components.screw import odd_preload, rating_of
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows
from ballscrew.physics.sizing.own_nut import odd_ratings
from ballscrew.physics.sizing.ratings import Ratings, ratings_of
from ballscrew.questions.select.answer import verdict
from support.commands import ROOT

AXIS = ROOT / "examples" / "vertical_axis.toml"
FEED = ROOT / "examples" / "feed_drive.toml"
SCREW = catalogue()["rexroth-40x10x6-6-double"].screw()

#: Settings of the vertical axis, 40 x 20 of a rating of some 50 kN, and the id and subject of what is said of them.
SLIPS = {
    'nut.preload="3.000 N"': [("inputs.implausible", "nut.preload"), ("inputs.thousands", "nut.preload")],
    'nut.preload="20 N"': [("inputs.implausible", "nut.preload")],
    'nut.preload="3000 kN"': [("inputs.implausible", "nut.preload")],
    "screw.loaded_balls=950": [
        ("inputs.implausible", "screw.loaded_turns"),
        ("inputs.implausible", "screw.loaded_balls"),
    ],
    "screw.loaded_balls=150": [("inputs.implausible", "screw.loaded_balls")],
    'screw.lead="20 cm"': [("inputs.implausible", "screw.lead_angle")],
    'screw.lead="10 cm"': [("inputs.implausible", "screw.groove_pitch")],
    'screw.dynamic_load_rating="330 kN"': [("inputs.implausible", "screw.dynamic_load_rating")],
    'screw.static_load_rating="40 kN"': [("inputs.implausible", "screw.static_load_rating")],
    'screw.root_diameter="30 mm"': [("inputs.implausible", "screw.root_diameter")],
    'losses.seals.seal_torque="4 N m"': [("inputs.implausible", "losses.seals.seal_torque")],
    'motor.peak_torque="5 kN m"': [("inputs.implausible", "motor.peak_torque")],
    'axis.mass="120 g"': [("inputs.implausible", "axis.mass")],
}
COMMANDS = {
    "run": [],
    "run with a band": ["--band", "--samples", "64"],
    "check": [],
    "compare": [],
    "duty": [],
    "warm-up": [],
    "axis": [],
    "sensitivity": ["--samples", "16"],
}


#: Lengths that contradict each other, and what is refused; 0.9 m of shaft for a stroke of 0.5 m.
CONTRADICTIONS = {
    'installation.unsupported_length="450 mm"': "motion: does not fit between the bearings (from -25 mm to 475 mm",
    'surroundings.first_position="500 mm"': "motion: does not fit between the bearings (from 500 mm to 1000 mm",
    'surroundings.stroke="5 m"': "surroundings.stroke: does not fit between the bearings (5000 mm on 900 mm)",
    'surroundings.shaft_length="0.8 m"': "installation.unsupported_length: is longer than the shaft between its",
    'surroundings.bore="40 mm"': "surroundings.bore: leaves no shaft (40 mm in a shaft of 3",
    'screw.root_diameter="42 mm"': "screw.root_diameter: leaves no room for the balls (42 mm and a pitch circle of 4",
}


#: Slips that no equation of the friction sees, and the same as a verdict names them.
BESIDE_FRICTION = {
    'screw.dynamic_load_rating="330 kN"': "[screw] dynamic_load_rating",
    'motor.peak_torque="5 kN m"': "[motor] peak_torque",
    'axis.mass="120 g"': "[axis] mass",
}


def said(records):
    return [(r["id"], r["subject"]) for r in records if r["id"].startswith("inputs.")]


@pytest.mark.parametrize("setting", SLIPS)
def test_a_slip_is_named(setting):
    found = case_file.load(AXIS, [setting]).implausible()
    assert [(record.id, record.subject) for record in found] == SLIPS[setting]
    assert {record.severity for record in found} == {"warning"}


@pytest.mark.slow
@pytest.mark.parametrize("command", COMMANDS)
def test_every_command_names_it(ballscrew, command):
    # the model of the paper answers the quickest
    options = [AXIS, "--model", "olaru2005", "--set", 'nut.preload="3.000 N"', *COMMANDS[command]]
    found = ballscrew(command.partition(" ")[0], *options, "--json")
    records = json.loads(found.stdout)["warnings"]
    assert said(records) == SLIPS['nut.preload="3.000 N"']
    text = " ".join(ballscrew(command.partition(" ")[0], *options).stdout.split())
    for record in records:
        if record["id"].startswith("inputs."):
            assert record["text"] in text


@pytest.mark.slow
@pytest.mark.parametrize("setting", BESIDE_FRICTION)
@pytest.mark.parametrize("command", ["check", "duty"])
def test_no_verdict_is_without_it(ballscrew, command, setting):
    options = [AXIS, "--model", "olaru2005", "--set", setting]
    document = json.loads(ballscrew(command, *options, "--json").stdout)
    (whole,) = (one for one in document["verdicts"] if one["id"] == "verdict.checks")
    assert whole["text"].endswith(f"; unlikely: {BESIDE_FRICTION[setting]}")
    assert whole["severity"] != "info"
    assert said(document["warnings"]) == SLIPS[setting]
    assert f"unlikely: {BESIDE_FRICTION[setting]}" in " ".join(ballscrew(command, *options).stdout.split())


def test_a_candidate_does_not_hold_without_it():
    need = {"force": "2 kN", "feed": "10 m/min", "rows": "hiwin-40-20k4", "nut": "single", "life": "1000 h"}
    found = bs.select({**need, "losses": {"seals": {"seal_torque": "4 N m"}}})
    (only,) = found.ranked
    assert verdict(only.candidate).endswith("; unlikely: [losses] seals.seal_torque")


def test_rows_that_are_shipped_are_likely():
    """Ratings, root diameters and seals of rows, with the nut that each lists."""
    rows = [*printed_rows(), *[row for row in catalogue().values() if row.family and not row.refusal][::20]]
    for name, row in ((row.name, row) for row in rows):
        preload = {} if row.nut in ("", "single") else {"preload": "5 %"}
        tables = {"screw": {"catalogue": name}, "nut": {"type": row.nut or "single", **preload}}
        tables |= {"lubricant": {"grade": "ISO VG 100"}, "operation": {"axial_load": "1 kN", "screw_speed": "9 rpm"}}
        # nuts with leads of twice the diameter have more than one thread, which is not printed
        unlikely = {"screw.groove_pitch"} if row.lead > 1.9 * row.nominal_diameter else set()
        assert unlikely.issuperset(case_file.build(tables).unlikely), name


def test_ratings_of_a_catalogue_are_likely_only_with_the_balls_of_their_row():
    """A row whose listed ratings are far from those by its estimated balls, and a nut with fewer balls than its row."""
    subjects = {"screw.dynamic_load_rating", "screw.static_load_rating"}
    examples = ROOT / "examples" / "service.toml"
    for settings, expected in (
        (["screw.catalogue=thk-bnfn10020a-5"], set()),
        (["screw.catalogue=rexroth-40x10x6-6-double"], set()),
        (["screw.catalogue=rexroth-40x10x6-6-double", "screw.loaded_balls=40"], subjects),
    ):
        records = case_file.load(examples, settings).implausible()
        assert {record.subject for record in records} & subjects == expected, settings


def test_a_static_rating_below_the_dynamic_one_is_named():
    found = odd_ratings({"dynamic_load_rating": 50e3, "static_load_rating": 49e3}, Ratings(50e3, 70e3))
    (record,) = found
    assert (record.subject, record.value, record.limit) == ("screw.static_load_rating", 49e3, 50e3)
    assert not odd_ratings({"dynamic_load_rating": 50e3, "static_load_rating": 60e3}, Ratings(50e3, 70e3))


@pytest.mark.parametrize("setting", CONTRADICTIONS)
@pytest.mark.parametrize("moves", [False, True])
def test_lengths_that_contradict_each_other_are_refused(setting, moves):
    with pytest.raises(bs.InputError) as refused:
        case_file.load(AXIS, [setting], moves=moves)
    assert CONTRADICTIONS[setting] in str(refused.value)


@pytest.mark.slow
@pytest.mark.parametrize("command", [*COMMANDS, "select"])
def test_every_command_refuses_a_shaft_that_is_too_short(ballscrew, command):
    path = ROOT / "examples" / "needs" / "vertical_axis.toml" if command == "select" else AXIS
    done = ballscrew(command.partition(" ")[0], path, "--set", 'installation.unsupported_length="450 mm"')
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert line.startswith("motion: does not fit between the bearings (from ")


def test_a_need_refuses_a_stroke_that_is_longer_than_its_shaft():
    need = {"force": "2 kN", "feed": "10 m/min", "stroke": "900 mm", "length": "300 mm", "ends": "fixed-fixed"}
    with pytest.raises(bs.InputError, match=r"need\.stroke: does not fit between the bearings \(900 mm on 300 mm"):
        bs.select(need)


@pytest.mark.slow
def test_a_measured_torque_comes_with_it(ballscrew):
    odd = ["--set", 'nut.preload="3.000 N"', "--json"]
    service = ballscrew("service", "--case", AXIS, "--torque", "0.35 N m", "--speed", "100 rpm", *odd)
    assert said(json.loads(service.stdout)["warnings"]) == SLIPS['nut.preload="3.000 N"']


def test_a_need_names_it():
    found = bs.select({"force": "3.000 N", "feed": "10 m/min", "rows": "hiwin-40-20k4", "preload": "5 %"})
    assert {"inputs.thousands"} == {
        record.id for each in found.ranked for record in each.candidate.case.doubts if record.subject.endswith("load")
    }


def test_a_point_before_three_digits_is_named_where_the_other_number_is_plausible():
    def doubts(*settings):
        return [r for r in case_file.load(AXIS, settings).implausible() if r.id == "inputs.thousands"]

    (record,) = doubts('operation.axial_load="3.000 N"')
    assert record.text == '"3.000 N" is read as 3 N: write "3000 N" if that is meant, else "3 N"'
    assert (record.value, record.limit, record.unit) == (3.0, 3000.0, "N")
    (record,) = doubts('operation.axial_load="3.512 N"')
    assert record.text == '"3.512 N" is read as 3.512 N: write "3512 N" if that is meant, else "3.5120 N"'
    assert not doubts('operation.axial_load="3.5120 N"')
    assert [r.subject for r in doubts('operation.screw_speed="1.500 rpm"')] == ["operation.screw_speed"]
    assert [r.subject for r in doubts('operation.axial_load="−3.000 N"')] == ["operation.axial_load"]
    assert [r.subject for r in doubts('operation.axial_load="３.０００ N"')] == ["operation.axial_load"]


@pytest.mark.parametrize(
    "setting",
    [
        'screw.ball_diameter="6.350 mm"',
        'screw.lead="20.000 mm"',
        'screw.pitch_circle_diameter="1.625 in"',
        'screw.ball_roughness="0.080 um"',
        'axis.mass="0.300 kg"',
        'axis.mass="1.250 kg"',
        'motor.rated_torque="9.550 N m"',
        'limits.running_time="20.000 h"',
        'axis.mass="400.000 kg"',
        'lubricant.temperature="40.000 degC"',
        'installation.unsupported_length="1.250 m"',
        'operation.axial_load="4000.000 N"',
        'operation.axial_load="900.000 N"',
        'operation.screw_speed="600.000 rpm"',
        'operation.axial_load="3.0000 N"',
        'operation.axial_load="3 N"',
        'operation.axial_load="1.500 kN"',
        'nut.preload="0.000 N"',
    ],
)
def test_decimals_as_other_programs_write_them_pass(setting):
    assert "inputs.thousands" not in {record.id for record in case_file.load(AXIS, [setting]).implausible()}


# -- in Python --------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("make", "subject"),
    [
        (lambda: dataclasses.replace(SCREW, lead=10), "screw.lead"),
        (lambda: dataclasses.replace(SCREW, lead=0.1), "screw.groove_pitch"),
        (lambda: dataclasses.replace(SCREW, loaded_balls=950), "screw.loaded_turns"),
        (lambda: bs.DoubleNut(preload=3), "nut.preload"),
        (lambda: dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=30.0)), "nut.preload"),
        (lambda: bs.Material(206.0), "material.young_modulus"),
    ],
)
def test_plain_numbers_are_warned_of_where_they_are_written(make, subject):
    with pytest.warns(bs.ImplausibleInput, match=subject.replace(".", r"\.")) as found:
        make()
    assert {record.filename for record in found} == {__file__}


@pytest.mark.implausible
def test_the_model_says_it_too():
    friction = bs.FrictionModel.reference()
    oil = bs.Lubricant.from_grade("ISO VG 100")
    odd = friction(dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=30.0)), oil, axial_load=1e3, screw_speed=10.0)
    assert [(r.id, r.subject) for r in odd.warning_records if r.id.startswith("inputs.")] == [
        ("inputs.implausible", "nut.preload")
    ]


def test_arrays_and_what_the_package_makes_are_never_warned_of():
    with warnings.catch_warnings():
        warnings.simplefilter("error", bs.ImplausibleInput)
        dataclasses.replace(SCREW, lead=np.array([0.01, 10.0]))
        bs.DoubleNut(preload=np.array([3.0, 3e3]))
        case_file.load(FEED, ['nut.type="double"', 'nut.preload="3 N"'])
        bs.sweep(
            bs.FrictionModel.corrected(),
            SCREW,
            bs.Lubricant.from_grade("ISO VG 100"),
            lead=[0.01, 10.0],
            axial_load=1e3,
            screw_speed=10.0,
        )


@pytest.mark.implausible
def test_of_arrays_the_preload_farthest_out():
    preloads = np.array([0.0, 3.0, 3e3, 30.0])
    with np.errstate(all="raise"):
        (record,) = odd_preload(dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=preloads)))
    assert record.value == pytest.approx(3.0 / float(rating_of(SCREW)), rel=1e-12)
    assert odd_preload(dataclasses.replace(SCREW, nut=bs.DoubleNut(preload=np.array([0.0, 3e3])))) == []


def test_the_rating_of_a_screw_is_that_of_its_row():
    for row in printed_rows():
        # balls of a screw are whole, and turns of a row are not: half a ball in some 20 or more, to the power of 0.86
        assert float(rating_of(row.screw())) == pytest.approx(ratings_of(row).dynamic, rel=0.86 * 0.5 / 20)
        assert math.isfinite(float(rating_of(row.screw())))
