"""Files of a store: rows with checksums, entries that another user may have prepared, and the lock of who writes.

Rows are CSV: size and checksum of every chunk of a block, and counts of false truth values. Each ends with a checksum
of itself, so that a damaged row is not taken for a block. All checksums are bound to the plan, by its digest: what was
written for another store has other checksums, wherever it is copied to. Links are never followed.

The lock is kept in place of the package ``filelock`` for the reasons in docs/decisions/05-engine.md.
"""

from __future__ import annotations

import csv
import errno
import importlib
import importlib.util
import io
import json
import os
import socket
import stat
import zlib
from collections.abc import Iterator, Sequence
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple

from ballscrew.basis.errors import Fault, InputError

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
