"""Figures of the page on nuts, and the accuracy of the slip law of four contacts."""

from pathlib import Path

from accuracy_table import printed
from ballscrew.figures import style
from effect_study import nut_figures


def write(folder: Path) -> None:
    """Figures as SVG and PNG, the table as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    with style.house_style():
        for name, draw in nut_figures.DRAWN.items():
            style.save(draw(), folder, name)
    (folder / "four_point.md").write_text(printed("four_point.py", "--markdown"), encoding="utf-8")
