"""Response models of the API for a condition over time."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.condition.answer import ConditionResults
from ballscrew.questions.shared.answer_parts import Closed, Number, Tables
from ballscrew.questions.shared.declared import response


class ConditionPicture(Closed):
    """What is drawn besides the states."""

    trend: list[Number] | None = Field(description="preload by the trend at each test; null where there is none")


class Beside(Closed):
    """What stands beside the results."""

    provenance: Tables
    picture: ConditionPicture


Condition: Any = response(ConditionResults, "Condition", beside=Beside)
