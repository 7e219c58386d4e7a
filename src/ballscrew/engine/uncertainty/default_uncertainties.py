"""Default uncertainties of inputs that are rarely known: ``data/uncertainties.toml``, about the values of a case."""

from __future__ import annotations

import dataclasses
import functools
import math
import operator
import tomllib
from collections.abc import Collection, Mapping
from importlib import resources
from typing import Any

from ballscrew.basis.quantities import Force, Info
from ballscrew.engine.evaluation.outputs import inputs_of
from ballscrew.engine.uncertainty.distributions import Distribution, LogNormal, Normal, Triangular, Uniform, within
from ballscrew.physics.components.materials import Lubricant
from ballscrew.physics.components.nut import OversizeBallNut
from ballscrew.physics.components.oil_grades import TEMPERATURE
from ballscrew.physics.components.screw import BallScrew
from ballscrew.physics.friction.model import FrictionModel
from ballscrew.physics.laws.traits import traits_of
from ballscrew.physics.solvers.load_distribution import preload_growth

#: Half the width of the interval that holds 95 % of a normal distribution, in standard deviations.
NORMAL_95 = 1.959963984540054
#: Share of a value that is known to be of a kind, where others of its quantity lie ``between`` two numbers.
NEAR = 0.1
#: What stands for a source where there is none.
JUDGEMENT = "judgement"
#: The viscosity of an oil whose grade and temperature are known.
_OF_GRADE = "viscosity_of_grade"
#: The viscosity of an oil of a data sheet at a temperature that is known.
_OF_SHEET = "viscosity_of_sheet"


@dataclasses.dataclass(frozen=True, kw_only=True)
class DefaultUncertainty:
    """Default uncertainty of an input, in one of five forms, with its source and the reason in a sentence.

    ``half_width``, ``share``, ``limits``, ``between`` and ``factor`` are as the head of the file says.
    """

    name: str
    source: str
    reason: str
    half_width: float | None = None
    share: float | None = None
    limits: float | None = None
    between: tuple[float, float] | None = None
    factor: float | None = None

    def about(self, value: float, info: Info) -> Distribution | None:
        """The distribution about a value of a quantity, SI; None for one at its lower bound, which was switched off."""
        bound = info.at_least if info.above is None else info.above
        above = value - (bound or 0.0)
        if above <= 0:
            return None
        if self.half_width is not None:
            distribution: Distribution = Normal(value, self.half_width / NORMAL_95)
        elif self.share is not None:
            distribution = Normal(value, self.share * above / NORMAL_95)
        elif self.between is not None:
            low, high = self.between
            known = Normal(value, NEAR * value / NORMAL_95)
            distribution = Triangular(low, value, high) if low < value < high else known
        elif self.limits is not None:
            distribution = Uniform(value * (1 - self.limits), value * (1 + self.limits))
        else:
            assert self.factor is not None, self.name
            distribution = LogNormal(value, math.exp(math.log(self.factor) / NORMAL_95))
        return within(distribution, info)


@functools.cache
def default_uncertainties() -> Mapping[str, DefaultUncertainty]:
    """Those shipped, by the name of the input."""
    text = resources.files("ballscrew").joinpath("data/uncertainties.toml").read_text(encoding="utf-8")
    tables: dict[str, dict[str, Any]] = tomllib.loads(text)
    return {name: DefaultUncertainty(name=name, **_hashable(table)) for name, table in tables.items()}


def _hashable(table: Mapping[str, Any]) -> dict[str, Any]:
    """A table with tuples for its lists."""
    return {key: tuple(value) if isinstance(value, list) else value for key, value in table.items()}


def default_distributions(
    model: FrictionModel,
    screw: BallScrew,
    lubricant: Lubricant,
    *,
    given: Collection[str] = (),
    exact: Collection[str] = (),
) -> Mapping[str, tuple[Distribution, DefaultUncertainty]]:
    """The usual distributions of inputs, about the values they have, and where they are from.

    Left out are those whose distribution is ``given`` and those that are known exactly. Of an oil of a grade or
    of a data sheet the temperature is uncertain and the viscosity follows, or, where the temperature is exact, the
    viscosity is by what a grade leaves open: never both, as one would undo the other. The preload of oversize balls is
    as uncertain as that of other nuts, and by what is uncertain of their size.
    """
    inputs, known = inputs_of(model, screw, lubricant), default_uncertainties()
    parts = {"screw": screw, "lubricant": lubricant, "model": model, "nut": screw.nut}
    result: dict[str, tuple[Distribution, DefaultUncertainty]] = {}
    for name in known:
        if name not in inputs or name in given or name in exact or not _counts(name, model, lubricant, exact):
            continue
        part, quantity = inputs[name]
        of_loss = name.startswith("losses.")
        value = screw.nut.value_of(name) if of_loss else operator.attrgetter(name)(parts[part])
        if value is None and name == "ball_to_ball_force":
            value = model.imposed_ball_force(screw)
        if value is None:
            continue  # preload of balls whose oversize is given
        uncertainty = known[_of_oil(lubricant) if name == "viscosity" else name]
        if name == "preload" and isinstance(screw.nut, OversizeBallNut) and value > 0:
            uncertainty = _of_oversize_balls(uncertainty, known["oversize"], screw, float(value))
        distribution = uncertainty.about(float(value), quantity.info)
        if distribution is not None:
            result[name] = distribution, uncertainty
    return result


def _of_oversize_balls(
    usual: DefaultUncertainty, oversize: DefaultUncertainty, screw: BallScrew, preload: Force
) -> DefaultUncertainty:
    """The uncertainty of a preload that balls of an uncertain oversize make: both causes are independent."""
    assert usual.share is not None
    assert oversize.half_width is not None
    by_size = preload_growth(screw, preload, screw.nut.bodies) * oversize.half_width
    share = math.hypot(usual.share, by_size)
    reason = f"{usual.share:.0%} as of other nuts, and {by_size:.0%} for half a gauge of balls: {oversize.reason}"
    return dataclasses.replace(usual, share=share, source=oversize.source, reason=reason)


def _of_oil(lubricant: Lubricant) -> str:
    """The default of the viscosity by what the oil was made from."""
    if lubricant.sheet is not None:
        return _OF_SHEET
    return "viscosity" if lubricant.grade is None else _OF_GRADE


def _counts(name: str, model: FrictionModel, lubricant: Lubricant, exact: Collection[str]) -> bool:
    """Test whether an input affects the result."""
    if name == "ball_to_ball_force":
        return traits_of(model.ball_force).uses_imposed_force
    if name == "friction.full_film_friction_coefficient":
        return model.full_film is None
    if name == "limiting_shear_coefficient":
        return traits_of(model.full_film).reads_limiting_shear
    if name == "viscosity" and lubricant.follows_temperature:
        return TEMPERATURE.name in exact
    return True
