"""The laws of a model as tables: what each slot can hold, and what each named model has there."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from typing import Any

from ballscrew.interfaces.schema import LAWS, MODELS, coefficients_of, name_of_law
from ballscrew.interfaces.units import shown
from ballscrew.quantities import fields_of

#: What each slot decides.
SLOTS = {
    "frame": "where the balls roll",
    "hertz": "contact ellipse",
    "film": "film thickness",
    "film_parameter": "film over roughness",
    "inlet": "heat and oil supply of the inlet",
    "friction": "friction coefficient of a contact",
    "full_film": "friction of the film alone",
    "rolling": "hydrodynamic rolling force",
    "elastic_resistance": "elastic resistance to rolling",
    "slip": "how the contacts slip",
    "ball_chain": "what the neighbouring balls do",
    "ball_force": "force between balls",
    "race_torques": "from forces to torques",
    "ideal_torque": "torque without friction",
}
_NAMED = ("olaru2005", "corrected", "reference")


def slots_table() -> str:
    """What each named model has in each slot, by the names of the case file."""
    lines = [["slot", "what it decides", *(f"`{name}`" for name in _NAMED)], ["---"] * (len(_NAMED) + 2)]
    for slot in LAWS:
        names = [_in_slot(slot, getattr(MODELS[name], slot)) for name in _NAMED]
        # bold where it is not what the model before has
        marked = [n if i == 0 or n == names[i - 1] else f"**{n}**" for i, n in enumerate(names)]
        lines.append([f"`{slot}`", SLOTS[slot], *marked])
    return _table(lines)


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
    """Every law by slot and name, with what its docstring says first and its coefficients."""
    lines = [["slot", "name", "what it is", "coefficients and their defaults"], ["---"] * 4]
    for slot, known in LAWS.items():
        for name, law in known.items():
            lines.append([f"`{slot}`", f"`{name}`", _says(law), ", ".join(_coefficients(slot, name, law))])
    return _table(lines)


def _says(law: Any) -> str:
    if law is None:
        return "a constant, the full-film coefficient of the friction law"
    first = (law.__doc__ or "").partition("\n\n")[0]
    return " ".join(first.split()).replace("|", r"\|")


def _coefficients(slot: str, name: str, law: Any) -> Iterator[str]:
    defaults = {field.name: field.default for field in dataclasses.fields(law)} if isinstance(law, type) else {}
    for field, quantity in coefficients_of(slot, name).items():
        yield f"`{field}` {shown(defaults[field], quantity)}"


def _table(lines: list[list[str]]) -> str:
    return "".join("| " + " | ".join(line) + " |\n" for line in lines)
