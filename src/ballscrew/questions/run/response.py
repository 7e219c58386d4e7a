"""Response models of the API for a run, made from the annotations of the parts that it consists of.

They describe the answers in the OpenAPI document. They are not run on each answer: the endpoints return finished
responses, and the tests validate answers against the description.
"""

from __future__ import annotations

from typing import Any

from ballscrew.questions.run.answer import RunResults, VendorRows
from ballscrew.questions.run.compute import NutLoads
from ballscrew.questions.shared.answer_parts import Closed, field
from ballscrew.questions.shared.declared import response, with_answers

LOADS = (NutLoads, field("loads of the balls of a nut, SI", optional=True))
VENDOR_ROWS = (VendorRows, field("model over vendor for the rows most like the nut, without load", optional=True))


class RunWords(Closed):
    """Sentences beside the numbers, as the command line prints them."""

    title: str
    verdicts: list[str]
    assumed: list[str]
    rigidity: list[str] = field("what the axial rigidity rests on")
    rules: list[str] = field("the torque without load beside the rules of makers; none of a nut without preload")


Document: Any = response(RunResults, "Document", beside=with_answers(loads=LOADS, vendor_rows=VENDOR_ROWS))


class Run(Document):
    """Friction at one operating point."""

    words: RunWords
