"""Write what the README shows and the program produces: the table of claims, and the picture.

``python docs/make_readme.py`` (or ``make readme``) rewrites both in place.
"""

from pathlib import Path

from ballscrew.analyses import olaru2005 as paper
from ballscrew.interfaces.figures import olaru2005 as figures
from ballscrew.interfaces.figures import style
from ballscrew.interfaces.reproduce import claims_table

HERE = Path(__file__).parent
README = HERE.parent / "README.md"
IMAGES = HERE / "images"
BEGIN, END = "<!-- claims: begin -->", "<!-- claims: end -->"


def with_claims(text: str) -> str:
    """The README with the table of claims as it is now."""
    before, rest = text.split(BEGIN)
    _, after = rest.split(END)
    return f"{before}{BEGIN}\n{claims_table()}{END}{after}"


def main() -> None:
    README.write_text(with_claims(README.read_text(encoding="utf-8")), encoding="utf-8")
    IMAGES.mkdir(exist_ok=True)
    plot = next(plot for plot in figures.PLOTS if plot.name == "parts_over_speed")
    with style.house_style():
        style.save(plot.draw(paper.curves()), IMAGES, plot.name)
    (IMAGES / f"{plot.name}.svg").unlink()
    print(README, *IMAGES.iterdir(), sep="\n")


if __name__ == "__main__":
    main()
