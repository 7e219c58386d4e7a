"""``ballscrew select``: every row, nut, preload and oil against a need."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.common_options import (
    AllowCode,
    AsSheet,
    CalibrationName,
    KeepGoing,
    ModelName,
    print_answer,
    say_of_rows,
)
from ballscrew.faces.cli.flags import flags_of
from ballscrew.questions.select.options import ListOptions, SelectOptions

if TYPE_CHECKING:
    from ballscrew.basis.errors import InputError
    from ballscrew.basis.output.sheet import Sheet
    from ballscrew.questions.select.compute import Ranked, Selection

_TO = "--to"
#: The kind of a case file.
_CASE = ".toml"
Need = Annotated[
    Path, typer.Argument(metavar="NEED", help="File (TOML) of what the screw has to do; a case file will do.")
]


@flags_of(SelectOptions, ListOptions)
def select(
    need: Need,
    rows: Annotated[
        Path | None,
        typer.Option(
            "--rows", metavar="FILE", help="A table of screws of your own, .csv or .xlsx, in place of the catalogue."
        ),
    ] = None,
    *,
    written: Mapping[str, Any],
    model: ModelName = None,
    calibration: CalibrationName = None,
    settings: Annotated[
        list[str] | None,
        typer.Option("--set", metavar="SECTION.FIELD=VALUE", help='Change a value: --set need.feed="20 m/min".'),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="One JSON object with all candidates, SI units.")] = False,
    as_sheet: AsSheet = False,
    to: Annotated[
        list[Path] | None,
        typer.Option(
            _TO,
            "-o",
            metavar="FILE",
            help="Also write a table (.csv, .xlsx), a picture (.png, .svg, .pdf) or a candidate's case (.toml); may be "
            "repeated.",
        ),
    ] = None,
    keep_going: KeepGoing = False,
    allow_code: AllowCode = False,
) -> None:
    """Rank the screws of the catalogue for a need. Each row counts with its nut, preloads and oils.

    Each candidate is judged by the full model and all checks, but for those that their loads alone rule out. The
    exit code is 0 where none holds, too: the list says what fails, and by how much. With --to FILE.toml the case of one
    candidate is written, with all tables of the need, for duty, axis, warm-up, run and report.
    """
    from ballscrew.faces.cli.progress import progress
    from ballscrew.questions.select import answer as documents
    from ballscrew.questions.select.compute import plan
    from ballscrew.questions.select.compute import select as selected
    from ballscrew.questions.select.sheet import cost, sheet
    from ballscrew.questions.shared.option_values import read

    options, listed = read(SelectOptions, written), read(ListOptions, written)
    _check_rank(to or [], listed.rank)
    check_spared(to or [], need, *([] if rows is None else [rows]), settings=settings or [])
    words = options.words or None
    planned = plan(need, rows=rows, words=words, settings=settings or [], keep_going=keep_going)
    if listed.rank is not None and listed.rank > planned.candidates:
        raise _no_such_rank(listed.rank, planned.candidates)
    for path in to or []:  # last, as it makes folders
        check_file(path, _CASE)
    with progress("candidates", cost(planned)) as done:
        found = selected(
            need,
            rows=rows,
            words=words,
            objectives=objectives_of(listed.objectives),
            settings=settings or [],
            model=model,
            calibration=calibration,
            allow_code=allow_code,
            keep_going=keep_going,
            complete=options.complete,
            done=done,
        )
    kept = [
        each for each in found.ranked if (each.candidate.fits or not listed.holds) and (each.pareto or not listed.front)
    ]

    def document() -> dict[str, Any]:
        whole, ranks = documents.document(found), {each.rank for each in kept}
        return {**whole, "candidates": [each for each in whole["candidates"] if each["rank"] in ranks]}

    seen = sheet(found, kept, listed.first)
    print_answer(seen, document, as_json=as_json, as_sheet=as_sheet)
    for path in sorted(to or [], key=_is_case):  # a case that is missing keeps no table back
        said = _written(path, found, kept, listed.rank, seen)
        typer.echo(f"{path}: {said}", err=True)
    say_of_rows(found.notes, found.interrupted)


def _is_case(path: Path) -> bool:
    return path.suffix.lower() == _CASE


def _check_rank(to: Sequence[Path], rank: int | None) -> None:
    from ballscrew.basis.errors import Fault, InputError

    if rank is not None and not any(map(_is_case, to)):
        raise InputError(Fault("--rank", "names no file", str(rank), "add --to axis.toml"))


def _written(path: Path, found: Selection, kept: Sequence[Ranked], rank: int | None, seen: Sheet) -> str:
    """Write a file of a selection, and return what is in it."""
    if not _is_case(path):
        from ballscrew.faces.sheets import to_file

        to_file.write(path, seen, option=_TO)
        return f"{len(kept)} candidates"
    from ballscrew.questions.select import case_text
    from ballscrew.questions.select.answer import verdict

    chosen = _chosen(path, found, kept, rank)
    text = verdict(chosen.candidate)
    case_text.save(path, found, chosen, text)
    return f"{chosen.candidate.variant.label}, rank {chosen.rank}: {text}"


def _chosen(path: Path, found: Selection, kept: Sequence[Ranked], rank: int | None) -> Ranked:
    """The candidate of a rank, or the first of those that are listed."""
    from ballscrew.basis.errors import Fault, InputError

    listed = kept if rank is None else [each for each in found.ranked if each.rank == rank]
    if listed:
        return listed[0]
    if rank is None:
        raise InputError(Fault(_TO, "there is no candidate to write", str(path), "leave out --holds and --front"))
    raise _no_such_rank(rank, len(found.ranked))


def _no_such_rank(rank: int, candidates: int) -> InputError:
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.records import Message

    remedy = Message("there are {candidates}", {"candidates": str(candidates)})
    return InputError(Fault("--rank", "there is no such candidate", str(rank), remedy))


def objectives_of(written: Sequence[str]) -> list[str] | None:
    """The names of objectives, also of those written with a dash; None for those of the need."""
    return [name.replace("-", "_") for name in written] or None


def check_spared(to: Sequence[Path], need: Path, *others: Path, settings: Sequence[str] = ()) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a file that would be written over one that is read.

    These are the need, whatever file it names, and ``others``.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.cases.case_files import case_file, project

    if not any(path.exists() for path in to):
        return
    need_file = project.file_of(need)
    named = [need_file.parent / name for name in _texts(case_file.override(case_file.read(need), settings))]
    for path in to:
        if not path.exists():
            continue
        if _is_same(path, need_file):
            raise InputError(Fault(_TO, "is the file of the need", str(path), "choose another name"))
        if any(_is_same(path, one) for one in (*others, *named)):
            raise InputError(Fault(_TO, "is a file that is read", str(path), "choose another name"))


def _texts(value: Any) -> Iterator[str]:
    """All texts in tables: any of them may name a file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from _texts(item)
    elif isinstance(value, list):
        for item in value:
            yield from _texts(item)


def _is_same(path: Path, other: Path) -> bool:
    try:
        return path.samefile(other)
    except (OSError, ValueError):  # no such file, or no name of one
        return False


def check_file(path: Path, *others: str) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later.

    ``others`` are kinds of files that a command writes beside tables and pictures.
    """
    from ballscrew.basis.atomic_files import check_writable
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.basis.records import Message
    from ballscrew.questions.shared import row_tables
    from ballscrew.questions.shared.chart_files import SUFFIXES, check_picture

    known = (*row_tables.KINDS, *SUFFIXES, *others)
    if path.suffix.lower() not in known:
        raise InputError(
            Fault(_TO, "unknown kind of file", str(path), Message("end it in {names}", {"names": ", ".join(known)}))
        )
    if path.suffix.lower() in others:
        check_writable(_TO, path)
    elif path.suffix.lower() in row_tables.KINDS:
        row_tables.check_path(path)
    else:
        check_picture(path)
