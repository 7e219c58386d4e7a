"""``ballscrew fit``: a log of torques in, a calibrated model out."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, NoReturn

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    CalibrationName,
    Inertia,
    KeepGoing,
    ModelName,
    Row,
    Rows,
    SelfHeatingOption,
    TorqueConstant,
    TorqueKind,
    Verbose,
    check_rows,
    say_engine,
)

if TYPE_CHECKING:
    from ballscrew.cases.case_files.case import Case
    from ballscrew.questions.fit.compute import FitReport
    from ballscrew.questions.fit.log import Options
    from ballscrew.questions.fit_motion.log import MovingOptions


def fit(
    case: Annotated[Path, typer.Option("--case", metavar="FILE", help="Case file (TOML) of screw, oil and model.")],
    log: Annotated[
        Path | None,
        typer.Argument(help="Log of load, speed and torque, perhaps temperature and time: .csv, .xlsx, .mat."),
    ] = None,
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
    kind: TorqueKind = None,
    column: Annotated[
        list[str] | None,
        typer.Option("--column", metavar="NAME=HEADING", help='A heading by hand: torque="M_ist [N m]".'),
    ] = None,
    torque_constant: TorqueConstant = None,
    inertia: Inertia = None,
    limits: Annotated[
        list[str] | None,
        typer.Option("--limits", metavar="NAME=LOW:HIGH", help='Of the next test: screw_speed="10:3000 rpm".'),
    ] = None,
    holdout: Annotated[
        float, typer.Option("--holdout", metavar="SHARE", help="Of the operating points, predicted and not fitted.")
    ] = 0.2,
    temperature_error: Annotated[
        str | None,
        typer.Option(
            "--temperature-error",
            metavar="VALUE",
            help='Of the oil in the whole log, half of 95 %: "2 K" (default where logged, else 10 K).',
        ),
    ] = None,
    seed: Annotated[int, typer.Option("--seed", metavar="N", help="Of what is held out.")] = 0,
    keep_going: KeepGoing = False,
    moving: Annotated[
        bool, typer.Option("--moving", help="The log is of a moving axis: time, position, force (found out otherwise).")
    ] = False,
    test: Annotated[
        Path | None,
        typer.Option("--test", metavar="FILE", help="Another log of the same axis, predicted and not fitted."),
    ] = None,
    gain: Annotated[
        str | None, typer.Option("--gain", metavar="VALUE", help='Of a control voltage of a moving log: "35 N/V".')
    ] = None,
    carried_mass: Annotated[
        str | None,
        typer.Option("--carried-mass", metavar="VALUE", help='That the nut of a moving log carries: "20 kg".'),
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
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
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
    self_heating: SelfHeatingOption = False,
    allow_code: AllowCode = False,
    verbose: Verbose = False,
) -> None:
    """Fit numbers of a model to a log, and say which of them the log cannot tell.

    A log of a moving axis (time, position, and a force, torque, current or control voltage) tells its mass, the
    gravity force, the dead time and the friction, by three models beside each other.

    With --rows each screw of a table is fitted by itself, to the file in its column log.

    A distribution that the case gives a number is its prior. Part of the operating points is held out
    to see how well the model predicts, beside two descriptions without physics. The last lines say where to
    measure next. With --self-heating each row of a log of friction torque without temperatures is as warm as its
    own torque makes it in the steady state.
    """
    from ballscrew.cases.case_files import case_file

    check_rows(rows, row)
    _check_log(log, rows, picture)
    if self_heating and rows is not None:
        _refuse_self_heating("is given beside --rows", "leave one of them out")
    written = _Written(
        free=free or [],
        bounds=bounds or [],
        limits=limits or [],
        columns=column or [],
        kind=kind,
        inertia=inertia,
        torque_constant=torque_constant,
        holdout=holdout,
        temperature_error=temperature_error,
        seed=seed,
        keep_going=keep_going,
    )
    if rows is not None:
        from ballscrew.faces.cli.fit_rows import fit_rows

        fit_rows(
            case, rows, row, written.options, settings=settings or [], model=model, calibration=calibration,
            allow_code=allow_code, keep_going=keep_going, as_json=as_json, to=to,
        )  # fmt: skip
        return
    assert log is not None
    tables = case_file.override(case_file.read(case), settings or [])
    loaded = case_file.build(tables, model, case.parent, calibration=calibration, allow_code=allow_code)

    # pandas is slow to import: only for a good case
    from ballscrew.questions.fit_motion.log import is_moving
    from ballscrew.questions.shared import chart_files as files

    if picture is not None:
        files.check_picture(picture, "--picture")
    shown = _Shown(as_json=as_json, to=to, picture=picture, verbose=verbose)
    if moving or test is not None or is_moving(log, written.columns):
        from ballscrew.faces.cli.fit_moving import fit_moving

        if self_heating:
            _refuse_self_heating("is not for a moving axis", "leave it out")
        options = written.moving_options(gain, carried_mass, to)
        fit_moving(loaded, log, test, options, as_json=as_json, picture=picture)
        return
    _fit_torques(_Read(case, tables, loaded), log, written, shown, self_heating=self_heating)


@dataclasses.dataclass(frozen=True)
class _Written:
    """The options of a fit as they are written: the numbers to fit, and how the log is read."""

    free: Sequence[str]
    bounds: Sequence[str]
    limits: Sequence[str]
    columns: Sequence[str]
    kind: str | None
    inertia: str | None
    torque_constant: str | None
    holdout: float
    temperature_error: str | None
    seed: int
    keep_going: bool

    def options(self, case: Case) -> Options:
        """Those of a log of torques, as numbers in SI."""
        from ballscrew.questions.fit.options import options

        return options(
            case, free=self.free, bounds=self.bounds, limits=self.limits, columns=self.columns, kind=self.kind,
            inertia=self.inertia, torque_constant=self.torque_constant, holdout=self.holdout,
            temperature_error=self.temperature_error, seed=self.seed, keep_going=self.keep_going,
        )  # fmt: skip

    def moving_options(self, gain: str | None, carried_mass: str | None, to: Path | None) -> MovingOptions:
        """Those of a log of a moving axis, which takes no other."""
        from ballscrew.questions.fit_motion.options import moving_options

        unused = {
            "--bounds": bool(self.bounds), "--limits": bool(self.limits), "--kind": self.kind is not None,
            "--inertia": self.inertia is not None, "--to": to is not None,
            "--temperature-error": self.temperature_error is not None,
        }  # fmt: skip
        return moving_options(
            free=self.free, columns=self.columns, torque_constant=self.torque_constant, gain=gain,
            carried_mass=carried_mass, seed=self.seed, keep_going=self.keep_going, unused=unused,
        )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class _Read:
    """A case file, its tables with the settings of the command line, and the case."""

    path: Path
    tables: Mapping[str, Any]
    case: Case


@dataclasses.dataclass(frozen=True)
class _Shown:
    """How a fit is shown, and the files that are written of it."""

    as_json: bool
    to: Path | None
    picture: Path | None
    verbose: bool


def _fit_torques(read: _Read, log: Path, written: _Written, shown: _Shown, *, self_heating: bool) -> None:
    """Fit a case to a log of torques, print what is found, and write the files asked for."""
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.fit.log import steady_log
    from ballscrew.questions.fit.options import check_to

    if shown.to is not None:
        check_to(shown.to, read.path)
    chosen = written.options(read.case)
    with progress("fit") as done:
        steady = steady_log(read.case, log, chosen, done)
        # solvers are slow to import: only for a log that can be fitted to
        from ballscrew.questions.fit import compute

        assumed: Sequence[str] = ()
        if self_heating:
            from ballscrew.questions.fit.warm_log import warm_log

            steady, assumed = warm_log(read.case, steady, chosen.kind)
        report = dataclasses.replace(compute.fit(read.case, steady, chosen), assumed=assumed)
    _show(read, report, shown)


def _show(read: _Read, report: FitReport, shown: _Shown) -> None:
    """Print a fit, and write its files."""
    from ballscrew.basis.output.json_text import as_json as json_text
    from ballscrew.cases.case_files import fitted_case
    from ballscrew.questions.fit import document as documents
    from ballscrew.questions.fit import text
    from ballscrew.questions.shared import chart_files as files

    if shown.verbose:
        say_engine(report.model.response.evaluation.attributes)
    if shown.as_json:
        typer.echo(json_text(documents.document(read.case, report)))
    else:
        text.print_fit(read.case, report)
    if shown.to is not None:
        fitted_case.save(shown.to, read.tables, read.path.parent, read.case, report.model)
        typer.echo(f"{shown.to}: the calibrated model", err=shown.as_json)
    if shown.picture is not None:
        from ballscrew.questions.fit import figure as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(read.case, report), shown.picture, "--picture")
        typer.echo(f"{shown.picture}: {len(report.model.rows.log)} rows", err=shown.as_json)


def _refuse_self_heating(problem: str, remedy: str) -> NoReturn:
    from ballscrew.basis.errors import Fault, InputError

    raise InputError(Fault("--self-heating", problem, "", remedy))


def _check_log(log: Path | None, rows: Path | None, picture: Path | None) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` unless there is one log, or a table that names them."""
    from ballscrew.basis.errors import Fault, InputError, raise_if_any

    if log is None and rows is None:
        raise InputError(Fault("fit", "needs a log", "", "give a file, or --rows FILE with a column log"))
    given = {"LOG": log, "--picture": picture}
    raise_if_any(
        [
            Fault(name, "does not go with --rows", str(path), "leave it out; the column log names the logs")
            for name, path in given.items()
            if path is not None and rows is not None
        ]
    )
