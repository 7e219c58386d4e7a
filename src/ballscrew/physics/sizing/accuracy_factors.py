"""Factors for accuracy of the rigidity of a nut, by make, with the kind of their source."""

from __future__ import annotations

import functools
import tomllib
from importlib import resources
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import Ratio
from ballscrew.physics.sizing.sources import QUALIFICATIONS, Source


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
