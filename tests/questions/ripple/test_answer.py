"""The answer of a ripple: declared once, the numbers of the physics on every face, and faults as people write them."""

import dataclasses
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal
from ballscrew.physics.laws.ball_chain import ChainBallForce
from ballscrew.physics.laws.nut_losses import ReturnBraking
from ballscrew.physics.moving_balls.ripple import (
    FullCircuit,
    MissingBall,
    NutGroove,
    PreloadLeft,
    Spall,
    torque_ripple,
)
from ballscrew.questions.ripple import RippleOptions
from ballscrew.questions.ripple.answer import ALL, defects_of, document, given_of, ripple_of, sheet
from support.commands import ROOT

EXAMPLE = ROOT / "examples" / "service.toml"
#: One turn of balls in each half, so that a run is short.
SHORT = ["screw.loaded_balls=20", 'nut.preload="1.5 kN"']
OPTIONS = RippleOptions(return_balls=10, turns=6.0)


@pytest.fixture(scope="module")
def case():
    return case_file.load(EXAMPLE, SHORT)


@pytest.fixture(scope="module")
def report(case):
    return ripple_of(case, dataclasses.replace(OPTIONS, fault=["preload=35 %", "spall=2 mm x 2 um"], seeds=3))


@pytest.mark.slow
def test_the_numbers_are_those_of_the_physics(case, report):
    given = {"axial_load": 0.0, "screw_speed": float(case.operation.screw_speed), "gap": 0.55, "groove_deviation": 1e-6}
    usual, left = (
        torque_ripple(
            case.model, case.screw, case.lubricant, **given, seed=1, return_balls=10, turns=6.0, defect=defect
        )
        for defect in (None, PreloadLeft(0.35))
    )
    results = document(report)["results"]
    assert results["peak_to_peak"] == pytest.approx(float(np.ptp(usual.torque)), rel=1e-12)
    assert results["relative"] == pytest.approx(results["peak_to_peak"] / results["mean"], rel=1e-12)
    assert [one["name"] for one in results["orders"]] == [one.name for one in usual.orders]
    assert [one["order"] for one in results["orders"]] == pytest.approx([float(one.order) for one in usual.orders])
    fault = results["faults"][0]
    assert (fault["fault"], fault["mean"]) == ("preload=35 %", pytest.approx(left.mean, rel=1e-12))
    turns = np.array(results["torque"]["x"])
    assert np.ptp(turns) == pytest.approx(np.ptp(usual.angle) / (2 * math.pi), rel=1e-12)
    assert sum(results["parts"].values()) == pytest.approx(results["mean"], rel=1e-12)


@pytest.mark.slow
def test_a_range_is_that_of_nuts_of_other_seeds(case, report):
    others = [ripple_of(case, dataclasses.replace(OPTIONS, seed=seed)).ripple.peak_to_peak for seed in (1, 2, 3)]
    assert report.range.nuts == 3
    assert report.range.median == pytest.approx(sorted(others)[1], rel=1e-12)
    assert min(others) < report.range.low < report.range.high < max(others)
    assert document(report)["results"]["range"]["median"] == report.range.median
    alone = document(ripple_of(case, OPTIONS))["results"]
    assert (alone["range"], alone["faults"]) == (None, [])


def test_words_say_what_torque_shows(report):
    said = " ".join(terminal.text(sheet(report)).split())
    verdicts = {one["id"]: one for one in document(report)["verdicts"]}
    assert verdicts["ripple.preload"]["holds"] is True
    assert verdicts["ripple.spall"]["holds"] is False
    assert "preload=35 %: torque shows it" in said
    assert "spall=2 mm x 2 um: torque is a poor sensor of it" in said
    assert "ball pass" in said
    assert "no catalogue has them" in said


@pytest.mark.slow
def test_the_return_of_a_case_is_that_of_the_chain(case):
    law = ReturnBraking(return_balls=10, wall_factor=30.0)
    nut = dataclasses.replace(case.screw.nut, losses={"recirculation": law})
    given = dataclasses.replace(case, screw=dataclasses.replace(case.screw, nut=nut))
    found = ripple_of(given, RippleOptions(turns=6.0)).ripple.parts["return"]
    usual = ripple_of(case, OPTIONS).ripple.parts["return"]
    assert 2 * usual < found < 3 * usual  # the weight of the balls stays


def test_a_case_may_describe_its_circuits(case):
    law = ChainBallForce(gap=0.2, groove_deviation=2e-6, circuits=2.0, return_turns=0.3, wall_factor=20.0)
    described = dataclasses.replace(case, model=dataclasses.replace(case.model, ball_force=law))
    found = given_of(described, RippleOptions())
    expected = {"gap": 0.2, "groove_deviation": 2e-6, "circuits": 2, "wall_factor": 20.0, "return_balls": 7}
    assert {name: found[name] for name in expected} == expected  # a turn has 21 balls
    assert (
        given_of(described, RippleOptions(gap=0.4, return_balls=5)).items() >= {"gap": 0.4, "return_balls": 5}.items()
    )


# -- faults as people write them ------------------------------------------------------------------


def test_faults_by_what_was_written():
    found = defects_of(["missing-ball", "full", "spall=2 mm x 2 um", "spall = 0.5mm×3um", "preload=0.35", "groove=3"])
    assert list(found.values()) == [
        MissingBall(),
        FullCircuit(),
        Spall(2e-3, 2e-6),
        Spall(0.5e-3, 3e-6),
        PreloadLeft(0.35),
        NutGroove(3.0),
    ]
    assert defects_of(["preload=35 %"])["preload=35 %"].share == pytest.approx(0.35, rel=1e-14)
    assert set(defects_of(ALL)) == set(ALL)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("fault", "message"),
    [
        ("spal=2 mm x 2 um", "unknown fault"),
        ("full=3", "takes no number"),
        ("preload", "needs a number"),
        ("groove=much", "needs a number"),
        ("spall=2 mm", "needs a width and a depth"),
        ("spall=2 N x 2 um", "wrong unit"),
        ("preload=1.5", "must be a share of the preload"),
    ],
)
def test_a_wrong_fault_is_refused(case, fault, message):
    with pytest.raises(InputError, match=f"--fault: {message}"):
        ripple_of(case, dataclasses.replace(OPTIONS, fault=[fault]))


@pytest.mark.slow
def test_all_leaves_out_a_preload_that_is_not_there(case):
    single = dataclasses.replace(case.screw, nut=bs.SingleNut(angle_under_load=True))
    operation = dataclasses.replace(case.operation, axial_load=800.0)
    loaded = dataclasses.replace(case, screw=single, operation=operation)
    found = ripple_of(loaded, dataclasses.replace(OPTIONS, fault=["all"]))
    assert [name.partition("=")[0] for name in found.faults] == ["missing-ball", "full", "spall", "groove"]
    assert math.isnan(document(found)["results"]["displacement"])
    assert "moves against the screw" not in terminal.text(sheet(found))


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"gap": -0.1}, "--gap: must be positive"),
        ({"seeds": 0}, "--seeds: must be at least one"),
        ({"circuits": 0}, "--circuits: must be a whole number"),
        ({"relief": 0.0}, "--relief: must be positive"),
        ({"return_balls": -1}, "--return-balls: must be a whole number"),
        ({"turns": 0.0}, "--turns: must be positive"),
    ],
)
def test_faults_in_numbers_name_their_flags(case, changes, message):
    with pytest.raises(InputError, match=message):
        ripple_of(case, dataclasses.replace(OPTIONS, **changes))
