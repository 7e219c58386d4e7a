"""Many designs at once, and the model on them: costs and constraints by evaluators that are compiled once."""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, faults_of, nearest, raise_if_any
from ballscrew.basis.quantities import Count, Info, Quantity, Ratio, fields_of
from ballscrew.cases.case_files.case import Case
from ballscrew.cases.case_files.uncertain_inputs import all_of, joint_of
from ballscrew.cases.schema.case_schema import read_table
from ballscrew.cases.schema.fields import section_of
from ballscrew.engine.evaluation.evaluator import Evaluator, evaluator
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.evaluation.recordings import Engine
from ballscrew.engine.uncertainty.monte_carlo import Sampler, sobol_sequence
from ballscrew.physics.components.materials import STEEL_DENSITY
from ballscrew.physics.components.nut import NUTS, PRELOADED
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry
from ballscrew.physics.equations.shaft import shaft_inertia
from ballscrew.physics.sizing.catalogue import CatalogueRow, printed_rows
from ballscrew.physics.sizing.checks import (
    CHECKS,
    RUNNING_TIME,
    loads_at_point,
    values_of_installation,
    values_of_limits,
)
from ballscrew.physics.sizing.installation import Installation, Limits
from ballscrew.physics.sizing.makers_tables import GENERAL
from ballscrew.physics.sizing.ratings import RatedGeometry, ratings_of
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.requirements import (
    ALLOWED,
    FORBIDDEN,
    OBJECTIVES,
    Requirements,
    objectives_named,
    preload_used,
    reflected_mass,
    shaft_length,
)

Numbers = NDArray[np.float64]


@dataclasses.dataclass(frozen=True, eq=False)
class Designs:
    """Designs as arrays of one length: sizes in SI, balls as whole numbers, and the preload as a force."""

    pitch_circle_diameter: Numbers
    lead: Numbers
    ball_diameter: Numbers
    loaded_balls: Numbers
    #: Turns that these whole balls fill: what the ratings count.
    loaded_turns: Numbers
    dynamic_rating: Numbers
    static_rating: Numbers
    root_diameter: Numbers
    preload: Numbers

    @classmethod
    def of(cls, columns: Mapping[str, Numbers], screw: BallScrew) -> Designs:
        """The designs of free variables; contact angle and conformity are those of a screw.

        Balls are counted and rated as :class:`~ballscrew.physics.sizing.catalogue.CatalogueRow` does. Where none finds
        room, the ratings are NaN.
        """
        d_m, P_h, d_w = (columns[name] for name in ("pitch_circle_diameter", "lead", "ball_diameter"))
        alpha, phi = screw.contact_angle, geometry.lead_angle(P_h, d_m)
        per_turn = np.floor(np.pi * (d_m / d_w) / np.cos(phi))
        balls = np.maximum(1.0, np.round(per_turn * columns["loaded_turns"]))
        turns = balls / per_turn
        with np.errstate(all="ignore"):
            rated = ratings_of(RatedGeometry(d_m, d_w, alpha, phi, per_turn, turns, screw.nut.spacer_balls))
        d_r = geometry.groove_root_diameter(d_m, d_w, screw.screw_conformity, alpha)
        preload = columns["preload"] * rated.dynamic if "preload" in columns else np.zeros_like(d_m)
        return cls(d_m, P_h, d_w, balls, turns, rated.dynamic, rated.static, d_r, preload)

    @property
    def room(self) -> Numbers:
        """Ball diameter over the room between neighbouring turns: above one, balls overlap."""
        phi = geometry.lead_angle(self.lead, self.pitch_circle_diameter)
        return self.ball_diameter / (self.lead * np.cos(phi))

    def utilisations(
        self,
        *,
        axial_load: float,
        screw_speed: Numbers,
        left: Numbers,
        pressure: Numbers,
        young_modulus: float,
        installation: Installation | None,
        limits: Limits,
    ) -> dict[str, Numbers]:
        """Demand over capacity of each check that can be judged, by its name; at most one where it holds.

        ``left`` is the preload that is left under the load, ``pressure`` that of the most loaded contact.
        """
        # a geometry that is free has no make
        limit = GENERAL.value if limits.diameter_speed_product is None else limits.diameter_speed_product
        values = {
            "screw_speed": screw_speed,
            "pitch_circle_diameter": self.pitch_circle_diameter,
            "root_diameter": self.root_diameter,
            "young_modulus": young_modulus,
            **loads_at_point(axial_load, left),
            "maximum_pressure": pressure,
            "dynamic_load_rating": self.dynamic_rating,
            "static_load_rating": self.static_rating,
            **values_of_limits(limits),
            "limits.diameter_speed_product": limit,
            **({} if installation is None else values_of_installation(installation)),
        }
        # the life says what the running time does
        is_asked = limits.running_time is not None
        rows = [row for row in CHECKS if row.name != "life" and (RUNNING_TIME not in row.takes or is_asked)]
        result = {row.name: row.finds(values) for row in rows}
        shape = load_shape(self)
        return {name: np.broadcast_to(one["utilisation"], shape) for name, one in result.items() if one is not None}


def load_shape(designs: Designs) -> tuple[int, ...]:
    """The shape of the arrays of designs."""
    return np.shape(designs.lead)


#: The objectives of a search; there is no price of what nobody makes.
SEARCHED = ("loss", "inertia", "reflected_mass", "life", "rigidity", "drive_torque", "preload_torque")
USUAL_OBJECTIVES = ("loss", "inertia")
#: Share of the dynamic load rating: what vendors give (Rexroth2006).
PRELOAD_SHARES = (0.02, 0.10)
_VARIED_SIZES = ("pitch_circle_diameter", "lead", "ball_diameter")
_SCREW = fields_of(BallScrew)
#: What is free, in the order of the columns of a design.
VARIABLES: Mapping[str, Quantity] = {
    **{name: _SCREW[name] for name in _VARIED_SIZES},
    "loaded_turns": Quantity(
        "loaded_turns", "1", Info("i_l", "turns of one nut body that carry load", above=0, at_most=100)
    ),
    "preload": Quantity("preload", "1", Info("p", "preload / dynamic load rating, %", at_least=0, at_most=100)),
}
#: Ratios of sizes that rows of the catalogue keep: how thick balls are against circle and lead, and how steep leads.
RATIOS: Mapping[str, tuple[str, str]] = {
    "ball_in_circle": ("ball_diameter", "pitch_circle_diameter"),
    "ball_in_lead": ("ball_diameter", "lead"),
    "lead_over_circle": ("lead", "pitch_circle_diameter"),
}
Span = tuple[float, float]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class SearchOptions(ByValue):
    """Options of a search. Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds."""

    population: Annotated[
        Count, Info("n", "designs of a generation", at_least=8, at_most=100_000, whole=True, hint="100 to 1000")
    ] = 200
    generations: Annotated[
        Count, Info("g", "generations", at_least=1, at_most=100_000, whole=True, hint="50 to 200")
    ] = 60
    elastic_generations: Annotated[
        Count,
        Info(
            "g_e",
            "generations after these, with the bodies of screw and nut elastic",
            at_least=0,
            at_most=10_000,
            whole=True,
        ),
    ] = 10
    members: Annotated[
        Count, Info("m", "members of the front that are evaluated in full", at_least=1, at_most=1000, whole=True)
    ] = 24
    seed: Annotated[Count, Info("s", "seed of the random numbers", at_least=0, whole=True)] = 0
    quantile: Annotated[
        Ratio | None,
        Info("q", "share of the uncertain inputs to be no worse than", above=0, below=1, hint="0.9; none: nominal"),
    ] = None
    samples: Annotated[
        Count, Info("k", "samples of the uncertain inputs for a quantile", at_least=8, at_most=65_536, whole=True)
    ] = 64
    margin: Annotated[
        Ratio, Info("m_u", "share of each limit that the search leaves free", at_least=0, below=1, hint="0 to 0.1")
    ] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("optimise", self, optional=("quantile",)))


@dataclasses.dataclass(frozen=True, eq=False)
class DesignSpace:
    """Free values, their bounds in SI, the kind of nut, and the ratios of sizes that are made."""

    nut: str
    bounds: Mapping[str, Span]
    ratios: Mapping[str, Span]
    objectives: Sequence[str]
    options: SearchOptions
    notes: Sequence[str] = ()

    @property
    def names(self) -> tuple[str, ...]:
        """The free variables: those whose bounds differ come into the search, all of them into a design."""
        return tuple(self.bounds)

    @property
    def lower(self) -> NDArray[np.float64]:
        """The lower bounds."""
        return np.array([low for low, _ in self.bounds.values()])

    @property
    def upper(self) -> NDArray[np.float64]:
        """The upper bounds."""
        return np.array([high for _, high in self.bounds.values()])

    def columns(self, designs: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
        """The variables of designs, one row each, by name."""
        return dict(zip(self.names, np.asarray(designs, dtype=float).T, strict=True))


@functools.cache
def makeable_bounds() -> Mapping[str, Span]:
    """Sizes between the least and the greatest of the rows that print all sizes: such screws are made."""
    read: Mapping[str, Callable[[CatalogueRow], Any]] = {
        "pitch_circle_diameter": lambda row: row.ball_circle,
        "lead": lambda row: row.lead,
        "ball_diameter": lambda row: row.ball_diameter,
        "loaded_turns": lambda row: row.loaded_turns,
    }
    return {name: _span([float(of(row)) for row in printed_rows()]) for name, of in read.items()}


@functools.cache
def makeable_ratios() -> Mapping[str, Span]:
    """Ratios of sizes between the least and the greatest of the rows shipped."""
    rows = [row.screw() for row in printed_rows()]
    return {
        name: _span([getattr(screw, one) / getattr(screw, other) for screw in rows])
        for name, (one, other) in RATIOS.items()
    }


def _span(values: Sequence[float]) -> Span:
    return min(values), max(values)


def design_space(need: Need, objectives: Sequence[str] | None = None, **options: Any) -> DesignSpace:
    """The space of the table ``[optimise]`` of a need; ``options`` win over it.

    ``[optimise.bounds]`` has pairs for the names of :data:`VARIABLES`; what it leaves out lies between the least and
    the greatest of the rows of the catalogue, a preload between the shares that vendors give. Raises
    :class:`~ballscrew.basis.errors.InputError` with all faults.
    """
    table, faults, notes = dict(need.optimise), list[Fault](), list[str]()
    given, named = table.pop("bounds", {}), table.pop("objectives", list(USUAL_OBJECTIVES))
    nut = table.pop("nut", None) or next(iter(need.nuts), None)
    if nut is None:
        nut = "double"
        notes.append("double nut: no kind was given")
    elif len(need.nuts) > 1 and "nut" not in need.optimise:
        notes.append(f"{nut} nut: the first of {len(need.nuts)}")
    if not isinstance(nut, str) or nut not in NUTS:
        faults.append(Fault("optimise.nut", "unknown kind of nut", str(nut), nearest(str(nut), NUTS)))
    section = section_of("Optimise", fields_of(SearchOptions), SearchOptions, required=False)
    values = read_table("optimise", section, {**table, **{n: v for n, v in options.items() if v is not None}}, faults)
    try:
        wanted = named if isinstance(named, list | tuple) else [named]
        names = objectives_named(wanted if objectives is None else objectives, "optimise.objectives", SEARCHED)
    except InputError as error:
        faults += error.faults
        names = ()
    preloaded = isinstance(nut, str) and nut in PRELOADED
    usual = {**makeable_bounds(), **({"preload": PRELOAD_SHARES} if preloaded else {})}
    bounds = {**usual, **_bounds(given, usual, nut, faults)}
    raise_if_any(faults)
    return DesignSpace(str(nut), bounds, makeable_ratios(), names, SearchOptions(**values), tuple(notes))


def _bounds(given: Any, usual: Mapping[str, Span], nut: Any, faults: list[Fault]) -> dict[str, Span]:
    if not isinstance(given, Mapping):
        faults.append(Fault("optimise.bounds", "must be a table", str(given), "write [optimise.bounds]"))
        return {}
    bounds: dict[str, Span] = {}
    for name, ends in given.items():
        where = f"optimise.bounds.{name}"
        if name not in usual:
            problem = f'a nut of type "{nut}" has none' if name in VARIABLES else "is not free"
            faults.append(Fault(where, problem, str(ends), nearest(str(name), usual)))
            continue
        pair = ends if isinstance(ends, list | tuple) else [ends, ends]
        numbers = [_number(where, VARIABLES[name], end) for end in pair]
        wrong = [number for number in numbers if isinstance(number, Fault)]
        faults += wrong
        if not wrong:
            values = [number for number in numbers if not isinstance(number, Fault)]
            if len(values) != 2 or not 0 < values[0] <= values[1]:
                sample = "[2, 5]" if VARIABLES[name].unit == "1" else '["20 mm", "63 mm"]'
                faults.append(
                    Fault(where, "is not a lower and an upper bound above zero", str(ends), f"write {sample}")
                )
            else:
                bounds[name] = (values[0], values[1])
    return bounds


def _number(where: str, quantity: Quantity, raw: Any) -> float | Fault:
    """A bound in SI; a preload is a share of the rating, with its sign of per cent or without."""
    if quantity.name == "preload":
        text = raw.strip().removesuffix("%").strip() if isinstance(raw, str) else raw
        percent = units.parse(where, text, quantity)
        return percent if isinstance(percent, Fault) else float(percent) / 100
    value = units.parse(where, raw, quantity)
    return value if isinstance(value, Fault) else float(value)


#: Inputs of the evaluator besides those that are uncertain.
_SIZES = ("pitch_circle_diameter", "lead", "ball_diameter", "loaded_balls")
_POINT = ("axial_load", "screw_speed")
_OUTPUTS = (
    "screw_torque", "drive_torque", "holding_torque", "friction_power", "rigidity", "remaining_preload",
    "lift_off_load", "maximum_pressure", "valid",
)  # fmt: skip
#: The objectives that the model has a say in, which uncertain inputs move.
OF_MODEL = ("loss", "rigidity", "drive_torque", "preload_torque")


@dataclasses.dataclass(frozen=True, eq=False)
class Sampled:
    """Samples of uncertain inputs, over their central values, the same for all designs."""

    factors: Mapping[str, Numbers]
    quantile: float


@dataclasses.dataclass(frozen=True, eq=False)
class DesignModel:
    """The model of a case on designs in place of its own screw.

    With rigid bodies all designs are one call. With elastic ones every ball is solved for, as in a run, and designs
    of as many balls are one call.
    """

    case: Case
    space: DesignSpace
    requirements: Requirements
    #: Length of shaft whose inertia counts, m.
    length: float
    #: The evaluator with rigid bodies.
    friction: Evaluator
    sampled: Sampled | None
    #: The evaluators with elastic bodies, by the number of balls; None where bodies are rigid.
    by_balls: dict[int, Evaluator] | None = None
    #: The case with its own nut.
    elastic_case: Case | None = None
    engine: Engine | None = None

    @classmethod
    def of(cls, case: Case, need: Need, space: DesignSpace, length: float, engine: Engine | None = None) -> DesignModel:
        """The model of a case with any design of a space and rigid bodies; recorded and compiled here."""
        nut = dataclasses.replace(case.screw.nut, bodies=None, deviations=None)
        screw = dataclasses.replace(case.screw, nut=nut)
        sampled = _sampled(dataclasses.replace(case, screw=screw), space)
        preload = ("preload",) if "preload" in space.names else ()
        others = () if sampled is None else tuple(sampled.factors)
        inputs = tuple(dict.fromkeys((*_SIZES, *preload, *_POINT, *others)))
        friction = evaluator(case.model, screw, case.lubricant, inputs=inputs, outputs=list(_OUTPUTS), engine=engine)
        rigid = dataclasses.replace(case, screw=screw)
        return cls(rigid, space, need.requirements, length, friction, sampled, elastic_case=case, engine=engine)

    @property
    def elastic(self) -> DesignModel | None:
        """The same with the bodies of the case's own nut; None where these are rigid."""
        own = self.elastic_case
        if own is None or not own.screw.nut.one_by_one:
            return None
        return dataclasses.replace(self, by_balls={})

    def designs(self, x: Numbers) -> Designs:
        """The designs of rows of free variables."""
        return Designs.of(self.space.columns(x), self.case.screw)

    def speed(self, designs: Designs) -> Numbers:
        """Screw speed of designs: that of the feed, or one for all."""
        feed = self.requirements.feed
        if feed is None:
            return np.full(np.shape(designs.lead), float(self.case.operation.screw_speed))
        return 2 * math.pi * feed / designs.lead

    def costs(self, x: Numbers) -> tuple[Numbers, Numbers]:
        """Objectives, less being better, and constraints, at most zero where they hold, of rows of free variables."""
        designs = self.designs(x)
        load, speed = float(self.case.operation.axial_load), self.speed(designs)
        at = self._at(designs, load, speed)
        numbers = self.objectives(designs, speed, at)
        used = self.utilisations(designs, speed, at, numbers)
        if self.sampled is not None:
            numbers = {**numbers, **self._quantiles(designs, speed, numbers)}
        costs = [OBJECTIVES[name].sign * numbers[name] for name in self.space.objectives]
        free = 1 - self.space.options.margin
        constraints = [value / free - 1 for value in used.values()]
        constraints += [*self._makeable(designs), np.where(at["valid"], -1.0, 1.0)]
        return np.column_stack(costs), np.column_stack(constraints)

    def objectives(self, designs: Designs, speed: Numbers, at: Mapping[str, Numbers]) -> dict[str, Numbers]:
        """The numbers compared, by name, at the central inputs."""
        wanted = {*self.space.objectives, *(["preload_torque"] if self.requirements.largest_preload_torque else [])}
        density = STEEL_DENSITY if self.case.installation is None else self.case.installation.shaft_density
        bore = 0.0 if self.case.surroundings is None else self.case.surroundings.bore
        inertia = shaft_inertia(designs.pitch_circle_diameter, bore, self.length, density)
        objectives = {
            "loss": at["friction_power"],
            "inertia": inertia,
            "reflected_mass": reflected_mass(inertia, designs.lead),
            "rigidity": at["rigidity"],
            "drive_torque": np.abs(at["drive_torque"]),
        }
        if "life" in wanted:
            objectives["life"] = self._life(designs, speed, at)
        if "preload_torque" in wanted:
            objectives["preload_torque"] = self._idle(designs, speed)
        return objectives

    def utilisations(
        self, designs: Designs, speed: Numbers, at: Mapping[str, Numbers], numbers: Mapping[str, Numbers]
    ) -> dict[str, Numbers]:
        """Demand over capacity of all checks and requirements, by name, at the central inputs."""
        required, case = self.requirements, self.case
        utilisations = designs.utilisations(
            axial_load=float(case.operation.axial_load),
            screw_speed=speed,
            left=at["remaining_preload"],
            pressure=at["maximum_pressure"],
            young_modulus=case.screw.screw_material.young_modulus,
            installation=case.installation,
            limits=case.limits,
        )
        if self.space.nut in PRELOADED:
            utilisations["preload"] = preload_used(
                designs.preload, at["remaining_preload"], float(case.operation.axial_load), at["lift_off_load"]
            )
        if required.largest_drive_torque is not None:
            utilisations["drive_torque"] = numbers["drive_torque"] / required.largest_drive_torque
        if required.largest_preload_torque is not None:
            utilisations["preload_torque"] = numbers["preload_torque"] / required.largest_preload_torque
        if required.least_rigidity is not None:
            utilisations["rigidity"] = required.least_rigidity / numbers["rigidity"]
        if required.least_remaining_preload is not None:
            with np.errstate(divide="ignore"):
                utilisations["remaining_preload"] = required.least_remaining_preload / at["remaining_preload"]
        if required.largest_inertia is not None and shaft_length(required, case) is not None:
            utilisations["inertia"] = numbers["inertia"] / required.largest_inertia
        if required.largest_step is not None and required.counts_per_turn is not None:
            utilisations["step"] = designs.lead / required.counts_per_turn / required.largest_step
        if required.back_driving != ALLOWED:
            utilisations["back_driving"] = self._back_driving(designs, at)
        return utilisations

    # -- parts --------------------------------------------------------------------------------------

    def _at(
        self, designs: Designs, load: float, speed: Numbers, factors: Mapping[str, Numbers] | None = None
    ) -> dict[str, Numbers]:
        """The outputs at a load and a speed; of samples, which are of rigid bodies, one column each."""
        given: dict[str, Any] = {name: getattr(designs, name) for name in _SIZES}
        given |= {"preload": designs.preload, "axial_load": np.full_like(speed, load), "screw_speed": speed}
        if self.by_balls is not None and factors is None:
            rigid = dataclasses.replace(self, by_balls=None)._at(designs, load, speed)
            return self._at_balls(self.by_balls, given) | {"lift_off_load": rigid["lift_off_load"]}
        values: list[Any] = []
        subject = Configuration(self.case.model, self.case.screw, self.case.lubricant)
        for name in self.friction.inputs:
            value = given[name] if name in given else subject.value_of(name)
            if factors is not None:
                value = np.asarray(value)[..., np.newaxis] * factors.get(name, np.ones(1))
            values.append(value)
        return self.friction(*values)

    def _at_balls(self, kept: dict[int, Evaluator], given: Mapping[str, Any]) -> dict[str, Numbers]:
        """The outputs with elastic bodies: designs of as many balls in one call."""
        case, count = self.elastic_case, len(given["loaded_balls"])
        assert case is not None
        outputs = [name for name in _OUTPUTS if name != "lift_off_load"]
        numbers = {name: np.zeros(count, dtype=bool if name == "valid" else float) for name in outputs}
        names = tuple(name for name in (*_SIZES, "preload", *_POINT) if name != "loaded_balls")
        names = names if "preload" in self.space.names else tuple(name for name in names if name != "preload")
        for number in np.unique(given["loaded_balls"]):
            balls, here = int(number), given["loaded_balls"] == number
            if balls not in kept:
                kept[balls] = evaluator(
                    case.model,
                    case.screw,
                    case.lubricant,
                    inputs=names,
                    outputs=outputs,
                    engine=self.engine,
                    loaded_balls=balls,
                )
            of_these = kept[balls](*(given[name][here] for name in names))
            for name, values in of_these.items():
                numbers[name][here] = values
        return numbers

    def _idle(self, designs: Designs, speed: Numbers) -> Numbers:
        """Torque of the nut without load, at the speed."""
        return self._at(designs, 0.0, speed)["screw_torque"]

    def _life(self, designs: Designs, speed: Numbers, at: Mapping[str, Numbers]) -> Numbers:
        """Basic rating life L10h."""
        limits = dataclasses.replace(self.case.limits, running_time=1.0)
        used = designs.utilisations(
            axial_load=float(self.case.operation.axial_load),
            screw_speed=speed,
            left=at["remaining_preload"],
            pressure=at["maximum_pressure"],
            young_modulus=1.0,
            installation=None,
            limits=limits,
        )
        with np.errstate(divide="ignore"):
            return 1 / used["running_time"]

    def _back_driving(self, designs: Designs, at: Mapping[str, Numbers]) -> Numbers:
        """Above one where the load does what it must not: the torque that it has left over that without friction."""
        load = float(self.case.operation.axial_load)
        rest = self._at(designs, load, np.zeros_like(designs.lead))["holding_torque"]
        scale = designs.lead * abs(load) / (2 * math.pi)
        left = math.copysign(1.0, load) * np.stack([rest, at["holding_torque"]]) / scale
        if self.requirements.back_driving == FORBIDDEN:
            return 1 + np.max(left, axis=0)
        return 1 - np.min(left, axis=0) + np.finfo(float).eps

    def _makeable(self, designs: Designs) -> list[Numbers]:
        """Ratios of sizes within those of the catalogue, and room between neighbouring turns."""
        makeable = [designs.room - 1]
        for name, (low, high) in self.space.ratios.items():
            one, other = RATIOS[name]
            ratio = getattr(designs, one) / getattr(designs, other)
            makeable += [low / ratio - 1, ratio / high - 1]
        return makeable

    def _quantiles(self, designs: Designs, speed: Numbers, central: Mapping[str, Numbers]) -> dict[str, Numbers]:
        """The quantile, on the bad side, of the objectives that the model has a say in.

        Samples are of rigid bodies; with elastic ones they count by their ratio to the central value.
        """
        assert self.sampled is not None
        rigid = dataclasses.replace(self, by_balls=None)
        wanted = [name for name in self.space.objectives if name in OF_MODEL]
        load, quantiles = float(self.case.operation.axial_load), dict[str, Numbers]()
        if {*wanted} - {"preload_torque"}:
            at = rigid._at(designs, load, speed, self.sampled.factors)
            read = {"loss": "friction_power", "rigidity": "rigidity", "drive_torque": "drive_torque"}
            quantiles = {name: _quantile(np.abs(at[read[name]]), name, self.sampled) for name in wanted if name in read}
        if "preload_torque" in wanted:
            idle = rigid._at(designs, 0.0, speed, self.sampled.factors)["screw_torque"]
            quantiles["preload_torque"] = _quantile(idle, "preload_torque", self.sampled)
        if self.by_balls is not None:
            alike = rigid.objectives(designs, speed, rigid._at(designs, load, speed))
            quantiles = {name: value / alike[name] * central[name] for name, value in quantiles.items()}
        return quantiles


def _quantile(values: Numbers, name: str, sampled: Sampled) -> Numbers:
    share = 1 - sampled.quantile if OBJECTIVES[name].larger_is_better else sampled.quantile
    return np.quantile(values, share, axis=1)


def _sampled(case: Case, space: DesignSpace) -> Sampled | None:
    """Samples of the uncertain inputs as factors on their central values; None without a quantile."""
    share = space.options.quantile
    if share is None:
        return None
    inputs = all_of(case)
    joint = joint_of(case, inputs)
    alone = {name: each.distribution for name, each in inputs.items() if joint is None or name not in joint.names}
    subject = Configuration(case.model, case.screw, case.lubricant)
    sampler = Sampler(subject, alone, {}, (), joint)
    shares = sobol_sequence(len(sampler.names), int(space.options.samples), int(space.options.seed))
    # conformity and angle enter the ratings and the groove, too: those of a design stay nominal there
    factors = {
        name: np.asarray(values, dtype=float) / float(subject.value_of(name))
        for name, values in sampler.inputs_at(shares).items()
        if float(subject.value_of(name))
    }
    return Sampled(factors, float(share))
