"""Laws that every band obeys."""

import itertools
import math

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.uncertainty.bands import band
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Uniform

POINT = {"axial_load": 4000.0, "screw_speed": 60.0}
CENTRES = {"viscosity": 0.1, "screw_conformity": 0.515, "ball_diameter": 3.175e-3}
OUTPUTS = ["screw_torque", "efficiency", "holding_torque"]


@pytest.fixture
def of(model, seed_screw, seed_oil):
    def made(uncertain, **options):
        return band(
            model, seed_screw, seed_oil, distributions=uncertain, outputs=OUTPUTS, samples=512, **POINT, **options
        )

    return made


def normal(share):
    return {name: Normal(value, share * value) for name, value in CENTRES.items()}


def test_a_band_shrinks_to_the_value_with_its_deviations(of):
    """In proportion, to first order: ten times less deviation, ten times less width."""
    widths = []
    for share in (1e-3, 1e-4, 1e-5):
        found = of(normal(share))["screw_torque"]
        assert found.both.low < found.value < found.both.high
        widths.append(found.both.high - found.both.low)
    assert widths[0] / widths[1] == pytest.approx(10, rel=0.02)
    assert widths[1] / widths[2] == pytest.approx(10, rel=0.002)


def test_nothing_uncertain_is_no_width(of):
    found = of({})
    for output in found.outputs.values():
        assert output.both == output.parameters == output.model_form == (output.value, output.value)
        assert output.median == output.value
        assert math.isnan(output.share_of_parameters)


def test_a_band_widens_with_its_level(of):
    bands = [of(normal(0.005), level=level) for level in (0.5, 0.8, 0.95, 0.99)]
    for output in OUTPUTS:
        intervals = [found[output].both for found in bands]
        for inner, outer in itertools.pairwise(intervals):
            assert outer.low < inner.low
            assert inner.high < outer.high


def test_the_same_seed_is_the_same_band_and_another_is_near(of):
    inputs = normal(0.005)
    first, again, other = (of(inputs, seed=seed)["screw_torque"].both for seed in (1, 1, 2))
    assert first == pytest.approx(again, rel=1e-10)
    assert first != other
    assert other == pytest.approx(first, rel=0.01)


def test_the_median_of_what_rises_is_the_value_at_the_median(of, model, seed_screw, seed_oil):
    """One input, and an output that rises with it: quantiles go through the model, to one step of 512 samples."""
    found = of({"axial_load": LogNormal(4000.0, 1.2)})["screw_torque"]
    for share, end in ((0.025, found.both.low), (0.5, found.median), (0.975, found.both.high)):
        near = LogNormal(4000.0, 1.2).quantile(np.array([share - 2 / 512, share + 2 / 512]))
        below, above = model(seed_screw, seed_oil, axial_load=near, screw_speed=60.0).screw_torque
        assert below < end < above


def test_efficiency_and_holding_torque_follow_from_the_torque(of):
    found = of({"viscosity": Uniform(0.05, 0.2)}, keep_samples=True).samples
    ideal = found["holding_torque"] + found["screw_torque"]
    assert found["efficiency"] == pytest.approx(ideal / (ideal + found["screw_torque"]), rel=1e-12)
    assert np.ptp(ideal) == pytest.approx(0, abs=1e-12)


def test_samples_stay_within_the_bounds_of_their_quantity(of):
    found = of(
        {"screw_conformity": Normal(0.502, 0.01), "ball_friction_coefficient": Normal(0.0, 0.1)}, keep_samples=True
    )
    assert found.samples["screw_conformity"].min() > 0.5
    assert found.samples["ball_friction_coefficient"].min() >= 0


def test_one_input_after_another_adds_up(seed_screw, seed_oil):
    """Variances of independent small deviations add; checked on the squares of the widths."""
    one, other = ({name: distribution} for name, distribution in list(normal(1e-4).items())[:2])
    widths = []
    for inputs in (one, other, one | other):
        found = band(bs.FrictionModel.reference(), seed_screw, seed_oil, distributions=inputs, samples=2**14, **POINT)[
            "screw_torque"
        ].both
        widths.append(found.high - found.low)
    # a width of 2^14 random samples is known to 1.1 % (one error), a square to twice that
    assert widths[0] ** 2 + widths[1] ** 2 == pytest.approx(widths[2] ** 2, rel=0.05)
