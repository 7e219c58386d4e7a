"""Friction of ball screws, cause by cause: torque, efficiency, heat and back-driving, with band and range of validity.

The public names are listed once, in ``__init__.pyi``. Each is loaded at its first use, so that
``import ballscrew`` costs little more than NumPy. Ask for help of one of them,
``help(ballscrew.BallScrew)``: that of the package has all of them, one after the other.
"""

from __future__ import annotations

import importlib
from typing import Any

from ballscrew.basis import displayed
from ballscrew.basis.version import __version__ as __version__

# one line each: from MODULE import NAME as NAME; to parse them with ast would take as long as all else here
with open(f"{__file__}i", encoding="utf-8") as _stub:  # noqa: PTH123  (pathlib is slow to load)
    _MODULES = {words[3]: words[1] for line in _stub if (words := line.split()) and words[0] == "from"}

#: Folders of the package and what their names are for.
_SUBJECTS = {
    "physics": "A ball screw, its parts and its friction",
    "engine": "Many points, derivatives and uncertainty",
    "axis": "The axis around the screw: motion, duty, supports, heat",
    "evidence": "Logs: fits, service and condition",
    "files": "Files and arrays of logs",
    "questions": "Selection and optimisation",
    "cases": "Screws and oils that are known",
    "exports": "Hand-over to other programs",
    "basis": "Errors and version",
}
for _folder, _subject in _SUBJECTS.items():
    _names = [name for name, module in _MODULES.items() if module.split(".")[1] == _folder]
    _lines = [", ".join(_names[place : place + 6]) for place in range(0, len(_names), 6)]
    __doc__ = f"{__doc__ or ''}\n{_subject}:\n    " + ",\n    ".join(_lines) + "\n"

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
