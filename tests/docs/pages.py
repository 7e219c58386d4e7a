"""The pages people read, and what is in them: fenced blocks, and the commands they tell people to type."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Iterator
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
WRITER = DOCS / "writer"

_FENCE = re.compile(r"^(?P<indent>\s*)(?P<ticks>`{3,})(?P<info>.*)$")
_WRITTEN, _END = re.compile(r"^<!-- (?:command|include|file|equation|output): "), "<!-- end -->"
_NOT_RUN = re.compile(r"^<!-- not run: (?P<reason>.+) -->$")


@dataclasses.dataclass(frozen=True)
class Block:
    """One fenced block: what stands behind its ticks, its text, its line, and why it is not run (or nothing)."""

    info: str
    text: str
    line: int
    not_run: str
    #: Whether ``docs/writer`` wrote it: what it shows was run, and is compared there.
    written: bool


def pages() -> list[Path]:
    """Every page."""
    return [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted(DOCS.rglob("*.md"))]


def name(page: Path) -> str:
    """A page as people name it."""
    return page.relative_to(ROOT).as_posix()


def blocks(page: Path) -> list[Block]:
    """The fenced blocks of a page, in their order."""
    found: list[Block] = []
    lines = page.read_text(encoding="utf-8").splitlines()
    number, written = 0, False
    while number < len(lines):
        if _WRITTEN.match(lines[number]) or lines[number] == _END:
            written = lines[number] != _END
        fence = _FENCE.match(lines[number])
        if fence is None:
            number += 1
            continue
        first = number
        number += 1
        while number < len(lines) and lines[number].strip() != fence["ticks"]:
            number += 1
        assert number < len(lines), f"{name(page)}:{first + 1}: this block has no end"
        before = next((line for line in reversed(lines[:first]) if line.strip()), "")
        marker = _NOT_RUN.match(before.strip())
        found.append(
            Block(
                fence["info"].strip(),
                "".join(f"{line}\n" for line in lines[first + 1 : number]),
                first + 1,
                marker["reason"] if marker else "",
                written,
            )
        )
        number += 1
    return found


def markers(page: Path) -> int:
    """How many blocks of a page are said not to run."""
    return sum(bool(_NOT_RUN.match(line.strip())) for line in page.read_text(encoding="utf-8").splitlines())


def commands(page: Path, written: bool = False) -> list[tuple[int, str]]:
    """What a page tells people to type, and the line it stands in; or only that whose output it shows."""
    return [found for block in blocks(page) if block.written or not written for found in _commands_of(block)]


def _commands_of(block: Block) -> Iterator[tuple[int, str]]:
    if block.info == "console":
        typed = ""
        for number, line in enumerate(block.text.splitlines(), start=block.line + 1):
            if typed.endswith("\\"):
                typed += f"\n{line}"
            elif line.startswith("$ "):
                typed = line.removeprefix("$ ")
            else:
                continue
            if not typed.endswith("\\"):
                yield number, re.sub(r" *\\\n *", " ", typed) if block.written else without_comment(typed)


def without_comment(command: str) -> str:
    """A command without the words behind it: ``make demo     # sets up``."""
    return re.sub(r"\s+#\s.*$", "", command)
