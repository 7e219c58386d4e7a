"""Selection: every row, nut, preload and oil against a need, ranked, with what fails and by how much."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, MutableMapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from ballscrew.cases.case import Case
from ballscrew.errors import Fault, InputError
from ballscrew.screw_tables import catalogue
from ballscrew.selection.candidates import (
    LENGTH_OF_STROKE,
    USUAL_PRELOADS,
    Candidate,
    Variant,
    assumes_preload,
    case_of,
    judged,
    variants,
)
from ballscrew.selection.need import Need, need_of
from ballscrew.selection.objectives import OBJECTIVES, USUAL_OBJECTIVES, objectives_named
from ballscrew.selection.pareto import front
from ballscrew.studies.every_row import Done, each

#: Variants at most: more take hours.
MOST_VARIANTS = 20_000


@dataclasses.dataclass(frozen=True, eq=False)
class Ranked:
    """A candidate with its rank, from 1, and whether no other one that fits beats it in all objectives."""

    rank: int
    candidate: Candidate
    pareto: bool


@dataclasses.dataclass(frozen=True, eq=False)
class Selection:
    """The candidates of a need, the best first."""

    need: Need
    #: The objectives of the Pareto mark; the first ranks.
    objectives: Sequence[str]
    ranked: Sequence[Ranked]
    #: What was left out, and why.
    notes: Sequence[str] = ()
    interrupted: bool = False

    @property
    def holding(self) -> Sequence[Ranked]:
        """The candidates whose checks were all judged and hold."""
        return [found for found in self.ranked if found.candidate.holds]

    @property
    def best(self) -> Candidate | None:
        """The first that holds and lies within the validity of the model; None where there is none."""
        found = next((each for each in self.ranked if each.candidate.holds and each.candidate.valid), None)
        return None if found is None else found.candidate


def select(
    need: str | Path | Mapping[str, Any] | Need,
    *,
    rows: str | Path | None = None,
    words: str | None = None,
    objectives: Sequence[str] | None = None,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
    keep_going: bool = False,
    done: Done | None = None,
    known: MutableMapping[str, Candidate] | None = None,
) -> Selection:
    """Every row of the catalogue with every nut, preload and oil of a need, judged and ranked.

    Each candidate is the case that ``ballscrew check`` would take, of a need with a motion that of ``ballscrew duty``:
    nothing is estimated. First come those of which no check fails, within the validity of the model before those
    outside, members of the Pareto front before others, then by the first of the ``objectives``; those that fail follow
    by their largest utilisation. ``rows`` is a table of one's own in place of the catalogue, ``words`` what rows must
    have in name, source or kind of nut. ``known`` are candidates by their labels that a call with the same arguments
    found before it was stopped; those found now are put in.

    Raises :class:`~ballscrew.errors.InputError` for faults of the need, and of rows; with ``keep_going`` rows at fault
    are left out, with a note, if any other is good.
    """
    asked = need_of(need, settings)
    names = asked.objectives if objectives is None else objectives_named(objectives, "objectives")
    table = None if rows is None else Path(rows)
    listed, notes = catalogue.load(table, keep_going)
    chosen = catalogue.chosen(listed, asked.rows if words is None else words, table)
    if objectives is None and names == USUAL_OBJECTIVES and any(row.price_index is not None for row in chosen):
        names = (*names, "price_index")
    unknown = [name for name in asked.price_index if name not in listed]
    if unknown:
        raise InputError(Fault("need.price_index", "no such row", ", ".join(unknown), "names are those of the rows"))
    every = list(variants(asked, chosen, table))
    if any(assumes_preload(asked, one) for one in every):
        note = (
            f"preloads of {', '.join(USUAL_PRELOADS)} of the dynamic load rating where a row lists none: none was given"
        )
        asked = asked.with_note(note)
    if len(every) > MOST_VARIANTS:
        remedy = f"name fewer; {MOST_VARIANTS} at most"
        raise InputError(Fault("need", "has too many combinations", str(len(every)), remedy))

    before = {} if known is None else known

    def work(variant: Variant) -> Candidate:
        if variant.label not in before:
            case: Case = case_of(asked, variant, model=model, calibration=calibration, allow_code=allow_code)
            before[variant.label] = judged(asked, variant, case)
        return before[variant.label]

    # a variant that no maker could build, such as a preload beyond its rating, is left out of the shipped rows, too
    found = each({one.label: one for one in every}, work, keep_going=keep_going or table is None, done=done)
    if asked.length_is_stroke:  # each candidate says its own length
        asked = asked.with_note(f"unsupported length: {LENGTH_OF_STROKE}")
    return Selection(asked, names, ranked(list(found.found.values()), names), [*notes, *found.notes], found.interrupted)


def ranked(candidates: Sequence[Candidate], objectives: Sequence[str]) -> list[Ranked]:
    """Candidates in their order, see :func:`select`."""
    fitting = [found for found in candidates if found.fits]
    # an estimate beyond the validity of the model beats nothing that is within it
    fitting = [found for found in fitting if found.valid] or fitting
    costs = np.array([costs_of(found, objectives) for found in fitting]).reshape(len(fitting), len(objectives))
    best = {id(found) for found, leads in zip(fitting, front(costs), strict=True) if leads}

    def key(found: Candidate) -> tuple[Any, ...]:
        first = costs_of(found, objectives[:1])[0]
        number = math.inf if math.isnan(first) else first
        if not found.fits:
            return (1, found.worst, number, found.variant.label)
        return (0, not found.valid, id(found) not in best, number, found.variant.label)

    ordered = sorted(candidates, key=key)
    return [Ranked(place, found, id(found) in best) for place, found in enumerate(ordered, start=1)]


def costs_of(candidate: Candidate, objectives: Sequence[str]) -> list[float]:
    """The objectives of a candidate, less being better; an infinite life is a number, too."""
    return [OBJECTIVES[name].sign * candidate.objectives[name] for name in objectives]
