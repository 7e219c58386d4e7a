"""Laws of geometry and of the Hertz contact."""

import math

import numpy as np
import pytest
from hypothesis import given

from ballscrew.physics.equations import geometry, hertz
from ballscrew.physics.laws.frame import bearing_frame, helix_frame
from ballscrew.physics.laws.hertz import exact_hertz
from support.strategies import both_models, cases, close, floats, powers, screws

ratios = powers(1e-3, 1e3)


def sizes(k):
    """Semi-axes and approach of a contact with R_x = 1 at W = 1."""
    shape = exact_hertz(k)
    integrals = hertz.elliptic_integrals(shape.ellipticity)
    c_d = hertz.approach_coefficient(k, shape.ellipticity, integrals.K, integrals.E)
    return shape.major, shape.minor, c_d


@pytest.mark.equation("Olaru2005 §2.1 (2)", "Olaru2005 §2.1 (3)")
@given(screws())
def test_rolling_radii_are_the_paper_s_fractions(screw):
    """R_x = ρ (1 ∓ γ): the fractions of Olaru2005 §2.1 (2) and (3) collapse to that."""
    d_w, d_m, alpha = screw.ball_diameter, screw.pitch_circle_diameter, screw.contact_angle
    gamma = bearing_frame(screw).curvature_ratio
    c = d_w * math.cos(alpha)
    assert close(geometry.screw_rolling_radius(d_w, gamma), 1 / (2 / d_w + 2 * math.cos(alpha) / (d_m - c)))
    assert close(geometry.nut_rolling_radius(d_w, gamma), 1 / (2 / d_w - 2 * math.cos(alpha) / (d_m + c)))


@given(screws())
def test_rolling_radii_on_the_helix(screw):
    """On the helix R_x = ρ (1 ∓ γ) too, with the curvature of the helix 2cos²φ/d_m in the place of 2/d_m."""
    d_w = screw.ball_diameter
    gamma = helix_frame(screw).curvature_ratio
    curvature = 2 * math.cos(screw.lead_angle) ** 2 / screw.pitch_circle_diameter
    assert close(gamma, d_w / 2 * math.cos(screw.contact_angle) * curvature)
    race = math.cos(screw.contact_angle) * curvature / (1 - gamma)
    assert close(geometry.screw_rolling_radius(d_w, gamma), 1 / (2 / d_w + race))
    race = math.cos(screw.contact_angle) * curvature / (1 + gamma)
    assert close(geometry.nut_rolling_radius(d_w, gamma), 1 / (2 / d_w - race))


@pytest.mark.equation("Olaru2005 §2.1 (5)", "Olaru2005 §2.2 (16)")
@given(screws(), floats(0.505, 0.56))
def test_transverse_and_deformed_radius(screw, conformity):
    """Curvatures subtract across the groove, and the deformed surface has their mean."""
    rho, groove = screw.ball_diameter / 2, conformity * screw.ball_diameter
    assert close(1 / geometry.transverse_radius(2 * rho, conformity), 1 / rho - 1 / groove, 1e-12, scale=1 / rho)
    assert close(1 / geometry.deformed_radius(2 * rho, conformity), (1 / rho + 1 / groove) / 2)


@given(cases, both_models, powers(1e-3, 1e3))
def test_exponents_of_the_load(case, model, factor):
    """a, b and p0 go with Q^⅓, the approach with Q^⅔, in the fit and in the exact solution."""
    less, greater = case(model), case(model, axial_load=factor * case.axial_load)
    for here, there in ((less.screw, greater.screw), (less.nut, greater.nut)):
        for name in ("semi_major_axis", "semi_minor_axis", "maximum_pressure"):
            assert close(getattr(there, name), getattr(here, name) * factor ** (1 / 3)), name
        assert close(there.mutual_approach, here.mutual_approach * factor ** (2 / 3))
        assert close(there.ellipticity, here.ellipticity)


@given(ratios)
def test_axes_may_be_swapped(k):
    """Which axis is called x is up to us: κ(1/k) = 1/κ(k), and the ellipse turns with it."""
    assert close(hertz.ellipticity(1 / k), 1 / hertz.ellipticity(k))
    major, minor, approach = sizes(k)
    # the swapped contact has R_x = k in the units of this one, and so W smaller by k²
    swapped_major, swapped_minor, swapped_approach = sizes(1 / k)
    assert close(swapped_minor * k ** (1 / 3), major)
    assert close(swapped_major * k ** (1 / 3), minor)
    assert close(swapped_approach * k ** (-1 / 3), approach)


@given(floats(-1e-3, 1e-3))
def test_circle(offset):
    """At k = 1 the ellipse is Hertz's circle: κ = 1, a = b = (3/2)^⅓, δ = a², smoothly so."""
    assert hertz.ellipticity(1.0) == 1.0
    major, minor, approach = sizes(1.0)
    assert close(major, 1.5 ** (1 / 3))
    assert close(minor, 1.5 ** (1 / 3))
    assert close(approach, 1.5 ** (2 / 3))
    near = sizes(1 + offset)
    assert close(near, (major, minor, approach), 2 * abs(offset) + 1e-14)


@given(ratios)
def test_ellipticity_solves_its_equation(k):
    """k = κ² B/D, with K = B + D and E = B + (1 − m) D."""
    kappa = hertz.ellipticity(k)
    K, E, B, D, C = hertz.elliptic_integrals(kappa)
    assert close(kappa**2 * B / D, k)
    assert close(B + D, K)
    assert close(E, B + D / kappa**2)
    assert close((D - B), (1 - kappa**-2) * C, scale=D)


@given(powers(1.0, 1e3), floats(1.001, 10))
def test_slenderer_geometry_makes_slenderer_contacts(k, factor):
    """The ellipticity rises with the radii ratio, and lies between k^½ and k^⅔·1.03 for k ≥ 1."""
    kappa = hertz.ellipticity(k)
    assert hertz.ellipticity(factor * k) > kappa
    assert k**0.5 * (1 - 1e-14) <= kappa <= k ** (2 / 3) * (1 + 1e-14)


@given(powers(1.0, 60.0))
def test_error_of_the_fit(k):
    """The paper's axes against the exact ones: at most 12 % too long across, within 2.6 % along."""
    major, minor, _ = sizes(k)
    assert -0.01 < hertz.semi_major_axis_coefficient_houpert(k) / major - 1 < 0.12
    assert abs(hertz.semi_minor_axis_coefficient_houpert(k) / minor - 1) < 0.026


@given(cases, both_models)
def test_pressure_carries_the_load(case, model):
    """The pressure over the ellipse carries the load: Q = ⅔ π a b p0."""
    r = case(model)
    for side in (r.screw, r.nut):
        carried = 2 / 3 * np.pi * side.semi_major_axis * side.semi_minor_axis * side.maximum_pressure
        assert close(carried, r.contact_load)
