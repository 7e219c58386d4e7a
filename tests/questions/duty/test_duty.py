"""``ballscrew duty``: a cycle as words, JSON, tables and picture; worked examples of catalogues; what is warned of."""

import contextlib
import dataclasses
import io
import json
import math

import pytest

from ballscrew.basis.output.json_text import plain
from ballscrew.cases.case_files import case_file
from ballscrew.faces.cli.main import main
from ballscrew.questions.duty import answer, compute
from ballscrew.questions.duty.compute import duty
from support.commands import ROOT
from support.own_screws import WITH_OIL

EXAMPLE = ROOT / "examples" / "vertical_axis.toml"
#: The model of the paper answers the quickest, of balls that are all alike.
SCREW = WITH_OIL.replace("[lubricant]", 'dynamic_load_rating = "5.4 kN"\n[lubricant]')
#: Horizontal, THK514E: 80 kg, lead 40 mm, 1 m at 1 m/s in 0.15 s, rests of 2.6 s.
THK = (
    SCREW.replace('lead = "10 mm"', 'lead = "40 mm"')
    + """
[model]
name = "constant-efficiency"
efficiency = 0.9
[axis]
mass = "80 kg"
guide_friction_coefficient = 0.003
guide_seal_force = "15 N"
inertia = "1.148e-3 kg m^2"
[motion]
kind = "trapezoid"
stroke = "1 m"
speed = "1 m/s"
acceleration = "6.66666667 m/s^2"
dwell = "2.6 s"
"""
)
VERTICAL = (
    SCREW
    + """
[axis]
mass = "100 kg"
inclination = "90 deg"
[motion]
kind = "trapezoid"
stroke = "0.3 m"
speed = "0.25 m/s"
acceleration = "1.5 m/s^2"
dwell = "1 s"
"""
)


@pytest.fixture
def found(tmp_path):
    """The duty of a case, in this process."""

    def of(written, *settings):
        path = tmp_path / "case.toml"
        path.write_text(written, encoding="utf-8")
        return duty(case_file.load(path, settings, moves=True))

    return of


def document(report):
    return plain(answer.document(report))


def records(document, kind):
    return {record["id"]: record for record in document[kind]}


def test_a_long_motion_is_thinned_and_says_so(found, monkeypatch):
    report = found(VERTICAL)
    whole = document(report)["results"]["cycle"]
    monkeypatch.setattr(compute, "MOST_STATES", 40)
    some = document(dataclasses.replace(report))["results"]["cycle"]
    assert (whole["every"], len(whole["time"])) == (1, len(report.duty.states.time))
    assert some["every"] == math.ceil(len(whole["time"]) / 40)
    assert some["torque"] == whole["torque"][:: some["every"]]


def test_the_horizontal_example_of_thk(found):
    """THK514E, selection of a ball screw: RMS torque 1305 N mm, peak 4730 N mm, mean load 225 N, no brake."""
    written = document(found(THK))
    results = written["results"]
    assert results["torque_by"] == "rule"
    assert results["torque_rms"] == pytest.approx(1.305, rel=5e-3)
    assert results["torque_peak"] == pytest.approx(4.730, rel=5e-3)
    assert results["mean_load"] == pytest.approx(225.0, rel=5e-3)
    assert results["life_revolutions"] == pytest.approx(4.1e9 * 1.5**3, rel=5e-3)  # their load factor is 1.5
    assert results["brake"]["falls"] is False
    assert results["cycle_time"] == pytest.approx(7.5, rel=1e-6)
    assert written["provenance"]["model"] == "constant-efficiency"
    # mechanics moves the mass through the screw, with its losses
    assert results["rules"]["mechanics"]["torque_peak"] > results["torque_peak"]


def test_the_vertical_example_of_thk(found):
    """THK514E: 50 kg up and down, 40 kg held for 7.6 s; RMS torque 743 N mm. The rise and the fall are of segments."""
    written = THK.partition("[axis]")[0].replace('lead = "40 mm"', 'lead = "10 mm"')
    written += '[axis]\nmass = "50 kg"\ninclination = "90 deg"\nguide_seal_force = "20 N"\ninertia = "8.12e-5 kg m^2"\n'
    written += '[motion]\nkind = "segments"\nacceleration = "1.5 m/s^2"\n'
    for distance in ("600 mm", "-600 mm"):
        written += f'[[motion.segment]]\ndistance = "{distance}"\nspeed = "0.3 m/s"\n'
    written += '[[motion.segment]]\nduration = "7.6 s"\nforce = "-98 N"\n'
    results = document(found(written))["results"]
    assert results["torque_rms"] == pytest.approx(0.743, rel=5e-3)
    assert results["rules"]["mechanics"]["torque_rms"] < results["torque_rms"]
    assert results["brake"]["falls"] is True


@pytest.mark.parametrize(
    ("settings", "name", "words"),
    [
        (["motion.return=false"], "duty.open_cycle", "ends 300 mm from where it began: the numbers are of "
         "this way alone, not of a cycle that repeats; return = true adds the way back"),
        (['motion.stroke="20 mm"'], "duty.short_stroke", "20 mm is shorter than the loaded turns of the nut, 28.56 mm"),
        (['installation.unsupported_length="4 m"', "installation.ends=fixed-free"], "duty.critical_speed", "move at "),
        (['motor.rated_torque="1 N m"', 'motor.peak_torque="1.5 N m"', 'motor.largest_speed="3000 rpm"'],
         "duty.motor_torque", "its curve reaches that at no speed: take a lower acceleration"),
        (['motor.rated_torque="9 N m"', 'motor.peak_torque="9 N m"', 'motor.largest_speed="1000 rpm"'],
         "duty.motor_speed", "at up to 1500 rpm, above its largest speed 1000 rpm: take a lower speed"),
        (['axis.mass="200000 kg"'], "inputs.implausible", "moved mass, with the load on it 200000 kg lies outside"),
    ],
    ids=lambda value: value if isinstance(value, str) and "." in value and " " not in value else "",
)  # fmt: skip
def test_warnings_name_the_remedy(found, settings, name, words):
    settings = [
        *settings,
        "model.name=constant-efficiency",
        "model.efficiency=0.9",
        'screw.dynamic_load_rating="37 kN"',
    ]
    by_id = records(document(found(VERTICAL, *settings)), "warnings")
    assert words in by_id[name]["text"]
    assert by_id[name]["severity"] == "warning"


def test_a_plain_cycle_warns_of_nothing(found):
    given = (
        "model.name=constant-efficiency",
        "model.efficiency=0.9",
        "axis.inertia=45 kg cm^2",
        "screw.dynamic_load_rating=37 kN",
    )
    assert document(found(VERTICAL, *given))["warnings"] == []


def test_a_jump_of_the_speed_is_named(found):
    motion = '[motion]\nkind = "segments"\n[[motion.segment]]\nname = "feed"\nduration = "2 s"\nspeed = "0.1 m/s"\n'
    motion += '[[motion.segment]]\nname = "back"\nduration = "2 s"\nspeed = "-0.1 m/s"\n'
    written = VERTICAL.partition("[motion]")[0] + motion
    warned = document(found(written, "model.name=constant-efficiency", "model.efficiency=0.9"))["warnings"]
    texts = [record["text"] for record in warned if record["id"] == "duty.speed_jump"]
    assert texts[0].startswith("the speed jumps from 6 m/min (“feed”) to -6 m/min (“back”)")
    assert len(texts) == 2
    assert not any(record["id"] == "duty.open_cycle" for record in warned)


def test_nothing_that_moves(found):
    written = VERTICAL.partition("[motion]")[0] + '[motion]\nkind = "segments"\n[[motion.segment]]\nduration = "2 s"\n'
    results = document(found(written))["results"]
    assert results["mean_load"] is None
    assert results["energy_drawn"] == 0
    assert results["power_peak"] == results["power_returned_peak"] == 0
    assert results["torque_rms"] == pytest.approx(100 * 9.80665 * 0.01 / (2 * math.pi), rel=1e-12)


def test_run_asks_for_an_operating_point(ballscrew, tmp_path):
    (tmp_path / "case.toml").write_text(VERTICAL, encoding="utf-8")
    done = ballscrew("run", "case.toml")
    assert (done.returncode, done.stdout) == (2, "")
    assert "only ballscrew duty and warm-up take the motion in its place" in done.stderr


def test_a_band(ballscrew, tmp_path):
    (tmp_path / "case.toml").write_text(VERTICAL, encoding="utf-8")
    done = ballscrew("duty", "case.toml", "--band", "--samples", "32", "--model", "olaru2005", "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["band"]["samples"] == 32
    for name in ("torque_rms", "torque_peak", "energy_drawn", "energy_returned", "energy_lost"):
        one = found["band"][name]
        assert one["value"] == pytest.approx(found["results"][name], rel=1e-9)
        assert one["low"] <= one["median"] <= one["high"]
    assert "temperature" in found["band"]["inputs"]


def test_a_recorded_motion(ballscrew, tmp_path):
    """In place of that of the case; without one in the case, too."""
    time = [0.002 * k for k in range(501)]
    rows = [f"{t:.3f},{150 * (1 - math.cos(2 * math.pi * t)):.6f}" for t in time]
    (tmp_path / "run.csv").write_text("\n".join(["t [s],x [mm]", *rows]), encoding="utf-8")
    (tmp_path / "case.toml").write_text(VERTICAL.partition("[motion]")[0], encoding="utf-8")
    rule = ("--set", "model.name=constant-efficiency", "--set", "model.efficiency=0.9")
    rule += ("--set", "axis.screw_inertia=0 kg cm^2")
    done = ballscrew("duty", "case.toml", "--trace", "run.csv", *rule, "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["inputs"]["motion"] == {"kind": "trajectory", "file": "run.csv", "samples": 501}
    # a sine of 0.3 m and 1 Hz turns the screw 60 times; its mechanics by hand at the lower end
    assert found["results"]["revolutions"] == pytest.approx(60.0, rel=1e-3)
    largest = 100 * (9.80665 + 0.15 * (2 * math.pi) ** 2) * 0.01 / (2 * math.pi) / 0.9
    assert found["results"]["rules"]["mechanics"]["torque_peak"] == pytest.approx(largest, rel=1e-3)
    assert found["results"]["smoothing"]["samples"] == 501


def test_on_an_output_without_an_encoding(monkeypatch):
    """Defect: one in memory has none, and the command ended with an error of Python."""
    said = io.StringIO()
    assert said.encoding is None
    monkeypatch.setattr("sys.argv", ["ballscrew", "duty", str(EXAMPLE)])
    with contextlib.redirect_stdout(said), pytest.raises(SystemExit) as end:
        main()
    assert end.value.code in (None, 0)
    assert "█" not in said.getvalue()
    assert "#" in said.getvalue()
