"""What each test runs: pytest with coverage and the plugin ``contexts``, and what they have noted in a folder."""

from __future__ import annotations

import json
import os
import shutil
import sqlite3
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

from coverage.numbits import numbits_to_nums

HERE = Path(__file__).parent
ROOT = HERE.parents[1]
SOURCE = ROOT / "src" / "ballscrew"


def started(folder: Path, include: str, arguments: Sequence[str], **environment: str) -> subprocess.Popen[bytes]:
    """A process of pytest that notes in an empty folder what each test runs of some files, and prints there."""
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "commands").mkdir(parents=True)
    noted = {
        "COVERAGE_FILE": str(folder / "coverage"), "SECONDS_OF_TESTS": str(folder / "seconds.json"),
        "PYTHONPATH": str(HERE), "LINES_OF_COMMANDS": str(folder / "commands"), "LINES_OF": include,
    }  # fmt: skip
    measure = [sys.executable, "-m", "coverage", "run", f"--rcfile={os.devnull}", f"--include={include}"]
    with (folder / "pytest.txt").open("wb") as output:
        return subprocess.Popen(
            [*measure, "-m", "pytest", "-p", "contexts", *arguments],
            cwd=ROOT,
            env={**os.environ, **noted, **environment},
            stdout=output,
            stderr=subprocess.STDOUT,
        )


def executed(folder: Path) -> Iterator[tuple[str, str, Sequence[int]]]:
    """Files below ``src/ballscrew``, what was run there for (a test or a shared fixture), and lines."""
    database = sqlite3.connect(folder / "coverage")
    query = (
        "select path, context, numbits from line_bits join file on file.id = file_id "
        "join context on context.id = context_id where context != ''"
    )
    for path, context, bits in database.execute(query):
        yield _named(path), context, numbits_to_nums(bits)
    for file in (folder / "commands").iterdir():
        noted = json.loads(file.read_text(encoding="utf-8"))
        if noted["context"]:
            yield from ((_named(path), noted["context"], lines) for path, lines in noted["lines"].items())


def _named(path: str) -> str:
    return Path(path).relative_to(SOURCE).as_posix()


def seconds(folder: Path) -> dict[str, dict[str, float]]:
    """Seconds of tests and shared fixtures, and the tests of each of these."""
    return json.loads((folder / "seconds.json").read_text(encoding="utf-8"))
