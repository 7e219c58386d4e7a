r"""The shaft as a bar in finite volumes: conduction along it, convection from it, heat into any of its cells.

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

import numpy as np

from ballscrew.axis.motion.states import Numbers
from ballscrew.basis.arrays import ByValue
from ballscrew.basis.quantities import (
    Conductance,
    Conductivity,
    Density,
    HeatCapacity,
    HeatTransfer,
    Length,
    TemperatureCoefficient,
    ThermalCapacity,
)
from ballscrew.physics.components.materials import STEEL_DENSITY

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
