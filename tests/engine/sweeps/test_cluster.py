"""Sweeps on a cluster: a real scheduler and real worker processes on this machine, one of which is killed."""

import asyncio
import contextlib
import dataclasses
import json
import os
import signal
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import ballscrew as bs
from ballscrew.engine.sweeps import cluster as clusters
from ballscrew.evidence.papers.olaru2005 import OIL, SCREW
from support.stores import files

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")
distributed = pytest.importorskip("distributed", reason="distributed is not installed (the extra cluster)")

pytestmark = [
    pytest.mark.slow,
    pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL"),
    # tornado leaves it to the garbage collector to close the sockets of a worker that was killed
    pytest.mark.filterwarnings("ignore:unclosed:ResourceWarning"),
]

PATIENCE = 60
SWEPT = {
    "outputs": ["screw_torque", "efficiency", "valid"],
    "block_size": 5_000,
    "axial_load": np.linspace(10, 4000, 40),
    "screw_speed": np.linspace(1, 100, 100),
    "viscosity": np.linspace(0.05, 0.5, 100),
}
BLOCKS = 80


def sweep(to, model=bs.FrictionModel.olaru2005, **given):
    return bs.sweep(model(), SCREW, OIL, to=to, **(SWEPT | given))


def until(true, what):
    end = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < end, what
        time.sleep(0.01)


class Cluster:
    """A scheduler and workers, each a process of its own."""

    def __init__(self, folder):
        self.folder = folder
        self.file = folder / "scheduler.json"
        self.processes = []
        self.workers = []
        options = "--host 127.0.0.1 --port 0 --no-dashboard --dashboard-address :0 --no-show"
        self._start("scheduler", *options.split())
        until(lambda: self._written_address() is not None, "no scheduler")
        self.address = self._written_address()

    def _written_address(self):
        """The address that the scheduler wrote; None until it has written all of its file."""
        try:
            return json.loads(self.file.read_text(encoding="utf-8"))["address"]
        except (OSError, ValueError, KeyError):
            return None

    def _start(self, what, *options):
        log = (self.folder / f"{what}-{len(self.processes)}.log").open("wb")
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", "--scheduler-file", str(self.file), *options]
        with log:
            process = subprocess.Popen(command, stdout=log, stderr=log, cwd=self.folder)
        self.processes.append(process)
        return process

    def add_worker(self, threads=1):
        options = ("--host", "127.0.0.1", "--no-nanny", "--no-dashboard", "--nthreads", str(threads))
        self.workers.append(self._start("worker", *options, "--local-directory", str(self.folder)))

    def stop(self):
        for process in self.processes:
            process.kill()
        for process in self.processes:
            process.wait()


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    running = Cluster(tmp_path_factory.mktemp("cluster"))
    try:
        running.add_worker()
        running.add_worker()
        yield running
    finally:
        running.stop()


@pytest.fixture
def client(cluster):
    with distributed.Client(cluster.address, timeout=PATIENCE, set_as_default=False) as client:
        client.wait_for_workers(1, timeout=PATIENCE)
        yield client


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The files of a run without a cluster."""
    folder = tmp_path_factory.mktemp("local") / "map.zarr"
    sweep(folder)
    return files(folder)


def test_a_worker_is_killed_and_the_store_is_the_same(cluster, client, whole, tmp_path):
    client.wait_for_workers(2, timeout=PATIENCE)
    killed, told = cluster.workers[0], []

    def kill(finished, total):
        told.append(finished)
        if finished >= total // 4 and killed.poll() is None:
            killed.send_signal(signal.SIGKILL)
            killed.wait()

    sweep(tmp_path / "map.zarr", cluster=client, done=kill)
    assert killed.returncode == -signal.SIGKILL
    assert told == sorted(told)
    assert told[-1] == 400_000
    assert files(tmp_path / "map.zarr") == whole


def test_begun_here_and_gone_on_with_there(client, whole, tmp_path):
    path = tmp_path / "map.zarr"

    def stop(finished, total):
        if finished > total // 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        sweep(path, done=stop)
    before = {block.name: block.stat().st_mtime_ns for block in (path / ".ballscrew" / "blocks").iterdir()}
    assert 30 < len(before) < BLOCKS
    assert sweep(path, cluster=client).sizes["axial_load"] == 40
    assert files(path) == whole
    # and a complete one is opened at once
    sweep(path, cluster=client, done=lambda *_: pytest.fail("computed again"))


def test_stopped_there_and_gone_on_with_here(client, whole, tmp_path):
    path = tmp_path / "map.zarr"

    def stop(finished, total):
        if finished > total // 4:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt) as caught:
        sweep(path, done=stop, cluster=client)
    assert "of 80 blocks are finished · run the same again" in caught.value.__notes__[0]
    sweep(path)
    assert files(path) == whole


def test_a_model_of_the_user_goes_to_the_workers(client, tmp_path):
    def friction(conditions):
        return 0.02 + 0.18 / (1 + conditions.film_parameter**2) ** 0.5

    def model():
        return dataclasses.replace(bs.FrictionModel.olaru2005(), friction=friction)

    small = {"axial_load": [100.0, 1000.0], "block_size": 10_000}
    there = sweep(tmp_path / "there.zarr", model, cluster=client, **small)
    assert there["efficiency"].notnull().all()
    sweep(tmp_path / "here.zarr", model, **small)
    assert files(tmp_path / "there.zarr") == files(tmp_path / "here.zarr")


def test_a_model_that_cannot_be_compared_goes_to_the_workers(client, tmp_path):
    """Only its package is compared there: the model comes with the store."""

    def friction(conditions):
        return np.interp(conditions.film_parameter, [0.0, 3.0], [0.2, eval("0.02")])

    def model():
        return dataclasses.replace(bs.FrictionModel.olaru2005(), friction=friction)

    small = {"axial_load": [100.0, 1000.0], "block_size": 10_000}
    assert sweep(tmp_path / "map.zarr", model, cluster=client, **small)["efficiency"].notnull().all()
    with pytest.raises(bs.InputError, match=r"cannot be gone on with, .* \(.*friction, which calls eval\)"):
        sweep(tmp_path / "map.zarr", model, cluster=client, **small)


def test_a_fault_in_a_law_of_the_user_is_raised(client, tmp_path):
    def faulty(conditions):
        raise ZeroDivisionError("mine")

    def model():
        return dataclasses.replace(bs.FrictionModel.olaru2005(), friction=faulty)

    with pytest.raises(ZeroDivisionError, match="mine"):
        sweep(tmp_path / "map.zarr", model, cluster=client)


def test_workers_that_see_another_disk_are_refused(client, tmp_path, monkeypatch):
    """Each block asks whether the plan of its store is there; here it is gone once the tasks are sent."""
    path = tmp_path / "map.zarr"

    def hide(finished, total):
        (path / ".ballscrew" / "plan.json").unlink(missing_ok=True)

    with pytest.raises(
        bs.InputError, match=r"sweep\.to: is not seen by a worker .* give a folder that all nodes share"
    ):
        sweep(path, cluster=client, done=hide)
    assert not path.exists()


def test_a_worker_with_a_full_disk_stops_the_sweep(client, tmp_path):
    from ballscrew.engine.sweeps.store import UnfinishedSweepError

    def full():
        import errno

        from ballscrew.engine.sweeps import store

        def fsync(descriptor):
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

        store.os.fsync, store.os.real_fsync = fsync, store.os.fsync

    def empty():
        from ballscrew.engine.sweeps import store

        store.os.fsync = getattr(store.os, "real_fsync", store.os.fsync)

    # a worker that takes the place of one that a test before has killed may come only now, and has room
    client.run(full)
    try:
        with pytest.raises(UnfinishedSweepError, match=r"No space left.* \d+ of 80 blocks are finished · make room"):
            sweep(tmp_path / "map.zarr", cluster=client)
    finally:
        client.run(empty)


# -- what is refused ------------------------------------------------------------------------------


def test_a_cluster_needs_a_store(client):
    with pytest.raises(bs.InputError, match=r'sweep\.cluster: needs a store · add to="map\.zarr"'):
        sweep(None, cluster=client)


def test_what_is_no_client_is_refused(tmp_path):
    with pytest.raises(bs.InputError, match=r"sweep\.cluster: is not a client of a cluster"):
        sweep(tmp_path / "map.zarr", cluster="tcp://127.0.0.1:8786")
    assert not (tmp_path / "map.zarr").exists()


def test_a_scheduler_without_workers_is_refused(tmp_path, monkeypatch):
    monkeypatch.setattr(clusters, "TIMEOUT", 1.0)
    alone = Cluster(tmp_path)
    try:
        with (
            distributed.Client(alone.address, timeout=PATIENCE, set_as_default=False) as client,
            pytest.raises(bs.InputError, match=r"sweep\.cluster: has no workers .* dask worker tcp://"),
        ):
            sweep(tmp_path / "map.zarr", cluster=client)
        assert not (tmp_path / "map.zarr").exists()
    finally:
        alone.stop()


def test_without_distributed_the_extra_is_named(tmp_path, monkeypatch):
    monkeypatch.setattr(clusters.importlib.util, "find_spec", lambda name: None)
    with pytest.raises(bs.InputError, match=r'sweep\.cluster: needs distributed · pip install "ballscrew\[cluster\]"'):
        sweep(tmp_path / "map.zarr", cluster=object())
    with contextlib.ExitStack() as stack, pytest.raises(bs.InputError, match="needs distributed"):
        stack.enter_context(clusters.cluster_client("tcp://127.0.0.1:8786"))


@pytest.mark.parametrize("address", ["nonsense", "foo://host:1", "tcp://127.0.0.1:1", "tcp://host.invalid:8786", ""])
def test_a_wrong_address_is_refused(address, monkeypatch):
    monkeypatch.setattr(clusters, "TIMEOUT", 1.0)
    with contextlib.ExitStack() as stack, pytest.raises(bs.InputError, match="no scheduler answers") as caught:
        stack.enter_context(clusters.cluster_client(address))
    assert len(caught.value.lines()) == 1


def test_a_thread_that_runs_an_event_loop_gets_the_same_answer():
    """A notebook runs one, and so does a thread that drives a browser."""

    async def scene():
        with clusters.cluster_client("tcp://127.0.0.1:9"):
            raise AssertionError("nobody listens at port 9")

    with ThreadPoolExecutor(1) as thread, pytest.raises(bs.InputError, match="no scheduler answers"):
        thread.submit(asyncio.run, scene()).result()
