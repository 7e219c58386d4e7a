"""Write what the README shows and the program produces: two tables, and the picture.

``python docs/make_readme.py`` (or ``make readme``) rewrites them in place.
"""

import sys
from pathlib import Path

from ballscrew.interfaces.figures import effects as figures
from ballscrew.interfaces.figures import style
from ballscrew.interfaces.reproduce import claims_table

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))

from accuracy_table import short_table  # noqa: E402  (after the path of its folder)

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


def main() -> None:
    README.write_text(with_accuracy(with_claims(README.read_text(encoding="utf-8"))), encoding="utf-8")
    IMAGES.mkdir(exist_ok=True)
    plot = next(plot for plot in figures.PLOTS if plot.name == PICTURE)
    with style.house_style():
        style.save(plot.draw(figures.drawn_cases()), IMAGES, "parts_over_speed")
    (IMAGES / "parts_over_speed.svg").unlink()
    print(README, *IMAGES.iterdir(), sep="\n")


if __name__ == "__main__":
    main()
