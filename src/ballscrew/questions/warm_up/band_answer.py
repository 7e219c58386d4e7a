"""Response models of the API for what stands beside the results of warming up."""

from __future__ import annotations

from ballscrew.questions.shared.answer_parts import Assumed, Open, Tables, field


class WarmUpBands(Open):
    """Bands over time and in the steady state."""

    level: float
    samples: int
    time: list[float] = field("instants, SI", "s")
    known_share: list[float] = field("share of the samples whose friction is known at each instant")
    equilibrium: Tables
    inputs: Tables


class BesideWarmUp(Assumed):
    """What is assumed, and the bands where they are asked for."""

    band: WarmUpBands = field(optional=True)
