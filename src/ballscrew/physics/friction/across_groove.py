"""Balls off the line of their grooves: what that makes of a preload which the nut has at rest.

In motion the friction of the helix pushes the balls of two contacts across their grooves
(:mod:`ballscrew.physics.equations.across_groove`). At the offset of two halves that a spacer keeps, all of them then
press as if they were larger by the same: the nut is one with a larger preload. That the normals of both contacts lean
changes the spin as well, the one way in one half and the other way in the other; that is left out here
(:mod:`ballscrew.physics.moving_balls.reversal`).
"""

from __future__ import annotations

import dataclasses
from typing import Any, NamedTuple, Protocol

import numpy as np

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Force, Length, Ratio
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import Deviations, SingleNut
from ballscrew.physics.components.operating_state import OperatingState
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import across_groove, rigidity
from ballscrew.physics.friction.balls import BallFriction
from ballscrew.physics.friction.loaded_balls import LoadedBalls, loads_of
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.solvers.load_distribution import (
    BallLoads,
    ball_loads,
    body_stiffness,
    pair_load_deflection,
)

#: Rounds of friction and load. A round leaves a tenth of the error of a usual preload, and half of that of a light one
#: in cold oil.
ROUNDS = 6
#: Newton's steps to the preload of a half between elastic bodies.
NEWTON_STEPS = 6


class Friction(Protocol):
    """Friction model as a preload in motion needs it."""

    def under(self, loads: BallLoads | None, screw: BallScrew, lubricant: Lubricant, state: OperatingState) -> Any:
        """Friction under loads of the balls that are known."""
        ...


class Arms(NamedTuple):
    """Distances from the centre of a ball to the centres of the grooves of screw and nut, under load."""

    screw: Length
    nut: Length


def arms_of(screw: BallScrew, on_screw: Contact, on_nut: Contact) -> Arms:
    """The arms of a ball of ``screw`` with these contacts: groove radius less ball radius, and the approach."""
    d_w = screw.ball_diameter
    sides = ((screw.screw_conformity, on_screw), (screw.nut_conformity, on_nut))
    return Arms(*((conformity - 0.5) * d_w + contact.mutual_approach for conformity, contact in sides))


def friction_across(kind: LoadedBalls) -> Ratio:
    """Lateral force over load, the mean of all balls of a kind by their loads; zero on four contacts and without
    load.
    """
    if not isinstance(kind.friction, BallFriction):
        return 0.0
    force, load = kind.total(kind.friction.lateral_force), kind.total(kind.friction.contact_load)
    loaded = load > 0
    xp = namespace(force, load)
    return xp.where(loaded, force / xp.where(loaded, load, 1.0), 0.0)


def in_motion(model: Friction, screw: BallScrew, lubricant: Lubricant, state: OperatingState) -> BallScrew:
    """The screw with its nut as it is in motion, where its preload was set at rest: that of the balls off their line.

    Friction is that of ``model`` with ``lubricant`` at the speed of ``state`` without load, the mean of both halves:
    where a load relieves one of them, the offset stays. At rest it is the limit of a vanishing speed: friction holds
    the balls where motion has left them. A nut whose balls have not moved yet is one that was not set at rest, and so
    is every other: it stays as it is.
    """
    nut: Any = screw.nut
    if not nut.set_at_rest:
        return screw
    moving = dataclasses.replace(screw, nut=dataclasses.replace(nut, set_at_rest=False))
    at_rest, idle = moving, OperatingState(0.0 * state.axial_load, state.screw_speed, state.temperature)
    for _ in range(ROUNDS):
        result = model.under(loads_of(moving, idle.axial_load), moving, lubricant, idle)
        tangent = sum(friction_across(kind) for kind in result.kinds) / len(result.kinds)
        preload = preload_off_line(at_rest, namespace(tangent).arctan(tangent))
        moving = dataclasses.replace(moving, nut=dataclasses.replace(nut, preload=preload, set_at_rest=False))
    return moving


def preload_off_line(screw: BallScrew, lateral_friction_angle: Angle) -> Force:
    """Preload of a nut at the offset that it has at rest, with its balls off their line by an angle of friction."""
    if screw.nut.bodies is None:
        return _of_rigid_bodies(screw, lateral_friction_angle)
    return _of_elastic_bodies(screw, lateral_friction_angle)


def growth_of(screw: BallScrew, approach: Length, lateral_friction_angle: Angle) -> Length:
    """Growth of an ``approach`` of the balls of ``screw`` as they leave their line while the groove centres stay."""
    A = rigidity.groove_centre_distance(screw.screw_conformity, screw.nut_conformity, screw.ball_diameter)
    s, d_w = A + approach, screw.ball_diameter
    conformities = screw.screw_conformity, screw.nut_conformity
    one, other = ((conformity - 0.5) * d_w + approach / 2 for conformity in conformities)
    growth = across_groove.off_line_growth(s, one, other, lateral_friction_angle)
    # the arms off the line are longer by the growth itself, which is a hundredth of them at most
    return across_groove.off_line_growth(s, one + growth / 2, other + growth / 2, lateral_friction_angle)


def _of_rigid_bodies(screw: BallScrew, beta: Angle) -> Force:
    preload: Any = getattr(screw.nut, "preload", 0.0)
    half = loads_of(
        dataclasses.replace(screw, nut=dataclasses.replace(screw.nut, deviations=None)), 0.0 * preload
    ).kinds[0]
    xp = namespace(preload, beta, half.forward_load)
    approach = _approach(screw, half.forward_load)
    growth = growth_of(screw, approach, beta)
    pressed = approach > 0
    return preload * xp.where(pressed, 1 + growth / xp.where(pressed, approach, 1.0), 1.0) ** 1.5


def _approach(screw: BallScrew, load: Force) -> Length:
    """Approach of screw and nut at a ball under a load."""
    xp = namespace(load)
    pressed = load > 0
    return xp.where(pressed, xp.where(pressed, load / pair_load_deflection(screw), 1.0) ** (2 / 3), 0.0)


def _of_elastic_bodies(screw: BallScrew, beta: Angle) -> Force:
    """Preload off the line between elastic bodies, by a half alone: a single nut held on one side, with it for a load.

    Its first ball moves by what its springs and bodies give way; balls that are larger touch earlier.
    """
    nut: Any = screw.nut
    bodies = dataclasses.replace(nut.bodies, same_side=True).sized(screw)
    alone = SingleNut(angle_under_load=True)
    preload = np.asarray(nut.preload, dtype=float)
    mean = preload / (screw.carrying_balls * np.sin(screw.contact_angle) * np.cos(screw.lead_angle))
    growth = growth_of(screw, _approach(screw, mean), np.asarray(beta))
    earlier = _earlier_touch(screw, growth)
    bars = body_stiffness(screw, bodies)
    middle = (bars[2] + nut.spacing) / 2 * (1 / bars[0] + 1 / bars[1])

    def half(force: Any, more: Any) -> BallLoads:
        return ball_loads(screw, alone, force, bodies=bodies, deviations=Deviations(ball_diameter=more))

    force, preload, growth, earlier = (
        np.array(part) for part in np.broadcast_arrays(preload, preload, growth, earlier)
    )
    for place in np.ndindex(force.shape):
        at_rest = float(half(preload[place], 0.0).deflection)
        for _ in range(NEWTON_STEPS):
            result = half(force[place], growth[place])
            too_far = float(result.deflection) - earlier[place] - at_rest + middle * (force[place] - preload[place])
            rigidity = float(result.rigidity)
            softness = 1 / rigidity if rigidity else np.inf  # of balls that just touch
            force[place] = max(force[place] - too_far / (softness + middle), 0.0)
    return force[()]


def _earlier_touch(screw: BallScrew, growth: Length) -> Length:
    """Axial displacement by which balls that are larger by a growth touch their flanks earlier."""
    A = rigidity.groove_centre_distance(screw.screw_conformity, screw.nut_conformity, screw.ball_diameter)
    up, out = A * np.sin(screw.contact_angle), A * np.cos(screw.contact_angle)
    return (up - np.sqrt((A - growth) ** 2 - out**2)) / np.cos(screw.lead_angle)
