"""All rows shipped, with what the reference model says of them: once for all tests of a worker."""

import functools

from ballscrew.evidence.validation.entries import Entry
from ballscrew.questions.validate import compute


@functools.cache
def every_set() -> tuple[tuple[Entry, ...], ...]:
    """The entries of each set, as ``ballscrew validate`` without options has them: some ten seconds."""
    return tuple(tuple(entries) for entries, _ in compute.evaluate(compute.request()))
