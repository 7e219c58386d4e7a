"""Truth: whose calibrations a band draws, what is left of it when a cause is known, and laws outside the validity."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.cases.case_files import case_file
from ballscrew.engine.uncertainty.bands import _without  # of a linear model, which no screw is
from ballscrew.physics.components.nut import Nut
from ballscrew.questions.band import BandOptions, answer, compute
from support.own_screws import SCREW as OWN

DOUBLE = {"type": "double", "preload": "3 kN"}
OVERSIZE = {"type": "oversize-balls", "preload": "3 kN"}


def case(screw=OWN, nut=DOUBLE, **sections):
    tables = {
        "screw": screw,
        "nut": nut,
        "lubricant": {"grade": "ISO VG 100", "temperature": "25 degC"},
        "operation": {"axial_load": "0 N", "screw_speed": "100 rpm"},
    }
    return case_file.build({**tables, **sections})


def drawn(found):
    return [candidate.name for candidate in compute.of_makers(found)]


@pytest.mark.slow
def test_whose_calibrations_are_drawn():
    """All of them where no make is known, that of the make where it is, none where nothing could be calibrated."""
    assert drawn(case()) == ["rexroth-2006-rubbing", "hiwin", "jis"]
    assert drawn(case({"catalogue": "rexroth-40x10x6-6-double"})) == ["rexroth-2006-rubbing"]
    assert drawn(case(nut=OVERSIZE)) == ["rexroth-2006-rubbing"]  # the others are of two contacts
    assert drawn(case(nut={**DOUBLE, "spacer_balls": True})) == drawn(case(nut={"type": "single"})) == []
    assert drawn(case(model={"calibration": "hiwin"})) == drawn(case(model={"name": "corrected"}, nut=DOUBLE)) == []
    imposed = {"ball_force": "imposed", "ball_to_ball_force": "0.02 N"}
    for told in (imposed, {"ball_force": {"law": "proportional", "share_of_load": 0.01}}):
        assert drawn(case(model=told)) == []


def constant_friction(conditions):
    return 0.1 + 0.0 * conditions.film_parameter


@pytest.mark.slow
def test_a_friction_law_of_ones_own_has_a_band_without_makers():
    found = case()
    own = dataclasses.replace(found, model=dataclasses.replace(found.model, friction=constant_friction))
    assert drawn(own) == []
    assert isinstance(own.screw.nut, Nut)
    report = compute.band(own, BandOptions(samples=16))
    assert np.isfinite(report.band["screw_torque"].median)


def test_what_is_left_without_a_cause_of_known_share():
    """ln y = 3 a + b of independent normal a, b: without a the interval of 95 % is that of b, exp(± 1.96)."""
    random = np.random.default_rng(1)
    a, b = random.standard_normal((2, 2**16))
    values = np.exp(3 * a + b)
    low, high = _without(np.exp(a), values, 32, 0.95)  # by its rank, so that any increasing function is the same
    # a class of a at the rim is wide: its own spread is left, which widens the interval by a few per cent
    assert np.log(high) == pytest.approx(1.96, rel=0.08)
    assert np.log(low) == pytest.approx(-1.96, rel=0.08)
    unmoved = _without(random.standard_normal(2**16), values, 32, 0.95)
    assert np.log(unmoved) == pytest.approx(np.array([-1.96, 1.96]) * np.sqrt(10), rel=0.05)


@pytest.mark.slow
def test_the_cause_named_is_the_one_that_varies():
    """Of two inputs, one a hundred times as uncertain; and nothing is named of a few samples."""
    told = {"ball_force": {"law": "proportional", "share_of_load": 0.0076}}  # so that no maker is drawn
    found = case(model={"friction": {"law": "run-in", "boundary_friction_coefficient": "0.12 ± 0.06"}, **told})
    uncertain = {**found.origins.uncertain, "preload": bs.Normal(3000.0, 3.0)}
    found = dataclasses.replace(found, origins=dataclasses.replace(found.origins, uncertain=uncertain))
    report = compute.band(found, BandOptions(samples=1024, only_given=True))
    assert report.band.narrowing is not None
    assert report.band.narrowing.name == "friction.boundary_friction_coefficient"
    few = compute.band(found, BandOptions(samples=64, only_given=True))
    assert few.band.narrowing is None


@pytest.mark.slow
@pytest.mark.parametrize("celsius", [-10, 0, 40])
def test_a_band_in_the_cold_holds_both_tracks(celsius):
    """Where the model is outside its validity the other track is, too: it is drawn all the same."""
    found = case(lubricant={"grade": "ISO VG 100", "temperature": f"{celsius} degC"})
    report = compute.band(found, BandOptions(samples=256))
    assert "inlet" in report.band.alternatives
    both, given = report.band["screw_torque"].both, report.band["screw_torque"].value
    at = {"axial_load": found.operation.axial_load, "screw_speed": found.operation.screw_speed}
    flooded = float(found.model.in_full_bath(found.screw, found.lubricant, **at).screw_torque)
    assert both.low < given < both.high
    assert both.low < flooded < both.high
    said = {record.id: record for record in answer.verdicts(found, report)}
    assert ("band.flooded" in said) == (flooded > 1.1 * given)
