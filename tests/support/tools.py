"""Modules of ``tools/``, which are scripts and no part of the package."""

import contextlib
import importlib.util
import sys
from pathlib import Path

TOOLS = Path(__file__).parents[2] / "tools"


@contextlib.contextmanager
def tool(folder, *names):
    """The modules of these names in a folder of ``tools``, each found by the name that those after it import."""
    found = []
    try:
        for name in names:
            spec = importlib.util.spec_from_file_location(name, TOOLS / folder / f"{name}.py")
            module = importlib.util.module_from_spec(spec)
            sys.modules[name] = module
            spec.loader.exec_module(module)
            found.append(module)
        yield found
    finally:
        for name in names:
            sys.modules.pop(name, None)
