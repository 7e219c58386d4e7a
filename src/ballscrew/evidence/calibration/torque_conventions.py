"""Torque conventions: whether the torque column of a log is friction or drive torque, and with which signs.

Rigs differ, and headings seldom state it. A torque is ``ideal · |M_Sa| + friction · M_S``, the two signs
by row. The conventions in use are far apart, so that the model identifies the one that was used. Both signs together
say on which side of the nut the load is, whatever sign the column of the load has.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from ballscrew.evidence.calibration.baselines import robust_linear
from ballscrew.evidence.calibration.robust import Vector, scatter_of
from ballscrew.files.torque_logs.log_rows import Kind

#: The source of the sign of a part of the torque: load, speed, both (the direction of the power), or nothing.
Sign = Literal["load", "against load", "speed", "motion", "none", "absent"]


class TorqueConvention(NamedTuple):
    """The kind of a torque, and the sources of the signs of the ideal torque and the friction torque in it."""

    kind: Kind
    description: str
    ideal: Sign
    friction: Sign
    #: Whether the column has the opposite sign throughout.
    reversed: bool = False

    def loads(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The loads with the signs of the model: positive where a positive speed works against them.

        Those of the column, unless the torque says that it has their sizes alone or the opposite signs.
        """
        if self.ideal == "absent":
            return np.asarray(axial_load)
        ideal, friction = self._signs(axial_load, screw_speed)
        return np.abs(axial_load) * ideal * friction * np.sign(screw_speed)

    def weights(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The factors of ideal torque and friction torque under :meth:`loads`, of shape (2, rows)."""
        _, friction = self._signs(axial_load, screw_speed)
        # an ideal torque with the sign of its load works against friction where it has not that of the speed
        return np.stack([friction * np.sign(screw_speed) * (self.ideal != "absent"), friction])

    def _signs(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The signs of the size of the ideal torque and of the friction torque in the column, of shape (2, rows)."""
        load, speed = np.sign(axial_load), np.sign(screw_speed)
        nothing = np.zeros_like(screw_speed)
        signs: dict[Sign, Vector] = {
            "load": load,
            "against load": -load,
            "speed": speed,
            "motion": load * speed,
            "none": nothing + 1,
            "absent": nothing,
        }
        direction = -1.0 if self.reversed else 1.0
        return direction * np.stack([signs[self.ideal], signs[self.friction]])


#: The simplest first: of conventions that fit a log equally well, the first is taken.
CONVENTIONS: Sequence[TorqueConvention] = (
    TorqueConvention("friction", "friction torque, its sign that of the speed", "absent", "speed"),
    TorqueConvention("friction", "magnitude of the friction torque", "absent", "none"),
    TorqueConvention("drive", "torque on the shaft, load and speed with their signs", "load", "speed"),
    TorqueConvention("drive", "torque on the shaft, the load always against the motion", "speed", "speed"),
    TorqueConvention("drive", "torque on the shaft, loads with the opposite sign", "against load", "speed"),
    TorqueConvention("drive", "torque in the direction of the motion", "motion", "none"),
    TorqueConvention("drive", "magnitude of the driving torque", "none", "none"),
    TorqueConvention("drive", "magnitude of the torque on the shaft", "none", "motion"),
)
#: A convention replaces a simpler one if its residual is below this share of the other's.
DECISIVE_RATIO = 0.9
#: Friction of this ratio to the model's counts as a doubled residual: models are hardly further off.
IMPLAUSIBLE_RATIO = 5.0
#: Rows that the conventions are compared on, evenly spaced.
MAXIMUM_ROWS = 2000


def identify_convention(
    torque: Vector,
    torques: Vector,
    axial_load: Vector,
    screw_speed: Vector,
    drift: Vector | None = None,
    kind: Kind = "unknown",
    known: TorqueConvention | None = None,
) -> tuple[TorqueConvention, float]:
    """The convention under which a column is nearest to a model, and the scatter that remains.

    ``torques`` are the ideal torque and the friction torque of the model, of shape (2, rows). Friction may be any
    multiple of the model's and have a constant part, and the sensor a zero error and a ``drift`` where friction has
    both signs: the remaining scatter is that which no fit removes. A known ``kind`` restricts the conventions, one that
    is ``known`` itself is the only one.
    """
    some = np.linspace(0, torque.size - 1, min(torque.size, MAXIMUM_ROWS)).astype(np.int64)
    choices = [convention for convention in CONVENTIONS if kind in ("unknown", convention.kind)]
    choices += [one._replace(reversed=True, description=f"{one.description}; reversed") for one in choices]
    choices = choices if known is None else [known]

    def penalised_scatter(convention: TorqueConvention) -> tuple[float, float]:
        weights = convention.weights(axial_load[some], screw_speed[some])
        ideal = np.abs(torques[0][some]) * np.sign(convention.loads(axial_load[some], screw_speed[some]))
        columns = [weights[1] * torques[1][some], weights[1]]
        if np.any(weights[1] > 0) and np.any(weights[1] < 0):
            columns += [np.ones(some.size), *([] if drift is None else [drift[some]])]
        rest = torque[some] - weights[0] * ideal
        stacked = np.stack(columns, axis=1)
        result, _ = robust_linear(stacked, rest)
        scatter = scatter_of(stacked @ result - rest, torque)
        typical = float(np.median(torques[1][some])) or 1.0
        # friction at a typical row over the model's, constant part included
        factor = result[0] + result[1] / typical
        if not factor > 0:
            return np.inf, scatter
        return scatter * (1 + (np.log(factor) / np.log(IMPLAUSIBLE_RATIO)) ** 2), scatter

    scatters = [penalised_scatter(convention) for convention in choices]
    best = 0
    for place, (penalised, _) in enumerate(scatters):
        if penalised < DECISIVE_RATIO * scatters[best][0]:
            best = place
    return choices[best], scatters[best][1]
