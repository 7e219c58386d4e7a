"""Tables on the terminal and numbers in them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from rich.table import Table

from ballscrew.axis.supports.element_laws import BEARING_LAWS, GUIDE_LAWS, name_of
from ballscrew.axis.supports.mounted_bearing import MountedBearing
from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity, fields_of
from ballscrew.cases.case_files.case import Case


def table_of(title: str, *columns: str) -> Table:
    """An empty table with a bold title, the first column aligned left and the others right.

    In a narrow terminal cells go on in the next line; none is cut.
    """
    table = Table(title=title, title_justify="left", title_style="bold", box=None, pad_edge=False)
    table.add_column(columns[0], overflow="fold")
    for column in columns[1:]:
        table.add_column(column, justify="right", overflow="fold")
    return table


def shown_or_dash(value: Any, quantity: Quantity, toward: int = 0) -> str:
    """A value with its unit, of the end of a band rounded ``toward`` the outside; a dash where it is not finite."""
    return units.shown(value + 0.0, quantity, toward=toward) if math.isfinite(value) else "–"  # adding zero: no "-0"


def ends_or_dashes(low: Any, high: Any, quantity: Quantity) -> tuple[str, str]:
    """The ends of a band with their units, rounded outward; dashes where they are not finite."""
    return shown_or_dash(low, quantity, -1), shown_or_dash(high, quantity, 1)


def markdown_table(heading: Sequence[str], rows: Sequence[Sequence[str]], *, numbers: bool = False) -> str:
    """A table in Markdown; bars in cells are escaped. Columns of ``numbers`` after the first are set to the right."""
    marks = ["---", *["--:" if numbers else "---"] * (len(heading) - 1)]
    return "".join(
        "| " + " | ".join(cell.replace("|", r"\|") for cell in line) + " |\n" for line in (heading, marks, *rows)
    )


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
