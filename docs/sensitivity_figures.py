"""Output and figure of the page on sensitivity."""

import contextlib
import io
from pathlib import Path

from ballscrew.cases.case_files import case_file
from ballscrew.questions.sensitivity import compute as sensitivity
from ballscrew.questions.sensitivity import figure as figures
from ballscrew.questions.sensitivity import text
from ballscrew.questions.shared import charts

EXAMPLE = Path(__file__).parents[1] / "examples" / "feed_drive.toml"


def write(folder: Path) -> None:
    """Output of ``ballscrew sensitivity examples/feed_drive.toml``, and its figure with ``--to``."""
    folder.mkdir(parents=True, exist_ok=True)
    case = case_file.load(EXAMPLE)
    report = sensitivity.sensitivity(case, sensitivity.SensitivityOptions())
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        text.print_sensitivity(case, report)
    (folder / "feed_drive.txt").write_text(said.getvalue(), encoding="utf-8")
    with charts.house_style():
        charts.save_as(figures.picture(case, report), folder / "feed_drive.svg", "svg")
