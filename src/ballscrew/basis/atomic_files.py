"""Files: read up to a size, and written whole or not at all."""

from __future__ import annotations

import contextlib
import os
import tempfile
from collections.abc import Generator
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError


def read_bytes(path: Path, most: int) -> bytes:
    """The content of a file, of a pipe or a device too. Raises ``ValueError`` for more than ``most`` bytes."""
    with path.open("rb") as file:
        content = file.read(most + 1)
    if len(content) > most:
        raise ValueError(f"is larger than {most // 1_000_000:,} MB")
    return content


def write_error(where: str, path: Path, error: OSError) -> InputError:
    """The input error of a file that cannot be written, in one line."""
    return InputError(Fault(where, "cannot be written", f"{path}: {error.strerror or error}", "choose another place"))


def check_writable(where: str, path: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now rather than after the work is done.

    Create the folder where there is none.
    """
    try:
        if path.is_dir():
            raise IsADirectoryError(21, "is a folder")
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=path.parent):
            pass
    except OSError as error:
        raise write_error(where, path, error) from None


@contextlib.contextmanager
def atomic_write(where: str, path: Path) -> Generator[Path]:
    """Yield a temporary path beside ``path``, which replaces ``path`` on success.

    On any failure (a full disk, Ctrl-C), ``path`` is unchanged and the temporary file is removed.
    """
    try:
        handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.", suffix=path.suffix)
        os.close(handle)
    except OSError as error:
        raise write_error(where, path, error) from None
    temporary = Path(name)
    try:
        yield temporary
        temporary.chmod(0o666 & ~_umask())
        temporary.replace(path)
    except OSError as error:
        raise write_error(where, path, error) from None
    finally:
        temporary.unlink(missing_ok=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask
