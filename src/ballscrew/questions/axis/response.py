"""Response models of the API for what stands beside the results of the chain of an axis."""

from __future__ import annotations

from ballscrew.questions.shared.answer_parts import Assumed, Closed, Message


class ChainDisplay(Closed):
    """What is assumed, as messages."""

    assumed: list[Message]


class BesideChain(Assumed):
    """What is assumed, in words and as messages."""

    display: ChainDisplay
