"""Axes: the ends of arrays are those of NumPy, and long axes are checked where they are read."""

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.outputs import BLOCK, ends
from ballscrew.engine.evaluation.plan import LONG_AXIS, Configuration, Plan
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW


@pytest.mark.parametrize("shape", [(), (1,), (1000,), (3 * BLOCK + 7,), (3, BLOCK + 1)])
@pytest.mark.parametrize("odd", [None, np.nan, np.inf, -np.inf])
def test_ends_are_those_of_numpy(shape, odd):
    values = np.random.default_rng(5).normal(size=shape)
    if odd is not None:
        values[(-1,) * values.ndim] = odd
    for array in (values, values.T, values[..., ::2] if shape else values):
        assert np.array_equal(ends(array), [np.min(array), np.max(array)], equal_nan=True)


@pytest.mark.parametrize("engine", ["numpy", "model", pytest.param("compiled", marks=pytest.mark.compiles)])
@pytest.mark.parametrize("place", [0, 70_000, -1])
@pytest.mark.parametrize(("bad", "problem"), [(np.nan, "must be a finite number"), (-1.0, "must be positive")])
def test_a_bad_value_in_a_long_axis_is_refused(bad, problem, place, engine):
    values = np.full(2 * LONG_AXIS, 0.1)
    values[place] = bad
    varied = {"viscosity": xr.DataArray(values, dims="point"), "axial_load": 100.0, "screw_speed": 1.0}
    with pytest.raises(bs.InputError, match=f"lubricant.viscosity: {problem}"):
        bs.sweep(bs.FrictionModel.olaru2005(), SCREW, OIL, outputs=["screw_torque"], engine=engine, **varied)


def test_a_long_axis_warns_as_a_short_one_does():
    """Of what no ball screw has, by its ends."""
    said = []
    for count in (10, 2 * LONG_AXIS):
        speeds = np.linspace(1.0, 5000.0, count)
        ds = bs.sweep(
            bs.FrictionModel.olaru2005(), SCREW, OIL, axial_load=100.0, screw_speed=speeds, outputs=["screw_torque"]
        )
        said.append(ds.attrs["warnings"])
    assert said[0] == said[1] != ""


def test_a_bad_value_in_a_long_axis_of_a_grid_is_refused():
    loads = np.linspace(1.0, 4000.0, LONG_AXIS + 1)
    loads[-1] = np.nan
    with pytest.raises(bs.InputError, match=r"operation.axial_load: must be a finite number"):
        bs.sweep(bs.FrictionModel.olaru2005(), SCREW, OIL, axial_load=loads, screw_speed=[1.0, 2.0], outputs=["valid"])


@pytest.mark.compiles
def test_checking_changes_no_bit():
    """Neither does the size of the blocks, whose ends are put together."""
    rng = np.random.default_rng(3)
    varied = {"axial_load": rng.uniform(0, 4000, 2 * LONG_AXIS), "screw_speed": rng.uniform(0, 100, 2 * LONG_AXIS)}
    varied = {name: xr.DataArray(values, dims="point") for name, values in varied.items()}
    subject = Configuration(bs.FrictionModel.olaru2005(), SCREW, OIL)
    checked = Plan.of(subject, None, varied)
    for block_size in (None, 1000, 77_777):
        later = Plan.of(subject, None, varied, later=True)
        assert list(later.unchecked) == list(varied)
        found = []
        for plan in (checked, later):
            evaluation = Evaluation.of(plan, "compiled")
            results = evaluation.empty(plan.total)
            evaluation.fill(results, slice(0, plan.total), block_size=block_size)
            found.append(results)
        assert all(np.array_equal(found[0][name], found[1][name], equal_nan=True) for name in checked.wanted)
        assert not later.unchecked
        assert all(np.array_equal(later.extremes[name], checked.extremes[name]) for name in varied)
