r"""The network of heat: cells of the shaft, nut and bearings with their conductances, linear but for the friction.

The shaft as a bar in finite volumes: conduction along it, convection from it, heat into any of its cells.

.. math::

    \rho c A \frac{\partial T}{\partial t} = \frac{\partial}{\partial x} \lambda A \frac{\partial T}{\partial x}
    - h U (T - T_a) + q'(x, t)

One temperature over the cross-section: the Biot number h d/4λ is some 0.01. Heat is conserved to rounding, so that the
steady growth of a shaft with insulated ends, :math:`\alpha_T Q/hU`, is exact whatever the cells.
"""

from __future__ import annotations

import dataclasses
import functools
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from ballscrew.axis.duty_cycle.duty import Duty
from ballscrew.axis.motion.states import Numbers
from ballscrew.axis.supports.bearing import MountedBearing
from ballscrew.axis.thermal import surroundings as air
from ballscrew.axis.thermal.friction_map import COLDEST, HOTTEST, FrictionMap, friction_map
from ballscrew.axis.thermal.surroundings import Surroundings
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import (
    AngularSpeed,
    Conductance,
    Conductivity,
    Density,
    Force,
    HeatCapacity,
    HeatTransfer,
    Length,
    Mass,
    Power,
    Ratio,
    TemperatureCoefficient,
    ThermalCapacity,
)
from ballscrew.physics.components.materials import STEEL_DENSITY
from ballscrew.physics.components.nut import Nut, SingleNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, heat, hertz
from ballscrew.physics.equations.nut_losses import backward_half_load
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.solvers.load_distribution import preload_of

#: Steel of shafts and nuts: thermal conductivity W/(m K), heat capacity J/(kg K), density kg/m³, expansion 1/K.
CONDUCTIVITY, CAPACITY, DENSITY, EXPANSION = 46.0, 470.0, STEEL_DENSITY, 11.7e-6
CELLS = 60


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Shaft(ByValue):
    """A shaft of one cross-section, solid or hollow, from one bearing to the other."""

    length: Length
    diameter: Length
    #: Diameter of a bore through which a coolant flows; zero for a solid shaft.
    bore: Length = 0.0
    #: Heat transfer to the air around, and to the coolant in the bore, W/(m² K).
    convection: HeatTransfer = 0.0
    bore_convection: HeatTransfer = 0.0
    conductivity: Conductivity = CONDUCTIVITY
    heat_capacity: HeatCapacity = CAPACITY
    density: Density = DENSITY
    expansion: TemperatureCoefficient = EXPANSION
    cells: int = CELLS

    @property
    def cell(self) -> Length:
        """Length of a cell."""
        return self.length / self.cells

    @property
    def places(self) -> Numbers:
        """Middles of the cells, from the first bearing."""
        return (np.arange(self.cells) + 0.5) * self.cell

    @property
    def section(self) -> float:
        """Area of the cross-section, m²."""
        return math.pi / 4 * (self.diameter**2 - self.bore**2)

    @property
    def cell_capacity(self) -> ThermalCapacity:
        """Heat capacity of a cell, J/K."""
        return self.density * self.heat_capacity * self.section * self.cell

    @property
    def cell_to_air(self) -> Conductance:
        """Conductance of a cell to the air, W/K."""
        return self.convection * math.pi * self.diameter * self.cell

    @property
    def cell_to_coolant(self) -> Conductance:
        """Conductance of a cell to the coolant, W/K."""
        return self.bore_convection * math.pi * self.bore * self.cell

    @property
    def to_neighbour(self) -> Conductance:
        """Conductance between the middles of neighbouring cells, W/K."""
        return self.conductivity * self.section / self.cell

    def to_end(self, beyond: Conductance) -> Conductance:
        """Conductance from the middle of an end cell to what lies ``beyond`` the end, half a cell between them, W/K."""
        return beyond / (1 + beyond / (2 * self.to_neighbour))

    @functools.cached_property
    def conduction(self) -> Numbers:
        """Heat out of each cell to its neighbours for each kelvin, a matrix, W/K, whose columns sum to zero."""
        values = np.zeros((self.cells, self.cells))
        for i in range(self.cells - 1):
            values[i, i] += self.to_neighbour
            values[i + 1, i + 1] += self.to_neighbour
            values[i, i + 1] -= self.to_neighbour
            values[i + 1, i] -= self.to_neighbour
        return values

    def spread(self, places: Numbers, weights: Numbers, length: Length) -> Numbers:
        """Shares of the cells in a heat that is given over a length around each of some places, with their weights.

        They sum to one; what would lie beyond an end stays in the shaft.
        """
        edges = np.arange(self.cells + 1) * self.cell
        half = max(length, 1e-9 * self.length) / 2
        middle = np.clip(places, half, max(self.length - half, half))[:, None]
        reached = np.clip((edges - (middle - half)) / (2 * half), 0.0, 1.0)
        shares = np.asarray(weights) @ np.diff(reached, axis=1)
        return shares / np.sum(shares)

    def growth_at(self, temperature: Numbers, reference: float, place: Numbers | float) -> Numbers:
        r"""Growth between the first bearing and places, :math:`\alpha_T \int_0^x (T - T_{ref}) dx`, m.

        The last axis of the temperatures are the cells.
        """
        edges = np.arange(self.cells + 1) * self.cell
        rise = np.cumsum(np.asarray(temperature) - reference, axis=-1) * self.cell * self.expansion
        whole = np.concatenate([np.zeros((*rise.shape[:-1], 1)), rise], axis=-1)
        where = np.atleast_1d(np.asarray(place, dtype=float))
        flat = [np.interp(where, edges, row) for row in whole.reshape(-1, self.cells + 1)]
        return np.reshape(flat, (*rise.shape[:-1], where.size))


#: Gap between shaft and nut that the grease fills, over the ball diameter, and its conductivity: assumptions.
GAP_SHARE, GREASE_CONDUCTIVITY = 0.1, 0.14
#: Outer diameter of a nut over that of the pitch circle, and its length beyond the loaded turns in leads: assumptions.
NUT_WALL, NUT_ENDS = 1.6, 2.0
#: Zero of the scale in which people give temperatures, K.
ZERO_CELSIUS = 273.15


@dataclasses.dataclass(frozen=True, eq=False)
class FrictionFactor(ByValue):
    """Ratio of the friction to that of the map, where its inputs are uncertain.

    Known at two temperatures of the oil, between which it goes evenly, and beyond which it stays.
    """

    #: The lower first; of networks side by side each is an array.
    temperatures: tuple[Any, Any]
    factors: tuple[Any, Any]

    def at(self, temperature: Any) -> Any:
        """The factor at a temperature of the oil."""
        cold, warm = self.temperatures
        share = np.clip((temperature - cold) / (warm - cold), 0.0, 1.0)
        return self.factors[0] + share * (self.factors[1] - self.factors[0])


@dataclasses.dataclass(frozen=True, eq=False)
class Network(ByValue):
    r"""Heat balance :math:`C \dot T = -A T + b + s P(T) + B` of shaft cells, nut and two bearings, in this order.

    ``P`` is the mean friction power of the nut, shared between shaft and nut. Only it is not linear; it depends on the
    mean temperature of the oil and on the preload, and both are linear in the temperatures.
    """

    shaft: Shaft
    surroundings: Surroundings
    #: Shares of the cells in what the nut gives to the shaft.
    spread: Numbers
    ball_conductance: Conductance
    nut_mass: float
    #: Mean friction power of the first and the last bearing, W.
    bearing_power: tuple[Power, Power]
    friction: FrictionMap
    #: Preload as it was set, at one temperature everywhere, N.
    preload_set: Force
    #: Approach of the groove pair of a ball at that preload, and per kelvin by which the shaft is warmer than the nut.
    approach_set: Length
    approach_per_kelvin: float
    #: Places of the middle of the nut at the ends of its travel, m from the fixed bearing.
    ends: tuple[Length, Length]
    #: What the shaft's growth between the halves of the nut adds or takes per kelvin, where it is not known which.
    approach_of_unknown_sign: float = 0.0
    friction_factor: FrictionFactor | None = None

    @functools.cached_property
    def by_bracing(self) -> Mapping[str, Network]:
        """The network for both ways of bracing, where the way is not known and counts."""
        if not self.approach_of_unknown_sign:
            return {}
        radial, along = self.approach_per_kelvin, self.approach_of_unknown_sign
        return {
            name: dataclasses.replace(self, approach_per_kelvin=radial + sign * along, approach_of_unknown_sign=0.0)
            for name, sign in air.BRACINGS.items()
        }

    @property
    def size(self) -> int:
        """Number of temperatures."""
        return self.shaft.cells + 3

    @functools.cached_property
    def standing(self) -> Network:
        """The same while the axis stands: the shaft does not turn in the air, unless its convection is given."""
        if self.surroundings.shaft_convection is not None:
            return self
        still = min(air.STILL, self.shaft.convection)
        return dataclasses.replace(self, shaft=dataclasses.replace(self.shaft, convection=still))

    @functools.cached_property
    def capacity(self) -> Numbers:
        """Heat capacities, J/K."""
        values = np.full(self.size, self.shaft.cell_capacity)
        values[-3] = self.nut_mass * CAPACITY
        values[-2:] = self.surroundings.bearing_mass * CAPACITY
        return values

    @functools.cached_property
    def losses(self) -> Numbers:
        """Conductances to the outside, W/K: to the air, and of the cells to the coolant."""
        losses = np.full(self.size, self.shaft.cell_to_air + self.shaft.cell_to_coolant)
        losses[-3] = self.surroundings.nut_conductance
        losses[-2:] = self.surroundings.bearing_conductance
        return losses

    @functools.cached_property
    def outside(self) -> Numbers:
        """Temperature to which each gives its heat, K: the air's, and for cells with a coolant the mean of both."""
        ambient, coolant = self.surroundings.ambient, self.surroundings.coolant
        values = np.full(self.size, float(ambient))
        if coolant is not None and self.shaft.cell_to_coolant:
            both = self.shaft.cell_to_air + self.shaft.cell_to_coolant
            values[:-3] = (self.shaft.cell_to_air * ambient + self.shaft.cell_to_coolant * coolant) / both
        return values

    @functools.cached_property
    def conductances(self) -> Numbers:
        """Heat out of each for each kelvin of each, W/K: conduction, balls, bearings, and the outside."""
        n = self.shaft.cells
        values = np.zeros((self.size, self.size))
        values[:n, :n] = self.shaft.conduction
        to_shaft = np.zeros(self.size)
        to_shaft[:n], to_shaft[n] = self.spread, -1.0
        values += self.ball_conductance * np.outer(to_shaft, to_shaft)
        to_bearing = self.shaft.to_end(self.surroundings.shaft_to_bearing)
        for bearing, cell in ((n + 1, 0), (n + 2, n - 1)):
            ends = np.zeros(self.size)
            ends[bearing], ends[cell] = 1.0, -1.0
            values += to_bearing * np.outer(ends, ends)
        return values + np.diag(self.losses)

    @functools.cached_property
    def source(self) -> Numbers:
        """Shares of the temperatures in the friction power of the nut; they sum to one."""
        source = np.zeros(self.size)
        source[:-3] = self.surroundings.shaft_share * self.spread
        source[-3] = 1 - self.surroundings.shaft_share
        return source

    @functools.cached_property
    def constant(self) -> Numbers:
        """Heat that comes from outside and from the bearings, W."""
        constant = self.losses * self.outside
        constant[-2:] += self.bearing_power
        return constant

    # -- what the friction depends on -------------------------------------------------------------

    @functools.cached_property
    def of_oil(self) -> Numbers:
        """Weights of the temperatures in that of the oil: half the nut's, half that of the shaft in it."""
        values = np.zeros(self.size)
        values[:-3], values[-3] = 0.5 * self.spread, 0.5
        return values

    @functools.cached_property
    def of_excess(self) -> Numbers:
        """Weights of the temperatures in how much the shaft is warmer than the nut."""
        values = np.zeros(self.size)
        values[:-3], values[-3] = self.spread, -1.0
        return values

    def preload(self, excess: Any) -> Any:
        """Preload where the shaft is so much warmer than the nut, N; zero where it is lost."""
        # heat adds to the approach what a displacement would take
        return backward_half_load(self.preload_set, -(self.approach_per_kelvin * excess / self.approach_set))

    def power_at(self, oil: Numbers, preload: Numbers) -> Numbers:
        """Mean friction power of the nut at temperatures of the oil and preloads, W; NaN where it is not known."""
        result = self.friction.at_all(oil, preload)
        return result if self.friction_factor is None else result * self.friction_factor.at(oil)

    def power(self, temperatures: Numbers) -> Power:
        """Mean friction power of the nut, W."""
        oil = float(self.of_oil @ temperatures)
        result = self.friction.at(oil, float(self.preload(self.of_excess @ temperatures)))
        return result if self.friction_factor is None else result * float(self.friction_factor.at(oil))

    def powers(self, temperatures: Numbers) -> Numbers:
        """The same of many temperatures, W: one row each; NaN where friction is not known."""
        return self.power_at(temperatures @ self.of_oil, self.preload(temperatures @ self.of_excess))

    def inside(self, temperatures: Numbers) -> bool:
        """True where the friction is known: oil and preload within the map."""
        return self.friction.has(float(self.of_oil @ temperatures), float(self.preload(self.of_excess @ temperatures)))


def network_of(
    duty: Duty, surroundings: Surroundings, *, shaft_length: Length | None = None, friction: FrictionMap | None = None
) -> Network:
    """The network of a duty in its surroundings; a map of its ``friction`` that is there is not made again.

    Raises :class:`~ballscrew.basis.errors.InputError` without a length of the shaft, for a motion that does not fit on
    it, for an ambient temperature at which the oil is not known, and as
    :func:`~ballscrew.axis.thermal.friction_map.friction_map` does.
    """
    if not COLDEST <= surroundings.ambient <= HOTTEST:
        known = " to ".join(f"{end - ZERO_CELSIUS:g} °C" for end in (COLDEST, HOTTEST))
        given = f"{surroundings.ambient - ZERO_CELSIUS:.4g} °C"
        remedy = f"the oil is known from {known}"
        raise InputError(Fault("surroundings.ambient", "is not among the temperatures of the oil", given, remedy))
    length = surroundings.shaft_length if surroundings.shaft_length is not None else shaft_length
    if length is None:
        remedy = 'give {surroundings.shaft_length}"1.2 m", or the unsupported length of the installation'
        raise InputError(Fault("surroundings.shaft_length", "missing", "", remedy))
    friction = friction_map(duty) if friction is None else friction
    driven: Any = duty.driven
    screw, oil = driven.screw, driven.lubricant
    root = geometry.groove_root_diameter(
        screw.pitch_circle_diameter, screw.ball_diameter, screw.screw_conformity, screw.contact_angle
    )
    if surroundings.bore >= root:
        given = f"{surroundings.bore * 1e3:.4g} mm in a shaft of {float(root) * 1e3:.4g} mm"
        raise InputError(Fault("surroundings.bore", "leaves no shaft", given, "give a smaller bore"))
    nut_length = nut_length_of(screw)
    mean_speed = duty.mean_speed
    shaft = Shaft(
        length=float(length),
        diameter=float(root),
        bore=float(surroundings.bore),
        convection=convection_of(surroundings, float(root), mean_speed),
        bore_convection=0.0 if surroundings.coolant is None else float(surroundings.coolant_convection),
    )
    places = duty.states.places_on(float(length), surroundings.first_position)
    heated = duty.states.weight * np.abs(duty.screw_speed)
    heated = heated if np.any(heated) else duty.states.weight
    set_to = float(preload_of(screw, screw.nut))
    loaded = set_to or max(float(np.max(np.abs(duty.axial_load))), 1.0)
    # the contacts of all nuts are alike: those of a row of balls that carries the preload, or else the largest load
    row = dataclasses.replace(screw, nut=SingleNut())
    at_load = driven.model(row, oil, axial_load=loaded, screw_speed=max(mean_speed, 1e-3))
    balls = surroundings.ball_conductance
    mass = surroundings.nut_mass
    if mass is None:
        mass = nut_mass_of(screw)
    radial = float(heat.thermal_approach(screw.contact_angle, EXPANSION, 1.0, screw.pitch_circle_diameter))
    apart = _distance_of_halves(screw)
    along = float(heat.thermal_approach_along(screw.contact_angle, EXPANSION, 1.0, apart)) if set_to else 0.0
    return Network(
        shaft,
        surroundings,
        shaft.spread(places, heated, nut_length),
        float(conductance_of_balls(at_load, screw.nut, nut_length)) if balls is None else float(balls),
        float(mass),
        power_of_supports(duty),
        friction,
        set_to,
        float(approach_of(at_load)),
        radial + air.BRACINGS.get(surroundings.bracing, 0.0) * along,
        (float(np.min(places)), float(np.max(places))),
        0.0 if surroundings.bracing else along,
    )


def convection_of(surroundings: Surroundings, diameter: Length, speed: AngularSpeed) -> HeatTransfer:
    """Heat transfer of a shaft to the air: as given, or by its speed, and at least that of a body at rest."""
    if surroundings.shaft_convection is not None:
        return float(surroundings.shaft_convection)
    Re = heat.rotational_reynolds(diameter, speed, air.AIR_VISCOSITY)
    turning = heat.rotating_shaft_convection(Re, air.AIR_PRANDTL, air.AIR_CONDUCTIVITY, diameter)
    return max(float(turning), air.STILL)


def nut_length_of(screw: BallScrew) -> Length:
    """Length of a nut: its loaded turns, and what is beyond them."""
    return nut_length(screw.loaded_turns, screw.lead, screw.nut.halves)


def nut_mass_of(screw: BallScrew) -> Mass:
    """Mass of the body of a nut of usual wall: an estimate."""
    wall = math.pi / 4 * (NUT_WALL**2 - 1) * screw.pitch_circle_diameter**2
    return DENSITY * float(wall) * nut_length_of(screw)


def nut_length(loaded_turns: Ratio, lead: Length, halves: int) -> Length:
    """Length of a nut of so many halves with these turns each: an estimate, to be replaced by that of a drawing."""
    return float(loaded_turns * lead * halves + NUT_ENDS * lead)


def _distance_of_halves(screw: BallScrew) -> Length:
    """Distance between the middles of the two halves of a nut; zero of a nut of one body and one kind of balls."""
    if screw.nut.halves == 1:
        return 0.0
    nut: Any = screw.nut
    return float(nut.spacing + screw.loaded_turns * screw.lead)


def power_of_supports(duty: Duty) -> tuple[Power, Power]:
    """Mean friction power of what holds the shaft at its first and its last end, W, with the oil of the duty.

    What has no end of the shaft as its place heats both alike.
    """
    first = last = 0.0
    for name, torque in duty.support_friction.items():
        power = duty.states.integral(torque * np.abs(duty.screw_speed)) / duty.states.cycle_time
        element = duty.also.get(name)
        far = float(element.at_far_end) if isinstance(element, MountedBearing) else 0.5
        first, last = first + (1 - far) * power, last + far * power
    return first, last


def conductance_of_balls(result: FrictionResult, nut: Nut, nut_length: Length) -> Any:
    """Heat from nut to shaft for each kelvin: through every ball, and through the grease around them.

    A ball conducts through two contacts, each two half spaces and a film in series. Contacts are taken as at rest;
    moving ones conduct more, and the gap is not known: a factor of three either way is honest.
    """
    screw = result.ball_screw
    resistance = 0.0
    for contact in (result.screw, result.nut):
        kappa = np.maximum(contact.semi_major_axis / contact.semi_minor_axis, 1.0)
        spot = heat.spot_resistance(hertz.elliptic_integrals(kappa).K, CONDUCTIVITY, contact.semi_major_axis)
        film = heat.film_resistance(
            contact.central_film_thickness, GREASE_CONDUCTIVITY, contact.semi_major_axis, contact.semi_minor_axis
        )
        resistance = resistance + 2 * spot + film
    balls = screw.loaded_balls * nut.halves * nut.contacts_per_ball / 2
    gap = heat.gap_conductance(
        GREASE_CONDUCTIVITY, screw.pitch_circle_diameter, nut_length, GAP_SHARE * screw.ball_diameter
    )
    return balls / resistance + gap


def approach_of(result: FrictionResult) -> Any:
    """Approach of the groove pair of the most loaded ball, both contacts together."""
    return result.screw.mutual_approach + result.nut.mutual_approach


def steady(network: Network, power: Power) -> Numbers:
    """Temperatures in the steady state with a given friction power of the nut, K."""
    return np.linalg.solve(network.conductances, network.constant + network.source * power)
