"""Laws of the friction coefficient, of the slip in the contact ellipse, and of what raises the torque."""

import dataclasses
import math
from types import SimpleNamespace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

import ballscrew as bs
from ballscrew.physics.equations import friction, hertz, kinematics
from ballscrew.physics.friction.validity import LARGEST_PURE_ROLLING_OFFSET
from support.strategies import (
    both_models,
    cases,
    close,
    constant_friction,
    fitting_cases,
    floats,
    powers,
    with_ball_force,
)

#: Where the asperities' share has fallen to 0.02, with the paper's coefficients.
THRESHOLD = 1.8298234138683820
PARTS = ("ball", "screw", "nut")


def stays_boundary(r):
    """Both contacts rub their asperities: the clamp at 0.02 is inactive."""
    return all(np.all(side.friction_coefficient > 0.0201) for side in (r.screw, r.nut))


def at_film(law):
    """A friction law as a function of the film parameter alone."""
    return lambda film_parameter: law(
        SimpleNamespace(film_parameter=film_parameter, full_film_friction_coefficient=None)
    )


# -- the coefficient ------------------------------------------------------------------------------


@given(cases, both_models)
def test_friction_coefficient_is_bounded(case, model):
    """0.02 ≤ µ ≤ 0.2, whatever the film."""
    r = case(model)
    for side in (r.screw, r.nut):
        assert 0.02 <= side.friction_coefficient <= 0.2


@given(powers(0.05, 0.3), powers(0.5, 4.0), floats(0.5, 1.5), floats(0.05, 0.9), powers(1e-12, 1e-3))
def test_clamp_is_continuous(mu_0, decay, exponent, share, step):
    """The branches of §5 meet: no jump where the asperities' share reaches the full-film value, nor at rest."""
    law = at_film(bs.ZhouHoeprich(mu_0, decay, exponent, full_film_friction_coefficient=share * mu_0))
    threshold = (-math.log(share) / decay) ** (1 / exponent)
    steepest = 10 * mu_0 * decay * exponent * max(1.0, threshold ** (exponent - 1))
    around = law(threshold * np.array([1 - step, 1.0, 1 + step]))
    assert np.all(np.abs(np.diff(around)) <= steepest * threshold * step + 1e-15)
    assert close(law(0.0), mu_0)
    assert close(law(2 * threshold), share * mu_0)


@given(floats(0.0, 10.0))
def test_threshold_of_the_paper(film_parameter):
    """µ leaves its full-film value of 0.02 below λ = 1.82982, not at 2.5 to 3."""
    mu = at_film(bs.ZhouHoeprich())(film_parameter)
    assert (mu > 0.02) == (film_parameter < THRESHOLD)


@given(floats(0.0, 10.0), floats(0.0, 10.0))
def test_thicker_films_never_rub_more(first, second):
    """µ does not rise with the film parameter."""
    thin, thick = sorted((first, second))
    law = at_film(bs.ZhouHoeprich())
    assert law(thick) <= law(thin)


# -- slip in the ellipse --------------------------------------------------------------------------


def over_the_ellipse(integrand, Y):
    """Integral over the unit ellipse, across × along, in pieces between the lines of pure rolling."""
    x, w = np.polynomial.legendre.leggauss(12)
    # along the ellipse with s = sqrt(1 - t²) sin θ: smooth, also where the pressure ends
    angles, weights = np.pi / 2 * x, np.pi / 2 * w
    total = 0.0
    for low, high in ((-1, -Y), (-Y, Y), (Y, 1)):
        t = ((high - low) * x + high + low) / 2
        half_width = np.sqrt(1 - t**2)[:, None]
        s = half_width * np.sin(angles)
        values = integrand(t[:, None], s) * half_width * np.cos(angles)
        total += (high - low) / 2 * w @ (values @ weights)
    return total


@pytest.mark.slow
@pytest.mark.equation("Olaru2005 §2.1 (13)", "Olaru2005 §2.2 (14)", "Olaru2005 §2.2 (15)")
@given(fitting_cases(), both_models, floats(0.0, 0.999))
def test_closed_form_is_the_integral(case, model, Y):
    """(15) is friction times pressure times height over the ellipse, (14); so is the traction that goes with it."""
    side = case(model).screw
    a, b, R_d = side.semi_major_axis, side.semi_minor_axis, side.deformed_radius
    mu, Q = side.friction_coefficient, side.contact_load
    # Houpert's axes and pressure belong together, so the pressure carries the load
    p_0 = 3 * Q / (2 * math.pi * a * b)

    def direction(t):
        speed = kinematics.curvature_sliding_speed(1.0, 1.0, R_d, t * a, Y * a)
        return -np.sign(speed)

    def shear(t, s):
        return mu * hertz.hertz_pressure(p_0, t, s) * direction(t) * a * b

    moment = over_the_ellipse(lambda t, s: shear(t, s) * (t * a) ** 2 / (2 * R_d), Y)
    traction = over_the_ellipse(shear, Y)
    assert close(moment, side.curvature_moment_at(Y), scale=0.1 * mu * Q * a**2 / R_d, relative=1e-9)
    assert close(traction, mu * Q * friction.traction_ratio(Y), scale=mu * Q, relative=1e-9)
    # and the power of the slip is what moment and traction do together
    power = over_the_ellipse(
        lambda t, s: np.abs(shear(t, s) * kinematics.curvature_sliding_speed(1.0, 1.0, R_d, t * a, Y * a)), Y
    )
    worked = side.curvature_moment_at(Y) - mu * Q * friction.traction_ratio(Y) * (Y * a) ** 2 / (2 * R_d)
    assert close(power, worked, scale=0.1 * mu * Q * a**2 / R_d, relative=1e-9)
    assert close(side.maximum_pressure, p_0)


@given(floats(0.0, 1.0))
def test_curvature_moment_brakes_up_to_its_offset(Y):
    """M_C ≥ 0 for 0 ≤ Y < 0.643, and negative beyond."""
    moment = friction.curvature_friction_moment(1.0, 1.0, 1.0, 1.0, Y)
    if Y < LARGEST_PURE_ROLLING_OFFSET:
        assert moment >= 0
    if Y > LARGEST_PURE_ROLLING_OFFSET + 1e-3:
        assert moment < 0
    assert -0.1 <= moment <= 0.1


@given(floats(0.0, 1.0), floats(-1.0, 1.0))
def test_offset_and_traction_are_inverse(Y, traction):
    """Each offset carries one traction, T = 1 − 3Y + Y³, and each traction has its offset."""
    assert close(friction.traction_ratio(friction.offset_from_traction(traction)), traction, 1e-14, scale=1)
    # the slope of T vanishes at Y = 1, so rounding of T is seen as its root there
    assert close(friction.offset_from_traction(friction.traction_ratio(Y)), Y, 1e-14, scale=1 / (1 - Y + 1e-8))


# -- what raises the torque -----------------------------------------------------------------------


@given(fitting_cases(), both_models, floats(0.0, 1.0), powers(1e-3, 1.0))
def test_torque_rises_with_the_force_between_balls(case, model, force, more):
    """M_S rises with F_B."""
    less, greater = (case(with_ball_force(model, F)) for F in (force, force + more))
    assert greater.screw_torque > less.screw_torque


@pytest.mark.slow
@given(fitting_cases(), both_models, floats(0.05, 0.4), floats(1.01, 2.0))
def test_torque_rises_with_boundary_friction(case, model, mu_0, factor):
    """M_S rises with µ0 where asperities rub, and never falls while the balls roll."""
    less, greater = (
        case(dataclasses.replace(model, friction=bs.ZhouHoeprich(boundary_friction_coefficient=mu)))
        for mu in (mu_0, factor * mu_0)
    )
    assume(less.validity["skid"])
    assert greater.screw_torque >= less.screw_torque * (1 - 1e-14)
    if stays_boundary(less):
        assert greater.screw_torque > less.screw_torque


@pytest.mark.slow
@given(fitting_cases(), both_models, floats(1.01, 3.0))
def test_torque_rises_with_roughness(case, model, factor):
    """M_S rises with the roughness where asperities rub, and never falls while the balls roll."""
    rough = dataclasses.replace(
        case.screw, **{f"{part}_roughness": factor * getattr(case.screw, f"{part}_roughness") for part in PARTS}
    )
    less, greater = case(model), dataclasses.replace(case, screw=rough)(model)
    assume(less.validity["skid"])
    assert greater.screw_torque >= less.screw_torque * (1 - 1e-14)
    if stays_boundary(less) and less.screw.friction_coefficient < 0.199:
        assert greater.screw_torque > less.screw_torque


@given(fitting_cases(), both_models, st.floats(1.05, 10))
def test_torque_rises_with_the_load(case, model, factor):
    """M_S rises with the load at constant friction coefficient."""
    constant = dataclasses.replace(model, friction=constant_friction(0.1))
    less, greater = case(constant), case(constant, axial_load=factor * case.axial_load)
    assume(less.validity["skid"])
    assert greater.screw_torque > less.screw_torque
