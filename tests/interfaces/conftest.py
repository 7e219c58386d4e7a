"""Real commands on real files."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture
def example() -> Path:
    return ROOT / "examples" / "olaru2005.toml"


@pytest.fixture
def ballscrew(tmp_path):
    """Run the command line in a process of its own, in an empty folder."""

    def command(*arguments: str, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess[str]:
        program = [sys.executable, "-m", "ballscrew.interfaces.cli", *map(str, arguments)]
        return subprocess.run(
            program,
            capture_output=True,
            check=False,
            cwd=tmp_path,
            encoding=(environment or {}).get("PYTHONIOENCODING", "utf-8"),
            errors="replace",
            env={**os.environ, **(environment or {})},
        )

    return command
