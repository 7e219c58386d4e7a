"""Response models of the API for a band."""

from __future__ import annotations

from ballscrew.questions.band.answer import BandResults
from ballscrew.questions.run.response import Document
from ballscrew.questions.shared.answer_parts import Closed
from ballscrew.questions.shared.declared import with_answers


class BandWords(Closed):
    """Sentences beside the numbers of a band."""

    sentences: list[str]
    inputs: str


class Band(Document, with_answers(band=BandResults)):
    """The answer of a run with the band beside it."""

    words: BandWords
