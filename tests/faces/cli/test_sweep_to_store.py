"""Sweeps into a Zarr store from the command line: what is said, what is left, and the exit code."""

import os
import shutil
import signal
import subprocess
import sys
import time

import pytest

from ballscrew.basis.errors import InputError
from ballscrew.cases.case_files import case_file
from ballscrew.questions.sweep import compute

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")

AXES = ("--vary", "axial_load=10:4000:30 N", "--vary", "screw_speed=1:1000:40 rpm")
#: A sweep that nobody waits for.
ENDLESS = (
    "--vary", "axial_load=10:4000:1000 N", "--vary", "screw_speed=1:1000:1000 rpm",
    "--vary", "viscosity=0.05:0.5:1000 Pa s", "--output", "efficiency",
)  # fmt: skip


def fault(process, *words):
    assert process.returncode == 2, process.stderr
    assert len(process.stderr.splitlines()) == 1
    for word in words:
        assert word in process.stderr


def files(folder):
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


@pytest.mark.slow
def test_a_complete_store_is_left_as_it_is(example, ballscrew, tmp_path):
    first = ballscrew("sweep", example, *AXES, "--to", "map.zarr")
    before = {name: (tmp_path / "map.zarr" / name).stat().st_mtime_ns for name in files(tmp_path / "map.zarr")}
    again = ballscrew("sweep", example, *AXES, "--to", "map.zarr")
    said = f"{tmp_path / 'map.zarr'}: complete already, nothing was computed\n"
    assert (again.returncode, again.stdout, again.stderr) == (0, first.stdout, said + first.stderr)
    assert {name: (tmp_path / "map.zarr" / name).stat().st_mtime_ns for name in before} == before
    other = ballscrew("sweep", example, *AXES, "--to", "map.zarr", "--set", "lubricant.viscosity=0.2 Pa s")
    fault(other, "sweep.to: holds another sweep (lubricant viscosity 0.1, not 0.2) · choose another name, or remove")


@pytest.mark.slow
def test_damage_is_said_and_repaired(example, ballscrew, tmp_path):
    first = ballscrew("sweep", example, *AXES, "--to", "map.zarr")
    before = files(tmp_path / "map.zarr")
    chunk = tmp_path / "map.zarr" / "efficiency" / "c" / "0" / "0"
    content = chunk.read_bytes()
    chunk.write_bytes(content[:-1] + bytes([content[-1] ^ 1]))
    again = ballscrew("sweep", example, *AXES, "--to", "map.zarr", "--verify")
    path = tmp_path / "map.zarr"
    said = f"{path}: 1 block is computed again: efficiency/c/0/0 has another checksum\n"
    assert (again.returncode, again.stdout, again.stderr) == (0, first.stdout, said + first.stderr)
    assert files(path) == before
    last = ballscrew("sweep", example, *AXES, "--to", "map.zarr", "--verify")
    assert last.stderr.startswith(f"{path}: complete already, all checksums hold, nothing was computed\n")


def test_the_memory_is_no_limit_of_a_store(example, tmp_path):
    case = case_file.load(example)
    vary = ["axial_load=10:4000:10000 N", "screw_speed=1:1000:10000 rpm"]
    plan = compute.plan(case, vary, [], tmp_path / "map.zarr")
    assert [len(values) for values in plan.axes.values()] == [10_000, 10_000]
    with pytest.raises(InputError, match=r"too many values .* or write to a folder: --to map\.zarr"):
        compute.plan(case, vary, [], tmp_path / "map.nc")
    with pytest.raises(InputError, match="count from 1 to 10,000,000"):
        compute.plan(case, ["axial_load=10:4000:10000001 N"], [], tmp_path / "map.zarr")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.skipif(sys.platform == "win32", reason="an interrupt is sent otherwise there")
def test_an_interrupt_ends_with_words_and_130(example, tmp_path):
    # where tests run in the background, interrupts are ignored unless asked for
    listening = "import signal; signal.signal(signal.SIGINT, signal.default_int_handler)"
    program = f"{listening}; from ballscrew.faces.cli.main import main; main()"
    command = [sys.executable, "-c", program, "sweep", str(example), *ENDLESS, "--to", "map.zarr"]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    blocks = tmp_path / "map.zarr" / ".ballscrew" / "blocks"
    end = time.monotonic() + 300
    while len(list(blocks.glob("*"))) < 2 and time.monotonic() < end:
        time.sleep(0.02)
    process.send_signal(signal.SIGINT)
    stdout, stderr = process.communicate(timeout=300)
    finished = len(list(blocks.glob("*")))
    assert process.returncode == 130, stderr
    assert stdout == ""
    assert stderr.startswith(f"{tmp_path / 'map.zarr'}: stopped, {finished} of ")
    assert stderr.endswith(" blocks are finished · run the same again to go on\n")
    assert len(stderr.splitlines()) == 1
    assert sorted(path.name for path in (tmp_path / "map.zarr" / ".ballscrew").iterdir()) == [
        "blocks",
        "layout.json",
        "plan.json",
        "zarr.json",
    ]


def test_a_full_disk_ends_with_words_and_1(example, ballscrew, tmp_path):
    mount = shutil.which("mount")
    if mount is None or os.name != "posix" or os.geteuid() != 0:
        pytest.skip("only root can mount a small file system")
    disk = tmp_path / "disk"
    disk.mkdir()
    made = subprocess.run([mount, "-t", "tmpfs", "-o", "size=32m", "tmpfs", disk], capture_output=True, check=False)
    if made.returncode:
        pytest.skip("no file system can be mounted here")
    try:
        process = ballscrew("sweep", example, *ENDLESS, "--to", disk / "map.zarr")
        finished = len(list((disk / "map.zarr" / ".ballscrew" / "blocks").iterdir()))
        assert not (disk / "map.zarr" / ".ballscrew" / "temporary").exists()
    finally:
        subprocess.run(["umount", disk], check=True)
    assert process.returncode == 1, process.stderr
    assert process.stdout == ""
    assert len(process.stderr.splitlines()) == 1
    assert f"stopped (No space left on device), {finished} of " in process.stderr
    assert process.stderr.endswith(" blocks are finished · make room and run the same again to go on\n")


# -- a cluster ------------------------------------------------------------------------------------


@pytest.mark.slow
def test_a_scheduler_that_does_not_answer(example, ballscrew, tmp_path):
    pytest.importorskip("distributed", reason="distributed is not installed (the extra cluster)")
    for address in ("tcp://127.0.0.1:1", "nonsense"):
        process = ballscrew("sweep", example, "--to", "map.zarr", "--scheduler", address)
        fault(process, f"--scheduler: no scheduler answers ({address}", "such as tcp://host:8786")
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
def test_a_sweep_on_a_cluster(example, ballscrew, tmp_path):
    distributed = pytest.importorskip("distributed", reason="distributed is not installed (the extra cluster)")
    there = {"host": "127.0.0.1", "protocol": "tcp://", "scheduler_port": 0, "dashboard_address": ":0"}
    there |= {"n_workers": 1, "threads_per_worker": 2, "processes": False, "local_directory": tmp_path / "scratch"}
    with distributed.LocalCluster(**there) as cluster:
        address = cluster.scheduler_address
        process = ballscrew("sweep", example, *AXES, "--to", "there.zarr", "--scheduler", address)
    assert process.returncode == 0, process.stderr
    here = ballscrew("sweep", example, *AXES, "--to", "here.zarr")
    assert process.stderr == here.stderr
    assert process.stdout == here.stdout.replace("here", "there")
    assert files(tmp_path / "here.zarr") == files(tmp_path / "there.zarr")
