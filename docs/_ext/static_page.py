"""The static page beside the pages of the documentation: ``page/index.html``, which the first page shows in a frame."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from ballscrew.faces.site import site

#: The models and the kinds of nut of that page: ``ballscrew site`` writes all of them.
MODELS, NUTS = ("reference",), ("row", "single", "double", "oversize-balls", "double+elastic")


def written(app: Any, error: Exception | None) -> None:
    """Write the page where the others are, once they are there."""
    if error is None and app.builder.format == "html":
        site.write(Path(app.outdir) / "page", site.site(MODELS, NUTS))


def setup(app: Any) -> dict[str, Any]:
    """Connect to the end of the build."""
    app.connect("build-finished", written)
    return {"parallel_read_safe": True}
