"""Kernels: assembly compiled to machine code, cached in memory and on disk, and called without Python's lock.

The key of the cache is a digest of the assembly, the processor and the version of the compiler, so that
the next process finds the code and never a wrong one. The cache is in ``BALLSCREW_CACHE``, or in the user's
cache folder. It is an optimisation only: where it cannot be read or written, each process compiles its own kernels.

Large arrays for results, in memory that has been used before where there is some.

Of memory that is new to the process the system first clears each page, which takes as long as a kernel needs to fill
it. So the memory of large arrays is kept when the last array in it is gone, for the next ones. The system is told
that it may take it back whenever it needs it (``MADV_FREE``); where it cannot be told so, nothing is kept.

Kernels that find the least and the greatest value of each input while they read it.

What a large array is checked for are its ends. To read it once more for them takes half as long as the kernel itself.
"""

from __future__ import annotations

import contextlib
import ctypes
import functools
import hashlib
import importlib
import importlib.util
import logging
import mmap
import os
import sys
import tempfile
import threading
from collections import deque
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.compiler.kernels.emission import ENDS_OF_EACH
from ballscrew.compiler.tracing.program import Source

#: Alignment in bytes that non-temporal stores need.
ALIGNMENT = 64
#: Size of a huge page, and the least size of what is kept.
HUGE_PAGE, LEAST_KEPT = 2 * 2**20, 2**20
#: Most memory that is kept in bytes, and the most pieces of it.
MOST_KEPT, MOST_PIECES = 2**30, 64
#: A piece is taken for an array of at least this share of its size.
LEAST_SHARE = 0.5

_MAY_BE_KEPT = hasattr(mmap, "MADV_FREE") and hasattr(mmap, "MAP_ANONYMOUS")
#: Memory that no array is in; a deque, as its methods need no lock, which a finaliser could not wait for.
_kept: deque[mmap.mmap] = deque()


def aligned_array(count: int, dtype: type) -> NDArray[Any]:
    """An uninitialised array aligned for non-temporal stores."""
    size = count * np.dtype(dtype).itemsize
    if size >= LEAST_KEPT and _MAY_BE_KEPT:
        return np.asarray(_Piece(_taken(size) or _mapped(size), size)).view(dtype)
    raw = np.empty(size + ALIGNMENT, dtype=np.uint8)
    start = -raw.ctypes.data % ALIGNMENT
    return raw[start : start + size].view(dtype)


def forget() -> None:
    """Give what is kept back to the system."""
    _kept.clear()


class _Piece:
    """Memory with arrays in it, which hold it; it is kept when the last of them is gone."""

    def __init__(self, memory: mmap.mmap, size: int) -> None:
        self._memory = memory
        address = np.frombuffer(memory, np.uint8, 1).__array_interface__["data"][0]
        address += -address % HUGE_PAGE
        self.__array_interface__ = {"version": 3, "shape": (size,), "typestr": "|u1", "data": (address, False)}

    def __del__(self) -> None:
        """Keep the memory, as long as there is not too much."""
        # not kept where the system refuses, another thread is quicker, or Python is being shut down
        with contextlib.suppress(OSError, RuntimeError, IndexError, TypeError, AttributeError):
            self._memory.madvise(mmap.MADV_FREE)
            _kept.append(self._memory)
            while len(_kept) > MOST_PIECES or sum(map(len, _kept.copy())) > MOST_KEPT:
                _kept.popleft()


def _mapped(size: int) -> mmap.mmap:
    """New memory with room to begin at a huge page."""
    whole = -(-size // HUGE_PAGE) * HUGE_PAGE + HUGE_PAGE
    memory = mmap.mmap(-1, whole, flags=mmap.MAP_PRIVATE | mmap.MAP_ANONYMOUS)
    if hasattr(mmap, "MADV_HUGEPAGE"):
        with contextlib.suppress(OSError):  # a system without them
            memory.madvise(mmap.MADV_HUGEPAGE)
    return memory


def _taken(size: int) -> mmap.mmap | None:
    """The smallest piece that is kept and large enough, but not too large."""
    for memory in sorted(_kept.copy(), key=len):
        if size + HUGE_PAGE <= len(memory) and size >= LEAST_SHARE * (len(memory) - 2 * HUGE_PAGE):
            try:
                _kept.remove(memory)
            except ValueError:  # another thread was quicker
                continue
            return memory
    return None


if hasattr(os, "register_at_fork"):  # what a child writes into it would be copied page by page
    os.register_at_fork(after_in_child=forget)


#: Columns that are worked on at a time, row after row: tables of a dozen inputs then stay in the first cache.
COLUMN_TILE = 512
#: Results larger than this do not stay in the cache anyway, and are stored non-temporally.
LARGEST_CACHED = 4 * 2**20
#: Most kernels in the cache in memory, and on disk; the oldest are removed.
MOST_IN_MEMORY = MOST_ON_DISK = 256
#: Levels of optimisation, of the assembly and of the code: beyond these, compiling takes longer and the code runs no
#: faster. An assembly is written without repeated terms and with its vectors; only functions are left to insert.
ASSEMBLY_OPTIMISATION, CODE_OPTIMISATION = 0, 2
#: Seconds of one processor that a line of assembly takes to compile, about, and those from which it is logged before
#: it starts: whoever waits is to know what for.
LINE_SECONDS, LOGGED_SECONDS = 2e-4, 1.0
#: The share of that which code without optimisation takes.
UNOPTIMISED_SHARE = 0.15

#: Version of the calling convention of kernels.
FORMAT = 2

_log = logging.getLogger(__name__)
_int64 = ctypes.c_int64
_SIGNATURE = ctypes.CFUNCTYPE(None, *[_int64] * 6, ctypes.c_bool, ctypes.c_void_p, ctypes.c_void_p)
_lock = threading.RLock()
_kernels: dict[str, Kernel] = {}


def available() -> bool:
    """Return whether the compiler is installed (the extra ``fast``)."""
    return importlib.util.find_spec("llvmlite") is not None


class Kernel:
    """A compiled kernel; see :mod:`ballscrew.compiler.kernels.emission` for what it does."""

    def __init__(self, machine_code: bytes, sources: Sequence[Source]) -> None:
        llvm = _llvm()
        self.sources = tuple(sources)
        # the function lives as long as the engine that holds its code
        self._engine: Any = llvm.create_mcjit_compiler(llvm.parse_assembly(""), _machine())
        self._engine.add_object_file(llvm.ObjectFileRef.from_data(machine_code))
        self._engine.finalize_object()
        self._function = _SIGNATURE(self._engine.get_function_address("kernel"))

    @classmethod
    def of(cls, text: str, sources: Sequence[Source]) -> Kernel:
        """The kernel of an assembly: from memory, from the disk, or compiled; what takes long is logged before."""
        with _lock:
            name = _digest(text)
            if name not in _kernels:
                machine_code = _load(name)
                if machine_code is None:
                    machine_code = code_of(text)
                    _save(name, machine_code)
                _kernels[name] = cls(machine_code, sources)
                if len(_kernels) > MOST_IN_MEMORY:
                    del _kernels[next(iter(_kernels))]
            return _kernels[name]

    def __call__(
        self,
        rows: slice,
        columns: slice,
        row_length: int,
        inputs: Sequence[NDArray[np.float64]],
        results: Sequence[NDArray[Any]],
        *,
        first: int = 0,
        past_cache: bool | None = None,
        tile: int | None = None,
    ) -> None:
        """Evaluate a rectangle of the grid; both slices hold at least one number.

        ``tile`` is the number of columns that are worked on at a time. ``past_cache`` says whether the results outgrow
        the cache; by default their sizes decide.

        Results and inputs over points are contiguous arrays that begin at place ``first`` of the
        flattened grid; inputs over rows and columns are whole.
        """
        start = rows.start * row_length + columns.start
        ends = [_address(array, first) for array in results]
        aligned = all(
            (end + start * array.itemsize) % ALIGNMENT == 0
            for end, array in zip(ends, results, strict=True)
            if array.dtype == np.float64
        )
        aligned &= rows.stop - rows.start == 1 or row_length % (ALIGNMENT // 8) == 0
        if past_cache is None:
            past_cache = sum(array.nbytes for array in results) > LARGEST_CACHED
        places = [
            _address(array, first if source == "points" else 0)
            for source, array in zip(self.sources, inputs, strict=True)
        ]
        self._function(
            rows.start,
            rows.stop,
            columns.start,
            columns.stop,
            row_length,
            tile or (COLUMN_TILE if "columns" in self.sources else columns.stop - columns.start),
            aligned and past_cache,
            (ctypes.c_void_p * len(places))(*places),
            (ctypes.c_void_p * len(ends))(*ends),
        )

    def at_addresses(
        self,
        rows: slice,
        columns: slice,
        row_length: int,
        tile: int,
        inputs: Sequence[NDArray[np.float64]],
        results: Sequence[NDArray[np.float64]],
    ) -> None:
        """Run over a rectangle, of contiguous arrays whose extents are the caller's affair."""
        tables = [(ctypes.c_void_p * len(arrays))(*(_address(a, 0) for a in arrays)) for arrays in (inputs, results)]
        self._function(rows.start, rows.stop, columns.start, columns.stop, row_length, tile, False, *tables)

    def strided(
        self,
        count: int,
        inputs: Sequence[NDArray[np.float64]],
        strides: Sequence[int],
        results: Sequence[NDArray[Any]],
    ) -> None:
        """Evaluate so many points, where all inputs have strides: of 1 an array, of 0 a vector of one number."""
        ends = [_address(array, 0) for array in results]
        aligned = all(
            end % ALIGNMENT == 0 for end, array in zip(ends, results, strict=True) if array.dtype == np.float64
        )
        past_cache = aligned and sum(array.nbytes for array in results) > LARGEST_CACHED
        places = [_address(array, 0) for array in inputs]
        table = (ctypes.c_void_p * (2 * len(places)))(*places, *strides)
        self._function(0, 1, 0, count, count, count, past_cache, table, (ctypes.c_void_p * len(ends))(*ends))

    def at_one_point(self, inputs: NDArray[np.float64], results: Sequence[NDArray[Any]]) -> Callable[[], None]:
        """A call that reads one point from ``inputs`` and writes it into ``results``, with next to nothing left to do.

        ``inputs`` holds a number for each input, all of them over points or with strides; the arrays must outlive the
        call.
        """
        start, item = _address(inputs, 0), inputs.itemsize
        strides = [0] * inputs.size if "strided" in self.sources else []
        places = (ctypes.c_void_p * (inputs.size + len(strides)))(
            *(start + i * item for i in range(inputs.size)), *strides
        )
        ends = (ctypes.c_void_p * len(results))(*(_address(array, 0) for array in results))
        return functools.partial(self._function, 0, 1, 0, 1, 1, 1, False, places, ends)


def kept(name: str) -> tuple[bytes, bytes] | None:
    """Entry kept on disk for this processor and this compiler under a name: a header, and machine code."""
    result = None
    with contextlib.suppress(OSError, RuntimeError):  # a look at the folder, before the compiler is loaded
        if any(path.name.startswith(_short(name)) for path in cache_folder().iterdir()):
            result = _load(f"{_short(name)}{_digest(name)}")
    if result is None:
        return None
    header, newline, machine_code = result.partition(b"\n")
    return (header, machine_code) if newline else None


def keep(name: str, header: bytes, machine_code: bytes) -> None:
    """Keep machine code on disk under a name, with a header of one line."""
    _save(f"{_short(name)}{_digest(name)}", header + b"\n" + machine_code)


def _short(name: str) -> str:
    """Prefix of files that are kept under a name, for whatever processor."""
    return f"{hashlib.sha256(name.encode()).hexdigest()[:16]}-"


def is_cached(text: str) -> bool:
    """Return whether the kernel of an assembly is in the cache."""
    name = _digest(text)
    with contextlib.suppress(OSError, RuntimeError):
        return name in _kernels or (cache_folder() / name).exists()
    return False


def _address(array: NDArray[Any], first: int) -> int:
    """The address of place 0 of the grid, for an array that begins at place ``first``."""
    if not array.flags.c_contiguous:
        raise ValueError("a kernel needs contiguous arrays")
    return array.__array_interface__["data"][0] - first * array.itemsize


@functools.cache
def _llvm() -> Any:
    """The compiler, ready for this processor."""
    llvm = importlib.import_module("llvmlite.binding")
    llvm.initialize_native_target()
    llvm.initialize_native_asmprinter()
    return llvm


def _machine(optimisation: int | None = None) -> Any:
    """A new target machine for this processor; an execution engine takes ownership of it."""
    llvm = _llvm()
    level = CODE_OPTIMISATION if optimisation is None else min(optimisation, CODE_OPTIMISATION)
    return llvm.Target.from_default_triple().create_target_machine(
        cpu=llvm.get_host_cpu_name(), features=llvm.get_host_cpu_features().flatten(), opt=level, jit=True
    )


@functools.cache
def _processor() -> str:
    llvm = _llvm()
    features = llvm.get_host_cpu_features().flatten()
    host = f"{llvm.get_default_triple()} {llvm.get_host_cpu_name()} {features} {llvm.llvm_version_info}"
    return f"{host} {FORMAT} {ASSEMBLY_OPTIMISATION} {CODE_OPTIMISATION}"


@functools.lru_cache(maxsize=64)
def _digest(text: str) -> str:
    """The name of a kernel: a digest of the assembly, the processor and the compiler."""
    return hashlib.sha256(f"{_processor()}\n{text}".encode()).hexdigest()


def code_of(text: str, optimisation: int | None = None) -> bytes:
    """The machine code of an assembly, compiled now; what takes long is logged before, and said to whoever looks on.

    No bit of a result depends on the ``optimisation``, 0 to 2, which is quicker code against quicker compiling.
    """
    lines = text.count("\n")
    expected = lines * LINE_SECONDS * (UNOPTIMISED_SHARE if optimisation == 0 else 1)
    if expected > LOGGED_SECONDS:
        notice = f"compiling a kernel of {lines} lines: some {expected:.0f} s, once"
        _log.info(notice)
        if sys.stderr.isatty() or hasattr(sys, "ps1"):  # a terminal, or a notebook
            sys.stderr.write(f"{notice}\n")
    return _compile(text, optimisation)


def _compile(text: str, optimisation: int | None) -> bytes:
    machine, module = _optimise(text, optimisation)
    return machine.emit_object(module)


def _optimise(text: str, optimisation: int | None = None) -> tuple[Any, Any]:
    """The processor, and the module ready to be made into its code."""
    llvm = _llvm()
    module = llvm.parse_assembly(text)
    module.verify()
    machine = _machine(optimisation)
    optimise(module, machine)
    return machine, module


def optimise(module: Any, machine: Any) -> None:
    """Insert functions where they are called, for any processor: vectors are explicit, and stay as they are written."""
    llvm = _llvm()
    tuning = llvm.create_pipeline_tuning_options(speed_level=ASSEMBLY_OPTIMISATION)
    tuning.loop_vectorization = tuning.slp_vectorization = tuning.loop_unrolling = False
    passes = llvm.create_pass_builder(machine, tuning)
    passes.getModulePassManager().run(module, passes)


def cache_folder() -> Path:
    """The folder of the cache on disk."""
    if place := os.environ.get("BALLSCREW_CACHE"):
        return Path(place) / "kernels"
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or "~/AppData/Local"
    elif sys.platform == "darwin":
        base = "~/Library/Caches"
    else:
        base = os.environ.get("XDG_CACHE_HOME") or "~/.cache"
    return Path(base).expanduser() / "ballscrew" / "kernels"


def _is_private(path: Path) -> bool:
    """Return whether nobody else can write there, as code from there is run."""
    if os.name != "posix":
        return True
    state = path.stat()
    return state.st_uid == os.geteuid() and not state.st_mode & 0o022


def _load(name: str) -> bytes | None:
    """Machine code from the disk; None where there is none, or it is incomplete."""
    try:
        path = cache_folder() / name
        if not (_is_private(path.parent) and _is_private(path)):
            return None
        digest, machine_code = path.read_bytes().split(b"\n", 1)
        if hashlib.sha256(machine_code).hexdigest().encode() != digest:
            return None
        with contextlib.suppress(OSError):  # a cache that is read only serves as well
            os.utime(path)
    except (OSError, RuntimeError, ValueError):  # no home, no such file, no line in it
        return None
    return machine_code


def _save(name: str, machine_code: bytes) -> None:
    """Write machine code to the cache atomically; a disk that refuses it only costs the next process a compilation."""
    with contextlib.suppress(OSError, RuntimeError):
        place = cache_folder()
        place.mkdir(parents=True, exist_ok=True, mode=0o700)
        if not _is_private(place):
            return
        handle, temporary = tempfile.mkstemp(dir=place)
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.sha256(machine_code).hexdigest().encode() + b"\n" + machine_code)
            Path(temporary).replace(place / name)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
        by_age = sorted(place.iterdir(), key=lambda path: path.stat().st_mtime)
        for old in by_age[:-MOST_ON_DISK]:
            old.unlink(missing_ok=True)


#: The bits of infinity: of a positive number they are less, of NaN more; those of negative numbers are negative.
_INFINITY = 0x7FF0000000000000


class WatchedKernel:
    """A kernel of a ``watched`` assembly (:func:`~ballscrew.compiler.kernels.emission.kernel_text`)."""

    def __init__(self, text: str, sources: Sequence[Source], lanes: int) -> None:
        self._kernel = Kernel.of(text, sources)
        self._watched = [source == "points" for source in sources]
        self._lanes = lanes

    def __call__(
        self,
        count: int,
        inputs: Sequence[NDArray[np.float64]],
        results: Sequence[NDArray[Any]],
        *,
        past_cache: bool | None = None,
    ) -> list[NDArray[np.float64] | None]:
        """Evaluate points; return the ends of each input over them, NaN as both where it has one."""
        result = np.empty((sum(self._watched), ENDS_OF_EACH, self._lanes), dtype=np.int64)
        self._kernel(slice(0, 1), slice(0, count), count, inputs, [*results, result], past_cache=past_cache)
        bits = iter(result)
        return [
            self._ends(values, next(bits)) if watched else None
            for values, watched in zip(inputs, self._watched, strict=True)
        ]

    def _ends(self, values: NDArray[np.float64], bits: NDArray[np.int64]) -> NDArray[np.float64]:
        """The ends by the bits of whole vectors, and the last values; by all values where not all are positive."""
        least, greatest = bits[0].min(), bits[1].max()
        whole = values.size // self._lanes * self._lanes
        if whole == 0 or least < 0 or greatest > _INFINITY:
            return np.array([values.min(), values.max()])
        ends = np.array([least, greatest]).view(np.float64)
        rest = values[whole:]
        # NaN among the last comes out as both
        return np.array([np.min(rest, initial=ends[0]), np.max(rest, initial=ends[1])])
