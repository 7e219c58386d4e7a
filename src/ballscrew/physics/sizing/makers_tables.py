"""Tables by make, with the kinds of their sources: read, recalled or estimated, and the words for these in a verdict.

Factors for accuracy of the rigidity of a nut; and limits of the DN value by how the balls return, as makers print them
(``data/speed_limits.toml``).
"""

from __future__ import annotations

import functools
import math
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any, Literal, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import DiameterSpeed, Ratio
from ballscrew.physics.sizing.catalogue import CatalogueRow

#: "read" in its source, or derived; "recalled", as its source was not read; "estimate", where no source has it.
Source = Literal["read", "recalled", "estimate"]

#: What stands beside a verdict; nothing where the source was read.
QUALIFICATIONS: Mapping[Source, str | None] = {
    "read": None,
    "recalled": "by formulas as recalled",
    "estimate": "by an estimate",
}


class FactorsOfStandard(NamedTuple):
    """The factors that ISO 3408-4 has by grade: greatest and least."""

    greatest: Ratio
    least: Ratio
    source: Source
    #: The key in the bibliography.
    reference: str


class FactorOfMake(NamedTuple):
    """The factor of the rigidities that a maker prints for double nuts."""

    make: str
    value: Ratio
    source: Source
    #: The key in the bibliography.
    reference: str

    @property
    def words(self) -> str:
        """Whose factor it is, with the kind of its source where it was not read."""
        said = (
            f"factor for accuracy {units.number(self.value, 3)}, of {self.make}'s printed rigidities of double "
            f"nuts ({self.reference})"
        )
        qualified = QUALIFICATIONS[self.source]
        if qualified is not None:
            said = f"{said}: {qualified}"
        return said


def factors_of_standard() -> FactorsOfStandard:
    """The factors by grade."""
    table = _tables()["standard"]
    return FactorsOfStandard(table["greatest"], table["least"], table["kind"], table["source"])


def factors_of_makes() -> tuple[FactorOfMake, ...]:
    """The factors of all makes that are known."""
    return tuple(
        FactorOfMake(table["make"], table["value"], table["kind"], table["source"]) for table in _tables()["factor"]
    )


def factor_of_make(make: str) -> FactorOfMake | None:
    """The factor of a make; None where it is not known."""
    return next((one for one in factors_of_makes() if one.make.casefold() == make.casefold()), None)


@functools.cache
def _tables() -> dict[str, Any]:
    text = resources.files("ballscrew").joinpath("data/accuracy_factors.toml").read_text(encoding="utf-8")
    return tomllib.loads(text)


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
