"""The command line. Each command says what it does in a few lines; the work is done elsewhere.

Scientific packages are imported inside the commands, so that ``ballscrew --help`` is instant.
"""

from __future__ import annotations

import contextlib
import errno
import io
import os
import sys
from collections.abc import Generator, Sequence
from pathlib import Path
from typing import Annotated, Any, NoReturn

import typer
from typer.core import TyperCommand

from ballscrew import _pint_plugins
from ballscrew.cli import catalogue, check, fit, report, sensitivity, serve, validate
from ballscrew.cli.common_options import AllowCode, Verbose, say_engine

app = typer.Typer(
    name="ballscrew",
    help="What a ball screw loses to friction: torque, efficiency, back-driving, and why, term by term.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)
app.add_typer(catalogue.app, name="catalogue")


class _Command(TyperCommand):
    """A command whose help names the models. Their source is slow to load: only when it is asked for."""

    def format_help(self, ctx: Any, formatter: Any) -> None:
        from ballscrew.cases.schema import DEFAULT_MODEL, MODELS

        models = ", ".join(f"{name} (default)" if name == DEFAULT_MODEL else name for name in MODELS)
        for parameter in self.params:
            text: str | None = getattr(parameter, "help", None)
            if text is not None:
                setattr(parameter, "help", text.replace(_MODELS, models))  # noqa: B010  (only options have one)
        super().format_help(ctx, formatter)


#: What stands for the names of the models in help texts.
_MODELS = "{models}"
CaseFile = Annotated[Path, typer.Argument(help="Case file (TOML); ballscrew catalogue show NAME --case makes one.")]
ModelName = Annotated[
    str | None,
    typer.Option("--model", metavar="NAME", help=f"{_MODELS}; wins over the file."),
]
Settings = Annotated[
    list[str] | None,
    typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set operation.axial_load="4 kN".'),
]


@app.command(cls=_Command)
def run(
    case: CaseFile,
    model: ModelName = None,
    settings: Settings = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    band: Annotated[
        bool, typer.Option("--band", help="How far off the results may be: uncertain inputs, and other laws.")
    ] = False,
    samples: Annotated[
        int | None, typer.Option("--samples", metavar="N", help="With --band: samples, 16384; of a whole nut 1024.")
    ] = None,
    level: Annotated[
        float | None, typer.Option("--level", metavar="SHARE", help="With --band: share in the band, 0.95.")
    ] = None,
    only_given: Annotated[
        bool, typer.Option("--only-given", help="With --band: only what the file says is uncertain.")
    ] = False,
    to: Annotated[
        Path | None, typer.Option("--to", "-o", metavar="FILE", help="With --band: also draw .png, .svg or .pdf.")
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """Friction at the operating point of a case file; with --band how far off it may be."""
    from ballscrew.cases import case_file

    loaded = case_file.load(case, settings or [], model, allow_code=allow_code)
    if band or to is not None or only_given or (samples, level) != (None, None):
        from ballscrew.cli import band as band_command
        from ballscrew.cli.progress import progress
        from ballscrew.studies.band import Options

        options = Options(samples, level, only_given)
        band_command.check(band, options, to)
        with progress("band") as done:
            band_command.run(loaded, options, to, as_json, done)
        return
    from ballscrew.output import json_text
    from ballscrew.output.documents.run import document
    from ballscrew.output.text.run import print_run
    from ballscrew.studies.run import run as run_case

    found = run_case(loaded)
    if as_json:
        typer.echo(json_text.as_json(document(found)))
    else:
        print_run(found)


@app.command(cls=_Command)
def compare(
    case: CaseFile,
    model: ModelName = None,
    settings: Settings = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object, SI units.")] = False,
    to: Annotated[
        Path | None,
        typer.Option("--to", "-o", metavar="FILE", help="Also draw a picture of the spread: .png, .svg or .pdf."),
    ] = None,
    allow_code: AllowCode = False,
) -> None:
    """All models and all laws side by side at the operating point of a case file.

    First the models as they are, then the model of the case with one law at a time in place of its
    own: torque, its parts, efficiency in both directions, and what lies outside its validity.
    """
    from ballscrew.cases import case_file
    from ballscrew.figures import files
    from ballscrew.output import json_text
    from ballscrew.output.documents import comparison as documents
    from ballscrew.output.text import comparison as text
    from ballscrew.studies.comparison import comparison

    loaded = case_file.load(case, settings or [], model, allow_code=allow_code)
    if to is not None:
        files.check_picture(to)
    compared = comparison(loaded)
    if as_json:
        typer.echo(json_text.as_json(documents.document(loaded, compared)))
    else:
        text.print_comparison(loaded, compared)
    if to is not None:
        from ballscrew.figures import comparison as figures  # matplotlib is slow to import

        files.draw(lambda: figures.picture(loaded, compared), to)
        typer.echo(f"{to}: {len(compared.rows)} models and laws", err=as_json)
    _say_constant_torque(loaded)


@app.command(cls=_Command)
def sweep(
    case: CaseFile,
    vary: Annotated[
        list[str] | None,
        typer.Option("--vary", metavar="FIELD=VALUES", help='Axis: axial_load="100:4000:14 N" or "100, 200 N".'),
    ] = None,
    output: Annotated[
        list[str] | None,
        typer.Option("--output", metavar="NAME", help="What to return, for example efficiency; may be repeated."),
    ] = None,
    to: Annotated[
        Path | None,
        typer.Option(
            "--to",
            "-o",
            metavar="FILE",
            help="Write .csv, .xlsx or .nc, or a folder .zarr of any size; without it, CSV on the terminal.",
        ),
    ] = None,
    scheduler: Annotated[
        str | None,
        typer.Option("--scheduler", metavar="ADDRESS", help="Fill a .zarr by the workers of a Dask scheduler."),
    ] = None,
    model: ModelName = None,
    settings: Settings = None,
    allow_code: AllowCode = False,
    verbose: Verbose = False,
) -> None:
    """Friction over ranges of load, speed or anything else.

    Without --vary, the axes come from the [sweep] table of the case file, or else are ten loads and
    ten speeds up to those of the case. One output over two axes comes as a table, load down and
    speed across, ready to paste; otherwise one row a point. A .zarr is filled block by block: stopped
    by whatever, the same command goes on where it was.
    """
    from ballscrew.cases import case_file
    from ballscrew.cli.progress import progress
    from ballscrew.output import sweep_files
    from ballscrew.output.text import sweep as text
    from ballscrew.studies import sweep as studies

    loaded = case_file.load(case, settings or [], model, allow_code=allow_code)
    plan = studies.plan(loaded, vary or [], output or [], to)
    with _stopped_in_words(), studies.workers(scheduler, to) as cluster, progress("sweep") as done:
        dataset = studies.sweep(loaded, plan, done, to, cluster)
    if verbose:
        say_engine(dataset.attrs)
    if to is None:
        sweep_files.write_csv(sys.stdout, dataset, plan)
    else:
        if not studies.is_store(to):
            sweep_files.write(dataset, plan, to)
        typer.echo(f"{to}: {text.size(dataset, plan)}, model {loaded.model.label}")
    if beware := text.warning(loaded, plan, dataset, to):
        typer.echo(beware, err=True)
    _say_constant_torque(loaded)


@app.command(cls=_Command)
def reproduce(
    paper: Annotated[str, typer.Argument(help="Which paper: olaru2005.")],
    out: Annotated[Path, typer.Option("--out", metavar="DIR", help="Folder for figures, data and claims.")],
) -> None:
    """The figures, the data and the claims of a paper, from its equations."""
    from ballscrew.errors import Fault, InputError, nearest

    if paper != "olaru2005":
        raise InputError(Fault("reproduce", "unknown paper", paper, nearest(paper, ["olaru2005"])))
    from ballscrew.cli.reproduction import reproduce_olaru2005

    written = reproduce_olaru2005(out, _step)
    typer.echo(f"{out}: {len(written)} files; read {out / 'claims.md'} first")


app.command(cls=_Command)(check.check)
app.command(cls=_Command)(fit.fit)
app.command(cls=_Command)(report.report)
app.command(cls=_Command)(sensitivity.sensitivity)
app.command(cls=_Command)(serve.serve)
app.command(cls=_Command)(validate.validate)


@app.command(cls=_Command)
def schema() -> None:
    """JSON Schema of a case file."""
    import json

    from ballscrew.cases.schema import json_schema

    typer.echo(json.dumps(json_schema(), indent=2, ensure_ascii=False))


@app.command(cls=_Command)
def cite(
    case: Annotated[Path | None, typer.Argument(help="Case file; without one, all sources.")] = None,
    model: ModelName = None,
    settings: Settings = None,
    allow_code: AllowCode = False,
) -> None:
    """BibTeX of the sources that a case makes use of."""
    from ballscrew.cases import case_file
    from ballscrew.references import bibliography

    entries = bibliography()
    keys = (
        list(entries)
        if case is None
        else case_file.references(case_file.load(case, settings or [], model, allow_code=allow_code))
    )
    typer.echo("\n\n".join(entries[key] for key in keys))


def _version(wanted: bool) -> None:
    if wanted:
        from ballscrew._version import __version__

        typer.echo(f"ballscrew {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """What a ball screw loses to friction: torque, efficiency, back-driving, and why, term by term."""


@contextlib.contextmanager
def _stopped_in_words() -> Generator[None]:
    """A sweep into a store that is stopped says in a line how far it came, and that it goes on from there."""
    try:
        yield
    except KeyboardInterrupt as error:
        for line in getattr(error, "__notes__", ()):
            typer.echo(line, err=True)
        raise  # the exit code is that of an interrupt
    except OSError as error:
        from ballscrew.sweeps.store import UnfinishedSweepError

        if not isinstance(error, UnfinishedSweepError):
            raise
        typer.echo(str(error), err=True)
        raise typer.Exit(1) from None


def _say_constant_torque(case: Any) -> None:
    """What a calibrated case has beside the torque of the balls."""
    from ballscrew.cases.descriptions import constant_torque

    for line in constant_torque(case):
        typer.echo(line, err=True)


def _step(what: str, done: int, total: int) -> None:
    """One line a step on the error stream."""
    typer.echo(f"[{done}/{total}] {what}", err=True)


def main() -> None:
    """Run a command; bad input ends with one line a fault and exit code 2, never with a traceback."""
    if sys.stdout is None:  # pyright: ignore[reportUnnecessaryComparison]  (started with >&-)
        _refuse(["stdout: is closed · leave out >&-, or write > /dev/null"])
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal that has no "·" still gets an answer
            stream.reconfigure(errors="backslashreplace")
    _pint_plugins.hidden_from_pint += ["dask", "scipy"]
    try:
        try:
            app()
        finally:
            sys.stdout.flush()
    except ValueError as error:
        from ballscrew.errors import InputError  # with NumPy: not for those who only ask for help

        if isinstance(error, InputError):
            _refuse(error.lines())
        _refuse_law(error)
    except OSError as error:
        if error.errno not in (errno.ENOSPC, errno.EIO, errno.EPIPE):
            raise  # not the output: a defect of ours, to be seen as one
        # nobody can read what we say on a full or closed output; keep Python from trying again at exit
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        _refuse([f"stdout: cannot be written ({error.strerror or error}) · choose another place"])
    except Exception as error:
        _refuse_law(error)


def _refuse_law(error: Exception) -> NoReturn:
    """One line for what a law from outside raised; anything else is a defect of ours, to be seen as one."""
    law = getattr(error, "raised_by_law", None)
    if law is None:
        raise error
    _refuse([f"{law} raised {type(error).__name__}: {error} · call it in Python to see where"])


def _refuse(lines: Sequence[str]) -> NoReturn:
    for line in lines:
        typer.echo(line, err=True)
    sys.exit(2)


if __name__ == "__main__":
    main()
