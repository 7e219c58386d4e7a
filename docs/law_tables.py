"""Tables of laws: the laws of each slot, and the law of each named model."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

from ballscrew.basis.quantities import fields_of
from ballscrew.basis.units import shown
from ballscrew.cases.schema.case_schema import MODELS, coefficients_of, name_of_law
from ballscrew.physics.friction.model import LAWS
from ballscrew.questions.shared.text_tables import markdown_table

#: Purpose of each slot.
SLOTS = {
    "frame": "geometry of the ball path",
    "hertz": "contact ellipse",
    "film": "film thickness",
    "film_parameter": "film over roughness",
    "inlet": "heat and oil supply of the inlet",
    "friction": "friction coefficient of a contact",
    "full_film": "friction of the full film",
    "rolling": "hydrodynamic rolling force",
    "elastic_resistance": "elastic resistance to rolling",
    "slip": "slip of the contacts",
    "ball_chain": "friction between neighbouring balls",
    "ball_force": "ball-to-ball force",
    "race_torques": "torques from contact forces and moments",
    "ideal_torque": "torque without friction",
}
_NAMED = ("olaru2005", "corrected", "reference")


def slots_table() -> str:
    """Laws of each named model by slot, with the names of the case file."""
    lines: list[list[str]] = []
    for slot in LAWS:
        names = [_in_slot(slot, getattr(MODELS[name], slot)) for name in _NAMED]
        # bold where it differs from the model before
        marked = [n if i == 0 or n == names[i - 1] else f"**{n}**" for i, n in enumerate(names)]
        lines.append([f"`{slot}`", SLOTS[slot], *marked])
    return markdown_table(("slot", "purpose", *(f"`{name}`" for name in _NAMED)), lines)


def _in_slot(slot: str, law: Any) -> str:
    name = name_of_law(slot, law)
    if not dataclasses.is_dataclass(law):
        return name
    defaults = type(law)()
    changed = [
        f"{field} {shown(getattr(law, field), quantity)}"
        for field, quantity in fields_of(law).items()
        if getattr(law, field) != getattr(defaults, field)
    ]
    return f"{name} ({', '.join(changed)})" if changed else name


def laws_table() -> str:
    """Every law by slot and name, with the first sentence of its docstring and its coefficients."""
    lines: list[list[str]] = []
    for slot, known in LAWS.items():
        for name, law in known.items():
            lines.append([f"`{slot}`", f"`{name}`", _says(law), ", ".join(_coefficients(slot, name, law))])
    return markdown_table(("slot", "name", "description", "coefficients and their defaults"), lines)


def _says(law: Any) -> str:
    if law is None:
        return "a constant, the full-film coefficient of the friction law"
    first = (law.__doc__ or "").partition("\n\n")[0]
    return " ".join(first.split())


def _coefficients(slot: str, name: str, law: Any) -> Iterator[str]:
    defaults = {field.name: field.default for field in dataclasses.fields(law)} if isinstance(law, type) else {}
    for field, quantity in coefficients_of(slot, name).items():
        yield f"`{field}` {shown(defaults[field], quantity)}"
