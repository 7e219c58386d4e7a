"""Texts for people whose quantities can be shown in any unit: a template, and the quantities that it names."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.basis.units import ShownQuantity

_PLACEHOLDER = re.compile(r"\{(\d{1,4})_*\}")


def filled(text: str, quantities: Sequence[ShownQuantity]) -> str:
    """The text as the command line prints it."""

    def shown(match: re.Match[str]) -> str:
        place = int(match[1])
        return quantities[place].text if place < len(quantities) else match[0]

    return _PLACEHOLDER.sub(shown, text)


def template(text: str, quantities: Sequence[ShownQuantity]) -> dict[str, Any]:
    """The text with the quantities that it names, numbered from zero."""
    own: list[ShownQuantity] = []

    def renumbered(match: re.Match[str]) -> str:
        place = int(match[1])
        if place >= len(quantities):
            return match[0]
        own.append(quantities[place])
        return f"{{{len(own) - 1}}}"

    found = _PLACEHOLDER.sub(renumbered, text)
    return {"text": found, "quantities": [_document(one) for one in own]}


def fill_records(document: Mapping[str, Any], quantities: Sequence[ShownQuantity]) -> None:
    """Fill the texts of all verdicts, checks and warnings of a document."""
    for kind in ("verdicts", "checks", "warnings"):
        for record in document[kind]:
            record["text"] = filled(record["text"], quantities)


def _document(one: ShownQuantity) -> dict[str, Any]:
    return {
        "value": one.value,
        "unit": one.quantity.unit,
        "shown_in": one.quantity.shown_in,
        "digits": one.digits,
        "toward": one.toward,
    }
