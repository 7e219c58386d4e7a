"""Write what the README shows and the program produces: tables, numbers, what the example prints, and the picture.

``python docs/make_readme.py`` (or ``make readme``) rewrites them in place.
"""

import contextlib
import io
import sys
import textwrap
from pathlib import Path

from ballscrew.analyses.effects import PAPER
from ballscrew.interfaces.figures import effects as figures
from ballscrew.interfaces.figures import style
from ballscrew.interfaces.reproduce import claims_table

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from accuracy_table import short_table  # noqa: E402  (after the path of its folder)
from effect_tables import doubts_table, light_load_words  # noqa: E402  (likewise)
from validation_tables import vendors_table  # noqa: E402  (likewise)

README = HERE.parent / "README.md"
IMAGES = HERE / "images"
PICTURE = "effects_parts_over_speed"


def with_block(text: str, name: str, block: str) -> str:
    """The README with another block between the marks of a name."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, rest = text.split(begin)
    _, after = rest.split(end)
    return f"{before}{begin}\n{block}{end}{after}"


def with_claims(text: str) -> str:
    """The README with the table of the paper's claims as it is now."""
    return with_block(text, "claims", claims_table())


def with_accuracy(text: str) -> str:
    """The README with the table of the reference model against the integral as it is now; takes some seconds."""
    return with_block(text, "accuracy", short_table())


def with_vendors(text: str) -> str:
    """The README with the model against what vendors state as it is now; takes a few seconds."""
    return with_block(text, "vendors", vendors_table())


def with_doubts(text: str) -> str:
    """The README with the three widest doubts as they are now."""
    return with_block(text, "doubts", doubts_table(rows=3))


def with_light_load(text: str) -> str:
    """The README with the loads at which the paper's screw skids as they are now."""
    return with_block(text, "light load", textwrap.fill(light_load_words(PAPER), 130) + "\n")


def example(text: str) -> str:
    """The Python example of the README."""
    return text.split("```python\n")[1].split("```")[0]


def with_example(text: str) -> str:
    """The README with what its example prints now."""
    shown = io.StringIO()
    with contextlib.redirect_stdout(shown):
        exec(compile(example(text), "README.md", "exec"), {})
    return with_block(text, "example", f"```text\n{shown.getvalue()}```\n")


def main() -> None:
    text = README.read_text(encoding="utf-8")
    for part in (with_claims, with_accuracy, with_vendors, with_doubts, with_light_load, with_example):
        text = part(text)
    README.write_text(text, encoding="utf-8")
    IMAGES.mkdir(exist_ok=True)
    plot = next(plot for plot in figures.PLOTS if plot.name == PICTURE)
    with style.house_style():
        style.save(plot.draw(figures.drawn_cases()), IMAGES, "parts_over_speed")
    (IMAGES / "parts_over_speed.svg").unlink()
    print(README, *IMAGES.iterdir(), sep="\n")


if __name__ == "__main__":
    main()
