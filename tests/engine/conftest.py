"""Kernels for tests: compiled in a folder of their own, never in the user's."""

import importlib.util
import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch):
    """Kernels of a test are kept where only the test sees them."""
    monkeypatch.setenv("BALLSCREW_CACHE", str(tmp_path / "cache"))


def pytest_collection_modifyitems(items):
    """Without the compiler, its tests say so."""
    if importlib.util.find_spec("llvmlite") is None:
        for item in items:
            if "compiles" in item.keywords:
                item.add_marker(pytest.mark.skip(reason="llvmlite is not installed (the extra fast)"))
