"""``ballscrew compare``: all models and laws side by side, or several designs."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsJson,
    AsSheet,
    CalibrationName,
    ModelName,
    SelfHeatingOption,
    Settings,
    print_answer,
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
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None,
        typer.Option(
            "--to", "-o", metavar="FILE", help="Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf)."
        ),
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
    from ballscrew.cases.case_files import case_file
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.compare import answer as documents
    from ballscrew.questions.compare.compute import comparison
    from ballscrew.questions.compare.sheet import sheet
    from ballscrew.questions.compare_designs import compute as documents_of_designs
    from ballscrew.questions.compare_designs.compute import is_one_case, side_by_side
    from ballscrew.questions.compare_designs.sheet import sheet as sheet_of_designs
    from ballscrew.questions.warm_up.self_heating_document import with_self_heating

    changes: dict[str, Any] = {"model": model, "calibration": calibration, "allow_code": allow_code}
    to_file.check([] if to is None else [to])
    if is_one_case(cases):
        if own:
            raise InputError(Fault("--own", "is for several designs", "", "name several case files, or a project"))
        loaded = case_file.load(cases[0], settings or [], **changes)
        heating = None
        if self_heating:
            from ballscrew.questions.warm_up import self_heating as studies

            heating = studies.self_heating(loaded)
            loaded = heating.warm
        compared = comparison(loaded)
        seen = sheet(loaded, compared, () if heating is None else heating.records)
        document = functools.partial(with_self_heating, documents.document(loaded, compared), heating)
        counted = f"{len(compared.rows)} models and laws"
    else:
        if self_heating:
            raise InputError(Fault("--self-heating", "is for one case", "", "compare one design alone"))
        designs = side_by_side(cases, own=own, settings=settings or [], **changes)
        seen = sheet_of_designs(designs)
        document = functools.partial(documents_of_designs.document, designs)
        counted = f"{len(designs.designs)} designs"
    print_answer(seen, document, as_json=as_json, as_sheet=as_sheet)
    if to is not None:
        to_file.write(to, seen)
        typer.echo(f"{to}: {counted}", err=as_json or as_sheet)
