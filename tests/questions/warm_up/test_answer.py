"""The answer of warming up: declared once, and the same on every face."""

import dataclasses
from types import SimpleNamespace

import numpy as np
import pytest

from ballscrew.basis.output.sheet import Chart
from ballscrew.cases.case_files import case_file
from ballscrew.questions.warm_up import compute, verdicts
from ballscrew.questions.warm_up.compute import warmed_up
from ballscrew.questions.warm_up.self_heating import self_heating
from ballscrew.questions.warm_up.sheet import sheet
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "warm_up.toml"
WARM, COLD = ["surroundings.ambient=45 degC"], ["surroundings.ambient=-5 degC", "lubricant.temperature=-5 degC"]


@pytest.fixture(scope="module")
def report():
    return warmed_up(case_file.load(EXAMPLE, [], moves=True), hours=1.0, cool_down=1.0)


@pytest.mark.slow
@pytest.mark.parametrize(("settings", "starved"), [(WARM, False), (COLD, True)], ids=["warm", "starved of oil"])
def test_a_full_bath_is_drawn_where_oil_comes_back_late(settings, starved):
    charts = sheet(warmed_up(case_file.load(EXAMPLE, settings, moves=True), hours=0.5)).of_kind(Chart)
    curves = {mark.name for chart in charts for mark in chart.marks}
    assert ("in a full bath of oil" in curves) == starved


def test_self_heating_has_units():
    heating = self_heating(case_file.load(EXAMPLE, [], moves=True))
    found = heating.within({"verdicts": []})
    assert found["results"]["self_heating"]["oil_temperature"] == heating.equilibrium.oil_temperature
    assert found["results"]["self_heating"].keys() == found["units"]["self_heating"].keys()
    assert found["units"]["self_heating"]["flooded_torque_given"] == "N m"


@pytest.mark.parametrize(
    ("steady", "known", "said"),
    [(1.0, 1.0, None), (0.75, 1.0, "25 % of 64 samples"), (1.0, 0.5, "50 % leave it"), (0.75, 0.5, "50 % leave it")],
)
def test_samples_that_are_lost_are_said(steady, known, said):
    central = SimpleNamespace(network=SimpleNamespace(by_bracing={}))
    bands = SimpleNamespace(warm_up=central, steady_share=steady, known_share=np.array([1.0, known]), count=64)
    found = [record.text for record in verdicts.band_records(SimpleNamespace(bands=bands))]
    assert len(found) == (said is not None)
    assert all(said in text for text in found)


def test_sizes_that_are_given_are_not_assumed(report):
    """Each is named by what stands for it, unless the surroundings have it."""
    words = {
        "ball_conductance": "from nut to shaft", "shaft_convection": "from the shaft to the air", "nut_mass": "nut of ",
        "shaft_length": "shaft of ",
    }  # fmt: skip
    none = dataclasses.replace(report.surroundings, **dict.fromkeys(words))
    network = report.warm_up.network
    for given in (None, *words):
        has = none if given is None else dataclasses.replace(none, **{given: 1.0})
        said = [str(line) for line in compute.assumed_of(report.case, has, network, None)]
        for name, words_of_it in words.items():
            assert any(words_of_it in line for line in said) is (name != given), (given, name)


def test_a_short_shaft_has_its_compensation_in_quarters():
    """At steps of 50 mm it would have three places, and its end."""
    short = ["surroundings.shaft_length=120 mm", "surroundings.first_position=10 mm", "motion.stroke=20 mm"]
    report = warmed_up(case_file.load(EXAMPLE, [*short, "model.name=olaru2005"], moves=True), hours=0.1)
    assert report.compensation[0] == pytest.approx([0.0, 0.03, 0.06, 0.09, 0.12], rel=1e-12, abs=1e-15)


@pytest.mark.parametrize(("left_out", "length"), [("motion", 0.6), ("axis", 0.6), (None, 1.6)])
def test_the_shaft_is_twice_the_stroke_of_what_moves(left_out, length):
    """A motion without an axis, or an axis without a motion, moves nothing: the stroke of the surroundings counts."""
    tables = case_file.override(case_file.read(EXAMPLE), [])
    tables["surroundings"] = {"stroke": "0.3 m"}
    tables.pop(left_out, None)
    case = case_file.build(tables)
    assert compute.length_of(case, case.surroundings) == pytest.approx(length, rel=1e-12)


@pytest.mark.parametrize(
    ("preload", "words"),
    [
        ([1000, 1100, 1050], "the preload goes from 1000 N to 1100 N (+10 %) at work"),
        ([1000, 1100, 700], "the preload goes from 1000 N to 1100 N (+10 %) at work, and while it stands to "
         "700 N (-30 %): nut and shaft cool at their own rates"),
        ([1000, 0, 900], "the preload 1000 N is lost at work: the nut grows away from the shaft"),
    ],
)  # fmt: skip
def test_the_preload_at_work_and_while_the_axis_stands(preload, words):
    warm_up = SimpleNamespace(
        network=SimpleNamespace(preload_set=True),
        preload=np.array(preload, dtype=float),
        works=np.array([True, True, False]),
    )
    (record,) = verdicts._preload(SimpleNamespace(warm_up=warm_up))
    assert record.text == words
    assert record.holds == ("lost" not in words)
