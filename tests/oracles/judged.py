"""Screws, laws and balls for the tests of the contact integral."""

from ballscrew.physics.equations import geometry
from ballscrew.physics.laws.frame import helix_frame
from oracles.contact_patch import ContactPatch, hertz_ellipse
from oracles.free_ball import BallResistances, FreeBall
from oracles.tractions import Coulomb, Eyring, LimitingShear
from support import screws

OIL = {"viscosity": 0.1, "pressure_viscosity_coefficient": 2.2e-8, "film_thickness": 2e-7}
LAWS = {
    "coulomb": Coulomb(0.1),
    "eyring": Eyring(**OIL, eyring_stress=5e6),
    "limiting": LimitingShear(**OIL, limiting_shear_coefficient=0.07),
    "mixed": (Coulomb(0.08), Eyring(**OIL, eyring_stress=3e6)),
}
HIGHEST_PRESSURE = 4.2e9
RESISTANCES = BallResistances(
    screw_rolling_force=0.02,
    nut_rolling_force=0.03,
    screw_elastic_moment=1e-5,
    nut_elastic_moment=2e-5,
    ball_friction_moment=5e-6,
    ball_to_ball_force=0.05,
)


def screw(**changes):
    sizes = {"ball_diameter": 3.175e-3, "loaded_balls": 56, "screw_conformity": 0.53}
    return screws.screw(**sizes | changes)


def ball(part, load, law, pairs, resistances):
    """The ball that the solver puts into balance."""
    frame, d_w = helix_frame(part), part.ball_diameter
    radii = (
        geometry.screw_rolling_radius(d_w, frame.curvature_ratio),
        geometry.nut_rolling_radius(d_w, frame.curvature_ratio),
    )
    raceways = (part.screw_raceway, part.nut_raceway)
    patches = [
        ContactPatch.of(hertz_ellipse(load, part.equivalent_modulus(way), d_w, way.conformity, R_x), law, (64, 16))
        for way, R_x in zip(raceways, radii, strict=True)
    ]
    return FreeBall.of(part, frame, [tuple(patches)] * pairs, resistances, 1.0)
