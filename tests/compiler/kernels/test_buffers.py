"""Memory of large arrays: used again when nothing is in it, and never before."""

import gc
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

from ballscrew.compiler.kernels import kernel
from ballscrew.compiler.kernels.kernel import ALIGNMENT, HUGE_PAGE, LEAST_KEPT, aligned_array

needs_pieces = pytest.mark.skipif(not kernel._MAY_BE_KEPT, reason="this system cannot take memory back by itself")
LARGE = LEAST_KEPT // 8


@pytest.fixture(autouse=True)
def nothing_kept():
    kernel.forget()
    yield
    kernel.forget()


@pytest.fixture(scope="module", autouse=True)
def nothing_left():
    """Of other tests: what the garbage collector finds later would give memory back in the middle of a test."""
    gc.collect()


def address(array):
    return array.__array_interface__["data"][0]


@pytest.mark.parametrize("dtype", [float, bool])
@pytest.mark.parametrize("count", [0, 1, 7, 1000, LARGE - 1, LARGE, 3 * LARGE + 5, 9 * LARGE])
def test_arrays_are_aligned_and_have_room(count, dtype):
    array = aligned_array(count, dtype)
    assert array.shape == (count,)
    assert array.dtype == dtype
    assert count == 0 or address(array) % ALIGNMENT == 0
    array[...] = 1
    assert array.sum() == count


@needs_pieces
def test_memory_is_used_again_when_the_last_view_is_gone():
    array = aligned_array(2 * LARGE, float)
    place = address(array)
    view = array[10:20].reshape(2, 5)
    array[...] = 7.0
    del array
    other = aligned_array(2 * LARGE, float)
    other[...] = 3.0
    assert address(other) != place
    assert np.all(view == 7.0)
    del view
    assert address(aligned_array(2 * LARGE - 100, float)) == place


@needs_pieces
def test_a_piece_is_neither_too_small_nor_much_too_large():
    places = []
    for count in (16 * LARGE, 2 * LARGE):
        array = aligned_array(count, float)
        places.append(address(array))
        del array
    # nothing public tells how much memory is kept
    assert len(kernel._kept) == 2
    assert address(aligned_array(15 * LARGE, float)) == places[0]
    assert address(aligned_array(2 * LARGE, float)) == places[1]
    enormous = aligned_array(40 * LARGE, float)
    enormous[...] = 1.0
    assert address(enormous) not in places


@needs_pieces
def test_only_so_much_is_kept(monkeypatch):
    monkeypatch.setattr(kernel, "MOST_KEPT", 12 * HUGE_PAGE)
    arrays = [aligned_array(LARGE, float) for _ in range(20)]
    del arrays
    # nothing public tells how much memory is kept
    assert 1 <= sum(map(len, kernel._kept)) <= 12 * HUGE_PAGE
    monkeypatch.setattr(kernel, "MOST_PIECES", 2)
    arrays = [aligned_array(LARGE, float) for _ in range(5)]
    del arrays
    # nothing public tells how much memory is kept
    assert len(kernel._kept) == 2
    huge = aligned_array(13 * HUGE_PAGE // 8, float)
    del huge
    # nothing public tells how much memory is kept
    assert sum(map(len, kernel._kept)) <= 12 * HUGE_PAGE


def test_no_two_threads_get_the_same_memory():
    def work(number):
        for _ in range(50):
            arrays = [aligned_array(LARGE + 1000 * k, float) for k in range(3)]
            for array in arrays:
                array[...] = number
            if not all(np.all(array == number) for array in arrays):
                return False
        return True

    with ThreadPoolExecutor(8) as pool:
        assert all(pool.map(work, range(8)))


@needs_pieces
def test_a_system_that_refuses_keeps_nothing(monkeypatch):
    monkeypatch.setattr(kernel.mmap, "MADV_FREE", -1)
    array = aligned_array(LARGE, float)
    del array
    # nothing public tells how much memory is kept
    assert not kernel._kept


@pytest.mark.skipif(not hasattr(os, "fork"), reason="this system has no fork")
@needs_pieces
def test_a_child_begins_with_nothing():
    """In a process of its own, as other libraries warn of a fork in this one."""
    program = (
        "import os\n"
        "from ballscrew.compiler.kernels import kernel\n"
        f"array = kernel.aligned_array({LARGE}, float)\n"
        "del array\n"
        "assert kernel._kept\n"
        "child = os.fork()\n"
        "if child == 0:\n"
        "    os._exit(3 if kernel._kept else 0)\n"
        "print('child:', os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))"
    )
    outcome = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert "child: 0" in outcome.stdout
