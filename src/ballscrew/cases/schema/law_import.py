"""Laws from outside in a case: ``module:name``, imported from beside the case or from the current folder.

Importing a module runs its code. So it happens only where the person at the command line allows it, and never on a
server.
"""

from __future__ import annotations

import contextlib
import dataclasses
import importlib
import re
import reprlib
import sys
from collections.abc import Generator, Mapping
from pathlib import Path
from typing import Any

from ballscrew.basis.errors import MISSING, Fault, InputError, nearest
from ballscrew.physics.friction.law_names import coefficients

#: A law of a module, as it is written.
OUTSIDE = re.compile(r"[A-Za-z_][\w.]*:[A-Za-z_][\w.]*")
NOT_ALLOWED = "add --allow-code on the command line, if you trust it; a server never runs code"

#: Modules with laws that this process has imported.
_imported: set[str] = set()


def law_from_outside(where: str, written: str, folder: Path | None) -> Any:
    """The function or the class that is written as ``module:name``; None for the folder forbids it.

    Raises :class:`~ballscrew.basis.errors.InputError` in one line.
    """
    if not OUTSIDE.fullmatch(written):
        raise InputError(Fault(where, "is no law of a module", written, 'write "module:name", as in "mine:my_law"'))
    if folder is None:
        raise InputError(Fault(where, "is code from outside, which is not allowed", written, NOT_ALLOWED))
    module_name, _, name = written.partition(":")
    result: Any = _module(where, written, module_name, folder)
    for part in name.split("."):
        if not hasattr(result, part):
            laws = [n for n, law in vars(result).items() if callable(law) and law.__module__ == module_name]
            raise InputError(Fault(where, f"{module_name} has no {name}", written, nearest(name, laws)))
        result = getattr(result, part)
    if isinstance(result, type):
        if not dataclasses.is_dataclass(result) or not callable(getattr(result, "__call__", None)):  # noqa: B004  (the class, not the instance)
            problem, remedy = "is a class, but no law", "make it a frozen dataclass with __call__, or name a function"
            raise InputError(Fault(where, problem, written, remedy))
    elif not callable(result):
        remedy = "name a function, or a frozen dataclass with __call__"
        raise InputError(Fault(where, "is no law: it cannot be called", written, remedy))
    return result


def with_plain_numbers(where: str, kind: Any, table: Mapping[str, Any], faults: list[Fault]) -> dict[str, Any]:
    """The coefficients in a table that have no unit declared, as they are; what is wrong goes to the list of faults."""
    if not isinstance(kind, type) or not dataclasses.is_dataclass(kind):
        faults += [
            Fault(f"{where}.{name}", "no coefficient of the law", "", "a function has none: make it a frozen dataclass")
            for name in table
        ]
        return {}
    fields = {field.name: field for field in dataclasses.fields(kind) if field.init}
    plain = {name: value for name, value in table.items() if name not in coefficients(kind)}
    for name, value in plain.items():
        if name not in fields:
            faults.append(Fault(f"{where}.{name}", "no coefficient of the law", "", nearest(name, fields)))
        elif not isinstance(value, int | float) or isinstance(value, bool):
            faults.append(Fault(f"{where}.{name}", "must be a number", reprlib.repr(value), "give it without quotes"))
    missing = [
        name
        for name, field in fields.items()
        if name not in table and field.default is dataclasses.MISSING and field.default_factory is dataclasses.MISSING
    ]
    faults += [Fault(f"{where}.{name}", MISSING, "", f"add {name} = a number") for name in missing]
    return plain


def _module(where: str, written: str, name: str, folder: Path) -> Any:
    try:
        beside = folder.joinpath(*name.split(".")).with_suffix(".py").resolve()
        with _importable(folder):
            module = importlib.import_module(name)
            if name in _imported and beside.is_file() and _file_of(module) != beside:
                # another case had a module of this name in a folder of its own
                del sys.modules[name]
                module = importlib.import_module(name)
    except ModuleNotFoundError as error:
        if error.name is not None and (name == error.name or name.startswith(f"{error.name}.")):
            remedy = f"put {name.partition('.')[0]}.py beside the case or into the current folder"
            raise InputError(Fault(where, f"there is no module {error.name}", written, remedy)) from None
        remedy = "install it, or change the module"
        raise InputError(Fault(where, f"its module needs {error.name}, which is not there", written, remedy)) from None
    except Exception as error:  # the code of a user may raise anything
        problem = f"its module cannot be imported: {type(error).__name__}: {error}"
        raise InputError(Fault(where, problem, written, f"try: python -c 'import {name}'")) from error
    if beside.is_file() and _file_of(module) != beside:
        value = module.__file__ or "a built-in one"
        problem = f"another module {name} is loaded already: {value}"
        raise InputError(Fault(where, problem, written, f"rename {beside.name}"))
    _imported.add(name)
    return module


def _file_of(module: Any) -> Path:
    return Path(module.__file__ or "").resolve()


@contextlib.contextmanager
def _importable(folder: Path) -> Generator[None]:
    """Look into the folder of the case and into the current one first, as ``python -m`` looks into the latter."""
    places = list(dict.fromkeys([str(folder.resolve()), str(Path.cwd())]))
    sys.path[:0] = places
    importlib.invalidate_caches()
    try:
        yield
    finally:
        for place in places:
            sys.path.remove(place)
