"""Figures of the page on nuts, and the accuracy of the slip law of four contacts."""

from pathlib import Path

from accuracy_table import printed
from ballscrew.questions.shared import charts
from effect_study import nut_figures

#: Random screws of the table: a quarter of those of the benchmark tell the same, in a quarter of its 40 s.
CASES = "150"


def write(folder: Path) -> None:
    """Figures as SVG and PNG, the table as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    with charts.house_style():
        for name, draw in nut_figures.DRAWN.items():
            charts.save_as(draw(), folder / f"{name}.svg", "svg")
    (folder / "four_point.md").write_text(printed("four_point", "--markdown", "--cases", CASES), encoding="utf-8")
