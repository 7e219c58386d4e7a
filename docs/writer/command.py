"""The commands of a page, and what they print.

The commands of a page run in one folder, one after the other, with the examples in it: a later one finds what an
earlier one wrote. What they print is kept under ``out/pages/commands`` (``kept.py``): they run again only where a file
has changed.
"""

from __future__ import annotations

import atexit
import functools
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import threading
import weakref
from pathlib import Path
from typing import Any

import kept
from kept import ROOT, Kept, Record

HERE = Path(__file__).parent
DOCS = ROOT / "docs"
#: Where what programs made for the pages is kept.
MADE = ROOT / "out" / "pages"
KEPT = MADE / "commands"
#: A command of the program itself, which a fork of a process that has loaded it runs; what a shell is needed for.
PROGRAM, MODULE, _SHELL = ".venv/bin/ballscrew", "ballscrew.faces.cli", re.compile(r"[|&;<>$`*?~\n]")
#: Columns of the terminal, and of a command.
WIDTH, WIDEST = "100", 98


class Page:
    """The commands of one page so far, and the folder they run in."""

    def __init__(self, name: str, root: Path = ROOT) -> None:
        self.folder = KEPT / name.replace("/", "-")
        self.place: Path | None = None
        self._kept = Kept(KEPT, root)
        #: All commands so far.
        self.typed: list[str] = []
        #: Commands whose output was kept; they run only if a later command needs their files.
        self.waiting: list[str] = []

    def said(self, typed: str, keep: list[str]) -> str:
        """The output of the next command, and the files to keep; kept, or made now."""
        self.typed.append(typed)
        what = (WIDTH, *self.typed, "kept:", *keep)
        record = self._kept.find(*what)
        if record is not None and record.made == self._digests(keep):
            self.waiting.append(typed)
            return record.said
        for earlier in self.waiting:
            self._done(earlier)
        self.waiting.clear()
        said = self._done(typed)
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in keep:
            shutil.copy(self._place() / name, self.folder)
        return self._kept.keep(Record(said, self._digests(keep)), *what).said

    def _digests(self, keep: list[str]) -> dict[str, str]:
        return {name: kept.digest_of(self.folder / Path(name).name) for name in keep}

    def _place(self) -> Path:
        if self.place is None:
            self.place = Path(tempfile.mkdtemp(prefix="ballscrew-docs-"))
            weakref.finalize(self, shutil.rmtree, self.place, ignore_errors=True)
            shutil.copytree(ROOT / "examples", self.place / "examples")
            (self.place / ".venv").symlink_to(Path(sys.executable).parents[1], target_is_directory=True)
        return self.place

    def _done(self, typed: str) -> str:
        words = shlex.split(typed)
        if words[0] == PROGRAM and not _SHELL.search(typed):
            environment = {"COLUMNS": WIDTH, "NO_COLOR": "1"}
            code, said = program_at_hand().together(words[1:], self._place(), environment, MODULE)
            said = said.replace(f"python -m {MODULE}", "ballscrew")
        else:
            code, said = self._by_shell(typed)
        if code:
            raise RuntimeError(f"{typed}\nended with {code}\n{said}")
        said = said.replace(f"{self._place()}/", "")  # the same wherever it runs
        return "\n".join(line.rstrip() for line in said.strip("\n").splitlines()) + "\n"

    def _by_shell(self, typed: str) -> tuple[int, str]:
        here = str(Path(sys.executable).parent)
        done = subprocess.run(
            ["bash", "-c", typed],
            cwd=self._place(),
            env={
                **os.environ,
                "PATH": f"{here}{os.pathsep}{os.environ.get('PATH', '')}",
                "COLUMNS": WIDTH,
                "NO_COLOR": "1",
                "PYTHONIOENCODING": "utf-8",
            },
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,  # warnings are part of what one sees
            encoding="utf-8",
            check=False,
        )
        return done.returncode, done.stdout


def program_at_hand() -> Any:
    """The process whose forks run commands: most of the time of a command is that of loading libraries."""
    with _STARTING:  # one for all threads
        return _server()


_STARTING = threading.Lock()


@functools.cache
def _server() -> Any:
    tests = ROOT / "tests"
    sys.path.append(str(tests))
    from support.commands import Commands

    found = Commands(HERE / "libraries.py", [HERE, DOCS, tests, ROOT / "benchmarks"])
    atexit.register(found.close)
    return found


def chosen(said: str, show: str) -> str:
    """Select parts of an output: ``FROM .. TO | FROM .. TO``, from one line to another.

    Each part starts at the first line with FROM and ends at the next line with TO.

    Either text may be left out: from the first line, to the last.
    """
    every, shown, last = said.splitlines(), [], 0
    for part in show.split("|"):
        begin, _, end = (words.strip() for words in part.partition(".."))
        first = _line_with(begin, every, last) if begin else last
        stop = _line_with(end, every, first) + 1 if end else len(every)
        if first > last:
            shown.append("…")
        shown += every[first:stop]
        last = stop
    if last < len(every):
        shown.append("…")
    return "\n".join(shown) + "\n"


def _line_with(words: str, lines: list[str], first: int) -> int:
    for number in range(first, len(lines)):
        if words in lines[number]:
            return number
    raise RuntimeError(f"the command does not say: {words}")


def displayed(typed: str) -> str:
    """A long command with its options on lines of their own."""
    lines = [""]
    for word in re.split(r" (?=-)", typed):
        if lines[-1] and len(f"{lines[-1]} {word}") > WIDEST:
            lines[-1] += " \\"
            lines.append(f"      {word}")
        else:
            lines[-1] = f"{lines[-1]} {word}".strip() if len(lines) == 1 else f"{lines[-1]} {word}"
    return "\n".join(lines)
