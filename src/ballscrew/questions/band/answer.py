"""Response models of the API for a band."""

from __future__ import annotations

from pydantic import Field

from ballscrew.engine.uncertainty.band_evaluation import BAND_OUTPUTS
from ballscrew.engine.uncertainty.bands import Interval as TwoEnds
from ballscrew.engine.uncertainty.bands import OutputBand
from ballscrew.questions.run.answer import Document
from ballscrew.questions.shared.answer_parts import (
    Closed,
    Number,
    Numbers,
    Template,
    field,
    with_fields,
)


class Interval(with_fields(**dict.fromkeys(TwoEnds._fields, (Number, ...)))):
    """Two ends with a share of the samples between them."""


_INTERVALS = [name for name, kind in OutputBand.__annotations__.items() if kind == TwoEnds.__name__]
#: The interval by both causes stands beside the value, the others under their names.
_NUMBERS = {name: (Number, ...) for name in OutputBand.__annotations__ if name not in _INTERVALS}
_OTHERS = {name: (Interval, ...) for name in _INTERVALS if name != "both"}


class BandedOutput(with_fields(Interval, **_NUMBERS, **_OTHERS)):
    """One output and its intervals."""


class UncertainInput(Closed):
    """Distribution of an input, and where it comes from."""

    distribution: str
    source: str
    reason: str = field(optional=True)


class AlternativeLaw(Closed):
    """A law that could stand in place of the model's."""

    name: str
    factor: Number = Field(description="torque with it over torque with the model's own law")


class BandTables(with_fields(**dict.fromkeys(BAND_OUTPUTS, (BandedOutput, ...)))):
    """Intervals of all outputs, and what they come from."""

    level: float
    samples: int
    seed: int
    self_locking_share: Number
    invalid_share: Number
    reasons: Numbers
    laws: dict[str, list[AlternativeLaw]]
    inputs: dict[str, UncertainInput]


class BandWords(Closed):
    """Sentences beside the numbers of a band."""

    sentences: list[str]
    inputs: str


class BandDisplay(Closed):
    """The same sentences, with their quantities apart."""

    sentences: list[Template]


class Band(Document):
    """The answer of a run with the band beside it."""

    band: BandTables
    words: BandWords
    display: BandDisplay
