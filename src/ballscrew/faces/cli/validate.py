"""``ballscrew validate``: the model against vendors and laboratories."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.evidence.validation.entries import Entry
    from ballscrew.questions.validate.compute import Request
    from ballscrew.questions.validate.summary import SummaryRow


def validate(
    sets: Annotated[
        list[str] | None, typer.Argument(metavar="SET", help="Sets of data: rexroth-double-nut; without one, all.")
    ] = None,
    rows: Annotated[
        Path | None,
        typer.Option("--rows", metavar="FILE", help="A table of your own with the columns of the set, .csv or .xlsx."),
    ] = None,
    card: Annotated[
        list[Path] | None,
        typer.Option("--card", metavar="PATH", help="A torque card, or a folder of them, in place of the sets."),
    ] = None,
    summary: Annotated[
        bool, typer.Option("--summary", help="Drag torques by maker and kind of nut in one table, without their rows.")
    ] = False,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON list, SI units; of --summary one object.")] = False,
    as_sheet: Annotated[
        bool, typer.Option("--sheet", help="What people see as one JSON list, a sheet for each set.")
    ] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Also draw the ratios: .png, .svg or .pdf.")
    ] = None,
    report: Annotated[
        Path | None,
        typer.Option("--report", metavar="FILE", help="Also write all of it as one paper: .pdf or .html."),
    ] = None,
    keep_going: Annotated[
        bool, typer.Option("--keep-going", help="Leave faulty rows out, and say which; fails if none is good.")
    ] = False,
    model: Annotated[str, typer.Option("--model", metavar="NAME", help="{models}.")] = "reference",
    calibration: Annotated[
        str | None,
        typer.Option(
            "--calibration", metavar="NAME", help="Calibration to show beside the model as it is: rexroth-2006."
        ),
    ] = None,
    temperature: Annotated[
        str | None,
        typer.Option("--temperature", metavar="VALUE", help='Temperature of the oil where a row has none: "25 degC".'),
    ] = None,
    grade: Annotated[
        str | None, typer.Option("--grade", metavar="NAME", help='Grade of the oil where a row has none: "ISO VG 100".')
    ] = None,
    speed: Annotated[
        str | None, typer.Option("--speed", metavar="VALUE", help='Screw speed where a row has none: "100 rpm".')
    ] = None,
) -> None:
    """The model against what vendors and laboratories state.

    For each set the ratio model / stated (the middle of the vendor's band), its scatter, the share of rows inside the
    band, and every row; first the model as it is, then with a named calibration. Beside them rules of one line that
    people use in place of a model.
    """
    from ballscrew.basis.output import json_text
    from ballscrew.basis.output import sheet as sheets
    from ballscrew.faces.sheets import terminal
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.validate import compute as validation
    from ballscrew.questions.validate import document as documents
    from ballscrew.questions.validate import sheet as seen
    from ballscrew.questions.validate import summary as summaries

    request = validation.request(
        sets or [],
        model=model,
        calibration_name=calibration,
        rows=rows,
        keep_going=keep_going,
        grade=grade,
        temperature=temperature,
        speed=speed,
        cards=card or [],
        summary=summary,
        to=to,
        report=report,
    )
    if to is not None:
        files.check_picture(to)
    if report is not None:
        from ballscrew.faces.report.files import check_kind

        check_kind("--report", report)
    _print_notes(request.notes)
    found: list[list[Entry]] = []
    shown: list[Sheet] = []
    quiet = as_json or as_sheet
    for entries, notes in validation.evaluate(request) if not summary else ():
        found.append(entries)
        shown.append(seen.sheet(entries, request))
        _print_notes(notes)
        if not quiet:
            typer.echo(("\n" if len(found) > 1 else "") + terminal.text(shown[-1]))
    table: list[SummaryRow] = []
    if summary or (request.everything and not as_json):
        table, notes = summaries.summary(request, found)
        shown.append(seen.of_makers(table))
        _print_notes(notes)
        if not quiet:
            typer.echo(("\n" if found else "") + terminal.text(shown[-1]))
    if as_sheet:
        typer.echo(json_text.as_json([sheets.document(one) for one in shown]))
    elif as_json:
        every = [entry for entries in found for entry in entries]
        typer.echo(json_text.as_json(summaries.document(table) if summary else documents.documents(every)))
    if report is not None:
        _write_report(request, found, report, quiet=quiet)
    if to is not None:
        from ballscrew.faces.sheets import pictures  # matplotlib is slow to import

        files.draw(lambda: pictures.picture(seen.picture(found, request)), to)
        typer.echo(f"{to}: {len(found)} sets", err=quiet)


def _print_notes(notes: Sequence[str]) -> None:
    for note in notes:
        typer.echo(note, err=True)


def _write_report(request: Request, entries: Sequence[Sequence[Entry]], report: Path, *, quiet: bool) -> None:
    """Write all of it as one paper."""
    from ballscrew.faces.report.files import written
    from ballscrew.faces.report.validation import report as report_of
    from ballscrew.questions.validate.summary import summary

    whole = report_of(request, entries, summary(request, entries)[0])
    typer.echo(f"{report}: report, {written('--report', report, whole) // 1000} kB", err=quiet)
