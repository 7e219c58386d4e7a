"""Files that are either whole or not there."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Generator
from pathlib import Path

from ballscrew.faults import Fault, InputError


def unwritable(where: str, path: Path, error: OSError) -> InputError:
    """The fault of a file that cannot be written, in one line."""
    return InputError(Fault(where, "cannot be written", f"{path}: {error.strerror or error}", "choose another place"))


def check_writable(where: str, path: Path) -> None:
    """Raise :class:`~ballscrew.faults.InputError` now rather than after the work is done.

    The folder is made where there is none.
    """
    try:
        if path.is_dir():
            raise IsADirectoryError(21, "is a folder")
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise unwritable(where, path, error) from None


@contextlib.contextmanager
def whole(where: str, path: Path) -> Generator[Path]:
    """A path beside ``path`` to write to; it takes the place of ``path`` once all went well.

    Whatever goes wrong (a full disk, Ctrl-C), ``path`` is as it was and nothing else is left.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix)
        os.close(handle)
    except OSError as error:
        raise unwritable(where, path, error) from None
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        raise unwritable(where, path, error) from None
    finally:
        temporary.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
