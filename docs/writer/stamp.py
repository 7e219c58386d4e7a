"""A stamp that is committed with the pages: a digest of all files of the repository once pages were written.

Where it still holds, programs make what pages have, and ``.ci/run`` need not run them again: that takes minutes.
"""

from __future__ import annotations

import hashlib
import subprocess
from pathlib import Path

from kept import ROOT

FILE = Path("docs", "figures", "stamp.txt")


def now(root: Path = ROOT) -> str:
    """The stamp of the files as they are, also of those to be committed; empty where git does not know them."""
    listed = ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"]
    try:
        found = subprocess.run(listed, cwd=root, capture_output=True, check=True, encoding="utf-8").stdout
    except (OSError, subprocess.CalledProcessError):
        return ""
    whole = hashlib.blake2b(digest_size=16)
    for name in sorted({*found.split("\0")} - {"", FILE.as_posix()}):
        path = root / name
        if path.is_file():  # not deleted, nor a folder that is linked to
            content = path.read_bytes()
            whole.update(f"{name}\0{len(content)}\0".encode() + content)
    return whole.hexdigest()


def holds(root: Path = ROOT) -> bool:
    """Whether nothing has changed since the pages were written."""
    path = root / FILE
    return path.is_file() and path.read_text(encoding="utf-8").strip() == now(root) != ""


def put(root: Path = ROOT) -> None:
    """Write the stamp: programs make what pages have."""
    if found := now(root):
        (root / FILE).write_text(f"{found}\n", encoding="utf-8")
