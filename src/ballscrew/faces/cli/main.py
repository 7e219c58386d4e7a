"""The application of the command line: the table of its commands, and how errors end.

Scientific packages are imported inside the commands, so that ``ballscrew --help`` is instant.
"""

from __future__ import annotations

import errno
import functools
import io
import os
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, NoReturn

import typer
from typer.core import TyperCommand, TyperGroup

from ballscrew.basis import pint_plugins
from ballscrew.faces.cli import INTERRUPTED, cases, choosing, lists, logs, questions, sharing
from ballscrew.faces.cli.options import with_flags
from ballscrew.questions.records import (
    AXIS,
    COMPARE,
    CONDITION,
    DUTY,
    OPTIMISE,
    REVERSAL,
    RIPPLE,
    SELECT,
    SENSITIVITY,
    SERVICE,
    WARM_UP,
)
from ballscrew.questions.shared.question import CALIBRATION_NAMES, MODEL_NAMES, Question


class _Command(TyperCommand):
    """A command whose help names models and calibrations.

    Ctrl-C ends it with a line on how far it came, what is kept and how to go on.

    Their source is slow to load: only when it is asked for.
    """

    def invoke(self, ctx: Any) -> Any:
        try:
            return super().invoke(ctx)
        except KeyboardInterrupt as error:
            for line in getattr(error, "__notes__", ["interrupted, nothing is kept · run the same again"]):
                typer.echo(line, err=True)
            raise typer.Exit(INTERRUPTED) from None

    def format_help(self, ctx: Any, formatter: Any) -> None:
        from ballscrew.cases.schema.case_schema import DEFAULT_MODEL, MODELS
        from ballscrew.physics.friction.calibrations import calibrations

        models = ", ".join(f"{name} (default)" if name == DEFAULT_MODEL else name for name in MODELS)
        for parameter in self.params:
            text: str | None = getattr(parameter, "help", None)
            if text is not None:
                text = text.replace(MODEL_NAMES, models).replace(CALIBRATION_NAMES, ", ".join(calibrations()))
                setattr(parameter, "help", text)  # noqa: B010  (only options have one)
        super().format_help(ctx, formatter)


#: The commands in the order of the help: questions, and functions of their own.
_COMMANDS: Sequence[Question | Callable[..., None]] = (
    cases.run,
    COMPARE,
    cases.sweep,
    lists.reproduce,
    cases.check,
    SELECT,
    OPTIMISE,
    logs.fit,
    sharing.hand_over,
    sharing.report,
    DUTY,
    AXIS,
    RIPPLE,
    WARM_UP,
    sharing.compensation,
    REVERSAL,
    SENSITIVITY,
    sharing.serve,
    sharing.site,
    SERVICE,
    CONDITION,
    logs.validate,
    lists.schema,
    lists.cite,
)


def _named(command: Question | Callable[..., None]) -> tuple[str, Callable[..., None]]:
    if isinstance(command, Question):
        return command.name, questions.command_of(command)
    return command.__name__.replace("_", "-"), command


#: The commands by their names.
COMMANDS: Mapping[str, Callable[..., None]] = {**dict(map(_named, _COMMANDS)), "list": lists.list_names}


class _Commands(TyperGroup):
    """Commands whose parameters are read for the one that is asked for: those of all take as long as all else."""

    def resolve_command(self, ctx: Any, args: list[str]) -> Any:
        name, command, others = super().resolve_command(ctx, args)
        function = COMMANDS.get(name or "")
        return name, command if name is None or function is None else typer_command(name, function), others


def typer_command(name: str, function: Callable[..., None]) -> Any:
    """A command with its parameters."""
    alone = typer.Typer(add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None)
    alone.command(name, cls=_Command)(with_flags(function))
    return typer.main.get_command(alone)


def _listed() -> None:
    """Stand for a command in the list of them."""


app = typer.Typer(
    name="ballscrew",
    cls=_Commands,
    help="Friction of ball screws, cause by cause: torque, efficiency, heat and back-driving, with band and range of "
    "validity.",
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    rich_markup_mode=None,
)
app.add_typer(choosing.catalogue, name="catalogue")
app.add_typer(lists.card, name="card")
app.add_typer(lists.oils, name="oils")
for _name, _function in COMMANDS.items():
    app.command(_name, help=_function.__doc__)(_listed)


def _version(wanted: bool) -> None:
    if wanted:
        from ballscrew.basis.version import __version__

        typer.echo(f"ballscrew {__version__}")
        raise typer.Exit


@app.callback()
def options(
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    """Friction of a ball screw: torque, efficiency, back-driving, and why, term by term."""


@functools.cache
def command_line() -> Any:
    """The commands with all their options, which take longer to make than most of them to run."""
    return typer.main.get_command(app)


def main() -> None:
    """Run a command; bad input ends with one line a fault and exit code 2, never with a traceback."""
    if sys.stdout is None:  # pyright: ignore[reportUnnecessaryComparison]  (started with >&-)
        _refuse(["stdout: is closed · leave out >&-, or write > /dev/null"])
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):  # a terminal that has no "·" still gets an answer
            stream.reconfigure(errors="backslashreplace")
    if not sys.warnoptions:  # -W and PYTHONWARNINGS ask for them
        warnings.simplefilter("ignore")  # those of libraries: what matters to people stands in the answer
    pint_plugins.hidden_from_pint += ["dask", "scipy"]
    if not any(word.startswith("--scheduler") for word in sys.argv):
        absent: Any = None  # as if it were not installed: xarray would load it, which takes seconds after a boot
        sys.modules.setdefault("dask", absent)
    try:
        try:
            command_line()()
        finally:
            sys.stdout.flush()
    except ValueError as error:
        from ballscrew.basis.errors import InputError  # with NumPy: not for those who only ask for help

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
