"""Plausibility: inputs that are possible, and that no ball screw has.

Bounds that cannot be exceeded and usual ranges stand in the one annotation of a quantity
(:class:`~ballscrew.quantities.Info`). The first are refused; outside the second, values are computed, and named in a
warning.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.components.screw import MATERIALS, BallScrew
from ballscrew.errors import shown
from ballscrew.quantities import Quantity, quantities_of
from ballscrew.records import Record

#: The id of the warning, whose last part is its name.
IMPLAUSIBLE = "inputs.implausible"
_TEXT = "{meaning} {0} lies outside the usual {1} to {2}: check the number and its unit"


def named_parts(model: Any, screw: BallScrew, lubricant: Any, **others: Any) -> dict[str, Any]:
    """The parts of a configuration by the section that their fields have in a case file.

    Those of the nut are among them. ``others`` are further parts by section; None stands for one that there is not.
    """
    materials = zip(MATERIALS, screw.materials, strict=True)
    laws = {f"model.{slot}": law for slot, law in model.laws_with_coefficients.items()}
    return {
        "screw": screw,
        **{f"screw.{name}": material for name, material in materials},
        "lubricant": lubricant,
        **_parts_of_nut(screw),
        **{section: part for section, part in others.items() if part is not None},
        "model": model,
        **laws,
    }


def _parts_of_nut(screw: BallScrew) -> dict[str, Any]:
    """The nut, its bodies in the sizes they have for the screw, and what it loses."""
    parts = screw.nut.parts
    return parts | ({"bodies": screw.nut.bodies.sized(screw)} if screw.nut.bodies is not None else {})


def implausible(parts: Mapping[str, Any]) -> list[Record]:
    """A warning for each quantity of the parts that is somewhere outside its usual range, with the value farthest out.

    Relations of fields, such as the lead angle, are quantities of the part as well.
    """
    return [
        _record(f"{section}.{name}", quantity, value)
        for section, part in parts.items()
        for name, quantity in quantities_of(type(part)).items()
        if quantity.info.usual is not None and (value := _farthest_out(quantity, getattr(part, name))) is not None
    ]


def _farthest_out(quantity: Quantity, values: Any) -> float | None:
    """The value farthest outside the usual range, by its ratio to the end; None if all are within it."""
    if values is None or quantity.info.usual is None:
        return None
    low, high = quantity.info.usual
    numbers = np.asarray(values, dtype=float)
    numbers = numbers[np.isfinite(numbers)]
    least, most = numbers.min(initial=low), numbers.max(initial=high)
    if least >= low and most <= high:
        return None
    return float(most if most > high and (least >= low or most / high > low / max(least, 1e-300)) else least)


def _record(subject: str, quantity: Quantity, value: float) -> Record:
    assert quantity.info.usual is not None
    low, high = quantity.info.usual
    template = _TEXT.replace("{meaning}", quantity.info.meaning)
    return Record(
        id=IMPLAUSIBLE,
        subject=subject,
        text=template.format(*(shown(number, quantity.unit) for number in (value, low, high))),
        severity="warning",
        holds=False,
        value=value,
        limit=high if value > high else low,
        unit=quantity.unit,
        template=template,
        quantities=tuple((number, quantity) for number in (value, low, high)),
    )
