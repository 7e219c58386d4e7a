"""A store that is there already: opened, refused, checked, locked."""

import dataclasses
import errno
import json
import os
import socket
import subprocess
import sys
import time

import numpy as np
import pytest
import xarray as xr

import ballscrew as bs
from ballscrew.compiler.kernels import kernel
from ballscrew.engine.evaluation.evaluation import Evaluation
from ballscrew.engine.evaluation.plan import Configuration, Plan
from ballscrew.engine.sweeps import store
from ballscrew.engine.sweeps.store import Store
from ballscrew.engine.sweeps.store_check import count_false
from support.stores import AXES, MODEL, SMALL, blocks_of, files, started, stop_at

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")


# -- what is there already ------------------------------------------------------------------------


@pytest.mark.slow
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
    path = tmp_path / "whole.zarr"
    screw = dataclasses.replace(seed_screw, nut_conformity=0.53)
    with pytest.raises(bs.InputError, match=r"screw nut conformity 0\.515, not 0\.53"):
        bs.sweep(MODEL, screw, seed_oil, to=path, **SMALL)
    with pytest.raises(bs.InputError, match=r"\(hertz houpert_hertz, not exact_hertz\)"):
        bs.sweep(bs.FrictionModel.reference(), seed_screw, seed_oil, to=path, **SMALL)

    def friction(conditions):
        return 0.1 + 0.0 * conditions.film_parameter

    mine = dataclasses.replace(MODEL, friction=friction)
    with pytest.raises(bs.InputError, match="holds another sweep"):
        bs.sweep(mine, seed_screw, seed_oil, to=path, **SMALL)
    monkeypatch.setattr("ballscrew.engine.sweeps.store_plan.__version__", "99.0")
    with pytest.raises(bs.InputError, match=r"version .*, not 99\.0"):
        bs.sweep(MODEL, seed_screw, seed_oil, to=path, **SMALL)


def test_the_code_of_a_law_counts(seed_screw, seed_oil, tmp_path):
    def of(number):
        def friction(conditions):
            return number + 0.02 / (1 + conditions.film_parameter**2)

        return dataclasses.replace(MODEL, friction=friction)

    bs.sweep(of(0.1), seed_screw, seed_oil, to=tmp_path / "m.zarr", **SMALL)
    with pytest.raises(bs.InputError, match=r"formulas \w+…, not \w+…"):
        bs.sweep(of(0.2), seed_screw, seed_oil, to=tmp_path / "m.zarr", **SMALL)


def test_what_is_no_store_is_not_touched(swept, tmp_path):
    file, folder, other = (tmp_path / f"{name}.zarr" for name in "abc")
    xr.Dataset({"a": ("x", [1.0, 2.0])}).to_zarr(other, zarr_format=3, consolidated=False)
    file.write_text("mine", encoding="utf-8")
    folder.mkdir()
    (folder / "thesis.tex").write_text("mine", encoding="utf-8")
    before = files(tmp_path)
    for path in (file, folder, other):
        with pytest.raises(bs.InputError, match=r"sweep\.to: is there and is not the store of a sweep"):
            swept(path)
    assert files(tmp_path) == before
    with pytest.raises(bs.InputError, match=r"sweep\.to: cannot be written .*Not a directory"):
        swept(file / "map.zarr")
    with pytest.raises(bs.InputError, match=r"is not in a file system .*give the path of a folder"):
        swept("s3://bucket/map.zarr")


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


@pytest.mark.slow
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

        def noted(plan, engine=None, of=of, chosen=chosen, **how):
            chosen.append(engine)
            return of(plan, engine, **how)

        monkeypatch.setattr(Evaluation, "of", noted)
        swept(path)
        monkeypatch.undo()
        assert chosen == [engine]
        swept(tmp_path / f"{engine} whole.zarr", engine=engine)
        assert files(path) == files(tmp_path / f"{engine} whole.zarr")
    monkeypatch.setattr(kernel, "available", lambda: False)
    with pytest.raises(bs.InputError, match="was begun with the engine compiled") as caught:
        swept(tmp_path / "compiled.zarr")
    assert 'pip install "ballscrew[fast]"' in str(caught.value)


def test_what_is_varied_alone_is_not_written(swept, tmp_path):
    with pytest.raises(bs.InputError, match=r"sweep\.outputs: are what is varied"):
        swept(tmp_path / "map.zarr", outputs=["ball_to_ball_force"], ball_to_ball_force=[0.0, 0.1])
    assert not (tmp_path / "map.zarr").exists()


def test_without_zarr_the_extra_is_named(swept, tmp_path, monkeypatch):
    monkeypatch.setattr(store.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(bs.InputError, match=r'sweep\.to: needs zarr .* pip install "ballscrew\[data\]"'):
        swept(tmp_path / "map.zarr")


# -- counts ---------------------------------------------------------------------------------------


def opened(path, seed_screw, seed_oil):
    varied = {name: value for name, value in SMALL.items() if name in AXES}
    plan = Plan.of(Configuration(MODEL, seed_screw, seed_oil), SMALL["outputs"], varied)
    return Store.of(path, plan, block_size=SMALL["block_size"])[0]


@pytest.mark.usefixtures("whole")
def test_what_is_false_is_counted(seed_screw, seed_oil, tmp_path):
    valid = xr.open_zarr(tmp_path / "whole.zarr", chunks=None)["valid"].to_numpy()
    assert 0 < valid.sum() < valid.size
    first = opened(tmp_path / "whole.zarr", seed_screw, seed_oil)
    number = next(n for n in range(first.blocks.count) if not valid[first.blocks.region(n)].all())
    assert count_false(tmp_path / "whole.zarr") == {"valid": (int((~valid).sum()), number)}


# -- one writer at a time -------------------------------------------------------------------------


@pytest.mark.slow
def test_two_processes_do_not_write_into_one_store(swept, whole, tmp_path):
    path = tmp_path / "map.zarr"
    process = started(path, 0.05)
    try:
        end = time.monotonic() + 300
        while len(blocks_of(path)) < 2 and time.monotonic() < end:
            time.sleep(0.01)
        from ballscrew.evidence.papers.olaru2005 import OIL, SCREW

        host = socket.gethostname()
        with pytest.raises(bs.InputError, match=rf"is being written by process {process.pid} on {host} .*lock"):
            bs.sweep(
                MODEL,
                SCREW,
                OIL,
                to=path,
                block_size=20_000,
                outputs=["screw_torque", "efficiency", "valid"],
                axial_load=np.linspace(10, 4000, 100),
                screw_speed=np.linspace(1, 100, 200),
                viscosity=np.linspace(0.05, 0.5, 100),
            )
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


@pytest.mark.slow
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
    fcntl = pytest.importorskip("fcntl", reason="this system has no fcntl")

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
