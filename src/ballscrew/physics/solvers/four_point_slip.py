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

The four contacts of an oversize ball as its four freedoms see them: speeds, forces, and what else resists.

Written for :mod:`ballscrew.physics.solvers.four_point_slip`, which says what the freedoms are. Everything is linear in
them but the forces of the slip.
"""

from __future__ import annotations

import dataclasses
import itertools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew.basis.arrays import in_blocks, namespace
from ballscrew.basis.quantities import Angle, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.physics.equations import slip
from ballscrew.physics.laws.contact import Contact
from ballscrew.physics.solvers.slip import Side, forces_of, shapes_of

#: Share of its friction that a contact along the path may be asked for by what resists the ball.
LARGEST_TRACTION_RATIO = 0.9


class Freedoms(NamedTuple):
    """Rotation of the ball about the path, outwards, and against the binormal, times its radius; and its travel."""

    along: Speed
    outward: Speed
    rolling: Speed
    travel: Speed


class Ball(NamedTuple):
    """Quantities common to the four contacts."""

    friction_moment: Torque
    chain_force: Force
    radius: Length
    lead_angle: Angle
    path_radius: Length


class ContactInput(NamedTuple):
    """One of the four contacts."""

    traction_limit: Force
    semi_major_axis: Length
    deformed_radius: Length
    ellipticity: Ratio
    rolling_force: Force
    elastic_moment: Torque
    contact_angle: Angle


class SlippingContact:
    """A contact and what it sees of the freedoms: speeds and their slopes."""

    def __init__(self, inputs: ContactInput, ball: Ball, *, on_screw: bool, facing: int) -> None:
        xp = namespace(inputs.contact_angle, ball.lead_angle)
        self.inputs, self.on_screw = inputs, on_screw
        self.cosine, self.sine = xp.cos(inputs.contact_angle), facing * xp.sin(inputs.contact_angle)
        self.radius = ball.radius
        self.rolling_cosine = self.cosine * xp.cos(ball.lead_angle)
        bend = slip.curvature_slip_speed(inputs.semi_major_axis, inputs.deformed_radius, 1 / ball.radius)
        zero = 0 * self.cosine
        # what the screw adds to creep, spin, lateral slip and curvature slip, for one rad/s
        self.of_screw: tuple[Any, ...] = (zero, zero, zero, zero)
        if on_screw:
            self.of_screw = (
                ball.path_radius - ball.radius * self.rolling_cosine,
                -self.sine * xp.cos(ball.lead_angle),
                ball.radius * xp.sin(ball.lead_angle),
                bend * ball.radius * self.rolling_cosine,
            )
        sign = -1.0 if on_screw else 1.0
        # slopes of the four by the freedoms
        self.slopes: tuple[tuple[Any, ...], ...] = (
            (0, -self.sine, -self.cosine, sign),
            (0, self.cosine / ball.radius, -self.sine / ball.radius, 0),
            (sign, 0, 0, 0),
            (0, bend * self.sine, bend * self.cosine, 0),
        )
        #: of each of the four, which freedoms it has a slope by, and the slope
        self.present = [[(i, slope) for i, slope in enumerate(row) if not is_zero(slope)] for row in self.slopes]
        self.side = Side(
            inputs.traction_limit, zero, zero, inputs.semi_major_axis, inputs.deformed_radius, inputs.ellipticity
        )
        self.shapes = shapes_of(self.side)

    def speeds(self, at: Freedoms) -> list[Speed]:
        """Creep, spin, lateral slip and curvature slip."""
        return [own + along(row, at) for own, row in zip(self.of_screw, self.slopes, strict=True)]

    def response(self, at: Freedoms, newton_share: float) -> ContactResponse:
        """The forces on the slip, friction times load included."""
        creep, spin, lateral, curvature = self.speeds(at)
        limit, a = self.inputs.traction_limit, self.inputs.semi_major_axis
        side = self.side._replace(curvature=curvature)
        f = forces_of(side, self.shapes, creep, spin, lateral, newton_share)
        first = (limit * f.path, limit * a * f.spin, limit * f.lateral, limit * f.curvature)
        second = (
            (limit * f.path_path,),
            (limit * a * f.path_spin, limit * a**2 * f.spin_spin),
            (limit * f.path_lateral, limit * a * f.spin_lateral, limit * f.lateral_lateral),
        )
        parts = (first[0] * creep + first[3] * curvature, first[1] * spin, first[2] * lateral)
        return ContactResponse(first, second, parts)


class ContactResponse(NamedTuple):
    """Forces on creep, spin, lateral and curvature slip; slopes of the first three; power by mechanism."""

    first: tuple[Any, ...]
    second: tuple[tuple[Any, ...], ...]
    parts: tuple[Any, ...]


def along(row: Sequence[Any], at: Freedoms) -> Any:
    """Sum of slopes times freedoms, without those that are absent."""
    terms = [slope * speed for slope, speed in zip(row, at, strict=True) if not is_zero(slope)]
    return sum(terms[1:], terms[0])


def is_zero(number: Any) -> bool:
    """True for a slope that is absent, not for an array of zeros."""
    return isinstance(number, int) and number == 0


class Resistance(NamedTuple):
    """Power of what else resists, by mechanism: a constant, and slopes by the freedoms."""

    constant: Any
    slopes: tuple[Any, ...]

    def power(self, at: Freedoms) -> Any:
        """The power at some speeds."""
        return self.constant + along(self.slopes, at)


def resistances_of(contacts: Sequence[SlippingContact], ball: Ball) -> list[Resistance]:
    """Rolling, elastic hysteresis, neighbours that rub, and their braking; the powers of :mod:`~oracles.free_ball`."""
    rho, L = ball.radius, ball.path_radius
    rolling: list[Any] = [0.0, 0, 0.0, 0.0, 0.0]
    hysteresis: list[Any] = [0.0, 0, 0.0, 0.0, 0]
    for contact in contacts:
        F_R, M_ER, c_alpha = contact.inputs.rolling_force, contact.inputs.elastic_moment, contact.rolling_cosine
        # surface speeds: R_s (1 - Ω_m) + ρ ω_b at the screw, R_n Ω_m + ρ ω_b at the nut, with ρ ω_b = ρ p + ρ Ω_m c_α
        fixed = L - rho * c_alpha if contact.on_screw else 0.0
        travel = (2 * rho * c_alpha - L) / L if contact.on_screw else (2 * rho * c_alpha + L) / L
        terms = (F_R * fixed, 0, F_R * contact.sine, F_R * contact.cosine, F_R * travel)
        rolling = [total + term for total, term in zip(rolling, terms, strict=True)]
        turned = M_ER * c_alpha if contact.on_screw else 0.0
        terms = (turned, 0, M_ER / rho * contact.sine, M_ER / rho * contact.cosine, 0)
        hysteresis = [total + term for total, term in zip(hysteresis, terms, strict=True)]
    # neighbours rub about the ball's axis: that of the two rolling axes, by load
    forward, backward = contacts[1], contacts[3]
    limits = forward.inputs.traction_limit, backward.inputs.traction_limit
    xp = namespace(*limits)
    both = limits[0] + limits[1]
    share = xp.where(both > 0, limits[0] / xp.where(both > 0, both, 1.0), 0.5)
    apart = forward.inputs.contact_angle + backward.inputs.contact_angle
    M_B = ball.friction_moment / xp.sqrt(1 - 4 * share * (1 - share) * xp.sin(apart / 2) ** 2)
    shares = ((share, forward), (1 - share, backward))
    rubbing = (
        0,
        M_B / rho * sum(part * contact.sine for part, contact in shares),
        M_B / rho * sum(part * contact.cosine for part, contact in shares),
        M_B / L * sum(part * contact.rolling_cosine for part, contact in shares),
    )
    return [
        Resistance(rolling[0], tuple(rolling[1:])),
        Resistance(hysteresis[0], tuple(hysteresis[1:])),
        Resistance(0.0, rubbing),
        Resistance(0.0, (0, 0, 0, ball.chain_force)),
    ]


def carried_share(contacts: Sequence[SlippingContact], ball: Ball) -> Ratio:
    """Share of the resistances that friction along the path can carry; one at most.

    Asked of the weaker race: all rolling forces and the moments over the ball's diameter.
    """
    needed = ball.friction_moment / (2 * ball.radius) + ball.chain_force
    for contact in contacts:
        needed = needed + contact.inputs.rolling_force + contact.inputs.elastic_moment / (2 * ball.radius)
    limits = [contact.inputs.traction_limit for contact in contacts]
    xp = namespace(needed, *limits)
    asked = _over(needed, xp.minimum(limits[0] + limits[2], limits[1] + limits[3]))
    # nor may one pair spin the ball about the normal of the other, which has to bear the forces as well
    spun: Ratio = 0.0
    for own, other in ((contacts[:2], contacts[2:]), (contacts[2:], contacts[:2])):
        lever = xp.abs(own[1].sine * other[1].cosine - own[1].cosine * other[1].sine)
        turning = sum(ball.radius * contact.inputs.rolling_force + contact.inputs.elastic_moment for contact in own)
        held = sum(ball.radius * contact.inputs.traction_limit for contact in own) * lever + sum(
            slip.pure_spin_moment(contact.inputs.traction_limit, contact.inputs.semi_major_axis) for contact in other
        )
        spun = xp.maximum(spun, _over(lever * turning, held))
    return LARGEST_TRACTION_RATIO / xp.maximum(xp.sqrt(asked**2 + spun**2), LARGEST_TRACTION_RATIO)


def _over(needed: Any, there: Any) -> Ratio:
    """Ratio of required to present; zero where nothing is present."""
    xp = namespace(needed, there)
    return xp.where(there > 0, needed / xp.where(there > 0, there, 1.0), 0.0)


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
