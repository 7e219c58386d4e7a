"""Projects: several named designs in one file, TOML or JSON.

``ballscrew_project = 1`` marks such a file and is its version. Each of ``designs`` has a ``name`` and a ``case``, the
tables of a case file; ``aside`` are tables that somebody keeps with a design and that no command reads.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis.errors import Fault, InputError, nearest, raise_if_any
from ballscrew.cases.case_files import case_text

#: The name that marks a project, and the version that is written and read.
KEY, VERSION = "ballscrew_project", 1
#: Names of a design in a file, and how many designs a file has at most.
_NAMES, MOST_DESIGNS = ("name", "case", "aside"), 100


@dataclasses.dataclass(frozen=True)
class Design:
    """A named case, as tables, and what is kept beside it."""

    name: str
    tables: Mapping[str, Any]
    aside: Mapping[str, Any] = dataclasses.field(default_factory=dict[str, Any])


def is_project(tables: Mapping[str, Any]) -> bool:
    """Test whether tables are those of a project."""
    return KEY in tables or isinstance(tables.get("designs"), list)


def designs_of(tables: Mapping[str, Any], where: str) -> list[Design]:
    """The designs of a project. Raises :class:`~ballscrew.basis.errors.InputError` with all faults of its form."""
    version = tables.get(KEY)
    if type(version) is not int or version != VERSION:
        given = "" if version is None else str(version)
        problem = "is a project without a version" if version is None else "is a project of an unknown version"
        remedy = f"write {KEY} = {VERSION}" if version is None else f"this program reads {KEY} = {VERSION}: update it"
        raise InputError(Fault(where, problem, given, remedy))
    unknown = [name for name in tables if name not in (KEY, "designs")]
    faults = [Fault(name, "unknown name in a project", "", nearest(name, (KEY, "designs"))) for name in unknown]
    listed = tables.get("designs")
    if not isinstance(listed, list) or not listed:
        faults.append(Fault("designs", "has no designs", "", "write [[designs]] with name, and [designs.case.screw] …"))
        listed = []
    if len(listed) > MOST_DESIGNS:
        faults.append(Fault("designs", "too many", str(len(listed)), f"{MOST_DESIGNS} at most in a file"))
        listed = []
    designs = [_design(place, table, faults) for place, table in enumerate(listed, start=1)]
    names = [design.name for design in designs]
    faults += [
        Fault(f"designs.{name}", "is the name of two designs", "", "name both apart")
        for name in dict.fromkeys(names)
        if names.count(name) > 1
    ]
    raise_if_any(faults)
    return designs


def _design(place: int, table: Any, faults: list[Fault]) -> Design:
    where = f"designs[{place}]"
    if not isinstance(table, dict):
        faults.append(Fault(where, "must be a table", str(table), "write [[designs]]"))
        return Design(f"#{place}", {})
    name, case, aside = table.get("name"), table.get("case"), table.get("aside", {})
    faults += [
        Fault(f"{where}.{key}", "unknown name in a design", "", nearest(key, _NAMES))
        for key in table
        if key not in _NAMES
    ]
    if not isinstance(name, str) or not name.strip():
        faults.append(Fault(f"{where}.name", "must be text", str(name), 'write name = "stiffer nut"'))
        name = f"#{place}"
    for key, value in (("case", case), ("aside", aside)):
        if not isinstance(value, dict):
            remedy = "write the tables of a case file, such as [designs.case.screw]"
            faults.append(Fault(f"{where}.{key}", "must be a table", "" if value is None else str(value), remedy))
    return Design(name, case if isinstance(case, dict) else {}, aside if isinstance(aside, dict) else {})


def tables_of(designs: Iterable[Design]) -> dict[str, Any]:
    """The tables of a project file with these designs."""
    listed = [
        {"name": one.name, "case": dict(one.tables), **({"aside": dict(one.aside)} if one.aside else {})}
        for one in designs
    ]
    return {KEY: VERSION, "designs": listed}


def read(path: str | Path) -> list[Design]:
    """The designs of a project file, or the one of a case file, which is called as the file.

    Raises :class:`~ballscrew.basis.errors.InputError`.
    """
    file, name = _parts(path)
    tables = case_text.tables_at(file)
    if not is_project(tables):
        if name:
            raise InputError(Fault(str(file), "is a case file, no project", name, f'leave out "#{name}"'))
        return [Design(file.stem, tables)]
    designs = designs_of(tables, str(file))
    if not name:
        return designs
    named = [design for design in designs if design.name == name]
    if not named:
        raise InputError(Fault(str(file), "has no such design", name, nearest(name, [one.name for one in designs])))
    return named


def file_of(path: str | Path) -> Path:
    """The file of a case, also of the design that ``project.toml#name`` names."""
    return _parts(path)[0]


def _parts(path: str | Path) -> tuple[Path, str]:
    """The file and the name of a design in ``project.toml#name``; a file of that very name comes first."""
    whole = Path(path)
    before, mark, name = str(path).partition("#")
    return (Path(before), name) if mark and not whole.exists() else (whole, "")
