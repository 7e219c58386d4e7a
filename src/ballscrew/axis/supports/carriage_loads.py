"""A table on four carriages: the load of each by statics."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import accepts_units, faults_of, raise_if_any
from ballscrew.basis.quantities import Acceleration, Angle, Array, Force, Info, Length, Mass

#: Sides of the carriages along the rails and across them, in the order of catalogues: round the table.
ALONG, ACROSS = np.array([-1.0, 1.0, 1.0, -1.0]), np.array([1.0, 1.0, -1.0, -1.0])


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class CarriedMass(ByValue):
    """A mass on the table, and where its centre is from the middle of the carriages, at the height of the screw."""

    mass: Annotated[Mass, Info("m", "mass", "kg", at_least=0, hint="the table is one of them")]
    along: Annotated[Length, Info("x", "centre of the mass along the rails", "mm", hint="from the middle")] = 0.0
    across: Annotated[Length, Info("y", "centre of the mass across the rails", "mm", hint="from the screw")] = 0.0
    above: Annotated[Length, Info("z", "centre of the mass above the screw", "mm", hint="below it: negative")] = 0.0

    def __post_init__(self) -> None:
        raise_if_any(faults_of("mass", self))


class CarriageLoads(NamedTuple):
    """Loads of the four carriages, N, the carriages along the last axis; the first is behind on the left side.

    Round the table: behind left, ahead left, ahead right, behind right; ahead is the direction of positive motion.
    """

    #: Pressing on the rail; negative where the carriage is pulled off it.
    normal: Array
    #: Across the rail.
    lateral: Array

    @property
    def equivalent(self) -> Force:
        r"""Equivalent loads :math:`\left|P\right| + \left|T\right|`, of carriages that bear alike in all directions."""
        return np.abs(self.normal) + np.abs(self.lateral)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class GuidedTable(ByValue):
    r"""A stiff table on two rails with two carriages each, pushed by a screw in the middle between the rails.

    .. math:: P_i = \sum_k \frac{m_k g \cos\theta}{4} \left(1 + \frac{4 x_i x_k}{l_1^2} + \frac{4 y_i y_k}{l_2^2}\right)
        - m_k \left(a + g \sin\theta\right) \frac{x_i z_k}{l_1^2},
        \qquad T_i = -m_k \left(a + g \sin\theta\right) \frac{x_i y_k}{l_1^2}

    with carriages at :math:`x_i = \pm l_1/2`, :math:`y_i = \pm l_2/2`: equilibrium of a stiff body on four springs that
    are alike. Carriages do not hold moments themselves here, and rails are straight: long carriages and errors of the
    bed change the shares. PMI2008's example comes out to 0.1 N.
    Raises :class:`~ballscrew.basis.errors.InputError` for values out of bounds.
    """

    masses: Sequence[CarriedMass]
    carriage_spacing: Annotated[
        Length, Info("l_1", "distance of the two carriages on a rail", "mm", above=0, hint="centre to centre")
    ]
    rail_spacing: Annotated[Length, Info("l_2", "distance of the two rails", "mm", above=0, hint="centre to centre")]
    inclination: Annotated[
        Angle,
        Info(
            r"\theta",
            "angle of positive motion above the horizontal",
            "deg",
            at_least=-math.pi / 2,
            at_most=math.pi / 2,
            hint="0 deg for a horizontal table",
        ),
    ] = 0.0
    gravity: Annotated[Acceleration, Info("g", "acceleration of free fall", at_least=0, hint="9.80665 m/s^2")] = 9.80665

    def __post_init__(self) -> None:
        raise_if_any(faults_of("table", self))

    @property
    def mass(self) -> Mass:
        """Mass that moves."""
        return sum(each.mass for each in self.masses)

    @accepts_units("table")
    def loads(self, acceleration: Acceleration = 0.0) -> CarriageLoads:
        """Loads of the carriages at an acceleration of the table, m/s², or at an array of them."""
        l_1, l_2, g = self.carriage_spacing, self.rail_spacing, self.gravity
        back: Any = (np.asarray(acceleration) + g * math.sin(self.inclination))[..., np.newaxis]
        down = g * math.cos(self.inclination)
        normal, lateral = 0.0 * back, 0.0 * back
        for each in self.masses:
            weight = each.mass * down * (0.25 + ALONG * each.along / (2 * l_1) + ACROSS * each.across / (2 * l_2))
            normal = normal + weight - each.mass * back * ALONG * each.above / (2 * l_1)
            lateral = lateral - each.mass * back * ALONG * each.across / (2 * l_1)
        return CarriageLoads(normal, lateral)
