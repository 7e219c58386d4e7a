"""The friction models of control engineering and their parameters, fitted to the friction after a reversal.

A part of the friction follows the direction at once; the rest winds up over the angle of the screw, and this is what
Dahl, LuGre and Maxwell-slip elements describe. As friction comes back in two ranges of the
angle a hundred times apart, no single stiffness holds both: Dahl is fitted to each of them, and both are given.

Balls in their contacts have no such memory: bristles that roll in are fresh, and short strokes stay on the line of the
grooves, where the spin has all that the contacts can hold. So no Maxwell-slip elements have both the curve after a
reversal and the work of short strokes; they are fitted to both, and how far off they are of each is given.
"""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Callable, Sequence
from typing import Annotated, Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy import optimize

from ballscrew.basis.errors import Fault, raise_if_any
from ballscrew.basis.quantities import (
    Angle,
    AngularSpeed,
    Array,
    Info,
    Length,
    MomentOfInertia,
    Ratio,
    RotationalDamping,
    RotationalStiffness,
    Torque,
)
from ballscrew.physics.equations import presliding
from ballscrew.physics.moving_balls.reversal import Loop, Reversal

Vector: TypeAlias = NDArray[np.float64]

#: The parts of a reversal that wind up within the contacts and across the grooves, and do not jump at its start.
SLIP = ("spin_and_curvature", "helix")
#: The first range of the angle, rad: within it the contacts themselves wind up.
FIRST_RANGE = math.radians(0.02)
#: Angles at least, beside the start, that the first range is fitted to.
_FEWEST = 3
#: Share of the swing at which a reversal counts as over.
SETTLED = 0.98
#: Damping ratio of an inertia on the bristles of LuGre, that of the example of CanudasDeWit1995.
DAMPING_RATIO = 0.5
#: Maxwell-slip elements at most.
MOST_ELEMENTS = 4
#: Angles at which elements may begin to slide, among which the best are searched; they are refined after that.
_CANDIDATES = 36
#: Error, as a share of the Coulomb torque, that no further element is worth.
_NOTHING = 1e-6
#: Stiffnesses of Dahl among which the best is searched, a decade.
_PER_DECADE = 12


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class WindingUp:
    """Friction that winds up over the angle of the screw after a reversal, or from rest.

    ``torque`` goes to ``coulomb_torque``, from its opposite or from zero, and what follows the direction ``at_once`` is
    beside it. ``loops`` have the work of short strokes to and fro, where it is known. Raises
    :class:`~ballscrew.basis.errors.InputError` where it is no such curve.
    """

    screw_angle: Annotated[Angle, Info(r"\theta", "angle of the screw since the reversal, increasing from zero")]
    travel: Annotated[Length, Info("x", "travel of the nut since the reversal")]
    torque: Annotated[Torque, Info("M", "friction torque that winds up, against the new direction")]
    coulomb_torque: Annotated[Torque, Info("M_c", "friction torque that winds up, in steady motion", above=0)]
    at_once: Annotated[Torque, Info("M_v", "friction torque that follows the direction at once")] = 0.0
    from_rest: bool = False
    loops: Sequence[Loop] = ()

    def __post_init__(self) -> None:
        angle, travel, torque = (np.asarray(one, dtype=float) for one in (self.screw_angle, self.travel, self.torque))
        faults: list[Fault] = []
        if not float(self.coulomb_torque) > 0:
            problem = "must be above zero: nothing winds up"
            faults.append(
                Fault("winding_up.coulomb_torque", problem, f"{self.coulomb_torque}", "take a model with slip")
            )
        if angle.ndim != 1 or angle.size < 4 or angle.shape != torque.shape or angle.shape != travel.shape:
            remedy = "give as many angles, travels and torques, four or more"
            faults.append(Fault("winding_up.screw_angle", "is no curve", f"{angle.size} angles", remedy))
        elif angle[0] < 0 or not np.all(np.diff(angle) > 0) or not np.isfinite([*angle, *torque, *travel]).all():
            faults.append(
                Fault("winding_up.screw_angle", "must increase from zero", "", "give finite numbers in order")
            )
        raise_if_any(faults)

    @classmethod
    def of(cls, reversal: Reversal, loops: Sequence[Loop] = ()) -> WindingUp:
        """The part of a reversal that winds up, with the ``loops`` of the same balls.

        What follows the direction at once is the jump at the start, of which a reversal has twice as much as a start
        from rest: rolling, losses, and half of what the balls press on each other with, as they part at once and press
        again once their gap has closed.
        """
        parts = {name: np.asarray(part, dtype=float) for name, part in reversal.contributions.items()}
        angle, whole = np.asarray(reversal.screw_angle, dtype=float), np.asarray(reversal.screw_torque, dtype=float)
        others = sum((part for name, part in parts.items() if name not in SLIP), np.zeros(angle.shape))
        before, share = (0.0, 1.0) if reversal.from_rest else (-1.0, 0.5)
        at_once = share * float(others[1] - others[0])
        return cls(
            screw_angle=angle,
            travel=reversal.travel,
            torque=whole - at_once * np.where(angle > 0, 1.0, before),
            coulomb_torque=float(reversal.steady_torque) - at_once,
            at_once=at_once,
            from_rest=reversal.from_rest,
            loops=loops,
        )

    @property
    def steady_torque(self) -> Annotated[Torque, Info("M_{ss}", "friction torque of steady motion")]:
        """All friction of steady motion."""
        return self.coulomb_torque + self.at_once

    @property
    def initial_torque(self) -> Annotated[Torque, Info("M_0", "friction torque that is wound up at the start")]:
        """Minus the Coulomb torque after a reversal, zero from rest."""
        return 0.0 if self.from_rest else -self.coulomb_torque

    @property
    def share_of_swing(self) -> Ratio:
        """Share of the way from its start to its steady value that the torque has come."""
        return (np.asarray(self.torque) - self.initial_torque) / (self.coulomb_torque - self.initial_torque)


@dataclasses.dataclass(frozen=True, kw_only=True)
class FitError:
    """Distance of a fitted model from the curve, as shares of the steady torque."""

    largest: Annotated[Ratio, Info("", "largest error over the whole curve, share of the steady torque")]
    rms: Annotated[
        Ratio, Info("", "root-mean-square error over the travel to 98 % of the swing, share of the steady torque")
    ]


@dataclasses.dataclass(frozen=True, kw_only=True)
class Dahl:
    """The model of Dahl, with the exponent one."""

    presliding_stiffness: Annotated[RotationalStiffness, Info(r"\sigma_0", "stiffness of the bristles", above=0)]
    coulomb_torque: Annotated[Torque, Info("M_c", "friction torque that winds up, in steady motion", above=0)]

    def torque(self, screw_angle: Angle, initial_torque: Torque) -> Torque:
        """Torque that is wound up after an angle, :func:`~ballscrew.physics.equations.presliding.dahl_torque`."""
        return presliding.dahl_torque(self.presliding_stiffness, self.coulomb_torque, initial_torque, screw_angle)


@dataclasses.dataclass(frozen=True, kw_only=True)
class LuGre:
    """The model LuGre at the speed of a reversal: its bristles, their damping, and what is viscous.

    What the bristles hold does not depend on the speed here: the falling part of the friction over the speed is that of
    the steady torque of the screw, which a sweep over the speed has.
    """

    presliding_stiffness: Annotated[RotationalStiffness, Info(r"\sigma_0", "stiffness of the bristles", above=0)]
    coulomb_torque: Annotated[Torque, Info("M_c", "friction torque that the bristles hold in steady motion", above=0)]
    micro_damping: Annotated[
        RotationalDamping, Info(r"\sigma_1", "damping of the bristles, a choice; zero where no inertia is given")
    ]
    viscous_slope: Annotated[RotationalDamping, Info(r"\sigma_2", "slope of the friction torque over the speed")]
    dry_torque: Annotated[
        Torque, Info("M_d", "friction torque that follows the direction at once and is not viscous, beside the model")
    ]

    def torque(self, screw_angle: Angle, initial_torque: Torque, screw_speed: AngularSpeed) -> Torque:
        """Torque after an angle at a steady speed,
        :func:`~ballscrew.physics.equations.presliding.lugre_torque`.
        """
        sigma_0, M_c = self.presliding_stiffness, self.coulomb_torque
        wound = presliding.dahl_torque(sigma_0, M_c, initial_torque, screw_angle)
        return (
            presliding.lugre_torque(wound, M_c, self.micro_damping, self.viscous_slope, screw_speed) + self.dry_torque
        )


@dataclasses.dataclass(frozen=True, kw_only=True)
class SlipElement:
    """A Maxwell-slip element: a spring in series with a block that slides."""

    stiffness: Annotated[RotationalStiffness, Info("k_i", "stiffness of an element", above=0)]
    slip_torque: Annotated[Torque, Info("M_i", "torque at which an element slides", above=0)]

    @property
    def slip_angle(self) -> Annotated[Angle, Info(r"\theta_i", "angle from rest at which an element slides", "deg")]:
        """Angle from rest at which it slides; after a reversal it is twice as far."""
        return self.slip_torque / self.stiffness


@dataclasses.dataclass(frozen=True, kw_only=True)
class DahlFit:
    """The model of Dahl fitted to a reversal."""

    #: The fitted model.
    model: Dahl
    #: How far it is from the curve.
    error: FitError


@dataclasses.dataclass(frozen=True, kw_only=True)
class LuGreFit:
    """The model LuGre fitted to a reversal."""

    #: The fitted model.
    model: LuGre
    #: How far it is from the curve.
    error: FitError


class FittedLoop(NamedTuple):
    """The work of a stroke to and fro by fitted elements, beside that by the balls."""

    stroke: Annotated[Angle, Info(r"\theta", "angle of the screw from one turning point to the other", "deg")]
    work_share: Annotated[Ratio, Info("", "friction work over that of steady friction on the same way, by the balls")]
    work_ratio: Annotated[
        Ratio, Info("", "friction work by the elements, with what is at once, over that by the balls")
    ]


@dataclasses.dataclass(frozen=True, kw_only=True)
class SlipElementsFit:
    """Maxwell-slip elements fitted to a reversal, the one that slides first at the front."""

    #: The fitted elements.
    elements: Sequence[SlipElement]
    #: How far their sum is from the curve.
    error: FitError
    #: What they lose on short strokes; empty where the curve has no loops.
    loops: Sequence[FittedLoop] = ()

    @property
    def work_error(self) -> Annotated[Ratio, Info("", "largest error of the friction work of the loops, share of it")]:
        """NaN without loops."""
        return max((abs(loop.work_ratio - 1) for loop in self.loops), default=math.nan)


def fit_dahl(curve: WindingUp) -> DahlFit:
    """The model of Dahl for tracking: the stiffness with the least squares over the travel.

    Travel that the curve spends in the first hundredths of a degree hardly counts. For a return path in two ranges it
    is the stiffness of the long one, and the jump of the short one is its largest error.
    """
    return _fitted_dahl(curve, _steps(np.asarray(curve.travel, dtype=float)))


def fit_dahl_first(curve: WindingUp) -> DahlFit | None:
    """The model of Dahl for the first 0.02° alone, by least squares over the angle; its error is over the whole curve.

    None where the curve has less than three angles there.
    """
    angle = np.asarray(curve.screw_angle, dtype=float)
    here = angle <= FIRST_RANGE * (1 + 1e-9)
    if np.count_nonzero(here & (angle > 0)) < _FEWEST:
        return None
    return _fitted_dahl(curve, np.where(here, _steps(np.where(here, angle, angle[here][-1])), 0.0))


def fit_lugre(
    curve: WindingUp,
    *,
    screw_speed: AngularSpeed,
    viscous_slope: RotationalDamping = 0.0,
    moment_of_inertia: MomentOfInertia | None = None,
    damping_ratio: Ratio = DAMPING_RATIO,
) -> LuGreFit:
    r"""The model LuGre for tracking, at the ``screw_speed`` of the curve (rad/s).

    At a slow steady speed its bristles have the torque of Dahl, so :math:`\sigma_0` and the error are those of
    :func:`fit_dahl`. :math:`\sigma_2` is the ``viscous_slope`` (N m s/rad), which one curve at one speed does not tell:
    that of the steady torque over the speed. What else follows the direction at once is its ``dry_torque``.
    :math:`\sigma_1` cannot be seen in a slow reversal either. With a ``moment_of_inertia`` (kg m²) of everything that
    turns with the screw it is chosen so that this swings on the bristles with the ``damping_ratio``; without one it is
    zero, which is a value and no finding. It acts while the bristles wind up: where :math:`\sigma_1 \omega` comes near
    :math:`M_c` it is far too much, and users of the model let it fade with the speed.
    """
    dahl = fit_dahl(curve)
    sigma_0 = dahl.model.presliding_stiffness
    sigma_1 = 0.0 if moment_of_inertia is None else presliding.micro_damping(sigma_0, moment_of_inertia, damping_ratio)
    model = LuGre(
        presliding_stiffness=sigma_0,
        coulomb_torque=dahl.model.coulomb_torque,
        micro_damping=float(sigma_1),
        viscous_slope=viscous_slope,
        dry_torque=curve.at_once - viscous_slope * abs(float(screw_speed)),
    )
    return LuGreFit(model=model, error=dahl.error)


def fit_slip_elements(curve: WindingUp, count: int) -> SlipElementsFit:
    r"""Maxwell-slip elements, ``count`` of them at most (1 to 4), of which each share of the swing counts alike.

    Least squares with :math:`M_i \ge 0` and :math:`\sum M_i = M_c`. Where the curve has loops, the mean error of the
    torque along these, their work over their way, counts as much as that along the curve. For given angles at which the
    elements slide the torques follow exactly; the angles are searched among some dozens and then refined. No
    more elements are made than hold both.

    Raises :class:`~ballscrew.basis.errors.InputError` for another number of elements.
    """
    if not 1 <= count <= MOST_ELEMENTS:
        raise_if_any([Fault("fit_slip_elements.count", "must be 1 to 4", f"{count}", "two hold both ranges")])
    angle, torque = (np.asarray(one, dtype=float) for one in (curve.screw_angle, curve.torque))
    # a curve that falls for a while, as gaps that close may make it, counts there as well
    M_c = curve.coulomb_torque
    strokes, work = (np.array([getattr(loop, name) for loop in curve.loops]) for name in ("stroke", "work_share"))
    problem = _Shares(
        angle,
        torque / M_c,
        np.abs(_steps(torque)) / M_c,
        curve.initial_torque / M_c,
        strokes,
        (work * curve.steady_torque - curve.at_once) / M_c,
    )
    angles, shares = problem.solved(count)
    swing = 1 - problem.start
    elements = [
        SlipElement(stiffness=swing * share * M_c / slides, slip_torque=share * M_c)
        for slides, share in sorted(zip(angles.tolist(), shares.tolist(), strict=True))
        if share > 0
    ]
    loops = tuple(
        FittedLoop(
            loop.stroke, loop.work_share, work_share(elements, loop.stroke, at_once=curve.at_once) / loop.work_share
        )
        for loop in curve.loops
    )
    return SlipElementsFit(elements=tuple(elements), error=error_of(curve, of_elements(elements, curve)), loops=loops)


def gms_torque(elements: Sequence[SlipElement], screw_angles: Array, *, initial_torques: Array | None = None) -> Array:
    r"""Torque of Maxwell-slip elements along any path of the angle, N m, one value for each angle.

    ``elements`` are those of :func:`fit_slip_elements`, or of any other source; ``screw_angles`` (rad) are the places
    in their order, between which the angle does not turn back; ``initial_torques`` are those of the elements at the
    first place, zero without any: nothing is wound up. The path may have steps of any size, as each element is exact
    (:func:`~ballscrew.physics.equations.presliding.slip_element_torque`). Its loops close, and it has the memory
    of all turning points that no larger one has wiped out. What follows the direction at once comes on top.

    Raises :class:`~ballscrew.basis.errors.InputError` for as many initial torques as there are no elements, or beyond
    those at which they slide.
    """
    k, M_s = (np.array([getattr(one, name) for one in elements]) for name in ("stiffness", "slip_torque"))
    held = np.zeros(len(k)) if initial_torques is None else np.asarray(initial_torques, dtype=float)
    if held.shape != k.shape or np.any(np.abs(held) > M_s * (1 + 1e-12)):
        remedy = "give one for each element, within the torque at which it slides"
        raise_if_any([Fault("gms_torque.initial_torques", "do not fit the elements", f"{initial_torques}", remedy)])
    angles = np.asarray(screw_angles, dtype=float)
    values = np.empty(angles.shape)
    for i, turned in enumerate(np.diff(angles, prepend=angles[:1])):
        held = presliding.slip_element_torque(k, M_s, held, turned)
        values[i] = held.sum()
    return values


def work_share(elements: Sequence[SlipElement], stroke: Angle, *, at_once: Torque = 0.0) -> Ratio:
    r"""Friction work of a stroke to and fro over that of steady friction on the same way, 0 to 1.

    .. math:: \frac{W}{W_{ss}} = \frac{M_v + \sum_i M_i \max(1 - 2 M_i / (k_i \theta), 0)}{M_v + \sum_i M_i}

    ``stroke`` is the angle :math:`\theta` of the screw from one turning point to the other (rad), and ``at_once`` the
    torque :math:`M_v` that follows the direction at once (N m). Once the loop closes, each of the ``elements`` slides
    on what is left of the way after it has swung from one end to the other, :math:`2 M_i / k_i`: the area within the
    loop of :func:`gms_torque`.

    Raises :class:`~ballscrew.basis.errors.InputError` for a stroke that is not above zero.
    """
    if not float(stroke) > 0:
        raise_if_any([Fault("work_share.stroke", "must be above zero", f"{stroke}", "give the angle of the screw")])
    k, M_s = (np.array([getattr(one, name) for one in elements], dtype=float) for name in ("stiffness", "slip_torque"))
    lost = float(np.sum(M_s * np.maximum(1 - 2 * M_s / (k * stroke), 0)))
    return (at_once + lost) / (at_once + float(M_s.sum()))


def _steps(values: Vector) -> Vector:
    """Half the distance of the neighbours of each value: the weights of a sum over them."""
    return np.diff(values, prepend=values[:1]) / 2 + np.diff(values, append=values[-1:]) / 2


def error_of(curve: WindingUp, fitted: Vector) -> FitError:
    """Error of a torque at the angles of a curve, N m, without what follows the direction at once."""
    off = np.abs(fitted - np.asarray(curve.torque)) / curve.steady_torque
    travel = np.asarray(curve.travel, dtype=float)
    settled = np.flatnonzero(np.asarray(curve.share_of_swing) >= SETTLED)
    end = int(settled[0]) + 1 if settled.size else off.size
    weights = _steps(travel[: max(end, 2)])
    squares = off[: max(end, 2)] ** 2
    return FitError(largest=float(off.max()), rms=math.sqrt(float(weights @ squares / weights.sum())))


def _fitted_dahl(curve: WindingUp, weights: Vector) -> DahlFit:
    """The stiffness with the least weighted squares: the best of a fine grid, refined."""
    angle, torque, M_c = np.asarray(curve.screw_angle, dtype=float), np.asarray(curve.torque), curve.coulomb_torque

    def squares(logarithm: float) -> float:
        off = presliding.dahl_torque(math.exp(logarithm), M_c, curve.initial_torque, angle) - torque
        return float(weights @ off**2)

    stiffness = math.exp(_minimum(squares, math.log(0.01 * M_c / angle[-1]), math.log(100 * M_c / angle[angle > 0][0])))
    model = Dahl(presliding_stiffness=stiffness, coulomb_torque=M_c)
    return DahlFit(model=model, error=error_of(curve, np.asarray(model.torque(angle, curve.initial_torque))))


def _minimum(function: Callable[[float], float], low: float, high: float) -> float:
    """The lowest place of a function that may have several dips."""
    grid = np.linspace(low, high, max(3, math.ceil((high - low) / math.log(10) * _PER_DECADE)))
    best = int(np.argmin([function(float(one)) for one in grid]))
    ends = float(grid[max(best - 1, 0)]), float(grid[min(best + 1, len(grid) - 1)])
    result: Any = optimize.minimize_scalar(function, bounds=ends, method="bounded", options={"xatol": 1e-10})
    return float(result.x)


def of_elements(elements: Sequence[SlipElement], curve: WindingUp) -> Vector:
    """Torque of elements at the angles of a curve, N m, with its start: slid in the other direction, or from rest."""
    angle = np.asarray(curve.screw_angle, dtype=float)
    share = 0.0 if curve.from_rest else -1.0
    return np.sum(
        [
            presliding.slip_element_torque(one.stiffness, one.slip_torque, share * one.slip_torque, angle)
            for one in elements
        ],
        axis=0,
    )


@dataclasses.dataclass(frozen=True, eq=False)
class _Shares:
    """Shares of the Coulomb torque that slide at given angles: least squares with shares that sum to one."""

    angle: Vector
    #: Torque over the Coulomb torque; it goes from ``start`` to one.
    torque: Vector
    weights: Vector
    start: float
    #: Strokes of loops, and their work over their way, over the Coulomb torque too.
    strokes: Vector
    work: Vector

    def _columns(self, slides: Vector) -> Vector:
        """The torque of an element of share one over the angle, a column for each angle at which one slides."""
        risen = np.minimum(self.angle[:, None] / slides, 1.0)
        return self.start + (1 - self.start) * risen

    def solved(self, count: int) -> tuple[Vector, Vector]:
        """The angles at which the best elements slide, and their shares; as few elements as hold the curve as well."""
        grid = np.geomspace(self.angle[self.angle > 0][0], self.angle[-1], _CANDIDATES)
        products = self._products(grid)
        best, least = grid[:1], math.inf
        for size in range(1, count + 1):
            chosen = np.array(list(itertools.combinations(range(len(grid)), size)))
            _, squares = _least_squares(products[chosen[:, :, None], chosen[:, None, :]])
            if not math.isfinite(squares.min()):  # some shares of so many are negative everywhere
                break
            angles = self._refined(grid[chosen[int(np.argmin(squares))]])
            reached = self._squares(angles)
            if reached < least - _NOTHING**2 * self.weights.sum():
                best, least = angles, reached
        return best, _least_squares(self._products(best))[0]

    def _refined(self, slides: Vector) -> Vector:
        start = np.log(slides)

        def squares(logarithms: Vector) -> float:
            return self._squares(np.exp(logarithms))

        result: Any = optimize.minimize(
            squares,
            start,
            method="Nelder-Mead",
            options={
                "xatol": 1e-10,
                "fatol": math.inf,
                "maxiter": 4000,
                "initial_simplex": np.vstack([start, start + 0.1 * np.eye(len(start))]),
            },
        )
        return np.exp(result.x)

    def _squares(self, slides: Vector) -> float:
        return float(_least_squares(self._products(slides))[1])

    def _products(self, slides: Vector) -> Vector:
        """Weighted products of the errors that elements of share one would have.

        With shares that sum to one, the error of the sum is the sum of the shares times these errors.
        """
        off = self._columns(slides) - self.torque[:, None]
        products = off.T @ (self.weights[:, None] * off)
        if not self.strokes.size:
            return products
        slid = np.maximum(1 - 2 * slides / (1 - self.start) / self.strokes[:, None], 0.0) - self.work[:, None]
        return products + self.weights.sum() / self.strokes.size * (slid.T @ slid)


def _least_squares(products: Vector) -> tuple[Vector, Vector]:
    """Shares that sum to one with the least squares, and these; infinite where a share is negative."""
    count = products.shape[-1]
    bordered = np.ones((*products.shape[:-2], count + 1, count + 1))
    bordered[..., -1, -1] = 0.0
    scale = np.trace(products, axis1=-2, axis2=-1)[..., None, None] / count
    # two elements that slide at one angle are alike
    bordered[..., :count, :count] = products / np.where(scale > 0, scale, 1.0) + 1e-15 * np.eye(count)
    right = np.zeros((*products.shape[:-2], count + 1, 1))
    right[..., -1, 0] = 1.0
    shares: Vector = np.asarray(np.linalg.solve(bordered, right)[..., :count, 0], dtype=float)
    squares = np.einsum("...i,...ij,...j->...", shares, products, shares)
    return shares, np.where(np.all(shares >= 0, axis=-1), squares, math.inf)
