"""The paper's case: what it states, and what had to be chosen because it does not."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

import numpy as np

from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import (
    FrictionModel,
)

#: The paper states its speeds in revolutions per minute; here they turn into rad/s once.
RPM = math.pi / 30

#: Olaru2005 §8, points a to g, and the conformity.
SCREW = BallScrew(
    pitch_circle_diameter=0.040,
    lead=0.005,
    ball_diameter=3.175e-3,
    loaded_balls=56,
    contact_angle=math.pi / 4,
    screw_conformity=0.515,
    nut_conformity=0.515,
    ball_roughness=0.08e-6,
    screw_roughness=0.3e-6,
    nut_roughness=0.3e-6,
)
OIL = Lubricant(viscosity=0.1, pressure_viscosity_coefficient=2.2e-8)

#: The load of Figs 5 to 7 and the speed of Figs 8 and 9.
AXIAL_LOAD = 4000.0
SCREW_SPEED = 600 * RPM
#: The contact load at which the paper divides Fig. 9 in two.
DIVIDING_CONTACT_LOAD = 20.0

# grids of the figures: round numbers of rpm and N
SPEEDS = np.arange(0, 1001) * RPM
LOADS = np.arange(0, 4001, 2.0)
BALL_TO_BALL_FORCES = np.array([0.0, 1.0, 2.0, 5.0]) / SCREW.loaded_balls
VISCOSITIES = np.array([0.05, 0.1, 0.2, 0.3, 0.5])
CONFORMITIES = np.array([0.515, 0.52, 0.53, 0.54])
BALL_FRICTION_COEFFICIENTS = np.array([0.0, 0.1, 0.2, 0.4])


@dataclasses.dataclass(frozen=True)
class Choice:
    """One thing the paper leaves open, and what was taken for it."""

    what: str
    taken: str
    why: str


CHOICES = (
    Choice(
        "equivalent modulus E′",
        f"{SCREW.equivalent_modulus(SCREW.screw_raceway) / 1e9:.1f} GPa",
        "not stated; steel on steel with a Young's modulus of 206 GPa and a Poisson's ratio of 0.3",
    ),
    Choice(
        "pressure–viscosity coefficient α_p",
        f"{OIL.pressure_viscosity_coefficient * 1e9:g} 1/GPa",
        "not stated; a usual mineral oil (1e-8 to 2.5e-8 1/Pa)",
    ),
    Choice(
        "contact load Q from the axial load F",
        "F/(z sin α); corrected: F/(z sin α cos φ)",
        "not stated; all balls share the load equally",
    ),
    Choice(
        "race roughness σ_R",
        "that of the race in contact, 0.3 µm",
        "the text names one roughness for screw and nut races",
    ),
    Choice(
        "film parameter λ",
        "h divided by the root of the sum of squares; olaru2005-literal: without the root, as printed",
        "the printed form has a unit of 1/m",
    ),
    Choice(
        "ball-to-ball force F_B",
        "net braking force on each ball; 1/z N unless a figure says otherwise",
        "imposed in the paper; (24) and (25) use it as a net force",
    ),
    Choice(
        "abscissa and viscosity of Fig. 5",
        "0 to 1000 rpm, 0.1 Pa s",
        "not stated; taken from Figs 6 and 7",
    ),
    Choice(
        "viscosity of Figs 8 and 9",
        "0.1 Pa s",
        "not stated; taken from Figs 6 and 7",
    ),
)


def models() -> Mapping[str, FrictionModel]:
    """The printed text, the corrected one, and the printed one to the letter, by name."""
    presets = (
        FrictionModel.olaru2005(),
        FrictionModel.corrected(),
        FrictionModel.olaru2005(literal_film_parameter=True),
    )
    return {model.name: model for model in presets}
