"""Entries of a folder that another user may have prepared: links are never followed."""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError
from ballscrew.engine.sweeps.store_rows import OWN, WHERE, unreadable


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
