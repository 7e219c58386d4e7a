"""Kinds of sources of formulas and limits: read, recalled or estimated, and the words for them beside a verdict."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ballscrew.basis.records import Message

#: "read" in its source, or derived; "recalled", as its source was not read; "estimate", where no source has it.
Source = Literal["read", "recalled", "estimate"]

#: What stands beside a verdict; nothing where the source was read.
QUALIFICATIONS: Mapping[Source, Message | None] = {
    "read": None,
    "recalled": Message("by formulas as recalled"),
    "estimate": Message("by an estimate"),
}
