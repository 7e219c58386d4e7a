"""Write what the program produces into README and first steps: a table, and outputs of examples.

``python docs/make_readme.py`` (or ``make readme``) rewrites them in place.
"""

import contextlib
import io
import re
import sys
from collections.abc import Callable
from pathlib import Path

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "tests")]

from validation_tables import agreement_table  # noqa: E402  (after the path of its folder)

README, START = HERE.parent / "README.md", HERE / "start.md"


def with_block(text: str, name: str, block: str) -> str:
    """The page with another block between the markers of a name."""
    begin, end = f"<!-- {name}: begin -->", f"<!-- {name}: end -->"
    before, rest = text.split(begin)
    _, after = rest.split(end)
    return f"{before}{begin}\n{block}{end}{after}"


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
