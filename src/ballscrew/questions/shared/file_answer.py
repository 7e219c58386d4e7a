"""Response models of the API for files that are opened, and for jobs."""

from __future__ import annotations

from typing import Any, Literal

from pydantic import Field

from ballscrew.questions.shared.answer_parts import Closed, Tables


class OpenedDesign(Closed):
    """A design of a file."""

    name: str
    case: Tables = Field(description="tables as they are written, unchecked")
    aside: Tables = Field(description="tables that no case has, kept for the next file")


class Opened(Closed):
    """The designs of a file."""

    kind: str = Field(description="case, project, table or need")
    designs: list[OpenedDesign]
    comments: int = Field(description="comments of the file, which are lost")
    notes: list[str] = Field(description="columns that are not used, rows that are left out")


class Job(Closed):
    """A request that runs by itself."""

    id: str = Field(description="its name, which nobody can guess")
    address: str
    state: Literal["waiting", "running", "finished", "failed", "cancelled"]
    before: int = Field(description="jobs that wait before it")
    finished: int = Field(description="how much is done, as the work counts it")
    total: int = Field(description="of how much; zero where it does not count")
    computed: float = Field(description="seconds of processor")
    limit: float = Field(description="seconds of processor that it may take")
    rows: list[Any] = Field(description="parts of the answer that are there before the rest, from the place asked for")
