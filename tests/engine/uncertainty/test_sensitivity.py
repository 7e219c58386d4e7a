"""Sensitivity of the friction model: against SALib and SciPy, and what it says in odd cases."""

import dataclasses
import itertools
import math
import warnings

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.basis.errors import InputError
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty import sobol
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Triangular, Uniform
from ballscrew.engine.uncertainty.sensitivity import METHODS, sensitivity
from ballscrew.engine.uncertainty.sobol import sobol_indices
from ballscrew.physics.friction.model import (
    FrictionModel,
)
from effect_study.cases import CATALOGUE

#: The corrected model is recorded the faster; the reference model is for what people see.
MODEL, REFERENCE = FrictionModel.corrected(), FrictionModel.reference()
POINT = {"axial_load": CATALOGUE.axial_load, "screw_speed": CATALOGUE.screw_speed}
VISCOSITY = CATALOGUE.oil.viscosity
#: Each kind of distribution, and what SALib calls it.
UNCERTAIN = {
    "viscosity": LogNormal(VISCOSITY, 1.3),
    "friction.boundary_friction_coefficient": Uniform(0.08, 0.2),
    "screw_conformity": Normal(0.54, 0.005),
    "nut_roughness": Triangular(0.15e-6, 0.3e-6, 0.6e-6),
    "friction.full_film_friction_coefficient": Uniform(0.01, 0.05),
    "axial_load": Normal(5000.0, 500.0),
}
OF_SALIB = {
    "viscosity": ("lognorm", [math.log(VISCOSITY), math.log(1.3)]),
    "friction.boundary_friction_coefficient": ("unif", [0.08, 0.2]),
    "screw_conformity": ("norm", [0.54, 0.005]),
    "nut_roughness": ("triang", [0.15e-6, 0.6e-6, (0.3 - 0.15) / (0.6 - 0.15)]),
    "friction.full_film_friction_coefficient": ("unif", [0.01, 0.05]),
    "axial_load": ("norm", [5000.0, 500.0]),
}


def found_of(distributions=UNCERTAIN, **changes):
    options = {"model": MODEL, "screw": CATALOGUE.screw, "lubricant": CATALOGUE.oil, **POINT, **changes}
    return sensitivity(
        options.pop("model"), options.pop("screw"), options.pop("lubricant"), distributions=distributions, **options
    )


def wide(e):
    return (e.high - e.low) / 2


# -- a second opinion -----------------------------------------------------------------------------


@pytest.mark.parametrize("output", ["screw_torque", pytest.param("efficiency", marks=pytest.mark.long)])
def test_indices_agree_with_salib(output):
    """Its own samples, its own estimator and intervals; and the model itself in place of the engine."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of its own dependencies, none of which is ours to mend
        from SALib.analyze import sobol as analyze
        from SALib.sample import sobol as sample

        problem = {
            "num_vars": len(OF_SALIB),
            "names": list(OF_SALIB),
            "dists": [kind for kind, _ in OF_SALIB.values()],
            "bounds": [numbers for _, numbers in OF_SALIB.values()],
        }
        points = sample.sample(problem, 2**12, calc_second_order=False, seed=5)
        result = Configuration(REFERENCE, CATALOGUE.screw, CATALOGUE.oil).at(
            POINT | dict(zip(OF_SALIB, points.T, strict=True))
        )
        theirs = analyze.analyze(problem, getattr(result, output), calc_second_order=False, seed=5)
    ours = found_of(output=output, model=REFERENCE)
    for i, name in enumerate(OF_SALIB):
        for mine, value, half in (
            (ours.first_order[name], theirs["S1"][i], theirs["S1_conf"][i]),
            (ours.total[name], theirs["ST"][i], theirs["ST_conf"][i]),
        ):
            assert abs(mine.value - value) < math.hypot(wide(mine), half), name
            if mine.value < sobol.LARGE_INDEX or mine is ours.total[name]:  # the same estimators
                assert wide(mine) == pytest.approx(half, rel=0.3, abs=1e-4), name
    assert list(ours.inputs) == [list(OF_SALIB)[i] for i in np.argsort(-theirs["ST"])]


def product(shares):
    return shares[0] * (1 + shares[1]) + 0.2 * shares[2]


def test_bootstrap_is_as_wide_as_that_of_scipy():
    from scipy import stats

    shares = sobol.sobol_sequence(6, 256, 0)
    a, b = shares[:3], shares[3:]
    mixed = np.array([[product(np.where(np.arange(3)[:, None] == i, b, a))] for i in range(3)])
    values = {"f_A": product(a)[None], "f_B": product(b)[None], "f_AB": mixed}
    theirs = stats.sobol_indices(func=values, n=256)
    resampled = theirs.bootstrap()
    ours = sobol_indices(product, 3, 256)
    small = theirs.first_order < sobol.LARGE_INDEX
    assert list(small) == [False, True, True]
    for mine, value, spread, shared in (
        (ours.first_order, theirs.first_order, resampled.first_order, small),
        (ours.total, theirs.total_order, resampled.total_order, np.full(3, True)),
    ):
        assert np.array([e.value for e in mine])[shared] == pytest.approx(value[shared], rel=1e-12)
        # two bootstraps of 999 each tell a standard error to 3 %
        errors = np.array([wide(e) / 1.96 for e in mine])
        assert errors[shared] == pytest.approx(spread.standard_error[shared], rel=0.15)
    # of a large index the other estimator is the better one
    assert wide(ours.first_order[0]) / 1.96 < 0.8 * resampled.first_order.standard_error[0]


def test_samples_without_a_number_are_left_out():
    """By the estimators themselves, of the samples that are left."""
    lost = np.zeros(256, dtype=bool)
    lost[[3, 100, 101]] = True

    def function(shares):
        values = product(shares)
        if shares.shape[1] == 5 * 256:  # A, B, and A with each input of B
            values[2 * 256 : 3 * 256][lost] = np.nan
        return values

    found = sobol_indices(function, 3, 256)
    shares = sobol.sobol_sequence(6, 256, 0)[:, ~lost]
    a, b = shares[:3], shares[3:]
    middle = np.mean([product(a), product(b)])
    f_a, f_b = product(a) - middle, product(b) - middle
    for i, (first, total) in enumerate(zip(found.first_order, found.total, strict=True)):
        f_ab = product(np.where(np.arange(3)[:, None] == i, b, a)) - middle
        small, large = np.mean(f_b * (f_ab - f_a)), np.var([f_a, f_b]) - np.mean((f_b - f_ab) ** 2) / 2
        assert first.value == pytest.approx((large if i == 0 else small) / np.var([f_a, f_b]), rel=1e-9)
        assert total.value == pytest.approx(np.mean((f_a - f_ab) ** 2) / 2 / np.var([f_a, f_b]), rel=1e-9)
    assert found.left_out == 3
    assert sobol_indices(product, 3, 256).left_out == 0


def test_too_many_samples_without_a_number_are_a_fault():
    with pytest.raises(InputError, match=r"has no finite value \(50% of the samples\)"):
        sobol_indices(lambda shares: np.where(np.arange(shares.shape[1]) % 2, np.nan, shares[0]), 2, 64)


# -- what is found --------------------------------------------------------------------------------


@pytest.mark.parametrize("method", METHODS)
def test_all_methods_rank_the_same_inputs(method):
    found = found_of(method=method)
    assert set(found.inputs) == set(UNCERTAIN)
    for measure in found.measures.values():
        assert list(measure) == list(UNCERTAIN)
    leading = [abs(next(iter(found.measures.values()))[name].value) for name in found.inputs]
    assert leading == sorted(leading, reverse=True)
    assert found.inputs[-1] == "friction.full_film_friction_coefficient"
    assert found.quantity.unit == "N m"
    assert found.mean == pytest.approx(float(CATALOGUE.result(MODEL).screw_torque), rel=0.2)


def test_what_to_find_out():
    found = found_of()
    names = [known.inputs for known in found.explained_variance]
    assert all(longer[:-1] == shorter for shorter, longer in itertools.pairwise(names))
    by_first_order = sorted(UNCERTAIN, key=lambda name: -found.first_order[name].value)
    assert list(names[-1]) == by_first_order[: len(names[-1])]
    halved = found.to_halve
    before = found.explained_variance[len(halved.inputs) - 2]
    assert before.remaining > 0.5 >= halved.remaining
    # known indeed: these inputs at one value along each row, the others at many
    rng = np.random.default_rng(1)
    shape = {True: (200, 1), False: (200, 200)}
    drawn = {n: d.quantile(rng.random(shape[n in halved.inputs])) for n, d in UNCERTAIN.items()}
    torques = Configuration(MODEL, CATALOGUE.screw, CATALOGUE.oil).at(POINT | drawn).screw_torque
    assert math.sqrt(np.mean(np.var(torques, axis=1))) / np.std(torques) == pytest.approx(halved.remaining, abs=0.02)


def test_one_input_has_it_all():
    only = {"viscosity": UNCERTAIN["viscosity"]}
    for method in ("sobol", "local"):
        found = found_of(only, method=method)
        assert found.first_order["viscosity"] == pytest.approx((1, 1, 1))
        assert found.left_if_known("viscosity") == 0
        assert found.to_halve == (("viscosity",), 0)
    assert found_of(only, method="morris").inputs == ("viscosity",)


@pytest.mark.parametrize("method", METHODS)
def test_an_input_without_effect_has_none(method):
    found = found_of(
        {"viscosity": UNCERTAIN["viscosity"], "lead": Normal(0.01, 1e-5)}, method=method, output="ideal_torque"
    )
    assert found.inputs == ("lead", "viscosity")
    for measure in found.measures.values():
        assert measure["viscosity"] == (0, 0, 0)
    if method != "morris":
        assert [known.inputs for known in found.explained_variance] == [("lead",)]


@pytest.mark.parametrize("method", METHODS)
def test_a_constant_output_owes_nothing_to_any(method):
    found = found_of(
        {"viscosity": UNCERTAIN["viscosity"], "density": Uniform(800, 900)}, method=method, output="ideal_torque"
    )
    assert found.is_constant
    assert found.to_halve is None
    assert found.explained_variance == ()
    assert math.isnan(found.left_if_known("viscosity"))
    assert all(e.value == 0 for measure in found.measures.values() for e in measure.values())


def test_the_same_seed_gives_the_same_numbers():
    for method in ("sobol", "morris"):
        one, again, other = (found_of(method=method, samples=64, seed=seed) for seed in (1, 1, 2))
        assert one.measures == again.measures
        assert one.measures != other.measures
        assert one.explained_variance == again.explained_variance


def test_evaluations_are_told():
    told = []
    found = found_of(samples=64, done=lambda finished, total: told.append((finished, total)))
    assert sum(total for finished, total in told if finished == total) == found.evaluations
    assert found.evaluations == 64 * (len(UNCERTAIN) + 2 + len(found.explained_variance) - 1)
    assert found_of(samples=64, method="morris").evaluations == 64 * (len(UNCERTAIN) + 1)


@pytest.mark.parametrize(
    ("distribution", "deviation"),
    [
        (Normal(0.1, 0.002), 0.002),
        (Uniform(0.09, 0.11), 0.02 / math.sqrt(12)),
        (LogNormal(0.1, 1.5), 0.1 * math.exp(math.log(1.5) ** 2 / 2) * math.sqrt(math.expm1(math.log(1.5) ** 2))),
        (Triangular(0.08, 0.1, 0.13), math.sqrt((0.02**2 + 0.05**2 + 0.03**2) / 36)),
    ],
)
def test_local_effects_are_slopes_times_deviations(distribution, deviation):
    found = found_of({"viscosity": distribution}, method="local")
    median = float(distribution.quantile(0.5))
    slope = bs.derivatives(MODEL, CATALOGUE.screw, CATALOGUE.oil, by=["viscosity"], viscosity=median, **POINT)
    expected = float(slope["d_screw_torque_d_viscosity"]) * deviation
    assert found.effect["viscosity"].value == pytest.approx(expected, rel=1e-5)
    assert found.deviation == pytest.approx(abs(expected), rel=1e-5)


def test_a_distribution_beyond_the_bounds_is_cut():
    found = found_of({"friction.boundary_friction_coefficient": Normal(0.05, 0.1)}, samples=256)
    assert found.left_out == 0
    assert (
        found.deviation < found_of({"friction.boundary_friction_coefficient": Uniform(0.0, 0.5)}, samples=256).deviation
    )


def double_nut(**parts):
    return dataclasses.replace(CATALOGUE.screw, nut=bs.DoubleNut(preload=2500.0, **parts))


@pytest.mark.parametrize("parts", [{}, {"bodies": bs.Bodies()}], ids=["rigid", "elastic"])
def test_a_whole_nut(parts):
    screw = double_nut(**parts)
    uncertain = {"preload": Normal(2500.0, 250.0), "friction.boundary_friction_coefficient": Uniform(0.08, 0.2)}
    found = found_of(uncertain, screw=screw, output="remaining_preload", samples=16)
    assert found.first_order["preload"].value == 1
    assert found_of(uncertain, screw=screw, method="morris", samples=8).inputs[-1] in uncertain


def test_local_effects_of_a_rigid_nut():
    """By the preload too: the slope is that of differences, as the nut is solved by steps that are recorded."""
    uncertain = {"preload": Normal(2500.0, 250.0), "friction.boundary_friction_coefficient": Uniform(0.08, 0.2)}
    found = found_of(uncertain, screw=double_nut(), method="local")
    step = 0.25
    model = dataclasses.replace(MODEL, friction=dataclasses.replace(MODEL.friction, boundary_friction_coefficient=0.14))
    torques = [
        model(dataclasses.replace(CATALOGUE.screw, nut=bs.DoubleNut(preload)), CATALOGUE.oil, **POINT).screw_torque
        for preload in (2500.0 - step, 2500.0 + step)
    ]
    slope = (torques[1] - torques[0]) / (2 * step)
    assert found.effect["preload"].value == pytest.approx(250.0 * slope, rel=1e-6)


# -- bad input ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("changes", "line"),
    [
        ({"output": "screw_torqu"}, 'sensitivity.output: unknown output (screw_torqu) · did you mean "screw_torque"?'),
        (
            {"output": "self_locking"},
            "sensitivity.output: is true or false, and has no variance (self_locking) · choose a number",
        ),
        ({"method": "fast"}, "sensitivity.method: unknown method (fast) · one of sobol, morris, local"),
        ({"samples": 1000}, "sensitivity.samples: must be a power of two (1000) · take 512 or 1024"),
        ({"samples": 2**19}, "sensitivity.samples: must be at most 262144 (524288) · all are in memory"),
        ({"samples": 8}, "sensitivity.samples: must be a whole number, 16 or more (8)"),
        ({"samples": 2.5}, "sensitivity.samples: must be a whole number, 16 or more (2.5)"),
        ({"samples": 3, "method": "morris"}, "sensitivity.samples: must be a whole number, 4 or more (3)"),
        (
            {"samples": 64, "method": "local"},
            "sensitivity.samples: does not count with local, which takes no samples (64) · leave it out",
        ),
        ({"seed": -1}, "sensitivity.seed: must be a whole number, 0 or more (-1)"),
        ({"level": 95}, "sensitivity.level: must lie between 0 and 1 (95) · 0.95 is usual"),
        (
            {"distributions": {"viscosit": Uniform(0.1, 0.2)}},
            'sensitivity.distributions.viscosit: unknown name · did you mean "viscosity"?',
        ),
        (
            {"distributions": {}},
            "sensitivity.distributions: no input is uncertain · give a distribution to an input: "
            '{"viscosity": LogNormal(0.1, 1.3)}',
        ),
        (
            {"method": "local", "screw": double_nut(bodies=bs.Bodies())},
            'sensitivity.method: has no derivatives where balls differ (local) · take method="sobol" or "morris"',
        ),
    ],
)
def test_faults(changes, line):
    with pytest.raises(InputError) as caught:
        found_of(**changes)
    assert caught.value.lines() == [line]


def test_a_law_that_cannot_be_differentiated():
    def rolling(*args, **named):
        return np.asarray(MODEL.rolling(*args, **named), dtype=float)

    model = dataclasses.replace(MODEL, rolling=rolling)
    with pytest.raises(InputError, match=r'take method="sobol" or "morris"'):
        found_of(model=model, method="local")
    assert found_of(model=model, method="morris").inputs == found_of(method="morris").inputs


def test_missing_point():
    with pytest.raises(InputError, match="screw_speed: missing"):
        sensitivity(MODEL, CATALOGUE.screw, CATALOGUE.oil, distributions=UNCERTAIN)
