r"""Slip of a ball on four contacts: oversize balls touch both flanks of screw and nut.

No axis of rotation lets a ball roll on both flanks. It has four freedoms, its rotation and its travel along the
path, and takes those at which the power lost is least. With friction coefficient
and pressure given that power is convex in the four, as in :mod:`ballscrew.solvers.ellipse_slip`: the
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
import math
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

from ballscrew._arrays import in_blocks, namespace
from ballscrew.components.contact import Contact
from ballscrew.equations import slip
from ballscrew.quantities import Angle, Force, Length, Mask, Ratio, Speed, Torque
from ballscrew.solvers.strips import Side, forces_of, shapes_of

#: Share of Newton's second term at each evaluation of the forces; see :mod:`ballscrew.solvers.ellipse_slip`.
NEWTON_SHARES = (0.5, 0.9, 0.99, 0.999, 0.999, 0.999, 0.999, 0.999)
#: Where a step has made it worse, this much of it is tried instead.
BACKTRACK = 0.25
#: What rounding may add to the power without a step being called worse.
ROUNDING = 1e-13
#: Imbalance, in units of friction times load, that counts as balanced.
TOLERANCE = 1e-2
#: The mechanisms, in the order of the powers.
PARTS = ("hydrodynamic_rolling", "elastic_hysteresis", "curvature", "spin", "helix", "ball_to_ball")
#: Share of its friction that a contact along the path may be asked for by what resists the ball.
LARGEST_TRACTION_RATIO = 0.9


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
    ball_to_ball_force: Force
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
        """Where the forces of the slip meet those of the balance."""
        return self.residual <= TOLERANCE

    @property
    def advice(self) -> str:
        """What to do where it did not converge."""
        return "one pair of flanks carries next to nothing: treat the ball as one with two contacts"


class _Freedoms(NamedTuple):
    """Rotation of the ball about the path, outwards, and against the binormal, times its radius; and its travel."""

    along: Speed
    outward: Speed
    rolling: Speed
    travel: Speed


class _Ball(NamedTuple):
    """What the four contacts have in common."""

    friction_moment: Torque
    chain_force: Force
    radius: Length
    lead_angle: Angle
    path_radius: Length


class _Touch(NamedTuple):
    """One of the four contacts."""

    traction_limit: Force
    semi_major_axis: Length
    deformed_radius: Length
    ellipticity: Ratio
    rolling_force: Force
    elastic_moment: Torque
    contact_angle: Angle


def four_point_slip(ball: FourPointBall) -> FourPointSlip:
    """How a ball slips on four contacts, and the torque it puts on the screw."""
    touches: list[Any] = []
    for pair in (ball.forward, ball.backward):
        for contact in (pair.screw, pair.nut):
            touches += _Touch(
                contact.friction_coefficient * contact.contact_load,
                contact.semi_major_axis,
                contact.deformed_radius,
                contact.ellipticity,
                contact.hydrodynamic_rolling_force,
                contact.elastic_resistance_moment,
                pair.contact_angle,
            )
    common = _Ball(
        ball.ball_friction_moment, ball.ball_to_ball_force, ball.ball_diameter / 2, ball.lead_angle, ball.path_radius
    )
    *parts, nut_torque, share, residual, axis_angle = in_blocks(_settle, *touches, *common)
    return FourPointSlip(dict(zip(PARTS, parts, strict=True)), nut_torque, share, residual, axis_angle)


class _Contact:
    """A contact and what it sees of the freedoms: speeds and their slopes."""

    def __init__(self, touch: _Touch, ball: _Ball, *, on_screw: bool, facing: int) -> None:
        xp = namespace(touch.contact_angle, ball.lead_angle)
        self.touch, self.on_screw = touch, on_screw
        self.cosine, self.sine = xp.cos(touch.contact_angle), facing * xp.sin(touch.contact_angle)
        self.radius = ball.radius
        self.rolling_cosine = self.cosine * xp.cos(ball.lead_angle)
        bend = slip.curvature_slip_speed(touch.semi_major_axis, touch.deformed_radius, 1 / ball.radius)
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
        self.side = Side(
            touch.traction_limit, zero, zero, touch.semi_major_axis, touch.deformed_radius, touch.ellipticity
        )
        self.shapes = shapes_of(self.side)

    def speeds(self, at: _Freedoms) -> list[Speed]:
        """Creep, spin, lateral slip and curvature slip."""
        return [own + _along(row, at) for own, row in zip(self.of_screw, self.slopes, strict=True)]

    def rolls(self, at: _Freedoms) -> Speed:
        """Speed of the ball's surface along the path."""
        return self.cosine * at.rolling + self.sine * at.outward

    def answer(self, at: _Freedoms, newton: float) -> _Answer:
        """The forces on the slip, friction times load included."""
        creep, spin, lateral, curvature = self.speeds(at)
        limit, a = self.touch.traction_limit, self.touch.semi_major_axis
        side = self.side._replace(curvature=curvature)
        f = forces_of(side, self.shapes, creep, spin, lateral, newton)
        first = (limit * f.path, limit * a * f.spin, limit * f.lateral, limit * f.curvature)
        second = (
            (limit * f.path_path,),
            (limit * a * f.path_spin, limit * a**2 * f.spin_spin),
            (limit * f.path_lateral, limit * a * f.spin_lateral, limit * f.lateral_lateral),
        )
        parts = (first[0] * creep + first[3] * curvature, first[1] * spin, first[2] * lateral)
        return _Answer(first, second, parts)


class _Answer(NamedTuple):
    """Forces on creep, spin, lateral and curvature slip; slopes of the first three; power by mechanism."""

    first: tuple[Any, ...]
    second: tuple[tuple[Any, ...], ...]
    parts: tuple[Any, ...]


def _along(row: Sequence[Any], at: _Freedoms) -> Any:
    """Sum of slopes times freedoms, without those that are zero."""
    terms = [slope * speed for slope, speed in zip(row, at, strict=True) if not _is_zero(slope)]
    return sum(terms[1:], terms[0])


def _plus(total: Any, *factors: Any) -> Any:
    """A total and one more product, if none of its factors is a plain zero."""
    return total if any(map(_is_zero, factors)) else total + math.prod(factors[1:], start=factors[0])


def _is_zero(number: Any) -> bool:
    return isinstance(number, int) and number == 0


class _Resistance(NamedTuple):
    """Power of what else resists, by mechanism: a constant, and slopes by the freedoms."""

    constant: Any
    slopes: tuple[Any, ...]

    def power(self, at: _Freedoms) -> Any:
        return self.constant + _along(self.slopes, at)


def _resistances(contacts: Sequence[_Contact], ball: _Ball) -> list[_Resistance]:
    """Hydrodynamic rolling, elastic hysteresis, and neighbours; the powers of :mod:`~ballscrew.solvers.free_ball`."""
    rho, L = ball.radius, ball.path_radius
    rolling: list[Any] = [0.0, 0, 0.0, 0.0, 0.0]
    hysteresis: list[Any] = [0.0, 0, 0.0, 0.0, 0]
    for contact in contacts:
        F_R, M_ER, c_alpha = contact.touch.rolling_force, contact.touch.elastic_moment, contact.rolling_cosine
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
    limits = forward.touch.traction_limit, backward.touch.traction_limit
    xp = namespace(*limits)
    both = limits[0] + limits[1]
    share = xp.where(both > 0, limits[0] / xp.where(both > 0, both, 1.0), 0.5)
    apart = forward.touch.contact_angle + backward.touch.contact_angle
    M_B = ball.friction_moment / xp.sqrt(1 - 4 * share * (1 - share) * xp.sin(apart / 2) ** 2)
    shares = ((share, forward), (1 - share, backward))
    neighbours = (
        0,
        M_B / rho * sum(part * contact.sine for part, contact in shares),
        M_B / rho * sum(part * contact.cosine for part, contact in shares),
        M_B / L * sum(part * contact.rolling_cosine for part, contact in shares) + ball.chain_force,
    )
    return [
        _Resistance(rolling[0], tuple(rolling[1:])),
        _Resistance(hysteresis[0], tuple(hysteresis[1:])),
        _Resistance(0.0, neighbours),
    ]


class _Stand(NamedTuple):
    """A place on the way: the freedoms there, the powers by mechanism, and where to go next."""

    freedoms: _Freedoms
    parts: Sequence[Torque]
    power: Torque
    imbalance: Ratio
    step: _Freedoms


def _settle(*numbers: Any) -> list[Any]:
    """The least power: its parts, what is left of the balance, and how the ball turns."""
    ball = _Ball(*numbers[28:])
    contacts = [
        _Contact(_Touch(*numbers[7 * i : 7 * i + 7]), ball, on_screw=i % 2 == 0, facing=1 if i < 2 else -1)
        for i in range(4)
    ]
    resistances = _resistances(contacts, ball)
    limits = [contact.touch.traction_limit for contact in contacts]
    xp = namespace(*limits, ball.path_radius)
    capacity = sum(limits)
    capacity = xp.where(capacity > 0, capacity, 1.0)
    share = _carried_share(contacts, ball)

    def stand(at: _Freedoms, newton: float) -> _Stand:
        slopes: list[Any] = [share * sum(part.slopes[i] for part in resistances) for i in range(4)]
        seconds: list[list[Any]] = [[0.0] * 4 for _ in range(4)]
        slipping: list[Any] = [0.0, 0.0, 0.0]
        for contact in contacts:
            answer = contact.answer(at, newton)
            slipping = [total + part for total, part in zip(slipping, answer.parts, strict=True)]
            for i in range(4):
                for force, row in zip(answer.first, contact.slopes, strict=True):
                    slopes[i] = _plus(slopes[i], force, row[i])
            for k, m in itertools.product(range(3), repeat=2):
                bend, one, other = answer.second[max(k, m)][min(k, m)], contact.slopes[k], contact.slopes[m]
                for i in range(4):
                    for j in range(i + 1):
                        seconds[i][j] = _plus(seconds[i][j], bend, one[i], other[j])
        others = [share * part.power(at) for part in resistances]
        power = sum(slipping) + sum(others)
        size = xp.sqrt(sum(slope**2 for slope in slopes)) / capacity
        return _Stand(at, [*others[:2], *slipping, others[2]], power, size, _Freedoms(*_solved(seconds, slopes)))

    middle, *alone = (stand(start, NEWTON_SHARES[0]) for start in _starts(contacts, ball))
    best = _better(xp, _better(xp, middle, alone[0]), alone[1])
    for newton in NEWTON_SHARES[1:]:
        moved = _Freedoms(*(place + step for place, step in zip(best.freedoms, best.step, strict=True)))
        trial = stand(moved, newton)
        shorter = best._replace(step=_Freedoms(*(BACKTRACK * step for step in best.step)))
        best = _better(xp, trial, shorter)
    axis_angle = xp.arctan(best.freedoms.outward / best.freedoms.rolling)
    nut_torque = best.power - share * ball.chain_force * ball.path_radius
    return [*best.parts, nut_torque, share + 0 * best.power, best.imbalance, axis_angle]


def _better(xp: Any, one: _Stand, other: _Stand) -> _Stand:
    """The place with the smaller power; the first unless it is worse by more than rounding."""
    worse = one.power > other.power + ROUNDING * xp.abs(other.power)

    def pick(first: Any, second: Any) -> Any:
        return xp.where(worse, second, first)

    return _Stand(
        _Freedoms(*map(pick, one.freedoms, other.freedoms)),
        list(map(pick, one.parts, other.parts)),
        pick(one.power, other.power),
        pick(one.imbalance, other.imbalance),
        _Freedoms(*map(pick, one.step, other.step)),
    )


def _starts(contacts: Sequence[_Contact], ball: _Ball) -> list[_Freedoms]:
    """Three ways to turn: in the middle between the flanks, and as if rolling on one pair alone."""
    forward, backward = contacts[1], contacts[3]
    rho, L = ball.radius, ball.path_radius
    xp = namespace(ball.lead_angle, forward.cosine)
    speed = (L - rho * (forward.rolling_cosine + backward.rolling_cosine) / 2) / 2
    along = rho * xp.sin(ball.lead_angle) / 2
    starts = [_Freedoms(along, 0 * speed, 2 * speed / (forward.cosine + backward.cosine), speed)]
    for contact in (forward, backward):
        speed = (L - rho * contact.rolling_cosine) / 2
        half_spin = rho * contact.sine * xp.cos(ball.lead_angle) / 2
        outward = contact.sine * speed + contact.cosine * half_spin
        starts.append(_Freedoms(along, outward, contact.cosine * speed - contact.sine * half_spin, speed))
    return starts


def _carried_share(contacts: Sequence[_Contact], ball: _Ball) -> Ratio:
    """Share of the resistances that friction along the path can carry; one at most.

    Asked of the weaker race: all rolling forces and the moments over the ball's diameter.
    """
    needed = ball.friction_moment / (2 * ball.radius) + ball.chain_force
    for contact in contacts:
        needed = needed + contact.touch.rolling_force + contact.touch.elastic_moment / (2 * ball.radius)
    limits = [contact.touch.traction_limit for contact in contacts]
    xp = namespace(needed, *limits)
    carried = LARGEST_TRACTION_RATIO * xp.minimum(limits[0] + limits[2], limits[1] + limits[3])
    return xp.where(needed > carried, carried / xp.where(needed > carried, needed, 1.0), 1.0)


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
    found: list[Any] = []
    for i in range(n):
        found.append((-slopes[i] - sum(factor[i][k] * found[k] for k in range(i))) / factor[i][i])
    for i in reversed(range(n)):
        found[i] = (found[i] - sum(factor[k][i] * found[k] for k in range(i + 1, n))) / factor[i][i]
    return found
