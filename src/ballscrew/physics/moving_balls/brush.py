r"""The contacts of a ball as bristles, which stick, slip and roll on, with the ball free to leave the line of its
grooves.

Each place of a contact holds the race against the ball like a spring of stiffness k for each area, up to
:math:`\mu p`; what rolls into the contact is not yet deflected. The slip that screw and nut force on a ball is that of
:mod:`ballscrew.physics.solvers.ellipse_slip`, with the ball's travel across its groove for a fifth freedom: the two
contacts share a lateral slip that is less by twice the change of the distance :math:`\eta` from the line of the groove
centres, which the leaning normals resist with :math:`Q \eta (1/a_s + 1/a_n)/2` at each contact
(:mod:`ballscrew.physics.equations.across_groove`).

A step is the minimum of a convex function, the energy of the bristles, of the leaning normals, and of what slips:
Newton's steps find it to rounding. So the work of a step is the energy that it stores and dissipates, term by term, to
rounding.

Against the package's steady slip this is a second derivation: the elastic contact is left out there, strips are summed
in place of bristles, and the ball cannot leave its line. Left out here: forces along the path that hold the resistances
to rolling; the change of the spin by leaning normals
(:func:`~ballscrew.physics.equations.across_groove.off_line_spin`); the different compliance of bristles beside each
other, so that the first hundredths of a degree are known to a factor of three: a rolling contact by Kalker's theory is
about as much stiffer than one at rest by Mindlin's.
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.quantities import Angle, Force, Length, Ratio, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import presliding, slip
from ballscrew.physics.friction.across_groove import arms_of
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.laws.frame import Frame

Field = NDArray[np.float64]

#: Cells along a contact, and places across it (Gauss's).
CELLS, PLACES = 14, 10
#: Newton's steps of a step, and halvings of one that has made it worse.
NEWTON_STEPS, HALVINGS = 60, 30
#: Imbalance, in units of what the contacts can hold, that counts as none.
BALANCED = 1e-13
#: Share of the fall by its slope that a step has to make, and what rounding leaves of a sum.
SUFFICIENT, EPSILON = 1e-4, 1e-15


class Patch(NamedTuple):
    """One contact: places along (m, with the flow of a forward turn) and across (in semi-axes), areas and springs."""

    along: Field
    across: Field
    area: Field
    #: Greatest traction, and stiffness for each area.
    limit: Field
    stiffness: Field
    semi_major_axis: float
    #: Slip of the curvature at the rim, and its shape, for one radian of the screw.
    curvature: Field


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class BallContacts:
    """Two contacts of a ball as bristles, and what screw and nut force on them for one radian of the screw."""

    patches: tuple[Patch, Patch]
    cell: Length
    #: Path that is rolled, spin, and lateral slip of both contacts together, each for one radian of the screw.
    rolled: Length
    spin: Ratio
    lateral: Length
    #: Force across at each contact over the distance from the line of the groove centres; infinite on four contacts.
    hold: float
    ball_diameter: Length
    lead_angle: Angle

    @classmethod
    def of(
        cls, screw: BallScrew, frame: Frame, on_screw: Contact, on_nut: Contact, *, held: bool = False
    ) -> BallContacts:
        """The contacts of a ball of ``screw``; ``held`` on its line by further contacts."""
        widths = [float(c.semi_major_axis / c.ellipticity) for c in (on_screw, on_nut)]
        cell = 2 * max(widths) / CELLS
        rolled = float(frame.entrainment_speed(1.0))
        speed = float(on_screw.motion.entrainment_speed) / rolled
        races = (screw.screw_raceway, screw.nut_raceway)
        patches = [
            _patch(screw, race, contact, width, cell, rolled)
            for race, contact, width in zip(races, (on_screw, on_nut), widths, strict=True)
        ]
        arms = arms_of(screw, on_screw, on_nut)
        hold = float(on_screw.contact_load) / 2 * (1 / float(arms.screw) + 1 / float(arms.nut))
        return cls(
            patches=(patches[0], patches[1]),
            cell=cell,
            rolled=rolled,
            spin=(float(on_screw.motion.spin) + float(on_nut.motion.spin)) / speed,
            lateral=(float(on_screw.motion.lateral_slip_speed) + float(on_nut.motion.lateral_slip_speed)) / speed,
            hold=np.inf if held else hold,
            ball_diameter=float(screw.ball_diameter),
            lead_angle=float(frame.lead_angle),
        )


def _patch(screw: BallScrew, race: Any, contact: Contact, width: float, cell: float, rolled: float) -> Patch:
    a, Q = float(contact.semi_major_axis), float(contact.contact_load)
    x = cell * (np.arange(CELLS, dtype=np.float64) - (CELLS - 1) / 2)
    t, weights = np.polynomial.legendre.leggauss(PLACES)
    shape = np.sqrt(np.maximum(1 - (x[:, None] / width) ** 2 - t**2, 0.0))
    area = cell * a * weights + 0 * shape
    pressure = Q * shape / np.sum(shape * area)
    bodies = (screw.ball_material, race.material)
    moduli = [float(presliding.shear_modulus(body.young_modulus, body.poisson_ratio)) for body in bodies]
    strip = np.maximum(width * np.sqrt(1 - t**2), cell / 2)
    rim = slip.curvature_slip_speed(a, float(contact.deformed_radius), rolled / float(contact.rolling_radius))
    return Patch(
        along=x,
        across=t,
        area=area,
        limit=float(contact.friction_coefficient) * pressure,
        stiffness=presliding.bristle_stiffness(strip, moduli[0], moduli[1]) + 0 * shape,
        semi_major_axis=a,
        curvature=rim * slip.surface_depth(t, a, float(contact.deformed_radius)),
    )


class Parts(NamedTuple):
    """Friction torque of a ball on the screw by mechanism, along a forward turn."""

    spin: Torque
    curvature: Torque
    helix: Torque


class Step(NamedTuple):
    """Result of a step of the screw."""

    torque: Parts
    lateral_force: Force
    distance: Length
    #: Energies of the step, J: lost by slip, by bristles that roll out and by the finite step, and stored.
    dissipated: float
    stored: float
    imbalance: Ratio


class Brush:
    """The bristles of a ball as they are now; a step turns the screw and rolls them on."""

    def __init__(self, ball: BallContacts) -> None:
        self.ball = ball
        one, other = ball.patches
        shape = (2, CELLS, PLACES)
        self._stiffness = np.stack([one.stiffness, other.stiffness])
        self._area = np.stack([one.area, other.area])
        self._limit = np.stack([one.limit, other.limit])
        self._reach = self._limit / self._stiffness
        a = np.array([one.semi_major_axis, other.semi_major_axis])[:, None, None]
        x = np.stack([one.along, other.along])[:, :, None] + np.zeros(shape)
        t = np.stack([one.across, other.across])[:, None, :] + np.zeros(shape)
        on_screw = np.zeros(shape)
        on_screw[0] = 1.0
        on_nut = 1 - on_screw
        none = np.zeros(shape)
        length = float(np.mean(a))
        # the fields of slip along and across: creep at both contacts, the nut's shares of spin and lateral slip, the
        # ball's way across; the spin as the speed of a rim
        turned = (a * t / length, -x / length)
        self._free = np.stack(
            [
                np.stack([on_screw, none]),
                np.stack([on_nut, none]),
                np.stack([(on_nut - on_screw) * part for part in turned]),
                np.stack([none, on_nut - on_screw]),
                np.stack([none, -2 * on_screw]),
            ]
        )
        if np.isinf(ball.hold):
            self._free = self._free[:4]
        curved = np.stack([one.curvature, other.curvature])[:, None, :] + none
        rim = np.stack(
            [
                2 * p.curvature[None, :] / np.where(p.across == 0, 1.0, p.across) / p.semi_major_axis
                for p in (one, other)
            ]
        )
        # of the surface's depth, t² in small contacts, the slope by t is twice itself over t
        forced_curvature = np.stack([curved, -x * rim])
        self._spin = np.stack([on_screw * part * length for part in turned]) * ball.spin
        # the side to which the helix drags a ball whose load is lifted is that to which its spin turns what flows in
        self._lateral = np.stack([none, -on_screw * ball.lateral])
        self._curvature = forced_curvature
        self._forced = self._spin + self._lateral + self._curvature
        self._deflection = np.zeros((2, *shape))
        self.distance = 0.0
        self._way = 0.0
        self._guess = np.zeros(len(self._free))
        self._capacity = float(np.sum(self._limit * self._area))

    def turn(self, angle: Angle) -> Step:
        """Turn the screw by a small angle of either sign: the path rolled must not exceed what is left of a cell."""
        start, before = self._deflection, self._energy(self._deflection) + self._leaning(self.distance)
        trial = start + self._forced * angle
        q, imbalance = self._minimum(trial, self._guess * angle)
        self._guess = q / angle
        wanted = trial + np.tensordot(q, self._free, 1)
        size = np.sqrt(np.sum(wanted**2, axis=0))
        scale = np.where(size > self._reach, self._reach / np.where(size > 0, size, 1.0), 1.0)
        deflection = wanted * scale
        traction = self._stiffness * self._area * deflection
        slipped = float(np.sum(self._limit * self._area * (size - np.minimum(size, self._reach))))
        moved = 0.5 * float(np.sum(self._stiffness * self._area * (deflection - start) ** 2))
        across = 0.0 if np.isinf(self.ball.hold) else float(q[4])
        leaning = self.ball.hold * across**2 if across else 0.0
        self._deflection, self.distance = deflection, self.distance + across
        lost = slipped + moved + leaning
        lost += self._roll(angle)
        torque = Parts(*(float(np.sum(traction * part)) for part in (self._spin, self._curvature, self._lateral)))
        force = float(np.sum(traction[1, 1]))
        stored = self._energy(self._deflection) + self._leaning(self.distance) - before
        return Step(torque, -force, self.distance, lost, stored, imbalance)

    def _roll(self, angle: Angle) -> float:
        """Roll the bristles on by whole cells; the energy of those that roll out, J."""
        self._way += angle * self.ball.rolled / self.ball.cell
        lost = 0.0
        while abs(self._way) >= 1 - 1e-9:
            forward = self._way > 0
            before = self._energy(self._deflection)
            rolled = np.zeros_like(self._deflection)
            if forward:
                rolled[:, :, 1:] = self._deflection[:, :, :-1]
            else:
                rolled[:, :, :-1] = self._deflection[:, :, 1:]
            # pressure changes along the contact: a bristle that its new place cannot hold slips
            size = np.sqrt(np.sum(rolled**2, axis=0))
            rolled = rolled * np.where(size > self._reach, self._reach / np.where(size > 0, size, 1.0), 1.0)
            self._deflection = rolled
            lost += before - self._energy(rolled)
            self._way -= 1.0 if forward else -1.0
        return lost

    def _energy(self, deflection: Field) -> float:
        return 0.5 * float(np.sum(self._stiffness * self._area * deflection**2))

    def _leaning(self, distance: float) -> float:
        """Energy of the leaning normals."""
        return self.ball.hold * distance**2 if distance else 0.0

    def _minimum(self, trial: Field, guess: Field) -> tuple[Field, float]:
        """The free slips that balance the ball, and the imbalance left over what the contacts can hold."""
        q = guess.copy()
        value, slope, curvature = self._potential(trial, q)
        for _ in range(NEWTON_STEPS):
            if np.max(np.abs(slope)) <= BALANCED * self._capacity:
                break
            step = np.linalg.solve(curvature, -slope)
            fall = float(slope @ step)
            for halving in range(HALVINGS):
                share = 0.5**halving
                there = self._potential(trial, q + share * step)
                # where rounding hides the fall of the function, that of its slope counts
                hidden = abs(share * fall) < EPSILON * abs(value) and np.max(np.abs(there[1])) < np.max(np.abs(slope))
                if hidden or there[0] <= value + SUFFICIENT * share * fall:
                    q = q + share * step
                    value, slope, curvature = there
                    break
            else:
                break
        return q, float(np.max(np.abs(slope))) / self._capacity

    def _potential(self, trial: Field, q: Field) -> tuple[float, Field, Field]:
        """The function whose minimum is sought, its slope, and its curvature."""
        u = trial + np.tensordot(q, self._free, 1)
        size = np.sqrt(np.sum(u**2, axis=0))
        slips = size > self._reach
        safe = np.where(slips, size, 1.0)
        held = self._stiffness * self._area
        lost = self._limit * self._area
        value = float(np.sum(np.where(slips, lost * (size - self._reach / 2), 0.5 * held * size**2)))
        factor = np.where(slips, lost / safe, held)
        forces = factor * u
        n = len(q)
        free = self._free.reshape(n, 2, -1)
        slope = free.reshape(n, -1) @ forces.reshape(-1)
        flat = factor.reshape(-1)
        along, across = free[:, 0], free[:, 1]
        curvature = (along * flat) @ along.T + (across * flat) @ across.T
        direction = np.where(slips, u / safe, 0.0).reshape(2, -1)
        turned = along * direction[0] + across * direction[1]
        curvature -= (turned * np.where(slips, factor, 0.0).reshape(-1)) @ turned.T
        if n == 5:
            hold, eta = self.ball.hold, self.distance + q[4]
            value += hold * eta**2
            slope[4] += 2 * hold * eta
            curvature[4, 4] += 2 * hold
        return value, slope, curvature + 1e-12 * np.trace(curvature) * np.eye(n)
