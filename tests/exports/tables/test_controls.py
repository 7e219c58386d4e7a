"""Friction curves for controls and drives: read back, and run by LinuxCNC's HAL."""

import copy
import csv
import io
import os
import re
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.exports import hand_over
from ballscrew.exports.export import target
from ballscrew.exports.tables.curves import beckhoff, drive, friction_curve, linuxcnc
from ballscrew.questions.hand_over import answer

RANGES = {"axial_load": (-3000.0, 3000.0), "screw_speed": (-100.0, 100.0)}
#: The example of the manual: infosys.beckhoff.com, tf5200_friction_comp, Parameterisation.
MANUAL = """\
frict_comp.mode                                 3
frict_comp.table_entries                        3
frict_comp.position_delay                       30
frict_comp.reversal_lookahead                   4
frict_comp.scaling_factor                       10
frict_comp.delay_cycles                         9
frict_comp.table[0].in                          0
frict_comp.table[0].out                         0
frict_comp.table[1].in                          316
frict_comp.table[1].out                         3722
frict_comp.table[2].in                          333
frict_comp.table[2].out                         3884
"""
LINE = re.compile(r"frict_comp\.([\w\[\].]+) +(-?\d+)")


@pytest.fixture(scope="module")
def handed(handed_over):
    def handed(to, **options):
        model, nut = bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0)
        return handed_over(model, nut, to=to, ranges=RANGES, load=500.0, **options)

    return handed


def _friction(handed, speeds):
    point = {"axial_load": 500.0, "temperature": 313.15, "preload": 900.0, "screw_speed": speeds}
    return handed.evaluate(point)["screw_torque"]


@pytest.mark.parametrize("count", [2, 8, 20])
def test_the_curve_has_the_error_it_states(handed, count):
    subject = handed("linuxcnc")
    curve = friction_curve(subject, count)
    speeds = np.geomspace(curve.speeds[0], 100.0, 5000)
    off = np.abs(np.interp(speeds, curve.speeds, curve.torques) - _friction(subject, speeds))
    assert len(curve.speeds) <= count
    assert off.max() == pytest.approx(curve.worst_error.value, rel=0.02)


@pytest.mark.slow
def test_the_curve_of_a_nut_whose_balls_are_solved_one_by_one(handed_over):
    nut = bs.DoubleNut(preload=900.0, bodies=bs.Bodies())
    subject = handed_over(bs.FrictionModel.corrected(), nut, to="linuxcnc", ranges=RANGES, load=500.0)
    curve = friction_curve(subject, 4)
    screw, oil = subject.subject.screw, subject.subject.lubricant
    for speed, torque in zip(curve.speeds, curve.torques, strict=True):
        both = [
            subject.subject.model(screw, oil, axial_load=500.0, screw_speed=s * speed).screw_torque for s in (1, -1)
        ]
        assert torque == pytest.approx(max(map(float, map(abs, both))), rel=1e-9)
    assert 0 < curve.worst_error.relative < 0.05


def test_more_points_are_no_worse(handed):
    errors = [friction_curve(handed("linuxcnc"), count).worst_error.relative for count in (4, 8, 16)]
    assert errors == sorted(errors, reverse=True)
    assert errors[1] < 0.02


def test_where_directions_differ_the_greater_friction_is_the_curve(handed):
    """A straight friction, twice as large backwards: its curve is that of backwards, and off by the whole forwards."""
    subject = copy.copy(handed("linuxcnc"))

    def twice_backwards(point):
        speed = np.asarray(point["screw_speed"], dtype=float)
        friction = 0.2 + 1e-3 * np.abs(speed)
        return dict.fromkeys(subject.output_names, np.where(speed < 0, 2 * friction, friction))

    vars(subject)["evaluate"] = twice_backwards  # in place of the model, whose directions have the same friction
    curve = friction_curve(subject, 4)
    assert curve.torques == pytest.approx(2 * (0.2 + 1e-3 * curve.speeds), rel=1e-12)
    assert curve.worst_error.relative == pytest.approx(1.0, rel=1e-9)
    assert curve.worst_error.relative_at["screw_speed"] > 0


def test_the_list_has_the_form_of_the_example_of_the_manual(handed):
    subject = handed("beckhoff")
    text = beckhoff(subject).files["friction_comp.lis"].decode()
    found, example = ([LINE.fullmatch(line).groups() for line in one.splitlines()] for one in (text, MANUAL))
    assert [name for name, _ in found[:10]] == [name for name, _ in example[:10]]
    values = dict(found)
    count = int(values["table_entries"])
    speeds, torques = (np.array([int(values[f"table[{k}].{one}"]) for k in range(count)]) for one in ("in", "out"))
    assert count <= 20
    assert (speeds[0], torques[0]) == (0, 0)
    assert np.all(np.diff(speeds) > 0)
    at = np.geomspace(speeds[1], speeds[-1], 500)
    per_speed = 1e6 * subject.subject.screw.lead / (2 * np.pi)
    stated = friction_curve(subject, 19).worst_error.value
    off = np.abs(np.interp(at, speeds, torques) / 1000 - _friction(subject, at / per_speed)).max()
    assert off <= stated + 2e-3  # what whole numbers of speed and torque add


def test_the_curve_of_a_drive_counts_with_the_ratio_of_the_motor(handed):
    plain, geared = (
        np.array(list(csv.reader(io.StringIO(found.files["friction_curve.csv"].decode())))[1:], dtype=float)
        for found in (drive(handed("drive")), drive(handed("drive", ratio=2.0)))
    )
    assert geared[:, 0] == pytest.approx(2 * plain[:, 0], rel=1e-8)
    assert geared[:, 2] == pytest.approx(plain[:, 2] / 2, rel=1e-8)
    assert plain[:, 1] == pytest.approx(plain[:, 0] * 30 / np.pi, rel=1e-8)


@pytest.mark.parametrize(
    ("options", "metres", "newton_metres"), [({}, 1e-3, 1.0), ({"length": "inch", "torque_unit": 0.001}, 0.0254, 1e-3)]
)
def test_the_points_of_linuxcnc_are_the_friction_with_its_sign(handed, options, metres, newton_metres):
    """From the fastest backwards to the fastest forwards, as the component interpolates them."""
    subject = handed("linuxcnc", **options)
    text = linuxcnc(subject).files["ballscrew.hal"].decode()
    x, y = (np.array(re.findall(rf"\.{axis}-val-\d\d (\S+)", text), dtype=float) for axis in "xy")
    assert np.all(np.diff(x) > 0)
    assert x == pytest.approx(-x[::-1], rel=1e-12)
    turning = x * metres * 2 * np.pi / subject.subject.screw.lead
    assert turning[-1] == pytest.approx(100.0, rel=1e-12)
    assert np.min(np.abs(turning)) == pytest.approx(100.0 / 10_000, rel=1e-9)
    assert y * newton_metres == pytest.approx(np.sign(x) * _friction(subject, np.abs(turning)), rel=1e-9)


def test_linuxcnc_gives_the_curve(handed):
    halrun = shutil.which("halrun")
    if halrun is None:
        pytest.skip("halrun of LinuxCNC is not installed")
    subject = handed("linuxcnc")
    lines = linuxcnc(subject).files["ballscrew.hal"].decode().splitlines()
    place = next(k for k, line in enumerate(lines) if line.startswith("addf"))
    lines.insert(place, "loadrt threads name1=servo-thread period1=1000000 fp1=1")
    speeds = [-40.0, -3.0, 0.0, 0.5, 25.0, 1000.0]  # mm/s
    ask = [f"setp ballscrew-friction.in {v}\nloadusr -w sleep 0.1\ngetp ballscrew-friction.out" for v in speeds]
    as_root = os.geteuid() == 0  # HAL refuses root, and nobody else may enter a folder of root's
    with tempfile.TemporaryDirectory() as folder:
        Path(folder).chmod(0o777)
        file = Path(folder) / "try.hal"
        file.write_text("\n".join([*lines, "start", *ask, ""]))
        done = subprocess.run(
            [halrun, "-f", str(file)],
            capture_output=True,
            text=True,
            timeout=60,
            cwd=folder,
            env={**os.environ, "HOME": folder},
            **({"user": 65534, "group": 65534, "extra_groups": []} if as_root else {}),
        )
    found = np.array([float(line) for line in done.stdout.splitlines() if re.fullmatch(r"-?[\d.e+-]+", line)])
    curve = friction_curve(subject, 8)
    turning = np.array(speeds) * 1e-3 * 2 * np.pi / subject.subject.screw.lead
    wanted = np.sign(turning) * np.interp(np.abs(turning), curve.speeds, curve.torques)
    assert found == pytest.approx(wanted, rel=1e-5, abs=1e-9), done.stdout + done.stderr


@pytest.mark.parametrize(
    ("to", "options", "expected"),
    [
        ("linuxcnc", {"length": "cm"}, "hand_over.length: must be mm or inch"),
        ("beckhoff", {"units_per_newton_metre": 0.0}, "hand_over.units_per_newton_metre: must be positive"),
        ("drive", {"points": 1}, "hand_over.points: must be two at least"),
    ],
)
def test_faults_name_field_and_remedy(handed, to, options, expected):
    with pytest.raises(bs.InputError) as fault:
        target(to).export(handed(to, **options))
    assert str(fault.value).startswith(expected)


def test_friction_that_no_speed_changes_takes_two_points(handed_over):
    """Without load the printed equations leave the force between the balls, which does not depend on speed."""
    subject = handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut(), to="linuxcnc", ranges=RANGES)
    text = linuxcnc(subject).files["ballscrew.hal"].decode()
    torques = [float(line.split()[-1]) for line in text.splitlines() if ".y-val-" in line]
    assert "personality=4\n" in text
    assert np.abs(torques) == pytest.approx(torques[-1])


def test_a_load_beyond_the_range_is_refused(handed_over):
    subject = handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut(), to="drive", ranges=RANGES, load=4000.0)
    with pytest.raises(bs.InputError, match=r"hand_over\.load: is beyond the range"):
        drive(subject)


def test_the_load_is_that_of_the_case(example):
    case = case_file.load(example, ["operation.axial_load=800 N"])
    assert [target(to).options_of_case(case) for to in ("drive", "beckhoff", "linuxcnc")] == [{"load": 800.0}] * 3
    export = hand_over.of_case(case, "drive", hand_over.Request(ranges=["axial_load=-1:1 kN"]))
    assert export.valid_range["axial_load"] == (800.0, 800.0)


def test_a_curve_of_one_direction_is_that_of_both_and_says_so(handed_over):
    model, nut = bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0)
    found = []
    for least in (-100.0, 0.0):
        ranges = {**RANGES, "screw_speed": (least, 100.0)}
        found.append(drive(handed_over(model, nut, to="drive", ranges=ranges, load=500.0)))
    both, one = found
    assert one.files == both.files
    assert one.valid_range["screw_speed"] == (-100.0, 100.0)
    assert [record.id for record in both.warnings] == ["hand_over.one_load"]
    assert one.warnings[-1].text.endswith("-954.9 rpm to 954.9 rpm, not 0 rpm to 954.9 rpm only")
    assert "axial_load: 500 N\n" in answer.text(one, [])
