"""The static page beside the pages of the documentation: ``page/index.html``, which the first page shows in a frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import ballscrew

#: The models and the kinds of nut of that page: those that compile within a minute. ``ballscrew site`` writes all.
MODELS, NUTS = ("reference",), ("row", "single", "double", "double+elastic")

SOURCES = Path(ballscrew.__file__).parent

#: What the first page has as a file, and what it has built.
PICTURE = "![The model in your browser](images/static_page.png)\n"
FRAME = """<iframe src="page/index.html" title="The model in your browser" class="static-page" loading="lazy"></iframe>
<p><a href="page/index.html">The same on a page of its own</a></p>
"""


def live(app: Any, name: str, source: list[str]) -> None:
    """Put the page itself where the first page has its picture."""
    if name == "index" and app.builder.format == "html":
        if PICTURE not in source[0]:
            raise ValueError(f"docs/index.md has no line {PICTURE}")
        source[0] = source[0].replace(PICTURE, FRAME)


def written(app: Any, error: Exception | None) -> None:
    """Write the page where the others are, once they are there; not again before a source is newer than it."""
    folder = Path(app.outdir) / "page"
    if error is None and app.builder.format == "html" and not _is_newer_than_sources(folder / "index.html"):
        from ballscrew.faces.page import site  # loads all of the program

        site.write(folder, site.site(MODELS, NUTS))


def _is_newer_than_sources(page: Path) -> bool:
    if not page.is_file():
        return False
    sources = (path for path in SOURCES.rglob("*") if path.is_file() and path.suffix != ".pyc")
    return page.stat().st_mtime > max(path.stat().st_mtime for path in sources)


def setup(app: Any) -> dict[str, Any]:
    """Connect to the reading of a page, and to the end of the build."""
    app.connect("source-read", live)
    app.connect("build-finished", written)
    return {"parallel_read_safe": True}
