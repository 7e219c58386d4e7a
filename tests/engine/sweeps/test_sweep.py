"""Sweeps: labels, sources, and the same numbers as the model by itself."""

import dataclasses
import math

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.engine.evaluation.outputs import DEFAULT_OUTPUTS, inputs_of, known_outputs
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.solvers.slip import curvature_slip
from support.rules import for_each

RPM = math.pi / 30
EVERYTHING = known_outputs()
RNG_SEED = 36


@pytest.fixture(scope="module")
def sweep(seed_screw, seed_oil):
    """Sweeps a model of the paper's screw."""
    return lambda model, **how: bs.sweep(model, seed_screw, seed_oil, **how)


def points(values):
    return xr.DataArray(values, dims="point")


def random_points(size=120):
    """Operating points, no load and no speed among them, with an oil and a groove that vary too."""
    rng = np.random.default_rng(RNG_SEED)
    load, speed = rng.uniform(0, 8000, size), rng.uniform(0, 200, size)
    load[:20] = np.logspace(-6, 2, 20)
    load[20:24] = speed[23:30] = 0.0
    return {
        "axial_load": load,
        "screw_speed": speed,
        "viscosity": rng.uniform(0.005, 1.0, size),
        "pressure_viscosity_coefficient": rng.uniform(1e-8, 2.5e-8, size),
        "screw_conformity": rng.uniform(0.505, 0.56, size),
    }


def plain(model, screw, oil, values):
    """The model by itself on whole arrays."""
    screw = dataclasses.replace(screw, screw_conformity=values.get("screw_conformity", screw.screw_conformity))
    oil = dataclasses.replace(
        oil, **{name: values[name] for name in ("viscosity", "pressure_viscosity_coefficient") if name in values}
    )
    return model(screw, oil, axial_load=values["axial_load"], screw_speed=values["screw_speed"])


def sizes_of(r):
    """What rounding of a difference is measured against, by output; elsewhere it is the value itself."""
    torque = sum(np.abs(part) for part in r.contributions.values())
    force = r.screw.tangential_force
    # what the contacts share is settled by the whole; a contact that sticks keeps next to nothing of it
    spin = r.screw.spin + r.nut.spin
    spin_parameter = r.screw.spin_parameter + r.nut.spin_parameter
    return {
        "screw_spin": spin,
        "nut_spin": spin,
        "screw_spin_parameter": spin_parameter,
        "nut_spin_parameter": spin_parameter,
        "spin_moment": r.screw.traction_limit * r.screw.semi_major_axis,
        "contribution_spin": torque,
        "nut_torque": torque,
        "screw_friction_torque": torque,
        "nut_friction_torque": torque,
        "nut_sliding_force": force,
        "nut_tangential_force": force,
        # a root of 1 - 3Y + Y³ = T, whose slope vanishes at Y = 1
        "screw_pure_rolling_offset": 1e6,
        "nut_pure_rolling_offset": 1e6,
        # in units of load and preload
        "residual": 1.0,
    }


def assert_same(found, expected, size=None, relative=1e-12):
    expected = np.broadcast_to(np.asarray(expected, float), found.shape)
    found = np.asarray(found, float)
    assert np.array_equal(np.isnan(found), np.isnan(expected))
    usual = np.isfinite(expected)
    assert np.array_equal(found[~usual], expected[~usual], equal_nan=True)
    tolerance = relative * np.broadcast_to(np.abs(expected if size is None else size), found.shape)
    assert np.all(np.abs(found[usual] - expected[usual]) <= tolerance[usual])


# -- the same numbers -----------------------------------------------------------------------------


@pytest.fixture(scope="module", params=["olaru2005", "corrected", "reference"])
def both(request, seed_screw, seed_oil, sweep):
    """Everything a sweep can say at random points, and what the model says there."""
    model = getattr(bs.FrictionModel, request.param)()
    values = random_points()
    ds = sweep(model, outputs=list(EVERYTHING), **{name: points(v) for name, v in values.items()})
    return model, ds, plain(model, seed_screw, seed_oil, values)


@for_each(name={name: name for name in EVERYTHING})
def test_every_output_equals_the_model(both, name):
    _, ds, r = both
    assert_same(ds[name].to_numpy(), EVERYTHING[name].read(r), sizes_of(r).get(name))


@for_each(name={name: name for name in EVERYTHING})
def test_no_output_is_nan_at_rest_or_without_load(both, name):
    """But for the efficiencies and what follows from them, which need a load, and coefficients of a preload."""
    _, ds, _ = both
    missing = ds[name].isnull()
    if name in ("preload_torque_coefficient", "diameter_drag_coefficient"):
        assert missing.all()
    elif name in ("efficiency", "back_driving_efficiency", "friction_coefficient", "friction_angle"):
        assert np.array_equal(missing, ds["ideal_torque"] == 0)
    else:
        assert not missing.any()


def test_masks_are_masks(both):
    _, ds, r = both
    assert ds["valid"].dtype == bool
    assert np.array_equal(ds["valid"], np.broadcast_to(r.valid, ds["valid"].shape))


#: Inputs that a part has by default from elsewhere: a value to begin with.
UNSET = {"ball_to_ball_force": 0.02, "pure_rolling_offset": 0.3, "pressure_modulus_slope": 0.02}


@pytest.mark.slow
def test_every_input_can_be_swept(model, seed_screw, seed_oil):
    """Whatever is listed as an input may vary, and gives what the changed part gives."""
    operation = {"axial_load": 2000.0, "screw_speed": 30.0}
    roomy = dataclasses.replace(seed_screw, lead=0.020)  # for one start more
    parts = {"model": model, "screw": roomy, "lubricant": seed_oil, "nut": roomy.nut}
    before, after = {}, {}
    for name, (part, _) in inputs_of(model, roomy, seed_oil).items():
        law, _, field = name.rpartition(".")
        if name.startswith("nut."):  # once more by its full name
            continue
        if part == "operation" or (name == "pure_rolling_offset" and model.slip is not curvature_slip):
            continue
        owner = getattr(parts[part], law) if law else parts[part]
        value = getattr(owner, field)
        before[name] = UNSET[name] if value is None else value
        # 1 % more, or one more of what can be counted
        after[name] = before[name] + (1 if name in {"loaded_balls", "starts"} else 0.01 * before[name])
        if value is None:
            parts[part] = dataclasses.replace(parts[part], **{name: before[name]})
    # row by row, one of them after another is changed
    rows = {name: points([after[name] if row == name else value for row in after]) for name, value in before.items()}
    ds = bs.sweep(model, roomy, seed_oil, **operation, **rows)
    for row, name in enumerate(after):
        part = inputs_of(model, roomy, seed_oil)[name][0]
        law, _, field = name.rpartition(".")
        owner = getattr(parts[part], law) if law else parts[part]
        changed = dataclasses.replace(owner, **{field: after[name]})
        changed = dataclasses.replace(parts[part], **{law: changed}) if law else changed
        now = parts | {part: changed}
        screw = dataclasses.replace(now["screw"], nut=now["nut"])
        r = now["model"](screw, now["lubricant"], **operation)
        assert ds["screw_torque"].to_numpy()[row] == pytest.approx(r.screw_torque, rel=1e-12), name
        assert ds["efficiency"].to_numpy()[row] == pytest.approx(r.efficiency, rel=1e-12), name


def test_an_offset_can_only_be_swept_where_curvature_is_the_only_slip(sweep):
    with pytest.raises(bs.InputError, match="curvature is the only slip"):
        sweep(bs.FrictionModel.reference(), **GOOD, pure_rolling_offset=[0.3, 0.31])


def test_the_default_force_between_balls_can_be_swept(model, seed_screw, seed_oil, sweep):
    """The one default that depends on another input: 1 N divided by the number of balls."""
    ds = sweep(model, axial_load=2000.0, screw_speed=30.0, loaded_balls=[56, 57])
    r = model(dataclasses.replace(seed_screw, loaded_balls=57), seed_oil, axial_load=2000.0, screw_speed=30.0)
    assert ds["screw_torque"].to_numpy()[1] == pytest.approx(r.screw_torque, rel=1e-12)


# -- labels ---------------------------------------------------------------------------------------


def test_dimensions_come_in_the_order_given(model, seed_screw, seed_oil, sweep):
    ds = sweep(model, viscosity=[0.05, 0.1], screw_speed=[0.0, 10.0, 20.0], axial_load=[1.0, 2.0, 3.0, 4])
    assert list(ds.sizes.items()) == [("viscosity", 2), ("screw_speed", 3), ("axial_load", 4)]
    assert set(ds.data_vars) == set(DEFAULT_OUTPUTS)
    for variable in ds.data_vars.values():
        assert variable.dims == ("viscosity", "screw_speed", "axial_load")
    assert list(ds["screw_speed"].to_numpy()) == [0.0, 10.0, 20.0]
    here = ds.sel(viscosity=0.1, screw_speed=20.0, axial_load=3.0)
    oil = dataclasses.replace(seed_oil, viscosity=0.1)
    r = model(seed_screw, oil, axial_load=3.0, screw_speed=20.0)
    assert float(here["screw_torque"]) == pytest.approx(r.screw_torque, rel=1e-12)


def test_values_that_share_a_dimension_vary_together(model, seed_screw, seed_oil, sweep):
    load, speed = np.array([1000.0, 2000.0, 3000.0]), np.array([10.0, 20.0, 30.0])
    ds = sweep(model, axial_load=points(load), screw_speed=points(speed), viscosity=[0.05, 0.1])
    assert dict(ds.sizes) == {"point": 3, "viscosity": 2}
    assert ds["axial_load"].dims == ds["screw_speed"].dims == ("point",)
    r = model(seed_screw, dataclasses.replace(seed_oil, viscosity=0.05), axial_load=load, screw_speed=speed)
    assert np.allclose(ds["screw_torque"].sel(viscosity=0.05), r.screw_torque, rtol=1e-12, atol=0)


def test_a_value_may_have_two_named_axes(model, seed_screw, seed_oil, sweep):
    load = xr.DataArray([[100.0, 200.0, 300.0], [400.0, 500.0, 600.0]], dims=("machine", "axis"))
    speed = xr.DataArray([1.0, 2.0, 3.0], dims="axis")
    ds = sweep(model, screw_speed=speed, axial_load=load)
    assert dict(ds.sizes) == {"axis": 3, "machine": 2}
    expected = model(seed_screw, seed_oil, axial_load=load.to_numpy().T, screw_speed=speed.to_numpy()[:, None])
    assert np.allclose(ds["screw_torque"], expected.screw_torque, rtol=1e-12, atol=0)


def test_numbers_stay_numbers(model, seed_screw, seed_oil, sweep):
    ds = sweep(model, axial_load=4000.0, screw_speed=60.0)
    assert dict(ds.sizes) == {}
    assert ds["screw_torque"].ndim == 0
    assert float(ds["axial_load"]) == 4000.0
    r = model(seed_screw, seed_oil, axial_load=4000.0, screw_speed=60.0)
    assert float(ds["screw_torque"]) == pytest.approx(r.screw_torque, rel=1e-12)
    ds = sweep(model, axial_load=[4000.0, 1.0], screw_speed=60.0)
    assert dict(ds.sizes) == {"axial_load": 2}
    assert ds["screw_speed"].ndim == 0


@for_each(name={name: name for name in EVERYTHING})
def test_every_output_is_described(both, name):
    _, ds, _ = both
    attributes = ds[name].attrs
    assert attributes["long_name"]
    assert attributes["units"]
    assert attributes["symbol"]


def test_attributes(model, sweep):
    ds = sweep(model, axial_load=[1.0], screw_speed=[1.0], viscosity=0.2, **{"friction.decay": [1.42, 2.32]})
    assert ds["screw_torque"].attrs == {
        "long_name": "friction torque on the screw",
        "units": "N m",
        "symbol": "M_S",
        "references": "Olaru2005 §6 (33)",
    }
    assert ds["screw_speed"].attrs["units"] == "rad/s"
    assert ds["axial_load"].attrs["units"] == "N"
    assert ds["viscosity"].attrs["long_name"]
    assert ds["friction.decay"].attrs["symbol"] == "B"
    assert ds.attrs["Conventions"].startswith("CF-")
    assert model.name in ds.attrs["title"]
    assert ds.attrs["source"] == f"ballscrew {bs.__version__}, model {model.name}"
    keys = ds.attrs["references"].split("; ")
    assert keys[0] == "Olaru2005" or "Olaru2005" in keys
    assert {"HamrockDowson1977", "ZhouHoeprich1991"} <= set(keys)
    # what does not vary is written down with its value, what varies is not
    assert ds.attrs["screw_pitch_circle_diameter"] == 0.040
    assert ds.attrs["lubricant_pressure_viscosity_coefficient"] == 2.2e-8
    assert "lubricant_viscosity" not in ds.attrs
    assert all(np.ndim(value) == 0 for value in ds.attrs.values())


def test_outputs_may_be_chosen(model, sweep):
    chosen = ("friction_power", "contribution_curvature", "screw.film_parameter", "nut_maximum_pressure")
    ds = sweep(model, outputs=chosen, axial_load=[1.0, 2.0], screw_speed=60.0)
    assert list(ds.data_vars) == [*(name.replace(".", "_") for name in chosen), "valid"]


def test_outputs_cover_results_and_both_sides():
    """Every mechanism and every quantity of a contact is there, for screw and nut."""
    for name in ("screw_torque", "friction_power", "drive_torque", "valid"):
        assert name in EVERYTHING
    for mechanism in MECHANISMS:
        assert f"contribution_{mechanism}" in EVERYTHING
    screw = {name.removeprefix("screw_") for name in EVERYTHING if name.startswith("screw_")} - {"torque"}
    nut = {name.removeprefix("nut_") for name in EVERYTHING if name.startswith("nut_")} - {"torque"}
    assert screw == nut
    assert set(DEFAULT_OUTPUTS) <= set(EVERYTHING)


# -- progress -------------------------------------------------------------------------------------


@pytest.mark.parametrize("threads", [1, 3])
def test_progress_is_told_in_order(model, threads, sweep):
    told = []
    sweep(
        model,
        axial_load=np.linspace(1, 2, 25),
        screw_speed=np.linspace(1, 2, 4),
        block_size=30,
        threads=threads,
        done=lambda finished, total: told.append((finished, total)),
    )
    if threads == 1:
        assert told == [(30, 100), (60, 100), (90, 100), (100, 100)]
    assert told[-1] == (100, 100)
    assert told == sorted(told)


@pytest.mark.parametrize("threads", [1, 2])
def test_a_sweep_can_be_stopped_from_its_progress(model, threads, sweep):
    def stop(finished, total):
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(model, axial_load=np.linspace(1, 2, 100), screw_speed=1.0, block_size=10, threads=threads, done=stop)


# -- bad input ------------------------------------------------------------------------------------


GOOD = {"axial_load": [1000.0, 2000.0], "screw_speed": [10.0]}


@pytest.mark.parametrize(
    ("changed", "message"),
    [
        ({"axial_laod": [1.0]}, r'sweep\.axial_laod: unknown name .*did you mean "axial_load"\?'),
        ({"friction.boundary_friction_coeficient": [0.1]}, r'did you mean "friction\.boundary_friction_coefficient"\?'),
        ({"outputs": ["screw_torqe"]}, r'unknown output .*did you mean "screw_torque"\?'),
        ({"axial_load": []}, r"sweep\.axial_load: has no values"),
        ({"axial_load": [1.0, math.nan, 3.0]}, r"operation\.axial_load: must be a finite number"),
        ({"axial_load": [1.0, math.inf]}, r"operation\.axial_load: must be a finite number"),
        ({"screw_speed": -math.inf}, r"operation\.screw_speed: must be a finite number"),
        ({"viscosity": [0.1, 0.0]}, r"lubricant\.viscosity: must be positive"),
        ({"screw_conformity": [0.5, 0.52]}, r"screw\.screw_conformity: must be above 0\.5"),
        ({"axial_load": np.ones((2, 2))}, r"sweep\.axial_load: has several axes .*DataArray"),
        ({"loaded_balls": [50, 50.5, 51]}, r"screw\.loaded_balls: must be a whole number"),
        ({"axial_load": xr.DataArray([1.0, 2.0], dims=(3,))}, r"has a dimension whose name is no text \(\(3,\)\)"),
        (
            {"axial_load": points([1.0, 2.0]), "screw_speed": points([1.0, 2.0, 3.0])},
            r"sweep\.point: different lengths",
        ),
    ],
)
def test_bad_input_is_refused_with_the_remedy(model, changed, message, sweep):
    with pytest.raises(bs.InputError, match=message):
        sweep(model, **(GOOD | changed))


@pytest.mark.parametrize("engine", ["numpy", "model"])
def test_loads_and_speeds_of_either_sign_are_swept(model, engine, sweep):
    """The other way round the drive torque is the same with the other sign, and friction is what it was."""
    outputs = ["drive_torque", "screw_torque", "efficiency", "valid"]
    ends = {"axial_load": np.array([-2000.0, -50.0, 0.0, 50.0, 2000.0]), "screw_speed": np.array([-30.0, 0.0, 30.0])}
    ds, turned = (
        sweep(model, engine=engine, outputs=outputs, **{n: sign * v for n, v in ends.items()}) for sign in (1, -1)
    )
    assert np.array_equal(turned["drive_torque"], -ds["drive_torque"])
    for name in ("screw_torque", "efficiency", "valid"):
        assert np.array_equal(turned[name], ds[name], equal_nan=name == "efficiency"), name
    drives = ds["axial_load"] * ds["screw_speed"] > 0
    at_rest = (ds["screw_speed"] == 0) & (ds["axial_load"] != 0)
    assert np.array_equal(ds["efficiency"].notnull().transpose(*drives.dims), drives | at_rest)


@pytest.mark.parametrize("name", ["axial_load", "screw_speed"])
def test_the_operating_point_is_needed(model, name, sweep):
    given = {key: value for key, value in GOOD.items() if key != name}
    with pytest.raises(bs.InputError, match=rf"sweep\.{name}: missing .*give {name}="):
        sweep(model, **given)


def test_all_faults_are_told_at_once(model, sweep):
    with pytest.raises(bs.InputError) as caught:
        sweep(model, axial_laod=[1.0], viscosity=[-1.0], lead=[math.nan])
    text = str(caught.value)
    for name in ("axial_laod", "viscosity", "lead", "axial_load", "screw_speed"):
        assert name in text


def test_impossible_geometry_is_flagged(model, sweep):
    """What a constructor refuses in a number is flagged in an array."""
    ds = sweep(model, ball_diameter=[3.0e-3, 6.0e-3, 19e-3, 21e-3], **GOOD)
    assert ds["valid"].isel(axial_load=0, screw_speed=0).to_numpy().tolist() == [True, False, False, False]


def test_an_input_may_be_asked_for_as_an_output(model, sweep):
    ds = sweep(model, outputs=["screw_torque", "ball_to_ball_force"], ball_to_ball_force=[0, 0.1], **GOOD)
    assert list(ds["ball_to_ball_force"].to_numpy()) == [0, 0.1]


def test_labels_of_a_dimension_stay(model, sweep):
    load = xr.DataArray([1000.0, 2000.0], dims="case", coords={"case": ["light", "heavy"]})
    ds = sweep(model, axial_load=load, screw_speed=10.0)
    assert list(ds["case"].to_numpy()) == ["light", "heavy"]


def test_names_that_mean_two_things_are_refused(sweep):
    model = bs.FrictionModel.corrected()
    odd = xr.DataArray([1000.0, 2000.0], dims="efficiency")
    with pytest.raises(bs.InputError, match=r"sweep\.efficiency: is a dimension and something else"):
        sweep(model, outputs=["efficiency"], axial_load=odd, screw_speed=10.0)
    other = xr.DataArray([1000.0, 2000.0], dims="lead")
    with pytest.raises(bs.InputError, match=r"sweep\.lead: is a dimension and something else"):
        sweep(model, axial_load=other, screw_speed=10.0, lead=0.005)


def test_arrays_belong_into_the_sweep(seed_screw, seed_oil):
    screw = dataclasses.replace(seed_screw, lead=np.array([0.005, 0.01]))
    with pytest.raises(bs.InputError, match=r"screw\.lead: is an array · give it to the sweep: lead="):
        bs.sweep(bs.FrictionModel.corrected(), screw, seed_oil, axial_load=[1.0, 2.0], screw_speed=10.0)


def test_a_single_output_may_be_a_plain_name(sweep):
    ds = sweep(bs.FrictionModel.corrected(), outputs="efficiency", axial_load=[1e3], screw_speed=9)
    assert list(ds.data_vars) == ["efficiency", "valid"]


def test_a_material_that_varies_is_a_coordinate_and_no_attribute(model, seed_screw, seed_oil, sweep):
    moduli = [2.0e11, 3.2e11]
    ds = sweep(model, axial_load=1e3, screw_speed=30.0, **{"ball_material.young_modulus": moduli})
    assert ds["ball_material.young_modulus"].attrs["units"] == "Pa"
    assert "screw_ball_material_young_modulus" not in ds.attrs
    assert ds.attrs["screw_nut_material_young_modulus"] == seed_screw.nut_material.young_modulus
    for modulus, torque in zip(moduli, ds["screw_torque"].to_numpy(), strict=True):
        ceramic = dataclasses.replace(seed_screw, ball_material=bs.Material(young_modulus=modulus))
        result = model(ceramic, seed_oil, axial_load=1e3, screw_speed=30.0)
        assert torque == pytest.approx(float(result.screw_torque), rel=1e-12)
