"""The gallery: the first picture of each page, which leads to the page that makes it."""

from __future__ import annotations

import re
from pathlib import Path

DOCS = Path(__file__).parent
#: Where pages with pictures are, with the headings of the gallery.
PAGES = {"Tasks": "howto/*.md", "Theory": "theory/*.md", "The model, and what it is worth": "*.md"}
_TITLE = re.compile(r"^# (.+)$", re.MULTILINE)
_PICTURE = re.compile(r"!\[(?P<words>[^\]]*)\]\((?:\.\./)?(?P<path>(?:figures|images)/[\w./-]+)\)")


def table() -> str:
    """A heading for each group, and a picture with the title of its page for each page that has one."""
    lines: list[str] = []
    for heading, pattern in PAGES.items():
        lines += [f"## {heading}", ""]
        for page in sorted(DOCS.glob(pattern)):
            text = page.read_text(encoding="utf-8")
            title, picture = _TITLE.search(text), _PICTURE.search(text)
            if title is None or picture is None or page.name == "index.md":
                continue
            link = page.relative_to(DOCS).as_posix()
            lines += [f"**[{title[1]}](../{link})**: {picture['words']}", ""]
            lines += [f"[![{picture['words']}](../{picture['path']})](../{link})", ""]
    return "\n".join(lines)
