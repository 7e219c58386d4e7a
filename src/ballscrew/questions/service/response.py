"""Response models of the API for a service."""

from __future__ import annotations

from typing import Any

from ballscrew.questions.service.answer import ServiceResults
from ballscrew.questions.shared.answer_parts import Closed, Tables
from ballscrew.questions.shared.declared import response


class ServiceWords(Closed):
    """What a service says beside its verdicts."""

    title: str
    causes: list[str]


class Beside(Closed):
    """What stands beside the results."""

    provenance: Tables
    words: ServiceWords
    picture: Tables


Service: Any = response(ServiceResults, "Service", beside=Beside)
