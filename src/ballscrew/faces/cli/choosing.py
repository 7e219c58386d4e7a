"""Commands that choose screws for a need: select, optimise, and the rows of catalogues."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from ballscrew.faces.cli.options import AsJson, KeepGoing, Output, file_option, print_answer
from ballscrew.faces.cli.progress import print_notes_of_rows, progress
from ballscrew.questions.optimise.options import OptimiseOptions
from ballscrew.questions.select.options import ListOptions, SelectOptions
from ballscrew.questions.shared.question import CaseOptions

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


def select(
    need: Need,
    rows: Annotated[
        Path | None,
        typer.Option(
            "--rows", metavar="FILE", help="A table of screws of your own, .csv or .xlsx, in place of the catalogue."
        ),
    ] = None,
    *,
    options: SelectOptions,
    listed: ListOptions,
    case_options: Annotated[CaseOptions, {"settings": 'Change a value: --set need.feed="20 m/min".'}],
    output: Annotated[Output, {"as_json": "One JSON object with all candidates, SI units."}],
    to: Annotated[
        list[Path] | None,
        file_option(
            "Also write a table (.csv, .xlsx), a picture (.png, .svg, .pdf) or a candidate's case (.toml); may be "
            "repeated."
        ),
    ] = None,
    keep_going: KeepGoing = False,
) -> None:
    """Rank the screws of the catalogue for a need. Each row counts with its nut, preloads and oils.

    Each candidate is judged by the full model and all checks, but for those that their loads alone rule out. The
    exit code is 0 where none holds, too: the list says what fails, and by how much. With --to FILE.toml the case of one
    candidate is written, with all tables of the need, for duty, axis, warm-up, run and report.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.select import answer as documents
    from ballscrew.questions.select.compute import plan
    from ballscrew.questions.select.compute import select as select_screws
    from ballscrew.questions.select.sheet import cost, sheet

    if listed.rank is not None and not any(map(_is_case, to or [])):
        raise InputError(Fault("--rank", "names no file", str(listed.rank), "add --to axis.toml"))
    _refuse_overwriting(to or [], need, *([] if rows is None else [rows]), settings=case_options.settings)
    words = options.words or None
    planned = plan(need, rows=rows, words=words, settings=case_options.settings, keep_going=keep_going)
    if listed.rank is not None and listed.rank > planned.candidates:
        raise _no_such_rank(listed.rank, planned.candidates)
    for path in to or []:  # last, as it makes folders
        _check_file(path, _CASE)
    with progress("candidates", cost(planned)) as done:
        selection = select_screws(
            need,
            rows=rows,
            words=words,
            objectives=_objectives(listed.objectives),
            **vars(case_options),
            keep_going=keep_going,
            complete=options.complete,
            done=done,
        )
    shown = [
        each
        for each in selection.ranked
        if (each.candidate.fits or not listed.holds) and (each.pareto or not listed.front)
    ]

    def document() -> dict[str, Any]:
        whole, ranks = documents.document(selection), {each.rank for each in shown}
        return {**whole, "candidates": [each for each in whole["candidates"] if each["rank"] in ranks]}

    answer_sheet = sheet(selection, shown, listed.first)
    output.print(answer_sheet, document)
    for path in sorted(to or [], key=_is_case):  # a case that is missing keeps no table back
        content = _write(path, selection, shown, listed.rank, answer_sheet)
        typer.echo(f"{path}: {content}", err=True)
    print_notes_of_rows(selection.notes, selection.interrupted)


def _is_case(path: Path) -> bool:
    return path.suffix.lower() == _CASE


def _write(path: Path, selection: Selection, shown: Sequence[Ranked], rank: int | None, sheet: Sheet) -> str:
    """Write a file of a selection, and return what is in it."""
    if not _is_case(path):
        from ballscrew.faces.sheets import to_file

        to_file.write(path, sheet, option=_TO)
        return f"{len(shown)} candidates"
    from ballscrew.questions.select import case_text
    from ballscrew.questions.select.answer import verdict

    chosen = _chosen(path, selection, shown, rank)
    text = verdict(chosen.candidate)
    case_text.save(path, selection, chosen, text)
    return f"{chosen.candidate.variant.label}, rank {chosen.rank}: {text}"


def _chosen(path: Path, selection: Selection, shown: Sequence[Ranked], rank: int | None) -> Ranked:
    """The candidate of a rank, or the first of those that are shown."""
    from ballscrew.basis.errors import Fault, InputError

    candidates = shown if rank is None else [each for each in selection.ranked if each.rank == rank]
    if candidates:
        return candidates[0]
    if rank is None:
        raise InputError(Fault(_TO, "there is no candidate to write", str(path), "leave out --holds and --front"))
    raise _no_such_rank(rank, len(selection.ranked))


def _no_such_rank(rank: int, candidates: int) -> InputError:
    from ballscrew.basis.errors import Fault, InputError

    remedy = f"there are {candidates}"
    return InputError(Fault("--rank", "there is no such candidate", str(rank), remedy))


def _objectives(written: Sequence[str]) -> list[str] | None:
    """The names of objectives, also of those written with a dash; None for those of the need."""
    return [name.replace("-", "_") for name in written] or None


def _refuse_overwriting(to: Sequence[Path], need: Path, *others: Path, settings: Sequence[str] = ()) -> None:
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
        if any(_is_same(path, other) for other in (*others, *named)):
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


def _check_file(path: Path, *others: str) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` now for a file that could not be written later.

    ``others`` are kinds of files that a command writes beside tables and pictures.
    """
    from ballscrew.basis.atomic_files import check_writable
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.shared import row_tables
    from ballscrew.questions.shared.chart_files import SUFFIXES, check_picture

    known = (*row_tables.KINDS, *SUFFIXES, *others)
    if path.suffix.lower() not in known:
        raise InputError(Fault(_TO, "unknown kind of file", str(path), f"end it in {', '.join(known)}"))
    if path.suffix.lower() in others:
        check_writable(_TO, path)
    elif path.suffix.lower() in row_tables.KINDS:
        row_tables.check_path(path)
    else:
        check_picture(path)


def optimise(
    need: Need,
    *,
    options: OptimiseOptions,
    case_options: Annotated[CaseOptions, {"settings": "Change a value: --set optimise.nut=single."}],
    output: Annotated[Output, {"as_json": "One JSON object with the members, SI units."}],
    to: Annotated[
        list[Path] | None,
        file_option("Also write a table (.csv, .xlsx) or a picture (.png, .svg, .pdf); may be repeated."),
    ] = None,
) -> None:
    """Pareto front of screw geometries for a need. They are free within what makers produce.

    The need is that of ballscrew select; its table [optimise] has bounds and objectives. Each member is evaluated by
    the full model and all checks. Needs the extra optimise.
    """
    from ballscrew.faces.sheets import to_file
    from ballscrew.questions.optimise import compute
    from ballscrew.questions.optimise.answer import document
    from ballscrew.questions.optimise.sheet import cost, sheet

    _refuse_overwriting(to or [], need, settings=case_options.settings)
    for path in to or []:
        _check_file(path)
    limits: dict[str, Any] = {**vars(options), **vars(case_options), "objectives": _objectives(options.objectives)}
    seed = limits.pop("seed")
    with progress("designs", cost(compute.plan(need, **limits))) as done:
        front = compute.optimise(need, seed=seed, done=done, **limits)
    answer_sheet = sheet(front)
    output.print(answer_sheet, lambda: document(front))
    for path in to or []:
        to_file.write(path, answer_sheet, option=_TO)
        typer.echo(f"{path}: {len(front.members)} designs", err=True)


catalogue = typer.Typer(
    help="Screws as catalogues list them, and case files made of them.", no_args_is_help=True, rich_markup_mode=None
)

CatalogueRows = Annotated[
    Path | None,
    typer.Option("--rows", metavar="FILE", help="A table of your own, .csv or .xlsx, in place of the rows shipped."),
]
KeepGoingInTable = Annotated[
    bool, typer.Option("--keep-going", help="Leave faulty rows of the table out, and say which; fails if none is good.")
]


@catalogue.command("list")
def list_rows(
    words: Annotated[
        list[str] | None, typer.Argument(help="Only rows with these sizes and words: rexroth 40x10.")
    ] = None,
    rows: CatalogueRows = None,
    as_json: AsJson = False,
    keep_going: KeepGoingInTable = False,
) -> None:
    """All rows, one line each."""
    from ballscrew.cases.screw_tables import catalogue as tables
    from ballscrew.questions.catalogue import text

    screws, notes = tables.load(rows, keep_going)
    chosen = tables.chosen(screws, " ".join(words or []), rows)
    print_notes_of_rows(notes)
    print_answer(lambda: text.list_text(chosen), lambda: tables.list_document(chosen), as_json=as_json)


@catalogue.command()
def show(
    name: Annotated[str, typer.Argument(help="Name of the row: hiwin-40-20k4.")],
    rows: CatalogueRows = None,
    as_json: AsJson = False,
    as_case: Annotated[bool, typer.Option("--case", help="A case file of the row, ready for ballscrew run.")] = False,
    keep_going: KeepGoingInTable = False,
) -> None:
    """One row: what is listed, what follows from it, what was assumed."""
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.cases.screw_tables import catalogue as tables
    from ballscrew.questions.catalogue import text

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    screws, notes = tables.load(rows, keep_going)
    row = tables.named(screws, name, file=rows)
    print_notes_of_rows(notes)
    if as_case:
        typer.echo(tables.case_text(row))
    else:
        print_answer(lambda: text.show_text(row), lambda: tables.show_document(row), as_json=as_json)


@catalogue.command()
def own(
    numbers: Annotated[
        str,
        typer.Argument(
            metavar="NUMBERS", help='NAME=VALUE with units, commas between them: "d0=40 mm, lead=10 mm, turns=2x2.5".'
        ),
    ],
    as_json: AsJson = False,
    as_case: Annotated[bool, typer.Option("--case", help="A case file, ready for ballscrew run.")] = False,
) -> None:
    """A nut of your own from a few catalogue numbers.

    It says what is estimated, and makes a case file of it.

    Needed are d0, lead and turns (all circuits of one nut body); each of Ca, C0a, ball, dp, dr, starts, nut, preload,
    D1 that is given makes the rest better.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.cases.screw_tables import catalogue as tables
    from ballscrew.cases.screw_tables.own_nut import numbers_in, own_nut_of
    from ballscrew.questions.catalogue import own_nut

    if as_case and as_json:
        raise InputError(Fault("--case", "does not go with --json", "", "give one of the two"))
    nut = own_nut_of(numbers_in(numbers))
    if as_case:
        typer.echo(tables.case_text(nut.row, nut.estimates))
        print_notes_of_rows([f"warning: {line}" for line in own_nut.warnings(nut)])
    else:
        print_answer(lambda: own_nut.text(nut), lambda: own_nut.document(nut), as_json=as_json)
