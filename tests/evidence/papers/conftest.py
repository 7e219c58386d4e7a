"""Lends the tests the script that makes the table of equations."""

import functools
import importlib.util
from pathlib import Path
from types import ModuleType

import pytest

SCRIPT = Path(__file__).resolve().parents[3] / "docs" / "equation_table.py"


@pytest.fixture(scope="session")
def equation_table() -> ModuleType:
    """The script, as a module that reads all files once."""
    spec = importlib.util.spec_from_file_location("equation_table", SCRIPT)
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    # each parses every file of the package or of the tests
    module.functions, module.tests = functools.cache(module.functions), functools.cache(module.tests)
    return module
