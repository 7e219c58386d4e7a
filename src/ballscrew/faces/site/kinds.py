"""What the static page can show: kinds of nuts and models, and the screws to start from, as cases.

A structure is a model and a kind of nut; all numbers are inputs of its module (:mod:`ballscrew.faces.site.modules`), so
that every screw with such a nut is computed by the same one.
"""

from __future__ import annotations

import functools
from collections.abc import Mapping
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.quantities import fields_of
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables.catalogue import EXAMPLE_PRELOADS
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.structures import numbers_alone
from ballscrew.faces.web.starts import starts
from ballscrew.physics.components.nut_losses import Seals
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.sizing.catalogue import CatalogueRow, catalogue
from ballscrew.physics.sizing.ratings import ratings_of
from ballscrew.questions.check.compute import GRADE, SHARE_OF_RATING, SPEED, TEMPERATURE

#: The models of which modules are made, the one to begin with first.
MODELS = ("reference", "olaru2005", "corrected")
#: The start of the paper.
PAPER = "paper"
#: The oil of a screw of the catalogue, as ``ballscrew check`` takes it.
OIL: Mapping[str, str] = {"grade": GRADE, "temperature": TEMPERATURE}


class Kind(NamedTuple):
    """A kind of nut: its name in a case file, empty for balls alone, and whether its bodies are elastic."""

    nut: str
    words: str
    elastic: bool = False
    spacer_balls: bool = False

    @property
    def is_preloaded(self) -> bool:
        """Whether such a nut has a preload."""
        return self.nut in EXAMPLE_PRELOADS


_NUTS: Mapping[str, str] = {
    "single": "single nut, not preloaded",
    "double": "double nut, preloaded",
    "offset-lead": "one nut body, preloaded by an offset of its lead",
    "oversize-balls": "one nut body, preloaded by oversize balls",
}
#: The kinds by name: rigid bodies, elastic ones, and every second ball a spacer.
KINDS: Mapping[str, Kind] = {
    "row": Kind("", "loaded balls alone, as in the paper"),
    **{nut: Kind(nut, words) for nut, words in _NUTS.items()},
    **{f"{nut}+elastic": Kind(nut, f"{words}, elastic bodies", elastic=True) for nut, words in _NUTS.items()},
    **{f"{nut}+spacers": Kind(nut, f"{words}, spacer balls", spacer_balls=True) for nut, words in _NUTS.items()},
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
def start_tables() -> Mapping[str, Mapping[str, Any]]:
    """The tables of the cases to start from, by name, without model and nut."""
    found: dict[str, Mapping[str, Any]] = {PAPER: {n: t for n, t in starts()[PAPER]["case"].items() if n != "model"}}
    load = fields_of(OperatingState)["axial_load"]
    for name, row in catalogue().items():
        force = units.written(_rounded(SHARE_OF_RATING * _rating(row)), load)
        operation = {"axial_load": force, "screw_speed": SPEED}
        found[name] = {"screw": {"catalogue": name}, "lubricant": dict(OIL), "operation": operation}
    return found


def kind_of_start(name: str) -> str:
    """The kind of nut that a start begins with: that which its row lists."""
    return "row" if name == PAPER else next(k for k, kind in KINDS.items() if kind.nut == catalogue()[name].nut)


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
    """What is evaluated in a case, with an oil that is its numbers alone."""
    return numbers_alone(Configuration(case.model, case.screw, case.lubricant))


def _preload(start: str, nut: str) -> str:
    """The preload as a row lists it, else an example of its kind."""
    row = catalogue().get(start) if start != PAPER else None
    if row is not None and row.nut == nut:
        if row.preload_share is not None:
            return f"{100 * row.preload_share:.12g} %"
        if row.preload is not None:
            return units.written(row.preload, fields_of(CatalogueRow)["preload"])
    return EXAMPLE_PRELOADS[nut]


def _seals(start: str) -> str:
    """The torque of the seals as a row lists it, else none."""
    row = catalogue().get(start) if start != PAPER else None
    return units.written((row and row.seal_torque) or 0.0, fields_of(Seals)["seal_torque"])


def _rating(row: CatalogueRow) -> float:
    return ratings_of(row).dynamic if row.dynamic_load_rating is None else row.dynamic_load_rating


def _rounded(force: float) -> float:
    """A force to two digits, as people set one."""
    return float(f"{force:.2g}")
