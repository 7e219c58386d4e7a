"""The question of the screws of a catalogue for a need."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

from ballscrew.questions.select.options import ListOptions, SelectOptions
from ballscrew.questions.shared.log_options import KeepGoing
from ballscrew.questions.shared.options import Option
from ballscrew.questions.shared.question import NEED, Answer, Done, Endpoint, Plan, Question, Request, Sent, Work

if TYPE_CHECKING:
    from ballscrew.basis.errors import InputError
    from ballscrew.questions.select.compute import Ranked, Selection


#: The kind of a case file.
_CASE = ".toml"


@dataclasses.dataclass(frozen=True, kw_only=True)
class TableOptions:
    """A table of screws."""

    rows: Annotated[
        str | None,
        Option("A table of screws of your own, .csv or .xlsx, in place of the catalogue.", metavar="FILE"),
    ] = None
    keep_going: KeepGoing = False


def _prepare(request: Request) -> Work:
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.questions.select.answer import document, row_document
    from ballscrew.questions.select.compute import plan, select
    from ballscrew.questions.select.sheet import cost, sheet

    options, listed = request.options(SelectOptions), request.options(ListOptions)
    table = request.options(TableOptions)
    assert request.need is not None
    if listed.rank is not None and not any(map(_is_case, request.to)):
        raise InputError(Fault("--rank", "names no file", str(listed.rank), "add --to axis.toml"))
    refuse_overwriting(request, *([] if table.rows is None else [Path(table.rows)]))
    need, words = request.need, options.words or None
    settings = request.case_options.settings
    planned = plan(need, rows=table.rows, words=words, settings=settings, keep_going=table.keep_going)
    if listed.rank is not None and listed.rank > planned.candidates:
        raise _no_such_rank(listed.rank, planned.candidates)

    def answer(done: Done) -> Answer:
        selection = select(
            need,
            rows=table.rows,
            words=words,
            objectives=objectives(listed.objectives),
            **vars(request.case_options),
            keep_going=table.keep_going,
            complete=options.complete,
            done=done,
            found_one=lambda candidate: request.send(row_document(candidate)),
        )
        shown = [
            each
            for each in selection.ranked
            if (each.candidate.fits or not listed.holds) and (each.pareto or not listed.front)
        ]

        def write(path: Path) -> str:
            return _write_case(path, selection, shown, listed.rank)

        return Answer(
            sheet(selection, shown, listed.first),
            lambda: document(selection, shown),
            f"{len(shown)} candidates",
            write=write,
            notes=selection.notes,
            is_interrupted=selection.interrupted,
        )

    return Work(answer, "candidates", cost=cost(planned))


def _plan(request: Request) -> Any:
    from ballscrew.questions.select.compute import plan
    from ballscrew.questions.shared import declared

    options, table = request.options(SelectOptions), request.options(TableOptions)
    assert request.need is not None
    return declared.document(
        plan(request.need, rows=table.rows, words=options.words or None, keep_going=table.keep_going)
    )


def _is_case(path: Path) -> bool:
    return path.suffix.lower() == _CASE


def _write_case(path: Path, selection: Selection, shown: Sequence[Ranked], rank: int | None) -> str:
    """Write the case of a candidate, and return what is in it."""
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
        raise InputError(Fault("--to", "there is no candidate to write", str(path), "leave out --holds and --front"))
    raise _no_such_rank(rank, len(selection.ranked))


def _no_such_rank(rank: int, candidates: int) -> InputError:
    from ballscrew.basis.errors import Fault, InputError

    return InputError(Fault("--rank", "there is no such candidate", str(rank), f"there are {candidates}"))


def objectives(written: Sequence[str]) -> list[str] | None:
    """The names of objectives, also of those written with a dash; None for those of the need."""
    return [name.replace("-", "_") for name in written] or None


def refuse_overwriting(request: Request, *others: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a file that would be written over one that is read.

    These are the need, whatever file it names, and ``others``.
    """
    from ballscrew.basis.errors import Fault, InputError
    from ballscrew.cases.case_files import case_file, project

    need = request.need
    if not isinstance(need, Path) or not any(path.exists() for path in request.to):
        return
    need_file = project.file_of(need)
    tables = case_file.override(case_file.read(need), request.case_options.settings)
    named = [need_file.parent / name for name in _texts(tables)]
    for path in filter(Path.exists, request.to):
        if _is_same(path, need_file):
            raise InputError(Fault("--to", "is the file of the need", str(path), "choose another name"))
        if any(_is_same(path, other) for other in (*others, *named)):
            raise InputError(Fault("--to", "is a file that is read", str(path), "choose another name"))


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


def _response() -> Any:
    from ballscrew.questions.select.response import Select

    return Select


def _plan_response() -> Any:
    from ballscrew.questions.select.compute import Plan
    from ballscrew.questions.shared.declared import schema

    return schema(Plan)


SELECT = Question(
    name="select",
    help="""Rank the screws of the catalogue for a need. Each row counts with its nut, preloads and oils.

    Each candidate is judged by the full model and all checks, but for those that their loads alone rule out. The
    exit code is 0 where none holds, too: the list says what fails, and by how much. With --to FILE.toml the case of one
    candidate is written, with all tables of the need, for duty, axis, warm-up, run and report.
    """,
    reads=(NEED,),
    options=(SelectOptions, ListOptions, TableOptions),
    case_texts={"settings": 'Change a value: --set need.feed="20 m/min".'},
    files=Option(
        "Also write a table (.csv, .xlsx), a picture (.png, .svg, .pdf) or a candidate's case (.toml); may be "
        "repeated.",
        short="-o",
        metavar="FILE",
    ),
    has_several_files=True,
    own_kinds=(_CASE,),
    prepare=_prepare,
    endpoint=Endpoint(
        response=_response,
        options=(SelectOptions,),
        files=(Sent("table", "rows", is_optional=True),),
        written={"keep_going": True},
        plan=Plan(
            _plan,
            _plan_response,
            "Candidates and time of a selection, and the inputs without which checks are not judged.",
        ),
    ),
)
