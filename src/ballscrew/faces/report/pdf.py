"""A report as a PDF that machines can read: PDF/UA-1, set by Typst."""

from __future__ import annotations

import dataclasses
import importlib.util
import json
from collections.abc import Mapping, Sequence
from importlib import resources
from pathlib import Path
from typing import Literal

from ballscrew.basis import child_process
from ballscrew.basis.atomic_files import atomic_write, check_writable
from ballscrew.basis.errors import Fault, InputError
from ballscrew.cases.case_files.case import Case
from ballscrew.faces.report import contents, several
from ballscrew.faces.report.contents import ALL, Heading
from ballscrew.faces.report.typesetting import pdf
from ballscrew.faces.sheets.report_blocks import Report, as_data
from ballscrew.questions.shared.question import Done


def html_bytes(report: Report) -> bytes:
    """The report as an HTML file; every text in it is escaped. Needs the extra ``report``."""
    import jinja2
    from markupsafe import Markup

    template = (
        resources.files("ballscrew.faces.report").joinpath("templates", "report.html").read_text(encoding="utf-8")
    )
    environment = jinja2.Environment(
        autoescape=True, undefined=jinja2.StrictUndefined, trim_blocks=True, lstrip_blocks=True, newline_sequence="\n"
    )
    # drawings come from this package, which escapes what is written in them
    environment.filters["drawn"] = Markup
    return environment.from_string(template).render(report=as_data(report)).encode()


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
        return child_process.call(pdf, template, data, str(fonts), report.pages)
    except child_process.ChildError as error:
        raise InputError(Fault("report", "cannot be set as a PDF", str(error), "write .html instead")) from error


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
        return html_bytes(report)

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
