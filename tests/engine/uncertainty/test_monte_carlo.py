"""Monte Carlo: closed forms where there are any, else the same samples evaluated by a sweep.

Bounds on what is random are five standard errors, from theory.
"""

import dataclasses
import itertools
import math
import tracemalloc

import numpy as np
import pytest
import xarray as xr
from scipy import stats

import ballscrew as bs
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Triangular, Uniform
from ballscrew.engine.uncertainty.monte_carlo import BLOCK, Statistics, monte_carlo, shares

ERRORS = 5
INPUTS = {
    "axial_load": Uniform(1000.0, 4000.0),
    "screw_speed": Triangular(10.0, 60.0, 100.0),
    "viscosity": LogNormal(0.1, 1.3),
    "screw_conformity": Uniform(0.51, 0.53),
    "ball_roughness": Normal(0.08e-6, 0.01e-6),
}
BY_ENGINE = [pytest.param("numpy"), pytest.param("compiled", marks=pytest.mark.compiles)]


@pytest.fixture(params=BY_ENGINE)
def engine(request):
    return request.param


@pytest.fixture
def sampled(seed_screw, seed_oil):
    """A run of the paper's model, or of another."""

    def run(model=None, **options):
        return monte_carlo(model or bs.FrictionModel.olaru2005(), seed_screw, seed_oil, **options)

    return run


def test_mean_and_deviation_of_a_linear_output(sampled, seed_screw, engine):
    """The contact load is F/(z sin α); the load is uniform, with deviation (high − low)/√12."""
    n = 300_000
    ds = sampled(
        distributions={"axial_load": Uniform(1000.0, 4000.0)},
        screw_speed=60.0,
        samples=n,
        seed=1,
        engine=engine,
        outputs=["contact_load"],
    )
    unit = 1 / (seed_screw.loaded_balls * math.sin(seed_screw.contact_angle))
    deviation = 3000 / math.sqrt(12) * unit
    assert abs(ds.contact_load_mean - 2500 * unit) < ERRORS * deviation / math.sqrt(n)
    # the variance of the variance of a uniform number is (9/5 − 1) σ⁴/n
    assert abs(ds.contact_load_standard_deviation / deviation - 1) < ERRORS * math.sqrt(0.8 / n) / 2
    assert 1000 * unit <= ds.contact_load_minimum < 1001 * unit
    assert 3999 * unit < ds.contact_load_maximum <= 4000 * unit
    assert ds.contact_load_missing_share == 0


def test_quantiles_of_a_log_normal_output(sampled, seed_screw, engine):
    """The contact load follows the load: median · factor^Φ⁻¹(q), with standard error σ √(q(1 − q)/n)/φ."""
    n, levels = 300_000, np.array([0.001, 0.025, 0.5, 0.9, 0.999])
    ds = sampled(
        distributions={"axial_load": LogNormal(2000.0, 1.2)},
        screw_speed=60.0,
        samples=n,
        seed=2,
        engine=engine,
        outputs=["contact_load"],
        quantiles=levels,
    )
    z = stats.norm.ppf(levels)
    expected = 2000 * 1.2**z / (seed_screw.loaded_balls * math.sin(seed_screw.contact_angle))
    error = math.log(1.2) * np.sqrt(levels * (1 - levels) / n) / stats.norm.pdf(z)
    assert np.all(np.abs(ds.contact_load_quantiles / expected - 1) < ERRORS * error)
    assert np.array_equal(ds["quantile"], levels)


def test_the_share_of_invalid_inputs(sampled, engine):
    """A groove with a conformity below one half is no groove: Φ(−1) of the samples."""
    n = 200_000
    ds = sampled(
        distributions={"screw_conformity": Normal(0.52, 0.02)},
        axial_load=4000.0,
        screw_speed=60.0,
        samples=n,
        outputs=["validity_inputs", "screw_torque"],
        engine=engine,
    )
    share = stats.norm.cdf(-1.0)
    error = math.sqrt(share * (1 - share) / n)
    assert abs(1 - ds.validity_inputs_share - share) < ERRORS * error
    assert ds.invalid_share >= 1 - ds.validity_inputs_share
    assert "valid_share" not in ds
    # k of the Hertz law is negative there, and has no root
    assert abs(ds.screw_torque_missing_share - share) < ERRORS * error


@pytest.mark.parametrize("samples", [1, 100, 20_000])
def test_the_same_samples_as_a_sweep(sampled, seed_screw, seed_oil, engine, samples):
    """Sample i of input j is the quantile of random number (i, j), and what is said of them is so."""
    seed, names, levels = 7, ["screw_torque", "nut_torque", "efficiency", "valid"], [0.0, 0.1, 0.5, 0.99, 1.0]
    ds = sampled(distributions=INPUTS, samples=samples, seed=seed, outputs=names, quantiles=levels, engine=engine)
    numbers = shares(slice(0, samples), len(INPUTS), seed)
    drawn = {name: one.quantile(u) for (name, one), u in zip(INPUTS.items(), numbers, strict=True)}
    points = {name: xr.DataArray(values, dims="sample") for name, values in drawn.items()}
    expected = bs.sweep(bs.FrictionModel.olaru2005(), seed_screw, seed_oil, outputs=names, engine="numpy", **points)
    for name in names[:-1]:
        values = expected[name].to_numpy()
        size = np.abs(values).max()
        assert ds[f"{name}_mean"] == pytest.approx(values.mean(), abs=1e-12 * size)
        assert ds[f"{name}_minimum"] == pytest.approx(values.min(), abs=1e-12 * size)
        assert ds[f"{name}_maximum"] == pytest.approx(values.max(), abs=1e-12 * size)
        if samples > 1:
            assert ds[f"{name}_standard_deviation"] == pytest.approx(values.std(ddof=1), rel=1e-9)
        else:
            assert np.isnan(ds[f"{name}_standard_deviation"])
        found = ds[f"{name}_quantiles"].to_numpy()
        assert np.all(np.abs(found - np.quantile(values, levels)) <= 1e-12 * size)
    assert ds.invalid_share == 1 - expected.valid.to_numpy().mean()


@pytest.mark.slow
def test_any_number_of_threads(sampled, engine):
    """The same bits; the last block is not full."""
    options = {"distributions": INPUTS, "samples": 3 * BLOCK + 9999, "seed": 3, "engine": engine}
    one, two, three = (sampled(**options, threads=threads) for threads in (1, 2, 3))
    assert one.identical(two)
    assert one.identical(three)
    assert not one.equals(sampled(**options | {"seed": 4}))


def test_the_mean_and_the_spread_of_the_shares():
    """1/2 and 1/12, to five standard errors: √(1/12n) and √(1/180n)."""
    count = 3 * BLOCK + 5000
    drawn = [shares(slice(start, min(start + BLOCK, count)), 3, 4) for start in range(0, count, BLOCK)]
    for numbers in np.concatenate(drawn, axis=1):
        assert abs(numbers.mean() - 1 / 2) < ERRORS * (1 / (12 * count)) ** 0.5
        assert abs(((numbers - 0.5) ** 2).mean() - 1 / 12) < ERRORS * (1 / (180 * count)) ** 0.5


def test_shares_do_not_follow_each_other():
    """The correlation of independent numbers is 0, with standard error 1/√n: of inputs, blocks, seeds, neighbours."""
    count = BLOCK
    first, second = shares(slice(0, count), 2, 5)
    (later,) = shares(slice(BLOCK, BLOCK + count), 1, 5)
    (other,) = shares(slice(0, count), 1, 6)
    for one, two in ((first, second), (first, later), (first, other), (first[1:], first[:-1])):
        assert abs(np.corrcoef(one, two)[0, 1]) < ERRORS / math.sqrt(count)


def test_shares_of_a_sample_are_its_own():
    """They do not depend on how many samples are drawn."""
    assert np.array_equal(shares(slice(BLOCK, BLOCK + 10), 5, 1), shares(slice(BLOCK, 2 * BLOCK), 5, 1)[:, :10])


def test_the_ends_of_the_shares_are_excluded(monkeypatch):
    """NumPy's numbers begin at zero, of which no quantile is finite."""

    class Zeros:
        def __init__(self, _):
            pass

        def random(self, shape):
            return np.zeros(shape)

    monkeypatch.setattr(np.random, "Generator", Zeros)
    assert np.all(np.isfinite(Normal(0.0, 1.0).quantile(shares(slice(0, 4), 2, 0))))


def test_infinite_and_missing_results():
    """As NumPy has them; a deviation of infinities is no number, and neither is one of a single value."""
    inf, nan = math.inf, math.nan
    for values, expected in (
        ([1.0, inf, nan, 3.0], [inf, nan, 1, inf, 3, 0.25]),
        ([-inf, inf], [nan, nan, -inf, inf, inf, 0]),
        ([nan, nan], [nan, nan, nan, nan, nan, 1]),
        ([0.1, 0.1, 0.1], [0.1, 0, 0.1, 0.1, 0.1, 0]),
        ([2.0], [2, nan, 2, 2, 2, 0]),
    ):
        found = Statistics.of(np.array(values), [0.5])
        assert [float(np.squeeze(one)) for one in found] == pytest.approx(expected, rel=0, abs=0, nan_ok=True)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("engine", "samples"), [("numpy", 10**6), pytest.param("compiled", 4 * 10**6, marks=pytest.mark.compiles)]
)
def test_memory_is_that_of_the_results(sampled, engine, samples):
    """Two outputs of 8 B, what is valid, and while one is sorted a copy of it; and some buffers for each thread."""
    options = {"distributions": INPUTS, "engine": engine, "threads": 2, "outputs": ["screw_torque", "efficiency"]}
    sampled(**options, samples=1000)  # what is made once
    tracemalloc.start()
    try:
        before = tracemalloc.get_traced_memory()[0]
        sampled(**options, samples=samples)
        peak = tracemalloc.get_traced_memory()[1] - before
    finally:
        tracemalloc.stop()
    assert peak < 40 * samples + 60e6


def test_outputs_of_every_kind(sampled, engine):
    """Truth alone, what is the same everywhere, and coefficients of laws as inputs."""
    ds = sampled(
        distributions={"friction.boundary_friction_coefficient": Uniform(0.1, 0.2)},
        axial_load=4000.0,
        screw_speed=60.0,
        samples=10_000,
        outputs=["contact_load", "valid"],
        engine=engine,
    )
    assert ds.contact_load_standard_deviation == 0
    assert ds.contact_load_mean == ds.contact_load_minimum == ds.contact_load_maximum
    assert np.all(ds.contact_load_quantiles == ds.contact_load_mean)
    assert list(sampled(distributions=INPUTS, samples=10, outputs="valid", engine=engine)) == ["invalid_share"]


def test_what_the_dataset_says(sampled, seed_screw):
    ds = sampled(distributions=INPUTS, samples=1000, seed=5, outputs=["screw_torque"], lead=0.010)
    of_mean = ds.screw_torque_mean.attrs
    assert of_mean["units"] == "N m"
    assert of_mean["long_name"].startswith("mean of ")
    assert of_mean["cell_methods"] == "realization: mean"
    assert ds.screw_torque_missing_share.attrs["units"] == "1"
    assert ds.lead == 0.010
    assert ds.lead.attrs["units"] == "m"
    assert ds.attrs["samples"] == 1000
    assert ds.attrs["seed"] == 5
    assert bs.__version__ in ds.attrs["source"]
    assert "olaru2005" in ds.attrs["source"]
    assert ds.attrs["distribution_operation_axial_load"] == "uniform from 1000.0 N to 4000.0 N"
    assert ds.attrs["distribution_lubricant_viscosity"] == "log-normal, median 0.1 Pa s, factor 1.3"
    assert ds.attrs["screw_loaded_balls"] == seed_screw.loaded_balls
    assert "screw_lead" not in ds.attrs
    assert "lubricant_viscosity" not in ds.attrs


def test_progress_is_told(sampled):
    told = []
    samples = 2 * BLOCK + 5
    sampled(distributions=INPUTS, samples=samples, outputs=["ideal_torque"], done=lambda *now: told.append(now))
    assert told[-1] == (samples, samples)
    assert all(one <= other for (one, _), (other, _) in itertools.pairwise(told))


LOAD = {"axial_load": Uniform(1000.0, 4000.0)}


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"distributions": {}}, "monte_carlo.distributions: is empty"),
        ({"distributions": {"axial_lod": Uniform(1, 2)}}, 'axial_lod: unknown name · did you mean "axial_load"'),
        ({"distributions": LOAD}, "monte_carlo.screw_speed: missing · give screw_speed=…"),
        ({"distributions": {"axial_load": 3.0}}, r"axial_load: is no distribution \(3.0\) · one of Uniform, Normal"),
        ({"distributions": {"loaded_balls": Uniform(50, 60)}}, "loaded_balls: is a whole number"),
        ({"distributions": LOAD, "axial_load": 3.0}, "axial_load: is given as one number too"),
        ({"distributions": LOAD, "screw_speed": Uniform(1, 2)}, "screw_speed: is a distribution"),
        ({"distributions": LOAD, "screw_speed": [1.0, 2.0]}, "monte_carlo.screw_speed: must be one number"),
        ({"distributions": LOAD, "screw_speed": math.inf}, "operation.screw_speed: must be a finite number"),
        ({"distributions": {"viscosity": Uniform(-1, 2)}, "axial_load": 1.0}, "screw_speed: missing"),
        ({"distributions": LOAD | {"viscosity": Uniform(-1, 2)}, "screw_speed": 1.0}, "viscosity: must be positive"),
        ({"distributions": LOAD | {"viscosity": Normal(-1, 2)}, "screw_speed": 1.0}, "viscosity: must be positive"),
        (
            {"distributions": LOAD, "screw_speed": 1.0, "samples": 0},
            r"samples: must be a whole number, 1 or more \(0\)",
        ),
        ({"distributions": LOAD, "screw_speed": 1.0, "samples": 1e6}, "samples: must be a whole number"),
        ({"distributions": LOAD, "screw_speed": 1.0, "threads": 0}, "threads: must be a whole number, 1 or more"),
        ({"distributions": LOAD, "screw_speed": 1.0, "seed": -1}, "seed: must be a whole number from 0"),
        ({"distributions": LOAD, "screw_speed": 1.0, "quantiles": [5]}, r"quantiles: must lie between 0 and 1 \(5\)"),
        ({"distributions": LOAD, "screw_speed": 1.0, "engine": "steam"}, "monte_carlo.engine: unknown engine"),
        ({"distributions": LOAD, "screw_speed": 1.0, "outputs": ["torque"]}, "monte_carlo.outputs: unknown output"),
    ],
)
def test_bad_input(sampled, options, message):
    with pytest.raises(bs.InputError, match=message):
        sampled(**{"samples": 10, **options})


def test_fields_that_are_arrays_already(seed_screw, seed_oil):
    screw = dataclasses.replace(seed_screw, lead=np.array([0.005, 0.010]))
    with pytest.raises(bs.InputError, match=r"screw\.lead: is an array · give one number"):
        monte_carlo(bs.FrictionModel.olaru2005(), screw, seed_oil, distributions=LOAD, samples=10, screw_speed=1.0)
