"""The fields of a case file as a table, from the annotations of the parts."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

from ballscrew.components.materials import Lubricant, Material, grades
from ballscrew.components.screw import BallScrew, Operation
from ballscrew.interfaces import units
from ballscrew.model import FrictionModel
from ballscrew.quantities import Quantity, fields_of

PARTS = {
    "[screw]": BallScrew,
    "[screw.ball_material] and so on": Material,
    "[lubricant]": Lubricant,
    "[operation]": Operation,
    "[model]": FrictionModel,
}


def field_table() -> str:
    """One table for each table of the file."""
    return "\n".join(line for title, cls in PARTS.items() for line in _lines(title, cls)) + (
        f"\nInstead of `viscosity`, `grade` ({', '.join(grades())}; `VG68` is `ISO VG 68`) and `temperature`"
        " (-20 to 150 degC, 40 degC if left out).\n"
    )


def _lines(title: str, cls: type) -> Iterator[str]:
    yield f"\n`{title}`\n"
    yield "| field | symbol | example | needed | bounds | meaning |"
    yield "|---|---|---|---|---|---|"
    defaults = {field.name: field.default for field in dataclasses.fields(cls)}
    for name, quantity in fields_of(cls).items():
        default = defaults[name]
        needed = "yes" if default is dataclasses.MISSING else f"no: {_shown(default, quantity)}"
        example = "56" if quantity.info.whole else "0.5" if quantity.unit == "1" else f'"1 {quantity.shown_in}"'
        bounds, meaning = _bounds(quantity), quantity.info.meaning
        yield f"| `{name}` | ${quantity.info.symbol}$ | `{example}` | {needed} | {bounds} | {meaning} |"


def _shown(default: object, quantity: Quantity) -> str:
    return "see its meaning" if default is None else units.shown(default, quantity)


def _bounds(quantity: Quantity) -> str:
    info = quantity.info
    words = {"above": info.above, "at least": info.at_least, "below": info.below, "at most": info.at_most}
    said = [f"{word} {units.shown(bound, quantity)}" for word, bound in words.items() if bound is not None]
    return ", ".join([*said, *(["whole"] if info.whole else [])])
