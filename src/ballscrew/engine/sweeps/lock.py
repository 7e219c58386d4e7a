"""A lock file: one process at a time writes into a folder.

Kept in place of the package ``filelock`` for the reasons in docs/decisions/05-engine.md.
"""

from __future__ import annotations

import errno
import importlib
import importlib.util
import json
import os
import socket
from pathlib import Path
from types import ModuleType
from typing import Any

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.sweeps.store_entries import opened_as_file

_fcntl: ModuleType | None = importlib.import_module("fcntl") if importlib.util.find_spec("fcntl") else None
#: Error numbers of a file system without locks.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL}


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
