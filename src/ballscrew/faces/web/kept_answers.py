"""Answers that are kept for a while: a page that is loaded again, or a step back in it, asks for what was computed.

An answer in JSON follows from the body of its request and the data of the package alone: random numbers have the same
seed each time. So the same request has the same answer, for whoever sends it. A report, which may have the date of
today, is made anew.
"""

from __future__ import annotations

from collections import OrderedDict
from typing import NamedTuple

#: Bytes of all answers that are kept, and of the largest one.
MOST_BYTES, LARGEST = 16_000_000, 1_000_000
#: Bytes that an answer takes beside its own: its question, and its place.
_BESIDE = 500


class Question(NamedTuple):
    """What is asked for: an address with its query, and the digest of a body."""

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
