"""Response models of the API for what stands beside the results of a ripple."""

from __future__ import annotations

from ballscrew.questions.shared.answer_parts import Assumed, Closed, Message


class RippleDisplay(Closed):
    """What is assumed, as messages."""

    assumed: list[Message]


class BesideRipple(Assumed):
    """What is assumed, in words and as messages."""

    display: RippleDisplay
