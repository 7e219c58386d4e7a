"""Origin of functions and classes: this package, an installed library, or code from outside."""

from __future__ import annotations

import functools
import hashlib
import importlib.metadata
import sys
import types
from pathlib import Path
from typing import Any, Literal

import numpy as np

#: Where code comes from: this package, an installed library or Python itself, or anywhere else.
Origin = Literal["package", "library", "outside"]
_PACKAGE = __name__.partition(".")[0]
#: Values without an address.
_DATA = frozenset({dict, list, set, tuple, frozenset, np.ndarray})


def name_in_library(value: Any) -> str:
    """The address of a function, class or constant of a library; empty if it is none."""
    if type(value) in _DATA:
        return ""
    module, name = getattr(value, "__module__", None), getattr(value, "__qualname__", None)
    if isinstance(value, np.ufunc):
        module, name = "numpy", value.__name__
        if getattr(np, name, None) is not value:
            module = "scipy.special"
    if not isinstance(module, str) or not isinstance(name, str) or _origin_of(module) != "library":
        return ""
    if isinstance(value, type) and module == "builtins":
        return f"{library(module)}:{name};"  # also types without a name there, as that of None
    result: Any = sys.modules.get(module)
    for part in name.split("."):
        result = getattr(result, part, None)
    return f"{library(module)}:{module}.{name};" if result is value else ""


def origin(item: Any) -> Origin:
    """The origin of a function, a class or a module."""
    if isinstance(item, types.ModuleType):
        return _origin_of(item.__name__)
    return _origin_of(getattr(item, "__module__", None) or "")


@functools.cache
def _origin_of(module: str) -> Origin:
    top = module.partition(".")[0]
    if top == _PACKAGE:
        return "package"
    file = getattr(sys.modules.get(top), "__file__", None)
    if top in sys.builtin_module_names or (top in sys.stdlib_module_names and top in sys.modules):
        return "library" if file is None or Path(file).is_relative_to(sys.base_prefix) else "outside"
    is_installed = file is not None and {"site-packages", "dist-packages"} & set(Path(file).parts)
    return "library" if is_installed and _distribution(top) else "outside"


@functools.cache
def _distribution(top: str) -> importlib.metadata.Distribution | None:
    try:
        return importlib.metadata.distribution(top)
    except importlib.metadata.PackageNotFoundError:  # named otherwise, as scikit-learn is; to look for it takes longer
        names = importlib.metadata.packages_distributions().get(top)
    return importlib.metadata.distribution(names[0]) if names else None


@functools.cache
def library(module: str) -> str:
    """A library as it is installed: its name, and the version of Python or a digest of its files."""
    top = module.partition(".")[0]
    distribution = None if top in sys.stdlib_module_names else _distribution(top)
    if distribution is None:
        return f"python {sys.version}"
    record = distribution.read_text("RECORD") or ""
    # of scripts and caches the record has other digests in each environment
    lines = [line for line in record.splitlines() if line.startswith(top) and "__pycache__" not in line]
    digest = hashlib.sha256("\n".join(sorted(lines)).encode()).hexdigest()
    return f"{top} {distribution.version} {digest}"
