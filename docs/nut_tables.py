"""What the page on nuts shows: its figures, and the accuracy of the law of four contacts."""

from pathlib import Path

from accuracy_table import printed
from ballscrew.interfaces.figures import nut, style


def write(folder: Path) -> None:
    """Figures as SVG and PNG, the table as Markdown."""
    folder.mkdir(parents=True, exist_ok=True)
    with style.house_style():
        for name, draw in nut.DRAWN.items():
            style.save(draw(), folder, name)
    (folder / "four_point.md").write_text(printed("four_point.py", "--markdown"), encoding="utf-8")
