"""What the law of each slot takes and returns: a protocol for each slot of a friction model."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from ballscrew.basis.quantities import Angle, Count, Force, Length, Ratio, Torque
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.laws.conditions import ContactConditions, HertzShape
from ballscrew.physics.laws.frame import Frame

# -- slots ----------------------------------------------------------------------------------------


class FrameLaw(Protocol):
    """Law of the frame in which the balls roll."""

    def __call__(self, screw: BallScrew, /) -> Frame: ...


class ContactLoadLaw(Protocol):
    """Normal load of a ball from the axial load."""

    def __call__(self, axial_load: Force, loaded_balls: Count, contact_angle: Angle, lead_angle: Angle, /) -> Force: ...


class HertzLaw(Protocol):
    """Shape of the contact ellipse: of the radii alone, as it is what the conditions of a contact are made of."""

    def __call__(self, radii_ratio: Ratio, /) -> HertzShape: ...


class FilmLaw(Protocol):
    """Minimum film thickness, inlet cool and full."""

    def __call__(self, conditions: ContactConditions, /) -> Length: ...


class FilmParameterLaw(Protocol):
    """Film thickness against roughness."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class InletFactors(NamedTuple):
    """Factors of the inlet: its heat on the film, all it does on the rolling force, missing oil on the film."""

    film: Ratio
    rolling: Ratio
    supply: Ratio = 1.0


class InletLaw(Protocol):
    """Heating and filling of the inlet."""

    def __call__(self, conditions: ContactConditions, /) -> InletFactors: ...


class FullFilmLaw(Protocol):
    """Friction coefficient of the film itself, where it alone carries the load."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class FrictionLaw(Protocol):
    """Friction coefficient of a contact, most often from its film parameter."""

    def __call__(self, conditions: ContactConditions, /) -> Ratio: ...


class RollingLaw(Protocol):
    """Hydrodynamic rolling force."""

    def __call__(self, conditions: ContactConditions, /) -> Force: ...


class ElasticResistanceLaw(Protocol):
    """Elastic resistance to rolling."""

    def __call__(self, conditions: ContactConditions, /) -> Torque: ...


class BallForceLaw(Protocol):
    """Net braking force between neighbouring balls."""

    def __call__(self, ball_to_ball_force: Force, contact_load: Force, /) -> Force: ...


class BallChainLaw(Protocol):
    """Law of the contact of a ball with its neighbours."""

    def __call__(
        self,
        ball_friction_coefficient: Ratio,
        ball_to_ball_force: Force,
        ball_diameter: Length,
        frame: Frame,
        /,
    ) -> BallChain: ...


class RaceTorqueLaw(Protocol):
    """Friction torque of one ball on screw and nut."""

    def __call__(
        self,
        screw_tangential_force: Force,
        nut_tangential_force: Force,
        screw_contact_moment: Torque,
        nut_contact_moment: Torque,
        frame: Frame,
        /,
    ) -> RaceTorques: ...


class IdealTorqueLaw(Protocol):
    """Drive torque without friction."""

    def __call__(self, axial_load: Force, screw: BallScrew, frame: Frame, /) -> Torque: ...


# -- the ball chain -------------------------------------------------------------------------------


class BallChain(NamedTuple):
    """Moment and force along the path that its neighbours exert on a ball."""

    #: Moment of the rubbing surfaces of the neighbours.
    moment: Torque
    #: Force against the motion: the net push of the neighbours, and what a curved chain makes of the moment.
    braking_force: Force
    #: The net push alone, as on a straight path; None where all of the braking force is that.
    net_push: Force | None = None

    @property
    def net_braking_force(self) -> Force:
        """Net push of the neighbours against the motion."""
        return self.braking_force if self.net_push is None else self.net_push


# -- torques --------------------------------------------------------------------------------------


class RaceTorques(NamedTuple):
    """Friction torque of one ball on each race."""

    screw: Torque
    nut: Torque
