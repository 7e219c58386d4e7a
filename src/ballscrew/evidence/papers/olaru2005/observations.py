"""Numbers of a model for the paper's case, against which its claims are checked."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import equilibrium, friction
from ballscrew.physics.equations.transmission import efficiency
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.contact import RaceState

#: Steps of 1 rpm, then of 0.05 rpm around the smallest torque found.
_FINE_STEP = 0.05


@dataclasses.dataclass(frozen=True)
class Range:
    """Smallest and largest of something."""

    least: float
    most: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class Minimum:
    """The smallest torque over speed, and what the parts of the torque do on both sides of it.

    Speed in rad/s. ``falling`` and ``rising`` hold the change of each part from rest to the
    minimum, and from there to the highest speed, N m.
    """

    speed: float
    torque: float
    torque_at_rest: float
    torque_at_top: float
    falling: Mapping[str, float]
    rising: Mapping[str, float]
    curvature_ratio: float
    friction_ratio: float
    film_parameter: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class Split:
    """Difference of the torques on screw and nut, as a share of the torque on the screw."""

    mean: float
    most: float
    efficiency_shift: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class LoadCurve:
    """Torque and efficiency over the contact load at the paper's fixed speed."""

    torque_rises: bool
    torque_without_load: float
    torque_at_top: float
    exponent_at_20: float
    exponent_at_top: float
    efficiency_without_load: float
    efficiency_at_20: float
    efficiency_rises: bool
    plateau: Range
    skid_limit: float
    efficiency_at_skid_limit: float
    elastic_limit: float
    efficiency_at_elastic_limit: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class Slip:
    """The sliding forces, with and without integrals."""

    force_residual: float
    moment_residual: float
    quadrature_error: float
    effects: Mapping[str, float]
    effects_residual: float
    offset: Range
    traction_residual: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class Coefficient:
    """The friction coefficient of §5."""

    threshold_by_formula: float
    threshold_by_bisection: float
    asperity_at_2_5: float
    asperity_at_3: float
    largest_share_of_boundary: float
    film_share_at_rest: float
    film_share_at_minimum: float
    film_parameter_at_top: float
    film_parameter_thick_oil: float


@dataclasses.dataclass(frozen=True, kw_only=True)
class Observations:
    """Everything the claims need to know about one model."""

    minimum: Minimum
    efficiency: Range
    split_one: Split
    split_two: Split
    load: LoadCurve
    slip: Slip
    coefficient: Coefficient


def observe(model: FrictionModel, screw: BallScrew = case.SCREW, oil: Lubricant = case.OIL) -> Observations:
    """Run the paper's program with a model."""

    def at_speeds(speeds: NDArray[Any], changed: FrictionModel = model, lubricant: Lubricant = oil) -> FrictionResult:
        return changed(screw, lubricant, axial_load=case.AXIAL_LOAD, screw_speed=speeds)

    over_speed = at_speeds(case.SPEEDS)
    minimum = _minimum(at_speeds, over_speed)
    splits = [
        _split(at_speeds(case.SPEEDS, dataclasses.replace(model, ball_to_ball_force=n / screw.loaded_balls)))
        for n in (1, 2)
    ]
    thick = dataclasses.replace(oil, viscosity=float(case.VISCOSITIES[-1]))
    return Observations(
        minimum=minimum,
        efficiency=Range(float(over_speed.efficiency.min()), float(over_speed.efficiency.max())),
        split_one=splits[0],
        split_two=splits[1],
        load=_load_curve(model, screw, oil),
        slip=_slip(over_speed, at_speeds(np.array([case.SCREW_SPEED]))),
        coefficient=_coefficient(model, over_speed, minimum, at_speeds(case.SPEEDS[-1:], lubricant=thick)),
    )


def _parts(result: FrictionResult, index: int) -> dict[str, float]:
    shape = np.shape(result.screw_torque)
    return {name: float(np.broadcast_to(part, shape)[index]) for name, part in result.contributions.items()}


def _minimum(at_speeds: Callable[[NDArray[Any]], FrictionResult], over_speed: FrictionResult) -> Minimum:
    coarse = case.SPEEDS[int(np.argmin(over_speed.screw_torque))] / case.RPM
    fine = np.arange(max(coarse - 1, 0), min(coarse + 1, 1000) + _FINE_STEP / 2, _FINE_STEP) * case.RPM
    speed = fine[int(np.argmin(at_speeds(fine).screw_torque))]
    three = at_speeds(np.array([0.0, speed, case.SPEEDS[-1]]))
    rest, lowest, top = (_parts(three, i) for i in range(3))
    mu = three.screw.friction_coefficient
    return Minimum(
        speed=float(speed),
        torque=float(three.screw_torque[1]),
        torque_at_rest=float(three.screw_torque[0]),
        torque_at_top=float(three.screw_torque[2]),
        falling={name: lowest[name] - rest[name] for name in MECHANISMS},
        rising={name: top[name] - lowest[name] for name in MECHANISMS},
        curvature_ratio=lowest["curvature"] / rest["curvature"],
        friction_ratio=float(mu[1] / mu[0]),
        film_parameter=float(three.screw.film_parameter[1]),
    )


def _split(result: FrictionResult) -> Split:
    apart = np.abs(result.screw_torque - result.nut_torque)
    by_nut = result.ideal_torque / (result.ideal_torque + result.nut_torque)
    share = apart / result.screw_torque
    return Split(
        mean=float(share.mean()),
        most=float(share.max()),
        efficiency_shift=float(np.abs(by_nut - result.efficiency).max()),
    )


def _load_curve(model: FrictionModel, screw: BallScrew, oil: Lubricant) -> LoadCurve:
    def at_loads(loads: NDArray[Any]) -> FrictionResult:
        return model(screw, oil, axial_load=loads, screw_speed=case.SCREW_SPEED)

    # Q is proportional to F in both models
    share = float(at_loads(np.array([1.0])).contact_load[0])
    dividing = case.DIVIDING_CONTACT_LOAD / share
    curve = at_loads(case.LOADS)
    light = at_loads(np.linspace(0.0, dividing, 2001))
    heavy = at_loads(np.linspace(dividing, case.AXIAL_LOAD, 2001))
    limits = {reason: _largest_failing(at_loads, reason, dividing) for reason in ("skid", "elastic_regime")}
    ends = at_loads(np.array([limits["skid"], limits["elastic_regime"]]))
    # by (36) as it is printed, which begins at zero, where a result has none
    eta = efficiency(light.ideal_torque, light.screw_torque)

    def exponent(load: float) -> float:
        pair = at_loads(load * np.array([0.99, 1.0])).screw_torque
        return float(np.log(pair[1] / pair[0]) / -math.log(0.99))

    return LoadCurve(
        torque_rises=bool(np.all(np.diff(curve.screw_torque) > 0)),
        torque_without_load=float(curve.screw_torque[0]),
        torque_at_top=float(curve.screw_torque[-1]),
        exponent_at_20=exponent(dividing),
        exponent_at_top=exponent(case.AXIAL_LOAD),
        efficiency_without_load=float(eta[0]),
        efficiency_at_20=float(eta[-1]),
        efficiency_rises=bool(np.all(np.diff(eta) > 0)),
        plateau=Range(float(heavy.efficiency.min()), float(heavy.efficiency.max())),
        skid_limit=limits["skid"] * share,
        efficiency_at_skid_limit=float(ends.efficiency[0]),
        elastic_limit=limits["elastic_regime"] * share,
        efficiency_at_elastic_limit=float(ends.efficiency[1]),
    )


def _largest_failing(at_loads: Callable[[NDArray[Any]], FrictionResult], reason: str, most: float) -> float:
    """The load below which a condition fails, by scanning and then scanning closer; 0 if it never does."""
    least = 0.0
    for _ in range(3):
        loads = np.linspace(least, most, 1001)
        failing = np.flatnonzero(~at_loads(loads).validity[reason])
        if not failing.size:
            return 0.0
        last = int(failing[-1])
        least, most = float(loads[last]), float(loads[min(last + 1, 1000)])
    return least


def _slip(over_speed: FrictionResult, reference: FrictionResult) -> Slip:
    residuals = [_imbalances(result) for result in (over_speed, reference)]
    sides = (over_speed.screw, over_speed.nut)
    tractions = [side.sliding_force / side.traction_limit for side in sides]
    demanded = [friction.offset_from_traction(np.clip(ratio, -1.0, 1.0)) for ratio in tractions]
    closing = [
        np.abs(ratio - friction.traction_ratio(side.pure_rolling_offset))
        for ratio, side in zip(tractions, sides, strict=True)
    ]
    effects, effects_residual = _effects(reference)
    return Slip(
        force_residual=max(force for force, _ in residuals),
        moment_residual=max(moment for _, moment in residuals),
        quadrature_error=max(_quadrature_error(side) for side in (reference.screw, reference.nut)),
        effects=effects,
        effects_residual=effects_residual,
        offset=Range(min(float(Y.min()) for Y in demanded), max(float(Y.max()) for Y in demanded)),
        traction_residual=max(float(c.max()) for c in closing),
    )


def _contact_moments(result: FrictionResult) -> Any:
    return sum(s.curvature_friction_moment + s.elastic_resistance_moment for s in (result.screw, result.nut))


def _imbalances(result: FrictionResult) -> tuple[float, float]:
    """Net force and moment on the ball, (22) and (23) of §3, in units of the sliding force."""
    s, n, chain, d_w = result.screw, result.nut, result.ball_chain, result.ball_screw.ball_diameter
    force = equilibrium.force_imbalance(
        s.sliding_force,
        n.sliding_force,
        s.hydrodynamic_rolling_force,
        n.hydrodynamic_rolling_force,
        s.pressure_force,
        n.pressure_force,
        chain.braking_force,
    )
    moment = equilibrium.moment_imbalance(
        s.sliding_force,
        n.sliding_force,
        s.hydrodynamic_rolling_force,
        n.hydrodynamic_rolling_force,
        _contact_moments(result),
        chain.moment,
        d_w,
    )
    scale = np.abs(s.sliding_force)
    return float(np.max(np.abs(force) / scale)), float(np.max(np.abs(moment) / (scale * d_w)))


def _effects(result: FrictionResult) -> tuple[dict[str, float], float]:
    """Share of each effect in the sliding force at the screw, and what is left of the force without them."""
    s, n, chain = result.screw, result.nut, result.ball_chain
    whole = {
        "rolling forces": (0.0, 0.0, s.hydrodynamic_rolling_force, n.hydrodynamic_rolling_force, 0.0),
        "curvature": (s.curvature_friction_moment + n.curvature_friction_moment, 0.0, 0.0, 0.0, 0.0),
        "elastic resistance": (s.elastic_resistance_moment + n.elastic_resistance_moment, 0.0, 0.0, 0.0, 0.0),
        "force between balls": (0.0, 0.0, 0.0, 0.0, chain.braking_force),
        "friction between balls": (0.0, chain.moment, 0.0, 0.0, 0.0),
    }
    shares: dict[str, float] = {}
    for name, (moments, ball_moment, F_Rs, F_Rn, F_B) in whole.items():
        part = equilibrium.screw_sliding_force(
            moments, ball_moment, result.ball_screw.ball_diameter, F_Rs, F_Rn, result.frame.curvature_ratio, F_B
        )
        shares[name] = float(np.ravel(part / s.sliding_force)[0])
    return shares, abs(sum(shares.values()) - 1.0)


def _quadrature_error(side: RaceState) -> float:
    """Closed form (15) against the integral (14) over the contact ellipse, relative.

    Friction changes sign at the lines of pure rolling; Gauss–Legendre nodes on both sides of them.
    """
    a, b, p_0, mu, Y, R_d = (
        float(np.ravel(value)[0])
        for value in (
            side.semi_major_axis,
            side.semi_minor_axis,
            side.maximum_pressure,
            side.friction_coefficient,
            side.pure_rolling_offset,
            side.deformed_radius,
        )
    )
    nodes, weights = np.polynomial.legendre.leggauss(12)
    integral = 0.0
    for start, end, sign in ((0.0, Y, -1.0), (Y, 1.0, 1.0)):
        y = a * (start + (end - start) * (nodes + 1) / 2)
        # the half-ellipse of pressure along the rolling direction has this area
        line_load = math.pi / 2 * p_0 * b * (1 - (y / a) ** 2)
        height = y**2 / (2 * R_d)
        integral += 2 * sign * mu * float(np.sum(weights * line_load * height)) * a * (end - start) / 2
    closed = float(np.ravel(side.curvature_friction_moment)[0])
    return abs(integral - closed) / abs(closed)


def _coefficient(
    model: FrictionModel, over_speed: FrictionResult, minimum: Minimum, thick: FrictionResult
) -> Coefficient:
    law: Any = model.friction
    mu_0, mu_f = law.boundary_friction_coefficient, law.full_film_friction_coefficient

    def asperity(film_parameter: Any) -> Any:
        return friction.asperity_friction_coefficient(film_parameter, mu_0, law.decay, law.exponent)

    at_minimum = float(asperity(minimum.film_parameter))
    moving = [side.film_parameter[1:] for side in (over_speed.screw, over_speed.nut)]
    return Coefficient(
        threshold_by_formula=(math.log(mu_0 / mu_f) / law.decay) ** (1 / law.exponent),
        threshold_by_bisection=_bisected(lambda lam: float(asperity(lam)) - mu_f, 0.0, 10.0),
        asperity_at_2_5=float(asperity(2.5)),
        asperity_at_3=float(asperity(3.0)),
        largest_share_of_boundary=max(float(np.max(asperity(lam))) for lam in moving) / mu_0,
        film_share_at_rest=mu_f / mu_0,
        film_share_at_minimum=mu_f / at_minimum if at_minimum > 0 else math.inf,
        film_parameter_at_top=max(float(lam[-1]) for lam in moving),
        film_parameter_thick_oil=max(float(side.film_parameter[-1]) for side in (thick.screw, thick.nut)),
    )


def _bisected(function: Callable[[float], float], low: float, high: float) -> float:
    """Zero of a falling function."""
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if function(middle) > 0 else (low, middle)
    return (low + high) / 2
