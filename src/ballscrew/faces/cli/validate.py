"""``ballscrew validate``: the model against vendors and laboratories."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


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
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.validate import compute as validation
    from ballscrew.questions.validate import document as documents
    from ballscrew.questions.validate import summary as summaries
    from ballscrew.questions.validate import text

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
    for note in request.notes:
        typer.echo(note, err=True)
    found = []
    for entries, notes in validation.evaluate(request) if not summary else ():
        found.append(entries)
        for note in notes:
            typer.echo(note, err=True)
        if not as_json:
            typer.echo(("\n" if len(found) > 1 else "") + text.text_of(entries, request))
    if summary or (request.everything and not as_json):
        table, notes = summaries.summary(request, found)
        for note in notes:
            typer.echo(note, err=True)
        if found:
            typer.echo("")
        typer.echo(json_text.as_json(summaries.document(table)) if as_json else summaries.text_of(table))
    elif as_json:
        typer.echo(json_text.as_json(documents.documents([entry for entries in found for entry in entries])))
    if report is not None:
        from ballscrew.faces.report.files import written
        from ballscrew.questions.validate.report import report as report_of

        whole = report_of(request, found, summaries.summary(request, found)[0])
        typer.echo(f"{report}: report, {written('--report', report, whole) // 1000} kB", err=as_json)
    if to is not None:
        from ballscrew.questions.validate import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(found, request), to)
        typer.echo(f"{to}: {len(found)} sets", err=as_json)
