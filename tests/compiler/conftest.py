"""Kernels for tests: compiled in a folder of their own, never in the user's."""

import pytest


@pytest.fixture(autouse=True)
def own_cache(tmp_path, monkeypatch, as_shipped):
    """Kernels of a test are kept where only the test sees them, and are those that users have."""
    monkeypatch.setenv("BALLSCREW_CACHE", str(tmp_path / "cache"))
