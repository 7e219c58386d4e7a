"""Commands made of questions (:mod:`ballscrew.questions.shared.question`)."""

from __future__ import annotations

import contextlib
import inspect
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any

import typer

from ballscrew.faces.cli.options import Output, file_option
from ballscrew.faces.cli.progress import print_notes_of_rows, progress
from ballscrew.questions.shared.question import CaseFile, CaseOptions, File, Question, Request


def command_of(question: Question) -> Callable[..., None]:
    """The command of a question, whose parameters follow from its record."""
    flag = question.files.flag or "to"

    def command(*, case_options: CaseOptions, output: Output, written: Mapping[str, Any], **given: Any) -> None:
        to = _paths(given[flag])
        read = {file.name: _paths(given[file.name]) for file in question.reads}
        cases = [CaseFile(path, case_options) for file in question.reads if file.is_case for path in read[file.name]]
        case = cases[0] if cases else None
        need = next((path for file in question.reads if file.is_need for path in read[file.name]), None)
        request = Request(files=read, case=case, need=need, case_options=case_options, written=written, to=to)
        work = question.answer.prepare(request)
        if work.files is None:
            _check_files(to, flag, question.own_kinds)  # last of the checks, as it makes folders
        with progress(work.name, work.cost) if work.name else contextlib.nullcontext(_no_bar) as done:
            answer = work.answer(done)
        files = dict.fromkeys(to, "") if work.files is None else work.files
        output.print_and_write(answer, files, f"--{flag}", question.own_kinds)
        print_notes_of_rows(answer.notes, answer.is_interrupted)

    command.__name__, command.__doc__ = question.name.replace("-", "_"), question.help
    setattr(command, "__signature__", inspect.Signature(_parameters(question)))  # noqa: B010  (functions have none)
    return command


def _no_bar(_finished: int, _total: int) -> None:
    """Show nothing of short work."""


def _paths(given: Any) -> Sequence[Path]:
    """The paths of a parameter, which has one, several or none."""
    return [] if given is None else given if isinstance(given, list) else [given]


def _check_files(paths: Sequence[Path], flag: str, own_kinds: Sequence[str]) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for files that could not be written later."""
    from ballscrew.faces.sheets import files
    from ballscrew.questions.shared.charts import check_picture

    if flag != "picture":
        files.check(paths, own_kinds)
        return
    for path in paths:
        check_picture(path, "--picture")


def _parameters(question: Question) -> Sequence[inspect.Parameter]:
    """The parameters of the command of a question, in the order of its help."""
    files = question.files
    kind = list[Path] | None if question.has_several_files else Path | None
    written = _parameter("written", Annotated[Mapping[str, Any], *question.options])
    to = file_option(files.meaning, files.flag or "to", files.short, files.metavar)
    shared = [
        _parameter("case_options", Annotated[CaseOptions, question.case_texts]),
        _parameter("output", Output),
        _parameter(files.flag or "to", Annotated[kind, to], None),
    ]
    reads = [_file(file) for file in question.reads]
    return [*reads, *shared, written] if question.has_options_last else [*reads, written, *shared]


def _file(file: File) -> inspect.Parameter:
    """The parameter for a file to read."""
    kind: Any = list[Path] if file.is_repeated else Path
    if file.is_flag:
        declared = typer.Option(f"--{file.name}", metavar=file.metavar, help=file.meaning)
    else:
        declared = typer.Argument(metavar=file.metavar or None, help=file.meaning)
    if file.is_optional:
        return _parameter(file.name, Annotated[kind | None, declared], None)
    return _parameter(file.name, Annotated[kind, declared])


def _parameter(name: str, annotation: Any, default: Any = inspect.Parameter.empty) -> inspect.Parameter:
    return inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)
