"""Counts of what was tried, and how it ended."""

from __future__ import annotations

import dataclasses
import sys
import threading
import time

#: Seconds between two lines of progress.
EVERY = 10.0


@dataclasses.dataclass
class Outcome:
    """Inputs that were answered with a result, those that were refused in a line or flagged, and what went wrong."""

    answered: int = 0
    refused: int = 0
    #: One line for each input with a wrong outcome.
    wrong: list[str] = dataclasses.field(default_factory=list)

    @property
    def tried(self) -> int:
        """The number of inputs."""
        return self.answered + self.refused + len(self.wrong)


class Tally:
    """The counts of a section, which ends after so many inputs or so many seconds."""

    def __init__(self, name: str, wanted: int, seconds: float) -> None:
        self.name, self.wanted, self.bound = name, wanted, seconds
        self.counts = Outcome()
        #: Lines below the table.
        self.notes: list[str] = []
        self._begun = self._said = time.monotonic()
        self._lock = threading.Lock()

    @property
    def seconds(self) -> float:
        """Seconds since the section began."""
        return time.monotonic() - self._begun

    @property
    def left(self) -> int:
        """The number of inputs that are still to be tried; none after the time is up."""
        return 0 if self.seconds > self.bound else max(0, self.wanted - self.counts.tried)

    def add(self, outcome: Outcome) -> None:
        """Count an outcome, and report progress."""
        with self._lock:
            self.counts.answered += outcome.answered
            self.counts.refused += outcome.refused
            self.counts.wrong += outcome.wrong
            if time.monotonic() > self._said + EVERY:
                self._said = time.monotonic()
                self.say()

    def say(self) -> None:
        """Print one line of progress."""
        counts = self.counts
        print(
            f"{self.name}: {counts.tried:,} of {self.wanted:,} in {self.seconds:.0f} s, {counts.answered:,} answered, "
            f"{counts.refused:,} refused, {len(counts.wrong):,} wrong",
            file=sys.stderr,
            flush=True,
        )
