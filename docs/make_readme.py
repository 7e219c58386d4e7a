"""Write what the program produces into README, page on agreement and first steps: tables and outputs.

``python docs/make_readme.py`` (or ``make readme``) rewrites them in place.
"""

import contextlib
import io
import re
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

from ballscrew.questions.reproduce.reproduction import claims_table

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]

from accuracy_table import short_table  # noqa: E402  (after the path of its folder)
from effect_study.cases import PAPER  # noqa: E402  (likewise)
from effect_tables import light_load_words, sensitivity_table  # noqa: E402  (likewise)
from validation_tables import agreement_table, vendors_in_words, vendors_table  # noqa: E402  (likewise)

README, AGREEMENT, START = HERE.parent / "README.md", HERE / "agreement.md", HERE / "start.md"


def with_block(text: str, name: str, block: str) -> str:
    """The page with another block between the markers of a name."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, rest = text.split(begin)
    _, after = rest.split(end)
    return f"{before}{begin}\n{block}{end}{after}"


def with_claims(text: str) -> str:
    """The page with the current table of the paper's claims."""
    return with_block(text, "claims", claims_table())


def with_accuracy(text: str) -> str:
    """The page with the current table of the reference model against the contact integral; takes some seconds."""
    return with_block(text, "accuracy", short_table())


def with_vendors(text: str) -> str:
    """The page with the current comparison with vendors, as a table and in words; takes a few seconds."""
    return with_block(with_block(text, "vendors", vendors_table()), "vendors in words", vendors_in_words())


def with_sensitivities(text: str) -> str:
    """The page with the three inputs that move the torque most as computed now."""
    return with_block(text, "sensitivities", sensitivity_table(rows=3))


def with_light_load(text: str) -> str:
    """The page with the loads at which the paper's screw skids as computed now."""
    return with_block(text, "light load", textwrap.fill(light_load_words(PAPER), 130) + "\n")


def with_agreement(text: str) -> str:
    """The page with the current comparison in seven rows; takes a few seconds."""
    return with_block(text, "agreement", agreement_table())


def examples(text: str) -> list[str]:
    """The Python blocks of a page, which share their names."""
    return [block.split("```")[0] for block in text.split("```python\n")[1:]]


def with_examples(text: str) -> str:
    """The page with the current output of its Python blocks, each of which has a place for it."""
    outputs = re.findall(r"<!-- (example\b[^:]*): begin -->", text)
    names: dict[str, object] = {}
    for name, source in zip(outputs, examples(text), strict=True):
        shown = io.StringIO()
        with contextlib.redirect_stdout(shown):
            exec(compile(source, name, "exec"), names)
        text = with_block(text, name, f"```text\n{shown.getvalue()}```\n")
    return text


#: What is written into each page.
WRITTEN: dict[Path, tuple[Callable[[str], str], ...]] = {
    README: (with_agreement, with_examples),
    AGREEMENT: (with_claims, with_accuracy, with_vendors, with_sensitivities, with_light_load),
    START: (with_examples,),
}


def main() -> None:
    for page, parts in WRITTEN.items():
        text = page.read_text(encoding="utf-8")
        for part in parts:
            text = part(text)
        page.write_text(text, encoding="utf-8")
    print(*WRITTEN, sep="\n")


if __name__ == "__main__":
    main()
