"""An output with one uncertain input at a time at either end of its distribution: what a tornado picture shows."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ballscrew.basis.quantities import AngularSpeed, Force
from ballscrew.engine.evaluation.plan import Configuration
from ballscrew.engine.uncertainty.distributions import Distribution, within
from ballscrew.engine.uncertainty.sampling import Sampler
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel


class Swing(NamedTuple):
    """An output with one input at the lower and at the upper end of its distribution, all others at their medians."""

    input: str
    at_lower: float
    at_upper: float

    @property
    def ends(self) -> tuple[float, float]:
        """The lesser and the greater of the two."""
        return min(self.at_lower, self.at_upper), max(self.at_lower, self.at_upper)

    @property
    def width(self) -> float:
        """How far apart they are; NaN where either is no number."""
        return abs(self.at_upper - self.at_lower)


def one_at_a_time(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    uncertain: Mapping[str, Distribution],
    axial_load: Force,
    screw_speed: AngularSpeed,
    output: str = "screw_torque",
    level: float = 0.95,
) -> Sequence[Swing]:
    """The swing of an ``output`` for each of the ``uncertain`` inputs, the widest first.

    The ends of an input leave ``(1 - level) / 2`` of its distribution below and above. It costs two evaluations for
    each input. What inputs do together, and the correlation that a fit leaves, is not in it: their sum is no band.
    Swings without a number come last. Raises :class:`~ballscrew.basis.errors.InputError` for unknown names.
    """
    if not uncertain:
        return ()
    subject = Configuration(model, screw, lubricant)
    known = subject.inputs
    inputs = {name: within(distribution, known[name][1].info) for name, distribution in uncertain.items()}
    point = {"axial_load": axial_load, "screw_speed": screw_speed}
    fixed = {name: value for name, value in point.items() if name not in inputs}
    shares = np.full((len(inputs), 2 * len(inputs)), 0.5)
    for place in range(len(inputs)):
        shares[place, 2 * place : 2 * place + 2] = (1 - level) / 2, (1 + level) / 2
    values = Sampler(subject, inputs, fixed, (output,)).evaluate(shares)[output]
    swings = [Swing(name, *map(float, values[2 * i : 2 * i + 2])) for i, name in enumerate(inputs)]
    return sorted(swings, key=lambda swing: (-np.nan_to_num(swing.width, nan=-1.0), swing.input))
