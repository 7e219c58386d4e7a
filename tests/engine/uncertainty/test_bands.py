"""Bands: against linear propagation, against another sampler, and against all combinations of laws.

Bounds on what is random are errors of random sampling, from theory; evenly spread samples do no worse.
"""

import dataclasses
import inspect
import itertools
import math
from pathlib import Path

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.axis.thermal.surroundings import VARIED
from ballscrew.basis.errors import InputError
from ballscrew.basis.references import bibliography
from ballscrew.cases.case_files import case_file, uncertain_inputs
from ballscrew.engine.evaluation.comparison import Candidate
from ballscrew.engine.uncertainty.bands import band, band_along
from ballscrew.engine.uncertainty.distributions import LogNormal, Normal, Uniform
from ballscrew.engine.uncertainty.monte_carlo import JointNormal
from ballscrew.engine.uncertainty.uncertain_value import (
    JUDGEMENT,
    NORMAL_95,
    default_distributions,
    default_uncertainties,
)
from ballscrew.physics.laws.ball_chain import ProportionalBallForce, imposed_ball_force
from ballscrew.physics.laws.friction import BalanSharing
from ballscrew.physics.laws.rolling import houpert_rolling
from ballscrew.physics.solvers.load_distribution import preload_growth, preload_of
from ballscrew.questions.band import compute

EXAMPLES = Path(__file__).parents[3] / "examples"
POINT = {"axial_load": 4000.0, "screw_speed": 60.0}
Z = 1.959963984540054
ERRORS = 5


@pytest.fixture(scope="module")
def drive():
    return case_file.load(EXAMPLES / "feed_drive.toml")


@pytest.fixture(scope="module")
def uncertain(drive):
    """The uncertain inputs of the drive by their names."""
    return {name: one.distribution for name, one in uncertain_inputs.all_of(drive).items()}


@pytest.fixture(scope="module")
def subject(drive):
    return drive.model, drive.screw, drive.lubricant


@pytest.fixture
def of_seed(seed_screw, seed_oil):
    def made(model=None, **options):
        return band(model or bs.FrictionModel.reference(), seed_screw, seed_oil, **{**POINT, **options})

    return made


# -- uncertain inputs -----------------------------------------------------------------------------


@pytest.mark.slow
def test_small_deviations_propagate_as_derivatives_say(of_seed, seed_screw, seed_oil):
    """σ² = Σ (∂M/∂x σ_x)², and the interval is normal: exact as the deviations vanish."""
    share = 1e-4
    centres = {
        "viscosity": 0.1,
        "axial_load": 4000.0,
        "screw_conformity": 0.515,
        "friction.boundary_friction_coefficient": 0.12,
    }
    samples = 2**14
    found = of_seed(
        distributions={name: Normal(value, share * value) for name, value in centres.items()}, samples=samples
    )["screw_torque"]
    slopes = bs.derivatives(bs.FrictionModel.reference(), seed_screw, seed_oil, by=list(centres), **POINT)
    parts = [float(slopes[f"d_screw_torque_d_{n.replace('.', '_')}"]) * share * v for n, v in centres.items()]
    deviation = math.sqrt(sum(part**2 for part in parts))
    tail = 0.025
    error = math.sqrt(tail * (1 - tail) / samples) * math.sqrt(2 * math.pi) * math.exp(Z**2 / 2) * deviation
    assert abs(found.both.low - (found.value - Z * deviation)) < ERRORS * error
    assert abs(found.both.high - (found.value + Z * deviation)) < ERRORS * error
    assert abs(found.median - found.value) < ERRORS * error
    assert found.both == found.parameters
    assert found.share_of_parameters == 1
    assert found.model_form == (found.value, found.value)


@pytest.mark.slow
def test_wide_distributions_against_random_samples(drive, subject, uncertain):
    """The ends of the bands lie where the random sampler has the shares that they should have."""
    outputs = ["screw_torque", "efficiency", "holding_torque", "friction_power"]
    point = {name: getattr(drive.operation, name) for name in ("axial_load", "screw_speed")}
    count, random = 2**13, 2**15
    found = band(*subject, distributions=uncertain, **point, outputs=outputs, samples=count)
    around = []
    for share in (0.025, 0.975):
        error = ERRORS * math.sqrt(share * (1 - share) * (1 / count + 1 / random))
        around += [share - error, share + error]
    sampled = bs.monte_carlo(
        *subject, distributions=uncertain, samples=random, seed=3, outputs=outputs, quantiles=around, **point
    )
    for output in outputs:
        low, high = found[output].parameters
        others = sampled[f"{output}_quantiles"].to_numpy()
        assert others[0] < low < others[1], output
        assert others[2] < high < others[3], output


@pytest.mark.slow
def test_correlated_inputs(of_seed, seed_screw, seed_oil):
    """σ² = gᵀ C g, far from the sum of squares where the errors are nearly opposite."""
    names = ("friction.boundary_friction_coefficient", "viscosity")
    centre = np.array([0.12, 0.1])
    sizes = 1e-4 * centre
    slopes = bs.derivatives(bs.FrictionModel.reference(), seed_screw, seed_oil, by=list(names), **POINT)
    g = np.array([float(slopes[f"d_screw_torque_d_{name.replace('.', '_')}"]) for name in names])
    sign = -np.sign(g[0] * g[1])
    covariance = np.diag(sizes) @ np.array([[1, 0.9 * sign], [0.9 * sign, 1]]) @ np.diag(sizes)
    found = of_seed(distributions={}, joint=JointNormal(names, centre, covariance), samples=2**14)["screw_torque"]
    deviation = math.sqrt(g @ covariance @ g)
    assert deviation < 0.9 * math.sqrt(np.sum((g * sizes) ** 2))
    # five errors of a quantile at 2.5 % of 2^14 random samples are 0.11 deviations
    assert found.both.high - found.both.low == pytest.approx(2 * Z * deviation, abs=0.22 * deviation)


def test_a_load_that_is_uncertain_is_drawn(of_seed):
    found = of_seed(distributions={"axial_load": Uniform(3000.0, 5000.0)}, keep_samples=True, samples=256)
    loads, torques = found.samples["axial_load"], found.samples["screw_torque"]
    assert 3000 < loads.min() < 3050
    assert 4950 < loads.max() < 5000
    assert np.all(np.diff(torques[np.argsort(loads)]) > 0)


def test_kept_samples_are_those_of_the_model(of_seed, seed_screw, seed_oil):
    found = of_seed(
        distributions={"viscosity": LogNormal(0.1, 1.3), "screw_speed": Uniform(40.0, 80.0)},
        outputs=["screw_torque", "friction_power", "back_driving_efficiency"],
        samples=16,
        keep_samples=True,
    )
    drawn = found.samples
    assert len(drawn["viscosity"]) == found.count == 16
    oil = dataclasses.replace(seed_oil, viscosity=drawn["viscosity"])
    r = bs.FrictionModel.reference()(seed_screw, oil, axial_load=4000.0, screw_speed=drawn["screw_speed"])
    for name in ("screw_torque", "friction_power", "back_driving_efficiency"):
        assert drawn[name] == pytest.approx(getattr(r, name), rel=1e-9)


def test_self_locking_share(seed_screw):
    """The holding torque is M_Sa − M_S: it locks where the friction drawn exceeds the torque of the load."""
    screw = dataclasses.replace(seed_screw, lead=0.0035)
    model = dataclasses.replace(bs.FrictionModel.reference(), ball_force=ProportionalBallForce(0.02))
    found = band(
        model,
        screw,
        bs.Lubricant(viscosity=0.1),
        distributions={"ball_force.share_of_load": Uniform(0.0, 0.4)},
        outputs=["holding_torque", "screw_torque"],
        samples=512,
        keep_samples=True,
        **POINT,
    )
    assert 0.1 < found.self_locking_share < 0.9
    assert found.self_locking_share == np.mean(found.samples["holding_torque"] <= 0)
    ideal = found.samples["holding_torque"] + found.samples["screw_torque"]
    assert ideal == pytest.approx(4000 * 0.0035 / (2 * math.pi), rel=1e-12)


# -- other laws -----------------------------------------------------------------------------------


def candidate(model, slot, law, counts=True):
    return Candidate(f"other {slot}", dataclasses.replace(model, **{slot: law}), slot, counts)


def test_laws_are_drawn_evenly_and_multiply(of_seed, seed_screw, seed_oil):
    model = bs.FrictionModel.reference()
    others = [candidate(model, "rolling", houpert_rolling), candidate(model, "friction", BalanSharing())]
    found = of_seed(distributions={}, alternatives=others, samples=2**10, keep_samples=True)
    torques = [float(m(seed_screw, seed_oil, **POINT).screw_torque) for m in (model, *(c.model for c in others))]
    own, *with_other = torques
    one, other = (torque / own for torque in with_other)
    values, counts = np.unique(np.round(found.samples["screw_torque"] / own, 9), return_counts=True)
    assert values == pytest.approx(sorted([1, one, other, one * other]), rel=1e-8)
    # a Sobol' sequence of 2^10 points has exactly a quarter in each quarter of a square
    assert np.array_equal(counts, [256] * 4)
    assert {slot: [law.shift for law in laws] for slot, laws in found.alternatives.items()} == {
        "rolling": [pytest.approx(math.log(one))],
        "friction": [pytest.approx(math.log(other))],
    }
    assert found["screw_torque"].share_of_parameters == 0


def test_laws_that_do_not_count_or_are_not_valid_are_not_drawn(of_seed):
    model = bs.FrictionModel.reference()
    never = dataclasses.replace(bs.FrictionModel.reference(), rolling=lambda c: math.nan * c.contact_load)
    others = [
        candidate(model, "friction", BalanSharing(), counts=False),
        Candidate("nonsense", never, "rolling"),
        Candidate("a whole model", bs.FrictionModel.corrected()),
    ]
    found = of_seed(distributions={}, alternatives=others)
    assert found.alternatives == {}
    assert found["screw_torque"].both == (found["screw_torque"].value,) * 2


@pytest.mark.parametrize("example", ["feed_drive", "olaru2005"])
def test_independent_slots_against_all_combinations(example):
    """docs/uncertainty.md: factors multiply within 10 %, and the ends of the interval are within 5 %."""
    case = case_file.load(EXAMPLES / f"{example}.toml", model="reference")
    point = {name: getattr(case.operation, name) for name in ("axial_load", "screw_speed")}

    def torque(model):
        return float(model(case.screw, case.lubricant, **point).screw_torque)

    own = torque(case.model)
    by_slot = {slot: [({}, 1.0)] for slot in ("friction", "rolling", "film", "full_film")}
    for other in compute.alternatives(case):
        if other.slot in by_slot:
            law = {other.slot: getattr(other.model, other.slot)}
            by_slot[other.slot].append((law, torque(other.model) / own))
    together, product = [], []
    for combination in itertools.product(*by_slot.values()):
        laws = {slot: law for change, _ in combination for slot, law in change.items()}
        together.append(torque(dataclasses.replace(case.model, **laws)) / own)
        product.append(math.prod(ratio for _, ratio in combination))
    assert len(together) == 5 * 4 * 2 * 4
    assert np.max(np.abs(np.log(np.divide(together, product)))) < 0.10
    for share in (0.025, 0.5, 0.975):
        ends = [np.quantile(values, share, method="inverted_cdf") for values in (together, product)]
        assert ends[1] == pytest.approx(ends[0], rel=0.05)


# -- curves, nuts, limits -------------------------------------------------------------------------


@pytest.mark.slow
def test_a_curve_goes_through_the_band(drive, subject, uncertain):
    options = {
        "distributions": uncertain, "alternatives": compute.alternatives(drive), "samples": 256, "axial_load": 5000.0,
        "screw_speed": 60.0,
    }  # fmt: skip
    curve = band_along(*subject, along="screw_speed", points=[0.0, 60.0, 90.0], **options)
    for i, speed in enumerate((0.0, 60.0, 90.0)):
        found = band(*subject, **{**options, "screw_speed": speed})["screw_torque"]
        assert curve.value[i] == pytest.approx(found.value, rel=1e-12)
        assert curve.median[i] == pytest.approx(found.median, rel=1e-9)
        assert [end[i] for end in curve.both] == pytest.approx(list(found.both), rel=1e-9)
        assert [end[i] for end in curve.parameters] == pytest.approx(list(found.parameters), rel=1e-9)


@pytest.mark.slow
def test_axes_have_the_band_of_each_point(drive, subject, uncertain):
    """Over a load and a diameter of the balls, in SI and with names, as a sweep is."""
    options = {
        "distributions": uncertain, "alternatives": compute.alternatives(drive), "samples": 128,
        "outputs": ["screw_torque", "holding_torque"],
    }  # fmt: skip
    loads, leads = [1000.0, -3000.0, 5000.0], [0.01, 0.02]
    told = []
    found = bs.band(
        *subject, **options, axial_load=loads, screw_speed=60.0, lead=leads, done=lambda *numbers: told.append(numbers)
    )
    assert found["screw_torque_low"].dims == ("axial_load", "lead")
    assert found["screw_torque_low"].attrs["units"] == "N m"
    assert (found.attrs["band_level"], found.attrs["band_samples"], found.attrs["band_seed"]) == (0.95, 128, 0)
    assert told[-1] == (6 * 128, 6 * 128)
    for load, lead in itertools.product(loads, leads):
        screw = dataclasses.replace(drive.screw, lead=lead)
        one = bs.band(drive.model, screw, drive.lubricant, **options, axial_load=load, screw_speed=60.0)
        for name in options["outputs"]:
            here = found.sel(axial_load=load, lead=lead)
            ends = [float(here[f"{name}_{end}"]) for end in ("low", "high")]
            assert ends == pytest.approx(list(one[name].both), rel=1e-9)
            assert float(here[name]) == pytest.approx(one[name].value, rel=1e-9)


@pytest.mark.slow
def test_axes_have_the_share_of_invalid_samples_of_each_point(subject, uncertain):
    """From a load at which most samples are valid to one at which none is, and between."""
    loads = [1000.0, 90_000.0, 110_000.0, 130_000.0, 160_000.0]
    options = {"distributions": uncertain, "samples": 128, "screw_speed": 60.0}
    found = bs.band(*subject, **options, axial_load=loads)["invalid_share"]
    ones = [bs.band(*subject, **options, axial_load=load).invalid_share for load in loads]
    assert found.dims == ("axial_load",)
    assert found.attrs["units"] == "1"
    assert found.values.tolist() == ones
    assert len(set(ones)) > 2, ones


def test_an_axis_is_exact(of_seed, seed_screw, seed_oil):
    both = {"viscosity": LogNormal(0.1, 1.3), "axial_load": Normal(4000.0, 100.0)}
    found = of_seed(distributions=both, axial_load=[2000.0, 4000.0], samples=128)
    for load in (2000.0, 4000.0):
        one = of_seed(distributions={"viscosity": LogNormal(0.1, 1.3)}, axial_load=load, samples=128)["screw_torque"]
        assert float(found["screw_torque_high"].sel(axial_load=load)) == pytest.approx(one.both.high, rel=1e-9)
    joint = JointNormal(("viscosity",), np.array([0.1]), np.array([[1e-6]]))
    with pytest.raises(InputError, match=r"band.viscosity: is an axis and among the joint ones"):
        bs.band(
            bs.FrictionModel.reference(),
            seed_screw,
            seed_oil,
            distributions={},
            joint=joint,
            viscosity=[0.1, 0.2],
            **POINT,
        )
    with pytest.raises(InputError, match=r"band.keep_samples: is of one point"):
        of_seed(distributions={}, axial_load=[1.0, 2.0], keep_samples=True)
    with pytest.raises(InputError, match=r"screw_sped: unknown"):
        of_seed(distributions={}, screw_sped=[1.0, 2.0])


def test_a_whole_nut(seed_screw, seed_oil):
    """A double nut with a load: its samples are those of the nut, evaluated one by one."""
    screw = dataclasses.replace(seed_screw, nut=bs.DoubleNut(preload=1000.0))
    model = bs.FrictionModel.reference()
    found = band(
        model,
        screw,
        seed_oil,
        distributions={"viscosity": LogNormal(0.1, 1.3)},
        samples=8,
        keep_samples=True,
        alternatives=[candidate(model, "rolling", houpert_rolling)],
        **POINT,
    )
    ratio = math.exp(found.alternatives["rolling"][0].shift)
    for viscosity, torque in zip(found.samples["viscosity"], found.samples["screw_torque"], strict=True):
        oil = dataclasses.replace(seed_oil, viscosity=viscosity)
        own = float(model(screw, oil, **POINT).screw_torque)
        assert min(abs(torque / own - 1), abs(torque / own / ratio - 1)) < 1e-9


def test_no_load_and_rest(of_seed):
    outputs = ["screw_torque", "efficiency", "back_driving_efficiency", "holding_torque", "friction_power"]
    inputs = {"viscosity": LogNormal(0.1, 1.3)}
    nothing = of_seed(distributions=inputs, axial_load=0.0, outputs=outputs, samples=64)
    assert nothing["screw_torque"].both == (0, 0)
    assert all(math.isnan(end) for end in nothing["efficiency"].both)
    assert math.isnan(nothing["back_driving_efficiency"].median)
    assert nothing.self_locking_share == 0
    still = of_seed(distributions=inputs, screw_speed=0.0, outputs=outputs, samples=64)
    assert still["friction_power"].both == (0, 0)
    assert still["screw_torque"].both.low > 0


# -- what is usually uncertain --------------------------------------------------------------------


def test_every_source_is_known_and_every_reason_said():
    for name, one in default_uncertainties().items():
        assert one.source == JUDGEMENT or one.source in bibliography(), name
        assert len(one.reason.split()) >= 4
        assert sum(x is not None for x in (one.half_width, one.share, one.limits, one.between, one.factor)) == 1


def test_every_input_in_the_file_exists(seed_screw):
    """Each is an input of some model and a preloaded nut, so that no name is misspelt."""
    from ballscrew.cases.screw_tables.nut_kinds import LOSSES
    from ballscrew.engine.evaluation.outputs import inputs_of
    from ballscrew.physics.friction.model import LAWS

    model = bs.FrictionModel.reference()
    oil = bs.Lubricant.from_grade("ISO VG 100")
    screw = dataclasses.replace(seed_screw, nut=bs.DoubleNut(1000.0))
    names = {
        name
        for slot, laws in LAWS.items()
        for law in laws.values()
        for name in inputs_of(dataclasses.replace(model, **{slot: law() if isinstance(law, type) else law}), screw, oil)
    }
    names |= {f"surroundings.{name}" for name in VARIED}
    losses = {slot: law() for slot, laws in LOSSES.items() for law in laws.values()}  # of a slot the last law
    nut = bs.DoubleNut(1000.0, losses=losses)
    for one in (nut, bs.OversizeBallNut(oversize=1e-6)):
        names |= set(inputs_of(model, dataclasses.replace(seed_screw, nut=one), oil))
    assert set(default_uncertainties()) - names == {"viscosity_of_grade", "viscosity_of_sheet"}


def test_the_preload_of_oversize_balls_is_uncertain_by_half_a_gauge_too(seed_screw, seed_oil):
    """Gauges of balls are 1 um apart: 95 % of the preloads are those of an oversize within half of it, and of 25 %."""
    model, force = bs.FrictionModel.reference(), 1000.0

    def usual(nut):
        return default_distributions(model, dataclasses.replace(seed_screw, nut=nut), seed_oil)

    def preload_at(oversize):
        nut = bs.OversizeBallNut(oversize=oversize)
        return float(preload_of(dataclasses.replace(seed_screw, nut=nut), nut))

    oversize = 1e-6 * (force / preload_at(1e-6)) ** (2 / 3)
    by_size = (preload_at(oversize + 1e-9) - preload_at(oversize - 1e-9)) / (2e-9 * force) * 0.5e-6
    assert 0.25 < by_size < 0.35
    distribution, why = usual(bs.OversizeBallNut(force))["preload"]
    assert distribution.mean == force
    assert distribution.deviation == pytest.approx(np.hypot(0.25, by_size) * force / NORMAL_95, rel=1e-6)
    assert "gauge" in why.reason
    assert usual(bs.DoubleNut(force))["preload"][0].deviation == pytest.approx(0.25 * force / NORMAL_95)
    given = usual(bs.OversizeBallNut(oversize=2e-6))
    assert "preload" not in given
    assert given["oversize"][0].deviation == pytest.approx(0.5e-6 / NORMAL_95)
    assert not {"preload", "oversize"} & usual(bs.OversizeBallNut(oversize=0.0)).keys()
    assert "preload" not in usual(bs.OversizeBallNut(0.0))


@pytest.mark.parametrize("bodies", [None, bs.Bodies()], ids=["rigid", "elastic"])
def test_preloads_grow_with_the_oversize_as_those_of_balls_that_are_bigger(seed_screw, bodies):
    def preload_at(oversize):
        nut = bs.OversizeBallNut(oversize=oversize, bodies=bodies)
        return float(preload_of(dataclasses.replace(seed_screw, nut=nut), nut))

    for oversize in (0.5e-6, 1e-6, 2e-6):
        slope = (preload_at(1.001 * oversize) / preload_at(0.999 * oversize) - 1) / (0.002 * oversize)
        # the angle that the widening changes is left out
        assert preload_growth(seed_screw, preload_at(oversize), bodies) == pytest.approx(slope, rel=0.02)


def test_usual_distributions_are_about_the_values_of_the_case(seed_screw, seed_oil):
    model = dataclasses.replace(bs.FrictionModel.reference(), friction=bs.ZhouHoeprich(), ball_force=imposed_ball_force)
    usual = default_distributions(model, seed_screw, seed_oil)
    centres = {name: float(distribution.quantile(0.5)) for name, (distribution, _) in usual.items()}
    boundary, _ = usual["friction.boundary_friction_coefficient"]
    assert boundary == Normal(0.2, 0.1 * 0.2 / 1.959963984540054)  # beyond what is known of steel: who says so knows
    assert centres["ball_to_ball_force"] == pytest.approx(1 / 56)
    assert centres["screw_conformity"] == pytest.approx(0.515, rel=1e-6)
    assert centres["viscosity"] == pytest.approx(0.1)
    assert "temperature" not in usual
    without = dataclasses.replace(model, ball_to_ball_force=0.0)
    assert "ball_to_ball_force" not in default_distributions(without, seed_screw, seed_oil)
    proportional = dataclasses.replace(model, ball_force=ProportionalBallForce())
    names = default_distributions(proportional, seed_screw, seed_oil)
    assert "ball_force.share_of_load" in names
    assert "ball_to_ball_force" not in names


def test_an_oil_of_a_grade(seed_screw):
    oil = bs.Lubricant.from_grade("ISO VG 100", 313.15)
    model = bs.FrictionModel.reference()
    usual = default_distributions(model, seed_screw, oil)
    assert "temperature" in usual
    assert "viscosity" not in usual
    given = default_distributions(model, seed_screw, oil, given={"temperature"})
    assert not {"temperature", "viscosity"} & set(given)
    distribution, why = default_distributions(model, seed_screw, oil, exact={"temperature"})["viscosity"]
    assert why.source == "ISO3448"
    assert distribution == Uniform(0.9 * oil.viscosity, 1.1 * oil.viscosity)


# -- bad input ------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (
            {"distributions": {"viscosty": Normal(0.1, 0.01)}},
            r'band.distributions.viscosty: unknown name · did you mean "visc',
        ),
        ({"distributions": {"viscosity": 0.1}}, "band.distributions.viscosity: is no distribution"),
        ({"distributions": {"loaded_balls": Normal(56, 1)}}, "is a whole number, which has no distribution"),
        ({"distributions": {"viscosity": Uniform(-1, 1)}}, "lubricant.viscosity: must be positive"),
        ({"distributions": {}, "outputs": ["contact_load"]}, "band.outputs: has no band"),
        ({"distributions": {}, "samples": 1}, "band.samples: must be a whole number from 2"),
        ({"distributions": {}, "samples": 2.5}, "band.samples: must be a whole number from 2"),
        ({"distributions": {}, "level": 1.0}, "band.level: must lie between 0 and 1"),
        ({"distributions": {}, "seed": -1}, "band.seed: must be a whole number"),
        ({"distributions": {}, "engine": "abacus"}, "band.engine: unknown engine"),
    ],
)
def test_bad_input(options, message, of_seed):
    with pytest.raises(InputError, match=message):
        of_seed(**options)


def test_joint_inputs_are_checked(of_seed):
    joint = JointNormal(("viscosity",), np.array([0.1]), np.array([[1e-6]]))
    with pytest.raises(InputError, match="is among the joint ones, too"):
        of_seed(distributions={"viscosity": Normal(0.1, 0.01)}, joint=joint)
    with pytest.raises(InputError, match=r"band.joint.viscosty: unknown name"):
        of_seed(distributions={}, joint=dataclasses.replace(joint, names=("viscosty",)))


def test_a_curve_along_something_else(subject):
    with pytest.raises(InputError, match=r"band.along: unknown"):
        band_along(*subject, along="lead", points=[1.0], distributions={}, **POINT)
    with pytest.raises(InputError, match=r"band.axial_load: must be one number"):
        band_along(
            *subject, along="screw_speed", points=[1.0], distributions={}, axial_load=[1.0, 2.0], screw_speed=1.0
        )


@pytest.mark.parametrize(
    "function",
    [bs.band, bs.monte_carlo, bs.sensitivity, bs.duty_band, bs.warm_up_band, bs.condition, bs.preload_change],
)
def test_uncertain_inputs_have_one_name_everywhere(function):
    parameters = inspect.signature(function).parameters
    assert "distributions" in parameters
    assert "uncertain" not in parameters


def test_the_old_name_of_uncertain_inputs_gives_the_same_band_with_a_warning(seed_screw, seed_oil):
    subject, inputs = (bs.FrictionModel.reference(), seed_screw, seed_oil), {"viscosity": Normal(0.1, 0.01)}
    expected = bs.band(*subject, distributions=inputs, samples=16, **POINT)["screw_torque"].both
    with pytest.warns(DeprecationWarning, match="band: write distributions=… for uncertain=…"):
        old = bs.band(*subject, uncertain=inputs, samples=16, **POINT)
    assert old["screw_torque"].both == expected
