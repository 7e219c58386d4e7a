"""What is said of preloads that were found, at the limits beyond which it is said; no model is run."""

import math
import types

import numpy as np
import pytest
from scipy.stats import chi2

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.service import diagnostics
from ballscrew.evidence.service.diagnostics import Mixture, PreloadEstimate
from ballscrew.evidence.service.preload_change import PreloadChange, _faults_of_logs, _nominal
from support.power_law import MODEL
from support.service_logs import OIL, PRELOAD, SCREW, WARM

SUBJECT = Configuration(MODEL, SCREW, OIL)


def estimate(preload=PRELOAD, *, temperature=None, beyond=0, rows=10, forward=True, backward=True):
    ways = {"forward": np.array([forward]), "backward": np.array([backward])}
    log = type("Log", (), {**ways, "__len__": lambda self: rows})()
    fit = types.SimpleNamespace(rows=types.SimpleNamespace(log=log))
    logarithm = Mixture.of(math.log(preload), 0.1)
    return PreloadEstimate(logarithm=logarithm, fit=fit, temperature=temperature, rows_beyond_lift_off=beyond)


def test_numbers_that_logs_ask_for():
    """Fewer effective samples than 20, a misfit that chance makes once in 1000, a number two deviations away."""
    limit = chi2.ppf(1 - 1e-3, 10)

    def said(samples, misfit, scores):
        preloads = [types.SimpleNamespace(misfit=np.array([0.0, misfit]))]
        found = types.SimpleNamespace(
            effective_samples=samples, preloads=preloads, best=1, mean_scores=lambda: dict(enumerate_scores(scores))
        )
        # each record by itself: a fit at each of their limits would take seconds
        return [(one.id, one.subject) for one in diagnostics._of_numbers(found, ["worn"])]

    def enumerate_scores(scores):
        return [(f"number {i}", score) for i, score in enumerate(scores)]

    assert said(20.0, 0.999 * limit, [2.0, -2.0]) == []
    assert said(19.9, 1.001 * limit, [1.9, -2.1, 2.1]) == [
        ("service.not_sampled", "preload"),
        ("service.misfit", "worn.torque"),
        ("service.beyond_known", "number 1"),
        ("service.beyond_known", "number 2"),
    ]
    assert said(math.nan, 0.0, []) == [("service.not_sampled", "preload")]


@pytest.mark.parametrize(("worn", "said"), [(0.099, False), (0.101, True)])
def test_a_preload_beyond_a_tenth_of_the_rating(worn, said):
    rating = 50e3
    both = {"new": estimate(0.05 * rating), "worn": estimate(worn * rating)}
    # each record by itself: a fit at each of their limits would take seconds
    records = diagnostics._of_ratings(both, SUBJECT, rating)
    assert [one.subject for one in records] == (["worn.preload"] if said else [])
    assert all((one.limit, one.value) == pytest.approx((5000.0, worn * rating)) for one in records)
    assert diagnostics._of_ratings(both, SUBJECT, None) == []


def test_rows_beyond_lift_off_and_directions():
    # each record by itself: a fit at each of their limits would take seconds
    (record,) = diagnostics._of_lift_off("new", estimate(beyond=3, rows=10))
    assert record.value == 3.0
    assert "in 3 of 10 rows, which tell nothing of it: 7 rows do" in record.text
    assert diagnostics._of_lift_off("new", estimate()) == []
    # each record by itself: a fit at each of their limits would take seconds
    assert diagnostics._of_directions("new", estimate()) == []
    for one in (estimate(forward=False), estimate(backward=False)):
        assert [record.id for record in diagnostics._of_directions("new", one)] == ["service.one_direction"]


@pytest.mark.parametrize(("warmer", "said"), [(5.1, "hotter"), (-5.1, "colder"), (4.9, ""), (-4.9, "")])
def test_temperatures_of_both_logs(warmer, said):
    logs = {"new": estimate(temperature=WARM), "worn": estimate(temperature=WARM + warmer)}
    # each record by itself: a fit at each of their limits would take seconds
    records = diagnostics._of_temperatures(logs, SUBJECT)
    assert [one.id for one in records] == (["service.temperatures_differ"] if said else [])
    assert all(said in one.text and one.value == pytest.approx(warmer) for one in records)
    assert all(one.severity == "info" for one in records)
    plain = Configuration(MODEL, SCREW, bs.Lubricant(viscosity=0.1))
    found = [(one.id, one.severity) for one in diagnostics._of_temperatures(logs, plain)]
    unused = [("service.temperature_unused", "warning")] * 2
    assert found == unused + ([("service.temperatures_differ", "warning")] if said else [])
    missing = diagnostics._of_temperatures({**logs, "new": estimate()}, SUBJECT)
    assert [(one.id, one.subject) for one in missing] == [("service.no_temperature", "new.temperature")]


@pytest.mark.parametrize(
    ("lost", "verdict"), [(0.94, "open"), (0.96, "lost"), (0.06, "open"), (0.04, "kept"), (math.nan, "open")]
)
def test_a_verdict_takes_a_probability_of_95_percent(lost, verdict):
    """Of a normal logarithm with its median where so much of it is below 90 %."""
    from scipy.stats import norm

    deviation = 0.05 if math.isfinite(lost) else math.nan
    median = math.log(0.9) - deviation * norm.ppf(lost)
    one = PreloadEstimate(logarithm=Mixture.of(0.0, 0.1))
    found = PreloadChange(
        new=one,
        worn=one,
        logarithm=Mixture.of(median, deviation),
        ratio_shares={},
        scores={},
        tolerance=0.1,
        alternatives=[],
    )
    assert found.verdict == verdict
    assert found.probability_of_loss == pytest.approx(lost, nan_ok=True)


def test_the_preload_of_the_case_with_its_tolerance():
    """A normal one of 5 % each way, 95 %; of a uniform one half of what lies between its quantiles of one deviation."""
    from scipy.stats import norm

    found = _nominal(SUBJECT, {"preload": bs.Normal(PRELOAD, 0.05 * PRELOAD)})
    assert found.preload == pytest.approx(PRELOAD)
    assert math.sqrt(found.logarithm.variance[0]) == pytest.approx(0.05, rel=1e-3)
    uniform = _nominal(SUBJECT, {"nut.preload": bs.Uniform(0.9 * PRELOAD, 1.1 * PRELOAD)})
    assert math.sqrt(uniform.logarithm.variance[0]) == pytest.approx(0.2 * (norm.cdf(1) - 0.5), rel=1e-3)
    assert _nominal(SUBJECT, {}).logarithm.variance[0] == 0.0


def test_logs_that_are_one_file_are_refused():
    def log(digest):
        return types.SimpleNamespace(source=None if digest is None else ("a.csv", digest))

    # each record by itself: a fit at each of their limits would take seconds
    assert _faults_of_logs({"worn": log("1")}) == _faults_of_logs({"new": log(None), "worn": log(None)}) == []
    assert _faults_of_logs({"new": log("1"), "worn": log("2")}) == []
    assert [one.where for one in _faults_of_logs({"new": log("1"), "worn": log("1")})] == ["service"]
    assert [one.where for one in _faults_of_logs({"new": log("1")})] == ["service.worn"]
