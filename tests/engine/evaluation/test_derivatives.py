"""Derivatives of the model: two ways to the same numbers, and differences as a third."""

import importlib.util

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.derivatives import derivatives
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from support.strategies import MODELS

#: Twelve inputs of every kind, over ranges in which points are valid.
RANGES = {
    "axial_load": (500, 4000),
    "screw_speed": (5, 100),
    "viscosity": (0.05, 0.3),
    "pitch_circle_diameter": (0.035, 0.045),
    "lead": (0.004, 0.006),
    "ball_diameter": (0.003, 0.0035),
    "contact_angle": (0.7, 0.85),
    "screw_conformity": (0.512, 0.54),
    "nut_conformity": (0.512, 0.54),
    "ball_roughness": (5e-8, 1e-7),
    "pressure_viscosity_coefficient": (1.8e-8, 2.4e-8),
    "friction.boundary_friction_coefficient": (0.1, 0.2),
}
OUTPUTS = ("screw_torque", "efficiency")


def random_points(count):
    rng = np.random.default_rng(7)
    return {name: rng.uniform(low, high, count) for name, (low, high) in RANGES.items()}


def along(values):
    return {name: xr.DataArray(v, dims="point") for name, v in values.items()}


def scaled(dataset, values, output, name):
    """A derivative as the relative change of the output for a relative change of the input."""
    slope = dataset[f"d_{output}_d_{name.replace('.', '_')}"].to_numpy()
    return slope * values[name] / dataset[output].to_numpy()


@pytest.mark.slow
@pytest.mark.parametrize("name", MODELS)
def test_against_differences(name):
    """Richardson's extrapolation of central differences of the model itself, which is good to about 1e-10 here."""
    values = random_points(100)
    found = derivatives(MODELS[name], SCREW, OIL, by=list(RANGES), outputs=OUTPUTS, **along(values))
    subject = Configuration(MODELS[name], SCREW, OIL)

    def at(changed, share):
        moved = values | {changed: values[changed] * (1 + share)}
        with np.errstate(all="ignore"):
            return subject.at(moved)

    h = 1e-4
    for changed in RANGES:
        ends = {share: at(changed, share) for share in (h, -h, h / 2, -h / 2)}
        for output in OUTPUTS:
            read = {share: getattr(r, output) for share, r in ends.items()}
            wide, narrow = (read[h] - read[-h]) / (2 * h), (read[h / 2] - read[-h / 2]) / h
            expected = (4 * narrow - wide) / 3 / found[output].to_numpy()
            assert np.max(np.abs(scaled(found, values, output, changed) - expected)) < 5e-9, (output, changed)


@pytest.mark.slow
@pytest.mark.compiles
@pytest.mark.parametrize("name", MODELS)
def test_kernels_and_numpy_agree(name):
    values = random_points(500)
    both = [
        derivatives(MODELS[name], SCREW, OIL, by=list(RANGES), engine=engine, **along(values))
        for engine in ("numpy", "compiled")
    ]
    for changed in RANGES:
        one, other = (scaled(dataset, values, "screw_torque", changed) for dataset in both)
        assert np.max(np.abs(one - other)) < 1e-10, changed


@pytest.mark.skipif(importlib.util.find_spec("jax") is None, reason="jax is not installed (the extra jax)")
@pytest.mark.parametrize("name", ["olaru2005", "corrected", pytest.param("reference", marks=pytest.mark.long)])
def test_jax_agrees(name):
    """An independent way: JAX differentiates the model as it runs on its arrays."""
    values = random_points(200)
    by = list(RANGES)
    tape = derivatives(MODELS[name], SCREW, OIL, by=by, outputs=["screw_torque"], **along(values))
    jax = derivatives(MODELS[name], SCREW, OIL, by=by, outputs=["screw_torque"], method="jax", **along(values))
    assert list(tape) == list(jax)
    for changed in RANGES:
        one, other = (scaled(dataset, values, "screw_torque", changed) for dataset in (tape, jax))
        assert np.max(np.abs(one - other)) < 1e-10, changed


@pytest.mark.slow
def test_labels_units_and_shapes():
    found = derivatives(
        MODELS["reference"],
        SCREW,
        OIL,
        by=["axial_load", "friction.boundary_friction_coefficient"],
        axial_load=[1000.0, 2000.0],
        screw_speed=[10.0, 20.0, 30.0],
    )
    slope = found["d_screw_torque_d_axial_load"]
    assert slope.dims == ("axial_load", "screw_speed")
    assert slope.attrs["units"] == "N m/N"
    assert slope.attrs["long_name"] == "friction torque on the screw, by axial load on the nut"
    assert found["d_screw_torque_d_friction_boundary_friction_coefficient"].attrs["units"] == "N m"
    swept = bs.sweep(MODELS["reference"], SCREW, OIL, axial_load=[1000.0, 2000.0], screw_speed=[10.0, 20.0, 30.0])
    assert np.allclose(found["screw_torque"], swept["screw_torque"], rtol=1e-12)


def test_one_point():
    found = derivatives(MODELS["olaru2005"], SCREW, OIL, by="axial_load", axial_load=4000.0, screw_speed=62.83)
    assert found["d_screw_torque_d_axial_load"].shape == ()
    assert found["d_screw_torque_d_axial_load"] > 0


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"by": ["axial_lode"]}, 'derivatives.by: unknown input (axial_lode) · did you mean "axial_load"?'),
        ({"by": []}, 'derivatives.by: missing · name the inputs: by=["axial_load"]'),
        ({"by": ["axial_load"], "outputs": ["valid"]}, "derivatives.outputs: is true or false"),
        ({"by": ["pure_rolling_offset"]}, "derivatives.pure_rolling_offset: has no value to differentiate by"),
        ({"by": ["axial_load"], "method": "guess"}, "derivatives.method: unknown method (guess) · one of tape, jax"),
    ],
)
def test_faults(given, message):
    with pytest.raises(bs.InputError) as fault:
        derivatives(MODELS["reference"], SCREW, OIL, axial_load=1000.0, screw_speed=10.0, **given)
    assert message in str(fault.value)
