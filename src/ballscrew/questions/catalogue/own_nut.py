"""A nut of one's own: its JSON document, and its text on the terminal."""

from __future__ import annotations

from typing import Any

import tomlkit

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned
from ballscrew.basis.records import documents
from ballscrew.basis.version import __version__
from ballscrew.cases.screw_tables.catalogue import case_text
from ballscrew.physics.sizing.own_nut import Estimate, OwnNut

_COLUMNS = ("estimated", "value", "from", "to", "where it is from")


def document(own_nut: OwnNut) -> dict[str, Any]:
    """The nut as the tables of a case, what was estimated with its band in SI, and what does not go together."""
    return {
        "name": own_nut.row.name,
        "case": tomlkit.parse(case_text(own_nut.row, own_nut.estimates)).unwrap(),
        "estimates": [_estimate(one) for one in own_nut.estimates],
        "warnings": documents(own_nut.warnings),
        "provenance": {"version": __version__},
    }


def _estimate(one: Estimate) -> dict[str, Any]:
    return {
        "name": one.name,
        "value": one.value,
        "low": one.low,
        "high": one.high,
        "unit": one.quantity.unit,
        "shown_in": one.quantity.shown_in,
        "source": one.source,
    }


def text(own_nut: OwnNut) -> str:
    """What was estimated, one line each, and what does not go together."""
    rows = [
        (
            one.name.replace("_", " "),
            *(units.shown(value, one.quantity, digits=4) for value in _values(one)),
            one.source,
        )
        for one in own_nut.estimates
    ]
    lines = aligned([_COLUMNS, *rows], (0, len(_COLUMNS) - 1))
    return "\n".join([*lines, *(f"warning: {line}" for line in warnings(own_nut))])


def warnings(own_nut: OwnNut) -> list[str]:
    """What does not go together, in words."""
    return [one.text for one in own_nut.warnings]


def _values(one: Estimate) -> tuple[float, float, float]:
    return one.value, one.low, one.high
