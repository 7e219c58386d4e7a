"""Places, extremes and verdicts of an axis over its stroke, by its springs and its limits."""

import math

import numpy as np
import pytest

from ballscrew.basis import units
from ballscrew.basis.output.sheet import Table
from ballscrew.cases.case_files import case_file
from ballscrew.questions.axis.answer import SERIES, SPEED, chain_of, sheet
from ballscrew.questions.check.answer import checked
from support.axis_cases import load
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "feed_axis.toml"


def changed(*settings, **sections):
    """The example with other sections; those that are None are left out."""
    tables = case_file.override(case_file.read(EXAMPLE), settings)
    kept = {name: value for name, value in (tables | sections).items() if value is not None}
    return case_file.build(kept, moves=True)


@pytest.fixture(scope="module")
def report():
    return chain_of(load(EXAMPLE, []))


def test_friction_of_guides_however_small_makes_lost_motion():
    """Twice the force over the rigidity; none that is known makes none that is known."""
    guided = chain_of(changed("axis.guide_seal_force=0.5 N", guides=None))
    assert guided.guide_friction == 0.5
    assert guided.series["lost_motion"] == pytest.approx(2 * 0.5 / guided.chain.total, rel=1e-12)
    bare = chain_of(changed(guides=None))
    assert math.isnan(bare.guide_friction)
    assert np.isnan(bare.series["lost_motion"]).all()


@pytest.mark.parametrize(
    ("nut", "words"),
    [
        ({"type": "single"}, "backlash comes on top"),
        ({"type": "double", "preload": "3 kN"}, "the preloaded nut has no backlash"),
    ],
)
def test_only_a_nut_without_preload_has_backlash(nut, words):
    places = next(iter(sheet(chain_of(changed(nut=nut))).of_kind(Table)))
    assert places.notes[0].endswith(f"of the guides; {words}.")


def test_extremes_are_those_of_the_travel(report):
    """The ends of the shaft count for none of them: the nut does not come there."""
    inside = (report.chain.position >= report.travel[0] - 1e-9) & (report.chain.position <= report.travel[1] + 1e-9)
    assert not inside.all()
    for at, values in (
        (report.softest, report.chain.total), (report.lowest_critical_speed, report.chain.critical_speed),
        (report.least_buckling_load, report.chain.buckling_load),
    ):  # fmt: skip
        assert inside[at]
        assert values[at] == np.min(values[inside])
    asked = chain_of(report.case, [0.05, 0.2])
    assert asked.shown == [0, 1]
    assert asked.chain.position[asked.softest] == asked.chain.position[np.argmin(asked.chain.total)]


def test_verdicts_by_their_limits(report):
    rigid, speed, buckling = report.verdicts
    at = report.softest
    assert rigid.value == report.chain.total[at]
    springs = {name: 1 / spring[at] for name, spring in report.chain.parts.items()}
    most = max(springs, key=springs.get)
    assert f"{100 * springs[most] / sum(springs.values()):.2g} % of the compliance is that of the {most}" in rigid.text
    critical = float(np.min(report.chain.critical_speed[report.lowest_critical_speed]))
    assert speed.limit == pytest.approx(report.case.limits.critical_speed_share * critical, rel=1e-12)
    assert speed.value == pytest.approx(2 * np.pi * 0.5 / 0.01, rel=1e-12)  # 30 m/min with a lead of 10 mm
    assert speed.holds is bool(speed.value <= speed.limit)
    least = float(report.chain.buckling_load[report.least_buckling_load])
    assert buckling.limit == pytest.approx(least / report.case.limits.buckling_safety, rel=1e-12)
    assert (buckling.value, buckling.holds) == (report.largest_load, bool(buckling.value <= buckling.limit))


def test_a_shaft_that_is_too_long_does_not_hold():
    found = chain_of(changed("surroundings.shaft_length=4 m", "installation.unsupported_length=4 m"))
    _, speed, _ = found.verdicts
    assert (speed.holds, speed.severity) == (False, "warning")
    assert speed.value > speed.limit


def test_the_travel_is_in_the_middle_unless_it_is_told_where_it_begins():
    stroke = 0.6
    found = chain_of(changed(surroundings=None))
    length = found.chain.installation.unsupported_length
    assert found.travel == pytest.approx(((length - stroke) / 2, (length + stroke) / 2), rel=1e-12)
    assert any("travels in the middle" in str(line) for line in found.assumed)
    told = chain_of(changed("surroundings.first_position=100 mm"))
    assert told.travel == pytest.approx((0.1, 0.7), rel=1e-12)
    assert not any("travels in the middle" in str(line) for line in told.assumed)


def test_the_coarse_answers_beside_the_fine_ones_are_those_of_the_checks():
    """One length for both questions; without the nut as a support it is what ``check`` judges."""
    case = load(EXAMPLE, ["surroundings.shaft_length=1.3 m"])
    whirling, buckling = (one.text for one in chain_of(case).verdicts[1:])
    judged, limits = checked("", case), case.limits
    speed = judged.check("critical_speed").limit / limits.critical_speed_share
    force = judged.check("buckling").limit * limits.buckling_safety
    assert f"; {units.shown(speed, SPEED)} is critical without it, as in the checks" in whirling
    assert f", {units.shown(force, SERIES['buckling_load'])} without it as in the checks" in buckling
