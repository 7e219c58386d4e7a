"""Subjects that the page can show: kinds of nuts and models, and the screws to start from, as cases.

A structure is a model and a kind of nut; all numbers are inputs of its module (:mod:`ballscrew.faces.page.modules`), so
that every screw with such a nut is computed by the same one.
"""

from __future__ import annotations

import functools
import tomllib
from collections.abc import Mapping
from typing import Any, NamedTuple

from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables.catalogue import EXAMPLE_PRELOADS, case_text
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import numbers_alone
from ballscrew.faces.page.starts import starts
from ballscrew.physics.sizing.catalogue import catalogue, printed_rows

#: The models of which modules are made, the one to begin with first.
MODELS = ("reference", "olaru2005", "corrected")
#: The start of the paper.
PAPER = "paper"


class Kind(NamedTuple):
    """A kind of nut: its name in a case file, empty for balls alone; elastic bodies, and spacer balls."""

    nut: str
    elastic: bool = False
    spacer_balls: bool = False

    @property
    def is_preloaded(self) -> bool:
        """True where such a nut has a preload."""
        return self.nut in EXAMPLE_PRELOADS


_NUTS = ("single", "double", "offset-lead", "oversize-balls")
#: The kinds by name: rigid bodies, elastic ones, and every second ball a spacer.
KINDS: Mapping[str, Kind] = {
    "row": Kind(""),
    **{nut: Kind(nut) for nut in _NUTS},
    **{f"{nut}+elastic": Kind(nut, elastic=True) for nut in _NUTS},
    **{f"{nut}+spacers": Kind(nut, spacer_balls=True) for nut in _NUTS},
}
#: What only the reference model has modules of: balls with four contacts, which the others do not know, and spacers.
_OF_REFERENCE = "reference"


def structures() -> tuple[tuple[str, str], ...]:
    """The models and kinds of nut that go together: balls with four contacts need the reference model."""
    return tuple((model, kind) for model in MODELS for kind in KINDS if _go_together(model, kind))


def _go_together(model: str, kind: str) -> bool:
    chosen = KINDS[kind]
    return model == _OF_REFERENCE or not (chosen.nut == "oversize-balls" or chosen.spacer_balls)


@functools.cache
def _start_cases() -> Mapping[str, Mapping[str, Any]]:
    """The whole cases to start from, by name: a row as ``ballscrew catalogue show --case`` writes it."""
    paper = {section: table for section, table in starts()[PAPER]["case"].items() if section != "model"}
    rows = {row.name: {**tomllib.loads(case_text(row)), "screw": {"catalogue": row.name}} for row in printed_rows()}
    return {PAPER: paper, **rows}


@functools.cache
def start_tables() -> Mapping[str, Mapping[str, Any]]:
    """The tables of the cases to start from, by name, without model and nut."""
    return {
        name: {section: case[section] for section in ("screw", "lubricant", "operation")}
        for name, case in _start_cases().items()
    }


def tables_of(start: str, model: str, kind: str) -> dict[str, Any]:
    """The tables of a case: a start, with a model and a kind of nut."""
    chosen = KINDS[kind]
    tables: dict[str, Any] = {**start_tables()[start], "model": {"name": model}}
    if not chosen.nut:
        return tables
    nut: dict[str, Any] = {"type": chosen.nut}
    if chosen.is_preloaded:
        nut["preload"] = _preload(start, chosen.nut)
    if chosen.spacer_balls:
        nut["spacer_balls"] = True
    bodies: dict[str, Any] = {"bodies": {}} if chosen.elastic else {}
    return {**tables, "nut": nut, **bodies, "losses": {"seals": {"seal_torque": _seals(start)}}}


def case_of(start: str, model: str, kind: str) -> Case:
    """The case of a start, with a model and a kind of nut."""
    return case_file.build(tables_of(start, model, kind), rows=catalogue())


def subject_of(case: Case) -> Configuration:
    """Configuration that is evaluated in a case, with an oil that is its numbers alone."""
    return numbers_alone(Configuration(case.model, case.screw, case.lubricant))


def _preload(start: str, nut: str) -> str:
    """The preload of a start with such a nut, else an example of its kind."""
    own = _start_cases()[start].get("nut", {})
    return own["preload"] if own.get("type") == nut else EXAMPLE_PRELOADS[nut]


def _seals(start: str) -> str:
    """The torque of the seals of a start, else none."""
    return _start_cases()[start].get("losses", {"seals": {"seal_torque": "0 N m"}})["seals"]["seal_torque"]
