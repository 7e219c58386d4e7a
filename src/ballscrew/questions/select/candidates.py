"""Candidates: a row of a catalogue with a nut, a preload and an oil, judged by the full model and all checks."""

from __future__ import annotations

import dataclasses
import itertools
import math
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Duration, Force, Length, fields_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables.catalogue import assumed, case_text
from ballscrew.physics.components.nut import NUTS, PRELOADED
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction import validity
from ballscrew.physics.friction.across_groove import in_motion
from ballscrew.physics.friction.loaded_balls import loads_of_each
from ballscrew.physics.friction.validity import BothTorques
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.checks import Check
from ballscrew.physics.sizing.installation import Installation
from ballscrew.physics.sizing.ratings import lists_preload
from ballscrew.physics.solvers.load_distribution import BallLoads, preload_of
from ballscrew.questions.check.answer import Checked, checked, checks_by_loads
from ballscrew.questions.duty import compute, verdicts
from ballscrew.questions.duty.compute import DutyReport
from ballscrew.questions.run.compute import with_nut
from ballscrew.questions.select import requirements
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.requirements import OBJECTIVES, USUAL_LENGTH, Requirements, reflected_mass, shaft_length
from ballscrew.questions.shared.every_row import copied, tables_of_row
from ballscrew.questions.shared.question import Done

#: Preloads where neither need nor row says one: the ends of what vendors give (Rexroth2006: 2 to 10 %), and between.
USUAL_PRELOADS = ("2 %", "5 %", "10 %")
#: Checks that friction has no part in: they follow from loads, speeds and sizes.
BY_LOADS = frozenset(
    {
        "static_safety", "life", "running_time", "shaft_stress", "buckling", "critical_speed", "diameter_speed_product",
        "motor_speed", *requirements.BY_LOADS,
    }
)  # fmt: skip
#: Demand over capacity by the loads alone, above which a candidate cannot hold, and its friction is not asked for.
NEARLY = 1.25
#: The least life that is looked for where a need asks for none, s: an assumption, which ranks and fails nothing.
USUAL_LIFE = 10_000 * 3600.0
#: How a length is made of a stroke.
LENGTH_OF_STROKE = "the stroke and a nut of its loaded turns and two leads; add what lies between it and the bearings"
_FEED = fields_of(Requirements)["feed"]


@dataclasses.dataclass(frozen=True)
class Variant:
    """Choice of a row, a kind of nut, a preload as it is written, and the table of an oil."""

    row: CatalogueRow
    nut: str
    #: Empty without preload, and for that which the row lists.
    preload: str
    oil: Mapping[str, Any]
    file: Path | None = None

    @property
    def oil_name(self) -> str:
        """The oil as it is called; ``own`` where its numbers are given."""
        return str(self.oil.get("oil") or self.oil.get("grade") or "own")

    @property
    def label(self) -> str:
        """Row, nut, preload and oil: unique in a selection."""
        preload = self.preload or ("preload as listed" if lists_preload(self.row) and self.nut in PRELOADED else "")
        return ", ".join(filter(None, [self.row.name, self.nut, preload, self.oil_name]))


@dataclasses.dataclass(frozen=True, eq=False)
class Candidate:
    """A variant with what the full model and all checks say of it.

    One that its loads alone rule out may be without the full model (:attr:`complete`): it has the checks that friction
    has no part in, the same as the full model would have, and the objectives that follow from them.
    """

    variant: Variant
    case: Case
    #: All checks: those of ``ballscrew check`` or ``ballscrew duty``, then those of the need.
    checks: Sequence[Check]
    #: The numbers compared, by the names of :data:`~ballscrew.questions.select.requirements.OBJECTIVES`, in SI.
    objectives: Mapping[str, float]
    #: Preload of the nut, N.
    preload: Force
    #: The largest axial load of the need, N.
    load: Force
    #: The loads of the balls under it.
    balls: BallLoads
    #: The run at the operating point, of a motion that of steady travel, with its own checks.
    run: Checked | None = None
    #: The cycle, where the need has a motion; its checks then count.
    duty: DutyReport | None = None
    #: The least life that is looked for where the need asks for none, s: it ranks, and fails nothing.
    life_looked_for: Duration | None = None
    #: That loss and torques, or that without load alone, are larger in a full bath of oil; the objectives then have
    #: the larger.
    starved: Sequence[Record] = ()

    @property
    def complete(self) -> bool:
        """True where the full model was computed."""
        return self.run is not None

    @property
    def checked(self) -> Checked:
        """The run at the operating point with its own checks; only of one that is :attr:`complete`."""
        if self.run is None:
            remedy = "select(…, complete=True) computes those, too, that their loads alone rule out"
            raise InputError(Fault("select", "has no full model of what cannot hold", self.variant.label, remedy))
        return self.run

    @property
    def name(self) -> str:
        """The name of the row."""
        return self.variant.row.name

    @property
    def holds(self) -> bool:
        """True where all checks were judged and hold."""
        return self.complete and all(check.holds for check in self.checks)

    @property
    def fits(self) -> bool:
        """True where no check fails; one that could not be judged does not."""
        return not self.failed

    @property
    def valid(self) -> bool:
        """True where the point lies within the validity of the model, as far as it was computed."""
        return self.run is None or bool(self.run.run.friction.valid)

    @property
    def rigid_lift_off_load(self) -> Force | None:
        """The load above which rigid bodies lose the preload, N, of a nut that has none left; None where some is.

        Elastic bodies may lose it at a smaller load.
        """
        lost = self.preload > 0 and float(self.balls.remaining_preload) <= 0
        return float(self.balls.rigid_lift_off_load) if lost else None

    @property
    def failed(self) -> Sequence[Check]:
        """The checks that fail."""
        return [check for check in self.checks if check.holds is False]

    @property
    def worst(self) -> float:
        """The largest utilisation of all checks; one or less where all hold."""
        return _worst(self.checks)

    @property
    def worst_by_loads(self) -> float:
        """The largest utilisation of the checks that friction has no part in."""
        return _worst([check for check in self.checks if check.name in BY_LOADS])

    @property
    def cannot_hold(self) -> bool:
        """True where its loads alone rule it out, and not by little: :data:`NEARLY`."""
        return self.worst_by_loads > NEARLY

    @property
    def life_short(self) -> float:
        """The life that is looked for over its own, where the need asks for none; else zero."""
        life = self.objectives["life"]
        if self.life_looked_for is None or math.isnan(life):
            return 0.0
        return self.life_looked_for / life if life else math.inf


def _worst(checks: Sequence[Check]) -> float:
    if any(check.utilisation is None for check in checks if check.holds is False):
        return math.inf
    used = [check.utilisation for check in checks if check.utilisation is not None]
    return max((value for value in used if not math.isnan(value)), default=0.0)


def variants(need: Need, rows: Sequence[CatalogueRow], file: Path | None) -> Iterator[Variant]:
    """Every row with every kind of nut, preload and oil of a need.

    Without kinds in the need each row has the nut that it lists. A preload is one of the need, or that of the row, or
    one of :data:`USUAL_PRELOADS`; nuts without preload come once.
    """
    for row in rows:
        for nut, oil in itertools.product(need.nuts or [row.nut or "single"], need.oils):
            for preload in _preloads(need, row, nut):
                yield Variant(row, nut, preload, oil, file)


def _preloads(need: Need, row: CatalogueRow, nut: str) -> Sequence[str]:
    if nut not in PRELOADED or "oversize" in need.tables.get("nut", {}):
        return ("",)
    if need.preloads:
        return need.preloads
    return ("",) if lists_preload(row) and nut == row.nut else USUAL_PRELOADS


def assumes_preload(need: Need, variant: Variant) -> bool:
    """Test whether the preload of a variant is one of :data:`USUAL_PRELOADS`, as neither need nor row has one."""
    return bool(variant.preload) and not need.preloads


def lacks_preload(need: Need, variant: Variant) -> bool:
    """Test whether a need that names no kinds of nuts asks for a preload, and that of the row is of a kind without."""
    return bool(need.preloads) and not need.nuts and variant.nut not in PRELOADED


def tables_of(need: Need, variant: Variant) -> dict[str, Any]:
    """The tables of the case of a variant, as a case file has them.

    The screw has elastic bodies of a usual size where the need does not say, as ``ballscrew check`` takes a row.
    """
    tables = copied({"screw": {}, "bodies": {}, **need.tables})
    made = tables_of_row({**tables, "nut": {}}, variant.row, variant.file)
    made["nut"] = _nut(tables.get("nut", {}), variant)
    made["lubricant"] = dict(variant.oil)
    feed = need.requirements.feed
    if feed is not None and isinstance(operation := made.setdefault("operation", {}), dict):
        operation["screw_speed"] = units.written(feed, _FEED)
    if need.length_is_stroke and need.requirements.stroke is not None:
        length = need.requirements.stroke + _nut_length(variant)
        made["installation"] = {**made["installation"], "unsupported_length": f"{length!r} m"}
    return made


def case_tables(need: Need, variant: Variant) -> dict[str, Any]:
    """The case file of a variant as tables, with the numbers of a row of one's own, so that it needs no table.

    A load rating that such a row does not list is computed from these numbers, whole balls in place of parts of turns.
    """
    made = tables_of(need, variant)
    if variant.file is None:
        return made
    own = tomllib.loads(case_text(variant.row))
    preload = (
        {"preload": own["nut"]["preload"]} if lists_preload(variant.row) and variant.nut == variant.row.nut else {}
    )
    kept = {name: value for name, value in made["screw"].items() if name not in ("catalogue", "catalogue_file")}
    made["screw"] = {**own["screw"], **kept}
    made["nut"] = {**preload, **made["nut"]}
    made["bodies"] = {**own["bodies"], **made["bodies"]}
    if "losses" in own:
        made["losses"] = {**own["losses"], **made.get("losses", {})}
    return made


def _nut_length(variant: Variant) -> Length:
    from ballscrew.axis.thermal.network import nut_length  # loads xarray: for lengths that no need gives

    row = variant.row
    return nut_length(row.loaded_turns, row.lead, NUTS[variant.nut].halves if variant.nut in NUTS else 1)


def _nut(table: Mapping[str, Any], variant: Variant) -> dict[str, Any]:
    """The section of the nut, without what other kinds of nuts have."""
    of_others = {name for kind in NUTS.values() for name in (*fields_of(kind), "set_at_rest")}
    if variant.nut in NUTS:
        of_others -= {*fields_of(NUTS[variant.nut]), *(field.name for field in dataclasses.fields(NUTS[variant.nut]))}
    kept = {name: value for name, value in table.items() if name not in of_others}
    return {"type": variant.nut, **kept, **({"preload": variant.preload} if variant.preload else {})}


def case_of(need: Need, variant: Variant, *, model: str | None, calibration: str | None, allow_code: bool) -> Case:
    """The case of a variant. Raises :class:`~ballscrew.basis.errors.InputError` with all faults in it."""
    return case_file.build(
        tables_of(need, variant),
        model,
        need.folder,
        {variant.row.name: variant.row},
        calibration=calibration,
        allow_code=allow_code,
        moves=need.moves,
    )


class Loaded(NamedTuple):
    """The case of a variant under the largest load of its need."""

    case: Case
    #: The screw in motion, and the load with its sign, for which the balls are solved.
    screw: BallScrew
    load: Force
    #: The cycle without its friction, where the need has a motion.
    planned: DutyReport | None


def loaded(need: Need, case: Case) -> Loaded:
    """The case under the largest load of its need."""
    if need.moves:
        report = compute.planned(case)
        return Loaded(case, report.screw_in_motion, report.signed_largest_load, report)
    state = OperatingState(0.0, float(case.operation.screw_speed), None)
    screw = in_motion(case.model, case.screw, case.lubricant, state)
    return Loaded(case, screw, float(case.operation.axial_load), None)


def by_loads(need: Need, variant: Variant, under: Loaded, balls: BallLoads) -> Candidate:
    """A variant with what follows from its loads and sizes alone, and no friction."""
    case, report = under.case, under.planned
    if report is not None:
        preload, load = float(preload_of(case.screw, case.screw.nut)), report.largest_load
        own, time = report.checks_by_loads, report.life_time
    else:
        preload, load = float(preload_of(under.screw, under.screw.nut)), under.load
        own = checks_by_loads(case, preload, float(balls.remaining_preload))
        time = _life_of(own)
    numbers = {
        **dict.fromkeys(OBJECTIVES, math.nan),
        **_of_shaft(need, case),
        "life": float(time),
        "price_index": _price(need, variant),
    }
    required = requirements.by_loads(
        need.requirements,
        case,
        numbers,
        preload=preload,
        largest_load=load,
        balls=balls,
        lacks_preload=lacks_preload(need, variant),
    )
    return Candidate(variant, case, (*own, *required), numbers, preload, load, balls, life_looked_for=_looked_for(need))


def each_by_loads(
    need: Need, every: Sequence[Variant], case_of_one: Callable[[Variant], Case], done: Done | None = None
) -> dict[str, Candidate | InputError]:
    """Variants by their labels with what follows from loads and sizes alone, or why a variant cannot be judged.

    The balls of all of them are solved together.
    """
    candidates: dict[str, Candidate | InputError] = {}
    under: dict[str, Loaded] = {}
    for number, variant in enumerate(every, start=1):
        try:
            under[variant.label] = loaded(need, case_of_one(variant))
        except InputError as error:
            candidates[variant.label] = error
        if done is not None:
            done(number, len(every))
    solved = loads_of_each([one.screw for one in under.values()], [one.load for one in under.values()])
    balls = dict(zip(under, solved, strict=True))
    for variant in every:
        label = variant.label
        if label in candidates:
            continue
        try:
            loads = balls[label]
            candidates[label] = loads if isinstance(loads, InputError) else by_loads(need, variant, under[label], loads)
        except InputError as error:
            candidates[label] = error
    return candidates


def judged(need: Need, candidate: Candidate, *, recorded: bool = False) -> Candidate:
    """A candidate with all that is computed of it; ``recorded`` where many of its kind are judged."""
    variant, case, nut = candidate.variant, candidate.case, candidate.case.nut
    row = variant.row
    notes = [text for name, text in assumed(row).items() if name != "loaded_turns"]
    if need.length_is_stroke and case.installation is not None:
        length = units.shown(case.installation.unsupported_length, fields_of(Installation)["unsupported_length"])
        notes.append(f"unsupported length {length}: {LENGTH_OF_STROKE}")
    known = None if need.moves or nut is None or nut.set_at_rest else with_nut(case, nut, candidate.balls)
    result = checked(row.name, case, [*need.notes, *notes], known)
    report = compute.duty(case, recorded=recorded) if need.moves else None
    starves = Starved.of(result, report)
    numbers = objectives(need, result, report, _price(need, variant), starves)
    balls = result.nut.loads if report is None else report.balls_under_largest_load
    of_loads = requirements.by_loads(
        need.requirements,
        case,
        numbers,
        preload=result.nut.preload,
        largest_load=candidate.load,
        balls=balls,
        lacks_preload=lacks_preload(need, variant),
    )
    own = result.checks if report is None else report.checks
    return dataclasses.replace(
        candidate,
        checks=(*own, *of_loads, *requirements.of_friction(need.requirements, result, report, numbers)),
        objectives=numbers,
        preload=result.nut.preload,
        balls=balls,
        run=result,
        duty=report,
        starved=starves.records,
    )


def _looked_for(need: Need) -> Duration | None:
    limits = need.tables.get("limits")
    asked = isinstance(limits, dict) and "running_time" in limits
    return None if asked else USUAL_LIFE


def _price(need: Need, variant: Variant) -> float:
    listed = math.nan if variant.row.price_index is None else variant.row.price_index
    return need.price_index.get(variant.row.name, listed)


def _life_of(checks: Sequence[Check]) -> Duration:
    """The basic rating life L10h, by the check of it; NaN where it is not known."""
    value = next(check for check in checks if check.name == "running_time").value
    return math.nan if value is None else float(value)


def _of_shaft(need: Need, case: Case) -> dict[str, float]:
    """Inertia and reflected mass of the shaft, 1 m long where no length is known."""
    shaft = case.shaft_of(shaft_length(need.requirements, case) or USUAL_LENGTH)
    return {"inertia": shaft.inertia, "reflected_mass": reflected_mass(shaft.inertia, case.screw.lead)}


class Starved(NamedTuple):
    """Starvation of a candidate: torques that oil coming back late makes smaller than in a full bath."""

    #: The record of the torque under load, of a motion that of its cycle; none where it hardly differs.
    under_load: Sequence[Record]
    #: The torque of the nut without load, as it is given and in a full bath; None where they hardly differ.
    without_load: BothTorques | None

    @classmethod
    def of(cls, result: Checked, report: DutyReport | None) -> Starved:
        """Under load and without, each judged by itself: under load oil may matter little, and without it much."""
        loaded = result.run.friction.starvation if report is None else verdicts.starved(report)
        return cls(loaded, _without_load(result))

    @property
    def records(self) -> list[Record]:
        """The record under load; where there is none that of the torque without load."""
        if self.under_load or self.without_load is None:
            return [*self.under_load]
        remark = "drag torque of the nut"
        return validity.records([self.without_load], remark)


def objectives(
    need: Need,
    result: Checked,
    report: DutyReport | None,
    price_index: float = math.nan,
    starved: Starved | None = None,
) -> dict[str, float]:
    """The numbers compared, in SI.

    Where they are ``starved``, loss and torques are the larger of those with the inlet as it is given, which oil that
    comes back late starves, and those in a full bath of oil: which of them a ball screw has is not measured. None
    keeps to the former.
    """
    starves = starved is not None and bool(starved.under_load)
    idle = None if starved is None else starved.without_load
    return {
        **dict.fromkeys(OBJECTIVES, math.nan),
        **(_of_point(result, starves=starves) if report is None else _of_cycle(report, starves=starves)),
        **_of_shaft(need, result.case),
        "rigidity": float(result.nut.loads.rigidity),
        "preload_torque": float(result.nut.preload_drag) if idle is None else idle.flooded,
        "price_index": float(price_index),
    }


def _of_point(result: Checked, *, starves: bool) -> dict[str, float]:
    friction = result.run.friction
    torque = float(friction.screw_torque)
    more = max(float(friction.flooded_torque) - torque, 0.0) if starves else 0.0
    loss, drive = float(friction.friction_power), float(friction.drive_torque)
    way = math.copysign(1.0, float(friction.screw_speed)) if float(friction.screw_speed) else 0.0
    return {
        "loss": loss + more * abs(float(friction.screw_speed)),
        "drive_torque": max(abs(drive), abs(drive + way * more)),
        "life": _life_of(result.checks),
    }


def _of_cycle(report: DutyReport, *, starves: bool) -> dict[str, float]:
    numbers, full = report.numbers, report.bath.numbers
    lost = max(numbers["energy_lost"], full["energy_lost"]) if starves else numbers["energy_lost"]
    return {
        "loss": lost / numbers["cycle_time"],
        "drive_torque": report.motor_torque["torque_peak"] if starves else abs(numbers["torque_peak"]),
        "life": numbers["life_time"],
    }


def _without_load(result: Checked) -> BothTorques | None:
    """Torque of the nut without load as it is given and in a full bath of oil; None where they hardly differ."""
    case, given, flooded = result.run.case, result.nut.preload_drag, result.nut.flooded_drag
    if case.screw.nut.set_at_rest and flooded != given:  # in a full bath motion leaves it another preload
        speed = case.operation.screw_speed
        idle = case.model.in_full_bath(case.screw, case.lubricant, axial_load=0.0, screw_speed=speed)
        flooded = float(idle.screw_torque)
    both = BothTorques(OBJECTIVES["preload_torque"].quantity, given, flooded)
    return both if validity.differs(given, flooded) else None
