"""Result of a friction model: torques, their parts, both contacts, and their validity."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any, NamedTuple

from ballscrew._arrays import lazy, namespace
from ballscrew.components.balance import Resistances, ball_forces
from ballscrew.components.contact import RaceState
from ballscrew.components.frame import Frame
from ballscrew.components.laws import BallChain, IdealTorqueLaw, RaceTorqueLaw
from ballscrew.components.screw import BallScrew
from ballscrew.equations import dissipation, equilibrium, kinematics, transmission
from ballscrew.friction.plausibility import implausible
from ballscrew.friction.validity import imbalance_records, validity_masks, warning_records
from ballscrew.quantities import AngularSpeed, Force, Info, Mask, Power, Ratio, Speed, Torque
from ballscrew.records import Record

#: The mechanisms a torque is made of, and what each is called in words.
MECHANISMS: Mapping[str, str] = {
    "hydrodynamic_rolling": "hydrodynamic rolling",
    "elastic_hysteresis": "elastic hysteresis",
    "curvature": "curvature slip",
    "spin": "spin slip",
    "helix": "helix slip",
    "ball_to_ball": "ball to ball",
}


#: The four quadrants: directions of the load on the nut and of the rotation.
QUADRANTS: Mapping[str, tuple[int, int]] = {
    "drives forward": (1, 1),
    "is back-driven in reverse": (1, -1),
    "drives in reverse": (-1, -1),
    "is back-driven forward": (-1, 1),
}


class Quadrant(NamedTuple):
    """One of the four combinations of load and rotation."""

    load_sign: int
    speed_sign: int
    shaft_torque: Torque
    shaft_power: Power
    efficiency: Ratio


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True, repr=False)
class FrictionResult:
    """Friction of a ball screw at one operating point, or at an array of them.

    The equilibrium is in hand when the result is made; everything else is computed when it is
    asked for, and kept.
    """

    #: The parts of the input, by section.
    parts: Mapping[str, Any]
    ball_screw: BallScrew
    frame: Frame
    axial_load: Annotated[Force, Info("F", "axial load on the nut")]
    screw_speed: Annotated[AngularSpeed, Info(r"\omega", "speed of the screw", "rpm")]
    contact_load: Annotated[Force, Info("Q", "normal load of each loaded ball")]
    entrainment_speed: Annotated[Speed, Info("v", "entrainment speed at both contacts")]
    screw: RaceState
    nut: RaceState
    ball_chain: BallChain
    ball_to_ball_force: Annotated[Force, Info("F_B", "net braking force between neighbouring balls")]
    spin_moment: Annotated[Torque, Info("M_P", "moment about the contact normals, the same at both contacts", "N mm")]
    lateral_force: Annotated[Force, Info("F_L", "friction across the path, the same at both contacts")]
    rolling_share: Annotated[
        Ratio, Info(r"\sigma", "share of the resistances to rolling that friction carries; below one the ball skids")
    ]
    race_torques: RaceTorqueLaw
    ideal_torque_law: IdealTorqueLaw
    converged: Mask
    slip_is_curvature_alone: bool

    def __repr__(self) -> str:
        """The few numbers one looks for first."""
        shown = {name: getattr(self, name) for name in ("screw_torque", "nut_torque", "efficiency", "valid")}
        return f"FrictionResult({', '.join(f'{name}={value}' for name, value in shown.items())})"

    @lazy
    def screw_torque(
        self,
    ) -> Annotated[Torque, Info("M_S", "friction torque on the screw", address="Olaru2005 §6 (33)")]:
        """Friction torque on the screw."""
        return equilibrium.total_friction_torque(self.ball_screw.loaded_balls, self.screw.friction_torque)

    @lazy
    def nut_torque(self) -> Annotated[Torque, Info("M_N", "friction torque on the nut", address="Olaru2005 §6 (34)")]:
        """Friction torque on the nut, the reaction and not a further loss."""
        return equilibrium.total_friction_torque(self.ball_screw.loaded_balls, self.nut.friction_torque)

    @lazy
    def ideal_torque(
        self,
    ) -> Annotated[Torque, Info("M_Sa", "drive torque without friction", address="Olaru2005 §7 (35)")]:
        """Drive torque without friction."""
        return self.ideal_torque_law(self.axial_load, self.ball_screw, self.frame)

    @lazy
    def drive_torque(self) -> Annotated[Torque, Info("M_Sa + M_S", "drive torque with friction")]:
        """Torque that drives the screw against the load."""
        return self.ideal_torque + self.screw_torque

    @lazy
    def efficiency(
        self,
    ) -> Annotated[Ratio, Info(r"\eta", "efficiency, screw drives the nut", address="Olaru2005 §7 (36)")]:
        """Efficiency when the screw drives the nut.

        Zero without load. Where both torques vanish, the limit of vanishing load in the models of
        the paper: 0 in motion, where friction falls more slowly than the load, and 1 at rest, where
        it falls faster. In the reference model the ball skids under vanishing load, and the limit
        in motion lies between the two: there the 0 is a convention (no load, no useful work).
        """
        ideal, friction = self.ideal_torque, self.screw_torque
        no_torque = ideal + friction == 0
        # truth counts as 1 here: it keeps 0/0 away, and is the limit at rest
        eta = transmission.efficiency(ideal, friction + no_torque)
        return eta + (no_torque & (self.screw_speed == 0))

    @lazy
    def back_driving_efficiency(self) -> Annotated[Ratio, Info(r"\eta_b", "efficiency, the load drives the screw")]:
        """Efficiency when the load drives the screw; zero or less means self-locking.

        NaN where the direct efficiency is zero: without a load, nothing drives.
        """
        eta = self.efficiency
        xp = namespace(eta)
        none = eta == 0
        return xp.where(none, float("nan"), transmission.back_driving_efficiency(xp.where(none, 1.0, eta)))[()]

    @lazy
    def holding_torque(
        self,
    ) -> Annotated[Torque, Info("M_h", "torque that holds the load when it drives; negative: that lowers it")]:
        """Torque on the shaft when the load drives the screw: held where positive, self-locking where not."""
        return transmission.holding_torque(self.ideal_torque, self.screw_torque)

    @lazy
    def self_locking(self) -> Annotated[Mask, Info("self-locking", "the load alone cannot turn the screw")]:
        """True where there is a load that cannot drive the screw back at this speed, that is with this friction."""
        return (self.ideal_torque > 0) & (self.holding_torque <= 0)

    def shaft_torque(self, load_sign: int, speed_sign: int) -> Torque:
        """Torque on the shaft in one of four quadrants, positive the way that moves the nut against a load of +1.

        ``load_sign`` is the direction of the load on the nut, ``speed_sign`` that of the rotation;
        with equal signs the screw drives the nut against its load, with opposite signs the load
        helps. Friction is the same in all four and opposes the rotation.
        """
        return load_sign * self.ideal_torque + speed_sign * self.screw_torque

    @lazy
    def quadrants(self) -> Mapping[str, Quadrant]:
        """All four quadrants of load and rotation, by name: shaft torque, its power, and the efficiency.

        The efficiency is that of the power that arrives: from the shaft where the screw drives,
        from the load where the load does. Where the load should drive and the screw locks itself,
        it is zero or less, and the shaft has to push too.
        """
        return {
            name: Quadrant(
                load,
                speed,
                self.shaft_torque(load, speed),
                self.shaft_torque(load, speed) * speed * self.screw_speed,
                self.efficiency if load == speed else self.back_driving_efficiency,
            )
            for name, (load, speed) in QUADRANTS.items()
        }

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
        """Friction torque on the screw by mechanism, N m; the parts sum to ``screw_torque``.

        The torque is linear in the forces and moments of the mechanisms, so each part is the torque
        with all others struck out.
        """
        s, n, chain = self.screw, self.nut, self.ball_chain
        zero = 0 * s.friction_torque
        F_Rs, F_Rn = s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force
        M_ERs, M_ERn = s.elastic_resistance_moment, n.elastic_resistance_moment
        M_Cs, M_Cn = s.curvature_friction_moment, n.curvature_friction_moment
        # adding zero gives the parts that depend on less the shape of the operating point
        M_B, F_B = chain.moment + zero, chain.braking_force + zero
        nothing = BallChain(zero, zero)
        parts = {
            "hydrodynamic_rolling": Resistances(F_Rs, F_Rn, zero, zero, nothing),
            "elastic_hysteresis": Resistances(zero, zero, M_ERs, M_ERn, nothing),
            "curvature": Resistances(zero, zero, M_Cs, M_Cn, nothing),
            "ball_to_ball": Resistances(zero, zero, zero, zero, BallChain(M_B, F_B)),
        }
        torques = {mechanism: self._screw_torque_of(part) for mechanism, part in parts.items()}
        torques["spin"] = zero + equilibrium.spin_torque(self.spin_moment, self.frame.rolling_plane_sine)
        torques["helix"] = zero + equilibrium.torsion_torque(
            self.lateral_force, self.ball_screw.ball_diameter, self.frame.lead_angle
        )
        z = self.ball_screw.loaded_balls
        return {mechanism: equilibrium.total_friction_torque(z, torques[mechanism]) for mechanism in MECHANISMS}

    def _screw_torque_of(self, part: Resistances) -> Torque:
        """Torque of one ball on the screw that a part of its resistances gives rise to."""
        forces = ball_forces(part, self.ball_screw.ball_diameter, self.frame)
        return self.race_torques(
            forces.screw_tangential_force, forces.nut_tangential_force, part.screw_moment, part.nut_moment, self.frame
        ).screw

    @lazy
    def dissipation(self) -> Mapping[str, Power]:
        """Power dissipated by mechanism, W, from local forces and local speeds.

        The speeds are those of a ball whose races creep ahead of it, where the slip law tells how
        much; what the sliding forces dissipate in creep counts as curvature slip. That the sum is the
        torque's power says that the ball is in balance, not that its slip has settled: the forces
        are those of the balance, and how far the slip is from them, ``converged`` tells.
        """
        s, n, chain, frame = self.screw, self.nut, self.ball_chain, self.frame
        d_w, z, cosine = self.ball_screw.ball_diameter, self.ball_screw.loaded_balls, frame.rolling_plane_cosine
        A_s, A_n = s.creep_speed, n.creep_speed
        w = kinematics.ball_surface_speed(
            self.entrainment_speed, A_s, A_n, s.contact_radius, n.contact_radius, frame.path_radius
        )
        ball = kinematics.ball_rotation(w, d_w)
        orbit = kinematics.orbital_rotation(w + A_n, n.contact_radius)
        relative = kinematics.screw_relative_rotation(w + A_s, s.contact_radius)
        at_screw = kinematics.screw_contact_rotation(ball, relative, cosine)
        at_nut = kinematics.nut_contact_rotation(ball, orbit, cosine)
        per_ball = {
            "hydrodynamic_rolling": dissipation.hydrodynamic_rolling_power(
                s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force, w + A_s / 2, w + A_n / 2
            ),
            "elastic_hysteresis": dissipation.contact_moment_power(
                s.elastic_resistance_moment, n.elastic_resistance_moment, at_screw, at_nut
            ),
            "curvature": dissipation.contact_moment_power(
                s.curvature_friction_moment, n.curvature_friction_moment, at_screw, at_nut
            )
            + dissipation.creep_power(s.sliding_force, n.sliding_force, A_s, A_n),
            "spin": dissipation.spin_power(self.spin_moment, s.spin + n.spin),
            "helix": dissipation.torsion_power(self.lateral_force, s.lateral_slip_speed + n.lateral_slip_speed),
            "ball_to_ball": dissipation.ball_chain_power(
                chain.moment, ball, self.ball_to_ball_force, kinematics.orbital_speed(orbit, frame.path_radius)
            ),
        }
        return {mechanism: z * power for mechanism, power in per_ball.items()}

    @lazy
    def friction_power(self) -> Annotated[Power, Info("P", "power dissipated by friction")]:
        """Power dissipated by friction, summed from the local dissipations and not from the torque."""
        return sum(self.dissipation.values())

    @lazy
    def power_imbalance(self) -> Ratio:
        """Power of the torque beyond what the parts dissipate, as a share of the latter; zero in equilibrium.

        NaN at rest. The printed reactions of Olaru2005 leave a part of the sliding forces out.
        """
        taken, lost = self.screw_torque * self.screw_speed, self.friction_power
        return (taken - lost) / lost

    @lazy
    def validity(self) -> Mapping[str, Mask]:
        """Masks of the conditions of the model, by reason; see :data:`ballscrew.friction.validity.REASONS`."""
        return validity_masks(
            self.parts.values(),
            self.screw,
            self.nut,
            self.converged,
            self.rolling_share,
            self.slip_is_curvature_alone,
            self.drive_torque,
        )

    @lazy
    def valid(self) -> Annotated[Mask, Info("valid", "all conditions of the model hold")]:
        """Mask: all conditions of the model hold."""
        masks = list(self.validity.values())
        holds = masks[0]
        for mask in masks[1:]:
            holds = holds & mask
        return holds

    @property
    def warning_records(self) -> list[Record]:
        """Inputs that no ball screw has, an imbalance of power, and the conditions that fail somewhere, as records."""
        unbalanced = imbalance_records(self.power_imbalance, self.nut_torque)
        return [*implausible(self.parts), *unbalanced, *warning_records(self.validity, (self.screw, self.nut))]

    @property
    def warnings(self) -> list[str]:
        """The :attr:`warning_records` as texts: ``"reason: explanation"``."""
        return [f"{record.name}: {record.text}" for record in self.warning_records]
