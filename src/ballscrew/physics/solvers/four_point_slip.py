r"""Slip of a ball on four contacts: oversize balls touch both flanks of screw and nut.

No axis of rotation lets a ball roll on both flanks. It has four freedoms, its rotation and its travel along the
path, and takes those at which the power lost is least. With friction coefficient
and pressure given that power is convex in the four, as in :mod:`ballscrew.physics.solvers.ellipse_slip`: the
slopes are what is left of the balance. The contacts are cut into the same strips. What else resists the ball has
a power that is linear in the freedoms.

Speeds are for one rad/s of the screw. With the rotations :math:`\Omega_t` about the path,
O outwards and -B about the binormal, the travel :math:`\Omega_m L`, and :math:`s = \pm\sin\alpha`
on the two flank pairs, each pair rolls on the nut with :math:`p = B \cos\alpha + O s`, and

.. math::
    \text{screw: } & A = L - \rho c_\alpha - \Omega_m L - \rho p, \quad \Omega_P = O \cos\alpha - B s - s \cos\varphi,
    \quad D = \rho \left(\sin\varphi - \Omega_t\right), \quad w = p + c_\alpha \\
    \text{nut: } & A = \Omega_m L - \rho p, \quad \Omega_P = O \cos\alpha - B s, \quad D = \rho \Omega_t, \quad w = p

are creep, spin, lateral slip and rotation in the contacts.

The torque on the screw is the least power over the speed of the screw. So an unfinished step changes
it in second order only, and energy is conserved wherever the iteration stands.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.basis.arrays import in_blocks, namespace
from ballscrew.basis.quantities import Angle, Force, Length, Mask, Ratio, Torque
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.solvers.oversize_ball_contacts import (
    Ball,
    ContactInput,
    Freedoms,
    SlippingContact,
    carried_share,
    resistances_of,
)

#: Share of Newton's second term at each evaluation of the forces; see :mod:`ballscrew.physics.solvers.ellipse_slip`.
NEWTON_SHARES = (0.5, 0.9, 0.99, *(0.999,) * 9)
#: Where a step has made it worse, this much of it is tried instead.
BACKTRACK = 0.25
#: What rounding may add to the power without a step being called worse.
ROUNDING = 1e-13
#: Imbalance, in units of friction times load, that counts as balanced.
TOLERANCE = 1e-2
#: The mechanisms, in the order of the powers.
PARTS = (
    "hydrodynamic_rolling", "elastic_hysteresis", "curvature", "spin", "helix", "ball_to_ball", "chain_braking",
)  # fmt: skip


class FlankPair(NamedTuple):
    """The two contacts of a ball on one pair of flanks."""

    screw: Contact
    nut: Contact
    contact_angle: Angle


class FourPointBall(NamedTuple):
    """A ball on two flank pairs, and what its neighbours do to it on a straight path."""

    forward: FlankPair
    backward: FlankPair
    ball_friction_moment: Torque
    net_braking_force: Force
    ball_diameter: Length
    lead_angle: Angle
    path_radius: Length


@dataclasses.dataclass(frozen=True, eq=False)
class FourPointSlip:
    """Outcome: torque of one ball on the screw by mechanism, and how the ball turns.

    ``rolling_share`` is the share of the other resistances that friction can carry: below one the
    ball skids, and they fall until it is in balance.
    """

    contributions: Mapping[str, Torque]
    nut_torque: Torque
    rolling_share: Ratio
    residual: Ratio
    #: Angle of the ball's axis against the binormal, towards that of rolling on the forward flanks.
    axis_angle: Angle

    @property
    def converged(self) -> Mask:
        """Mask: the slip balance converged."""
        return self.residual <= TOLERANCE

    @property
    def advice(self) -> str:
        """Remedy where the balance did not converge."""
        return "one pair of flanks carries next to nothing: treat the ball as one with two contacts"


def four_point_slip(ball: FourPointBall) -> FourPointSlip:
    """Slip of a ball on four contacts, and its torque on the screw."""
    inputs: list[Any] = []
    for pair in (ball.forward, ball.backward):
        for contact in (pair.screw, pair.nut):
            inputs += ContactInput(
                contact.friction_coefficient * contact.contact_load,
                contact.semi_major_axis,
                contact.deformed_radius,
                contact.ellipticity,
                contact.hydrodynamic_rolling_force,
                contact.elastic_resistance_moment,
                pair.contact_angle,
            )
    common = Ball(
        ball.ball_friction_moment, ball.net_braking_force, ball.ball_diameter / 2, ball.lead_angle, ball.path_radius
    )
    *parts, nut_torque, share, residual, axis_angle = in_blocks(_solve_slip, *inputs, *common)
    return FourPointSlip(dict(zip(PARTS, parts, strict=True)), nut_torque, share, residual, axis_angle)


class _Iterate(NamedTuple):
    """An iterate: the degrees of freedom, the powers by mechanism, and the next step."""

    freedoms: Freedoms
    parts: Sequence[Torque]
    power: Torque
    imbalance: Ratio
    step: Freedoms


def _solve_slip(*numbers: Any) -> list[Any]:
    """The least power: its parts, what is left of the balance, and how the ball turns."""
    ball = Ball(*numbers[28:])
    contacts = [
        SlippingContact(ContactInput(*numbers[7 * i : 7 * i + 7]), ball, on_screw=i % 2 == 0, facing=1 if i < 2 else -1)
        for i in range(4)
    ]
    resistances = resistances_of(contacts, ball)
    limits = [contact.inputs.traction_limit for contact in contacts]
    xp = namespace(*limits, ball.path_radius)
    capacity = sum(limits)
    capacity = xp.where(capacity > 0, capacity, 1.0)
    share = carried_share(contacts, ball)

    def iterate(at: Freedoms, newton_share: float) -> _Iterate:
        slopes: list[Any] = [share * sum(part.slopes[i] for part in resistances) for i in range(4)]
        seconds: list[list[Any]] = [[0.0] * 4 for _ in range(4)]
        slipping: list[Any] = [0.0, 0.0, 0.0]
        for contact in contacts:
            response = contact.response(at, newton_share)
            slipping = [total + part for total, part in zip(slipping, response.parts, strict=True)]
            for force, row in zip(response.first, contact.present, strict=True):
                for i, slope in row:
                    slopes[i] = slopes[i] + force * slope
            for k, m in itertools.product(range(3), repeat=2):
                bend = response.second[max(k, m)][min(k, m)]
                for (i, one), (j, other) in itertools.product(contact.present[k], contact.present[m]):
                    if j <= i:
                        seconds[i][j] = seconds[i][j] + bend * one * other
        others = [share * part.power(at) for part in resistances]
        power = sum(slipping) + sum(others)
        size = xp.sqrt(sum(slope**2 for slope in slopes)) / capacity
        return _Iterate(at, [*others[:2], *slipping, *others[2:]], power, size, Freedoms(*_solved(seconds, slopes)))

    middle, *alone = (iterate(start, NEWTON_SHARES[0]) for start in _starts(contacts, ball))
    best = _better(xp, _better(xp, middle, alone[0]), alone[1])
    for newton_share in NEWTON_SHARES[1:]:
        moved = Freedoms(*(place + step for place, step in zip(best.freedoms, best.step, strict=True)))
        trial = iterate(moved, newton_share)
        shorter = best._replace(step=Freedoms(*(BACKTRACK * step for step in best.step)))
        best = _better(xp, trial, shorter)
    axis_angle = xp.arctan(best.freedoms.outward / best.freedoms.rolling)
    nut_torque = best.power - share * ball.chain_force * ball.path_radius
    return [*best.parts, nut_torque, share + 0 * best.power, best.imbalance, axis_angle]


def _better(xp: Any, one: _Iterate, other: _Iterate) -> _Iterate:
    """The place with the smaller power; the first unless it is worse by more than rounding."""
    worse = one.power > other.power + ROUNDING * xp.abs(other.power)

    def pick(first: Any, second: Any) -> Any:
        return xp.where(worse, second, first)

    return _Iterate(
        Freedoms(*map(pick, one.freedoms, other.freedoms)),
        list(map(pick, one.parts, other.parts)),
        pick(one.power, other.power),
        pick(one.imbalance, other.imbalance),
        Freedoms(*map(pick, one.step, other.step)),
    )


def _starts(contacts: Sequence[SlippingContact], ball: Ball) -> list[Freedoms]:
    """Three ways to turn: in the middle between the flanks, and as if rolling on one pair alone."""
    forward, backward = contacts[1], contacts[3]
    rho, L = ball.radius, ball.path_radius
    xp = namespace(ball.lead_angle, forward.cosine)
    speed = (L - rho * (forward.rolling_cosine + backward.rolling_cosine) / 2) / 2
    along = rho * xp.sin(ball.lead_angle) / 2
    starts = [Freedoms(along, 0 * speed, 2 * speed / (forward.cosine + backward.cosine), speed)]
    for contact in (forward, backward):
        speed = (L - rho * contact.rolling_cosine) / 2
        half_spin = rho * contact.sine * xp.cos(ball.lead_angle) / 2
        outward = contact.sine * speed + contact.cosine * half_spin
        starts.append(Freedoms(along, outward, contact.cosine * speed - contact.sine * half_spin, speed))
    return starts


def _solved(matrix: Sequence[Sequence[Any]], slopes: Sequence[Any]) -> list[Any]:
    """Minus the inverse of a positive matrix times the slopes, by Cholesky's factors."""
    xp = namespace(*slopes)
    n = len(slopes)
    factor: list[list[Any]] = [[0.0] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            rest = matrix[i][j] - sum(factor[i][k] * factor[j][k] for k in range(j))
            # rounding may leave nothing of a diagonal: then that freedom stays where it is
            factor[i][j] = xp.sqrt(xp.maximum(rest, 1e-30)) if i == j else rest / factor[j][j]
    values: list[Any] = []
    for i in range(n):
        values.append((-slopes[i] - sum(factor[i][k] * values[k] for k in range(i))) / factor[i][i])
    for i in reversed(range(n)):
        values[i] = (values[i] - sum(factor[k][i] * values[k] for k in range(i + 1, n))) / factor[i][i]
    return values
