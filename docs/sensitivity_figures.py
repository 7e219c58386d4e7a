"""What the page on sensitivity shows: the output of the command, and its picture."""

import contextlib
import io
from pathlib import Path

from ballscrew.interfaces import config, sensitivity
from ballscrew.interfaces.figures import style

EXAMPLE = Path(__file__).parents[1] / "examples" / "feed_drive.toml"


def write(folder: Path) -> None:
    """What ``ballscrew sensitivity examples/feed_drive.toml`` says, and draws with ``--to``."""
    folder.mkdir(parents=True, exist_ok=True)
    case = config.load(EXAMPLE)
    found = sensitivity.found(case, sensitivity.Asked())
    said = io.StringIO()
    with contextlib.redirect_stdout(said):
        sensitivity.print_found(case, found)
    (folder / "feed_drive.txt").write_text(said.getvalue(), encoding="utf-8")
    with style.house_style():
        style.save(sensitivity.picture(case, found), folder, "feed_drive")
