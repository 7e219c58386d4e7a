"""A lock file: one process at a time writes into a folder."""

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

from ballscrew.faults import Fault, InputError

_fcntl: ModuleType | None = importlib.import_module("fcntl") if importlib.util.find_spec("fcntl") else None
#: What a file system says that has no locks.
_NO_LOCKS = {errno.ENOLCK, errno.ENOSYS, errno.EOPNOTSUPP, errno.EINVAL}


class Lock:
    """A file with the process and its host, locked by the operating system while the process lives.

    The system's lock ends with the process, whatever ended it, and is not fooled by a process id
    that is used again. Where a file system has no locks, a process of this host is asked for by its
    id; where there are no process ids to ask for either, the file alone counts.
    Raises :class:`~ballscrew.faults.InputError` while another process holds it, and ``OSError``.
    """

    def __init__(self, path: Path, where: str, holds: Path) -> None:
        self._path = path
        while True:
            # "a+" makes the file where there is none and leaves what is in it
            self._file = path.open("a+", encoding="utf-8")
            holder = _holder(self._file)
            if _taken(self._file, holder):
                self._file.close()
                who = f"process {holder['process']} on {holder['host']}" if holder else "another process"
                remedy = f"wait for it or choose another name; if it is gone, remove {path}"
                raise InputError(Fault(where, f"is being written by {who}", str(holds), remedy))
            if self._is_in_place():
                break
            self._file.close()  # the one before us removed it as we opened it
        self._file.seek(0)
        self._file.truncate()
        self._file.write(json.dumps({"process": os.getpid(), "host": socket.gethostname()}))
        self._file.flush()

    def _is_in_place(self) -> bool:
        try:
            return os.path.samestat(os.fstat(self._file.fileno()), self._path.stat())
        except FileNotFoundError:
            return False

    def release(self) -> None:
        """Let others write."""
        if _fcntl is None:
            self._file.close()  # an open file cannot be removed there
        self._path.unlink(missing_ok=True)
        self._file.close()


def _holder(file: Any) -> dict[str, Any]:
    """Who wrote a lock file; nothing if it was killed before it could."""
    file.seek(0)
    try:
        holder = json.loads(file.read())
        return {"process": int(holder["process"]), "host": str(holder["host"])}
    except (ValueError, KeyError, TypeError):
        return {}


def _taken(file: Any, holder: dict[str, Any]) -> bool:
    """Whether somebody else holds the lock; takes it if not."""
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
    return bool(holder) and not (ours and _is_gone(holder["process"]))


def _is_gone(process: int) -> bool:
    """Whether a process of this host has ended; where nobody can be asked, it has not."""
    if os.name != "posix" or process == os.getpid():
        return False
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return True
    except OSError:
        return False
    return False
