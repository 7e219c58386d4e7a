"""The four contacts of an oversize ball as its four freedoms see them: speeds, forces, and what else resists.

Written for :mod:`ballscrew.physics.solvers.four_point_slip`, which says what the freedoms are. Everything is linear in
them but the forces of the slip.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from ballscrew.basis.arrays import namespace
from ballscrew.basis.quantities import Angle, Force, Length, Ratio, Speed, Torque
from ballscrew.physics.equations import slip
from ballscrew.physics.solvers.strips import Side, forces_of, shapes_of

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
