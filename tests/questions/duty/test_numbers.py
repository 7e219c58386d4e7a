"""Numbers of a cycle as a case has them: parts of the peak and of the RMS torque, and the balls under most load."""

import itertools

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
        "acceleration_of_the_mass": 100 * 4 * ARM,
        "gravity": -100 * G * ARM,
        "process": 2500 * ARM,
        "efficiency": -abs(load) * ARM * (1 / 0.8 - 1),
        "acceleration_of_what_turns": 2e-3 * 4 / ARM,
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


def by_hand():
    """Of each phase that moves: its torque by mechanics, forth or back, and its way; forth the process pulls."""
    found = []
    for direction, force in ((1, -2500.0), (-1, 0.0)):
        for acceleration, way in ((4.0, 0.005), (0.0, 0.39), (-4.0, 0.005)):
            load = 100 * (G + direction * acceleration) + force
            torque = load * ARM + direction * abs(load) * ARM * (1 / 0.8 - 1) + 2e-3 * direction * acceleration / ARM
            found.append((torque, direction, way))
    return found


def test_the_numbers_of_a_cycle_by_hand(report):
    numbers, cycle = report.numbers, 2 * (0.4 / 0.2 + 0.2 / 4 + 0.5)
    energies = [torque * direction * way / ARM for torque, direction, way in by_hand()]
    drawn, returned = sum(max(one, 0.0) for one in energies), sum(max(-one, 0.0) for one in energies)
    powers = [torque * direction * 0.2 / ARM for torque, direction, _ in by_hand()]
    lost = sum(
        abs(100 * (G + d * a) + f) * way * 0.25
        for d, f in ((1, -2500), (-1, 0))
        for a, way in ((4, 0.005), (0, 0.39), (-4, 0.005))
    )
    wanted = {
        "cycle_time": cycle, "mean_speed": 0.8 / ARM / cycle, "largest_speed": 0.2 / ARM, "revolutions": 80.0,
        "power_peak": max(powers), "power_returned_peak": -min(powers), "energy_drawn": drawn,
        "energy_returned": returned, "energy_lost": lost, "energy_of_process": -2500 * 0.4, "energy_stored": 0.0,
        "energy_per_day": drawn * 86400 / cycle, "energy_per_day_with_recovery": (drawn - returned) * 86400 / cycle,
    }  # fmt: skip
    assert {name: numbers[name] for name in wanted} == pytest.approx(wanted, rel=1e-9, abs=1e-9)
    assert returned > 0
    # of the two flanks the pulled one, by the rule of catalogues alone
    pulled = [(0.005, 2500 - 100 * (G + 4)), (0.39, 2500 - 100 * G), (0.005, 2500 - 100 * (G - 4))]
    mean = (sum(way * load**3 for way, load in pulled) / 0.8) ** (1 / 3)
    lives = 1e6 * (report.life.dynamic_load_rating / mean) ** 3
    assert numbers["mean_load"] == pytest.approx(mean, rel=1e-9)
    assert numbers["life_revolutions"] == pytest.approx(lives, rel=1e-9)
    assert numbers["life_cycles"] == pytest.approx(lives / 80.0, rel=1e-9)
    assert numbers["life_time"] == pytest.approx(lives / 80.0 * cycle, rel=1e-9)


def test_the_phases_of_a_cycle_by_hand(report):
    """Each with its start, its time, and what it asks of the motor; rests hold the weight."""
    starts = np.cumsum([0.0, 0.05, 1.95, 0.05, 0.5, 0.05, 1.95, 0.05, 0.5])
    held = (100 * G * ARM, 0, 0.0)
    every = [*by_hand()[:3], held, *by_hand()[3:], held]
    forth, back = ([abs(100 * (G + a) + f) for a in each] for f, each in ((-2500, (4, 0, -4)), (0, (-4, 0, 4))))
    loads = [*forth, 100 * G, *back, 100 * G]
    ends = itertools.pairwise(starts)
    for phase, (start, end), (torque, direction, way), load in zip(report.phases, ends, every, loads, strict=True):
        assert (phase.start, phase.duration) == pytest.approx((start, end - start), abs=1e-12)
        assert (phase.torque_peak, phase.torque_rms) == pytest.approx((torque, abs(torque)), rel=1e-9)
        assert phase.energy == pytest.approx(torque * direction * way / ARM, rel=1e-9, abs=1e-9)
        assert phase.largest_load == pytest.approx(load, rel=1e-9)


def test_what_is_said_of_the_running_time(tmp_path):
    """Turns and hours against those that are asked for: used is one over the other."""
    path = tmp_path / "case.toml"
    path.write_text(CASE + '[limits]\nrunning_time = "20000 h"\n', encoding="utf-8")
    found = duty(case_file.load(path, [], moves=True))
    by_name = {check.name: check for check in found.checks}
    hours, turns = by_name["running_time"], by_name["life"]
    assert hours.limit == pytest.approx(20000 * 3600.0)
    assert hours.value == pytest.approx(found.numbers["life_time"], rel=1e-12)
    assert turns.limit == pytest.approx(20000 * 3600.0 / found.numbers["cycle_time"] * 80.0, rel=1e-12)
    assert turns.value == pytest.approx(found.numbers["life_revolutions"], rel=1e-12)
    for check in (hours, turns):
        assert check.utilisation == pytest.approx(check.limit / check.value, rel=1e-12)
        assert check.holds is bool(check.utilisation <= 1)


def test_the_life_is_that_of_the_preload_in_motion(tmp_path):
    """A nut whose preload was set at rest lives as one with the preload that it has at the mean speed of the cycle."""
    constant = '[model]\nname = "constant-efficiency"\nefficiency = 0.8\n'

    def of(nut):
        path = tmp_path / "case.toml"
        path.write_text(CASE.replace(constant, "").replace('type = "single"', f'type = "double"\n{nut}'))
        return duty(case_file.load(path, [], moves=True))

    given, set_at_rest = of('preload = "3 kN"'), of('preload = "3 kN"\nset_at_rest = true')
    assert given.life.preload == 3000
    assert set_at_rest.life.preload > 1.3 * given.life.preload
    same = of(f'preload = "{float(set_at_rest.life.preload)!r} N"')
    assert same.life.revolutions == pytest.approx(set_at_rest.life.revolutions, rel=1e-9)
    assert set_at_rest.life.revolutions < given.life.revolutions
    at_rest, moving, like = (
        float(np.max(one.balls_under_largest_load.forward_load + one.balls_under_largest_load.backward_load))
        for one in (given, set_at_rest, same)
    )
    assert moving == pytest.approx(like, rel=1e-9)
    assert moving > at_rest
