"""Friction of one loaded ball on two contacts: its equilibrium, its torque by mechanism, and where the power goes."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, Protocol

import numpy as np

from ballscrew.basis.arrays import lazy
from ballscrew.basis.quantities import AngularSpeed, Force, Info, Length, Mask, Power, Ratio, Speed, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import equilibrium, geometry, heat, kinematics
from ballscrew.physics.equations.rolling import nut_pressure_force, screw_pressure_force
from ballscrew.physics.laws.ball_chain import BallInCircuit, force_between_balls
from ballscrew.physics.laws.conditions import Motion
from ballscrew.physics.laws.contact import Contact, ContactLaws, RaceState, rolling_contact
from ballscrew.physics.laws.frame import Frame
from ballscrew.physics.laws.protocols import BallChain, RaceTorqueLaw
from ballscrew.physics.laws.torque import Resistances, ball_forces
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.slip import BallProblem, ContactSlip, Slip

#: The mechanisms a torque is made of, and what each is called in words.
MECHANISMS: Mapping[str, str] = {
    "hydrodynamic_rolling": "hydrodynamic rolling",
    "elastic_hysteresis": "elastic hysteresis",
    "curvature": "curvature slip",
    "spin": "spin slip",
    "helix": "helix slip",
    "ball_to_ball": "ball to ball",
    "chain_braking": "braking of the ball chain",
}


class BallModel(Protocol):
    """Model as the friction of a ball needs it: its laws, to be called, and two numbers."""

    @property
    def laws(self) -> Any:
        """The laws by slot, to be called."""
        ...

    @property
    def contact_laws(self) -> Any:
        """The laws of one contact, to be called."""
        ...

    @property
    def slip(self) -> Any:
        """The slip law, with its traits."""
        ...

    @property
    def ball_force(self) -> Any:
        """The law of the force between balls, with its traits."""
        ...

    @property
    def ball_friction_coefficient(self) -> Ratio:
        """Friction coefficient between balls."""
        ...

    @property
    def pure_rolling_offset(self) -> Ratio | None:
        """Offset of the lines of pure rolling, where it is imposed."""
        ...

    def imposed_ball_force(self, screw: BallScrew) -> Force:
        """The force between neighbouring balls where the load does not set it."""
        ...


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class BallFriction:
    """Friction of one ball on two contacts in its equilibrium; everything else is computed when it is asked for."""

    frame: Frame
    ball_diameter: Length
    contact_load: Annotated[Force, Info("Q", "normal load of each loaded ball")]
    entrainment_speed: Annotated[Speed, Info("v", "entrainment speed at both contacts")]
    screw: RaceState
    nut: RaceState
    ball_chain: BallChain
    ball_to_ball_force: Annotated[Force, Info("F_B", "force between neighbouring balls")]
    spin_moment: Annotated[Torque, Info("M_P", "moment about the contact normals, the same at both contacts", "N mm")]
    lateral_force: Annotated[Force, Info("F_L", "friction across the path, the same at both contacts")]
    rolling_share: Annotated[
        Ratio, Info(r"\sigma", "share of the resistances to rolling that friction carries; below one the ball skids")
    ]
    race_torques: RaceTorqueLaw
    converged: Mask
    slip_is_curvature_alone: bool

    @property
    def screw_torque(self) -> Torque:
        """Friction torque of the ball on the screw."""
        return self.screw.friction_torque

    @property
    def nut_torque(self) -> Torque:
        """Friction torque of the ball on the nut."""
        return self.nut.friction_torque

    @property
    def net_braking_force(self) -> Force:
        """Net push of the neighbours against the motion."""
        return self.ball_chain.net_braking_force

    @lazy
    def ball_friction_moment(
        self,
    ) -> Annotated[
        Torque, Info("M_B", "braking moment of the neighbouring balls", "N mm", address="Olaru2005 §2.2 (21)")
    ]:
        """Braking moment of the neighbouring balls."""
        return self.ball_chain.moment

    @lazy
    def contributions(self) -> Mapping[str, Torque]:
        """Friction torque of the ball on the screw by mechanism, N m.

        The torque is linear in the forces and moments of the mechanisms, so each part is the torque
        with all others struck out.
        """
        s, n, chain = self.screw, self.nut, self.ball_chain
        zero = 0 * s.friction_torque
        F_Rs, F_Rn = s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force
        M_ERs, M_ERn = s.elastic_resistance_moment, n.elastic_resistance_moment
        M_Cs, M_Cn = s.curvature_friction_moment, n.curvature_friction_moment
        # adding zero gives the parts that depend on less the shape of the operating point
        M_B, F_net = chain.moment + zero, chain.net_braking_force + zero
        of_moment = chain.braking_force - chain.net_braking_force + zero
        nothing = BallChain(zero, zero)
        parts = {
            "hydrodynamic_rolling": Resistances(F_Rs, F_Rn, zero, zero, nothing),
            "elastic_hysteresis": Resistances(zero, zero, M_ERs, M_ERn, nothing),
            "curvature": Resistances(zero, zero, M_Cs, M_Cn, nothing),
            "ball_to_ball": Resistances(zero, zero, zero, zero, BallChain(M_B, of_moment)),
            "chain_braking": Resistances(zero, zero, zero, zero, BallChain(zero, F_net)),
        }
        torques = {mechanism: self._screw_torque_of(part) for mechanism, part in parts.items()}
        torques["spin"] = zero + equilibrium.spin_torque(self.spin_moment, self.frame.rolling_plane_sine)
        torques["helix"] = zero + equilibrium.torsion_torque(
            self.lateral_force, self.ball_diameter, self.frame.lead_angle
        )
        return {mechanism: torques[mechanism] for mechanism in MECHANISMS}

    def _screw_torque_of(self, part: Resistances) -> Torque:
        """Torque of the ball on the screw that a part of its resistances gives rise to."""
        forces = ball_forces(part, self.ball_diameter, self.frame)
        return self.race_torques(
            forces.screw_tangential_force, forces.nut_tangential_force, part.screw_moment, part.nut_moment, self.frame
        ).screw

    @lazy
    def dissipation(self) -> Mapping[str, Power]:
        """Power dissipated at the ball by mechanism, W, from local forces and local speeds.

        The speeds are those of a ball whose races creep ahead of it, where the slip law tells how
        much; what the sliding forces dissipate in creep counts as curvature slip. That the sum is the
        torque's power says that the ball is in balance, not that its slip has settled: the forces
        are those of the balance, and how far the slip is from them, ``converged`` tells.
        """
        s, n, chain, frame = self.screw, self.nut, self.ball_chain, self.frame
        d_w, cosine = self.ball_diameter, frame.rolling_plane_cosine
        A_s, A_n = s.creep_speed, n.creep_speed
        w = kinematics.ball_surface_speed(
            self.entrainment_speed, A_s, A_n, s.contact_radius, n.contact_radius, frame.path_radius
        )
        ball = kinematics.ball_rotation(w, d_w)
        orbit = kinematics.orbital_rotation(w + A_n, n.contact_radius)
        relative = kinematics.screw_relative_rotation(w + A_s, s.contact_radius)
        at_screw = kinematics.screw_contact_rotation(ball, relative, cosine)
        at_nut = kinematics.nut_contact_rotation(ball, orbit, cosine)
        return {
            "hydrodynamic_rolling": heat.hydrodynamic_rolling_power(
                s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force, w + A_s / 2, w + A_n / 2
            ),
            "elastic_hysteresis": heat.contact_moment_power(
                s.elastic_resistance_moment, n.elastic_resistance_moment, at_screw, at_nut
            ),
            "curvature": heat.contact_moment_power(
                s.curvature_friction_moment, n.curvature_friction_moment, at_screw, at_nut
            )
            + heat.creep_power(s.sliding_force, n.sliding_force, A_s, A_n),
            "spin": heat.spin_power(self.spin_moment, s.spin + n.spin),
            "helix": heat.torsion_power(self.lateral_force, s.lateral_slip_speed + n.lateral_slip_speed),
            "ball_to_ball": heat.ball_rubbing_power(chain.moment, ball),
            "chain_braking": heat.chain_braking_power(
                chain.net_braking_force, kinematics.orbital_speed(orbit, frame.path_radius)
            ),
        }


def ball_friction(
    model: BallModel,
    screw: BallScrew,
    lubricant: Lubricant,
    frame: Frame,
    contact_load: Force,
    screw_speed: AngularSpeed,
    imposed_ball_force: Force,
) -> BallFriction:
    """Friction of a ball under a contact load, at a speed without sign; the balls of the screw have its contact angle.

    ``imposed_ball_force`` is the force between neighbours where the load does not set it.
    """
    laws, d_w = model.laws, screw.ball_diameter
    v = frame.entrainment_speed(screw_speed)
    spin = kinematics.relative_spin(screw_speed, frame.rolling_plane_sine)
    lateral = kinematics.torsion_speed(screw_speed, d_w, frame.lead_angle)
    motion = Motion(v, spin / 2, lateral / 2)
    on_screw, on_nut = ball_contacts(model.contact_laws, screw, lubricant, frame, contact_load, (motion, motion))
    of_a_turn = kinematics.relative_spin(1.0, frame.rolling_plane_sine)
    ball = BallInCircuit(screw, frame, on_screw, on_nut, of_a_turn, screw_speed, model.ball_friction_coefficient)
    F_B = force_between_balls(model.ball_force, laws.ball_force, imposed_ball_force, contact_load, ball)
    chain = laws.ball_chain(model.ball_friction_coefficient, F_B, d_w, frame)
    asked = Resistances(
        on_screw.hydrodynamic_rolling_force,
        on_nut.hydrodynamic_rolling_force,
        on_screw.elastic_resistance_moment,
        on_nut.elastic_resistance_moment,
        chain,
    )
    slip = laws.slip(BallProblem(on_screw, on_nut, asked, d_w, frame, screw_speed, model.pure_rolling_offset))
    carried = asked.scaled(slip.rolling_share)
    screw_state, nut_state = _race_states(laws.race_torques, on_screw, on_nut, carried, slip, frame, d_w)
    return BallFriction(
        frame=frame,
        ball_diameter=d_w,
        contact_load=contact_load,
        entrainment_speed=v,
        screw=screw_state,
        nut=nut_state,
        ball_chain=carried.chain,
        ball_to_ball_force=slip.rolling_share * F_B,
        spin_moment=slip.spin_moment,
        lateral_force=slip.lateral_force,
        rolling_share=slip.rolling_share,
        race_torques=laws.race_torques,
        converged=slip.converged,
        slip_is_curvature_alone=traits_of(model.slip).curvature_alone,
    )


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class IdleBallFriction:
    """Friction of a ball that carries no load: its neighbours may push it along."""

    screw_torque: Torque
    nut_torque: Torque
    contributions: Mapping[str, Torque]
    dissipation: Mapping[str, Power]


def idle_ball_friction(
    model: BallModel, screw: BallScrew, frame: Frame, screw_speed: AngularSpeed, imposed_ball_force: Force
) -> IdleBallFriction:
    """The limit of :func:`ball_friction` without load, without what has no derivative there.

    Where curvature is the only slip, an imposed force between balls is carried without load too; with all slips the
    ball skids, and carries nothing.
    """
    laws, d_w = model.laws, screw.ball_diameter
    share = 1.0 if traits_of(model.slip).curvature_alone else 0.0
    nothing = np.float64(0.0)
    F_B = nothing if traits_of(model.ball_force).reads_ball else laws.ball_force(imposed_ball_force, nothing)
    chain = laws.ball_chain(model.ball_friction_coefficient, F_B, d_w, frame)
    net = chain.net_braking_force
    both, braking = (
        laws.race_torques(forces.screw_tangential_force, forces.nut_tangential_force, 0.0, 0.0, frame)
        for part in (chain, BallChain(0 * chain.moment, net, net))
        for forces in [ball_forces(Resistances(0.0, 0.0, 0.0, 0.0, part).scaled(share), d_w, frame)]
    )
    parts = {
        **dict.fromkeys(MECHANISMS, 0.0),
        "ball_to_ball": both.screw - braking.screw,
        "chain_braking": braking.screw,
    }
    return IdleBallFriction(
        screw_torque=both.screw,
        nut_torque=both.nut,
        contributions=parts,
        dissipation={mechanism: torque * screw_speed for mechanism, torque in parts.items()},
    )


def ball_contacts(
    laws: ContactLaws,
    screw: BallScrew,
    lubricant: Lubricant,
    frame: Frame,
    contact_load: Force,
    motions: tuple[Motion, Motion],
) -> tuple[Contact, Contact]:
    """The contacts of a ball with screw and nut under a load, in motion; what slips in them comes later."""
    d_w, gamma = screw.ball_diameter, frame.curvature_ratio
    sides = (
        (screw.screw_raceway, geometry.screw_rolling_radius(d_w, gamma)),
        (screw.nut_raceway, geometry.nut_rolling_radius(d_w, gamma)),
    )
    on_screw, on_nut = (
        rolling_contact(laws, screw, raceway, lubricant, rolling_radius, contact_load, motion)
        for (raceway, rolling_radius), motion in zip(sides, motions, strict=True)
    )
    return on_screw, on_nut


def _race_states(
    race_torques: RaceTorqueLaw,
    on_screw: Contact,
    on_nut: Contact,
    carried: Resistances,
    slip: Slip,
    frame: Frame,
    ball_diameter: Length,
) -> tuple[RaceState, RaceState]:
    """The contacts in the equilibrium of the ball, with screw and nut."""
    F_Rs, F_Rn, M_ERs, M_ERn, chain = carried
    M_s = slip.screw.curvature_moment + M_ERs
    M_n = slip.nut.curvature_moment + M_ERn
    forces = ball_forces(Resistances(F_Rs, F_Rn, M_s, M_n, chain), ball_diameter, frame)
    torques = race_torques(forces.screw_tangential_force, forces.nut_tangential_force, M_s, M_n, frame)
    through = equilibrium.spin_torque(slip.spin_moment, frame.rolling_plane_sine) + equilibrium.torsion_torque(
        slip.lateral_force, ball_diameter, frame.lead_angle
    )

    def state(contact: Contact, at_contact: ContactSlip, **changed: Any) -> RaceState:
        return contact.extended(
            RaceState,
            **changed,
            pure_rolling_offset=at_contact.pure_rolling_offset,
            curvature_friction_moment=at_contact.curvature_moment,
            creep_speed=at_contact.creep_speed,
            spin=at_contact.spin,
            lateral_slip_speed=at_contact.lateral_slip_speed,
        )

    screw = state(
        on_screw,
        slip.screw,
        hydrodynamic_rolling_force=F_Rs,
        elastic_resistance_moment=M_ERs,
        sliding_force=forces.screw_sliding_force,
        contact_radius=frame.screw_contact_radius,
        pressure_force=screw_pressure_force(F_Rs, frame.curvature_ratio),
        tangential_force=forces.screw_tangential_force,
        friction_torque=torques.screw + through,
    )
    nut = state(
        on_nut,
        slip.nut,
        hydrodynamic_rolling_force=F_Rn,
        elastic_resistance_moment=M_ERn,
        sliding_force=forces.nut_sliding_force,
        contact_radius=frame.nut_contact_radius,
        pressure_force=nut_pressure_force(F_Rn, frame.curvature_ratio),
        tangential_force=forces.nut_tangential_force,
        friction_torque=torques.nut + through,
    )
    return screw, nut
