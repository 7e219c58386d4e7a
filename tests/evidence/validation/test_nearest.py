"""The rows of a vendor nearest to a nut: stored ratios, found again, and said beside a result."""

import dataclasses

import numpy as np
import pytest

import ballscrew as bs

# the ratios as they are stored; near_rows gives a few of them
from ballscrew.evidence.validation.entries import Conditions, _ratios, near_rows
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.friction.calibrations import calibrated, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.validate import compute
from support.drive_case import drive_case

DRIVE = bs.catalogue()["rexroth-40x10x6-6-double"]


@pytest.mark.parametrize("column", [name for name in _ratios()[0] if name not in ("set", "row", "size", "lead")])
def test_the_stored_ratios_are_those_of_the_model(column):
    """If this was meant to move: python benchmarks/fit_calibration.py --write."""
    model = FrictionModel.reference()
    model = model if column == "uncalibrated" else calibrated(model, calibrations()[column])
    for name, shipped in (("rexroth-double-nut", 3), ("rexroth-single-nut", 5)):
        values = compute.shipped_rows(SETS[name])[shipped]
        stored = {row["row"]: float(row[column]) for row in _ratios() if row["set"] == name}
        for point in SETS[name].evaluate(model, values, Conditions()):
            assert stored[point.name] == pytest.approx(point.ratio, abs=1e-4)


def test_the_row_itself_is_the_nearest():
    near = near_rows(DRIVE.screw(nut=bs.DoubleNut(preload=4000.0)))
    assert near.data == "rexroth-double-nut"
    assert near.rows[:2] == ["40x10x6-6 at 7 %", "40x10x6-6 at 10 %"]
    ratios = [float(row["uncalibrated"]) for row in _ratios() if row["row"] in near.rows and row["set"] == near.data]
    assert near.mean == pytest.approx(np.mean(ratios), rel=1e-12)
    oversize = near_rows(DRIVE.screw(nut=bs.OversizeBallNut(preload=2000.0)), "rexroth-2006")
    assert oversize.data == "rexroth-single-nut"


@pytest.mark.implausible
def test_nuts_and_calibrations_without_rows_have_none():
    assert near_rows(DRIVE.screw()) is None
    assert near_rows(DRIVE.screw(nut=bs.DoubleNut(preload=1.0)), "mine") is None
    far = dataclasses.replace(DRIVE.screw(nut=bs.DoubleNut(preload=1.0)), pitch_circle_diameter=0.3)
    assert near_rows(far) is None


def test_it_is_said_beside_a_result(ballscrew, tmp_path):
    case = tmp_path / "nut.toml"
    case.write_text(drive_case(), encoding="utf-8")
    plain = " ".join(ballscrew("run", case).stdout.split())
    assert "drag torque without seals at 100 rpm, ISO VG 100 at 25 degC, model / vendor: 0.8" in plain
    assert "for the 6 rows of rexroth-double-nut most like this nut, without calibration" in plain
    fitted = " ".join(ballscrew("run", case, "--calibration", "rexroth-2006-rubbing").stdout.split())
    assert "which rexroth-2006-rubbing was fitted to" in fitted
    changed = ballscrew("run", case, "--set", "model.friction=load-sharing").stdout
    assert "model / vendor" not in changed


def test_every_row_of_the_sets_is_stored():
    assert [row["set"] for row in _ratios()] == ["rexroth-double-nut"] * 24 + ["rexroth-single-nut"] * 18
