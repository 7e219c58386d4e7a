"""Make a generated part: ``make_part FOLDER NAME MODULE:FUNCTION``, run in a fork of ``libraries``.

A name with a suffix is a file: the function returns its text, or a table that is written as JSON; of a module alone it
is what it prints. Else it is a folder, which the function fills.
"""

import contextlib
import importlib
import io
import json
import runpy
import sys
from pathlib import Path


def make(folder: str, name: str, maker: str) -> None:
    """Call the function, and write what it returns."""
    module, _, function = maker.partition(":")
    target = Path(folder, name)
    target.parent.mkdir(parents=True, exist_ok=True)
    if not function:
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            runpy.run_module(module)
        target.write_text(printed.getvalue(), encoding="utf-8")
        return
    make = getattr(importlib.import_module(module), function)
    if not target.suffix:
        make(target)
    else:
        found = make()
        text = found if isinstance(found, str) else json.dumps(found, ensure_ascii=False, indent=1)
        target.write_text(text, encoding="utf-8")


if __name__ == "__main__":
    make(*sys.argv[1:])
