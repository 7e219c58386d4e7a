"""Limits of the DN value by make and by how the balls return, as makers print them (``data/speed_limits.toml``)."""

from __future__ import annotations

import functools
import math
import tomllib
from collections.abc import Sequence
from importlib import resources
from typing import NamedTuple

from ballscrew.basis.quantities import DiameterSpeed
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.sources import Source

#: One millimetre times one turn a minute, in m rad/s.
MM_RPM = 1e-3 * math.tau / 60


class SpeedLimit(NamedTuple):
    """The largest DN value, and whose limit it is: words that follow on "limit", and keys in the bibliography."""

    value: DiameterSpeed
    words: str
    sources: tuple[str, ...] = ()
    #: Of the limit for this very nut: an estimate where another nut's stands for it.
    source: Source = "read"


class PrintedLimit(NamedTuple):
    """A limit as a maker prints it; an empty make stands for all, an empty recirculation for standard nuts."""

    make: str
    recirculation: str
    value: DiameterSpeed
    #: The diameter that the maker multiplies by: "pitch circle" or "nominal".
    diameter: str
    #: The key in the bibliography.
    source: str


#: That of standard nuts of THK514E and HIWIN2016, where that of a make is not known. Nuts that are made for speed stand
#: more: up to 140000 mm · rpm by Thomson's list, over 160000 by NSK's.
GENERAL = SpeedLimit(
    70000 * MM_RPM,
    "of standard nuts in general (THK514E, HIWIN2016): that of this make is not known, it may be more",
    ("THK514E", "HIWIN2016"),
    source="estimate",
)


def speed_limit_of(row: CatalogueRow | None) -> SpeedLimit | None:
    """The limit of a row: its own, that of its make and recirculation, or that of standard nuts of the make.

    None where nothing is known of the make.
    """
    if row is None:
        return None
    if row.speed_limit is not None:
        listed = f"that the row lists ({row.source})"
        return SpeedLimit(row.speed_limit, listed if row.source else "that the row lists")
    return printed_limit(row.make, row.recirculation)


def printed_limit(make: str, recirculation: str = "") -> SpeedLimit | None:
    """The limit that is printed for a make and a recirculation; that of the standard nuts of the make else."""
    wanted, kind = make.casefold(), recirculation.casefold()
    listed = {(one.make.casefold(), one.recirculation.casefold()): one for one in printed_limits()}
    result = (listed.get((wanted, kind)) or listed.get(("", kind))) if kind else None
    if result is not None:
        makes = result.make or "all makes"
        words = f"of {makes} for this recirculation, {result.recirculation} ({result.source})"
        return SpeedLimit(result.value, words, (result.source,))
    standard = listed.get((wanted, "")) if wanted else None
    if standard is None:
        return None
    words = f"of standard nuts of {standard.make} ({standard.source})"
    if kind:
        words += f": what its {recirculation} recirculation stands could not be read, it may be more"
    return SpeedLimit(standard.value, words, (standard.source,), "estimate" if kind else "read")


@functools.cache
def printed_limits() -> Sequence[PrintedLimit]:
    """All limits that could be read."""
    text = resources.files("ballscrew").joinpath("data/speed_limits.toml").read_text(encoding="utf-8")
    return tuple(
        PrintedLimit(
            table.get("make", ""),
            table.get("recirculation", ""),
            table["value"] * MM_RPM,
            table["diameter"],
            table["source"],
        )
        for table in tomllib.loads(text)["limit"]
    )
