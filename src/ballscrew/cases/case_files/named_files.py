"""The files that a case names beside itself, where the case is written into another folder."""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

#: Fields, in any table of a case, that name a file beside it.
FIELDS = ("file", "catalogue_file", "oil_file")


def moved(value: Any, old: Path, new: Path) -> Any:
    """Tables of a case in the folder ``old`` for one in ``new``: the same files, as they lie from there.

    A path that is absolute stays.
    """
    if isinstance(value, Mapping):
        return {
            key: _from(new, old / item)
            if key in FIELDS and isinstance(item, str) and not Path(item).is_absolute()
            else moved(item, old, new)
            for key, item in value.items()
        }
    return [moved(item, old, new) for item in value] if isinstance(value, list) else value


def _from(folder: Path, file: Path) -> str:
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # on another drive
        return file.resolve().as_posix()
