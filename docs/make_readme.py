"""Write the parts of the README that the program produces: tables, numbers, the output of the example, the picture.

``python docs/make_readme.py`` (or ``make readme``) rewrites them in place.
"""

import contextlib
import io
import sys
import textwrap
from pathlib import Path

from ballscrew.faces.cli.reproduction import claims_table
from ballscrew.questions.shared import charts

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]

from accuracy_table import short_table  # noqa: E402  (after the path of its folder)
from effect_study import effect_figures as figures  # noqa: E402  (likewise)
from effect_study.cases import PAPER  # noqa: E402  (likewise)
from effect_tables import light_load_words, sensitivity_table  # noqa: E402  (likewise)
from validation_tables import vendors_in_words, vendors_table  # noqa: E402  (likewise)

README = HERE.parent / "README.md"
IMAGES = HERE / "images"
PICTURE = "effects_parts_over_speed"


def with_block(text: str, name: str, block: str) -> str:
    """The README with another block between the markers of a name."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, rest = text.split(begin)
    _, after = rest.split(end)
    return f"{before}{begin}\n{block}{end}{after}"


def with_claims(text: str) -> str:
    """The README with the current table of the paper's claims."""
    return with_block(text, "claims", claims_table())


def with_accuracy(text: str) -> str:
    """The README with the current table of the reference model against the contact integral; takes some seconds."""
    return with_block(text, "accuracy", short_table())


def with_vendors(text: str) -> str:
    """The README with the current comparison with vendors, as a table and in words; takes a few seconds."""
    return with_block(with_block(text, "vendors", vendors_table()), "vendors in words", vendors_in_words())


def with_sensitivities(text: str) -> str:
    """The README with the three inputs that move the torque most as computed now."""
    return with_block(text, "sensitivities", sensitivity_table(rows=3))


def with_light_load(text: str) -> str:
    """The README with the loads at which the paper's screw skids as computed now."""
    return with_block(text, "light load", textwrap.fill(light_load_words(PAPER), 130) + "\n")


#: The names of the outputs of the Python blocks, in their order.
EXAMPLES = ("example", "example of a nut", "example of a spread")


def examples(text: str) -> list[str]:
    """The Python blocks of the README, which share their names."""
    return [block.split("```")[0] for block in text.split("```python\n")[1:]]


def with_examples(text: str) -> str:
    """The README with the current output of its Python blocks."""
    names: dict[str, object] = {}
    for name, source in zip(EXAMPLES, examples(text), strict=True):
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown):
            exec(compile(source, "README.md", "exec"), names)
        text = with_block(text, name, f"```text\n{shown.getvalue()}```\n")
    return text


def main() -> None:
    text = README.read_text(encoding="utf-8")
    for part in (with_claims, with_accuracy, with_vendors, with_sensitivities, with_light_load, with_examples):
        text = part(text)
    README.write_text(text, encoding="utf-8")
    IMAGES.mkdir(exist_ok=True)
    plot = next(plot for plot in figures.PLOTS if plot.name == PICTURE)
    with charts.house_style():
        charts.save(plot.draw(figures.drawn_cases()), IMAGES, "parts_over_speed")
    (IMAGES / "parts_over_speed.svg").unlink()
    print(README, *IMAGES.iterdir(), sep="\n")


if __name__ == "__main__":
    main()
