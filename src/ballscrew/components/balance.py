"""One ball between its forces: from resistances to sliding forces, tangential forces and torques."""

from __future__ import annotations

from typing import NamedTuple

from ballscrew.components.frame import Frame
from ballscrew.components.laws import BallChain, RaceTorqueLaw, RaceTorques
from ballscrew.equations import equilibrium
from ballscrew.quantities import Force, Length, Torque


class Resistances(NamedTuple):
    """All that resists one ball: rolling forces, contact moments (curvature and elastic), the chain."""

    screw_rolling_force: Force
    nut_rolling_force: Force
    screw_moment: Torque
    nut_moment: Torque
    chain: BallChain


class BallBalance(NamedTuple):
    """The forces that keep the ball in equilibrium, and the torque they put on the races."""

    screw_sliding_force: Force
    nut_sliding_force: Force
    screw_tangential_force: Force
    nut_tangential_force: Force
    torques: RaceTorques


def ball_balance(
    resistances: Resistances, ball_diameter: Length, frame: Frame, race_torques: RaceTorqueLaw
) -> BallBalance:
    """Equilibrium of one ball, Olaru2005 §3 and §6; linear in the resistances."""
    F_Rs, F_Rn, M_s, M_n, chain = resistances
    forces = (M_s + M_n, chain.moment, ball_diameter, F_Rs, F_Rn, frame.curvature_ratio, chain.braking_force)
    F_Ss = equilibrium.screw_sliding_force(*forces)
    F_Sn = equilibrium.nut_sliding_force(*forces)
    F_s = equilibrium.tangential_force(F_Rs, F_Ss)
    F_n = equilibrium.tangential_force(F_Rn, F_Sn)
    return BallBalance(F_Ss, F_Sn, F_s, F_n, race_torques(F_s, F_n, M_s, M_n, frame))
