"""A template and data set by Typst. This module imports little: a process of its own loads it for each report."""

from __future__ import annotations

import re

#: Sizes of letters that are tried until a report has no more pages than it may have, in points.
_SIZES = ("9.6", "9", "8.4", "7.8")
_PAGE = re.compile(rb"/Type\s*/Page\b")


def pdf(template: str, data: str, fonts: str, pages: int) -> bytes:
    """The template as a PDF file, with the data as its input ``report``, and fonts of a folder beside Typst's own.

    The type gets smaller where there would be more pages.
    """
    import typst

    found = typst.Fonts(include_system_fonts=False, include_embedded_fonts=True, font_paths=[fonts])
    written = b""
    for size in _SIZES:
        written = typst.compile(
            template.encode(),
            format="pdf",
            font_paths=found,
            sys_inputs={"report": data, "size": size},
            pdf_standards=["ua-1"],
        )
        if len(_PAGE.findall(written)) <= pages:
            break
    return written
