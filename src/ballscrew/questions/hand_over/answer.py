"""Response models of the API for targets of a hand-over and the files of one."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, Record, Tables


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


class HandOver(Closed):
    """A model handed over: its files, their range and their worst error."""

    inputs: Tables
    results: Tables
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
    words: HandOverWords
    file: SentContent
