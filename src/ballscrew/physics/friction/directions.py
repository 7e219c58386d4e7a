"""Torque and efficiency in the four quadrants: what load and motion make of an ideal torque and a friction torque.

Friction in the terms of catalogues: friction coefficient and angle of the thread, and coefficients of the drag.
"""

from __future__ import annotations

import functools
import math
import operator
from typing import Annotated, Any

from ballscrew.basis.arrays import lazy, where
from ballscrew.basis.quantities import Angle, Array, Force, Info, Mask, Ratio, Torque
from ballscrew.physics.equations import transmission
from ballscrew.physics.friction.loaded_balls import LoadedBalls
from ballscrew.physics.solvers.load_distribution import preload_of


def direction_of(screw_speed: Array) -> Array:
    """The sign of a speed: 1, -1, or 0 at rest."""
    return where(screw_speed > 0, 1.0, where(screw_speed < 0, -1.0, 0.0))


def holding_torque(ideal_torque: Torque, screw_torque: Torque) -> Torque:
    """Torque on the shaft that holds a load of either sign; of the other sign than the load's where it locks itself."""
    size = transmission.holding_torque(abs(ideal_torque), screw_torque)
    return where(ideal_torque < 0, -size, size)


def load_drives(holding_torque: Torque, axial_load: Force) -> Mask:
    """Mask: the load alone turns the screw; False where the torque is NaN."""
    return holding_torque * axial_load > 0


def locks_itself(ideal_torque: Torque, screw_torque: Torque) -> Mask:
    """Mask: there is a load, and friction holds it."""
    size = abs(ideal_torque)
    return (size > 0) & (size <= screw_torque)


def direct_efficiency(ideal_torque: Torque, screw_torque: Torque) -> Ratio:
    """Efficiency if the screw drove the load; NaN without a load."""
    size = abs(ideal_torque)
    loaded = ideal_torque != 0
    eta = transmission.efficiency(where(loaded, size, 1.0), screw_torque)
    return where(loaded, eta, float("nan"))


def efficiency(ideal_torque: Torque, screw_torque: Torque, direction: Array) -> Ratio:
    """Efficiency where the screw drives the load, at rest its limit; NaN elsewhere."""
    drives = ((ideal_torque > 0) & (direction >= 0)) | ((ideal_torque < 0) & (direction <= 0))
    return where(drives, direct_efficiency(ideal_torque, screw_torque), float("nan"))


class VendorTerms:
    """Properties of a result that hold it against a catalogue. NaN where a term has no meaning.

    The first two describe a nut under load, the other two a preloaded nut without. A preload is in the first two as
    well, as it is in the efficiency.
    """

    @property
    def _result(self) -> Any:
        """The result itself, whose class is made of this one."""
        return self

    @lazy
    def friction_coefficient(
        self,
    ) -> Annotated[
        Ratio,
        Info(
            r"\mu",
            "friction coefficient of the thread, by the efficiency",
            address="THKGeneral A-664, HIWIN2017 Fig. 2.1",
        ),
    ]:
        """Coefficient of the inclined plane with this efficiency, screw drives the nut; NaN without a load."""
        phi = self._result.ball_screw.lead_angle
        eta = 1 / (2 - self._result.back_driving_efficiency)  # the direct one, also where the load drives
        return transmission.friction_coefficient(phi, eta)

    @lazy
    def friction_angle(
        self,
    ) -> Annotated[
        Angle,
        Info(
            r"\rho", "friction angle of the thread, by the efficiency", "deg",
            address="HIWIN2016, worked example",
        ),
    ]:  # fmt: skip
        """Angle whose tangent is the friction coefficient of the thread; NaN without a load."""
        return transmission.friction_angle(self.friction_coefficient)

    @lazy
    def preload_torque_coefficient(
        self,
    ) -> Annotated[
        Ratio,
        Info(
            "K_p", "drag coefficient of the preload, over F_pr P_h / 2 pi",
            address="JISB1192, HIWIN2017 F 3.2",
        ),
    ]:  # fmt: skip
        """Drag of the balls over the ideal torque of the preload, no seals; NaN under load, and without preload."""
        screw = self._result.ball_screw
        return self._over_preload(transmission.ideal_torque(1.0, screw.lead))

    @lazy
    def diameter_drag_coefficient(
        self,
    ) -> Annotated[
        Ratio,
        Info(
            "c_p",
            "drag coefficient of the preload, over F_pr d_m",
            address="Rexroth2006",
        ),
    ]:
        """Drag of the balls over preload and pitch circle, without seals; NaN under load, and without preload.

        The vendor's is over the nominal diameter, which is 1.5 to 5 % smaller in most screws.
        """
        return self._over_preload(self._result.ball_screw.pitch_circle_diameter)

    def _over_preload(self, lever: Torque) -> Ratio:
        """Torque of the balls over the preload and a lever; NaN under load, and without preload."""
        own = self._result
        preload: Force = preload_of(own.ball_screw, own.ball_screw.nut)
        idle = (own.axial_load == 0) & (preload > 0)
        kinds: tuple[LoadedBalls, ...] = own.kinds
        balls = functools.reduce(operator.add, [kind.sum_of(lambda ball: ball.screw_torque) for kind in kinds])
        return where(idle, balls / (where(idle, preload, 1.0) * lever), math.nan)
