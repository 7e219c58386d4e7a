"""Whose report it is, and of when: said by somebody, or not at all, so that equal cases have equal reports."""

from __future__ import annotations

import datetime
from typing import NamedTuple

from ballscrew.basis.errors import Fault, raise_if_any

#: Letters of the name of a project.
LONGEST = 120


class Heading(NamedTuple):
    """The name of a project and a date, as they stand on a report; empty where there are none."""

    project: str = ""
    date: str = ""

    @classmethod
    def of(cls, project: str | None, date: str | None) -> Heading:
        """The heading of texts that people gave; ``today`` is a date, too.

        Raises :class:`~ballscrew.basis.errors.InputError` for a name of several lines or too many letters, and for a
        date that is not one of the calendar, such as 2026-11-23.
        """
        faults: list[Fault] = []
        name, day = (project or "").strip(), (date or "").strip()
        if len(name) > LONGEST or not name.isprintable():
            remedy = f"one line of {LONGEST} letters at most"
            faults.append(Fault("--project", "cannot stand on a report", repr(name[:40]), remedy))
        if day == "today":
            day = datetime.date.today().isoformat()
        if day and not _is_date(day):
            faults.append(Fault("--date", "is no date", day[:40], "write it as 2026-11-23, or leave it out"))
        raise_if_any(faults)
        return cls(name, day)

    @property
    def lines(self) -> list[str]:
        """What stands below the title."""
        said = [f"Project: {self.project}"] * bool(self.project) + [f"Date: {self.date}"] * bool(self.date)
        return [" · ".join(said)] if said else []


def _is_date(text: str) -> bool:
    try:
        return datetime.date.fromisoformat(text).isoformat() == text
    except ValueError:
        return False
