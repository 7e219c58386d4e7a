"""ballscrew: what a ball screw loses to friction, and why, term by term.

The public names are listed once, in ``__init__.pyi``. Each is loaded at its first use, so that
``import ballscrew`` costs little more than NumPy.
"""

from __future__ import annotations

import importlib
from typing import Any

from ballscrew.basis import displayed
from ballscrew.basis.version import __version__ as __version__

# one line each: from MODULE import NAME as NAME; to parse them with ast would take as long as all else here
with open(f"{__file__}i", encoding="utf-8") as _stub:  # noqa: PTH123  (pathlib is slow to load)
    _MODULES = {words[3]: words[1] for line in _stub if (words := line.split()) and words[0] == "from"}

__all__ = sorted(_MODULES)  # pyright: ignore[reportUnsupportedDunderAll]  (read from the stub)


def __getattr__(name: str) -> Any:
    module = _MODULES.get(name)
    if module is None:
        raise AttributeError(f"module 'ballscrew' has no attribute {name!r}")
    value = getattr(importlib.import_module(module), name)
    if isinstance(value, type):
        importlib.import_module("ballscrew.basis.field_docs").show_fields(value)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return list(__all__)


# what a notebook shows of a value is decided by a face, which is loaded when somebody looks
displayed.shown_by(lambda module: importlib.import_module(f"ballscrew.faces.notebook.{module}"))
