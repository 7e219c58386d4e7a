"""A nut with all that goes with it, ready for any screw: what a case or a sweep evaluates."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Annotated, Any

from ballscrew._arrays import ByValue
from ballscrew.components.materials import Lubricant
from ballscrew.components.nut import Bodies, Deviations, DoubleNut, Nut, OffsetLeadNut, OversizeBallNut
from ballscrew.components.nut_losses import ParasiticLaw
from ballscrew.components.screw import BallScrew
from ballscrew.components.traits import traits_of
from ballscrew.errors import faults_of, is_concrete, raise_if_any
from ballscrew.friction.model import FrictionModel
from ballscrew.friction.nut_friction import NutFriction, nut_friction
from ballscrew.quantities import AngularSpeed, Count, Force, Info, Length, fields_of


@dataclasses.dataclass(frozen=True, eq=False)
class Scatter(ByValue):
    """Scatter of balls and lead as standard deviations; one seed gives the same balls every time.

    Raises :class:`~ballscrew.errors.InputError` for negative numbers.
    """

    ball_diameter: Annotated[
        Length,
        Info(
            "s_w",
            "standard deviation of the ball diameters",
            "um",
            at_least=0,
            hint="balls of one lot: below 1 um",
            usual=(0.0, 5e-5),
        ),
    ] = 0.0
    lead: Annotated[
        Length,
        Info(
            "s_h",
            "standard deviation of each ball's place on the lead",
            "um",
            at_least=0,
            hint="ground: about 1 um",
            usual=(0.0, 1e-4),
        ),
    ] = 0.0
    seed: Annotated[
        Count, Info("n_s", "seed of the random numbers", at_least=0, whole=True, hint="any whole number")
    ] = 1

    def __post_init__(self) -> None:
        raise_if_any(faults_of("deviations", self))

    def of(self, balls: int) -> Deviations:
        """The deviations of so many balls."""
        return Deviations.scattered(balls, seed=int(self.seed), ball_diameter=self.ball_diameter, lead=self.lead)


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class NutParts(ByValue):
    """A nut, and what may go with it."""

    nut: Nut
    #: Fields of :class:`Bodies` that are not of the usual size; None stands for rigid bodies.
    bodies: Mapping[str, Any] | None = None
    scatter: Scatter | None = None
    #: Losses besides the balls, by name.
    losses: Mapping[str, ParasiticLaw] = dataclasses.field(default_factory=dict[str, ParasiticLaw])

    @property
    def one_by_one(self) -> bool:
        """True where the balls differ, so that each is solved by itself."""
        return self.bodies is not None or self.scatter is not None

    @property
    def halves(self) -> int:
        """Nut bodies or halves with the loaded balls of the screw each."""
        return 2 if isinstance(self.nut, DoubleNut | OffsetLeadNut) else 1

    def knows(self, model: FrictionModel) -> bool:
        """True for a model that can be evaluated on this nut: not every one knows balls with four contacts."""
        return not isinstance(self.nut, OversizeBallNut) or 4 in traits_of(model.slip).contacts_per_ball

    def bodies_of(self, screw: BallScrew) -> Bodies | None:
        """The elastic bodies, of the usual size where nothing else is given."""
        return None if self.bodies is None else dataclasses.replace(Bodies.of(screw), **self.bodies)

    def deviations_of(self, screw: BallScrew) -> Deviations | None:
        """The deviations of the balls of a screw."""
        if self.scatter is None or not is_concrete(screw.loaded_balls):
            return None if self.scatter is None else Deviations()
        return self.scatter.of(self.halves * int(screw.loaded_balls))

    def by_section(self, screw: BallScrew) -> dict[str, Any]:
        """The parts with quantities, by their sections."""
        losses = {f"losses.{name}": law for name, law in self.losses.items()}
        return {"nut": self.nut, "bodies": self.bodies_of(screw), "deviations": self.scatter, **losses}

    def attributes(self, screw: BallScrew) -> dict[str, Any]:
        """All numbers besides those of the nut itself, by name, to be kept with results."""
        others = {"bodies": self.bodies_of(screw), "deviations": self.scatter}
        others |= {f"losses_{name}": law for name, law in self.losses.items()}
        found: dict[str, Any] = {"nut_kind": type(self.nut).__name__}
        for name, part in others.items():
            known = {} if part is None else fields_of(part)
            found |= {f"{name}_{field}": getattr(part, field) for field in known}
        return {name: value for name, value in found.items() if value is not None}

    def friction(
        self,
        model: FrictionModel,
        screw: BallScrew,
        lubricant: Lubricant,
        *,
        axial_load: Force,
        screw_speed: AngularSpeed,
    ) -> NutFriction:
        """Friction of a screw with this nut, as :func:`~ballscrew.friction.nut_friction.nut_friction` has it."""
        return nut_friction(
            model,
            screw,
            self.nut,
            lubricant,
            axial_load=axial_load,
            screw_speed=screw_speed,
            bodies=self.bodies_of(screw),
            deviations=self.deviations_of(screw),
            losses=self.losses,
        )
