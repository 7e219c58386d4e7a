"""Response models of the API for a service."""

from __future__ import annotations

from ballscrew.questions.service.answer import ServiceResults
from ballscrew.questions.shared.answer_parts import Record, Shown, Tables
from ballscrew.questions.shared.declared import with_answers


class Service(with_answers(results=ServiceResults), Shown):
    """The preload that is left in a nut."""

    inputs: Tables
    units: Tables
    warnings: list[Record]
    verdicts: list[Record]
    checks: list[Record]
    provenance: Tables
