"""Uncertainty bands at the rows of a set: those of ``ballscrew run --band``, row by row or together; points by hand."""

import dataclasses
import math

import pytest

from ballscrew.cases.case_files import uncertain_inputs
from ballscrew.cases.case_files.case import Case, Origins
from ballscrew.engine.uncertainty import bands
from ballscrew.evidence.validation.entries import Band, Entry, Point
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.calibrations import calibrated, calibration
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.questions.band import compute
from ballscrew.questions.validate.compute import SAMPLES, evaluate, request, shipped_rows, with_bands

REFERENCE = FrictionModel.reference()
STOCK = SETS["hiwin-stock"]


def entry(names, model=REFERENCE, calibration=None):
    rows = [values for values in shipped_rows(STOCK) if values["name"] in names]
    points = [point for values in rows for point in STOCK.evaluate(model, values, STOCK.conditions)]
    return Entry(data=STOCK, model=model, calibration=calibration, points=points)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["R32-5B2-OFSW", "R16-5B1-FSW"])
@pytest.mark.parametrize("fitted", [None, "rexroth-2006"])
def test_the_band_of_a_row_is_that_of_a_case(name, fitted):
    """Of the same samples the band of ``run --band``: usual distributions, other laws, errors of a calibration."""
    found = None if fitted is None else calibration(fitted)
    model = REFERENCE if found is None else calibrated(REFERENCE, found)
    one = with_bands(entry([name], model, fitted), samples=64).points[0]
    at = one.computed_at
    state = OperatingState(at.axial_load, at.screw_speed)
    case = Case(model, at.screw, at.lubricant, state, origins=Origins(calibration=found))
    uncertain, joint = compute.distributions(case, uncertain_inputs.all_of(case))
    same = bands.band(
        model,
        at.screw,
        at.lubricant,
        distributions=uncertain,
        joint=joint,
        alternatives=compute.alternatives(case),
        axial_load=at.axial_load,
        screw_speed=at.screw_speed,
        samples=64,
        engine="numpy",
    )
    assert one.uncertainty == pytest.approx(tuple(same["screw_torque"].both), rel=1e-9)
    assert one.uncertainty[0] < one.value < one.uncertainty[1]


@pytest.mark.slow
def test_rows_together_have_the_bands_that_each_has_alone():
    names = ["R10-4B1-FSB", "R32-32K2-FSC", "R40-10B2-FDW", "R32-10B2-FDW", "2R16-32V2-DFSH", "R40-8B2-OFSW"]
    together = {point.name: point for point in with_bands(entry(names), samples=32).points}
    for name in names:
        (alone,) = with_bands(entry([name]), samples=32).points
        assert together[name].uncertainty == pytest.approx(alone.uncertainty, rel=1e-9)


def test_points_of_no_single_state_have_no_band():
    points = [dataclasses.replace(point, computed_at=None) for point in entry(["R40-10B2-FDW"]).points]
    found = with_bands(Entry(data=STOCK, model=REFERENCE, calibration=None, points=points))
    assert found.points[0].uncertainty is None
    assert (found.share_in_uncertainty_band, found.uncertainty_width) == (None, None)


def test_shares_and_widths_by_hand():
    def point(middle, ends):
        return Point(name="a", value=1.0, band=Band(middle), descriptors={}, uncertainty=ends)

    points = [point(1.0, (1.0, 2.0)), point(2.5, (0.5, 2.0)), point(1.0, None), point(1.0, (math.nan, math.nan))]
    found = Entry(data=STOCK, model=REFERENCE, calibration=None, points=points)
    assert [one.in_uncertainty_band for one in points] == [True, False, None, None]
    assert found.share_in_uncertainty_band == 0.5
    assert found.uncertainty_width == pytest.approx(math.sqrt(2 * 4))


@pytest.mark.slow
def test_every_no_load_torque_of_a_known_nut_has_a_band():
    asked = request(["thk-jis", "xjtu"])
    for entries, _ in evaluate(asked):
        for one in entries:
            has = {point.in_uncertainty_band is not None for point in one.points}
            assert has == {not one.data.alternatives}
    assert SAMPLES & (SAMPLES - 1) == 0
