"""Bearings and guides of a case in words: their law, their sizes, and what is assumed of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, name_of
from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files.case import Case

_LAWS = {
    "contacts": "by its contacts",
    "skf": "by the model of SKF2018",
    "palmgren": "by Palmgren's moments, a recalled form",
    "known": "of a known torque",
    "maker": "by the law of makers",
}
#: What is shown of an element, as far as it has it.
_SHOWN = (
    "bore", "outside_diameter", "ball_diameter", "balls", "contact_angle", "rows", "contacts_per_ball",
    "preload", "seal_torque", "torque", "friction_coefficient",
    "seal_force", "carriages",
)  # fmt: skip


def element_lines(case: Case) -> Sequence[str]:
    """One line for each bearing and for the guides."""
    lines = [f"{bearing.name} {_words(bearing.element, BEARING_LAWS)}{_mounting(bearing)}" for bearing in _all(case)]
    if case.axis is not None and case.axis.guides is not None:
        table = "" if case.axis.table is not None else "; all carriages bear alike"
        lines.append(f"guides {_words(case.axis.guides, GUIDE_LAWS)}{table}")
    return lines


def _all(case: Case) -> Sequence[MountedBearing]:
    return list(case.bearings.values())


def _words(element: Any, laws: Any) -> str:
    law = name_of(element, laws)
    known = fields_of(type(element))
    sizes = [
        f"{name.replace('_', ' ')} {units.shown(getattr(element, name), known[name])}"
        for name in _SHOWN
        if name in known and getattr(element, name)
    ]
    assumed = getattr(element, "assumed", ())
    return f"{_LAWS[law]}: {', '.join(sizes) or 'nothing'}" + (f"; assumed: {', '.join(assumed)}" if assumed else "")


def _mounting(bearing: MountedBearing) -> str:
    """The share of the load where it is not all or nothing, and a pair without preload."""
    element: Any = bearing.element
    words = f"; takes {float(bearing.load_share):.3g} of the load" if 0 < bearing.load_share < 1 else ""
    braced = getattr(element, "rows", 1) > 1 and not getattr(element, "preload", 1.0)
    return f"{words}; no preload" if braced else words
