"""The checks of a case in its report."""

from __future__ import annotations

from collections.abc import Sequence

from ballscrew.cases.screw_tables.nut_kinds import LISTED
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.check.compute import Checked
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.shared import check_lines
from ballscrew.questions.shared.report_blocks import Block, Paragraph, Table, sentence
from ballscrew.questions.shared.report_blocks import value as value_of


def checks(found: Checked) -> list[Block]:
    """Checks, line by line."""
    return [
        said_of_checks(found.verdict, found),
        check_table("Limits, and how much of each is used", found.checks),
    ]


def over_a_cycle(report: DutyReport, of_point: Checked) -> list[Block]:
    """The checks over the cycle, in place of those of the operating point as if it lasted for ever."""
    verdict = next(record for record in duty_verdicts.verdicts(report) if record.id == "verdict.checks")
    return [
        said_of_checks(verdict.text, of_point),
        check_table("Limits over the cycle, and how much of each is used", report.checks),
    ]


def said_of_checks(verdict: str, found: Checked) -> Paragraph:
    """The verdict on checks, and on what they rest."""
    said = [verdict]
    if found.case.nut is None:
        said.append("the case has no nut: it is checked as a single nut without preload")
    said += _computed_ratings(found)
    return Paragraph(" ".join(f"{sentence(words)}." for words in said), strong=True)


def check_table(caption: str, found: Sequence[Check]) -> Table:
    """A line for each check."""
    return Table(caption, ("", "value", "limit", "used", "verdict"), [check_row(one) for one in found], (0, 4), 4)


def _computed_ratings(found: Checked) -> list[str]:
    """The ratings that nobody lists and that the checks took from the geometry instead."""
    unlisted = [name for name in ("dynamic", "static") if found.case.listed.get(f"{name}_load_rating") is None]
    if found.computed is None or not unlisted:
        return []
    values = [value_of(getattr(found.computed, name), LISTED[f"{name}_load_rating"]) for name in unlisted]
    ratings = " and ".join(f"{name} {value}" for name, value in zip(unlisted, values, strict=True))
    return [f"load ratings that are not listed are computed from the geometry, by ISO 3408-5 as recalled: {ratings}"]


def check_row(one: Check) -> tuple[str, ...]:
    """A check: value, limit, share of it that is used, verdict."""
    return (
        one.name.replace("_", " "),
        check_lines.shown(one, one.value),
        check_lines.shown(one, one.limit),
        check_lines.used_of(one),
        ": ".join(filter(None, [check_lines.verdict_of(one), one.text])),
    )
