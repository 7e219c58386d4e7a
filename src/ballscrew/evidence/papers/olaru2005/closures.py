"""Readings of what the paper leaves unstated, and the claims that they reproduce.

A reading that meets the claims is consistent with the text. It is not thereby verified: the figures
carry no values that could be read off.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Mapping

from ballscrew.evidence.papers.olaru2005 import case
from ballscrew.evidence.papers.olaru2005.claims import judged
from ballscrew.evidence.papers.olaru2005.observations import observe
from ballscrew.evidence.papers.olaru2005.verdicts import Finding, Verdict
from ballscrew.physics.components.materials import Lubricant, Material
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.film import HamrockDowson

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


#: The claims whose verdict depends on what is left unstated.
KEYS = ("split_one", "split_two", "minimum", "falling", "rising", "efficiency", "first_zone", "second_zone")
_NU = Material().poisson_ratio


@dataclasses.dataclass(frozen=True, kw_only=True)
class Reading:
    """One way to fill in what the paper does not say."""

    name: str
    description: str
    model: FrictionModel
    screw: BallScrew
    oil: Lubricant


@dataclasses.dataclass(frozen=True, kw_only=True)
class ClosureCheck:
    """A reading, and what becomes of the claims under it."""

    reading: Reading
    findings: Mapping[str, Finding]

    @property
    def consistent(self) -> bool:
        """True where all claims about torque minimum, efficiency and split hold."""
        return all(finding.verdict is Verdict.HOLDS for finding in self.findings.values())


def readings() -> tuple[Reading, ...]:
    """The printed model, the right exponent in it, and two sets of closures, each with both exponents."""
    printed = FrictionModel.olaru2005()
    right = dataclasses.replace(printed, film=HamrockDowson())
    thin = dataclasses.replace(case.OIL, pressure_viscosity_coefficient=1e-8)
    other = dataclasses.replace(case.OIL, pressure_viscosity_coefficient=2e-8)
    steel = Material(young_modulus=2.1e11 * (1 - _NU**2), poisson_ratio=_NU)
    rough = math.hypot(case.SCREW.screw_roughness, case.SCREW.nut_roughness)
    rougher = dataclasses.replace(
        case.SCREW,
        screw_roughness=rough,
        nut_roughness=rough,
        ball_material=steel,
        screw_material=steel,
        nut_material=steel,
    )

    def without_offset(model: FrictionModel) -> FrictionModel:
        return dataclasses.replace(model, pure_rolling_offset=0.0)

    first = "bracket of Y in (15) dropped (as with Y = 0), α_p 1e-8 1/Pa"
    second = "Y = 0, E′ 2.1e11 Pa, α_p 2e-8 1/Pa, σ² = σ_b² + σ_s² + σ_n²"
    return (
        Reading(name="as printed", description="the choices above", model=printed, screw=case.SCREW, oil=case.OIL),
        Reading(
            name="exponent 0.68", description="the right exponent in (26)", model=right, screw=case.SCREW, oil=case.OIL
        ),
        Reading(
            name="set 1", description=f"{first}, exponent 0.68", model=without_offset(right), screw=case.SCREW, oil=thin
        ),
        Reading(
            name="set 1, exponent 0.66",
            description=f"{first}, exponent as printed",
            model=without_offset(printed),
            screw=case.SCREW,
            oil=thin,
        ),
        Reading(
            name="set 2", description=f"{second}, exponent 0.68", model=without_offset(right), screw=rougher, oil=other
        ),
        Reading(
            name="set 2, exponent 0.66",
            description=f"{second}, exponent as printed",
            model=without_offset(printed),
            screw=rougher,
            oil=other,
        ),
    )


def closure_checks() -> tuple[ClosureCheck, ...]:
    """Check the claims that depend on the unstated closures under each reading."""
    checks: list[ClosureCheck] = []
    for reading in readings():
        seen = observe(reading.model, reading.screw, reading.oil)
        values = {claim.key: claim.findings[reading.name] for claim in judged({reading.name: seen}, KEYS)}
        checks.append(ClosureCheck(reading=reading, findings=values))
    return tuple(checks)
