"""What a program made, kept under a digest of the files that it may depend on: it is made again if one has changed.

All files count for all programs, but for pages, figures and tests. The digest of all files without exception is a stamp
that is committed with the pages: where it still holds, programs make what pages have, and ``.ci/run`` need not run them
again, which takes minutes.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import re
import secrets
import subprocess
import sys
import sysconfig
from collections.abc import Mapping
from pathlib import Path

ROOT = Path(__file__).parents[2]
STAMP = Path("docs", "figures", "stamp.txt")
#: Files that no program reads for a page: what is written into pages, and the tests that only look.
_READ_BY_NONE = re.compile(r".*\.md|docs/(figures|images)/.*|tests/(?!support/|data/|oracles/).*")


def digest(root: Path = ROOT, *, of_programs: bool = False) -> str:
    """Digest of all files of the repository, also of those to be committed, or of those that programs read.

    Empty where git does not know them.
    """
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        names = subprocess.run(listed, cwd=root, capture_output=True, check=True, encoding="utf-8").stdout.split("\0")
    except (OSError, subprocess.CalledProcessError):
        return ""
    whole = hashlib.blake2b(digest_size=16)
    for name in sorted({*names} - {"", STAMP.as_posix()}):
        path = root / name
        # not deleted, nor a folder that is linked to
        if path.is_file() and not (of_programs and _READ_BY_NONE.fullmatch(name)):
            content = path.read_bytes()
            whole.update(f"{name}\0{len(content)}\0".encode() + content)
    return whole.hexdigest()


def stamp_holds(root: Path = ROOT) -> bool:
    """Whether nothing has changed since the pages were written."""
    path = root / STAMP
    return path.is_file() and path.read_text(encoding="utf-8").strip() == digest(root) != ""


def stamp(root: Path = ROOT) -> None:
    """Write the stamp: programs make what pages have."""
    if whole := digest(root):
        (root / STAMP).write_text(f"{whole}\n", encoding="utf-8")


@functools.cache
def cause_of_all(root: Path = ROOT) -> str:
    """What counts for every program, as this process found it: Python, its libraries, and the files."""
    libraries = sorted(path.name for path in Path(sysconfig.get_path("purelib")).glob("*.dist-info"))
    # where the files are not known, nothing made before counts
    files = digest(root, of_programs=True) or secrets.token_hex()
    return _hash(json.dumps([sys.version, libraries, files]).encode())


def _hash(content: bytes) -> str:
    return hashlib.blake2b(content, digest_size=16).hexdigest()


def digest_of(path: Path) -> str:
    """Digest of a file that was made, now."""
    return _hash(path.read_bytes()) if path.is_file() else "none"


@dataclasses.dataclass(frozen=True)
class Record:
    """What was made: a text that was printed, and files by name with their digests."""

    said: str
    made: Mapping[str, str]


class Kept:
    """Records in a folder, by what was run."""

    def __init__(self, folder: Path, root: Path = ROOT) -> None:
        self.folder, self._cause = folder, cause_of_all(root)

    def _path(self, *what: str) -> Path:
        return self.folder / f"{_hash(json.dumps([self._cause, *what]).encode())}.json"

    def find(self, *what: str) -> Record | None:
        """The record, if nothing has changed since."""
        try:
            return Record(**json.loads(self._path(*what).read_text(encoding="utf-8")))
        except (OSError, ValueError, TypeError):
            return None

    def keep(self, record: Record, *what: str) -> Record:
        """Write a record."""
        self.folder.mkdir(parents=True, exist_ok=True)
        self._path(*what).write_text(json.dumps(dataclasses.asdict(record)), encoding="utf-8")
        return record
