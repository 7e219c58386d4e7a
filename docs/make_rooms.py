"""Write the tables of folders and rooms in CONTRIBUTING.md: subject, size, cohesion and imports of each.

``make rooms``. The import graph is that of import-linter, type-only and lazy imports included, and modules named in
strings, which are imported when they are needed. Cohesion is the share of imports that stay within: of all imports
from or to modules of the room, without those of ``basis``, which all rooms use.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from graphlib import CycleError, TopologicalSorter
from pathlib import Path
from typing import NamedTuple

import grimp

HERE = Path(__file__).parent.parent
SOURCE = HERE / "src" / "ballscrew"
CONTRIBUTING = HERE / "CONTRIBUTING.md"
BEGIN, END = "<!-- rooms: begin -->", "<!-- rooms: end -->"
#: The public face: it loads what is asked for by name, and is no folder.
FACE = "ballscrew"
#: The paper in one file, which imports nothing and is in no folder.
PAPER = "ballscrew.olaru2005"
BASIS = "basis"


class Room(NamedTuple):
    """A folder below ``ballscrew``, or a package in it as ``folder/room``."""

    name: str
    subject: str
    #: Lines of each file, by its path in the room.
    files: Mapping[str, int]
    imports: frozenset[str]
    cohesion: float

    @property
    def lines(self) -> int:
        """Lines of all files."""
        return sum(self.files.values())


@cache
def modules() -> Mapping[str, frozenset[str]]:
    """The modules that each module imports."""
    graph = grimp.build_graph("ballscrew", cache_dir=None)
    return {module: frozenset(graph.find_modules_directly_imported_by(module)) for module in graph.modules}


@cache
def named(module: str) -> frozenset[str]:
    """Modules that are named in the strings of a module; in an f-string the package before the first value counts."""
    text = source(module).read_text(encoding="utf-8")
    strings = (node.value for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Constant))
    found = (re.fullmatch(r"(ballscrew(?:\.\w+)+)\.?(?::\w+)?", text) for text in strings if isinstance(text, str))
    return frozenset(match[1] for match in found if match and match[1] in modules()) - {module}


def source(module: str) -> Path:
    """The file of a module."""
    path = SOURCE.parent / module.replace(".", "/")
    return path / "__init__.py" if path.is_dir() else path.with_suffix(".py")


def folder_of(module: str) -> str:
    """The folder of a module, such as ``physics``."""
    return module.split(".")[1]


def room_of(module: str) -> str:
    """The room of a module, such as ``physics/friction``; the folder for what is in no room of it."""
    parts = module.split(".")[1:3]
    return "/".join(parts) if (SOURCE / "/".join(parts)).is_dir() else parts[0]


def edges(place: Callable[[str], str]) -> Iterator[tuple[str, str]]:
    """The place of each importing module with that of the imported one."""
    for module, imported in modules().items():
        if module != FACE:
            for other in (imported | named(module)) - {FACE}:
                yield place(module), place(other)


def arrows(place: Callable[[str], str]) -> dict[str, frozenset[str]]:
    """The places that each place imports."""
    found: dict[str, set[str]] = {place(module): set() for module in modules() if module not in (FACE, PAPER)}
    for one, other in edges(place):
        found[one].add(other)
    return {name: frozenset(others - {name}) for name, others in found.items()}


def of_the_basis(name: str) -> bool:
    """True for the basis and for rooms in it."""
    return name.split("/")[0] == BASIS


def cohesion(name: str, place: Callable[[str], str]) -> float:
    """Share of the imports from or to a place that stay in it, without those of the basis; 0 without any."""
    whole = of_the_basis(name)
    ours = [pair for pair in edges(place) if name in pair and (whole or not any(map(of_the_basis, pair)))]
    return sum(one == other for one, other in ours) / len(ours) if ours else 0.0


def cycles(graph: Mapping[str, frozenset[str]]) -> list[list[str]]:
    """The members of a circle; none where there is no circle."""
    try:
        TopologicalSorter(graph).prepare()
    except CycleError as error:
        return [sorted(set(error.args[1]))]
    return []


def lines_of(path: Path) -> int:
    """Lines of a file."""
    return len(path.read_text(encoding="utf-8").splitlines())


def heights(graph: Mapping[str, frozenset[str]]) -> dict[str, int]:
    """Longest way down from each place."""
    found: dict[str, int] = {}
    for name in TopologicalSorter(graph).static_order():
        found[name] = 1 + max((found[other] for other in graph[name]), default=0)
    return found


def rooms(place: Callable[[str], str]) -> list[Room]:
    """The folders, or the rooms in them, each above those it imports."""
    graph = arrows(place)
    high = heights(graph)
    folders = heights(arrows(folder_of))
    found: list[Room] = []
    for name in sorted(graph, key=lambda name: (-folders[name.split("/")[0]], -high[name], name)):
        folder = SOURCE / name
        # what is beside the rooms of a folder, or all of it
        paths = sorted(folder.glob("*.py") if place is room_of and "/" not in name else folder.rglob("*.py"))
        docstring = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
        files = {path.relative_to(folder).as_posix(): lines_of(path) for path in paths}
        subject = docstring.partition("\n")[0].rstrip(".")
        found.append(Room(name, subject, files, graph[name], cohesion(name, place)))
    return found


def table() -> str:
    """The folders, the rooms in them, and the figures below."""
    folders = rooms(folder_of)
    lines = ["| folder | subject | files | lines | cohesion | imports |", "|---|---|---|---|---|---|"]
    for each in folders:
        imports = ", ".join(f"`{name}`" for name in sorted(each.imports))
        lines.append(
            f"| `{each.name}/` | {each.subject} | {len(each.files)} | {each.lines} | {each.cohesion:.2f} | {imports} |"
        )
    lines += ["", "| room | subject | files | lines | cohesion |", "|---|---|---|---|---|"]
    lines += [
        f"| `{each.name}/` | {each.subject} | {len(each.files)} | {each.lines} | {each.cohesion:.2f} |"
        for each in rooms(room_of)
        if "/" in each.name
    ]
    total, files = sum(each.lines for each in folders), sum(len(each.files) for each in folders)
    lines += [
        "",
        f"Circles of imports: {len(cycles(arrows(folder_of)))} between folders, {len(cycles(modules()))} between "
        f"modules. In all: {total} lines in {files} files.",
    ]
    return "\n".join(lines)


def page(text: str) -> str:
    """The text of CONTRIBUTING.md with the tables of today."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{table()}\n{END}{after}"


if __name__ == "__main__":
    CONTRIBUTING.write_text(page(CONTRIBUTING.read_text(encoding="utf-8")), encoding="utf-8")
    print(table())
