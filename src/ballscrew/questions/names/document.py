"""``ballscrew list --json``: names as a document."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.questions.names.compute import Name


def document(kind: str, found: Sequence[Name]) -> dict[str, Any]:
    """The names of a kind, with their groups, SI units and meanings."""
    return {"results": {kind: [one._asdict() for one in found]}, "warnings": []}
