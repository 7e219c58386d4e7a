"""Response models of the API for the columns of a log, and example logs."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.fit.log_document import LogColumns
from ballscrew.questions.shared.answer_parts import Closed, FaultLine, Tables
from ballscrew.questions.shared.declared import schema


class ColumnFault(FaultLine):
    """A fault of the columns of a log."""

    column: str = Field(description="that it is about; may be empty")


class Log(schema(LogColumns)):
    """The columns of a log, and what may be fitted to it."""

    faults: list[ColumnFault] = Field(description="for which the log cannot be read as it is")


class ExampleLog(Closed):
    """A log to try."""

    name: str
    text: str


class Example(Closed):
    """A case, and logs that belong to it."""

    file: str
    case: Tables
    logs: list[ExampleLog]
    free: list[str] = Field(description="numbers to fit to the logs")


class Examples(Closed):
    """Logs to try; no screw was measured for them."""

    condition: Example
    fit: Example
    service: Example
