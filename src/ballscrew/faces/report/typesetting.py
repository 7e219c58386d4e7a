"""The setting of a report by Typst, which runs in a process of its own: that process imports this module alone."""

from __future__ import annotations

import json
from typing import Any, NamedTuple

#: Sizes of letters that are tried, in points: the first with which no page is nearly blank, and no page too many.
_SIZES = ("9.6", "9.2", "8.8", "8.4", "8", "7.6")
#: Share of the last page that a report fills at least, where a size of letters can do it.
LEAST_OF_LAST_PAGE = 0.3


class _Extent(NamedTuple):
    """Pages of a report, and how much of the last one is filled."""

    pages: int
    last: float


def pdf(template: str, data: str, fonts: str, pages: int) -> bytes:
    """The template as a PDF file, with the data as its input ``report``, and fonts of a folder beside Typst's own.

    The type gets smaller where there would be more pages, or little on the last one.
    """
    import typst

    result = typst.Fonts(include_system_fonts=False, include_embedded_fonts=True, font_paths=[fonts])
    source = template.encode()

    def compiler(size: str) -> Any:
        return typst.Compiler(input=source, font_paths=result, sys_inputs={"report": data, "size": size})

    extents: dict[str, _Extent] = {}
    for size in _SIZES:
        end = json.loads(compiler(size).query("<end>", field="value", one=True))
        extents[size] = _Extent(end["page"], end["share"])
        if extents[size].pages <= pages and extents[size].last >= LEAST_OF_LAST_PAGE:
            return bytes(compiler(size).compile(input=source, format="pdf", pdf_standards=["ua-1"]))
    best = min(extents, key=lambda size: (max(extents[size].pages, pages), -extents[size].last))
    return bytes(compiler(best).compile(input=source, format="pdf", pdf_standards=["ua-1"]))
