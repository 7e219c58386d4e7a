"""Contribution of each effect: from the corrected paper to the reference model, one effect at a time.

Two screws, each at one operating point: the paper's, with close grooves and a small lead, and a
catalogue screw, with open grooves and a larger lead. Curves of single effects are in
:mod:`effect_study.curves`.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ballscrew.cases.case_files import case_file
from ballscrew.evidence.papers.olaru2005 import case as paper
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.balls import MECHANISMS
from ballscrew.physics.friction.model import PAPER_FRICTION, FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.ball_chain import ProportionalBallForce
from ballscrew.physics.laws.friction import LoadSharing, RunInSharing
from ballscrew.physics.laws.inlet import Inlet
from ballscrew.physics.laws.rolling import houpert_rolling
from ballscrew.physics.solvers.ellipse_slip import ellipse_slip
from ballscrew.physics.solvers.line_slip import line_slip
from ballscrew.physics.solvers.slip import BallProblem, Slip

RPM = paper.RPM
#: Published pairs of decay and exponent of the asperities' share, each for its surfaces (ZhouHoeprich).
DECAYS = ((1.42, 0.8), (2.32, 0.97), (1.90, 0.99), (2.1, 0.85))


@dataclasses.dataclass(frozen=True, eq=False)
class Case:
    """A screw, its oil, and the operating point at which the effects are computed."""

    name: str
    title: str
    #: Parts of its caption by subject: screw, axial_load, screw_speed, oil, assumed.
    caption_parts: Mapping[str, str]
    screw: BallScrew
    oil: Lubricant
    axial_load: float
    screw_speed: float

    def caption(self, *varied: str) -> str:
        """The case as a caption, without the load or the speed where they vary."""
        kept = {about: text for about, text in self.caption_parts.items() if about not in varied}
        point = ", ".join(kept[about] for about in ("axial_load", "screw_speed", "oil") if about in kept)
        return f"{kept['screw']}; {point}. Assumed: {kept['assumed']}."

    def result(self, model: FrictionModel, **changes: Any) -> FrictionResult:
        """The model at the operating point, with another load, speed or field of the screw where given."""
        point = {name: changes.pop(name, getattr(self, name)) for name in ("axial_load", "screw_speed")}
        return model(dataclasses.replace(self.screw, **changes), self.oil, **point)


PAPER = Case(
    name="paper",
    title="the paper's screw",
    caption_parts={
        "screw": "40 × 5, d_w 3.175 mm, f 0.515, 45°, 56 balls",
        "axial_load": "F = 4000 N",
        "screw_speed": "n = 600 rpm",
        "oil": "viscosity 0.1 Pa s",
        "assumed": "E′ 226 GPa, α_p 22 1/GPa",
    },
    screw=paper.SCREW,
    oil=paper.OIL,
    axial_load=paper.AXIAL_LOAD,
    screw_speed=paper.SCREW_SPEED,
)
_FEED_DRIVE = case_file.load(Path(__file__).parents[2] / "examples" / "feed_drive.toml")
#: Four turns of a catalogue screw 40 × 10: 75 balls carry (ISO 3408-5: 20 a turn, a quarter turn
#: lost), which makes a dynamic load rating of 50 kN; the load is a tenth of that.
CATALOGUE = Case(
    name="catalogue",
    title="a catalogue screw",
    caption_parts={
        "screw": "40 × 10, d_m 41.4 mm, d_w 6.35 mm, f 0.54, 45°, 75 balls (four turns)",
        "axial_load": "F = 5000 N, a tenth of C_a",
        "screw_speed": "n = 600 rpm",
        "oil": "ISO VG 100 at 40 °C",
        "assumed": "E′ 226 GPa, roughness as in the paper",
    },
    screw=_FEED_DRIVE.screw,
    oil=_FEED_DRIVE.lubricant,
    axial_load=_FEED_DRIVE.operation.axial_load,
    screw_speed=_FEED_DRIVE.operation.screw_speed,
)
CASES: Mapping[str, Case] = {case.name: case for case in (PAPER, CATALOGUE)}


def spin_over_ellipse(ball: BallProblem) -> Slip:
    """The slip of the reference model on a path without a lead angle: no lateral slip."""
    return ellipse_slip(ball._replace(frame=dataclasses.replace(ball.frame, lead_angle=0.0)))


@dataclasses.dataclass(frozen=True, eq=False)
class Step:
    """One effect: short name, description, and the model with all effects up to it."""

    short: str
    description: str
    model: FrictionModel


@functools.cache
def steps() -> tuple[Step, ...]:
    """The corrected model first, then one effect after the other; the last is the reference model."""
    reference, so_far = FrictionModel.reference(), FrictionModel.corrected()
    paper_boundary = LoadSharing(boundary_friction_coefficient=PAPER_FRICTION.boundary_friction_coefficient)
    changes: tuple[tuple[str, str, dict[str, Any]], ...] = (
        ("rolling", "rolling force in all regimes, fully flooded", {"rolling": reference.rolling}),
        ("inlet heat", "heating of the inlet, and oil that flows back too late", {"inlet": reference.inlet}),
        ("load sharing", "asperities and film share the load, µ_0 still 0.2", {"friction": paper_boundary}),
        ("µ_0 0.12", "boundary friction 0.12 instead of 0.2", {"friction": LoadSharing()}),
        ("run-in", "surfaces that have run in", {"friction": reference.friction}),
        ("spin", "spin, on a line across the contact", {"slip": line_slip}),
        ("ellipse", "the whole ellipse instead of the line", {"slip": spin_over_ellipse}),
        ("helix", "lateral slip of the helix", {"slip": reference.slip}),
        ("no braking", "neighbours that rub and do not brake", {"ball_chain": reference.ball_chain}),
        (
            "balls",
            "balls that press on each other in proportion to their load",
            {"ball_force": reference.ball_force, "name": reference.name},
        ),
    )
    found = [Step("corrected", "the paper, corrected", so_far)]
    for short, description, change in changes:
        so_far = dataclasses.replace(so_far, **change)
        found.append(Step(short, description, so_far))
    return tuple(found)


@dataclasses.dataclass(frozen=True)
class Effect:
    """Friction torque (N m), its parts, and the efficiency, with an effect and all before it."""

    short: str
    description: str
    torque: float
    added: float
    parts: Mapping[str, float]
    efficiency: float
    friction_coefficient: float


def effects(case: Case) -> tuple[Effect, ...]:
    """The steps at the operating point of a case; ``added`` is the change of torque against the step before."""
    found: list[Effect] = []
    for step in steps():
        result = case.result(step.model)
        torque = float(result.screw_torque)
        found.append(
            Effect(
                short=step.short,
                description=step.description,
                torque=torque,
                added=torque - found[-1].torque if found else 0.0,
                parts={mechanism: float(result.contributions[mechanism]) for mechanism in MECHANISMS},
                efficiency=float(result.efficiency),
                friction_coefficient=float(result.screw.friction_coefficient),
            )
        )
    return tuple(found)


# -- assumptions ---------------------------------------------------------------------------------


@dataclasses.dataclass(frozen=True)
class Sensitivity:
    """One assumption that a data sheet does not settle, and the torques (N m) with its alternatives."""

    description: str
    default: str
    alternatives: str
    torques: tuple[float, ...]
    reference: float

    @property
    def lowest(self) -> float:
        """Largest fall against the reference, relative."""
        return min(*self.torques, self.reference) / self.reference - 1

    @property
    def highest(self) -> float:
        """Largest rise against the reference, relative."""
        return max(*self.torques, self.reference) / self.reference - 1


def sensitivities(case: Case) -> tuple[Sensitivity, ...]:
    """Assumptions of the reference model, the one that moves the torque most first."""
    reference = FrictionModel.reference()
    at_reference = float(case.result(reference).screw_torque)

    def torques(*models: FrictionModel) -> tuple[float, ...]:
        return tuple(float(case.result(model).screw_torque) for model in models)

    def rough(*heights: float) -> tuple[float, ...]:
        return tuple(
            float(case.result(reference, screw_roughness=height, nut_roughness=height).screw_torque)
            for height in heights
        )

    def with_slot(slot: str, *laws: Any) -> tuple[float, ...]:
        return torques(*(dataclasses.replace(reference, **{slot: law}) for law in laws))

    def frictions(name: str, *values: float) -> tuple[float, ...]:
        return with_slot("friction", *(RunInSharing(**{name: value}) for value in values))

    boundary, film = (f"{which}_friction_coefficient" for which in ("boundary", "full_film"))
    pairs = with_slot("friction", *(RunInSharing(decay=B, exponent=C) for B, C in DECAYS[1:]))
    films = frictions(film, 0.035, 0.053)
    oils = [dataclasses.replace(case.oil, viscosity=factor * case.oil.viscosity) for factor in (0.5, 2.0)]
    warm = tuple(float(dataclasses.replace(case, oil=oil).result(reference).screw_torque) for oil in oils)
    supplied = *with_slot("inlet", Inlet(inlet_film_ratio=10.0)), *with_slot("rolling", houpert_rolling)
    shares = with_slot("ball_force", *map(ProportionalBallForce, (0.0, 0.0225)))
    found = (
        ("boundary friction µ_0", "0.12", "0.08, 0.20", frictions(boundary, 0.08, 0.2)),
        ("load share of the asperities: B, C", "1.42, 0.80", "the other three published pairs", pairs),
        ("oil temperature", "as stated", "half and double the viscosity", warm),
        ("roughness of the races", "0.3 µm", "0.15, 0.5 µm", rough(0.15e-6, 0.5e-6)),
        ("friction of the full film", "0.05", "0.035 (PAO), 0.053 (naphthenic), Arana2019", films),
        ("running in of the surfaces: λ_r", "0.7", "0 (new), 1.4", frictions("run_in_film_parameter", 0.0, 1.4)),
        ("oil supply of the inlet", "an oil bath", "S = 10, and the law of Houpert1987", supplied),
        ("ball-to-ball force", "0.0075 Q", "0, 0.0225 Q", shares),
    )
    rows = [Sensitivity(*row, reference=at_reference) for row in found]
    return tuple(sorted(rows, key=lambda row: row.lowest - row.highest))
