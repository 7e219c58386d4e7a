"""Friction over the angle of the screw after a reversal, or from rest.

Four things come back at their own pace. The resistances to rolling are there at once. Spin and curvature slip wind up
within the contacts, in hundredths of a degree. The lateral slip of the helix comes back only as the balls roll from one
side of their grooves to the other, over degrees (:mod:`ballscrew.physics.equations.across_groove`). And balls press on
each other again when the gap of their circuit has closed. The second and third are computed with bristles
(:mod:`ballscrew.physics.moving_balls.brush`), ball for ball of each kind, and brought to the steady torque of the
model, from which theirs differs by some thousandths; the last is a straight line over the gap, which is assumed.

Where the balls of two contacts lie across their grooves in motion, and what that changes.

Friction of the helix pushes them off the line of the groove centres (:mod:`ballscrew.physics.equations.across_groove`).
Their contact angles at screw and nut then differ, the one way where the load is lifted and the other where it is
lowered; the spin of both contacts is less there and more here, as both normals lean towards the same side; and the nut
lies nearer to the screw by what the ball has moved out of its line, so that it steps axially when the direction of
rotation changes.

The models of the package leave this out: it is exact mechanics that no published measurement of a ball screw has
shown. What it makes of a preload that was set at rest is in :mod:`ballscrew.physics.friction.across_groove`.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.basis.arrays import namespace, where
from ballscrew.basis.errors import Fault, accepts_units, raise_if_any
from ballscrew.basis.quantities import Angle, AngularSpeed, Array, Force, Info, Length, Ratio, Torque
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import across_groove, kinematics
from ballscrew.physics.friction.across_groove import arms_of
from ballscrew.physics.friction.balls import BallFriction, ball_friction
from ballscrew.physics.friction.loaded_balls import LoadedBalls
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.moving_balls.brush import CELLS, BallContacts, Brush, Step
from ballscrew.physics.solvers.load_distribution import preload_of

#: Rounds of spin and lateral force: each changes the other by a tenth at most.
ROUNDS = 6


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class OffLineBalls:
    """The balls of one kind where they lie in steady motion, with their ``friction`` there; elementwise."""

    lateral_friction_angle: Annotated[
        Angle, Info(r"\beta", "lean of each normal; above zero where the load is lifted", "deg")
    ]
    screw_contact_angle: Annotated[Angle, Info(r"\alpha_s", "contact angle at the screw", "deg")]
    nut_contact_angle: Annotated[Angle, Info(r"\alpha_n", "contact angle at the nut", "deg")]
    distance: Annotated[Length, Info(r"\eta", "distance of the balls from the line of the groove centres", "um")]
    axial_step: Annotated[
        Length, Info("x_r", "axial step of the nut while the balls cross the line, at a constant load", "um")
    ]
    spin_share: Annotated[Ratio, Info(r"\Omega_P'/\Omega_P", "spin over that of balls on the line")]
    torque_ratio: Annotated[Ratio, Info("M'/M", "friction torque of a ball over that of one on the line")]
    friction: BallFriction


@accepts_units("operation")
def off_line_balls(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
) -> tuple[OffLineBalls, ...]:
    """The balls of each kind off the line of their grooves, those that carry the load first: :class:`OffLineBalls`.

    ``model`` gives the friction of ``screw`` with ``lubricant`` under ``axial_load`` (N) at ``screw_speed`` (rad/s);
    spin and lateral force are found together. Balls that differ are taken as alike, between rigid bodies. Balls without
    load are left out where the whole kind has none.

    Raises :class:`~ballscrew.basis.errors.InputError` as the model, and for balls on four contacts, which stay on their
    line.
    """
    result = of_balls_alike(model, screw, lubricant, axial_load=axial_load, screw_speed=screw_speed)
    four = [kind for kind in result.kinds if not isinstance(kind.friction, BallFriction)]
    if four:
        remedy = "ask for a nut whose balls have two"
        raise_if_any(
            [Fault("nut.type", "has balls on four contacts, which stay on the line of their grooves", "", remedy)]
        )
    lifts = where(axial_load * screw_speed >= 0, 1.0, -1.0)
    return tuple(
        _of_kind(model, result, lubricant, kind, way) for kind, way in zip(result.kinds, (lifts, -lifts), strict=False)
    )


def of_balls_alike(
    model: FrictionModel, screw: BallScrew, lubricant: Lubricant, *, axial_load: Force, screw_speed: AngularSpeed
) -> FrictionResult:
    """The friction of a nut with all balls of a kind alike, between rigid bodies and without losses beside them.

    Raises :class:`~ballscrew.basis.errors.InputError` as the model.
    """
    if screw.nut.one_by_one or screw.nut.losses:
        screw = dataclasses.replace(screw, nut=dataclasses.replace(screw.nut, bodies=None, deviations=None, losses={}))
    return model(screw, lubricant, axial_load=axial_load, screw_speed=screw_speed)


def _of_kind(
    model: FrictionModel, friction_result: FrictionResult, lubricant: Lubricant, kind: LoadedBalls, way: Ratio
) -> OffLineBalls:
    at_line = kind.friction
    assert isinstance(at_line, BallFriction), "four contacts are refused"
    screw = dataclasses.replace(friction_result.ball_screw, contact_angle=kind.contact_angle)
    frame, Q, omega = at_line.frame, at_line.contact_load, abs(friction_result.screw_speed)
    v = frame.entrainment_speed(1.0)
    rotations = v / at_line.screw.rolling_radius, v / at_line.nut.rolling_radius
    total = kinematics.relative_spin(1.0, frame.rolling_plane_sine)
    here, spin = at_line, total
    beta = 0.0 * Q
    for _ in range(ROUNDS):
        beta = way * across_groove.lateral_friction_angle(here.lateral_force, Q)
        spin = across_groove.off_line_spin(total, *rotations, beta)
        leaning = dataclasses.replace(frame, rolling_plane_sine=abs(spin))
        here = ball_friction(model, screw, lubricant, leaning, Q, omega, model.imposed_ball_force(screw))
    arms = arms_of(screw, here.screw, here.nut)
    s = across_groove.off_line_centre_distance(*arms, beta)
    xp = namespace(kind.contact_angle, screw.lead_angle)
    growth = across_groove.off_line_growth(s, *arms, beta)
    return OffLineBalls(
        lateral_friction_angle=beta,
        screw_contact_angle=kind.contact_angle - beta,
        nut_contact_angle=kind.contact_angle + beta,
        distance=across_groove.off_line_distance(*arms, beta),
        axial_step=growth / (xp.sin(kind.contact_angle) * xp.cos(screw.lead_angle)),
        spin_share=spin / total,
        torque_ratio=here.screw_torque / at_line.screw_torque,
        friction=here,
    )


Field = NDArray[np.float64]

#: The parts of the torque after a reversal, by how they come back, and the mechanisms of the model that they are.
MECHANISMS: Mapping[str, tuple[str, ...]] = {
    "rolling": ("hydrodynamic_rolling", "elastic_hysteresis"),
    "spin_and_curvature": ("spin", "curvature"),
    "helix": ("helix",),
    "ball_to_ball": ("ball_to_ball", "chain_braking"),
}
#: The rest of the steady torque: losses of the nut, which are there at once.
LOSSES = "losses"
#: Angles that the balls need to roll across to the other side of their grooves, after which nothing changes any more.
CROSSINGS = 4.0
#: Contact lengths that the bristles need to settle.
CONTACTS = 6.0
#: Parts into which the first cells of the contacts are cut: there spin and curvature wind up.
FINE_CELLS = (64, 16, 8, 4, 2)
#: Points of a curve behind the first cells.
POINTS = 200
#: The gap of a circuit, in balls, where none is given: assumed; a usual fill has 0.1 and more.
GAP = 0.5
#: Strokes, rad from one turning point to the other, whose friction work elements are fitted to and held against.
STROKES: Sequence[Angle] = tuple(math.radians(2 * amplitude) for amplitude in (0.5, 1.0, 2.0, 5.0))
#: Steps at least in half a stroke.
_FEWEST_STEPS = 4


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Reversal:
    """Friction over the angle that the screw has turned since it reversed, or since it started."""

    #: Angle of the screw since then, rad, increasing from zero.
    screw_angle: Annotated[Angle, Info(r"\theta", "angle of the screw since it reversed or started", "deg")]
    #: Travel of the nut since then, m.
    travel: Annotated[Length, Info("x", "travel since the screw reversed or started", "mm")]
    #: Friction torque against the new direction, N m: from minus the steady torque (zero from rest) to plus it.
    screw_torque: Annotated[Torque, Info("M", "friction torque against the new direction")]
    #: Its parts by mechanism, N m; they sum to it.
    contributions: Mapping[str, Array]
    #: The friction torque of steady motion, N m, which it goes to, and its parts.
    steady_torque: Annotated[Torque, Info(r"M_\infty", "friction torque of steady motion")]
    steady_contributions: Mapping[str, Torque]
    #: How far the balls lie off the line of their grooves, m; of the half that carries the load first.
    displacement: tuple[Array, ...]
    #: Steady slip torque of the bristles over that of the model.
    bristles_over_model: Ratio
    from_rest: bool

    def angle_at(self, share: float) -> Angle:
        """Angle at which a ``share`` of the swing from the first to the steady torque has come back, rad."""
        first = self.screw_torque[0]
        back = (self.screw_torque - first) / (self.steady_torque - first)
        reached = np.nonzero(back >= share)[0]
        if not reached.size:
            return math.nan
        i = int(reached[0])
        if i == 0:
            return float(self.screw_angle[0])
        part = (share - back[i - 1]) / (back[i] - back[i - 1])
        return float(self.screw_angle[i - 1] + part * (self.screw_angle[i] - self.screw_angle[i - 1]))


class Loop(NamedTuple):
    """Friction work of a stroke that the screw turns to and fro again and again."""

    stroke: Annotated[Angle, Info(r"\theta", "angle of the screw from one turning point to the other", "deg")]
    work_share: Annotated[Ratio, Info("", "friction work over that of steady friction on the same way")]


class _Ball(NamedTuple):
    """A ball of a kind with one of its flank pairs, and how many of them there are."""

    contacts: BallContacts
    number: float
    #: Angle of the screw in which the ball rolls from the line of its grooves to where it lies in motion.
    crossing: Angle
    #: Whether the screw pushes the ball the way that it moves after the reversal.
    lifts: bool


class _Start(NamedTuple):
    """Start of a reversal: angles of the screw to where contacts and grooves settle, and to its end."""

    steady: FrictionResult
    balls: list[_Ball]
    advance: Length
    closing: Angle
    whole: Angle
    end: Angle


class _Curve(NamedTuple):
    """Slip torque of one ball over the angle, by part, its way off the line, and the steady slip torque."""

    angle: Field
    spin_and_curvature: Field
    helix: Field
    distance: Field
    steady: Torque


@accepts_units("operation")
def reversal(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    travel: Length | None = None,
    from_rest: bool = False,
    gap: Ratio = GAP,
) -> Reversal:
    """Friction of a ball screw after it has reversed in motion, or ``from_rest``: a :class:`Reversal`.

    ``model`` gives the steady friction of ``screw`` with ``lubricant`` under ``axial_load`` (N) at ``screw_speed``
    (rad/s), that after the reversal; what winds up depends on the angle, not on the time, so that a slow reversal is
    one at the friction coefficients of that speed. ``travel`` (m) is how far to follow; by default until nothing
    changes any more. The ``gap`` of each circuit, in balls, closes before they press on each other again.

    A hypothesis, but for its steady ends: no published ball screw tells it apart from guides that wind up as well.
    Balls that differ are taken as alike. On four contacts the other flanks keep a ball on its line: helix slip, too,
    winds up within the contacts, and their curve is that of each pair of flanks by itself.

    Raises :class:`~ballscrew.basis.errors.InputError` for arrays, a speed of zero, a travel that is not above zero, a
    gap below zero, balls without load, and for a model without slip across the path.
    """
    raise_if_any(_faults(model, screw, {"axial_load": axial_load, "screw_speed": screw_speed}, travel, gap))
    operation: dict[str, Any] = {"axial_load": float(axial_load), "screw_speed": float(screw_speed)}
    steady, balls, advance, closing, whole, end = _start(model, screw, lubricant, operation, travel, gap)
    curves = [_curve(ball, end, whole, from_rest) for ball in balls]
    angle = _angles(curves, end)
    slip, of_bristles = {"spin_and_curvature": 0 * angle, "helix": 0 * angle}, 0.0
    for ball, curve in zip(balls, curves, strict=True):
        of_bristles += ball.number * curve.steady
        for name in slip:
            slip[name] = slip[name] + ball.number * np.interp(angle, curve.angle, getattr(curve, name))
    parts = {name: sum(float(steady.contributions[each]) for each in of) for name, of in MECHANISMS.items()}
    parts[LOSSES] = float(steady.screw_torque) - sum(parts.values())
    scale = sum(parts[name] for name in slip) / of_bristles if of_bristles > 0 else 0.0
    turned = angle > 0
    at_once = np.where(turned, 1.0, 0.0 if from_rest else -1.0)
    pressed = np.where(turned, np.minimum(angle / closing, 1.0) if closing > 0 else 1.0, at_once)
    contributions = {
        "rolling": parts["rolling"] * at_once,
        **{name: scale * values for name, values in slip.items()},
        "ball_to_ball": parts["ball_to_ball"] * pressed,
        LOSSES: parts[LOSSES] * at_once,
    }
    return Reversal(
        screw_angle=angle,
        travel=advance * angle,
        screw_torque=sum(contributions.values(), 0 * angle),
        contributions=contributions,
        steady_torque=float(steady.screw_torque),
        steady_contributions=parts,
        displacement=tuple(np.interp(angle, curve.angle, curve.distance) for curve in curves),
        bristles_over_model=1 / scale if scale else math.nan,
        from_rest=from_rest,
    )


def loops(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    after: Reversal,
    strokes: Sequence[Angle] = STROKES,
    *,
    axial_load: Force,
    screw_speed: AngularSpeed,
    gap: Ratio = GAP,
) -> tuple[Loop, ...]:
    """Friction work of short strokes to and fro, once they repeat: a :class:`Loop` for each of the ``strokes`` (rad).

    ``after`` is the :func:`reversal` at the same point, to whose steady torque the slip of the balls is brought. They
    swing about the line of their grooves: over less than they need to roll across, next to no slip is sideways, and
    the spin has all that the contacts can hold, about twice its steady torque. Balls that part at a turning point press
    on each other for what is left of the stroke once their ``gap`` has closed, on the line of the reversal.

    The first loop after a start from rest is taken, whose work is within 3 % of that of the later ones.
    """
    operation: dict[str, Any] = {"axial_load": float(axial_load), "screw_speed": float(screw_speed)}
    start = _start(model, screw, lubricant, operation, None, gap)
    parts, steady = after.steady_contributions, float(after.steady_torque)
    result: list[Loop] = []
    for stroke in strokes:
        slip = sum(ball.number * _work(ball, stroke) for ball in start.balls) / (2 * stroke)
        scaled = slip / after.bristles_over_model if slip else 0.0
        closed = stroke / start.closing if start.closing > 0 else math.inf
        pressed = parts["ball_to_ball"] * (closed / 2 if closed < 1 else 1 - 0.5 / closed)
        result.append(Loop(stroke, (parts["rolling"] + parts[LOSSES] + scaled + pressed) / steady))
    return tuple(result)


def _work(ball: _Ball, stroke: Angle) -> float:
    """Slip work of a ball on a stroke to and fro, after half a stroke from rest, J."""
    brush, half = Brush(ball.contacts), _half_steps(ball, stroke)
    size, way = stroke / 2 / half, 1.0 if ball.lifts else -1.0
    for _ in range(half):
        brush.turn(way * size)
    return sum(
        sum(brush.turn(direction * size).torque) * direction * size
        for direction in (-way, way)
        for _ in range(2 * half)
    )


def _half_steps(ball: _Ball, stroke: Angle) -> int:
    return max(math.ceil(stroke / 2 * ball.contacts.rolled / ball.contacts.cell), _FEWEST_STEPS)


def _start(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    operation: Mapping[str, Any],
    travel: Length | None,
    gap: Ratio,
) -> _Start:
    steady = model(screw, lubricant, **operation)
    lifts = operation["axial_load"] * operation["screw_speed"] >= 0
    balls = _balls(of_balls_alike(model, steady.ball_screw, lubricant, **operation), lifts=lifts)
    advance, closing = float(screw.lead) / (2 * math.pi), _closing(steady, float(gap))
    whole = max((_whole(ball) for ball in balls), default=0.0)
    end = max(whole, 1.2 * closing) if travel is None else float(travel) / advance
    return _Start(steady, balls, advance, closing, whole, end)


def _balls(friction_result: FrictionResult, *, lifts: bool) -> list[_Ball]:
    """The balls that carry load, each flank pair by itself; those of a braced half are pushed the other way."""
    balls: list[_Ball] = []
    for place, kind in enumerate(friction_result.kinds):
        held = sum(float(pair.load) > 0 for pair in kind.pairs) > 1
        for pair in kind.pairs:
            if float(pair.load) <= 0:
                continue
            frame = friction_result.frame
            if isinstance(kind.friction, BallFriction):
                frame = kind.friction.frame
            contacts = BallContacts.of(friction_result.ball_screw, frame, pair.screw, pair.nut, held=held)
            balls.append(_Ball(contacts, float(kind.balls), _crossing(contacts, kind), lifts == (place == 0)))
    return balls


def _crossing(contacts: BallContacts, kind: LoadedBalls) -> Angle:
    if math.isinf(contacts.hold) or not contacts.lateral or not isinstance(kind.friction, BallFriction):
        return 0.0
    return float(kind.friction.lateral_force) / contacts.hold / (contacts.lateral / 2)


def _whole(ball: _Ball) -> Angle:
    """Angle after which a ball has settled: in its groove, and in its contacts."""
    return max(CROSSINGS * ball.crossing, CONTACTS * CELLS * ball.contacts.cell / ball.contacts.rolled)


def _closing(steady: FrictionResult, gap: Ratio) -> Angle:
    """Angle in which the balls travel along their path by a gap."""
    frame = steady.frame
    orbit = kinematics.orbital_rotation(frame.entrainment_speed(1.0), frame.nut_contact_radius)
    return gap * float(steady.ball_screw.ball_diameter / kinematics.orbital_speed(orbit, frame.path_radius))


def _curve(ball: _Ball, end: Angle, whole: Angle, from_rest: bool) -> _Curve:
    """The slip of a ball after it has settled the other way, or from rest."""
    brush, cell = Brush(ball.contacts), ball.contacts.cell / ball.contacts.rolled
    way = 1.0 if ball.lifts else -1.0
    settled = math.ceil(whole / cell)
    first = (0.0, 0.0, 0.0)
    last = first
    if not from_rest:
        for _ in range(settled):
            step = brush.turn(-way * cell)
            last = _along(way, step)
        first = last
    steps = [cell / parts for parts in FINE_CELLS for _ in range(parts)]
    turned = min(end, whole)  # behind it nothing changes any more
    steps += [cell] * max(math.ceil(turned / cell) - len(FINE_CELLS), 0)
    rows = [(0.0, *first)]
    for size in steps:
        rows.append((rows[-1][0] + size, *_along(way, brush.turn(way * size))))
        if rows[-1][0] >= turned:
            break
    last = rows[-1][1:] if from_rest else last
    if rows[-1][0] < end:
        rows.append((end, *rows[-1][1:]))
    elif from_rest:
        for _ in range(max(settled - len(rows), 0)):
            last = _along(way, brush.turn(way * cell))
    return _Curve(*np.array(rows).T, steady=abs(last[0] + last[1]))


def _along(way: float, step: Step) -> tuple[float, float, float]:
    """Torques against the new direction, and the way off the line."""
    spin, curvature, helix = step.torque
    return way * (spin + curvature), way * helix, way * step.distance


def _angles(curves: list[_Curve], end: Angle) -> Field:
    """The angles to show: dense where spin and curvature wind up, then in a geometric series."""
    if not curves:
        return np.linspace(0.0, end, POINTS)
    finest = min(curves, key=lambda curve: curve.angle[1]).angle
    last = min(end, *(float(curve.angle[-1]) for curve in curves))
    dense = finest[: sum(FINE_CELLS) : 4]
    dense = dense[dense < last]
    if len(dense) < 2:  # a travel within the first cell
        return np.linspace(0.0, last, POINTS)
    return np.concatenate([dense, np.geomspace(dense[-1], last, POINTS)[1:]])


def _faults(
    model: FrictionModel, screw: BallScrew, operation: Mapping[str, Any], travel: Length | None, gap: Ratio
) -> list[Fault]:
    numbers = {**{f"operation.{n}": v for n, v in operation.items()}, "reversal.travel": travel, "reversal.gap": gap}
    remedy = "follow one reversal at a time"
    faults = [
        Fault(name, "must be one number", "an array", remedy)
        for name, value in numbers.items()
        if value is not None and np.ndim(value)
    ]
    if faults:
        return faults
    if operation["screw_speed"] == 0:
        remedy = "give the speed after the reversal, a slow one"
        faults.append(Fault("operation.screw_speed", "must not be zero", "", remedy))
    braced = screw.nut.halves == 2 or isinstance(screw.nut, OversizeBallNut)
    if operation["axial_load"] == 0 and not (braced and preload_of(screw, screw.nut)):
        remedy = "give the load under which the screw turns round"
        faults.append(Fault("operation.axial_load", "leaves the balls without load", "", remedy))
    if travel is not None and not 0 < travel < math.inf:
        faults.append(Fault("reversal.travel", "must be above zero", str(travel), "give how far to follow: 1 mm"))
    if not 0 <= gap < math.inf:
        remedy = "give the gap of a circuit in balls: 0.5"
        faults.append(Fault("reversal.gap", "must not be negative", str(gap), remedy))
    if not traits_of(model.slip).lateral_slip or traits_of(model.slip).curvature_alone:
        faults.append(Fault("model.slip", "knows no slip across the path", "", "take the model reference"))
    return faults
