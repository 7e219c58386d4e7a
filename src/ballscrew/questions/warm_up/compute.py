"""Warming up of a case: temperatures, growth, preload and torque over hours of its motion or operating point."""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator, Mapping, Sequence
from typing import Annotated, Any

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty, cycle, to_and_fro
from ballscrew.axis.motion.profiles import Trapezoid
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.thermal.network import GAP_SHARE, GREASE_CONDUCTIVITY, NUT_WALL, Network
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.axis.thermal.warm_up import WarmUp, warm_up
from ballscrew.basis import units
from ballscrew.basis.arrays import lazy
from ballscrew.basis.errors import Fault, InputError, overflow_as_input_error, raise_if_any
from ballscrew.basis.quantities import (
    Energy,
    Force,
    Info,
    Length,
    Power,
    Quantity,
    Ratio,
    Temperature,
    Torque,
    Unit,
    fields_of,
)
from ballscrew.cases.case_files.case import Case
from ballscrew.physics.components.materials import Lubricant

HOUR = 3600.0
#: The longest time, h: a year.
LONGEST = 8766.0
#: The stroke of one operating point over the shaft between its bearings.
SHARE_OF_SHAFT = 0.5
#: The shaft of an operating point where nothing tells a length, m.
LENGTH = 1.0
#: Feed of a drift test as a share of rapid, hours of rest after it, and the acceleration where a motion jumps: choices.
FEED_SHARE, REST, USUAL_ACCELERATION = 0.5, 1.0, 1.0
#: Distance of the places of a compensation table, m.
STEP = 0.05
#: Numbers of the surroundings that are said where they are their defaults.
OF_DEFAULTS = ("ambient", "nut_conductance", "shaft_share", "bearing_conductance", "bearing_mass")
_OF, _VISCOSITY = fields_of(Surroundings), fields_of(Lubricant)["viscosity"]
_Temperatures = Annotated[Sequence[float], Unit("K")]
_Lengths = Annotated[Sequence[float], Unit("m")]


@dataclasses.dataclass(frozen=True, eq=False)
class OverTime:
    """Numbers at each instant: all faces have them from here, in this order."""

    time: Annotated[Sequence[float], Unit("s"), Info("t", "time", "h")]
    nut_temperature: Annotated[_Temperatures, Info("T_n", "temperature of the nut", "degC")]
    oil_temperature: Annotated[_Temperatures, Info("T_o", "temperature of the oil", "degC")]
    shaft_temperature: Annotated[_Temperatures, Info("T_s", "mean temperature of the shaft", "degC")]
    first_bearing_temperature: Annotated[_Temperatures, Info("T_1", "temperature of the fixed bearing", "degC")]
    last_bearing_temperature: Annotated[_Temperatures, Info("T_2", "temperature of the other bearing", "degC")]
    shaft_growth: Annotated[_Lengths, Info(r"\Delta L", "growth of the shaft between its bearings", "um")]
    preload: Annotated[Sequence[float], Unit("N"), Info("F_{pr}", "preload")]
    screw_torque: Annotated[Sequence[float], Unit("N m"), Info("M", "mean friction torque of the screw")]
    friction_power: Annotated[Sequence[float], Unit("W"), Info("P", "mean friction power of the nut")]


@dataclasses.dataclass(frozen=True)
class Heat:
    """Heat until the end; generated is stored and lost."""

    generated: Annotated[Energy, Info("Q", "heat of friction", "kJ")]
    stored: Annotated[Energy, Info(r"\Delta U", "heat stored", "kJ")]
    lost: Annotated[Energy, Info("Q_a", "heat lost to the surroundings", "kJ")]


#: What is known at each instant; of the heat, that until then.
SERIES: Mapping[str, Quantity] = {
    **fields_of(OverTime),
    **{f"heat_{name}": quantity for name, quantity in fields_of(Heat).items()},
}


@dataclasses.dataclass(frozen=True)
class Equilibrium:
    """The steady state; its numbers are null where there is none."""

    #: True where there is one within the range of oil and preload.
    exists: bool
    #: Stability margin of the thermal loop: 1 less its gain; thermal runaway at 0.
    margin: Ratio
    nut_temperature: Annotated[Temperature, SERIES["nut_temperature"].info]
    oil_temperature: Annotated[Temperature, SERIES["oil_temperature"].info]
    shaft_temperature: Annotated[Temperature, SERIES["shaft_temperature"].info]
    preload: Annotated[Force, SERIES["preload"].info]
    screw_torque: Annotated[Torque, SERIES["screw_torque"].info]
    growth: Annotated[Length, SERIES["shaft_growth"].info]
    power: Annotated[Power, SERIES["friction_power"].info]


#: The numbers of the steady state.
EQUILIBRIUM: Mapping[str, Quantity] = fields_of(Equilibrium)
#: The mean friction torque at the two ends of warming up.
AT_START = Quantity("screw_torque", "N m", Info("M", "mean friction torque of the screw at the start"))
AT_END = Quantity("screw_torque", "N m", Info("M", "mean friction torque of the screw in the steady state"))
#: Places on the shaft.
PLACE = Quantity("place", "m", Info("x", "distance from the fixed bearing", "mm"))


@dataclasses.dataclass(frozen=True, eq=False)
class WarmUpReport:
    """A case that warms up."""

    case: Case
    surroundings: Surroundings
    warm_up: WarmUp
    #: The stroke of the operating point, m; None where the case has a motion.
    stroke: Length | None

    @property
    def duty(self) -> Duty:
        """The cycle that makes the heat."""
        return self.warm_up.duty

    @property
    def last_at_work(self) -> int:
        """Index of the last instant of work."""
        return int(np.flatnonzero(self.warm_up.works)[-1])

    @lazy
    def full_bath(self) -> WarmUpReport | None:
        """The same in a full bath of oil; None where nothing is starved of oil."""
        return dataclasses.replace(self, warm_up=self.warm_up.flooded) if self.warm_up.starved else None

    @property
    def length_is_assumed(self) -> bool:
        """True where no table tells how long the shaft is."""
        return self.surroundings.shaft_length is None and self.case.installation is None

    @lazy
    def series(self) -> Mapping[str, Numbers]:
        """Numbers over time in SI, as :data:`SERIES` has them."""
        result = self.warm_up
        first, last = result.bearing_temperatures
        known = {
            "shaft_temperature": np.mean(result.shaft_temperature, axis=1),
            "first_bearing_temperature": first,
            "last_bearing_temperature": last,
            **{f"heat_{name}": values for name, values in result.heat.items()},
        }
        return {name: known[name] if name in known else getattr(result, name) for name in SERIES}

    @lazy
    def equilibrium(self) -> Mapping[str, float]:
        """Numbers of the steady state in SI, as :data:`EQUILIBRIUM` has them; NaN where there is none."""
        end, speed = self.warm_up.equilibrium, self.duty.mean_speed
        torque = end.power / speed if speed else float("nan")
        return {name: torque if name == "screw_torque" else float(getattr(end, name)) for name in EQUILIBRIUM}

    @lazy
    def drift(self) -> tuple[Numbers, Numbers]:
        """Places of the two ends of the stroke and of its middle, m, and growth there: instants by places."""
        ends = self.warm_up.network.ends
        places = np.array([ends[0], (ends[0] + ends[1]) / 2, ends[1]])
        return places, self.warm_up.growth_at(places)

    @lazy
    def compensation(self) -> tuple[Numbers, Numbers]:
        """Places on the shaft and the growth there at the last instant of work, m."""
        return self.warm_up.compensation_table(min(STEP, self.warm_up.network.shaft.length / 4))

    @property
    def assumed(self) -> Sequence[str]:
        """Numbers that the case does not give, and what stands in for them."""
        return assumed_of(self.case, self.surroundings, self.warm_up.network, self.stroke)


def assumed_of(case: Case, given: Surroundings, network: Network, stroke: Length | None) -> Sequence[str]:
    """Numbers of the heat that a case does not give, and what stands in for them."""
    names = [*_assumed_sizes(case, given, network)]
    if stroke is not None and given.stroke is None:
        length = units.shown(stroke, PLACE)
        names.append(f"to and fro over {length}, half the shaft, under the load of the case")
    if any(network.bearing_power):
        first, last = (units.shown(power, SERIES["friction_power"], 3) for power in network.bearing_power)
        names.append(f"bearings make {first} at the fixed end and {last} at the other, whatever they warm up to")
    else:
        names.append("no heat of the support bearings: their friction is not given ([bearings.fixed])")
    defaults = {field.name: field.default for field in dataclasses.fields(Surroundings)}
    for name in OF_DEFAULTS:
        if getattr(given, name) == defaults[name] and name not in case.origins.given_surroundings:
            meaning, value = _OF[name].info.meaning, units.shown(defaults[name], _OF[name])
            names.append(f"{meaning} {value}: the default")
    return names


def _assumed_sizes(case: Case, given: Surroundings, network: Network) -> Iterator[str]:
    """Conductances and sizes of nut and shaft that are not given."""
    if given.ball_conductance is None:
        conductance = units.shown(network.ball_conductance, _OF["ball_conductance"])
        yield (
            f"{conductance} from nut to shaft: balls at rest and grease of {GREASE_CONDUCTIVITY:g} W/(m K) in a "
            f"gap of {GAP_SHARE:g} ball diameters; a factor of three either way is possible"
        )
    if given.shaft_convection is None:
        convection = units.shown(network.shaft.convection, _OF["shaft_convection"])
        yield (
            f"{convection} from the shaft to the air by the mean speed, a recalled formula; a factor of two "
            "either way is possible"
        )
    if given.nut_mass is None:
        mass, wall = units.shown(network.nut_mass, _OF["nut_mass"]), f"{NUT_WALL:g}"
        yield f"nut of {mass}: {wall} times as wide as the screw"
    if given.shaft_length is None:
        length = units.shown(network.shaft.length, _OF["shaft_length"])
        if case.installation is None:
            yield f"shaft of {length}: not given, an assumption"
        else:
            yield f"shaft of {length}: the length of [installation]"


def check_hours(hours: float, cool_down: float) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for times that are none."""
    faults: list[Fault] = []
    if not 0 < hours <= LONGEST:
        problem = f"must be above 0 and at most {units.to_significant(LONGEST, 6)}"
        faults.append(Fault("--hours", problem, f"{hours:g}", "write --hours 4"))
    if not 0 <= cool_down <= LONGEST:
        problem = f"must be 0 to {units.to_significant(LONGEST, 6)}"
        faults.append(Fault("--cool-down", problem, f"{cool_down:g}", "write --cool-down 1"))
    raise_if_any(faults)


def drift_cycle(case: Case, share: float = FEED_SHARE) -> Case:
    """The case with a cycle like that of the drift test of ISO 230-3: the full stroke to and fro at a share of rapid.

    The standard could not be read: stroke and rapid are those of the motion of the case, its acceleration the largest,
    and the share is a choice. Raises :class:`~ballscrew.basis.errors.InputError` without a motion, and for shares that
    are none.
    """
    faults: list[Fault] = []
    if case.axis is None or case.motion is None:
        faults.append(Fault("--drift-cycle", "has no motion whose stroke it could take", "", "add [axis] and [motion]"))
    if not 0 < share <= 1:
        faults.append(Fault("--feed-share", "must be above 0 and at most 1", f"{share:g}", "write --feed-share 0.5"))
    raise_if_any(faults)
    assert case.motion is not None
    states = case.motion.states()
    cycle = Trapezoid(
        stroke=states.stroke,
        speed=share * float(np.max(np.abs(states.speed))),
        acceleration=float(np.max(np.abs(states.acceleration))) or USUAL_ACCELERATION,
    )
    return dataclasses.replace(case, motion=cycle)


def moves(tables: Mapping[str, Any]) -> bool:
    """True of the tables of a case whose motion counts, and not its operating point."""
    return "motion" in tables or "axis" in tables


def check_oil(case: Case) -> None:
    """Raise :class:`~ballscrew.basis.errors.InputError` for an oil that has no temperature."""
    if case.lubricant.temperature is None:
        problem = "has no temperature: its viscosity would be the same for ever"
        remedy = 'write grade = "ISO VG 100", or both viscosities of the data sheet, in its place'
        raise InputError(
            Fault("lubricant.viscosity", problem, units.shown(case.lubricant.viscosity, _VISCOSITY), remedy)
        )


def duty_of(case: Case, surroundings: Surroundings) -> tuple[Duty, Length | None]:
    """The cycle that heats a case, and the stroke where it is of one operating point."""
    if case.efficiency is not None:
        problem = "knows no oil, so that nothing changes as it warms up"
        raise InputError(Fault("model.name", problem, "constant-efficiency", "take a model"))
    check_oil(case)
    also = case.bearings_by_name
    if case.motion is not None and (axis := case.turning_axis) is not None:
        return cycle(case.model, case.screw, case.lubricant, axis=axis, motion=case.motion, also=also), None
    stroke = stroke_of(case, surroundings)
    point = case.operation
    duty = to_and_fro(
        case.model,
        case.screw,
        case.lubricant,
        axial_load=float(point.axial_load),
        screw_speed=float(point.screw_speed),
        stroke=stroke,
        also=also,
    )
    return duty, stroke


def stroke_of(case: Case, surroundings: Surroundings) -> Length:
    """The stroke of one operating point: of the surroundings, or half the shaft."""
    length = length_of(case, surroundings)
    return SHARE_OF_SHAFT * length if surroundings.stroke is None else float(surroundings.stroke)


def length_of(case: Case, surroundings: Surroundings) -> Length:
    """The shaft between its bearings: of the surroundings, of the installation, or else twice the stroke."""
    if case.shaft_length is not None:
        return case.shaft_length
    stroke = surroundings.stroke
    if case.motion is not None and case.axis is not None:
        stroke = case.motion.states().stroke
    return LENGTH if not stroke else float(stroke) / SHARE_OF_SHAFT


@overflow_as_input_error()
def warmed_up(case: Case, hours: float = 4.0, cool_down: float = 0.0) -> WarmUpReport:
    """The warming up of a case for some hours, and its cooling down for some more."""
    surroundings = case.surroundings or Surroundings()
    duty, stroke = duty_of(case, surroundings)
    result = warm_up(
        duty, surroundings, time=hours * HOUR, cool_down=cool_down * HOUR, shaft_length=length_of(case, surroundings)
    )
    return WarmUpReport(case, surroundings, result, stroke)
