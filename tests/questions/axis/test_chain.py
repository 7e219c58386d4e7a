"""``ballscrew axis``: what gives way between motor and table over the stroke, and what the shaft stands."""

import json
import tomllib

import numpy as np
import pytest

from ballscrew.axis.supports.stiffness import stiffness_over_stroke
from ballscrew.basis.errors import InputError
from ballscrew.basis.output.sheet import Columns
from ballscrew.cases.case_files import case_file
from ballscrew.physics.sizing.installation import Ends
from ballscrew.questions.axis.answer import chain_of
from ballscrew.questions.duty.compute import duty
from ballscrew.questions.duty.sheet import sheet
from ballscrew.questions.duty.verdicts import warnings
from support.axis_cases import load
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "feed_axis.toml"


@pytest.fixture(scope="module")
def case():
    return load(EXAMPLE, [])


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
    assert ballscrew("axis", EXAMPLE, "--at", "1.2 m").returncode == 2
    assert "must lie on the shaft" in ballscrew("axis", EXAMPLE, "--at", "1.2 m").stderr
    assert "--at: " in ballscrew("axis", EXAMPLE, "--at", "1 kg").stderr


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
    records = {(r.id, r.subject): r for r in warnings(duty(load(EXAMPLE, settings)))}
    found = records["validity.direction", "fixed_bearing"]
    assert 0 < found.value < 1
    assert found.text.startswith("fixed bearing: one row carries no load")
    assert ("validity.direction", "fixed_bearing") not in {(r.id, r.subject) for r in warnings(duty(load(EXAMPLE, [])))}


def test_the_table_of_the_heat_is_all_that_is_lost(case):
    report = duty(case)
    (heat,) = (block for block in sheet(report).of_kind(Columns) if block.name == "heat")
    assert [column.name for column in heat.columns] == ["element", "mechanism", "energy in a cycle", "mean heat"]
    assert sum(heat.columns[2].values) == pytest.approx(report.numbers["energy_lost"], rel=1e-9)
    assert sum(heat.columns[3].values) == pytest.approx(sum(report.duty.heat.values()), rel=1e-9)


def test_what_no_bearing_has_is_said():
    found = warnings(duty(load(EXAMPLE, ['bearings.floating.torque="300 N m"', 'guides.seal_force="5 kN"'])))
    assert {"bearings.floating.torque", "guides.seal_force"} <= {record.subject for record in found}
