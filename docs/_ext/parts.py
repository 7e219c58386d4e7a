"""Generated parts of pages: made in the background, if a page includes them and a file that they depend on has changed.

A page has a part if its text has ``generated/NAME``, or a number of it in double braces.
"""

from __future__ import annotations

import json
import os
import re
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any

import command
import kept
from command import DOCS
from kept import ROOT, Kept, Record
from sphinx.project import Project

GENERATED = DOCS / "generated"
#: What makes each part. A name with a suffix is a file, else it is a folder.
PARTS = {
    "validation": "validation_tables:write",
    "calibration": "calibration_pages:write",
    "nuts": "nut_tables:write",
    "accuracy.md": "accuracy_table:page",
    "olaru2005": "ballscrew.faces.cli.reproduction:reproduce_olaru2005",
    "effects": "effect_tables:write",
    "theory": "theory_figures:write",
    "uncertainty": "uncertainty_tables:write",
    "warm_up": "warm_up_tables:write",
    "starvation": "starvation_tables:write",
    "sensitivity": "sensitivity_figures:write",
    "errata.md": "errata_page:page",
    "bearings": "bearing_comparison:write",
    "api": "api_tables:write",
    "cards.md": "card_table:tables",
    "columns.md": "column_table:column_table",
    "fields.md": "field_table:field_table",
    "slots.md": "law_tables:slots_table",
    "laws.md": "law_tables:laws_table",
    "duty_examples.md": "duty_examples:table",
}
#: Numbers in double braces, by what their names begin with; the last has all others.
NUMBERS = {
    "validation_": ("numbers/validation.json", "validation_tables:numbers"),
    "t_": ("numbers/theory.json", "theory_numbers:numbers"),
    "": ("numbers/effects.json", "effect_tables:numbers"),
}
MAKERS = {**dict(NUMBERS.values()), **PARTS}
_INCLUDED = re.compile(r"generated/(?!commands/)([\w./-]+)")
_NUMBER = re.compile(r"\{\{ *(\w+) *\}\}")


def parts_of(text: str) -> list[str]:
    """The parts that a page includes, without its numbers."""
    found = set()
    for name in _INCLUDED.findall(text):
        whole = [part for part in PARTS if name == part or name.startswith(f"{part}/")]
        if not whole:
            raise LookupError(f"nothing makes generated/{name}")
        found.add(max(whole, key=len))
    return sorted(found)


def numbers_of(text: str) -> list[str]:
    """The parts with the numbers of a page."""
    found = {next(begin for begin in NUMBERS if name.startswith(begin)) for name in _NUMBER.findall(text)}
    return sorted(NUMBERS[begin][0] for begin in found)


class Part:
    """A part, and the record of what it was made from."""

    def __init__(self, name: str, files: kept.Files) -> None:
        self.name, self._kept = name, Kept(GENERATED / "kept", files)
        self._cause = self._kept.cause("part", name, MAKERS[name])

    def at_hand(self) -> Record | None:
        """The record, if it holds and all files are as they were made."""
        record = self._kept.found(self._cause)
        return record if record and all(kept.digest_of(GENERATED / n) == d for n, d in record.made.items()) else None

    def make(self) -> Record:
        """Make it, and write down from what."""
        arguments = [self.name, MAKERS[self.name]]
        before = {path: path.stat().st_mtime_ns for path in self._there()}
        code, said, heard = kept.run(command.program_at_hand(), "make_part", arguments, ROOT, {"COLUMNS": "100"})
        if code:
            raise RuntimeError(f"{self.name}: {MAKERS[self.name]} ended with {code}\n{said}")
        made = {
            path.relative_to(GENERATED).as_posix(): kept.digest_of(path)
            for path in self._there()
            if path.stat().st_mtime_ns != before.get(path)
        }
        return self._kept.keep(self._cause, "", made, self._kept.files.of_repository(heard, {}))

    def _there(self) -> list[Path]:
        target = GENERATED / self.name
        if target.suffix:
            return [target] if target.is_file() else []
        return sorted(path for path in target.rglob("*") if path.is_file())


_making: dict[str, Future[Record]] = {}


def made(name: str) -> Record:
    """The record of a part, once it is there."""
    if name in _making:
        return _making[name].result()
    record = Part(name, kept.files()).at_hand()
    assert record, f"{name} is made before it is needed"
    return record


def _begin(app: Any, config: Any) -> None:
    """Start everything that is to be made for the pages of this build; wait for the numbers alone."""
    # the project itself comes later
    names = Project(app.srcdir, config.source_suffix).discover(config.exclude_patterns, config.include_patterns)
    pages = {name: _text(name) for name in sorted(names)}
    pool = ThreadPoolExecutor(max(2, (os.cpu_count() or 2) - 1))
    app.connect("build-finished", lambda *_: pool.shutdown(wait=False, cancel_futures=True))
    numbers = _all(numbers_of, pages)
    for name in [*numbers, *sorted(_all(parts_of, pages), key=list(PARTS).index)]:
        part = Part(name, kept.files())
        if part.at_hand() is None:
            _making[name] = pool.submit(part.make)
    command.begin(pool, pages)
    found: dict[str, str] = {}
    for name in numbers:
        made(name)
        found |= json.loads((GENERATED / name).read_text(encoding="utf-8"))
    config.myst_substitutions = found


def _all(of: Any, pages: dict[str, str]) -> list[str]:
    return sorted({name for text in pages.values() for name in of(text)})


def _text(name: str) -> str:
    return (DOCS / f"{name}.md").read_text(encoding="utf-8")


def _wait(app: Any, name: str, source: list[str]) -> None:
    """Wait for the parts that a page includes."""
    _versions(app.env)[name] = _version(source[0])


def _version(text: str) -> str:
    return " ".join(made(part).version for part in parts_of(text))


def _versions(env: Any) -> dict[str, str]:
    """Digest of the parts that a page included when it was read, by page."""
    if not hasattr(env, "ballscrew_parts"):
        env.ballscrew_parts = {}
    return env.ballscrew_parts


def _outdated(_app: Any, env: Any, _added: Any, _changed: Any, _removed: Any) -> list[str]:
    """Pages that include a part that is being made, or that was made since they were read."""
    found: list[str] = []
    for page, version in _versions(env).items():
        if page in env.found_docs:
            text = _text(page)
            if any(part in _making for part in parts_of(text)) or _version(text) != version:
                found.append(page)
    return found


def setup(app: Any) -> dict[str, bool]:
    app.connect("config-inited", _begin, priority=900)
    app.connect("source-read", _wait)
    app.connect("env-get-outdated", _outdated)
    return {"parallel_read_safe": False, "parallel_write_safe": True}
