"""Options of bands, which several questions have."""

from __future__ import annotations

from typing import Annotated

from ballscrew.questions.shared.options import Option

Level = Annotated[float | None, Option("With --band: share in the band, 0.95.", metavar="SHARE")]
OnlyGiven = Annotated[bool, Option("With --band: only what the file says is uncertain.")]


def number_of_samples(meaning: str) -> Option:
    """How many samples a band has; a meaning says of what, and how many there are if it is left out."""
    return Option(f"With --band: {meaning}.", metavar="N")
