"""Ratios of the model by size of the screw, and of laws that could be in its place: tables of ``fit_calibration.py``.

What decision 3 says of share laws comes from here. No number is fitted.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, cast

import numpy as np

from ballscrew.evidence.validation.entries import Conditions, Point, Values, trends
from ballscrew.evidence.validation.rows import screw_of
from ballscrew.evidence.validation.sets import SETS
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.calibrations import calibrated, calibrations
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.friction.result import FrictionResult
from ballscrew.physics.laws.ball_chain import ChainBallForce, ProportionalBallForce, imposed_ball_force, two_neighbours
from ballscrew.physics.laws.conditions import ContactConditions
from ballscrew.physics.laws.friction import (
    BalanSharing,
    GreenwoodTrippSharing,
    LoadSharing,
    RunInSharing,
    arana_traction,
)
from ballscrew.physics.laws.inlet import Inlet, flooded_inlet
from ballscrew.physics.laws.nut_losses import ReturnBraking, ShearedOil, SpinUp
from ballscrew.questions.shared.text_tables import markdown_table
from ballscrew.questions.validate import compute

#: The sets that the calibrations are fitted to, and a column of each that is a maximum and no band.
FITTED = ("rexroth-double-nut", "rexroth-single-nut")
_MAXIMUM = "no_load_torque_2pct_max"
#: Ends of the size classes: nominal diameters in m.
CLASSES = {"up to 25 mm": (0.0, 0.0251), "32 to 50 mm": (0.0251, 0.0501), "63 mm and more": (0.0501, 1.0)}
#: A model for each row.
OfRow = Callable[[Values], FrictionModel]
REFERENCE = FrictionModel.reference()


@dataclasses.dataclass(frozen=True)
class ConstantShare:
    """Asperities carry the same share of the load at any film."""

    share: float

    def __call__(self, conditions: ContactConditions) -> Any:
        """Friction coefficient."""
        return 0.12 * self.share + 0.05 * (1 - self.share) + 0 * conditions.film_parameter


@dataclasses.dataclass(frozen=True)
class CappedShare:
    """The share of ZhouHoeprich1991, but no more than a cap: no rise of friction at rest."""

    cap: float

    def __call__(self, conditions: ContactConditions) -> Any:
        """Friction coefficient."""
        share = np.minimum(np.exp(-1.42 * conditions.film_parameter**0.8), self.cap)
        return 0.12 * share + 0.05 * (1 - share)


def weighting_factor(screw: BallScrew, conditions: Conditions) -> float:
    r"""Share of the boundary friction by SKF2018 in a rolling bearing as large as the pitch circle.

    .. math:: \phi_{bl} = \exp\left(-2.6 \cdot 10^{-8} (n \nu)^{1.4} d_m\right)

    with rpm, mm²/s and mm.
    """
    oil = conditions.lubricant
    viscosity, speed = 1e6 * oil.viscosity / oil.density, conditions.screw_speed * 30 / math.pi
    return math.exp(-2.6e-8 * (speed * viscosity) ** 1.4 * 1e3 * screw.pitch_circle_diameter)


def with_friction(law: Any) -> OfRow:
    """The reference model with this law of friction."""
    model = dataclasses.replace(REFERENCE, friction=law)
    return lambda _: model


def _by_weighting_factor(values: Values) -> FrictionModel:
    share = weighting_factor(screw_of(values).screw(), Conditions().of(values))
    return dataclasses.replace(REFERENCE, friction=ConstantShare(share))


def _of_0_1(_: Values) -> FrictionModel:
    """The reference model of version 0.1."""
    return dataclasses.replace(
        REFERENCE,
        inlet=Inlet(replenishment_constant=0.0),
        friction=LoadSharing(full_film_friction_coefficient=0.02),
        ball_chain=two_neighbours,
        ball_force=imposed_ball_force,
    )


LAWS: Mapping[str, OfRow] = {
    "the reference model of 0.1": _of_0_1,
    "as new: ZhouHoeprich1991 with B, C = 1.42, 0.8": with_friction(LoadSharing()),
    **{
        f"the same with {B:g}, {C:g}": with_friction(LoadSharing(decay=B, exponent=C))
        for B, C in ((2.32, 0.97), (1.90, 0.99), (2.1, 0.85), (1.42, 0.2), (1.42, 0.4), (1.42, 0.6))
    },
    "Balan2015": with_friction(BalanSharing()),
    "GreenwoodTripp1970": with_friction(GreenwoodTrippSharing()),
    "weighting factor of SKF2018": _by_weighting_factor,
    "a constant share of 0.35": with_friction(ConstantShare(0.35)),
    "a share of 0.35 at most": with_friction(CappedShare(0.35)),
    **{
        f"run in, λ_r = {worn:g}{' (the default)' if worn == RunInSharing().run_in_film_parameter else ''}":
        with_friction(RunInSharing(run_in_film_parameter=worn)) for worn in (0.4, 0.5, 0.6, 0.7, 0.8, 1.0)
    },
}  # fmt: skip


def points(name: str, model: OfRow) -> list[Point]:
    """The rows of a set against their bands, with a model for each."""
    found: list[Point] = []
    for row in compute.shipped_rows(SETS[name]):
        values = {column: value for column, value in row.items() if column != _MAXIMUM}
        found += [p for p in SETS[name].evaluate(model(values), values, Conditions()) if isinstance(p, Point)]
    return found


def trends_table() -> str:
    """Mean ratio, scatter and trends of each law, as Markdown: ratio ∝ d₀ ^ exponent, and P_h/d₀ ^ exponent."""
    of_set = ("mean ratio", "over d₀", "over P_h/d₀")
    lines = [["friction", *(f"{name}: {words}" for name in FITTED for words in of_set)]]
    for words, model in LAWS.items():
        cells: list[str] = []
        for name in FITTED:
            found = points(name, model)
            ratios = [point.ratio for point in found]
            exponents = {trend.descriptor: trend.exponent for trend in trends(found)}
            cells.append(f"{np.mean(ratios):.3f} ± {np.std(ratios, ddof=1):.3f}")
            cells += [f"{exponents[each]:+.2f}".replace("-", "−") for each in ("size", "steepness")]
        lines.append([words, *cells])
    return markdown_table(lines[0], lines[1:])


class _OfNuts:
    """A model that is asked for each nut as ``changed`` makes it."""

    def __init__(self, model: FrictionModel, changed: Callable[[BallScrew], BallScrew]) -> None:
        self._model, self._changed = model, changed

    def __call__(self, screw: BallScrew, oil: Lubricant, **operation: Any) -> FrictionResult:
        return self._model(self._changed(screw), oil, **operation)

    def __getattr__(self, name: str) -> Any:
        return getattr(self._model, name)


def of_nuts(model: FrictionModel, changed: Callable[[BallScrew], BallScrew]) -> FrictionModel:
    """The model, asked for nuts that are changed before."""
    return cast("FrictionModel", _OfNuts(model, changed))


def set_at_rest(screw: BallScrew) -> BallScrew:
    """The screw with a preload that was set at rest, where its nut has two contacts a ball."""
    nut: Any = screw.nut
    return dataclasses.replace(screw, nut=dataclasses.replace(nut, set_at_rest=True)) if nut.halves == 2 else screw


#: Turns of a circuit and of its return, assumed for all nuts.
TURNS_OF_A_CIRCUIT, TURNS_IN_RETURN = 2.5, 0.5


def with_moving_balls(screw: BallScrew) -> BallScrew:
    """The screw with a preload set at rest, returns to push, sheared oil and balls to spin up: all of it assumed."""
    balls_of_a_turn = math.pi * float(screw.pitch_circle_diameter / screw.ball_diameter)
    circuits = screw.nut.halves * max(1, round(float(screw.loaded_balls) / balls_of_a_turn / TURNS_OF_A_CIRCUIT))
    losses = {
        "recirculation": ReturnBraking(return_balls=round(TURNS_IN_RETURN * balls_of_a_turn), returns=circuits),
        "sheared_oil": ShearedOil(oil_share=1.0),
        "spin_up": SpinUp(entries=circuits, lost_speed=0.0),
    }
    nut: Any = dataclasses.replace(screw.nut, losses={**screw.nut.losses, **losses})
    return set_at_rest(dataclasses.replace(screw, nut=nut))


_CHAIN = dataclasses.replace(REFERENCE, ball_force=ChainBallForce())
_JAMMED = dataclasses.replace(REFERENCE, ball_force=ChainBallForce(gap=0.0))
#: One assumption of the reference model changed at a time, by words.
CHANGES: Mapping[str, FrictionModel] = {
    "as it is": REFERENCE,
    "film by the oil's own limit (arana)": dataclasses.replace(REFERENCE, full_film=arana_traction),
    "film friction 0.035, the limit of PAO": dataclasses.replace(
        REFERENCE, friction=RunInSharing(full_film_friction_coefficient=0.035)
    ),
    "film friction 0.053, of naphthenic oil": dataclasses.replace(
        REFERENCE, friction=RunInSharing(full_film_friction_coefficient=0.053)
    ),
    "boundary friction 0.06, of fresh surfaces": dataclasses.replace(REFERENCE, friction=RunInSharing(0.06)),
    "a full bath of oil": dataclasses.replace(REFERENCE, inlet=flooded_inlet),
    "force between balls 0.0005 Q, a fill with gaps": dataclasses.replace(
        REFERENCE, ball_force=ProportionalBallForce(0.0005)
    ),
    "law of the chain, a gap of half a ball": _CHAIN,
    "law of the chain, no gap": _JAMMED,
    "preload set at rest, balls off their line": of_nuts(REFERENCE, set_at_rest),
    "set at rest, law of the chain": of_nuts(_CHAIN, set_at_rest),
    "the same with returns, sheared oil and spin-up": of_nuts(_CHAIN, with_moving_balls),
    "calibration rexroth-2006": calibrated(REFERENCE, calibrations()["rexroth-2006"]),
    "calibration hiwin": calibrated(REFERENCE, calibrations()["hiwin"]),
    "calibration jis": calibrated(REFERENCE, calibrations()["jis"]),
}


def changes_table() -> str:
    """Mean ratio and scatter of each set and kind of nut with one change at a time, as Markdown."""
    lines: list[list[str]] = []
    for words, model in CHANGES.items():
        groups: dict[str, list[float]] = {}
        for name in (*FITTED, "hiwin-stock", "thk-jis"):
            data = SETS[name]
            for row in compute.shipped_rows(data):
                for point in data.evaluate(model, row, data.conditions):
                    groups.setdefault(f"{data.maker}, {point.group}", []).append(point.ratio)
        if not lines:
            lines = [["change", *(f"{group} ({len(ratios)})" for group, ratios in groups.items())]]
        scatters = {group: f" ± {np.std(r, ddof=1):.2f}" if len(r) > 1 else "" for group, r in groups.items()}
        lines.append([words, *(f"{np.mean(ratios):.2f}{scatters[group]}" for group, ratios in groups.items())])
    return markdown_table(lines[0], lines[1:])


def strata_table() -> str:
    """Mean ratio, scatter and share in band of the rows of each size, as they are and calibrated, as Markdown."""
    models = {"uncalibrated": REFERENCE}
    models |= {name: calibrated(REFERENCE, one) for name, one in calibrations().items()}
    lines = [["rows", "number", *models]]
    for name in FITTED:
        found = [points(name, lambda _, model=model: model) for model in models.values()]
        for words, (low, high) in {**CLASSES, "all": (0.0, math.inf)}.items():
            strata = [[point for point in of_model if low <= point.descriptors["size"] < high] for of_model in found]
            lines.append([f"{name}, {words}", str(len(strata[0])), *map(_judged, strata)])
    return markdown_table(lines[0], lines[1:])


def _judged(found: Sequence[Point]) -> str:
    ratios = [point.ratio for point in found]
    share = np.mean([bool(point.in_band) for point in found])
    return f"{np.mean(ratios):.3f} ± {np.std(ratios, ddof=1):.3f}, {share:.0%}".replace("%", " %")
