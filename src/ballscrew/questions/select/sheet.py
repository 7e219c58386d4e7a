"""The sheet of a selection: candidates, the best first, what they were compared with, and their objectives."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from ballscrew.basis import units
from ballscrew.basis.output.sheet import (
    Axis,
    Cell,
    Cells,
    Chart,
    Colour,
    Columns,
    Curve,
    Number,
    Sheet,
    Table,
    columns_of,
    lines,
)
from ballscrew.basis.output.text import wrapped
from ballscrew.basis.quantities import fields_of, quantities_of
from ballscrew.questions.check.sheet import cells
from ballscrew.questions.duty import verdicts
from ballscrew.questions.duty.compute import NUMBERS, DutyReport
from ballscrew.questions.run import compute
from ballscrew.questions.select.candidates import Candidate
from ballscrew.questions.select.compute import BrakeOfNeed, Plan, Ranked, Selection, verdict
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.requirements import ALLOWED, OBJECTIVES, Requirements
from ballscrew.questions.shared import check_lines

#: What stands against a limit, where the list prints something else.
_OF_LIMIT = {"rigidity": ["that of the balls under the load, in the list, or of the nut by ISO 3408-4 if it is less"]}
#: Lines shown where nothing else is said.
USUAL_LINES = 20
_DIGITS = 3
#: Objectives in the headings of tables.
LABELS = {
    "loss": "loss",
    "inertia": "inertia",
    "reflected_mass": "adds mass",
    "life": "life",
    "rigidity": "rigidity",
    "drive_torque": "torque",
    "preload_torque": "drag torque",
    "price_index": "price",
}
#: Torques of a need with a motion, by their headings.
_OF_MOTION: Mapping[str, Callable[[DutyReport], float]] = {
    "motor, largest": lambda report: report.motor_torque["torque_peak"],
    "motor, RMS": lambda report: report.motor_torque["torque_rms"],
    "brake holds": lambda report: report.brake.holding_torque,
}
#: Members of the front whose ranks stand in a picture, and spans of an axis beyond which it is logarithmic.
_NAMED, _DECADE = 6, 10.0


def sheet(selection: Selection, ranked: Sequence[Ranked], most: int = USUAL_LINES) -> Sheet:
    """All that people see of a selection: the first of those ranked, all of them in files; zero stands for all."""
    shown = ranked[:most] if most else ranked
    return Sheet(
        title(selection),
        [
            lines(_answer(selection), "verdict"),
            _candidates(selection, shown),
            lines(_remarks(selection, ranked, len(shown))),
            lines(compared_with(selection)),
            lines((*what_turns(ranked), *beside_rules(selection))),
            lines(_legend(selection), "small"),
            lines(_assumed(selection.need), "small"),
            *_charts(selection),
            of_selection(ranked),
        ],
    )


def title(selection: Selection) -> str:
    """``need.toml: 16 of 104 candidates hold``."""
    return f"{selection.need.name}: {len(selection.holding)} of {len(selection.ranked)} candidates hold"


def _answer(selection: Selection) -> Iterator[str]:
    """Reason why none holds, and what is to be given so that one can."""
    reason, missing = not_judged(selection), _missing([each.candidate for each in selection.ranked])
    if reason:
        yield reason
    elif missing:
        yield f"a candidate holds only once all checks are judged: give {', '.join(missing)}"
    elif selection.best is None:
        which = "none of the candidates judged so far" if selection.interrupted else "no candidate"
        yield f"{which} holds within the validity of the model: look at what fails first, and by how much"


def _candidates(selection: Selection, ranked: Sequence[Ranked]) -> Table:
    """A row for each: rank, label, objectives, verdict; the oil is named where there are several.

    Of a need with a motion with the torque of the motor and what a brake has to hold.
    """
    with_oil, of_motion = len(selection.need.oils) > 1, _OF_MOTION if selection.need.moves else {}
    digits = max((len(str(each.rank)) for each in ranked), default=1)
    rows: list[Sequence[Cell]] = []
    for each in ranked:
        duty = each.candidate.duty
        numbers = [each.candidate.objectives[name] for name in selection.objectives]
        torques = (math.nan if duty is None else read(duty) for read in of_motion.values())
        rows.append(
            [
                f"{each.rank:>{digits}}{'*' if each.pareto else ' '} {_label(each.candidate, with_oil=with_oil)}",
                *(
                    Number(value, OBJECTIVES[name].quantity, _DIGITS)
                    for name, value in zip(selection.objectives, numbers, strict=True)
                ),
                *(Number(torque, NUMBERS["torque_peak"]) for torque in torques),
                verdict(each.candidate),
            ]
        )
    headings = ("", *(LABELS[name] for name in selection.objectives), *of_motion, "verdict")
    return Table("candidates", "candidate", headings, rows)


def _label(candidate: Candidate, *, with_oil: bool) -> str:
    variant = candidate.variant
    nut = "" if variant.nut == (variant.row.nut or "single") else variant.nut
    return ", ".join(filter(None, [variant.row.name, nut, variant.preload, variant.oil_name if with_oil else ""]))


def _remarks(selection: Selection, ranked: Sequence[Ranked], shown: int) -> Iterator[str]:
    """Remarks on what is not in the list, or stands in it otherwise than it was computed."""
    if shown < len(ranked):
        yield f"… {len(ranked) - shown} more: --first 0 shows all"
    if not ranked:
        yield "none is left of these"
    starved = [each for each in ranked if each.candidate.starved]
    if starved:
        first = starved[0]
        yield (
            f"{len(starved)} are starved of oil: compared are the larger loss and torque, those in a full bath; "
            f"{first.rank}: {first.candidate.starved[0].text}"
        )
    ruled_out = sum(not each.candidate.complete for each in selection.ranked)
    if ruled_out:
        yield f"{ruled_out} cannot hold by their loads alone; their friction was not computed: --complete computes it"


def _assumed(need: Need) -> list[str]:
    return ["assumed:", *(f"  {note}" for note in need.notes)] if need.notes else []


def _legend(selection: Selection) -> list[str]:
    *others, last = (LABELS[name] for name in selection.objectives)
    named = f"{', '.join(others)} and {last}" if others else last
    front = f"* Pareto front: of the candidates that fail no check, none is better in {named} taken together"
    return [", ".join(asked(selection.need)), front]


def cost(plan: Plan) -> str:
    """``candidates: 104, 16 s of a processor at most``: what a selection costs and cannot judge, before it starts."""
    lines = [f"candidates: {plan.candidates}, {max(1.0, plan.seconds):.2g} s of a processor at most"]
    if plan.unasked:
        checks = dict.fromkeys(check.replace("_", " ") for one in plan.unasked for check in one.checks)
        inputs = ", ".join(one.input for one in plan.unasked)
        lines.append(f"not judged, as nothing is given for {inputs}: {', '.join(checks)}")
    return "\n".join(map(wrapped, lines))


def not_judged(selection: Selection) -> str:
    """Reason why none holds, if some do not fail: ``12 of them fail no check, but …``; empty where that is not so."""
    fitting = [each.candidate for each in selection.ranked if each.candidate.fits]
    missing = _missing([each.candidate for each in selection.ranked])
    if selection.holding or not fitting or not missing:
        return ""
    needed = ", ".join(missing)
    return f"{len(fitting)} of them fail no check, but a candidate holds only once all are judged: give {needed}"


def _missing(candidates: Sequence[Candidate]) -> list[str]:
    """Values missing for checks, each once."""
    return sorted({check.missing for each in candidates for check in each.checks if check.missing})


def asked(need: Need) -> list[str]:
    """Demands of a need on load, speed, mounting and life, as it is written."""
    known, required = fields_of(Requirements), need.requirements
    numbers = {name: getattr(required, name) for name in known}
    return [
        *(
            f"{key} {value}".replace("_", " ")
            for section in ("operation", "installation", "limits")
            if isinstance(table := need.tables.get(section), dict)
            for key, value in table.items()
        ),
        *(
            f"{name.replace('_', ' ')} {units.shown(value, known[name])}"
            for name, value in numbers.items()
            if value is not None
        ),
        *([] if required.back_driving == ALLOWED else [f"back-driving {required.back_driving}"]),
    ]


def compared_with(selection: Selection) -> list[str]:
    """The limits that any candidate fails, from the least to the largest of all candidates.

    Whose they are, with how many were compared with each, where makers have their own; and how many fail by an
    estimated limit alone.
    """
    every = [check for each in selection.ranked for check in each.candidate.checks if check.limit is not None]
    lines: list[str] = []
    for name in dict.fromkeys(check.name for check in every if check.holds is False and check.limit):
        own = sorted((check for check in every if check.name == name), key=lambda check: check.limit or 0.0)
        limits = dict.fromkeys(check_lines.shown(check, check.limit) for check in (own[0], own[-1]))
        compute = Counter(check.whose_limit for check in own if check.whose_limit)
        words = [
            " to ".join(limits),
            *_OF_LIMIT.get(name, ()),
            *(f"{maker}: {count} candidates" for maker, count in compute.items()),
        ]
        lines.append(f"{name.replace('_', ' ')} {'; '.join(words)}")
    alone = [each for each in selection.ranked if _estimate_decides(each.candidate)]
    if alone:
        lines.append(f"{len(alone)} fail by an estimated limit alone: ask the maker, and give it by [limits]")
    return ["compared with:", *(f"  {line}" for line in lines)] if lines else []


def _estimate_decides(candidate: Candidate) -> bool:
    return bool(candidate.failed) and all(check.source == "estimate" for check in candidate.failed)


def what_turns(ranked: Sequence[Ranked]) -> list[str]:
    """Inertias that the torque of the first candidate's motor accelerates, and what is missing in it.

    Beside it how many have a shaft with a larger inertia than the need gives for all that turns.
    """
    moving = [(each.rank, each.candidate.duty) for each in ranked if each.candidate.duty is not None]
    lines = [f"{rank}: {one.text}" for rank, duty in moving[:1] for one in verdicts.inertia(duty)]
    warned = [(rank, one) for rank, duty in moving for one in verdicts.inertia_warnings(duty)]
    if too_small := [(rank, one) for rank, one in warned if one.id == "duty.inertia_too_small"]:
        rank, first = too_small[0]
        lines.append(f"{len(too_small)} have a shaft of more inertia than is given; {rank}: {first.text}")
    elif warned and not lines:
        lines.append(f"{warned[0][0]}: {warned[0][1].text}")
    return lines


def beside_rules(selection: Selection) -> list[str]:
    """The torque of the best candidate without load beside the rules of makers; nothing of one without preload."""
    best = next((each for each in selection.ranked if each.candidate is selection.best), None)
    if best is None or best.candidate.run is None:
        return []
    run = best.candidate.run.run
    said = "; ".join(compute.messages(run.case, run.nut))
    return [f"{best.rank}: {said}"] if said else []


# -- files ----------------------------------------------------------------------------------------


def of_selection(ranked: Sequence[Ranked]) -> Columns:
    """Rank, row, nut, preload and oil, the objectives, and all that ``ballscrew check --to`` writes of a screw.

    Of a need with a motion with the torques of motor and brake. Cells of what was not computed are empty.
    """
    return columns_of("screws", lambda: (_cells(each) for each in ranked))


def _cells(ranked: Ranked) -> Cells:
    candidate = ranked.candidate
    plain: dict[str, Any] = {
        "rank": ranked.rank,
        "name": candidate.name,
        "nut": candidate.variant.nut,
        "preload as given": candidate.variant.preload,
        "oil": candidate.variant.oil_name,
        "holds": int(candidate.holds),
        "pareto": int(ranked.pareto),
        "largest utilisation": _finite(candidate.worst),
        "verdict": verdict(candidate),
    }
    values: dict[str, tuple[Any, Any]] = {heading: (value, None) for heading, value in plain.items()}
    values |= {
        objective.quantity.name: (candidate.objectives[name], objective.quantity)
        for name, objective in OBJECTIVES.items()
    }
    if candidate.duty is not None:
        for name, torque in candidate.duty.motor_torque.items():
            values[f"motor {name}"] = (torque, NUMBERS[name])
        for name in quantities_of(BrakeOfNeed):
            values[f"brake {name}"] = (getattr(candidate.duty.brake, name), NUMBERS["torque_peak"])
    for check in candidate.checks:
        values[f"{check.name.replace('_', ' ')} utilisation"] = (_finite(check.utilisation), None)
    of_check = cells(candidate.checked) if candidate.complete else {}
    return {**values, **{heading: cell for heading, cell in of_check.items() if heading not in values}}


def _finite(share: float | None) -> float | None:
    """A share of a limit; none where nothing of the limit is left."""
    return share if share is not None and math.isfinite(share) else None


# -- charts ---------------------------------------------------------------------------------------


def _charts(selection: Selection) -> Iterator[Chart]:
    """The objectives two by two, the first against each other one; ranks stand beside the first of the front."""
    names = list(selection.objectives)
    for other in names[1:] or ["drive_torque"]:
        x, y = (_axis(selection.ranked, name) for name in (names[0], other))
        yield Chart(f"{LABELS[other]} against {LABELS[names[0]]}", x, y, list(_dots(selection.ranked, names[0], other)))


def _axis(ranked: Sequence[Ranked], name: str) -> Axis:
    quantity = OBJECTIVES[name].quantity
    numbers = [value for each in ranked if math.isfinite(value := each.candidate.objectives[name]) and value > 0]
    return Axis(quantity.info.meaning, quantity, log=bool(numbers) and max(numbers) > _DECADE * min(numbers))


def _dots(ranked: Sequence[Ranked], x: str, y: str) -> Iterator[Curve]:
    groups: Sequence[tuple[str, Colour, Sequence[Ranked]]] = (
        ("fails", "grey", [each for each in ranked if not each.candidate.fits]),
        ("no check fails", "blue", [each for each in ranked if each.candidate.fits and not each.pareto]),
        ("Pareto front", "red", [each for each in ranked if each.pareto]),
    )
    for name, colour, members in groups:
        if not members:
            continue
        places = ([each.candidate.objectives[objective] for each in members] for objective in (x, y))
        across, up = (np.where(np.isfinite(values), values, math.nan) for values in map(np.asarray, places))
        ranks = [str(each.rank) for each in members[:_NAMED]] if colour == "red" else []
        yield Curve(name, across, up, colour, "circles" if colour == "blue" else "dots", labels=ranks)
