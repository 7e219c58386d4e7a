"""``ballscrew compare``: all models and laws side by side, or several designs."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsJson,
    CalibrationName,
    ModelName,
    SelfHeatingOption,
    Settings,
)


def compare(
    cases: Annotated[
        list[Path],
        typer.Argument(metavar="CASE...", help="Case file (TOML); or several, or a project, for designs side by side."),
    ],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Settings = None,
    as_json: AsJson = False,
    to: Annotated[
        Path | None,
        typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture of the spread: .png, .svg or .pdf."),
    ] = None,
    self_heating: SelfHeatingOption = False,
    own: Annotated[
        bool,
        typer.Option("--own", help="Of several designs: each at its own load and speed, not at those of the first."),
    ] = False,
    allow_code: AllowCode = False,
) -> None:
    """Models and laws side by side, or several designs.

    Of several case files, or of a project file, each design is run and checked, and changes are against the first;
    project.toml#name is one design of it, as for all commands. Of one case it is as follows.

    First the models as they are, then the model of the case with one law at a time in place of its
    own: torque, its parts, efficiency in both directions, and what lies outside its validity. With
    --self-heating all at the oil and preload in which the model of the case ends.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.output import json_text
    from ballscrew.basis.output.wrapping import wrapped
    from ballscrew.cases.case_files import case_file
    from ballscrew.questions.compare import document as documents
    from ballscrew.questions.compare import text
    from ballscrew.questions.compare.compute import comparison
    from ballscrew.questions.compare_designs.compute import is_one_case
    from ballscrew.questions.shared import chart_files as files
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    if to is not None:
        files.check_picture(to)
    if not is_one_case(cases):
        _designs(cases, settings or [], model, calibration, as_json, to, self_heating, own, allow_code)
        return
    if own:
        raise InputError(Fault("--own", "is for several designs", "", "name several case files, or a project"))
    loaded = case_file.load(cases[0], settings or [], model, calibration=calibration, allow_code=allow_code)
    heating = None
    if self_heating:
        from ballscrew.questions.warm_up import self_heating as studies

        heating = studies.self_heating(loaded)
        loaded = heating.warm
    compared = comparison(loaded)
    if as_json:
        typer.echo(json_text.as_json(with_self_heating(documents.document(loaded, compared), heating)))
    else:
        if heating is not None:
            typer.echo("\n".join(wrapped(record.text) for record in heating.records))
        text.print_comparison(loaded, compared)
    if to is not None:
        from ballscrew.questions.compare import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, compared), to)
        typer.echo(f"{to}: {len(compared.rows)} models and laws", err=as_json)


def _designs(
    paths: list[Path],
    settings: list[str],
    model: str | None,
    calibration: str | None,
    as_json: bool,
    to: Path | None,
    self_heating: bool,
    own: bool,
    allow_code: bool,
) -> None:
    """Several designs side by side."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.output import json_text
    from ballscrew.questions.compare_designs import document as documents
    from ballscrew.questions.compare_designs import text
    from ballscrew.questions.compare_designs.compute import side_by_side

    if self_heating:
        raise InputError(Fault("--self-heating", "is for one case", "", "compare one design alone"))
    found = side_by_side(paths, own=own, settings=settings, model=model, calibration=calibration, allow_code=allow_code)
    typer.echo(json_text.as_json(documents.document(found)) if as_json else text.text(found))
    if to is not None:
        from ballscrew.questions.compare_designs.figure import DesignBar, picture
        from ballscrew.questions.shared import chart_files as files  # matplotlib is slow to import

        bars = [
            DesignBar(one.name, {name: float(part) for name, part in one.run.friction.contributions.items()}, 0.0, 0.0)
            for one in found.designs
        ]
        files.draw(lambda: picture(bars), to)
        typer.echo(f"{to}: {len(bars)} designs", err=as_json)
