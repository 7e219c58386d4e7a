"""Numbers that no screw has: a verdict on each, before all else, and none on fits that are right."""

import dataclasses
import importlib
import math
from pathlib import Path

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.evidence.calibration.diagnostics import (
    BOUNDARY_FRICTION,
    HIGHEST_PRELOAD,
    MOST_CONSTANT,
    verdict_records,
)
from ballscrew.evidence.papers.olaru2005.case import SCREW
from support.synthetic_logs import OIL, log, truth

PAPER = bs.FrictionModel.olaru2005()
BENCHMARKS = Path(__file__).parents[3] / "benchmarks"
FRICTION, CONSTANT, PRELOAD = "boundary_friction_coefficient", "constant_torque", "nut.preload"


@pytest.fixture(scope="module")
def logs():
    with pytest.MonkeyPatch.context() as patch:
        patch.syspath_prepend(BENCHMARKS)
        return importlib.import_module("implausible_fits").LOGS


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "number", "limit"),
    [
        ("another nut", FRICTION, BOUNDARY_FRICTION[1]),
        ("zero of the sensor", CONSTANT, 0.0),
        ("seals left out", PRELOAD, HIGHEST_PRELOAD * 72_100),
    ],
)
def test_a_log_with_a_fault_ends_in_a_verdict(logs, name, number, limit):
    found = logs[name].fit()
    (verdict,) = found.verdict_records
    assert (verdict.id, verdict.subject, verdict.holds, verdict.severity) == ("fit.implausible", number, False, "error")
    assert verdict.value == found.estimates[number].value
    assert verdict.limit == pytest.approx(limit, rel=1e-3)
    assert "do not predict with this fit" in verdict.text
    assert found.report().startswith("implausible: ")
    # one record for one number
    assert not any(record.id == "inputs.implausible" for record in found.warning_records)


def test_a_fit_that_is_right_has_none():
    found = bs.fit(PAPER, SCREW, OIL, log(truth(), drift=0.0, outliers=0.0), [FRICTION, CONSTANT])
    assert not [record for record in found.verdict_records if record.holds is False]


def fit_with(constant, **fields):
    """A fit that is right, with other numbers of an estimate."""
    found = bs.fit(PAPER, SCREW, OIL, log(truth(), drift=0.0, outliers=0.0), [FRICTION, CONSTANT])
    changed = dataclasses.replace(found.estimates[constant], **fields)
    return dataclasses.replace(found, estimates={**found.estimates, constant: changed})


def test_a_number_outside_whose_interval_reaches_in_is_open():
    (verdict,) = verdict_records(fit_with(FRICTION, value=0.202, std=0.002))
    assert (verdict.subject, verdict.holds, verdict.severity) == (FRICTION, None, "warning")
    assert "its interval reaches into it" in verdict.text


def test_a_constant_torque_is_below_zero_where_its_interval_is():
    """A true constant torque of zero is found below zero by chance, half of the time: nothing is said of it."""
    found = fit_with(CONSTANT, value=-0.001, std=0.001)
    assert found.estimates[CONSTANT].interval()[1] > 0
    assert verdict_records(found) == []
    (verdict,) = verdict_records(fit_with(CONSTANT, value=-0.004, std=0.001))
    assert (verdict.subject, verdict.holds, verdict.limit) == (CONSTANT, False, 0.0)
    (verdict,) = verdict_records(fit_with(CONSTANT, value=-0.004, std=None))  # how sure it is, is not known
    assert (verdict.subject, verdict.holds) == (CONSTANT, False)


def test_a_constant_torque_is_a_share_of_the_friction_that_was_measured():
    """Not of that of the fitted model, which a fit that follows its log badly has elsewhere."""
    found = fit_with(CONSTANT, value=1.0, std=0.01)
    rows = dataclasses.replace(found.rows, predicted=found.rows.predicted + found.rows.direction)
    points = {"axial_load": rows.log.axial_load, "screw_speed": rows.log.screw_speed}
    measured = np.abs(rows.log.torque - PAPER(SCREW, OIL, **points).ideal_torque)
    (verdict,) = verdict_records(dataclasses.replace(found, rows=rows))
    assert verdict.limit == pytest.approx(MOST_CONSTANT * np.median(measured), rel=0.05)
    assert verdict.holds is False


def test_a_constant_torque_is_at_most_the_share_that_seals_have(logs):
    """The seals of Rexroth's table over the whole torque without load, row by row: none is above the limit."""
    import tomllib
    from importlib import resources

    from ballscrew.evidence.validation.sets import SETS
    from ballscrew.questions.validate import compute

    seals = tomllib.loads((resources.files("ballscrew") / "data" / "seals.toml").read_text(encoding="utf-8"))["seals"]
    shares = []
    for name in ("rexroth-double-nut", "rexroth-single-nut"):
        for row in compute.shipped_rows(SETS[name]):
            d0, lead = row["nominal_diameter"], row["lead"]
            torques = [
                one["torque"]
                for one in seals
                if math.isclose(one["nominal_diameter"], d0)
                and ("leads" not in one or one["leads"][0] - 1e-6 <= lead <= one["leads"][1] + 1e-6)
            ]
            drags = [value for key, value in row.items() if key.startswith("no_load_torque") and value is not None]
            shares += [torques[0] / (torques[0] + float(drag)) for drag in drags if torques]
    assert len(shares) > 50
    assert max(shares) == pytest.approx(MOST_CONSTANT)
