"""``ballscrew card check --json``: the documents of torque cards; all in SI."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.cases.torque_cards.torque_card import TorqueCard, TorquePoint
from ballscrew.questions.card import compute as torque_cards


def documents(cards: Sequence[TorqueCard]) -> list[dict[str, Any]]:
    """A document for each card."""
    return [
        {
            "name": card.name,
            "synthetic": card.synthetic,
            **torque_cards.document(card),
            "points": [{name: getattr(point, name) for name in fields_of(TorquePoint)} for point in card.points],
        }
        for card in cards
    ]
