"""Optimisation of free geometries for a need, and each member of the front by the full model and all checks."""

from __future__ import annotations

import dataclasses
import importlib
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import fields_of
from ballscrew.basis.records import Record
from ballscrew.cases.case_files import case_file
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.screw_tables.nut_kinds import NUT_FIELDS
from ballscrew.engine.evaluation.recordings import Engine
from ballscrew.physics.components.nut import PRELOADED, Bodies
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.sizing.catalogue import CatalogueRow
from ballscrew.physics.sizing.checks import Check
from ballscrew.questions.check.answer import Checked, checked
from ballscrew.questions.optimise.design_model import VARIABLES, DesignModel, DesignSpace, design_space
from ballscrew.questions.select import candidates, requirements
from ballscrew.questions.select.candidates import Starved
from ballscrew.questions.select.need import Need, need_of
from ballscrew.questions.select.requirements import OBJECTIVES, USUAL_LENGTH, front, shaft_length
from ballscrew.questions.shared.every_row import copied
from ballscrew.questions.shared.question import Done

Numbers = NDArray[np.float64]
#: Costs, all to be small, and constraints, at most zero where they hold, of designs: one row each.
Evaluate = Callable[[Numbers], tuple[Numbers, Numbers]]
#: What stands for a constraint that is no number: worse than any other.
_WORST = 1e6


class Found(NamedTuple):
    """The designs of the front with their costs, and how many were evaluated; empty where none holds."""

    designs: Numbers
    costs: Numbers
    evaluations: int
    #: The last generation, from which another search may go on.
    population: Numbers


def search(
    evaluate: Evaluate,
    lower: Numbers,
    upper: Numbers,
    *,
    population: int,
    generations: int,
    seed: int,
    start: Numbers | None = None,
    done: Callable[[int], None] | None = None,
) -> Found:
    """The Pareto front of a constrained problem by NSGA-II.

    As pymoo has it (BlankDeb2020): designs that hold before those that do not, these by the sum of what they exceed.
    The same seed gives the same front; ``start`` has designs of the first generation. A design whose costs or
    constraints are no numbers counts as one that does not hold. ``done`` is told the designs that were evaluated, after
    each generation.

    Raises :class:`~ballscrew.basis.errors.InputError` where pymoo is not installed.
    """
    pymoo = _pymoo()
    costs, constraints = _sound(*evaluate((lower + upper)[np.newaxis] / 2))
    count, evaluated = population * generations, 0

    class Problem(pymoo.Problem):
        def __init__(self) -> None:
            counts = {"n_obj": costs.shape[1], "n_ieq_constr": constraints.shape[1]}
            super().__init__(n_var=len(lower), xl=lower, xu=upper, **counts)

        def _evaluate(self, x: Numbers, out: dict[str, Any], *_: Any, **__: Any) -> None:
            nonlocal evaluated
            out["F"], out["G"] = _sound(*evaluate(np.asarray(x, dtype=float)))
            evaluated += len(x)
            if done is not None:
                done(min(evaluated, count))

    first = {} if start is None else {"sampling": start}
    result = pymoo.minimize(
        Problem(), pymoo.NSGA2(pop_size=population, **first), ("n_gen", generations), seed=seed, verbose=False
    )
    last = np.asarray(result.pop.get("X"), dtype=float)
    if result.X is None:
        return Found(np.empty((0, len(lower))), np.empty((0, costs.shape[1])), count, last)
    designs = np.atleast_2d(result.X).astype(float)
    return Found(designs, np.atleast_2d(result.F).astype(float), count, last)


def _sound(costs: Numbers, constraints: Numbers) -> tuple[Numbers, Numbers]:
    """Costs and constraints without NaN: such a design does not hold."""
    bad = ~np.isfinite(costs).all(axis=1) | np.isnan(constraints).any(axis=1)
    limited = np.clip(np.nan_to_num(constraints, nan=_WORST, posinf=_WORST, neginf=-_WORST), -_WORST, _WORST)
    return (
        np.where(np.isfinite(costs), costs, _WORST),
        np.column_stack([limited, np.where(bad, 1.0, -1.0)]),
    )


class _Pymoo(NamedTuple):
    Problem: Any
    NSGA2: Any
    minimize: Any


def _pymoo() -> _Pymoo:
    try:
        result = [
            getattr(importlib.import_module(f"pymoo.{module}"), name)
            for module, name in (
                ("core.problem", "Problem"),
                ("algorithms.moo.nsga2", "NSGA2"),
                ("optimize", "minimize"),
            )
        ]
    except ImportError:
        raise InputError(Fault("optimise", "needs pymoo", "", 'pip install "ballscrew[optimise]"')) from None
    return _Pymoo(*result)


def spread(costs: Numbers, most: int) -> list[int]:
    """The places of at most so many rows, spread evenly over a front: its ends, then the farthest from those taken."""
    if len(costs) <= most:
        return list(range(len(costs)))
    span = np.ptp(costs, axis=0)
    scaled = (costs - costs.min(axis=0)) / np.where(span > 0, span, 1.0)
    taken = list(dict.fromkeys(int(place) for place in np.argmin(scaled, axis=0)))[:most]
    distance = np.min([np.linalg.norm(scaled - scaled[place], axis=1) for place in taken], axis=0)
    while len(taken) < most:
        place = int(np.argmax(distance))
        taken.append(place)
        distance = np.minimum(distance, np.linalg.norm(scaled - scaled[place], axis=1))
    return sorted(taken)


#: Seconds of one processor: for recording and compiling, and for a design, of rigid bodies, of each sample of a
#: quantile, of elastic bodies, and in full. They say what an optimisation costs and decide nothing.
SECONDS: Mapping[str, float] = {"compiling": 5.0, "rigid": 6e-5, "sample": 2e-6, "elastic": 2e-3, "member": 0.04}
#: Contact angle and conformity where the need gives none: those of a row that lists none.
_ROW = CatalogueRow.__dataclass_fields__
_ANGLE, _CONFORMITY = _ROW["contact_angle"].default, _ROW["conformity"].default
_SIZES = ("pitch_circle_diameter", "lead", "ball_diameter")
_SCREW, _SPEED = fields_of(BallScrew), fields_of(OperatingState)["screw_speed"]


@dataclasses.dataclass(frozen=True)
class Plan:
    """Plan of an optimisation."""

    #: Designs of the search, with rigid and with elastic bodies, and members in full, at most.
    rigid: int
    elastic: int
    members: int
    #: Seconds of one processor, about.
    seconds: float

    @property
    def total(self) -> int:
        """All that are evaluated, at most."""
        return self.rigid + self.elastic + self.members


@dataclasses.dataclass(frozen=True, eq=False)
class Member:
    """A design of the front: its free variables, what the search knew of it, and what the full model says."""

    #: The free variables by name, in SI; a preload as a share of the dynamic load rating.
    variables: Mapping[str, float]
    #: The objectives of the search: with rigid bodies, and with the quantile where one was asked for.
    searched: Mapping[str, float]
    #: The case of the design with all that ``ballscrew check`` says of it.
    checked: Checked
    checks: Sequence[Check]
    #: The objectives by the full model, at the central inputs.
    objectives: Mapping[str, float]
    #: Its case file as tables.
    case: Mapping[str, Any]
    #: Whether no other member that holds is better in all objectives by the full model.
    pareto: bool = False

    @property
    def name(self) -> str:
        """The name of the design."""
        return self.checked.name

    @property
    def holds(self) -> bool:
        """True where all checks were judged and hold by the full model."""
        return all(check.holds for check in self.checks)

    @property
    def fits(self) -> bool:
        """True where no check fails by the full model; one that could not be judged does not."""
        return all(check.holds is not False for check in self.checks)

    @property
    def valid(self) -> bool:
        """True where it lies within the validity of the model."""
        return bool(self.checked.run.friction.valid)


@dataclasses.dataclass(frozen=True, eq=False)
class Optimisation:
    """The front of a need."""

    #: The need as it was read.
    need: Need
    #: Free variables with their bounds, objectives and options of the search.
    space: DesignSpace
    #: Designs of the front, evaluated by the full model.
    members: Sequence[Member]
    #: Designs that the search evaluated, and members of its own front, of which :attr:`members` are a choice.
    evaluations: int
    #: The outcome of the search.
    front: Found
    #: The engine of the search, and why it is that one.
    engine: tuple[str, str]
    #: What was assumed.
    notes: Sequence[str] = ()

    @property
    def largest_change(self) -> Mapping[str, float]:
        """The largest change of each objective from search to full model, over the former; not of a quantile.

        A member whose number was zero in the search (the torque without load of a nut without preload) has no such
        ratio and does not count; an objective that is zero in all members is left out.
        """
        if self.space.options.quantile is not None:
            return {}
        pairs = {
            name: [(each.objectives[name], each.searched[name]) for each in self.members if each.searched[name]]
            for name in self.space.objectives
        }
        return {name: max(abs(full / searched - 1) for full, searched in each) for name, each in pairs.items() if each}


def optimise(
    need: str | Path | Mapping[str, Any] | Need,
    *,
    objectives: Sequence[str] | None = None,
    population: int | None = None,
    generations: int | None = None,
    members: int | None = None,
    seed: int | None = None,
    quantile: float | None = None,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
    engine: Engine | None = None,
    done: Done | None = None,
) -> Optimisation:
    """The Pareto front of free geometries for a need, an :class:`Optimisation`: each member by the full model.

    ``need`` is a file, its tables, or a need that was read (:func:`~ballscrew.questions.select.need.need_of`);
    ``settings`` of the form ``section.field=value`` win over file and tables. ``model`` names the model of friction and
    ``calibration`` a named one in place of those of the need, and with ``allow_code`` laws of files of the user's own
    are imported. ``objectives`` names what is optimised. ``population`` designs are in each of ``generations``
    generations, ``members`` of the front are evaluated in full, and ``seed`` is that of the random numbers; without
    them those of the table ``[optimise]`` count, or usual ones.

    Free are pitch circle, lead, ball diameter, turns and preload within ``[optimise.bounds]``, by default the span of
    the catalogue, and ratios of sizes that the catalogue keeps
    (:func:`~ballscrew.questions.optimise.design_model.design_space`). NSGA-II of pymoo searches on the recorded model,
    first with rigid bodies and then, some generations more, with the elastic ones of a run; constraints are all checks
    of ``ballscrew check`` and the requirements of the need, less a ``margin``. With a ``quantile`` the objectives are
    that quantile over the uncertain inputs, in place of their values at the central ones; constraints stay at these.
    Members of the front are then evaluated one by one as ``ballscrew check`` does; one that fails there is kept, and
    says so. ``engine`` is that of :func:`~ballscrew.engine.evaluation.evaluator.evaluator`. ``done(finished, total)``
    is told the designs evaluated, generation by generation, and then the members; fewer than planned lower the total.

    Raises :class:`~ballscrew.basis.errors.InputError` for faults of the need, for one with a motion, and where pymoo
    (the extra ``optimise``) is not installed.
    """
    chosen = {
        "population": population, "generations": generations, "members": members, "seed": seed, "quantile": quantile,
    }  # fmt: skip
    options = {"model": model, "calibration": calibration, "allow_code": allow_code}
    asked, space, case = _prepared(need, objectives, settings, chosen, options)
    planned = _plan(space, case)
    ready = DesignModel.of(case, asked, space, _length(asked, case), engine)
    own = space.options
    told = done or _untold
    match = search(
        ready.costs,
        space.lower,
        space.upper,
        population=int(own.population),
        generations=int(own.generations),
        seed=int(own.seed),
        done=lambda finished: told(finished, planned.total),
    )
    elastic = ready.elastic
    evaluations = match.evaluations
    if elastic is not None and own.elastic_generations:
        match = search(
            elastic.costs,
            space.lower,
            space.upper,
            population=int(own.population),
            generations=int(own.elastic_generations),
            seed=int(own.seed),
            start=match.population,
            done=lambda finished: told(planned.rigid + finished, planned.total),
        )
        evaluations += match.evaluations
    places = spread(match.costs, int(own.members))
    made: list[Member] = []
    for number, place in enumerate(places, start=1):
        made.append(_member(asked, space, ready, match, place, options))
        told(evaluations + number, evaluations + len(places))
    notes = [*asked.notes, *space.notes]
    if len(asked.oils) > 1:
        notes.append(f"oil {case.origins.oil.get('grade', 'of the first table')}: the first of {len(asked.oils)}")
    return Optimisation(
        asked,
        space,
        _marked(made, space.objectives),
        evaluations,
        match,
        (ready.friction.engine, ready.friction.engine_reason),
        notes,
    )


def plan(
    need: str | Path | Mapping[str, Any] | Need,
    *,
    objectives: Sequence[str] | None = None,
    population: int | None = None,
    generations: int | None = None,
    members: int | None = None,
    quantile: float | None = None,
    settings: Sequence[str] = (),
    model: str | None = None,
    calibration: str | None = None,
    allow_code: bool = False,
) -> Plan:
    """Plan of an optimisation: the designs that :func:`optimise` would evaluate, and about the time it takes.

    Raises :class:`~ballscrew.basis.errors.InputError` as :func:`optimise` does for faults of the need.
    """
    chosen = {"population": population, "generations": generations, "members": members, "quantile": quantile}
    options = {"model": model, "calibration": calibration, "allow_code": allow_code}
    _, space, case = _prepared(need, objectives, settings, chosen, options)
    return _plan(space, case)


def _prepared(
    need: str | Path | Mapping[str, Any] | Need,
    objectives: Sequence[str] | None,
    settings: Sequence[str],
    chosen: Mapping[str, Any],
    options: Mapping[str, Any],
) -> tuple[Need, DesignSpace, Case]:
    """The need, its space of designs, and the case that stands for all of them."""
    asked = need_of(need, settings)
    if asked.length_is_stroke:
        note = "unsupported length: the stroke alone, too short; add the nut and what lies between it and the bearings"
        asked = asked.with_note(note)
    if asked.moves:
        remedy = "give [operation] with the mean load and speed that ballscrew duty says"
        raise InputError(Fault("motion", "is too much for a search", asked.name, remedy))
    space = design_space(asked, objectives, **chosen)
    centre = {name: (low * high) ** 0.5 for name, (low, high) in space.bounds.items()}
    return asked, space, _case(asked, space, centre, options)


def _plan(space: DesignSpace, case: Case) -> Plan:
    own = space.options
    rigid = int(own.population * own.generations)
    elastic = int(own.population * own.elastic_generations) if case.screw.nut.one_by_one else 0
    samples = 0 if own.quantile is None else own.samples
    seconds = SECONDS["compiling"] + rigid * SECONDS["rigid"] + (rigid + elastic) * samples * SECONDS["sample"]
    seconds += elastic * SECONDS["elastic"] + own.members * SECONDS["member"]
    return Plan(rigid, elastic, int(own.members), float(seconds))


def _untold(*_: int) -> None:
    """Nothing, for nobody asks."""


def tables_of(need: Need, space: DesignSpace, variables: Mapping[str, float], **numbers: float) -> dict[str, Any]:
    """The tables of the case of a design, as a case file has them; ``numbers`` are its balls and its preload."""
    tables = copied({"bodies": {}, **need.tables})
    screw = tables.get("screw", {})
    sizes = {name: units.written(variables[name], VARIABLES[name]) for name in _SIZES}
    usual = {
        "contact_angle": units.written(_ANGLE, _SCREW["contact_angle"]),
        "screw_conformity": _CONFORMITY, "nut_conformity": _CONFORMITY,
    }  # fmt: skip
    left_out = ("catalogue", "catalogue_file", "starts", "dynamic_load_rating", "static_load_rating", "root_diameter")
    # sizes of bodies belong to one screw
    tables["bodies"] = {name: value for name, value in tables["bodies"].items() if name not in fields_of(Bodies)}
    kept = {name: value for name, value in screw.items() if name not in left_out}
    tables["screw"] = {**usual, **kept, **sizes, "loaded_balls": int(numbers["balls"])}
    preload = {"preload": units.written(numbers["preload"], NUT_FIELDS["preload"])} if space.nut in PRELOADED else {}
    tables["nut"] = {**tables.get("nut", {}), "type": space.nut, **preload}
    tables["lubricant"] = dict(need.oils[0])
    feed = need.requirements.feed
    if feed is not None:
        speed = 2 * np.pi * feed / variables["lead"]
        tables["operation"] = {**tables.get("operation", {}), "screw_speed": units.written(speed, _SPEED)}
    return tables


def _case(need: Need, space: DesignSpace, variables: Mapping[str, float], options: Mapping[str, Any]) -> Case:
    """The case of a design that stands for all: sizes are inputs of the evaluator."""
    # any screw and preload do here, if they fit
    sizes = {**variables, "ball_diameter": min(variables["ball_diameter"], 0.4 * variables["lead"])}
    return _built(need, tables_of(need, space, sizes, balls=40, preload=1000.0), options)


def _built(need: Need, tables: Mapping[str, Any], options: Mapping[str, Any]) -> Case:
    return case_file.build(
        tables, options["model"], need.folder, calibration=options["calibration"], allow_code=options["allow_code"]
    )


def _length(need: Need, case: Case) -> float:
    return shaft_length(need.requirements, case) or USUAL_LENGTH


def _member(
    need: Need, space: DesignSpace, ready: DesignModel, result: Found, place: int, options: Mapping[str, Any]
) -> Member:
    """A design of the front by the full model."""
    x = result.designs[place : place + 1]
    variables = {name: float(values[0]) for name, values in space.columns(x).items()}
    designs = ready.designs(x)
    preload, balls = float(designs.preload[0]), float(designs.loaded_balls[0])
    tables = tables_of(need, space, variables, balls=balls, preload=preload)
    case = _built(need, tables, options)
    whole = checked(f"design {place + 1}", case, need.notes)
    numbers = candidates.objectives(need, whole, None)
    searched = {
        name: OBJECTIVES[name].sign * float(cost)
        for name, cost in zip(space.objectives, result.costs[place], strict=True)
    }
    checks = (
        *whole.checks,
        *requirements.by_loads(
            need.requirements, case, numbers, preload=whole.nut.preload,
            largest_load=float(case.operation.axial_load), balls=whole.nut.loads,
        ),
        *requirements.of_friction(need.requirements, whole, None, numbers),
    )  # fmt: skip
    return Member(variables, searched, whole, checks, {name: numbers[name] for name in OBJECTIVES}, tables)


def _marked(members: Sequence[Member], objectives: Sequence[str]) -> list[Member]:
    """Members by their first objective, with the front of those of which no check fails marked."""
    fitting = [each for each in members if each.fits and each.valid]
    costs = np.array([[OBJECTIVES[n].sign * each.objectives[n] for n in objectives] for each in fitting])
    leads = front(costs.reshape(len(fitting), len(objectives)))
    best = {id(member) for member, is_best in zip(fitting, leads, strict=True) if is_best}
    ordered = sorted(members, key=lambda each: OBJECTIVES[objectives[0]].sign * each.objectives[objectives[0]])
    return [dataclasses.replace(each, pareto=id(each) in best) for each in ordered]


def warnings(optimisation: Optimisation) -> list[Record]:
    """Records of starvation, of the first member that has any."""
    records = (Starved.of(member.checked, None).records for member in optimisation.members)
    return next(filter(None, records), [])
