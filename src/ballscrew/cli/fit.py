"""``ballscrew fit``: a log of torques in, a calibrated model out. The work is done in ``interfaces/fitting``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def fit(
    log: Annotated[
        Path,
        typer.Argument(help="Log of load, speed and torque, perhaps temperature and time: .csv, .xlsx, .mat."),
    ],
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, oil and model.")],
    free: Annotated[
        list[str] | None,
        typer.Option(
            "--free",
            metavar="NAMES",
            help="What to fit, with commas: boundary_friction_coefficient (default), constant_torque, any other input.",
        ),
    ] = None,
    bounds: Annotated[
        list[str] | None,
        typer.Option("--bounds", metavar="NAME=LOW:HIGH", help='boundary_friction_coefficient="0.05:0.2".'),
    ] = None,
    kind: Annotated[
        str | None,
        typer.Option("--kind", metavar="KIND", help="Of torque: friction or drive; if left out, the model tells."),
    ] = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help='A heading by hand: torque="M_ist [N m]".'),
    ] = None,
    torque_constant: Annotated[
        str | None, typer.Option("--torque-constant", metavar="VALUE", help='Of a motor current: "0.5 N m/A".')
    ] = None,
    inertia: Annotated[
        str | None,
        typer.Option("--inertia", metavar="VALUE", help='What the torque accelerates, at the screw: "2e-3 kg m^2".'),
    ] = None,
    limits: Annotated[
        list[str] | None,
        typer.Option("--limits", metavar="NAME=LOW:HIGH", help='Of the next test: screw_speed="10:3000 rpm".'),
    ] = None,
    holdout: Annotated[
        float, typer.Option("--holdout", metavar="SHARE", help="Of the operating points, predicted and not fitted.")
    ] = 0.2,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Of what is held out.")] = 0,
    keep_going: Annotated[bool, typer.Option("--keep-going", help="Leave faulty rows out, and say how many.")] = False,
    model: Annotated[str | None, typer.Option("--model", metavar="NAME", help="{models}; wins over the file.")] = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="SECTION.FIELD=VALUE",
            help='Change a value, or give a prior: --set model.friction.boundary_friction_coefficient="0.12 ± 0.03".',
        ),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="Write the calibrated model, a case file (.toml).")
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw log and model: .png, .svg or .pdf."),
    ] = None,
) -> None:
    """Fit numbers of a model to a log, and say which of them the log cannot tell.

    A distribution that the case gives a number is its prior. Part of the operating points is held out
    to see how well the model predicts, beside two descriptions without physics. The last lines say where to
    measure next.
    """
    from ballscrew.interfaces import comparison, config, fit_report, fitted_case, fitting
    from ballscrew.interfaces.files import check_writable
    from ballscrew.interfaces.progress import progress

    tables = config.override(config.read(case), settings or [])
    loaded = config.build(tables, model, case.parent)
    asked = fitting.Asked(
        free or [], bounds or [], limits or [], column or [], kind, inertia, torque_constant, holdout, seed, keep_going
    )
    if to is not None:
        fitted_case.check(to, case)
        check_writable("--to", to)
    if picture is not None:
        comparison.check_picture(picture, "--picture")
    with progress("fit") as done:
        found = fitting.fitted(loaded, log, asked, done)
    if as_json:
        typer.echo(fitting.json_text(loaded, found))
    else:
        fit_report.print_fit(loaded, found)
    if to is not None:
        fitted_case.save(to, tables, case.parent, loaded, found.model)
        typer.echo(f"{to}: the calibrated model", err=as_json)
    if picture is not None:
        fit_report.draw(loaded, found, picture)
        typer.echo(f"{picture}: {len(found.model.rows.log)} rows", err=as_json)
