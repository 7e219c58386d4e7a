"""Response models of the API for a service."""

from __future__ import annotations

from ballscrew.questions.service.answer import ServiceResults
from ballscrew.questions.shared.answer_parts import Closed, Record, Tables
from ballscrew.questions.shared.declared import with_answers


class ServiceWords(Closed):
    """What a service says beside its verdicts."""

    title: str
    causes: list[str]


class Service(with_answers(results=ServiceResults)):
    """The preload that is left in a nut."""

    inputs: Tables
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
    words: ServiceWords
    picture: Tables
