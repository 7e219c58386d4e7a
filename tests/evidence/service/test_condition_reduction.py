"""Means of a test that are known more and less well: by inverse variances, computed by hand."""

import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.service.condition_means import Means
from ballscrew.evidence.service.condition_values import reduced
from support.service_logs import OIL, RPM, SCREW, WARM

TESTS = 6
#: Measured over computed torque at two speeds, and how well each mean is known.
FACTORS, DEVIATIONS = np.array([1.10, 0.95]), np.array([0.01, 0.03])
SPEEDS = RPM * np.array([100.0, 400.0])


def means(factors):
    """Tests at two speeds; ``factors`` by test and speed."""
    there = bs.FrictionModel.olaru2005()(SCREW, OIL.at(WARM), axial_load=0.0, screw_speed=SPEEDS).screw_torque
    return Means(
        test=np.repeat(np.arange(TESTS), 2),
        screw_speed=np.tile(SPEEDS, TESTS),
        axial_load=np.zeros(2 * TESTS),
        temperature=np.full(2 * TESTS, WARM),
        torque=(there * factors).ravel(),
        deviation=np.tile(DEVIATIONS, TESTS),
        labels=[str(number) for number in range(TESTS)],
        times=np.arange(1.0, TESTS + 1),
        per="test",
    )


def reduction(factors):
    subject = Configuration(bs.FrictionModel.olaru2005(), SCREW, OIL)
    return reduced(subject, means(factors), 3, {}, None, WARM, 0)


def test_speeds_of_a_test_weigh_by_their_inverse_variances():
    weights = 1 / DEVIATIONS**2
    by_hand = math.exp(np.sum(weights * np.log(FACTORS)) / np.sum(weights))
    found = reduction(np.tile(FACTORS, (TESTS, 1)))
    assert found.factor == pytest.approx(by_hand, rel=1e-9)
    # by 1/σ it is another number, by more than any rounding
    assert abs(math.exp(np.sum(np.log(FACTORS) / DEVIATIONS) / np.sum(1 / DEVIATIONS)) / by_hand - 1) > 0.01
