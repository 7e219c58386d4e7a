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
the ratio of the flexibilities of screw and nut. :mod:`ballscrew.physics.solvers.ball_springs` solves it. The balls
also widen the nut and shrink the screw, each nut body by one gap (:mod:`ballscrew.physics.solvers.swelling`). Between
rigid bodies all balls of a kind are alike, and :mod:`ballscrew.physics.solvers.rigid_ball_loads` has the answer in a
fixed number of steps.

A load of either sign: a negative one presses on the backward flanks, those of a single nut or of the second
half of a double nut, and relieves the forward ones. It enters where a positive one enters.

Left out: bending and tilt of the nut, radial play, swelling that differs along a nut body, friction and inertia of the
balls, and the change of K with the contact angle.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np

from ballscrew.basis.arrays import as_array, in_blocks, lazy, map_blocks, namespace
from ballscrew.basis.errors import Fault, InputError, accepts_units, is_concrete, raise_if_any, si_value
from ballscrew.basis.quantities import Angle, Force, Info, Length, LoadDeflection, Mask, Ratio, Stiffness
from ballscrew.physics.components.nut import Bodies, Deviations, Nut, OversizeBallNut
from ballscrew.physics.components.screw import BallScrew, Raceway
from ballscrew.physics.equations import geometry, hertz, rigidity
from ballscrew.physics.laws.frame import helix_frame
from ballscrew.physics.solvers.ball_springs import Field
from ballscrew.physics.solvers.compiled_chain import FEWEST_POINTS
from ballscrew.physics.solvers.elastic_ball_loads import NutCase, elastic_lift_off_load, solved
from ballscrew.physics.solvers.rigid_ball_loads import KindLoads, RigidLoads, RigidNut, rigid_loads

#: Imbalance, in units of load and preload, that counts as balanced.
TOLERANCE = 1e-10
#: Springs that are solved at once: what belongs to them stays in the cache.
BLOCK = 65_536
#: Balls of a nut body that are solved for one by one: several times those of the largest nuts.
MOST_BALLS = 2000
#: Results for the nut as a whole, in the order of the solvers.
_OF_NUT = ("deflection", "rigidity", "remaining_preload", "lift_off", "residual")


@dataclasses.dataclass(frozen=True, eq=False)
class LiftOff:
    """Search for the load at which the balls of a nut with elastic bodies leave the flank that is relieved."""

    case: NutCase
    points: _Points
    #: The load between rigid bodies.
    rigid: Force

    def at(self, places: Any) -> LiftOff:
        """The search at some of several operating points."""
        return LiftOff(self.case, self.points.at(places), self.rigid[places])

    def __call__(self) -> Force:
        """The load, N; NaN for a preload below zero."""
        (result,) = _solution(elastic_lift_off_load, self.case, self.points)
        return self.points.all_of(result)[()]


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class BallLoads:
    """Outcome: load and contact angle of each ball on both flanks, and how far the nut gives way.

    A positive load presses on the forward flanks, a negative one on the backward ones. The ball axis comes last. It has
    one entry for each kind of ball where all of a kind are alike.
    """

    #: The kinds of balls: one of a nut with one body, two of a nut with halves; or one with all balls one by one.
    kinds: tuple[KindLoads, ...]
    #: Whether the balls are given one by one.
    one_by_one: bool
    deflection: Annotated[Length, Info("x", "axial displacement of the screw against the nut by the load", "um")]
    rigidity: Annotated[Stiffness, Info("R_nu", "axial rigidity of the nut at this load", "N/um")]
    remaining_preload: Annotated[Force, Info("F_b", "axial force left on the flank that the load relieves")]
    #: The load that lifts the other flank off, or the search for it.
    lift_off: Force | LiftOff
    #: That of all balls together. What is left at one ball between elastic bodies, beyond rounding, is less than a
    #: millionth of load and preload, or else it stands here.
    residual: Annotated[Ratio, Info(r"\epsilon", "imbalance / (load + preload)")]

    @lazy
    def lift_off_load(self) -> Annotated[Force, Info("F_l", "axial load of this sign that lifts the other flank off")]:
        """Size of the axial load at which the last ball leaves the flank that the load relieves.

        It is of the sign of the load (of a positive one without load): elastic bodies lose the preload at another load
        forwards than backwards. It is searched for when it is first read.
        """
        return self.lift_off() if isinstance(self.lift_off, LiftOff) else self.lift_off

    @property
    def rigid_lift_off_load(self) -> Force:
        """The same between rigid bodies, where it does not depend on the sign of the load."""
        return self.lift_off.rigid if isinstance(self.lift_off, LiftOff) else self.lift_off

    @lazy
    def forward_load(
        self,
    ) -> Annotated[Force, Info("Q_i", "normal load of each ball on the flank that carries the load")]:
        """Normal load of each ball on the flank that a positive load presses on."""
        return self._by_ball("forward_load")

    @lazy
    def backward_load(self) -> Annotated[Force, Info("Q_i'", "normal load of each ball on the other flank")]:
        """Normal load of each ball on the other flank."""
        return self._by_ball("backward_load")

    @lazy
    def forward_angle(self) -> Annotated[Angle, Info(r"\alpha_i", "contact angle of each ball under load", "deg")]:
        """Contact angle of each ball on the flank that a positive load presses on."""
        return self._by_ball("forward_angle")

    @lazy
    def backward_angle(
        self,
    ) -> Annotated[Angle, Info(r"\alpha_i'", "contact angle of each ball on the other flank", "deg")]:
        """Contact angle of each ball on the other flank."""
        return self._by_ball("backward_angle")

    @lazy
    def balls(self) -> Any:
        """Number of balls that each entry of the ball axis stands for."""
        return self._by_ball("balls")

    def at(self, places: Any) -> BallLoads:
        """The loads at some of several operating points, by their places; of balls that are given one by one."""
        assert self.one_by_one, "balls that are alike are no trouble to solve again"
        kinds = tuple(KindLoads(*(part[places] for part in kind)) for kind in self.kinds)
        of_nut = {name: getattr(self, name) for name in _OF_NUT}
        some = {name: one.at(places) if isinstance(one, LiftOff) else one[places] for name, one in of_nut.items()}
        return BallLoads(kinds=kinds, one_by_one=True, **some)

    def _by_ball(self, name: str) -> Any:
        parts = [getattr(kind, name) for kind in self.kinds]
        if self.one_by_one:
            return parts[0]
        xp = namespace(*parts, self.deflection)
        *whole, _ = xp.broadcast_arrays(*parts, self.deflection)
        return xp.stack(whole, axis=-1)

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
    compiled: bool = False,
) -> BallLoads:
    """Loads of the balls of a nut under an axial load of either sign; arrays of loads, screws and preloads broadcast.

    Elements with a preload below zero are NaN.

    Without ``bodies`` screw and nut are rigid between the balls; with them, and with ``deviations``, the
    number of balls must be one number. Without both, every operation is elementwise and can be recorded.
    ``constant_contact_angle`` keeps the angle without load. Bodies that swell take what a ball's given oversize gives
    before its flanks are pressed: their preload is less than :func:`preload_of_rigid_bodies`. ``compiled``
    solves balls between elastic bodies by a kernel where the compiler is installed: the same steps, whose sums round
    otherwise.
    Raises :class:`~ballscrew.basis.errors.InputError` for balls that cannot be counted one by one.
    """
    point = _rigid_nut(screw, nut, as_array(axial_load))
    if bodies is None and deviations is None:
        return _alike(nut, point, constant_contact_angle)
    return _one_by_one(screw, nut, point, bodies, deviations, constant_contact_angle, compiled)


def ball_loads_of_each(screws: Sequence[BallScrew], axial_loads: Sequence[Force]) -> list[BallLoads | InputError]:
    """Loads of the balls of many screws between their elastic bodies, without deviations, or why one has none.

    Nuts with the same balls are solved together, and those with the same numbers once: these share what they have.
    """
    loads: list[BallLoads | InputError | None] = [None] * len(screws)
    kinds: dict[Any, tuple[NutCase, dict[bytes, list[int]]]] = {}
    for place, (screw, load) in enumerate(zip(screws, axial_loads, strict=True)):
        nut: Any = screw.nut
        try:
            bodies = nut.bodies.sized(screw)
            raise_if_any(_faults(screw, nut.halves, None))
        except InputError as error:
            loads[place] = error
            continue
        case = _case(screw, nut, bodies, None, False, False)
        numbers = np.array(_numbers(screw, nut, _rigid_nut(screw, nut, as_array(load)), bodies), dtype=float)
        _, alike = kinds.setdefault(case[: NutCase._fields.index("excess")], (case, {}))
        alike.setdefault(numbers.tobytes(), []).append(place)
    for case, alike in kinds.values():
        flat = [*np.frombuffer(b"".join(alike)).reshape(len(alike), -1).T.copy()]
        together = _at_points(case, _Points(flat, len(alike), slice(None), (len(alike),)))
        for number, places in enumerate(alike.values()):
            one = together.at(number)
            for place in places:
                loads[place] = one
    return [one for one in loads if one is not None]


def _rigid_nut(screw: BallScrew, nut: Nut, axial_load: Force) -> RigidNut:
    """The nut as it is between rigid bodies."""
    return RigidNut(
        load=axial_load,
        preload=as_array(preload_of_rigid_bodies(screw, nut)),
        contact_angle=screw.contact_angle,
        lead_cosine=namespace(screw.lead_angle).cos(screw.lead_angle),
        centre_distance=rigidity.groove_centre_distance(
            screw.screw_conformity, screw.nut_conformity, screw.ball_diameter
        ),
        load_deflection=pair_load_deflection(screw),
        loaded_balls=screw.carrying_balls,
    )


def _alike(nut: Nut, point: RigidNut, constant_angle: bool) -> BallLoads:
    """Rigid bodies, and all balls of a kind alike."""
    halves, oversize = nut.halves, isinstance(nut, OversizeBallNut)

    def solve(*numbers: Any) -> RigidLoads:
        return rigid_loads(RigidNut(*numbers), halves=halves, oversize=oversize, constant_angle=constant_angle)

    forward, backward, forward_angle, backward_angle, *of_nut = in_blocks(solve, *map(as_array, point))
    if halves == 2:
        kinds = (
            KindLoads(point.loaded_balls, forward, 0.0, forward_angle, 0.0),
            KindLoads(point.loaded_balls, 0.0, backward, 0.0, backward_angle),
        )
    else:
        kinds = (KindLoads(point.loaded_balls, forward, backward, forward_angle, backward_angle),)
    return BallLoads(kinds=kinds, one_by_one=False, **dict(zip(_OF_NUT, of_nut, strict=True)))


def _one_by_one(
    screw: BallScrew,
    nut: Nut,
    point: RigidNut,
    bodies: Bodies | None,
    deviations: Deviations | None,
    constant_angle: bool,
    compiled: bool,
) -> BallLoads:
    """Each ball for itself, in blocks of operating points."""
    if deviations is not None:
        deviations = Deviations(*(si_value(f"deviations.{n}", v, "m") for n, v in deviations._asdict().items()))
    raise_if_any(_faults(screw, nut.halves, deviations))
    points = _points(_numbers(screw, nut, point, bodies), compiled)
    return _at_points(_case(screw, nut, bodies, deviations, constant_angle, compiled), points)


def _at_points(case: NutCase, points: _Points) -> BallLoads:
    """The loads of nuts that have the same balls, at some points."""
    solution = _solution(solved, case, points)
    by_ball = [points.all_of(np.moveaxis(part, 0, -1)) for part in solution[:4]]
    plain = (points.all_of(part)[()] for part in solution[4:])
    of_nut: dict[str, Any] = dict(zip(_OF_NUT, plain, strict=True))
    if case.elastic and (case.halves == 2 or case.oversize):
        of_nut["lift_off"] = LiftOff(case, points, of_nut["lift_off"])
    kind = KindLoads(np.ones_like(by_ball[0]), *by_ball)
    return BallLoads(kinds=(kind,), one_by_one=True, **of_nut)


def _case(
    screw: BallScrew,
    nut: Nut,
    bodies: Bodies | None,
    deviations: Deviations | None,
    constant_angle: bool,
    compiled: bool,
) -> NutCase:
    """Values that all operating points have in common."""
    balls = int(screw.carrying_balls)
    return NutCase(
        balls=balls,
        halves=nut.halves,
        oversize=isinstance(nut, OversizeBallNut),
        elastic=bodies is not None,
        swells=bodies is not None and bodies.swelling,
        same_side=bodies is None or bodies.same_side,
        constant_angle=constant_angle,
        scatters=deviations is not None,
        excess=_by_ball(deviations.ball_diameter if deviations else 0.0, nut.halves * balls),
        lead_error=_by_ball(deviations.lead if deviations else 0.0, nut.halves * balls),
        compiled=compiled,
    )


def _numbers(screw: BallScrew, nut: Nut, point: RigidNut, bodies: Bodies | None) -> list[Any]:
    """The numbers of a :class:`~ballscrew.physics.solvers.elastic_ball_loads.NutPoint`, each of a shape of its own."""
    oversize = getattr(nut, "oversize", None)
    return [
        *point,
        getattr(nut, "spacing", 0.0),
        *body_stiffness(screw, bodies),
        np.inf if bodies is None or not bodies.swelling else radial_stiffness(screw, bodies),
        np.nan if oversize is None else oversize,
    ]


@dataclasses.dataclass(frozen=True, eq=False)
class _Points:
    """Operating points to be solved, and where those that were asked for are among them."""

    #: By number of a point; one value where all have it.
    numbers: list[Field]
    #: The first so many are asked for; those behind them are there for the order of sums.
    count: int
    #: The place of each point that was asked for, and the shape of all of them.
    places: Any
    shape: tuple[int, ...]

    def all_of(self, part: Field) -> Field:
        """A result for all points that were asked for; further axes come last."""
        return part[self.places].reshape((*self.shape, *part.shape[1:]))

    def at(self, places: Any) -> _Points:
        """Some of the points that were asked for; of a single one no others are solved."""
        chosen = np.arange(self.count)[self.places].reshape(self.shape)[places]
        if np.ndim(chosen):
            return dataclasses.replace(self, places=chosen.reshape(-1), shape=chosen.shape)
        return _Points([n if n.size == 1 else n[chosen, None] for n in self.numbers], 1, slice(None), ())


def _points(numbers: Sequence[Any], compiled: bool) -> _Points:
    """The operating points of numbers that broadcast."""
    shape = np.broadcast_shapes(*(np.shape(number) for number in numbers))
    flat = [np.broadcast_to(np.asarray(number, dtype=float), shape).reshape(-1) for number in numbers]
    load_varies_alone = not any(np.ndim(number) for number in numbers[1:])
    places: Any = slice(None)
    if flat[0].size > 1 and load_varies_alone:
        # each distinct one is solved once, a single one as two, so that sums have one order
        distinct, places = np.unique(flat[0], return_inverse=True)
        distinct = np.resize(distinct, max(distinct.size, FEWEST_POINTS))
        flat = [distinct, *(np.broadcast_to(each[:1], distinct.shape) for each in flat[1:])]
    count = flat[0].size
    if compiled:
        # where the load alone varies, the rest is worked out once; a single point is two, so that sums have one order
        if load_varies_alone:
            flat = [flat[0], *(each[:1] for each in flat[1:])]
        flat[0] = np.resize(flat[0], max(count, FEWEST_POINTS))
    return _Points(flat, count, places, shape)


def _solution(solve_block: Callable[..., tuple[Field, ...]], case: NutCase, points: _Points) -> list[Field]:
    """The results of a solver at the points, the ball axis first; NaN for a preload below zero, which has none."""
    load, preload, *_ = points.numbers
    # who asks for kernels comes block by block, with threads of its own
    size = load.size if case.compiled else max(1, BLOCK // (case.halves * case.balls))
    parts: list[Any] = [None] * -(-load.size // size)

    def solve(block: slice) -> None:
        alone = block.stop - block.start == 1 and block.start > 0  # with one before it, sums have one order
        here = slice(block.start - alone, block.stop)
        with np.errstate(all="ignore"):
            result = solve_block(case, *(n if n.size == 1 else n[here] for n in points.numbers))
        parts[block.start // size] = [part[..., 1:] for part in result] if alone else result

    map_blocks(solve, load.size, block_size=size)
    joined = parts[0] if len(parts) == 1 else [np.concatenate(part, axis=-1) for part in zip(*parts, strict=True)]
    joined = [np.broadcast_to(part, (*part.shape[:-1], load.size))[..., : points.count] for part in joined]
    meaningless = (np.isnan(load) | ~(preload >= 0))[: points.count]
    return [np.where(meaningless, np.nan, part) for part in joined] if np.any(meaningless) else joined


def preload_of(screw: BallScrew, nut: Nut) -> Force:
    """The axial preload of a nut: given, or that of balls whose oversize is given; zero without.

    Bodies that swell take a part of a given oversize; their preload is what is left on either flank without load.
    """
    bodies = nut.bodies
    if getattr(nut, "oversize", None) is None or bodies is None or not bodies.swelling:
        return preload_of_rigid_bodies(screw, nut)
    return ball_loads(screw, nut, 0.0, bodies=bodies.sized(screw)).remaining_preload


def preload_of_rigid_bodies(screw: BallScrew, nut: Nut) -> Force:
    r"""The axial preload of a nut between bodies that do not give way.

    .. math:: F_{pr} = z K \delta_w^{3/2} (\sin\alpha) (\cos\varphi)

    The oversize is the approach of a ball on each pair of flanks, at the contact angle without load.
    """
    oversize = getattr(nut, "oversize", None)
    if oversize is None:
        return getattr(nut, "preload", 0.0)
    xp = namespace(oversize, screw.contact_angle, screw.lead_angle)
    K = pair_load_deflection(screw)
    axial = xp.sin(screw.contact_angle) * xp.cos(screw.lead_angle)
    return screw.carrying_balls * K * oversize * xp.sqrt(oversize) * axial


def preload_growth(screw: BallScrew, preload: Force, bodies: Bodies | None = None) -> float:
    r"""The share by which the preload of oversize balls grows with their oversize, 1/m, at a preload.

    .. math:: \frac{1}{F_{pr}} \frac{dF_{pr}}{d\delta_w} =
        \frac{1}{\frac{2}{3} \delta_b + 2 F_{pr} \cos\alpha / (k_r \tan\alpha \cos\varphi)}

    The approach of a ball is :math:`\delta_b`, see :func:`preload_of_rigid_bodies`; the other part of the oversize
    widens bodies of the radial stiffness :math:`k_r`.
    """
    alpha, c_phi = screw.contact_angle, math.cos(screw.lead_angle)
    of_balls = (preload / (screw.carrying_balls * pair_load_deflection(screw) * math.sin(alpha) * c_phi)) ** (2 / 3)
    of_bodies = 0.0
    if bodies is not None and bodies.swelling:
        k_r = radial_stiffness(screw, bodies.sized(screw))
        of_bodies = 2 * preload * math.cos(alpha) / (k_r * math.tan(alpha) * c_phi)
    return float(1 / (2 / 3 * of_balls + of_bodies))


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
    return rigidity.series_load_deflection(on_screw, on_nut)


def _load_deflection(screw: BallScrew, raceway: Raceway, rolling_radius: Length) -> LoadDeflection:
    k = geometry.radii_ratio(geometry.transverse_radius(screw.ball_diameter, raceway.conformity), rolling_radius)
    kappa = hertz.ellipticity(k)
    integrals = hertz.elliptic_integrals(kappa)
    coefficient = hertz.approach_coefficient(k, kappa, integrals.K, integrals.E)
    return rigidity.contact_load_deflection(coefficient, screw.equivalent_modulus(raceway), rolling_radius)


def body_stiffness(screw: BallScrew, bodies: Bodies | None) -> tuple[Any, Any, Any]:
    """Stiffness per length of screw and nut (E A), and the axial distance of balls that carry, one after the other."""
    step = _step(screw)
    if bodies is None:
        return np.inf, np.inf, step
    whole: Any = bodies.sized(screw)
    core = np.pi / 4 * whole.screw_diameter**2
    tube = np.pi / 4 * (whole.nut_outer_diameter**2 - whole.nut_inner_diameter**2)
    return screw.screw_material.young_modulus * core, screw.nut_material.young_modulus * tube, step


def radial_stiffness(screw: BallScrew, bodies: Bodies) -> Stiffness:
    """Radial force of the balls of one nut body over the gap that it opens between nut and screw."""
    whole: Any = bodies.sized(screw)
    nut, shaft = screw.nut_material, screw.screw_material
    inside = rigidity.nut_force_diameter(screw.pitch_circle_diameter, screw.ball_diameter, screw.contact_angle)
    compliance = rigidity.radial_compliance(
        whole.nut_outer_diameter,
        inside,
        nut.young_modulus,
        nut.poisson_ratio,
        shaft.young_modulus,
        shaft.poisson_ratio,
    )
    return rigidity.radial_stiffness(compliance, screw.carrying_balls * _step(screw))


class ElasticNutNumbers(NamedTuple):
    """Numbers that the loads of balls between elastic bodies depend on besides load and preload, SI.

    The order is that of the structure in ``data/exports/ballscrew_loads.h``, behind its whole numbers.
    """

    #: Of a ball between screw and nut, N/m^1.5.
    load_deflection: LoadDeflection
    centre_distance: Length
    contact_angle: Angle
    lead_cosine: Ratio
    #: Axial distance from ball to ball, and between the halves.
    step: Length
    spacing: Length
    #: Stiffness times length of both bodies in series, N.
    link: Force
    #: Share of the load that enters at the first ball.
    first_share: Ratio
    #: Zero of bodies that do not swell.
    radial_stiffness: Stiffness


def elastic_nut_numbers(screw: BallScrew, nut: Nut, bodies: Bodies) -> ElasticNutNumbers:
    """The numbers of a nut and its bodies for a solver of its balls; elementwise, so that they can be recorded.

    Raises :class:`~ballscrew.basis.errors.InputError` for a nut that swells and has no wall around its balls.
    """
    screw_bar, nut_bar, step = body_stiffness(screw, bodies)
    link = 1 / (1 / screw_bar + 1 / nut_bar)
    return ElasticNutNumbers(
        load_deflection=pair_load_deflection(screw),
        centre_distance=rigidity.groove_centre_distance(
            screw.screw_conformity, screw.nut_conformity, screw.ball_diameter
        ),
        contact_angle=screw.contact_angle,
        lead_cosine=namespace(screw.lead_angle).cos(screw.lead_angle),
        step=step,
        spacing=getattr(nut, "spacing", 0.0),
        link=link,
        first_share=1.0 if bodies.same_side else link / screw_bar,
        radial_stiffness=radial_stiffness(screw, bodies) if bodies.swelling else 0.0,
    )


def _step(screw: BallScrew) -> Length:
    """Axial distance of balls that carry; they touch their neighbours, which may be spacer balls."""
    places = 2 if screw.nut.spacer_balls else 1
    return places * screw.ball_diameter * np.sin(screw.lead_angle) / screw.starts


def _by_ball(deviation: Any, balls: int) -> Field:
    return np.broadcast_to(np.asarray(deviation, dtype=float), (balls,))[:, None]


def _faults(screw: BallScrew, halves: int, deviations: Deviations | None) -> list[Fault]:
    if not is_concrete(screw.loaded_balls):
        remedy = "solve screws with different numbers of balls one after the other"
        return [Fault("screw.loaded_balls", "must be one number where balls differ", "an array", remedy)]
    if screw.carrying_balls > MOST_BALLS:
        remedy = f"{MOST_BALLS} at most where balls differ or bodies are elastic"
        return [Fault("screw.loaded_balls", "too many to solve one by one", f"{screw.loaded_balls:g}", remedy)]
    balls = halves * int(screw.carrying_balls)
    sizes = {} if deviations is None else {name: np.shape(value) for name, value in deviations._asdict().items()}
    return [
        Fault(f"deviations.{name}", "must be one number or one for each ball", f"shape {size}", f"give {balls}")
        for name, size in sizes.items()
        if size not in ((), (balls,))
    ]
