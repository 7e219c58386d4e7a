"""Users at work on one server at the same time, whose answers are compared with those computed in process.

Users of one `ballscrew serve` at the same time for three minutes, each with a request some two seconds after the last
answer: run, sweep, band, comparison, catalogue and now and then a report (the column counts requests).

*Wrong*: an answer other than the one computed in process, to 1e-10; a status other than 200 and 429 (busy: counted as
refused); no answer within 60 s; a server that has written to standard error.
"""

from __future__ import annotations

import asyncio
import concurrent.futures
import dataclasses
import json
import statistics
import threading
import time
from collections import Counter
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import httpx
import numpy as np
import psutil
from benchmarks.hostile.server import MOST_SECONDS, started, wrong_answer
from benchmarks.hostile.tally import Outcome, Tally
from benchmarks.serve import CASE, NUT, memory_of

from support.documents import differences

COUNT, SECONDS = 50, 180.0

#: Mean seconds between an answer and the next request.
PAUSE = 2.0
#: Of a hundred requests, and requests of each kind that differ in their numbers.
SHARES = {"run": 50, "sweep": 20, "band": 8, "compare": 6, "catalogue": 15, "report": 1}
DIFFERENT = {"run": 12, "sweep": 6, "band": 4, "compare": 4, "catalogue": 4, "report": 2}
#: Diameters in mm that the catalogue has: a search without a row is refused.
DIAMETERS = (16, 20, 32, 40)


@dataclasses.dataclass(frozen=True)
class Question:
    """One of the requests of a kind."""

    kind: str
    number: int

    @property
    def address(self) -> str:
        """Path and query."""
        more = {"catalogue": f"?words={DIAMETERS[self.number % len(DIAMETERS)]}x", "report": "?kind=html"}
        return f"/api/v1/{self.kind}{more.get(self.kind, '')}"

    @property
    def body(self) -> Any:
        """The body; None for a question without one."""
        if self.kind == "catalogue":
            return None
        operation = {"axial_load": f"{1000 + 700 * self.number} N", "screw_speed": f"{50 + 111 * self.number} rpm"}
        of_nut = self.number % 3 == 2 and self.kind in {"run", "sweep", "compare"}
        more: dict[str, Any] = {"sweep": {"vary": {"axial_load": "100:5000:20 N"}}, "band": {"samples": 512}}
        return {"case": {**(NUT if of_nut else CASE), "operation": operation}, **more.get(self.kind, {})}

    def request(self, client: Any) -> Any:
        """The request, to be sent by this client."""
        method = "GET" if self.body is None else "POST"
        return client.request(method, self.address, json=self.body)


class Answer(NamedTuple):
    """What a question got: the content, or words on what is wrong."""

    question: Question
    status: int
    content: bytes
    wrong: str


async def in_process(questions: Iterable[Question]) -> dict[Question, bytes]:
    """The answers that the same application gives without a server between."""
    from ballscrew.faces.web.server import application

    transport = httpx.ASGITransport(application())
    async with httpx.AsyncClient(base_url="http://localhost", transport=transport, timeout=None) as client:
        return {question: (await question.request(client)).content for question in questions}


def run(tally: Tally, seed: int) -> None:
    """Let users work for a time in proportion to their number, and compare the answers afterwards."""
    users, duration = tally.wanted, SECONDS * tally.wanted / COUNT
    kinds, weights = list(SHARES), np.array([*SHARES.values()]) / sum(SHARES.values())
    seconds: dict[str, list[float]] = {kind: [] for kind in kinds}
    answers: Counter[Answer] = Counter()
    lock = threading.Lock()

    def user(number: int, address: str, end: float) -> None:
        rng = np.random.default_rng([seed, number])
        with httpx.Client(base_url=address, timeout=MOST_SECONDS, trust_env=False) as client:
            while True:
                time.sleep(min(rng.exponential(PAUSE), max(0.0, end - time.monotonic())))
                if time.monotonic() >= end:
                    return
                kind = str(rng.choice(kinds, p=weights))
                question = Question(kind, int(rng.integers(DIFFERENT[kind])))
                begun = time.perf_counter()
                answer = answered(client, question)
                with lock:
                    seconds[kind].append(time.perf_counter() - begun)
                    answers[answer] += 1

    with started(tally) as (process, address):
        end = time.monotonic() + duration
        with concurrent.futures.ThreadPoolExecutor(users) as pool:
            list(pool.map(lambda number: user(number, address, end), range(users)))
        server = psutil.Process(process.pid)
        memory = memory_of(process) + sum(child.memory_info().rss for child in server.children(recursive=True)) / 2**20
    expected = asyncio.run(in_process({answer.question for answer in answers if answer.status == 200}))
    for answer, number in answers.items():
        tally.add(judged(answer, number, expected))
    tally.wanted = tally.counts.tried
    tally.notes += notes(users, duration, seconds, memory)


def answered(client: httpx.Client, question: Question) -> Answer:
    """The answer to one question."""
    try:
        found = question.request(client)
    except httpx.HTTPError as error:
        return Answer(question, 0, b"", f"no answer ({type(error).__name__}: {error})")
    return Answer(question, found.status_code, found.content, wrong_answer(found.status_code, found.headers))


def judged(answer: Answer, number: int, expected: Mapping[Question, bytes]) -> Outcome:
    """The outcome of an answer that came so many times."""
    wrong = answer.wrong
    if not wrong and answer.status == 429:
        return Outcome(refused=number)
    if not wrong and answer.status != 200:
        wrong = f"status {answer.status}"
    if not wrong and not _same(answer.content, expected[answer.question]):
        wrong = "another answer than in process"
    if wrong:
        return Outcome(wrong=[f"{answer.question.address} {json.dumps(answer.question.body)}: {wrong}"] * number)
    return Outcome(answered=number)


def _same(content: bytes, expected: bytes) -> bool:
    """Test whether two answers are one: numbers to rounding, as one may be of NumPy and one of a kernel."""
    if content == expected:
        return True
    try:
        return not differences(json.loads(content), json.loads(expected))
    except ValueError:  # a report
        return False


def notes(users: int, duration: float, seconds: dict[str, list[float]], memory: float) -> list[str]:
    """The table of times, and the memory at the end."""
    lines = [
        f"{users} users for {duration:.0f} s; resident memory of the server at the end: {memory:.0f} MB.",
        "",
        "| request | number | median | 95 % within |",
        "|---|---|---|---|",
    ]
    for kind, found in seconds.items():
        if len(found) > 1:
            last = statistics.quantiles(found, n=20)[-1]
            lines.append(f"| {kind} | {len(found):,} | {1e3 * statistics.median(found):.0f} ms | {1e3 * last:.0f} ms |")
    return lines
