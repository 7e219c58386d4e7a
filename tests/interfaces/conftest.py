"""Real commands on real files."""

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

    def command(*arguments: str, cwd: Path = tmp_path) -> subprocess.CompletedProcess[str]:
        program = [sys.executable, "-m", "ballscrew.interfaces.cli", *map(str, arguments)]
        return subprocess.run(program, capture_output=True, text=True, cwd=cwd, check=False, encoding="utf-8")

    return command
