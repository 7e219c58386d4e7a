"""Selection: every row, nut, preload and oil against a need, ranked, with what fails and by how much."""

from __future__ import annotations

import dataclasses
import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Duration, Info, Torque
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables import catalogue
from ballscrew.compiler.kernels import kernel
from ballscrew.physics.components.nut import NUTS
from ballscrew.physics.sizing.checks import failing, verdict_of
from ballscrew.questions.select.candidates import (
    LENGTH_OF_STROKE,
    USUAL_LIFE,
    USUAL_PRELOADS,
    Candidate,
    Variant,
    assumes_preload,
    case_of,
    each_by_loads,
    judged,
    variants,
)
from ballscrew.questions.select.need import Need, need_of
from ballscrew.questions.select.requirements import LIFT_OFF, OBJECTIVES, USUAL_OBJECTIVES, front, objectives_named
from ballscrew.questions.shared.check_lines import with_unlikely
from ballscrew.questions.shared.declared import FINITE
from ballscrew.questions.shared.every_row import each
from ballscrew.questions.shared.question import Done

#: Candidates of the catalogue whose friction is computed unless the list is to be complete: more take minutes.
MOST_JUDGED = 150
#: Variants at most: more take hours.
MOST_VARIANTS = 20_000
#: Candidates with a motion of one kind of nut from which on their friction is recorded and compiled, which takes some
#: seconds: of balls with two contacts, and of balls with four.
WORTH_RECORDING, WORTH_RECORDING_FOUR = 25, 50


#: Seconds of one processor for a candidate by the full model: at an operating point, over a cycle, and over a cycle
#: whose friction is recorded. They say what a selection costs and decide nothing.
SECONDS: Mapping[str, float] = {"point": 0.08, "cycle": 0.35, "recorded": 0.15}


class Unasked(NamedTuple):
    """An input that a need leaves empty, and the checks that nobody can judge without it."""

    #: By section.field of a case file.
    input: str
    #: The checks that are not judged without it.
    checks: Sequence[str]


#: What a need may leave empty though checks need it.
UNASKED = (
    Unasked("limits.running_time", ("life", "running_time")),
    Unasked("installation.unsupported_length", ("buckling", "critical_speed")),
    Unasked("installation.ends", ("buckling", "critical_speed")),
)


@dataclasses.dataclass(frozen=True)
class Plan:
    """Plan of a selection, before it is done."""

    #: Rows, nuts, preloads and oils, each with each.
    candidates: int
    #: Time of one processor at most: those that their loads rule out cost next to nothing.
    seconds: Annotated[Duration, FINITE]
    #: Inputs that the need leaves empty.
    unasked: Sequence[Unasked]


@dataclasses.dataclass(frozen=True, eq=False)
class Ranked:
    """A candidate with its rank, from 1, and whether no other one that fits beats it in all objectives."""

    rank: int
    candidate: Candidate
    pareto: bool


@dataclasses.dataclass(frozen=True, eq=False)
class Selection:
    """The candidates of a need, the best first."""

    #: The need as it was read.
    need: Need
    #: The objectives of the Pareto mark; the first ranks.
    objectives: Sequence[str]
    #: The candidates with their ranks.
    ranked: Sequence[Ranked]
    #: What was left out, and why.
    notes: Sequence[str] = ()
    #: Ctrl-C came before all candidates were judged.
    interrupted: bool = False
    #: Name of the model that they were judged by, in place of that of the need.
    model: str | None = None

    @property
    def holding(self) -> Sequence[Ranked]:
        """The candidates whose checks were all judged and hold."""
        return [result for result in self.ranked if result.candidate.holds]

    @property
    def best(self) -> Candidate | None:
        """The first that holds and lies within the validity of the model; None where there is none."""
        result = next((each for each in self.ranked if each.candidate.holds and each.candidate.valid), None)
        return None if result is None else result.candidate


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
    complete: bool = False,
    done: Done | None = None,
    found_one: Callable[[Candidate], None] | None = None,
) -> Selection:
    """Rows of the catalogue with every nut, preload and oil of a need, judged and ranked: a :class:`Selection`.

    ``need`` is a file, its tables, or a need that was read (:func:`~ballscrew.questions.select.need.need_of`);
    ``settings`` of the form ``section.field=value`` win over file and tables. ``model`` names the model of friction and
    ``calibration`` a named one in place of those of the need, and with ``allow_code`` laws of files of the user's own
    are imported.

    Each candidate is the case that ``ballscrew check`` would take, of a need with a motion that of ``ballscrew duty``:
    nothing is estimated. What follows from loads and sizes alone is judged first; of those that it rules out by more
    than :data:`~ballscrew.questions.select.candidates.NEARLY` the friction is asked for only if the list is to be
    ``complete``, which changes no rank. Of the rows shipped, where their loads allow more than :data:`MOST_JUDGED`
    candidates, those with the least load times diameter over lead are judged and ranked, with a note, and all if the
    list is to be ``complete``; of a table of one's own all are.

    First come those of which no check fails, within the validity of the model before those outside, members of the
    Pareto front before others, then by the first of the ``objectives``. Those that fail follow by their largest
    utilisation, then the first objective, and last those that their loads rule out, by the largest utilisation that
    loads decide; of equal ones the label is next. Where a need asks for no life, those of less than
    :data:`~ballscrew.questions.select.candidates.USUAL_LIFE` are ranked as if they failed it by as much. ``rows`` is a
    table of one's own in place of the catalogue, ``words`` what rows must have in name, source or kind of nut.
    ``found_one`` gets each candidate as it comes, and ``done(finished, total)`` is told their number.

    Raises :class:`~ballscrew.basis.errors.InputError` for faults of the need, and of rows; with ``keep_going`` rows at
    fault are left out, with a note, if any other is good.
    """
    ready = _prepared(need, rows, words, objectives, settings, keep_going=keep_going)
    asked, every = ready.need, ready.variants
    if "running_time" not in asked.tables.get("limits", {}):
        hours = units.grouped(round(USUAL_LIFE / 3600))
        note = f"no life was asked for: what lives less than {hours} h is ranked after the others"
        asked = asked.with_note(note)
    recorded = _worth_recording(asked, every)

    def case_of_one(variant: Variant) -> Case:
        return case_of(asked, variant, model=model, calibration=calibration, allow_code=allow_code)

    known = each_by_loads(asked, every, case_of_one, done)
    if ready.table is None and not complete:
        every, note = _most_likely(every, known)
        asked = asked.with_note(note) if note else asked

    def work(variant: Variant) -> Candidate:
        candidate = known[variant.label]
        if isinstance(candidate, InputError):
            raise candidate
        if complete or not candidate.cannot_hold:
            candidate = judged(asked, candidate, recorded=variant.nut in recorded)
        if found_one is not None:
            found_one(candidate)
        return candidate

    # a variant that no maker could build, such as a preload beyond its rating, is left out of the shipped rows, too
    result = each({one.label: one for one in every}, work, keep_going=keep_going or ready.table is None, done=done)
    if asked.length_is_stroke:  # each candidate says its own length
        asked = asked.with_note(f"unsupported length: {LENGTH_OF_STROKE}")
    candidates = list(result.found.values())
    return Selection(
        asked,
        ready.objectives,
        ranked(candidates, ready.objectives),
        [*ready.notes, *result.notes],
        result.interrupted,
        model,
    )


def _most_likely(
    every: Sequence[Variant], known: Mapping[str, Candidate | InputError]
) -> tuple[Sequence[Variant], str]:
    """The variants whose friction is computed where their loads allow more than :data:`MOST_JUDGED`, and a note.

    Friction at a given speed of the nut grows about with load and preload, and with diameter over lead.
    """

    def friction(candidate: Candidate) -> float:
        screw = candidate.case.screw
        return (abs(candidate.load) + candidate.preload) * float(screw.pitch_circle_diameter / screw.lead)

    able = [one for one in known.values() if isinstance(one, Candidate) and not one.cannot_hold]
    if len(able) <= MOST_JUDGED:
        return every, ""
    left_out = {one.variant.label for one in sorted(able, key=friction)[MOST_JUDGED:]}
    note = (
        f"of {len(able)} candidates that can hold by their loads, the {MOST_JUDGED} with the least load times diameter "
        "over lead are judged: name rows, or --complete for all"
    )
    return [one for one in every if one.label not in left_out], note


def plan(
    need: str | Path | Mapping[str, Any] | Need,
    *,
    rows: str | Path | None = None,
    words: str | None = None,
    settings: Sequence[str] = (),
    keep_going: bool = False,
) -> Plan:
    """Plan of a selection: its candidates, about the time it takes, and the requirements that it could not judge.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`select` does for faults of the need and of the table.
    """
    ready = _prepared(need, rows, words, None, settings, keep_going=keep_going)
    asked, every = ready.need, ready.variants
    seconds = 0.0
    recorded = _worth_recording(asked, every)
    for variant in every:
        seconds += SECONDS["point"] if not asked.moves else SECONDS["recorded" if variant.nut in recorded else "cycle"]
    if ready.table is None:  # of the shipped rows no more are judged
        seconds *= min(1.0, MOST_JUDGED / len(every))
    return Plan(len(every), seconds, tuple(one for one in UNASKED if _is_open(asked, one.input)))


def _is_open(need: Need, place: str) -> bool:
    """Test whether a need leaves an input empty; a stroke stands for the length, once the ends are known."""
    section, _, name = place.partition(".")
    table = need.tables.get(section)
    if isinstance(table, Mapping) and name in table:
        return False
    return not (name == "unsupported_length" and need.requirements.stroke is not None)


class _Prepared(NamedTuple):
    """A need with its objectives and what is to be judged for it."""

    need: Need
    objectives: Sequence[str]
    variants: Sequence[Variant]
    table: Path | None
    notes: Sequence[str]


def _prepared(
    need: str | Path | Mapping[str, Any] | Need,
    rows: str | Path | None,
    words: str | None,
    objectives: Sequence[str] | None,
    settings: Sequence[str],
    *,
    keep_going: bool,
) -> _Prepared:
    asked = need_of(need, settings)
    names = asked.objectives if objectives is None else objectives_named(objectives, "objectives")
    table = None if rows is None else Path(rows)
    listed, notes = catalogue.load(table, keep_going)
    chosen, refused = catalogue.computable(catalogue.chosen(listed, asked.rows if words is None else words, table))
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
    return _Prepared(asked, names, every, table, [*notes, *refused])


def _worth_recording(need: Need, every: Sequence[Variant]) -> frozenset[str]:
    """The kinds of nuts of which so many candidates move that their friction is recorded and compiled once."""
    if not need.moves or not kernel.available():
        return frozenset()
    counts = Counter(variant.nut for variant in every)
    four = {nut for nut in counts if nut in NUTS and NUTS[nut].contacts_per_ball == 4}
    return frozenset(
        nut for nut, count in counts.items() if count >= (WORTH_RECORDING_FOUR if nut in four else WORTH_RECORDING)
    )


def ranked(candidates: Sequence[Candidate], objectives: Sequence[str]) -> list[Ranked]:
    """Candidates in their order, see :func:`select`."""
    fitting = [candidate for candidate in candidates if candidate.fits and candidate.life_short <= 1]
    # an estimate beyond the validity of the model beats nothing that is within it
    fitting = [result for result in fitting if result.valid] or fitting
    costs = np.array([costs_of(result, objectives) for result in fitting]).reshape(len(fitting), len(objectives))
    best = {id(result) for result, leads in zip(fitting, front(costs), strict=True) if leads}

    def key(candidate: Candidate) -> tuple[Any, ...]:
        if candidate.cannot_hold:  # by what is known with and without the full model
            return (2, candidate.worst_by_loads, candidate.variant.label)
        first = costs_of(candidate, objectives[:1])[0]
        number = math.inf if math.isnan(first) else first
        if not candidate.fits or candidate.life_short > 1:
            return (1, max(candidate.worst, candidate.life_short), number, candidate.variant.label)
        return (0, not candidate.valid, id(candidate) not in best, number, candidate.variant.label)

    ordered = sorted(candidates, key=key)
    return [Ranked(place, result, id(result) in best) for place, result in enumerate(ordered, start=1)]


def costs_of(candidate: Candidate, objectives: Sequence[str]) -> list[float]:
    """The objectives of a candidate, less being better; an infinite life is a number, too."""
    return [OBJECTIVES[name].sign * candidate.objectives[name] for name in objectives]


def verdict(result: Candidate) -> str:
    """All checks in a few words, with the utilisation of those that fail."""
    if result.complete:
        said = verdict_of(result.checks, passes="holds", by_how_much=True)
    else:
        names = ", ".join(failing(check) for check in result.failed)
        said = f"cannot hold: {names}"
    text = with_unlikely(said, result.case)
    limit = result.rigid_lift_off_load
    if limit is not None:
        text += f"; preload lost (rigid bodies: above {units.shown(limit, LIFT_OFF)})"
    return text if result.valid else f"{text}; outside the model's validity"


class BrakeOfNeed(NamedTuple):
    """Torques that the brake of an axis must hold."""

    #: True where the axis starts to move by itself, or goes on once started.
    falls: bool
    holding_torque: Annotated[Torque, Info("M_h", "largest torque that keeps the axis at rest")]
    load_torque: Annotated[Torque, Info("M_l", "torque of the load without any friction")]
    brake_torque: Annotated[Torque, Info("M_b", "rated torque of a brake")]
