"""One ball between its forces along the path: from resistances to sliding and tangential forces."""

from __future__ import annotations

from typing import NamedTuple

from ballscrew.basis.quantities import Force, Length, Ratio, Torque
from ballscrew.physics.equations import equilibrium
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain


class Resistances(NamedTuple):
    """All that resists one ball: rolling forces, contact moments (curvature and elastic), the chain."""

    screw_rolling_force: Force
    nut_rolling_force: Force
    screw_moment: Torque
    nut_moment: Torque
    chain: BallChain

    def scaled(self, share: Ratio) -> Resistances:
        """A share of them all."""
        F_Rs, F_Rn, M_s, M_n, chain = self
        return Resistances(
            share * F_Rs,
            share * F_Rn,
            share * M_s,
            share * M_n,
            BallChain(share * chain.moment, share * chain.braking_force, share * chain.net_braking_force),
        )


class BallForces(NamedTuple):
    """The forces along the path that keep the ball in equilibrium."""

    screw_sliding_force: Force
    nut_sliding_force: Force
    screw_tangential_force: Force
    nut_tangential_force: Force


def ball_forces(resistances: Resistances, ball_diameter: Length, frame: Frame) -> BallForces:
    """Equilibrium of one ball, Olaru2005 §3 and §6; linear in the resistances."""
    F_Rs, F_Rn, M_s, M_n, chain = resistances
    forces = (M_s + M_n, chain.moment, ball_diameter, F_Rs, F_Rn, frame.curvature_ratio, chain.braking_force)
    F_Ss = equilibrium.screw_sliding_force(*forces)
    F_Sn = equilibrium.nut_sliding_force(*forces)
    return BallForces(F_Ss, F_Sn, equilibrium.tangential_force(F_Rs, F_Ss), equilibrium.tangential_force(F_Rn, F_Sn))
