"""Laws of the torques: of the friction on both races, and of the load without friction."""

from __future__ import annotations

from ballscrew.basis.quantities import Force, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import equilibrium, transmission
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import RaceTorques
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
