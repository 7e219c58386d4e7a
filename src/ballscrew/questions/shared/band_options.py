"""Options of bands, which several questions have."""

from __future__ import annotations

from typing import Annotated

from ballscrew.questions.shared.options import Option

Level = Annotated[
    float | None, Option("With --band: share of the samples in the band; 0.95 if left out.", metavar="SHARE")
]
OnlyGiven = Annotated[bool, Option("With --band: only the uncertain inputs that the case file gives.")]


def number_of_samples(meaning: str) -> Option:
    """How many samples a band has; a meaning says of what, and how many there are if it is left out."""
    return Option(f"With --band: {meaning}.", metavar="N")
