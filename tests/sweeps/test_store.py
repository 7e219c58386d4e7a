"""Sweeps on disk: the same dataset as in memory, and the same files whatever stopped the work."""

import errno
import json
import math
import os
import shutil
import signal
import socket
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
from ballscrew.analyses import store as stores
from ballscrew.analyses.evaluation import Evaluation
from ballscrew.analyses.nut_parts import NutParts
from ballscrew.analyses.plan import Plan, Subject
from ballscrew.analyses.store import Store, Unfinished
from ballscrew.analyses.store_plan import BLOCK_BYTES, Blocks
from ballscrew.analyses.store_rows import crc, false_in, rows
from ballscrew.engine import kernel as kernels

pytest.importorskip("zarr")

RPM = math.pi / 30
MODEL = bs.FrictionModel.olaru2005()
AXES = {
    "axial_load": np.linspace(10, 4000, 7),
    "screw_speed": np.linspace(1, 100, 9),
    "viscosity": [0.05, 0.1, 0.3],
}
SMALL = {"outputs": ["screw_torque", "efficiency", "valid"], "block_size": 12, **AXES}


def files(folder):
    """All that lies in a folder, byte for byte."""
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def times(folder, names):
    return {name: (folder / name).stat().st_mtime_ns for name in names}


@pytest.fixture
def swept(seed_screw, seed_oil):
    def sweep(to=None, **given):
        return bs.sweep(MODEL, seed_screw, seed_oil, **(SMALL | given), **({} if to is None else {"to": to}))

    return sweep


@pytest.fixture
def whole(swept, tmp_path):
    """The files of a run that nobody stopped."""
    swept(tmp_path / "whole.zarr")
    return files(tmp_path / "whole.zarr")


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


@pytest.mark.parametrize(
    ("case", "block_size"), [*((case, size) for case in cases_of_axes() for size in (5, None)), ("two named axes", 1)]
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


def test_a_whole_nut(seed_screw, seed_oil, tmp_path):
    parts = NutParts(nut=bs.SingleNut())
    axes = {"axial_load": np.linspace(10, 4000, 40), "screw_speed": [1.0, 60.0]}
    found = bs.sweep(
        bs.FrictionModel.corrected(), seed_screw, seed_oil, nut=parts, to=tmp_path / "m.zarr", block_size=9, **axes
    )
    expected = bs.sweep(bs.FrictionModel.corrected(), seed_screw, seed_oil, nut=parts, **axes)
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
    plan = Plan.of(Subject(MODEL, seed_screw, seed_oil), None, AXES)
    sizes = {f"axis_{i}": size for i, size in enumerate(shape)}
    plan = Plan(plan.subject, plan.axes, sizes, plan.outputs)
    point = sum(np.dtype(output.dtype).itemsize for output in plan.wanted.values())
    blocks = Blocks.of(plan)
    assert blocks.largest * point <= BLOCK_BYTES
    assert blocks.largest * point > BLOCK_BYTES / 3 or blocks.count == 1


# -- stopped, and gone on with --------------------------------------------------------------------

KILLED = """
import sys, time
import numpy as np
import ballscrew as bs
from ballscrew.analyses.olaru2005 import OIL, SCREW
bs.sweep(
    bs.FrictionModel.olaru2005(), SCREW, OIL, outputs=["screw_torque", "efficiency", "valid"], to=sys.argv[1],
    block_size=20_000, done=lambda finished, total: time.sleep(float(sys.argv[2])),
    axial_load=np.linspace(10, 4000, 100), screw_speed=np.linspace(1, 100, 200), viscosity=np.linspace(0.05, 0.5, 100),
)
"""
KILLED_BLOCKS = 100


def started(path, pause):
    return subprocess.Popen([sys.executable, "-c", KILLED, str(path), str(pause)], stderr=subprocess.PIPE)


def blocks_of(path):
    return list((path / ".ballscrew" / "blocks").glob("*"))


@pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")
def test_killed_in_the_middle_it_goes_on_where_it_was(tmp_path, monkeypatch):
    path = tmp_path / "map.zarr"
    for least in (20, 60):
        process = started(path, 0.01)
        end = time.monotonic() + 60
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
    _, said = process.communicate(timeout=60)
    assert process.returncode == 0, said
    assert (times(path, chunks), {name: (path / name).read_bytes() for name in chunks}) == before
    monkeypatch.setattr(sys, "argv", ["", str(tmp_path / "whole.zarr"), "0"])
    exec(KILLED, {})
    assert files(path) == files(tmp_path / "whole.zarr")


def test_killed_before_any_rename_it_goes_on(swept, tmp_path, monkeypatch):
    """Before each rename the folder is set aside as a kill at that moment would leave it; each goes on to the same."""
    monkeypatch.setattr("ballscrew.analyses.stream.WRITERS", 1)  # one rename at a time
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


def stop_at(number, error, monkeypatch):
    """Let the commit of a block end otherwise."""
    commit = Store.commit

    def committed(self, block, *others):
        if block == number:
            raise error
        commit(self, block, *others)

    monkeypatch.setattr(Store, "commit", committed)


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


def test_an_unfinished_store_is_not_taken_for_a_finished_one(swept, tmp_path, monkeypatch):
    stop_at(4, KeyboardInterrupt(), monkeypatch)
    with pytest.raises(KeyboardInterrupt):
        swept(tmp_path / "map.zarr")
    with pytest.raises(FileNotFoundError):
        xr.open_zarr(tmp_path / "map.zarr", chunks=None)


def test_a_fault_in_a_law_of_the_user_is_raised(seed_screw, seed_oil, tmp_path):
    import dataclasses

    def faulty(film_parameter, conditions, full_film):
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
    with pytest.raises(Unfinished) as caught:
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
    with pytest.raises(Unfinished, match=r"32 of 35 blocks are finished · make room") as caught:
        swept(path, **many)
    assert caught.value.errno == errno.ENOSPC
    assert 0 < len(blocks_of(path)) < 35
    assert not (path / ".ballscrew" / "temporary").exists()
    # more room elsewhere: the folder may be moved
    shutil.copytree(path, tmp_path / "map.zarr")
    swept(tmp_path / "map.zarr", **many)
    swept(tmp_path / "whole.zarr", **many)
    assert files(tmp_path / "map.zarr") == files(tmp_path / "whole.zarr")


# -- what is there already ------------------------------------------------------------------------


def test_a_complete_store_is_opened_at_once(swept, whole, tmp_path, monkeypatch):
    path = tmp_path / "whole.zarr"
    before = times(path, whole)
    monkeypatch.setattr(Evaluation, "fill", lambda *_, **__: pytest.fail("computed again"))
    xr.testing.assert_identical(swept(path).load(), xr.open_zarr(path, chunks=None).load())
    assert times(path, whole) == before


@pytest.mark.parametrize(
    ("other", "said"),
    [
        ({"lead": 0.01}, r"lead missing, not 0\.01"),
        ({"viscosity": [0.05, 0.1, 0.2]}, r"viscosity \w+…, not \w+…"),
        ({"viscosity": [0.05, 0.1]}, "grid .* x viscosity 3, not .* x viscosity 2"),
        ({"outputs": ["screw_torque", "valid"]}, "efficiency float64, not missing"),
        ({"block_size": 50}, r"chunks \[1, 3, 3\], not \[1, 9, 3\]"),
        pytest.param({"engine": "compiled"}, "engine numpy, not compiled", marks=pytest.mark.compiles),
    ],
)
@pytest.mark.usefixtures("whole")
def test_another_sweep_is_refused_and_said(other, said, swept, tmp_path):
    path = tmp_path / "whole.zarr"
    before = files(path)
    with pytest.raises(bs.InputError, match=rf"sweep\.to: holds another sweep \({said}\) · choose another name"):
        swept(path, **other)
    assert files(path) == before


@pytest.mark.usefixtures("whole")
def test_other_fixed_inputs_laws_and_versions_are_refused(seed_screw, seed_oil, tmp_path, monkeypatch):
    import dataclasses

    path = tmp_path / "whole.zarr"
    screw = dataclasses.replace(seed_screw, nut_conformity=0.53)
    with pytest.raises(bs.InputError, match=r"screw nut conformity 0\.515, not 0\.53"):
        bs.sweep(MODEL, screw, seed_oil, to=path, **SMALL)
    with pytest.raises(bs.InputError, match=r"\(hertz houpert_hertz, not exact_hertz\)"):
        bs.sweep(bs.FrictionModel.reference(), seed_screw, seed_oil, to=path, **SMALL)

    def friction(film_parameter, conditions, full_film):
        return 0.1 + 0.0 * film_parameter

    mine = dataclasses.replace(MODEL, friction=friction)
    with pytest.raises(bs.InputError, match="holds another sweep"):
        bs.sweep(mine, seed_screw, seed_oil, to=path, **SMALL)
    monkeypatch.setattr(bs, "__version__", "99.0")
    with pytest.raises(bs.InputError, match=r"version .*, not 99\.0"):
        bs.sweep(MODEL, seed_screw, seed_oil, to=path, **SMALL)


def test_the_code_of_a_law_counts(seed_screw, seed_oil, tmp_path):
    import dataclasses

    def of(number):
        def friction(film_parameter, conditions, full_film):
            return number + 0.02 / (1 + film_parameter**2)

        return dataclasses.replace(MODEL, friction=friction)

    bs.sweep(of(0.1), seed_screw, seed_oil, to=tmp_path / "m.zarr", **SMALL)
    with pytest.raises(bs.InputError, match=r"formulas \w+…, not \w+…"):
        bs.sweep(of(0.2), seed_screw, seed_oil, to=tmp_path / "m.zarr", **SMALL)


def test_what_is_no_store_is_not_touched(swept, tmp_path):
    file, folder = tmp_path / "a.zarr", tmp_path / "b.zarr"
    file.write_text("mine", encoding="utf-8")
    folder.mkdir()
    (folder / "thesis.tex").write_text("mine", encoding="utf-8")
    before = files(tmp_path)
    for path in (file, folder):
        with pytest.raises(bs.InputError, match=r"sweep\.to: is there and is not the store of a sweep"):
            swept(path)
    assert files(tmp_path) == before
    with pytest.raises(bs.InputError, match=r"sweep\.to: cannot be written .*Not a directory"):
        swept(file / "map.zarr")
    with pytest.raises(bs.InputError, match=r"is not in a file system .*give the path of a folder"):
        swept("s3://bucket/map.zarr")


def test_a_zarr_of_others_is_not_touched(swept, tmp_path):
    path = tmp_path / "other.zarr"
    xr.Dataset({"a": ("x", [1.0, 2.0])}).to_zarr(path, zarr_format=3, consolidated=False)
    before = files(path)
    with pytest.raises(bs.InputError, match="is not the store of a sweep"):
        swept(path)
    assert files(path) == before


def test_an_empty_folder_will_do(swept, whole, tmp_path):
    (tmp_path / "map.zarr").mkdir()
    swept(tmp_path / "map.zarr")
    assert files(tmp_path / "map.zarr") == whole


@pytest.mark.usefixtures("whole")
def test_a_changed_plan_is_seen(swept, tmp_path):
    plan = tmp_path / "whole.zarr" / ".ballscrew" / "plan.json"
    kept = json.loads(plan.read_text(encoding="utf-8"))
    kept["plan"]["attributes"]["screw_lead"] = 0.006
    for text in (json.dumps(kept), "{", "[]"):
        plan.write_text(text, encoding="utf-8")
        with pytest.raises(bs.InputError, match=r"has a damaged plan .*plan\.json"):
            swept(tmp_path / "whole.zarr")


@pytest.mark.compiles
def test_the_engine_stays_what_it_was(swept, tmp_path, monkeypatch):
    for engine in ("numpy", "compiled"):
        path = tmp_path / f"{engine}.zarr"
        stop_at(4, KeyboardInterrupt(), monkeypatch)
        with pytest.raises(KeyboardInterrupt):
            swept(path, engine=engine)
        monkeypatch.undo()
        chosen = []
        of = Evaluation.of

        def noted(plan, engine=None, of=of, chosen=chosen):
            chosen.append(engine)
            return of(plan, engine)

        monkeypatch.setattr(Evaluation, "of", noted)
        swept(path)
        monkeypatch.undo()
        assert chosen == [engine]
        swept(tmp_path / f"{engine} whole.zarr", engine=engine)
        assert files(path) == files(tmp_path / f"{engine} whole.zarr")
    monkeypatch.setattr(kernels, "available", lambda: False)
    with pytest.raises(bs.InputError, match="was begun with the engine compiled") as caught:
        swept(tmp_path / "compiled.zarr")
    assert 'pip install "ballscrew[fast]"' in str(caught.value)


def test_what_is_varied_alone_is_not_written(swept, tmp_path):
    with pytest.raises(bs.InputError, match=r"sweep\.outputs: are what is varied"):
        swept(tmp_path / "map.zarr", outputs=["ball_to_ball_force"], ball_to_ball_force=[0.0, 0.1])
    assert not (tmp_path / "map.zarr").exists()


def test_without_zarr_the_extra_is_named(swept, tmp_path, monkeypatch):
    monkeypatch.setattr(stores.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(bs.InputError, match=r'sweep\.to: needs zarr .* pip install "ballscrew\[data\]"'):
        swept(tmp_path / "map.zarr")


# -- checksums ------------------------------------------------------------------------------------


def opened(path, seed_screw, seed_oil):
    varied = {name: value for name, value in SMALL.items() if name in AXES}
    plan = Plan.of(Subject(MODEL, seed_screw, seed_oil), SMALL["outputs"], varied)
    return Store.of(path, plan, block_size=SMALL["block_size"])[0]


def damaged(store):
    """The blocks whose numbers are not those of the checksums."""
    dataset, found = store.opened(), []
    for row in rows(store.path):
        region = dict(zip(store.plan.sizes, store.blocks.region(int(row["block"])), strict=True))
        if any(crc(dataset[name].isel(region).to_numpy()) != row[name] for name in store.variables):
            found.append(int(row["block"]))
    return found


@pytest.mark.usefixtures("whole")
def test_damage_can_be_told_by_the_checksums(seed_screw, seed_oil, tmp_path):
    path = tmp_path / "whole.zarr"
    store = opened(path, seed_screw, seed_oil)
    assert damaged(store) == []
    (path / "efficiency/c/2/1/0").unlink()
    shutil.copy(path / "screw_torque/c/0/0/0", path / "screw_torque/c/3/0/0")
    assert damaged(store) == [7, 9]


@pytest.mark.usefixtures("whole")
def test_what_is_false_is_counted(seed_screw, seed_oil, tmp_path):
    valid = xr.open_zarr(tmp_path / "whole.zarr", chunks=None)["valid"].to_numpy()
    assert 0 < valid.sum() < valid.size
    first = opened(tmp_path / "whole.zarr", seed_screw, seed_oil)
    number = next(n for n in range(first.blocks.count) if not valid[first.blocks.region(n)].all())
    assert false_in(tmp_path / "whole.zarr") == {"valid": (int((~valid).sum()), number)}


# -- one writer at a time -------------------------------------------------------------------------


def test_two_processes_do_not_write_into_one_store(swept, whole, tmp_path):
    path = tmp_path / "map.zarr"
    process = started(path, 0.05)
    try:
        end = time.monotonic() + 30
        while len(blocks_of(path)) < 2 and time.monotonic() < end:
            time.sleep(0.01)
        from ballscrew.analyses.olaru2005 import OIL, SCREW

        host = socket.gethostname()
        with pytest.raises(bs.InputError, match=rf"is being written by process {process.pid} on {host} .*lock"):
            bs.sweep(
                MODEL, SCREW, OIL, to=path, block_size=20_000, outputs=["screw_torque", "efficiency", "valid"],
                axial_load=np.linspace(10, 4000, 100), screw_speed=np.linspace(1, 100, 200),
                viscosity=np.linspace(0.05, 0.5, 100),
            )  # fmt: skip
        assert process.poll() is None
    finally:
        process.kill()
        process.communicate()


def test_a_sweep_within_a_sweep_is_refused(swept, tmp_path):
    with pytest.raises(bs.InputError, match=f"is being written by process {os.getpid()}"):
        swept(tmp_path / "map.zarr", done=lambda *_: swept(tmp_path / "map.zarr"))


def dead_process():
    process = subprocess.Popen([sys.executable, "-c", ""])
    process.wait()
    return process.pid


@pytest.mark.parametrize("text", ["", "{", "dead", "mine"])
def test_a_lock_left_behind_is_taken_over(text, swept, whole, tmp_path):
    """Whoever wrote it is dead, though another process may have its number now: the system's lock tells."""
    path = tmp_path / "map.zarr"
    (path / ".ballscrew").mkdir(parents=True)
    if text in ("dead", "mine"):
        process = dead_process() if text == "dead" else os.getpid()
        text = json.dumps({"process": process, "host": socket.gethostname()})
    (path / ".ballscrew" / "lock").write_text(text, encoding="utf-8")
    swept(path)
    assert files(path) == whole


def test_where_there_are_no_locks_the_process_is_asked_for(swept, whole, tmp_path, monkeypatch):
    fcntl = pytest.importorskip("fcntl")

    def none(*_):
        raise OSError(errno.ENOLCK, os.strerror(errno.ENOLCK))

    monkeypatch.setattr(fcntl, "flock", none)
    path = tmp_path / "map.zarr"
    lock = path / ".ballscrew" / "lock"
    lock.parent.mkdir(parents=True)
    lock.write_text(json.dumps({"process": os.getppid(), "host": socket.gethostname()}), encoding="utf-8")
    with pytest.raises(bs.InputError, match=f"is being written by process {os.getppid()}"):
        swept(path)
    lock.write_text(json.dumps({"process": dead_process(), "host": socket.gethostname()}), encoding="utf-8")
    swept(path)
    assert files(path) == whole


def test_a_lock_of_another_host_counts(swept, tmp_path):
    path = tmp_path / "map.zarr"
    (path / ".ballscrew").mkdir(parents=True)
    lock = path / ".ballscrew" / "lock"
    lock.write_text(json.dumps({"process": 1, "host": "elsewhere"}), encoding="utf-8")
    with pytest.raises(bs.InputError, match=rf"by process 1 on elsewhere .* if it is gone, remove {lock}"):
        swept(path)
