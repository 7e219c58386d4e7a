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
from typing import Annotated, Any

import numpy as np

from ballscrew._arrays import map_blocks
from ballscrew.components.frame import helix_frame
from ballscrew.components.nut import Bodies, Deviations, DoubleNut, Nut, OffsetLeadNut, OversizeBallNut
from ballscrew.components.screw import BallScrew, Raceway
from ballscrew.equations import deflection, geometry, hertz
from ballscrew.errors import Fault, accepts_units, is_concrete, raise_if_any, si_value
from ballscrew.quantities import Angle, Force, Info, Length, LoadDeflection, Mask, Ratio, Stiffness
from ballscrew.solvers.ball_springs import Field
from ballscrew.solvers.nut_balance import NutCase, solved

#: Imbalance, in units of load and preload, that counts as balanced.
TOLERANCE = 1e-10
#: Springs that are solved at once: what belongs to them stays in the cache.
BLOCK = 65_536
#: Balls of a nut body that are solved for one by one: several times those of the largest nuts.
MOST_BALLS = 2000
#: Where the numbers of balls stand among what is solved for.
_BALLS = 4


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
    lift_off_load: Annotated[Force, Info("F_l", "axial load that lifts the other flank off, bodies rigid")]
    #: That of all balls together. What is left at one ball between elastic bodies, beyond rounding, is less than a
    #: millionth of load and preload, or else it stands here.
    residual: Annotated[Ratio, Info(r"\epsilon", "imbalance / (load + preload)")]

    @property
    def converged(self) -> Mask:
        """Mask: the balls balance the load."""
        return self.residual <= TOLERANCE

    @property
    def advice(self) -> str:
        """Remedy where the balance did not converge."""
        return (
            "the balls outgrow their grooves: check load, preload and deviations against ball_diameter and conformity"
        )


@accepts_units("operation")
@np.errstate(all="ignore")  # what is impossible is NaN
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

    Elements with a load or a preload below zero are NaN.

    Without ``bodies`` screw and nut are rigid between the balls; with them, and with ``deviations``, the
    number of balls must be one number. ``constant_contact_angle`` keeps the angle without load.
    Raises :class:`~ballscrew.errors.InputError` for balls that cannot be counted one by one.
    """
    one_by_one = bodies is not None or deviations is not None
    halves = 2 if isinstance(nut, DoubleNut | OffsetLeadNut) else 1
    if deviations is not None:
        deviations = Deviations(*(si_value(f"deviations.{n}", v, "m") for n, v in deviations._asdict().items()))
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
    case = NutCase(
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
            parts[block.start // size] = solved(case, *(number[block] for number in flat))

    map_blocks(solve, flat[0].size, block_size=size)
    joined = [np.concatenate(part, axis=-1) for part in zip(*parts, strict=True)]
    # a load or a preload below zero has no distribution
    meaningless = ~((flat[0] >= 0) & (flat[1] >= 0))
    if np.any(meaningless):
        joined = [part if i == _BALLS else np.where(meaningless, np.nan, part) for i, part in enumerate(joined)]
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
    if screw.loaded_balls > MOST_BALLS:
        remedy = f"{MOST_BALLS} at most where balls differ or bodies are elastic"
        return [Fault("screw.loaded_balls", "too many to solve one by one", f"{screw.loaded_balls:g}", remedy)]
    balls = halves * int(screw.loaded_balls)
    sizes = {} if deviations is None else {name: np.shape(value) for name, value in deviations._asdict().items()}
    return [
        Fault(f"deviations.{name}", "must be one number or one for each ball", f"shape {size}", f"give {balls}")
        for name, size in sizes.items()
        if size not in ((), (balls,))
    ]
