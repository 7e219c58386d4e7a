"""A large sweep killed again and again at random times: the store is the one of a run that was never killed."""

import random
import signal
import sys
import time
import zlib
from pathlib import Path

import pytest

import ballscrew as bs
from support.stores import started

pytest.importorskip("zarr", reason="zarr is not installed (the extra data)")
pytestmark = [pytest.mark.long, pytest.mark.skipif(sys.platform == "win32", reason="there is no SIGKILL")]

POINTS = 20_000_000
KILLS = 10


def started_large(path):
    return started(path, 0, (200, 500, 200), 40_000)


def wait_for_a_block(process, path, before=0):
    while finished(path) <= before and process.poll() is None:
        time.sleep(0.002)


def seconds_of(path):
    """Seconds to the first new block of a run, and from there to its end; and what it logged."""
    start, before = time.perf_counter(), finished(path)
    process = started_large(path)
    wait_for_a_block(process, path, before)
    begun = time.perf_counter()
    _, said = process.communicate()
    assert process.returncode == 0, said
    return begun - start, time.perf_counter() - begun, said


def digests(folder):
    return {p.relative_to(folder).as_posix(): zlib.crc32(p.read_bytes()) for p in folder.rglob("*") if p.is_file()}


def finished(path: Path) -> int:
    return len(list((path / ".ballscrew" / "blocks").glob("*")))


def test_killed_ten_times_the_store_is_the_same(tmp_path, capsys):
    whole, path = tmp_path / "whole.zarr", tmp_path / "map.zarr"
    starting, filling, _ = seconds_of(whole)
    times = random.Random(2005)
    kept, logged = [], ""
    for kill in range(KILLS):
        process = started_large(path)
        if kill % 5:  # while blocks are written; the others as the process starts
            wait_for_a_block(process, path, finished(path))
            time.sleep(times.uniform(0, filling / KILLS))
        else:
            time.sleep(times.uniform(0, starting))
        process.send_signal(signal.SIGKILL)
        _, said = process.communicate()
        assert process.returncode == -signal.SIGKILL, said
        logged += said
        kept.append(finished(path))
    *rest, said = seconds_of(path)
    assert logged + said == ""  # no finished block was damaged by a kill
    assert kept == sorted(kept)
    assert kept[-1] > 0
    assert digests(path) == digests(whole)

    start = time.perf_counter()
    assert bs.verify(path).holds
    verified = time.perf_counter() - start
    share = verified / (starting + filling)
    with capsys.disabled():
        sys.stdout.write(
            f"\n{POINTS:,} points in {starting + filling:.1f} s; blocks at the kills: {kept}; "
            f"the rest in {sum(rest):.1f} s\n"
            f"verify: {verified:.2f} s, {share:.1%} of the sweep\n"
        )
