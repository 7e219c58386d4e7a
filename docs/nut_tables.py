"""Figures of the page on nuts, and the accuracy of the slip law of four contacts."""

import sys
from pathlib import Path

from ballscrew.questions.shared import charts
from effect_study import nut_figures

sys.path.append(str(Path(__file__).parents[1] / "benchmarks"))
import four_point

#: Random screws of the table: a quarter of those of the benchmark tell the same, in a quarter of its 40 s.
CASES = 150


def write(folder: Path) -> None:
    """Figures as SVG and PNG, the table as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    with charts.house_style():
        for name, draw in nut_figures.DRAWN.items():
            charts.save_as(draw(), folder / f"{name}.svg", "svg")
    (folder / "four_point.md").write_text(four_point.table(CASES), encoding="utf-8")
