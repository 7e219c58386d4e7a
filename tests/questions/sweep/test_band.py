"""A band over a sweep: at each point that which ``run --band`` says there."""

import csv
import io
import json

import numpy as np
import pytest
import xarray as xr

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.questions.band import BandOptions, compute
from ballscrew.questions.sweep import compute as sweep
from ballscrew.questions.sweep.band import with_band
from support.commands import ROOT

EXAMPLES = ROOT / "examples"
DRIVE = EXAMPLES / "feed_drive.toml"
#: Both have the same samples: however few they are, the ends are equal.
OPTIONS = BandOptions(samples=64)


def swept(case, vary, outputs=("screw_torque", "efficiency"), options=OPTIONS, done=None):
    plan = sweep.plan(case, vary, outputs, None, banded=True)
    return with_band(case, plan, sweep.sweep(case, plan), options, done)


@pytest.mark.slow
def test_the_document_has_narrower_intervals_of_the_same_samples(ballscrew):
    """Those of a band of their level; a file has none of them."""
    vary = ("--vary", "screw_speed=300, 1500 rpm", "--output", "screw_torque", "--samples", "128")
    found = json.loads(ballscrew("sweep", DRIVE, *vary, "--band", "--json").stdout)["outputs"]
    assert [one["level"] for one in found["screw_torque"]["inner"]] == [0.5, 0.8]
    assert "inner" not in found["valid"]
    for one in found["screw_torque"]["inner"]:
        options = (*vary, "--level", str(one["level"]), "--json")
        alone = json.loads(ballscrew("sweep", DRIVE, *options).stdout)["outputs"]["screw_torque"]
        assert (one["low"], one["high"]) == (alone["low"], alone["high"])
        # only what is narrower than the band itself
        assert [each["level"] for each in alone.get("inner", [])] == [0.5] * (one["level"] > 0.5)
    case = case_file.load(DRIVE)
    assert not [name for name in swept(case, ["screw_speed=300 rpm"]) if name.endswith(("_of_50", "_of_80"))]


#: The section of each axis in a case file.
SECTIONS = {
    "screw_conformity": "screw", "axial_load": "operation", "temperature": "lubricant", "nut.preload": "",
    "lead": "screw", "friction.boundary_friction_coefficient": "model",
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize(
    ("example", "axes", "settings"),
    [
        # of an uncertain input the default goes with its value
        ("feed_drive.toml", {"screw_conformity": ["0.52", "0.55"], "axial_load": ["-2000 N", "5000 N"]}, []),
        ("feed_drive.toml", {"temperature": ["20 degC", "60 degC"]}, []),
        # a number of the oil that is given stays where the temperature is varied
        (
            "feed_drive.toml",
            {"temperature": ["20 degC", "60 degC"]},
            ["lubricant.pressure_viscosity_coefficient=15 1/GPa"],
        ),
        # another number of the model gives other laws to exchange
        ("feed_drive.toml", {"friction.boundary_friction_coefficient": ["0.08", "0.14"]}, []),
        ("vertical_axis.toml", {"nut.preload": ["500 N", "3000 N"]}, []),
        ("feed_drive.toml", {"lead": ["8 mm", "16 mm"]}, ["operation.screw_speed=6 m/min ± 0.5 m/min"]),
        # what is varied loses the ± of the file
        ("feed_drive.toml", {"axial_load": ["2000 N", "5000 N"]}, ["operation.axial_load=5000 N ± 1000 N"]),
    ],
)
def test_each_point_has_the_band_of_the_case_there(example, axes, settings):
    case = case_file.load(EXAMPLES / example, settings)
    found = swept(case, [f"{name}={', '.join(values)}" for name, values in axes.items()])
    paths = [f"{SECTIONS[name]}.{name}".removeprefix(".") for name in axes]
    for place in np.ndindex(*map(len, axes.values())):
        texts = [values[i] for values, i in zip(axes.values(), place, strict=True)]
        changes = [f"{path}={text}" for path, text in zip(paths, texts, strict=True)]
        one = compute.band(case_file.load(EXAMPLES / example, [*settings, *changes]), OPTIONS).band
        for output in ("screw_torque", "efficiency"):
            value = float(found[output][place])
            assert value == pytest.approx(one[output].value, rel=1e-9, nan_ok=True)  # the load drives: no efficiency
            ends = [float(found[f"{output}_{end}"][place]) for end in ("low", "high")]
            assert ends == pytest.approx(list(one[output].both), rel=1e-9, nan_ok=True), (changes, output)
            assert ends[1] > ends[0] or output == "efficiency"


def test_points_that_cannot_be_have_no_band_and_the_samples_are_counted():
    case = case_file.load(DRIVE)
    told = []
    found = swept(case, ["lead=5, 10, 20 mm"], ["screw_torque"], done=lambda *numbers: told.append(numbers))
    assert np.isnan(found["screw_torque_low"].to_numpy()).tolist() == [True, False, False]
    assert not found["valid_high"][0]
    assert found["invalid_share"].to_numpy()[0] == 1 > found["invalid_share"].to_numpy()[1]
    assert told[-1] == (2 * 64, 2 * 64)


@pytest.mark.slow
def test_files_have_the_ends_beside_the_values(tmp_path, ballscrew):
    wanted = ("--vary", "axial_load=1000, 2000 N", "--output", "screw_torque", "--samples", "64")
    rows = list(csv.reader(io.StringIO(ballscrew("sweep", DRIVE, *wanted).stdout)))
    assert rows[0] == [
        "axial load [N]",
        "screw torque [N m]",
        "screw torque low [N m]",
        "screw torque high [N m]",
        "valid",
    ]
    path = tmp_path / "band.nc"
    assert ballscrew("sweep", DRIVE, *wanted, "--to", path).returncode == 0
    with xr.open_dataset(path, engine="h5netcdf") as stored:
        assert stored["screw_torque_low"].attrs["units"] == "N m"
        assert stored.attrs["band_samples"] == 64
        for row, low, high in zip(rows[1:], stored["screw_torque_low"], stored["screw_torque_high"], strict=True):
            assert [float(row[2]), float(row[3])] == pytest.approx([float(low), float(high)])
    # two axes: a table has no room for three numbers a point
    both = ballscrew("sweep", DRIVE, *wanted, "--vary", "screw_speed=100, 200 rpm")
    assert len(both.stdout.splitlines()) == 5


def test_options_of_a_band_are_checked_before_it():
    with pytest.raises(InputError, match=r"^--samples"):
        swept(case_file.load(DRIVE), ["screw_speed=100, 200 rpm"], options=BandOptions(samples=1))
