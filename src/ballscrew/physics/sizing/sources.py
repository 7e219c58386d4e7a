"""Kinds of sources of formulas and limits: read, recalled or estimated, and the words for them beside a verdict."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

#: "read" in its source, or derived; "recalled", as its source was not read; "estimate", where no source has it.
Source = Literal["read", "recalled", "estimate"]

#: What stands beside a verdict; nothing where the source was read.
QUALIFICATIONS: Mapping[Source, str | None] = {
    "read": None,
    "recalled": "by formulas as recalled",
    "estimate": "by an estimate",
}
