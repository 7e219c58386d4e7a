"""The tree of pages beside each page, from titles alone.

The theme shows titles. Sphinx copies the whole table of contents of each page into the tree of each page, with all
functions of the reference, and then removes all but the titles: that took half of the time of a build.
"""

from __future__ import annotations

from typing import Any

from sphinx.addnodes import toctree


def titles(toc: Any) -> Any:
    """A table of contents with its titles and the trees below them."""
    found = toc.deepcopy()
    for top_level in found.children:
        if len(top_level) > 1:
            if subtrees := list(top_level.findall(toctree)):
                top_level[1][:] = subtrees
            else:
                top_level.pop(1)
    return found


def _of_titles(app: Any, _page: str, _template: str, context: dict[str, Any], _doctree: Any) -> None:
    whole = context.get("toctree")
    if whole is None:
        return
    if not hasattr(app, "ballscrew_titles"):
        app.ballscrew_titles = {name: titles(toc) for name, toc in app.env.tocs.items()}

    def tree(**options: Any) -> Any:
        if not options.get("titles_only"):
            return whole(**options)
        tocs, app.env.tocs = app.env.tocs, app.ballscrew_titles
        try:
            return whole(**options)
        finally:
            app.env.tocs = tocs

    context["toctree"] = tree


def setup(app: Any) -> dict[str, bool]:
    app.connect("html-page-context", _of_titles, priority=100)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
