"""``ballscrew fit``: a log in, a calibrated model out.

Three questions have this command: a log of torques, a log of a moving axis, and the logs of the screws of a table.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsJson,
    AsSheet,
    CalibrationName,
    ModelName,
    Row,
    Rows,
    Verbose,
    check_rows,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.fit.options import FitOptions
from ballscrew.questions.fit_motion.options import FitMotionOptions


@flags_of(FitOptions, FitMotionOptions)
def fit(
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, oil and model.")],
    log: Annotated[
        Path | None,
        typer.Argument(help="Log of load, speed and torque, perhaps temperature and time: .csv, .xlsx, .mat."),
    ] = None,
    *,
    written: Mapping[str, Any],
    moving: Annotated[
        bool,
        typer.Option(
            "--moving",
            help="The log is of a moving axis: time, position, force (recognised by its columns if left out).",
        ),
    ] = False,
    test: Annotated[
        Path | None,
        typer.Option("--test", metavar="FILE", help="Another log of the same axis, predicted and not fitted."),
    ] = None,
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option(
            "--set",
            metavar="SECTION.FIELD=VALUE",
            help='Change a value, or give a prior: --set model.friction.boundary_friction_coefficient="0.12 ± 0.03".',
        ),
    ] = None,
    as_json: AsJson = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        Path | None,
        typer.Option(
            "--to",
            "-o",
            metavar="FILE",
            help="Write the calibrated model, a case file (.toml); with --rows a table (.csv, .xlsx), or a folder.",
        ),
    ] = None,
    picture: Annotated[
        Path | None,
        typer.Option("--picture", metavar="FILE", help="Draw log and model: .png, .svg or .pdf."),
    ] = None,
    rows: Rows = None,
    row: Row = None,
    allow_code: AllowCode = False,
    verbose: Verbose = False,
) -> None:
    """Fit numbers of a model to a log. The output says which of them the log does not determine.

    A log of a moving axis (time, position, and a force, torque, current or control voltage) determines its mass, the
    gravity force, the dead time and the friction, by three models side by side.

    With --rows each screw of a table is fitted by itself, to the file in its column log.

    A distribution that the case gives a number is its prior. Part of the operating points is held out
    to see how well the model predicts, beside two descriptions without physics. The last lines say where to
    measure next. With --self-heating each row of a log of friction torque without temperatures is as warm as its
    own torque makes it in the steady state.
    """
    from ballscrew.cases.case_files import case_file

    check_rows(rows, row)
    _check_log(log, rows, picture, self_heating=written["self_heating"])
    if rows is not None:
        from ballscrew.faces.cli.fit_rows import fit_rows

        fit_rows(
            case,
            rows,
            row,
            written,
            settings=settings or [],
            model=model,
            calibration=calibration,
            allow_code=allow_code,
            as_json=as_json,
            as_sheet=as_sheet,
            to=to,
        )
        return
    assert log is not None
    tables = case_file.override(case_file.read(case), settings or [])
    loaded = case_file.build(tables, model, case.parent, calibration=calibration, allow_code=allow_code)

    # pandas is slow to import: only for a good case
    from ballscrew.questions.fit_motion.log import is_moving
    from ballscrew.questions.shared import chart_files as files

    if picture is not None:
        files.check_picture(picture, "--picture")
    if moving or test is not None or is_moving(log, written["columns"] or []):
        from ballscrew.faces.cli.fit_moving import fit_moving

        fit_moving(loaded, log, test, written, as_json=as_json, as_sheet=as_sheet, to=to, picture=picture)
    else:
        from ballscrew.faces.cli.fit_torques import Shown, fit_torques

        shown = Shown(as_json=as_json, as_sheet=as_sheet, to=to, picture=picture, verbose=verbose)
        fit_torques(case, tables, loaded, log, written, shown)


def _check_log(log: Path | None, rows: Path | None, picture: Path | None, *, self_heating: bool) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` unless there is one log, or a table that names them."""
    from ballscrew.basis.errors import Fault, InputError, raise_if_any

    if log is None and rows is None:
        raise InputError(Fault("fit", "needs a log", "", "give a file, or --rows FILE with a column log"))
    if rows is None:
        return
    beside = {"LOG": log, "--picture": picture}
    raise_if_any(
        [
            Fault(name, "does not go with --rows", str(path), "leave it out; the column log names the logs")
            for name, path in beside.items()
            if path is not None
        ]
    )
    if self_heating:
        raise InputError(Fault("--self-heating", "is given beside --rows", "", "leave one of them out"))
