"""Tables: their files read back, and what they state of themselves."""

import csv
import io
import json
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr
from scipy.interpolate import RegularGridInterpolator

import ballscrew as bs
from ballscrew.exports.tables.friction_table import FrictionTable, friction_table
from ballscrew.exports.tables.table import export

RANGES = {"axial_load": (-3000.0, 5000.0), "screw_speed": (-60.0, 100.0)}


@pytest.fixture(scope="module")
def handed(handed_over):
    return handed_over(bs.FrictionModel.olaru2005(), bs.DoubleNut(preload=900.0), to="table", ranges=RANGES)


@pytest.fixture(scope="module")
def exported(handed):
    return export(handed)


@pytest.fixture(scope="module")
def read(exported):
    return json.loads(exported.files["friction.json"])


def _grid(read):
    axes = [np.array(axis["values"]) for axis in read["axes"].values()]
    return axes, {name: np.array(one["values"]) for name, one in read["outputs"].items()}


def test_a_table_holds_within_its_range_and_between_nodes_that_hold():
    axes = {"axial_load": np.array([-100.0, 0.0, 300.0]), "screw_speed": np.array([-10.0, 0.0, 20.0])}
    load, _ = np.meshgrid(*axes.values(), indexing="ij")
    values = {"screw_torque": 0.5 + 0 * load, "ideal_torque": 1e-3 * load}
    holds = np.ones_like(load, dtype=bool)
    holds[0, 0] = False
    table = FrictionTable(axes, {**values, "drive_torque": values["ideal_torque"]}, holds, {}, 0.0)
    points = {
        (-100.0, 20.0): True, (300.0, 20.0): True, (300.0, -10.0): True, (0.0, 0.0): True, (-50.0, 0.0): True,
        (-100.0, -10.0): False, (-1.0, -1.0): False,  # beside a node at which the model does not hold
        (-100.1, 5.0): False, (300.1, 5.0): False, (0.0, -10.1): False, (0.0, 20.1): False,
    }  # fmt: skip
    at = dict(zip(axes, np.array(list(points)).T, strict=True))
    found = table.at(at)
    assert found["valid"].tolist() == list(points.values())
    ideal = 1e-3 * np.clip(at["axial_load"], -100.0, 300.0)
    assert found["drive_torque"] == pytest.approx(ideal + 0.5 * np.sign(at["screw_speed"]), rel=1e-12)
    # what locks itself needs a torque of the other sign to move
    holding = np.where(ideal < 0, 0.5 - np.abs(ideal), np.abs(ideal) - 0.5)
    assert found["holding_torque"] == pytest.approx(holding, abs=1e-15)


@pytest.mark.parametrize(
    ("error", "said"), [(0.01, []), (0.034, [("hand_over.tolerance", "warning", False, 0.034, 0.01)])]
)
def test_a_table_that_is_coarser_than_was_asked_for_says_so(error, said):
    asked = SimpleNamespace(options={"tolerance": 0.01})
    found = FrictionTable({}, {}, np.ones(0, dtype=bool), {}, error).warnings(asked)
    assert [(one.id, one.severity, one.holds, one.value, one.limit) for one in found] == said
    assert all("off by up to 3.4 %, not 1 %" in one.text for one in found)


def test_rest_and_no_load_and_the_ends_are_nodes(read):
    (load, speed), _ = _grid(read)
    assert (load[0], load[-1], speed[0], speed[-1]) == (*RANGES["axial_load"], *RANGES["screw_speed"])
    assert 0.0 in load
    assert 0.0 in speed


def test_the_error_it_states_is_that_of_a_program_that_interpolates(handed, exported, read):
    axes, values = _grid(read)
    points = handed.sample()
    at = np.column_stack([points["axial_load"], points["screw_speed"]])
    found = RegularGridInterpolator(axes, values["screw_torque"])(at)
    wanted = handed.evaluate({**points, "temperature": 313.15, "preload": 900.0})["screw_torque"]
    stated = {one.output: one for one in exported.worst_error}["screw_torque"]
    assert np.abs(found - wanted).max() == pytest.approx(stated.value, rel=1e-9)
    is_coarse = any(record.id == "hand_over.tolerance" for record in exported.warnings)
    assert is_coarse == (read["error_between_nodes"] > 0.01)


def test_csv_and_netcdf_say_the_same(exported, read):
    axes, values = _grid(read)
    rows = list(csv.reader(io.StringIO(exported.files["friction.csv"].decode())))
    assert rows[0][:3] == ["axial_load [N]", "screw_speed [rad/s]", "screw_torque [N m]"]
    assert np.array(rows[1:], dtype=float)[:, 2] == pytest.approx(values["screw_torque"].ravel(), rel=1e-15)
    with xr.open_dataset(io.BytesIO(exported.files["friction.nc"]), engine="h5netcdf") as found:
        assert np.array_equal(found["drive_torque"], values["drive_torque"])
        assert np.array_equal(found["axial_load"], axes[0])
        assert found["screw_torque"].attrs["units"] == "N m"
        assert found.attrs["fixed_preload"] == 900.0
        stated = {name.removeprefix("worst_error_"): found.attrs[name] for name in found.attrs if "worst_error" in name}
        assert stated == {one.output: one.value for one in exported.worst_error if one.output != "valid"}


def test_parquet_says_the_same(handed_over, exported, read):
    arrow = pytest.importorskip("pyarrow.parquet", reason="pyarrow is not installed")
    found = arrow.read_table(io.BytesIO(exported.files["friction.parquet"]))
    _, values = _grid(read)
    assert found["screw_torque [N m]"].to_numpy() == pytest.approx(values["screw_torque"].ravel(), rel=1e-15)


def test_a_range_of_another_input_makes_it_an_axis(handed_over):
    ranges = {**RANGES, "temperature": (300.0, 330.0)}
    model, nut = bs.FrictionModel.olaru2005(), bs.SingleNut()
    table = friction_table(handed_over(model, nut, to="table", ranges=ranges, tolerance=0.05))
    assert list(table.axes) == ["axial_load", "screw_speed", "temperature"]
    assert table.valid_range["temperature"] == (300.0, 330.0)


def test_a_table_of_too_many_nodes_is_refused(handed_over, monkeypatch):
    monkeypatch.setattr("ballscrew.exports.tables.friction_table.MOST_NODES", 50)
    subject = handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut(), to="table", ranges=RANGES)
    with pytest.raises(bs.InputError, match=r"hand_over\.tolerance: needs a table of .* more than 50"):
        friction_table(subject)


@pytest.mark.parametrize(
    ("asked", "expected"),
    [
        ({"kinds": "csv,xml"}, "hand_over.kinds: unknown kind of file"),
        ({"tolerance": 0.0}, "hand_over.tolerance: must be from 0.0001"),
        ({"outputs": ["efficiency"]}, "hand_over.to: efficiency is no finite number at "),
    ],
)
def test_faults_name_field_and_remedy(handed_over, asked, expected):
    with pytest.raises(bs.InputError) as fault:
        export(handed_over(bs.FrictionModel.olaru2005(), bs.SingleNut(), to="table", ranges=RANGES, **asked))
    assert str(fault.value).startswith(expected)
