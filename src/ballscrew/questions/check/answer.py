"""Response models of the API for the checks of a screw."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.check.compute import BothRatings, Geometry
from ballscrew.questions.run.answer import RunResults
from ballscrew.questions.run.nut_loads import NutLoads
from ballscrew.questions.run.response import VENDOR_ROWS
from ballscrew.questions.shared.answer_parts import JudgedCheck
from ballscrew.questions.shared.declared import response, with_answers


class OneCheck(JudgedCheck):
    """A check with its text for people."""

    passes: bool | None = Field(description="as ``holds``")
    words: str = Field(description="as ``text``")


class Beside(with_answers(geometry=Geometry, loads=NutLoads, vendor_rows=VENDOR_ROWS, ratings=BothRatings)):
    """What the checks of a case have beside its results."""

    checks: list[OneCheck]
    judged: int = Field(description="number of the checks that were judged; the others lack an input")
    holds: bool = Field(description="true where all checks were judged and hold")
    verdict: str
    nut: str = Field(description="kind of the nut; a case without one is checked with a single nut")
    assumed: list[str]


class Checks(response(RunResults, "Checks", beside=Beside)):
    """The checks of a case, with its results."""
