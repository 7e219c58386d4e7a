"""Text of a selection: one line for each candidate, the best first."""

from __future__ import annotations

import math
from collections import Counter
from collections.abc import Callable, Mapping, Sequence

from ballscrew.basis import units
from ballscrew.basis.output.wrapping import aligned_beside, wrapped
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.records import Message
from ballscrew.questions.duty import verdicts as duty_verdicts
from ballscrew.questions.duty.compute import NUMBERS, DutyReport
from ballscrew.questions.run import makers
from ballscrew.questions.select.candidates import Candidate
from ballscrew.questions.select.compute import Plan, Ranked, Selection
from ballscrew.questions.select.document import verdict
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.objectives import OBJECTIVES
from ballscrew.questions.select.requirements import ALLOWED, Requirements
from ballscrew.questions.shared import check_lines

#: What stands against a limit, where the list prints something else.
_OF_LIMIT = {"rigidity": ["that of the balls under the load, in the list, or of the nut by ISO 3408-4 if it is less"]}
#: Lines shown where nothing else is said.
USUAL_LINES = 20
#: Objectives in the headings of tables.
LABELS = {
    "loss": "loss", "inertia": "inertia", "reflected_mass": "adds mass", "life": "life", "rigidity": "rigidity",
    "drive_torque": "torque", "preload_torque": "drag torque", "price_index": "price",
}  # fmt: skip

#: Torques of a need with a motion, by their headings.
OF_MOTION: Mapping[str, Callable[[DutyReport], float]] = {
    "motor, largest": lambda report: report.motor_torque["torque_peak"],
    "motor, RMS": lambda report: report.motor_torque["torque_rms"],
    "brake holds": lambda report: report.brake.holding_torque,
}


def title(found: Selection) -> str:
    """``need.toml: 16 of 104 candidates hold``."""
    return f"{found.need.name}: {len(found.holding)} of {len(found.ranked)} candidates hold"


def cost(plan: Plan) -> str:
    """``candidates: 104, 16 s of a processor at most``: what a selection costs and cannot judge, before it starts."""
    lines = [f"candidates: {plan.candidates}, {max(1.0, plan.seconds):.2g} s of a processor at most"]
    if plan.unasked:
        checks = dict.fromkeys(check.replace("_", " ") for one in plan.unasked for check in one.checks)
        inputs = ", ".join(one.input for one in plan.unasked)
        lines.append(f"not judged, as nothing is given for {inputs}: {', '.join(checks)}")
    return "\n".join(map(wrapped, lines))


def not_judged(found: Selection) -> str:
    """Why none holds though some fail nothing: ``12 of them fail no check, but …``; empty where that is not so."""
    fitting = [each.candidate for each in found.ranked if each.candidate.fits]
    missing = _missing([each.candidate for each in found.ranked])
    if found.holding or not fitting or not missing:
        return ""
    needed = ", ".join(missing)
    return f"{len(fitting)} of them fail no check, but a candidate holds only once all are judged: give {needed}"


def _missing(candidates: Sequence[Candidate]) -> list[str]:
    """What is missing for checks, each once."""
    return sorted({check.missing for each in candidates for check in each.checks if check.missing})


def asked(need: Need) -> list[str]:
    """What a need says of load, speed, mounting and life, as it is written."""
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


def text(found: Selection, ranked: Sequence[Ranked], most: int = USUAL_LINES) -> str:
    """The first lines of those ranked, and how the list is to be read; zero stands for all."""
    shown = ranked[:most] if most else ranked
    reason = not_judged(found)
    lines = [
        title(found),
        *([wrapped(reason)] if reason else []),
        "",
        *table(shown, found.objectives, len(found.need.oils) > 1, moves=found.need.moves),
    ]
    if len(shown) < len(ranked):
        lines.append(f"… {len(ranked) - len(shown)} more: --first 0 shows all")
    starved = [each for each in ranked if each.candidate.starved]
    if starved:
        first = starved[0]
        words = (
            f"{len(starved)} are starved of oil: compared are the larger loss and torque, those in a full bath; "
            f"{first.rank}: {first.candidate.starved[0].text}"
        )
        lines += ["", wrapped(words)]
    lines += compared_with(found)
    ruled_out = sum(not each.candidate.complete for each in found.ranked)
    if ruled_out:
        words = f"{ruled_out} cannot hold by their loads alone; their friction was not computed: --complete computes it"
        lines.append(wrapped(words))
    if not ranked:
        lines.append("none is left of these")
    lines += [*what_turns(ranked), *beside_rules(found)]
    *others, last = (LABELS[name] for name in found.objectives)
    named = f"{', '.join(others)} and {last}" if others else last
    lines += [
        "",
        wrapped(f"*  Pareto front: of the candidates that fail no check, none is better in {named} taken together"),
    ]
    lines += ["", "assumed", *(wrapped(f"  {note}") for note in found.need.notes)] if found.need.notes else []
    missing = _missing([each.candidate for each in found.ranked])
    if missing and not reason:
        lines += ["", wrapped(f"a candidate holds only once all checks are judged: give {', '.join(missing)}")]
    elif found.best is None and not reason:
        which = "none of the candidates judged so far" if found.interrupted else "no candidate"
        lines += ["", f"{which} holds within the validity of the model: look at what fails first, and by how much"]
    return "\n".join(lines)


def compared_with(found: Selection) -> list[str]:
    """The limits that any candidate fails, from the least to the largest of all candidates.

    Whose they are, with how many were compared with each, where makers have their own; and how many fail by an
    estimated limit alone.
    """
    every = [check for each in found.ranked for check in each.candidate.checks if check.limit is not None]
    lines: list[str] = []
    for name in dict.fromkeys(check.name for check in every if check.holds is False and check.limit):
        own = sorted((check for check in every if check.name == name), key=lambda check: check.limit or 0.0)
        limits = dict.fromkeys(check_lines.shown(check, check.limit) for check in (own[0], own[-1]))
        sources = (check.message.values.get("source") for check in own)
        makers = Counter(units.filled(source) for source in sources if isinstance(source, Message))
        words = [
            " to ".join(limits),
            *_OF_LIMIT.get(name, ()),
            *(f"{maker}: {count} candidates" for maker, count in makers.items()),
        ]
        lines.append(f"{name.replace('_', ' ')} {'; '.join(words)}")
    alone = [each for each in found.ranked if _estimate_decides(each.candidate)]
    if alone:
        lines.append(f"{len(alone)} fail by an estimated limit alone: ask the maker, and give it by [limits]")
    return ["", "compared with", *(wrapped(f"  {line}") for line in lines)] if lines else []


def _estimate_decides(candidate: Candidate) -> bool:
    return bool(candidate.failed) and all(check.source == "estimate" for check in candidate.failed)


def what_turns(ranked: Sequence[Ranked]) -> list[str]:
    """What the torque of the first candidate's motor accelerates, and what is missing in it.

    Beside it how many have a shaft with a larger inertia than the need gives for all that turns.
    """
    moving = [(each.rank, each.candidate.duty) for each in ranked if each.candidate.duty is not None]
    lines = [f"{rank}: {one.text}" for rank, duty in moving[:1] for one in duty_verdicts.inertia(duty)]
    warned = [(rank, one) for rank, duty in moving for one in duty_verdicts.inertia_warnings(duty)]
    if too_small := [(rank, one) for rank, one in warned if one.id == "duty.inertia_too_small"]:
        rank, first = too_small[0]
        lines.append(f"{len(too_small)} have a shaft of more inertia than is given; {rank}: {first.text}")
    elif warned and not lines:
        lines.append(f"{warned[0][0]}: {warned[0][1].text}")
    return [wrapped(line) for line in lines]


def beside_rules(found: Selection) -> list[str]:
    """The torque of the best candidate without load beside the rules of makers; nothing of one without preload."""
    best = next((each for each in found.ranked if each.candidate is found.best), None)
    if best is None or best.candidate.run is None:
        return []
    run = best.candidate.run.run
    said = "; ".join(map(units.filled, makers.messages(run.case, run.nut)))
    return [wrapped(f"{best.rank}: {said}")] if said else []


def table(ranked: Sequence[Ranked], objectives: Sequence[str], with_oil: bool, *, moves: bool = False) -> list[str]:
    """A line for each: rank, mark, label, objectives, verdict. The oil is named where there are several.

    Of a need that ``moves`` with the torque of the motor and what a brake has to hold.
    """
    of_motion = [*OF_MOTION] if moves else []
    heading = ["", "", "candidate", *(LABELS[name] for name in objectives), *of_motion, "verdict"]
    cells = [
        heading,
        *(
            [
                str(each.rank),
                "*" if each.pareto else "",
                *_cells(each.candidate, objectives, with_oil),
                *(_torque(each.candidate, read) for name, read in OF_MOTION.items() if name in of_motion),
                verdict(each.candidate),
            ]
            for each in ranked
        ),
    ]
    return aligned_beside(cells, (2,))


def _cells(found: Candidate, names: Sequence[str], with_oil: bool) -> list[str]:
    one = found.variant
    nut = "" if one.nut == (one.row.nut or "single") else one.nut
    label = ", ".join(filter(None, [one.row.name, nut, one.preload, one.oil_name if with_oil else ""]))
    return [label, *(shown(name, found.objectives[name]) for name in names)]


def _torque(found: Candidate, read: Callable[[DutyReport], float]) -> str:
    return "–" if found.duty is None else units.shown(read(found.duty), NUMBERS["torque_peak"])


def shown(name: str, value: float) -> str:
    """A number of an objective in its display unit."""
    if math.isnan(value):
        return "–"
    if math.isinf(value):
        return "no end"
    quantity = OBJECTIVES[name].quantity
    number = float(f"{float(units.from_si(value, quantity)):.3g}")
    return f"{number:.7g} {units.label(quantity)}".rstrip()
