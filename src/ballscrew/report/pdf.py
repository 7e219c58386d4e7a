"""A report as a PDF that machines can read: PDF/UA-1, set by Typst."""

from __future__ import annotations

import json
import re
from importlib import resources
from pathlib import Path

from ballscrew.report.blocks import (
    Report,
    as_data,
)

#: Pages that a report may have, and the sizes of letters that are tried until it has no more, in points.
PAGES, _SIZES = 4, ("9.6", "9", "8.4", "7.8")
_PAGE = re.compile(rb"/Type\s*/Page\b")


def pdf_bytes(report: Report) -> bytes:
    """The report as a PDF file. Needs the extra ``report``.

    The texts go in as data, never as markup: nothing in them is obeyed. Nothing is read or fetched but the fonts that
    come with the packages.
    """
    import matplotlib as mpl
    import typst

    template = resources.files("ballscrew.report").joinpath("templates", "report.typ").read_text(encoding="utf-8")
    own = Path(mpl.get_data_path()) / "fonts" / "ttf"
    fonts = typst.Fonts(include_system_fonts=False, include_embedded_fonts=True, font_paths=[own])
    data = json.dumps(as_data(report), ensure_ascii=False, sort_keys=True)
    written = b""
    for size in _SIZES:
        written = typst.compile(
            template.encode(),
            format="pdf",
            font_paths=fonts,
            sys_inputs={"report": data, "size": size},
            pdf_standards=["ua-1"],
        )
        if len(_PAGE.findall(written)) <= PAGES:
            break
    return written
