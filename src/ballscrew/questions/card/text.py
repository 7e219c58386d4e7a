"""``ballscrew card check``: cards as text, a block for each."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import wrapped
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import descriptions
from ballscrew.cases.torque_cards.torque_card import TorqueCard, TorquePoint

_KNOWN = fields_of(TorquePoint)


def text_of(cards: Sequence[TorqueCard]) -> str:
    """What the cards hold, and what they do not state."""
    return "\n\n".join(_block(card) for card in cards)


def _block(card: TorqueCard) -> str:
    speeds, torques = [point.screw_speed for point in card.points], [point.torque for point in card.points]
    lines = [
        f"{card.name}: {card.title}",
        f"  {card.about['who']}, {card.about['when'].isoformat()}, {card.about['licence']}",
        f"  {descriptions.design(card.case, plain_text=True)}",
        f"  {len(card.points)} points, {_range(speeds, 'screw_speed')}, {_range(torques, 'torque_forward')}",
        *(f"  beware: {note}" for note in card.notes),
    ]
    return "\n".join(map(wrapped, lines))


def _range(values: Sequence[float], name: str) -> str:
    ends = [units.shown(float(end), _KNOWN[name]) for end in (min(values), max(values))]
    return " to ".join(ends)
