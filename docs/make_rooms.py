"""Write the table of rooms in CONTRIBUTING.md: subject, size and imports of each package, and the number of cycles.

``make rooms``. The import graph is that of import-linter: type-only and lazy imports count.
"""

from __future__ import annotations

import ast
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import NamedTuple

import grimp

HERE = Path(__file__).parent.parent
SOURCE = HERE / "src" / "ballscrew"
CONTRIBUTING = HERE / "CONTRIBUTING.md"
BEGIN, END = "<!-- rooms: begin -->", "<!-- rooms: end -->"
#: The row of the modules that are in no room.
TOP = "top modules"
TOP_SUBJECT = "Quantities and units, errors, records, references, atomic files, arrays"


class Room(NamedTuple):
    """A package directly under ``ballscrew``."""

    name: str
    subject: str
    #: Lines of each file, by its path in the room.
    files: Mapping[str, int]
    imports: frozenset[str]

    @property
    def lines(self) -> int:
        """Lines of all files."""
        return sum(self.files.values())


@cache
def modules() -> Mapping[str, frozenset[str]]:
    """The modules that each module of the package imports."""
    graph = grimp.build_graph("ballscrew", cache_dir=None)
    return {module: frozenset(graph.find_modules_directly_imported_by(module)) for module in graph.modules}


def room_of(module: str) -> str:
    """The room of a module."""
    name = [*module.split("."), ""][1]
    return name if (SOURCE / name / "__init__.py").is_file() and name else TOP


def arrows() -> dict[str, frozenset[str]]:
    """The rooms that each room imports."""
    found: dict[str, set[str]] = {}
    for module, imported in modules().items():
        found.setdefault(room_of(module), set()).update(map(room_of, imported))
    return {room: frozenset(others - {room}) for room, others in found.items()}


def cycles(graph: Mapping[str, frozenset[str]]) -> list[list[str]]:
    """The strongly connected components with more than one member (Tarjan 1972)."""
    number: dict[str, int] = {}
    low: dict[str, int] = {}
    stack: list[str] = []
    found: list[list[str]] = []

    def visit(node: str) -> None:
        number[node] = low[node] = len(number)
        stack.append(node)
        for other in sorted(graph.get(node, ())):
            if other not in number:
                visit(other)
                low[node] = min(low[node], low[other])
            elif other in stack:
                low[node] = min(low[node], number[other])
        if low[node] == number[node]:
            component = stack[stack.index(node) :]
            del stack[stack.index(node) :]
            if len(component) > 1:
                found.append(sorted(component))

    for node in sorted(graph):
        if node not in number:
            visit(node)
    return found


def lines_of(path: Path) -> int:
    """Lines of a file."""
    return len(path.read_text(encoding="utf-8").splitlines())


def rooms() -> list[Room]:
    """The rooms, each above those it imports."""
    graph = arrows()
    depth: dict[str, int] = {}

    def height(name: str) -> int:
        if name not in depth:
            depth[name] = 0  # ends the recursion in a cycle, which the test reports
            depth[name] = 1 + max((height(other) for other in graph[name]), default=0)
        return depth[name]

    found: list[Room] = []
    for name in sorted(graph, key=lambda name: (name == TOP, -height(name), name)):
        folder = SOURCE if name == TOP else SOURCE / name
        paths = sorted(folder.glob("*.py") if name == TOP else folder.rglob("*.py"))
        docstring = ast.get_docstring(ast.parse((folder / "__init__.py").read_text(encoding="utf-8"))) or ""
        subject = TOP_SUBJECT if name == TOP else docstring.partition("\n")[0].rstrip(".")
        files = {path.relative_to(folder).as_posix(): lines_of(path) for path in paths}
        found.append(Room(name, subject, files, graph[name]))
    return found


def table() -> str:
    """The table and the figures below it."""
    found = rooms()
    lines = ["| room | subject | files | lines | largest file | imports |", "|---|---|---|---|---|---|"]
    for room in found:
        largest = max(room.files, key=lambda name: room.files[name])
        imports = ", ".join(f"`{name}`" for name in sorted(room.imports - {TOP}))
        name = room.name if room.name == TOP else f"`{room.name}/`"
        size = f"{room.files[largest]} (`{largest}`)"
        lines.append(f"| {name} | {room.subject} | {len(room.files)} | {room.lines} | {size} | {imports} |")
    largest_room = max(found, key=lambda room: room.lines)
    total, files = sum(room.lines for room in found), sum(len(room.files) for room in found)
    lines += [
        "",
        f"Import cycles: {len(cycles(arrows()))} between rooms, {len(cycles(modules()))} between modules. Largest "
        f"room: `{largest_room.name}`, {largest_room.lines} lines. In all: {total} lines in {files} files.",
    ]
    return "\n".join(lines)


def page(text: str) -> str:
    """The text of CONTRIBUTING.md with the table of today."""
    before, _, rest = text.partition(BEGIN)
    _, _, after = rest.partition(END)
    return f"{before}{BEGIN}\n{table()}\n{END}{after}"


if __name__ == "__main__":
    CONTRIBUTING.write_text(page(CONTRIBUTING.read_text(encoding="utf-8")), encoding="utf-8")
