"""Checks in lines: value, limit, the share that is used, and the verdict; bearings and guides of a case in words."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, LAW_WORDS, name_of
from ballscrew.basis import units
from ballscrew.basis.errors import in_file
from ballscrew.basis.output.sheet import Cell, Number, Share, Table
from ballscrew.basis.output.text import plain
from ballscrew.basis.quantities import Info, Quantity, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.sizing.checks import Check
from ballscrew.physics.sizing.makers_tables import QUALIFICATIONS

#: The display units of the checks, by SI unit.
_SHOWN_IN = {"N": "kN", "Pa": "MPa", "s": "h", "rad/s": "rpm", "m rad/s": "mm rpm", "N m": "N m", "N/m": "N/um"}
#: The options for an input that is missing.
_GIVE = {
    "installation": "--length and --ends, or [installation]",
    "limits.running_time": '--set limits.running_time="20000 h"',
}


def quantity_of(check: Check) -> Quantity:
    """The quantity of a check, in the unit it is shown in."""
    return in_shown_unit(check.name, check.unit)


def in_shown_unit(name: str, unit: str) -> Quantity:
    """The quantity of a check of this name, in the unit it is shown in."""
    return Quantity(name, unit, Info("", name, _SHOWN_IN.get(unit, "")))


def shown(check: Check, value: float | None) -> str:
    """Four digits and the unit, without the exponent of programs."""
    if value is None or not math.isfinite(value):
        return "–"
    quantity = quantity_of(check)
    rounded = float(f"{value:.4g}") if quantity.unit == "1" else float(units.rounded(value, quantity))
    return plain(f"{rounded:.6g}") + ("" if quantity.unit == "1" else f" {quantity.shown_in}")


#: The field that an input is, of those that checks may lack.
_FIELDS = {
    "installation": "installation.unsupported_length",
    "limits.running_time": "limits.running_time",
    "dynamic_load_rating": "screw.dynamic_load_rating",
    "static_load_rating": "screw.static_load_rating",
}


def check_table(checks: Sequence[Check], give: Mapping[str, str] | None = None) -> Table:
    """The checks with their limits; ``give`` names what to give for inputs they lack."""
    rows: list[Sequence[Cell]] = []
    fields: list[str] = []
    for check in checks:
        text = check.text
        fields.append(_FIELDS.get(check.missing, ""))
        for missing, remedy in (_GIVE if give is None else give).items():
            text = text.replace(missing, remedy) if check.missing == missing else text
        value, limit = (None if v is None else Number(v, quantity_of(check)) for v in (check.value, check.limit))
        used = check.utilisation
        share = None if used is None or not math.isfinite(used) else Share(used, bar=False)
        verdict = ": ".join(filter(None, [verdict_of(check), text]))
        rows.append((check.name.replace("_", " "), value, limit, share, verdict))
    return Table("checks", "Checks", ("", "value", "limit", "used", "verdict"), rows, detail=True, fields=fields)


def verdict_of(check: Check) -> str:
    """The verdict on a check, by formulas of which source; of one that is not judged the source of its value alone."""
    said = {True: "passes", False: "FAILS", None: ""}[check.holds]
    by = None if check.source is None or check.value is None else QUALIFICATIONS[check.source]
    return "; ".join(filter(None, [said, "" if by is None else by]))


def with_unlikely(verdict: str, case: Case) -> str:
    """A verdict, and the inputs of the case that are unlikely: what is computed with them may hold by a slip."""
    names = ", ".join(map(in_file, case.unlikely))
    return f"{verdict}; unlikely: {names}" if names else verdict


def source_document(check: Check) -> dict[str, Any]:
    """The source of a check as it stands in JSON, with its words where it was not read; nothing of a check without."""
    if check.source is None:
        return {}
    return {"source": check.source, "source_text": QUALIFICATIONS[check.source]}


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
    line = f"{LAW_WORDS[law]}: {', '.join(sizes) or 'nothing'}"
    return f"{line}; assumed: {', '.join(assumed)}" if assumed else line


def _mounting(bearing: MountedBearing) -> str:
    """The share of the load where it is not all or nothing, and a pair without preload."""
    element: Any = bearing.element
    words = f"; takes {float(bearing.load_share):.3g} of the load" if 0 < bearing.load_share < 1 else ""
    braced = getattr(element, "rows", 1) > 1 and not getattr(element, "preload", 1.0)
    return f"{words}; no preload" if braced else words
