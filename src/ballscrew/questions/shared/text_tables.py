"""Numbers in texts, and tables in Markdown."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from ballscrew.basis import units
from ballscrew.basis.quantities import Quantity


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
