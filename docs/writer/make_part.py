"""Make a generated part: ``make_part FOLDER NAME MODULE:FUNCTION``, run in a fork of ``libraries``.

A name with a suffix is a file: the function returns its text, or a table that is written as JSON, or draws it
(``.svg``); of a module alone it is what it prints. Else it is a folder, and the function returns its files by name:
texts, and functions that draw. A function that takes the folder fills it by itself.
"""

import contextlib
import importlib
import inspect
import io
import json
import runpy
import sys
from pathlib import Path
from typing import Any


def make(folder: str, name: str, maker: str) -> None:
    """Call the function, and write what it returns."""
    module, _, function = maker.partition(":")
    target = Path(folder, name)
    if not function:
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            runpy.run_module(module)
        put(target, printed.getvalue())
        return
    make = getattr(importlib.import_module(module), function)
    if not target.suffix and inspect.signature(make).parameters:
        make(target)
    else:
        put(target, make if target.suffix == ".svg" else make())


def put(target: Path, found: Any) -> None:
    """Write a file, or those of a folder."""
    if not target.suffix:
        for name, content in found.items():
            put(target / name, content)
        return
    target.parent.mkdir(parents=True, exist_ok=True)
    if target.suffix == ".svg":
        from ballscrew.questions.shared import charts  # is of the parts that have figures

        charts.draw(found, target)
    else:
        text = found if isinstance(found, str) else json.dumps(found, ensure_ascii=False, indent=1)
        target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    make(*sys.argv[1:])
