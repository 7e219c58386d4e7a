"""All answers about a case in one request, each as a line of JSON as soon as it is there."""

from __future__ import annotations

import asyncio
import contextlib
import functools
from collections.abc import AsyncIterator, Awaitable, Callable, Sequence
from typing import Any, ClassVar, Literal

from fastapi import APIRouter, Request
from pydantic import Field, RootModel
from starlette.background import BackgroundTask
from starlette.responses import StreamingResponse

from ballscrew.basis.errors import InputError
from ballscrew.faces.web import documents, limits, openapi, problems
from ballscrew.faces.web.bodies import MOST_BYTES, MOST_VALUES, CaseBody, Tables, read
from ballscrew.faces.web.endpoint_parts import as_bytes, cancellable, of_tables, queue_of
from ballscrew.faces.web.problems import Refused
from ballscrew.faces.web.request_queue import Deadline, RequestQueue
from ballscrew.questions import responses
from ballscrew.questions.check.answer import with_nut_named
from ballscrew.questions.curves import Curve, curves
from ballscrew.questions.run.compute import Run
from ballscrew.questions.shared import schemas
from ballscrew.questions.sweep import compute as sweeps
from ballscrew.questions.sweep.answer import document

#: Designs beside the case at most.
MOST_BESIDE = 8

router = APIRouter()


class AnswersBody(CaseBody):
    """A case, and other designs beside it, which are run and checked alone."""

    most_bytes: ClassVar[int] = (1 + MOST_BESIDE) * MOST_BYTES
    most_values: ClassVar[int] = (1 + MOST_BESIDE) * MOST_VALUES

    beside: list[Tables] = Field(default_factory=list[Tables], max_length=MOST_BESIDE)


class RunLine(schemas.Closed):
    """The run of the case (``place`` 0), or of a design beside it."""

    question: Literal["run"]
    place: int
    answer: responses.Run


class CheckLine(schemas.Closed):
    """The checks of the case (``place`` 0), or of a design beside it."""

    question: Literal["check"]
    place: int
    answer: responses.Checks


class CurveLine(schemas.Closed):
    """A curve around the operating point; ``cold_and_hot`` where the oil follows the temperature."""

    question: Literal["over_speed", "cold_and_hot", "over_both", "over_load"]
    place: Literal[0]
    answer: responses.Sweep


class DrawingLine(schemas.Closed):
    """The ball between its grooves, to be shown in any units."""

    question: Literal["drawing"]
    place: Literal[0]
    answer: schemas.Drawing


class CurveSweep(schemas.Closed):
    """The sweep of a curve, as which it may be asked for by itself: the rest of a body of ``/sweep``."""

    vary: dict[str, str]
    outputs: list[str]


class ProblemLine(schemas.Closed):
    """A question that has no answer, and why; a curve has its sweep, which may be started as a job."""

    question: Literal["run", "check", "over_speed", "cold_and_hot", "over_both", "over_load", "drawing"]
    place: int
    problem: schemas.Problem
    sweep: CurveSweep | None = None


class Line(RootModel[RunLine | CheckLine | CurveLine | DrawingLine | ProblemLine]):
    """A line: a question with its answer, or with the problem that the address of that question would answer."""


class Lines(StreamingResponse):
    """Lines of JSON, sent one by one."""

    media_type = "application/x-ndjson"


@router.post(
    "/answers",
    openapi_extra=openapi.body(AnswersBody),
    response_class=Lines,
    response_model=Line,
    responses=openapi.problems_of(),
)
async def answers(request: Request) -> Lines:
    """Numbers, checks, curves and drawing of a case, which is built once: a line of JSON for each.

    Run and checks of the case come first, then the curve over the speed; the rest comes as soon as it is there. What
    cannot be answered has a problem in its line; the checks of a design that cannot be run have none.
    """
    body: AnswersBody = await read(request, AnswersBody)
    asked = _Asked(queue_of(request), body.case)
    run = await cancellable(request, asked.run())  # what is no case is refused before anything is sent
    return Lines(_lines(asked, run, body.beside), background=BackgroundTask(asked.release))


async def _lines(asked: _Asked, run: dict[str, Any], beside: Sequence[Tables]) -> AsyncIterator[bytes]:
    """The answers, each as soon as it is there; what cannot be answered has its problem."""
    yield _written("run", 0, answer=run)
    yield await _line("check", 0, asked.checks)
    named = curves(asked.found)
    yield await _curve(asked, "over_speed", named.pop("over_speed"))
    rest = [_beside(_Asked(asked.queue, tables), place) for place, tables in enumerate(beside, start=1)]
    rest += [_alone(_curve(asked, name, curve)) for name, curve in named.items()]
    rest.append(_alone(_line("drawing", 0, asked.drawing)))
    tasks = [asyncio.ensure_future(one) for one in rest]
    try:
        for task in asyncio.as_completed(tasks):
            for line in await task:
                yield line
    finally:  # the client has gone, or typed on
        for task in tasks:
            task.cancel()


async def _alone(line: Awaitable[bytes]) -> list[bytes]:
    """The line of one question about the case."""
    return [await line]


def _curve(asked: _Asked, name: str, curve: Curve) -> Awaitable[bytes]:
    """The line of a curve."""
    sweep = {"vary": dict(curve.vary), "outputs": list(curve.outputs)}
    return _line(name, 0, functools.partial(asked.curve, curve), sweep=sweep)


async def _beside(asked: _Asked, place: int) -> list[bytes]:
    """The lines of a design beside the case: its run, and its checks where it has one."""
    try:
        run = _written("run", place, answer=await asked.run())
    except (InputError, Refused) as error:
        return [_written("run", place, problem=_problem(error))]
    return [run, await _line("check", place, asked.checks)]


async def _line(question: str, place: int, answer: Callable[[], Awaitable[Any]], **beside: Any) -> bytes:
    """A line with an answer, or with the reason why there is none and what stands beside it."""
    try:
        return _written(question, place, answer=await answer())
    except (InputError, Refused) as error:
        return _written(question, place, problem=_problem(error), **beside)


def _problem(error: InputError | Refused) -> dict[str, Any]:
    return problems.document(error.status if isinstance(error, Refused) else 422, error.faults)


def _written(question: str, place: int, **result: Any) -> bytes:
    return as_bytes({"question": question, "place": place, **result}) + b"\n"


class _Asked:
    """A case that is asked about: it is built and run once, for the first question."""

    def __init__(self, queue: RequestQueue, tables: Tables) -> None:
        self.queue, self.tables = queue, tables
        self._found: Run | None = None
        self._is_heavy = False

    @property
    def found(self) -> Run:
        """The run, which is asked for first."""
        assert self._found is not None
        return self._found

    async def run(self) -> dict[str, Any]:
        """The document of the run. Raises :class:`~ballscrew.basis.errors.InputError` for what is no case."""
        self._found, document = await of_tables(self.queue, self.tables, lambda result: (result, documents.run(result)))
        return document

    async def checks(self) -> dict[str, Any]:
        """The document of the checks, with the nut named that the case lacks."""
        tables, notes = with_nut_named(self.tables)
        if tables != self.tables:
            return await of_tables(self.queue, tables, lambda result: documents.check(result, notes))
        return await self._of_run(lambda result: documents.check(result, notes))

    async def drawing(self) -> dict[str, Any]:
        """The drawing."""
        return await self._of_run(documents.drawing)

    async def curve(self, curve: Curve) -> dict[str, Any]:
        """The document of a sweep."""
        case = self.found.case
        axes = [f"{name}={text}" for name, text in curve.vary.items()]
        plan = sweeps.with_flooded_torque(case, sweeps.plan(case, axes, curve.outputs, None))

        def work(done: Deadline) -> dict[str, Any]:
            return document(case, plan, sweeps.sweep(case, plan, done))

        if limits.is_short(case, plan):
            return await self.queue.short(work)
        self._is_heavy = True
        return await self.queue.heavy(work)

    async def release(self) -> None:
        """Give back what heavy work has left behind: once, after the last line, as it takes as long as a curve."""
        if self._is_heavy:
            with contextlib.suppress(Refused):  # a server that ends meanwhile gives all of it back
                await self.queue.heavy(limits.releasing(lambda _: None))

    async def _of_run(self, work: Callable[[Run], dict[str, Any]]) -> dict[str, Any]:
        """Work on the run: quick, unless many balls are computed one by one."""
        result = self.found
        if limits.balls_of(result.case) > limits.MANY_BALLS:
            self._is_heavy = True
            return await self.queue.heavy(lambda _: work(result))
        return await self.queue.quick(lambda: work(result))
