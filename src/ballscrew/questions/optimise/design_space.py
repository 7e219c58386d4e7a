"""The space of designs: what is free, within which bounds, and how the search goes."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis import units
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, faults_of, nearest, raise_if_any
from ballscrew.basis.quantities import Count, Info, Quantity, Ratio, fields_of
from ballscrew.cases.schema.case_schema import read_table
from ballscrew.cases.schema.fields import section_of
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.sizing.catalogue import CatalogueRow, printed_rows
from ballscrew.physics.sizing.listed_nut import NUTS, PRELOADED
from ballscrew.questions.select.need import Need
from ballscrew.questions.select.objectives import objectives_named

#: The objectives of a search; there is no price of what nobody makes.
SEARCHED = ("loss", "inertia", "reflected_mass", "life", "rigidity", "drive_torque", "preload_torque")
USUAL_OBJECTIVES = ("loss", "inertia")
#: Share of the dynamic load rating: what vendors give (Rexroth2006).
PRELOAD_SHARES = (0.02, 0.10)
_SIZES = ("pitch_circle_diameter", "lead", "ball_diameter")
_SCREW = fields_of(BallScrew)
#: What is free, in the order of the columns of a design.
VARIABLES: Mapping[str, Quantity] = {
    **{name: _SCREW[name] for name in _SIZES},
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
    """What is free, its bounds in SI, the kind of nut, and the ratios of sizes that are made."""

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
