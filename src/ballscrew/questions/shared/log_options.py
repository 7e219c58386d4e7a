"""Options of logs, which several questions have."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Annotated, Literal

from ballscrew.questions.shared.options import Option


def headings(meaning: str) -> Option:
    """Columns of a log by their headings, with an example of them in its meaning."""
    example = 'torque="M_ist [N m]"'
    return Option(meaning, metavar="NAME=HEADING", flag="column", noun="heading", example=example)


Columns = Annotated[Mapping[str, str], headings('Heading of a column: torque="M_ist [N m]".')]
TorqueKind = Annotated[
    Literal["friction", "drive", "unknown"],
    Option(
        "Kind of the torque: friction or drive; if left out, found by comparison with the model.",
        metavar="KIND",
        noun="kind of torque",
    ),
]
TorqueConstant = Annotated[
    float | None,
    Option('Torque for each ampere of a motor current: "0.5 N m/A".', metavar="VALUE", unit="N m/A", above=0),
]
Inertia = Annotated[
    float | None,
    Option(
        'Inertia that the torque accelerates, at the screw: "2e-3 kg m^2".', metavar="VALUE", unit="kg m^2", above=0
    ),
]
KeepGoing = Annotated[bool, Option("Leave faulty rows out, and say how many.")]


Level = Annotated[
    float | None, Option("With --band: share of the samples in the band; 0.95 if left out.", metavar="SHARE")
]
OnlyGiven = Annotated[bool, Option("With --band: only the uncertain inputs that the case file gives.")]


def number_of_samples(meaning: str) -> Option:
    """How many samples a band has; a meaning says of what, and how many there are if it is left out."""
    return Option(f"With --band: {meaning}.", metavar="N")
