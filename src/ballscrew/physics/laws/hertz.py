"""Laws of the slot ``hertz``: shape of the contact ellipse, by fits or exact."""

from __future__ import annotations

from ballscrew.basis.quantities import Ratio
from ballscrew.physics.equations import hertz
from ballscrew.physics.laws.conditions import HertzShape
from ballscrew.physics.laws.traits import law_traits

# -- Hertz contact --------------------------------------------------------------------------------


@law_traits(excluded="approximates the exact contact: a known error, and no doubt")
def houpert_hertz(radii_ratio: Ratio) -> HertzShape:
    """The paper's power laws, Olaru2005 §2.2 (18) and (19); 12 % too long at their limit k = 60."""
    major = hertz.semi_major_axis_coefficient_houpert(radii_ratio)
    minor = hertz.semi_minor_axis_coefficient_houpert(radii_ratio)
    return HertzShape(major, minor, major / minor, largest_radii_ratio=60.0)


@law_traits(alternative=True)
def exact_hertz(radii_ratio: Ratio) -> HertzShape:
    """The exact solution with elliptic integrals (Johnson1985 §4.2)."""
    kappa = hertz.ellipticity(radii_ratio)
    major = hertz.semi_major_axis_coefficient(radii_ratio, kappa, hertz.elliptic_integrals(kappa).E)
    return HertzShape(major, major / kappa, kappa, largest_radii_ratio=1000.0)


@law_traits(excluded="approximates the exact contact: a known error, and no doubt")
def brewe_hamrock_hertz(radii_ratio: Ratio) -> HertzShape:
    """The exact formulas with the fits of BreweHamrock1977 for ellipticity and elliptic integral."""
    kappa = hertz.ellipticity_brewe_hamrock(radii_ratio)
    second_integral = hertz.second_integral_brewe_hamrock(radii_ratio)
    major = hertz.semi_major_axis_coefficient(radii_ratio, kappa, second_integral)
    return HertzShape(major, major / kappa, kappa, largest_radii_ratio=100.0)
