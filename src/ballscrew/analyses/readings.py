"""What the torque column of a log is: friction or the whole drive torque, with which signs.

Rigs differ, and headings seldom say it. A torque is ``ideal · M_Sa + friction · M_S``, the two signs
by row; which of the few readings that are in use is meant, the model tells: they are far apart.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.analyses.torque_log import Kind

#: What gives a part of the torque its sign: the load, the speed, nothing; or it is not there.
Sign = Literal["load", "speed", "none", "absent"]


class Reading(NamedTuple):
    """A way to read a torque: its kind, in words, and what gives ideal torque and friction torque their signs."""

    kind: Kind
    words: str
    ideal: Sign
    friction: Sign
    #: Whether the column has the opposite sign throughout.
    reversed: bool = False

    def weights(self, axial_load: NDArray[np.float64], screw_speed: NDArray[np.float64]) -> NDArray[np.float64]:
        """The factors of ideal torque and friction torque, of shape (2, rows), from load and speed with their signs."""
        nothing = np.zeros_like(screw_speed)
        signs = {"load": np.sign(axial_load), "speed": np.sign(screw_speed), "none": nothing + 1, "absent": nothing}
        direction = -1.0 if self.reversed else 1.0
        return direction * np.stack([signs[self.ideal], signs[self.friction]])


#: The plainest first: of readings that say the same of a log, the first is taken.
READINGS: Sequence[Reading] = (
    Reading("friction", "friction torque, its sign that of the speed", "absent", "speed"),
    Reading("friction", "magnitude of the friction torque", "absent", "none"),
    Reading("drive", "torque on the shaft, load and speed with their signs", "load", "speed"),
    Reading("drive", "torque on the shaft, the load always against the motion", "speed", "speed"),
    Reading("drive", "magnitude of the driving torque", "none", "none"),
)
#: A reading has to miss by this much less than a plainer one.
CLEARLY = 0.9


def read_as(
    torque: NDArray[np.float64],
    torques: NDArray[np.float64],
    axial_load: NDArray[np.float64],
    screw_speed: NDArray[np.float64],
    kind: Kind = "unknown",
) -> Reading:
    """The reading under which a column is nearest to what a model says, by the median of the differences.

    ``torques`` are the ideal torque and the friction torque of the model, of shape (2, rows). Of a ``kind`` that is
    known only its readings count.
    """
    choices = [reading for reading in READINGS if kind in ("unknown", reading.kind)]
    choices += [reading._replace(reversed=True, words=f"{reading.words}; reversed") for reading in choices]

    def missed(reading: Reading) -> float:
        weights = reading.weights(axial_load, screw_speed)
        return float(np.median(np.abs(torque - np.sum(weights * torques, axis=0))))

    best = choices[0]
    least = missed(best)
    for reading in choices[1:]:
        off = missed(reading)
        if off < CLEARLY * least:
            best, least = reading, off
    return best
