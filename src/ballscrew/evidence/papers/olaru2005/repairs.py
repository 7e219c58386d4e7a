"""From the printed model to the corrected one, one repair at a time."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping

from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.physics.friction.model import (
    FrictionModel,
)

#: The fields of the model in which the two differ, and what each repair is.
REPAIRS: Mapping[str, str] = {
    "frame": "helix in the kinematics and in Q(F)",
    "hertz": "exact contact ellipse for (18) and (19)",
    "film": "exponent 0.68 in (26)",
    "ball_chain": "two neighbours in a curved chain for (21)",
    "race_torques": "moments of the contacts on the races, (28) and (31)",
    "ideal_torque": "virtual work for (35)",
    "pure_rolling_offset": "Y from equilibrium, not 0.34",
}


@dataclasses.dataclass(frozen=True)
class Repair:
    """Torque (N m) and efficiency at 4000 N and 600 rpm with this repair alone, and with all so far."""

    description: str
    torque_alone: float
    efficiency_alone: float
    torque_so_far: float
    efficiency_so_far: float


def repairs() -> tuple[Repair, ...]:
    """The printed model first, then each repair; the last line is the corrected model."""
    printed, corrected = FrictionModel.olaru2005(), FrictionModel.corrected()
    steps = [Repair("as printed", *_at_the_point(printed), *_at_the_point(printed))]
    so_far = printed
    for field, words in REPAIRS.items():
        change = {field: getattr(corrected, field)}
        so_far = dataclasses.replace(so_far, **change)
        alone = dataclasses.replace(printed, **change)
        steps.append(Repair(words, *_at_the_point(alone), *_at_the_point(so_far)))
    return tuple(steps)


def _at_the_point(model: FrictionModel) -> tuple[float, float]:
    result = model(case.SCREW, case.OIL, axial_load=case.AXIAL_LOAD, screw_speed=case.SCREW_SPEED)
    return float(result.screw_torque), float(result.efficiency)
