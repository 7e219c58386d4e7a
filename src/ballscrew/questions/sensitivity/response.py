"""Response models of the API for a sensitivity analysis."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.sensitivity.answer import Indices
from ballscrew.questions.shared.answer_parts import Closed, Number
from ballscrew.questions.shared.declared import response


class ShownInput(Closed):
    """An uncertain input for people: what it is, its field, and its interval."""

    name: str
    path: str = Field(description="section.field")
    meaning: str
    unit: str = Field(description="SI")
    shown_in: str
    low: Number = Field(description="2.5 % quantile, SI")
    median: Number = Field(description="SI")
    high: Number = Field(description="97.5 % quantile, SI")


class SensitivityDisplay(Closed):
    """What stands beside the indices for people."""

    meaning: str = Field(description="of the output")
    unit: str = Field(description="of the output, SI")
    shown_in: str
    inputs: list[ShownInput] = Field(description="in the order of the indices")


class Beside(Closed):
    """What stands beside the indices."""

    units: dict[str, Any] = Field(description="SI units of the output and of the inputs")
    display: SensitivityDisplay


Sensitivity: Any = response(Indices, "Sensitivity", named="sensitivity", beside=Beside)
