r"""A half of a nut as balls between two grooves in the section across the path: vectors, and no triangle of centres.

Each ball is a body in the plane, pressed by both grooves along its normals and dragged across by friction that is a
share :math:`\mu` of the mean normal force at both contacts. Its grooves are circles; the one of the screw moves along
the axis. The bodies between the balls are bars. Unknown are all places at once, and the balance of all forces is solved
for them: the judge of :mod:`ballscrew.physics.friction.across_groove`, which has a closed form for the ball, and the
package's solver for the rest.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq, root

from ballscrew.basis.quantities import Force
from ballscrew.physics.components.nut import Bodies
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.equations import geometry, hertz, rigidity

Field = NDArray[np.float64]
#: Lengths are in micrometres while they are solved for.
MICROMETRE = 1e-6


@dataclasses.dataclass(frozen=True)
class HalfNut:
    """So many balls in two grooves, and the bars between them; the preload enters at the last ball.

    Between rigid bodies all are alike, and one stands for as many as there are.
    """

    balls: int
    alike: int
    contact_angle: float
    lead_angle: float
    #: Radii of the grooves of screw and nut less that of the ball, and load over approach to the power of 3/2 of both.
    arms: tuple[float, float]
    stiffness: tuple[float, float]
    #: Compliance of both bodies between neighbouring balls, and from the last ball to the middle of the spacer; zero:
    #: rigid.
    bar: float
    spacer: float

    @classmethod
    def of(cls, screw: BallScrew, bodies: Bodies | None, spacing: float = 0.0) -> HalfNut:
        """The half of a double nut of ``screw``."""
        d_w, alpha, phi = (float(x) for x in (screw.ball_diameter, screw.contact_angle, screw.lead_angle))
        L = geometry.path_radius(screw.pitch_circle_diameter, phi)
        gamma = geometry.curvature_ratio(d_w, 2 * L, alpha, 0.0)
        radii = (d_w / 2 * (1 - gamma), d_w / 2 * (1 + gamma))
        stiffness: list[float] = []
        for conformity, race, R_x in zip(
            (screw.screw_conformity, screw.nut_conformity), (screw.screw_raceway, screw.nut_raceway), radii, strict=True
        ):
            k = geometry.radii_ratio(geometry.transverse_radius(d_w, conformity), R_x)
            kappa = hertz.ellipticity(k)
            integrals = hertz.elliptic_integrals(kappa)
            c = hertz.approach_coefficient(k, kappa, integrals.K, integrals.E)
            stiffness.append(float(rigidity.contact_load_deflection(c, screw.equivalent_modulus(race), R_x)))
        bar = spacer = 0.0
        if bodies is not None:
            whole = bodies.sized(screw)
            core = np.pi / 4 * whole.screw_diameter**2 * screw.screw_material.young_modulus
            tube = np.pi / 4 * (whole.nut_outer_diameter**2 - whole.nut_inner_diameter**2)
            compliance = 1 / core + 1 / (tube * screw.nut_material.young_modulus)
            step = d_w * np.sin(phi) / float(screw.starts)
            bar, spacer = float(step * compliance), float((step + spacing) / 2 * compliance)
        return cls(
            balls=1 if bodies is None else int(screw.loaded_balls),
            alike=int(screw.loaded_balls) if bodies is None else 1,
            contact_angle=alpha,
            lead_angle=phi,
            arms=(float((screw.screw_conformity - 0.5) * d_w), float((screw.nut_conformity - 0.5) * d_w)),
            stiffness=(stiffness[0], stiffness[1]),
            bar=bar,
            spacer=spacer,
        )

    def preload_in_motion(self, preload: Force, share: float) -> tuple[Force, Field, Field]:
        """Axial force at the offset of a preload at rest, with so much friction across; loads at rest and in motion."""
        at_rest = self._balanced(preload, 0.0)
        offset = self._end(at_rest) + self.spacer * preload

        def left(force: float) -> float:
            return (self._end(self._balanced(force, share)) + self.spacer * force - offset) / MICROMETRE

        force = brentq(left, 0.5 * preload, 4 * preload, xtol=1e-9 * preload)
        return force, self._loads(at_rest, 0.0)[0], self._loads(self._balanced(force, share), share)[0]

    def _end(self, places: Field) -> float:
        return float(places[self.balls - 1]) * MICROMETRE

    def _balanced(self, force: Force, share: float) -> Field:
        """Displacement of the screw at each ball, and the centres of the balls, µm."""
        each = force / (self.balls * self.alike) / np.sin(self.contact_angle) / np.cos(self.lead_angle)
        approach = [(each / k) ** (2 / 3) / MICROMETRE for k in self.stiffness]
        shift = sum(approach) / np.sin(self.contact_angle) / np.cos(self.lead_angle)
        start = np.concatenate([np.full(self.balls, shift), np.full(self.balls, approach[1]), np.zeros(self.balls)])
        found = root(lambda x: self._left(x, force, share) / each, start, tol=1e-12)
        # it complains of slow progress where rounding ends it
        assert np.max(np.abs(found.fun)) < 1e-7, found.message
        return found.x

    def _geometry(self, places: Field) -> tuple[tuple[Field, Field], tuple[Field, Field]]:
        """From the centres of the grooves of screw and nut to those of the balls: along the line of contact, and
        across.
        """
        u, along, across = places.reshape(3, -1) * MICROMETRE
        sine, cosine = np.sin(self.contact_angle), np.cos(self.contact_angle)
        shift = u * np.cos(self.lead_angle)
        of_nut = self.arms[1] + along, across
        of_screw = along - self.arms[0] - shift * sine, across - shift * cosine
        return of_screw, of_nut

    def _loads(self, places: Field, share: float) -> tuple[Field, Field, Field]:
        """Normal force of each ball, mean of both contacts; force on the ball by the screw, and by both, in the
        plane.
        """
        forces: list[Field] = []
        normals: list[Field] = []
        sides = self._geometry(places)
        for (along, across), arm, k in zip(sides, self.arms, self.stiffness, strict=True):
            length = np.hypot(along, across)
            normals.append(k * np.maximum(length - arm, 0.0) ** 1.5)
        mean = (normals[0] + normals[1]) / 2
        for (along, across), normal in zip(sides, normals, strict=True):
            length = np.hypot(along, across)
            n = np.stack([along, across]) / length
            # the tangent that points to the side to which friction drags
            t = np.stack([-n[1], n[0]]) * np.sign(n[0])
            forces.append(-normal * n + share * mean * t)
        return mean, forces[0], forces[0] + forces[1]

    def _left(self, places: Field, force: Force, share: float) -> Field:
        _, by_screw, by_both = self._loads(places, share)
        axial = (by_screw[0] * np.sin(self.contact_angle) + by_screw[1] * np.cos(self.contact_angle)) * np.cos(
            self.lead_angle
        )
        u = places[: self.balls] * MICROMETRE
        of_bars = -axial
        if self.balls > 1:
            passed = np.diff(u) / self.bar
            of_bars[:-1] += passed
            of_bars[1:] -= passed
        of_bars[-1] += force / self.alike
        return np.concatenate([of_bars, *by_both])
