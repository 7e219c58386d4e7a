"""Output and figure of the page on sensitivity."""

import contextlib
import io
from pathlib import Path

from ballscrew.cases import case_file
from ballscrew.figures import sensitivity as figures
from ballscrew.figures import style
from ballscrew.studies import sensitivity
from ballscrew.text import sensitivity as text

EXAMPLE = Path(__file__).parents[1] / "examples" / "feed_drive.toml"


def write(folder: Path) -> None:
    """Output of ``ballscrew sensitivity examples/feed_drive.toml``, and its figure with ``--to``."""
    folder.mkdir(parents=True, exist_ok=True)
    case = case_file.load(EXAMPLE)
    report = sensitivity.sensitivity(case, sensitivity.Options())
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        text.print_sensitivity(case, report)
    (folder / "feed_drive.txt").write_text(said.getvalue(), encoding="utf-8")
    with style.house_style():
        style.save_as(figures.picture(case, report), folder / "feed_drive.svg", "svg")
