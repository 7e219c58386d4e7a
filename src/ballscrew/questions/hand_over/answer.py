"""Response models of the API for targets of a hand-over and the files of one."""

from __future__ import annotations

from typing import Any

from pydantic import Field

from ballscrew.questions.hand_over.document import HandOverResults
from ballscrew.questions.shared.answer_parts import Closed, Tables
from ballscrew.questions.shared.declared import response


class Choice(Closed):
    """A choice that a target has."""

    name: str
    default: str
    meaning: str


class Target(Closed):
    """A target of a hand-over."""

    name: str
    meaning: str
    options: list[Choice]


class Targets(Closed):
    """The targets of a hand-over."""

    targets: list[Target]


class SentContent(Closed):
    """A file of a hand-over, or a zip archive of several."""

    name: str
    media_type: str
    base64: str


class HandOverWords(Closed):
    """What a hand-over says: ranges, worst errors, warnings."""

    lines: list[str]
    ranges: list[str] = Field(description="ranges and worst errors alone")


class Beside(Closed):
    """What stands beside the results of a hand-over."""

    provenance: Tables
    words: HandOverWords
    file: SentContent


HandOver: Any = response(HandOverResults, "HandOver", beside=Beside)
