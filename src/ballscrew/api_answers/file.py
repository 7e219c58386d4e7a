"""Response models of the API for files that are opened, and for progress."""

from __future__ import annotations

from pydantic import Field

from ballscrew.api_answers.parts import Closed, Tables


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


class Progress(Closed):
    """How far a request is."""

    finished: int
    total: int = Field(description="zero of a ticket that nothing is known of")
