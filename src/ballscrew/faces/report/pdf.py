"""A report as a PDF that machines can read: PDF/UA-1, set by Typst."""

from __future__ import annotations

import json
from importlib import resources
from pathlib import Path

from ballscrew.basis import child_process
from ballscrew.basis.errors import Fault, InputError
from ballscrew.faces.report import typesetting
from ballscrew.questions.shared.report_blocks import Report, as_data


def pdf_bytes(report: Report) -> bytes:
    """The report as a PDF file. Needs the extra ``report``.

    The texts go in as data, never as markup: nothing in them is obeyed. Nothing is read or fetched but the fonts that
    come with the packages. It is set in a process of its own: Typst keeps 10 MB of memory for each of the last reports.
    Raises :class:`~ballscrew.basis.errors.InputError` where that process reaches its limits.
    """
    import matplotlib as mpl

    template = resources.files("ballscrew.faces.report").joinpath("templates", "report.typ").read_text(encoding="utf-8")
    fonts = Path(mpl.get_data_path()) / "fonts" / "ttf"
    data = json.dumps(as_data(report), ensure_ascii=False, sort_keys=True)
    try:
        return child_process.call(typesetting.pdf, template, data, str(fonts), report.pages)
    except child_process.ChildError as error:
        raise InputError(Fault("report", "cannot be set as a PDF", str(error), "write .html instead")) from error
