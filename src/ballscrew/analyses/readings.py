"""What the torque column of a log is: friction or the whole drive torque, with which signs.

Rigs differ, and headings seldom say it. A torque is ``ideal · M_Sa + friction · M_S``, the two signs
by row; which of the readings that are in use is meant, the model tells: they are far apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np

from ballscrew.analyses.baselines import robust_linear
from ballscrew.analyses.robust import Vector, scatter_of
from ballscrew.analyses.torque_log import Kind

#: What gives a part of the torque its sign: load, speed, both together (which way the power goes), or nothing.
Sign = Literal["load", "against load", "speed", "motion", "none", "absent"]


class Reading(NamedTuple):
    """A way to read a torque: its kind, in words, and what gives ideal torque and friction torque their signs."""

    kind: Kind
    words: str
    ideal: Sign
    friction: Sign
    #: Whether the column has the opposite sign throughout.
    reversed: bool = False

    def weights(self, axial_load: Vector, screw_speed: Vector) -> Vector:
        """The factors of ideal torque and friction torque, of shape (2, rows), from load and speed with their signs."""
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


#: The plainest first: of readings that say the same of a log, the first is taken.
READINGS: Sequence[Reading] = (
    Reading("friction", "friction torque, its sign that of the speed", "absent", "speed"),
    Reading("friction", "magnitude of the friction torque", "absent", "none"),
    Reading("drive", "torque on the shaft, load and speed with their signs", "load", "speed"),
    Reading("drive", "torque on the shaft, the load always against the motion", "speed", "speed"),
    Reading("drive", "torque on the shaft, loads with the opposite sign", "against load", "speed"),
    Reading("drive", "torque in the direction of the motion", "motion", "none"),
    Reading("drive", "magnitude of the driving torque", "none", "none"),
    Reading("drive", "magnitude of the torque on the shaft", "none", "motion"),
)
#: A reading has to miss by this much less than a plainer one.
CLEARLY = 0.9
#: Friction so many times that of the model at the start counts as missing twice as much: models are hardly further off.
FAR_OFF = 5.0
#: As many rows as this say it.
ENOUGH = 2000


def read_as(
    torque: Vector,
    torques: Vector,
    axial_load: Vector,
    screw_speed: Vector,
    drift: Vector | None = None,
    kind: Kind = "unknown",
) -> tuple[Reading, float]:
    """The reading under which a column is nearest to a model, and the scatter that is left.

    ``torques`` are the ideal torque and the friction torque of the model, of shape (2, rows). Friction may be any
    multiple of the model's and have a constant part, and the sensor a zero error and a ``drift`` where friction has
    both signs: what is left then is what no fit mends. Of a ``kind`` that is known only its readings count.
    """
    some = np.linspace(0, torque.size - 1, min(torque.size, ENOUGH)).astype(np.int64)
    choices = [reading for reading in READINGS if kind in ("unknown", reading.kind)]
    choices += [reading._replace(reversed=True, words=f"{reading.words}; reversed") for reading in choices]

    def missed(reading: Reading) -> tuple[float, float]:
        weights = reading.weights(axial_load[some], screw_speed[some])
        columns = [weights[1] * torques[1][some], weights[1]]
        if np.any(weights[1] > 0) and np.any(weights[1] < 0):
            columns += [np.ones(some.size), *([] if drift is None else [drift[some]])]
        rest = torque[some] - weights[0] * torques[0][some]
        stacked = np.stack(columns, axis=1)
        found, _ = robust_linear(stacked, rest)
        scatter = scatter_of(stacked @ found - rest, torque)
        typical = float(np.median(torques[1][some])) or 1.0
        # friction where most of it is, constant part and all
        factor = found[0] + found[1] / typical
        if not factor > 0:
            return np.inf, scatter
        return scatter * (1 + (np.log(factor) / np.log(FAR_OFF)) ** 2), scatter

    found = [missed(reading) for reading in choices]
    best = 0
    for place, (off, _) in enumerate(found):
        if off < CLEARLY * found[best][0]:
            best = place
    return choices[best], found[best][1]
