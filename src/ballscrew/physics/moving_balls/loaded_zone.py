r"""The load of a ball over its way through a nut, and the speed at which it would roll there by itself.

The grooves of screw and nut lie off their nominal places by a few harmonics of a turn, the ends of the loaded zone are
relieved, and the screw has turned since. At each ball the groove centres are then as far apart as
:mod:`~ballscrew.physics.equations.rigidity` says, with a distance and an angle of their own without load; the load
follows from the approach, and the natural speed from the contact angle. What the contacts do against another speed is
asked of the slip law of the model, at a few loads.

Left out: bending and stretch of the bodies between balls, the change of the creep with the contact angle, and what the
rolling resistances do to the speed, some 1e-4, which all balls have alike.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.errors import Fault, InputError
from ballscrew.basis.quantities import Angle, AngularSpeed, Force, Length, LoadDeflection, Ratio, Speed
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.screw import SINGLE_NUT, BallScrew
from ballscrew.physics.equations import geometry, kinematics, rigidity
from ballscrew.physics.friction.balls import ball_friction
from ballscrew.physics.friction.four_contact_balls import four_contact_friction
from ballscrew.physics.friction.loaded_balls import loads_of
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.ball_chain import imposed_ball_force, one_neighbour
from ballscrew.physics.solvers.load_distribution import pair_load_deflection

Field = NDArray[np.float64]

#: Harmonics of a turn that the place of a groove has, with amplitudes that fall as one over their number.
HARMONICS = 3
#: Loads, over the nominal one, at which the creep is asked of the slip law; its coefficient is interpolated between
#: them.
CREEP_LOADS = np.geomspace(0.02, 5.0, 14)
#: Push, over the load, whose slip is the slope: far below the limit of friction, far above the rounding of the solver.
PUSH = 0.01
#: Newton's steps to the displacement under which the balls of a moment carry the load, and what counts as carried.
STEPS, CARRIED = 50, 1e-13


@dataclasses.dataclass(frozen=True, eq=False)
class Groove:
    """Deviation of a groove from its nominal helix, once a turn and in a few harmonics of that."""

    #: Factors of cosine and sine of each harmonic, m: along the axis, and outwards. Shape [2, 2, harmonics].
    harmonics: Field

    @classmethod
    def scattered(cls, deviation: Length, generator: np.random.Generator) -> Groove:
        """A groove of this root-mean-square deviation in either direction, with random phases."""
        weights = 1 / np.arange(1, HARMONICS + 1)
        amplitudes = deviation * np.sqrt(2 / np.sum(weights**2)) * weights
        phases = generator.uniform(0, 2 * np.pi, (2, HARMONICS))
        return cls(np.stack([amplitudes * np.cos(phases), amplitudes * np.sin(phases)], axis=1))

    def at(self, angle: Any) -> Field:
        """The deviations along the axis and outwards at angles of the groove, m, the direction first."""
        multiples = np.asarray(angle)[..., None] * np.arange(1, self.harmonics.shape[-1] + 1)
        waves = np.concatenate([np.cos(multiples), np.sin(multiples)], axis=-1)
        return np.moveaxis(waves @ self.harmonics.reshape(2, -1).T, -1, 0)


class Creep(NamedTuple):
    """Response of the contacts of a ball to a speed that is not their own, at some loads, ascending."""

    load: Field
    #: Force over the load, for each unit by which the speed deviates.
    coefficient: Field
    #: The greatest force over the load.
    limit: Field

    def at(self, load: Field) -> tuple[Field, Field]:
        """Coefficient and limit at loads, over the load."""
        where = np.log(np.maximum(load, self.load[0]))
        known = np.log(self.load)
        return np.interp(where, known, self.coefficient), np.interp(where, known, self.limit)


class BallsInZone(NamedTuple):
    """Balls at their places: what each carries, and how the races drive it."""

    load: Field
    contact_angle: Field
    #: Natural speed along the path, m for each radian of the screw.
    speed: Field
    #: Force for each m/rad by which the speed falls short of that, and the greatest force.
    creep: Field
    limit: Field


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class LoadedZone:
    """The loaded zone of a circuit: a place along it is a length of path from where the balls enter, m.

    The angle is what the screw has turned since the start, rad, in the direction in which it turns. Outside of the zone
    a ball has no load.
    """

    length: Length
    #: Length at either end over which the load rises as the place does; the groove is as much deeper there.
    relief: Length
    ball_diameter: Length
    pitch_circle_diameter: Length
    lead_angle: Angle
    #: Contact angle and distance of the groove centres without load.
    contact_angle: Angle
    centre_distance: Length
    load_deflection: LoadDeflection
    ball_excess: Length
    nut_groove: Groove
    screw_groove: Groove
    creep: Creep
    #: Displacement of screw against nut across the path that the nominal load has, m.
    displacement: Length
    #: Axial load that the balls of the circuit carry together; None where the displacement is kept.
    axial_load: Force | None
    #: Load and approach of a ball at its nominal place.
    nominal_load: Force
    nominal_approach: Length
    four_contacts: bool
    #: 1 for the flanks that a positive load presses on, -1 for the others; 1 for a positive speed of the screw.
    flank: int
    direction: int

    @property
    def path_radius(self) -> Length:
        """Radius of the path, along the helix."""
        return geometry.path_radius(self.pitch_circle_diameter, self.lead_angle)

    @property
    def natural_speed(self) -> Speed:
        """Speed of a ball along the path in grooves without deviations, m for each radian of the screw."""
        return self._speed(self._nominal_angle, 0.0)

    @property
    def _nominal_angle(self) -> Angle:
        A, alpha, xi = self.centre_distance, self.contact_angle, self.displacement
        s = rigidity.loaded_centre_distance(A, alpha, xi)
        return np.arcsin(rigidity.loaded_contact_sine(A, alpha, xi, s))

    def at(self, places: Field, angle: Any) -> BallsInZone:
        """The balls at some places, the last axis, when the screw has turned by an angle, one for all of them."""
        off, shift = self._deviations(places, np.asarray(angle))
        ramp = np.clip(np.minimum(places, self.length - places) / max(self.relief, 1e-300), 0.0, 1.0)
        inside = (places >= 0) & (places <= self.length)
        lift = self.nominal_approach * (1 - ramp ** (2 / 3))
        xi: Any = self.displacement if self.axial_load is None else self._carrying(off, lift, inside)
        load, alpha = self._on_flanks(off, lift, inside, xi)
        speed = self._speed(alpha, shift)
        if self.four_contacts:
            back, behind = self._on_flanks(
                off * np.array([-1.0, 1.0]).reshape(2, *[1] * places.ndim), lift, inside, -xi
            )
            both = load + back
            share = np.divide(load, both, out=np.full_like(both, 0.5), where=both > 0)
            speed = share * speed + (1 - share) * self._speed(behind, shift)
            load = both
        coefficient, limit = self.creep.at(load)
        return BallsInZone(load, alpha, speed, coefficient * load / speed, limit * load)

    def _deviations(self, places: Field, angle: Any) -> tuple[Field, Field]:
        """Deviations of nut against screw, towards the flank and outwards, and the shift of the path."""
        way = places if self.direction > 0 else self.length - places
        psi = way / self.path_radius
        nut = self.nut_groove.at(psi)
        screw = self.screw_groove.at(psi - self.direction * (angle[..., None] if angle.ndim else angle))
        between = nut - screw
        if self.flank < 0:
            between[0] *= -1
        return between, (nut[1] + screw[1]) / 2

    def _on_flanks(self, off: Field, lift: Field, inside: Any, displacement: Any) -> tuple[Field, Field]:
        """Load and contact angle at balls whose grooves lie off their places."""
        X = self.centre_distance * np.sin(self.contact_angle) + off[0]
        R = self.centre_distance * np.cos(self.contact_angle) + off[1]
        A, alpha = np.hypot(X, R), np.arctan2(X, R)
        s = rigidity.loaded_centre_distance(A, alpha, displacement)
        excess = self.ball_excess + (A - self.centre_distance) - lift
        delta = rigidity.ball_approach(A, alpha, displacement, s, excess)
        load = rigidity.hertz_load(self.load_deflection, np.where(inside, np.maximum(delta, 0.0), 0.0))
        return load, np.arcsin(rigidity.loaded_contact_sine(A, alpha, displacement, s))

    def _carrying(self, off: Field, lift: Field, inside: Any) -> Field:
        """The displacement at which the balls of each moment carry the axial load; of a four-contact ball net."""
        xi = np.full((*off.shape[1:-1], 1), self.displacement)
        cosine = np.cos(self.lead_angle)
        flipped = off * np.array([-1.0, 1.0]).reshape(2, *[1] * (off.ndim - 1))
        target: Any = self.axial_load
        scale = max(abs(target), self.nominal_load)
        for _ in range(STEPS):
            load, alpha = self._on_flanks(off, lift, inside, xi)
            force, slope = load * np.sin(alpha), self._slope(load, alpha)
            if self.four_contacts:
                load, alpha = self._on_flanks(flipped, lift, inside, -xi)
                force, slope = force - load * np.sin(alpha), slope + self._slope(load, alpha)
            left = target - cosine * np.sum(force, axis=-1, keepdims=True)
            if np.all(np.abs(left) <= CARRIED * scale):
                break
            total = cosine * np.sum(slope, axis=-1, keepdims=True)
            # where nothing touches, a step to where it would nominally
            xi = xi + np.where(total > 0, left / np.where(total > 0, total, 1.0), self.nominal_approach)
        return xi

    def _slope(self, load: Field, alpha: Field) -> Field:
        """Slope of the axial force of a ball by the displacement; that of its angle adds a little."""
        delta = (load / self.load_deflection) ** (2 / 3)
        stiff = 1.5 * self.load_deflection * np.sqrt(delta) * np.sin(alpha) ** 2
        return stiff + load * np.cos(alpha) ** 2 / (self.centre_distance + delta)

    def _speed(self, alpha: Any, shift: Any) -> Any:
        d_m, phi = self.pitch_circle_diameter + 2 * shift, self.lead_angle
        L = geometry.path_radius(d_m, phi)
        gamma = geometry.curvature_ratio(self.ball_diameter, d_m, alpha, phi)
        v = kinematics.entrainment_speed(1.0, L, gamma)
        rotation = kinematics.orbital_rotation(v, geometry.nut_contact_radius(L, gamma))
        return kinematics.orbital_speed(rotation, L)


def creep(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    contact_load: Force,
    screw_speed: AngularSpeed,
    *,
    four_contacts: bool = False,
) -> Creep:
    """Response of the contacts of a ball to a push along its path, by the slip law of the model.

    ``contact_load`` is one load or some, ascending, on one pair of flanks or, with ``four_contacts``, half of it on
    each of two; the balls of ``screw`` have its contact angle.
    """
    pushed = dataclasses.replace(
        model, ball_chain=one_neighbour, ball_force=imposed_ball_force, ball_friction_coefficient=0.0
    )
    Q, omega = np.atleast_1d(np.asarray(contact_load, dtype=float)), abs(screw_speed)
    speed_at = _speed_on_four if four_contacts else _speed_on_two
    (faster, _), (slower, limit) = (speed_at(pushed, screw, lubricant, Q, omega, push * Q) for push in (-PUSH, PUSH))
    coefficient = 2 * PUSH / ((faster - slower) / ((faster + slower) / 2))  # the push is against the motion
    return Creep(Q, np.broadcast_to(coefficient, Q.shape), np.broadcast_to(limit, Q.shape))


def _speed_on_two(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, load: Field, omega: AngularSpeed, push: Field
) -> tuple[Field, Field]:
    """Speed of a ball on two contacts that is pushed back, and the friction of both over the load."""
    result = ball_friction(model, screw, lubricant, model.laws.frame(screw), load, omega, push)
    on_screw, on_nut, L = result.screw, result.nut, result.frame.path_radius
    w = kinematics.ball_surface_speed(
        result.entrainment_speed,
        on_screw.creep_speed,
        on_nut.creep_speed,
        on_screw.contact_radius,
        on_nut.contact_radius,
        L,
    )
    speed = kinematics.orbital_speed(kinematics.orbital_rotation(w + on_nut.creep_speed, on_nut.contact_radius), L)
    return speed, on_screw.friction_coefficient + on_nut.friction_coefficient


def _speed_on_four(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, load: Field, omega: AngularSpeed, push: Field
) -> tuple[Field, Field]:
    """The same on four contacts: the torque that a push asks for is the push at the speed of the ball."""
    each = (load / 2, screw.contact_angle)
    result = four_contact_friction(model, screw, lubricant, (each, each), omega, push)
    speed = omega * result.contributions["chain_braking"] / (push * result.rolling_share)
    return speed, result.screw.friction_coefficient + result.nut.friction_coefficient


def loaded_zone(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    groove_deviation: Length,
    seed: int,
    circuits: int = 1,
    relief: Ratio = 1.0,
    keeps_load: bool | None = None,
) -> LoadedZone:
    """The loaded zone of one of the equal ``circuits`` of a nut.

    ``groove_deviation`` is the root-mean-square deviation of the place of nut groove against screw groove, along the
    axis as outwards, m, of which either groove has half the variance; the same ``seed`` gives the same grooves.
    ``relief`` is the length at either end over which the load rises, in ball diameters. The balls ``keeps_load`` where
    their axial load is the same at any angle, as that of a nut without preload is; where nut halves brace each other,
    the displacement is.

    Raises :class:`~ballscrew.basis.errors.InputError` for balls without load.
    """
    nut = screw.nut
    flank, direction = (-1 if axial_load < 0 else 1), (-1 if screw_speed < 0 else 1)
    load, alpha = _nominal(screw, axial_load, flank)
    if not load > 0:
        raise InputError(Fault("chain.axial_load", "leaves the balls without load", f"{axial_load:g} N", "load them"))
    A = rigidity.groove_centre_distance(screw.screw_conformity, screw.nut_conformity, screw.ball_diameter)
    K = pair_load_deflection(screw)
    delta = (load / K) ** (2 / 3)
    four = isinstance(nut, OversizeBallNut)
    s = A * np.cos(screw.contact_angle) / np.cos(alpha) if four else A + delta
    alpha = np.arccos(A * np.cos(screw.contact_angle) / s)
    generator = np.random.default_rng(seed)
    nut_groove, screw_groove = (Groove.scattered(groove_deviation / math.sqrt(2), generator) for _ in range(2))
    keeps = nut.is_row if keeps_load is None else keeps_load
    at_angle = dataclasses.replace(screw, contact_angle=float(alpha), nut=SINGLE_NUT)
    balls = screw.loaded_balls / circuits
    carried = load * balls * np.sin(alpha) * np.cos(screw.lead_angle)  # that of the half that carries the load
    return LoadedZone(
        length=float(balls * screw.ball_diameter),
        relief=float(relief * screw.ball_diameter),
        ball_diameter=screw.ball_diameter,
        pitch_circle_diameter=screw.pitch_circle_diameter,
        lead_angle=float(screw.lead_angle),
        contact_angle=screw.contact_angle,
        centre_distance=float(A),
        load_deflection=float(K),
        ball_excess=float(delta - (s - A)) if four else 0.0,
        nut_groove=nut_groove,
        screw_groove=screw_groove,
        creep=creep(model, at_angle, lubricant, load * CREEP_LOADS, screw_speed, four_contacts=four),
        displacement=float(s * np.sin(alpha) - A * np.sin(screw.contact_angle)),
        axial_load=float(abs(axial_load) / circuits if four else carried) if keeps else None,
        nominal_load=float(load),
        nominal_approach=float(delta),
        four_contacts=four,
        flank=flank,
        direction=direction,
    )


def _nominal(screw: BallScrew, axial_load: Force, flank: int) -> tuple[float, float]:
    """Mean load and contact angle of the balls on the flank that carries the load."""
    loads = loads_of(screw, axial_load)
    kinds: Sequence[Any] = loads.kinds if flank > 0 else loads.kinds[::-1]
    carrying = kinds[0]
    load, angle = (
        (carrying.forward_load, carrying.forward_angle)
        if flank > 0
        else (carrying.backward_load, carrying.backward_angle)
    )
    load = np.asarray(load, dtype=float)
    some = load > 0
    if not np.any(some):
        return 0.0, screw.contact_angle
    return float(np.mean(load[some])), float(np.mean(np.broadcast_to(angle, load.shape)[some]))
