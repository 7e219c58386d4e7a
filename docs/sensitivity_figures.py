"""Output and figure of the page on sensitivity."""

from pathlib import Path

from ballscrew.cases.case_files import case_file
from ballscrew.faces.sheets import terminal, to_file
from ballscrew.questions.sensitivity import answer
from ballscrew.questions.sensitivity.answer import sheet

EXAMPLE = Path(__file__).parents[1] / "examples" / "feed_drive.toml"


def write(folder: Path) -> None:
    """Output of ``ballscrew sensitivity examples/feed_drive.toml``, and its figure with ``--to``."""
    folder.mkdir(parents=True, exist_ok=True)
    case = case_file.load(EXAMPLE)
    report = answer.sensitivity(case, answer.SensitivityOptions())
    shown = sheet(case, report)
    (folder / "feed_drive.txt").write_text(f"{terminal.text(shown)}\n", encoding="utf-8")
    to_file.write(folder / "feed_drive.svg", shown)
