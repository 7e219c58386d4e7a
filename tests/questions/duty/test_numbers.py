"""Numbers of a cycle as a case has them: parts of the peak and of the RMS torque, and the balls under most load."""

import numpy as np
import pytest

from ballscrew.cases.case_files import case_file
from ballscrew.questions.duty.compute import duty

CASE = """
[screw]
catalogue = "rexroth-40x10x6-6-double"
[nut]
type = "single"
[lubricant]
grade = "ISO VG 100"
[model]
name = "constant-efficiency"
efficiency = 0.8
[axis]
mass = "100 kg"
inclination = "90 deg"
inertia = "20 kg cm^2"
[motion]
kind = "trapezoid"
stroke = "0.4 m"
speed = "0.2 m/s"
acceleration = "4 m/s^2"
dwell = "0.5 s"
force = "-2.5 kN"
"""
G, ARM = 9.80665, 0.01 / (2 * np.pi)


@pytest.fixture(scope="module")
def report(tmp_path_factory):
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_text(CASE, encoding="utf-8")
    return duty(case_file.load(path, [], moves=True))


def test_the_largest_torque_by_its_causes(report):
    """Slowing down upwards while the process pulls: the torque is backwards, and parts have the sign of their sum."""
    load = 100 * (G - 4) - 2500
    parts = {
        "acceleration of the mass": 100 * 4 * ARM,
        "gravity": -100 * G * ARM,
        "process": 2500 * ARM,
        "efficiency": -abs(load) * ARM * (1 / 0.8 - 1),
        "acceleration of what turns": 2e-3 * 4 / ARM,
    }
    found = {name: part for name, part in report.torque_peak_by.items() if part}
    assert found == pytest.approx(parts, rel=1e-9)
    assert sum(found.values()) == pytest.approx(report.duty.torque_peak, rel=1e-12)
    assert min(report.duty.torque) == pytest.approx(-report.duty.torque_peak, rel=1e-12)


def test_parts_share_out_the_square_of_the_rms_torque(report):
    assert sum(report.torque_rms_by.values()) == pytest.approx(report.duty.torque_rms, rel=1e-12)
    states, torque = report.duty.states, report.duty.torque
    own = states.weight @ (report.duty.parts["gravity"] * torque) / states.cycle_time / report.duty.torque_rms
    assert report.torque_rms_by["gravity"] == pytest.approx(own, rel=1e-12)


def test_the_balls_are_asked_for_under_the_largest_load_with_its_sign(report):
    """Of one nut without preload all balls carry it: N sin α z = F, and those of the other flank carry nothing."""
    largest = 100 * (G - 4) - 2500
    assert report.largest_load == pytest.approx(-largest, rel=1e-12)
    screw, balls = report.case.screw, report.balls_under_largest_load
    carried = float(screw.loaded_balls) * np.sin(float(screw.contact_angle))
    assert float(np.max(balls.forward_load)) == 0.0
    assert float(np.max(balls.backward_load)) == pytest.approx(
        -largest / carried, rel=0.01
    )  # beside the slope of the lead
