"""Plan and files of a store: its blocks, the JSON document that identifies its plan, rows with checksums, and the lock.

The lock is of who writes; entries that another user may have prepared are refused.

Rows are CSV: size and checksum of every chunk of a block, and counts of false truth values. Each ends with a checksum
of itself, so that a damaged row is not taken for a block. All checksums are bound to the plan, by its digest: what was
written for another store has other checksums, wherever it is copied to. Links are never followed.

The lock is kept in place of the package ``filelock`` for the reasons in docs/decisions/05-engine.md.
"""

from __future__ import annotations

import contextlib
import csv
import dataclasses
import errno
import hashlib
import importlib
import importlib.util
import io
import itertools
import json
import math
import os
import socket
import stat
import zlib
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.version import __version__
from ballscrew.engine.evaluation.fingerprint import Fingerprint, package_digest
from ballscrew.engine.evaluation.plan import Configuration, Plan

#: Version of the layout of a store.
FORMAT = 3
#: The results of one block take at most so many bytes: a few blocks at a time fit any memory, and a
#: file of each output still has some megabytes.
BLOCK_BYTES = 32_000_000
#: Entries that differ as a consequence of others, and are reported only where no other differs.
_CONSEQUENCES = ("shape", "chunks", "formulas", "package")
#: Entries of a plan that are read, and their JSON types.
_ENTRIES = {"engine": str, "attributes": dict, "axes": dict, "outputs": dict, "shape": list, "chunks": list}
#: Digits of a digest that a message shows.
_DIGITS_SHOWN = 12


@dataclasses.dataclass(frozen=True)
class Blocks:
    """A grid cut into blocks: each is one chunk of every output and one range of the flattened grid."""

    shape: tuple[int, ...]
    #: ``(1, …, 1, c, full, …)``.
    chunk: tuple[int, ...]

    @classmethod
    def of(cls, plan: Plan, block_size: int | None = None) -> Blocks:
        """The blocks of a plan, of ``block_size`` points at most; else as many as take ``BLOCK_BYTES``.

        A nut whose balls are solved for one by one gets smaller blocks: each is work that a kill loses.
        """
        point = sum(np.dtype(output.dtype).itemsize for output in plan.wanted.values())
        most = block_size or max(1, BLOCK_BYTES // (point * plan.subject.balls))
        chunk = list(plan.shape)
        for axis, length in enumerate(plan.shape):
            beyond = math.prod(chunk[axis + 1 :])
            if length * beyond <= most:
                break
            pieces = math.ceil(length / max(1, most // beyond))
            chunk[axis] = math.ceil(length / pieces)
        return cls(plan.shape, tuple(chunk))

    @property
    def along(self) -> tuple[int, ...]:
        """The number of blocks along each axis."""
        return tuple(-(-length // part) for length, part in zip(self.shape, self.chunk, strict=True))

    @property
    def count(self) -> int:
        """The number of blocks."""
        return math.prod(self.along)

    @property
    def largest(self) -> int:
        """The points of a block, of the last ones along an axis perhaps fewer."""
        return math.prod(self.chunk)

    def _places(self, number: int) -> list[int]:
        return [int(place) for place in np.unravel_index(number, self.along)] if self.shape else []

    def key(self, number: int) -> str:
        """The path of the chunk of a block in the folder of each output."""
        return "/".join(["c", *map(str, self._places(number))])

    def number(self, key: str) -> int | None:
        """The number of the block with that path; None where there is none."""
        first, *places = key.split("/")
        if first != "c" or len(places) != len(self.shape) or not all(place.isdecimal() for place in places):
            return None
        at = [int(place) for place in places]
        if any(place >= most for place, most in zip(at, self.along, strict=True)):
            return None
        return int(np.ravel_multi_index(at, self.along)) if at else 0

    def region(self, number: int) -> tuple[slice, ...]:
        """The range of a block in the grid."""
        corners = [place * part for place, part in zip(self._places(number), self.chunk, strict=True)]
        return tuple(
            slice(corner, min(corner + part, length))
            for corner, part, length in zip(corners, self.chunk, self.shape, strict=True)
        )

    def span(self, number: int) -> slice:
        """The range of a block in the flattened grid."""
        start, points = 0, 1
        for where, length in zip(self.region(number), self.shape, strict=True):
            start = start * length + where.start
            points *= where.stop - where.start
        return slice(start, start + points)

    def points(self, number: int) -> int:
        """The number of points of a block."""
        span = self.span(number)
        return span.stop - span.start


def description_of(
    plan: Plan, blocks: Blocks, attributes: Mapping[str, Any], *, engine: str, identity: Fingerprint
) -> dict[str, Any]:
    """All that determines the bytes of a store, as plain JSON values: equal if and only if the stores are.

    Where it cannot be known what a model computes, its fingerprint is random, and at least the package is compared.
    """
    coordinates = {
        name: _digest(axis.dims, axis.to_numpy()) if axis.dims else axis.to_numpy().item()
        for name, axis in plan.axes.items()
    }
    labels = {
        str(name): _digest(values.dims, values.to_numpy())
        for axis in plan.axes.values()
        for name, values in axis.coords.items()
        if name in axis.dims and name not in plan.axes
    }
    document = {
        "format": FORMAT,
        "version": __version__,
        "engine": engine,
        "formulas": identity.digest,
        **({"package": package_digest()} if identity.unknown else {}),
        "grid": " x ".join(f"{name} {size}" for name, size in plan.sizes.items()),  # their order counts
        "shape": blocks.shape,
        "chunks": blocks.chunk,
        "axes": coordinates | labels,
        "outputs": {name: np.dtype(output.dtype).name for name, output in plan.wanted.items()},
        "laws": _laws(plan.subject),
        "attributes": dict(attributes),
    }
    return json.loads(_json(document))


def _laws(subject: Configuration) -> dict[str, str]:
    """The laws of a model and a nut by name; their coefficients are among the attributes."""
    model = {field.name: getattr(subject.model, field.name) for field in dataclasses.fields(subject.model)}
    losses = {f"losses {name}": law for name, law in subject.nut.losses.items()}
    return {
        slot: getattr(law, "__name__", type(law).__name__) for slot, law in (model | losses).items() if callable(law)
    }


def canonical_json(document: Mapping[str, Any]) -> str:
    """JSON with sorted keys."""
    return _json(dict(document), sort_keys=True)


def _json(document: Mapping[str, Any], *, sort_keys: bool = False) -> str:
    return json.dumps(document, sort_keys=sort_keys, ensure_ascii=False, separators=(",", ":"), default=_plain)


def checksum(document: Mapping[str, Any]) -> str:
    """The digest of a description."""
    return hashlib.sha256(canonical_json(document).encode()).hexdigest()


def sealed(name: str, document: Mapping[str, Any]) -> bytes:
    """A document under a name, with its digest, as the text of a file."""
    return canonical_json({name: document, "sha256": checksum(document)}).encode()


def read_sealed(name: str, text: str) -> dict[str, Any] | None:
    """The document of a name in the text of a file; None where it is damaged."""
    with contextlib.suppress(ValueError, KeyError, TypeError):
        kept = json.loads(text)
        if isinstance(kept[name], dict) and checksum(kept[name]) == kept["sha256"]:
            return kept[name]
    return None


def is_plan(document: Mapping[str, Any]) -> bool:
    """Return whether a document has the entries of a plan that are read; of another format, whether it tells which."""
    if document.get("format") != FORMAT:
        return "format" in document
    if not all(isinstance(document.get(name), kind) for name, kind in _ENTRIES.items()):
        return False
    shape, chunks = document["shape"], document["chunks"]
    return len(shape) == len(chunks) and all(type(length) is int and length > 0 for length in (*shape, *chunks))


def differences(stored: Mapping[str, Any], wanted: Mapping[str, Any]) -> list[str]:
    """The differences of two descriptions as text: ``screw_lead 0.005, not 0.01``."""
    differing: dict[str, list[str]] = {}
    for name in (*wanted, *(name for name in stored if name not in wanted)):
        theirs, ours = stored.get(name), wanted.get(name)
        if ours == theirs:
            continue
        if isinstance(ours, dict) and isinstance(theirs, dict):
            differing[name] = differences(theirs, ours)
        else:
            differing[name] = [f"{name.replace('_', ' ')} {_shown(theirs)}, not {_shown(ours)}"]
    causes = [words for name, words in differing.items() if name not in _CONSEQUENCES]
    return list(itertools.chain(*(causes or differing.values())))


def _shown(value: Any) -> str:
    text = "missing" if value is None else value if isinstance(value, str) else json.dumps(value, ensure_ascii=False)
    digest = len(text) == hashlib.sha256().digest_size * 2 and set(text) <= set("0123456789abcdef")
    return f"{text[:_DIGITS_SHOWN]}…" if digest else text


def _digest(dimensions: Sequence[Any], values: np.ndarray) -> str:
    """A digest of values along dimensions; values that are not numbers count by their text."""
    body = values.tobytes() if values.dtype.kind in "fiub" else json.dumps(values.tolist(), default=str).encode()
    return hashlib.sha256(f"{[*map(str, dimensions)]} {values.shape}\n".encode() + body).hexdigest()


def _plain(value: Any) -> Any:
    """A NumPy number as JSON knows it."""
    return value.item() if isinstance(value, np.generic) else str(value)


_fcntl: ModuleType | None = importlib.import_module("fcntl") if importlib.util.find_spec("fcntl") else None
#: Error numbers of a file system without locks.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL}
#: The field that errors name, and the remedy for a store that exists already.
WHERE = "sweep.to"
OTHER = "choose another name, or remove it"
#: The remedy for files without the right to read them.
READABLE = "make it readable"
#: The folder of metadata of this package in a store.
OWN = ".ballscrew"
#: Suffixes of the headings of columns: sizes of chunks, and counts of false truth values.
BYTES, FALSE = " bytes", " false"


class Content(NamedTuple):
    """Size and checksum (CRC-32) of a file."""

    bytes: int
    checksum: str

    @classmethod
    def of(cls, plan: str, key: str, content: Any) -> Content:
        """Size and checksum of a file of a plan, by its digest, under its path: elsewhere it has another."""
        view = memoryview(content).cast("B") if len(content) else b""
        return cls(len(view), f"{zlib.crc32(view, zlib.crc32(f'{plan} {key}'.encode())):08x}")


def unreadable(path: Path, error: OSError | ValueError, remedy: str = OTHER) -> InputError:
    """The error of a file of a store that cannot be read; without the right to, the remedy is to get it."""
    why = getattr(error, "strerror", None) or str(error)
    remedy = READABLE if isinstance(error, PermissionError) else remedy
    return InputError(Fault(WHERE, "cannot be read", f"{path}: {why}", remedy))


def row(plan: str, cells: Sequence[Any]) -> bytes:
    """The cells of a row, and their checksum in the store of a plan, by its digest, as a line of text."""
    text = io.StringIO()
    csv.writer(text, lineterminator="").writerow(cells)  # a comma, which ends it, is refused here from Python 3.13 on
    line = f"{text.getvalue()},".encode()
    return line + _checksum(plan, line)


def cells_of(plan: str, line: bytes) -> list[str] | None:
    """The cells of a row; None where it is damaged, or of another plan."""
    body, comma, checksum = line.rpartition(b",")
    if checksum != _checksum(plan, body + comma):
        return None
    return next(csv.reader([body.decode()]))


def _checksum(plan: str, line: bytes) -> bytes:
    return f"{zlib.crc32(line, zlib.crc32(plan.encode())):08x}\n".encode()


def refuse_unsafe(folder: Path, *, trust: bool) -> None:
    """Check the folder of a store before anything is written into it.

    A link in it could lead a write to a file elsewhere, and the owner of a folder can replace any entry by a link at
    any time. Raises :class:`~ballscrew.basis.errors.InputError` for a link, and unless ``trust`` for a folder of
    another user.
    """
    try:
        top = folder.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return
    _refuse_foreign(folder, top, trust=trust)
    if not os.path.lexists(folder / OWN):
        return  # it is empty, or no store
    try:
        _refuse_foreign(folder, folder.stat(), trust=trust)  # its own name may be a link
        for entry in _entries(folder):
            if entry.is_symlink():
                remedy = "remove the link, or choose another name"
                raise InputError(Fault(WHERE, "has a link in it, which is not followed", entry.path, remedy))
            if entry.is_dir(follow_symlinks=False):
                _refuse_foreign(Path(entry.path), entry.stat(follow_symlinks=False), trust=trust)
    except OSError as error:
        raise unreadable(Path(error.filename or folder), error) from None


def opened_as_file(path: Path) -> int:
    """The descriptor of a file, made where there is none; ``OSError`` where the last part of the path is a link."""
    descriptor = os.open(
        path, os.O_RDWR | os.O_CREAT | getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0), 0o666
    )
    if not stat.S_ISREG(os.fstat(descriptor).st_mode):
        os.close(descriptor)
        raise OSError(None, "is not a file", str(path))
    return descriptor


def _entries(folder: os.PathLike[str] | str) -> Iterator[os.DirEntry[str]]:
    with os.scandir(folder) as entries:
        for entry in entries:
            yield entry
            if entry.is_dir(follow_symlinks=False):
                yield from _entries(entry.path)


def _refuse_foreign(path: Path, state: os.stat_result, *, trust: bool) -> None:
    if trust or os.name != "posix" or state.st_uid == os.geteuid():
        return
    remedy = "choose another name, or add --trust (trust=True in Python) if you trust them"
    raise InputError(Fault(WHERE, "belongs to another user, who can change it", f"{path}: user {state.st_uid}", remedy))


class Lock:
    """A file with the process and its host, locked by the operating system while the process lives.

    The system's lock ends with the process, whatever ended it, and is not fooled by a process id
    that is used again. Where a file system has no locks, the process of this host is looked up by its
    id; where that is impossible too, the file alone counts.
    Raises :class:`~ballscrew.basis.errors.InputError` while another process holds it, and ``OSError``.
    """

    def __init__(self, path: Path, where: str, holds: Path) -> None:
        self._path = path
        while True:
            # the file is made where there is none, and what is in it stays; a link is not followed
            self._file = os.fdopen(opened_as_file(path), "r+", encoding="utf-8")
            holder = _holder(self._file)
            if _is_held_by_other(self._file, holder):
                self._file.close()
                who = "process {process} on {host}".format(**holder) if holder else "another process"
                remedy = f"wait for it or choose another name; if it is gone, remove {path}"
                raise InputError(Fault(where, f"is being written by {who}", str(holds), remedy))
            if self._is_in_place():
                break
            self._file.close()  # the previous holder removed it after we had opened it
        self._file.seek(0)
        self._file.truncate()
        self._file.write(json.dumps({"process": os.getpid(), "host": socket.gethostname()}))
        self._file.flush()

    def _is_in_place(self) -> bool:
        try:
            return os.path.samestat(os.fstat(self._file.fileno()), self._path.lstat())
        except FileNotFoundError:
            return False

    def release(self) -> None:
        """Release the lock and remove its file."""
        if _fcntl is None:
            self._file.close()  # an open file cannot be removed there
        self._path.unlink(missing_ok=True)
        self._file.close()


def _holder(file: Any) -> dict[str, Any]:
    """The process and host in a lock file; empty where the process was killed before it wrote them."""
    file.seek(0)
    try:
        holder = json.loads(file.read())
        return {"process": int(holder["process"]), "host": str(holder["host"])}
    except (ValueError, KeyError, TypeError):
        return {}


def _is_held_by_other(file: Any, holder: dict[str, Any]) -> bool:
    """Acquire the lock; return whether another process holds it."""
    ours = not holder or holder["host"] == socket.gethostname()
    if _fcntl is not None:
        try:
            _fcntl.flock(file.fileno(), _fcntl.LOCK_EX | _fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except OSError as error:
            if error.errno not in _NO_LOCKS:
                raise
        else:
            # locks of some file systems do not reach other hosts
            return not ours
    return bool(holder) and not (ours and _has_ended(holder["process"]))


def _has_ended(process: int) -> bool:
    """Return whether a process of this host has ended; False where that cannot be found out."""
    if os.name != "posix" or process == os.getpid():
        return False
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except OSError:
        return False
    return False
