"""Directive ``{command} .venv/bin/ballscrew run case.toml``: a command and its output, run while the page is built.

The commands of a page run in one folder, one after the other, with the examples in it: a later one finds what an
earlier one wrote. What they print is kept under ``generated/commands`` by its cause: the program, the examples, the
command, and all commands before it on the page. So only what may have changed is run again.

``:show: Torque .. at rest | Contacts ..`` shows parts of the output, by words in their first and last lines, and says
with a ``…`` where others are left out. ``:keep: out/map.png`` puts a file that the command wrote where the page finds
it: ``generated/commands/PAGE/map.png``.
"""

from __future__ import annotations

import atexit
import functools
import hashlib
import itertools
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
import weakref
from concurrent.futures import Future, ThreadPoolExecutor, wait
from pathlib import Path
from typing import Any

from docutils import nodes
from docutils.parsers.rst import directives
from sphinx.util.docutils import SphinxDirective

DOCS = Path(__file__).parents[1]
ROOT = DOCS.parent
KEPT = DOCS / "generated" / "commands"
#: A command of the program itself, which a fork of a process that has loaded it runs; what a shell is needed for.
PROGRAM, _SHELL = ".venv/bin/ballscrew", re.compile(r"[|&;<>$`*?~\n]")
#: Columns of the terminal, and of a command.
WIDTH, WIDEST = "100", 98


class Command(SphinxDirective):
    """A command with its output."""

    required_arguments = 1
    final_argument_whitespace = True
    option_spec = {"show": directives.unchanged, "keep": directives.unchanged}  # noqa: RUF012  (docutils' own way)

    def run(self) -> list[nodes.Node]:
        typed = " ".join(self.arguments[0].split())
        if self.env.docname in _begun:
            wait([_begun.pop(self.env.docname)])  # an error there occurs again here, and is reported here
        page = self.env.temp_data.setdefault("commands", Page(self.env.docname))
        keep = _words(self.options.get("keep", ""))
        try:
            said = _chosen(page.said(typed, keep), self.options.get("show", ".."))
        except RuntimeError as error:
            raise self.error(str(error)) from error
        _of(self.env)[self.env.docname] = program()
        text = f"$ {_displayed(typed)}\n{said}"
        block = nodes.literal_block(text, text, language="console")
        self.set_source_info(block)
        return [block]


class Page:
    """The commands of one page so far, and the folder they run in."""

    def __init__(self, name: str) -> None:
        self.folder = KEPT / name.replace("/", "-")
        self.place: Path | None = None
        self.cause = program()
        #: Commands whose output was cached; they run only if a later command needs their files.
        self.waiting: list[str] = []

    def said(self, typed: str, keep: list[str]) -> str:
        self.cause = _next_cause(self.cause, typed)
        at_hand = KEPT / f"{self.cause}.txt"
        if at_hand.is_file() and all((self.folder / Path(name).name).is_file() for name in keep):
            self.waiting.append(typed)
            return at_hand.read_text(encoding="utf-8")
        for earlier in self.waiting:
            self._done(earlier)
        self.waiting.clear()
        said = self._done(typed)
        self.folder.mkdir(parents=True, exist_ok=True)
        for name in keep:
            shutil.copy(self._place() / name, self.folder)
        at_hand.write_text(said, encoding="utf-8")
        return said

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
            code, said = program_at_hand().together(words[1:], self._place(), {"COLUMNS": WIDTH, "NO_COLOR": "1"})
            said = said.replace("python -m ballscrew.faces.cli", "ballscrew")
        else:
            code, said = self._by_shell(typed)
        if code:
            raise RuntimeError(f"{typed}\nended with {code}\n{said}")
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


@functools.cache
def program_at_hand() -> Any:
    """The process whose forks run commands: most of the time of a command is that of loading the program."""
    sys.path.append(str(ROOT / "tests"))
    from support.commands import Commands

    found = Commands()
    atexit.register(found.close)
    return found


def _next_cause(before: str, typed: str) -> str:
    return hashlib.sha256(f"{before}\n{typed}".encode()).hexdigest()


def causes(commands: list[str]) -> list[str]:
    """Cache keys of the output of the commands of a page, in order."""
    return list(itertools.accumulate(commands, _next_cause, initial=program()))[1:]


def _chosen(said: str, show: str) -> str:
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


def _displayed(typed: str) -> str:
    """A long command with its options on lines of their own."""
    lines = [""]
    for word in re.split(r" (?=-)", typed):
        if lines[-1] and len(f"{lines[-1]} {word}") > WIDEST:
            lines[-1] += " \\"
            lines.append(f"      {word}")
        else:
            lines[-1] = f"{lines[-1]} {word}".strip() if len(lines) == 1 else f"{lines[-1]} {word}"
    return "\n".join(lines)


@functools.cache
def program() -> str:
    """Digest of everything that the output may depend on."""
    found = hashlib.sha256(f"{WIDTH} {sys.version}".encode())
    for folder in (ROOT / "src" / "ballscrew", ROOT / "examples"):
        for path in sorted(folder.rglob("*")):
            if path.is_file() and path.suffix != ".pyc":
                found.update(f"{path.relative_to(ROOT)}\n".encode())
                found.update(path.read_bytes())
    return found.hexdigest()


#: Pages whose commands run in the background, while other parts of the documentation are made.
_begun: dict[str, Future[None]] = {}
_FENCE = re.compile(r"^```\{command\} (?P<typed>.+)\n(?P<options>(?::\w+:.*\n)*)", re.MULTILINE)


def _begin(_app: Any) -> None:
    """Start the commands of all pages in the background, to use a second processor."""
    pool = ThreadPoolExecutor(1)
    for path in sorted(DOCS.rglob("*.md")):
        text = path.read_text(encoding="utf-8")
        if KEPT.parent not in path.parents and _FENCE.search(text):
            name = path.relative_to(DOCS).with_suffix("").as_posix()
            _begun[name] = pool.submit(_all_of, name, text)
    pool.shutdown(wait=False)


def _all_of(name: str, text: str) -> None:
    page = Page(name)
    for found in _FENCE.finditer(text):
        kept = re.search(r"^:keep:(.*)$", found["options"], re.MULTILINE)
        page.said(" ".join(found["typed"].split()), _words(kept[1] if kept else ""))


def _words(listed: str) -> list[str]:
    return [word.strip() for word in listed.split(",") if word.strip()]


def _of(env: Any) -> dict[str, str]:
    """Version of the program by page, for pages with commands."""
    if not hasattr(env, "ballscrew_commands"):
        env.ballscrew_commands = {}
    return env.ballscrew_commands


def _outdated(_app: Any, env: Any, _added: Any, _changed: Any, _removed: Any) -> list[str]:
    return [page for page, of in _of(env).items() if of != program() and page in env.found_docs]


def setup(app: Any) -> dict[str, bool]:
    KEPT.mkdir(parents=True, exist_ok=True)
    app.add_directive("command", Command)
    app.connect("builder-inited", _begin, priority=1)
    app.connect("env-get-outdated", _outdated)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
