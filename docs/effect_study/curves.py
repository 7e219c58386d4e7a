"""Curves of single effects: slip over spin, slip over the contact, rolling laws, load shares, sweeps."""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ballscrew.physics.equations import friction, slip
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.friction.validity import SMALLEST_ELASTIC_REGIME_PARAMETER
from ballscrew.physics.laws.friction import GreenwoodTrippSharing, LoadSharing, RunInSharing
from ballscrew.physics.laws.protocols import RollingLaw
from ballscrew.physics.laws.rolling import aihara_rolling, biboulet_houpert_rolling, houpert_rolling, olaru_rolling
from ballscrew.physics.solvers.line_slip import pure_rolling_lines
from effect_study.cases import DECAYS, PAPER, RPM, Case

Values = NDArray[np.float64]

#: The three models to compare.
MODELS: Mapping[str, FrictionModel] = {
    model.name: model for model in (FrictionModel.olaru2005(), FrictionModel.corrected(), FrictionModel.reference())
}

# -- over spin ------------------------------------------------------------------------------------


class SpinCurves(NamedTuple):
    """Slip on the line without a net force, over the spin parameter; moments relative to their maximum."""

    spin_parameter: Values
    curvature: Values
    spin: Values
    curvature_polynomial: Values
    spin_polynomial: Values
    curvature_power: Values
    spin_power: Values
    #: Spin parameter at which one of the two lines of pure rolling leaves the ellipse.
    one_line_from: float


def spin_curves() -> SpinCurves:
    """Closed forms and polynomials; powers are those of both, in units of that of curvature alone."""
    E_s = np.linspace(0.0, 2.5, 501)
    lines = pure_rolling_lines(E_s, 0.0 * E_s)
    c_C = slip.line_curvature_coefficient(lines.lower, lines.upper)
    f_P = slip.line_spin_coefficient(lines.lower, lines.upper)
    alone = 2 * c_C[0]
    return SpinCurves(
        spin_parameter=E_s,
        curvature=c_C / c_C[0],
        spin=f_P,
        curvature_polynomial=slip.curvature_factor_polynomial(E_s),
        spin_polynomial=slip.spin_factor_polynomial(E_s),
        curvature_power=2 * c_C / alone,
        spin_power=3 / 8 * f_P * E_s / alone,
        one_line_from=float(E_s[~np.asarray(lines.are_two)][0]),
    )


# -- over the contact -----------------------------------------------------------------------------


class SlipPicture(NamedTuple):
    """Slip of race against ball over a contact, m and m/s.

    Positions count along the path of the ball and across it, towards nut normal × path.
    """

    across: Values
    along: Values
    slip_along: Values
    slip_across: Values


def slip_picture(result: FrictionResult, on_screw: bool, across: Values, along: Values) -> SlipPicture:
    """Slip at points of a contact, as the slip law left it; positions in units of the semi-axes."""
    contact = result.screw if on_screw else result.nut
    a, b, R_d = contact.semi_major_axis, contact.semi_minor_axis, contact.deformed_radius
    rotation = contact.motion.entrainment_speed / contact.rolling_radius
    # along the path the screw runs ahead of the ball and the nut stays behind; across it is the other way round
    ahead = 1.0 if on_screw else -1.0
    C, beta = ahead * slip.curvature_slip_speed(a, R_d, rotation), contact.spin * a
    path = slip.path_slip_speed(ahead * contact.creep_speed, beta, C, across, slip.surface_depth(across, a, R_d))
    turned = along * b / a * slip.local_spin_speed(beta, C, across)
    return SlipPicture(a * across, b * along, path + 0 * along, -ahead * contact.lateral_slip_speed - turned)


# -- comparison of laws ---------------------------------------------------------------------------

ROLLING_LAWS: Mapping[str, RollingLaw] = {
    "Biboulet and Houpert 2010": biboulet_houpert_rolling,
    "Houpert 1987": houpert_rolling,
    "Olaru (1)": olaru_rolling,
    "Aihara 1987, rollers": aihara_rolling,
}
#: Laws for elastic contacts only.
ELASTIC_ONLY = ("Houpert 1987", "Olaru (1)", "Aihara 1987, rollers")


class RollingCurves(NamedTuple):
    """Rolling forces (N) at the screw contact by law, without inlet heating, over load (N) or speed (rad/s)."""

    abscissa: Values
    forces: Mapping[str, Values]
    #: Where the contact is nearer the elastic regime than the rigid one.
    elastic: NDArray[np.bool_]


def rolling_over_load() -> RollingCurves:
    """At the paper's screw and speed, over the load of a ball."""
    result = PAPER.result(MODELS["reference"], axial_load=np.geomspace(10.0, 8000.0, 121))
    return _rolling(np.asarray(result.contact_load), result)


def rolling_over_speed() -> RollingCurves:
    """At the paper's screw and load, over the speed."""
    speed = np.geomspace(10.0, 5000.0, 121) * RPM
    return _rolling(speed, PAPER.result(MODELS["reference"], screw_speed=speed))


def _rolling(abscissa: Values, result: FrictionResult) -> RollingCurves:
    contact = result.screw
    forces = {name: np.asarray(law(contact)) for name, law in ROLLING_LAWS.items()}
    elastic = np.asarray(contact.elastic_regime_parameter >= SMALLEST_ELASTIC_REGIME_PARAMETER)
    return RollingCurves(abscissa, forces, elastic)


class ShareCurves(NamedTuple):
    """Load share of the asperities by law, and friction coefficients, over the film parameter."""

    film_parameter: Values
    shares: Mapping[str, Values]
    coefficients: Mapping[str, Values]


def share_curves() -> ShareCurves:
    """Laws of load sharing; Greenwood and Tripp at the paper's screw contact."""
    lam = np.linspace(0.0, 4.0, 401)
    shares = {
        f"Zhou and Hoeprich, B {B:g}, C {C:g}": friction.asperity_load_share_zhou_hoeprich(lam, B, C) for B, C in DECAYS
    }
    at_film = dataclasses.replace(PAPER.result(MODELS["reference"]).screw, film_parameter=lam)
    tripp = GreenwoodTrippSharing(boundary_friction_coefficient=1.0, full_film_friction_coefficient=0.0)
    shares["Bălan 2015, cut at 2"] = friction.asperity_load_share_balan(lam)
    # with one for the asperities and nothing for the film, the coefficient is the share
    shares["Greenwood and Tripp, 1.92 GPa"] = np.asarray(tripp(at_film))
    sharing, printed = LoadSharing(), PAPER_FRICTION
    high = dataclasses.replace(sharing, boundary_friction_coefficient=printed.boundary_friction_coefficient)
    coefficients = {
        "clamped, µ_0 0.2 (the paper)": printed(at_film),
        "shared, µ_0 0.2": high(at_film),
        "shared, µ_0 0.12": sharing(at_film),
        "shared, run in (reference)": RunInSharing()(at_film),
    }
    return ShareCurves(lam, shares, coefficients)


# -- sweeps ---------------------------------------------------------------------------------------


@functools.cache
def over_speed(case: Case) -> tuple[Values, Mapping[str, FrictionResult]]:
    """Speeds (rpm) and the three models there."""
    speed = np.r_[0.0, np.geomspace(1.0, 3000.0, 160)]
    return speed, _each(case, screw_speed=speed * RPM)


@functools.cache
def over_load(case: Case) -> tuple[Values, Mapping[str, FrictionResult]]:
    """Axial loads (N) and the three models there."""
    load = np.linspace(0.005, 2.0, 200) * case.axial_load
    return load, _each(case, axial_load=load)


@functools.cache
def over_light_load(case: Case) -> tuple[Values, Mapping[str, FrictionResult]]:
    """Axial loads (N) over six decades, equally spaced on a logarithmic axis, and the three models there."""
    load = np.geomspace(1e-4, 2.0, 261) * case.axial_load
    return load, _each(case, axial_load=load)


@functools.cache
def largest_flagged_load(case: Case, reason: str, screw_speed: float | None = None) -> float:
    """The largest axial load (N) at which the reference model is not valid for a reason; zero if there is none.

    At the speed of the case, or at another (rad/s).
    """
    speed = case.screw_speed if screw_speed is None else screw_speed
    load, found = np.geomspace(1e-4, 2.0, 501) * case.axial_load, 0.0
    for _ in range(2):  # the second time between the load that was found and the next
        result = case.result(MODELS["reference"], axial_load=load, screw_speed=speed)
        found = float(np.max(load[~np.asarray(result.validity[reason])], initial=0.0))
        load = np.linspace(found, np.min(load[load > found], initial=load[-1]), 501)
    return found


@functools.cache
def over_lead(case: Case) -> tuple[Values, FrictionResult]:
    """Leads (m) from d_m/20, or where the balls have room, to d_m, and the reference model there."""
    screw = case.screw
    smallest = 1.001 * screw.ball_diameter / np.cos(float(screw.lead_angle))
    lead = np.linspace(max(screw.pitch_circle_diameter / 20, smallest), screw.pitch_circle_diameter, 161)
    return lead, case.result(MODELS["reference"], lead=lead)


def _each(case: Case, **varied: Any) -> Mapping[str, FrictionResult]:
    return {name: case.result(model, **varied) for name, model in MODELS.items()}
