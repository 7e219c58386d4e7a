"""Laws of the torques: of the friction on both races, and of the load without friction."""

from __future__ import annotations

from typing import NamedTuple

from ballscrew.basis.quantities import Force, Length, Ratio, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import equilibrium, transmission
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain, RaceTorques
from ballscrew.physics.laws.traits import law_traits


@law_traits(printed_form=True, excluded="leaves the moments of the contacts out: breaks the balance of energy")
def printed_race_torques(
    screw_tangential_force: Force,
    nut_tangential_force: Force,
    screw_contact_moment: Torque,
    nut_contact_moment: Torque,
    frame: Frame,
) -> RaceTorques:
    """Tangential forces on their levers only, Olaru2005 §6 (28) and (31)."""
    return RaceTorques(
        equilibrium.race_torque(screw_tangential_force, frame.screw_contact_radius),
        equilibrium.race_torque(nut_tangential_force, frame.nut_contact_radius),
    )


@law_traits(alternative=True)
def balanced_race_torques(
    screw_tangential_force: Force,
    nut_tangential_force: Force,
    screw_contact_moment: Torque,
    nut_contact_moment: Torque,
    frame: Frame,
) -> RaceTorques:
    """Tangential forces on their levers, and the moments of the contacts, which the paper left out."""
    cosine = frame.rolling_plane_cosine
    return RaceTorques(
        equilibrium.balanced_screw_torque(
            screw_tangential_force, frame.screw_contact_radius, screw_contact_moment, cosine
        ),
        equilibrium.balanced_nut_torque(nut_tangential_force, frame.nut_contact_radius, nut_contact_moment, cosine),
    )


@law_traits(printed_form=True, excluded="low by the factor 1 - γ: breaks the balance of energy")
def printed_ideal_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The paper's torque without friction, Olaru2005 §7 (35); low by the factor 1 - γ."""
    return transmission.ideal_torque_printed(
        axial_load, frame.screw_contact_radius, screw.lead, screw.pitch_circle_diameter
    )


@law_traits(alternative=True)
def virtual_work_torque(axial_load: Force, screw: BallScrew, frame: Frame) -> Torque:
    """The torque without friction that conserves energy, F P_h/2π."""
    return transmission.ideal_torque(axial_load, screw.lead)


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
