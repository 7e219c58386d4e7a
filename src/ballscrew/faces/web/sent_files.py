"""Files that come with a request: read by the readers of the command line from a folder that is removed at once."""

from __future__ import annotations

import base64
import binascii
import contextlib
import dataclasses
import os
import re
import tempfile
from collections.abc import Generator, Mapping
from pathlib import Path

from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.opened_file import is_table
from ballscrew.faces.web.limits import check_columns

#: What a name of a file has not: what leads elsewhere, and what some system does not take.
_ODD = re.compile(r'[\x00-\x1f\x7f<>:"/\\|?*]')
LONGEST_NAME = 50


@contextlib.contextmanager
def written(files: Mapping[str, Mapping[str, str]], *, tables: bool = True) -> Generator[dict[str, Path]]:
    """Paths of files by their fields, in a private folder that is there only for a while.

    They are ``tables`` whatever their names are; without it each is what ``opened_file`` takes it for.
    Each file has a ``name`` and its content as ``text`` or in ``base64``. Faults that are found meanwhile name the file
    and not the folder. Raises :class:`~ballscrew.basis.errors.InputError` for what is no such file.
    """
    with tempfile.TemporaryDirectory(prefix="ballscrew-", ignore_cleanup_errors=True) as folder:
        paths: dict[str, Path] = {}
        for field, file in files.items():
            place = Path(folder) / field  # each in a folder of its own: both logs may have one name
            place.mkdir()
            paths[field] = place / _name(file.get("name", ""))
            content = _content(field, file)
            paths[field].write_bytes(content)
            if tables or is_table(paths[field]):
                check_columns(paths[field].name, content)
        try:
            yield paths
        except InputError as error:
            raise InputError(*(_without_folders(fault, paths) for fault in error.faults)) from None


def _name(given: str) -> str:
    """The last part of the name of a file, as any system takes it."""
    last = _ODD.sub("_", re.split(r"[/\\]", given)[-1]).strip(" .")
    stem, dot, ending = last.rpartition(".")
    return f"{stem[-LONGEST_NAME:]}{dot}{ending[:10]}" if stem else last[:LONGEST_NAME] or "log.csv"


def _content(field: str, file: Mapping[str, str]) -> bytes:
    """The bytes of a file. Raises :class:`~ballscrew.basis.errors.InputError` unless it has one content that is
    good.
    """
    text, coded = file.get("text"), file.get("base64")
    if (text is None) == (coded is None):
        raise InputError(Fault(field, "needs one content", "", "send text, or base64, not both"))
    try:
        return (text or "").encode() if coded is None else base64.b64decode(coded, validate=True)
    except UnicodeEncodeError:
        raise InputError(Fault(f"{field}.text", "has an unpaired surrogate", "", "send Unicode text")) from None
    except (binascii.Error, ValueError):
        raise InputError(Fault(f"{field}.base64", "is not base64", coded[:40] if coded else "", "")) from None


def _without_folders(fault: Fault, paths: Mapping[str, Path]) -> Fault:
    """A fault that names files without their folders."""

    def plain(text: str) -> str:
        for path in paths.values():
            text = text.replace(f"{path.parent}{os.sep}", "")
        return text

    texts = {name: plain(getattr(fault, name)) for name in ("where", "problem", "given", "remedy")}
    return dataclasses.replace(fault, **texts)
