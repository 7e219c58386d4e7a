"""Named calibrations: one or two numbers of a model, fitted once to rows that are shipped, and how sure the fit is.

``benchmarks/fit_calibration.py`` fits them and writes ``data/calibrations.toml``; nothing else does.
"""

from __future__ import annotations

import dataclasses
import functools
import math
import tomllib
from collections.abc import Mapping, Sequence
from importlib import resources
from typing import Any

from ballscrew.basis.arrays import ByValue
from ballscrew.basis.errors import Fault, InputError, nearest
from ballscrew.basis.quantities import Ratio
from ballscrew.physics.friction.model import FrictionModel, coefficients
from ballscrew.physics.laws.ball_chain import ProportionalBallForce, opposed_neighbours

#: The numbers that a calibration sets, and where they stand in a model.
PARAMETERS: Mapping[str, str] = {
    "boundary_friction_coefficient": "friction.boundary_friction_coefficient",
    "share_of_load": "ball_force.share_of_load",
}


@dataclasses.dataclass(frozen=True, eq=False, kw_only=True)
class Calibration(ByValue):
    """A boundary friction coefficient, and a ball-to-ball force in units of the load of a ball, for all screws."""

    name: str
    #: The model that was fitted.
    model: str
    #: Whose rows or rule it was fitted to.
    maker: str
    #: The kinds of nut that it was fitted to, by the contacts of a ball.
    contacts_per_ball: Sequence[int]
    boundary_friction_coefficient: float
    share_of_load: float
    #: The numbers that were fitted, in the order of the covariance; others are those of the model.
    fitted: Sequence[str]
    covariance: Sequence[Sequence[float]]
    #: How many values were fitted, and what is left: the sum of the squares of (model − middle) / half the band.
    rows: int
    cost: float
    objective: str
    #: SHA-256 of the files with the rows.
    data: Mapping[str, str]
    version: str
    command: str
    #: Whether the rows fitted are those that ``data/validation/splits.toml`` declares, or all of the files.
    declared_rows: bool = False

    @property
    def parameters(self) -> Mapping[str, str]:
        """The fitted numbers, and where they stand in a model."""
        return {name: PARAMETERS[name] for name in self.fitted}

    @property
    def standard_errors(self) -> tuple[float, ...]:
        """Standard errors of the fitted numbers."""
        return tuple(math.sqrt(row[i]) for i, row in enumerate(self.covariance))

    @property
    def correlation(self) -> float | None:
        """Correlation of the errors of two numbers; None of one."""
        if len(self.fitted) < 2:
            return None
        one, other = self.standard_errors
        return self.covariance[0][1] / (one * other)


#: Written for a calibration: that of the make of the catalogue row.
BY_MAKE = "by-make"


def is_of_maker(maker: str, make: str) -> bool:
    """Test whether a text, in any letters, names a maker: ``"Bosch Rexroth"`` names Rexroth."""
    return bool(maker) and maker.casefold() in make.casefold()


def calibration_of_make(make: str) -> Calibration | None:
    """The calibration of a maker, of several the one of most numbers; None of a maker that has none."""
    values = [one for one in calibrations().values() if is_of_maker(one.maker, make)]
    return max(values, key=lambda one: len(one.fitted), default=None)


@functools.cache
def calibrations() -> Mapping[str, Calibration]:
    """The calibrations shipped, by name (``data/calibrations.toml``)."""
    text = resources.files("ballscrew").joinpath("data/calibrations.toml").read_text(encoding="utf-8")
    tables: dict[str, dict[str, Any]] = tomllib.loads(text)
    return {name: Calibration(name=name, **table) for name, table in tables.items()}


def calibration(name: str) -> Calibration:
    """The calibration of that name. Raises :class:`~ballscrew.basis.errors.InputError` with the nearest if there is
    none.
    """
    known = calibrations()
    if name not in known:
        raise InputError(Fault("model.calibration", "unknown calibration", name, nearest(name, known)))
    return known[name]


def calibrated(model: FrictionModel, result: Calibration) -> FrictionModel:
    """The model with the numbers that a calibration fitted, and with neighbours that rub as in the fitted model.

    In a model whose neighbours brake, the fitted force between balls would brake with all of it, ten times too much.
    Raises :class:`~ballscrew.basis.errors.InputError` for a model that has no boundary friction, or whose force
    between the balls is imposed.
    """
    friction: Any = model.friction
    own = getattr(friction, "boundary_friction_coefficient", result.boundary_friction_coefficient)
    fitted = "boundary_friction_coefficient" in result.fitted
    return with_parameters(model, result.boundary_friction_coefficient if fitted else own, result.share_of_load)


def with_parameters(model: FrictionModel, boundary_friction_coefficient: Ratio, share_of_load: Ratio) -> FrictionModel:
    """The model with these two numbers, and neighbours that rub; raises as :func:`calibrated` does."""
    friction: Any = model.friction
    faults: list[Fault] = []
    if model.ball_to_ball_force is not None:
        problem = "does not count with a calibration, which sets the force between the balls"
        faults.append(
            Fault("model.ball_to_ball_force", problem, str(model.ball_to_ball_force), "leave one of the two out")
        )
    has_one = "boundary_friction_coefficient" in coefficients(friction)
    if has_one and not faults:
        return dataclasses.replace(
            model,
            friction=dataclasses.replace(friction, boundary_friction_coefficient=boundary_friction_coefficient),
            ball_force=ProportionalBallForce(share_of_load),
            ball_chain=opposed_neighbours,
        )
    if not has_one:
        remedy = 'take a friction law that has one, such as "load-sharing"'
        faults.append(Fault("model.friction", "has no boundary friction to calibrate", "", remedy))
    raise InputError(*faults)
