"""What a command has answered: its document, or the lines of its refusal."""

import json
import subprocess
from typing import Any

import pytest


def document_of(process: subprocess.CompletedProcess[str]) -> Any:
    """The document of a command that was asked for JSON, in which no number is NaN or infinite."""
    assert process.returncode == 0, process.stderr
    return json.loads(process.stdout, parse_constant=lambda constant: pytest.fail(f"{constant} in JSON"))


def refused(process: subprocess.CompletedProcess[str], *expected: str) -> None:
    """Fail unless a command was refused with exit code 2, in as many lines, and each of them has its words."""
    assert (process.returncode, process.stdout) == (2, ""), process.stderr
    assert "Traceback" not in process.stderr
    lines = process.stderr.strip().splitlines()
    assert len(lines) == len(expected), process.stderr
    for line, text in zip(lines, expected, strict=True):
        assert text in line
