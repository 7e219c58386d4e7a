"""Old module paths, served for one release: ``ballscrew.analyses.sweep`` is ``ballscrew.sweeps.sweep``.

The table is ``data/moved_modules.txt``, read when an old path is imported. To be removed with 0.3.
"""

from __future__ import annotations

import functools
import importlib
import sys
import warnings
from collections.abc import Mapping
from importlib.machinery import ModuleSpec
from types import ModuleType
from typing import Any

#: Folders that there are no more: empty packages whose modules are all in the table.
_FOLDERS = ("ballscrew.analyses", "ballscrew.engine", "ballscrew.interfaces")
#: What an old path has below ``ballscrew``; for all others the table is not read.
_OLD = frozenset(
    {"analyses", "engine", "interfaces", "assembly", "calibrations", "faults", "model", "result", "validity"}
)
#: Old paths within packages that are still there.
_WITHIN = frozenset({"ballscrew.components.catalogue", "ballscrew.components.installation"})


@functools.cache
def moved_modules() -> Mapping[str, str]:
    """New path of each module by its old path."""
    from importlib.resources import files  # slow to load, and seldom needed

    text = files("ballscrew").joinpath("data/moved_modules.txt").read_text(encoding="utf-8")
    pairs = (line.split() for line in text.splitlines() if line and not line.startswith("#"))
    return {f"ballscrew.{old}": f"ballscrew.{new}" for old, new in pairs}


class _MovedModule:
    """Loads the module at the new path under the old one."""

    def __init__(self, new: str) -> None:
        self._new = new

    def create_module(self, _spec: ModuleSpec) -> ModuleType:
        module = importlib.import_module(self._new)
        self._spec = module.__spec__
        return module

    def exec_module(self, module: ModuleType) -> None:
        module.__spec__ = self._spec  # the import system has put that of the old path there


class _MovedPackage:
    """Makes a package at the old path whose names are those at the new one.

    A package of its own: modules imported below it become attributes of it, and must not hide names of the new one.
    """

    def __init__(self, new: str) -> None:
        self._new = new

    def create_module(self, _spec: ModuleSpec) -> None:
        return None

    def exec_module(self, module: ModuleType) -> None:
        new = importlib.import_module(self._new)

        def name_of_new(name: str) -> Any:
            return getattr(new, name)

        module.__dict__["__getattr__"] = name_of_new


class _EmptyPackage:
    """Makes a package that holds nothing but moved modules."""

    def create_module(self, _spec: ModuleSpec) -> None:
        return None

    def exec_module(self, _module: ModuleType) -> None:
        pass


class _MovedModules:
    """Finds old module paths, before the other finders: they would load a second copy of what is in a moved folder."""

    def find_spec(self, fullname: str, *_: Any) -> ModuleSpec | None:
        if not fullname.startswith("ballscrew.") or (fullname.split(".")[1] not in _OLD and fullname not in _WITHIN):
            return None
        if fullname in _FOLDERS:
            return ModuleSpec(fullname, _loader(_EmptyPackage()), is_package=True)
        new = moved_modules().get(fullname)
        if new is None:
            return None
        warnings.warn(f"{fullname} is now {new}; the old path goes with 0.3", DeprecationWarning, stacklevel=2)
        if any(old.startswith(f"{fullname}.") for old in moved_modules()):
            return ModuleSpec(fullname, _loader(_MovedPackage(new)), is_package=True)
        return ModuleSpec(fullname, _loader(_MovedModule(new)))


def _loader(loader: Any) -> Any:
    """A loader by its methods: the base class would cost the import of the package a fifth of its time."""
    return loader


def serve_old_paths() -> None:
    """Let old module paths be imported, each with a ``DeprecationWarning`` that names the new one."""
    if not any(isinstance(finder, _MovedModules) for finder in sys.meta_path):
        sys.meta_path.insert(0, _MovedModules())
