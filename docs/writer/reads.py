"""The files that a process reads, heard by an audit hook: all that its output may depend on.

A file counts if it is opened, a folder if its names are listed, a library if it is loaded; a module is the file that
the import opened, its source. A program that the process starts is not heard: it may have read everything. Forks are
heard.
"""

from __future__ import annotations

import os
import sys
from importlib.util import source_from_cache

#: Stands for all files. What stands behind a folder if only imports looked into it: names of other files do not count.
EVERYTHING, FOR_MODULES = "*", "?modules"
_READ = {"open", "ctypes.dlopen", "os.listdir", "os.scandir", "sqlite3.connect"}
_STARTED = {"subprocess.Popen", "os.posix_spawn", "os.spawn", "os.exec", "os.system"}
#: A program that reads nothing of the repository: the standard library asks it for the processor.
_HARMLESS = "uname"
#: Code that looks into all folders of modules, for modules or for the names of distributions.
_IMPORTS = (
    "<frozen importlib._bootstrap_external>",
    "importlib/metadata/__init__.py",
    "importlib_metadata/__init__.py",
)
_heard: set[str] = set()
_record = -1


def listen() -> None:
    """Hear from now on. There is no way back: it is for a process that ends, and for its forks."""
    sys.addaudithook(_hear)


def write_to(record: str) -> None:
    """Write the names heard so far to a file, and all others as soon as they are heard."""
    global _record
    _record = os.open(record, os.O_WRONLY | os.O_CREAT | os.O_APPEND)
    os.write(_record, "".join(f"{name}\0" for name in sorted(_heard)).encode())


def names(record: bytes) -> set[str]:
    """The names in a file that :func:`write_to` wrote."""
    return {name for name in record.decode().split("\0") if name}


def _hear(event: str, arguments: tuple[object, ...]) -> None:
    if event in _READ:
        name = _name(event, arguments[0])
    elif event in _STARTED and arguments[0] != _HARMLESS:
        name = EVERYTHING
    else:
        return
    if name and name not in _heard:
        _heard.add(name)
        if _record >= 0:
            os.write(_record, f"{name}\0".encode())


def _name(event: str, path: object) -> str:
    """The absolute name of what is read, empty where an open file is read: that was heard as it was opened."""
    if isinstance(path, int):
        return ""
    try:
        name = os.path.abspath("." if path is None else os.fsdecode(path))  # noqa: PTH100  (resolves no link)
    except (OSError, TypeError):
        return EVERYTHING
    if name.endswith(".pyc"):
        try:
            return source_from_cache(name)
        except ValueError:
            return name
    if event == "os.listdir" and _asked_by().endswith(_IMPORTS):
        return f"{name}{FOR_MODULES}"
    return name


def _asked_by() -> str:
    """The file of the code that listed a folder: two functions of this module stand in between."""
    return sys._getframe(3).f_code.co_filename
