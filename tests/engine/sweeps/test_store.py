"""Sweeps on disk: the same dataset as in memory, and the same files whatever stopped the work."""

import dataclasses
import errno
import math
import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
import xarray as xr
from hypothesis import given
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.sweeps.store import UnfinishedSweepError
from ballscrew.engine.sweeps.store_plan import BLOCK_BYTES, Blocks
from support.stores import AXES, KILLED_BLOCKS, MODEL, blocks_of, files, started, stop_at, times

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")


# -- the dataset ----------------------------------------------------------------------------------


def cases_of_axes():
    return {
        "a grid": AXES,
        "one number each": {"axial_load": 1000.0, "screw_speed": 30.0},
        "numbers beside axes": {**AXES, "lead": 0.006},
        "points that vary together": {
            name: xr.DataArray(values, dims="point")
            for name, values in (("axial_load", np.linspace(1, 4000, 50)), ("screw_speed", np.linspace(1, 90, 50)))
        },
        "labels": {
            "screw_speed": [10.0, 20.0],
            "axial_load": xr.DataArray([1e3, 2e3], dims="case", coords={"case": ["light", "heavy"]}),
        },
        "two named axes": {
            "axial_load": xr.DataArray(np.linspace(1, 4000, 30).reshape(5, 6), dims=("machine", "axis")),
            "screw_speed": xr.DataArray(np.linspace(1, 90, 6), dims="axis"),
        },
        "a coefficient": {**AXES, "friction.boundary_friction_coefficient": [0.1, 0.2]},
    }


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "block_size"), [*((case, size) for case in cases_of_axes() for size in (20, None)), ("two named axes", 1)]
)
def test_the_store_holds_the_dataset(case, block_size, seed_screw, seed_oil, tmp_path):
    axes = cases_of_axes()[case]
    expected = bs.sweep(MODEL, seed_screw, seed_oil, **axes)
    found = bs.sweep(MODEL, seed_screw, seed_oil, to=tmp_path / "map.zarr", block_size=block_size, **axes)
    assert list(found) == list(expected)
    assert found.sizes == expected.sizes
    xr.testing.assert_identical(found.load(), expected)
    with xr.open_zarr(tmp_path / "map.zarr", chunks=None) as opened:
        xr.testing.assert_identical(opened.load(), expected)


def test_values_are_read_when_they_are_asked_for(swept, tmp_path):
    found = swept(tmp_path / "map.zarr")
    assert not found["efficiency"].variable._in_memory  # xarray says it nowhere else without dask
    assert float(found["efficiency"].isel(axial_load=3, screw_speed=4, viscosity=1)) > 0


def test_cf_attributes_are_in_the_files(swept, tmp_path):
    import zarr

    swept(tmp_path / "map.zarr", lead=0.006)
    group = zarr.open_group(tmp_path / "map.zarr", mode="r")
    assert group.metadata.zarr_format == 3
    assert group["screw_torque"].attrs["units"] == "N m"
    assert group["screw_torque"].attrs["coordinates"] == "lead"
    assert group.attrs["Conventions"] == "CF-1.11"
    assert group["axial_load"].attrs["units"] == "N"
    assert sorted(name for name, _ in group.members()) == sorted(
        ["axial_load", "efficiency", "lead", "screw_speed", "screw_torque", "valid", "viscosity"]
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    "nut",
    [bs.SingleNut(angle_under_load=True), bs.DoubleNut(1000.0), bs.SingleNut(bodies=bs.Bodies())],
    ids=["angle under load", "double", "ball by ball"],
)
def test_a_whole_nut(nut, seed_screw, seed_oil, tmp_path):
    axes = {"axial_load": np.linspace(10, 4000, 40), "screw_speed": [1.0, 60.0], "engine": "numpy"}
    found = bs.sweep(
        bs.FrictionModel.corrected(), seed_screw, seed_oil, nut=nut, to=tmp_path / "m.zarr", block_size=9, **axes
    )
    expected = bs.sweep(bs.FrictionModel.corrected(), seed_screw, seed_oil, nut=nut, **axes)
    xr.testing.assert_identical(found.load(), expected)


def test_progress_is_told_in_points(swept, tmp_path):
    told = []
    swept(tmp_path / "map.zarr", done=lambda finished, total: told.append((finished, total)))
    assert told[0] == (0, 189)
    assert told[-1] == (189, 189)
    assert told == sorted(told)


def test_the_number_of_threads_changes_no_byte(swept, whole, tmp_path):
    for threads in (1, 3):
        swept(tmp_path / f"{threads}.zarr", threads=threads)
        assert files(tmp_path / f"{threads}.zarr") == whole


# -- blocks ---------------------------------------------------------------------------------------


@given(shape=st.lists(st.integers(1, 12), max_size=4).map(tuple), most=st.integers(1, 200))
def test_blocks_are_whole_chunks_and_ranges_of_the_grid(shape, most):
    class Sized:
        wanted = ()
        subject = None

    plan = Sized()
    plan.shape, plan.wanted = shape, {}
    blocks = Blocks.of(plan, most)
    grid = np.arange(math.prod(shape)).reshape(shape)
    assert blocks.largest <= max(1, most)
    seen = []
    for number in range(blocks.count):
        span = blocks.span(number)
        assert np.array_equal(grid[blocks.region(number)].ravel(), np.arange(span.start, span.stop))
        assert all(where.start % part == 0 for where, part in zip(blocks.region(number), blocks.chunk, strict=True))
        assert blocks.points(number) == span.stop - span.start <= blocks.largest
        seen += range(span.start, span.stop)
    assert seen == list(range(grid.size))


@pytest.mark.parametrize("shape", [(1000, 1000, 100), (100_000_000,), (7, 3, 3_000_001), (10_000, 10_000), (50, 20)])
def test_a_block_has_bounded_size_and_is_not_tiny(shape, seed_screw, seed_oil):
    plan = Plan.of(Configuration(MODEL, seed_screw, seed_oil), None, AXES)
    sizes = {f"axis_{i}": size for i, size in enumerate(shape)}
    plan = Plan(plan.subject, plan.axes, sizes, plan.outputs)
    point = sum(np.dtype(output.dtype).itemsize for output in plan.wanted.values())
    blocks = Blocks.of(plan)
    assert blocks.largest * point <= BLOCK_BYTES
    assert blocks.largest * point > BLOCK_BYTES / 3 or blocks.count == 1


# -- stopped, and gone on with --------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_killed_in_the_middle_it_goes_on_where_it_was(tmp_path):
    path = tmp_path / "map.zarr"
    for least in (20, 60):
        process = started(path, 0.01)
        end = time.monotonic() + 3000
        while len(blocks_of(path)) < least and time.monotonic() < end and process.poll() is None:
            time.sleep(0.002)
        process.send_signal(signal.SIGKILL)
        _, said = process.communicate()
        assert process.returncode == -signal.SIGKILL, said
    finished = [block.name for block in blocks_of(path)]
    assert 60 <= len(finished) < KILLED_BLOCKS
    assert not (path / "zarr.json").exists()
    chunks = [f"{name}/c/{number}/0/0" for number in finished for name in ("screw_torque", "efficiency")]
    before = times(path, chunks), {name: (path / name).read_bytes() for name in chunks}
    process = started(path, 0)
    _, said = process.communicate(timeout=600)
    assert process.returncode == 0, said
    assert (times(path, chunks), {name: (path / name).read_bytes() for name in chunks}) == before
    started(tmp_path / "whole.zarr", 0).communicate(timeout=600)
    assert files(path) == files(tmp_path / "whole.zarr")


@pytest.mark.slow
def test_killed_before_any_rename_it_goes_on(swept, tmp_path, monkeypatch):
    """Before each rename the folder is set aside as a kill at that moment would leave it; each goes on to the same."""
    monkeypatch.setattr("ballscrew.engine.sweeps.cluster.WRITERS", 1)  # one rename at a time
    left = []
    replace = Path.replace

    def replaced(self, target):
        left.append(tmp_path / f"left-{len(left)}" / "map.zarr")
        shutil.copytree(tmp_path / "map.zarr", left[-1])
        return replace(self, target)

    monkeypatch.setattr(Path, "replace", replaced)
    swept(tmp_path / "map.zarr", block_size=90)
    monkeypatch.undo()
    expected = files(tmp_path / "map.zarr")
    assert len(left) > 20
    for folder in left:
        assert not (folder / "zarr.json").exists()
        swept(folder, block_size=90)
        assert files(folder) == expected


def test_killed_after_the_last_rename_it_is_tidied(swept, whole, tmp_path):
    path = tmp_path / "map.zarr"
    swept(path)
    (path / ".ballscrew" / "blocks").mkdir()
    (path / ".ballscrew" / "blocks" / "0").touch()
    (path / ".ballscrew" / "temporary").mkdir()
    (path / ".ballscrew" / "lock").touch()
    swept(path)
    assert files(path) == whole


def test_an_interrupt_says_how_far_it_came(swept, whole, tmp_path, monkeypatch):
    path = tmp_path / "map.zarr"
    stop_at(4, KeyboardInterrupt(), monkeypatch)
    with pytest.raises(KeyboardInterrupt) as caught:
        swept(path)
    (words,) = caught.value.__notes__
    assert words == f"{path}: stopped, 4 of 21 blocks are finished · run the same again to go on"
    assert not (path / ".ballscrew" / "temporary").exists()
    assert not (path / ".ballscrew" / "lock").exists()
    monkeypatch.undo()
    told = []
    swept(path, done=lambda finished, total: told.append(finished))
    assert told[0] == 4 * 9
    assert files(path) == whole


def test_an_interrupt_keeps_the_block_that_is_being_written(swept, tmp_path):
    path = tmp_path / "map.zarr"

    def stop(finished, total):
        if finished > 40:  # in the fifth block, while the fourth is being written
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        swept(path, done=stop)
    assert len(blocks_of(path)) == 4


def test_a_fault_in_a_law_of_the_user_is_raised(seed_screw, seed_oil, tmp_path):
    def faulty(conditions):
        raise ZeroDivisionError("mine")

    mine = dataclasses.replace(MODEL, friction=faulty)
    with pytest.raises(ZeroDivisionError, match="mine"):
        bs.sweep(mine, seed_screw, seed_oil, axial_load=[1.0], screw_speed=1.0, to=tmp_path / "m.zarr")
    assert not (tmp_path / "m.zarr" / ".ballscrew" / "lock").exists()


# -- a full disk ----------------------------------------------------------------------------------


def test_a_full_disk_stops_with_words(swept, whole, tmp_path, monkeypatch):
    path = tmp_path / "map.zarr"
    fsync, left = os.fsync, [30]

    def full(descriptor):
        left[0] -= 1
        if left[0] < 0:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        fsync(descriptor)

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(UnfinishedSweepError) as caught:
        swept(path)
    monkeypatch.undo()
    finished = len(blocks_of(path))
    assert 0 < finished < 21
    reason = os.strerror(errno.ENOSPC)
    remedy = "make room and run the same again to go on"
    assert str(caught.value) == f"{path}: stopped ({reason}), {finished} of 21 blocks are finished · {remedy}"
    assert caught.value.errno == errno.ENOSPC
    assert not (path / ".ballscrew" / "temporary").exists()
    swept(path)
    assert files(path) == whole


@pytest.fixture
def small_disk(tmp_path):
    """A real file system of one megabyte."""
    mount = shutil.which("mount")
    if mount is None or os.name != "posix" or os.geteuid() != 0:
        pytest.skip("only root can mount a small file system")
    disk = tmp_path / "disk"
    disk.mkdir()
    made = subprocess.run([mount, "-t", "tmpfs", "-o", "size=1m", "tmpfs", disk], capture_output=True, check=False)
    if made.returncode:
        pytest.skip("no file system can be mounted here")
    yield disk
    subprocess.run(["umount", disk], check=True)


def test_a_disk_that_is_really_full(swept, small_disk, tmp_path):
    path = small_disk / "map.zarr"
    many = {"viscosity": np.linspace(0.05, 0.5, 800), "block_size": 2000}
    with pytest.raises(UnfinishedSweepError, match=r"32 of 35 blocks are finished · make room") as caught:
        swept(path, **many)
    assert caught.value.errno == errno.ENOSPC
    assert 0 < len(blocks_of(path)) < 35
    assert not (path / ".ballscrew" / "temporary").exists()
    # more room elsewhere: the folder may be moved
    shutil.copytree(path, tmp_path / "map.zarr")
    swept(tmp_path / "map.zarr", **many)
    swept(tmp_path / "whole.zarr", **many)
    assert files(tmp_path / "map.zarr") == files(tmp_path / "whole.zarr")
