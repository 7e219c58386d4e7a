r"""The load on every ball: Hertz springs between a screw and a nut that give way, too.

The screw moves by x against the nut. At each ball that is a displacement
:math:`\xi = x \cos\varphi` across the path, by which the groove centres of the forward flanks
part and those of the backward flanks near each other. Each flank pair carries
:math:`Q = K\delta^{3/2}` where it touches, at a contact angle that changes with the load;
the axial forces :math:`Q \sin\alpha \cos\varphi` balance the load on the nut.

Screw and nut body are bars between neighbouring balls. The displacements of two neighbours
differ by the stretch of both bars, so that all of them are those of a chain of springs (the two
bodies in series) with a spring to ground at each ball. Where screw and nut are held on the same side,
the load enters at the first ball; where they are held on opposite sides, it enters at both ends, in
the ratio of the flexibilities of screw and nut. :mod:`ballscrew.solvers.ball_springs` solves it.

Left out: bending and tilt of the nut, radial play, swelling of the nut, friction and inertia of the
balls, and the change of K with the contact angle.
"""

from __future__ import annotations

import dataclasses
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew._arrays import map_blocks
from ballscrew.components.frame import helix_frame
from ballscrew.components.nut import Bodies, Deviations, DoubleNut, Nut, OffsetLeadNut, OversizeBallNut
from ballscrew.components.screw import BallScrew, Raceway
from ballscrew.equations import deflection, geometry, hertz
from ballscrew.faults import Fault, is_concrete, raise_if_any
from ballscrew.quantities import Angle, Force, Info, Length, LoadDeflection, Mask, Ratio, Stiffness
from ballscrew.solvers.ball_springs import (
    BallSprings,
    Bars,
    Field,
    Flanks,
    chain_balance,
    rigid_balance,
    tridiagonal,
)

#: Imbalance, in units of load and preload, that counts as balanced.
TOLERANCE = 1e-10
#: Imbalance of the rigid screw from which the elastic one starts.
START = 0.1
PICOMETRE = 1e-12
#: Springs that are solved at once: what belongs to them stays in the cache.
BLOCK = 65_536


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class BallLoads:
    """Outcome: load and contact angle of each ball on both flanks, and how far the nut gives way.

    The ball axis comes last. It has one entry for each kind of ball where all of a kind are alike.
    """

    forward_load: Annotated[Force, Info("Q_i", "normal load of each ball on the flank that carries the load")]
    backward_load: Annotated[Force, Info("Q_i'", "normal load of each ball on the other flank")]
    forward_angle: Annotated[Angle, Info(r"\alpha_i", "contact angle of each ball under load", "deg")]
    backward_angle: Annotated[Angle, Info(r"\alpha_i'", "contact angle of each ball on the other flank", "deg")]
    #: How many balls each entry of the ball axis stands for.
    balls: Any
    deflection: Annotated[Length, Info("x", "axial displacement of the screw against the nut by the load", "um")]
    rigidity: Annotated[Stiffness, Info("R_nu", "axial rigidity of the nut at this load", "N/um")]
    remaining_preload: Annotated[Force, Info("F_b", "axial force left on the flank that the load relieves")]
    lift_off_load: Annotated[Force, Info("F_l", "axial load that lifts the other flank off, balls alike and bodies rigid")]
    residual: Annotated[Ratio, Info(r"\epsilon", "imbalance / (load + preload)")]

    @property
    def converged(self) -> Mask:
        """Where the balls balance the load."""
        return self.residual <= TOLERANCE

    @property
    def advice(self) -> str:
        """What to do where it did not converge."""
        return (
            "the balls outgrow their grooves: check load, preload and deviations against ball_diameter and conformity"
        )


def ball_loads(
    screw: BallScrew,
    nut: Nut,
    axial_load: Force,
    *,
    bodies: Bodies | None = None,
    deviations: Deviations | None = None,
    constant_contact_angle: bool = False,
) -> BallLoads:
    """Loads of the balls of a nut under an axial load; arrays of loads, screws and preloads broadcast.

    Without ``bodies`` screw and nut are rigid between the balls; with them, and with ``deviations``, the
    number of balls must be one number. ``constant_contact_angle`` keeps the angle without load.
    Raises :class:`~ballscrew.faults.InputError` for balls that cannot be counted one by one.
    """
    one_by_one = bodies is not None or deviations is not None
    halves = 2 if isinstance(nut, DoubleNut | OffsetLeadNut) else 1
    raise_if_any(_faults(screw, halves, deviations) if one_by_one else [])
    preload = getattr(nut, "preload", 0.0)
    spacing = getattr(nut, "spacing", 0.0)
    c_phi = np.cos(screw.lead_angle)
    A = deflection.groove_centre_distance(screw.screw_conformity, screw.nut_conformity, screw.ball_diameter)
    numbers = [
        axial_load, preload, spacing, screw.contact_angle, c_phi, A, pair_load_deflection(screw), screw.loaded_balls,
        *_bodies(screw, bodies),
    ]  # fmt: skip
    shape = np.broadcast_shapes(*(np.shape(number) for number in numbers))
    flat = [np.broadcast_to(np.asarray(number, dtype=float), shape).reshape(-1) for number in numbers]
    balls = int(screw.loaded_balls) if one_by_one else 1
    case = _Case(
        balls=balls,
        one_by_one=one_by_one,
        halves=halves,
        oversize=isinstance(nut, OversizeBallNut),
        elastic=bodies is not None,
        same_side=bodies is None or bodies.same_side,
        constant_angle=constant_contact_angle,
        scatters=deviations is not None,
        excess=_by_ball(deviations.ball_diameter if deviations else 0.0, halves * balls),
        lead_error=_by_ball(deviations.lead if deviations else 0.0, halves * balls),
    )
    parts: list[Any] = [None] * -(-flat[0].size // (size := max(1, BLOCK // (halves * balls))))

    def solve(block: slice) -> None:
        with np.errstate(all="ignore"):
            parts[block.start // size] = _solved(case, *(number[block] for number in flat))

    map_blocks(solve, flat[0].size, block_size=size)
    joined = [np.concatenate(part, axis=-1) for part in zip(*parts, strict=True)]
    by_ball = [np.moveaxis(part, 0, -1).reshape(*shape, part.shape[0]) for part in joined[:5]]
    plain = [part.reshape(shape)[()] for part in joined[5:]]
    return BallLoads(
        forward_load=by_ball[0],
        backward_load=by_ball[1],
        forward_angle=by_ball[2],
        backward_angle=by_ball[3],
        balls=by_ball[4],
        deflection=plain[0],
        rigidity=plain[1],
        remaining_preload=plain[2],
        lift_off_load=plain[3],
        residual=plain[4],
    )


def pair_load_deflection(screw: BallScrew) -> LoadDeflection:
    """Load over approach to the power of one and a half, of a ball between screw and nut."""
    gamma = helix_frame(screw).curvature_ratio
    radii = (
        geometry.screw_rolling_radius(screw.ball_diameter, gamma),
        geometry.nut_rolling_radius(screw.ball_diameter, gamma),
    )
    on_screw, on_nut = (
        _load_deflection(screw, raceway, R_x)
        for raceway, R_x in zip((screw.screw_raceway, screw.nut_raceway), radii, strict=True)
    )
    return deflection.series_load_deflection(on_screw, on_nut)


def _load_deflection(screw: BallScrew, raceway: Raceway, rolling_radius: Length) -> LoadDeflection:
    k = geometry.radii_ratio(geometry.transverse_radius(screw.ball_diameter, raceway.conformity), rolling_radius)
    kappa = hertz.ellipticity(k)
    integrals = hertz.elliptic_integrals(kappa)
    coefficient = hertz.approach_coefficient(k, kappa, integrals.K, integrals.E)
    return deflection.contact_load_deflection(coefficient, screw.equivalent_modulus(raceway), rolling_radius)


def _bodies(screw: BallScrew, bodies: Bodies | None) -> tuple[Any, Any, Any]:
    """Stiffness per length of screw and nut (E A), and the axial distance of neighbouring balls, which touch."""
    step = screw.ball_diameter * np.sin(screw.lead_angle) / screw.starts
    if bodies is None:
        return np.inf, np.inf, step
    core = np.pi / 4 * bodies.screw_diameter**2
    tube = np.pi / 4 * (bodies.nut_outer_diameter**2 - bodies.nut_inner_diameter**2)
    return screw.screw_material.young_modulus * core, screw.nut_material.young_modulus * tube, step


def _by_ball(deviation: Any, balls: int) -> Field:
    return np.broadcast_to(np.asarray(deviation, dtype=float), (balls,))[:, None]


def _faults(screw: BallScrew, halves: int, deviations: Deviations | None) -> list[Fault]:
    if not is_concrete(screw.loaded_balls):
        remedy = "solve screws with different numbers of balls one after the other"
        return [Fault("screw.loaded_balls", "must be one number where balls differ", "an array", remedy)]
    balls = halves * int(screw.loaded_balls)
    sizes = {} if deviations is None else {name: np.shape(value) for name, value in deviations._asdict().items()}
    return [
        Fault(f"deviations.{name}", "must be one number or one for each ball", f"shape {size}", f"give {balls}")
        for name, size in sizes.items()
        if size not in ((), (balls,))
    ]


class _Case(NamedTuple):
    """What all operating points have in common."""

    balls: int
    one_by_one: bool
    halves: int
    oversize: bool
    elastic: bool
    same_side: bool
    constant_angle: bool
    scatters: bool
    excess: Field
    lead_error: Field


class _Point(NamedTuple):
    """What differs between operating points."""

    load: Field
    preload: Field
    spacing: Field
    contact_angle: Field
    lead_cosine: Field
    centre_distance: Field
    load_deflection: Field
    loaded_balls: Field
    screw_bar: Field
    nut_bar: Field
    step: Field

    @property
    def link(self) -> Field:
        """Stiffness per length of both bodies in series."""
        return 1 / (1 / self.screw_bar + 1 / self.nut_bar)

    @property
    def forces_at_work(self) -> Field:
        """Load and preload, against which an imbalance is judged; without both, what a picometre gives."""
        return np.maximum(self.load + self.preload, self.loaded_balls * self.load_deflection * PICOMETRE**1.5)

    def approach(self, force: Field) -> Field:
        """Approach of balls that share an axial force equally at their angle without load."""
        normal = force / (self.loaded_balls * np.sin(self.contact_angle) * self.lead_cosine)
        return (normal / self.load_deflection) ** (2 / 3)

    def displacement(self, force: Field) -> Field:
        """About how far such balls let the screw move."""
        return self.approach(force) / (np.sin(self.contact_angle) * self.lead_cosine)


def _solved(case: _Case, *numbers: Field) -> tuple[Field, ...]:
    """A block of operating points, the ball axis first."""
    point = _Point(*numbers)
    springs, bars = _springs(case, point), _bars(case, point)
    at_rest = _first_touch(point, springs)
    if case.halves == 2:
        springs, at_rest = _braced(case, point, springs, bars)
    elif case.oversize:
        at_rest = _balance(case, point, springs, bars, 0 * point.load) if case.scatters else 0 * at_rest
    found = _balance(case, point, springs, bars, point.load)
    if not (case.halves == 2 or case.oversize):
        found = np.where(point.load > 0, found, at_rest)
    forward, backward = _by_facing(springs, found)
    on_forward, on_backward = (np.sum(springs.balls * force, axis=0) for _, _, force in (forward, backward))
    imbalance = np.abs(on_forward - on_backward - point.load) / point.forces_at_work
    return (
        forward[0],
        backward[0],
        forward[1],
        backward[1],
        springs.balls + 0 * found,
        _travel(case, point, bars, found, point.load) - _travel(case, point, bars, at_rest, 0 * point.load),
        1 / _compliance(case, point, bars, springs.forces(found)[1]),
        on_backward,
        _lift_off_load(case, point),
        imbalance,
    )


def _by_facing(springs: BallSprings, displacement: Field) -> list[tuple[Field, Field, Field]]:
    """Load, contact angle and axial force of the flank pairs that face forwards, and of those that face backwards."""
    loads = [(flanks.facing, springs.loads(flanks, displacement)) for flanks in springs.flanks]

    def of(facing: int) -> tuple[Field, Field, Field]:
        load = angle = force = np.zeros_like(displacement)
        for pair, there in loads:
            load = load + np.where(pair == facing, there.load, 0.0)
            angle = angle + np.where(pair == facing, np.arcsin(there.sine), 0.0)
            force = force + np.where(pair == facing, facing * there.axial_force, 0.0)
        return load, angle, force

    return [of(1), of(-1)]


def _springs(case: _Case, point: _Point) -> BallSprings:
    """The balls. Those of the second half of a double nut face backwards; they are not braced yet."""
    row = np.arange(case.halves * case.balls)[:, None]
    forward = np.where(row < case.balls, 1.0, -1.0)
    excess = np.broadcast_to(case.excess, forward.shape)
    if case.oversize:
        excess = excess + point.approach(point.preload)
    shift = -case.lead_error * point.lead_cosine
    pairs = [Flanks(forward, forward * shift, excess)]
    if case.oversize:
        pairs.append(Flanks(-forward, -forward * shift, excess))
    return BallSprings(
        load_deflection=point.load_deflection,
        centre_distance=point.centre_distance,
        contact_angle=point.contact_angle,
        lead_cosine=point.lead_cosine,
        balls=np.ones_like(point.load) if case.one_by_one else point.loaded_balls,
        constant_angle=case.constant_angle,
        flanks=tuple(pairs),
    )


def _bars(case: _Case, point: _Point) -> Bars:
    """The bodies between the balls; a double nut has its spacing in the middle."""
    middle = np.arange(1, case.halves * case.balls)[:, None] == case.balls
    lengths = np.where(middle, point.step + point.spacing, point.step)
    share = np.ones_like(point.load) if case.same_side else point.link / point.screw_bar
    return Bars(point.link / lengths, share)


def _balance(case: _Case, point: _Point, springs: BallSprings, bars: Bars, load: Field) -> Field:
    """Displacement of the screw at each ball."""
    forces, guess = point.forces_at_work, point.displacement(point.forces_at_work)
    if not case.elastic:
        return rigid_balance(springs, load, forces, guess)
    start = rigid_balance(springs.of_kinds(case.balls), load, forces, guess, START)
    return chain_balance(
        springs, bars, load, forces, np.broadcast_to(start[0], (len(springs.flanks[0].facing), load.size))
    )


def _braced(case: _Case, point: _Point, springs: BallSprings, bars: Bars) -> tuple[BallSprings, Field]:
    """A double nut with its halves braced by the preload, and the displacements then.

    Each half by itself carries the preload, which enters at its inner end.
    """
    n = case.balls
    one, other = springs.of(slice(None, n)), springs.of(slice(n, None))
    before = _balance(case, point, one, bars.of(slice(None, n - 1), 0.0), point.preload)
    if case.scatters:
        behind = _balance(case, point, other, bars.of(slice(n, None), 1.0), -point.preload)
    else:
        behind = -before[::-1]
    stretch = point.preload / bars.stiffness[n - 1] if case.elastic else 0.0
    gap = before[-1] - behind[0] + stretch
    facing, offset, excess = springs.flanks[0]
    braced = Flanks(facing, offset + np.where(facing < 0, gap * point.lead_cosine, 0.0), excess)
    return springs._replace(flanks=(braced,)), np.concatenate([before, behind + gap])


def _first_touch(point: _Point, springs: BallSprings) -> Field:
    """The displacement at which the first ball of a nut without preload touches, at each ball."""
    touch = np.min((springs.touch(springs.flanks[0]) - springs.flanks[0].offset) / point.lead_cosine, axis=0)
    return touch + 0 * springs.flanks[0].offset


def _travel(case: _Case, point: _Point, bars: Bars, x: Field, load: Field) -> Length:
    """Displacement of the loaded end of the screw against the held end of the nut."""
    beta = bars.first_share
    return beta * x[0] + (1 - beta) * x[-1] + load * _parallel_compliance(case, point, bars)


def _compliance(case: _Case, point: _Point, bars: Bars, slope: Field) -> Ratio:
    """Slope of the travel by the load, from those of the balls' forces by their displacements."""
    if not case.elastic:
        return 1 / np.sum(slope, axis=0)
    beta = bars.first_share
    right = np.zeros_like(slope)
    right[0] += beta
    right[-1] += 1 - beta
    moved = tridiagonal(bars.stiffness, slope, right)
    return beta * moved[0] + (1 - beta) * moved[-1] + _parallel_compliance(case, point, bars)


def _parallel_compliance(case: _Case, point: _Point, bars: Bars) -> Ratio:
    """What the bodies give way by themselves between opposite ends, if the balls held them together there."""
    if not case.elastic:
        return 0 * point.load
    return bars.first_share * (1 - bars.first_share) * np.sum(1 / bars.stiffness, axis=0)


def _lift_off_load(case: _Case, point: _Point) -> Force:
    """The load of a rigid screw with balls that are all alike when the other flanks just touch."""
    if not (case.halves == 2 or case.oversize):
        return 0 * point.load
    none = np.zeros((case.halves, 1))
    alike = case._replace(balls=1, one_by_one=False, elastic=False, scatters=False, excess=none, lead_error=none)
    springs, bars = _springs(alike, point), _bars(alike, point)
    if case.halves == 2:
        springs, _ = _braced(alike, point, springs, bars)
    own, other = springs.flanks[0], springs.flanks[-1]
    lifted = (other.offset - springs.touch(other))[-1] / point.lead_cosine
    return springs.balls * springs.loads(own, lifted).axial_force[0]
