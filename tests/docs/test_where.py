"""Every file and every name of the page "Where is …?" exists."""

import re

from support.rules import for_each

from .pages import DOCS, ROOT

ROW = re.compile(r"^\| (?P<question>.+\?) \| `(?P<path>[^`]+)` \| (?:`(?P<name>\w+)`)? ?\|$", re.MULTILINE)
ROWS = [*ROW.finditer((DOCS / "where.md").read_text(encoding="utf-8"))]


def test_the_page_has_at_least_twenty_questions():
    assert len(ROWS) >= 20
    lines = (DOCS / "where.md").read_text(encoding="utf-8").splitlines()
    headings = sum(line.startswith("|---") for line in lines)
    assert len(ROWS) == sum(line.startswith("|") for line in lines) - 2 * headings  # each with the rule below it


@for_each(row={f"{place}: {row['path']}": row for place, row in enumerate(ROWS)})
def test_the_answer_exists(row):
    path = ROOT / row["path"]
    assert path.is_dir() if row["path"].endswith("/") else path.is_file()
    if row["name"]:
        defined = rf"^\s*(?:export )?(?:async )?(?:def|class|function|const) {row['name']}\b|^{row['name']}\b.*="
        assert re.search(defined, path.read_text(encoding="utf-8"), re.MULTILINE), (
            f"update docs/where.md: {row['name']} is not in {path}"
        )
