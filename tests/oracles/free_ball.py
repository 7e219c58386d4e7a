r"""One ball between screw and nut, free to turn and to travel: its contacts, and what else resists it.

The nut is at rest; the screw turns with :math:`\omega` and advances by its lead, so that at the centre
of the ball it moves along the path with :math:`\omega L`. The unknowns are the rotation
:math:`\Omega` of the ball about the path, across it and about the outward normal of the first nut
contact (t, c, N with c = N × t), and its orbital rotation :math:`\Omega_m` about the screw axis. All
speeds are linear in them.

With :math:`c_\alpha = \cos\alpha\cos\varphi` and the rotation about the rolling axis against the
travelling frame, :math:`\omega_b = -\Omega_c + \Omega_m c_\alpha`, the power of the resistances is

.. math::
    P = F_{Rs} \left(R_s (\omega - \Omega_m) + \tfrac{d_w}{2} \omega_b\right)
      + F_{Rn} \left(\tfrac{d_w}{2} \omega_b + R_n \Omega_m\right)
      + M_{ERs} \left(\omega_b + (\omega - \Omega_m) c_\alpha\right)
      + M_{ERn} \left(\omega_b - \Omega_m c_\alpha\right)
      + M_B \omega_b + F_B \Omega_m L
"""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ballscrew.basis.quantities import AngularSpeed, Force, Length, Speed, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import kinematics
from ballscrew.physics.laws.frame import Frame
from oracles.contact_patch import ContactPatch
from oracles.tractions import (
    Field,
)

#: Components of twists and wrenches: along and across the path, and about the normal.
ALONG, LATERAL, SPIN = 0, 1, 4


class BallResistances(NamedTuple):
    """What resists one ball beside the traction in its contacts; constant, in the paper's signs.

    Rolling forces and elastic moments are those of one contact. With two flank pairs each contact of
    a race has them; the ball chain acts once, about the mean of the two rolling axes. The
    ball-to-ball force is that of a straight chain: what its curvature adds follows from the
    kinematics.
    """

    screw_rolling_force: Force = 0.0
    nut_rolling_force: Force = 0.0
    screw_elastic_moment: Torque = 0.0
    nut_elastic_moment: Torque = 0.0
    ball_friction_moment: Torque = 0.0
    ball_to_ball_force: Force = 0.0


class Side(NamedTuple):
    """One contact, and the twist of race against ball in it: by each unknown, of a turning race, and all in all."""

    patch: ContactPatch
    on_screw: bool
    by_unknowns: Field
    of_race: Field
    rolling: Field

    def twist(self, change: Field) -> Field:
        """The twist where the unknowns differ by ``change`` from those of the rolling ball."""
        return self.rolling + self.by_unknowns @ change


class Imbalance(NamedTuple):
    """What is left of the balance: generalised forces, their slope, and what friction can carry in all."""

    forces: Field
    slope: Field
    capacity: float

    def share(self, levers: Field) -> float:
        """The largest force or moment left, in units of what friction can carry."""
        return float(np.max(np.abs(self.forces / levers)) / self.capacity)


@dataclasses.dataclass(frozen=True, eq=False)
class FreeBall:
    """A ball on two or four contacts.

    Solved for is the change of the unknowns against a ball that rolls with half of the spin and of
    the lateral slip at each contact, so that small slips do not drown in large speeds.
    """

    sides: Sequence[Side]
    rolling: Field
    #: Derivatives of the resistances' power by the unknowns, and by the rotations of screw and nut.
    resistance: Field
    screw_resistance: Torque
    nut_resistance: Torque
    #: Generalised forces over these are forces.
    levers: Field
    screw_speed: AngularSpeed
    rolling_speed: Speed
    spin: AngularSpeed

    @classmethod
    def of(
        cls,
        screw: BallScrew,
        frame: Frame,
        patches: Sequence[tuple[ContactPatch, ContactPatch]],
        resistances: BallResistances,
        screw_speed: AngularSpeed,
    ) -> FreeBall:
        """The ball of a screw, from its patches on screw and nut, of one flank pair or of two."""
        alpha, phi = float(screw.contact_angle), float(frame.lead_angle)
        rho, L, gamma = float(screw.ball_diameter) / 2, float(frame.path_radius), float(frame.curvature_ratio)
        # the path, and what is outward and normal of it, in the directions t, c, N of the first nut contact
        path = np.array([1.0, 0.0, 0.0])
        outward = np.array([0.0, -np.sin(alpha), np.cos(alpha)])
        binormal = np.array([0.0, np.cos(alpha), np.sin(alpha)])
        axis = np.sin(phi) * path + np.cos(phi) * binormal
        nut_normals = [np.cos(alpha) * outward + side * np.sin(alpha) * binormal for side in (1, -1)[: len(patches)]]
        rolling_axes = [_cross(normal, path) for normal in nut_normals]
        ball_axis = rolling_axes[0] if len(patches) == 1 else binormal

        orbit = screw_speed * (1 - gamma) / 2
        rotation = screw_speed / 2 * np.sin(phi) * path - orbit * L / rho / (rolling_axes[0] @ ball_axis) * ball_axis
        spin = screw_speed * float(axis @ nut_normals[0])
        if len(patches) == 1:
            rotation = rotation + spin / 2 * nut_normals[0]
        rolling = np.append(rotation, orbit)

        sides: list[Side] = []
        for normal, patch, on_screw in [
            (sign * normal, patch, on_screw)
            for normal, (at_screw, at_nut) in zip(nut_normals, patches, strict=True)
            for sign, patch, on_screw in ((-1, at_screw, True), (1, at_nut, False))
        ]:
            axes, middle = np.array([path, _cross(normal, path), normal]), rho * normal
            of_screw = _twist(axes, L * path + _cross(axis, middle), axis)
            of_ball = [_twist(axes, _cross(unit, middle), unit) for unit in np.eye(3)]
            of_orbit = _twist(axes, L * path, np.zeros(3))
            by_unknowns = -np.stack([*of_ball, of_orbit], axis=-1)
            twist = by_unknowns @ rolling + (screw_speed * of_screw if on_screw else 0)
            sides.append(Side(patch, on_screw, by_unknowns, of_screw, twist))
        gradient, by_screw, by_nut = _resisting(resistances, frame, rho, rolling_axes, ball_axis, axis)
        return cls(
            sides=sides,
            rolling=rolling,
            resistance=gradient,
            screw_resistance=by_screw,
            nut_resistance=by_nut,
            levers=np.array([rho, rho, max(float(np.max(patch.across)) for pair in patches for patch in pair), L]),
            screw_speed=screw_speed,
            rolling_speed=float(kinematics.entrainment_speed(screw_speed, L, gamma)),
            spin=spin,
        )

    @property
    def mean_slip(self) -> Speed:
        """Root mean square of the slip of the rolling ball, by load."""
        squares = load = 0.0
        for side in self.sides:
            s_t, s_c = side.patch.slip(side.rolling)
            share = side.patch.area * side.patch.pressure
            squares, load = squares + share @ (s_t**2 + s_c**2), load + share.sum()
        return float(np.sqrt(squares / load))

    def imbalance(self, change: Field, blur: Speed) -> Imbalance:
        """Gradient and second derivative of the potential by the unknowns."""
        forces, slope, capacity = self.resistance, np.zeros((4, 4)), 0.0
        for side in self.sides:
            answer = side.patch.answer(side.twist(change), blur)
            forces = forces + side.by_unknowns.T @ answer.wrench
            slope = slope + side.by_unknowns.T @ answer.slope @ side.by_unknowns
            capacity += answer.capacity
        return Imbalance(forces, slope, capacity)

    def potential(self, change: Field, blur: Speed) -> float:
        """The function whose minimum is the balance, W, up to a constant."""
        slip = sum(side.patch.potential(side.twist(change), blur) for side in self.sides)
        return slip + float(self.resistance @ change)

    def sliding_speed(self, change: Field) -> Speed:
        """The greatest speed along the path at the middle of a contact."""
        return max(abs(float(side.twist(change)[ALONG])) for side in self.sides)


def _resisting(
    resistances: BallResistances,
    frame: Frame,
    ball_radius: Length,
    rolling_axes: Sequence[Field],
    ball_axis: Field,
    screw_axis: Field,
) -> tuple[Field, Torque, Torque]:
    """Derivatives of the resistances' power by the unknowns, by the screw's rotation, and less that by the nut's."""
    F_Rs, F_Rn, M_ERs, M_ERn, M_B, F_B = (float(each) for each in resistances)
    L, c_alpha = float(frame.path_radius), float(frame.rolling_plane_cosine)
    R_s, R_n, pairs = float(frame.screw_contact_radius), float(frame.nut_contact_radius), len(rolling_axes)
    by_turning = ball_radius * (F_Rs + F_Rn) + M_ERs + M_ERn
    by_travel = F_Rn * R_n - F_Rs * R_s - (M_ERs + M_ERn) * c_alpha
    gradient = np.append(-M_B * ball_axis, M_B * (screw_axis @ ball_axis) + F_B * L)
    for rolling_axis in rolling_axes:
        gradient = gradient + np.append(-by_turning * rolling_axis, by_turning * c_alpha + by_travel)
    return gradient, pairs * (F_Rs * R_s + M_ERs * c_alpha), pairs * (F_Rn * R_n - M_ERn * c_alpha)


def _cross(one: Field, other: Field) -> Field:
    return np.asarray(np.cross(one, other), dtype=np.float64)


def _twist(axes: Field, velocity: Field, rotation: Field) -> Field:
    """Velocities along and across, and the rotation, in the axes of a contact; nothing moves along the normal."""
    return np.concatenate([(axes @ velocity)[:2], axes @ rotation])
