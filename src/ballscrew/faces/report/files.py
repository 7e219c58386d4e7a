"""The report of a case, or of several side by side, as the bytes of a file."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Literal

from ballscrew.cases.case_files.case import Case
from ballscrew.faces.report import contents, several
from ballscrew.faces.report.contents import ALL, Done
from ballscrew.faces.report.heading import Heading

Kind = Literal["pdf", "html"]
#: Nobody says whose report it is.
NO_HEADING = Heading()


def report_bytes(
    case: Case,
    kind: Kind,
    done: Done | None = None,
    samples: int | None = None,
    heading: Heading = NO_HEADING,
    beside: Sequence[Case] = (),
) -> bytes:
    """The report of a case as a PDF or HTML file; equal cases with equal headings give equal bytes.

    With other designs ``beside`` it all of them stand side by side first. ``done(finished, total)`` is told how far it
    is. Needs the extra ``report``.
    """
    whole = several.content([case, *beside], done, samples) if beside else contents.content(case, done, samples)
    found = dataclasses.replace(whole, heading=heading.lines)
    if kind == "html":
        from ballscrew.faces.report.html import html_bytes

        written = html_bytes(found)
    else:
        from ballscrew.faces.report.pdf import pdf_bytes

        written = pdf_bytes(found)
    if done is not None:
        done(ALL, ALL)
    return written
