"""The report of a case, or of several side by side, as the bytes of a file."""

from __future__ import annotations

import dataclasses
import importlib.util
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Literal

from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.report import contents, several
from ballscrew.faces.report.contents import ALL, Done
from ballscrew.faces.report.heading import Heading
from ballscrew.questions.shared.report_blocks import Report

Kind = Literal["pdf", "html"]
#: What each kind of file needs beyond the core.
_NEEDS = {".html": ("jinja2",), ".pdf": ("typst",)}
_KINDS: Mapping[str, Kind] = {".html": "html", ".pdf": "pdf"}
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
    made = bytes_of(dataclasses.replace(whole, heading=heading.lines), kind)
    if done is not None:
        done(ALL, ALL)
    return made


def bytes_of(report: Report, kind: Kind) -> bytes:
    """A report as a PDF or HTML file. Needs the extra ``report``."""
    if kind == "html":
        from ballscrew.faces.report.html import html_bytes

        return html_bytes(report)
    from ballscrew.faces.report.pdf import pdf_bytes

    return pdf_bytes(report)


def check_kind(option: str, to: Path) -> Kind:
    """The kind of report by the ending of a file that can be written.

    Raises :class:`~ballscrew.basis.errors.InputError` for another ending, a package that is missing, and a file that
    cannot be written.
    """
    kind = to.suffix.lower()
    if kind not in _NEEDS:
        raise InputError(Fault(option, "unknown kind of file", str(to), "end it in .pdf or .html"))
    missing = [name for name in _NEEDS[kind] if importlib.util.find_spec(name) is None]
    if missing:
        problem = f"needs {' and '.join(missing)}"
        raise InputError(Fault(option, problem, str(to), 'pip install "ballscrew[report]"'))
    check_writable(option, to)
    return _KINDS[kind]


def written(option: str, to: Path, report: Report) -> int:
    """Write a report to a file, whole or not at all, and return its bytes."""
    made = bytes_of(report, check_kind(option, to))
    with atomic_write(option, to) as path:
        path.write_bytes(made)
    return len(made)
