"""Places, extremes and verdicts of an axis over its stroke, by its springs and its limits."""

import json
import math
import tomllib

import numpy as np
import pytest

from ballscrew.axis.supports.stiffness import stiffness_over_stroke
from ballscrew.basis import units
from ballscrew.basis.errors import InputError
from ballscrew.basis.output.sheet import Columns, Table
from ballscrew.cases.case_files import case_file
from ballscrew.physics.sizing.installation import Ends
from ballscrew.questions.axis.answer import SERIES, SPEED, chain_of, sheet
from ballscrew.questions.check.answer import checked
from ballscrew.questions.duty.compute import duty
from ballscrew.questions.duty.sheet import sheet as duty_sheet
from ballscrew.questions.duty.verdicts import warnings as duty_warnings
from support.axis_cases import load
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "feed_axis.toml"


def changed(*settings, **sections):
    """The example with other sections; those that are None are left out."""
    tables = case_file.override(case_file.read(EXAMPLE), settings)
    kept = {name: value for name, value in (tables | sections).items() if value is not None}
    return case_file.build(kept, moves=True)


@pytest.fixture(scope="module")
def case():
    return load(EXAMPLE, [])


@pytest.fixture(scope="module")
def report(case):
    return chain_of(case)


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


def test_it_is_the_chain_of_the_parts(case):
    report = chain_of(case)
    fixed = case.bearings["fixed"]
    expected = stiffness_over_stroke(
        case.screw,
        installation=case.installation,
        positions=report.chain.position,
        root_diameter=case.origins.listed.get("root_diameter"),
        **case.sizes_of_nut(case.screw),
    )
    np.testing.assert_allclose(report.chain.total, expected.total, rtol=1e-12)
    assert np.all(report.chain.bearings == fixed.rigidity)
    assert report.travel == pytest.approx((0.25, 0.85))
    assert report.softest == int(np.argmin(np.abs(report.chain.position - 0.85)))
    assert report.guide_friction == pytest.approx(0.003 * 500 * 9.80665 + 4 * 3.0)
    np.testing.assert_allclose(report.series["lost_motion"], 2 * report.guide_friction / expected.total)
    assert report.largest_speed == pytest.approx(2 * np.pi * 0.5 / 0.01)
    loads = case.axis.loads(case.motion.states()).total
    assert report.largest_load == pytest.approx(np.max(np.abs(loads)))


def test_a_mount_in_series():
    report = chain_of(load(EXAMPLE, ['installation.mount_rigidity="400 N/um"']))
    bare = chain_of(load(EXAMPLE, []))
    np.testing.assert_allclose(1 / report.chain.total, 1 / bare.chain.total + 1 / 400e6, rtol=1e-12)
    assert "mount rigid" not in " ".join(report.assumed)


def test_places_that_are_asked_for(ballscrew):
    process = ballscrew("axis", EXAMPLE, "--at", "20 cm", "--at", "1 m", "--json")
    found = json.loads(process.stdout)["results"]
    assert found["position"] == pytest.approx([0.2, 1.0])


def test_without_a_motion_it_is_the_operating_point():
    plain = load(
        ROOT / "examples" / "catalogue_screw.toml",
        ['installation.unsupported_length="1.1 m"', 'installation.ends="fixed-fixed"'],
    )
    found = chain_of(plain)
    assert not found.travel_is_known
    assert found.travel == pytest.approx((0.055, 1.045))
    assert found.largest_load == abs(plain.operation.axial_load)
    assert found.chain.installation.ends is Ends.FIXED_FIXED
    assert np.isnan(found.series["lost_motion"]).all()
    assert "no lost motion" in " ".join(found.assumed)


def test_a_bearing_of_known_balls_has_their_rigidity():
    text = EXAMPLE.read_text(encoding="utf-8").replace('rigidity = "800 N/um"', "#")
    case = case_file.build(tomllib.loads(text), moves=True)
    report = chain_of(case)
    balls = case.bearings["fixed"].element.rigidity(report.largest_load)
    np.testing.assert_allclose(report.chain.bearings, balls, rtol=1e-12)
    assert "rigidity of the fixed bearing of balls and races, its rings rigid" in report.assumed


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        (['installation.bearing_rigidity="1 N/um"'], "installation.bearing_rigidity: is given beside that of the bear"),
        (['surroundings.first_position="900 mm"'], "motion: does not fit between the bearings"),
    ],
)
def test_what_is_refused(settings, said):
    with pytest.raises(InputError) as refused:
        chain_of(load(EXAMPLE, settings))
    assert said in str(refused.value)


def test_a_nut_without_preload_and_load_has_no_rigidity():
    mounted = '[installation]\nunsupported_length = "1 m"\nends = "fixed-free"\n'
    tables = tomllib.loads(EXAMPLE.read_text(encoding="utf-8").partition("[axis]")[0] + mounted)
    tables["nut"], tables["operation"]["axial_load"] = {"type": "single"}, "0 N"
    report = chain_of(case_file.build(tables))
    assert np.isnan(report.chain.total).all()
    assert report.verdicts[0].text.startswith("rigidity not known")


def test_a_row_that_is_pulled_off_is_said_in_the_duty():
    settings = ["bearings.fixed.rows=1", 'bearings.fixed.preload="0 N"']
    records = {(r.id, r.subject): r for r in duty_warnings(duty(load(EXAMPLE, settings)))}
    found = records["validity.direction", "fixed_bearing"]
    assert 0 < found.value < 1
    assert found.text.startswith("fixed bearing: one row carries no load")
    assert ("validity.direction", "fixed_bearing") not in {
        (r.id, r.subject) for r in duty_warnings(duty(load(EXAMPLE, [])))
    }


def test_the_table_of_the_heat_is_all_that_is_lost(case):
    report = duty(case)
    (heat,) = (block for block in duty_sheet(report).of_kind(Columns) if block.name == "heat")
    assert [column.name for column in heat.columns] == ["element", "mechanism", "energy in a cycle", "mean heat"]
    assert sum(heat.columns[2].values) == pytest.approx(report.numbers["energy_lost"], rel=1e-9)
    assert sum(heat.columns[3].values) == pytest.approx(sum(report.duty.heat.values()), rel=1e-9)


def test_what_no_bearing_has_is_said():
    found = duty_warnings(duty(load(EXAMPLE, ['bearings.floating.torque="300 N m"', 'guides.seal_force="5 kN"'])))
    assert {"bearings.floating.torque", "guides.seal_force"} <= {record.subject for record in found}
