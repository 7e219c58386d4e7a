"""Documents of the API: those of the commands, with words beside them."""

from __future__ import annotations

import json
import threading
from collections import OrderedDict
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.cases.case_files import descriptions
from ballscrew.cases.case_files.case import Case
from ballscrew.questions.band import answer as band_documents
from ballscrew.questions.band.compute import BandReport
from ballscrew.questions.band.sheet import input_counts
from ballscrew.questions.check import answer as check_documents
from ballscrew.questions.check.answer import checked
from ballscrew.questions.run import answer, compute

#: Runs that are kept: who has asked for the numbers of a case often asks for its drawing or its checks next.
_MOST_RUNS = 4
_runs: OrderedDict[str, compute.Run] = OrderedDict()
_runs_lock = threading.Lock()


def run_of(case: Case, tables: Mapping[str, Any]) -> compute.Run:
    """The run of a case that was made of these tables; of the same tables again it is not computed again."""
    key = json.dumps(tables, default=repr)
    with _runs_lock:
        result = _runs.get(key)
    if result is None:
        result = compute.run(case)
        with _runs_lock:
            _runs[key] = result
            if len(_runs) > _MOST_RUNS:
                _runs.popitem(last=False)
    return result


def run(result: compute.Run) -> dict[str, Any]:
    """The document of a run, and its sentences."""
    case, document = result.case, answer.document(result)
    rigidity = () if result.nut is None else result.nut.rigidity.assumed
    return {
        **document,
        "words": {
            "title": descriptions.title(case),
            "verdicts": [record["text"] for record in document["verdicts"]],
            "assumed": descriptions.assumed(case, result.ball_to_ball_force),
            "rigidity": list(rigidity),
            "rules": compute.messages(case, result.nut),
        },
    }


def check(result: compute.Run, notes: Sequence[str] = ()) -> dict[str, Any]:
    """The document of the checks of a run; a request has no name."""
    document = check_documents.document(checked("", result.case, notes, known=result))
    return {key: value for key, value in document.items() if key != "name"}


def drawing(result: compute.Run) -> dict[str, Any]:
    """The ball between its grooves, as SVG."""
    from ballscrew.faces.report.drawing import drawing

    return {"text": drawing(result)}


def band(case: Case, band_report: BandReport) -> dict[str, Any]:
    """The document of a band, and its sentences."""
    return {
        **band_documents.document(compute.run(case), band_report),
        "words": {
            "sentences": [verdict.text for verdict in band_documents.verdicts(case, band_report)],
            "inputs": input_counts(band_report),
        },
    }


#: Bytes of all answers that are kept, and of the largest one.
MOST_BYTES, LARGEST = 16_000_000, 1_000_000
#: Bytes that an answer takes beside its own: its question, and its place.
_BESIDE = 500


class Question(NamedTuple):
    """Request: an address with its query, and the digest of a body."""

    address: str
    digest: bytes


class KeptAnswers:
    """The answers asked for last, as JSON; those that nobody asked for the longest make room."""

    def __init__(self, most_bytes: int = MOST_BYTES, largest: int = LARGEST) -> None:
        self._most, self._largest = most_bytes, largest
        self._found: OrderedDict[Question, bytes] = OrderedDict()
        self._bytes = 0

    def find(self, question: Question) -> bytes | None:
        """The answer, where it is kept."""
        if question not in self._found:
            return None
        self._found.move_to_end(question)
        return self._found[question]

    def keep(self, question: Question, answer: bytes) -> None:
        """Keep an answer; one that is too large is not kept."""
        if len(answer) > self._largest or question in self._found:
            return
        self._found[question] = answer
        self._bytes += len(answer) + _BESIDE
        while self._bytes > self._most:
            _, oldest = self._found.popitem(last=False)
            self._bytes -= len(oldest) + _BESIDE
