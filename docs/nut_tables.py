"""Figures of the page on nuts, and the accuracy of the slip law of four contacts."""

import sys
from pathlib import Path
from typing import Any

from effect_study import nut_figures

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
import four_point

#: Random screws of the table: a quarter of those of the benchmark tell the same, in a quarter of its 40 s.
CASES = 150


def parts() -> dict[str, Any]:
    """Figures, and the table as Markdown."""
    drawn = {f"{name}.svg": draw for name, draw in nut_figures.DRAWN.items()}
    return {**drawn, "four_point.md": four_point.table(CASES)}
