"""Response models of the API for the columns of a log, and example logs."""

from __future__ import annotations

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, FaultLine, Number, Numbers, Tables


class SeenColumn(Closed):
    """A column of a file."""

    heading: str
    bare_heading: str = Field(description="without its unit")
    taken_for: str = Field(description="the name of a column of a log; empty where it is not used")
    unit: str
    cells: list[str] = Field(description="the first cells, as written")


class KnownColumn(Closed):
    """A column that a log may have."""

    name: str
    meaning: str
    unit: str = Field(description="SI")
    shown_in: str
    required: bool


class Candidate(Closed):
    """A number that may be fitted."""

    name: str
    meaning: str
    symbol: str
    unit: str = Field(description="SI")
    shown_in: str
    value: Number = Field(description="in the case, SI")


class ColumnFault(FaultLine):
    """A fault of the columns of a log."""

    column: str = Field(description="that it is about; may be empty")


class Log(Closed):
    """The columns of a log, and what may be fitted to it."""

    file: str
    moving: bool = Field(description="of a moving axis: ballscrew fit takes it, this address does not")
    columns: list[SeenColumn]
    more_columns: int
    constants: Numbers = Field(description="values that count in every row, SI")
    known: list[KnownColumn]
    missing: list[str] = Field(description="columns that are needed and not there")
    free: list[Candidate] = Field(description="numbers that are usually uncertain")
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
