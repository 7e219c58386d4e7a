"""Errors of operations that cannot be recorded."""

from __future__ import annotations


class CannotRecordError(TypeError):
    """Asked of a traced value: what only numbers or plain arrays can do."""


class NoAttributeError(CannotRecordError, AttributeError):
    """Asked of a traced value: a method or an attribute of plain arrays."""


def why_not_recorded(error: BaseException) -> CannotRecordError | None:
    """Cause of an error that is an operation that cannot be recorded."""
    below: BaseException | None = error
    while below is not None and not isinstance(below, CannotRecordError):
        below = below.__cause__ or below.__context__
    return below
