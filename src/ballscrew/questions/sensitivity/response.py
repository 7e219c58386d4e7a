"""Response models of the API for a sensitivity analysis."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.engine.uncertainty.sensitivity import METHODS
from ballscrew.questions.shared.answer_parts import Closed, Number, Provenance, Record, Shown, Tables, field


class Estimated(Closed):
    """A number with its interval; both ends are the number itself where it is exact."""

    value: Number
    low: Number
    high: Number


class SensitiveInput(Closed):
    """An uncertain input, and what the method says of it: the measures of that method, and no others."""

    name: str = Field(description="as in sweeps")
    distribution: Tables = Field(description="its kind and its parameters, SI")
    given: bool = Field(description="whether the case gives it; otherwise it is taken as usual")
    source: str = Field(description="given, judgement, a key of the bibliography, or a calibration")
    total: Estimated | None = field("sobol: share of the variance in which it has a part", optional=True)
    first_order: Estimated | None = field("sobol: share of the variance that it has by itself", optional=True)
    effect: Estimated | None = field("change of the output by one standard deviation of the input", optional=True)
    effect_deviation: Estimated | None = field("morris: standard deviation of these changes", optional=True)
    share: Estimated | None = field("local: share of the variance, were the slopes the same", optional=True)
    left_if_known: Number = Field(description="share of the standard deviation that is left if it is known")


class IfKnown(Closed):
    """Some inputs, and the share of the standard deviation that is left if they are known."""

    inputs: list[str]
    left: Number


class Indices(Closed):
    """The inputs of an output, the one that matters most first."""

    output: str
    method: str = Field(json_schema_extra={"enum": list(METHODS)})
    mean: Number = Field(description="over all samples; with local the value at the medians of the inputs; SI")
    standard_deviation: Number = Field(description="SI; null with morris")
    inputs: list[SensitiveInput]
    knowing: list[IfKnown] = Field(description="the largest inputs, one more each time")
    to_halve: IfKnown | None = Field(
        description="the inputs to find out so that half is left; null where there are none"
    )
    level: float = Field(description="of the intervals")
    samples: int
    left_out: int = Field(description="samples without a number")
    evaluations: int
    seed: int


class Sensitivity(Shown):
    """What the band of a result comes from, and what to find out to halve it."""

    inputs: Tables
    sensitivity: Indices
    units: dict[str, Any] = Field(description="SI units of the output and of the inputs")
    verdicts: list[Record]
    checks: list[Record]
    warnings: list[Record]
    provenance: Provenance
