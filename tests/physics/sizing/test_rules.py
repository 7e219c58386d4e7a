"""Rules of one line against the worked examples of the catalogues that state them."""

import math

import pytest

from ballscrew.physics.sizing.rules import CHART_FRICTION, CHART_LINES, DRAG_RULES, RULES, Subject, drags, rule_of

#: BNFN4010-5: THK, A-689; and the examples of A-666 and A-743, of screws without preload.
BNFN4010 = Subject(0.040, 0.04175, 0.010, preload=3000.0)


def of(name, subject):
    return RULES[name].estimate(subject)


def test_the_preload_torque_of_thk():
    assert of("jis", BNFN4010).drag_torque == pytest.approx(0.865, abs=5e-4)
    assert of("thk", BNFN4010).drag_torque == of("jis", BNFN4010).drag_torque


def test_the_efficiency_that_thk_reads_off_its_chart():
    """33 mm, lead 10 mm, µ = 0.003: 96 %, and 24 N mm for 14.7 N."""
    subject = Subject(0.033, 0.033, 0.010, axial_load=14.7)
    found = of("lead-angle", subject)
    assert found.efficiency(subject.ideal_torque) == pytest.approx(0.96, abs=0.0101)
    assert subject.ideal_torque + found.screw_torque == pytest.approx(0.024, abs=5e-4)


def test_the_rotational_torque_of_thk():
    """510 N on a lead of 10 mm: 900 N mm."""
    subject = Subject(0.020, 0.020, 0.010, axial_load=510.0)
    assert subject.ideal_torque + of("thk", subject).screw_torque == pytest.approx(0.900, abs=5e-3)


def test_the_friction_angle_of_the_feed_drive_library():
    """Özdemir: a plane of 0.2° on the nominal diameter. Lead 10 on 40 mm is 4.55°: tan 4.55° / tan 4.75° = 0.9577."""
    subject = Subject(0.040, 0.045, 0.010, axial_load=1000.0)
    found = of("feed-drive-library", subject)
    assert found.efficiency(subject.ideal_torque) == pytest.approx(0.9577, abs=5e-5)


def test_the_lines_of_the_charts():
    """THKGeneral, A-664, and HIWIN2017, fig. 2.1: three lines; the first is that of the worked example."""
    assert CHART_LINES == (0.003, 0.005, 0.01)
    assert CHART_LINES[0] == CHART_FRICTION


def test_the_example_of_hiwin():
    """41.4 mm, 4.4°, 0.286°: η 0.938 and η_b 0.934, so K_p is 0.132."""
    subject = Subject(0.040, 0.0414, math.pi * 0.0414 * math.tan(math.radians(4.4)), axial_load=1000.0)
    found = of("hiwin", subject)
    assert found.efficiency(subject.ideal_torque) == pytest.approx(0.938, abs=1e-3)
    braced = of("hiwin", subject._replace(preload=1000.0))
    assert braced.drag_torque / subject.ideal_torque == pytest.approx(1 / 0.938 - 0.934, abs=2e-3)
    assert braced.screw_torque == pytest.approx(found.screw_torque + braced.drag_torque, rel=1e-12)


def test_the_middle_of_rexroths_bands():
    """40x10x6-6 at 10 %: 0.87 to 1.44 N m; 40x40x6-3 with oversize balls at 5 %: 0.56 to 0.93 N m."""
    assert of("rexroth", Subject(0.040, 0.040, 0.010, preload=7210.0)).drag_torque == pytest.approx(1.155, abs=5e-3)
    oversize = Subject(0.040, 0.040, 0.040, preload=1850.0, oversize_balls=True)
    assert of("rexroth", oversize).drag_torque == pytest.approx(0.745, abs=6e-3)


def test_one_nut_by_all_makers():
    """BNFN4010-5 by hand: a lead angle of tan φ = 10/(π 41.75), HIWIN's plane of 0.286°, Rexroth's 0.004 F_pr d_0."""
    tangent = 10 / (math.pi * 41.75)
    phi, rho = math.atan(tangent), math.radians(0.286)
    drive, back = tangent / math.tan(phi + rho), math.tan(phi - rho) / tangent
    lever = 3000 * 0.010 / (2 * math.pi)
    found = drags(BNFN4010)
    assert found == {
        "jis": pytest.approx(0.05 / math.sqrt(tangent) * lever, rel=1e-12),
        "rexroth": pytest.approx(0.004 * 3000 * 0.040, rel=1e-12),
        "hiwin": pytest.approx((1 / drive - back) * lever, rel=1e-12),
    }
    assert found["jis"] == pytest.approx(0.865, abs=5e-4)  # as THK prints it, A-689
    assert all(math.isnan(one) for one in drags(BNFN4010._replace(preload=0.0)).values())


@pytest.mark.parametrize(
    ("make", "name"),
    [("THK", "jis"), ("Bosch Rexroth AG", "rexroth"), ("hiwin", "hiwin"), ("Kuroda", None), ("", None)],
)
def test_the_rule_of_a_make(make, name):
    found = rule_of(make)
    assert (None if found is None else found.name) == name


def test_every_drag_has_a_maker():
    assert {name for name, rule in RULES.items() if rule.maker} == set(DRAG_RULES)
    assert all(rule.label.startswith(rule.maker) for rule in RULES.values())


def test_a_rule_without_an_answer_gives_none():
    loaded = BNFN4010._replace(preload=0.0, axial_load=1000.0)
    for name in DRAG_RULES:
        assert math.isnan(of(name, loaded).drag_torque)
    assert {name for name in RULES if math.isnan(of(name, loaded).screw_torque)} == {"jis", "rexroth"}
    assert math.isnan(of("thk", BNFN4010).efficiency(BNFN4010.ideal_torque))


def test_every_rule_says_where_it_is_from():
    for name, rule in RULES.items():
        assert rule.name == name
        assert all((rule.title, rule.formula, rule.source, rule.checked, rule.range))
