"""The answer of a selection: its candidates, declared once, the case file of one, and the work of a request.

JSON, its units and its schema follow from the annotations.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Annotated, Any, Literal, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.atomic_files import atomic_write
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Force, Info, Length, Ratio, fields_of, quantities_of
from ballscrew.basis.records import documents
from ballscrew.cases.case_files import case_file, descriptions, project
from ballscrew.cases.case_files.case_file import ASIDE, ESTIMATES
from ballscrew.cases.case_files.named_calibration import NO_CALIBRATION, with_calibration
from ballscrew.cases.case_files.opened_file import moved
from ballscrew.cases.schema.case_schema import sections
from ballscrew.cases.screw_tables.catalogue import assumed_fields
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.friction.validity import STARVED
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.checks import judged
from ballscrew.questions.check.answer import check_document, list_document
from ballscrew.questions.duty import verdicts
from ballscrew.questions.duty.compute import NUMBERS, DutyReport, FullBath
from ballscrew.questions.select import CASE_FILE, ListOptions, SelectOptions, TableOptions
from ballscrew.questions.select.candidates import Candidate, assumes_preload, case_tables
from ballscrew.questions.select.compute import BrakeOfNeed, Ranked, Selection, plan, select, verdict
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.requirements import OBJECTIVES, Requirements
from ballscrew.questions.select.sheet import cost, sheet
from ballscrew.questions.shared import declared
from ballscrew.questions.shared.declared import FINITE, from_attributes, table_of
from ballscrew.questions.shared.question import Answer, Done, Request, Work

_ROW = quantities_of(CatalogueRow)


class CycleOfNeed(table_of(NUMBERS)):
    """Numbers of the cycle of a need."""


class Objectives(table_of({name: one.quantity for name, one in OBJECTIVES.items()})):
    """The numbers compared."""


class Failing(NamedTuple):
    """A check that fails."""

    #: Of the check.
    name: str
    #: Demand over capacity; null where the check is a question of yes or no.
    utilisation: Ratio


class RowSizes(NamedTuple):
    """Sizes of a row, and its source."""

    nominal_diameter: Annotated[Length, _ROW["nominal_diameter"].info, FINITE]
    lead: Annotated[Length, _ROW["lead"].info, FINITE]
    #: Where the row is from.
    source: str


class OneObjective(NamedTuple):
    """A number that is compared."""

    #: In options and documents.
    name: str
    #: What it is.
    meaning: str
    #: SI.
    unit: str
    #: The direction that is better.
    better: Literal["less", "more"]


@dataclasses.dataclass(frozen=True, eq=False)
class OneCandidate:
    """A row with a nut, a preload and an oil, its rank, and the numbers compared."""

    #: From 1, the best.
    rank: int
    #: Of the row.
    name: str
    #: Row, nut, preload and oil.
    label: str
    #: Of the row.
    row: RowSizes
    #: Kind of the nut.
    nut: str
    preload: Annotated[Force, NUT_FIELDS["preload"].info]
    #: Name of the oil.
    oil: str
    #: True where all checks were judged and hold.
    holds: bool
    #: False where its loads alone rule it out: friction was not computed, results are empty.
    complete: bool
    #: True within the validity of the model, as far as it was computed.
    valid: bool
    #: True where no other candidate that fits is better in all objectives.
    pareto: bool
    rigid_lift_off_load: Annotated[
        Force | None,
        Info("F_l", "load above which rigid bodies lose the preload, of a nut that has none left; null: some is left"),
    ]
    #: Largest utilisation.
    worst: Ratio
    #: The checks that fail.
    fails: Sequence[Failing]
    #: All checks in a few words.
    verdict: str
    #: The numbers compared.
    objectives: Objectives
    #: Its case file as tables.
    case: Mapping[str, Any]
    #: True where the torque in a full bath of oil is larger: loss and torques compared are the larger.
    starved: bool


class MotorTorque(table_of({name: NUMBERS[name] for name in ("torque_peak", "torque_rms")})):
    """The torques that a motor is chosen by."""


@dataclasses.dataclass(frozen=True, eq=False)
class OfMotion:
    """Values that a candidate has beside the others where the need has a motion."""

    #: Numbers of its cycle, where the need has a motion.
    duty: CycleOfNeed
    #: Those in a full bath of oil; null by the rule of catalogues, which knows no oil.
    full_bath: FullBath | None
    #: The torques that a motor is chosen by.
    motor_torque: MotorTorque
    #: What the brake must hold.
    brake: BrakeOfNeed


def candidate(ranked: Ranked, verdict: str, case: Mapping[str, Any]) -> OneCandidate:
    """A candidate with its rank, all checks in a few words, and its case file."""
    result, row = ranked.candidate, ranked.candidate.variant.row
    return from_attributes(
        OneCandidate,
        result,
        rank=ranked.rank,
        label=result.variant.label,
        row=RowSizes(row.nominal_diameter, row.lead, row.source),
        nut=result.variant.nut,
        oil=result.variant.oil_name,
        pareto=ranked.pareto,
        worst=worst(result),
        fails=fails(result),
        verdict=verdict,
        objectives=Objectives(**result.objectives),
        case=case,
        starved=bool(result.starved),
    )


def worst(result: Candidate) -> float | None:
    """The largest utilisation; None where it is not finite."""
    return result.worst if math.isfinite(result.worst) else None


def fails(result: Candidate) -> list[Failing]:
    """The checks that fail."""
    return [Failing(check.name, check.utilisation) for check in result.failed]


def of_motion(duty: DutyReport) -> OfMotion:
    """The cycle of a candidate."""
    return OfMotion(
        CycleOfNeed(**duty.numbers),
        duty.full_bath,
        MotorTorque(**duty.motor_torque),
        from_attributes(BrakeOfNeed, duty.brake),
    )


def objective(name: str) -> OneObjective:
    """An objective with meaning, unit, and the direction that is better."""
    one = OBJECTIVES[name]
    return OneObjective(name, one.quantity.info.meaning, one.quantity.unit, "more" if one.larger_is_better else "less")


#: What is the same for all candidates, or too long for a list.
_LEFT_OUT = ("units", "provenance", "loads", "name", "checks", "judged", "holds", "verdict")


def document(selection: Selection, listed: Sequence[Ranked] | None = None) -> dict[str, Any]:
    """The document in SI; ``results`` and ``checks`` of a candidate are those of ``ballscrew check --json``.

    Candidates are those ``listed``, or all of them.
    """
    first = next((each.candidate for each in selection.ranked if each.candidate.complete), None)
    known: dict[str, Any] = {} if first is None else list_document([first.checked])[0]["units"]
    known.pop("loads", None)
    best, moves = selection.best, selection.need.moves
    return {
        "need": need_document(selection.need),
        "objectives": objectives_document(selection.objectives),
        "best": None if best is None else best.variant.label,
        "holding": len(selection.holding),
        "ruled_out": sum(not each.candidate.complete for each in selection.ranked),
        "candidates": [
            candidate_document(each, selection.need, selection.model)
            for each in (selection.ranked if listed is None else listed)
        ],
        "notes": list(selection.notes),
        "warnings": documents(
            next((each.candidate.starved for each in selection.ranked if each.candidate.starved), [])
        ),
        "units": {
            **known,
            **declared.units_of(OneCandidate),
            **(declared.units_of(OfMotion) if moves else {}),
        },
        "provenance": descriptions.of_case(selection.ranked[0].candidate.case) if selection.ranked else None,
    }


def row_document(result: Candidate) -> dict[str, Any]:
    """A candidate as it comes, before it has a rank: what is seen in the list."""
    return {
        "label": result.variant.label,
        "complete": result.complete,
        "fits": result.fits,
        "holds": result.holds,
        "worst": worst(result),
        "fails": declared.document(fails(result)),
        "objectives": dict(result.objectives),
    }


def need_document(need: Need) -> dict[str, Any]:
    """A need: its tables as they are written, what it requires in SI, and the choices that are open."""
    required = need.requirements
    numbers = {name: getattr(required, name) for name in fields_of(Requirements)}
    return {
        "name": need.name,
        "tables": dict(need.tables),
        "requirements": {
            **{name: value for name, value in numbers.items() if value is not None},
            "back_driving": required.back_driving,
            **({"accuracy": required.accuracy} if required.accuracy else {}),
        },
        "choices": {"nut": list(need.nuts), "preload": list(need.preloads), "oils": [dict(oil) for oil in need.oils]},
        "rows": need.rows,
        "assumed": list(need.notes),
    }


def objectives_document(names: Any) -> list[dict[str, Any]]:
    """Objectives with meaning, unit, and the direction that is better."""
    return [declared.document(objective(name)) for name in names]


def candidate_document(ranked: Ranked, need: Need, model: str | None = None) -> dict[str, Any]:
    """One candidate: the document of its check, with its rank, what fails, the numbers compared, and its case file."""
    result = ranked.candidate
    whole: dict[str, Any] = {"results": {}, "verdicts": [], "warnings": [], "assumed": []}
    if result.run is not None:
        whole = list_document([result.run])[0]
        if result.duty is not None:  # of the cycle, and not of steady travel
            for name, more in (("verdicts", verdicts.inertia), ("warnings", verdicts.inertia_warnings)):
                whole[name] = [one for one in whole[name] if one["id"] != STARVED] + documents(more(result.duty))
        if not any(one["id"] == STARVED for name in ("verdicts", "warnings") for one in whole[name]):
            # of the cycle, or of the nut without load
            whole["warnings"] = [*documents(result.starved), *whole["warnings"]]
    return {
        **declared.document(candidate(ranked, verdict(result), tables_of(result, need, model))),
        "results": whole.pop("results"),
        **({} if result.duty is None else declared.document(of_motion(result.duty))),
        "checks": [check_document(check) for check in result.checks],
        "judged": judged(result.checks),
        **{name: part for name, part in whole.items() if name not in (*_LEFT_OUT, "nut")},
    }


def prepare(request: Request) -> Work:
    """The work for an answer; a request is read and checked at once."""
    options, listed = request.options(SelectOptions), request.options(ListOptions)
    table = request.options(TableOptions)
    assert request.need is not None
    if listed.rank is not None and not any(map(_is_case, request.to)):
        raise InputError(Fault("--rank", "names no file", str(listed.rank), "add --to axis.toml"))
    refuse_overwriting(request, *([] if table.rows is None else [Path(table.rows)]))
    need, words = request.need, options.words or None
    settings = request.case_options.settings
    planned = plan(need, rows=table.rows, words=words, settings=settings, keep_going=table.keep_going)
    if listed.rank is not None and listed.rank > planned.candidates:
        raise _no_such_rank(listed.rank, planned.candidates)

    def answer(done: Done) -> Answer:
        selection = select(
            need,
            rows=table.rows,
            words=words,
            objectives=objectives(listed.objectives),
            **vars(request.case_options),
            keep_going=table.keep_going,
            complete=options.complete,
            done=done,
            found_one=lambda candidate: request.send(row_document(candidate)),
        )
        shown = [
            each
            for each in selection.ranked
            if (each.candidate.fits or not listed.holds) and (each.pareto or not listed.front)
        ]

        def write(path: Path) -> str:
            return _write_case(path, selection, shown, listed.rank)

        return Answer(
            sheet(selection, shown, listed.first),
            lambda: document(selection, shown),
            f"{len(shown)} candidates",
            write=write,
            notes=selection.notes,
            is_interrupted=selection.interrupted,
        )

    return Work(answer, "candidates", cost=cost(planned))


def plan_document(request: Request) -> Any:
    """The document of the plan."""
    options, table = request.options(SelectOptions), request.options(TableOptions)
    assert request.need is not None
    return declared.document(
        plan(request.need, rows=table.rows, words=options.words or None, keep_going=table.keep_going)
    )


def _is_case(path: Path) -> bool:
    return path.suffix.lower() == CASE_FILE


def _write_case(path: Path, selection: Selection, shown: Sequence[Ranked], rank: int | None) -> str:
    """Write the case of a candidate, and return what is in it."""
    chosen = _chosen(path, selection, shown, rank)
    text = verdict(chosen.candidate)
    save_case(path, selection, chosen, text)
    return f"{chosen.candidate.variant.label}, rank {chosen.rank}: {text}"


def _chosen(path: Path, selection: Selection, shown: Sequence[Ranked], rank: int | None) -> Ranked:
    """The candidate of a rank, or the first of those that are shown."""
    candidates = shown if rank is None else [each for each in selection.ranked if each.rank == rank]
    if candidates:
        return candidates[0]
    if rank is None:
        raise InputError(Fault("--to", "there is no candidate to write", str(path), "leave out --holds and --front"))
    raise _no_such_rank(rank, len(selection.ranked))


def _no_such_rank(rank: int, candidates: int) -> InputError:
    return InputError(Fault("--rank", "there is no such candidate", str(rank), f"there are {candidates}"))


def objectives(written: Sequence[str]) -> list[str] | None:
    """The names of objectives, also of those written with a dash; None for those of the need."""
    return [name.replace("-", "_") for name in written] or None


def refuse_overwriting(request: Request, *others: Path) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for a file that would be written over one that is read.

    These are the need, whatever file it names, and ``others``.
    """
    need = request.need
    if not isinstance(need, Path) or not any(path.exists() for path in request.to):
        return
    need_file = project.file_of(need)
    tables = case_file.override(case_file.read(need), request.case_options.settings)
    named = [need_file.parent / name for name in _texts(tables)]
    for path in filter(Path.exists, request.to):
        if _is_same(path, need_file):
            raise InputError(Fault("--to", "is the file of the need", str(path), "choose another name"))
        if any(_is_same(path, other) for other in (*others, *named)):
            raise InputError(Fault("--to", "is a file that is read", str(path), "choose another name"))


def _texts(value: Any) -> Iterator[str]:
    """All texts in tables: any of them may name a file."""
    if isinstance(value, str):
        yield value
    elif isinstance(value, Mapping):
        for item in value.values():
            yield from _texts(item)
    elif isinstance(value, list):
        for item in value:
            yield from _texts(item)


def _is_same(path: Path, other: Path) -> bool:
    try:
        return path.samefile(other)
    except (OSError, ValueError):  # no such file, or no name of one
        return False


def tables_of(candidate: Candidate, need: Need, model: str | None = None) -> dict[str, Any]:
    """The case file of a candidate; one that moves has its steady travel as operation, for all other questions.

    ``model`` is the name of the one that it was judged by, in place of that of the need.
    """
    known, at = fields_of(OperatingState), candidate.case.operation
    steady = {name: units.written(getattr(at, name), known[name]) for name in ("axial_load", "screw_speed")}
    made = case_tables(need, candidate.variant)
    if need.moves and "operation" not in made:
        made["operation"] = steady
    if model is not None:
        made["model"] = {**made.get("model", {}), "name": model}
    estimates = _estimates(candidate, need, made)
    if estimates:
        made[ESTIMATES] = estimates
    if candidate.case.origins.calibration is not None:
        return {**with_calibration(made, candidate.case.origins.calibration.name)}
    return {**with_calibration(made, NO_CALIBRATION)} if "calibration" in made.get("model", {}) else made


def save_case(to: Path, selection: Selection, chosen: Ranked, said: str) -> None:
    """Write the case of a candidate; ``said`` is what its checks say."""
    with atomic_write("--to", to) as path:
        path.write_text(case_text(selection, chosen, said, folder=to.parent), encoding="utf-8")


def case_text(selection: Selection, chosen: Ranked, said: str, *, folder: Path = Path()) -> str:
    """The case of a candidate as TOML for a file in ``folder``; what was assumed stands in its comments."""
    import tomlkit

    candidate, need = chosen.candidate, selection.need
    made = tables_of(candidate, need, selection.model)
    if need.folder.resolve() != folder.resolve():
        kept = made.pop(ASIDE, None)  # no command reads it
        made = {**moved(made, need.folder, folder), **({} if kept is None else {ASIDE: kept})}
    order = [name for name in (*sections(), *made) if name in made]
    ordered = {name: made[name] for name in dict.fromkeys(order)}
    head = [
        f"{candidate.variant.label}: rank {chosen.rank} of {len(selection.ranked)} for {need.name}",
        f"written by ballscrew select; checks: {said}",
        *(f"assumed: {note}" for note in _assumed(candidate, need)),
    ]
    if ESTIMATES in made:
        head.append("[estimates] repeats the values that were estimated: change one above, and it is yours")
    comments = "".join(f"# {' '.join(line.split())}\n" for line in head)
    return f"{comments}\n{tomlkit.dumps(ordered)}"


def _estimates(candidate: Candidate, need: Need, made: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The values of a case that were estimated, by section: those of its need still hold if the case has them."""
    variant = candidate.variant
    places = [*need.assumed_oil]
    if assumes_preload(need, variant):
        places.append("nut.preload")
    if need.length_is_stroke:
        places.append("installation.unsupported_length")
    if variant.file is not None:  # the numbers of the row stand in the case
        given = need.tables.get("screw", {})
        places += [f"screw.{name}" for name in sorted(assumed_fields(variant.row)) if name not in given]
    estimates = {section: dict(values) for section, values in made.get(ESTIMATES, {}).items()}
    for place in places:
        section, _, name = place.partition(".")
        if name in made.get(section, {}):
            estimates.setdefault(section, {})[name] = made[section][name]
    return estimates


def _assumed(candidate: Candidate, need: Need) -> list[str]:
    """Assumptions about the need and the row, once each."""
    of_run = () if candidate.run is None else candidate.run.assumed
    return [*dict.fromkeys((*need.notes, *of_run))]
