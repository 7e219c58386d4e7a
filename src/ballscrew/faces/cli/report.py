"""``ballscrew report``: a case as a file to read and to keep."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import AllowCode, CalibrationName, CaseFile, ModelName, Settings
from ballscrew.faces.cli.flags import flags_of
from ballscrew.faces.report.options import ReportOptions

_TO = "--to"
#: Designs beside the first, as :mod:`ballscrew.faces.report.several` has letters for.
_MOST_BESIDE = 3


@flags_of(ReportOptions)
def report(
    case: CaseFile,
    to: Annotated[Path, typer.Option("--to", "-o", metavar="FILE", help="File to write: .pdf or .html.")],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    *,
    written: Mapping[str, Any],
    beside: Annotated[
        list[Path] | None,
        typer.Option("--beside", metavar="CASE", help="Another design beside the first; may be repeated, up to three."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Write a report of a case as PDF or HTML.

    It has checks, results with their bands, drawing, curves, what makes the band, inputs and sources.

    With --beside other designs stand side by side with the first, checks and bands included, then each by itself. Up
    to five pages; two more with a motion, one more where that case has an [installation], one more with
    [surroundings], for four hours of warming up. The .html is one file that asks for nothing from
    outside; the .pdf can be read by machines, too (PDF/UA-1). The same case gives the same bytes: a date stands on it
    only where --date says one.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.records import Message
    from ballscrew.faces.report.files import check_kind

    kind = check_kind(_TO, to)
    from ballscrew.basis.atomic_files import atomic_write
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.report.heading import Heading
    from ballscrew.questions.shared.option_values import read

    if len(beside or []) > _MOST_BESIDE:
        raise InputError(
            Fault(
                "--beside",
                "too many designs",
                str(len(beside or [])),
                Message("{most_beside} at most", {"most_beside": str(_MOST_BESIDE)}),
            )
        )
    loaded, *others = (
        case_file.load(path, settings or [], model, calibration=calibration, allow_code=allow_code)
        for path in (case, *(beside or []))
    )
    options = read(ReportOptions, written)
    heading = Heading.of(options.project, options.date)
    from ballscrew.faces.cli.progress import progress
    from ballscrew.faces.report.files import report_bytes

    with progress("report") as done:
        made = report_bytes(loaded, kind, done, options.samples, heading, others)
    with atomic_write(_TO, to) as path:
        path.write_bytes(made)
    typer.echo(f"{to}: report of {case.name}, {len(made) // 1000} kB")
