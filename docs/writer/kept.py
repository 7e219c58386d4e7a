"""What a program made, kept with the files that it read: it is made again only if one of them has changed.

A record is found by its cause: what was run, on which Python with which libraries, and the names of all data files (to
look for a file that is not there is not heard). It holds as long as all that was read is as it was.

Files are read once, before anything runs: what changes meanwhile is another file to the next build.
"""

from __future__ import annotations

import dataclasses
import functools
import hashlib
import json
import sys
import sysconfig
import tempfile
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

import reads

ROOT = Path(__file__).parents[2]
#: Folders whose files are read before anything runs, and what in the repository is made, not read.
SOURCES = "src", "examples", "docs", "benchmarks", "tests"
MADE = ".git", ".venv", "out", "docs/figures"
#: What runs programs and keeps their output.
HERE = (
    *(f"docs/writer/{name}.py" for name in ("command", "kept", "libraries", "reads", "recorded")),
    "tests/support/commands.py",
    "tests/support/fork_server.py",
)


class Files:
    """Digests of the files below a folder, as they are now."""

    def __init__(self, root: Path = ROOT) -> None:
        self.root = root
        self._digests: dict[str, str] = {}
        for folder in SOURCES:
            for path in self._below(root / folder):
                self.digest(path.relative_to(root).as_posix())

    def _below(self, folder: Path) -> Iterator[Path]:
        if not folder.is_dir():
            return
        for path in sorted(folder.iterdir()):
            if path.name == "__pycache__" or path.relative_to(self.root).as_posix() in MADE:
                continue
            if path.suffix == ".md" and self.root / "docs" in path.parents:
                continue  # what commands and parts are written into
            if path.is_dir():
                yield from self._below(path)
            yield path

    def digest(self, name: str) -> str:
        """Digest of the content of a file, of the names in a folder, or of all files."""
        if name not in self._digests:
            self._digests[name] = self._digest(name)
        return self._digests[name]

    def _digest(self, name: str) -> str:
        if name == reads.EVERYTHING:
            return _hash(json.dumps(sorted(self._digests.items())).encode())
        path = self.root / name.removesuffix(reads.FOR_MODULES)
        if path.is_file():
            return _hash(path.read_bytes())
        if not path.is_dir():
            return "none"
        names = [one.name for one in path.iterdir() if one.name not in ("__pycache__", "generated")]
        if name.endswith(reads.FOR_MODULES):
            names = [one for one in names if "." not in one or one.endswith((".py", ".so", "-info"))]
        return _hash("\n".join(sorted(names)).encode())

    def digests(self, names: Iterable[str]) -> dict[str, str]:
        """Digests by name."""
        return {name: self.digest(name) for name in sorted(names)}

    def of_repository(self, heard: Iterable[str], places: Mapping[str, str]) -> set[str]:
        """Names, relative to the repository, of what was read of it or of its copies, and not of what is made."""
        found: set[str] = set()
        for name in heard:
            if name == reads.EVERYTHING:
                found.add(name)
                continue
            for copy, original in places.items():
                if name.startswith(f"{copy}/"):
                    name = f"{original}{name.removeprefix(copy)}"
            if not name.startswith(f"{self.root}/"):
                continue
            inside = name.removeprefix(f"{self.root}/")
            if not any(f"{inside}/".startswith(f"{made}/") for made in MADE):
                found.add(inside)
        return found

    @functools.cached_property
    def cause(self) -> str:
        """Digest of all that counts for every program."""
        libraries = Path(sysconfig.get_path("purelib"))
        data = [name for name in self._digests if name.startswith("examples/") or "/data/" in name]
        return _hash(
            json.dumps(
                [
                    sys.version,
                    sorted(path.name for path in libraries.glob("*.dist-info")),
                    sorted(data),
                    self.digests(HERE),
                ]
            ).encode()
        )


def _hash(content: bytes) -> str:
    return hashlib.blake2b(content, digest_size=16).hexdigest()


@dataclasses.dataclass(frozen=True)
class Record:
    """What was made: a text that was printed, or files by name with their digests; and what was read, with digests."""

    said: str
    made: Mapping[str, str]
    read: Mapping[str, str]


class Kept:
    """Records in a folder, and the files that they are of."""

    def __init__(self, folder: Path, files: Files) -> None:
        self.folder, self.files = folder, files

    def cause(self, *parts: str) -> str:
        """The name of the record of what these words describe."""
        return _hash(json.dumps([self.files.cause, *parts]).encode())

    def found(self, cause: str) -> Record | None:
        """The record, if all that was read is as it was then."""
        try:
            record = Record(**json.loads((self.folder / f"{cause}.json").read_text(encoding="utf-8")))
        except (OSError, ValueError, TypeError):
            return None
        return record if all(self.files.digest(name) == then for name, then in record.read.items()) else None

    def keep(self, cause: str, said: str, made: Mapping[str, str], read: Iterable[str]) -> Record:
        """Write a record."""
        record = Record(said, made, self.files.digests(read))
        self.folder.mkdir(parents=True, exist_ok=True)
        (self.folder / f"{cause}.json").write_text(json.dumps(dataclasses.asdict(record)), encoding="utf-8")
        return record


@functools.cache
def files() -> Files:
    """The files of the repository as this process found them."""
    return Files()


def digest_of(path: Path) -> str:
    """Digest of a file that was made, now."""
    return _hash(path.read_bytes()) if path.is_file() else "none"


def run(
    commands: Any, module: str, arguments: Sequence[str], folder: Path, environment: Mapping[str, str]
) -> tuple[int, str, set[str]]:
    """Run a module in a fork: its exit code, what it printed, and the names of what it read."""
    with tempfile.TemporaryDirectory(prefix="ballscrew-docs-") as place:
        record = Path(place) / "reads"
        code, said = commands.together([record, module, *arguments], folder, environment, module="recorded")
        return code, said, reads.names(record.read_bytes()) if record.is_file() else {reads.EVERYTHING}
