"""The state of the nut of a case: what its balls carry and touch, and its torque without load."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import NamedTuple

from ballscrew.physics.components.nut import Nut
from ballscrew.physics.friction.verdicts import preload_is_lost
from ballscrew.physics.sizing.rigidity import AxialRigidity
from ballscrew.physics.solvers.load_distribution import BallLoads


class Touching(NamedTuple):
    """A pair of flanks that a ball touches: 1 is the side that carries the load, -1 the other."""

    side: int
    angle: float
    load: float


class Flank(NamedTuple):
    """Loads and contact angles of the balls on one flank: least, mean and greatest."""

    load: tuple[float, float, float]
    angle: tuple[float, float, float]


@dataclasses.dataclass(frozen=True, eq=False)
class NutState:
    """The loads of the balls of a nut, and the torque of the nut without axial load."""

    nut: Nut
    #: Preload of the nut, N.
    preload: float
    #: Torque of the nut without load: of its balls under the preload, and of seals and other losses.
    preload_drag: float
    #: The same in a full bath of oil; equal where no oil is late.
    flooded_drag: float
    #: What of it are losses beside those of the balls, by name, N m.
    idle_losses: Mapping[str, float]
    #: That of the balls as coefficients of catalogues, by the names of the result; NaN without preload.
    drag_coefficients: Mapping[str, float]
    loads: BallLoads
    #: Rigidity by ISO 3408-4, and the deflection of the drive.
    rigidity: AxialRigidity
    #: Greatest contact pressure of all balls, Pa.
    maximum_pressure: float
    #: The flank that carries the load, and the one that it relieves; None where no ball touches.
    loaded: Flank | None
    relieved: Flank | None

    @property
    def drag_of_balls(self) -> float:
        """Torque of the balls alone without load: without seals and other losses, N m."""
        return self.preload_drag - sum(self.idle_losses.values())

    @property
    def preload_is_lost(self) -> bool:
        """The load has lifted the balls off the other flank."""
        return bool(preload_is_lost(self.preload, float(self.loads.remaining_preload)))
