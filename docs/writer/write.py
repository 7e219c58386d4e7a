"""Write into the pages what programs make for them: outputs of commands, tables, figures, numbers, formulas, files.

So a page reads where it lies, without a build. What is written stands between marks, which no reader sees::

    <!-- command: .venv/bin/ballscrew run examples/feed_drive.toml
    show: Torque .. at rest
    keep: out/map.png -->
    <!-- end -->

- ``command``: the command and what it prints. ``show`` chooses parts, by words in their first and last lines, and says
  with a ``…`` where others are left out. ``keep`` puts files that the command wrote into ``figures/PAGE``;
- ``include``: a table or a text that a program makes (``parts.py`` lists them), or one of ``docs/*.inc``;
- ``file``: a file of the repository, or one that a command of the page has kept (``commands/PAGE/NAME``), as code:
  whole, ``from`` a line, ``to`` before another, or its first ``lines``;
- ``equation``: the formula of a function, with its symbols, units and source; ``show`` chooses of title, formula,
  letters and remark. A section explains a letter once;
- ``output``: what the Python block before it prints; of a page such blocks alone are run, and share their names;
- ``<!--= NAME-->0.87<!--/-->``: a number.

Decisions are as they were written: no mark in them is followed. A figure is in ``figures/PART`` where a page shows it.

``python docs/writer/write.py`` writes; ``--check`` only compares, and fails where a page or a figure is not what its
program makes; ``--unless-stamped`` does nothing where no file has changed since all pages were written. Names of pages
choose some of them.
"""

from __future__ import annotations

import argparse
import difflib
import functools
import io
import json
import os
import re
import shutil
import sys
from collections.abc import Iterator, Mapping
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import NamedTuple

import compare
import kept
import sources
from command import DOCS, MADE, Page, chosen, displayed
from equation import SHOWN, as_markdown, letters
from kept import ROOT
from parts import PARTS, Part, numbers_of, part_of

FIGURES = DOCS / "figures"
_BLOCK = re.compile(
    r"^(?P<mark><!-- (?P<kind>command|include|file|equation|output): (?P<what>[^\n]+?)"
    r"(?P<options>(?:\n[a-z]+: [^\n]+?)*) -->\n)"
    r"(?P<written>.*?)^<!-- end -->$",
    re.MULTILINE | re.DOTALL,
)
#: The options of each kind of mark.
OPTIONS = {"command": {"show", "keep"}, "file": {"from", "to", "lines"}, "equation": {"show"}} | {
    kind: set[str]() for kind in ("include", "output")
}
_MARK = re.compile(rf"^<!-- (?:{'|'.join(OPTIONS)}): ", re.MULTILINE)
_NUMBER = re.compile(r"(?P<mark><!--= (?P<name>\w+)-->)(?P<written>[^<]*)<!--/-->")
_FIGURE = re.compile(r"\((?:\.\./)*figures/(?P<name>[\w./-]+)\)")
#: A figure that stands beside the text that shows it, where a program made both.
_IMAGE = re.compile(r"(?P<before>!\[[^\]]*\]\()(?P<name>[\w.-]+)\)")


class Failed(Exception):
    """What programs make is not what the pages have, or cannot be made."""


def pages() -> list[str]:
    """The names of all pages but those of decisions; the first is outside their folder."""
    names = (path.relative_to(DOCS).with_suffix("").as_posix() for path in DOCS.rglob("*.md"))
    return ["../README", *sorted(name for name in names if not name.startswith("decisions/"))]


class Written:
    """A page, and what programs make for it."""

    def __init__(self, name: str, text: str | None = None) -> None:
        self.name, self.path = name, DOCS / f"{name}.md"
        self.text = self.path.read_text(encoding="utf-8") if text is None else text
        self.blocks = [*_BLOCK.finditer(self.text)]
        if not len(_MARK.findall(self.text)) == self.text.count("\n<!-- end -->\n") == len(self.blocks):
            raise Failed(f"{name}: a mark has no end, or an end no mark")
        for block in self.blocks:
            if unknown := _options(block).keys() - OPTIONS[block["kind"]]:
                raise Failed(f"{name}: {block['kind']} {block['what']} has no option {', '.join(sorted(unknown))}")
        #: The way from the page to the folder of all pages.
        self.up = "../" * name.count("/")

    @property
    def commands(self) -> list[tuple[str, list[str]]]:
        """The commands, each with the files to keep."""
        return [
            (block["what"], _listed(_options(block).get("keep", "")))
            for block in self.blocks
            if block["kind"] == "command"
        ]

    @property
    def numbers(self) -> set[str]:
        """The names of the numbers in the text."""
        return {number["name"] for number in _NUMBER.finditer(self.text)}

    @property
    def kept(self) -> set[str]:
        """The files that its commands write, below the folder of figures."""
        folder = self.name.replace("/", "-")
        return {f"{folder}/{Path(name).name}" for _, keep in self.commands for name in keep}

    @property
    def figures(self) -> set[str]:
        """The figures that it shows, below their folder."""
        return figures_of(self.text)

    @property
    def parts(self) -> set[str]:
        """The parts whose tables, numbers or figures it has."""
        included = {block["what"] for block in self.blocks if block["kind"] in ("include", "file")}
        return {
            *(
                part_of(name)
                for name in included
                if not name.endswith(".inc") and not name.startswith("commands/") and not (ROOT / name).is_file()
            ),
            *map(part_of, self.made_here(self.figures) - self.kept),
            *map(numbers_of, self.numbers),
        }

    def made_here(self, names: set[str]) -> set[str]:
        """The figures that are not kept by the command of another page: the gallery shows those, too."""
        own = {self.name.replace("/", "-"), *PARTS}
        folders = {name: name.partition("/")[0] for name in names}
        return {
            name
            for name, folder in folders.items()
            if folder in own or not (DOCS / f"{folder.replace('-', '/', 1)}.md").is_file()
        }

    @property
    def runs(self) -> bool:
        """True where something of it is run."""
        return any(block["kind"] in ("command", "output") for block in self.blocks)

    def outputs(self) -> list[str]:
        """Output of its commands and of its Python blocks."""
        page, printed = Page(self.name), self._printed()
        commands = iter(self.commands)
        return [
            next(printed) if block["kind"] == "output" else page.said(*next(commands))
            for block in self.blocks
            if block["kind"] in ("command", "output")
        ]

    def _printed(self) -> Iterator[str]:
        shown = io.StringIO()
        names = {"print": functools.partial(print, file=shown)}
        for block in self.blocks:
            if block["kind"] == "output":
                shown.truncate(shown.seek(0))
                source = self.text[: block.start()].rpartition("```python\n")[2].partition("```")[0]
                exec(compile(source, self.name, "exec"), names)
                yield shown.getvalue()

    def with_all(self, outputs: list[str], numbers: Mapping[str, str]) -> str:
        """The text with everything in its place."""
        said = iter(outputs)
        text = _BLOCK.sub(lambda block: f"{block['mark']}{self._written(block, said)}<!-- end -->", self.text)
        if unknown := self.numbers - numbers.keys():
            raise Failed(f"{self.name}: nothing makes the number {', '.join(sorted(unknown))}")
        return _NUMBER.sub(lambda number: f"{number['mark']}{numbers[number['name']]}<!--/-->", text)

    def _written(self, block: re.Match[str], said: Iterator[str]) -> str:
        what, options = block["what"], _options(block)
        if block["kind"] == "command":
            return _fenced("console", f"$ {displayed(what)}\n{chosen(next(said), options.get('show', '..'))}")
        if block["kind"] == "output":
            return _fenced("text", next(said))
        if block["kind"] == "equation":
            return as_markdown(what, self.up, _shown(block), self._explained(block))
        if block["kind"] == "file":
            return self._file(what, options)
        text = ((DOCS if what.endswith(".inc") else MADE) / what).read_text(encoding="utf-8")
        folder = f"{self.up}figures/{what.rpartition('/')[0]}/"
        return _apart(_IMAGE.sub(lambda image: f"{image['before']}{folder}{image['name']})", self._expanded(text)))

    def _explained(self, block: re.Match[str]) -> dict[str, str]:
        """The letters that formulas before this one explain, in its section of the page."""
        start = self.text.rfind("\n## ", 0, block.start())
        return {
            letter: meaning
            for other in self.blocks
            if other["kind"] == "equation" and start < other.start() < block.start() and "letters" in _shown(other)
            for letter, meaning in letters(other["what"]).items()
        }

    def _file(self, what: str, options: Mapping[str, str]) -> str:
        found = ROOT / what if (ROOT / what).is_file() else MADE / what
        lines = found.read_text(encoding="utf-8").splitlines()
        first = _line(what, lines, options["from"], 0) if "from" in options else 0
        last = _line(what, lines, options["to"], first) if "to" in options else int(options.get("lines", len(lines)))
        language = {".toml": "toml", ".py": "python"}.get(found.suffix, "text")
        return _fenced(language, "\n".join(lines[first:last]).strip("\n") + "\n")

    def _expanded(self, text: str) -> str:
        """A text that a program made, with the formulas and the sources that it names."""
        whole = _BLOCK.sub(lambda block: as_markdown(block["what"], self.up), text)
        return sources.cited(whole, self.up)


def figures_of(text: str) -> set[str]:
    """The figures that a text shows, below their folder."""
    return {figure["name"] for figure in _FIGURE.finditer(text)}


def _line(what: str, lines: list[str], words: str, first: int) -> int:
    for number in range(first, len(lines)):
        if words in lines[number]:
            return number
    raise Failed(f"{what} has no line with: {words}")


def _options(block: re.Match[str]) -> dict[str, str]:
    pairs = (line.partition(": ") for line in block["options"].strip("\n").splitlines())
    return {name: value for name, _, value in pairs}


def _shown(block: re.Match[str]) -> list[str]:
    """What a page shows of a formula."""
    return _listed(_options(block).get("show", ",".join(SHOWN)))


def _listed(words: str) -> list[str]:
    return [word.strip() for word in words.split(",") if word.strip()]


def _fenced(language: str, text: str) -> str:
    return f"```{language}\n{text}```\n"


def _apart(text: str) -> str:
    """A text with an empty line around it: else a table belongs to the mark before it."""
    return "\n" + text.strip("\n") + "\n\n"


class Made:
    """All that is made for some pages: in the background, each thing once."""

    def __init__(self, pages: list[Written]) -> None:
        self._pool = ThreadPoolExecutor(max(2, (os.cpu_count() or 2) - 1))
        wanted = {part for page in pages for part in page.parts}
        order = [*(part for part in wanted if part not in PARTS), *(part for part in PARTS if part in wanted)]
        self._parts = {name: self._pool.submit(self._part, name) for name in order}
        self._outputs: dict[str, Future[list[str]]] = {
            page.name: self._pool.submit(page.outputs) for page in pages if page.runs
        }

    def _part(self, name: str) -> None:
        part = Part(name)
        if part.at_hand() is None:
            part.make()
            print(f"made {name}", file=sys.stderr, flush=True)

    def text(self, page: Written) -> str:
        """The text of a page, once all of it is there."""
        for name in page.parts:
            self._parts[name].result()
        numbers: dict[str, str] = {}
        for name in {numbers_of(number) for number in page.numbers}:
            numbers |= json.loads((MADE / name).read_text(encoding="utf-8"))
        outputs = self._outputs[page.name].result() if page.name in self._outputs else []
        return page.with_all(outputs, numbers)

    def figure(self, name: str, page: Written) -> Path:
        """The file of a figure as its program made it."""
        return MADE / "commands" / name if name in page.kept else MADE / name

    def close(self) -> None:
        """Give up what is not made yet."""
        self._pool.shutdown(wait=True, cancel_futures=True)


#: What goes wrong with one page, of which the others are made all the same.
_FAULTS = Failed, LookupError, OSError, RuntimeError, ValueError


class Outcome(NamedTuple):
    """What differs between pages and programs, and what cannot be made."""

    differ: list[str]
    failed: list[str]


def put(names: list[str], write: bool) -> Outcome:
    """Make all of some pages, and write or only compare it."""
    found = [Written(name) for name in names]
    made = Made(found)
    differ, failed = Outcome([], [])
    try:
        for page in found:
            try:
                text = made.text(page)
            except _FAULTS as error:
                failed.append(f"{page.name}: {error}\n")
                continue
            if not compare.same_text(page.text, text):
                differ.append(_difference(page, text))
                if write:
                    page.path.write_text(text, encoding="utf-8")
            for name in sorted(page.made_here(figures_of(text))):
                before, now = FIGURES / name, made.figure(name, page)
                if not now.is_file():
                    failed.append(f"{page.name}: nothing makes figures/{name}\n")
                elif not compare.same_figure(before, now):
                    differ.append(f"figures/{name} of {page.name} is another figure\n")
                    if write:
                        before.parent.mkdir(parents=True, exist_ok=True)
                        shutil.copy(now, before)
    finally:
        made.close()
    return Outcome(differ, failed)


def _difference(page: Written, text: str) -> str:
    lines = difflib.unified_diff(
        page.text.splitlines(True), text.splitlines(True), page.name, "what programs make", n=1
    )
    return "".join(lines)


def left_over(names: list[str]) -> list[str]:
    """Figures that no page shows."""
    shown = {name for page in names for name in Written(page).figures}
    files = (path for path in FIGURES.rglob("*.*") if path != ROOT / kept.STAMP)
    return sorted(path.as_posix() for path in files if path.relative_to(FIGURES).as_posix() not in shown)


def main(arguments: list[str]) -> int:
    """Write, or compare."""
    parser = argparse.ArgumentParser(description="write into the pages what programs make for them")
    parser.add_argument("pages", nargs="*", help="such as howto/duty; all, if none is named")
    parser.add_argument("--check", action="store_true", help="only compare; 1 if something differs")
    parser.add_argument("--unless-stamped", action="store_true", help="nothing, if no file has changed since")
    chosen_by = parser.parse_args(arguments)
    if chosen_by.unless_stamped and kept.stamp_holds():
        print("pages are as they were written: no file has changed since")
        return 0
    try:
        differ, failed = put(chosen_by.pages or pages(), write=not chosen_by.check)
        failed += [] if chosen_by.pages else [f"no page shows {name}\n" for name in left_over(pages())]
    except _FAULTS as error:
        differ, failed = Outcome([], [f"{error}\n"])
    sys.stdout.writelines(differ)
    if chosen_by.check and differ:
        print("make pages writes what programs make now")
    sys.stderr.writelines(failed)
    if failed or (chosen_by.check and differ):
        return 1
    if not (chosen_by.check or chosen_by.pages):
        kept.stamp()
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
