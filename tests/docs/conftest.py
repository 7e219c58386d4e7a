"""What writes the pages, as modules for these tests alone."""

import importlib
import sys
import types

import pytest

from .pages import WRITER

NAMES = "command", "compare", "equation", "kept", "parts", "sources", "write"


@pytest.fixture(scope="session")
def writer():
    """The modules of ``docs/writer``, by name."""
    sys.path.insert(0, str(WRITER))
    found = {name: importlib.import_module(name) for name in NAMES}
    yield types.SimpleNamespace(**found)
    sys.path.remove(str(WRITER))
    for name in NAMES:
        del sys.modules[name]
