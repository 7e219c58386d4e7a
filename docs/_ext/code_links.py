"""Links to source files, in the built pages: to the listing of the file, and to the reference of what they name.

On a page ``[`film.film_parameter`](../../src/ballscrew/physics/equations/film.py)`` leads to the file, wherever the
page is read. The listings of the built pages lead to a function, and the reference says what it takes.
"""

from __future__ import annotations

import re
from typing import Any

_LINK = re.compile(r"\[`(?P<shown>[\w.]+)`\]\((?:\.\./)*src/(?P<path>ballscrew/[\w/]+)\.py\)")


def _linked(app: Any, name: str, source: list[str]) -> None:
    up = "../" * name.count("/")

    def link(found: re.Match[str]) -> str:
        function = found["shown"].rpartition(".")[2]
        listing = f"{up}_modules/{found['path']}.html#{function}"
        full = f"{found['path'].replace('/', '.')}.{function}"
        return f'{{py:func}}`{found["shown"]} <{full}>` · <a href="{listing}">source</a>'

    if app.builder.format == "html":
        source[0] = _LINK.sub(link, source[0])


def setup(app: Any) -> dict[str, bool]:
    """Connect to the reading of pages."""
    app.connect("source-read", _linked)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
